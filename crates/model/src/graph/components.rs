//! What hangs together: connected components, biconnected blocks, and blocks tied by couplings.
//!
//! Two edges belong to the same biconnected block exactly if some cycle runs through both. No cycle leaves its block, so
//! loops, rank and mobility of different blocks have nothing to do with each other, unless a coupling writes an equation
//! over joints of both.

use petgraph::unionfind::UnionFind;
use serde::Serialize;

use super::constraint_graph::ConstraintGraph;

/// A biconnected block: a largest set of edges any two of which lie on a common cycle, or a single bridge.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Block {
    /// Edge indices, by name. Every edge of the graph is in exactly one block.
    pub edges: Vec<usize>,
    /// Indices of the nodes at these edges, by name. A node may be in several blocks.
    pub nodes: Vec<usize>,
    /// Whether the block is one edge that lies on no cycle. Two parallel edges are a block, and not a bridge.
    pub bridge: bool,
    /// Indices of the couplings that use at least one of the edges, by name.
    pub couplings: Vec<usize>,
}

impl Block {
    /// Number of independent cycles in the block.
    #[must_use]
    pub fn loop_count(&self) -> usize {
        self.edges.len() + 1 - self.nodes.len()
    }
}

/// Blocks that couplings tie together: the smallest part of a mechanism that can be analysed alone.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CoupledBlock {
    /// Positions in [`ConstraintGraph::blocks`], ascending.
    pub blocks: Vec<usize>,
    /// Edge indices of all of them, by name.
    pub edges: Vec<usize>,
    /// Node indices of all of them, by name, each once.
    pub nodes: Vec<usize>,
    /// Indices of the couplings that hold them together or lie within, by name.
    pub couplings: Vec<usize>,
}

impl ConstraintGraph {
    /// The connected components as lists of nodes by name: that of the ground first, the others by their first name.
    ///
    /// # Complexity
    /// O(V log V + E).
    #[must_use]
    pub fn components(&self) -> Vec<Vec<usize>> {
        let mut seen = vec![false; self.node_count()];
        let mut components = Vec::new();
        let starts = std::iter::once(self.ground()).chain(self.nodes_by_name().iter().copied());
        for start in starts {
            if std::mem::replace(&mut seen[start], true) {
                continue;
            }
            let mut members = vec![start];
            let mut next = 0;
            while let Some(&node) = members.get(next) {
                next += 1;
                for incidence in self.incident(node) {
                    if !std::mem::replace(&mut seen[incidence.node], true) {
                        members.push(incidence.node);
                    }
                }
            }
            members.sort_unstable_by_key(|&node| self.node_rank(node));
            components.push(members);
        }
        components
    }

    /// The biconnected blocks, ordered by the name of their first edge. Links without joints are in none.
    ///
    /// Depth-first search with low points (Hopcroft & Tarjan 1973, Algorithm 447), written with an explicit stack because
    /// chains may be deeper than the call stack, and comparing edges instead of parents because edges may be parallel.
    ///
    /// # Complexity
    /// O((V + E) log E), the logarithm for sorting by name.
    #[must_use]
    pub fn blocks(&self) -> Vec<Block> {
        let mut blocks: Vec<Block> = self
            .biconnected_edge_sets()
            .into_iter()
            .map(|edges| self.block_of(edges))
            .collect();
        blocks.sort_unstable_by_key(|block| self.edge_rank(block.edges[0]));

        let block_of_edge = self.block_of_each_edge(&blocks);
        for coupling in self.couplings_by_name() {
            for &edge in &self.couplings()[coupling].edges {
                let touched = &mut blocks[block_of_edge[edge]].couplings;
                if touched.last() != Some(&coupling) {
                    touched.push(coupling);
                }
            }
        }
        blocks
    }

