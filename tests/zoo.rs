//! The reference mechanisms: what is known of them, and what the analysis says.
//!
//! `redundant` is compared everywhere, since it follows from the other two. `locked` is compared where the pose is regular
//! and the mechanism moves: at a singular pose what moves at the pose and what moves on a branch differ, and in a rigid
//! mechanism to be locked says nothing.

use crate::support;

use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, PoseKind};
use serde_json::Value;
use std::collections::BTreeSet;
use support::{KNOWN_ZOO, Known, assert_none, folder, is_locked, locked_names};

fn expected() -> Value {
    let text = std::fs::read_to_string(folder("tests/zoo/expected.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn disagreements((name, mechanism, analysis): &Known, expected: &Value) -> Vec<String> {
    let mut wrong = Vec::new();
    let Some(home) = &analysis.home else {
        return vec![format!("{name}: does not assemble")];
    };
    let kutzbach = expected["kutzbach"].as_i64().unwrap();
    let instantaneous = expected["instantaneous"].as_u64().unwrap();
    let finite = expected["finite"].as_u64().unwrap();
    let mut compare = |what: &str, found: String, expected: String| {
        if found != expected {
            wrong.push(format!("{name}: {what} is {found}, expected {expected}"));
        }
    };
    compare(
        "kutzbach",
        analysis.kutzbach.to_string(),
        kutzbach.to_string(),
    );
    compare(
        "instantaneous",
        format!("{:?}", home.instantaneous),
        format!("{:?}", Some(instantaneous as usize)),
    );
    compare(
        "redundant",
        format!("{:?}", home.redundant),
        format!("{:?}", Some(instantaneous as i64 - kutzbach)),
    );
    let (low, high) = analysis.mobility.bounds;
    let (low, high) = (low.unwrap(), high.unwrap());
    if !(low as u64 <= finite && finite <= high as u64) {
        wrong.push(format!(
            "{name}: finite mobility between {low} and {high}, expected {finite}"
        ));
    }
    if expected["pose"] == "singular" && analysis.mobility.pose == Some(PoseKind::Regular) {
        wrong.push(format!("{name}: a singular pose is called regular"));
    }
    if finite > 0
        && expected["pose"] == "regular"
        && let Some(names) = expected["locked"].as_array()
    {
        wrong.extend(locked_disagreements(name, mechanism, analysis, names));
    }
    wrong
}

fn locked_disagreements(
    name: &str,
    mechanism: &Mechanism,
    analysis: &Analysis,
    expected: &[Value],
) -> Vec<String> {
    let expected: BTreeSet<String> = expected
        .iter()
        .map(|name| name.as_str().unwrap().to_owned())
        .collect();
    let found = locked_names(mechanism, analysis);
    let whole = |names: &BTreeSet<String>| -> BTreeSet<String> {
        names.iter().filter(|n| !n.contains('.')).cloned().collect()
    };
    let mut wrong = Vec::new();
    if whole(&found) != whole(&expected) {
        wrong.push(format!(
            "{name}: locked {:?}, expected {:?}",
            whole(&found),
            whole(&expected)
        ));
    }
    for part in expected.iter().filter(|n| n.contains('.')) {
        if !is_locked(part, &found, mechanism) {
            wrong.push(format!("{name}: {part} should be locked; found {found:?}"));
        }
    }
    for (joint, role) in mechanism.joints().iter().zip(&analysis.roles) {
        if joint.freedom() > 0 && role.locked.is_none() {
            wrong.push(format!(
                "{name}: whether {} is locked stays open",
                joint.name
            ));
        }
    }
    wrong
}

#[test]
fn counts_ranks_and_locked_joints_are_the_known_ones() {
    let expected = expected();
    assert_eq!(KNOWN_ZOO.len(), 132);
    assert_eq!(expected.as_object().unwrap().len(), KNOWN_ZOO.len());
    let wrong = KNOWN_ZOO
        .iter()
        .map(|known| disagreements(known, &expected[&known.0]));
    assert_none(&wrong.collect::<Vec<_>>().concat());
}

/// The reference files carry sixty digits: nothing in them is rounded, so no answer may come with a reservation.
#[test]
fn every_file_is_drawn_closed_and_decided_without_reservation() {
    let wrong = KNOWN_ZOO.iter().map(|(name, _, analysis)| {
        let mut wrong = Vec::new();
        if !analysis.assembly.closed || !(analysis.assembly.moved < 1e-12) {
            wrong.push(format!(
                "{name}: moved {:.1e} to close within {:.1e}",
                analysis.assembly.moved, analysis.assembly.residual
            ));
        }
        for part in &analysis.parts {
            if let Some(note) = &part.note {
                wrong.push(format!("{name}: {note}"));
            }
        }
        wrong
    });
    assert_none(&wrong.collect::<Vec<_>>().concat());
}

/// Everything that is known of the reference mechanisms, as the program itself compares it: all of it is decided, and right.
#[test]
fn every_known_fact_is_found() {
    let run = crate::support::program()
        .args(["check", "--format", "json", "tests/zoo"])
        .current_dir(folder(""))
        .output()
        .unwrap();
    let told: Value = serde_json::from_slice(&run.stdout).unwrap();
    let count = |what: &str| told[what].as_u64().unwrap();
    assert_eq!(count("files"), 132);
    for what in ["without_expectation", "unreadable"] {
        assert_eq!(told[what].as_array().unwrap().len(), 0, "{what}");
    }
    assert_eq!((count("wrong"), count("open")), (0, 0), "{told:#}");
    assert!(count("right") >= 769, "{} facts", count("right"));
}
