//! All small well-constrained graphs.

use super::built;
use crate::graph::Graph;
use std::collections::{BTreeSet, HashMap};

/// The well-constrained graphs with so many vertices, one of each isomorphism class, for 2 to 7 vertices: 1, 1, 1, 3, 13 and 70
/// (OEIS A227117). Others would take too long and give none.
///
/// Henneberg's two moves lead from the single edge to all of them (Henneberg 1911; Tay and Whiteley 1985).
#[must_use]
pub fn laman_graphs(vertices: usize) -> Vec<Graph> {
    if !(2..=7).contains(&vertices) {
        return Vec::new();
    }
    let mut classes: BTreeSet<Vec<[usize; 2]>> = [vec![[0, 1]]].into();
    for v in 2..vertices {
        let mut known = HashMap::new();
        classes = classes
            .iter()
            .flat_map(|edges| moves(v, edges))
            .map(|edges| {
                let least = known.entry(bits(&edges));
                least.or_insert_with(|| canonical(v + 1, &edges)).clone()
            })
            .collect();
    }
    classes.into_iter().map(|e| built(vertices, e)).collect()
}

/// Both moves, with the new vertex `v`, in all ways.
fn moves(v: usize, edges: &[[usize; 2]]) -> Vec<Vec<[usize; 2]>> {
    let mut grown = Vec::new();
    for b in 1..v {
        for a in 0..b {
            grown.push([edges, &[[a, v], [b, v]]].concat());
        }
    }
    for (i, &[a, b]) in edges.iter().enumerate() {
        let mut rest = edges.to_vec();
        rest.remove(i);
        for c in (0..v).filter(|c| ![a, b].contains(c)) {
            grown.push([&rest[..], &[[a, v], [b, v], [c, v]]].concat());
        }
    }
    grown
}

/// The set of edges as bits.
fn bits(edges: &[[usize; 2]]) -> u32 {
    edges.iter().fold(0, |sum, &[u, v]| sum | bit(u, v))
}

fn bit(u: usize, v: usize) -> u32 {
    let [low, high] = [u.min(v), u.max(v)];
    1 << (high * (high - 1) / 2 + low)
}

/// The edges under that order of vertices by falling degree whose bits are least.
fn canonical(n: usize, edges: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let degree = |v: usize| edges.iter().filter(|e| e.contains(&v)).count();
    let degrees: Vec<usize> = (0..n).map(degree).collect();
    let mut sorted = degrees.clone();
    sorted.sort_unstable_by(|a, b| b.cmp(a));
    let mut best = u32::MAX;
    place(0, &mut vec![n; n], &degrees, &sorted, edges, &mut best);
    (1..n)
        .flat_map(|v| (0..v).map(move |u| [u, v]))
        .filter(|&[u, v]| best & bit(u, v) != 0)
        .collect()
}

/// Tries all vertices of the right degree at `position`.
fn place(
    position: usize,
    at: &mut Vec<usize>,
    degrees: &[usize],
    sorted: &[usize],
    edges: &[[usize; 2]],
    best: &mut u32,
) {
    if position == sorted.len() {
        let moved = edges.iter().map(|&[u, v]| bit(at[u], at[v]));
        *best = (*best).min(moved.fold(0, |sum, b| sum | b));
        return;
    }
    for v in 0..degrees.len() {
        if at[v] == degrees.len() && degrees[v] == sorted[position] {
            at[v] = position;
            place(position + 1, at, degrees, sorted, edges, best);
            at[v] = degrees.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pebbles::{PebbleGame, Standing};

    #[test]
    fn there_are_as_many_as_known_and_all_are_well_constrained() {
        for (n, count) in (2..).zip([1, 1, 1, 3, 13, 70]) {
            let graphs = laman_graphs(n);
            assert_eq!(graphs.len(), count, "{n} vertices");
            for graph in graphs {
                assert_eq!(PebbleGame::play(&graph).standing(), Standing::Well);
            }
        }
    }
}
