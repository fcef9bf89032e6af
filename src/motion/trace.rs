//! From an analysis to the motion along one of its branches.

use super::curve::{Curve, CurvePose, WholeFrame};
use super::dead_centres::{DeadCentre, LOCKED, dead_centres};
use super::follow::{Bounds, Node, SAME, Stop, follow, node_at};
use super::inputs::{Variable, choose_inputs};
use super::ranges::ranges;
use super::result::{
    End, EndReason, Event, EventKind, Held, Motion, Still, Trace, TraceError, TraceOptions,
};
use super::sampling::sample;
use super::singular::Singular;
use super::solver::Solver;
use super::system::{LoopSystem, SystemPose};
use super::walk::{Walked, walk};
use super::wishes::{Wishes, read_wishes};
use crate::closure::{Arithmetic, Geometry, JointState, Part};
use crate::mechanism::Mechanism;
use crate::mobility::{Analysis, Branch, PoseKind, SingularKind, Verdict};
use nalgebra::DMatrix;
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
    if let Some((from, to)) = options.range
        && !(from.is_finite() && to.is_finite())
    {
        return Err(TraceError::Range { from, to });
    }
    let wishes = read_wishes(mechanism, options)?;
    let still = |reason: &str| {
        Ok(Trace::Still(Still {
            reason: reason.to_owned(),
            branch: None,
        }))
    };
    match analysis.mobility.verdict {
        Verdict::Unassembled => return still("nothing moves: the mechanism does not assemble"),
        Verdict::Rigid => return still("nothing moves: the mechanism is rigid (finite freedom 0)"),
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
        return still("nothing moves: no branch through this pose has a freedom");
    };
    let tracer = Tracer::new(mechanism, analysis, branch, options);
    tracer.run(branches, &wishes, options)
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
    geometry: Geometry<f64>,
    stages: Vec<Stage>,
}

