//! Candidates for a minimum cycle basis, by length.
//!
//! Horton (1987): a minimum basis can be found among the cycles made of an edge and the tree paths from its ends to a root,
//! with a shortest path tree for every root. Two reductions keep the set small here, where every edge counts one.
//!
//! Let Z(L) be the span of all cycles of at most L edges. *Claim:* if v lies on a cycle C of length L, then C is in the
//! span of Z(L − 1) and v's candidates of length L whose two paths meet only at v, for any breadth-first tree from v.
//! *Proof.* For L = 2k + 1 let e be the edge of C opposite v; the two arcs from v to its ends have length k, the tree paths
//! to these ends at most k. Replacing each arc by its tree path changes C by closed walks of at most 2k edges, which are in
//! Z(L − 1). For L = 2k let w be the node opposite v and e, f its edges on C. Take the tree path to w twice: C is the sum
//! of the candidates of e and f and of the two differences between arcs and tree paths of at most k − 1 edges each. In
//! either case a candidate shorter than L is in Z(L − 1), and so is one whose paths meet before v, since the part they
//! share cancels. ∎
//!
//! So for each length it is enough to have one root on every cycle. Roots are therefore visited in a fixed order, and each
//! is removed once visited: a cycle is found from its first root, in a graph where it is still whole. In a block with two
//! or more loops every cycle has a node of degree three or more, so only such nodes are roots.

use std::cmp::Reverse;
use std::ops::ControlFlow;

use super::block_graph::{BlockGraph, NONE, to_u32};

/// The candidates of a block with at least two loops, and the scratch space for finding them.
#[derive(Debug)]
pub(super) struct ShortCycles<'a> {
    block: &'a BlockGraph,
    /// By falling degree, then by name.
    roots: Vec<u32>,
    /// Position of each node among the roots, [`NONE`] if it is none.
    turn: Vec<u32>,
    /// How many incidences have been looked at in all.
    work: u64,
    /// The root for which a node's entries below were written, as a running number.
    stamp: Vec<u64>,
    clock: u64,
    depth: Vec<u32>,
    /// Position in the queue.
    position: Vec<u32>,
    /// Edge and node above, in the breadth-first tree.
    above: Vec<(u32, u32)>,
    /// The root's child through which the node is reached; the root itself for the root.
    branch: Vec<u32>,
    queue: Vec<u32>,
    walk: Vec<u32>,
}

impl<'a> ShortCycles<'a> {
    pub(super) fn new(block: &'a BlockGraph) -> Self {
        let nodes = block.node_count();
        let mut roots: Vec<u32> = (0..nodes)
            .filter(|&node| block.degree(node) >= 3)
            .map(to_u32)
            .collect();
        roots.sort_by_key(|&node| (Reverse(block.degree(node as usize)), node));
        let mut turn = vec![NONE; nodes];
        for (position, &root) in (0..).zip(&roots) {
            turn[root as usize] = position;
        }
        Self {
            block,
            roots,
            turn,
            work: 0,
            stamp: vec![0; nodes],
            clock: 0,
            depth: vec![0; nodes],
            position: vec![0; nodes],
            above: vec![(NONE, NONE); nodes],
            branch: vec![NONE; nodes],
            queue: Vec::new(),
            walk: Vec::new(),
        }
    }

    /// How many incidences the searches so far have looked at.
    pub(super) fn work(&self) -> u64 {
        self.work
    }

    /// Calls `visit` with the edges of each candidate of exactly this length, in cyclic order, until it breaks.
    pub(super) fn of_length(
        &mut self,
        length: u32,
        mut visit: impl FnMut(&[u32]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for turn in 0..self.roots.len() {
            self.search_root(turn, length, &mut visit)?;
        }
        ControlFlow::Continue(())
    }

    fn search_root(
        &mut self,
        turn: usize,
        length: u32,
        visit: &mut impl FnMut(&[u32]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let root = self.roots[turn];
        let half = length / 2;
        let odd = length % 2 == 1;
        self.clock += 1;
        self.queue.clear();
        self.reach(root, 0, (NONE, NONE), root);
        let mut next = 0;
        while let Some(&here) = self.queue.get(next) {
            next += 1;
            let depth = self.depth[here as usize];
            // An even candidate closes from depth half − 1 to half, an odd one within depth half.
            if depth > half || (depth == half && !odd) {
                break;
            }
            let block = self.block;
            for &(edge, there) in block.incident(here) {
                self.work += 1;
                let node = there as usize;
                if (self.turn[node] as usize) < turn {
                    continue;
                }
                if self.stamp[node] != self.clock {
                    if depth < half {
                        let branch = if here == root {
                            there
                        } else {
                            self.branch[here as usize]
                        };
                        self.reach(there, depth + 1, (edge, here), branch);
                    }
                    continue;
                }
                let closes = depth + self.depth[node] + 1 == length
                    && self.branch[here as usize] != self.branch[node]
                    && self.above[here as usize].0 != edge
                    && self.above[node].0 != edge;
                // Within one depth both ends see the edge; the later one reports it.
                let first_sight =
                    depth == self.depth[node] && self.position[here as usize] < self.position[node];
                if closes && !first_sight {
                    self.write_walk(here, edge, there);
                    visit(&self.walk)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    fn reach(&mut self, node: u32, depth: u32, above: (u32, u32), branch: u32) {
        let index = node as usize;
        self.stamp[index] = self.clock;
        self.depth[index] = depth;
        self.position[index] = to_u32(self.queue.len());
        self.above[index] = above;
        self.branch[index] = branch;
        self.queue.push(node);
    }

    fn write_walk(&mut self, from: u32, edge: u32, to: u32) {
        self.walk.clear();
        self.climb(from);
        self.walk.reverse();
        self.walk.push(edge);
        self.climb(to);
    }

    fn climb(&mut self, mut node: u32) {
        loop {
            let (edge, above) = self.above[node as usize];
            if edge == NONE {
                return;
            }
            self.walk.push(edge);
            node = above;
        }
    }
}
