//! Everything that generic poses of a branch tell, with the work on the poses done once.

use super::branch::{BranchPose, IdleLink, RelativeMotion};
use super::branch_roles::roles_seen;
use super::idle::idle_seen;
use super::link_twists::LinkTwists;
use super::relative_motion::{link_twists, motions_seen_from_ground};
use super::roles::JointRole;
use kutzbach_closure::Geometry;
use kutzbach_closure::Structure;
use kutzbach_model::mechanism::Mechanism;

/// What moves along a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchFacts {
    /// As [`super::branch_roles`] gives them.
    pub roles: Vec<JointRole>,
    /// As [`super::idle_links`] gives them.
    pub idle: Vec<IdleLink>,
    /// Links that move a thousand times as much as all others in some motion: nearly idle.
    pub nearly_idle: Vec<IdleLink>,
    /// As [`super::motions_to_ground`] gives them.
    pub motions: Vec<RelativeMotion>,
}

/// Roles, idle links and motions relative to the ground, from a few generic poses of one branch.
#[must_use]
pub fn branch_facts(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
) -> BranchFacts {
    let seen = link_twists(mechanism, geometry, structure, poses);
    facts_seen(mechanism, geometry, structure, (poses, &seen))
}

pub(super) fn facts_seen(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    (poses, seen): (&[BranchPose], &[LinkTwists]),
) -> BranchFacts {
    let idle = idle_seen(mechanism, geometry, structure, (poses, seen));
    let roles = roles_seen(mechanism, seen);
    BranchFacts {
        motions: motions_seen_from_ground(mechanism, geometry, &roles, seen),
        roles,
        idle: idle.idle,
        nearly_idle: idle.nearly,
    }
}
