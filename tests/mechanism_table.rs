//! The table of `mechanisms/README.md` lists every file with the answer that the file itself states.
use crate::support;

use kutzbach::mechanism::Expectation;
use std::collections::BTreeMap;
use support::{folder, own_mechanisms};

/// The cells of a row: what it is, freedoms, pose, why it is interesting.
fn rows(page: &str) -> BTreeMap<String, Vec<String>> {
    let mut rows = BTreeMap::new();
    for line in page.lines().filter(|line| line.starts_with("| [`")) {
        let mut cells: Vec<String> = line
            .trim_matches('|')
            .split('|')
            .map(|cell| cell.trim().to_owned())
            .collect();
        let first = cells.remove(0);
        let (_, rest) = first.split_once("[`").unwrap();
        let (name, link) = rest.split_once("`](").unwrap();
        assert_eq!(link, format!("{name}.urdf)"));
        assert!(
            rows.insert(name.to_owned(), cells).is_none(),
            "{name} has two rows"
        );
    }
    rows
}

/// `1 (-2), 2 instantaneous`.
fn freedoms(expected: &Expectation) -> String {
    let (finite, kutzbach) = (expected.finite.unwrap(), expected.kutzbach.unwrap());
    match expected.instantaneous {
        Some(many) if many != finite => format!("{finite} ({kutzbach}), {many} instantaneous"),
        _ => format!("{finite} ({kutzbach})"),
    }
}

/// `regular`, the kind of singularity, or `singular` where it has no name.
fn pose(expected: &Expectation) -> String {
    let kind = expected.kind.clone().filter(|kind| !kind.is_empty());
    kind.or_else(|| expected.pose.clone())
        .unwrap()
        .replace('_', " ")
}

#[test]
fn every_file_has_its_row_and_every_row_its_file() {
    let page = std::fs::read_to_string(folder("mechanisms/README.md")).unwrap();
    let mut rows = rows(&page);
    for (name, mechanism) in own_mechanisms() {
        let row = rows
            .remove(&name)
            .unwrap_or_else(|| panic!("{name}.urdf is not in the table"));
        let expected = mechanism.expectation().unwrap();
        assert_eq!(row.len(), 4, "{name}");
        assert_eq!(row[1], freedoms(expected), "{name}");
        assert_eq!(row[2], pose(expected), "{name}");
        assert!(!row[0].is_empty() && !row[3].is_empty(), "{name}");
    }
    assert!(rows.is_empty(), "rows without a file: {:?}", rows.keys());
}
