//! `kutzbach check PATH...`: compares reports with what is known of the mechanisms.
//!
//! What is known stands in a file's own `<expect>` and in an `expected.json` beside it; both are compared. Files are taken
//! from folders by their extension, in order of their paths, and analysed in parallel; the answer does not depend on how
//! many processors there are.

mod junit;
mod known;
mod table;
mod update;

use super::failure::Failure;
use super::{BAD_INPUT, DISAGREEMENT, DONE, files, load, output, terminal};
use clap::{Args, ValueEnum};
use known::Known;
use kutzbach::mechanism::Expectation;
use kutzbach::report::{Comparison, Disagreement, Options, Report, compare};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Compare reports with what is known of the mechanisms
#[derive(Debug, Args)]
pub struct Arguments {
    /// Mechanism files, or folders of them
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Count files of which anything unusual is not read as unreadable, and as failures what is open, files of which nothing is
    /// known, entries of files that are not there, and fields that nothing reads
    #[arg(long)]
    strict: bool,
    /// Write what the reports found into the `expected.json` of each folder: fields stated there that are decided, and an entry
    /// for each file that has none. `locked` and `idle`, and what files say themselves in `<expect>`, stay as they are
    #[arg(long)]
    update: bool,
    #[command(flatten)]
    closing: load::Closing,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A table of disagreements for a person
    Text,
    /// Everything, for a program
    Json,
    /// A case for every file, for programs that build and test
    Junit,
}

/// Everything a check finds.
#[derive(Debug, Default, Serialize)]
struct Checked {
    schema: &'static str,
    files: usize,
    /// Files of which nothing is known.
    without_expectation: Vec<String>,
    /// Files that could not be read, and why.
    unreadable: Vec<Unreadable>,
    right: usize,
    wrong: usize,
    open: usize,
    /// The three counts per field.
    fields: BTreeMap<&'static str, Tally>,
    disagreements: Vec<Row>,
    notes: Vec<String>,
    #[serde(skip)]
    cases: Vec<Case>,
}

/// One file.
#[derive(Debug, Default)]
struct Case {
    file: String,
    /// Where it stands what is known of it; `None` where nothing is.
    place: Option<Place>,
    /// Fields that the report leaves open.
    open: Vec<&'static str>,
    /// Why it could not be read.
    unreadable: Option<String>,
}

/// A line of a file, counted from 1.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
struct Place {
    file: String,
    line: usize,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}", self.file, self.line)
    }
}

#[derive(Debug, Serialize)]
struct Unreadable {
    file: String,
    message: String,
}

#[derive(Debug, Default, Serialize)]
struct Tally {
    right: usize,
    wrong: usize,
    open: usize,
}

#[derive(Debug, Serialize)]
struct Row {
    file: String,
    /// Where it stands what is expected.
    #[serde(rename = "expected_at")]
    place: Option<Place>,
    #[serde(flatten)]
    disagreement: Disagreement,
}

/// What came of one file.
enum Outcome {
    Unreadable(Failure),
    NothingKnown(Option<Box<Report>>),
    Compared(Vec<(Comparison, Option<Place>)>, Box<Report>),
}

