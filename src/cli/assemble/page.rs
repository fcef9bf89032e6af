//! Configurations as a page.

use super::super::failure::Failure;
use super::super::load;
use kutzbach::assembly::modes::{Configuration as Found, Modes};
use kutzbach::assembly::words;
use kutzbach::format::Reading;
use kutzbach::mechanism::{Configuration, FreedomPart, JointId, Mechanism};
use kutzbach::mobility::{Analysis, ExactBudget};
use kutzbach::number::Number;
use kutzbach::report::html::{Facts, Shown, configurations_page};
use kutzbach::report::{Options, Report};
use std::collections::BTreeSet;
use std::path::Path;

/// So many configurations are shown, the drawn one among them: each is analysed and followed.
const MOST: usize = 24;

/// A configuration with the mechanism that has it, and what is known there.
struct Analysed {
    number: usize,
    name: String,
    mechanism: Mechanism,
    report: Report,
    analysis: Analysis,
}

/// The page of all configurations.
///
/// # Errors
/// Where a configuration cannot be analysed.
pub(super) fn page(reading: &Reading, file: &Path, modes: &Modes) -> Result<String, Failure> {
    let mechanism = &reading.mechanism;
    let mut chosen: Vec<usize> = (0..modes.configurations.len()).collect();
    // The page begins with the drawn one.
    chosen.sort_by_key(|&k| !modes.configurations[k].drawn);
    chosen.truncate(MOST);
    let mut analysed = Vec::new();
    for &number in &chosen {
        analysed.push(at(reading, file, &modes.configurations[number], number)?);
    }
    let shown: Vec<Shown<'_>> = analysed
        .iter()
        .map(|one| Shown {
            facts: Facts {
                mechanism: &one.mechanism,
                report: &one.report,
                analysis: &one.analysis,
                configuration: Some(&one.name),
                verification: None,
                accuracy: None,
            },
            title: format!("Configuration {}", one.number + 1),
            note: words::note(&modes.configurations[one.number]),
            values: values(mechanism, &modes.configurations[one.number]),
        })
        .collect();
    let mut sentences: Vec<String> = words::text(mechanism, modes, words::Units::Si)
        .lines()
        .take_while(|line| !line.starts_with("Configuration "))
        .map(|line| line.trim().trim_start_matches("• ").to_owned())
        .filter(|line| !line.is_empty())
        .collect();
    if modes.configurations.len() > MOST {
        sentences.push(format!(
            "Shown are {MOST} of {}; `--format json` has all.",
            modes.configurations.len()
        ));
    }
    let moves = |one: &Analysed| one.analysis.mobility.finite() > Some(0);
    if analysed.iter().any(moves) {
        sentences.push("The picture shows how each moves with no joint held.".to_owned());
    }
    let title = format!("{}: configurations", mechanism.name());
    configurations_page(&title, &sentences, &shown).map_err(|error| Failure::Plain {
        message: format!("cannot be written as a page: {error}"),
        help: None,
    })
}

/// The mechanism at a configuration, with no joint held.
fn at(reading: &Reading, file: &Path, found: &Found, number: usize) -> Result<Analysed, Failure> {
    let exact = |x: &f64| Number::from_f64(*x);
    let positions: Vec<(JointId, Vec<Number>)> = found
        .joints
        .iter()
        .filter_map(|(joint, values)| {
            let values: Vec<Number> = values.as_ref()?.iter().map(exact).collect::<Option<_>>()?;
            Some((*joint, values))
        })
        .collect();
    // A name that no file has: names of files are words.
    let name = format!("configuration {}", number + 1);
    let mechanism = reading.mechanism.with_configuration(Configuration {
        name: name.clone(),
        positions,
        free: BTreeSet::new(),
    });
    let options = Options {
        configuration: Some(name.clone()),
        exact: ExactBudget::none(),
        ..Options::default()
    };
    let here = Reading {
        mechanism: mechanism.clone(),
        warnings: Vec::new(),
        skipped: Vec::new(),
        format: reading.format,
        kept: reading.kept.clone(),
        expect_at: reading.expect_at,
    };
    let (report, analysis) = load::analysed(&here, file, &options)?;
    Ok(Analysed {
        number,
        name,
        mechanism,
        report,
        analysis,
    })
}

/// Joints and their values, in degrees and millimetres; balls are left out.
fn values(mechanism: &Mechanism, found: &Found) -> Vec<(String, String)> {
    let one = |(joint, values): &(JointId, Option<Vec<f64>>)| {
        let joint = mechanism.joint(*joint);
        let [value] = values.as_deref()? else {
            return None;
        };
        let turns = joint.kind.freedoms().first() != Some(&FreedomPart::Translation);
        let value = match turns {
            true => format!("{:.3}°", value.to_degrees() + 0.0),
            false => format!("{:.3} mm", value * 1e3 + 0.0),
        };
        Some((joint.name.clone(), value))
    };
    found.joints.iter().filter_map(one).collect()
}
