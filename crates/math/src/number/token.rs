//! Tokens of an expression.

use super::decimal;
use super::error::{NumberError, Reason};

/// One word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Token<'a> {
    /// A decimal without sign.
    Decimal(&'a str),
    Name(&'a str),
    Plus,
    Minus,
    Times,
    Divide,
    Power,
    Open,
    Close,
    Comma,
}

impl Token<'_> {
    /// For messages.
    pub(super) fn shown(self) -> String {
        match self {
            Self::Decimal(text) | Self::Name(text) => format!("`{}`", decimal::excerpt(text)),
            Self::Plus => "`+`".to_owned(),
            Self::Minus => "`-`".to_owned(),
            Self::Times => "`*`".to_owned(),
            Self::Divide => "`/`".to_owned(),
            Self::Power => "`**`".to_owned(),
            Self::Open => "`(`".to_owned(),
            Self::Close => "`)`".to_owned(),
            Self::Comma => "`,`".to_owned(),
        }
    }
}

/// Reads words one by one.
pub(super) struct Tokens<'a> {
    text: &'a str,
    offset: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, offset: 0 }
    }

    /// The next word and its byte offset; `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<(usize, Token<'a>)>, NumberError> {
        let bytes = self.text.as_bytes();
        while bytes.get(self.offset).is_some_and(u8::is_ascii_whitespace) {
            self.offset += 1;
        }
        let start = self.offset;
        let Some(&first) = bytes.get(start) else {
            return Ok(None);
        };
        let (token, length) = match first {
            b'+' => (Token::Plus, 1),
            b'-' => (Token::Minus, 1),
            b'*' if bytes.get(start + 1) == Some(&b'*') => (Token::Power, 2),
            b'*' => (Token::Times, 1),
            b'/' => (Token::Divide, 1),
            b'(' => (Token::Open, 1),
            b')' => (Token::Close, 1),
            b',' => (Token::Comma, 1),
            b'0'..=b'9' | b'.' => {
                let length = decimal_length(&bytes[start..]);
                (Token::Decimal(&self.text[start..start + length]), length)
            }
            b'A'..=b'Z' | b'a'..=b'z' | b'_' => {
                let is_part = |b: &&u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.');
                let length = bytes[start..].iter().take_while(is_part).count();
                (Token::Name(&self.text[start..start + length]), length)
            }
            _ => {
                let found = self.text[start..].chars().next().unwrap_or_default();
                return Err(Reason::Syntax {
                    needed: "a number, a name, an operator or a parenthesis",
                    found: format!("`{}`", found.escape_debug()),
                }
                .at(start));
            }
        };
        self.offset += length;
        Ok(Some((start, token)))
    }
}

/// Digits, points and an exponent; whether they make a decimal is decided where it is read.
fn decimal_length(bytes: &[u8]) -> usize {
    let run = |from: usize, is_part: fn(&u8) -> bool| {
        from + bytes[from.min(bytes.len())..]
            .iter()
            .take_while(|b| is_part(b))
            .count()
    };
    let mantissa = run(0, |b| b.is_ascii_digit() || *b == b'.');
    if !matches!(bytes.get(mantissa), Some(b'e' | b'E')) {
        return mantissa;
    }
    let signed = mantissa + 1 + usize::from(matches!(bytes.get(mantissa + 1), Some(b'+' | b'-')));
    let end = run(signed, u8::is_ascii_digit);
    if end > signed { end } else { mantissa }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn words_and_offsets() {
        let mut tokens = Tokens::new(" 2e-3*leg.a **(x_1,.5)");
        let mut found = Vec::new();
        while let Some(token) = tokens.next().unwrap() {
            found.push(token);
        }
        let expected = [
            (1, Token::Decimal("2e-3")),
            (5, Token::Times),
            (6, Token::Name("leg.a")),
            (12, Token::Power),
            (14, Token::Open),
            (15, Token::Name("x_1")),
            (18, Token::Comma),
            (19, Token::Decimal(".5")),
            (21, Token::Close),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn strangers_are_named() {
        let error = Tokens::new("2^3").next().and(Tokens::new("^3").next());
        let error = error.unwrap_err();
        assert!(error.hint().is_some_and(|hint| hint.contains("**")));
        assert!(Tokens::new("é").next().is_err());
    }
}
