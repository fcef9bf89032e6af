//! The words of an expression.

use super::text::Text;
use super::value::{Kind, Num};
use kutzbach_math::number::Number;
use std::ops::Range;
use std::rc::Rc;

#[derive(Clone, Debug)]
pub(super) enum Token {
    Number(Num),
    Text(Rc<str>),
    Name(Rc<str>),
    /// An operator, a bracket or a keyword.
    Sign(&'static str),
}

/// Names are looked for more often than they are written.
const LONGEST_NAME: usize = 1000;

const KEYWORDS: [&str; 9] = [
    "and", "or", "not", "in", "is", "if", "else", "for", "lambda",
];

/// Longer ones before those that they begin with.
const SIGNS: [&str; 26] = [
    "**", "//", "==", "!=", "<=", ">=", "+", "-", "*", "/", "%", "<", ">", "(", ")", "[", "]", "{",
    "}", ",", ":", ".", "=", "&", "|", ";",
];

/// Splits an expression; a fault is a message.
pub(super) fn tokens(text: &Text) -> Result<Vec<(Token, usize)>, String> {
    let whole = text.as_str();
    let mut all = Vec::new();
    let mut at = 0;
    while let Some(c) = whole[at..].chars().next() {
        let rest = &whole[at..];
        let start = at;
        if c.is_whitespace() {
            at += c.len_utf8();
            continue;
        }
        let starts_number =
            c.is_ascii_digit() || c == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit());
        let token = if starts_number {
            let end = at + number_length(rest);
            at = end;
            Token::Number(number(text, start..end)?)
        } else if c == '\'' || c == '"' {
            let (value, length) = string(rest)?;
            at += length;
            Token::Text(value.into())
        } else if c.is_alphabetic() || c == '_' {
            let ends = |c: char| !(c.is_alphanumeric() || c == '_');
            let name = &rest[..rest.find(ends).unwrap_or(rest.len())];
            if name.len() > LONGEST_NAME {
                return Err(format!("a name of more than {LONGEST_NAME} bytes"));
            }
            at += name.len();
            match KEYWORDS.iter().find(|keyword| **keyword == name) {
                Some(keyword) => Token::Sign(keyword),
                None => Token::Name(name.into()),
            }
        } else if let Some(sign) = SIGNS.iter().find(|sign| rest.starts_with(**sign)) {
            at += sign.len();
            Token::Sign(sign)
        } else {
            return Err(format!("`{c}` has no meaning in an expression"));
        };
        all.push((token, start));
    }
    Ok(all)
}

/// The base of an integer such as `0x1F`, `0o17`, `0b11`, told by its second character.
pub(super) fn base(literal: &str) -> Option<u32> {
    match literal.as_bytes() {
        [b'0', b'x' | b'X', ..] => Some(16),
        [b'0', b'o' | b'O', ..] => Some(8),
        [b'0', b'b' | b'B', ..] => Some(2),
        _ => None,
    }
}

fn number_length(rest: &str) -> usize {
    if base(rest).is_some() {
        // To the end of the word, so that a digit beyond the base is told, not read as a name.
        let ends = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
        return rest.find(ends).unwrap_or(rest.len());
    }
    let bytes = rest.as_bytes();
    let digits = |from: usize| {
        let more = bytes.get(from..).unwrap_or_default();
        from + more
            .iter()
            .take_while(|b| b.is_ascii_digit() || **b == b'_')
            .count()
    };
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let signed = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let stop = digits(signed);
        if stop > signed {
            end = stop;
        }
    }
    end
}

/// A literal of an expression states no precision; a number that xacro wrote there is the number it was.
fn number(text: &Text, range: Range<usize>) -> Result<Num, String> {
    let written = text.as_str()[range.clone()].replace('_', "");
    let fault = || format!("`{written}` is not a number");
    if let Some(base) = base(&written) {
        let value = i128::from_str_radix(&written[2..], base);
        return value.map(Num::int).map_err(|_| fault());
    }
    let exact = match text.number_at(range) {
        Some(number) => Some(number.clone()),
        None => Number::expression(&written, &mut |_| Ok(None)).ok(),
    };
    let kind = if written.bytes().all(|b| b.is_ascii_digit()) {
        Kind::Int(
            written
                .parse()
                .map_err(|_| "the integer is too large".to_owned())?,
        )
    } else {
        Kind::Float(written.parse().map_err(|_| fault())?)
    };
    Ok(Num { kind, exact })
}

/// A text in quotes and its length with them.
fn string(rest: &str) -> Result<(String, usize), String> {
    let mut chars = rest.char_indices();
    let quote = chars.next().map_or('\'', |(_, c)| c);
    let mut value = String::new();
    while let Some((at, c)) = chars.next() {
        match c {
            c if c == quote => return Ok((value, at + 1)),
            '\\' => match chars.next() {
                Some((_, 'n')) => value.push('\n'),
                Some((_, 't')) => value.push('\t'),
                Some((_, c @ ('\\' | '\'' | '"'))) => value.push(c),
                Some((_, c)) => {
                    value.push('\\');
                    value.push(c);
                }
                None => break,
            },
            c => value.push(c),
        }
    }
    Err(format!("a text is not closed; needed `{quote}`"))
}
