//! The play that joints need for a motion which the numbers as written bind.

use serde::{Deserialize, Serialize};

/// The play that joints need for a motion: the least deviation, the same for all joints, that closes the loops of the numbers as
/// written along the motion of the mechanism meant. To first order in the misfit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Play {
    /// The branch followed.
    pub branch: String,
    /// How far every joint has to give way at the worst pose (m): its sides shift by `d` and tilt by `θ` with
    /// `√(d² + (arm θ)²)` up to this.
    pub needed: f64,
    /// A proven lower bound of it (m).
    pub at_least: f64,
    /// The length by which tilts count: half the length of a bearing (m).
    pub arm: f64,
    /// The variable that tells poses apart.
    pub variable: String,
    /// Its value at the worst pose (rad, m).
    pub at: f64,
    /// Whether it is an angle.
    pub angle: bool,
    /// Joints that give way there, in the order of the file.
    pub joints: Vec<JointPlay>,
    /// Whether the motion was followed all round, or from end to end.
    pub whole: bool,
    /// Variables that were held, where the branch has several degrees of freedom.
    #[serde(default)]
    pub held: Vec<String>,
    /// Poses left out, at which the equations have another rank.
    pub left_out: usize,
    /// The clearance asked about (m).
    #[serde(default)]
    pub clearance: Option<f64>,
    /// Whether it suffices.
    #[serde(default)]
    pub passes: Option<bool>,
    /// How many times this misalignment it forgives.
    #[serde(default)]
    pub forgiven: Option<f64>,
}

/// How a joint gives way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointPlay {
    /// The joint.
    pub name: String,
    /// Shift of its sides (m).
    pub shift: f64,
    /// Their tilt (rad).
    pub tilt: f64,
}
