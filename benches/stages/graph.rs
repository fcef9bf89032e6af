//! Topology: blocks, spanning tree, cycles.

use super::cases::{ALL, mechanism};
use divan::{Bencher, black_box};
use kutzbach::graph::{CycleBasis, SpanningTree};
use kutzbach::mobility::{Structure, constraint_graph};

/// Everything the analysis asks of the topology.
#[divan::bench(args = ALL, max_time = 2)]
fn structure(bencher: Bencher, case: &str) {
    let mechanism = mechanism(case);
    bencher.bench_local(|| Structure::new(black_box(&mechanism)));
}

#[divan::bench(args = ALL, max_time = 2)]
fn spanning_tree(bencher: Bencher, case: &str) {
    let graph = constraint_graph(&mechanism(case));
    bencher.bench_local(|| SpanningTree::low_depth(black_box(&graph)));
}

#[divan::bench(args = ALL, max_time = 2)]
fn shortest_cycles(bencher: Bencher, case: &str) {
    let graph = constraint_graph(&mechanism(case));
    let tree = SpanningTree::low_depth(&graph);
    bencher.bench_local(|| CycleBasis::minimum(black_box(&graph), black_box(&tree)));
}
