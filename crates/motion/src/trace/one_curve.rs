//! One curve with everything that is found on it.

use super::{Found, Stage, Tracer};
use crate::curve::Curve;
use crate::dead_centres::{DeadCentre, LOCKED, dead_centres};
use crate::follow::{Bounds, Stop, follow};
use crate::links::WholeFrame;
use crate::node::{Node, SAME, node_at};
use crate::pieces::Assembled;
use crate::result::TraceError;
use crate::solver::Solver;
use crate::system::{LoopSystem, SystemPose};
use crate::walk::{Walked, walk};
use std::sync::Arc;

/// How far along the curve (metric) a better start is looked for.
const SEARCHED: f64 = 4.0;

impl Tracer<'_> {
    pub(super) fn follow(
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
        (solver.reach, solver.poses) = self.limits;
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
        let Assembled {
            nodes,
            shapes,
            singular,
        } = assembled;
        if solver.is_deflated() && stops.contains(&Stop::Budget) {
            notes.push(
                "branch shaky all along: followed for a limited number of poses, each of which takes the derivative of a rank"
                    .to_owned(),
            );
        }
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
            frame: Arc::new(WholeFrame::new(
                self.mechanism,
                &self.geometry,
                system,
                states,
            )),
            asked: f64::NAN,
            dense: None,
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

    /// Which way is forward: the driven variable grows, or else the first that moves of those at the ground, then by name.
    pub(super) fn forward(&self, solver: &Solver, drive: Option<usize>) -> Vec<f64> {
        let tangent = solver.tangent();
        let mut toward = vec![0.0; tangent.len()];
        if let Some(drive) = drive
            && tangent[drive].abs() > LOCKED
        {
            toward[drive] = 1.0;
            return toward;
        }
        let ground = self.mechanism.ground();
        let place = |(unknown, (joint, freedom)): (usize, (usize, usize))| {
            let known = &self.mechanism.joints()[joint];
            let ends = [known.predecessor.link, known.successor.link];
            (
                !ends.contains(&ground),
                known.freedom_name(freedom),
                unknown,
            )
        };
        let variables = solver.system.variables().into_iter().enumerate();
        let moving = variables.filter(|(unknown, _)| tangent[*unknown].abs() > 1e-3);
        if let Some((_, _, first)) = moving.map(place).min() {
            toward[first] = 1.0;
        }
        toward
    }

    /// The limits of the file that the start keeps.
    pub(super) fn bounds(
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
                    "joint `{}` starts outside its limits; they are ignored",
                    known.name
                ));
            } else {
                bounds.push(own);
            }
        }
        bounds
    }
}

/// A generic pose of a branch may still be close to the singular pose at home: the most regular one on a stretch of the
/// curve around it serves better as the start.
fn away_from_home(solver: &mut Solver, start: Node, bounds: &[Bounds]) -> Node {
    let mut best = start.clone();
    let mut back = start.clone();
    back.tangent.iter_mut().for_each(|t| *t = -*t);
    for (from, sign) in [(&start, 1.0), (&back, -1.0)] {
        for node in follow(solver, from, from, bounds, SEARCHED).0 {
            if node.arc < SEARCHED && node.margin > best.margin * (1.0 + 1e-6) {
                best = node;
                best.tangent.iter_mut().for_each(|t| *t *= sign);
            }
        }
    }
    best.arc = 0.0;
    best
}

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
