//! Known bases, comparison with an enumeration of all cycles, and independence from the order of the file.

#![allow(clippy::unwrap_used)]

use std::time::Instant;

use proptest::prelude::*;

use super::super::cycles::overlaps;
use super::super::invariants::check_basis;
use super::super::samples;
use super::*;

fn minimum(graph: &ConstraintGraph) -> CycleBasis {
    let basis = CycleBasis::minimum(graph, &SpanningTree::low_depth(graph));
    check_basis(graph, &basis.cycles).unwrap();
    assert_eq!(basis.kind, BasisKind::MinimumLength);
    basis
}

/// Loops, total length, longest, pairs of cycles with common edges.
fn figures(graph: &ConstraintGraph) -> (usize, usize, usize, usize) {
    let basis = minimum(graph);
    let pairs = overlaps(graph, &basis.cycles).len();
    (
        basis.cycles.len(),
        basis.total_length(),
        basis.longest(),
        pairs,
    )
}

/// Six legs of three joints: the five loops of two legs each are all 6 long.
#[test]
fn gough_platform() {
    assert_eq!(figures(&samples::platform(6, 3)), (5, 30, 6, 10));
}

///```text
///   a0 ─── b1 ─── a2 ─ ⋯         open: units − 1 squares
///    │      │      │             closed: as many squares as units, and one way around
///   b0 ─── a1 ─── b2 ─ ⋯
///```
#[test]
fn scissors() {
    assert_eq!(figures(&samples::scissor(32, false)), (31, 124, 4, 30));
    assert_eq!(figures(&samples::scissor(32, true)), (33, 160, 32, 64));
    // An odd ring is a Möbius ladder: going around once ends on the other rail, so a rung is added.
    assert_eq!(
        figures(&samples::scissor(31, true)),
        (32, 31 * 4 + 32, 32, 31 + 31)
    );
}

#[test]
fn lattices() {
    assert_eq!(figures(&samples::lattice(8, 8)), (49, 196, 4, 84));
    assert_eq!(figures(&samples::lattice(16, 16)), (225, 900, 4, 420));
}

#[test]
fn polyhedra_and_complete_graphs() {
    assert_eq!(figures(&samples::prism(24)), (25, 120, 24, 48));
    assert_eq!(figures(&samples::dodecahedron()), (11, 55, 5, 25));
    let loops_total_longest = |graph: &ConstraintGraph| {
        let (loops, total, longest, _) = figures(graph);
        (loops, total, longest)
    };
    assert_eq!(loops_total_longest(&samples::petersen()), (6, 30, 5));
    assert_eq!(loops_total_longest(&samples::complete(5)), (6, 18, 3));
    assert_eq!(loops_total_longest(&samples::complete(6)), (10, 30, 3));
    assert_eq!(loops_total_longest(&samples::complete(7)), (15, 45, 3));
}

#[test]
fn cartesian_table() {
    let basis = minimum(&samples::cartesian_table());
    let lengths: Vec<_> = basis.cycles.iter().map(Cycle::len).collect();
    assert_eq!(lengths, [2, 2, 2, 2, 5]);
}

#[test]
fn without_loops_there_are_no_cycles() {
    assert_eq!(figures(&samples::serial_chain(10)), (0, 0, 0, 0));
    assert_eq!(figures(&samples::numbered(1, [])), (0, 0, 0, 0));
}

#[test]
fn long_rings_and_long_limbs() {
    assert_eq!(figures(&samples::ring(50_000)), (1, 50_000, 50_000, 0));
    assert_eq!(figures(&samples::platform(4, 3_000)), (3, 18_000, 6_000, 3));
}

/// The time bounds are those of an optimised build with room to spare on a slow machine without optimisation; what they
/// guard against is a change to quadratic growth, which would take minutes.
#[test]
fn large_graphs_take_near_linear_time() {
    let timed = |graph: &ConstraintGraph| {
        let start = Instant::now();
        let figures = figures(graph);
        (figures, start.elapsed().as_secs_f64())
    };
    let (chain, seconds) = timed(&samples::scissor(10_000, false));
    assert_eq!(chain, (9_999, 39_996, 4, 9_998));
    assert!(seconds < 20.0, "chain took {seconds} s");
    let (ring, seconds) = timed(&samples::scissor(10_000, true));
    assert_eq!(ring, (10_001, 50_000, 10_000, 20_000));
    assert!(seconds < 20.0, "ring took {seconds} s");
    let (lattice, seconds) = timed(&samples::lattice(30, 30));
    assert_eq!(lattice, (841, 3_364, 4, 1_624));
    assert!(seconds < 10.0, "lattice took {seconds} s");
}

