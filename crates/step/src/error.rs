//! What can be wrong with a STEP file, and where.

use std::error::Error;
use std::fmt;

/// Why a STEP file cannot be read, with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct StepError {
    /// Line of the file, from 1; of the entity's first character where an entity is wrong.
    pub line: usize,
    /// Number of the entity that is wrong or stands there; `None` outside all entities.
    pub entity: Option<u64>,
    /// What is wrong.
    pub problem: Problem,
}

/// What is wrong with a STEP file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// The text does not follow ISO 10303-21.
    Syntax {
        /// What was needed.
        needed: String,
        /// What stands there.
        found: String,
    },
    /// More than can be read.
    TooMuch {
        /// Of what.
        what: &'static str,
        /// The most that is read.
        limit: u64,
    },
    /// Two entities of one number.
    Twice {
        /// Line of the first of them.
        first_line: usize,
    },
    /// A reference to an entity that is not in the file.
    Unresolved {
        /// The number that is referred to.
        to: u64,
    },
    /// A parameter that is not what its entity needs.
    Parameter {
        /// Keyword of the entity.
        keyword: String,
        /// Place of the parameter, from 1.
        position: usize,
        /// What was needed.
        needed: &'static str,
        /// What was found.
        found: String,
    },
    /// An entity of another kind than is needed there.
    Kind {
        /// What was needed.
        needed: &'static str,
        /// The keyword that was found.
        found: String,
    },
    /// Entities that contain themselves.
    Cycle {
        /// Which ones.
        what: &'static str,
    },
    /// What the file says is not what a rigid assembly can have.
    Geometry {
        /// What was needed.
        needed: &'static str,
        /// What was found, and what to do about it.
        found: String,
    },
}

impl StepError {
    /// An error at a line, inside an entity or outside all.
    pub(crate) fn at(line: usize, entity: Option<u64>, problem: Problem) -> Self {
        Self {
            line,
            entity,
            problem,
        }
    }
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}", self.line)?;
        if let Some(entity) = self.entity {
            write!(f, ", #{entity}")?;
        }
        write!(f, ": {}", self.problem)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Syntax { needed, found } => write!(f, "needed {needed}, found {found}"),
            Self::TooMuch { what, limit } => {
                write!(
                    f,
                    "more than {limit} {what}: nothing beyond is read; split the file"
                )
            }
            Self::Twice { first_line } => write!(
                f,
                "this number was given before, on line {first_line}: every entity needs its own"
            ),
            Self::Unresolved { to } => write!(
                f,
                "refers to #{to}, which is not in this file: export the assembly again as one file"
            ),
            Self::Parameter {
                keyword,
                position,
                needed,
                found,
            } => write!(
                f,
                "{keyword} needs {needed} as its parameter {position}, found {found}"
            ),
            Self::Kind { needed, found } => write!(f, "needed {needed}, found {found}"),
            Self::Cycle { what } => write!(f, "{what} that contain themselves"),
            Self::Geometry { needed, found } => write!(f, "needed {needed}, found {found}"),
        }
    }
}

impl Error for StepError {}
