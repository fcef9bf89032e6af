//! A mechanism that was read, and all that is asked of it.

use crate::asked::{self, Read};
use crate::description::description;
use crate::failure::Failure;
use crate::motion::Traced;
use crate::report::{self, Analysed};
use crate::sweep::Sweep;
use crate::watched::watched;
use crate::{motion, proofs, simulation, sweep};
use kutzbach::format::{self, FormatError, ReadOptions, file_bytes, read_bytes_of, write};
use kutzbach::mechanism::Mechanism;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

/// A file or a text, and how it is read.
#[derive(Clone, Debug)]
pub struct Source {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// What errors and reports call it.
    pub file: String,
    /// Its path, beside which included files are looked for; none of a text.
    pub base: Option<PathBuf>,
    /// How it is read.
    pub options: ReadOptions,
}

impl Source {
    /// Reads it, with some of its measures left open.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn read(&self, symbolic: &[String]) -> Result<format::Reading, FormatError> {
        let options = ReadOptions {
            symbolic: symbolic.to_vec(),
            ..self.options.clone()
        };
        read_bytes_of(&self.bytes, &self.file, self.base.as_deref(), &options)
    }
}

/// What was read, shared by all that is asked of it.
#[derive(Clone, Debug)]
pub struct Subject {
    /// From what.
    pub source: Arc<Source>,
    /// What it says.
    pub reading: Arc<format::Reading>,
}

impl Subject {
    fn read(source: Source) -> Result<Self, Failure> {
        let reading = source.read(&[])?;
        Ok(Self {
            source: Arc::new(source),
            reading: Arc::new(reading),
        })
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &Mechanism {
        &self.reading.mechanism
    }

    /// A message about it, with its name before it, as the command line has it.
    pub fn failed(&self, message: &str, help: Option<String>) -> Failure {
        Failure::Plain {
            message: format!("{}: {message}", self.source.file),
            help,
        }
    }
}

/// A mechanism that was read. Questions are JSON objects, answers JSON texts.
#[pyclass(frozen, module = "kutzbach._kutzbach")]
pub struct Reading(Subject);

/// Reads a file.
#[pyfunction]
#[pyo3(signature = (path, asked))]
pub fn read_file(py: Python<'_>, path: PathBuf, asked: &str) -> PyResult<Reading> {
    let asked = asked.to_owned();
    watched(py, move |_| {
        let options = asked::parsed::<Read>(&asked)?.options();
        let source = Source {
            bytes: file_bytes(&path).map_err(Failure::of_unread)?,
            file: path.display().to_string(),
            base: Some(path),
            options,
        };
        Subject::read(source).map(Reading)
    })
}

/// Reads a text that errors call `name`.
#[pyfunction]
#[pyo3(signature = (text, name, asked))]
pub fn read_text(py: Python<'_>, text: String, name: String, asked: &str) -> PyResult<Reading> {
    let asked = asked.to_owned();
    watched(py, move |_| {
        let options = asked::parsed::<Read>(&asked)?.options();
        let source = Source {
            bytes: text.into_bytes(),
            file: name,
            base: None,
            options,
        };
        Subject::read(source).map(Reading)
    })
}

#[pymethods]
impl Reading {
    /// What the file says.
    fn description(&self) -> String {
        let source = &self.0.source;
        description(&self.0.reading, &source.bytes, &source.file).to_string()
    }

    /// The mechanism in the native format.
    fn native(&self) -> String {
        write(self.0.mechanism())
    }

    /// The report.
    #[pyo3(signature = (asked))]
    fn analyse(&self, py: Python<'_>, asked: &str) -> PyResult<Analysed> {
        let (subject, asked) = (self.0.clone(), asked.to_owned());
        watched(py, move |_| report::analysed(&subject, &asked))
    }

    /// The answer of a lesser depth: what a row of a sweep says.
    #[pyo3(signature = (asked))]
    fn facts(&self, py: Python<'_>, asked: &str) -> PyResult<String> {
        let (subject, asked) = (self.0.clone(), asked.to_owned());
        watched(py, move |_| report::facts(&subject, &asked))
    }

    /// The report as a page that moves.
    #[pyo3(signature = (asked))]
    fn page(&self, py: Python<'_>, asked: &str) -> PyResult<String> {
        let (subject, asked) = (self.0.clone(), asked.to_owned());
        watched(py, move |_| report::page(&subject, &asked))
    }

    /// A branch followed.
    #[pyo3(signature = (asked))]
    fn trace(&self, py: Python<'_>, asked: &str) -> PyResult<Traced> {
        let (subject, asked) = (self.0.clone(), asked.to_owned());
        watched(py, move |_| motion::traced(&subject, &asked))
    }

    /// All configurations.
    #[pyo3(signature = (asked))]
    fn assemble(&self, py: Python<'_>, asked: &str) -> PyResult<String> {
        let (subject, asked) = (self.0.clone(), asked.to_owned());
        watched(py, move |_| proofs::assembled(&subject, &asked))
    }

    /// What polynomials prove.
    #[pyo3(signature = (asked))]
    fn exact(&self, py: Python<'_>, asked: &str) -> PyResult<String> {
        let (subject, asked) = (self.0.clone(), asked.to_owned());
        watched(py, move |_| proofs::exact(&subject, &asked))
    }

    /// What the physics engine says.
    #[pyo3(signature = (asked))]
    fn simulate(&self, py: Python<'_>, asked: &str) -> PyResult<String> {
        let (subject, asked) = (self.0.clone(), asked.to_owned());
        watched(py, move |_| simulation::simulated(&subject, &asked))
    }

    /// Many variants.
    #[pyo3(signature = (asked))]
    fn sweep(&self, py: Python<'_>, asked: &str) -> PyResult<Sweep> {
        let (subject, asked) = (self.0.clone(), asked.to_owned());
        watched(py, move |_| sweep::planned(&subject, &asked))
    }
}
