//! Predictor and corrector: from one pose of a curve to the next.
//!
//! The predictor is the cubic through the last two poses with their tangents, so that its error is of fourth order in the
//! step; the corrector is Newton's method across the predicted tangent (Allgower & Georg 2003, chapters 2 and 6). Steps are
//! as long as the tangent turns by about a tenth of a radian, and no joint by more than a fifth.
//!
//! Where branches meet, the least singular value of the equations vanishes and neither the tangent nor a correction is
//! determined. Such a pose is never stepped onto: where the margin falls fast, longer steps are tried until the pose behind
//! is as regular as the one before (Allgower & Georg 2003, chapter 8: jumping over simple bifurcations).

use super::solver::{Along, Solver};
use super::system::SystemPose;

/// A pose of a curve.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub pose: SystemPose,
    /// Arclength in the metric, from the start.
    pub arc: f64,
    /// Unit tangent in the metric, in the direction of growing arclength.
    pub tangent: Vec<f64>,
    /// Least singular value of the chosen equations.
    pub margin: f64,
}

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

/// A hinge is followed for so many turns, a slide for as many radians in part lengths.
const MOST_TURNS: f64 = 12.0;

/// More poses are not computed.
const MOST_NODES: usize = 20_000;

/// Nor these, where every one takes the derivative of a rank.
const MOST_DEFLATED_NODES: usize = 600;

