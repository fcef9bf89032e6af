//! Tokens of ISO 10303-21, as places in the text: no token owns a string.

use crate::error::{Problem, StepError};

/// A piece of the text, by the offsets of its first byte and of the byte behind its last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    /// Offset of the first byte.
    pub start: u32,
    /// Offset of the byte behind the last.
    pub end: u32,
}

impl Span {
    /// The bytes of this piece of `text`; empty where the span is not of this text.
    pub fn of(self, text: &[u8]) -> &[u8] {
        text.get(self.start as usize..self.end as usize)
            .unwrap_or_default()
    }
}

/// One token.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token {
    /// A keyword, as `PRODUCT`, `!USER_DEFINED` or `ISO-10303-21`.
    Keyword(Span),
    /// An integer or a real number.
    Number(f64),
    /// A reference or a number of an entity, as `#12`.
    Reference(u64),
    /// What stands between the quotes of a string, escapes and all.
    Text(Span),
    /// What stands between the dots of an enumeration.
    Enumeration(Span),
    /// What stands between the double quotes of a binary value.
    Binary(Span),
    /// `(`
    Open,
    /// `)`
    Close,
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// `=`
    Equals,
    /// `$`, a value that is not given.
    Dollar,
    /// `*`, a value that follows from others.
    Star,
    /// The end of the text.
    End,
}

/// Cuts a text into tokens, one at a time.
pub(super) struct Lexer<'t> {
    text: &'t [u8],
    at: usize,
    line: usize,
}

impl<'t> Lexer<'t> {
    /// A lexer at the beginning of a text. Offsets have to fit in 32 bits: the caller sees to it.
    pub fn new(text: &'t [u8]) -> Self {
        Self {
            text,
            at: 0,
            line: 1,
        }
    }

