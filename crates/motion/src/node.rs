//! Nodes of a curve: poses of the branch with tangent, margin and arclength.

use super::cubic::{Cubic, arc_between};
use super::solver::{Along, Solver};
use super::system::SystemPose;
use super::vectors::{dot, length};

/// Poses closer than this (metric) are the same: above the accuracy of corrections at poses of ordinary margin, far below
/// the distance between sheets of a curve that a step can tell apart.
pub(super) const SAME: f64 = 1e-9;

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
