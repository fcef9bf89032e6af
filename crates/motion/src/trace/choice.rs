//! Which curve answers the question: the one asked for, or the one that serves best.

use super::{CANDIDATES, Found, Tracer};
use crate::inputs::{Variable, choose_inputs};
use crate::result::TraceError;
use crate::system::LoopSystem;
use std::sync::Arc;

impl Tracer<'_> {
    /// The curve on which a variable moves while the wanted others are held, and of the rest the other inputs.
    pub(super) fn curve_driven_by(
        &self,
        drive: &Variable,
        (hold, inputs): (&[Variable], &[Variable]),
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
        // Of the rest the inputs are held, as far as that holds anything.
        let mut preferred = first.clone();
        for unknown in inputs.iter().filter_map(&unknown) {
            if unknown != driven && !preferred.contains(&unknown) {
                preferred.push(unknown);
            }
        }
        let driven_first: Vec<usize> = std::iter::once(driven)
            .chain(preferred.iter().copied())
            .collect();
        let (chosen, _) = choose_inputs(self.mechanism, &system, &tangents, &driven_first);
        let holds: Vec<usize> = if chosen.first() == Some(&driven) {
            if first.iter().any(|held| !chosen.contains(held)) {
                let held: Vec<&str> = hold.iter().map(|v| v.name.as_str()).collect();
                return Err(TraceError::NothingLeft {
                    drive: drive.name.clone(),
                    held: held.join(", "),
                });
            }
            chosen[1..].to_vec()
        } else {
            // At a dead centre of the driven variable: its rate is zero at the start, and the others suffice to go on.
            let (chosen, _) = choose_inputs(self.mechanism, &system, &tangents, &preferred);
            chosen
                .into_iter()
                .take(stage.dimension.saturating_sub(1))
                .collect()
        };
        let found = self.follow(stage, &system, pose, at_home, holds, Some(driven))?;
        Ok(found.map(|f| (f, drive.clone())))
    }

    /// The curve that serves best where nothing is asked for: that of the input which goes round without dead centre, or else of
    /// the one that is moved farthest. Where there is no input to drive, of any joint that could be one.
    pub(super) fn best_curve(
        &self,
        hold: &[Variable],
        inputs: &[Variable],
    ) -> Result<Option<(Found, Variable)>, TraceError> {
        let can_move = |input: &&Variable| {
            let stage = self.stage_of(input.joint);
            !hold.contains(input) && stage.is_some() && self.locked(input) != Some(true)
        };
        let mut candidates: Vec<Variable> = inputs.iter().filter(can_move).cloned().collect();
        if candidates.is_empty() {
            candidates = self.independent_of(hold)?;
        }
        if let (true, Some(last)) = (candidates.is_empty(), hold.last()) {
            return Err(TraceError::HoldsTooMuch {
                name: last.name.clone(),
            });
        }
        // What turns outside all loops shows nothing of how the others move.
        let in_a_loop = |candidate: &Variable| {
            let stage = self.stage_of(candidate.joint);
            stage.is_some_and(|stage| stage.index.is_some())
        };
        // A joint of a rod that spins may do no more than spin it.
        let hidden = self.hidden();
        let spins = |candidate: &Variable| hidden.touches(self.mechanism, candidate.joint);
        candidates.sort_by_key(|candidate| (!in_a_loop(candidate), spins(candidate)));
        let mut best: Option<((bool, f64), Found, Variable)> = None;
        let mut refused = None;
        for candidate in candidates.into_iter().take(CANDIDATES) {
            if best.as_ref().is_some_and(|((shown, _), _, _)| *shown) && !in_a_loop(&candidate) {
                break;
            }
            let (found, variable) = match self.curve_driven_by(&candidate, (hold, inputs)) {
                Ok(Some(found)) => found,
                Ok(None) => continue,
                Err(error @ TraceError::NothingLeft { .. }) => {
                    refused.get_or_insert(error);
                    continue;
                }
                Err(error) => return Err(error),
            };
            let score = self.score(&found, &variable);
            let shown = hidden.is_shown(&found.curve);
            if best.as_ref().is_none_or(|((known, most), _, _)| {
                (shown && !*known) || (shown == *known && score > most * (1.0 + 1e-9))
            }) {
                best = Some(((shown, score), found, variable));
                if shown && score.is_infinite() {
                    break;
                }
            }
        }
        match (best, refused) {
            (Some((_, found, variable)), _) => Ok(Some((found, variable))),
            (None, Some(error)) => Err(error),
            (None, None) => Ok(None),
        }
    }

    /// Variables that can be driven while others are held, of every part.
    fn independent_of(&self, hold: &[Variable]) -> Result<Vec<Variable>, TraceError> {
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
        candidates.sort_by_key(|variable| variable.rank(self.mechanism));
        Ok(candidates)
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
}
