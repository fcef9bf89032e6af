//! The mechanisms of `mechanisms/` and what their own `<expect>` says of them.
//!
//! What the analysis decides must agree; where it leaves the finite mobility open, its bounds must contain the answer.

use crate::support;

use kutzbach::mechanism::{Expectation, Mechanism};
use kutzbach::mobility::{Analysis, PoseKind, Verdict};
use std::collections::BTreeSet;
use support::{KNOWN_OWN, Known, assert_none, is_locked, locked_names};

fn disagreements((name, mechanism, analysis): &Known) -> Vec<String> {
    let Some(expected) = mechanism.expectation() else {
        return vec![format!("{name}: states no expectation")];
    };
    let Some(home) = &analysis.home else {
        return vec![format!("{name}: does not assemble")];
    };
    let mut wrong = Vec::new();
    let mut compare = |what: &str, found: Option<i64>, expected: Option<i64>| {
        if expected.is_some() && found != expected {
            wrong.push(format!("{name}: {what} {found:?}, expected {expected:?}"));
        }
    };
    let whole = |number: Option<usize>| number.map(|n| n as i64);
    compare("kutzbach", Some(analysis.kutzbach), expected.kutzbach);
    compare(
        "instantaneous",
        whole(home.instantaneous),
        whole(expected.instantaneous),
    );
    compare("redundant", home.redundant, expected.redundant);
    if let (Some(instantaneous), Some(redundant), Some(kutzbach)) = (
        expected.instantaneous,
        expected.redundant,
        expected.kutzbach,
    ) && instantaneous as i64 - redundant != kutzbach
    {
        wrong.push(format!("{name}: its own numbers do not add up"));
    }
    wrong.extend(
        finite_disagreement(expected, analysis)
            .iter()
            .map(|w| format!("{name}: {w}")),
    );
    wrong.extend(
        locked_disagreement(mechanism, expected, analysis)
            .iter()
            .map(|w| format!("{name}: {w}")),
    );
    wrong
}

fn finite_disagreement(expected: &Expectation, analysis: &Analysis) -> Option<String> {
    let finite = expected.finite?;
    let (low, high) = analysis.mobility.bounds;
    let verdict = analysis.mobility.verdict;
    let right = match verdict {
        Verdict::Mobile | Verdict::Rigid => analysis.mobility.finite() == Some(finite),
        Verdict::Undecided => low.is_some_and(|l| l <= finite) && high.is_some_and(|h| finite <= h),
        Verdict::Unassembled => false,
    };
    let regular = expected.pose.as_deref().map(|pose| pose == "regular");
    if analysis.mobility.pose == Some(PoseKind::Regular) && regular == Some(false) {
        return Some("a singular pose is called regular".to_owned());
    }
    (!right).then(|| {
        format!(
            "{} with {low:?} to {high:?}, expected {finite}",
            verdict.word()
        )
    })
}

/// Compared at regular poses of mobile mechanisms, like the reference mechanisms.
fn locked_disagreement(
    mechanism: &Mechanism,
    expected: &Expectation,
    analysis: &Analysis,
) -> Option<String> {
    let names = expected.locked.as_ref()?;
    let singular = expected.pose.as_deref() == Some("singular");
    if singular || expected.finite == Some(0) || names.iter().any(|n| n == "all") {
        return None;
    }
    let expected: BTreeSet<String> = names.iter().cloned().collect();
    let found = locked_names(mechanism, analysis);
    let whole = |names: &BTreeSet<String>| -> BTreeSet<String> {
        names.iter().filter(|n| !n.contains('.')).cloned().collect()
    };
    let parts_found = expected
        .iter()
        .all(|part| is_locked(part, &found, mechanism));
    (whole(&found) != whole(&expected) || !parts_found)
        .then(|| format!("locked {found:?}, expected {expected:?}"))
}

#[test]
fn every_file_agrees_with_its_own_expectation() {
    assert!(KNOWN_OWN.len() >= 30, "found {}", KNOWN_OWN.len());
    let wrong: Vec<_> = KNOWN_OWN.iter().map(disagreements).collect();
    assert_none(&wrong.concat());
}

/// Their numbers are exact and their loops close, so assembly has nothing to do and the answers need no reservation.
/// Drawn open on purpose: their closed poses are what is asked for, and no number writes them down.
const DRAWN_OPEN: [&str; 5] = [
    "quad_16_17_18_19",
    "tetra_20_10_4",
    "tetra_6_7_8",
    "tetra_ii",
    "tetra_iii",
];

#[test]
fn every_file_is_drawn_closed_and_exact() {
    let wrong = KNOWN_OWN.iter().map(|(name, _, analysis)| {
        let mut wrong = Vec::new();
        let drawn_open = DRAWN_OPEN.contains(&name.as_str());
        if drawn_open != (analysis.assembly.steps > 0) {
            wrong.push(format!(
                "{name}: {} steps, moved {:.1e}",
                analysis.assembly.steps, analysis.assembly.moved
            ));
        }
        for part in &analysis.parts {
            wrong.extend(part.note.iter().map(|note| format!("{name}: {note}")));
        }
        wrong
    });
    assert_none(&wrong.collect::<Vec<_>>().concat());
}
