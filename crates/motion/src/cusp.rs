//! Cusps: where a curve turns back on its other half.
//!
//! Near a cusp the curve is `z = c τ² + b τ³ + …` (or τ⁵, τ⁷): one direction c, gone to its end and back again. No pose lies
//! beyond, so that a predictor along c finds nothing; but every coordinate is a power series in τ, the square root of the
//! distance left along c. So
//!
//! 1. the polynomial in τ through poses of the half that was followed predicts, at −τ, poses of the other half, which are
//!    corrected: from the cusp outwards, each by all that are known;
//! 2. the square of the distance between both halves at the same place along c falls as an odd power of what is left; its
//!    root of that order is a power series with a simple zero at the cusp, which interpolation finds;
//! 3. the polynomial in τ through poses on both halves passes the cusp, at τ = 0.

use super::bridge::{Bridge, horner, interpolate};
use super::cubic::Cubic;
use super::node::{Node, finish};
use super::singular::{Singular, kernels};
use super::solver::{Along, Solver};
use super::system::SystemPose;
use super::vectors::{dot, length};

/// Places of poses on one half, in units of the largest τ.
const PLACES: [f64; 8] = [0.14, 0.22, 0.35, 0.48, 0.61, 0.74, 0.87, 1.0];

/// The nearest of them lead from one half to the other; there the equations have hardly any margin, and what is said of
/// the cusp rests on the others.
const LEADING: usize = 1;

/// The passage reaches as far as the curve has turned by about this much (rad) on the way to the cusp.
const TURNED: f64 = 0.35;

/// How far beyond the last node the cusp is guessed, in turn, in shares of the passage.
const BEYOND: [f64; 9] = [0.0, 1e-4, 3e-4, 1e-3, 2e-3, 4e-3, 1e-2, 2e-2, 4e-2];

/// Exponents that are recognised.
const POWERS: [f64; 3] = [3.0, 5.0, 7.0];

struct Near<'n> {
    nodes: &'n [Node],
    reference: SystemPose,
    /// The direction in which the curve comes to its end.
    chord: Vec<f64>,
}

impl Near<'_> {
    fn chart(&self, solver: &Solver, pose: &SystemPose) -> Vec<f64> {
        let mut z = vec![0.0; self.chord.len()];
        solver.system.way(&self.reference, pose, &mut z);
        z
    }

    /// A pose near a prediction, cut across the chord at a place along it.
    fn corrected(
        &self,
        solver: &mut Solver,
        mut prediction: Vec<f64>,
        along: f64,
    ) -> Option<(SystemPose, Vec<f64>)> {
        let off = along - dot(&self.chord, &prediction);
        prediction
            .iter_mut()
            .zip(&self.chord)
            .for_each(|(p, c)| *p += off * c);
        let mut pose = self.reference.clone();
        solver.system.advance(&mut pose, &prediction);
        solver.correct(&mut pose, Along::Across(&self.chord))?;
        let z = self.chart(solver, &pose);
        Some((pose, z))
    }
}

