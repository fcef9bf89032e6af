//! What is found on a curve, told.

use super::{Found, Tracer};
use crate::curve::{Curve, CurvePose};
use crate::follow::Stop;
use crate::inputs::Variable;
use crate::node::SAME;
use crate::ranges::ranges;
use crate::result::{End, EndReason, Event, EventKind, Held, Motion, TraceOptions};
use crate::sampling::sample;
use kutzbach_mobility::Branch;
use std::sync::Arc;

impl Tracer<'_> {
    pub(super) fn motion(
        &self,
        mut found: Found,
        drive: Variable,
        branches: &[Branch],
        mut notes: Vec<String>,
        options: &TraceOptions,
    ) -> Motion {
        let system = Arc::clone(&found.curve.solver.system);
        let variables = system.variables();
        let variable = |u: usize| {
            let (joint, freedom) = variables[u];
            Variable::of(self.mechanism, joint, freedom)
        };
        let events = self.events(&mut found);
        let shown = self.hidden().is_shown(&found.curve);
        if !shown {
            notes.push(
                "nothing is seen to move: what is traced is the spin of rods between balls"
                    .to_owned(),
            );
        }
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
        found.curve.set_tolerance(options.tolerance);
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
            shown,
            curve: found.curve,
        }
    }

    pub(super) fn events(&self, found: &mut Found) -> Vec<Event> {
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
            values: curve.values(&at.pose),
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
