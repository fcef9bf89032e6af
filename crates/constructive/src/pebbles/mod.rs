//! What is over-constrained, what is left free, and why: the pebble game.
//!
//! # The problem
//! A graph is *over-constrained* where some m of its vertices carry more than 2m − 3 edges, *under-constrained* where it is not
//! and has fewer than 2V − 3 edges, *well-constrained* otherwise. There are too many subgraphs to count them all.
//!
//! # How it is decided
//! Every vertex has two pebbles. An edge is *independent* of those before it if four pebbles can be gathered at its ends, moving
//! pebbles against the directions of the edges that they cover; it then keeps one of them. Where only three can be
//! gathered, the vertices within reach are exactly those that the edges before hold rigid, the fewest with both
//! ends: together with the refused edge they are a *circuit*, over-constrained by one and nowhere within itself.
//!
//! # What it costs
//! An edge costs four searches of what is within reach: O(V·E) at worst, [`PebbleGame::steps`] counts. A rigid part costs what
//! lies in it and around it: in proportion to all parts together where free pebbles are near.
//!
//! Sources: Jacobs and Hendrickson (1997); Lee and Streinu (2008).

mod board;

use crate::graph::Graph;
use board::Board;

/// What the count over all subgraphs says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// No subgraph has too many edges, and the whole has as many as it needs.
    Well,
    /// No subgraph has too many edges, and the whole too few.
    Under,
    /// Some subgraph has too many edges, whatever the whole has.
    Over,
}

/// An edge that those before it imply, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Circuit {
    /// The edge.
    pub edge: usize,
    /// The vertices, ascending, that the independent edges before it hold rigid already: with both of its ends, and as few as
    /// there can be. All independent edges among them are needed for that.
    pub vertices: Vec<usize>,
}

/// The played game.
#[derive(Clone, Debug)]
pub struct PebbleGame {
    edges: Vec<[usize; 2]>,
    board: Board,
    circuits: Vec<Circuit>,
    independent: usize,
}

impl PebbleGame {
    /// Plays the game, edges in their order.
    #[must_use]
    pub fn play(graph: &Graph) -> Self {
        let mut board = Board::new(graph.vertices());
        let mut circuits = Vec::new();
        for (edge, &ends) in graph.edges().iter().enumerate() {
            if board.gather(ends) == 4 {
                board.cover(ends);
            } else {
                let vertices = board.within_reach(ends);
                circuits.push(Circuit { edge, vertices });
            }
        }
        Self {
            edges: graph.edges().to_vec(),
            independent: graph.edges().len() - circuits.len(),
            board,
            circuits,
        }
    }

    /// Over-, under- or well-constrained.
    #[must_use]
    pub fn standing(&self) -> Standing {
        match (self.circuits.is_empty(), self.freedoms()) {
            (false, _) => Standing::Over,
            (true, 0) => Standing::Well,
            (true, _) => Standing::Under,
        }
    }

