//! Why a verification cannot be made.

use crate::WorldError;
use kutzbach_math::matrix::MatrixError;
use thiserror::Error;

/// What stops a verification. That it does not confirm a prediction is an answer, not an error.
#[derive(Clone, Debug, Error)]
pub enum VerificationError {
    /// A world cannot be made.
    #[error(transparent)]
    World(#[from] WorldError),
    /// Numbers out of range.
    #[error("the geometry leaves the range of floating-point numbers: {0}")]
    OutOfRange(#[from] MatrixError),
    /// There is no branch of that name.
    #[error("there is no branch named `{name}`; there are {known}")]
    UnknownBranch {
        /// The name asked for.
        name: String,
        /// The names there are, for people.
        known: String,
    },
}