    /// The blocks merged wherever a coupling spans several of them, ordered by the name of their first edge.
    ///
    /// # Complexity
    /// That of [`ConstraintGraph::blocks`], plus near-linear union-find over the couplings.
    #[must_use]
    pub fn coupled_blocks(&self) -> Vec<CoupledBlock> {
        let blocks = self.blocks();
        let block_of_edge = self.block_of_each_edge(&blocks);
        let mut sets = UnionFind::<usize>::new(blocks.len());
        for coupling in self.couplings() {
            for pair in coupling.edges.windows(2) {
                sets.union(block_of_edge[pair[0]], block_of_edge[pair[1]]);
            }
        }
        let mut place = vec![usize::MAX; blocks.len()];
        let mut merged: Vec<CoupledBlock> = Vec::new();
        for (position, block) in blocks.iter().enumerate() {
            let representative = sets.find(position);
            if place[representative] == usize::MAX {
                place[representative] = merged.len();
                merged.push(CoupledBlock {
                    blocks: Vec::new(),
                    edges: Vec::new(),
                    nodes: Vec::new(),
                    couplings: Vec::new(),
                });
            }
            let target = &mut merged[place[representative]];
            target.blocks.push(position);
            target.edges.extend(&block.edges);
            target.nodes.extend(&block.nodes);
            target.couplings.extend(&block.couplings);
        }
        for group in &mut merged {
            group.edges.sort_unstable_by_key(|&e| self.edge_rank(e));
            group.nodes.sort_unstable_by_key(|&n| self.node_rank(n));
            group.nodes.dedup();
            self.sort_couplings(&mut group.couplings);
            group.couplings.dedup();
        }
        merged
    }

    /// For every edge the position of its block in [`ConstraintGraph::blocks`].
    pub(super) fn block_of_each_edge(&self, blocks: &[Block]) -> Vec<usize> {
        let mut block_of_edge = vec![0; self.edge_count()];
        for (position, block) in blocks.iter().enumerate() {
            for &edge in &block.edges {
                block_of_edge[edge] = position;
            }
        }
        block_of_edge
    }

    fn couplings_by_name(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.couplings().len()).collect();
        self.sort_couplings(&mut order);
        order
    }

    fn sort_couplings(&self, couplings: &mut [usize]) {
        couplings.sort_by(|&a, &b| {
            let name = |c: usize| &self.couplings()[c].name;
            name(a).cmp(name(b)).then(a.cmp(&b))
        });
    }

    fn block_of(&self, mut edges: Vec<usize>) -> Block {
        edges.sort_unstable_by_key(|&edge| self.edge_rank(edge));
        let mut nodes: Vec<usize> = edges.iter().flat_map(|&e| self.edge(e).ends).collect();
        nodes.sort_unstable_by_key(|&node| self.node_rank(node));
        nodes.dedup();
        Block {
            bridge: edges.len() == 1,
            edges,
            nodes,
            couplings: Vec::new(),
        }
    }

    fn biconnected_edge_sets(&self) -> Vec<Vec<usize>> {
        const UNSEEN: usize = usize::MAX;
        const NONE: usize = usize::MAX;
        struct Frame {
            node: usize,
            /// The edge by which the node was reached.
            via: usize,
            /// Position of the next incidence to look at.
            next: usize,
        }

        let mut discovered = vec![UNSEEN; self.node_count()];
        let mut low = vec![UNSEEN; self.node_count()];
        let mut clock = 0;
        let mut open_edges: Vec<usize> = Vec::new();
        let mut sets = Vec::new();
        for &root in self.nodes_by_name() {
            if discovered[root] != UNSEEN {
                continue;
            }
            let mut frames = vec![Frame {
                node: root,
                via: NONE,
                next: 0,
            }];
            (discovered[root], low[root]) = (clock, clock);
            clock += 1;
            while let Some(frame) = frames.last_mut() {
                let here = frame.node;
                if let Some(&incidence) = self.incident(here).get(frame.next) {
                    frame.next += 1;
                    if incidence.edge == frame.via {
                        continue;
                    }
                    let there = incidence.node;
                    if discovered[there] == UNSEEN {
                        open_edges.push(incidence.edge);
                        (discovered[there], low[there]) = (clock, clock);
                        clock += 1;
                        frames.push(Frame {
                            node: there,
                            via: incidence.edge,
                            next: 0,
                        });
                    } else if discovered[there] < discovered[here] {
                        open_edges.push(incidence.edge);
                        low[here] = low[here].min(discovered[there]);
                    }
                    continue;
                }
                let via = frame.via;
                frames.pop();
                let Some(parent) = frames.last().map(|frame| frame.node) else {
                    continue;
                };
                low[parent] = low[parent].min(low[here]);
                // Nothing below the edge reaches above its upper end: the edges opened since form a block.
                if low[here] >= discovered[parent] {
                    let start = open_edges
                        .iter()
                        .rposition(|&edge| edge == via)
                        .unwrap_or(0);
                    sets.push(open_edges.split_off(start));
                }
            }
        }
        sets
    }
}

#[cfg(test)]
mod tests {
    use super::super::constraint_graph::ExtraRelation;
    use super::super::samples;
    use super::*;

