//! How questions are written: JSON objects, all of whose fields may be left out.

use crate::failure::Failure;
use kutzbach::format::ReadOptions;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Depth, ExactBudget};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::path::PathBuf;

/// The configuration as drawn.
pub const HOME: &str = "home";

/// Memory that exact algebra may fill, as the command line has it (bytes).
const MEMORY: u64 = 2_000_000_000;

/// How a file is read.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Read {
    /// Names and values of measures.
    pub settings: Vec<(String, String)>,
    /// Take decimals as written.
    pub literal: bool,
    /// How well decimals are known (m, rad).
    pub precision: Option<f64>,
    /// ROS packages by name.
    pub packages: Vec<(String, PathBuf)>,
    /// What would be skipped is a fault.
    pub strict: bool,
}

impl Read {
    /// The same for the reader.
    pub fn options(self) -> ReadOptions {
        ReadOptions {
            settings: self.settings,
            literal: self.literal,
            precision: self.precision,
            packages: self.packages,
            strict: self.strict,
            ..ReadOptions::default()
        }
    }
}

/// What is asked of an analysis.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Analyse {
    /// `rank`, `verdict`, `motions` or `everything`.
    pub depth: Option<String>,
    /// A configuration of the file.
    pub configuration: Option<String>,
    /// Gap up to which loops count as closed (m).
    pub closure_tolerance: Option<f64>,
    /// Work for exact proofs (s).
    pub exact: Option<f64>,
    /// Joints that count as inputs.
    pub inputs: Vec<String>,
    /// Pairs of links: how does the first move, seen from the second?
    pub between: Vec<(String, String)>,
    /// Tell what every engine found.
    pub evidence: bool,
}

impl Analyse {
    /// How much is asked.
    ///
    /// # Errors
    /// A word that names no depth.
    pub fn depth(&self) -> Result<Depth, Failure> {
        match self.depth.as_deref() {
            Some("rank") => Ok(Depth::Rank),
            Some("verdict") => Ok(Depth::Verdict),
            Some("motions") => Ok(Depth::Motions),
            Some("everything") | None => Ok(Depth::Everything),
            Some(other) => Err(Failure::plain(
                format!("there is no depth `{other}`"),
                "depths are `rank`, `verdict`, `motions` and `everything`",
            )),
        }
    }

    /// How much work exact algebra may do.
    pub fn budget(&self) -> ExactBudget {
        self.exact
            .map_or_else(ExactBudget::default, ExactBudget::seconds)
            .within(MEMORY)
    }
}

/// Which branch, and how it is followed.
#[derive(Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Follow {
    /// A configuration of the file.
    pub configuration: Option<String>,
    /// Gap up to which loops count as closed (m).
    pub closure_tolerance: Option<f64>,
    /// Name of the branch.
    pub branch: Option<String>,
    /// Joint that is driven.
    pub drive: Option<String>,
    /// Values wanted of it (rad, m).
    pub range: Option<(f64, f64)>,
    /// Joints that are held.
    pub hold: Vec<String>,
    /// Number of poses.
    pub samples: usize,
    /// How well loops of poses have to close.
    pub tolerance: f64,
}

impl Default for Follow {
    fn default() -> Self {
        Self {
            configuration: None,
            closure_tolerance: None,
            branch: None,
            drive: None,
            range: None,
            hold: Vec::new(),
            samples: 100,
            tolerance: 0.0,
        }
    }
}

/// Which configurations are looked for.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Assemble {
    /// Joints to hold and their values (rad, m); a set of inputs, where they are drawn, if there are none.
    pub hold: Option<Vec<(String, String)>>,
    /// Work, in seconds of a usual machine.
    pub budget: Option<f64>,
}

/// What is to be proved.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Prove {
    /// A configuration of the file.
    pub configuration: Option<String>,
    /// Work, in seconds of a usual machine.
    pub budget: Option<f64>,
}

/// What is simulated.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Simulate {
    /// A configuration of the file.
    pub configuration: Option<String>,
    /// Gap up to which loops count as closed (m).
    pub closure_tolerance: Option<f64>,
    /// Only this branch.
    pub branch: Option<String>,
    /// Joint that is driven.
    pub drive: Option<String>,
    /// Seed of the blows that count freedoms.
    pub seed: Option<u64>,
    /// Work on the verification, in seconds of a usual machine.
    pub budget: Option<f64>,
    /// Simulated seconds of the file's scene.
    pub duration: Option<f64>,
}

/// Which variants, and what is asked of each.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Vary {
    /// Measures and their values, each as `name=values`.
    pub over: Vec<String>,
    /// `sobol:N` or `random:N`.
    pub sample: Option<String>,
    /// `i/n`.
    pub shard: Option<String>,
    /// `rank`, `verdict`, `motions` or `everything`.
    pub depth: Option<String>,
    /// A configuration of the file.
    pub configuration: Option<String>,
    /// Gap up to which loops count as closed (m).
    pub closure_tolerance: Option<f64>,
}

/// Reads a question.
///
/// # Errors
/// Where it is none; the package writes them, so that this is a slip of somebody who does not use it.
pub fn parsed<T: DeserializeOwned>(text: &str) -> Result<T, Failure> {
    serde_json::from_str(text)
        .map_err(|error| Failure::plain(error.to_string(), "use the functions of `kutzbach`"))
}

/// A configuration to look up: none for the pose drawn.
pub fn named(configuration: Option<String>) -> Option<String> {
    configuration.filter(|name| name != HOME)
}

/// The same where a file may give values to the pose drawn, as reports and sweeps take it.
pub fn named_in(mechanism: &Mechanism, configuration: Option<String>) -> Option<String> {
    let name = configuration.unwrap_or_else(|| HOME.to_owned());
    (name != HOME || mechanism.configuration(HOME).is_some()).then_some(name)
}
