//! Numbers in attribute values: `0.5`, `${sqrt(3)/2}`, `$(arg twist)`, and several of them separated by white space.
//!
//! White space inside `${...}` separates nothing. A value that mixes (`-${a}`, `2*${a}` in a property) is read as one
//! expression in which each `${...}` is in parentheses. All rewriting keeps byte positions, so that an error found by the
//! evaluator points at the place in the file.

use super::error::{Fault, Outcome};
use super::words::{did_you_mean, quoted};
use kutzbach_math::number::{Number, Reason};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ops::Range;

/// What a name in an expression stands for.
pub(super) trait Names {
    /// The value of a property; `None` if there is no such property.
    fn property(&mut self, name: &str) -> Result<Option<Number>, Trouble>;

    /// The value of an argument, `$(arg name)`; `None` if there is no such argument.
    fn argument(&mut self, name: &str) -> Result<Option<Number>, Trouble>;

    /// Names to suggest for an unknown one.
    fn suggestions(&self) -> Vec<&str>;
}

/// A fault in a piece of text, or one that the piece ran into by naming something.
#[derive(Clone, Debug)]
pub(super) enum Trouble {
    /// The range counts bytes of the piece.
    Here(Fault),
    /// The range counts bytes of the file.
    Elsewhere(Fault),
}

impl Trouble {
    /// The fault with its range in the file, given the way from ranges in the piece to ranges in the file.
    pub(super) fn placed(self, place: impl FnOnce(Range<usize>) -> Range<usize>) -> Fault {
        match self {
            Self::Here(mut fault) => {
                fault.range = place(fault.range);
                fault
            }
            Self::Elsewhere(fault) => fault,
        }
    }

    /// The trouble seen from a text in which the piece starts at this offset.
    fn moved(self, offset: usize) -> Self {
        match self {
            Self::Here(mut fault) => {
                fault.range = fault.range.start + offset..fault.range.end + offset;
                Self::Here(fault)
            }
            elsewhere => elsewhere,
        }
    }
}

/// The ranges of the numbers in a value: split at white space outside `${...}` and `$(...)`.
pub(super) fn split(value: &str) -> Outcome<Vec<Range<usize>>> {
    let bytes = value.as_bytes();
    let mut ranges = Vec::with_capacity(3);
    let mut start = None;
    let mut at = 0;
    while at < bytes.len() {
        let here = at;
        at = match (bytes[at], bytes.get(at + 1)) {
            (b'$', Some(b'{')) => closing(value, at)?,
            (b'$', Some(b'(')) => match value[at..].find(')') {
                Some(end) => at + end + 1,
                None => return Err(unclosed(at, "$(", ")")),
            },
            _ => at + 1,
        };
        if bytes[here].is_ascii_whitespace() {
            ranges.extend(start.take().map(|start| start..here));
        } else if start.is_none() {
            start = Some(here);
        }
    }
    ranges.extend(start.map(|start| start..bytes.len()));
    Ok(ranges)
}

/// The offset behind the brace that closes the `${` at an offset.
fn closing(value: &str, start: usize) -> Outcome<usize> {
    let mut depth = 0usize;
    for (at, byte) in value.bytes().enumerate().skip(start + 1) {
        match byte {
            b'{' => depth += 1,
            b'}' if depth == 1 => return Ok(at + 1),
            b'}' => depth -= 1,
            _ => {}
        }
    }
    Err(unclosed(start, "${", "}"))
}

fn unclosed(start: usize, open: &str, close: &str) -> Fault {
    Fault::new(
        start..start + 2,
        format!("`{open}` is not closed; needed `{close}`"),
    )
}

/// One number of an attribute: decimals, or an expression marked by `$`.
pub(super) fn number(token: &str, names: &mut dyn Names) -> Result<Number, Trouble> {
    if token.contains('$') {
        return expression(token, names);
    }
    Number::decimal(token).map_err(|error| {
        let help = if token.contains(',') {
            Some("numbers are separated by spaces, and the decimal point is a point".to_owned())
        } else if expression(token, names).is_ok() {
            Some(format!("write ${{{token}}} for an expression"))
        } else {
            None
        };
        let range = word_at(token, error.offset);
        let message = format!("{error} in {}", quoted(token));
        Trouble::Here(
            Fault::new(range, message)
                .maybe_help(error.hint().map(str::to_owned))
                .maybe_help(help),
        )
    })
}

