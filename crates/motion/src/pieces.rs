//! A curve put together from nodes and passages through singular poses.

use super::cubic::{Cubic, arc_between};
use super::curve::Shape;
use super::node::Node;
use super::singular::{Singular, locate};
use super::solver::Solver;
use super::system::SystemPose;
use super::vectors::{dot, length};

/// The nodes of a curve, each with the passage that begins at it.
pub(super) type Pieces = Vec<(Node, Option<Singular>)>;

/// The pieces of a closed curve without cusps, given by its nodes from the start to the start. It is cut open where it is
/// most regular, so that no passage lies across the cut, and put together again.
pub(super) fn bridge_closed(solver: &mut Solver, nodes: &[Node]) -> Pieces {
    let (Some(first), Some(last)) = (nodes.first(), nodes.last()) else {
        return Vec::new();
    };
    let around: Vec<f64> = first
        .pose
        .values
        .iter()
        .zip(&last.pose.values)
        .map(|(a, b)| b - a)
        .collect();
    let cut = (0..nodes.len() - 1)
        .max_by(|a, b| nodes[*a].margin.total_cmp(&nodes[*b].margin).then(b.cmp(a)))
        .unwrap_or(0);
    let span = last.arc - first.arc;
    let mut turned: Vec<Node> = nodes[cut..].to_vec();
    turned.extend(nodes[1..=cut].iter().map(|node| {
        let mut node = node.clone();
        node.arc += span;
        shift(&mut node, &around);
        node
    }));
    let mut start = nodes.len() - 1 - cut;
    let pieces = bridge_open(solver, &turned, &mut start);
    if cut == 0 {
        return pieces;
    }
    // The start first again; what came before it comes last, counted on.
    let back: Vec<f64> = around.iter().map(|x| -x).collect();
    let mut whole: Pieces = Vec::with_capacity(pieces.len());
    for (mut node, singular) in pieces[start..pieces.len() - 1].iter().cloned() {
        shift(&mut node, &back);
        let singular = singular.map(|mut s| {
            s.bridge.shift(&back);
            shift_pose(&mut s.pose, &back);
            s
        });
        whole.push((node, singular));
    }
    whole.extend(pieces[..=start].iter().cloned());
    whole
}

fn shift(node: &mut Node, around: &[f64]) {
    shift_pose(&mut node.pose, around);
}

fn shift_pose(pose: &mut SystemPose, around: &[f64]) {
    for (value, way) in pose.values.iter_mut().zip(around) {
        *value += way;
    }
}

