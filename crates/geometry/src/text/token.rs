//! Words, numbers and signs of a text, each with its place.

use super::TextError;
use std::ops::Range;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A word: letters, digits, `_` and `.`, the first a letter or `_`.
    Word,
    /// A free name, with its question mark.
    Free,
    /// A decimal.
    Number,
    /// An expression with `${` and `}` around it.
    Expression,
    /// A sign.
    Sign,
    /// The end of a line.
    LineEnd,
}

/// A piece of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Token<'a> {
    pub(crate) kind: Kind,
    pub(crate) text: &'a str,
    pub(crate) span: Range<usize>,
}

impl Token<'_> {
    /// For messages.
    pub(crate) fn shown(&self) -> String {
        match self.kind {
            Kind::LineEnd => "the end of the line".to_owned(),
            _ => format!("`{}`", self.text),
        }
    }
}

/// Signs of two characters come first, so that they are not read as two.
const SIGNS: [&str; 14] = [
    "!=", "<=", ">=", "(", ")", "[", "]", ",", ";", ":", "=", "<", ">", "/",
];

/// All tokens of a text; what follows a `#` on a line is left out. Ends of lines are tokens.
pub(crate) fn tokens(source: &str) -> Result<Vec<Token<'_>>, TextError> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(rest) = source.get(at..).filter(|rest| !rest.is_empty()) {
        let Some(first) = rest.chars().next() else {
            break;
        };
        if first == '#' {
            at += rest.find('\n').unwrap_or(rest.len());
            continue;
        }
        if first != '\n' && (first.is_whitespace() || first == '\u{feff}') {
            at += first.len_utf8();
            continue;
        }
        let (kind, length) = next(source, at, rest, first)?;
        let text = rest.get(..length).unwrap_or_default();
        found.push(Token {
            kind,
            text,
            span: at..at + length,
        });
        at += length;
    }
    Ok(found)
}

/// The kind and the length in bytes of the token at the beginning of a text that is not blank.
fn next(source: &str, at: usize, rest: &str, first: char) -> Result<(Kind, usize), TextError> {
    let wrong = |length: usize, found: &str| {
        let needed = "a name, a number or a sign of the language";
        TextError::needed(source, at..at + length, needed, found)
    };
    if first == '\n' {
        return Ok((Kind::LineEnd, 1));
    }
    if begins_word(first) {
        return Ok((Kind::Word, word(rest)));
    }
    if let Some(name) = rest.strip_prefix('?') {
        return match name.chars().next().is_some_and(begins_word) {
            true => Ok((Kind::Free, 1 + word(name))),
            false => Err(wrong(1, "a `?` without a name").help("write `?f`")),
        };
    }
    if let Some(inside) = rest.strip_prefix("${") {
        let line = inside.split('\n').next().unwrap_or_default();
        return match line.find('}') {
            Some(end) => Ok((Kind::Expression, 2 + end + 1)),
            None => Err(wrong(2, "`${` without its `}` on the same line")),
        };
    }
    if let Some(length) = number(rest) {
        return Ok((Kind::Number, length));
    }
    match SIGNS.iter().find(|sign| rest.starts_with(**sign)) {
        Some(sign) => Ok((Kind::Sign, sign.len())),
        None => Err(wrong(
            first.len_utf8(),
            &format!("`{}`", first.escape_debug()),
        )),
    }
}

fn begins_word(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

/// The length of the word at the beginning.
fn word(text: &str) -> usize {
    let goes_on = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    text.find(|c: char| !goes_on(c)).unwrap_or(text.len())
}

/// The length of the decimal at the beginning, where there is one.
fn number(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let mut at = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    if !(digit(at) || bytes.get(at) == Some(&b'.') && digit(at + 1)) {
        return None;
    }
    while digit(at) || bytes.get(at) == Some(&b'.') {
        at += 1;
    }
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        let signed = usize::from(matches!(bytes.get(at + 1), Some(b'+' | b'-')));
        if digit(at + 1 + signed) {
            at += 1 + signed;
            while digit(at) {
                at += 1;
            }
        }
    }
    Some(at)
}
