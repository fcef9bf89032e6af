//! What an expression can stand for: the values of Python that xacro files use.

use super::element::Element;
use super::keyed::Keyed;
use super::python_text::{float_text, quoted_text};
use super::scope::Table;
use super::text::{Joined, Text};
use super::{Outcome, Trouble};
use crate::words::quoted;
use kutzbach_math::number::Number;
use std::rc::Rc;

/// A value. Lists and dictionaries are shared and never change.
#[derive(Clone)]
pub(super) enum Value {
    None,
    Bool(bool),
    Number(Num),
    Text(Text),
    List(Rc<[Value]>),
    Tuple(Rc<[Value]>),
    /// Items that differ, in the order in which they were given: Python promises none.
    Set(Rc<Keyed<Value>>),
    /// Keys in the order in which they were given.
    Dict(Rc<Keyed<(Value, Value)>>),
    /// A function by its name.
    Function(&'static str),
    /// `math`, `python` or `xacro`.
    Module(&'static str),
    /// The names of `<xacro:include ns="..."/>`.
    Namespace(Rc<Table>),
    /// What `<xacro:insert_block/>` inserts.
    Block(Rc<Element>),
    /// What `<xacro:name/>` calls.
    Macro(Rc<super::macros::Macro>),
}

/// A number as Python calculates it, and exactly.
#[derive(Clone, Debug)]
pub(super) struct Num {
    pub(super) kind: Kind,
    /// The exact value; none where it is not known, such as that of a remainder or a hyperbolic sine.
    pub(super) exact: Option<Number>,
}

/// Whether Python has it as an integer or as a double: that decides how it is printed.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    Int(i128),
    Float(f64),
}

impl Num {
    pub(super) fn int(value: i128) -> Self {
        Self {
            kind: Kind::Int(value),
            exact: i64::try_from(value).ok().map(Number::integer),
        }
    }

    pub(super) fn float(value: f64) -> Self {
        Self {
            kind: Kind::Float(value),
            exact: None,
        }
    }

    pub(super) fn double(&self) -> f64 {
        match self.kind {
            Kind::Int(value) => value as f64,
            Kind::Float(value) => value,
        }
    }

    pub(super) fn is_int(&self) -> bool {
        matches!(self.kind, Kind::Int(_))
    }

    pub(super) fn text(&self) -> Text {
        let written = match self.kind {
            Kind::Int(value) => value.to_string(),
            Kind::Float(value) => float_text(value),
        };
        Text::of_number(&written, self.exact.as_ref())
    }

    /// The number that Python's `int` or `float` reads from a text.
    pub(super) fn read(text: &Text) -> Option<Self> {
        Self::read_int(text).or_else(|| Self::read_float(text))
    }

    pub(super) fn read_int(text: &Text) -> Option<Self> {
        let (trimmed, exact) = exactly(text);
        let digits = trimmed.strip_prefix(['+', '-']).unwrap_or(trimmed);
        if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let value = trimmed.parse().ok()?;
        Some(Self {
            kind: Kind::Int(value),
            exact,
        })
    }

    pub(super) fn read_float(text: &Text) -> Option<Self> {
        let (trimmed, exact) = exactly(text);
        Some(Self {
            kind: Kind::Float(trimmed.parse().ok()?),
            exact,
        })
    }
}

/// A text without white space around it and the exact number that it stands for.
fn exactly(text: &Text) -> (&str, Option<Number>) {
    let whole = text.as_str();
    let trimmed = whole.trim();
    let start = whole.len() - whole.trim_start().len();
    let exact = match text.number_at(start..start + trimmed.len()) {
        Some(number) => Some(number.clone()),
        None => Number::decimal(trimmed).ok(),
    };
    (trimmed, exact)
}

impl Value {
    pub(super) fn text(text: &str) -> Self {
        Self::Text(text.into())
    }

    pub(super) fn int(value: usize) -> Self {
        Self::Number(Num::int(value as i128))
    }

    /// A value that is written in a file: text in single quotes, a number, a truth value, or else text.
    ///
    /// Digits joined by underscores are text, as xacro wants it.
    pub(super) fn literal(text: &Text) -> Self {
        let written = text.as_str();
        if written.len() >= 2 && written.starts_with('\'') && written.ends_with('\'') {
            return Self::Text(text.slice(1..written.len() - 1));
        }
        if written.contains('_') {
            return Self::Text(text.clone());
        }
        match written {
            "true" | "True" => Self::Bool(true),
            "false" | "False" => Self::Bool(false),
            _ => match Num::read(text) {
                Some(number) => Self::Number(number),
                None => Self::Text(text.clone()),
            },
        }
    }