/// Everything found about one curve.
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
        let configuration = options
            .configuration
            .as_deref()
            .and_then(|name| mechanism.configuration(name));
        let geometry = Geometry::new(mechanism, configuration, &Arithmetic::double());
        let offsets = mechanism.variable_offsets();
        let moves = |part: &Part, tangent: &[f64]| {
            part.joints.iter().any(|&j| {
                tangent[offsets[j]..offsets[j + 1]]
                    .iter()
                    .any(|x| *x != 0.0)
            })
        };
        let mut stages: Vec<Stage> = Vec::new();
        for (index, part) in analysis.structure.parts.iter().enumerate() {
            let dimension = match branch.poses.first() {
                Some(pose) => pose.tangents.iter().filter(|t| moves(part, t)).count(),
                None => analysis.findings.get(index).map_or(0, |f| f.upper),
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
        }
    }

    fn stage_of(&self, joint: usize) -> Option<&Stage> {
        self.stages.iter().find(|s| s.part.joints.contains(&joint))
    }

    fn run(
        &self,
        branches: &[Branch],
        wishes: &Wishes,
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
        // What is driven: as asked, as the scene has it, or what serves best.
        let scene = self
            .mechanism
            .scene()
            .and_then(|s| s.drives.first())
            .map(|d| Variable::of(self.mechanism, d.joint.0, 0));
        let asked = wishes.drive.clone().or_else(|| {
            scene.filter(|v| {
                !wishes.hold.contains(v)
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
            Some(drive) => self.curve_driven_by(drive, &wishes.hold)?,
            None => self.best_curve(&wishes.hold)?,
        };
        let Some((found, drive)) = found else {
            return still(format!(
                "branch {} cannot be followed: its equations leave more than one direction open at the start",
                self.branch.name
            ));
        };
        notes.extend(found.notes.iter().cloned());
        Ok(Trace::Moving(Box::new(
            self.motion(found, drive, branches, notes, options),
        )))
    }

    /// Whether a variable rests on the branch.
    fn locked(&self, variable: &Variable) -> Option<bool> {
        let role = self.branch.roles.get(variable.joint)?;
        match role.locked {
            Some(false) => Some(role.locked_parts.contains(&variable.name)),
            other => other,
        }
    }

    /// The states from which a part is followed, and whether they are those of the pose analysed.
    fn start(&self, stage: &Stage) -> (Vec<JointState<f64>>, bool) {
        let home = self.analysis.assembly.states.clone();
        let Some(index) = stage.index else {
            return (home, true);
        };
        let finding = &self.analysis.findings[index];
        let regular = finding.pose == Some(PoseKind::Regular)
            || finding.kind == Some(SingularKind::PermanentlyShaky)
                && finding.branches.as_ref().is_some_and(|b| b.len() == 1);
        match self.branch.poses.first() {
            Some(pose) if !regular => {
                let mut states = home;
                for &joint in &stage.part.joints {
                    states[joint] = pose.states[joint].clone();
                }
                (states, false)
            }
            _ => (home, true),
        }
    }

    /// By how many the instantaneous freedom of a part exceeds its dimension all along the branch.
    fn excess(&self, stage: &Stage) -> usize {
        let Some(index) = stage.index else { return 0 };
        let finding = &self.analysis.findings[index];
        let first = stage.part.joints.first().copied();
        let own = self.branch.poses.first().zip(first).and_then(|(pose, j)| {
            finding.branches.iter().flatten().find(|b| {
                b.poses
                    .first()
                    .and_then(|p| p.states.first())
                    .is_some_and(|s| s.values == pose.states[j].values)
                    && b.dimension == stage.dimension
            })
        });
        own.and_then(|b| b.poses.first())
            .and_then(|p| p.instantaneous)
            .map_or(0, |i| i.saturating_sub(stage.dimension))
    }

    /// The curve on which a variable moves while the wanted others are held.
    fn curve_driven_by(
        &self,
        drive: &Variable,
        hold: &[Variable],
    ) -> Result<Option<(Found, Variable)>, TraceError> {
        let Some(stage) = self.stage_of(drive.joint) else {
            return Ok(None);
        };
        let (states, at_home) = self.start(stage);
        let system = Arc::new(LoopSystem::new(
            self.mechanism,
            &self.geometry,
            &states,
            &stage.part,
        )?);
        let unknown = |v: &Variable| system.unknowns_of(v.joint).map(|r| r.start + v.freedom);
        let Some(driven) = unknown(drive) else {
            return Ok(None);
        };
        let mut first = Vec::new();
        for variable in hold {
            // Other parts stand still anyway.
            if let Some(u) = unknown(variable) {
                first.push(u);
            }
        }
        let pose = system.pose(&states);
        let tangents = self.tangents(stage, &system, &pose);
        let held_first: Vec<usize> = std::iter::once(driven)
            .chain(first.iter().copied())
            .collect();
        let (chosen, left_out) = choose_inputs(self.mechanism, &system, &tangents, &held_first);
        if let Some(&out) = left_out.first() {
            let (joint, freedom) = system.variables()[out];
            let variable = Variable::of(self.mechanism, joint, freedom);
            if out != driven {
                return Err(if first.len() >= stage.dimension {
                    TraceError::HoldsTooMuch {
                        name: variable.name,
                    }
                } else {
                    TraceError::NothingLeft {
                        drive: drive.name.clone(),
                        held: hold
                            .iter()
                            .map(|v| v.name.as_str())
                            .collect::<Vec<_>>()
                            .join(", "),
                    }
                });
            }
        }
        let holds: Vec<usize> = if chosen.first() == Some(&driven) {
            chosen[1..].to_vec()
        } else {
            // At a dead centre of the driven variable: its rate is zero at the start, and the others suffice to go on.
            let (chosen, _) = choose_inputs(self.mechanism, &system, &tangents, &first);
            chosen
                .into_iter()
                .take(stage.dimension.saturating_sub(1))
                .collect()
        };
        let found = self.follow(stage, &system, pose, at_home, holds, Some(driven))?;
        Ok(found.map(|f| (f, drive.clone())))
    }

    /// The curve that serves best where nothing is asked for: one whose driven variable goes round without dead centre, or
    /// else the one that is moved farthest.
    fn best_curve(&self, hold: &[Variable]) -> Result<Option<(Found, Variable)>, TraceError> {
        let mut candidates: Vec<Variable> = Vec::new();
        for stage in &self.stages {
            let (states, _) = self.start(stage);
            let system = LoopSystem::new(self.mechanism, &self.geometry, &states, &stage.part)?;
            let pose = system.pose(&states);
            let tangents = self.tangents(stage, &system, &pose);
            let held: Vec<usize> = hold
                .iter()
                .filter_map(|v| Some(system.unknowns_of(v.joint)?.start + v.freedom))
                .collect();
            let (chosen, _) = choose_inputs(self.mechanism, &system, &tangents, &held);
            let variables = system.variables();
            candidates.extend(chosen.iter().filter(|u| !held.contains(u)).map(|&u| {
                let (joint, freedom) = variables[u];
                Variable::of(self.mechanism, joint, freedom)
            }));
        }
        let mut best: Option<(f64, Found, Variable)> = None;
        for candidate in candidates.into_iter().take(CANDIDATES) {
            let Some((found, variable)) = self.curve_driven_by(&candidate, hold)? else {
                continue;
            };
            let single = self
                .stage_of(candidate.joint)
                .is_some_and(|s| s.dimension == 1);
            let (score, variable) = if single {
                self.best_variable(&found, hold).unwrap_or((0.0, variable))
            } else {
                (self.score(&found, &variable), variable)
            };
            if best
                .as_ref()
                .is_none_or(|(known, _, _)| score > known * (1.0 + 1e-9))
            {
                let done = score.is_infinite();
                best = Some((score, found, variable));
                if done {
                    break;
                }
            }
        }
        let Some((_, found, variable)) = best else {
            return Ok(None);
        };
        // Followed anew, so that the driven variable grows along the curve and its dead centres part the stretches.
        let again = self.curve_driven_by(&variable, hold)?;
        Ok(again.or(Some((found, variable))))
    }

    /// How well a variable serves as the driven one: infinitely where it goes round without dead centre, else its range.
    fn score(&self, found: &Found, variable: &Variable) -> f64 {
        let Some(range) = found.curve.solver.system.unknowns_of(variable.joint) else {
            return 0.0;
        };
        let unknown = range.start + variable.freedom;
        let turned = found.curve.winding()[unknown].abs();
        let turns_back = found.dead.iter().any(|d| d.unknown == unknown);
        if turned > 1.0 && !turns_back {
            return f64::INFINITY;
        }
        let values = found.curve.nodes.iter().map(|n| n.pose.values[unknown]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
            (l.min(v), h.max(v))
        });
        (high - low) * found.curve.solver.system.weights()[unknown]
    }

    fn best_variable(&self, found: &Found, hold: &[Variable]) -> Option<(f64, Variable)> {
        let system = &found.curve.solver.system;
        let mut all: Vec<(usize, Variable)> = system
            .variables()
            .into_iter()
            .enumerate()
            .map(|(u, (joint, freedom))| (u, Variable::of(self.mechanism, joint, freedom)))
            .filter(|(u, v)| system.is_scalar(*u) && !hold.contains(v))
            .collect();
        // Marked ones first, then by name; the first of equals is kept.
        all.sort_by_key(|(_, v)| {
            let joint = &self.mechanism.joints()[v.joint];
            (
                joint.independent != Some(true),
                joint.freedom() > 1,
                v.name.clone(),
            )
        });
        let mut best: Option<(f64, Variable)> = None;
        for (_, variable) in all {
            let marked = self.mechanism.joints()[variable.joint].independent == Some(true);
            let score = self.score(found, &variable);
            if score > 0.0
                && best
                    .as_ref()
                    .is_none_or(|(known, _)| score > known * (1.0 + 1e-6) && !known.is_infinite())
            {
                best = Some((score, variable));
                if marked {
                    break;
                }
            }
        }
        best
    }

    /// A basis of the tangents of the branch at the start of a part, in the metric.
    fn tangents(&self, stage: &Stage, system: &LoopSystem, pose: &SystemPose) -> Vec<Vec<f64>> {
        let n = system.unknowns();
        if self.excess(stage) == 0 && n <= KERNEL_UNKNOWNS {
            let mut evaluation = super::system::Evaluation::default();
            system.evaluate(pose, &mut evaluation);
            let mut rows = vec![0.0; system.equations() * n];
            system.fill_dense(&evaluation, &mut rows);
            let size = n.max(system.equations());
            let matrix = DMatrix::from_row_slice(system.equations(), n, &rows).resize(size, n, 0.0);
            if let Some(v) = matrix.clone().svd(false, true).v_t {
                let values = matrix.singular_values();
                let mut order: Vec<usize> = (0..n).collect();
                order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
                return order[..stage.dimension.min(n)]
                    .iter()
                    .map(|&i| v.row(i).iter().copied().collect())
                    .collect();
            }
        }
        let offsets = self.mechanism.variable_offsets();
        let Some(pose) = self.branch.poses.first() else {
            return Vec::new();
        };
        pose.tangents
            .iter()
            .map(|tangent| {
                system
                    .variables()
                    .iter()
                    .zip(system.weights())
                    .map(|((joint, freedom), w)| tangent[offsets[*joint] + freedom] * w)
                    .collect::<Vec<f64>>()
            })
            .filter(|t| t.iter().any(|x| *x != 0.0))
            .collect()
    }

    /// Largest closure that counts as closed in a part.
    fn allowed(&self, stage: &Stage) -> f64 {
        let stated = stage
            .index
            .and_then(|i| self.analysis.parts.get(i))
            .map_or(0.0, |p| p.stated);
        CLOSED.max(4.0 * stated)
    }

    fn follow(
        &self,
        stage: &Stage,
        system: &Arc<LoopSystem>,
        pose: SystemPose,
        starts_at_home: bool,
        holds: Vec<usize>,
        drive: Option<usize>,
    ) -> Result<Option<Found>, TraceError> {
        let held: Vec<(usize, f64)> = holds.iter().map(|&u| (u, pose.values[u])).collect();
        let Some(mut solver) = Solver::new(
            Arc::clone(system),
            &pose,
            held,
            self.excess(stage),
            self.allowed(stage),
        ) else {
            return Ok(None);
        };
        let toward = self.forward(&solver, drive);
        let Some(start) = node_at(&mut solver, pose, &toward, 0.0) else {
            return Ok(None);
        };
        let mut notes = Vec::new();
        let bounds = self.bounds(stage, system, &start.pose, &mut notes);
        let start = if starts_at_home {
            start
        } else {
            away_from_home(&mut solver, start, &bounds)
        };
        let walked = walk(&mut solver, &start, &bounds);
        let Walked {
            assembled,
            start: at,
            stops,
            closed,
        } = walked;
        let super::singular::Assembled {
            nodes,
            shapes,
            singular,
        } = assembled;
        let home = system.pose(&self.analysis.assembly.states);
        let mut states = self.analysis.assembly.states.clone();
        if let Some(pose) = self.branch.poses.first().filter(|_| !starts_at_home) {
            for &joint in &stage.part.joints {
                states[joint] = pose.states[joint].clone();
            }
        }
        let drive = drive.unwrap_or(0);
        let mut curve = Curve {
            solver,
            nodes,
            shapes,
            closed,
            drive,
            milestones: Vec::new(),
            frame: Arc::new(WholeFrame {
                mechanism: self.mechanism.clone(),
                geometry: self.geometry.clone(),
                states,
            }),
        };
        let dead = dead_centres(&mut curve);
        curve.milestones = milestones(&curve, &dead);
        Ok(Some(Found {
            start: at,
            stops,
            singular,
            dead,
            holds,
            starts_at_home,
            home,
            notes,
            curve,
        }))
    }

    /// Which way is forward: the driven variable grows, or the first by name that moves.
    fn forward(&self, solver: &Solver, drive: Option<usize>) -> Vec<f64> {
        let tangent = solver.tangent();
        let mut toward = vec![0.0; tangent.len()];
        if let Some(drive) = drive
            && tangent[drive].abs() > LOCKED
        {
            toward[drive] = 1.0;
            return toward;
        }
        let mut order: Vec<(String, usize)> = solver
            .system
            .variables()
            .into_iter()
            .enumerate()
            .map(|(u, (joint, freedom))| (self.mechanism.joints()[joint].freedom_name(freedom), u))
            .collect();
        order.sort();
        if let Some((_, first)) = order.iter().find(|(_, u)| tangent[*u].abs() > 1e-3) {
            toward[*first] = 1.0;
        }
        toward
    }

    /// The limits of the file that the start keeps.
    fn bounds(
        &self,
        stage: &Stage,
        system: &LoopSystem,
        start: &SystemPose,
        notes: &mut Vec<String>,
    ) -> Vec<Bounds> {
        let mut bounds = Vec::new();
        for &joint in &stage.part.joints {
            let known = &self.mechanism.joints()[joint];
            let (Some(limit), Some(range), 1) =
                (&known.limit, system.unknowns_of(joint), known.freedom())
            else {
                continue;
            };
            let unknown = range.start;
            let own = Bounds {
                unknown,
                lower: limit
                    .lower
                    .as_ref()
                    .map_or(f64::NEG_INFINITY, |n| n.value()),
                upper: limit.upper.as_ref().map_or(f64::INFINITY, |n| n.value()),
            };
            let value = start.values[unknown];
            if value < own.lower - SAME || value > own.upper + SAME || own.lower > own.upper {
                notes.push(format!(
                    "joint `{}` starts outside its limits, which are left aside",
                    known.name
                ));
            } else {
                bounds.push(own);
            }
        }
        bounds
    }

    fn motion(
        &self,
        mut found: Found,
        drive: Variable,
        branches: &[Branch],
        notes: Vec<String>,
        options: &TraceOptions,
    ) -> Motion {
        let system = Arc::clone(&found.curve.solver.system);
        let variables = system.variables();
        let variable = |u: usize| {
            let (joint, freedom) = variables[u];
            Variable::of(self.mechanism, joint, freedom)
        };
        let events = self.events(&mut found);
        let ends = if found.curve.closed {
            Vec::new()
        } else {
            let ends = [found.curve.nodes.first(), found.curve.nodes.last()];
            ends.into_iter()
                .flatten()
                .zip(&found.stops)
                .map(|(node, stop)| End {
                    arclength: node.arc,
                    drive: node.pose.values[found.curve.drive],
                    reason: match stop {
                        Stop::Limit { unknown, value } => EndReason::JointLimit {
                            variable: variable(*unknown),
                            value: *value,
                        },
                        Stop::Budget | Stop::Closed => EndReason::GoesOn,
                        Stop::Stuck => EndReason::CannotGoOn,
                    },
                })
                .collect()
        };
        let sampled = sample(&mut found.curve, options, &ends);
        let (low, high) = found.curve.arclengths();
        let start = &found.curve.nodes[found.start];
        Motion {
            branch: self.branch.name.clone(),
            dimension: self.branch.dimension,
            branches: branches.iter().map(|b| b.name.clone()).collect(),
            held: {
                let mut held: Vec<Held> = found
                    .holds
                    .iter()
                    .map(|&u| Held {
                        variable: variable(u),
                        value: start.pose.values[u],
                    })
                    .collect();
                held.sort_by(|a, b| a.variable.name.cmp(&b.variable.name));
                held
            },
            driven: drive,
            starts_at_home: found.starts_at_home,
            closed: found.curve.closed.then_some(high - low),
            ends,
            events,
            ranges: ranges(self.mechanism, &found),
            spacing: sampled.spacing,
            largest_closure: sampled.samples.iter().fold(0.0, |m, s| m.max(s.closure)),
            samples: sampled.samples,
            unreached: sampled.unreached,
            allowed_closure: found.curve.solver.allowed,
            length_unit: system.length(),
            notes,
            curve: found.curve,
        }
    }

    fn events(&self, found: &mut Found) -> Vec<Event> {
        let system = Arc::clone(&found.curve.solver.system);
        let variables = system.variables();
        let variable = |u: usize| {
            let (joint, freedom) = variables[u];
            Variable::of(self.mechanism, joint, freedom)
        };
        let mut events = Vec::new();
        let tell = |curve: &Curve, kind: EventKind, at: CurvePose| Event {
            kind,
            arclength: at.arclength,
            drive: at.pose.values[curve.drive],
            values: super::sampling::all_values(&curve.states(&at.pose)),
        };
        for dead in found.dead.clone() {
            let kind = EventKind::DeadCentre {
                variable: variable(dead.unknown),
                value: dead.value,
                greatest: dead.greatest,
            };
            if let Some(at) = found.curve.pose_at_arclength(dead.arclength) {
                events.push(tell(&found.curve, kind, at));
            }
        }
        for (arc, singular) in &found.singular {
            let beside = self
                .stages
                .iter()
                .find(|s| s.part.joints.contains(&variables[0].0))
                .map_or(1, |s| s.dimension + self.excess(s));
            let home = system.separation(&singular.pose, &found.home) < 10.0 * SAME;
            let kind = if singular.cusp {
                EventKind::Cusp { home }
            } else {
                EventKind::Singular {
                    freedom: singular.freedom,
                    excess: singular.freedom.saturating_sub(beside),
                    crosses: singular.crosses,
                    home,
                }
            };
            let at = CurvePose {
                arclength: *arc,
                pose: singular.pose.clone(),
                closure: 0.0,
            };
            events.push(tell(&found.curve, kind, at));
        }
        for (index, stop) in found.stops.iter().enumerate() {
            let node = if index == 0 {
                found.curve.nodes.first()
            } else {
                found.curve.nodes.last()
            };
            if let (Stop::Limit { unknown, value }, Some(node), false) =
                (stop, node, found.curve.closed)
            {
                let at = CurvePose {
                    arclength: node.arc,
                    pose: node.pose.clone(),
                    closure: 0.0,
                };
                let kind = EventKind::JointLimit {
                    variable: variable(*unknown),
                    value: *value,
                };
                events.push(tell(&found.curve, kind, at));
            }
        }
        let rank = |e: &Event| match &e.kind {
            EventKind::DeadCentre { variable, .. } => (0, variable.name.clone()),
            EventKind::Singular { .. } => (1, String::new()),
            EventKind::Cusp { .. } => (2, String::new()),
            EventKind::JointLimit { variable, .. } => (3, variable.name.clone()),
        };
        // Events at one place, as far as rounding tells, are told by kind and name.
        events.sort_by(|a, b| a.arclength.total_cmp(&b.arclength));
        let mut first = 0;
        while first < events.len() {
            let mut last = first;
            while last + 1 < events.len()
                && events[last + 1].arclength - events[last].arclength < 1e-8
            {
                last += 1;
            }
            events[first..=last].sort_by_cached_key(rank);
            first = last + 1;
        }
        events
    }
}

/// A generic pose of a branch may still be close to the singular pose at home: the most regular one on a stretch of the
/// curve around it serves better as the start.
fn away_from_home(solver: &mut Solver, start: Node, bounds: &[Bounds]) -> Node {
    let mut best = start.clone();
    let mut back = start.clone();
    back.tangent.iter_mut().for_each(|t| *t = -*t);
    for (from, sign) in [(&start, 1.0), (&back, -1.0)] {
        for node in follow(solver, from, from, bounds).0 {
            if node.arc < SEARCHED && node.margin > best.margin * (1.0 + 1e-6) {
                best = node;
                best.tangent.iter_mut().for_each(|t| *t *= sign);
            }
        }
    }
    best.arc = 0.0;
    best
}

/// How far along the curve (metric) a better start is looked for.
const SEARCHED: f64 = 4.0;

/// The driven variable at every node and dead centre of its own.
fn milestones(curve: &Curve, dead: &[DeadCentre]) -> Vec<(f64, f64)> {
    let mut all: Vec<(f64, f64)> = curve
        .nodes
        .iter()
        .map(|n| (n.arc, n.pose.values[curve.drive]))
        .chain(
            dead.iter()
                .filter(|d| d.unknown == curve.drive)
                .map(|d| (d.arclength, d.value)),
        )
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.dedup_by(|b, a| b.0 - a.0 < 1e-13);
    all
}
