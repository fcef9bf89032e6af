//! Predictor and corrector: from one pose of a curve to the next.
//!
//! The predictor is the cubic through the last two poses with their tangents, so that its error is of fourth order in the
//! step; the corrector is Newton's method across the predicted tangent (Allgower & Georg 2003, chapters 2 and 6). Steps are
//! as long as the tangent turns by about a tenth of a radian, and no joint by more than a fifth.
//!
//! Where branches meet, the least singular value of the equations vanishes and neither the tangent nor a correction is
//! determined. Such a pose is never stepped onto: where the margin falls fast, longer steps are tried until the pose behind
//! is as regular as the one before (Allgower & Georg 2003, chapter 8: jumping over simple bifurcations).
//!
//! Where branches come close without meeting, the same step would lead from one to the other. Both cases change the sign
//! of the determinant of fixed equations and the tangent. They are told apart on this side of the place: towards a pose
//! where branches meet, the margin falls to nothing and the tangent stays; past a gap it does not. Gaps down to
//! about a fifth of a step are seen; a narrower one may be crossed.

use super::cubic::{Cubic, Predictor, arc_between};
use super::node::{Node, SAME, at_value, finish};
use super::solver::{Along, Solver};
use super::vectors::{dot, length};

/// Why a curve was followed no further.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stop {
    /// It is back where it started.
    Closed,
    /// A joint limit of the file.
    Limit { unknown: usize, value: f64 },
    /// Followed far enough.
    Budget,
    /// No further pose is found.
    Stuck,
}

/// A range that an unknown must not leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub unknown: usize,
    pub lower: f64,
    pub upper: f64,
}

/// The tangent turns by about this much from pose to pose (rad), and by no more than three times as much.
const TURN: f64 = 0.1;

/// No joint moves by more than this per step (rad, part lengths).
const LONGEST_WAY: f64 = 0.2;

/// A first step, and one too short to go on (metric, relative to the longest).
const FIRST_STEP: f64 = 0.1;
const SHORTEST_STEP: f64 = 1e-5;

/// A motion whose variables come and go is followed for so many times its reach.
const WAYS: f64 = 40.0;

/// Nor these, where every one takes the derivative of a rank.
const MOST_DEFLATED_NODES: usize = 250;

/// Where the margin falls below this share of the one before, longer steps are tried: so many times as long.
const FALLING: f64 = 0.4;
const JUMPS: [f64; 4] = [1.0, 1.7, 2.6, 3.6];

fn longest(tangent: &[f64]) -> f64 {
    let largest = tangent.iter().fold(0.0f64, |m, t| m.max(t.abs()));
    LONGEST_WAY / largest.max(1e-6)
}

/// What one attempt at a step came to.
struct Attempt {
    node: Node,
    /// By how much the tangent turned.
    turn: f64,
    /// Length of the correction.
    way: f64,
}

fn attempt(solver: &mut Solver, here: &Node, predictor: &Predictor, step: f64) -> Option<Attempt> {
    let mut pose = here.pose.clone();
    solver.system.advance(&mut pose, &predictor.at(step));
    let across = predictor.direction(step);
    if !across.iter().all(|x| x.is_finite()) {
        return None;
    }
    let corrected = solver.correct(&mut pose, Along::Across(&across))?;
    if corrected.way > 0.1 * step || !solver.linearise(&pose) {
        return None;
    }
    let mut tangent = solver.tangent().to_vec();
    if dot(&tangent, &across) < 0.0 {
        tangent.iter_mut().for_each(|t| *t = -*t);
    }
    let turn = dot(&tangent, &here.tangent).clamp(-1.0, 1.0).acos();
    let margin = solver.margin();
    let mut node = Node {
        pose,
        arc: here.arc,
        tangent,
        margin,
    };
    node.arc += arc_between(solver, here, &node);
    Some(Attempt {
        node,
        turn,
        way: corrected.way,
    })
}

