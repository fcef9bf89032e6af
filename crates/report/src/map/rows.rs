//! The text of a sweep: a line that states what was asked, the names of its columns, and rows.

use super::MapError;
use crate::sweep::{SWEEP_SCHEMA, csv_cells};
use serde::Deserialize;
use std::io::{BufRead, Error, ErrorKind, Read};

/// No line of a sweep is longer than this (bytes).
const LONGEST: u64 = 1 << 20;

/// How to get what can be drawn.
const HELP: &str = "name a file that `kutzbach sweep FILE --over … -o out.csv` has written, with its first two lines";

/// What the first line states that rows depend on; its share and the version of the program are not asked for.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(super) struct Head {
    schema: String,
    pub file: String,
    hash: String,
    over: Vec<String>,
    /// The sample, if one was taken.
    pub sample: Option<String>,
    depth: String,
    /// How many variants the whole sweep has.
    pub variants: u64,
    pub set: Vec<String>,
    pub literal: bool,
    pub precision: Option<f64>,
    pub closure_tolerance: Option<f64>,
}

/// What stands behind the name of a measure that a column has as well.
const MARK: &str = " (measure)";

/// The names of all columns: the variant's number, the measures, the status and what follows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Columns {
    names: Vec<String>,
    measures: usize,
}

impl Columns {
    fn read(line: &str) -> Option<Self> {
        let names = csv_cells(line)?;
        // A measure of this name would be marked.
        let status = names.iter().position(|name| name == "status")?;
        let measures = status.checked_sub(1)?;
        let begins = names.first().is_some_and(|name| name == "variant");
        begins.then_some(Self { names, measures })
    }

    /// How many columns there are.
    pub fn count(&self) -> usize {
        self.names.len()
    }

    /// Places of the measures.
    pub fn measures(&self) -> std::ops::RangeInclusive<usize> {
        1..=self.measures
    }

    /// The name of a measure at a place, as the file of the mechanism has it.
    pub fn measure_name(&self, place: usize) -> &str {
        let name = self.name(place);
        name.strip_suffix(MARK).unwrap_or(name)
    }

    /// The name of a column at a place.
    pub fn name(&self, place: usize) -> &str {
        self.names.get(place).map_or("", String::as_str)
    }

    /// The place of a measure.
    pub fn measure(&self, name: &str) -> Option<usize> {
        self.measures()
            .find(|place| self.name(*place) == name || self.measure_name(*place) == name)
    }

    /// The place of a column.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|own| own == name)
    }

    /// All names, for an error.
    pub fn listed(&self, places: impl Iterator<Item = usize>) -> String {
        let names: Vec<String> = places
            .map(|place| format!("`{}`", self.measure_name(place)))
            .collect();
        names.join(", ")
    }
}

/// A line of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Line {
    /// Counted from 1.
    pub number: u64,
    /// Without its line break.
    pub content: String,
    /// Whether it had one.
    pub is_complete: bool,
}

/// The lines of a text.
#[derive(Debug)]
pub(super) struct Lines<R> {
    reader: R,
    number: u64,
}

impl<R: BufRead> Lines<R> {
    pub fn new(reader: R) -> Self {
        Self { reader, number: 0 }
    }

    /// The next line; `None` after the last.
    ///
    /// # Errors
    /// What the system says; a line that is no text, or longer than any row.
    pub fn read(&mut self) -> Result<Option<Line>, Error> {
        let mut bytes = Vec::new();
        let mut limited = self.reader.by_ref().take(LONGEST);
        let length = limited.read_until(b'\n', &mut bytes)?;
        if length == 0 {
            return Ok(None);
        }
        self.number += 1;
        let number = self.number;
        let wrong =
            |what: &str| Error::new(ErrorKind::InvalidData, format!("line {number} {what}"));
        let is_complete = bytes.ends_with(b"\n");
        if !is_complete && length as u64 >= LONGEST {
            return Err(wrong("is longer than any row of a sweep"));
        }
        let mut content = String::from_utf8(bytes).map_err(|_| wrong("is no UTF-8 text"))?;
        // Programs of tables end lines in two characters.
        let kept = content.trim_end_matches(['\n', '\r']).len();
        content.truncate(kept);
        Ok(Some(Line {
            number,
            content,
            is_complete,
        }))
    }
}

/// Reads what stands before the rows.
///
/// # Errors
/// [`MapError`] where that is something else.
pub(super) fn opening<R: BufRead>(
    file: &str,
    lines: &mut Lines<R>,
) -> Result<(Option<Head>, Columns), MapError> {
    let mut next = || -> Result<Line, MapError> {
        let line = lines.read().map_err(|error| unreadable(file, &error))?;
        Ok(line.unwrap_or(Line {
            number: 1,
            content: String::new(),
            is_complete: false,
        }))
    };
    let first = next()?;
    // A byte order mark is what programs of tables begin with.
    let opened = first.content.trim_start_matches('\u{feff}');
    if opened.starts_with('{') {
        return Err(MapError::new(
            format!("`{file}` holds lines of JSON, and a map is made of CSV"),
            "sweep with `-o out.csv`, or `--format csv`",
        ));
    }
    let Some(stated) = opened.strip_prefix('#') else {
        return match Columns::read(opened) {
            Some(columns) => Ok((None, columns)),
            None => Err(no_sweep(file, "the names of its columns")),
        };
    };
    let head: Head = serde_json::from_str(stated.trim())
        .map_err(|_| no_sweep(file, "what was asked, as JSON"))?;
    if head.schema != SWEEP_SCHEMA {
        return Err(MapError::new(
            format!(
                "needed rows of the schema `{SWEEP_SCHEMA}`, found `{}` in `{file}`",
                head.schema
            ),
            HELP,
        ));
    }
    let second = next()?;
    match Columns::read(&second.content) {
        Some(columns) => Ok((Some(head), columns)),
        None => Err(no_sweep(file, "the names of its columns")),
    }
}

/// The file cannot be read, and what the system says.
pub(super) fn unreadable(file: &str, error: &Error) -> MapError {
    MapError::new(format!("cannot read `{file}`: {error}"), HELP)
}

fn no_sweep(file: &str, needed: &str) -> MapError {
    MapError::new(
        format!("`{file}` does not begin as the rows of a sweep do: needed {needed}"),
        HELP,
    )
}
