//! A cycle basis with as few edges in all as possible, and the check that it is fit for solving at a distance.
//!
//! # Method
//! The minimum basis is greedy: going through cycles by length and keeping those independent of the ones kept before gives
//! the least total (the cycle space is a matroid). It is found block by block, since no cycle leaves its biconnected block.
//!
//! 1. Candidates of length 2, 3, 4, … come from bounded breadth-first searches (file `short_cycles`) and are tested for
//!    independence over GF(2) (file `gf2`).
//! 2. Where several lengths in a row bring nothing new, as for a chain of short loops closed to a ring, the few
//!    dimensions left are finished one by one: a vector orthogonal to all cycles so far is taken as a set of marked edges,
//!    and the next cycle is a shortest one with an odd number of them (file `signed_cover`; de Pina 1995).
//!
//! Both are exact, so the moment of changing over decides only about time. It comes when the searches that brought
//! nothing have cost as much as the rest is expected to cost the other way.
//!
//! # Fitness
//! Closing the cycles of a basis at the pose at hand closes all loops near that pose. Farther away this needs that every
//! loop be a product of the basis cycles taken along paths, which independence alone does not give. It holds for bases
//! that *peel*: there is an order of removing cycles such that each owns an edge that no cycle remaining has (weakly
//! fundamental bases; Liebchen & Rizzi 2007). Fundamental cycles of a tree always peel, their chords being such edges.

use std::ops::ControlFlow;

use serde::Serialize;

use super::block_graph::{BlockGraph, NONE};
use super::components::Block;
use super::constraint_graph::ConstraintGraph;
use super::cycles::{Cycle, fundamental_cycle};
use super::gf2::Eliminator;
use super::short_cycles::ShortCycles;
use super::signed_cover::shortest_odd_cycle;
use super::spanning_tree::SpanningTree;

/// Cycles through which all others can be expressed, each once.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CycleBasis {
    /// The cycles by length, then by the names of their edges in the order of the walk.
    pub cycles: Vec<Cycle>,
    /// Which basis this is.
    pub kind: BasisKind,
}

/// Which basis was handed out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BasisKind {
    /// The total number of edges is the least possible, and the basis peels.
    MinimumLength,
    /// In some blocks the minimum basis found does not peel; there the fundamental cycles of the spanning tree stand in its
    /// place. Elsewhere the basis is minimal.
    WithFundamentalBlocks {
        /// Positions of these blocks in [`ConstraintGraph::blocks`].
        blocks: Vec<usize>,
    },
}

impl CycleBasis {
    /// A cycle basis of minimum total length that peels; where there is doubt, the cycles of `tree` instead.
    ///
    /// A minimum basis is not unique in general. Which one is returned depends on the names only.
    ///
    /// # Complexity
    /// For cycles of bounded length in a graph of bounded degree linear, apart from the elimination, whose fill-in is small
    /// for chains and lattices.
    #[must_use]
    pub fn minimum(graph: &ConstraintGraph, tree: &SpanningTree) -> Self {
        let mut local = vec![NONE; graph.node_count()];
        let mut cycles = Vec::new();
        let mut doubtful = Vec::new();
        for (position, block) in graph.blocks().iter().enumerate() {
            if block.bridge {
                continue;
            }
            let block_graph = BlockGraph::new(graph, block, &mut local);
            let shortest: Vec<Cycle> = minimum_cycles(&block_graph, PATIENCE)
                .iter()
                .filter_map(|walk| Cycle::from_walk(graph, &block_graph.graph_edges(walk)))
                .collect();
            let (fit, fundamental) = fit_or_fundamental(graph, tree, block, shortest);
            cycles.extend(fit);
            if fundamental {
                doubtful.push(position);
            }
        }
        cycles.sort_by_cached_key(|cycle| {
            let ranks = cycle.edges.iter().map(|&(edge, _)| graph.edge_rank(edge));
            (cycle.len(), ranks.collect::<Vec<_>>())
        });
        Self {
            cycles,
            kind: if doubtful.is_empty() {
                BasisKind::MinimumLength
            } else {
                BasisKind::WithFundamentalBlocks { blocks: doubtful }
            },
        }
    }

    /// Number of edges in all cycles together.
    #[must_use]
    pub fn total_length(&self) -> usize {
        self.cycles.iter().map(Cycle::len).sum()
    }

    /// Number of edges of the longest cycle, 0 if there is none.
    #[must_use]
    pub fn longest(&self) -> usize {
        self.cycles.iter().map(Cycle::len).max().unwrap_or(0)
    }
}

/// The cycles given, if they are as many as the block has loops and peel; otherwise those of the tree, and `true`.
fn fit_or_fundamental(
    graph: &ConstraintGraph,
    tree: &SpanningTree,
    block: &Block,
    shortest: Vec<Cycle>,
) -> (Vec<Cycle>, bool) {
    if shortest.len() == block.loop_count() && peels(&shortest) {
        return (shortest, false);
    }
    // The part of a spanning tree within a block spans the block, so these cycles stay within.
    let chords = block.edges.iter().filter(|&&edge| !tree.contains(edge));
    let cycles = chords.filter_map(|&chord| fundamental_cycle(graph, tree, chord));
    (cycles.collect(), true)
}