/// Where the margin falls below this share of the one before, longer steps are tried: so many times as long.
const FALLING: f64 = 0.4;
const JUMPS: [f64; 4] = [1.0, 1.7, 2.6, 3.6];

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(super) fn length(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn longest(tangent: &[f64]) -> f64 {
    let largest = tangent.iter().fold(0.0f64, |m, t| m.max(t.abs()));
    LONGEST_WAY / largest.max(1e-6)
}

/// The cubic that leaves a pose with its tangent and came from the one before with that one's.
struct Predictor {
    first: Vec<f64>,
    second: Vec<f64>,
    third: Vec<f64>,
}

impl Predictor {
    fn new(solver: &Solver, before: Option<&Node>, here: &Node) -> Self {
        let n = here.tangent.len();
        let mut predictor = Self {
            first: here.tangent.clone(),
            second: vec![0.0; n],
            third: vec![0.0; n],
        };
        if let Some(before) = before {
            let mut back = vec![0.0; n];
            solver.system.way(&here.pose, &before.pose, &mut back);
            let tangent = solver.system.chart_velocity(&back, &before.tangent);
            let gap = here.arc - before.arc;
            if gap.abs() > 1e-12 {
                let gap = gap.abs();
                for i in 0..n {
                    let a = (back[i] + here.tangent[i] * gap) / (gap * gap);
                    let b = (here.tangent[i] - tangent[i]) / gap;
                    predictor.third[i] = (2.0 * a - b) / gap;
                    predictor.second[i] = 3.0 * a - b;
                }
            }
        }
        predictor
    }

    fn at(&self, u: f64) -> Vec<f64> {
        (0..self.first.len())
            .map(|i| u * (self.first[i] + u * (self.second[i] + u * self.third[i])))
            .collect()
    }

    fn direction(&self, u: f64) -> Vec<f64> {
        let mut d: Vec<f64> = (0..self.first.len())
            .map(|i| self.first[i] + u * (2.0 * self.second[i] + u * 3.0 * self.third[i]))
            .collect();
        let size = length(&d);
        d.iter_mut().for_each(|x| *x /= size);
        d
    }
}

/// What one attempt at a step came to.
struct Attempt {
    node: Node,
    /// By how much the tangent turned.
    turn: f64,
    /// Length of the correction.
    way: f64,
}

/// A pose of the branch as a node: corrected, with its tangent. `None` where that fails.
pub(super) fn node_at(
    solver: &mut Solver,
    mut pose: SystemPose,
    toward: &[f64],
    arc: f64,
) -> Option<Node> {
    if !solver.linearise(&pose) {
        return None;
    }
    let across = solver.tangent().to_vec();
    solver.correct(&mut pose, Along::Across(&across))?;
    solver.anchor(&pose);
    if !solver.linearise(&pose) {
        return None;
    }
    let mut tangent = solver.tangent().to_vec();
    if dot(&tangent, toward) < 0.0 {
        tangent.iter_mut().for_each(|t| *t = -*t);
    }
    Some(Node {
        margin: solver.margin(),
        pose,
        arc,
        tangent,
    })
}

/// The length of the cubic between two nodes, in the chart of the first: Gauss quadrature with three points, off by the
/// seventh power of the step.
pub(super) fn arc_between(solver: &Solver, from: &Node, to: &Node) -> f64 {
    let cubic = Cubic::between(solver, from, to);
    let root = 0.6f64.sqrt() / 2.0;
    [(0.5 - root, 5.0), (0.5, 8.0), (0.5 + root, 5.0)]
        .into_iter()
        .map(|(u, weight)| length(&cubic.velocity(u)) * weight / 18.0)
        .sum()
}

/// The cubic Hermite interpolant between two nodes, in the chart of the first; `u` from 0 to 1.
#[derive(Clone, Debug)]
pub(super) struct Cubic {
    first: Vec<f64>,
    last: Vec<f64>,
    chord: Vec<f64>,
}

impl Cubic {
    pub fn between(solver: &Solver, from: &Node, to: &Node) -> Self {
        let n = from.tangent.len();
        let mut chord = vec![0.0; n];
        solver.system.way(&from.pose, &to.pose, &mut chord);
        let size = length(&chord);
        // The chord of an arc that turns by τ is shorter than the arc by a part of τ²/24.
        let turned: Vec<f64> = from
            .tangent
            .iter()
            .zip(&to.tangent)
            .map(|(a, b)| a - b)
            .collect();
        let arc = size * (1.0 + dot(&turned, &turned) / 24.0);
        let last = solver.system.chart_velocity(&chord, &to.tangent);
        Self {
            first: from.tangent.iter().map(|t| t * arc).collect(),
            last: last.iter().map(|t| t * arc).collect(),
            chord,
        }
    }

    pub fn at(&self, u: f64) -> Vec<f64> {
        let (a, b, c) = (
            u * (1.0 - u) * (1.0 - u),
            u * u * (3.0 - 2.0 * u),
            u * u * (u - 1.0),
        );
        (0..self.chord.len())
            .map(|i| a * self.first[i] + b * self.chord[i] + c * self.last[i])
            .collect()
    }

    /// One component of [`Self::at`].
    pub fn component(&self, i: usize, u: f64) -> f64 {
        u * (1.0 - u) * (1.0 - u) * self.first[i]
            + u * u * (3.0 - 2.0 * u) * self.chord[i]
            + u * u * (u - 1.0) * self.last[i]
    }

    /// One component of [`Self::velocity`].
    pub fn speed(&self, i: usize, u: f64) -> f64 {
        (1.0 - u) * (1.0 - 3.0 * u) * self.first[i]
            + 6.0 * u * (1.0 - u) * self.chord[i]
            + u * (3.0 * u - 2.0) * self.last[i]
    }

    pub fn velocity(&self, u: f64) -> Vec<f64> {
        let (a, b, c) = (
            (1.0 - u) * (1.0 - 3.0 * u),
            6.0 * u * (1.0 - u),
            u * (3.0 * u - 2.0),
        );
        (0..self.chord.len())
            .map(|i| a * self.first[i] + b * self.chord[i] + c * self.last[i])
            .collect()
    }
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

/// Follows the curve from a node in the direction of its tangent. That node is the first of the result; `start` is the
/// one at which a closed curve is recognised.
pub(super) fn follow(
    solver: &mut Solver,
    start: &Node,
    from: &Node,
    bounds: &[Bounds],
) -> (Vec<Node>, Stop) {
    let mut nodes = vec![from.clone()];
    solver.anchor(&from.pose);
    let mut step = FIRST_STEP * longest(&from.tangent);
    loop {
        let here = nodes[nodes.len() - 1].clone();
        let most = if solver.is_deflated() {
            MOST_DEFLATED_NODES
        } else {
            MOST_NODES
        };
        if nodes.len() > most || far_enough(solver, start, &here) {
            return (nodes, Stop::Budget);
        }
        let before = (nodes.len() > 1).then(|| nodes[nodes.len() - 2].clone());
        let predictor = Predictor::new(solver, before.as_ref(), &here);
        let limit = longest(&here.tangent);
        step = step.min(limit);
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
    far > MOST_TURNS * std::f64::consts::TAU
        || here.arc - start.arc > 40.0 * MOST_TURNS * std::f64::consts::TAU
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

/// The pose between two nodes at which an unknown has a value that lies between theirs.
pub(super) fn at_value(
    solver: &mut Solver,
    from: &Node,
    to: &Node,
    unknown: usize,
    value: f64,
) -> Option<Node> {
    let cubic = Cubic::between(solver, from, to);
    let weight = solver.system.weights()[unknown];
    let wanted = (value - from.pose.values[unknown]) * weight;
    let (mut low, mut high) = (0.0, 1.0);
    let rising = cubic.at(1.0)[unknown] > 0.0;
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if (cubic.at(middle)[unknown] < wanted) == rising {
            low = middle;
        } else {
            high = middle;
        }
    }
    let u = 0.5 * (low + high);
    let mut pose = from.pose.clone();
    solver.system.advance(&mut pose, &cubic.at(u));
    let guess = pose.clone();
    if solver
        .correct(&mut pose, Along::Value(unknown, value))
        .is_none()
    {
        // Too close to a dead centre for the value to single out a pose: cut across the curve instead.
        pose = guess;
        let mut across = cubic.velocity(u);
        let size = length(&across);
        across.iter_mut().for_each(|x| *x /= size);
        solver.correct(&mut pose, Along::Across(&across))?;
    }
    finish(solver, pose, &cubic.velocity(u), from)
}

/// The node at a pose between nodes.
pub(super) fn finish(
    solver: &mut Solver,
    pose: SystemPose,
    toward: &[f64],
    from: &Node,
) -> Option<Node> {
    if !solver.linearise(&pose) {
        return None;
    }
    let mut tangent = solver.tangent().to_vec();
    if dot(&tangent, toward) < 0.0 {
        tangent.iter_mut().for_each(|t| *t = -*t);
    }
    let mut node = Node {
        margin: solver.margin(),
        pose,
        arc: from.arc,
        tangent,
    };
    node.arc += arc_between(solver, from, &node);
    Some(node)
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

/// Poses closer than this (metric) are the same: above the accuracy of corrections at poses of ordinary margin, far below
/// the distance between sheets of a curve that a step can tell apart.
pub(super) const SAME: f64 = 1e-9;
