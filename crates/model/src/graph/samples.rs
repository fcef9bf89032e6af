//! Graphs for the tests of this module.

use super::constraint_graph::{ConstraintGraph, EdgeSpec, ExtraRelation, NodeSpec};

/// Names of edges.
pub fn names<'a>(graph: &'a ConstraintGraph, edges: &[usize]) -> Vec<&'a str> {
    edges.iter().map(|&edge| graph.edge_name(edge)).collect()
}

/// Edges as (name, predecessor, successor); nodes in the order in which they are first named, the ground first.
pub fn graph(ground: &str, edges: &[(&str, &str, &str)]) -> ConstraintGraph {
    graph_with_isolated(ground, edges, &[])
}

/// The same with further nodes that have no edges.
pub fn graph_with_isolated(
    ground: &str,
    edges: &[(&str, &str, &str)],
    isolated: &[&str],
) -> ConstraintGraph {
    let mut names: Vec<String> = vec![ground.to_string()];
    let mut index = |name: &str| {
        names.iter().position(|n| n == name).unwrap_or_else(|| {
            names.push(name.to_string());
            names.len() - 1
        })
    };
    let edges = edges
        .iter()
        .map(|&(name, from, to)| edge(name.to_string(), [index(from), index(to)]))
        .collect();
    for name in isolated {
        index(name);
    }
    let nodes = names.into_iter().map(|name| NodeSpec { name }).collect();
    ConstraintGraph::new(0, nodes, edges, Vec::new())
}

fn edge(name: String, ends: [usize; 2]) -> EdgeSpec {
    EdgeSpec {
        name,
        ends,
        freedom: 1,
        class: "R".into(),
    }
}

/// Nodes `n0…`, edges `e0…` in the order given.
pub fn numbered(nodes: usize, edges: impl IntoIterator<Item = (usize, usize)>) -> ConstraintGraph {
    let nodes = (0..nodes)
        .map(|n| NodeSpec {
            name: format!("n{n}"),
        })
        .collect();
    let edges = edges
        .into_iter()
        .enumerate()
        .map(|(e, (a, b))| edge(format!("e{e}"), [a, b]))
        .collect();
    ConstraintGraph::new(0, nodes, edges, Vec::new())
}

/// All specifications of a graph, for changing them.
pub fn parts(graph: &ConstraintGraph) -> (Vec<NodeSpec>, Vec<EdgeSpec>) {
    let nodes = (0..graph.node_count()).map(|n| graph.node(n).clone());
    let edges = (0..graph.edge_count()).map(|e| graph.edge(e).clone());
    (nodes.collect(), edges.collect())
}

pub fn with_couplings(graph: &ConstraintGraph, couplings: Vec<ExtraRelation>) -> ConstraintGraph {
    let (nodes, edges) = parts(graph);
    ConstraintGraph::new(graph.ground(), nodes, edges, couplings)
}

/// The same graph from a file with other orders: `keys` decide where nodes and edges go.
pub fn shuffled(graph: &ConstraintGraph, keys: &[u64]) -> ConstraintGraph {
    let (nodes, mut edges) = parts(graph);
    let key = |i: usize| (keys[i % keys.len()].rotate_left((i % 63) as u32), i);
    let mut order: Vec<usize> = (0..nodes.len()).collect();
    order.sort_by_key(|&n| key(n));
    let mut place = vec![0; nodes.len()];
    for (position, &node) in order.iter().enumerate() {
        place[node] = position;
    }
    for edge in &mut edges {
        edge.ends = edge.ends.map(|n| place[n]);
    }
    let mut edge_order: Vec<usize> = (0..edges.len()).collect();
    edge_order.sort_by_key(|&e| key(e + 7));
    ConstraintGraph::new(
        place[graph.ground()],
        order.iter().map(|&n| nodes[n].clone()).collect(),
        edge_order.iter().map(|&e| edges[e].clone()).collect(),
        Vec::new(),
    )
}

