//! Rule 1 on what the reductions left: a network of chains.

use super::chain::{enclosing, freedom, span};
use super::clear;
use super::network::Edge;
use kutzbach_math::group::{Gauge, GroupError, Margin, Subalgebra};
use kutzbach_math::matrix::{SparseMatrix, decide};
use kutzbach_model::graph::{ConstraintGraph, CycleBasis, EdgeSpec, NodeSpec, SpanningTree};
use std::collections::BTreeMap;

/// Networks of more chains are left alone: their matrix is dense.
const MOST_CHAINS: usize = 60;

/// Independent equations of a network whose configurations are a manifold.
pub struct Explained {
    /// The rank of its closure equations.
    pub rank: usize,
    /// The worst margin.
    pub margin: Margin,
}

/// Whether the dimensions of the subgroups of a network's cycles explain the rank of its closure equations.
pub fn explain(chains: &[&Edge], gauge: &Gauge) -> Result<Option<Explained>, GroupError> {
    if chains.len() > MOST_CHAINS || chains.iter().any(|chain| chain.ends[0] == chain.ends[1]) {
        return Ok(None);
    }
    let mut margin = Margin::CERTAIN;
    let mut spans = Vec::with_capacity(chains.len());
    let mut algebras = Vec::with_capacity(chains.len());
    for chain in chains {
        let span = span(&chain.pieces, gauge)?;
        let algebra = enclosing(&chain.pieces, gauge)?;
        margin = margin.and(span.margin()).and(algebra.margin());
        spans.push(span);
        algebras.push(algebra);
    }
    let Some(cycles) = cycles(chains) else {
        return Ok(None);
    };
    let mut wanted = 0;
    for cycle in &cycles {
        let mut members = cycle.iter().map(|(chain, _)| &algebras[*chain]);
        let Some(first) = members.next() else {
            continue;
        };
        let space: Subalgebra = members.try_fold(first.clone(), |sum, k| sum.join(k))?;
        margin = margin.and(space.margin());
        wanted += space.dimension();
    }
    if !clear(margin) {
        return Ok(None);
    }
    let mut first_column = Vec::with_capacity(spans.len());
    let mut columns = 0;
    for span in &spans {
        first_column.push(columns);
        columns += span.dimension();
    }
    let mut entries = Vec::new();
    for (number, cycle) in cycles.iter().enumerate() {
        for &(chain, forward) in cycle {
            for (k, twist) in spans[chain].basis().iter().enumerate() {
                let sign = if forward { 1.0 } else { -1.0 };
                for (row, entry) in gauge.measure(twist).iter().enumerate() {
                    entries.push((6 * number + row, first_column[chain] + k, sign * entry));
                }
            }
        }
    }
    let rows = 6 * cycles.len();
    // Unit columns, each within the uncertainty of its chain's span: as in `kutzbach_math::matrix::rank`.
    let wrong = spans.iter().map(|s| s.uncertainty()).fold(0.0, f64::max);
    let accuracy = wrong * (rows.min(columns) as f64).sqrt();
    let Ok(mut matrix) = SparseMatrix::from_triplets(rows, columns, 0.0, entries) else {
        return Ok(None);
    };
    matrix.scale_columns();
    let Ok(decision) = decide(&matrix, accuracy) else {
        return Ok(None);
    };
    let all: usize = chains.iter().map(|chain| freedom(&chain.pieces)).sum();
    let found = decision.rank.filter(|rank| *rank == wanted && *rank <= all);
    Ok(found.map(|rank| Explained {
        rank,
        margin: margin.and(Margin {
            kept: decision.kept / decision.tolerance,
            dropped: decision.dropped / decision.tolerance,
        }),
    }))
}

/// A minimum cycle basis of the network: chains in order, and whether each is passed from its first link.
fn cycles(chains: &[&Edge]) -> Option<Vec<Vec<(usize, bool)>>> {
    let mut number = BTreeMap::new();
    for chain in chains {
        for link in chain.ends {
            let next = number.len();
            number.entry(link).or_insert(next);
        }
    }
    let nodes = (0..number.len())
        .map(|node| NodeSpec {
            name: format!("{node:08}"),
        })
        .collect();
    let edges = chains
        .iter()
        .enumerate()
        .map(|(index, chain)| EdgeSpec {
            name: format!("{index:08}"),
            ends: chain.ends.map(|link| number[&link]),
            freedom: freedom(&chain.pieces).min(6),
            class: String::new(),
        })
        .collect();
    let graph = ConstraintGraph::try_new(0, nodes, edges, Vec::new()).ok()?;
    let tree = SpanningTree::low_depth(&graph);
    let basis = CycleBasis::minimum(&graph, &tree);
    Some(basis.cycles.into_iter().map(|cycle| cycle.edges).collect())
}
