//! `${...}` and `$(...)` in texts.

use super::scope::Table;
use super::syntax::parse;
use super::text::{Joined, Text};
use super::value::{Num, Value};
use super::{Outcome, Place, Run, Sort, Trouble};
use crate::words::quoted;
use std::ops::Range;
use std::path::Path;
use std::rc::Rc;

/// A piece of a text, with its range.
#[derive(Debug, PartialEq, Eq)]
enum Piece {
    /// As it is.
    Text(Range<usize>),
    /// Inside `${...}`.
    Expression(Range<usize>),
    /// Inside `$(...)`.
    Extension(Range<usize>),
}

/// Splits a text. `$${` and `$$(` are the characters without the first `$`.
fn pieces(text: &str) -> Result<Vec<Piece>, (usize, String)> {
    let bytes = text.as_bytes();
    let mut all = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        if bytes[at] != b'$' {
            let end = text[at..].find('$').map_or(bytes.len(), |end| at + end);
            all.push(Piece::Text(at..end));
            at = end;
            continue;
        }
        let dollars = bytes[at..].iter().take_while(|b| **b == b'$').count();
        let opens = bytes.get(at + dollars).copied();
        match (dollars, opens) {
            (2.., Some(b'{' | b'(')) => {
                all.push(Piece::Text(at + 1..at + dollars + 1));
                at += dollars + 1;
            }
            (1, Some(open @ (b'{' | b'('))) => {
                let close = if open == b'{' { '}' } else { ')' };
                let Some(length) = text[at..].find(close) else {
                    let open = char::from(open);
                    return Err((at, format!("`${open}` is not closed; needed `{close}`")));
                };
                let inside = at + 2..at + length;
                all.push(match open {
                    b'{' => Piece::Expression(inside),
                    _ => Piece::Extension(inside),
                });
                at += length + 1;
            }
            _ => {
                all.push(Piece::Text(at..at + dollars));
                at += dollars;
            }
        }
    }
    Ok(all)
}

