//! The expanded file as text, and where each part of it comes from.
//!
//! In attributes that the reader takes for numbers, a number that was computed is written as `${__n7}`, a name for the exact
//! number; every other attribute is written as xacro writes it.

use super::element::{Attribute, Element, Node};
use super::map::{Map, Span};
use super::text::Text;
use super::value::Value;
use super::{Outcome, Place, Run, Trouble};
use crate::{Reading, Warning, guard};
use kutzbach_math::number::Number;
use std::ops::Range;
use std::rc::Rc;

/// Attributes that are read as numbers.
const NUMERIC: [&str; 15] = [
    "xyz",
    "rpy",
    "lower",
    "upper",
    "effort",
    "velocity",
    "multiplier",
    "offset",
    "lead",
    "damping",
    "friction",
    "radius",
    "length",
    "size",
    "scale",
];
/// Elements whose `value` is read as a number.
const WITH_VALUE: [&str; 4] = ["mass", "ratio", "distance", "position"];

/// The name of a number, which no file can define.
const PREFIX: &str = "__n";

/// The number that a name in an expanded text stands for.
pub(crate) fn number_named<'n>(name: &str, numbers: &'n [Number]) -> Option<&'n Number> {
    numbers.get(name.strip_prefix(PREFIX)?.parse::<usize>().ok()?)
}

/// An expanded file.
pub(crate) struct Expanded {
    /// Plain URDF, with names for numbers.
    pub(crate) text: String,
    /// The numbers.
    pub(crate) numbers: Vec<Number>,
    /// Where its parts come from.
    pub(crate) map: Map,
    /// The same as xacro writes it, numbers as doubles.
    pub(crate) plain: String,
}

impl Expanded {
    /// A reading of the text with its notes at places of the main file, and what the file itself said.
    pub(crate) fn placed(&self, mut reading: Reading) -> Reading {
        let starts: Vec<usize> = std::iter::once(0)
            .chain(self.text.match_indices('\n').map(|(at, _)| at + 1))
            .collect();
        let offset = |line: usize, column: usize| {
            let start = starts.get(line.saturating_sub(1)).copied().unwrap_or(0);
            let rest = self.text.get(start..).unwrap_or_default();
            let inside = rest.char_indices().nth(column.saturating_sub(1));
            start + inside.map_or(0, |(at, _)| at)
        };
        let of_warnings = reading.warnings.iter().map(|own| (own.line, own.column));
        let of_skipped = reading.skipped.iter().map(|own| (own.line, own.column));
        let offsets: Vec<usize> = of_warnings
            .chain(of_skipped)
            .chain(reading.expect_at)
            .map(|(line, column)| offset(line, column))
            .collect();
        let (noted, own) = self.map.notes(&offsets);
        let mut noted = noted.into_iter();
        for (warning, noted) in reading.warnings.iter_mut().zip(&mut noted) {
            (warning.line, warning.column) = (noted.line, noted.column);
            warning.message.push_str(&noted.beside);
        }
        for (skipped, noted) in reading.skipped.iter_mut().zip(&mut noted) {
            (skipped.line, skipped.column) = (noted.line, noted.column);
            skipped.what.push_str(&noted.beside);
        }
        if let (Some(place), Some(noted)) = (&mut reading.expect_at, noted.next()) {
            *place = (noted.line, noted.column);
        }
        reading
            .warnings
            .extend(own.into_iter().map(|(noted, (kind, said))| Warning {
                line: noted.line,
                column: noted.column,
                kind,
                message: format!("{said}{}", noted.beside),
                count: 1,
            }));
        reading
            .warnings
            .sort_by_key(|warning| (warning.line, warning.column));
        reading
            .skipped
            .sort_by_key(|skipped| (skipped.line, skipped.column));
        reading.format = "xacro";
        reading
    }
}

struct Writer {
    text: String,
    plain: String,
    numbers: Vec<Number>,
    spans: Vec<Span>,
}

/// Writes an expanded robot.
pub(super) fn written(
    root: &Rc<Element>,
    prefixes: &[(String, String)],
    run: &Run<'_>,
) -> Outcome<Expanded> {
    let mut writer = Writer {
        text: String::new(),
        plain: String::new(),
        numbers: Vec::new(),
        spans: Vec::new(),
    };
    writer.element(root, prefixes, 0)?;
    Ok(Expanded {
        text: writer.text,
        numbers: writer.numbers,
        map: Map::new(writer.spans, run),
        plain: writer.plain,
    })
}

