//! What can be wrong with a file, and where.

use std::ops::Range;
use thiserror::Error;

/// A file that is not a mechanism: what is wrong, where, and how to mend it.
///
/// Displays as one line, `file:line:column: message`. When a file has several faults, this is the first one in the file
/// and [`others`](Self::others) holds the next ones.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{file}:{line}:{column}: {message}")]
pub struct FormatError {
    /// What was needed and what was found, in one line.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// Bytes of the text that the message is about. For a text that is not UTF-8, bytes of the file.
    pub span: Range<usize>,
    /// The file, as it was named by the caller.
    pub file: String,
    /// Further faults of the same file, in file order, none of which has further ones itself.
    pub others: Box<[FormatError]>,
}

/// A fault by byte range; it becomes a [`FormatError`] when lines and columns are known.
#[derive(Clone, Debug)]
pub(super) struct Fault {
    pub(super) range: Range<usize>,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

impl Fault {
    pub(super) fn new(range: Range<usize>, message: impl Into<String>) -> Self {
        Self {
            range,
            message: message.into(),
            help: None,
        }
    }

    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds the help only where there is one.
    pub(super) fn maybe_help(mut self, help: Option<String>) -> Self {
        self.help = help.or(self.help);
        self
    }
}

pub(super) type Outcome<T> = Result<T, Fault>;

/// At most this many faults of one file are told.
pub(super) const MOST_FAULTS: usize = 20;

/// Turns faults into the error that a caller sees: sorted by position, with lines and columns.
pub(super) fn located(file: &str, text: &str, mut faults: Vec<Fault>) -> FormatError {
    faults.sort_by_key(|fault| fault.range.start);
    faults.truncate(MOST_FAULTS);
    let offsets: Vec<usize> = faults.iter().map(|fault| fault.range.start).collect();
    let places = lines_and_columns(text, &offsets);
    let mut errors = faults
        .into_iter()
        .zip(places)
        .map(|(fault, (line, column))| {
            let start = floor_boundary(text, fault.range.start);
            FormatError {
                message: one_line(&fault.message),
                help: fault.help.map(|help| one_line(&help)),
                line,
                column,
                span: start..floor_boundary(text, fault.range.end.max(start)),
                file: file.to_owned(),
                others: Box::default(),
            }
        });
    let first = errors.next().unwrap_or_else(|| FormatError {
        message: "unknown fault".to_owned(),
        help: None,
        line: 1,
        column: 1,
        span: 0..0,
        file: file.to_owned(),
        others: Box::default(),
    });
    let others = errors.collect();
    FormatError { others, ..first }
}

/// An error about a whole line, counted from 1, of a file that need not be UTF-8. A line beyond the file is its first.
pub(super) fn at_line(
    file: &str,
    bytes: &[u8],
    line: usize,
    message: &str,
    help: Option<String>,
) -> FormatError {
    let is_end = |byte: &u8| *byte == b'\n';
    let mut ends = bytes.iter().enumerate().filter(|(_, byte)| is_end(byte));
    let start = match line.checked_sub(2) {
        None => 0,
        Some(before) => ends.nth(before).map_or(0, |(at, _)| at + 1),
    };
    let rest = bytes.get(start..).unwrap_or_default();
    let length = rest.iter().position(is_end).unwrap_or(rest.len());
    FormatError {
        message: one_line(message),
        help: help.map(|help| one_line(&help)),
        line: line.max(1),
        column: 1,
        span: start..start + length,
        file: file.to_owned(),
        others: Box::default(),
    }
}

/// Line and column (both from 1, columns in characters) of ascending byte offsets, in one walk over the text.
///
/// A byte order mark at the start is not a column. Offsets beyond the text count as its end.
pub(super) fn lines_and_columns(text: &str, ascending: &[usize]) -> Vec<(usize, usize)> {
    let mut places = Vec::with_capacity(ascending.len());
    let (mut line, mut column) = (1, 1);
    let mut at = if text.starts_with('\u{feff}') { 3 } else { 0 };
    for &offset in ascending {
        let offset = floor_boundary(text, offset);
        for byte in text.as_bytes().get(at..offset).unwrap_or_default() {
            match byte {
                b'\n' => (line, column) = (line + 1, 1),
                // Continuation bytes of a character are no columns of their own.
                0x80..=0xbf => {}
                _ => column += 1,
            }
        }
        at = at.max(offset);
        places.push((line, column));
    }
    places
}

/// The largest character boundary at or before an offset.
pub(super) fn floor_boundary(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// Messages quote files; control characters and endless names must not reach a terminal.
fn one_line(message: &str) -> String {
    const LONGEST: usize = 1000;
    let mut line: String = message
        .chars()
        .take(LONGEST)
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    if message.chars().nth(LONGEST).is_some() {
        line.push('…');
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_characters_and_a_byte_order_mark_is_none() {
        let text = "\u{feff}aé\nöx";
        let offsets = [0, 3, 4, 6, 7, 9, 10];
        let expected = [(1, 1), (1, 1), (1, 2), (1, 3), (2, 1), (2, 2), (2, 3)];
        assert_eq!(lines_and_columns(text, &offsets), expected);
        assert_eq!(lines_and_columns(text, &[999]), [(2, 3)]);
    }

    #[test]
    fn faults_are_sorted_and_capped() {
        let faults = (0..50).rev().map(|i| Fault::new(i..i + 1, "x")).collect();
        let error = located("f", &"a".repeat(50), faults);
        assert_eq!((error.line, error.column, error.span), (1, 1, 0..1));
        assert_eq!(error.others.len(), MOST_FAULTS - 1);
        assert_eq!(error.others[18].column, 20);
    }

    #[test]
    fn a_message_is_one_line() {
        let error = located("f", "a", vec![Fault::new(0..1, "a\nb\u{7}c")]);
        assert_eq!(error.to_string(), "f:1:1: a b c");
    }
}
