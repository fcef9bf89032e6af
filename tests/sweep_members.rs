//! Members of a family, whose file is parsed once, are in every field what separate readings of the file are.

use crate::support::folder;
use kutzbach::format::{ReadOptions, Template, file_bytes, read_bytes_of, read_file_with};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, Depth, analyse};
use kutzbach::sweep::{
    Facts, Family, MeasuredFile, Outcome, Over, Plan, Sample, Shard, Status, outcome,
};

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
    let [mut parsed, mut varied] = [0; 2];
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
            let place = format!("{file}: {name}={value}");
            assert_eq!(format!("{read:?}"), format!("{own:?}"), "{place}");
            let look = |mechanism: &Mechanism| format!("{mechanism:?}");
            if let Some(mechanism) = template.with_varied(&asked.settings, look) {
                assert_eq!(mechanism, look(&own.unwrap().mechanism), "{place}");
                varied += 1;
            }
        }
    }
    assert_eq!(parsed, FAMILIES.len());
    assert!(varied > 15, "{varied} have all but numbers in common");
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

/// A planar four-bar, not closed as it is drawn; of some lengths its bars do not reach.
const FOUR_BAR: &str = r#"<robot name="four_bar" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="a" value="1"/>
  <xacro:property name="b" value="7/2"/>
  <xacro:property name="c" value="2"/>
  <link name="base"/> <link name="crank"/> <link name="coupler"/> <link name="rocker"/>
  <joint name="main" type="revolute">
    <parent link="base"/> <child link="crank"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="pivot" type="revolute">
    <parent link="base"/> <child link="rocker"/> <origin xyz="4 0 0"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="pin" type="revolute">
    <parent link="crank"/> <child link="coupler"/> <origin xyz="0 ${a} 0"/> <axis xyz="0 0 1"/>
  </joint>
  <loop name="end" type="revolute">
    <predecessor link="coupler"><origin xyz="${b} 0 0"/></predecessor>
    <successor link="rocker"><origin xyz="0 ${c} 0"/></successor>
    <axis xyz="0 0 1"/>
  </loop>
</robot>
"#;

/// A crank, a rod and a slider beside the crank's axis.
const SLIDER_CRANK: &str = r#"<robot name="slider_crank" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="a" value="1"/>
  <xacro:property name="b" value="2"/>
  <xacro:property name="e" value="1/2"/>
  <link name="base"/> <link name="crank"/> <link name="rod"/> <link name="slider"/>
  <joint name="main" type="revolute">
    <parent link="base"/> <child link="crank"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="pin" type="revolute">
    <parent link="crank"/> <child link="rod"/> <origin xyz="0 ${a} 0"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="base"/> <child link="slider"/> <origin xyz="${b} ${e} 0"/> <axis xyz="1 0 0"/>
  </joint>
  <loop name="end" type="revolute">
    <predecessor link="rod"><origin xyz="${b} 0 0"/></predecessor>
    <successor link="slider"><origin xyz="0 0 0"/></successor>
    <axis xyz="0 0 1"/>
  </loop>
</robot>
"#;

/// The file with another value written in it where a measure or an argument is named.
fn rewritten(text: &str, name: &str, value: &str) -> String {
    let heads = ["default", "value"].map(|own| format!("name=\"{name}\" {own}=\""));
    let from = heads
        .iter()
        .find_map(|head| Some(text.find(head)? + head.len()))
        .unwrap();
    let to = from + text[from..].find('"').unwrap();
    format!("{}{value}{}", &text[..from], &text[to..])
}

/// What a row would say of a text by itself.
fn of_text(text: &str, file: &str, asked: &AnalysisOptions) -> Outcome {
    let none = ReadOptions::default();
    let reading = read_bytes_of(text.as_bytes(), file, None, &none).unwrap();
    let analysis = analyse(&reading.mechanism, asked).unwrap();
    outcome(&reading.mechanism, &analysis, asked.depth)
}

#[test]
fn members_at_random_are_in_every_field_what_files_of_their_own_are() {
    let text = |path: &str| std::fs::read_to_string(folder(path)).unwrap();
    let bennett = text("mechanisms/bennett_isogram.urdf");
    let [six_legs, robot] =
        ["six_legs", "robot"].map(|name| text(&format!("benches/families/{name}.urdf")));
    let families = [
        (FOUR_BAR, &["a=0.5..3", "b=0.5..5", "c=0.5..5"][..]),
        (SLIDER_CRANK, &["a=0.5..3", "b=0.5..5", "e=0..2"]),
        (bennett.as_str(), &["p=0.5..3", "q=0.5..3", "h=0.1..1"]),
        (six_legs.as_str(), &["foot=0.1..0.5"]),
        (robot.as_str(), &["crank=0.01..0.1", "rod=0.2..0.4"]),
    ];
    let asked = AnalysisOptions {
        depth: Depth::Motions,
        ..AnalysisOptions::default()
    };
    let mut seen = Vec::new();
    for (text, over) in families {
        let over = over.iter().map(|own| Over::read(own).unwrap());
        let sample = Sample::read("random:50").unwrap();
        let plan = Plan::new(over.collect(), Some(sample)).unwrap();
        let source = MeasuredFile::of_text(text, "own.urdf");
        let family = Family::new(source, plan, asked.clone()).unwrap();
        let names: Vec<&str> = family.plan().names().collect();
        let rows: Vec<_> = family.variants(Shard::default()).collect();
        assert_eq!(rows.len(), 50);
        for row in rows {
            let pairs = names.iter().zip(&row.values);
            let own = pairs.fold(text.to_owned(), |own, (name, value)| {
                rewritten(&own, name, &value.setting)
            });
            let expected = of_text(&own, "own.urdf", &asked);
            assert_eq!(row.outcome, expected, "{own}");
            seen.push(expected.status);
        }
    }
    // Of all kinds but those that are no mechanism.
    assert!(seen.contains(&Status::Unassembled), "all assemble");
    let analysed = seen.iter().filter(|own| **own == Status::Analysed).count();
    assert!(analysed > 100, "{analysed} were analysed");
}
