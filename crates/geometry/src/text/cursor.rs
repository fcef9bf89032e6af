//! Tokens one by one.

use super::{TextError, Token, TokenKind};
use std::fmt::Display;
use std::ops::Range;

/// A place among tokens.
#[derive(Clone, Debug)]
pub(crate) struct Cursor<'a> {
    source: &'a str,
    tokens: &'a [Token<'a>],
    at: usize,
    /// Where the text ends that the tokens are of.
    end: usize,
}

impl<'a> Cursor<'a> {
    /// At the first of some tokens of a text.
    pub(crate) fn new(source: &'a str, tokens: &'a [Token<'a>]) -> Self {
        Self {
            source,
            tokens,
            at: 0,
            end: tokens.last().map_or(source.len(), |last| last.span.end),
        }
    }

    /// The next token, which stays.
    pub(crate) fn peek(&self) -> Option<&'a Token<'a>> {
        self.tokens.get(self.at)
    }

    /// The token after the next one.
    pub(crate) fn peek_second(&self) -> Option<&'a Token<'a>> {
        self.tokens.get(self.at + 1)
    }

    /// The next token.
    pub(crate) fn take(&mut self) -> Option<&'a Token<'a>> {
        let token = self.tokens.get(self.at)?;
        self.at += 1;
        Some(token)
    }

    /// Whether nothing is left.
    pub(crate) fn is_done(&self) -> bool {
        self.peek().is_none()
    }

    /// The place of the next token, or the end.
    pub(crate) fn place(&self) -> Range<usize> {
        self.peek().map_or(self.end..self.end, |t| t.span.clone())
    }

    /// Where the last token that was taken ends.
    pub(crate) fn behind(&self) -> usize {
        let last = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        last.map_or(0, |token| token.span.end)
    }

    /// The error that something else was needed next.
    pub(crate) fn needed(&self, needed: impl Display) -> TextError {
        let found = self.peek().map_or("the end".to_owned(), Token::shown);
        TextError::needed(self.source, self.place(), needed, found)
    }

    /// The text that the tokens are of.
    pub(crate) fn source(&self) -> &'a str {
        self.source
    }

    /// Whether the next token is this sign.
    pub(crate) fn is_sign(&self, sign: &str) -> bool {
        self.peek()
            .is_some_and(|t| t.kind == TokenKind::Sign && t.text == sign)
    }

    /// Takes the next token where it is this sign.
    pub(crate) fn take_sign(&mut self, sign: &str) -> bool {
        let is = self.is_sign(sign);
        if is {
            self.at += 1;
        }
        is
    }

    /// Takes a sign that has to be there.
    pub(crate) fn sign(&mut self, sign: &str, needed: &str) -> Result<(), TextError> {
        match self.take_sign(sign) {
            true => Ok(()),
            false => Err(self.needed(needed)),
        }
    }

    /// Takes the next token where it is this word, in capitals or not.
    pub(crate) fn take_word(&mut self, word: &str) -> bool {
        let is = self
            .peek()
            .is_some_and(|t| t.kind == TokenKind::Word && t.text.eq_ignore_ascii_case(word));
        if is {
            self.at += 1;
        }
        is
    }

    /// Takes a word that has to be there.
    pub(crate) fn word(&mut self, needed: &str) -> Result<&'a Token<'a>, TextError> {
        match self.peek() {
            Some(token) if token.kind == TokenKind::Word => {
                self.at += 1;
                Ok(token)
            }
            _ => Err(self.needed(needed)),
        }
    }

    /// Takes ends of lines.
    pub(crate) fn skip_lines(&mut self) {
        while self.peek().is_some_and(|t| t.kind == TokenKind::LineEnd) {
            self.at += 1;
        }
    }
}