    fn block_names(graph: &ConstraintGraph) -> Vec<(String, bool)> {
        graph
            .blocks()
            .iter()
            .map(|block| {
                let names: Vec<_> = block.edges.iter().map(|&e| graph.edge_name(e)).collect();
                (names.join(" "), block.bridge)
            })
            .collect()
    }

    ///```text
    ///            ┌─ d ─┐
    ///  A ──a── B        C ──f── D ──g── E        F
    ///            └─ e ─┘         \──h── G ──i──/     (E and G joined by i)
    ///```
    /// One bridge, one pair of parallel edges, one bridge, one triangle; F stands alone.
    fn mixed() -> ConstraintGraph {
        samples::graph_with_isolated(
            "A",
            &[
                ("a", "A", "B"),
                ("d", "B", "C"),
                ("e", "C", "B"),
                ("f", "C", "D"),
                ("g", "D", "E"),
                ("h", "D", "G"),
                ("i", "E", "G"),
            ],
            &["F"],
        )
    }

    #[test]
    fn blocks_and_bridges() {
        let graph = mixed();
        let expected = [("a", true), ("d e", false), ("f", true), ("g h i", false)];
        let expected: Vec<_> = expected.map(|(n, b)| (n.to_string(), b)).into();
        assert_eq!(block_names(&graph), expected);
        assert_eq!(graph.components().len(), 2);
        assert_eq!(graph.loop_count(), 2);
        let loops: Vec<_> = graph.blocks().iter().map(Block::loop_count).collect();
        assert_eq!(loops, [0, 1, 0, 1]);
    }

    /// A gear between the bridge `a` and the triangle joins these two blocks; the rest stays apart.
    #[test]
    fn couplings_merge_blocks() {
        let plain = mixed();
        let index = |name: &str| {
            plain.edges_by_name()[["a", "d", "e", "f", "g", "h", "i"]
                .iter()
                .position(|n| *n == name)
                .unwrap_or(0)]
        };
        let couplings = vec![
            ExtraRelation {
                name: "z-gear".into(),
                edges: vec![index("h"), index("a")],
            },
            ExtraRelation {
                name: "belt".into(),
                edges: vec![index("g"), index("i")],
            },
        ];
        let graph = samples::with_couplings(&plain, couplings);
        let merged = graph.coupled_blocks();
        let edges: Vec<Vec<_>> = merged
            .iter()
            .map(|m| m.edges.iter().map(|&e| graph.edge_name(e)).collect())
            .collect();
        assert_eq!(edges, [vec!["a", "g", "h", "i"], vec!["d", "e"], vec!["f"]]);
        assert_eq!(merged[0].couplings, [1, 0], "by name: belt before z-gear");
        assert_eq!(merged[0].blocks, [0, 3]);
        assert_eq!(graph.blocks()[3].couplings, [1, 0]);
        assert_eq!(graph.blocks()[0].couplings, [0]);
    }

    ///```text
    ///      A
    ///     / \
    ///    B───C───D      two triangles sharing the node C: two blocks, no bridge
    ///         \ /
    ///          E
    ///```
    #[test]
    fn triangles_at_a_cut_node_are_two_blocks() {
        let graph = samples::graph(
            "A",
            &[
                ("1", "A", "B"),
                ("2", "B", "C"),
                ("3", "C", "A"),
                ("4", "C", "D"),
                ("5", "D", "E"),
                ("6", "E", "C"),
            ],
        );
        let expected = [("1 2 3", false), ("4 5 6", false)];
        let expected: Vec<_> = expected.map(|(n, b)| (n.to_string(), b)).into();
        assert_eq!(block_names(&graph), expected);
    }

    #[test]
    fn a_chain_of_100_000_links_is_all_bridges() {
        let graph = samples::serial_chain(100_000);
        let blocks = graph.blocks();
        assert_eq!(blocks.len(), 99_999);
        assert!(blocks.iter().all(|block| block.bridge));
    }

    #[test]
    fn a_ring_of_100_000_links_is_one_block() {
        let graph = samples::ring(100_000);
        let blocks = graph.blocks();
        assert_eq!(blocks.len(), 1);
        assert!(!blocks[0].bridge);
        assert_eq!(blocks[0].nodes.len(), 100_000);
    }

    #[test]
    fn components_start_with_the_ground() {
        let graph = samples::graph("q", &[("1", "q", "p"), ("2", "a", "b")]);
        let names: Vec<Vec<_>> = graph
            .components()
            .iter()
            .map(|c| c.iter().map(|&n| graph.node_name(n)).collect())
            .collect();
        assert_eq!(names, [vec!["p", "q"], vec!["a", "b"]]);
    }
}
