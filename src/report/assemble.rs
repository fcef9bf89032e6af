//! From a mechanism to a report.
//!
//! Counting and the tables of joints and couplings need the mechanism alone and are filled in here. What an analysis finds
//! is laid over them; what it does not reach stays `null`.

use super::natural::natural_order;
use super::schema::{
    Assembly, CouplingRow, Home, JointRow, Mobility, Report, SCHEMA, Size, Source,
};
use super::vocabulary::Verdict;
use crate::mechanism::{Coupling, Mechanism};
use thiserror::Error;

/// The name of the pose with all joint variables zero.
const HOME: &str = "home";

/// What is reported on.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The file as the caller named it.
    pub file: &'a str,
    /// The file's format, such as `urdf`.
    pub format: &'a str,
    /// What its reader wants to be known.
    pub warnings: &'a [String],
}

/// What to report.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The configuration to analyse; `None` is the home pose.
    pub configuration: Option<String>,
    /// Whether to say how long the stages took.
    pub timing: bool,
}

/// Why there is no report.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ReportError {
    /// The mechanism has no configuration of that name.
    #[error("there is no configuration `{name}` in `{mechanism}`")]
    UnknownConfiguration {
        /// The name asked for.
        name: String,
        /// The mechanism.
        mechanism: String,
        /// Those it has.
        known: Vec<String>,
    },
}

impl ReportError {
    /// How to mend it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::UnknownConfiguration { known, .. } if known.is_empty() => {
                "the file names none; without `--at` the home pose is analysed".to_owned()
            }
            Self::UnknownConfiguration { known, .. } => {
                format!("it has: home, {}", known.join(", "))
            }
        }
    }
}

/// The report on a mechanism.
///
/// # Errors
/// [`ReportError`] where the options ask for what the mechanism does not have.
pub fn report(input: &Input<'_>, options: &Options) -> Result<Report, ReportError> {
    let mechanism = input.mechanism;
    let configuration = match options.configuration.as_deref() {
        Some(name) if name != HOME && mechanism.configuration(name).is_none() => {
            return Err(ReportError::UnknownConfiguration {
                name: name.to_owned(),
                mechanism: mechanism.name().to_owned(),
                known: mechanism
                    .configurations()
                    .iter()
                    .map(|c| c.name.clone())
                    .collect(),
            });
        }
        Some(name) => name,
        None => HOME,
    };
    Ok(counted(input, configuration))
}

/// Kutzbach's count: 6 (links − 1) − Σ (6 − freedom) − couplings (D2).
///
/// Linear in the number of joints. Links that no joint reaches count with six freedoms.
#[must_use]
pub fn kutzbach_count(mechanism: &Mechanism) -> i64 {
    let links = signed(mechanism.links().len());
    let removed: i64 = mechanism
        .joints()
        .iter()
        .map(|joint| 6 - signed(joint.freedom()))
        .sum();
    6 * (links - 1) - removed - signed(mechanism.couplings().len())
}

