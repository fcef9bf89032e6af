//! What people call the parts of a mechanism, so that a reason names the part that it is about.
//!
//! The joints of a leg are mostly named after it: what their names have in common, in whole words, is its name. Where they
//! have nothing in common, or two parts the same, the first joint stands for its part, as in the JSON report.

use crate::Part;
use kutzbach_model::graph::ConstraintGraph;
use kutzbach_model::mechanism::Mechanism;
use std::collections::BTreeMap;

/// Parts named one by one in a reason; of more the rest is counted.
const NAMED: usize = 4;

/// A name for every part; no two are equal. Linear in the length of the joints' names.
pub(super) fn part_names(
    mechanism: &Mechanism,
    graph: &ConstraintGraph,
    parts: &[Part],
) -> Vec<String> {
    // Loops are closed under names of their own, and fixed joints name frames.
    let own = |part: &Part| -> Vec<usize> {
        let all = part.joints.iter().copied();
        all.filter(|&joint| {
            let joint = &mechanism.joints()[joint];
            joint.freedom() > 0 && !joint.closes_loop
        })
        .collect()
    };
    let of_joint = |joint: Option<&usize>| joint.map_or("", |&joint| graph.edge_name(joint));
    let firsts: Vec<&str> = parts
        .iter()
        .map(|part| of_joint(own(part).first().or(part.joints.first())))
        .collect();
    let common: Vec<Option<&str>> = parts
        .iter()
        .map(|part| {
            let names: Vec<&str> = own(part)
                .iter()
                .map(|joint| of_joint(Some(joint)))
                .collect();
            common_words(&names)
        })
        .collect();
    let mut uses: BTreeMap<&str, usize> = BTreeMap::new();
    for name in common.iter().flatten() {
        *uses.entry(name).or_default() += 1;
    }
    let joint_names = |name: &str| mechanism.joint_named(name).is_some();
    common
        .iter()
        .zip(firsts)
        .map(|(name, first)| match name {
            Some(name) if uses.get(name) == Some(&1) && !joint_names(name) => (*name).to_owned(),
            _ => first.to_owned(),
        })
        .collect()
}

/// The words that all of several names begin with, or all end with.
fn common_words<'a>(names: &[&'a str]) -> Option<&'a str> {
    let (first, others) = names.split_first().filter(|(_, rest)| !rest.is_empty())?;
    let separates = |c: char| !c.is_alphanumeric();
    // Where all names agree and a word ends; names that are a word of another end one too.
    let agree = |length: usize, begin: bool| {
        others.iter().all(|other| match begin {
            true => {
                other.get(..length) == first.get(..length)
                    && other
                        .get(length..)
                        .is_some_and(|rest| rest.is_empty() || rest.starts_with(separates))
            }
            false => {
                let tail = first.get(first.len() - length..);
                other.len().checked_sub(length).is_some_and(|at| {
                    other.get(at..) == tail
                        && other
                            .get(..at)
                            .is_some_and(|rest| rest.is_empty() || rest.ends_with(separates))
                })
            }
        })
    };
    let beginning = first
        .match_indices(separates)
        .map(|(at, _)| at)
        .filter(|&at| at > 1 && agree(at, true))
        .max()
        .and_then(|at| first.get(..at));
    let ending = || {
        first
            .match_indices(separates)
            .map(|(at, separator)| first.len() - at - separator.len())
            .filter(|&length| length > 1 && agree(length, false))
            .max()
            .and_then(|length| first.get(first.len() - length..))
    };
    beginning.or_else(ending)
}

/// Reasons of parts as sentences about them: equal ones once, with the names of their parts before them. A mechanism of one
/// part needs no names.
#[must_use]
pub fn with_owners<'a>(
    names: &[String],
    reasons: impl IntoIterator<Item = (usize, &'a str)>,
) -> Vec<String> {
    let mut grouped: Vec<(&str, Vec<usize>)> = Vec::new();
    for (part, reason) in reasons {
        match grouped.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, parts)) => parts.push(part),
            None => grouped.push((reason, vec![part])),
        }
    }
    grouped
        .into_iter()
        .map(|(reason, parts)| match names.len() {
            0 | 1 => reason.to_owned(),
            _ => format!("{}: {reason}", owners(names, &parts)),
        })
        .collect()
}

/// `left_leg`, or `4 blocks alike (left_front, …)`.
#[must_use]
pub fn owners(names: &[String], parts: &[usize]) -> String {
    let name = |part: &usize| names.get(*part).map_or("", String::as_str);
    match parts {
        [only] => name(only).to_owned(),
        several => {
            let mut listed: Vec<&str> = several.iter().take(NAMED).map(name).collect();
            if several.len() > NAMED {
                listed.push("…");
            }
            format!("{} blocks alike ({})", several.len(), listed.join(", "))
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::Structure;
    use crate::samples::{CRANK_ROCKER, Written, add_ring, planar};
    use kutzbach_model::mechanism::MechanismBuilder;

    #[test]
    fn words_in_common_are_whole_words() {
        assert_eq!(
            common_words(&["left_hip", "left_knee", "left_ankle"]),
            Some("left")
        );
        assert_eq!(
            common_words(&["front_leg_hip", "front_leg_knee"]),
            Some("front_leg")
        );
        assert_eq!(common_words(&["hip.left", "knee.left"]), Some("left"));
        // `arm` is no word of `armour`.
        assert_eq!(common_words(&["arm_a", "armour_a2"]), None);
        assert_eq!(common_words(&["hinge"]), None);
        assert_eq!(common_words(&["a_b", "a_c"]), None, "one letter is no name");
    }

    #[test]
    fn parts_are_told_apart() {
        let mut builder = MechanismBuilder::new("legs");
        builder.link("ground");
        for leg in ["left", "right"] {
            add_ring(
                &mut builder,
                leg,
                "ground",
                &planar(&CRANK_ROCKER),
                [0.0; 3],
                Written::Exactly,
            );
        }
        let mechanism = builder.build().unwrap();
        let names = Structure::new(&mechanism).part_names;
        assert_eq!(names, ["left", "right"]);
        let reasons = [(0, "it folds"), (1, "it folds")];
        assert_eq!(
            with_owners(&names, reasons),
            ["2 blocks alike (left, right): it folds"]
        );
        assert_eq!(with_owners(&names, [(1, "it folds")]), ["right: it folds"]);
        assert_eq!(with_owners(&names[..1], [(0, "it folds")]), ["it folds"]);
    }
}
