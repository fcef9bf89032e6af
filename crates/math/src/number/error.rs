//! What can be wrong with a number.

use thiserror::Error;

/// A number that cannot be made: where in its text, and why.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{reason}")]
pub struct NumberError {
    /// Byte offset in the text that was read; 0 where there was no text.
    pub offset: usize,
    /// What was needed and what was found.
    pub reason: Reason,
}

/// Why a number cannot be made. Every message names what was needed and what was found.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Reason {
    /// The text is not a number or not an expression.
    #[error("needed {needed}, found {found}")]
    Syntax {
        /// What could have stood here.
        needed: &'static str,
        /// What stands here.
        found: String,
    },
    /// A name that is not defined.
    #[error("needed a defined name, found `{0}`")]
    UnknownName(String),
    /// A name whose definition is itself in error.
    #[error("needed a value for `{name}`: {message}")]
    BadName {
        /// The name.
        name: String,
        /// What the caller's look-up said.
        message: String,
    },
    /// A function that does not exist.
    #[error("needed a function, found `{0}`")]
    UnknownFunction(String),
    /// A function with too few or too many arguments.
    #[error("needed {needed} argument(s) for `{function}`, found {found}")]
    Arguments {
        /// The function.
        function: &'static str,
        /// How many it takes.
        needed: usize,
        /// How many were given.
        found: usize,
    },
    /// An argument outside the domain of a function.
    #[error("{function} needed {needed}, found {found}")]
    Domain {
        /// The function.
        function: &'static str,
        /// Its domain.
        needed: &'static str,
        /// The argument, about.
        found: String,
    },
    /// A function that needs the value of a number that is left [open](super::Number::parameter).
    #[error("{function} needs the value of `{found}`, which is left open")]
    Open {
        /// The function.
        function: &'static str,
        /// The name that is left open.
        found: String,
    },
    /// A division by something that is zero, literally or after simplification.
    #[error("needed a divisor that is not zero, found {0}")]
    DivisionByZero(String),
    /// An exponent that is not a half-integer of moderate size.
    #[error(
        "needed an exponent that is an integer or half an integer, at most 1000 in size, found {0}"
    )]
    Exponent(String),
    /// The number or the expression is too large to work with.
    #[error("needed {needed}, found {found}")]
    TooLarge {
        /// The limit.
        needed: &'static str,
        /// What exceeds it.
        found: String,
    },
}

impl Reason {
    /// The error with this reason at a byte offset.
    #[must_use]
    pub fn at(self, offset: usize) -> NumberError {
        NumberError {
            offset,
            reason: self,
        }
    }
}

impl NumberError {
    /// The same error elsewhere: used where a part of a text was read on its own.
    #[must_use]
    pub fn moved(mut self, offset: usize) -> Self {
        self.offset += offset;
        self
    }

    /// What to do about it, in one sentence, where there is something to say beyond the message.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        match &self.reason {
            Reason::Syntax { found, .. } if found.contains('^') => Some("a power is written `**`"),
            Reason::Syntax { needed, .. } if *needed == super::decimal::NEEDED => {
                Some("digits, a point and a decimal exponent: 12, 0.866, -1.5e-7")
            }
            Reason::Syntax { .. } => None,
            Reason::UnknownName(_) => {
                Some("define it with <xacro:property> or <xacro:arg>; `pi` is always there")
            }
            Reason::BadName { .. } => None,
            Reason::UnknownFunction(_) => {
                Some("there are sqrt, sin, cos, tan, asin, acos, atan, atan2, abs and radians")
            }
            Reason::Arguments { .. } => None,
            Reason::Domain { .. } => Some("check the dimensions this value is computed from"),
            Reason::Open { .. } => {
                Some("leave open what it is computed from, or give the measure a value")
            }
            Reason::DivisionByZero(_) => {
                Some("the divisor may be an expression that simplifies to zero")
            }
            Reason::Exponent(_) => Some("write a square root as sqrt(x) or x**(1/2)"),
            Reason::TooLarge { .. } => Some("split it, or give the value as a decimal"),
        }
    }
}
