//! Geometry as text: numbers, tokens with their places, and worlds.

mod cursor;
mod number;
mod token;
mod world;

pub use number::Legible;
pub use world::{Reading, read_world};

pub(crate) use cursor::Cursor;
pub(crate) use number::{double_text, read_expression, read_number};
pub(crate) use token::{Kind as TokenKind, Token, tokens};

use std::error::Error;
use std::fmt;
use std::ops::Range;

/// What is wrong with a text, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextError {
    /// What was needed and what was found.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// Bytes of the text that the message is about.
    pub span: Range<usize>,
}

impl TextError {
    /// An error about bytes of a text.
    pub(crate) fn at(source: &str, span: Range<usize>, message: impl Into<String>) -> Self {
        let before = source.get(..span.start).unwrap_or(source);
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let last = before.get(line_start..).unwrap_or_default();
        Self {
            message: message.into(),
            help: None,
            line: before.matches('\n').count() + 1,
            column: last.chars().count() + 1,
            span,
        }
    }

    /// With what mends it.
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Where something else was needed.
    pub(crate) fn needed(
        source: &str,
        span: Range<usize>,
        needed: impl fmt::Display,
        found: impl fmt::Display,
    ) -> Self {
        Self::at(source, span, format!("needed {needed}, found {found}"))
    }
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

impl Error for TextError {}