impl Writer {
    fn push(&mut self, text: &str) {
        self.text.push_str(text);
        self.plain.push_str(text);
    }

    fn span(&mut self, out: Range<usize>, place: Place, call: Option<u32>, is_verbatim: bool) {
        self.spans.push(Span {
            out,
            place,
            call,
            is_verbatim,
        });
    }

    fn element(
        &mut self,
        element: &Element,
        prefixes: &[(String, String)],
        depth: usize,
    ) -> Outcome<()> {
        if let Some(fault) = guard::size_fault(self.text.len() as u64) {
            let trouble = Trouble::new(format!("expanded, {}", fault.message));
            return Err(match fault.help {
                Some(help) => trouble.help(help),
                None => trouble,
            }
            .at(element.place, element.call));
        }
        self.push(&"  ".repeat(depth.min(20)));
        let start = self.text.len();
        self.push("<");
        self.push(&element.name);
        self.span(start..self.text.len(), element.place, element.call, true);
        for (prefix, address) in prefixes {
            if prefix == "xacro" {
                continue;
            }
            let colon = if prefix.is_empty() { "" } else { ":" };
            self.push(&format!(" xmlns{colon}{prefix}=\"{}\"", escaped(address)));
        }
        for attribute in &element.attributes {
            self.attribute(element, attribute)?;
        }
        if element.children.is_empty() {
            self.push("/>\n");
            return Ok(());
        }
        self.push(">\n");
        for child in &element.children {
            match child {
                Node::Element(inner) => self.element(inner, &[], depth + 1)?,
                Node::Text(text, place) => {
                    let start = self.text.len();
                    self.push(&escaped(text.as_str()));
                    self.span(start..self.text.len(), *place, element.call, false);
                    self.push("\n");
                }
            }
        }
        self.push(&"  ".repeat(depth.min(20)));
        self.push("</");
        self.push(&element.name);
        self.push(">\n");
        Ok(())
    }

    fn attribute(&mut self, element: &Element, attribute: &Attribute) -> Outcome<()> {
        self.push(" ");
        let start = self.text.len();
        self.push(&attribute.name);
        self.span(start..self.text.len(), attribute.place, element.call, false);
        self.push("=\"");
        let start = self.text.len();
        let name = &*attribute.name;
        let is_number = NUMERIC.contains(&name)
            || name == "value" && WITH_VALUE.contains(&&*element.name)
            || element.local_name() == "inertia";
        let value = match is_number {
            true => self
                .with_numbers(&attribute.value)
                .map_err(|trouble| trouble.at(attribute.place, element.call))?,
            false => escaped(attribute.value.as_str()),
        };
        self.text.push_str(&value);
        self.plain.push_str(&escaped(attribute.value.as_str()));
        // A value that was not touched is as long as where it is written, unless it has entities.
        let is_verbatim = value.len() == attribute.place.end - attribute.place.start;
        self.span(
            start..self.text.len(),
            attribute.place,
            element.call,
            is_verbatim,
        );
        self.push("\"");
        Ok(())
    }

    /// A value in which the computed numbers that stand by themselves have names.
    fn with_numbers(&mut self, value: &Text) -> Outcome<String> {
        let whole = value.as_str();
        let mut out = String::new();
        let mut at = 0;
        for mark in value.marks() {
            let Range { start, end } = mark.range;
            let blank = |c: Option<char>| c.is_none_or(char::is_whitespace);
            let alone =
                blank(whole[..start].chars().next_back()) && blank(whole[end..].chars().next());
            if !alone {
                Value::Text(value.clone()).known("a number put together from letters")?;
                continue;
            }
            out.push_str(&escaped(&whole[at..start]));
            let source = mark.number.source();
            if source.contains('$') {
                out.push_str(&format!("${{{PREFIX}{}}}", self.numbers.len()));
                self.numbers.push(mark.number.clone());
            } else {
                out.push_str(&source);
            }
            at = end;
        }
        out.push_str(&escaped(&whole[at..]));
        Ok(out)
    }
}

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' | '\r' => out.push_str(&format!("&#{};", c as u32)),
            // Control characters have no place in XML; none come from XML, but escapes of expressions can make them.
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