    /// The freedoms left beside the three of the whole in the plane: (2V − 3) less the independent edges.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        2 * self.board.vertices() - 3 - self.independent
    }

    /// Every edge that those before it imply; none where the graph is not over-constrained. Their number does not depend on
    /// the order of the edges.
    #[must_use]
    pub fn circuits(&self) -> &[Circuit] {
        &self.circuits
    }

    /// Vertices looked at so far.
    #[must_use]
    pub const fn steps(&self) -> u64 {
        self.board.steps()
    }

    /// The largest parts that are rigid in themselves, by first edge, vertices ascending. Every edge lies in one; two of them
    /// share one vertex at most.
    #[must_use]
    pub fn rigid_parts(&self) -> Vec<Vec<usize>> {
        self.parts_and_steps().0
    }

    fn parts_and_steps(&self) -> (Vec<Vec<usize>>, u64) {
        let mut board = self.board.clone();
        let mut near: Vec<Vec<usize>> = vec![Vec::new(); board.vertices()];
        for &[u, v] in &self.edges {
            near[u].push(v);
            near[v].push(u);
        }
        // Ascending, as parts are found.
        let mut part_of: Vec<Vec<usize>> = vec![Vec::new(); board.vertices()];
        let mut parts: Vec<Vec<usize>> = Vec::new();
        for &[u, v] in &self.edges {
            let few_first = part_of[u].len() <= part_of[v].len();
            let [few, many] = if few_first { [u, v] } else { [v, u] };
            let both = |p: &usize| part_of[many].binary_search(p).is_ok();
            if part_of[few].iter().any(both) {
                continue;
            }
            let part = board.rigid_around([u, v], &near);
            for &w in &part {
                part_of[w].push(parts.len());
            }
            parts.push(part);
        }
        (parts, board.steps() - self.board.steps())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::samples::{self, Random};

    /// The definition, over all sets of vertices.
    fn by_definition(graph: &Graph) -> Standing {
        let n = graph.vertices();
        let over = (0_u32..1 << n).any(|set| {
            let m = set.count_ones() as i64;
            let inside = |&&[u, v]: &&[usize; 2]| set >> u & 1 == 1 && set >> v & 1 == 1;
            m >= 2 && graph.edges().iter().filter(inside).count() as i64 > 2 * m - 3
        });
        match (over, graph.deficit()) {
            (true, _) => Standing::Over,
            (false, 0) => Standing::Well,
            (false, _) => Standing::Under,
        }
    }

    #[test]
    fn the_game_says_what_the_definition_says() {
        let mut random = Random::new(3);
        let mut seen = [0; 3];
        for _ in 0..400 {
            let n = 2 + random.below(7);
            let fewer = 3 + random.below(2);
            let graph = samples::any(n, 2 * n - fewer.min(2 * n), &mut random);
            let standing = PebbleGame::play(&graph).standing();
            assert_eq!(standing, by_definition(&graph), "{graph:?}");
            seen[standing as usize] += 1;
        }
        assert!(seen.iter().all(|&s| s > 20), "{seen:?}");
    }

    #[test]
    fn a_circuit_is_over_constrained_by_one_and_nowhere_within() {
        let mut random = Random::new(4);
        let mut seen = 0;
        for _ in 0..200 {
            let n = 4 + random.below(5);
            let graph = samples::any(n, 2 * n - 2, &mut random);
            let game = PebbleGame::play(&graph);
            let refused: Vec<usize> = game.circuits().iter().map(|c| c.edge).collect();
            for circuit in game.circuits() {
                seen += 1;
                let on = |e: usize| {
                    graph.edges()[e]
                        .iter()
                        .all(|v| circuit.vertices.contains(v))
                };
                let among: Vec<usize> = (0..circuit.edge)
                    .filter(|&e| on(e) && !refused.contains(&e))
                    .chain([circuit.edge])
                    .collect();
                assert_eq!(among.len(), 2 * circuit.vertices.len() - 2);
                for left_out in &among {
                    let fewer = among.iter().filter(|e| *e != left_out);
                    let fewer = Graph::new(n, fewer.map(|&e| graph.edges()[e])).unwrap();
                    assert_ne!(by_definition(&fewer), Standing::Over);
                }
            }
        }
        assert!(seen > 100);
    }

    #[test]
    fn two_triangles_at_a_hinge_are_two_rigid_parts_with_one_freedom() {
        let graph = samples::named("bow tie").unwrap();
        let game = PebbleGame::play(&graph);
        assert_eq!(game.standing(), Standing::Under);
        assert_eq!(game.freedoms(), 1);
        assert_eq!(game.rigid_parts(), [vec![0, 1, 2], vec![2, 3, 4]]);
    }

    #[test]
    fn rigid_parts_share_one_vertex_at_most_and_hold_every_edge() {
        let mut random = Random::new(5);
        for _ in 0..200 {
            let n = 4 + random.below(12);
            let graph = samples::any(n, 2 * n - 4, &mut random);
            let parts = PebbleGame::play(&graph).rigid_parts();
            for (i, one) in parts.iter().enumerate() {
                let edges = graph.edges().iter();
                let inside = edges.filter(|e| e.iter().all(|v| one.contains(v))).copied();
                let inside = Graph::new(n, inside).unwrap();
                let free = PebbleGame::play(&inside).freedoms();
                assert_eq!(free, 2 * (n - one.len()), "rigid");
                for other in &parts[..i] {
                    assert!(one.iter().filter(|v| other.contains(v)).count() < 2);
                }
            }
            for edge in graph.edges() {
                assert!(parts.iter().any(|p| edge.iter().all(|v| p.contains(v))));
            }
        }
    }

    #[test]
    fn rigid_parts_cost_in_proportion() {
        let path = |n: usize| (1..n).map(|k| [k - 1, k]).collect::<Vec<_>>();
        let star = |n: usize| (1..n).map(|k| [0, k]).collect();
        let two_hubs = |n: usize| (2..n).flat_map(|k| [[0, k], [1, k]]).collect();
        let ladder = |n: usize| {
            (0..n / 2)
                .flat_map(|k| {
                    [
                        [2 * k, 2 * k + 1],
                        [2 * k, 2 * k + 2],
                        [2 * k + 1, 2 * k + 3],
                    ]
                })
                .filter(|e| e[1] < n)
                .collect()
        };
        let triangles = |n: usize| {
            (0..n / 2)
                .flat_map(|k| {
                    [
                        [2 * k, 2 * k + 1],
                        [2 * k + 1, 2 * k + 2],
                        [2 * k, 2 * k + 2],
                    ]
                })
                .filter(|e| e[1] < n)
                .collect()
        };
        type Shape<'a> = (&'a str, &'a dyn Fn(usize) -> Vec<[usize; 2]>);
        let shapes: [Shape<'_>; 5] = [
            ("path", &path),
            ("star", &star),
            ("two hubs", &two_hubs),
            ("ladder", &ladder),
            ("triangles at hinges", &triangles),
        ];
        for (name, edges) in shapes {
            let steps = |n: usize| {
                let graph = Graph::new(n, edges(n)).unwrap();
                PebbleGame::play(&graph).parts_and_steps().1
            };
            let (short, long) = (steps(1001), steps(8001));
            assert!(long <= 10 * short, "{name}: {short} {long}");
        }
    }
}