    /// What Python calls the type.
    pub(super) fn sort(&self) -> &'static str {
        match self {
            Self::None => "None",
            Self::Bool(_) => "a truth value",
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Tuple(_) => "a tuple",
            Self::Set(_) => "a set",
            Self::Dict(_) => "a dictionary",
            Self::Function(_) => "a function",
            Self::Module(_) => "a module",
            Self::Namespace(_) => "a namespace",
            Self::Block(_) => "a block",
            Self::Macro(_) => "a macro",
        }
    }

    /// Python's truth of a value.
    pub(super) fn truth(&self, asked: &str) -> Outcome<bool> {
        if let Self::Number(_) = self {
            self.known(asked)?;
        }
        Ok(self.is_true())
    }

    /// A number that is left open, itself or within a text.
    fn open(&self) -> Option<&Number> {
        match self {
            Self::Number(number) => number.exact.as_ref().filter(|exact| exact.is_open()),
            Self::Text(text) => text.open(),
            _ => None,
        }
    }

    /// Refuses a number that is left open where its value itself is asked for: what is asked must not be answered by the
    /// value that the file happens to have.
    pub(super) fn known(&self, asked: &str) -> Outcome<()> {
        self.open().map_or(Ok(()), |number| {
            let name = number.open_name().unwrap_or("a measure");
            Err(Trouble::new(format!(
                "{asked} needs the value of {}, which is left open",
                quoted(name)
            ))
            .help("leave open what it is computed from, or give the measure a value"))
        })
    }

    fn is_true(&self) -> bool {
        match self {
            Self::None => false,
            Self::Bool(value) => *value,
            Self::Number(number) => number.double() != 0.0,
            Self::Text(text) => !text.as_str().is_empty(),
            Self::List(items) | Self::Tuple(items) => !items.is_empty(),
            Self::Set(items) => !items.is_empty(),
            Self::Dict(items) => !items.is_empty(),
            _ => true,
        }
    }

    /// As a number; truth values count as 0 and 1, as in Python.
    pub(super) fn number(&self) -> Option<Num> {
        match self {
            Self::Number(number) => Some(number.clone()),
            Self::Bool(value) => Some(Num::int(i128::from(*value))),
            _ => None,
        }
    }

    /// Python's `str`, with marks; nothing longer than `most` bytes.
    pub(super) fn to_text(&self, most: usize) -> Option<Text> {
        match self {
            Self::Text(text) => Some(text.clone()),
            Self::Number(number) => Some(number.text()),
            _ => self.repr(most),
        }
    }

    /// Python's `repr`, with marks; nothing longer than `most` bytes.
    pub(super) fn repr(&self, most: usize) -> Option<Text> {
        let mut joined = Joined::default();
        self.write(&mut joined, most, 0)?;
        Some(joined.finish())
    }

    /// `None` where it would be too long or nested too deep.
    fn write(&self, out: &mut Joined, most: usize, depth: usize) -> Option<()> {
        const DEEPEST: usize = 64;
        if out.len() > most || depth > DEEPEST {
            return None;
        }
        let listed = |out: &mut Joined, items: &[Value]| -> Option<()> {
            for (index, item) in items.iter().enumerate() {
                if index > 0 {
                    out.push_str(", ");
                }
                item.write(out, most, depth + 1)?;
            }
            Some(())
        };
        match self {
            Self::None => out.push_str("None"),
            Self::Bool(true) => out.push_str("True"),
            Self::Bool(false) => out.push_str("False"),
            Self::Number(number) => out.push(&number.text()),
            Self::Text(text) => out.push_str(&quoted_text(text.as_str())),
            Self::List(items) => {
                out.push_str("[");
                listed(out, items)?;
                out.push_str("]");
            }
            Self::Tuple(items) => {
                out.push_str("(");
                listed(out, items)?;
                out.push_str(if items.len() == 1 { ",)" } else { ")" });
            }
            Self::Set(items) if items.is_empty() => out.push_str("set()"),
            Self::Set(items) => {
                out.push_str("{");
                listed(out, items)?;
                out.push_str("}");
            }
            Self::Dict(items) => {
                out.push_str("{");
                for (index, (key, value)) in items.iter().enumerate() {
                    if index > 0 {
                        out.push_str(", ");
                    }
                    key.write(out, most, depth + 1)?;
                    out.push_str(": ");
                    value.write(out, most, depth + 1)?;
                }
                out.push_str("}");
            }
            other => {
                out.push_str("<");
                out.push_str(other.sort());
                out.push_str(">");
            }
        }
        Some(())
    }
}
