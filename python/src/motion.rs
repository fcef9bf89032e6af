//! A traced branch: arrays of doubles, and what is said of them.

use crate::asked::{self, Follow};
use crate::failure::Failure;
use crate::reading::Subject;
use kutzbach::mobility::{AnalysisOptions, Depth, Followed, analyse_to_follow};
use kutzbach::motion::{Sample, Trace, TraceOptions, Variable, trace};
use kutzbach::report::traced::{data, quaternion};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// A traced branch. Arrays are little-endian doubles, a row for each sample.
#[pyclass(frozen, module = "kutzbach._kutzbach")]
pub struct Traced {
    json: String,
    samples: usize,
    variables: usize,
    links: usize,
    arrays: Arrays,
}

/// What every sample says.
#[derive(Default)]
struct Arrays {
    drive: Vec<u8>,
    arclength: Vec<u8>,
    closure: Vec<u8>,
    /// All joint variables.
    values: Vec<u8>,
    /// x y z and qw qx qy qz of every link.
    poses: Vec<u8>,
}

fn push(array: &mut Vec<u8>, numbers: &[f64]) {
    for number in numbers {
        array.extend_from_slice(&number.to_le_bytes());
    }
}

impl Arrays {
    fn of(samples: &[Sample]) -> Self {
        let mut arrays = Self::default();
        for sample in samples {
            push(&mut arrays.drive, &[sample.drive]);
            push(&mut arrays.arclength, &[sample.arclength]);
            push(&mut arrays.closure, &[sample.closure]);
            push(&mut arrays.values, &sample.values);
            for pose in &sample.links {
                push(&mut arrays.poses, &pose.translation);
                push(&mut arrays.poses, &quaternion(pose));
            }
        }
        arrays
    }
}

#[pymethods]
impl Traced {
    /// Everything but the samples, in the form of `kutzbach trace --format json`.
    fn json(&self) -> &str {
        &self.json
    }

    /// How many samples, joint variables and links there are.
    fn shape(&self) -> (usize, usize, usize) {
        (self.samples, self.variables, self.links)
    }

    /// One of the arrays: `drive`, `arclength`, `closure`, `values` or `poses`.
    #[pyo3(signature = (name))]
    fn array<'py>(&self, py: Python<'py>, name: &str) -> Option<Bound<'py, PyBytes>> {
        let array = match name {
            "drive" => &self.arrays.drive,
            "arclength" => &self.arrays.arclength,
            "closure" => &self.arrays.closure,
            "values" => &self.arrays.values,
            "poses" => &self.arrays.poses,
            _ => return None,
        };
        Some(PyBytes::new(py, array))
    }
}

/// Follows a branch as `kutzbach trace` does.
///
/// # Errors
/// A configuration, branch or joint that there is not; what is held or wanted and cannot be.
pub fn traced(subject: &Subject, asked: &str) -> Result<Traced, Failure> {
    let asked: Follow = asked::parsed(asked)?;
    let configuration = asked::named(asked.configuration);
    let Followed {
        mechanism,
        analysis,
        changed,
    } = analyse_to_follow(
        subject.mechanism(),
        &AnalysisOptions {
            configuration: configuration.clone(),
            depth: Depth::Motions,
            closure_tolerance: asked.closure_tolerance,
            ..AnalysisOptions::default()
        },
    )
    .map_err(|error| subject.failed(&error.to_string(), None))?;
    let options = TraceOptions {
        branch: asked.branch,
        drive: asked.drive,
        range: asked.range,
        hold: asked.hold,
        samples: asked.samples,
        tolerance: asked.tolerance,
        configuration,
        ..TraceOptions::default()
    };
    let mut found = trace(&mechanism, &analysis, &options)
        .map_err(|error| subject.failed(&error.to_string(), Some(error.help())))?;
    // As arrays they take a tenth of what they take as text.
    let samples = match &mut found {
        Trace::Still(_) => Vec::new(),
        Trace::Moving(motion) => std::mem::take(&mut motion.samples),
    };
    let value = data(&mechanism, changed, &found, &[]);
    Ok(Traced {
        json: value.to_string(),
        samples: samples.len(),
        variables: Variable::all(&mechanism).len(),
        links: mechanism.links().len(),
        arrays: Arrays::of(&samples),
    })
}
