//! What was measured, as it is kept.

use super::subjects::{Result, Subject};
use kutzbach::accuracy::{Accuracy, AccuracyOptions, measure};
use kutzbach::mobility::{AnalysisOptions, analyse};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::ops::ControlFlow;

/// All mechanisms, with when and where the times were measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The day, as given.
    pub date: String,
    /// The kind of machine, as given.
    pub machine: String,
    /// In the order of the page.
    pub mechanisms: Vec<Row>,
}

/// One mechanism.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// In file names and markers.
    pub name: String,
    /// In the text.
    pub title: String,
    /// What was measured.
    pub accuracy: Accuracy,
}

impl Record {
    /// Nothing measured yet.
    pub fn new(date: &str, machine: &str) -> Self {
        Self {
            date: date.to_owned(),
            machine: machine.to_owned(),
            mechanisms: Vec::new(),
        }
    }

    /// Measures a mechanism.
    pub fn add(&mut self, subject: &Subject) -> Result<()> {
        self.mechanisms.push(Row {
            name: subject.name.to_owned(),
            title: subject.title.to_owned(),
            accuracy: measured(subject, &AccuracyOptions::default())?,
        });
        Ok(())
    }
}

/// What a mechanism costs, numbers in four digits.
pub fn measured(subject: &Subject, options: &AccuracyOptions) -> Result<Accuracy> {
    let mechanism = subject.mechanism()?;
    let analysis = analyse(&mechanism, &AnalysisOptions::default())?;
    let accuracy = measure(&mechanism, &analysis, options, &mut |_, _| {
        ControlFlow::Continue(())
    })?;
    let mut value = serde_json::to_value(&accuracy)?;
    shorten(&mut value);
    Ok(serde_json::from_value(value)?)
}

/// Four digits: more are noise, in times at least. Lengths of steps keep theirs, since they are chosen.
fn shorten(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(shorten),
        Value::Object(fields) => fields
            .iter_mut()
            .filter(|(name, _)| *name != "time_step")
            .for_each(|(_, value)| shorten(value)),
        Value::Number(number) if number.is_f64() => {
            let short = number
                .as_f64()
                .and_then(|x| format!("{x:.3e}").parse().ok());
            if let Some(short) = short.and_then(serde_json::Number::from_f64) {
                *number = short;
            }
        }
        _ => {}
    }
}
