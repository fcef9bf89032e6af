//! Finite mobility taken apart, and what inputs do.

use serde::{Deserialize, Serialize};

/// The finite mobility taken apart, on the branches of the largest dimension.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Freedoms {
    /// The others than those below.
    pub useful: usize,
    /// Six for each piece that no joint connects with the ground, such as the base of a robot under a `floating` joint.
    #[serde(default)]
    pub floating: usize,
    /// Idle freedoms (D10).
    pub idle: usize,
    /// Whether all idle freedoms are rods, or legs between two balls, that spin about their own line.
    pub rods: bool,
    /// The ground, where the file holds it by convention only: the root link, and a body with a mass. Six freedoms more if it
    /// floats.
    pub base: Option<String>,
}

/// What the inputs of a mechanism do, along the first branch (D26).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Inputs {
    /// The inputs: joints, or single freedoms such as `slider.trans`.
    pub given: Vec<String>,
    /// Who names them; `null` where nobody does.
    pub source: Option<InputSource>,
    /// How many of them are independent; `null` where a margin does not tell.
    pub independent: Option<usize>,
    /// How many are independent at the pose itself, fewer at a dead centre; `null` where that is not known.
    pub independent_here: Option<usize>,
    /// Those that follow from others before them.
    pub dependent: Vec<DependentInput>,
    /// Freedoms that are left when the inputs are held, idle ones not counted; `null` where a margin does not tell.
    pub left: Option<usize>,
    /// Further inputs that would take them, none of which could be left out.
    pub proposed: Vec<String>,
    /// How many of the independent inputs and those proposed are independent together at the pose itself; `null` where that is
    /// not known.
    #[serde(default)]
    pub together_here: Option<usize>,
    /// Whether nothing is left with these.
    pub complete: bool,
    /// What follows from the inputs, given and proposed, in natural order of names.
    pub followers: Vec<Follower>,
    /// The link that the limbs hang on; `null` where there are no two limbs.
    pub base: Option<String>,
    /// Freedoms between the ground and that link.
    pub trunk: Option<usize>,
    /// The freedoms of each limb.
    pub limbs: Vec<Limb>,
}

/// Who names the inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum InputSource {
    /// The caller.
    Asked,
    /// The file, by the drives of its scene and then by its other motors.
    File,
    /// The file, by its marks of independent coordinates.
    Independent,
}

impl From<kutzbach_motion::InputSource> for InputSource {
    fn from(source: kutzbach_motion::InputSource) -> Self {
        match source {
            kutzbach_motion::InputSource::Asked => Self::Asked,
            kutzbach_motion::InputSource::File => Self::File,
            kutzbach_motion::InputSource::Independent => Self::Independent,
        }
    }
}

/// An input that others determine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DependentInput {
    /// The input.
    pub input: String,
    /// Those it follows from; empty where it cannot move; `null` where a margin does not tell which.
    pub on: Option<Vec<String>>,
}

/// A freedom that follows from inputs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Follower {
    /// The joint, or its single freedom.
    pub joint: String,
    /// The inputs that its rate depends on, empty where it rests; `null` where idle motion moves it too, or a margin does not tell.
    pub of: Option<Vec<String>>,
}

/// What hangs on the base by itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Limb {
    /// The link at its end; that at its start where it branches.
    pub end: String,
    /// Whether it branches, as a torso with two arms does.
    #[serde(default)]
    pub branches: bool,
    /// Its finite freedoms, idle ones included.
    pub freedom: usize,
    /// Its idle freedoms.
    pub idle: usize,
}