/// A report that holds what counting alone tells.
fn counted(input: &Input<'_>, configuration: &str) -> Report {
    let mechanism = input.mechanism;
    let size = Size {
        links: mechanism.links().len(),
        joints: mechanism.joints().len(),
        loops: mechanism.joints().len() + connected_parts(mechanism) - mechanism.links().len(),
        couplings: mechanism.couplings().len(),
        freedoms: mechanism.freedom(),
    };
    let precision = mechanism.precision();
    Report {
        schema: SCHEMA.to_owned(),
        mechanism: mechanism.name().to_owned(),
        source: Source {
            file: input.file.to_owned(),
            format: input.format.to_owned(),
            digits: precision.decimals,
            exact: precision.is_exact(),
        },
        kutzbach: kutzbach_count(mechanism),
        generic: None,
        assembly: Assembly {
            closed: None,
            residual: None,
            moved: None,
            tolerance: None,
            gaps: Vec::new(),
        },
        home: Home {
            configuration: configuration.to_owned(),
            pose: None,
            kind: None,
            instantaneous: None,
            // No equation leaves fewer freedoms than the count, and none more than all joints have together.
            candidates: [
                usize::try_from(kutzbach_count(mechanism)).unwrap_or(0),
                size.freedoms + 6 * (connected_parts(mechanism) - 1),
            ],
            as_written: None,
            redundant: None,
            rank: None,
            equations: 6 * size.loops + size.couplings,
            unknowns: size.freedoms,
            gap: None,
            kept: None,
            dropped: None,
            tolerance: None,
            accuracy: None,
            method: String::new(),
            bits: None,
            blocks: Vec::new(),
            note: None,
        },
        mobility: Mobility {
            verdict: Verdict::Undecided,
            finite: None,
            bounds: [None, None],
            complex_dimension: None,
            class: None,
            certificate: None,
            nominal: None,
            why: Vec::new(),
        },
        branches: None,
        joints: joint_rows(mechanism),
        couplings: coupling_rows(mechanism),
        cycles: Vec::new(),
        tree: None,
        motions: Vec::new(),
        advice: Vec::new(),
        warnings: input.warnings.to_vec(),
        timing: None,
        size,
    }
}

fn joint_rows(mechanism: &Mechanism) -> Vec<JointRow> {
    let mut rows: Vec<JointRow> = mechanism
        .joints()
        .iter()
        .map(|joint| JointRow {
            name: joint.name.clone(),
            class: joint.kind.class().to_owned(),
            kind: joint.kind.word().to_owned(),
            links: [
                mechanism.link(joint.predecessor.link).name.clone(),
                mechanism.link(joint.successor.link).name.clone(),
            ],
            freedom: joint.freedom(),
            locked: None,
            locked_parts: Vec::new(),
            redundant_wrenches: None,
            closes_loop: joint.closes_loop,
        })
        .collect();
    rows.sort_by(|a, b| natural_order(&a.name, &b.name));
    rows
}

fn coupling_rows(mechanism: &Mechanism) -> Vec<CouplingRow> {
    let mut rows: Vec<CouplingRow> = mechanism
        .couplings()
        .iter()
        .map(|coupling| CouplingRow {
            name: coupling.name.clone(),
            text: equation(mechanism, coupling),
        })
        .collect();
    rows.sort_by(|a, b| natural_order(&a.name, &b.name));
    rows
}

/// A coupling as an equation, `2 a − b = 0.5`; numbers as the file wrote them.
fn equation(mechanism: &Mechanism, coupling: &Coupling) -> String {
    let mut text = String::new();
    for (index, term) in coupling.terms.iter().enumerate() {
        let negative = term.factor.value() < 0.0;
        let factor = if negative {
            (-&term.factor).source()
        } else {
            term.factor.source()
        };
        text.push_str(match (index, negative) {
            (0, false) => "",
            (0, true) => "−",
            (_, false) => " + ",
            (_, true) => " − ",
        });
        if factor != "1" {
            text.push_str(&factor);
            text.push(' ');
        }
        text.push_str(&mechanism.joint(term.joint).name);
    }
    text.push_str(" = ");
    text.push_str(&coupling.offset.source());
    text
}

/// The number of connected parts of the links under the joints.
fn connected_parts(mechanism: &Mechanism) -> usize {
    let mut parent: Vec<usize> = (0..mechanism.links().len()).collect();
    let mut parts = parent.len();
    for joint in mechanism.joints() {
        let a = root(&mut parent, joint.predecessor.link.0);
        let b = root(&mut parent, joint.successor.link.0);
        if a != b {
            parent[a] = b;
            parts -= 1;
        }
    }
    parts
}

/// The representative of a link's part; halves the path on the way, so that all look-ups together are near linear.
fn root(parent: &mut [usize], mut node: usize) -> usize {
    while parent[node] != node {
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    node
}

/// Counts fit easily: a mechanism of 2⁶³ joints does not fit into memory.
fn signed(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}