/// Steps shorter than this share of the longest are taken without asking what lies between.
const FINEST_LOOK: f64 = 1e-3;

/// A margin that falls below this share of the one at hand is taken to vanish.
const VANISHES: f64 = 1e-4;

/// Looks are taken so many times, each this share of the way to where the margin would vanish.
const LOOKS: usize = 24;
const APPROACH: f64 = 0.7;

/// Whether a step leads across a gap between branches: the margin falls on the way, but not to nothing. `beyond` is the
/// margin at its end.
fn is_a_gap(
    solver: &mut Solver,
    here: &Node,
    predictor: &Predictor,
    step: f64,
    beyond: f64,
) -> bool {
    let ordinary = 0.5 * here.margin.min(beyond);
    let mut low = (0.0, here.margin);
    let mut at = 0.5 * step * here.margin / (here.margin + beyond);
    let mut missed = 0;
    for _ in 0..LOOKS {
        let found = attempt(solver, here, predictor, at).filter(|f| f.turn < 3.0 * TURN);
        let margin = found.map_or(f64::INFINITY, |f| f.node.margin);
        if margin < VANISHES * here.margin {
            return false;
        }
        if margin > 0.9 * low.1 {
            // Beyond the place, or past the least margin: nearer looks tell.
            missed += 1;
            if missed > 3 {
                break;
            }
            at = low.0 + 0.4 * (at - low.0);
            continue;
        }
        let zero = at + (at - low.0) * margin / (low.1 - margin);
        low = (at, margin);
        at += APPROACH * (zero - at);
        if at >= step {
            break;
        }
    }
    low.1 < ordinary
}

/// Follows the curve from a node in the direction of its tangent. That node is the first of the result; `start` is the
/// one at which a closed curve is recognised. It ends with the first node that is farther than `farthest` (metric) from
/// the start.
pub(super) fn follow(
    solver: &mut Solver,
    start: &Node,
    from: &Node,
    bounds: &[Bounds],
    farthest: f64,
) -> (Vec<Node>, Stop) {
    let mut nodes = vec![from.clone()];
    solver.anchor(&from.pose);
    let mut step = FIRST_STEP * longest(&from.tangent);
    loop {
        let here = nodes[nodes.len() - 1].clone();
        let most = if solver.is_deflated() {
            MOST_DEFLATED_NODES
        } else {
            solver.poses
        };
        if nodes.len() > most || here.arc - start.arc > farthest || far_enough(solver, start, &here)
        {
            return (nodes, Stop::Budget);
        }
        let before = (nodes.len() > 1).then(|| nodes[nodes.len() - 2].clone());
        let predictor = Predictor::new(solver, before.as_ref(), &here);
        let limit = longest(&here.tangent);
        step = step.min(limit);
        solver.linearise(&here.pose);
        let chosen = solver.chosen();
        let orientation = solver.orientation(&chosen, &here.pose, &here.tangent);
        let mut next = None;
        while step > SHORTEST_STEP * limit {
            let mut best: Option<Attempt> = None;
            for jump in JUMPS {
                let size = step * jump;
                if jump > 1.0 && size > 3.0 * limit {
                    break;
                }
                let Some(found) = attempt(solver, &here, &predictor, size) else {
                    if jump == 1.0 && here.margin > 0.05 {
                        break;
                    }
                    continue;
                };
                if found.turn > 3.0 * TURN * jump {
                    continue;
                }
                let falling = found.node.margin < FALLING * here.margin;
                let better = best
                    .as_ref()
                    .is_none_or(|b| found.node.margin > 1.5 * b.node.margin);
                if better {
                    let turned = jump > 1.0
                        || solver.orientation(&chosen, &found.node.pose, &found.node.tangent)
                            != orientation;
                    if turned
                        && orientation != 0.0
                        && step > FINEST_LOOK * limit
                        && is_a_gap(solver, &here, &predictor, size, found.node.margin)
                    {
                        break;
                    }
                    best = Some(found);
                }
                if !falling {
                    break;
                }
            }
            if let Some(found) = best.filter(|b| b.node.margin > 1e-7) {
                next = Some(found);
                break;
            }
            step *= 0.5;
        }
        let Some(found) = next else {
            return (nodes, Stop::Stuck);
        };
        let gone = found.node.arc - here.arc;
        let by_turn = TURN / found.turn.max(0.05 * TURN);
        let by_way = (0.01 * gone / found.way.max(1e-6 * gone)).cbrt();
        step = gone.min(limit) * by_turn.min(by_way).clamp(0.4, 1.6);
        let node = found.node;
        solver.anchor(&node.pose);
        if let Some(last) = stopped_by_limit(solver, &here, &node, bounds) {
            let stop = Stop::Limit {
                unknown: last.1,
                value: last.0.pose.values[last.1],
            };
            if last.0.arc > here.arc {
                nodes.push(last.0);
            }
            return (nodes, stop);
        }
        if (nodes.len() > 2 || from.arc > start.arc)
            && let Some(last) = closes(solver, start, &here, &node)
        {
            nodes.push(last);
            return (nodes, Stop::Closed);
        }
        nodes.push(node);
    }
}