/// Whether the cycles can be removed one after the other, each owning, when its turn comes, an edge that no cycle
/// remaining has. Such cycles are independent; if there are as many as the graph has loops, they are a weakly fundamental
/// basis and closing them closes every loop.
///
/// The order of removal does not matter: removing one cycle never takes an edge of its own from another.
///
/// # Complexity
/// Linear in the total length and the largest edge index.
#[must_use]
pub fn peels(cycles: &[Cycle]) -> bool {
    let edges = || cycles.iter().flat_map(|cycle| &cycle.edges);
    let size = edges().map(|&(edge, _)| edge + 1).max().unwrap_or(0);
    // The exclusive or of the positions of all cycles through an edge is, once one is left, the position of that one.
    let mut through = vec![(0_usize, 0_usize); size];
    for (position, cycle) in cycles.iter().enumerate() {
        for &(edge, _) in &cycle.edges {
            through[edge].0 += 1;
            through[edge].1 ^= position;
        }
    }
    let owners = through.iter().filter(|(count, _)| *count == 1);
    let mut ready: Vec<usize> = owners.map(|&(_, owner)| owner).collect();
    let mut removed = vec![false; cycles.len()];
    let mut left = cycles.len();
    while let Some(position) = ready.pop() {
        if std::mem::replace(&mut removed[position], true) {
            continue;
        }
        left -= 1;
        for &(edge, _) in &cycles[position].edges {
            through[edge].0 -= 1;
            through[edge].1 ^= position;
            if through[edge].0 == 1 {
                ready.push(through[edge].1);
            }
        }
    }
    left == 0
}

/// A search in the double cover looks at each of its 2E edges from both ends; vain searches may cost this much for each
/// dimension still open.
const PATIENCE: u64 = 4;

/// Walks in cyclic order of a minimum cycle basis of the block, shortest first.
fn minimum_cycles(block: &BlockGraph, patience: u64) -> Vec<Vec<u32>> {
    let loops = block.loop_count();
    let mut rows = Eliminator::new(loops);
    let mut basis: Vec<Vec<u32>> = Vec::with_capacity(loops);
    let mut length = 1;
    // A single loop has no node of degree three to search from; the double cover finds it at once.
    if loops > 1 {
        let mut candidates = ShortCycles::new(block);
        let mut in_vain = 0;
        for next in 2..=u32::try_from(block.node_count()).unwrap_or(u32::MAX) {
            let open = (loops - rows.rank()) as u64;
            if in_vain > patience * open * block.edge_count() as u64 {
                break;
            }
            let work = candidates.work();
            let before = rows.rank();
            let outcome = candidates.of_length(next, |walk| {
                if rows.insert(block.chords(walk)) {
                    basis.push(walk.to_vec());
                }
                if rows.rank() == loops {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            });
            if outcome.is_break() {
                return basis;
            }
            length = next as usize;
            if rows.rank() == before {
                in_vain += candidates.work() - work;
            } else {
                in_vain = 0;
            }
        }
    }
    finish(block, rows.annihilators(), length + 1, &mut basis);
    basis
}

/// Adds a cycle for each support vector, all cycles shorter than `minimum` being spanned already.
fn finish(
    block: &BlockGraph,
    mut supports: Vec<Vec<u32>>,
    minimum: usize,
    basis: &mut Vec<Vec<u32>>,
) {
    // From the sparsest: fewer marked edges, fewer searches. Sorting is stable, so the order stays one of names.
    supports.sort_by_key(|support| std::cmp::Reverse(support.len()));
    let mut found = Vec::new();
    while let Some(support) = supports.pop() {
        let marked = block.edges_of_chords(&support);
        let Some(walk) = shortest_odd_cycle(block, &marked, minimum) else {
            continue;
        };
        // The vectors left must be orthogonal to the new cycle as well.
        let mut chords: Vec<u32> = block.chords(&walk).collect();
        chords.sort_unstable();
        for other in &mut supports {
            let common = other
                .iter()
                .filter(|c| chords.binary_search(c).is_ok())
                .count();
            if common % 2 == 1 {
                *other = symmetric_difference(other, &support);
            }
        }
        found.push(walk);
    }
    found.sort_by_key(Vec::len);
    basis.append(&mut found);
}

fn symmetric_difference(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut result: Vec<u32> = a.iter().chain(b).copied().collect();
    result.sort_unstable();
    result
        .chunk_by(|x, y| x == y)
        .filter(|run| run.len() % 2 == 1)
        .map(|run| run[0])
        .collect()
}

#[cfg(test)]
mod tests;