impl Run<'_> {
    /// The value of a text: that of a single `${...}`, else the text with all of them replaced.
    pub(super) fn substitute(
        &mut self,
        text: &Text,
        place: Place,
        names: &Rc<Table>,
    ) -> Outcome<Value> {
        if !text.as_str().contains('$') {
            return Ok(Value::Text(text.clone()));
        }
        let call = self.call;
        self.deeper(|run| run.substitute_pieces(text, place, names))
            .map_err(|trouble| trouble.at(place, call))
    }

    fn substitute_pieces(
        &mut self,
        text: &Text,
        place: Place,
        names: &Rc<Table>,
    ) -> Outcome<Value> {
        // Where the value is written as it is, a part of it has a place of its own.
        let written_so = place.end - place.start == text.as_str().len();
        let part = |range: &Range<usize>| match written_so {
            true => Place {
                start: place.start + range.start,
                end: place.start + range.end,
                ..place
            },
            false => place,
        };
        let call = self.call;
        let all = pieces(text.as_str())
            .map_err(|(at, message)| Trouble::new(message).at(part(&(at..at + 2)), call))?;
        let single = all.len() == 1;
        self.spend(all.len().saturating_sub(1))?;
        let mut joined = Joined::default();
        for piece in all {
            let value = match piece {
                Piece::Text(range) => {
                    let kept = text.slice(range);
                    if single {
                        return Ok(Value::Text(kept));
                    }
                    joined.push(&kept);
                    continue;
                }
                Piece::Expression(range) => {
                    let here = part(&range);
                    self.expression(&text.slice(range), here, names)
                        .map_err(|trouble| trouble.at(here, call))?
                }
                Piece::Extension(range) => {
                    let here = part(&range);
                    self.extension(&text.slice(range), here, names)
                        .map_err(|trouble| trouble.at(here, call))?
                }
            };
            if single {
                return Ok(value);
            }
            joined.push(&self.paid_text(&value)?);
            if joined.len() > super::arithmetic::LONGEST_TEXT {
                return Err(Trouble::new("the text is too long"));
            }
        }
        Ok(Value::Text(joined.finish()))
    }

    /// The value of what stands between `${` and `}`; `$(arg x)` in it is replaced before it is read.
    fn expression(&mut self, text: &Text, place: Place, names: &Rc<Table>) -> Outcome<Value> {
        let inner = self.substitute(text, place, names)?;
        let inner = self.paid_text(&inner)?;
        let tree = parse(&inner)
            .map_err(|message| Trouble::new(format!("{message} in {}", quoted(inner.as_str()))))?;
        self.spend(inner.as_str().len() / 8)?;
        self.evaluate(&tree, names)
    }

    /// The value of what stands between `$(` and `)`.
    fn extension(&mut self, text: &Text, place: Place, names: &Rc<Table>) -> Outcome<Value> {
        let inner = self.substitute(text, place, names)?;
        let inner = self.paid_text(&inner)?;
        let inner = inner.as_str();
        if let Some(expression) = inner.strip_prefix("eval ") {
            return self.argument_expression(expression);
        }
        let words: Vec<&str> = inner.split(' ').filter(|word| !word.is_empty()).collect();
        let path = |path: &Path| Ok(Value::text(&path.to_string_lossy()));
        match words[..] {
            ["arg", name] => Ok(Value::Text(self.argument(name)?)),
            ["find", package] => Ok(Value::text(&self.package(package)?)),
            ["env", name] => match self.variable(name).and_then(|v| v.into_string().ok()) {
                Some(value) => Ok(Value::text(&value)),
                None => Err(Trouble::new(format!(
                    "the environment variable {} is not set",
                    quoted(name)
                ))),
            },
            ["optenv", name, ref default @ ..] => {
                let value = self.variable(name).and_then(|v| v.into_string().ok());
                let value = value.unwrap_or_else(|| default.join(" "));
                Ok(Value::text(&value))
            }
            ["dirname"] => path(&self.folder()?),
            ["cwd"] => match std::env::current_dir() {
                Ok(folder) => path(&folder),
                Err(error) => Err(Trouble::new(format!("there is no current folder: {error}"))),
            },
            _ => Err(Trouble::new(format!(
                "needed $(arg name), $(find package), $(env NAME), $(optenv NAME default), $(dirname) or $(eval ...), \
                 found {}",
                quoted(&format!("$({inner})"))
            ))),
        }
    }

    /// The value of an argument.
    pub(super) fn argument(&mut self, name: &str) -> Outcome<Text> {
        self.met_names.insert(name.to_owned());
        match self.arguments.get(name) {
            Some(value) => Ok(value.clone()),
            None => Err(
                Trouble::new(format!("the argument {} has no value", quoted(name)))
                    .sort(Sort::Argument),
            ),
        }
    }

    /// `$(eval ...)`: an expression over the arguments, whose value is text.
    fn argument_expression(&mut self, text: &str) -> Outcome<Value> {
        let names = Rc::new(Table::default());
        self.spend(self.arguments.len())?;
        for (name, value) in &self.arguments {
            let value = match value.as_str().to_ascii_lowercase().as_str() {
                "true" => Value::Bool(true),
                "false" => Value::Bool(false),
                _ => Num::read(value).map_or_else(|| Value::Text(value.clone()), Value::Number),
            };
            names.set_value(name, value);
        }
        names.set_value("true", Value::Bool(true));
        names.set_value("false", Value::Bool(false));
        let tree = parse(&text.into())
            .map_err(|message| Trouble::new(format!("{message} in {}", quoted(text))))?;
        self.spend(text.len() / 8)?;
        let value = self.evaluate(&tree, &names)?;
        Ok(Value::Text(self.paid_text(&value)?))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn texts_fall_into_pieces() {
        use Piece::{Expression, Extension, Text};
        assert_eq!(
            pieces("a${b}$(c)$").unwrap(),
            [Text(0..1), Expression(3..4), Extension(7..8), Text(9..10)]
        );
        assert_eq!(pieces("$${x}").unwrap(), [Text(1..3), Text(3..5)]);
        assert_eq!(pieces("$5").unwrap(), [Text(0..1), Text(1..2)]);
        assert_eq!(pieces("x ${a").unwrap_err().0, 2);
    }
}
