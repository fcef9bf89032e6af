//! Oriented cycles: closed walks through the graph, the ones a tree gives, and how much they overlap.

use serde::Serialize;

use super::constraint_graph::ConstraintGraph;
use super::spanning_tree::SpanningTree;

/// A simple cycle as an oriented closed walk: no node and no edge twice.
///
/// Where it starts and which way it runs is fixed by the names: it starts with its first edge by name, passed from
/// predecessor to successor.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Cycle {
    /// The edges in the order of the walk, and for each whether it is passed forward, from its predecessor
    /// ([`ends`](super::EdgeSpec::ends)`[0]`) to its successor, or backward.
    pub edges: Vec<(usize, bool)>,
}

impl Cycle {
    /// Orients edges given in cyclic order and puts the start where it belongs. `None` if they are not a simple cycle in
    /// this order: fewer than two edges, edges that do not meet, or a node or edge passed twice.
    #[must_use]
    pub fn from_walk(graph: &ConstraintGraph, edges: &[usize]) -> Option<Self> {
        let start = (0..edges.len()).min_by_key(|&i| graph.edge_rank(edges[i]))?;
        let [tail, head] = graph.edge(edges[start]).ends;
        let next = edges[(start + 1) % edges.len()];
        // With two edges both directions visit the same edges; with more, the walk runs on where the next edge is met.
        let along = graph.edge(next).ends.contains(&head);
        let count = edges.len();
        let position = |step: usize| {
            if along {
                (start + step) % count
            } else {
                (start + count - step) % count
            }
        };
        let mut at = tail;
        let mut walk = Vec::with_capacity(count);
        for step in 0..count {
            let edge = edges[position(step)];
            let [from, to] = graph.edge(edge).ends;
            let forward = from == at;
            if !forward && to != at {
                return None;
            }
            at = if forward { to } else { from };
            walk.push((edge, forward));
        }
        let cycle = Self { edges: walk };
        let mut nodes = cycle.nodes(graph);
        nodes.sort_unstable();
        nodes.dedup();
        let twice = count == 2 && edges[0] == edges[1];
        (at == tail && count >= 2 && nodes.len() == count && !twice).then_some(cycle)
    }

    /// Number of edges.
    #[must_use]
    pub fn len(&self) -> usize {
        self.edges.len()
    }

    /// Whether there are no edges at all; never so for a cycle made by this module.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// The node before each edge, in the order of the walk.
    #[must_use]
    pub fn nodes(&self, graph: &ConstraintGraph) -> Vec<usize> {
        self.edges
            .iter()
            .map(|&(edge, forward)| graph.edge(edge).ends[usize::from(!forward)])
            .collect()
    }
}

/// The cycle that `chord` closes with the tree (procedure `cycles_from_tree`, Ruiz 1994, section 5.4.1), or `None` if the
/// edge belongs to the tree.
///
/// # Complexity
/// Linear in the length of the cycle; the paths are followed only as far as they differ.
#[must_use]
pub fn fundamental_cycle(
    graph: &ConstraintGraph,
    tree: &SpanningTree,
    chord: usize,
) -> Option<Cycle> {
    if tree.contains(chord) {
        return None;
    }
    let [mut left, mut right] = graph.edge(chord).ends;
    let mut from_left = Vec::new();
    let mut from_right = Vec::new();
    while left != right {
        if tree.depth(left) >= tree.depth(right) {
            let step = tree.parent(left)?;
            from_left.push(step.edge);
            left = step.node;
        } else {
            let step = tree.parent(right)?;
            from_right.push(step.edge);
            right = step.node;
        }
    }
    from_left.extend(from_right.into_iter().rev());
    from_left.push(chord);
    Cycle::from_walk(graph, &from_left)
}

/// The fundamental cycles of the tree, one for each chord, in the order of [`SpanningTree::chords`].
///
/// # Complexity
/// Linear in their total length, which for long chains grows with the square of the chain
/// ([`SpanningTree::fundamental_length`] tells it beforehand).
#[must_use]
pub fn fundamental_cycles(graph: &ConstraintGraph, tree: &SpanningTree) -> Vec<Cycle> {
    tree.chords()
        .iter()
        .filter_map(|&chord| fundamental_cycle(graph, tree, chord))
        .collect()
}

/// Two cycles that have edges in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Overlap {
    /// Position of one cycle in the list.
    pub first: usize,
    /// Position of the other, larger than `first`.
    pub second: usize,
    /// How many edges both pass.
    pub shared: usize,
}