    /// The line that is read, from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn advance(&mut self) {
        if self.peek() == Some(b'\n') {
            self.line += 1;
        }
        self.at += 1;
    }

    fn span_from(&self, start: usize) -> Span {
        Span {
            start: start as u32,
            end: self.at as u32,
        }
    }

    fn syntax(line: usize, needed: &str, found: &str) -> StepError {
        StepError::at(
            line,
            None,
            Problem::Syntax {
                needed: needed.to_owned(),
                found: found.to_owned(),
            },
        )
    }

    /// Goes past blanks, comments and the print controls `\N\` and `\F\`.
    fn skip_blanks(&mut self) -> Result<(), StepError> {
        while let Some(byte) = self.peek() {
            match byte {
                b' ' | b'\t' | b'\r' | b'\n' | 0x0b | 0x0c => self.advance(),
                b'\\'
                    if matches!(
                        self.text.get(self.at..self.at + 3),
                        Some(b"\\N\\" | b"\\F\\")
                    ) =>
                {
                    self.at += 3;
                }
                b'/' if self.text.get(self.at + 1) == Some(&b'*') => self.skip_comment()?,
                // A byte order mark says nothing about the file.
                0xef if self.at == 0 && self.text.starts_with(b"\xef\xbb\xbf") => self.at += 3,
                _ => break,
            }
        }
        Ok(())
    }

    fn skip_comment(&mut self) -> Result<(), StepError> {
        let line = self.line;
        self.at += 2;
        loop {
            match self.peek() {
                None => {
                    return Err(Self::syntax(
                        line,
                        "`*/` at the end of the comment that begins here",
                        "the end of the file",
                    ));
                }
                Some(b'*') if self.text.get(self.at + 1) == Some(&b'/') => {
                    self.at += 2;
                    return Ok(());
                }
                Some(_) => self.advance(),
            }
        }
    }

    /// Goes to the next `ENDSEC`, whatever stands before it: the way past sections that hold no entities.
    pub fn skip_section(&mut self) {
        while self.at < self.text.len() && !self.text[self.at..].starts_with(b"ENDSEC") {
            self.advance();
        }
    }

    /// The next token; [`Token::End`] at the end of the text, however often it is asked.
    ///
    /// # Errors
    /// A string or comment that does not end, a number that is none, a character that begins nothing.
    pub fn token(&mut self) -> Result<Token, StepError> {
        self.skip_blanks()?;
        let Some(byte) = self.peek() else {
            return Ok(Token::End);
        };
        let single = match byte {
            b'(' => Token::Open,
            b')' => Token::Close,
            b',' => Token::Comma,
            b';' => Token::Semicolon,
            b'=' => Token::Equals,
            b'$' => Token::Dollar,
            b'*' => Token::Star,
            b'\'' => return self.string(),
            b'"' => return self.binary(),
            b'#' => return self.reference(),
            b'.' if !self.followed_by_digit() => return self.enumeration(),
            b'+' | b'-' | b'.' | b'0'..=b'9' => return self.number(),
            b'A'..=b'Z' | b'a'..=b'z' | b'_' | b'!' => return Ok(self.keyword()),
            _ => {
                let found = if byte.is_ascii_graphic() {
                    format!("`{}`", char::from(byte))
                } else {
                    format!("the byte {byte:#04x}")
                };
                return Err(Self::syntax(self.line, "a value or a keyword", &found));
            }
        };
        self.at += 1;
        Ok(single)
    }

    fn followed_by_digit(&self) -> bool {
        self.text.get(self.at + 1).is_some_and(u8::is_ascii_digit)
    }

    fn take_while(&mut self, belongs: impl Fn(u8) -> bool) {
        while self.peek().is_some_and(&belongs) {
            self.at += 1;
        }
    }

    fn keyword(&mut self) -> Token {
        let start = self.at;
        self.at += 1;
        // The hyphen is for `ISO-10303-21` and `END-ISO-10303-21`.
        self.take_while(|byte| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-');
        Token::Keyword(self.span_from(start))
    }

    fn number(&mut self) -> Result<Token, StepError> {
        let start = self.at;
        self.at += 1;
        self.take_while(|byte| {
            byte.is_ascii_digit() || matches!(byte, b'.' | b'E' | b'e' | b'+' | b'-')
        });
        let written = self.text.get(start..self.at).unwrap_or_default();
        let written = String::from_utf8_lossy(written);
        match written.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(Token::Number(value)),
            _ => Err(Self::syntax(
                self.line,
                "a finite number",
                &format!("`{}`", shortened(&written)),
            )),
        }
    }

    fn reference(&mut self) -> Result<Token, StepError> {
        self.at += 1;
        let start = self.at;
        self.take_while(|byte| byte.is_ascii_digit());
        let digits = self.text.get(start..self.at).unwrap_or_default();
        let number = std::str::from_utf8(digits)
            .ok()
            .and_then(|d| d.parse().ok());
        number.map(Token::Reference).ok_or_else(|| {
            let found = format!("`#{}`", shortened(&String::from_utf8_lossy(digits)));
            Self::syntax(self.line, "the number of an entity behind `#`", &found)
        })
    }

    fn enumeration(&mut self) -> Result<Token, StepError> {
        self.at += 1;
        let start = self.at;
        self.take_while(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        let token = Token::Enumeration(self.span_from(start));
        if self.peek() == Some(b'.') {
            self.at += 1;
            return Ok(token);
        }
        Err(Self::syntax(
            self.line,
            "`.` at the end of an enumeration",
            "something else",
        ))
    }

    fn binary(&mut self) -> Result<Token, StepError> {
        self.at += 1;
        let start = self.at;
        self.take_while(|byte| byte.is_ascii_hexdigit());
        let token = Token::Binary(self.span_from(start));
        if self.peek() == Some(b'"') {
            self.at += 1;
            return Ok(token);
        }
        Err(Self::syntax(
            self.line,
            "`\"` at the end of a binary value",
            "something else",
        ))
    }

    fn string(&mut self) -> Result<Token, StepError> {
        let line = self.line;
        self.at += 1;
        let start = self.at;
        loop {
            match self.peek() {
                None => {
                    return Err(Self::syntax(
                        line,
                        "`'` at the end of the string that begins here",
                        "the end of the file",
                    ));
                }
                Some(b'\'') if self.text.get(self.at + 1) == Some(&b'\'') => self.at += 2,
                Some(b'\'') => {
                    let token = Token::Text(self.span_from(start));
                    self.at += 1;
                    return Ok(token);
                }
                Some(_) => self.advance(),
            }
        }
    }
}

/// The beginning of something that may be long.
pub(super) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let mut short: String = text.chars().take(LONGEST).collect();
    short.push('…');
    short
}
