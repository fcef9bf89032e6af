//! Where a mechanism was read, how large it is, and how long its analysis took.

use serde::{Deserialize, Serialize};

/// Where a mechanism was read, and how precisely its geometry is stated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// The file as named by the caller.
    pub file: String,
    /// Its format, such as `urdf`.
    pub format: String,
    /// The most decimals of any literal in the geometry of loops; `null` where there is no literal to round.
    pub digits: Option<i32>,
    /// Whether every number is taken as exact (D13).
    pub exact: bool,
    /// How lengths, angles and directions are written, those that are not exact.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub written: Vec<WrittenKind>,
    /// How well the literals were said to be known (m, rad), where that was said by hand instead of by digits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub precision: Option<f64>,
    /// Literals that were read as the constants they are within their own digits, where there are such.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constants: Option<Constants>,
    /// The literal that makes numbers rounded: the first of those with most decimals; `null` where they are exact by their digits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rounded_by: Option<LiteralAt>,
    /// Literals that were read as 0 because they are what rounding left of one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub residues: Vec<LiteralAt>,
}

/// How the numbers of one kind are written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct WrittenKind {
    /// `lengths`, `angles` or `directions`.
    pub kind: String,
    /// How they were rounded.
    pub style: WrittenStyle,
    /// To so many decimals, of a metre or radian or of the unit of the style, where that is the style.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub decimals: Option<i32>,
    /// To so many significant digits, where that is the style.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub significant: Option<u32>,
}

/// How numbers were rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WrittenStyle {
    /// To a number of decimals.
    Decimals,
    /// To a number of significant digits.
    Significant,
    /// To decimals or significant digits: the numbers do not tell which.
    Either,
    /// All digits of single precision.
    Single,
    /// All digits of doubles.
    Double,
    /// To a number of decimals of a degree, and converted to radians.
    Degrees,
    /// To a number of decimals of an inch, and converted to metres.
    Inches,
}

/// A literal and where it stands.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LiteralAt {
    /// The text in the file.
    pub literal: String,
    /// The joint whose geometry it belongs to, or the link that it places.
    pub owner: String,
}

/// Literals that were read as constants, such as `1.5707963267948966` as π/2.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Constants {
    /// How many.
    pub count: usize,
    /// Each constant once, with the first literal that was read so.
    pub readings: Vec<LiteralReading>,
}

/// A literal and what it was read as.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LiteralReading {
    /// The text in the file.
    pub literal: String,
    /// The constant, such as `π/2`.
    pub read_as: String,
}

/// How large a mechanism is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Size {
    /// Links, the ground included.
    pub links: usize,
    /// Joints, those that close loops included.
    pub joints: usize,
    /// Independent loops: joints − links + connected parts.
    pub loops: usize,
    /// Couplings, `mimic` included.
    pub couplings: usize,
    /// Sum of the joint freedoms.
    pub freedoms: usize,
}

/// What remains of the count when the geometry is arbitrary.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct GenericCount {
    /// Freedoms at random geometry.
    pub mobility: usize,
    /// Dependent equations at random geometry.
    pub redundant: i64,
}

/// How long an analysis took.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// All of it, in milliseconds.
    pub total_ms: f64,
    /// Its stages, in the order they ran.
    pub stages: Vec<Stage>,
}

/// How long one stage took.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stage {
    /// The stage.
    pub name: String,
    /// Milliseconds.
    pub ms: f64,
}