/// All pairs of cycles that share edges, ordered by position: the sparse strictly upper triangle of the matrix of shared
/// edges.
///
/// # Complexity
/// Σ k² log over the edges, with k the number of cycles through an edge: at worst the square of the number of cycles.
#[must_use]
pub fn overlaps(graph: &ConstraintGraph, cycles: &[Cycle]) -> Vec<Overlap> {
    let mut through: Vec<Vec<usize>> = vec![Vec::new(); graph.edge_count()];
    for (position, cycle) in cycles.iter().enumerate() {
        for &(edge, _) in &cycle.edges {
            through[edge].push(position);
        }
    }
    let mut pairs: Vec<(usize, usize)> = Vec::new();
    for cycles in &through {
        for (i, &first) in cycles.iter().enumerate() {
            pairs.extend(cycles[i + 1..].iter().map(|&second| (first, second)));
        }
    }
    pairs.sort_unstable();
    pairs
        .chunk_by(|a, b| a == b)
        .map(|run| Overlap {
            first: run[0].0,
            second: run[0].1,
            shared: run.len(),
        })
        .collect()
}

/// How many pairs (edge, two cycles through it) [`overlaps`] has to look at: Σ k (k − 1) / 2.
pub(super) fn overlap_work(graph: &ConstraintGraph, cycles: &[Cycle]) -> usize {
    let mut through = vec![0_usize; graph.edge_count()];
    for cycle in cycles {
        for &(edge, _) in &cycle.edges {
            through[edge] += 1;
        }
    }
    through.iter().map(|k| k * k.saturating_sub(1) / 2).sum()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::{self, names};
    use super::*;

    fn written(graph: &ConstraintGraph, cycle: &Cycle) -> String {
        let parts: Vec<String> = cycle
            .edges
            .iter()
            .map(|&(edge, forward)| {
                format!(
                    "{}{}",
                    if forward { '+' } else { '-' },
                    graph.edge_name(edge)
                )
            })
            .collect();
        parts.join(" ")
    }

    ///```text
    ///        C1          C5         C6          C3
    ///   B4 ══════ B1 ══════ B3 ══════ B2 ══════ B5
    ///        C2          C8         C9          C4
    ///    └────────────────── C7 ──────────────────┘
    ///```
    /// Ruiz 1994, Tables 5.2 and 6.12: {C1-C2, C3-C4, C6-C9, C8-C5, C5-C1-C7-C3-C6}.
    #[test]
    fn cartesian_table_has_the_cycles_of_table_5_2() {
        let graph = samples::cartesian_table();
        let tree = SpanningTree::root_at(&graph, 2);
        let cycles = fundamental_cycles(&graph, &tree);
        let written: Vec<_> = cycles.iter().map(|c| written(&graph, c)).collect();
        let expected = [
            "+C1 -C2",
            "+C3 -C4",
            "+C1 +C7 -C3 -C6 +C5",
            "+C5 -C8",
            "+C6 -C9",
        ];
        assert_eq!(written, expected);
        for (cycle, &chord) in cycles.iter().zip(tree.chords()) {
            assert_eq!(cycle.len(), tree.fundamental_length(&graph, chord));
        }
        let shared: Vec<_> = overlaps(&graph, &cycles)
            .iter()
            .map(|o| (o.first, o.second, o.shared))
            .collect();
        assert_eq!(shared, [(0, 2, 1), (1, 2, 1), (2, 3, 1), (2, 4, 1)]);
        assert_eq!(overlap_work(&graph, &cycles), 4);
    }

    ///```text
    ///    a ──1── b
    ///    │       │      every way of writing the square is the same cycle
    ///    4       2
    ///    │       │
    ///    d ──3── c
    ///```
    #[test]
    fn start_and_direction_are_normalised() {
        let graph = samples::graph(
            "a",
            &[
                ("1", "b", "a"),
                ("2", "b", "c"),
                ("3", "c", "d"),
                ("4", "d", "a"),
            ],
        );
        for shift in 0..4 {
            for back in [false, true] {
                let mut walk: Vec<usize> = (0..4).map(|i| (i + shift) % 4).collect();
                if back {
                    walk.reverse();
                }
                let cycle = Cycle::from_walk(&graph, &walk).unwrap();
                assert_eq!(written(&graph, &cycle), "+1 -4 -3 -2");
                assert_eq!(names(&graph, &walk).len(), 4);
            }
        }
    }

    #[test]
    fn what_is_no_cycle_is_refused() {
        let graph = samples::cartesian_table();
        let walk = |edges: &[usize]| Cycle::from_walk(&graph, edges);
        assert_eq!(walk(&[]), None);
        assert_eq!(walk(&[0]), None);
        assert_eq!(walk(&[0, 0]), None);
        assert_eq!(walk(&[0, 4]), None);
        assert_eq!(walk(&[0, 1, 4, 7]), None, "figure of eight");
        assert!(walk(&[0, 1]).is_some());
    }
}
