//! What a file says beside the mechanism itself: the physical effects of a simulation, and what is known of the answer.

use super::model::JointId;
use kutzbach_math::number::Number;

/// A joint that is driven.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// The joint.
    pub joint: JointId,
    /// Wanted rate (rad/s, m/s).
    pub velocity: Number,
    /// Largest torque or force (N m, N); `None` is unlimited.
    pub torque: Option<Number>,
}

/// The physical effects that a simulation of the mechanism calls for.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Scene {
    /// Gravitational acceleration in the world frame, m/s².
    pub gravity: Option<[Number; 3]>,
    /// Contact between collision shapes.
    pub contact: bool,
    /// How fast what touches parts again, as a share of the speed of approach (Newton's coefficient of restitution, from 0 to 1); `None` is
    /// not at all.
    pub restitution: Option<Number>,
    /// Joint limits.
    pub limits: bool,
    /// Dry friction in joints.
    pub friction: bool,
    /// Viscous damping in joints.
    pub damping: bool,
    /// Driven joints.
    pub drives: Vec<Drive>,
}

/// What is known of a mechanism's mobility; every field may be left out.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Expectation {
    /// Finite mobility.
    pub finite: Option<usize>,
    /// Instantaneous freedom at home.
    pub instantaneous: Option<usize>,
    /// Redundant constraints at home.
    pub redundant: Option<i64>,
    /// Kutzbach's count.
    pub kutzbach: Option<i64>,
    /// `regular` or `singular`.
    pub pose: Option<String>,
    /// Kind of singularity.
    pub kind: Option<String>,
    /// Locked joints (`slider`, or `slider.rot` for a part); the single word `all` for all joints.
    pub locked: Option<Vec<String>>,
    /// Links with idle freedoms.
    pub idle: Option<Vec<String>>,
    /// Number of branches through home.
    pub branches: Option<usize>,
    /// Dimensions of the branches, ascending.
    pub branch_dimensions: Option<Vec<usize>>,
}
