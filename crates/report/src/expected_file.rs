//! `expected.json`: what is known of the mechanisms in a folder, one entry per file without its extension.
//!
//! ```json
//! { "bennett": { "finite": 1, "instantaneous": 1, "kutzbach": -2, "pose": "regular", "locked": [], "idle": null } }
//! ```
//!
//! The fields are those of [`Expectation`]; `locked` is a list or the word `"all"`; `null` says nothing, like a field left
//! out. Fields with other names are listed by [`ExpectedFile::unknown_fields`] rather than dropped in silence.

use kutzbach_model::mechanism::Expectation;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use thiserror::Error;

/// A file that is not an `expected.json`.
#[derive(Debug, Error)]
#[error("line {line}, column {column}: {message}")]
pub struct ExpectedFileError {
    /// What is wrong.
    pub message: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
}

/// The expectations of a folder.
#[derive(Clone, Debug, Default)]
pub struct ExpectedFile {
    entries: BTreeMap<String, Entry>,
}

#[derive(Clone, Debug, Deserialize)]
struct Entry {
    finite: Option<usize>,
    instantaneous: Option<usize>,
    redundant: Option<i64>,
    kutzbach: Option<i64>,
    pose: Option<String>,
    kind: Option<String>,
    locked: Option<Names>,
    idle: Option<Vec<String>>,
    branches: Option<usize>,
    branch_dimensions: Option<Vec<usize>>,
    #[serde(flatten)]
    unknown: BTreeMap<String, Value>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
enum Names {
    One(String),
    Many(Vec<String>),
}

impl ExpectedFile {
    /// Reads the text of an `expected.json`.
    ///
    /// # Errors
    /// Where the text is not JSON, or a field has a value of another type than the dialect says.
    pub fn parse(text: &str) -> Result<Self, ExpectedFileError> {
        let entries = serde_json::from_str(text).map_err(|error| ExpectedFileError {
            line: error.line(),
            column: error.column(),
            message: strip_position(&error.to_string()),
        })?;
        Ok(Self { entries })
    }

    /// What is expected of the file with this stem.
    #[must_use]
    pub fn expectation(&self, stem: &str) -> Option<Expectation> {
        let entry = self.entries.get(stem)?.clone();
        Some(Expectation {
            finite: entry.finite,
            instantaneous: entry.instantaneous,
            redundant: entry.redundant,
            kutzbach: entry.kutzbach,
            pose: entry.pose,
            kind: entry.kind,
            locked: entry.locked.map(|names| match names {
                Names::One(word) => word.split_whitespace().map(str::to_owned).collect(),
                Names::Many(names) => names,
            }),
            idle: entry.idle,
            branches: entry.branches,
            branch_dimensions: entry.branch_dimensions,
        })
    }

    /// The stems it speaks of, sorted.
    pub fn stems(&self) -> impl Iterator<Item = &str> {
        self.entries.keys().map(String::as_str)
    }

    /// Fields that nothing here understands, as `stem.field`, sorted.
    pub fn unknown_fields(&self) -> impl Iterator<Item = String> {
        self.entries.iter().flat_map(|(stem, entry)| {
            entry
                .unknown
                .keys()
                .map(move |field| format!("{stem}.{field}"))
        })
    }
}

/// serde_json ends its messages with the position, which is told apart here.
fn strip_position(message: &str) -> String {
    match message.rfind(" at line ") {
        Some(end) => message[..end].to_owned(),
        None => message.to_owned(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn null_and_absence_say_nothing() {
        let file =
            ExpectedFile::parse(r#"{"a": {"finite": 1, "idle": null, "locked": "all"}}"#).unwrap();
        let expectation = file.expectation("a").unwrap();
        assert_eq!(expectation.finite, Some(1));
        assert_eq!(expectation.idle, None);
        assert_eq!(expectation.pose, None);
        assert_eq!(expectation.locked, Some(vec!["all".to_owned()]));
        assert_eq!(file.expectation("b"), None);
    }

    #[test]
    fn unknown_fields_are_told() {
        let file = ExpectedFile::parse(r#"{"a": {"finit": 1}}"#).unwrap();
        assert_eq!(file.unknown_fields().collect::<Vec<_>>(), ["a.finit"]);
    }

    #[test]
    fn errors_name_the_place() {
        let error = ExpectedFile::parse("{\n \"a\": {\"finite\": -1}}").unwrap_err();
        assert_eq!(error.line, 2);
        assert!(!error.message.contains("line"), "{}", error.message);
    }
}
