//! `kutzbach check PATH...`: compares reports with what is known of the mechanisms.
//!
//! What is known stands in a file's own `<expect>` and in an `expected.json` beside it; both are compared. Files are taken
//! from folders by their extension, in order of their paths, and analysed in parallel; the answer does not depend on how
//! many processors there are.

mod known;
mod table;

use super::failure::Failure;
use super::{BAD_INPUT, DISAGREEMENT, DONE, files, load, output, terminal};
use clap::{Args, ValueEnum};
use known::Known;
use kutzbach::mechanism::Expectation;
use kutzbach::report::{Disagreement, Options, compare};
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
    /// Count files of which anything unusual is not read as unreadable
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    closing: load::Closing,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A table of disagreements for a person
    Text,
    /// Everything, for a program
    Json,
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
    #[serde(flatten)]
    disagreement: Disagreement,
}

/// What came of one file.
enum Outcome {
    Unreadable(Failure),
    NothingKnown,
    Compared(Vec<kutzbach::report::Comparison>),
}

/// Runs the command.
///
/// # Errors
/// Where a path does not exist, an `expected.json` is malformed, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let files = files::mechanism_files(&arguments.paths)?;
    let known = Known::beside(&files)?;
    let outcomes = files::each(&files, |file| {
        outcome(file, &known, arguments.strict, arguments.closing)
    });
    let mut failures = Vec::new();
    let mut checked = Checked {
        schema: "kutzbach-check-1",
        files: files.len(),
        notes: known.notes(&files, &arguments.paths),
        ..Checked::default()
    };
    for (file, outcome) in files.iter().zip(outcomes) {
        let name = file.display().to_string();
        match outcome {
            Outcome::NothingKnown => checked.without_expectation.push(name),
            Outcome::Unreadable(failure) => {
                checked.unreadable.push(Unreadable {
                    file: name,
                    message: failure.line(),
                });
                failures.push(failure);
            }
            Outcome::Compared(comparisons) => checked.add(&name, comparisons),
        }
    }
    let text = match arguments.format {
        Format::Text => table::render(&checked, terminal::layout(false, true)),
        Format::Json => output::json(&checked)?,
    };
    output::put(&text, None)?;
    failures.iter().for_each(Failure::tell);
    Ok(if !failures.is_empty() {
        BAD_INPUT
    } else if checked.wrong > 0 {
        DISAGREEMENT
    } else {
        DONE
    })
}

impl Checked {
    /// Adds the comparisons of one file. What its two sources agree on counts once.
    fn add(&mut self, file: &str, comparisons: Vec<kutzbach::report::Comparison>) {
        let (mut right, mut open) = (BTreeSet::new(), BTreeSet::new());
        let mut wrong: Vec<Disagreement> = Vec::new();
        for comparison in comparisons {
            right.extend(comparison.right);
            open.extend(comparison.open);
            for disagreement in comparison.wrong {
                if !wrong.contains(&disagreement) {
                    wrong.push(disagreement);
                }
            }
        }
        self.right += right.len();
        self.wrong += wrong.len();
        self.open += open.len();
        for field in right {
            self.fields.entry(field).or_default().right += 1;
        }
        for field in open {
            self.fields.entry(field).or_default().open += 1;
        }
        for disagreement in wrong {
            self.fields.entry(disagreement.what).or_default().wrong += 1;
            self.disagreements.push(Row {
                file: file.to_owned(),
                disagreement,
            });
        }
    }
}

/// Reads, analyses and compares one file.
fn outcome(file: &Path, known: &Known, strict: bool, closing: load::Closing) -> Outcome {
    let reading = match load::mechanism(file, &[], strict) {
        Ok(reading) => reading,
        Err(failure) => return Outcome::Unreadable(failure),
    };
    let expectations: Vec<Expectation> = reading
        .mechanism
        .expectation()
        .cloned()
        .into_iter()
        .chain(known.of(file))
        .collect();
    if expectations.is_empty() {
        return Outcome::NothingKnown;
    }
    let options = Options {
        closure_tolerance: closing.closure_tolerance,
        ..Options::default()
    };
    match load::report_on(&reading, file, &options) {
        Ok(report) => Outcome::Compared(
            expectations
                .iter()
                .map(|expectation| compare(&report, expectation))
                .collect(),
        ),
        Err(failure) => Outcome::Unreadable(failure),
    }
}