/// K4 and its three cycles through all four nodes: each edge is in two of them. Their sum is zero, so they are no basis,
/// but two of them peel.
#[test]
fn peeling_needs_an_edge_of_ones_own() {
    let graph = samples::complete(4);
    // Edges 0..6: 01 02 03 12 13 23.
    let squares = [[0, 3, 5, 2], [0, 4, 5, 1], [1, 3, 4, 2]];
    let squares: Vec<_> = squares
        .iter()
        .map(|walk| Cycle::from_walk(&graph, walk).unwrap())
        .collect();
    assert!(!peels(&squares));
    assert!(peels(&squares[..2]));
    assert!(peels(&[]));

    let tree = SpanningTree::low_depth(&graph);
    let block = &graph.blocks()[0];
    let (cycles, fundamental) = fit_or_fundamental(&graph, &tree, block, squares);
    assert!(fundamental);
    check_basis(&graph, &cycles).unwrap();
    assert!(peels(&cycles));
    let (again, fundamental) = fit_or_fundamental(&graph, &tree, block, cycles.clone());
    assert_eq!((again, fundamental), (cycles, false));
}

/// Lengths of a minimum basis from the enumeration of all simple cycles and dense elimination: nothing in common with the
/// method above but the greedy choice.
fn lengths_by_enumeration(nodes: usize, edges: &[(usize, usize)]) -> Vec<usize> {
    fn extend(
        edges: &[(usize, usize)],
        start: usize,
        at: usize,
        visited: u64,
        used: u64,
        found: &mut Vec<u64>,
    ) {
        for (edge, &(a, b)) in edges.iter().enumerate() {
            if used >> edge & 1 == 1 || (a != at && b != at) {
                continue;
            }
            let there = a + b - at;
            if there == start && used != 0 {
                found.push(used | 1 << edge);
            } else if there > start && visited >> there & 1 == 0 {
                extend(
                    edges,
                    start,
                    there,
                    visited | 1 << there,
                    used | 1 << edge,
                    found,
                );
            }
        }
    }
    let mut cycles = Vec::new();
    for start in 0..nodes {
        extend(edges, start, start, 1 << start, 0, &mut cycles);
    }
    cycles.sort_unstable_by_key(|cycle| (cycle.count_ones(), *cycle));
    let mut rows: Vec<u64> = Vec::new();
    let mut lengths = Vec::new();
    for cycle in cycles {
        let rest = rows.iter().fold(cycle, |rest, row| rest.min(rest ^ row));
        if rest != 0 {
            rows.push(rest);
            lengths.push(cycle.count_ones() as usize);
        }
    }
    lengths
}

/// Horton's candidates as he gave them (all roots, no reduction), with dense elimination.
fn lengths_by_horton(graph: &ConstraintGraph) -> Vec<usize> {
    let mut candidates: Vec<u128> = Vec::new();
    for root in 0..graph.node_count() {
        let mut path = vec![None; graph.node_count()];
        path[root] = Some(0_u128);
        let mut queue = std::collections::VecDeque::from([root]);
        while let Some(node) = queue.pop_front() {
            for step in graph.incident(node) {
                if path[step.node].is_none() {
                    path[step.node] = path[node].map(|bits| bits | 1 << step.edge);
                    queue.push_back(step.node);
                }
            }
        }
        for edge in 0..graph.edge_count() {
            let [a, b] = graph.edge(edge).ends;
            if let (Some(a), Some(b)) = (path[a], path[b])
                && a & b == 0
                && (a | b) >> edge & 1 == 0
            {
                candidates.push(a | b | 1 << edge);
            }
        }
    }
    candidates.sort_unstable_by_key(|bits| (bits.count_ones(), *bits));
    candidates.dedup();
    let mut rows: Vec<u128> = Vec::new();
    let mut lengths = Vec::new();
    for bits in candidates {
        let rest = rows.iter().fold(bits, |rest, row| rest.min(rest ^ row));
        if rest != 0 {
            rows.push(rest);
            lengths.push(bits.count_ones() as usize);
        }
    }
    lengths
}