/// Ruiz 1994, Figure 5.3 and Tables 5.1, 6.11.
pub fn cartesian_table() -> ConstraintGraph {
    let nodes = ["B1", "B2", "B3", "B4", "B5"].map(|name| NodeSpec { name: name.into() });
    let edges = [
        ("C1", [0, 3]),
        ("C2", [0, 3]),
        ("C3", [1, 4]),
        ("C4", [1, 4]),
        ("C5", [2, 0]),
        ("C6", [2, 1]),
        ("C7", [3, 4]),
        ("C8", [2, 0]),
        ("C9", [2, 1]),
    ];
    let edges = edges.map(|(name, ends)| edge(name.into(), ends));
    ConstraintGraph::new(2, nodes.into(), edges.into(), Vec::new())
}

pub fn serial_chain(nodes: usize) -> ConstraintGraph {
    numbered(nodes, (1..nodes).map(|n| (n - 1, n)))
}

pub fn ring(nodes: usize) -> ConstraintGraph {
    numbered(nodes, (0..nodes).map(|n| (n, (n + 1) % nodes)))
}

/// Scissor units one after the other: links a, b of a unit cross at a pivot, and each ends at the other's successor.
/// ```text
///    a0 ╲ ╱ a1 ╲ ╱ a2            a0 ─── b1 ─── a2
///        ╳      ╳         graph   │      │      │
///    b0 ╱ ╲ b1 ╱ ╲ b2            b0 ─── a1 ─── b2
/// ```
pub fn scissor(units: usize, closed: bool) -> ConstraintGraph {
    let mut edges = Vec::new();
    for unit in 0..units {
        edges.push((2 * unit, 2 * unit + 1));
        if unit + 1 < units || closed {
            let next = (unit + 1) % units;
            edges.push((2 * unit, 2 * next + 1));
            edges.push((2 * unit + 1, 2 * next));
        }
    }
    numbered(2 * units, edges)
}

pub fn lattice(width: usize, height: usize) -> ConstraintGraph {
    let mut edges = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let here = y * width + x;
            if x + 1 < width {
                edges.push((here, here + 1));
            }
            if y + 1 < height {
                edges.push((here, here + width));
            }
        }
    }
    numbered(width * height, edges)
}

/// Two rings of `sides` nodes with a rung between each pair: the graph C × K2.
pub fn prism(sides: usize) -> ConstraintGraph {
    let edges = (0..sides).flat_map(|i| {
        let next = (i + 1) % sides;
        [(i, next), (sides + i, sides + next), (i, sides + i)]
    });
    numbered(2 * sides, edges.collect::<Vec<_>>())
}

/// Base, platform and `legs` legs of `joints` joints each.
pub fn platform(legs: usize, joints: usize) -> ConstraintGraph {
    let mut edges = Vec::new();
    let mut count = 2;
    for _ in 0..legs {
        let mut at = 0;
        for _ in 1..joints {
            edges.push((at, count));
            at = count;
            count += 1;
        }
        edges.push((at, 1));
    }
    numbered(count, edges)
}

pub fn complete(nodes: usize) -> ConstraintGraph {
    let edges = (0..nodes).flat_map(|a| (a + 1..nodes).map(move |b| (a, b)));
    numbered(nodes, edges.collect::<Vec<_>>())
}

/// Generalised Petersen graph: an outer ring, spokes, and an inner ring that skips.
fn generalised_petersen(sides: usize, skip: usize) -> ConstraintGraph {
    let edges = (0..sides).flat_map(|i| {
        [
            (i, (i + 1) % sides),
            (i, sides + i),
            (sides + i, sides + (i + skip) % sides),
        ]
    });
    numbered(2 * sides, edges.collect::<Vec<_>>())
}

pub fn petersen() -> ConstraintGraph {
    generalised_petersen(5, 2)
}

pub fn dodecahedron() -> ConstraintGraph {
    generalised_petersen(10, 2)
}
