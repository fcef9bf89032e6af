//! The mechanism that rounded numbers mean, as data.

use super::vocabulary::{RelationKind, Verdict};
use kutzbach_model::mechanism::Mechanism;

/// A number that the mechanism meant has otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Joint index.
    pub joint: usize,
    /// Place in [`kutzbach_model::mechanism::Joint::numbers`].
    pub place: usize,
    /// The number as written (m, rad).
    pub from: f64,
    /// The number meant.
    pub to: f64,
    /// How far the digits allow it to be (m, rad).
    pub within: f64,
}

/// The mobile mechanism nearest to a file's numbers.
#[derive(Clone, Debug)]
pub struct Meant {
    /// The mechanism, its numbers known to rounding.
    pub mechanism: Mechanism,
    /// What differs, largest in units of its uncertainty first.
    pub changes: Vec<Change>,
}

impl Change {
    /// The change in units of what the digits leave open: up to 1 it lies within them.
    #[must_use]
    pub fn units(&self) -> f64 {
        (self.to - self.from).abs() / self.within
    }
}

/// The numbers taken literally.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AsWritten {
    /// What they leave.
    pub verdict: Verdict,
    /// Freedom, where it is decided.
    pub finite: Option<usize>,
}

/// A relation that rounded numbers nearly satisfy, and that the mechanism meant satisfies exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// What is exact.
    pub kind: RelationKind,
    /// The joints whose axes or points are related: two of one link, or two of each of two.
    pub joints: Vec<usize>,
    /// The angle (rad), where it is one.
    pub angle: Option<f64>,
}
