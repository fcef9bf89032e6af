//! Graphs and sketches for examples, benches and tests: by name, by Henneberg moves, and all small well-constrained ones.

mod laman;
mod random;
mod sketches;

pub use laman::laman_graphs;
pub use random::Random;
pub use sketches::{strip_sketch, tied_sketch};

use crate::graph::Graph;
use std::collections::HashSet;

/// The graphs of [`named`], with the edges as pairs of letters.
///
/// "chain of six" is the graph that the slides of Soto i Riera (2002) take apart; the list of its leaves there leaves out the edge
/// `be`, and read literally it is "chain of six, be left out", which is under-constrained.
pub const NAMED: [(&str, &str); 10] = [
    ("edge", "ab"),
    ("triangle", "ab bc ca"),
    ("chain of six", "bc ce ad ae de be ab bf af"),
    ("chain of six, be left out", "bc ce ad ae de ab bf af"),
    ("K3,3", "ad ae af bd be bf cd ce cf"),
    ("prism", "ab bc ca de ef fd ad be cf"),
    ("quadrilateral", "ab bc cd da"),
    ("K4", "ab ac ad bc bd cd"),
    ("bow tie", "ab bc ca cd de ec"),
    ("K4 with a tail", "ab ac ad bc bd cd de ef"),
];

/// One of the graphs of [`NAMED`], vertices in the order of the alphabet.
#[must_use]
pub fn named(name: &str) -> Option<Graph> {
    let (_, text) = NAMED.iter().find(|(n, _)| *n == name)?;
    let index = |letter: u8| usize::from(letter - b'a');
    let edges: Vec<[usize; 2]> = text
        .split(' ')
        .map(|e| [index(e.as_bytes()[0]), index(e.as_bytes()[1])])
        .collect();
    let vertices = 1 + edges.iter().flatten().max()?;
    Graph::new(vertices, edges).ok()
}

/// A strip of triangles: vertex k is tied to the two before it. Well-constrained from two vertices on.
#[must_use]
pub fn strip(vertices: usize) -> Vec<[usize; 2]> {
    let ties = |k: usize| (k.saturating_sub(2)..k).rev().map(move |j| [k, j]);
    (1..vertices).flat_map(ties).collect()
}

/// A graph with so many edges drawn evenly, or all edges where there are not so many.
#[must_use]
pub fn any(vertices: usize, edges: usize, random: &mut Random) -> Graph {
    let mut all: Vec<[usize; 2]> = (1..vertices)
        .flat_map(|v| (0..v).map(move |u| [u, v]))
        .collect();
    random.shuffle(&mut all);
    all.truncate(edges);
    built(vertices, all)
}

/// A well-constrained graph by Henneberg's moves from one edge: a new vertex is tied to two others, or replaces an edge and is
/// tied to its ends and one more, the latter with the chance `second` in a hundred.
#[must_use]
pub fn henneberg(vertices: usize, second: usize, random: &mut Random) -> Graph {
    let mut edges = vec![[0, 1]];
    for v in 2..vertices {
        if v >= 3 && random.below(100) < second {
            let [a, b] = edges.swap_remove(random.below(edges.len()));
            let c = random.other_than(v, &[a, b]);
            edges.extend([[a, v], [b, v], [c, v]]);
        } else {
            let a = random.below(v);
            let b = random.other_than(v, &[a]);
            edges.extend([[a, v], [b, v]]);
        }
    }
    random.shuffle(&mut edges);
    built(vertices, edges)
}

/// A well-constrained graph by gluing: vertices are tied to the ends of edges or to any two, parts replace edges, so that
/// deep trees of large parts arise.
#[must_use]
pub fn glued(vertices: usize, random: &mut Random) -> Graph {
    if vertices <= 3 {
        return built(vertices, strip(vertices));
    }
    // A triangle of three parts has three vertices fewer than these together.
    let spare = vertices - 3;
    let first = 2 + random.below(spare + 1);
    let second = 2 + random.below(vertices + 3 - first - 3);
    let third = vertices + 3 - first - second;
    let mut edges = Vec::new();
    let mut next = 3;
    for (size, ends) in [(first, [0, 1]), (second, [1, 2]), (third, [2, 0])] {
        let part = glued(size, random);
        let [a, b] = [0, part.vertices() - 1];
        let base = next;
        let place = |v: usize| match v {
            v if v == a => ends[0],
            v if v == b => ends[1],
            v => base + v - 1,
        };
        edges.extend(part.edges().iter().map(|&[u, v]| [place(u), place(v)]));
        next += part.vertices() - 2;
    }
    built(vertices, edges)
}

/// The same graph with an edge added that it does not have, if there is one.
#[must_use]
pub fn with_one_more(graph: &Graph, random: &mut Random) -> Graph {
    let has: HashSet<[usize; 2]> = graph.edges().iter().map(|&[u, v]| ordered(u, v)).collect();
    let n = graph.vertices();
    for _ in 0..100 {
        let u = random.below(n);
        let v = random.other_than(n, &[u]);
        if !has.contains(&ordered(u, v)) {
            let edges = graph.edges().iter().copied().chain([[u, v]]);
            return built(n, edges.collect());
        }
    }
    graph.clone()
}

/// The same graph without one of its edges.
#[must_use]
pub fn with_one_fewer(graph: &Graph, random: &mut Random) -> Graph {
    let mut edges = graph.edges().to_vec();
    if !edges.is_empty() {
        edges.remove(random.below(edges.len()));
    }
    built(graph.vertices(), edges)
}

fn ordered(u: usize, v: usize) -> [usize; 2] {
    [u.min(v), u.max(v)]
}

/// What the functions above put together is a graph.
fn built(vertices: usize, edges: Vec<[usize; 2]>) -> Graph {
    #[allow(clippy::expect_used)] // no data from outside
    Graph::new(vertices.max(2), edges).expect("edges between different vertices, none twice")
}
