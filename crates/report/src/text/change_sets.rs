//! Sets of joints to relax, told once where many say the same: `any one of a1 … a4 → spherical and another → cylindrical`.

use super::words::{counted, mirrored_runs};
use crate::change_sets::{Component, JointReplacement, PartChanges};
use crate::schema::{JointRow, Report};
use std::collections::{BTreeMap, BTreeSet};

/// Joints, or runs of them, that a line names.
const NAMED: usize = 4;

/// Joints of the independent redundant constraints that a first screen names.
const JOINTS: usize = 4;

/// A set as (joint, new kind), sorted.
type Set<'a> = BTreeSet<(&'a str, &'a str)>;

/// (to, from) of each change of a set, sorted.
type Kinds<'a> = Vec<(&'a str, &'a str)>;

/// The lines of one part, the first sets first; each with the number of sets it stands for.
pub(super) fn lines(part: &PartChanges) -> Vec<(String, usize)> {
    // Sets by the kinds that they make, in the order of first mention.
    let mut groups: Vec<(Kinds, Vec<Set>)> = Vec::new();
    for set in &part.sets {
        let kinds = kinds(set);
        let joints: Set = set
            .iter()
            .map(|c| (c.joint.as_str(), c.to.as_str()))
            .collect();
        match groups.iter_mut().find(|(known, _)| *known == kinds) {
            Some((_, sets)) if sets.contains(&joints) => {}
            Some((_, sets)) => sets.push(joints),
            None => groups.push((kinds, vec![joints])),
        }
    }
    let mut told: Vec<(Told, usize)> = Vec::new();
    for (kinds, sets) in &groups {
        let next = Told::of(kinds, sets, part.complete);
        if !told
            .iter_mut()
            .any(|(known, many)| known.takes(&next, many, sets.len()))
        {
            told.push((next, sets.len()));
        }
    }
    told.into_iter()
        .map(|(told, many)| (told.text(), many))
        .collect()
}

/// Sets that make the same kinds of joints.
enum Told<'a> {
    /// Every choice of different joints will do.
    Choice {
        joints: BTreeSet<&'a str>,
        kinds: Vec<&'a str>,
        /// Kinds that the last of them may be instead.
        instead: Vec<&'a str>,
    },
    /// One of them, spelt out.
    Spelt(String),
}

impl<'a> Told<'a> {
    fn of(kinds: &[(&'a str, &str)], sets: &[Set<'a>], complete: bool) -> Self {
        let mut choices: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for (joint, to) in sets.iter().flatten() {
            choices.entry(to).or_default().insert(joint);
        }
        let joints = choices.values().next().cloned().unwrap_or_default();
        let alike = choices.values().all(|others| *others == joints);
        let kinds: Vec<&str> = kinds.iter().map(|(to, _)| *to).collect();
        if complete && sets.len() > 1 && alike && sets.len() == ways(joints.len(), &kinds) {
            return Self::Choice {
                joints,
                kinds,
                instead: Vec::new(),
            };
        }
        let mut text = sets.first().map_or_else(String::new, spelt);
        if sets.len() > 1 {
            let others = counted(sets.len() - 1, "other set");
            text.push_str(&format!(", or {others} of the same kinds"));
        }
        Self::Spelt(text)
    }

    /// Takes in another choice of the same joints that differs in one kind.
    fn takes(&mut self, other: &Self, many: &mut usize, more: usize) -> bool {
        let Self::Choice {
            joints,
            kinds,
            instead,
        } = self
        else {
            return false;
        };
        let Self::Choice {
            joints: others,
            kinds: new,
            ..
        } = other
        else {
            return false;
        };
        if joints != others {
            return false;
        }
        let mut added = new.clone();
        let mut replaced = kinds.clone();
        replaced.retain(|kind| match added.iter().position(|k| k == kind) {
            Some(place) => {
                added.remove(place);
                false
            }
            None => true,
        });
        let ([added], [replaced]) = (added.as_slice(), replaced.as_slice()) else {
            return false;
        };
        // The kind that may be another stands last.
        if let Some(place) = kinds.iter().position(|kind| kind == replaced)
            && (instead.is_empty() || place + 1 == kinds.len())
        {
            let last = kinds.remove(place);
            kinds.push(last);
            instead.push(added);
            *many += more;
            return true;
        }
        false
    }

    fn text(&self) -> String {
        match self {
            Self::Choice {
                joints,
                kinds,
                instead,
            } => {
                let mut text = choice(joints, kinds);
                for kind in instead {
                    text.push_str(&format!(" or {}", kind.replace('_', " ")));
                }
                text
            }
            Self::Spelt(text) => text.clone(),
        }
    }
}

fn kinds(set: &[JointReplacement]) -> Kinds<'_> {
    let mut kinds: Vec<_> = set
        .iter()
        .map(|c| (c.to.as_str(), c.from.as_str()))
        .collect();
    kinds.sort_unstable_by(|a, b| b.cmp(a));
    kinds
}

