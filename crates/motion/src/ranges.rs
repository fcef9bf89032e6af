//! How far every joint variable moves along a curve.

use super::dead_centres::LOCKED;
use super::inputs::Variable;
use super::result::Range;
use super::trace::Found;
use kutzbach_model::mechanism::Mechanism;

/// A whole number of turns is one within this, far more than curves are off where they close.
const WHOLE_TURN: f64 = 1e-4;

/// One row per variable of the mechanism; those that are not of the moving part rest where they are.
pub(super) fn ranges(mechanism: &Mechanism, found: &Found) -> Vec<Range> {
    let curve = &found.curve;
    let system = &curve.solver.system;
    let winding = curve.winding();
    Variable::all(mechanism)
        .into_iter()
        .map(|variable| {
            let Some(own) = system.unknowns_of(variable.joint) else {
                let value = curve.frame.states[variable.joint].values[variable.freedom];
                return Range {
                    variable,
                    min: value,
                    max: value,
                    travel: 0.0,
                    turns: 0,
                    moves: false,
                    dead_centres: 0,
                };
            };
            let unknown = own.start + variable.freedom;
            // Extremes lie at nodes (ends) and dead centres, singular poses between them.
            let mut places: Vec<(f64, f64)> = curve
                .nodes
                .iter()
                .map(|n| (n.arc, n.pose.values[unknown]))
                .chain(
                    found
                        .dead
                        .iter()
                        .filter(|d| d.unknown == unknown)
                        .map(|d| (d.arclength, d.value)),
                )
                .chain(
                    found
                        .singular
                        .iter()
                        .map(|(arc, s)| (*arc, s.pose.values[unknown])),
                )
                .collect();
            places.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (min, max) = places
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| {
                    (l.min(p.1), h.max(p.1))
                });
            let travel = places.windows(2).map(|p| (p[1].1 - p[0].1).abs()).sum();
            let fastest = curve
                .nodes
                .iter()
                .fold(0.0f64, |m, n| m.max(n.tangent[unknown].abs()));
            let around = winding[unknown] / std::f64::consts::TAU;
            let whole = (around - around.round()).abs() < WHOLE_TURN;
            // A ball that comes back has turned about one of its axes, or about none of them.
            let turns = match system.is_periodic(unknown) || (!system.is_scalar(unknown) && whole) {
                true => around.round() as i64,
                false => 0,
            };
            Range {
                variable,
                min,
                max,
                travel,
                turns,
                moves: fastest > LOCKED,
                dead_centres: found.dead.iter().filter(|d| d.unknown == unknown).count(),
            }
        })
        .collect()
}
