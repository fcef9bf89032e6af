//! What can be wrong with a mechanism.

use std::fmt;
use thiserror::Error;

/// The thing that an error is about; a reader of files turns it into a line and a column.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Entity {
    /// The mechanism as a whole.
    Mechanism,
    /// A link by name.
    Link(String),
    /// A joint or loop by name.
    Joint(String),
    /// A coupling by name.
    Coupling(String),
    /// A configuration by name.
    Configuration(String),
    /// The ground element.
    Ground,
    /// The scene.
    Scene,
    /// The expectation.
    Expectation,
}

impl fmt::Display for Entity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mechanism => f.write_str("the mechanism"),
            Self::Link(name) => write!(f, "link `{name}`"),
            Self::Joint(name) => write!(f, "joint `{name}`"),
            Self::Coupling(name) => write!(f, "coupling `{name}`"),
            Self::Configuration(name) => write!(f, "configuration `{name}`"),
            Self::Ground => f.write_str("the ground"),
            Self::Scene => f.write_str("the scene"),
            Self::Expectation => f.write_str("the expectation"),
        }
    }
}

/// A mechanism that cannot be: what it is about, what is wrong, and how to mend it.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{entity}: {problem}")]
pub struct MechanismError {
    /// What the error is about.
    pub entity: Entity,
    /// What was needed and what was found.
    pub problem: String,
    /// How to mend it.
    pub help: Option<String>,
}

impl MechanismError {
    pub(super) fn new(entity: Entity, problem: impl Into<String>) -> Self {
        Self {
            entity,
            problem: problem.into(),
            help: None,
        }
    }

    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}