fn far_enough(solver: &Solver, start: &Node, here: &Node) -> bool {
    let weights = solver.system.weights();
    let far = start
        .pose
        .values
        .iter()
        .zip(&here.pose.values)
        .zip(weights)
        .map(|((a, b), w)| (b - a).abs() * w)
        .fold(0.0, f64::max);
    far > solver.reach || here.arc - start.arc > WAYS * solver.reach
}

/// The pose between two nodes where an unknown first meets its limit.
fn stopped_by_limit(
    solver: &mut Solver,
    from: &Node,
    to: &Node,
    bounds: &[Bounds],
) -> Option<(Node, usize)> {
    let mut first: Option<(Node, usize)> = None;
    for bound in bounds {
        let value = to.pose.values[bound.unknown];
        let limit = if value > bound.upper {
            bound.upper
        } else if value < bound.lower {
            bound.lower
        } else {
            continue;
        };
        if let Some(found) = at_value(solver, from, to, bound.unknown, limit)
            && first.as_ref().is_none_or(|(n, _)| found.arc < n.arc)
        {
            first = Some((found, bound.unknown));
        }
    }
    first
}

/// Whether the start lies between two nodes, all joints compared and the tangent too; then the start once more, as it is
/// counted at this end.
fn closes(solver: &mut Solver, start: &Node, from: &Node, to: &Node) -> Option<Node> {
    let n = start.tangent.len();
    let again = solver.system.wound_towards(&start.pose, &from.pose);
    let mut chord = vec![0.0; n];
    solver.system.way(&from.pose, &to.pose, &mut chord);
    let size = length(&chord);
    let mut way = vec![0.0; n];
    solver.system.way(&from.pose, &again, &mut way);
    let along = dot(&chord, &way) / size;
    let inside = along > -1e-9 * size && along <= size * (1.0 + 1e-9);
    if !(inside && length(&way) < 1.5 * size) {
        return None;
    }
    let cubic = Cubic::between(solver, from, to);
    let mut pose = from.pose.clone();
    solver.system.advance(&mut pose, &cubic.at(along / size));
    // The chord's own component is made that of the start, so that both are cut at the same place.
    let mut across = chord;
    across.iter_mut().for_each(|x| *x /= size);
    for _ in 0..3 {
        solver.correct(&mut pose, Along::Across(&across))?;
        let wound = solver.system.wound_towards(&start.pose, &pose);
        solver.system.way(&pose, &wound, &mut way);
        if solver.system.separation(&pose, &start.pose) < SAME {
            let mut node = finish(solver, wound, &across, from)?;
            return (dot(&node.tangent, &start.tangent) > 0.9).then(|| {
                node.tangent.clone_from(&start.tangent);
                node
            });
        }
        let short = dot(&across, &way);
        if short.abs() > size {
            return None;
        }
        let step: Vec<f64> = across.iter().map(|x| x * short).collect();
        solver.system.advance(&mut pose, &step);
    }
    None
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::samples::at_home;
    use kutzbach_closure::samples::{CRANK_ROCKER, Written, planar, ring};
    use std::f64::consts::{PI, TAU};

    fn around(points: &[[f64; 2]]) -> (Vec<Node>, Stop, Solver) {
        let mechanism = ring(&planar(points), [0.0; 3], Written::Exactly);
        let (mut solver, start) = at_home(&mechanism);
        let (nodes, stop) = follow(&mut solver, &start, &start, &[], f64::INFINITY);
        (nodes, stop, solver)
    }

    #[test]
    fn a_parallelogram_goes_round_through_both_flat_poses() {
        let (nodes, stop, _) = around(&[[0.0, 0.0], [1.0, 2.0], [4.0, 2.0], [3.0, 0.0]]);
        assert_eq!(stop, Stop::Closed);
        // All four hinges turn alike: the arc is a circle's.
        let last = nodes.last().unwrap();
        assert!((last.arc - 2.0 * TAU).abs() < 1e-6, "{}", last.arc);
        for node in &nodes {
            let v = &node.pose.values;
            for other in &v[1..] {
                assert!((other.abs() - v[0].abs()).abs() < 1e-11, "{v:?}");
            }
            assert!((node.tangent[0].abs() - 0.5).abs() < 1e-9);
        }
        assert!(nodes.iter().any(|n| (n.pose.values[0] - PI).abs() < 0.3));
    }

    #[test]
    fn a_gap_between_branches_is_not_crossed() {
        // Close to a parallelogram: its two motions no longer meet, and coupler and rocker never stretch, so that each
        // motion keeps the side on which their hinge lies. Grashof's margin is given.
        for margin in [3e-1, 1e-2, 1e-3] {
            let points = [[0.0, 0.0], [0.0, 1.0], [3.0, 1.0], [3.0, -margin]];
            let (nodes, stop, solver) = around(&points);
            assert_eq!(stop, Stop::Closed, "{margin}");
            let turned = |p: [f64; 2], angle: f64| {
                let (s, c) = angle.sin_cos();
                [c * p[0] - s * p[1], s * p[0] + c * p[1]]
            };
            let sides: Vec<f64> = nodes
                .iter()
                .map(|node| {
                    let v = &node.pose.values;
                    let tip = turned(points[1], v[0]);
                    let coupler = turned([3.0, 0.0], v[0] + v[1]);
                    let end = [tip[0] + coupler[0], tip[1] + coupler[1]];
                    let rocker = [points[3][0] - end[0], points[3][1] - end[1]];
                    coupler[0] * rocker[1] - coupler[1] * rocker[0]
                })
                .collect();
            assert!(
                sides.iter().all(|s| (*s < 0.0) == (sides[0] < 0.0)),
                "{margin}"
            );
            assert!((nodes.last().unwrap().pose.values[0] - TAU).abs() < 1e-9);
            drop(solver);
        }
    }

    #[test]
    fn a_limit_ends_the_curve_where_it_is() {
        let mechanism = ring(&planar(&CRANK_ROCKER), [0.0; 3], Written::Exactly);
        let (mut solver, start) = at_home(&mechanism);
        let bound = Bounds {
            unknown: 0,
            lower: -1.0,
            upper: 0.75,
        };
        let (nodes, stop) = follow(&mut solver, &start, &start, &[bound], f64::INFINITY);
        assert_eq!(
            stop,
            Stop::Limit {
                unknown: 0,
                value: 0.75
            }
        );
        assert_eq!(nodes.last().unwrap().pose.values[0], 0.75);
        let (nodes, stop) = follow(&mut solver, &start, &start, &[], 1.0);
        assert_eq!(stop, Stop::Budget);
        let arc = nodes.last().unwrap().arc;
        assert!(arc > 1.0 && arc < 2.0);
    }
}
