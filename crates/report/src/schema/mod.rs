//! The fields of a report. Their names and order are the JSON schema `kutzbach-report-2`: fields may be added, none may
//! change its meaning.
//!
//! Units: metres and radians. Dimensions, ranks and freedoms are plain counts. `null` means "not decided" or "does not
//! apply", as the field says; it never means zero. Every number is finite.
//!
//! What `kutzbach-report-1` had not: `freedoms`, `inputs`, `four_bars`, `change_sets`, `play`,
//! `mobility.as_written`, `mobility.nominal.{distance, within_digits, changes, relations, known_to}`, `joints[].{ranges,
//! redundant_directions, block}`, `motions[].{pitches, tilts, whole_branch, rotations, translations, within, joint}`,
//! `branches[].nearly_idle`, `home.weakest` and `home.blocks[].{label, finite, pose, kind, class}`, `assembly.{tolerance_asked, starts,
//! work_limited, held, corrected, joints, outside_limits, proven_open, proof, released, reversal, dimensions_changed}`. What changed
//! its meaning: `warnings[]` are objects with a kind, a place and a text; `advice[].to` may be `none`, for a joint to remove; `motions[].freedom` may be `null`, and counts the
//! dimension of the set of displacements along the whole branch.

mod assembly;
mod branches;
mod inputs;
mod joints;
mod mobility;
mod play;
mod pose;
mod source;
mod structure;
mod warnings;

pub use assembly::{Assembly, Gap, JointPlace, Misfit, OutsideLimit, Reversal};
pub use branches::{Branch, Idle, Motion};
pub use inputs::{DependentInput, Follower, Freedoms, InputSource, Inputs, Limb};
pub use joints::{Advice, CouplingRow, JointRange, JointRow};
pub use mobility::{AsWritten, Certificate, Change, Evidence, Mobility, Nominal, Relation};
pub use play::{JointPlay, Play};
pub use pose::{Block, Home};
pub use source::{
    Constants, GenericCount, LiteralAt, LiteralReading, Size, Source, Stage, Timing, WrittenKind,
    WrittenStyle,
};
pub use structure::{Cycle, Tree, TreeLink};
pub use warnings::{Warning, WarningKind, WarningPlace};

use super::asked::ReportDepth;
use super::change_sets::ChangeSets;
use kutzbach_mobility::Verdict;
use kutzbach_motion::FourBar;
use serde::{Deserialize, Serialize};

/// The value of [`Report::schema`].
pub const SCHEMA: &str = "kutzbach-report-2";

/// Everything that is known of one mechanism at one pose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Always [`SCHEMA`].
    pub schema: String,
    /// The mechanism's name.
    pub mechanism: String,
    /// Where it was read.
    pub source: Source,
    /// How large it is.
    pub size: Size,
    /// Kutzbach's count 6 (links − 1) − Σ (6 − freedom) − couplings (D2).
    pub kutzbach: i64,
    /// The count at random geometry of the same topology (D16); `null` where it was not made.
    pub generic: Option<GenericCount>,
    /// Whether and how the loops close (D17).
    pub assembly: Assembly,
    /// What holds at the pose.
    pub home: Home,
    /// The verdict.
    pub mobility: Mobility,
    /// Its finite mobility in useful and idle freedoms; `null` while it or its branches are not known.
    #[serde(default)]
    pub freedoms: Option<Freedoms>,
    /// What its inputs do (D26); `null` where nothing moves, or no branch is known.
    #[serde(default)]
    pub inputs: Option<Inputs>,
    /// Branches through the pose (D8): empty for an isolated assembly, `null` while not decided.
    pub branches: Option<Vec<Branch>>,
    /// One row per joint, loops included, in natural order of names.
    pub joints: Vec<JointRow>,
    /// Four-bar linkages on the ground, those within larger mechanisms too.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub four_bars: Vec<FourBar>,
    /// One row per coupling, in natural order of names.
    pub couplings: Vec<CouplingRow>,
    /// The basic cycles of the spanning tree (D14).
    pub cycles: Vec<Cycle>,
    /// The spanning tree the cycles come from (D15); `null` where it was not made.
    pub tree: Option<Tree>,
    /// How links move relative to one another (D19): every link seen from the ground, after the pairs that were asked for.
    pub motions: Vec<Motion>,
    /// Single joints whose relaxation removes redundancy without adding freedom.
    pub advice: Vec<Advice>,
    /// Sets of joints whose relaxation, all at once, leaves no constraint redundant and the finite mobility as it is; `null` where
    /// nothing is redundant or the counts are not decided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change_sets: Option<ChangeSets>,
    /// The play that joints need for the motion to go through with the numbers as written; only where asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub play: Option<Play>,
    /// What a careful reader should know: oddities of the file, short margins.
    pub warnings: Vec<Warning>,
    /// What of the file was not read, because it says nothing about motion.
    pub skipped: Vec<String>,
    /// What every engine found; only where asked for, since its figures differ from machine to machine in their last
    /// digits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<Vec<Evidence>>,
    /// How long the stages took; only where asked for, so that reports can be compared byte by byte.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timing: Option<Timing>,
    /// How much was asked for, where that is less than everything: what lies beyond is `null` or empty because nobody looked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<ReportDepth>,
}

impl Report {
    /// Whether it says what was asked: the mechanism assembles, its mobility is decided, and so is how every link moves.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        let known = |motion: &Motion| motion.freedom.is_some() && motion.rotations.is_some();
        matches!(self.mobility.verdict, Verdict::Mobile | Verdict::Rigid)
            && self.motions.iter().all(known)
    }
}

#[cfg(test)]
mod tests {
    use crate::samples::{mobile, rigid, unassembled, undecided};

    #[test]
    fn decided_is_what_assembles_and_leaves_no_motion_open() {
        assert!(mobile().is_decided() && rigid().is_decided());
        assert!(!unassembled().is_decided() && !undecided().is_decided());
        let mut open = mobile();
        assert!(!open.motions.is_empty());
        open.motions[0].rotations = None;
        assert!(!open.is_decided());
    }
}