/// Number of ways to give different joints these kinds, which are sorted.
fn ways(joints: usize, kinds: &[&str]) -> usize {
    if kinds.len() > joints {
        return 0;
    }
    let mut ways = (0..kinds.len()).map(|i| joints - i).product::<usize>();
    let equal = kinds.chunk_by(|a, b| a == b);
    for run in equal {
        ways /= (1..=run.len()).product::<usize>();
    }
    ways
}

/// `any one of a … d → spherical and another → cylindrical`.
fn choice(joints: &BTreeSet<&str>, kinds: &[&str]) -> String {
    let names = mirrored_runs(&sorted(joints.iter().copied()), NAMED);
    let parts = kinds.chunk_by(|a, b| a == b).enumerate().map(|(i, run)| {
        let kind = run[0].replace('_', " ");
        match (i, run.len()) {
            (0, 1) => format!("any one of {names} → {kind}"),
            (0, n) => format!("any {n} of {names} → {kind}"),
            (_, 1) => format!("another → {kind}"),
            (_, n) => format!("{n} others → {kind}"),
        }
    });
    parts.collect::<Vec<_>>().join(" and ")
}

/// `a → spherical, b and c → cylindrical`.
fn spelt(set: &Set) -> String {
    let mut by_kind: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (joint, to) in set {
        by_kind.entry(to).or_default().push(joint);
    }
    let parts = by_kind.iter().rev().map(|(to, joints)| {
        let kind = to.replace('_', " ");
        let joints = sorted(joints.iter().copied());
        format!("{} → {kind}", mirrored_runs(&joints, 2 * NAMED))
    });
    parts.collect::<Vec<_>>().join(" and ")
}

/// Names in natural order.
fn sorted<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.sort_by(|a, b| crate::natural_order(a, b));
    names
}

/// `hinge_1: force along z, moments about x and y`: independent redundant constraints, joints that have the same ones together.
pub(super) fn independent(report: &Report, verbose: bool) -> Option<String> {
    let of = |joint: &JointRow| {
        let own = joint.redundant_directions.iter().filter(|d| d.independent);
        let (mut forces, mut moments) = (Vec::new(), Vec::new());
        for direction in own {
            match direction.component {
                Component::Force => forces.push(named(&direction.direction)),
                Component::Moment => moments.push(named(&direction.direction)),
            }
        }
        forces.sort();
        moments.sort();
        let forces = components("force", "along", &forces);
        let moments = components("moment", "about", &moments);
        let parts: Vec<String> = forces.into_iter().chain(moments).collect();
        (!parts.is_empty()).then(|| (joint.name.clone(), parts.join(", ")))
    };
    let mut groups: Vec<(String, Vec<String>)> = Vec::new();
    for (joint, parts) in report.joints.iter().filter_map(of) {
        match groups.iter_mut().find(|(known, _)| *known == parts) {
            Some((_, joints)) => joints.push(joint),
            None => groups.push((parts, vec![joint])),
        }
    }
    let shown = match verbose || groups.len() <= JOINTS {
        true => groups.len(),
        false => JOINTS - 1,
    };
    let most = if verbose { usize::MAX } else { 2 * NAMED };
    let told = groups[..shown].iter().map(|(parts, joints)| {
        let each = if joints.len() > 1 { " each" } else { "" };
        let names = mirrored_runs(&sorted(joints.iter().map(String::as_str)), most);
        format!("{names}{each}: {parts}")
    });
    let mut text = told.collect::<Vec<_>>().join("; ");
    if shown < groups.len() {
        let more = groups[shown..].iter().map(|(_, joints)| joints.len()).sum();
        text.push_str(&format!("; and at {}", counted(more, "more joint")));
    }
    (!groups.is_empty()).then_some(text)
}