/// The passage through a cusp at the end of a list of nodes, and how many of the nodes stay.
/// `start` is a node that the passage must not jump over.
pub(super) fn pass_cusp(
    solver: &mut Solver,
    nodes: &[Node],
    start: &Node,
) -> Option<(usize, Singular)> {
    let last = nodes.last()?;
    if nodes.len() < 6 {
        return None;
    }
    // From where the direction still differs from that at the end.
    let turned = |node: &Node| dot(&node.tangent, &last.tangent).clamp(-1.0, 1.0).acos();
    let far = nodes.iter().rposition(|n| turned(n) > TURNED).unwrap_or(0);
    if far + 5 > nodes.len() {
        return None;
    }
    let near = Near {
        nodes: &nodes[far..],
        reference: last.pose.clone(),
        chord: last.tangent.clone(),
    };
    // What is left beyond the last node is less than the shortest step.
    let places: Vec<f64> = near
        .nodes
        .iter()
        .map(|n| dot(&near.chord, &near.chart(solver, &n.pose)))
        .collect();
    let mut end = *places.last()?;
    let mut reach = (end - places[0]).sqrt();
    let again = solver.system.wound_towards(&start.pose, &near.reference);
    let to_start = near.chart(solver, &again);
    let along_start = dot(&near.chord, &to_start);
    if length(&to_start) < 2.0 * (end - places[0]) && along_start < end {
        reach = reach.min(0.9 * (end - along_start).sqrt());
    }
    let mut halves = None;
    for beyond in BEYOND {
        let from = end + beyond * reach * reach;
        if let Some(found) = both_halves(solver, &near, &places, from, 0.95 * reach)
            && let Some(better) = turning_place(&found, from)
        {
            end = better;
            halves = Some(found);
            break;
        }
    }
    for _ in 0..5 {
        let found = both_halves(solver, &near, &places, end, 0.95 * reach)?;
        let better = turning_place(&found, end)?;
        let moved = (better - end).abs();
        end = better;
        halves = Some(found);
        if moved < 1e-12 * reach {
            break;
        }
    }
    let halves = halves?;
    let scale = halves
        .iter()
        .map(|h| (end - h.along).sqrt())
        .fold(0.0, f64::max);
    let root = |half: &Half| (end - half.along).max(0.0).sqrt() / scale;
    let mut points: Vec<f64> = halves.iter().rev().map(|h| -root(h)).collect();
    points.extend(halves.iter().map(root));
    let mut values: Vec<Vec<f64>> = halves.iter().rev().map(|h| h.before.1.clone()).collect();
    values.extend(halves.iter().map(|h| h.after.1.clone()));
    if !points.windows(2).all(|p| p[0] < p[1]) {
        return None;
    }
    let bridge = Bridge::through(near.reference.clone(), &points, &values);
    let pose = bridge.pose(solver, bridge.middle());
    let outermost = halves.last()?;
    let along = outermost.along;
    let kept = far + places.iter().position(|p| *p >= along).unwrap_or(0);
    let base = &nodes[kept.checked_sub(1)?];
    let before = finish(
        solver,
        outermost.before.0.clone(),
        &bridge.direction(0.0),
        base,
    )?;
    let mut after = finish(
        solver,
        outermost.after.0.clone(),
        &bridge.direction(1.0),
        base,
    )?;
    after.arc = before.arc + bridge.arc();
    let (_, freedom) = kernels(solver, &pose);
    Some((
        kept,
        Singular {
            pose,
            freedom,
            crosses: false,
            cusp: true,
            bridge,
            before,
            after,
        },
    ))
}

/// Poses of both halves at one place along the chord.
struct Half {
    along: f64,
    before: (SystemPose, Vec<f64>),
    after: (SystemPose, Vec<f64>),
}

fn both_halves(
    solver: &mut Solver,
    near: &Near<'_>,
    places: &[f64],
    end: f64,
    reach: f64,
) -> Option<Vec<Half>> {
    // The half that was followed, between its nodes.
    let mut points: Vec<f64> = Vec::new();
    let mut values: Vec<Vec<f64>> = Vec::new();
    let mut before = Vec::new();
    for (index, place) in PLACES.into_iter().enumerate().rev() {
        let tau = place * reach;
        let along = end - tau * tau;
        // Close to the cusp the polynomial in τ predicts better than what lies between nodes.
        let prediction = if index < LEADING {
            horner(&interpolate(&points, &values), tau)
        } else {
            between_nodes(solver, near, places, along)
        };
        let found = near.corrected(solver, prediction, along)?;
        points.insert(0, tau);
        values.insert(0, found.1.clone());
        before.insert(0, (along, found));
    }
    // The other half, from the middle outwards, each predicted by all that are known.
    let mut halves = Vec::new();
    for (place, (along, before)) in PLACES.into_iter().zip(before) {
        let tau = -place * reach;
        let predicted = horner(&interpolate(&points, &values), tau);
        let after = near.corrected(solver, predicted.clone(), along)?;
        // On the half it was meant for.
        if apart(&after.1, &predicted) > 0.4 * apart(&after.1, &before.1) {
            return None;
        }
        points.insert(0, tau);
        values.insert(0, after.1.clone());
        halves.push(Half {
            along,
            before,
            after,
        });
    }
    halves.drain(..LEADING);
    Some(halves)
}

