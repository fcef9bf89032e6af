//! The verdict, what it rests on, and the mechanism that rounded numbers mean.

use kutzbach_mobility::{CertificateLevel, MobilityClass, RelationKind, Verdict};
use serde::{Deserialize, Serialize};

/// The verdict on finite mobility.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mobility {
    /// The answer in one word.
    pub verdict: Verdict,
    /// Finite mobility (D4); `null` while not decided.
    pub finite: Option<usize>,
    /// Proven bounds on it; `null` for a side without one.
    pub bounds: [Option<usize>; 2],
    /// Dimension over the complex numbers, where it was found.
    pub complex_dimension: Option<usize>,
    /// Hervé's class (D11).
    pub class: Option<MobilityClass>,
    /// What the answer rests on (D12); `null` while there is none.
    pub certificate: Option<Certificate>,
    /// A mobile mechanism within the stated precision of a rigid file (D13).
    pub nominal: Option<Nominal>,
    /// What the numbers taken literally leave, where the mechanism meant was computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub as_written: Option<AsWritten>,
    /// The reasons, one sentence each, weightiest first.
    pub why: Vec<String>,
}

/// What an answer rests on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Certificate {
    /// How strong it is.
    pub level: CertificateLevel,
    /// What it proves, in one sentence.
    pub text: String,
}

/// A mechanism close to the one in the file that moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nominal {
    /// Its finite mobility.
    pub finite: usize,
    /// How far the file's numbers, taken literally, are from closing along its motion, in metres.
    pub tolerance: f64,
    /// How far its geometry is from the file's (m; angles by the length of the loops); `null` where it was not computed.
    #[serde(default)]
    pub distance: Option<f64>,
    /// The tolerance asked for that stood in for the precision of the digits (m, rad), where these left the mobility open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub known_to: Option<f64>,
    /// Whether it lies within what the file's digits, or [`known_to`](Self::known_to), leave open.
    #[serde(default = "yes")]
    pub within_digits: bool,
    /// Whether it differs by the noise of numbers that a program printed: less than a millionth of the loop's size.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub noise: bool,
    /// The numbers that it has otherwise, those that change most first; empty where it was not computed.
    #[serde(default)]
    pub changes: Vec<Change>,
    /// Relations that the file's numbers nearly satisfy and that it satisfies exactly, by which it was found.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub relations: Vec<Relation>,
}

/// A relation between axes or points of links.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Relation {
    /// What is exact.
    pub kind: RelationKind,
    /// The joints whose axes or points are related: two of one link, or two of each of two links.
    pub joints: Vec<String>,
    /// The angle between them in degrees, where it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub degrees: Option<f64>,
}

/// A number of the file that the mechanism meant has otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// The joint.
    pub joint: String,
    /// Which number: `origin xyz[0]`, `successor rpy[2]`, `axis[1]`, `lead`, `distance`.
    pub number: String,
    /// As written (m, rad).
    pub from: f64,
    /// As meant (m, rad).
    pub to: f64,
}

/// What the file's numbers leave where they are taken literally.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AsWritten {
    /// The verdict.
    pub verdict: Verdict,
    /// Finite mobility; `null` where it is not decided.
    pub finite: Option<usize>,
}

/// What one engine found of one block (D20).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Evidence {
    /// The block, by the name it has in [`Home::blocks`](crate::Home::blocks).
    pub block: String,
    /// The engine.
    pub engine: String,
    /// Where what it found holds: at the pose, in a neighbourhood, at every pose.
    pub scope: String,
    /// Bounds on the finite mobility of the block; `null` where it gives none from above.
    pub bounds: [Option<usize>; 2],
    /// Its figures: margins, orders, radii, seeds.
    pub text: String,
}

fn yes() -> bool {
    true
}
