//! The book and the program say the same.
use kutzbach::format::read;
use kutzbach::mechanism::JointKind;
use kutzbach::report::{ExpectedFile, Options, compare, report};

const FORMAT: &str = include_str!("../docs/src/format.md");
const FORMATS: &str = include_str!("../docs/src/formats.md");
const NOTATION: &str = include_str!("../docs/src/notation.md");
const DEPENDENCIES: &str = include_str!("../docs/dependencies.md");
const MANIFEST: &str = include_str!("../Cargo.toml");

/// The first fenced block of a language.
fn block<'a>(page: &'a str, language: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("```{language}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

#[test]
fn the_example_is_a_mechanism_that_meets_its_expectations() {
    let reading = read(block(FORMAT, "xml"), "slider_crank.urdf", &[]).unwrap();
    assert!(reading.warnings.is_empty(), "{:?}", reading.warnings);
    assert!(reading.mechanism.precision().is_exact());
    let report = report(&reading, "slider_crank.urdf", &Options::default()).unwrap();
    let own = reading.mechanism.expectation().cloned().unwrap();
    let beside = ExpectedFile::parse(block(FORMAT, "json")).unwrap();
    for expectation in [own, beside.expectation("slider_crank").unwrap()] {
        let comparison = compare(&report, &expectation);
        assert!(comparison.wrong.is_empty(), "{:?}", comparison.wrong);
        assert!(!comparison.right.is_empty());
    }
}

#[test]
fn the_smallest_files_of_all_formats_have_one_freedom() {
    let examples = FORMATS
        .split_once("## The smallest file of each")
        .unwrap()
        .1;
    let mut formats = Vec::new();
    // Every second piece is what stands in a fence, behind the name of its language.
    for fenced in examples.split("```").skip(1).step_by(2) {
        let (_, text) = fenced.split_once('\n').unwrap();
        let reading = read(text, "example", &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let told = report(&reading, "example", &Options::default()).unwrap();
        assert_eq!(told.mobility.finite, Some(1), "{text}");
        formats.push(reading.format);
    }
    assert_eq!(formats[1..], ["sdf", "mjcf", "asmt", "freecad"]);
    for kind in JointKind::ALL {
        assert!(
            FORMATS.contains(&format!("\n| `{}` |", kind.word())),
            "{kind}"
        );
    }
}

#[test]
fn every_joint_type_has_its_row() {
    for kind in JointKind::ALL {
        let row = FORMAT
            .lines()
            .find(|line| line.starts_with(&format!("| `{}`", kind.word())))
            .unwrap_or_else(|| panic!("no row for {kind}"));
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        assert_eq!(cells[2], kind.class(), "{row}");
        assert_eq!(cells[3], kind.freedom().to_string(), "{row}");
        assert_eq!(cells[4].contains("`axis`"), kind.uses_axis(), "{row}");
        assert_eq!(
            cells[4].contains("`axis2`"),
            kind.uses_second_axis(),
            "{row}"
        );
        assert_eq!(cells[4].contains("lead"), kind.uses_lead(), "{row}");
        for word in cells[1].split(", ") {
            assert_eq!(JointKind::from_word(word.trim_matches('`')), Some(kind));
        }
        let letters = NOTATION.split_once("## Displacement subgroups").unwrap().1;
        assert!(
            letters.contains(kind.class()),
            "{} is not in the notation",
            kind.class()
        );
    }
}

#[test]
fn every_dependency_is_listed() {
    let sections = MANIFEST.split("\n[").filter(|section| {
        let title = section.lines().next().unwrap_or_default();
        title.ends_with("dependencies]")
    });
    for line in sections.flat_map(|section| section.lines().skip(1)) {
        let Some((name, _)) = line.split_once([' ', '=', '.']) else {
            continue;
        };
        if name == "#" || name.starts_with("kutzbach") {
            continue;
        }
        assert!(
            DEPENDENCIES.contains(&format!("| {} |", name.trim())),
            "{name} is not listed"
        );
    }
}