/// The pieces of a list of nodes: those inside a passage left out, and every passage with the node it begins at. `start` is
/// the index of a node that stays one.
pub(super) fn bridge_open(solver: &mut Solver, nodes: &[Node], start: &mut usize) -> Pieces {
    let margins: Vec<f64> = nodes.iter().map(|n| n.margin).collect();
    let mut candidates: Vec<usize> = (1..nodes.len().saturating_sub(1))
        .filter(|&i| margins[i] <= margins[i - 1] && margins[i] < margins[i + 1])
        .collect();
    // A singular pose close to an end shows as the least margin there.
    if nodes.len() > 3 && margins[0] < margins[1] {
        candidates.insert(0, 1);
    }
    if nodes.len() > 3 && margins[nodes.len() - 1] < margins[nodes.len() - 2] {
        candidates.push(nodes.len() - 2);
    }
    let mut found: Vec<Singular> = Vec::new();
    let begin = nodes[*start].arc;
    for at in candidates {
        let mut clear = (f64::NEG_INFINITY, f64::INFINITY);
        if let Some(last) = found.last() {
            clear.0 = last.after.arc;
        }
        // The start stays outside; where it is the candidate itself, both sides of it are looked at.
        let sides = match nodes[at].arc.total_cmp(&begin) {
            std::cmp::Ordering::Greater if at <= *start + 2 => {
                vec![(begin, clear.1), (clear.0, begin)]
            }
            std::cmp::Ordering::Greater => vec![(clear.0.max(begin), clear.1)],
            std::cmp::Ordering::Less if at + 2 >= *start => {
                vec![(clear.0, begin), (begin, clear.1)]
            }
            std::cmp::Ordering::Less => vec![(clear.0, begin)],
            std::cmp::Ordering::Equal => vec![(clear.0, begin), (begin, clear.1)],
        };
        for side in sides {
            let Some(mut singular) = locate(solver, nodes, at, side) else {
                continue;
            };
            place(solver, nodes, &mut singular);
            if found
                .last()
                .is_none_or(|l| singular.before.arc >= l.after.arc - 1e-12)
            {
                found.push(singular);
                break;
            }
        }
    }
    let mut kept: Vec<(Node, Option<Singular>)> = Vec::new();
    let mut pending = found.into_iter().peekable();
    let mut new_start = 0;
    for (index, node) in nodes.iter().enumerate() {
        while pending
            .peek()
            .is_some_and(|s| s.before.arc <= node.arc - 1e-12)
        {
            if let Some(singular) = pending.next() {
                let after = singular.after.clone();
                kept.push((singular.before.clone(), Some(singular)));
                kept.push((after, None));
            }
        }
        let inside = kept
            .last()
            .is_some_and(|(last, _)| node.arc <= last.arc + 1e-9 * (1.0 + last.arc.abs()));
        if index == *start {
            if inside && kept.len() > 1 && kept.last().is_some_and(|(_, s)| s.is_none()) {
                kept.pop();
            }
            new_start = kept.len();
            kept.push((node.clone(), None));
        } else if !inside {
            kept.push((node.clone(), None));
        }
    }
    *start = new_start;
    kept
}

/// What a curve consists of.
pub(super) struct Assembled {
    pub nodes: Vec<Node>,
    /// Between neighbouring nodes.
    pub shapes: Vec<Shape>,
    /// Singular poses with their arclengths.
    pub singular: Vec<(f64, Singular)>,
}

/// Arclengths along the pieces, counted from the start; shapes between nodes.
pub(super) fn assemble(solver: &Solver, pieces: Pieces, start: usize) -> Assembled {
    let mut shapes = Vec::new();
    let mut singular = Vec::new();
    let mut arc = 0.0;
    let mut arcs = vec![0.0];
    for pair in pieces.windows(2) {
        let (shape, gap) = match &pair[0].1 {
            Some(passed) => {
                let length = passed.bridge.arc();
                singular.push((arc + passed.bridge.middle() * length, passed.clone()));
                (Shape::Bridge(Box::new(passed.bridge.clone())), length)
            }
            None => {
                let (a, b) = (&pair[0].0, &pair[1].0);
                (
                    Shape::Cubic(Cubic::between(solver, a, b)),
                    arc_between(solver, a, b),
                )
            }
        };
        shapes.push(shape);
        arc += gap;
        arcs.push(arc);
    }
    let zero = arcs.get(start).copied().unwrap_or(0.0);
    for entry in &mut singular {
        entry.0 -= zero;
    }
    let nodes = pieces
        .into_iter()
        .zip(&arcs)
        .map(|((mut node, _), arc)| {
            node.arc = arc - zero;
            node
        })
        .collect();
    Assembled {
        nodes,
        shapes,
        singular,
    }
}

/// The arclengths of a passage on the curve it belongs to.
fn place(solver: &Solver, nodes: &[Node], singular: &mut Singular) {
    let nearest = |node: &Node| {
        let mut way = vec![0.0; node.tangent.len()];
        let mut best = nodes[0].arc;
        let mut least = f64::INFINITY;
        for known in nodes {
            solver.system.way(&known.pose, &node.pose, &mut way);
            let far = length(&way);
            if far < least {
                least = far;
                let ahead = dot(&way, &known.tangent);
                best = known.arc + far.copysign(ahead);
            }
        }
        best
    };
    singular.before.arc = nearest(&singular.before);
    singular.after.arc = nearest(&singular.after);
}
