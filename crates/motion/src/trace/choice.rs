//! Which curve answers the question: the one asked for, or the one that serves best.

use super::{CANDIDATES, Found, Tracer};
use crate::inputs::{SAID, Variable, choose_inputs};
use crate::result::TraceError;
use crate::system::LoopSystem;
use std::sync::Arc;

impl Tracer<'_> {
    /// The curve on which a variable moves while the wanted others are held.
    pub(super) fn curve_driven_by(
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
            // Other parts stand still anyway, and so does what rests on the branch.
            if let Some(u) = unknown(variable).filter(|_| self.locked(variable) != Some(true)) {
                first.push(u);
            }
        }
        let pose = system.pose(&states);
        let tangents = self.tangents(stage, &system, &pose);
        let name = |u: usize| {
            let (joint, freedom) = system.variables()[u];
            Variable::of(self.mechanism, joint, freedom).name
        };
        let (chosen, idle) = choose_inputs(self.mechanism, &system, &tangents, &first);
        if let Some(last) = first.last()
            && chosen.iter().all(|u| first.contains(u))
        {
            return Err(TraceError::HoldsTooMuch { name: name(*last) });
        }
        if let Some(&out) = idle.first() {
            return Err(TraceError::HoldsNothing { name: name(out) });
        }
        let held_first: Vec<usize> = std::iter::once(driven)
            .chain(first.iter().copied())
            .collect();
        let (chosen, left_out) = choose_inputs(self.mechanism, &system, &tangents, &held_first);
        if left_out.first().is_some_and(|&out| out != driven) {
            let held: Vec<&str> = hold.iter().map(|v| v.name.as_str()).collect();
            return Err(TraceError::NothingLeft {
                drive: drive.name.clone(),
                held: held.join(", "),
            });
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
    pub(super) fn best_curve(
        &self,
        hold: &[Variable],
    ) -> Result<Option<(Found, Variable)>, TraceError> {
        let mut candidates: Vec<Variable> = Vec::new();
        for stage in &self.stages {
            let (states, _) = self.start(stage);
            let system = LoopSystem::new(self.mechanism, &self.geometry, &states, &stage.part)?;
            let pose = system.pose(&states);
            let tangents = self.tangents(stage, &system, &pose);
            let held: Vec<usize> = hold
                .iter()
                .filter(|v| self.locked(v) != Some(true))
                .filter_map(|v| Some(system.unknowns_of(v.joint)?.start + v.freedom))
                .collect();
            let (chosen, _) = choose_inputs(self.mechanism, &system, &tangents, &held);
            let variables = system.variables();
            candidates.extend(chosen.iter().filter(|u| !held.contains(u)).map(|&u| {
                let (joint, freedom) = variables[u];
                Variable::of(self.mechanism, joint, freedom)
            }));
        }
        if let (true, Some(last)) = (candidates.is_empty(), hold.last()) {
            return Err(TraceError::HoldsTooMuch {
                name: last.name.clone(),
            });
        }
        // What the file says is driven is driven.
        let rank = |variable: &Variable| variable.rank(self.mechanism);
        candidates.sort_by_key(rank);
        let first = candidates.first().map_or(usize::MAX, rank);
        if first <= SAID {
            candidates.retain(|candidate| rank(candidate) == first);
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
        let own = found.curve.solver.system.unknowns_of(variable.joint);
        if own.is_some_and(|r| r.start + variable.freedom == found.curve.drive) {
            return Ok(Some((found, variable)));
        }
        // Followed anew, so that the driven variable grows along the curve and its dead centres part the stretches.
        let again = self.curve_driven_by(&variable, hold)?;
        Ok(again.or(Some((found, variable))))
    }

    /// How well a variable serves as the driven one: infinitely where it goes round without dead centre, else its range.
    pub(super) fn score(&self, found: &Found, variable: &Variable) -> f64 {
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

    pub(super) fn best_variable(
        &self,
        found: &Found,
        hold: &[Variable],
    ) -> Option<(f64, Variable)> {
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
            let several = self.mechanism.joints()[v.joint].freedom() > 1;
            let rank = v.rank(self.mechanism);
            (
                if rank <= SAID { rank } else { SAID + 1 },
                several,
                v.name.clone(),
            )
        });
        let mut best: Option<(f64, Variable)> = None;
        for (_, variable) in all {
            let marked = variable.rank(self.mechanism) <= SAID;
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
}
