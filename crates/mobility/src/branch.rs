//! Branches: the components of the configuration space that pass through a pose, and what moves along each.
//!
//! What a joint does, which links are idle and how links move relative to one another is never asked at the pose itself,
//! which may be special, but at generic poses of the branch ([`BranchPose`]).

use super::link_twists::LinkTwists;
use super::roles::JointRole;
use kutzbach_closure::JointState;
use kutzbach_math::group::DisplacementSubgroup;
use std::sync::Arc;

/// A tangent of a branch: one rate per variable of the mechanism, joints by index, the variables of each in their own order, in rad
/// or m per unit. A tangent of one part of a large mechanism is nearly all zeros, which are not stored.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tangent {
    variables: usize,
    entries: Vec<(usize, f64)>,
}

impl Tangent {
    /// The tangent of a mechanism of so many variables with the rates given, each variable at most once.
    #[must_use]
    pub fn new(variables: usize, rates: impl IntoIterator<Item = (usize, f64)>) -> Self {
        let mut entries: Vec<(usize, f64)> =
            rates.into_iter().filter(|(_, rate)| *rate != 0.0).collect();
        entries.sort_by_key(|(variable, _)| *variable);
        Self { variables, entries }
    }

    /// Number of variables of the mechanism.
    #[must_use]
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// The rates that are not zero, by variable.
    #[must_use]
    pub fn entries(&self) -> &[(usize, f64)] {
        &self.entries
    }
}

impl From<Vec<f64>> for Tangent {
    fn from(rates: Vec<f64>) -> Self {
        Self::new(rates.len(), rates.into_iter().enumerate())
    }
}

impl std::ops::Index<usize> for Tangent {
    type Output = f64;

    /// The rate of a variable; zero for one that the tangent does not have.
    fn index(&self, variable: usize) -> &f64 {
        let found = self
            .entries
            .binary_search_by_key(&variable, |entry| entry.0);
        found.map_or(&0.0, |index| &self.entries[index].1)
    }
}

/// A generic pose of a branch.
#[derive(Clone, Debug)]
pub struct BranchPose {
    /// The state of every joint of the mechanism, by joint index.
    pub states: Vec<JointState<f64>>,
    /// A basis of the branch's tangent space. Freedoms of joints in no loop and no coupling may be left out.
    pub tangents: Vec<Tangent>,
}

/// A link that can move while all other links stand still, but for those that stand for no body of their own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IdleLink {
    /// Index of the link; of several that move together, the heaviest, or the first by name.
    pub link: usize,
    /// The others that move with it: parts fixed to it, the other links of a leg between two balls, intermediate links of balls
    /// and universal joints that are written as hinges.
    pub with: Vec<usize>,
    /// Their idle freedoms, those of other entries not counted again.
    pub freedom: usize,
    /// Whether they hang between balls: a rod or a leg that spins about its own line.
    pub rod: bool,
}

/// How a link moves relative to another along a branch. What the margins do not tell is `None`.
#[derive(Clone, Debug, PartialEq)]
pub struct RelativeMotion {
    /// Index of the moving link.
    pub link: usize,
    /// Index of the link it is seen from.
    pub relative_to: usize,
    /// Dimension of the set of its relative displacements.
    pub freedom: Option<usize>,
    /// The displacement subgroup it moves in, where its motion is one: axes in the frame of `relative_to`, at the pose
    /// that the displacements are counted from.
    pub class: Option<DisplacementSubgroup>,
    /// The smallest displacement subgroup that all its displacements lie in, as far as it is known: `class` where there is one.
    pub within: Option<DisplacementSubgroup>,
    /// Whether its motion certainly is no subgroup: its axes or directions move.
    pub axes_move: bool,
    /// The joint of one freedom between the two links, or between what moves with them, whose motion this is.
    pub joint: Option<usize>,
    /// How many of its freedoms turn it, at a generic pose: the rank of its angular velocities.
    pub rotations: Option<usize>,
    /// The others, which move it without turning.
    pub translations: Option<usize>,
    /// Of a motion of one freedom that turns: the least and the greatest pitch of its screws (m/rad) at the poses seen; both zero
    /// where it turns without sliding.
    pub pitches: Option<[f64; 2]>,
    /// Of a motion of several freedoms that translates but for a tilt, less than half a degree while it goes the mechanism's length:
    /// the most it turns at the poses seen (rad/m). The tilt does not count among its rotations.
    pub tilts: Option<f64>,
}

/// One branch through the pose (D8).
#[derive(Clone, Debug)]
pub struct Branch {
    /// `A`, `B`, …, in an order that does not depend on the file's.
    pub name: String,
    /// Its dimension: the finite freedoms along it.
    pub dimension: usize,
    /// Instantaneous freedom at a generic pose of the branch; `None` where the margin does not tell.
    pub instantaneous: Option<usize>,
    /// Dependent equations at a generic pose of the branch.
    pub redundant: Option<i64>,
    /// Ways of leaving the pose along a branch of dimension 1: two, opposite in direction, or the same at a cusp.
    pub half_branches: Option<usize>,
    /// What each joint does along the branch, by joint index.
    pub roles: Vec<JointRole>,
    /// Links that are idle along the branch.
    pub idle: Vec<IdleLink>,
    /// Links that move a thousand times as much as all others in some motion along the branch: nearly idle, but not so.
    pub nearly_idle: Vec<IdleLink>,
    /// How every link moves relative to the ground.
    pub motions: Vec<RelativeMotion>,
    /// Generic poses of the branch: never the pose itself.
    pub poses: Vec<BranchPose>,
    /// How links move at the usable ones of these poses: what the facts above were read off, and others are.
    pub(super) seen: Arc<Vec<LinkTwists>>,
}
