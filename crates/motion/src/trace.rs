//! From an analysis to the motion along one of its branches.

mod answer;
mod choice;
mod driven;
mod one_curve;
mod start;

pub use driven::{InputSource, Inputs, inputs};

use super::curve::Curve;
use super::dead_centres::DeadCentre;
use super::follow::Stop;
use super::inputs::Variable;
use super::requested::{RequestedVariables, requested_variables};
use super::result::{Still, Trace, TraceError, TraceOptions};
use super::shown::Hidden;
use super::singular::Singular;
use super::system::SystemPose;
use kutzbach_closure::{Geometry, Part};
use kutzbach_mobility::{Analysis, Branch, Tangent, Verdict};
use kutzbach_model::mechanism::Mechanism;
use std::sync::Arc;

/// Poses of a mechanism written exactly are closed to this (rad, cycle lengths).
const CLOSED: f64 = 1e-12;

/// A default driven input is looked for among so many.
const CANDIDATES: usize = 6;

/// Kernels are computed anew up to this many unknowns.
const KERNEL_UNKNOWNS: usize = 150;

/// Follows a branch of a mechanism as a curve. See the [module](super).
///
/// # Errors
/// [`TraceError`] where the options ask for what the mechanism does not have. That nothing moves is an answer.
pub fn trace(
    mechanism: &Mechanism,
    analysis: &Analysis,
    options: &TraceOptions,
) -> Result<Trace, TraceError> {
    if !(2..=10_000_000).contains(&options.samples) {
        return Err(TraceError::Samples {
            samples: options.samples,
        });
    }
    if !(options.reach > 0.0 && options.reach.is_finite()) {
        return Err(TraceError::Reach {
            reach: options.reach,
        });
    }
    if !(options.tolerance >= 0.0 && options.tolerance.is_finite()) {
        return Err(TraceError::Tolerance {
            tolerance: options.tolerance,
        });
    }
    if let Some((from, to)) = options.range
        && !(from.is_finite() && to.is_finite())
    {
        return Err(TraceError::Range { from, to });
    }
    let requested = requested_variables(mechanism, options)?;
    let still = |reason: &str| {
        Ok(Trace::Still(Still {
            reason: reason.to_owned(),
            branch: None,
        }))
    };
    match analysis.mobility.verdict {
        Verdict::Unassembled => return still("no closed pose is known to begin at"),
        Verdict::Rigid => {
            return still("nothing moves: the mechanism is rigid (0 degrees of freedom)");
        }
        Verdict::Undecided | Verdict::Mobile => {}
    }
    let Some(branches) = &analysis.branches else {
        return still("nothing is traced: how the mechanism moves is not decided");
    };
    let branch = match &options.branch {
        None => branches.first(),
        Some(name) => Some(branches.iter().find(|b| b.name == *name).ok_or_else(|| {
            let known: Vec<String> = branches.iter().map(|b| format!("`{}`", b.name)).collect();
            TraceError::UnknownBranch {
                name: name.clone(),
                known: known.join(", "),
            }
        })?),
    };
    let Some(branch) = branch else {
        return still("nothing moves: no branch through this pose has a degree of freedom");
    };
    let tracer = Tracer::new(mechanism, analysis, branch, options);
    tracer.run(branches, &requested, options)
}

/// One part with its branch, ready to be followed.
pub(super) struct Stage {
    pub part: Part,
    /// Index in the structure; `None` for a joint that is free.
    pub index: Option<usize>,
    /// Dimension of the branch in this part.
    pub dimension: usize,
}

struct Tracer<'a> {
    mechanism: &'a Mechanism,
    analysis: &'a Analysis,
    branch: &'a Branch,
    geometry: Arc<Geometry<f64>>,
    stages: Vec<Stage>,
    /// How far, and for how many poses each way, curves are followed.
    limits: (f64, usize),
}

/// Everything found about one curve.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub curve: Curve,
    pub start: usize,
    pub stops: [Stop; 2],
    pub singular: Vec<(f64, Singular)>,
    pub dead: Vec<DeadCentre>,
    pub holds: Vec<usize>,
    pub starts_at_home: bool,
    pub home: SystemPose,
    pub notes: Vec<String>,
}

impl<'a> Tracer<'a> {
    fn new(
        mechanism: &'a Mechanism,
        analysis: &'a Analysis,
        branch: &'a Branch,
        options: &TraceOptions,
    ) -> Self {
        let geometry = Arc::clone(&analysis.geometry);
        let offsets = mechanism.variable_offsets();
        let moves = |part: &Part, tangent: &Tangent| {
            let mut variables = part.joints.iter().flat_map(|&j| offsets[j]..offsets[j + 1]);
            variables.any(|variable| tangent[variable] != 0.0)
        };
        let mut stages: Vec<Stage> = Vec::new();
        for (index, part) in analysis.structure.parts.iter().enumerate() {
            let dimension = match branch.poses.first() {
                Some(pose) => pose.tangents.iter().filter(|t| moves(part, t)).count(),
                None => analysis.findings.get(index).map_or(0, |f| f.upper()),
            };
            stages.push(Stage {
                part: part.clone(),
                index: Some(index),
                dimension,
            });
        }
        for &joint in &analysis.structure.free_joints {
            stages.push(Stage {
                part: Part {
                    joints: vec![joint],
                    ..Part::default()
                },
                index: None,
                dimension: mechanism.joints()[joint].freedom(),
            });
        }
        stages.retain(|s| s.dimension > 0);
        stages.sort_by_key(|s| {
            s.part
                .joints
                .iter()
                .map(|&j| mechanism.joints()[j].name.clone())
                .min()
        });
        Self {
            mechanism,
            analysis,
            branch,
            geometry,
            stages,
            limits: (options.reach, options.poses),
        }
    }

