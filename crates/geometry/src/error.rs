//! What can be wrong with a question.

use crate::entity::Kind;
use std::error::Error;
use std::fmt;

/// A place in a face or in a boundary, counted from 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spot {
    /// The face; none where there is one face only.
    pub face: Option<usize>,
    /// The loop of the face: 0 is the outer one.
    pub ring: Option<usize>,
    /// The corner of the loop, or the edge from it to the next one.
    pub corner: Option<usize>,
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            ("face", self.face),
            ("loop", self.ring),
            ("corner", self.corner),
        ];
        let mut any = false;
        for (name, number) in parts {
            if let Some(number) = number {
                write!(f, "{}{name} {number}", if any { ", " } else { "" })?;
                any = true;
            }
        }
        f.write_str(if any { " (counted from 0)" } else { "the face" })
    }
}

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
    /// A face, a loop or an edge of a boundary that would not be one.
    NoFace {
        /// Where.
        spot: Spot,
        /// What is needed there.
        needed: &'static str,
        /// What was given, and how to mend it.
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

impl GeometryError {
    /// The same of the face with this number.
    pub(crate) fn in_face(self, number: usize) -> Self {
        match self {
            Self::NoFace {
                spot,
                needed,
                found,
            } => Self::NoFace {
                spot: Spot {
                    face: Some(number),
                    ..spot
                },
                needed,
                found,
            },
            other => other,
        }
    }
}

impl fmt::Display for GeometryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Degenerate { needed, found } => write!(f, "needed {needed}, found {found}"),
            Self::NoFace {
                spot,
                needed,
                found,
            } => write!(f, "{spot}: needed {needed}, found {found}"),
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
