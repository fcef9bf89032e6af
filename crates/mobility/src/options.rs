//! What is asked of an analysis, and why there may be none.

use super::depth::Depth;
use super::exact::ExactBudget;
use kutzbach_math::matrix::MatrixError;
use thiserror::Error;

/// What to analyse.
#[derive(Clone, Debug, Default)]
pub struct AnalysisOptions {
    /// The configuration to start from; the home pose if `None`.
    pub configuration: Option<String>,
    /// How much work exact algebra may do.
    pub exact: ExactBudget,
    /// How much is to be found out.
    pub depth: Depth,
    /// The gap up to which a loop counts as closed (m; angles count by the length of the loop); what the file's digits say if
    /// `None`. Ranks are then only as certain as such a pose.
    pub closure_tolerance: Option<f64>,
}

/// Why an analysis could not be made. That a mechanism does not assemble or stays undecided is a result, not an error.
#[derive(Clone, Debug, Error)]
pub enum AnalysisError {
    /// The configuration asked for does not exist.
    #[error("there is no configuration named `{name}`; the file has {known}")]
    UnknownConfiguration {
        /// The name asked for.
        name: String,
        /// The names there are, for people.
        known: String,
    },
    /// A distance joint whose two points coincide where its distance is to be read off.
    #[error(
        "joint `{joint}`: its two points coincide at home, and no <distance> is stated; two coinciding points are a `spherical` joint"
    )]
    NoDistance {
        /// The joint's name.
        joint: String,
    },
    /// Numbers out of range.
    #[error("the geometry leaves the range of floating-point numbers: {0}")]
    OutOfRange(#[from] MatrixError),
}
