//! Whether a report agrees with what is known of a mechanism; the rules are those of [`compare`].

use super::schema::{JointRow, Report};
use kutzbach_mobility::{PoseKind, Verdict};
use kutzbach_model::mechanism::{Expectation, JointKind};
use serde::Serialize;
use std::collections::BTreeSet;

/// One field in which report and expectation differ.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Disagreement {
    /// The field.
    pub what: &'static str,
    /// What was expected.
    pub expected: String,
    /// What the report says.
    pub found: String,
}

/// The outcome of a comparison: every stated field is in exactly one of the three lists.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Comparison {
    /// Fields that agree.
    pub right: Vec<&'static str>,
    /// Fields that differ.
    pub wrong: Vec<Disagreement>,
    /// Fields that the report has not decided.
    pub open: Vec<&'static str>,
}

/// What the report says about one field.
enum Found {
    Agrees,
    Open,
    Differs(String),
}

impl Comparison {
    fn add(&mut self, what: &'static str, expected: impl ToString, found: Found) {
        match found {
            Found::Agrees => self.right.push(what),
            Found::Open => self.open.push(what),
            Found::Differs(found) => self.wrong.push(Disagreement {
                what,
                expected: expected.to_string(),
                found,
            }),
        }
    }
}

/// Compares a report with an expectation.
///
/// Only fields that the expectation states are looked at. A field that the report has not decided is *open*, which is no
/// disagreement, unless what the report does know excludes the expected value: bounds on the finite mobility, candidates
/// for the instantaneous one, a mechanism that does not assemble.
///
/// Dimensions of branches are compared as a set: that all branches have dimension 1 is one fact, how many there are another.
///
/// Locked joints are compared at regular poses only, because at a singular pose what moves at the pose and what moves on a
/// branch differ (D9). Joints are named whole (`slider`) or in part (`slider.rot`; with several rotations `ball.rot` means
/// all of them and `ball.rot2` one).
#[must_use]
pub fn compare(report: &Report, expectation: &Expectation) -> Comparison {
    let mut comparison = Comparison::default();
    if let Some(expected) = expectation.kutzbach {
        let found = decided(&expected, Some(&report.kutzbach));
        comparison.add("kutzbach", expected, found);
    }
    if let Some(expected) = expectation.instantaneous {
        comparison.add("instantaneous", expected, instantaneous(report, expected));
    }
    if let Some(expected) = expectation.redundant {
        comparison.add("redundant", expected, redundant(report, expected));
    }
    if let Some(expected) = expectation.finite {
        comparison.add("finite", expected, finite(report, expected));
    }
    if let Some(expected) = &expectation.pose {
        let word = report.home.pose.map(|pose| pose.word().to_owned());
        let found = unless_unassembled(report, decided(expected, word.as_ref()));
        comparison.add("pose", expected, found);
    }
    if let Some(expected) = &expectation.kind {
        comparison.add("kind", expected, kind(report, expected));
    }
    if let Some(expected) = &expectation.locked {
        locked(report, expectation, expected, &mut comparison);
    }
    if let Some(expected) = &expectation.idle {
        comparison.add("idle", set_text(expected), idle(report, expected));
    }
    if let Some(expected) = expectation.branches {
        let count = report.branches.as_ref().map(Vec::len);
        let found = unless_unassembled(report, decided(&expected, count.as_ref()));
        comparison.add("branches", expected, found);
    }
    if let Some(expected) = &expectation.branch_dimensions {
        let expected = set_of_numbers(expected.iter().copied());
        let found = report
            .branches
            .as_ref()
            .map(|branches| set_of_numbers(branches.iter().map(|b| b.dimension)));
        let found = unless_unassembled(report, decided(&expected, found.as_ref()));
        comparison.add("branch_dimensions", expected, found);
    }
    comparison
}