    fn stage_of(&self, joint: usize) -> Option<&Stage> {
        self.stages.iter().find(|s| s.part.joints.contains(&joint))
    }

    fn run(
        &self,
        branches: &[Branch],
        requested: &RequestedVariables,
        options: &TraceOptions,
    ) -> Result<Trace, TraceError> {
        let mut notes = Vec::new();
        if options.branch.is_none() && branches.len() > 1 {
            let others: Vec<&str> = branches[1..].iter().map(|b| b.name.as_str()).collect();
            notes.push(format!(
                "branch {} of {}; {} with --branch",
                self.branch.name,
                branches.len(),
                others.join(", ")
            ));
        }
        let still = |reason: String| {
            Ok(Trace::Still(Still {
                reason,
                branch: Some(self.branch.name.clone()),
            }))
        };
        let inputs = self.inputs_for(requested, options);
        // What is driven: as asked, as the scene has it, or the input that serves best.
        let scene = self
            .mechanism
            .scene()
            .and_then(|s| s.drives.first())
            .map(|d| Variable::of(self.mechanism, d.joint.0, 0));
        let asked = requested.drive.clone().or_else(|| {
            scene.filter(|v| {
                !requested.hold.contains(v)
                    && self.locked(v) == Some(false)
                    && self.stage_of(v.joint).is_some()
            })
        });
        if let Some(drive) = &asked
            && (self.stage_of(drive.joint).is_none() || self.locked(drive) == Some(true))
        {
            return still(format!(
                "nothing moves: `{}` does not move on branch {}",
                drive.name, self.branch.name
            ));
        }
        let found = match &asked {
            Some(drive) => self.curve_driven_by(drive, (&requested.hold, &inputs))?,
            None => self.best_curve(&requested.hold, &inputs)?,
        };
        let Some((found, drive)) = found else {
            return still(format!(
                "branch {} cannot be followed: what is held and driven does not determine the motion at the start",
                self.branch.name
            ));
        };
        if asked.is_none() && inputs.is_empty() {
            notes.push(format!(
                "which joints suffice as inputs is not decided; `{}` is driven, which goes farthest",
                drive.name
            ));
        }
        notes.extend(self.held_beside(&found, &inputs, &requested.hold));
        notes.extend(found.notes.iter().cloned());
        Ok(Trace::Moving(Box::new(
            self.motion(found, drive, branches, notes, options),
        )))
    }

    fn hidden(&self) -> Hidden {
        Hidden::new(self.mechanism, &self.geometry, self.branch)
    }

    /// The inputs, where it matters what they are: something is driven without being asked for, or something is held.
    fn inputs_for(&self, requested: &RequestedVariables, options: &TraceOptions) -> Vec<Variable> {
        let drive = requested.drive.as_ref();
        let stage = drive.and_then(|drive| self.stage_of(drive.joint));
        if drive.is_some() && stage.is_none_or(|stage| stage.dimension < 2) {
            return Vec::new();
        }
        let configuration = options.configuration.as_deref();
        let (mechanism, analysis) = (self.mechanism, self.analysis);
        let found = inputs(mechanism, analysis, self.branch, configuration, Vec::new());
        found.variables(mechanism)
    }

    /// What is held although it is no input and nobody asked for it: what the inputs leave free, such as idle motion, or what stands in
    /// for one that fixes nothing at the start.
    fn held_beside(
        &self,
        found: &Found,
        inputs: &[Variable],
        asked: &[Variable],
    ) -> Option<String> {
        let variables = found.curve.solver.system.variables();
        let held = found.holds.iter().map(|&unknown| {
            let (joint, freedom) = variables[unknown];
            Variable::of(self.mechanism, joint, freedom)
        });
        let beside = held.filter(|held| !inputs.contains(held) && !asked.contains(held));
        let names: Vec<String> = beside.map(|held| format!("`{}`", held.name)).collect();
        (!names.is_empty() && !inputs.is_empty()).then(|| {
            format!(
                "held beside the inputs, which leave more free at the start: {}",
                names.join(", ")
            )
        })
    }

    /// Whether a variable rests on the branch.
    fn locked(&self, variable: &Variable) -> Option<bool> {
        let role = self.branch.roles.get(variable.joint)?;
        match role.locked {
            Some(false) => Some(role.locked_parts.contains(&variable.name)),
            other => other,
        }
    }
}