/// Runs the command.
///
/// # Errors
/// Where a path does not exist, an `expected.json` is malformed, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let files = files::mechanism_files(&arguments.paths)?;
    let known = Known::beside(&files)?;
    let outcomes = files::each(&files, |file| outcome(file, &known, arguments));
    let mut failures = Vec::new();
    let mut found = Vec::new();
    let mut checked = Checked {
        schema: "kutzbach-check-1",
        files: files.len(),
        notes: known.notes(&files, &arguments.paths),
        ..Checked::default()
    };
    for (file, outcome) in files.iter().zip(outcomes) {
        let name = file.display().to_string();
        let case = Case {
            file: name.clone(),
            ..Case::default()
        };
        match outcome {
            Outcome::NothingKnown(report) => {
                checked.without_expectation.push(name);
                checked.cases.push(case);
                found.extend(report.map(|report| (file.as_path(), report)));
            }
            Outcome::Unreadable(failure) => {
                let message = failure.line();
                checked.cases.push(Case {
                    unreadable: Some(message.clone()),
                    ..case
                });
                checked.unreadable.push(Unreadable {
                    file: name,
                    message,
                });
                failures.push(failure);
            }
            Outcome::Compared(comparisons, report) => {
                checked.add(&name, comparisons);
                found.push((file.as_path(), report));
            }
        }
    }
    let text = match arguments.format {
        Format::Text => table::render(&checked, terminal::layout(false, true)),
        Format::Json => output::json(&checked)?,
        Format::Junit => junit::render(&checked, arguments.strict),
    };
    output::put(&text, None)?;
    failures.iter().for_each(Failure::tell);
    if arguments.update {
        update::write(&found)?;
    }
    Ok(if !failures.is_empty() {
        BAD_INPUT
    } else if checked.wrong > 0 || arguments.strict && checked.is_incomplete() {
        DISAGREEMENT
    } else {
        DONE
    })
}

impl Checked {
    /// Whether anything was left open, is not known, or is misspelt, or nothing was compared at all.
    fn is_incomplete(&self) -> bool {
        let nothing_known = !self.without_expectation.is_empty() || !self.notes.is_empty();
        self.open > 0 || nothing_known || self.right + self.wrong == 0
    }

    /// Adds the comparisons of one file. What its two sources agree on counts once.
    fn add(&mut self, file: &str, comparisons: Vec<(Comparison, Option<Place>)>) {
        let (mut right, mut open) = (BTreeSet::new(), BTreeSet::new());
        let mut wrong: Vec<(Disagreement, Option<Place>)> = Vec::new();
        let place = comparisons.iter().find_map(|(_, place)| place.clone());
        for (comparison, place) in comparisons {
            right.extend(comparison.right);
            open.extend(comparison.open);
            for disagreement in comparison.wrong {
                if !wrong.iter().any(|(known, _)| *known == disagreement) {
                    wrong.push((disagreement, place.clone()));
                }
            }
        }
        self.cases.push(Case {
            file: file.to_owned(),
            place,
            open: open.iter().copied().collect(),
            unreadable: None,
        });
        self.right += right.len();
        self.wrong += wrong.len();
        self.open += open.len();
        for field in right {
            self.fields.entry(field).or_default().right += 1;
        }
        for field in open {
            self.fields.entry(field).or_default().open += 1;
        }
        for (disagreement, place) in wrong {
            self.fields.entry(disagreement.what).or_default().wrong += 1;
            self.disagreements.push(Row {
                file: file.to_owned(),
                place,
                disagreement,
            });
        }
    }
}

/// Reads, analyses and compares one file. Where nothing is known of it, it is analysed only to be written down.
fn outcome(file: &Path, known: &Known, arguments: &Arguments) -> Outcome {
    let reading = match load::mechanism(file, &[], arguments.strict) {
        Ok(reading) => reading,
        Err(failure) => return Outcome::Unreadable(failure),
    };
    let own = reading.mechanism.expectation().cloned().map(|expected| {
        let place = reading.expect_at.map(|(line, _)| Place {
            file: file.display().to_string(),
            line,
        });
        (expected, place)
    });
    let beside = known.of(file).map(|(expected, at)| (expected, Some(at)));
    let expectations: Vec<(Expectation, Option<Place>)> = own.into_iter().chain(beside).collect();
    if expectations.is_empty() && !arguments.update {
        return Outcome::NothingKnown(None);
    }
    let options = Options {
        closure_tolerance: arguments.closing.closure_tolerance,
        ..Options::default()
    };
    let report = match load::report_on(&reading, file, &options) {
        Ok(report) => Box::new(report),
        Err(failure) => return Outcome::Unreadable(failure),
    };
    if expectations.is_empty() {
        return Outcome::NothingKnown(Some(report));
    }
    let comparisons = expectations
        .into_iter()
        .map(|(expectation, place)| (compare(&report, &expectation), place));
    Outcome::Compared(comparisons.collect(), report)
}
