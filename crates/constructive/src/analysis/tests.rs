//! The three analyses agree.

use super::*;
use crate::graph::Graph;
use crate::pebbles::{PebbleGame, Standing};
use crate::samples::{self, Random};
use std::collections::BTreeSet;

/// What all three say, and that a solution is what it claims to be.
fn constructive(graph: &Graph) -> bool {
    let (up, down, owen) = (reduce(graph), decompose(graph), s_tree(graph));
    assert_eq!(up.solved, down.solved, "{graph:?}");
    assert_eq!(up.solved, owen.solved, "{graph:?}");
    let merges = graph.vertices() - 2;
    if up.solved {
        assert_eq!(up.merges.len(), merges);
        assert_eq!(down.sets.len(), merges);
        assert_eq!(owen.leaves(LeafKind::Triangle), merges);
    }
    set_decompositions(graph, &down);
    deficits(graph, &owen);
    up.solved
}

/// The vertices of every part, from the edges up; parts share what they say they share, and nothing else.
fn set_decompositions(graph: &Graph, down: &Decomposition) {
    let mut of: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); down.sets.len()];
    let part = |p: &Part, of: &[BTreeSet<usize>]| match p {
        Part::Edge(e) => graph.edges()[*e].into_iter().collect(),
        Part::Set(s) => of[*s].clone(),
        Part::Stuck(vertices) => vertices.iter().copied().collect::<BTreeSet<usize>>(),
    };
    for (i, set) in down.sets.iter().enumerate().rev() {
        let [a, b, c] = [0, 1, 2].map(|k| part(&set.parts[k], &of));
        for ((one, other), shared) in [(&a, &b), (&b, &c), (&c, &a)].into_iter().zip(set.shared) {
            assert!(one.intersection(other).eq([&shared]), "{graph:?}");
        }
        of[i] = [a, b, c].into_iter().flatten().collect();
    }
    assert_eq!(part(&down.root, &of).len(), graph.vertices());
}

/// The deficits of the leaves add up to that of the graph.
fn deficits(graph: &Graph, owen: &STree) {
    let deficit = |n: &Node| match n {
        Node::Leaf {
            vertices, edges, ..
        } => crate::graph::deficit(vertices.len(), edges.len()),
        Node::Split { .. } => 0,
    };
    let sum: i64 = owen.nodes.iter().map(deficit).sum();
    assert_eq!(sum, graph.deficit());
}

#[test]
fn the_three_agree_on_ten_thousand_graphs() {
    let mut random = Random::new(7);
    // By standing, and whether constructive.
    let mut seen = [[0; 2]; 3];
    for round in 0..10_000 {
        let n = 3 + random.below(58);
        let second = [0, 5, 20, 60][round % 4];
        let graph = match round / 4 % 8 {
            0 | 1 => samples::henneberg(n, second, &mut random),
            2 | 3 => samples::glued(n, &mut random),
            4 => samples::with_one_more(&samples::glued(n, &mut random), &mut random),
            5 => samples::with_one_fewer(&samples::glued(n, &mut random), &mut random),
            6 => {
                // Over-constrained here and under-constrained there: the count of all edges is right.
                let more = samples::with_one_more(
                    &samples::henneberg(n, second, &mut random),
                    &mut random,
                );
                samples::with_one_fewer(&more, &mut random)
            }
            _ => samples::any(n, 2 * n - 3, &mut random),
        };
        let standing = PebbleGame::play(&graph).standing();
        let solved = constructive(&graph);
        assert!(!solved || standing == Standing::Well);
        seen[standing as usize][usize::from(solved)] += 1;
    }
    let [[unsolved, solved], [under, _], [over, _]] = seen;
    assert!(unsolved > 1000 && solved > 3000, "{seen:?}");
    assert!(under > 500 && over > 1500, "{seen:?}");
}

#[test]
fn the_three_agree_on_all_small_graphs() {
    let mut counts = Vec::new();
    for n in 2..=7 {
        let graphs = samples::laman_graphs(n);
        let solved = graphs.iter().filter(|g| constructive(g)).count();
        counts.push((graphs.len(), solved));
    }
    // K3,3 and the prism are the only ones of six vertices that are not constructive.
    assert_eq!(counts[..5], [(1, 1), (1, 1), (1, 1), (3, 3), (13, 11)]);
    assert_eq!(counts[5].0, 70);
}

#[test]
fn graphs_by_name() {
    let named = |name| samples::named(name).unwrap();
    for (name, standing, solved) in [
        ("edge", Standing::Well, true),
        ("triangle", Standing::Well, true),
        ("chain of six", Standing::Well, true),
        ("chain of six, be left out", Standing::Under, false),
        ("K3,3", Standing::Well, false),
        ("prism", Standing::Well, false),
        ("quadrilateral", Standing::Under, false),
        ("K4", Standing::Over, false),
        ("bow tie", Standing::Under, false),
        ("K4 with a tail", Standing::Over, false),
    ] {
        let graph = named(name);
        assert_eq!(PebbleGame::play(&graph).standing(), standing, "{name}");
        assert_eq!(constructive(&graph), solved, "{name}");
    }
    for name in ["K3,3", "prism"] {
        assert_eq!(s_tree(&named(name)).leaves(LeafKind::Triconnected), 1);
    }
}

#[test]
fn splits_compensate_deficits() {
    // Two quadrilaterals with a diagonal each, glued at a pair that neither ties: the pair is held by one side only.
    let tree = s_tree(&samples::named("chain of six").unwrap());
    for (i, node) in tree.nodes.iter().enumerate() {
        let Node::Split {
            sides, virtual_in, ..
        } = node
        else {
            continue;
        };
        let stands_for = |n: &Node| match n {
            Node::Leaf { edges, .. } => edges.iter().any(|e| e.1 == Tie::Virtual(i)),
            Node::Split { .. } => true,
        };
        assert!(stands_for(&tree.nodes[sides[*virtual_in]]));
    }
    assert_eq!(tree.nodes.len(), 7, "three splits, four triangles");
}

#[test]
fn decomposition_and_s_tree_of_a_strip_cost_in_proportion() {
    let steps = |n: usize| {
        let graph = Graph::new(n, samples::strip(n)).unwrap();
        (decompose(&graph).steps, s_tree(&graph).steps)
    };
    let (short, long) = (steps(1000), steps(8000));
    assert!(long.0 <= 9 * short.0 && long.1 <= 9 * short.1);
}
