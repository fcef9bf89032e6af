//! What keeps a mechanism from being written as polynomials.

use thiserror::Error;

/// Why there is no polynomial system of a mechanism.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SystemError {
    /// A number that is not algebraic, or not in a form that shows that it is.
    #[error("{entity}, {element}: {number} is {kind}; {advice}")]
    NotAlgebraic {
        /// The joint or link, such as ``joint `crank` ``.
        entity: String,
        /// Which of its numbers, such as `origin of the predecessor`.
        element: String,
        /// The number as written.
        number: String,
        /// What it is instead.
        kind: &'static str,
        /// What to write instead.
        advice: String,
    },
    /// The numbers lie in a field of too high a degree.
    #[error("{entity}, {element}: {number} needs a number field of too high a degree; {advice}")]
    Degree {
        /// The joint or link.
        entity: String,
        /// Which of its numbers.
        element: String,
        /// The number as written.
        number: String,
        /// What to do about it.
        advice: String,
    },
    /// A distance joint whose two points coincide where the distance was to be read off.
    #[error("joint `{joint}`: its two points coincide, so there is no distance to keep")]
    NoDistance {
        /// The joint.
        joint: String,
    },
    /// The distance of a joint is that of the file's pose, which is not known exactly.
    #[error(
        "joint `{joint}`: its distance is that of the drawn pose, which is not algebraic; write `<distance value=...>`"
    )]
    UnknownDistance {
        /// The joint.
        joint: String,
    },
    /// A configuration that the mechanism does not have.
    #[error("there is no configuration `{name}`; {known}")]
    UnknownConfiguration {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A variable that the equations do not have.
    #[error("the equations have no variable `{name}`; they have {known}")]
    UnknownVariable {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// The equations have too many terms to be written down.
    #[error("the equations of {what} have more than {limit} terms")]
    TooLarge {
        /// The cycle or joint.
        what: String,
        /// Number of terms.
        limit: usize,
    },
    /// To write the equations would take too many products of terms.
    #[error("the equations of {what} take more than {limit} products of terms")]
    TooManyProducts {
        /// The cycle or joint.
        what: String,
        /// Number of products.
        limit: u64,
    },
}