fn decided<T: PartialEq + ToString>(expected: &T, found: Option<&T>) -> Found {
    match found {
        None => Found::Open,
        Some(found) if found == expected => Found::Agrees,
        Some(found) => Found::Differs(found.to_string()),
    }
}

/// A mechanism that does not assemble has no pose: what was expected of one cannot come true any more.
fn unless_unassembled(report: &Report, found: Found) -> Found {
    match found {
        Found::Open if report.mobility.verdict == Verdict::Unassembled => {
            Found::Differs("does not assemble".to_owned())
        }
        found => found,
    }
}

fn instantaneous(report: &Report, expected: usize) -> Found {
    let found = decided(&expected, report.home.instantaneous.as_ref());
    let [least, most] = report.home.candidates;
    match unless_unassembled(report, found) {
        Found::Open if expected < least || expected > most => {
            Found::Differs(format!("between {least} and {most}"))
        }
        found => found,
    }
}

/// Redundancy is what the instantaneous freedom exceeds the count by, and so has its candidates.
fn redundant(report: &Report, expected: i64) -> Found {
    let found = decided(&expected, report.home.redundant.as_ref());
    let freedom = expected.saturating_add(report.kutzbach);
    match unless_unassembled(report, found) {
        Found::Open => match usize::try_from(freedom) {
            Ok(freedom) => match instantaneous(report, freedom) {
                Found::Differs(_) => {
                    let [least, most] = report
                        .home
                        .candidates
                        .map(|n| n as i128 - i128::from(report.kutzbach));
                    Found::Differs(format!("between {least} and {most}"))
                }
                Found::Open | Found::Agrees => Found::Open,
            },
            Err(_) => Found::Differs(
                "as many as would leave less than no freedom are impossible".to_owned(),
            ),
        },
        found => found,
    }
}

fn finite(report: &Report, expected: usize) -> Found {
    let found = decided(&expected, report.mobility.finite.as_ref());
    match unless_unassembled(report, found) {
        Found::Open => match report.mobility.bounds {
            [Some(least), _] if expected < least => Found::Differs(format!("at least {least}")),
            [_, Some(most)] if expected > most => Found::Differs(format!("at most {most}")),
            _ => Found::Open,
        },
        found => found,
    }
}

fn kind(report: &Report, expected: &str) -> Found {
    match (report.home.kind, report.home.pose) {
        (Some(kind), _) if kind.word() == expected => Found::Agrees,
        (Some(kind), _) => Found::Differs(kind.word().to_owned()),
        (None, Some(PoseKind::Regular)) => Found::Differs("none, the pose is regular".to_owned()),
        (None, _) => unless_unassembled(report, Found::Open),
    }
}

fn locked(
    report: &Report,
    expectation: &Expectation,
    expected: &[String],
    comparison: &mut Comparison,
) {
    let expects_regular = expectation.pose.as_deref() == Some(PoseKind::Regular.word());
    match report.home.pose {
        // An analysis that does not decide regularity still says which joints stand still at the pose. Where the pose is
        // known to be regular, that is its answer for the branch.
        None if expects_regular => {}
        None => {
            comparison.open.push("locked");
            return;
        }
        Some(PoseKind::Singular) => return,
        Some(PoseKind::Regular) => {}
    }
    let finite = expectation.finite.or(report.mobility.finite);
    if expected.is_empty() && finite == Some(0) {
        return;
    }
    let found = unless_unassembled(report, locked_set(report, expected));
    comparison.add("locked", set_text(expected), found);
}

