//! Members of a family, whose file is parsed once, are in every field what separate readings of the file are.

use crate::support::folder;
use kutzbach::format::{ReadOptions, Template, file_bytes, read_file_with};
use kutzbach::mobility::{Analysis, AnalysisOptions, Depth, analyse};
use kutzbach::sweep::{Facts, Family, MeasuredFile, Over, Plan, Shard, Status};

/// Files with one of their measures and values of it; `acos(2)` and 1/0 make no mechanism.
const FAMILIES: [(&str, &str, &[&str]); 12] = [
    ("bennett_spoiled", "off", &["0", "1/1000", "1/0"]),
    ("bennett_isogram", "h", &["0", "1/2"]),
    ("bricard_line_symmetric_spoiled", "off", &["0", "1/100"]),
    ("bricard_threefold", "rise", &["1", "2"]),
    ("four_bar_two_circles", "a", &["1", "3/2"]),
    ("hooke_joint", "bend", &["pi/4", "acos(2)"]),
    ("oldham", "offset", &["0", "1/5", "0.125"]),
    ("oldham_measures", "L1", &["0.02", "0.03"]),
    ("parallelogram", "angle", &["pi/3", "acos(4/5)"]),
    ("peaucellier_tilted_slot", "tilt", &["0", "1/10"]),
    ("scissor_lift", "w", &["2/5", "1/2"]),
    ("waldron_six_bar_spoiled", "off", &["0", "1/50"]),
];

fn options(name: &str, value: &str) -> ReadOptions {
    ReadOptions {
        settings: vec![(name.to_owned(), value.to_owned())],
        ..ReadOptions::default()
    }
}

#[test]
fn a_template_reads_what_the_file_is_read_as() {
    let mut parsed = 0;
    for (file, name, values) in FAMILIES {
        let path = folder("mechanisms").join(format!("{file}.urdf"));
        let bytes = file_bytes(&path).unwrap();
        let shown = path.display().to_string();
        let none = ReadOptions::default();
        let template = Template::new(&bytes, &shown, Some(&path), &none);
        parsed += usize::from(template.is_parsed());
        for value in values {
            let asked = options(name, value);
            let read = template.read(&asked.settings);
            let own = read_file_with(&path, &asked);
            assert_eq!(
                format!("{read:?}"),
                format!("{own:?}"),
                "{file}: {name}={value}"
            );
        }
    }
    assert_eq!(parsed, FAMILIES.len());
}

/// What a row has of an analysis.
fn facts(analysis: &Analysis) -> Facts {
    let mobility = &analysis.mobility;
    let home = analysis.home.as_ref().unwrap();
    Facts {
        kutzbach: Some(analysis.kutzbach),
        instantaneous: home.instantaneous,
        redundant: home.redundant,
        finite: mobility.finite(),
        verdict: Some(mobility.verdict),
        pose: mobility.pose,
        kind: mobility.kind,
        class: mobility.class,
        branches: analysis.branches.as_ref().map(Vec::len),
        ..Facts::default()
    }
}

#[test]
fn members_have_the_verdicts_of_separate_files() {
    for (file, name, values) in FAMILIES {
        let path = folder("mechanisms").join(format!("{file}.urdf"));
        let source = MeasuredFile {
            bytes: file_bytes(&path).unwrap(),
            file: path.display().to_string(),
            base: Some(path.clone()),
            options: ReadOptions::default(),
        };
        let over = Over::read(&format!("{name}={}", values.join(","))).unwrap();
        let plan = Plan::new(vec![over], None).unwrap();
        let asked = AnalysisOptions {
            depth: Depth::Verdict,
            ..AnalysisOptions::default()
        };
        let family = Family::new(source, plan, asked.clone()).unwrap();
        let rows: Vec<_> = family.variants(Shard::default()).collect();
        assert_eq!(rows.len(), values.len());
        for (row, value) in rows.iter().zip(values) {
            let place = format!("{file}: {name}={value}");
            // One row alone is the same as that row of many.
            assert_eq!(family.row(row.index).as_ref(), Some(row), "{place}");
            // The sweep gives the file's reader exact values.
            let setting = &row.values[0].setting;
            let reading = match read_file_with(&path, &options(name, setting)) {
                Ok(reading) => reading,
                Err(error) => {
                    assert_eq!(row.outcome.status, Status::Invalid, "{place}");
                    assert_eq!(row.outcome.reason, Some(error.to_string()), "{place}");
                    continue;
                }
            };
            let mut options = asked.clone();
            if reading.mechanism.configuration("home").is_some() {
                options.configuration = Some("home".to_owned());
            }
            let analysis = analyse(&reading.mechanism, &options).unwrap();
            assert_eq!(row.outcome.status, Status::Analysed, "{place}");
            let expected = Facts {
                // These are made of the analysis by the sweep alone.
                generic: row.outcome.facts.generic,
                margin: row.outcome.facts.margin,
                locked: row.outcome.facts.locked.clone(),
                ..facts(&analysis)
            };
            assert_eq!(row.outcome.facts, expected, "{place}");
        }
    }
}
