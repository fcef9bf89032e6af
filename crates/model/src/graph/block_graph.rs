//! One biconnected block on its own, numbered so that comparing numbers compares names.

use super::components::Block;
use super::constraint_graph::ConstraintGraph;

/// Marks the absence of a node, edge or chord.
pub(super) const NONE: u32 = u32::MAX;

/// A block with nodes and edges renumbered from 0 in the order of their names.
#[derive(Debug)]
pub(super) struct BlockGraph {
    /// Graph edge index of each local edge.
    edges: Vec<usize>,
    ends: Vec<[u32; 2]>,
    /// (edge, other end) of all nodes one after the other, those of node `n` at `first[n]..first[n + 1]`.
    incidences: Vec<(u32, u32)>,
    first: Vec<usize>,
    /// Number of each edge among the chords of a breadth-first tree, [`NONE`] for the edges of that tree.
    chord: Vec<u32>,
    loops: usize,
}

impl BlockGraph {
    /// `local` is scratch space of one entry for each node of the graph; its contents do not matter.
    pub(super) fn new(graph: &ConstraintGraph, block: &Block, local: &mut [u32]) -> Self {
        for (number, &node) in (0..).zip(&block.nodes) {
            local[node] = number;
        }
        let ends: Vec<[u32; 2]> = block
            .edges
            .iter()
            .map(|&edge| graph.edge(edge).ends.map(|node| local[node]))
            .collect();
        let nodes = block.nodes.len();
        let mut first = vec![0; nodes + 1];
        for &end in ends.iter().flatten() {
            first[end as usize + 1] += 1;
        }
        for node in 0..nodes {
            first[node + 1] += first[node];
        }
        let mut next = first.clone();
        let mut incidences = vec![(0, 0); 2 * ends.len()];
        for (edge, &[a, b]) in (0..).zip(&ends) {
            for (here, there) in [(a, b), (b, a)] {
                incidences[next[here as usize]] = (edge, there);
                next[here as usize] += 1;
            }
        }
        let mut result = Self {
            edges: block.edges.clone(),
            ends,
            incidences,
            first,
            chord: Vec::new(),
            loops: block.loop_count(),
        };
        result.number_chords();
        result
    }

    /// Chords are numbered as a breadth-first search closes them, so that short cycles have chords of nearby numbers and
    /// elimination by the largest number fills in little.
    fn number_chords(&mut self) {
        let nodes = self.node_count();
        let mut position = vec![NONE; nodes];
        let mut in_tree = vec![false; self.edge_count()];
        let root = (0..nodes).max_by_key(|&n| (self.degree(n), std::cmp::Reverse(n)));
        let mut queue: Vec<u32> = Vec::with_capacity(nodes);
        if let Some(root) = root {
            position[root] = 0;
            queue.push(to_u32(root));
        }
        let mut next = 0;
        while let Some(&node) = queue.get(next) {
            next += 1;
            for &(edge, other) in self.incident(node) {
                if position[other as usize] == NONE {
                    position[other as usize] = to_u32(queue.len());
                    in_tree[edge as usize] = true;
                    queue.push(other);
                }
            }
        }
        let mut chords: Vec<usize> = (0..self.edge_count()).filter(|&e| !in_tree[e]).collect();
        chords.sort_by_key(|&edge| {
            let [a, b] = self.ends[edge].map(|node| position[node as usize]);
            (a.max(b), a.min(b), edge)
        });
        self.chord = vec![NONE; self.edge_count()];
        for (number, &edge) in (0..).zip(&chords) {
            self.chord[edge] = number;
        }
    }

    pub(super) fn node_count(&self) -> usize {
        self.first.len() - 1
    }

    pub(super) fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// Dimension of the cycle space.
    pub(super) fn loop_count(&self) -> usize {
        self.loops
    }

    pub(super) fn degree(&self, node: usize) -> usize {
        self.first[node + 1] - self.first[node]
    }

    pub(super) fn incident(&self, node: u32) -> &[(u32, u32)] {
        let node = node as usize;
        &self.incidences[self.first[node]..self.first[node + 1]]
    }

    pub(super) fn ends(&self, edge: u32) -> [u32; 2] {
        self.ends[edge as usize]
    }

    /// The chord numbers of some edges. A vector of the cycle space is known by its chords alone.
    pub(super) fn chords<'a>(&'a self, edges: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
        edges
            .iter()
            .map(|&edge| self.chord[edge as usize])
            .filter(|&chord| chord != NONE)
    }

    /// Whether each edge is a chord with its number in `chords`, which must ascend.
    pub(super) fn edges_of_chords(&self, chords: &[u32]) -> Vec<bool> {
        self.chord
            .iter()
            .map(|chord| chords.binary_search(chord).is_ok())
            .collect()
    }

    /// Graph edge indices of local edges.
    pub(super) fn graph_edges(&self, edges: &[u32]) -> Vec<usize> {
        edges.iter().map(|&e| self.edges[e as usize]).collect()
    }
}

/// Blocks of more than 2³² − 2 nodes or edges do not fit into petgraph's indices either.
pub(super) fn to_u32(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(NONE)
}
