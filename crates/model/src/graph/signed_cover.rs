//! The shortest cycle with an odd number of marked edges (de Pina 1995; Kavitha, Mehlhorn, Michail & Paluch 2008).
//!
//! In the double cover of the block every node has two copies, a marked edge leads from one copy to the other and an
//! unmarked edge stays. A closed walk with an odd number of marked edges is a path between the two copies of a node, so
//! breadth-first search finds the shortest. The shortest of all is a simple cycle: a walk that passes a node twice splits
//! into two closed walks, one of them odd, and shorter.

use std::cmp::Reverse;

use super::block_graph::{BlockGraph, NONE, to_u32};

/// The edges, in cyclic order, of a shortest cycle with an odd number of `marked` edges, or `None` if there is none.
///
/// `known_minimum`: no such cycle is shorter than this; the search ends when it is met. Every such cycle passes a node
/// with a marked edge, so only these nodes are searched from, the ones with most marked edges first; a node is removed
/// once searched from, and the others' searches are cut at the best length so far.
///
/// # Complexity
/// O(E) for each node searched from; at most as many of these as there are marked edges.
pub(super) fn shortest_odd_cycle(
    block: &BlockGraph,
    marked: &[bool],
    known_minimum: usize,
) -> Option<Vec<u32>> {
    let mut marks = vec![0_u32; block.node_count()];
    for (edge, _) in (0..).zip(marked).filter(|(_, marked)| **marked) {
        for end in block.ends(edge) {
            marks[end as usize] += 1;
        }
    }
    let mut starts: Vec<u32> = (0..block.node_count())
        .filter(|&node| marks[node] > 0)
        .map(to_u32)
        .collect();
    starts.sort_by_key(|&node| (Reverse(marks[node as usize]), node));

    let mut search = Search {
        block,
        marked,
        removed: vec![false; block.node_count()],
        stamp: vec![0; 2 * block.node_count()],
        above: vec![(NONE, NONE); 2 * block.node_count()],
        queue: Vec::new(),
        clock: 0,
    };
    let mut best: Option<Vec<u32>> = None;
    for start in starts {
        let limit = best.as_ref().map_or(usize::MAX, Vec::len);
        if limit <= known_minimum {
            break;
        }
        if marks[start as usize] == 0 {
            continue;
        }
        if let Some(shorter) = search.shorter_than(start, limit) {
            best = Some(shorter);
        }
        search.removed[start as usize] = true;
        for &(edge, other) in block.incident(start) {
            if marked[edge as usize] {
                marks[other as usize] = marks[other as usize].saturating_sub(1);
            }
        }
    }
    best
}

struct Search<'a> {
    block: &'a BlockGraph,
    marked: &'a [bool],
    removed: Vec<bool>,
    /// The start for which a state's entry was written; state 2n + p is copy p of node n.
    stamp: Vec<u32>,
    /// Edge and state before.
    above: Vec<(u32, u32)>,
    /// State and its depth.
    queue: Vec<(u32, usize)>,
    clock: u32,
}

impl Search<'_> {
    fn shorter_than(&mut self, start: u32, limit: usize) -> Option<Vec<u32>> {
        let goal = 2 * start + 1;
        self.clock += 1;
        self.queue.clear();
        self.queue.push((2 * start, 0));
        self.stamp[2 * start as usize] = self.clock;
        let mut next = 0;
        while let Some(&(state, depth)) = self.queue.get(next) {
            next += 1;
            if depth + 1 >= limit {
                return None;
            }
            for &(edge, other) in self.block.incident(state / 2) {
                if self.removed[other as usize] {
                    continue;
                }
                let reached = 2 * other + ((state % 2) ^ u32::from(self.marked[edge as usize]));
                if self.stamp[reached as usize] == self.clock {
                    continue;
                }
                self.stamp[reached as usize] = self.clock;
                self.above[reached as usize] = (edge, state);
                if reached == goal {
                    return Some(self.path(goal, 2 * start));
                }
                self.queue.push((reached, depth + 1));
            }
        }
        None
    }

    fn path(&self, mut state: u32, start: u32) -> Vec<u32> {
        let mut edges = Vec::new();
        while state != start {
            let (edge, before) = self.above[state as usize];
            edges.push(edge);
            state = before;
        }
        edges
    }
}