fn locked_set(report: &Report, expected: &[String]) -> Found {
    let movable: Vec<&JointRow> = report.joints.iter().filter(|j| j.freedom > 0).collect();
    if movable.iter().any(|joint| joint.locked.is_none()) {
        return Found::Open;
    }
    let whole: BTreeSet<&str> = movable
        .iter()
        .filter(|joint| joint.locked == Some(true))
        .map(|joint| joint.name.as_str())
        .collect();
    if expected.iter().any(|name| name == "all") {
        let moving: Vec<&str> = movable
            .iter()
            .filter(|joint| joint.locked == Some(false))
            .map(|joint| joint.name.as_str())
            .collect();
        return if moving.is_empty() {
            Found::Agrees
        } else {
            Found::Differs(format!("all but {}", moving.join(", ")))
        };
    }
    let (names, parts): (Vec<&String>, Vec<&String>) = expected
        .iter()
        .partition(|name| report.joints.iter().any(|joint| joint.name == **name));
    let mut expected_whole: BTreeSet<&str> = names
        .into_iter()
        .map(String::as_str)
        .filter(|name| movable.iter().any(|joint| joint.name == *name))
        .collect();
    for joint in &movable {
        let all_named = part_names(joint)
            .iter()
            .all(|name| parts.iter().any(|part| name.is(part)));
        if all_named {
            expected_whole.insert(&joint.name);
        }
    }
    let parts_hold = parts.iter().all(|part| {
        let mut named = movable.iter().flat_map(|joint| {
            part_names(joint)
                .into_iter()
                .map(move |name| (joint, name))
                .filter(|(_, name)| name.is(part))
        });
        let holds = |(joint, name): (&&JointRow, PartName)| {
            joint.locked == Some(true) || joint.locked_parts.contains(&name.own)
        };
        let Some(first) = named.next() else {
            return false;
        };
        holds(first) && named.all(holds)
    });
    if whole == expected_whole && parts_hold {
        return Found::Agrees;
    }
    let mut found: Vec<String> = whole.iter().map(|name| (*name).to_owned()).collect();
    for joint in &movable {
        if joint.locked == Some(false) {
            found.extend(joint.locked_parts.iter().cloned());
        }
    }
    Found::Differs(set_text(&found))
}

/// The two names of one freedom.
struct PartName {
    /// Its own, such as `ball.rot2`.
    own: String,
    /// That of all freedoms of the joint that do the same, such as `ball.rot`.
    group: String,
}

impl PartName {
    fn is(&self, name: &str) -> bool {
        self.own == name || self.group == name
    }
}

fn part_names(joint: &JointRow) -> Vec<PartName> {
    let parts = JointKind::from_word(&joint.kind).map_or(&[][..], JointKind::freedoms);
    parts
        .iter()
        .enumerate()
        .map(|(index, part)| {
            let group = format!("{}.{}", joint.name, part.suffix());
            let same = parts.iter().filter(|p| *p == part).count();
            let rank = parts[..=index].iter().filter(|p| *p == part).count();
            let own = match (parts.len(), same) {
                (1, _) => joint.name.clone(),
                (_, 1) => group.clone(),
                _ => format!("{group}{rank}"),
            };
            PartName { own, group }
        })
        .collect()
}

fn idle(report: &Report, expected: &[String]) -> Found {
    let Some(branches) = &report.branches else {
        return unless_unassembled(report, Found::Open);
    };
    // Naming the rod is enough; what moves along with it may be named too.
    let named = |most: usize| -> BTreeSet<&str> {
        let idle = branches.iter().flat_map(|branch| &branch.idle);
        idle.flat_map(|idle| idle.links.iter().take(most))
            .map(String::as_str)
            .collect()
    };
    let expected: BTreeSet<&str> = expected.iter().map(String::as_str).collect();
    if named(1) == expected || named(usize::MAX) == expected {
        Found::Agrees
    } else {
        let found: Vec<String> = named(1).into_iter().map(str::to_owned).collect();
        Found::Differs(set_text(&found))
    }
}

fn set_text(names: &[String]) -> String {
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}

/// The distinct numbers in order, as text.
fn set_of_numbers(numbers: impl Iterator<Item = usize>) -> String {
    let distinct: BTreeSet<usize> = numbers.collect();
    let words: Vec<String> = distinct.iter().map(usize::to_string).collect();
    set_text(&words)
}

#[cfg(test)]
#[path = "expectation_tests.rs"]
mod tests;
