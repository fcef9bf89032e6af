//! What can be wrong with a question.

use crate::entity::Kind;
use std::error::Error;
use std::fmt;

/// Why there is no such entity, or no answer.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum GeometryError {
    /// An entity that would not be one.
    Degenerate {
        /// What the entity needs.
        needed: &'static str,
        /// What was given.
        found: &'static str,
    },
    /// A function that has no meaning for such a pair of arguments.
    NoSuchPair {
        /// The function.
        function: &'static str,
        /// What the first argument is.
        first: Kind,
        /// What the second argument is.
        second: Kind,
    },
    /// A measured number that is none, or an uncertainty that is negative.
    NotMeasured {
        /// The number.
        value: f64,
        /// Its uncertainty.
        uncertainty: f64,
    },
    /// A number that cannot be computed: beyond the range of numbers, or left open.
    OutOfRange {
        /// What was needed.
        needed: &'static str,
    },
}

impl fmt::Display for GeometryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Degenerate { needed, found } => write!(f, "needed {needed}, found {found}"),
            Self::NoSuchPair {
                function,
                first,
                second,
            } => write!(
                f,
                "{function} needed two entities that it has a meaning for, found a {first} and a {second}: \
                 the page on geometry lists the pairs"
            ),
            Self::NotMeasured { value, uncertainty } => write!(
                f,
                "needed a finite number with an uncertainty of 0 or more, found {value} with {uncertainty}"
            ),
            Self::OutOfRange { needed } => write!(
                f,
                "needed {needed}, found a number beyond the range of numbers or one that is left open"
            ),
        }
    }
}

impl Error for GeometryError {}