fn multigraph(
    nodes: std::ops::Range<usize>,
    edges: std::ops::Range<usize>,
) -> impl Strategy<Value = (usize, Vec<(usize, usize)>)> {
    nodes.prop_flat_map(move |nodes| {
        // The second end is a distance, so that it never equals the first.
        let edge = (0..nodes, 1..nodes).prop_map(move |(a, step)| (a, (a + step) % nodes));
        (Just(nodes), prop::collection::vec(edge, edges.clone()))
    })
}

fn lengths(basis: &CycleBasis) -> Vec<usize> {
    basis.cycles.iter().map(Cycle::len).collect()
}

/// The basis in words, free of indices.
fn named(graph: &ConstraintGraph, basis: &CycleBasis) -> Vec<Vec<(String, bool)>> {
    let name = |&(edge, forward): &(usize, bool)| (graph.edge_name(edge).to_string(), forward);
    basis
        .cycles
        .iter()
        .map(|cycle| cycle.edges.iter().map(name).collect())
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn small_multigraphs_agree_with_enumeration((nodes, edges) in multigraph(2..8, 0..15)) {
        let graph = samples::numbered(nodes, edges.clone());
        prop_assert_eq!(lengths(&minimum(&graph)), lengths_by_enumeration(nodes, &edges));
    }

    #[test]
    fn larger_multigraphs_agree_with_horton((nodes, edges) in multigraph(10..60, 10..120)) {
        let graph = samples::numbered(nodes, edges);
        prop_assert_eq!(lengths(&minimum(&graph)), lengths_by_horton(&graph));
    }

    /// Without patience everything after length 2, or after the first length in vain, comes from the double cover.
    #[test]
    fn both_methods_agree((nodes, edges) in multigraph(4..30, 4..60)) {
        let graph = samples::numbered(nodes, edges);
        let mut local = vec![NONE; nodes];
        for block in graph.blocks() {
            let block_graph = BlockGraph::new(&graph, &block, &mut local);
            let by = |patience| -> Vec<usize> {
                minimum_cycles(&block_graph, patience).iter().map(Vec::len).collect()
            };
            prop_assert_eq!(by(0), by(u64::from(u32::MAX)));
            // All from the double cover.
            let mut walks = Vec::new();
            let nothing = Eliminator::new(block.loop_count());
            finish(&block_graph, nothing.annihilators(), 2, &mut walks);
            let lengths: Vec<usize> = walks.iter().map(Vec::len).collect();
            prop_assert_eq!(lengths, by(PATIENCE));
        }
    }

    #[test]
    fn order_of_the_file_does_not_matter(
        (nodes, edges) in multigraph(2..20, 0..40),
        keys in prop::collection::vec(any::<u64>(), 1..20),
    ) {
        let graph = samples::numbered(nodes, edges);
        let shuffled = samples::shuffled(&graph, &keys);
        prop_assert_eq!(named(&graph, &minimum(&graph)), named(&shuffled, &minimum(&shuffled)));

        let tree = |graph: &ConstraintGraph| {
            let tree = SpanningTree::low_depth(graph);
            let order: Vec<_> = tree.order().iter()
                .map(|&n| (graph.node_name(n).to_string(), tree.depth(n)))
                .collect();
            let chords: Vec<_> = samples::names(graph, tree.chords()).iter().map(|n| (*n).to_string()).collect();
            (order, chords)
        };
        prop_assert_eq!(tree(&graph), tree(&shuffled));

        let blocks = |graph: &ConstraintGraph| -> Vec<Vec<String>> {
            graph.blocks().iter()
                .map(|b| samples::names(graph, &b.edges).iter().map(|n| (*n).to_string()).collect())
                .collect()
        };
        prop_assert_eq!(blocks(&graph), blocks(&shuffled));
    }

    /// An edge is a bridge exactly if taking it away leaves one more component.
    #[test]
    fn bridges_disconnect((nodes, edges) in multigraph(2..10, 1..16)) {
        let graph = samples::numbered(nodes, edges.clone());
        let loops: usize = graph.blocks().iter().map(super::super::Block::loop_count).sum();
        prop_assert_eq!(loops, graph.loop_count());
        for block in graph.blocks() {
            for &edge in &block.edges {
                let mut rest = edges.clone();
                rest.remove(edge);
                let more = samples::numbered(nodes, rest).components().len() > graph.components().len();
                prop_assert_eq!(more, block.bridge);
            }
        }
    }
}
