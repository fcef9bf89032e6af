//! Links that the equations hold together.
//!
//! A joint all of whose variables have finitely many values keeps its two links where they are relative to one another:
//! they cannot change between the values without the joint being taken apart. Which value it is may differ from one
//! assembly mode to the next; that the links are one body does not.

use super::fixed::FixedVariable;
use crate::{Meaning, PolynomialSystem};
use kutzbach_model::mechanism::{JointId, JointKind, LinkId, Mechanism};

/// Joints among some that have variables, all of them fixed.
pub(super) fn rigid_joints(
    system: &PolynomialSystem,
    fixed: &[FixedVariable],
    joints: impl Iterator<Item = JointId>,
) -> Vec<JointId> {
    let is_fixed = |v: &usize| fixed.iter().any(|f| f.variable == *v);
    joints
        .filter(|joint| {
            let variables = &system.joint_variables[joint.0];
            !variables.is_empty() && variables.iter().all(is_fixed)
        })
        .collect()
}

/// The links that some joints hold together.
pub(super) fn clusters(mechanism: &Mechanism, joints: &[JointId]) -> Vec<Vec<LinkId>> {
    let ends = joints.iter().map(|&joint| {
        let joint = mechanism.joint(joint);
        vec![joint.predecessor.link, joint.successor.link]
    });
    joined(ends.collect())
}

/// The links that are one body in the whole mechanism: held together by joints that the whole fixes, by those that some
/// cycle fixes, by a pose relative to the ground that is fixed; joints without freedom join what touches them. At least
/// one joint that could move by itself takes part in each.
pub(super) fn mechanism_clusters(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    fixed: &[FixedVariable],
    of_cycles: impl Iterator<Item = Vec<LinkId>>,
) -> Vec<Vec<LinkId>> {
    let joints = (0..system.joint_variables.len()).map(JointId);
    let mut held = clusters(mechanism, &rigid_joints(system, fixed, joints));
    held.extend(of_cycles);
    held.extend(fixed_bodies(mechanism, system, fixed).map(|link| vec![mechanism.ground(), link]));
    let welds: Vec<JointId> = (0..mechanism.joints().len())
        .map(JointId)
        .filter(|joint| mechanism.joint(*joint).kind == JointKind::Fixed)
        .collect();
    let welded = clusters(mechanism, &welds);
    joined(held.into_iter().chain(welded.iter().cloned()).collect())
        .into_iter()
        .filter(|cluster| !welded.contains(cluster))
        .collect()
}

/// Links all twelve entries of whose pose relative to the ground are fixed (positional form).
fn fixed_bodies<'a>(
    mechanism: &'a Mechanism,
    system: &'a PolynomialSystem,
    fixed: &'a [FixedVariable],
) -> impl Iterator<Item = LinkId> + 'a {
    let of = |variable: usize| match system.variables[variable].meaning {
        Meaning::BodyRotation { link, .. } | Meaning::BodyTranslation { link, .. } => Some(link),
        _ => None,
    };
    (0..mechanism.links().len())
        .map(LinkId)
        .filter(move |link| {
            let entries = fixed.iter().filter(|f| of(f.variable) == Some(*link));
            entries.count() == 12
        })
}

/// Groups of links with those that share a link made one, in ascending order.
pub(super) fn joined(groups: Vec<Vec<LinkId>>) -> Vec<Vec<LinkId>> {
    let mut result: Vec<Vec<LinkId>> = Vec::new();
    for group in groups {
        let (mut together, rest): (Vec<_>, Vec<_>) = result
            .into_iter()
            .partition(|known| group.iter().any(|link| known.contains(link)));
        together.push(group);
        let mut links = together.concat();
        links.sort_unstable();
        links.dedup();
        result = rest;
        result.push(links);
    }
    result.sort();
    result
}