/// The value of a property or argument: a decimal number, or an expression whether marked by `${...}` or not.
pub(super) fn definition(text: &str, names: &mut dyn Names) -> Result<Number, Trouble> {
    let trimmed = text.trim();
    let offset = text.len() - text.trim_start().len();
    if trimmed.is_empty() {
        return Err(Trouble::Here(Fault::new(
            0..text.len(),
            "needed a number or an expression, found nothing",
        )));
    }
    // A plain decimal keeps its stated precision, which an expression does not have.
    if let Ok(number) = Number::decimal(trimmed) {
        return Ok(number);
    }
    expression(trimmed, names).map_err(|trouble| trouble.moved(offset))
}

/// An expression, possibly with `${...}` and `$(arg ...)` inside.
fn expression(text: &str, names: &mut dyn Names) -> Result<Number, Trouble> {
    let inner = text
        .strip_prefix("${")
        .and_then(|rest| rest.strip_suffix('}'))
        .filter(|inner| !inner.contains(['{', '}']));
    if let Some(inner) = inner {
        return evaluate(inner, names).map_err(|trouble| trouble.moved(2));
    }
    evaluate(text, names)
}

fn evaluate(text: &str, names: &mut dyn Names) -> Result<Number, Trouble> {
    let (plain, arguments) = without_marks(text).map_err(Trouble::Here)?;
    let mut met = None;
    let mut unknown: Option<(String, bool)> = None;
    let mut lookup = |name: &str| {
        let argument = undisguised(name).filter(|argument| arguments.contains(argument));
        let found = match argument {
            Some(argument) => names.argument(argument),
            None => names.property(name),
        };
        match found {
            Ok(None) => {
                let name = argument.unwrap_or(name).to_owned();
                unknown = Some((name, argument.is_some()));
                Ok(None)
            }
            Ok(value) => Ok(value),
            Err(trouble) => {
                met = Some(trouble);
                Err(String::new())
            }
        }
    };
    let error = match Number::expression(&plain, &mut lookup) {
        Ok(number) => return Ok(number),
        Err(error) => error,
    };
    let range = word_at(text, error.offset);
    match met {
        // A name that is itself in trouble: told at its definition, or here, where the name stands.
        Some(Trouble::Elsewhere(fault)) => return Err(Trouble::Elsewhere(fault)),
        Some(Trouble::Here(mut fault)) => {
            fault.range = range;
            return Err(Trouble::Here(fault));
        }
        None => {}
    }
    let hint = error.hint().map(str::to_owned);
    let fault = match (&error.reason, unknown) {
        (Reason::UnknownName(_), Some((name, is_argument))) => {
            let what = if is_argument { "argument" } else { "property" };
            let known = names.suggestions();
            let end = text[range.start..].find(')').filter(|_| is_argument);
            let range = range.start..end.map_or(range.end, |end| range.start + end + 1);
            Fault::new(range, format!("there is no {what} named {}", quoted(&name)))
                .maybe_help(hint)
                .maybe_help(did_you_mean(&name, known, ("`", "`")))
        }
        _ => Fault::new(range, error.to_string()).maybe_help(hint),
    };
    Err(Trouble::Here(fault))
}

/// The identifier that stands for `$(arg name)` in an expression: as long as what it replaces. Properties cannot have it,
/// as their names do not start with two underscores.
fn disguised(argument: &str) -> String {
    format!("__arg_{argument}_")
}

/// The argument that an identifier stands for.
fn undisguised(identifier: &str) -> Option<&str> {
    identifier.strip_prefix("__arg_")?.strip_suffix('_')
}

/// The text as a plain expression of the same length, and the arguments that it names: `${...}` becomes ` (...)`.
fn without_marks(text: &str) -> Outcome<(Cow<'_, str>, BTreeSet<&str>)> {
    if !text.contains('$') {
        return Ok((Cow::Borrowed(text), BTreeSet::new()));
    }
    let mut plain = String::with_capacity(text.len());
    let mut arguments = BTreeSet::new();
    let mut depth = 0usize;
    let mut rest = text;
    while let Some(character) = rest.chars().next() {
        let at = text.len() - rest.len();
        let mut taken = character.len_utf8();
        if rest.starts_with("${") {
            plain.push_str(" (");
            depth += 1;
            taken = 2;
        } else if rest.starts_with("$(") {
            let Some(end) = rest.find(')') else {
                return Err(unclosed(at, "$(", ")"));
            };
            let inside = &rest[2..end];
            let name = inside
                .trim_start()
                .strip_prefix("arg")
                .filter(|rest| rest.starts_with(char::is_whitespace))
                .map(str::trim);
            let Some(name) = name.filter(|name| is_identifier(name)) else {
                return Err(Fault::new(
                    at..at + end + 1,
                    format!("needed $(arg name), found {}", quoted(&rest[..=end])),
                )
                .help("other substitutions, such as $(find package), have no numbers to give"));
            };
            taken = end + 1;
            let identifier = disguised(name);
            // `$(arg x)` with anything but white space between is at least as long as its identifier.
            plain.extend(std::iter::repeat_n(
                ' ',
                taken.saturating_sub(identifier.len()),
            ));
            plain.push_str(&identifier);
            arguments.insert(name);
        } else if character == '$' {
            return Err(Fault::new(
                at..at + 1,
                "found `$` that starts neither ${...} nor $(arg ...)",
            ));
        } else if character == '}' && depth > 0 {
            plain.push(')');
            depth -= 1;
        } else {
            plain.push(character);
        }
        rest = &rest[taken..];
    }
    match depth {
        0 => Ok((Cow::Owned(plain), arguments)),
        _ => Err(unclosed(text.rfind("${").unwrap_or(0), "${", "}")),
    }
}

