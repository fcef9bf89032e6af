//! What Python is told where there is no answer.

use kutzbach::format::FormatError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::any::Any;

/// Why there is no answer.
#[derive(Debug)]
pub enum Failure {
    /// A file that is not a mechanism.
    File(Box<FormatError>),
    /// Anything without a place in a file.
    Plain {
        /// What was needed and what was found.
        message: String,
        /// How to mend it.
        help: Option<String>,
    },
    /// A fault of this program.
    Fault(String),
}

impl From<FormatError> for Failure {
    fn from(error: FormatError) -> Self {
        Self::File(Box::new(error))
    }
}

impl From<Box<FormatError>> for Failure {
    fn from(error: Box<FormatError>) -> Self {
        Self::File(error)
    }
}

impl From<serde_json::Error> for Failure {
    /// Answers always have a JSON form.
    fn from(error: serde_json::Error) -> Self {
        Self::Fault(error.to_string())
    }
}

/// One fault as Python's `MechanismError` takes it: message, help, file, line and column.
type Told = (
    String,
    Option<String>,
    Option<String>,
    Option<usize>,
    Option<usize>,
);

fn told(error: &FormatError) -> Told {
    (
        error.message.clone(),
        error.help.clone(),
        Some(error.file.clone()),
        Some(error.line),
        Some(error.column),
    )
}

impl Failure {
    /// Something without a place in a file, and how to mend it.
    pub fn plain(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Plain {
            message: message.into(),
            help: Some(help.into()),
        }
    }

    /// Of a file without a text: there is no place in it.
    pub fn of_unread(error: FormatError) -> Self {
        Self::Plain {
            message: format!("{}: {}", error.file, error.message),
            help: error.help,
        }
    }

    /// What a panic said.
    pub fn of_panic(fault: &(dyn Any + Send)) -> Self {
        let said = fault
            .downcast_ref::<&str>()
            .copied()
            .or_else(|| fault.downcast_ref::<String>().map(String::as_str));
        Self::Fault(said.unwrap_or("it says nothing").to_owned())
    }

    /// The exception.
    pub fn raised(self, py: Python<'_>) -> PyErr {
        match self.made(py) {
            Ok(exception) | Err(exception) => exception,
        }
    }

    fn made(self, py: Python<'_>) -> PyResult<PyErr> {
        let (first, others): (Told, Vec<Told>) = match self {
            Self::File(error) => (told(&error), error.others.iter().map(told).collect()),
            Self::Plain { message, help } => ((message, help, None, None, None), Vec::new()),
            Self::Fault(said) => {
                return Ok(PyRuntimeError::new_err(format!(
                    "a fault of kutzbach itself: {said}"
                )));
            }
        };
        let class = py.import("kutzbach._errors")?.getattr("MechanismError")?;
        let (message, help, file, line, column) = first;
        let exception = class.call1((message, help, file, line, column, others))?;
        Ok(PyErr::from_value(exception))
    }
}
