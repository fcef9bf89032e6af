//! The whole curve through a start: both ways from it, through cusps, with the passages through singular poses.

use super::cusp::pass_cusp;
use super::follow::{Bounds, Stop, follow};
use super::node::Node;
use super::pieces::{Assembled, Pieces, assemble, bridge_closed, bridge_open};
use super::singular::Singular;
use super::solver::Solver;

/// A curve and how it ends.
pub(super) struct Walked {
    pub assembled: Assembled,
    /// Index of the start among the nodes.
    pub start: usize,
    /// What stopped it behind and ahead.
    pub stops: [Stop; 2],
    pub closed: bool,
}

/// A stretch between cusps, and the cusp at its end.
type Leg = (Vec<Node>, Option<Singular>);

/// More cusps are not passed.
const MOST_CUSPS: usize = 16;

/// One way from the start: stretches with the cusps between them.
fn one_way(solver: &mut Solver, start: &Node, bounds: &[Bounds]) -> (Vec<Leg>, Stop) {
    let mut legs: Vec<Leg> = Vec::new();
    let mut from = start.clone();
    loop {
        let (mut nodes, stop) = follow(solver, start, &from, bounds, f64::INFINITY);
        if stop == Stop::Stuck
            && legs.len() < MOST_CUSPS
            && let Some((kept, cusp)) = pass_cusp(solver, &nodes, start)
        {
            nodes.truncate(kept);
            nodes.push(cusp.before.clone());
            from = cusp.after.clone();
            legs.push((nodes, Some(cusp)));
            continue;
        }
        legs.push((nodes, None));
        return (legs, stop);
    }
}

pub(super) fn walk(solver: &mut Solver, start: &Node, bounds: &[Bounds]) -> Walked {
    let (mut ahead, stop) = one_way(solver, start, bounds);
    if stop == Stop::Closed && ahead.len() == 1 {
        let pieces = bridge_closed(solver, &ahead[0].0);
        return Walked {
            assembled: assemble(solver, pieces, 0),
            start: 0,
            stops: [Stop::Closed, Stop::Closed],
            closed: true,
        };
    }
    let closed = stop == Stop::Closed;
    let mut stops = [stop.clone(), stop];
    let mut behind: Vec<Leg> = Vec::new();
    if !closed {
        let mut back = start.clone();
        reverse(&mut back);
        (behind, stops[0]) = one_way(solver, &back, bounds);
    }
    // Where a cusp stands in the way ahead, the way back may come round: then it is all there is.
    let round_behind = !closed && stops[0] == Stop::Closed;
    if round_behind {
        ahead.clear();
        stops[1] = Stop::Closed;
    }
    let closed = closed || round_behind;
    // The stretch with the start in it, put together from both sides.
    let mut at = 0;
    let mut legs: Vec<Leg> = Vec::new();
    if !behind.is_empty() {
        let cusps: Vec<Option<Singular>> = behind.iter().map(|l| l.1.clone()).collect();
        let count = behind.len();
        for (index, (mut nodes, _)) in behind.into_iter().enumerate().rev() {
            nodes.iter_mut().for_each(reverse);
            nodes.reverse();
            let cusp = index
                .checked_sub(1)
                .and_then(|i| cusps[i].clone())
                .map(|mut cusp| {
                    cusp.bridge.reverse();
                    reverse(&mut cusp.before);
                    reverse(&mut cusp.after);
                    std::mem::swap(&mut cusp.before, &mut cusp.after);
                    cusp
                });
            legs.push((nodes, cusp));
        }
        debug_assert_eq!(legs.len(), count);
        if let Some((nodes, cusp)) = legs.last_mut() {
            at = nodes.len() - 1;
            if !ahead.is_empty() {
                let first = ahead.remove(0);
                nodes.extend(first.0.into_iter().skip(1));
                *cusp = first.1;
            }
        }
    }
    let own = legs.len().saturating_sub(1);
    legs.append(&mut ahead);
    let mut pieces: Pieces = Vec::new();
    let mut start_index = 0;
    for (index, (nodes, cusp)) in legs.into_iter().enumerate() {
        let mut inside = if index == own { at } else { 0 };
        let mut own_pieces = bridge_open(solver, &nodes, &mut inside);
        if index == own {
            start_index = pieces.len() + inside;
        }
        if let (Some(last), Some(cusp)) = (own_pieces.last_mut(), cusp) {
            last.1 = Some(cusp);
        }
        pieces.append(&mut own_pieces);
    }
    Walked {
        assembled: assemble(solver, pieces, start_index),
        start: start_index,
        stops,
        closed,
    }
}

fn reverse(node: &mut Node) {
    node.arc = -node.arc;
    node.tangent.iter_mut().for_each(|t| *t = -*t);
}