/// Whether a text can name a property or an argument.
pub(super) fn is_identifier(name: &str) -> bool {
    !name.is_empty()
        && !name.starts_with(|c: char| c.is_ascii_digit())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// The range of the word or character at an offset; at the end, of the last character.
fn word_at(text: &str, offset: usize) -> Range<usize> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let start = super::error::floor_boundary(text, offset);
    let rest = &text[start..];
    match rest.chars().next() {
        None => {
            let last = text.chars().next_back().map_or(0, char::len_utf8);
            text.len() - last..text.len()
        }
        Some(first) if is_word(first) => {
            start..start + rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        }
        Some(first) => start..start + first.len_utf8(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    struct Two;

    impl Names for Two {
        fn property(&mut self, name: &str) -> Result<Option<Number>, Trouble> {
            Ok((name == "a").then(|| Number::integer(2)))
        }
        fn argument(&mut self, name: &str) -> Result<Option<Number>, Trouble> {
            Ok((name == "a").then(|| Number::integer(3)))
        }
        fn suggestions(&self) -> Vec<&str> {
            vec!["a", "width"]
        }
    }

    fn here(trouble: Trouble) -> Fault {
        match trouble {
            Trouble::Here(fault) | Trouble::Elsewhere(fault) => fault,
        }
    }

    #[test]
    fn white_space_separates_only_outside_of_expressions() {
        let value = " 1 ${ a + {b} } \n-${c} $(arg d) ";
        let parts: Vec<&str> = split(value)
            .unwrap()
            .into_iter()
            .map(|r| &value[r])
            .collect();
        assert_eq!(parts, ["1", "${ a + {b} }", "-${c}", "$(arg d)"]);
        assert_eq!(split("1 ${2").unwrap_err().range, 2..4);
        assert_eq!(split("1 $(arg 2").unwrap_err().range, 2..4);
        assert!(split(" ").unwrap().is_empty());
    }

    #[test]
    fn expressions_mix_properties_and_arguments_of_one_name() {
        for (text, value) in [
            ("${a}", 2.0),
            ("$(arg a)", 3.0),
            ("-${a}", -2.0),
            ("${a*$(arg  a)}", 6.0),
            ("${1 + ${a}}", 3.0),
        ] {
            assert_eq!(number(text, &mut Two).unwrap().value(), value, "{text}");
        }
        assert_eq!(definition(" 2*${a+1} ", &mut Two).unwrap().value(), 6.0);
    }

    #[test]
    fn errors_point_into_the_expression() {
        let fault = here(number("${1 + widht}", &mut Two).unwrap_err());
        assert_eq!(fault.range, 6..11);
        assert_eq!(fault.help.unwrap(), "did you mean `width`?");
        let fault = here(definition("  1/(a - 2)", &mut Two).unwrap_err());
        assert!(
            fault.range.start >= 3 && fault.range.end <= 11,
            "{:?}",
            fault.range
        );
        assert!(number("$(find x)", &mut Two).is_err());
        assert!(number("$", &mut Two).is_err());
        assert!(number("${1}}", &mut Two).is_err());
        assert!(number("${__arg_a_}", &mut Two).is_err());
    }

    #[test]
    fn a_bare_expression_is_told_how_to_be_one() {
        let fault = here(number("3/5", &mut Two).unwrap_err());
        assert!(fault.help.unwrap().contains("${3/5}"));
        let fault = here(number("1,5", &mut Two).unwrap_err());
        assert!(fault.help.unwrap().contains("spaces"));
    }
}