/// A prediction at a place along the chord, by the cubic between the nodes beside it.
fn between_nodes(solver: &Solver, near: &Near<'_>, places: &[f64], along: f64) -> Vec<f64> {
    let after = places.partition_point(|p| *p <= along);
    let segment = after.saturating_sub(1).min(near.nodes.len() - 2);
    let (a, b) = (&near.nodes[segment], &near.nodes[segment + 1]);
    let cubic = Cubic::between(solver, a, b);
    // The place is a cubic of the parameter too.
    let weight = |z: Vec<f64>| dot(&near.chord, &z);
    let wanted = along - places[segment];
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let u = 0.5 * (low + high);
        if weight(cubic.at(u)) < wanted {
            low = u;
        } else {
            high = u;
        }
    }
    let mut guess = a.pose.clone();
    solver
        .system
        .advance(&mut guess, &cubic.at(0.5 * (low + high)));
    near.chart(solver, &guess)
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    let off: Vec<f64> = a.iter().zip(b).map(|(x, y)| x - y).collect();
    length(&off)
}

/// The place along the chord where both halves meet.
fn turning_place(halves: &[Half], end: f64) -> Option<f64> {
    let square = |h: &Half| {
        h.before
            .1
            .iter()
            .zip(&h.after.1)
            .map(|(a, b)| (a - b).powi(2))
            .sum::<f64>()
    };
    let (first, last) = (halves.first()?, halves.last()?);
    let slope =
        (square(last) / square(first)).ln() / ((end - last.along) / (end - first.along)).ln();
    let power = POWERS
        .into_iter()
        .min_by(|a, b| (a - slope).abs().total_cmp(&(b - slope).abs()))?;
    if (power - slope).abs() > 0.8 {
        return None;
    }
    let span = end - last.along;
    let places: Vec<f64> = halves.iter().map(|h| (h.along - end) / span).collect();
    let roots: Vec<Vec<f64>> = halves
        .iter()
        .map(|h| vec![square(h).powf(1.0 / power)])
        .collect();
    let polynomial = interpolate(&places, &roots);
    let value = |x: f64| horner(&polynomial, x)[0];
    let mut x = 0.0;
    for _ in 0..50 {
        let h = 1e-4;
        let slope = (value(x + h) - value(x - h)) / (2.0 * h);
        let step = value(x) / slope;
        x -= step;
        if !(x.abs() < 0.2) {
            return None;
        }
        if step.abs() < 1e-16 {
            break;
        }
    }
    Some(end + x * span)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_halves_of_a_known_cusp_meet_where_they_should() {
        // (x, y) = (e − τ², a τ³ (1 + τ²)): the halves at x lie ±y apart.
        let (end, tip) = (0.3, 0.3017);
        for power in [3, 5] {
            let halves: Vec<Half> = PLACES
                .iter()
                .map(|place| {
                    let along = end - (0.4 * place).powi(2);
                    let tau: f64 = f64::sqrt(tip - along);
                    let y = 0.7 * tau.powi(power) * (1.0 + tau * tau);
                    let pose = || SystemPose::default();
                    Half {
                        along,
                        before: (pose(), vec![along, y]),
                        after: (pose(), vec![along, -y]),
                    }
                })
                .collect();
            let found = turning_place(&halves, end).unwrap();
            assert!((found - tip).abs() < 1e-10, "{power}: {found}");
        }
    }

    #[test]
    fn an_end_that_is_no_cusp_is_not_taken_for_one() {
        // An ordinary turning point: the halves part as the root of what is left.
        let end = 0.3;
        let halves: Vec<Half> = PLACES
            .iter()
            .map(|place| {
                let tau = 0.4 * place;
                let along = end - tau * tau;
                Half {
                    along,
                    before: (SystemPose::default(), vec![along, tau]),
                    after: (SystemPose::default(), vec![along, -tau]),
                }
            })
            .collect();
        assert!(turning_place(&halves, end).is_none());
    }
}
