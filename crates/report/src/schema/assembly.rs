//! How the loops close.

use serde::{Deserialize, Serialize};

/// How the loops close.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Assembly {
    /// Whether all loops close within [`tolerance`](Self::tolerance); `null` where it was not tried.
    pub closed: Option<bool>,
    /// The largest gap left, as a length: angles count by the length of their loop. Metres.
    pub residual: Option<f64>,
    /// How far the pose had to move from the file's to close; the largest shift of a joint, in metres.
    pub moved: Option<f64>,
    /// What the residual is held against: rounding and the numbers' stated precision, or what was given. Metres.
    pub tolerance: Option<f64>,
    /// Whether [`tolerance`](Self::tolerance) is the one asked for, instead of what the numbers' precision allows.
    #[serde(default)]
    pub tolerance_asked: bool,
    /// The gap of each loop of the file.
    pub gaps: Vec<Gap>,
    /// The most poses that any part was closed from: 1 where the drawn one sufficed; `null` where it was not tried.
    #[serde(default)]
    pub starts: Option<usize>,
    /// Whether the search for other starts ended at its limit on work, before all were tried.
    #[serde(default)]
    pub work_limited: bool,
    /// Joints that the configuration names and that keep its values, in natural order.
    #[serde(default)]
    pub held: Vec<String>,
    /// Joints whose values in the configuration are rounded, and were corrected to close the loops.
    #[serde(default)]
    pub corrected: Vec<String>,
    /// Where every joint with a freedom stands, in natural order of names.
    #[serde(default)]
    pub joints: Vec<JointPlace>,
    /// Joints outside their limits there, farthest first.
    #[serde(default)]
    pub outside_limits: Vec<OutsideLimit>,
    /// Whether it is proven that the loops close at no pose; `false` says nothing. Not of a pose with held joints: what is
    /// [`proof`](Self::proof) then holds as long as they are.
    #[serde(default)]
    pub proven_open: bool,
    /// Why the loops close at no pose, or at none with the held joints as they are, in one clause.
    #[serde(default)]
    pub proof: Option<String>,
    /// Measures of the file whose values alone rule a pose out: see [`misfits`](crate::misfits). Not looked for by [`report`](crate::report()).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub misfits: Vec<Misfit>,
    /// Where the loops do not close with the held joints as they are, but do once these are released: where that takes them.
    #[serde(default)]
    pub released: Option<Vec<JointPlace>>,
    /// A loop with which everything closes once one of its frames is turned over.
    #[serde(default)]
    pub reversal: Option<Reversal>,
    /// Whether dimensions were changed too, to those that rounded numbers mean.
    #[serde(default)]
    pub dimensions_changed: bool,
}

/// A measure whose value in the file rules a pose out, whatever the pose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Misfit {
    /// The property or argument.
    pub measure: String,
    /// Its value in the file (m); `null` of an angle.
    pub value: Option<f64>,
    /// What it has to satisfy with all others as they are, of which the file's value violates all: necessary for a pose.
    pub needs: Vec<String>,
}

/// Where assembly took a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointPlace {
    /// Its name.
    pub name: String,
    /// Its values there (rad, m; the turn of a ball as a rotation vector), as a configuration holds them.
    pub values: Vec<f64>,
    /// Its values as drawn.
    pub drawn: Vec<f64>,
    /// The larger of [`turned`](Self::turned) and [`shifted`](Self::shifted), taken as numbers.
    pub correction: f64,
    /// Largest turn of its variables from the drawn pose (rad).
    pub turned: f64,
    /// Largest translation of its variables from there (m).
    pub shifted: f64,
}

/// A joint outside its limits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutsideLimit {
    /// Its name.
    pub joint: String,
    /// By how much (rad, m); negative below the lower limit.
    pub by: f64,
    /// Whether that is an angle.
    pub angle: bool,
}

/// A frame that is to be turned over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reversal {
    /// The loop.
    #[serde(rename = "loop")]
    pub cycle: String,
    /// The direction about which the frame on its successor's side is to be turned by 180°, in that frame.
    pub about: [f64; 3],
}

/// The gap of one loop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    /// The cycle's name.
    #[serde(rename = "loop")]
    pub cycle: String,
    /// Distance between the joint's two sides as the file draws them, in metres; what the joint allows is taken out.
    pub position: f64,
    /// Angle between them, in radians.
    pub angle: f64,
    /// What is left of the distance after assembly, in metres.
    pub left_position: f64,
    /// What is left of the angle after assembly, in radians.
    pub left_angle: f64,
}
