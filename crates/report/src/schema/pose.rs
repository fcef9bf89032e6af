//! What holds at the pose that was analysed.

use kutzbach_mobility::{MobilityClass, PoseKind, SingularKind};
use serde::{Deserialize, Serialize};

/// What holds at the pose that was analysed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Home {
    /// Name of the configuration, `home` for all joint variables zero.
    pub configuration: String,
    /// Regular or singular (D6); `null` while not decided.
    pub pose: Option<PoseKind>,
    /// The kind of singularity (D7); `null` at regular poses and while not decided.
    pub kind: Option<SingularKind>,
    /// Instantaneous freedom (D3); `null` where the margin did not suffice or the mechanism does not assemble.
    pub instantaneous: Option<usize>,
    /// Smallest and largest instantaneous freedom that the margins leave possible.
    pub candidates: [usize; 2],
    /// The instantaneous freedom of the numbers taken literally, where it differs from that within stated precision.
    pub as_written: Option<usize>,
    /// Dependent constraint equations (D5): instantaneous − Kutzbach.
    pub redundant: Option<i64>,
    /// Rank of the constraint equations.
    pub rank: Option<usize>,
    /// Constraint equations: six per independent loop, one per coupling.
    pub equations: usize,
    /// Joint variables, and six more for each part that no joint connects with the ground.
    pub unknowns: usize,
    /// Smallest singular value kept over largest one dropped; `null` where none was dropped or dropped ones are zero.
    pub gap: Option<f64>,
    /// Smallest singular value kept, relative to the largest.
    pub kept: Option<f64>,
    /// Largest singular value dropped, relative to the largest.
    pub dropped: Option<f64>,
    /// The relative size below which a singular value counts as zero.
    pub tolerance: Option<f64>,
    /// How precisely the entries of the equations are known, relative to the largest.
    pub accuracy: Option<f64>,
    /// How the rank was found, in a few words; empty where it was not.
    pub method: String,
    /// Bits of the arithmetic that decided; 53 is double precision.
    pub bits: Option<u32>,
    /// The biconnected blocks, each with its own rank.
    pub blocks: Vec<Block>,
    /// The block whose rank has the least margin, by its label: `kept`, `dropped`, `gap`, `tolerance` and `accuracy` are
    /// its; `null` where there is but one block.
    #[serde(default)]
    pub weakest: Option<String>,
    /// A sentence on the margin, where it matters.
    pub note: Option<String>,
}

/// One biconnected block of the constraint graph: what can be analysed apart.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Block {
    /// A name made of one of its joints.
    pub name: String,
    /// What reasons call it: the words that the names of its joints have in common, or else `name`.
    #[serde(default)]
    pub label: String,
    /// Number of joints.
    pub joints: usize,
    /// Number of joint variables.
    pub unknowns: usize,
    /// Rank of the block's equations; `null` where undecided.
    pub rank: Option<usize>,
    /// Its share of the instantaneous freedom; `null` where undecided.
    pub instantaneous: Option<usize>,
    /// Its share of the finite freedom; `null` where undecided.
    #[serde(default)]
    pub finite: Option<usize>,
    /// Whether the pose is regular or singular for it; `null` while not decided.
    #[serde(default)]
    pub pose: Option<PoseKind>,
    /// In which way singular.
    #[serde(default)]
    pub kind: Option<SingularKind>,
    /// Hervé's class of its motion, where it moves.
    #[serde(default)]
    pub class: Option<MobilityClass>,
}
