//! What is asked of a report, and why there may be none.

use kutzbach_mobility::{AnalysisError, Depth, ExactBudget};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The name of the pose with all joint variables zero.
pub(crate) const HOME: &str = "home";

/// How much a report is to say; what it does not say is not computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ReportDepth {
    /// Counts, closure, and the instantaneous freedom at the pose with its margin.
    Counts,
    /// The finite freedom and how the pose is singular too, and why.
    Verdict,
    /// Branches, motions, joints, advice and ranges too, and stronger certificates by exact algebra.
    #[default]
    Everything,
}

impl From<ReportDepth> for Depth {
    fn from(depth: ReportDepth) -> Self {
        match depth {
            ReportDepth::Counts => Self::Rank,
            ReportDepth::Verdict => Self::Verdict,
            ReportDepth::Everything => Self::Everything,
        }
    }
}

/// What to report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// How much.
    pub depth: ReportDepth,
    /// The configuration to analyse; `None` is the home pose.
    pub configuration: Option<String>,
    /// How much work exact algebra may do for the verdict.
    pub exact: ExactBudget,
    /// Whether to say how long the stages took.
    pub timing: bool,
    /// Whether to tell what every engine found.
    pub evidence: bool,
    /// Pairs of links: how does the first move, seen from the second?
    pub between: Vec<(String, String)>,
    /// The gap up to which a loop counts as closed (m); what the file's digits say if `None`.
    pub closure_tolerance: Option<f64>,
    /// Names of joints, or of single freedoms such as `slider.trans`, that are to count as the inputs; where there are none, those
    /// that the file names.
    pub inputs: Vec<String>,
    /// Whether to follow branches that are curves, for the ranges of their joints.
    pub ranges: bool,
    /// Whether to say what play the joints need, and for what clearance.
    pub play: Option<PlayAsked>,
}

/// What to say of play.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlayAsked {
    /// A clearance that joints have (m), which is compared with what they need.
    pub clearance: Option<f64>,
    /// Distance of the two ends of every bearing (m); the length of the moving loops if `None`.
    pub bearing: Option<f64>,
}

/// Why there is no report.
#[derive(Clone, Debug, Error)]
pub enum ReportError {
    /// The analysis could not be made.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The mechanism has no configuration of that name.
    #[error("there is no configuration `{name}` in `{mechanism}`")]
    UnknownConfiguration {
        /// The name asked for.
        name: String,
        /// The mechanism.
        mechanism: String,
        /// Those it has.
        known: Vec<String>,
    },
    /// The mechanism has no link of that name.
    #[error("there is no link `{name}` in `{mechanism}`")]
    UnknownLink {
        /// The name asked for.
        name: String,
        /// The mechanism.
        mechanism: String,
        /// The name it has that is closest, if one is close.
        nearest: Option<String>,
    },
    /// No freedom of the mechanism has that name.
    #[error("`{name}` cannot be an input of `{mechanism}`: {}", if *.fixed { "the joint has no freedom" } else { "it has no joint of that name" })]
    UnknownInput {
        /// The name asked for.
        name: String,
        /// The mechanism.
        mechanism: String,
        /// Whether a joint without freedom has it.
        fixed: bool,
        /// The name of a joint that is closest, if one is close.
        nearest: Option<String>,
    },
}

impl ReportError {
    /// How to mend it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::Analysis(_) => "see the format's description of this element".to_owned(),
            Self::UnknownConfiguration { known, .. } if known.is_empty() => {
                "the file names none; without `--at` the home pose is analysed".to_owned()
            }
            Self::UnknownConfiguration { known, .. } => {
                format!("it has: home, {}", known.join(", "))
            }
            Self::UnknownLink {
                nearest: Some(nearest),
                ..
            } => format!("did you mean `{nearest}`?"),
            Self::UnknownLink { .. } => "`kutzbach graph FILE` lists all links".to_owned(),
            Self::UnknownInput { fixed: true, .. } => "name a joint that can move".to_owned(),
            Self::UnknownInput {
                nearest: Some(nearest),
                ..
            } => format!("did you mean `{nearest}`?"),
            Self::UnknownInput { .. } => {
                "`kutzbach report FILE --verbose` lists all joints".to_owned()
            }
        }
    }
}