fn components(what: &str, how: &str, directions: &[String]) -> Option<String> {
    match directions {
        [] => None,
        [one] => Some(format!("{what} {how} {one}")),
        [all @ .., last] => Some(format!("{what}s {how} {} and {last}", all.join(", "))),
    }
}

/// The axis of the joint's frame, or the vector.
fn named(direction: &[f64; 3]) -> String {
    let axis = direction.iter().position(|x| x.abs() > 1.0 - 1e-9);
    match axis {
        Some(axis) => ["x", "y", "z"][axis].to_owned(),
        None => {
            let rounded = direction.map(|x| (x * 1e4).round() / 1e4 + 0.0);
            format!("({}, {}, {})", rounded[0], rounded[1], rounded[2])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::change_sets::RedundantDirection;

    fn set(changes: &[(&str, &str)]) -> Vec<JointReplacement> {
        let of = |(joint, to): &(&str, &str)| JointReplacement {
            joint: (*joint).to_owned(),
            from: "revolute".to_owned(),
            to: (*to).to_owned(),
            axis: None,
            axis2: None,
        };
        changes.iter().map(of).collect()
    }

    fn part(sets: Vec<Vec<JointReplacement>>) -> PartChanges {
        PartChanges {
            redundant: 3,
            least: true,
            complete: true,
            sets,
        }
    }

    #[test]
    fn every_choice_of_joints_is_told_in_one_line() {
        let names = ["a1", "a2", "a3"];
        let pairs = names
            .iter()
            .flat_map(|one| names.iter().map(move |other| (one, other)));
        let sets = pairs.filter(|(one, other)| one != other);
        let sets = sets.map(|(one, other)| set(&[(one, "spherical"), (other, "cylindrical")]));
        let told = lines(&part(sets.collect()));
        let text = "any one of a1 … a3 → spherical and another → cylindrical";
        assert_eq!(told, [(text.to_owned(), 6)]);
    }

    #[test]
    fn choices_that_differ_in_one_kind_share_a_line() {
        let mut sets = Vec::new();
        for kind in ["cylindrical", "universal"] {
            for (one, other) in [("a", "b"), ("b", "a")] {
                sets.push(set(&[(one, "spherical"), (other, kind)]));
            }
        }
        let text = "any one of a and b → spherical and another → cylindrical or universal";
        assert_eq!(lines(&part(sets)), [(text.to_owned(), 4)]);
    }

    #[test]
    fn where_not_every_choice_will_do_one_is_spelt_out() {
        let sets = vec![
            set(&[("a", "spherical"), ("b", "spherical"), ("c", "cylindrical")]),
            set(&[("a", "spherical"), ("c", "spherical"), ("d", "cylindrical")]),
        ];
        let told = lines(&part(sets));
        let text = "a and b → spherical and c → cylindrical, or 1 other set of the same kinds";
        assert_eq!(told, [(text.to_owned(), 2)]);
    }

    #[test]
    fn directions_along_axes_of_the_frame_have_their_names() {
        assert_eq!(named(&[0.0, -1.0, 0.0]), "y");
        assert_eq!(named(&[0.6, 0.0, 0.8]), "(0.6, 0, 0.8)");
        let two = ["x".to_owned(), "y".to_owned()];
        assert_eq!(
            components("moment", "about", &two).as_deref(),
            Some("moments about x and y")
        );
    }

    #[test]
    fn joints_with_the_same_redundant_constraints_are_told_together() {
        let mut report = crate::samples::mobile();
        let along = |component, direction| RedundantDirection {
            component,
            direction,
            independent: true,
        };
        let (force, moment) = (Component::Force, Component::Moment);
        let names = ["J10", "J2", "J1", "J3"];
        for (joint, name) in report.joints.iter_mut().zip(names) {
            joint.name = name.to_owned();
            joint.redundant_directions = vec![along(force, [0.0, 0.0, 1.0])];
        }
        report.joints[0].redundant_directions = vec![along(moment, [1.0, 0.0, 0.0])];
        assert_eq!(
            independent(&report, false).as_deref(),
            Some("J10: moment about x; J1 … J3 each: force along z")
        );
    }
}
