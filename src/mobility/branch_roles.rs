//! What every joint does along a branch.
//!
//! A freedom is locked along a branch when no tangent at any generic pose of it moves it. That a joint moves is seen at
//! one pose; that it rests has to be seen at all of them, since at a single pose it may pause.

use super::branch::BranchPose;
use super::link_twists::LinkTwists;
use super::relative_motion::link_twists;
use super::roles::{JointRole, role};
use super::structure::Structure;
use crate::closure::Geometry;
use crate::mechanism::Mechanism;

/// Roles of all joints along a branch, by joint index; the default role where no pose can be used.
///
/// A joint's role stays open (`None`) where a component of the tangents is too large to be called rest and too small to be
/// called motion.
#[must_use]
pub fn branch_roles(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
) -> Vec<JointRole> {
    let seen = link_twists(mechanism, geometry, structure, poses);
    roles_seen(mechanism, &seen)
}

pub(super) fn roles_seen(mechanism: &Mechanism, seen: &[LinkTwists]) -> Vec<JointRole> {
    let joints = mechanism.joints().iter().enumerate();
    joints
        .map(|(index, joint)| {
            if seen.is_empty() {
                return JointRole::default();
            }
            let mut zero = vec![true; joint.freedom()];
            let mut doubtful = vec![true; joint.freedom()];
            for there in seen {
                let tangents = &there.tangents;
                let limits = tangents.limits_of(index);
                for (own, variable) in tangents.variables(index).enumerate() {
                    let moves = limits.moves(tangents.magnitude(variable));
                    zero[own] &= moves == Some(false);
                    doubtful[own] &= moves != Some(true);
                }
            }
            for (doubtful, zero) in doubtful.iter_mut().zip(&zero) {
                *doubtful &= !zero;
            }
            role(joint, &zero, &doubtful)
        })
        .collect()
}
