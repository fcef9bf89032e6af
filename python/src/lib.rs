//! The extension module of the Python package `kutzbach`.
//!
//! Questions come as JSON, answers go as JSON and arrays as bytes; the package's own Python makes classes and arrays of them.
//! Whatever may take long runs in a thread of its own, with the interpreter free for others and Ctrl-C looked at.
//!
//! | file | what it answers |
//! |---|---|
//! | `reading` | a mechanism that was read, and all that is asked of it |
//! | `description` | what the file says, number by number |
//! | `report` | the report, and the answer of lesser depths |
//! | `motion` | a traced branch |
//! | `proofs` | all configurations; what polynomials prove |
//! | `simulation` | what the physics engine says |
//! | `sweep` | many variants |
//! | `asked` | how questions are written |
//! | `failure` | what Python is told where there is no answer |
//! | `watched` | work that Ctrl-C ends |

mod asked;
mod description;
mod failure;
mod motion;
mod proofs;
mod reading;
mod report;
mod simulation;
mod sweep;
mod watched;

use pyo3::prelude::*;

/// The compiled part of `kutzbach`; use the package.
#[pymodule]
fn _kutzbach(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<reading::Reading>()?;
    module.add_class::<report::Analysed>()?;
    module.add_class::<motion::Traced>()?;
    module.add_class::<sweep::Sweep>()?;
    module.add_function(wrap_pyfunction!(reading::read_file, module)?)?;
    module.add_function(wrap_pyfunction!(reading::read_text, module)?)?;
    module.add_function(wrap_pyfunction!(report::explain, module)?)?;
    Ok(())
}
