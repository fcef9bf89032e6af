//! The report, the answer of lesser depths, and what words mean.

use crate::asked::{self, Analyse};
use crate::failure::Failure;
use crate::reading::Subject;
use kutzbach::format::property_names;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, Depth, analyse};
use kutzbach::report::definitions;
use kutzbach::report::html::{Assets, Facts, Prepared};
use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Misfit, Options, Report, ReportError, analysed_report, misfits};
use kutzbach::sweep;
use pyo3::prelude::*;
use serde_json::{Value, json};

/// A report, and what a row of a sweep would say.
#[pyclass(frozen, module = "kutzbach._kutzbach")]
pub struct Analysed {
    report: Report,
    facts: String,
}

#[pymethods]
impl Analysed {
    /// Everything.
    fn json(&self) -> PyResult<String> {
        serde_json::to_string(&self.report)
            .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))
    }

    /// What a row of a sweep would say.
    fn facts(&self) -> &str {
        &self.facts
    }

    /// A page for a person.
    #[pyo3(signature = (width, verbose))]
    fn text(&self, width: usize, verbose: bool) -> String {
        let layout = Layout {
            width,
            verbose,
            ..Layout::default()
        };
        render(&self.report, layout)
    }
}

/// The meaning of a word of a report, where it has one.
#[pyfunction]
#[pyo3(signature = (word))]
pub fn explain(word: &str) -> Option<String> {
    let found = definitions::find(word)?;
    Some(format!("{}\n\n{}", found.title, found.body.trim()))
}

fn options(asked: &Analyse, ranges: bool) -> Options {
    Options {
        configuration: asked::named(asked.configuration.clone()),
        exact: asked.budget(),
        evidence: asked.evidence,
        between: asked.between.clone(),
        closure_tolerance: asked.closure_tolerance,
        inputs: asked.inputs.clone(),
        ranges,
        ..Options::default()
    }
}

/// The report that `kutzbach report --format json` writes.
///
/// # Errors
/// A question that the mechanism has no answer to.
pub fn analysed(subject: &Subject, asked: &str) -> Result<Analysed, Failure> {
    let asked: Analyse = asked::parsed(asked)?;
    let options = options(&asked, true);
    let (mut report, analysis) = analysed_report(&subject.reading, &subject.source.file, &options)
        .map_err(|error| refused(subject, &error))?;
    if report.assembly.proven_open {
        report.assembly.misfits = ruled_out(subject);
    }
    let facts = row(subject.mechanism(), &analysis, Depth::Everything);
    Ok(Analysed {
        report,
        facts: facts.to_string(),
    })
}

/// The report as a page.
///
/// # Errors
/// As [`analysed`].
pub fn page(subject: &Subject, asked: &str) -> Result<String, Failure> {
    let asked: Analyse = asked::parsed(asked)?;
    // A page has ranges of its own.
    let options = options(&asked, false);
    let (mut report, analysis) = analysed_report(&subject.reading, &subject.source.file, &options)
        .map_err(|error| refused(subject, &error))?;
    if report.assembly.proven_open {
        report.assembly.misfits = ruled_out(subject);
    }
    let facts = Facts {
        mechanism: subject.mechanism(),
        report: &report,
        analysis: &analysis,
        configuration: options.configuration.as_deref(),
        verification: None,
        accuracy: None,
    };
    Ok(Prepared::new(facts, Assets::Inside).page()?)
}

fn refused(subject: &Subject, error: &ReportError) -> Failure {
    subject.failed(&error.to_string(), Some(error.help()))
}

/// Measures whose values rule a pose out, each by itself; those that were set come first.
fn ruled_out(subject: &Subject) -> Vec<Misfit> {
    let source = &subject.source;
    let mut names = property_names(&String::from_utf8_lossy(&source.bytes));
    let settings = &source.options.settings;
    names.sort_by_key(|name| !settings.iter().any(|(set, _)| set == name));
    misfits(&names, |name| {
        let reading = source.read(&[name.to_owned()]).ok()?;
        Some(reading.mechanism)
    })
}

/// What a row of `kutzbach sweep` says, to the depth asked for.
///
/// # Errors
/// As [`analysed`].
pub fn facts(subject: &Subject, asked: &str) -> Result<String, Failure> {
    let asked: Analyse = asked::parsed(asked)?;
    let mechanism = subject.mechanism();
    let depth = asked.depth()?;
    let options = AnalysisOptions {
        configuration: asked::named_in(mechanism, asked.configuration.clone()),
        exact: asked.budget(),
        depth,
        closure_tolerance: asked.closure_tolerance,
    };
    let analysis =
        analyse(mechanism, &options).map_err(|error| subject.failed(&error.to_string(), None))?;
    Ok(row(mechanism, &analysis, depth).to_string())
}

/// The row of a sweep, as JSON with the words of a report.
fn row(mechanism: &Mechanism, analysis: &Analysis, depth: Depth) -> Value {
    let found = sweep::outcome(mechanism, analysis, depth);
    let facts = &found.facts;
    json!({
        "mechanism": mechanism.name(),
        "status": found.status.word(),
        "kutzbach": facts.kutzbach,
        "instantaneous": facts.instantaneous,
        "redundant": facts.redundant,
        "margin": facts.margin,
        "finite": facts.finite,
        "generic": facts.generic,
        "verdict": facts.verdict,
        "pose": facts.pose,
        "kind": facts.kind,
        "class": facts.class,
        "branches": facts.branches,
        "locked": facts.locked,
        "reason": found.reason,
    })
}
