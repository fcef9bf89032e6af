//! What a tree or a set of cycles must satisfy, checked from the definitions alone.
//!
//! These checks trust nothing but the ends of the edges. They serve the tests of this crate, and whoever brings cycles from
//! elsewhere.

use thiserror::Error;

use super::constraint_graph::ConstraintGraph;
use super::cycles::Cycle;
use super::gf2::Eliminator;
use super::spanning_tree::SpanningTree;

/// Which promise is broken, and where. Cycles are told by their position in the list.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Violation {
    /// The cycle has no edges, or only one.
    #[error("cycle {cycle} has {length} edges; a cycle has two or more")]
    TooShort {
        /// Position of the cycle.
        cycle: usize,
        /// Its length.
        length: usize,
    },
    /// The cycle names an edge that the graph does not have.
    #[error("cycle {cycle} passes edge number {edge}, which does not exist")]
    NoSuchEdge {
        /// Position of the cycle.
        cycle: usize,
        /// The index given.
        edge: usize,
    },
    /// An edge does not start where the one before it ends (the first follows the last).
    #[error("cycle {cycle} is torn before joint `{edge}`")]
    Torn {
        /// Position of the cycle.
        cycle: usize,
        /// Name of the edge that does not fit.
        edge: String,
    },
    /// The cycle comes twice through a node, or there and back along one edge.
    #[error("cycle {cycle} passes `{name}` twice")]
    PassedTwice {
        /// Position of the cycle.
        cycle: usize,
        /// Name of the link, or of the joint.
        name: String,
    },
    /// The number of cycles is not that of independent loops.
    #[error("{found} cycles for {needed} independent loops")]
    WrongNumber {
        /// How many there are.
        found: usize,
        /// How many there must be.
        needed: usize,
    },
    /// The cycle is a sum of cycles before it.
    #[error("cycle {cycle} is a sum of cycles before it")]
    Dependent {
        /// Position of the cycle.
        cycle: usize,
    },
    /// A node's edge to its parent does not lead there, or the depth does not fit.
    #[error("link `{node}` is not one step below its parent")]
    BadParent {
        /// Name of the node.
        node: String,
    },
    /// The tree misses a node, or has a number of roots other than that of the components.
    #[error(
        "the tree reaches {reached} of {nodes} links from {roots} roots in {components} components"
    )]
    NotSpanning {
        /// Nodes reached.
        reached: usize,
        /// Nodes there are.
        nodes: usize,
        /// Roots of the tree.
        roots: usize,
        /// Connected components of the graph.
        components: usize,
    },
    /// Tree edges and chords do not divide the edges between them.
    #[error("joint `{edge}` must be a tree edge or a chord, and not both")]
    BadPartition {
        /// Name of the edge.
        edge: String,
    },
}

/// Checks that every cycle is a closed walk passing no node and no edge twice.
///
/// # Errors
/// The first [`Violation`] found.
pub fn check_cycles(graph: &ConstraintGraph, cycles: &[Cycle]) -> Result<(), Violation> {
    let mut last_visit = vec![usize::MAX; graph.node_count()];
    for (position, cycle) in cycles.iter().enumerate() {
        if cycle.len() < 2 {
            return Err(Violation::TooShort {
                cycle: position,
                length: cycle.len(),
            });
        }
        if let Some(&(edge, _)) = cycle.edges.iter().find(|(e, _)| *e >= graph.edge_count()) {
            return Err(Violation::NoSuchEdge {
                cycle: position,
                edge,
            });
        }
        let passed_twice = |name: &str| Violation::PassedTwice {
            cycle: position,
            name: name.to_string(),
        };
        if cycle.len() == 2 && cycle.edges[0].0 == cycle.edges[1].0 {
            return Err(passed_twice(graph.edge_name(cycle.edges[0].0)));
        }
        let leaves = |(edge, forward): (usize, bool)| graph.edge(edge).ends[usize::from(!forward)];
        let arrives = |(edge, forward): (usize, bool)| graph.edge(edge).ends[usize::from(forward)];
        let mut at = cycle.edges.last().map(|&step| arrives(step));
        for &step in &cycle.edges {
            let node = leaves(step);
            if at != Some(node) {
                return Err(Violation::Torn {
                    cycle: position,
                    edge: graph.edge_name(step.0).to_string(),
                });
            }
            if std::mem::replace(&mut last_visit[node], position) == position {
                return Err(passed_twice(graph.node_name(node)));
            }
            at = Some(arrives(step));
        }
    }
    Ok(())
}

/// Checks that the cycles are a basis of the cycle space: sound cycles, as many as there are independent loops, and
/// independent over GF(2), hence over the rationals too.
///
/// # Errors
/// The first [`Violation`] found.
pub fn check_basis(graph: &ConstraintGraph, cycles: &[Cycle]) -> Result<(), Violation> {
    check_cycles(graph, cycles)?;
    let needed = graph.loop_count();
    if cycles.len() != needed {
        return Err(Violation::WrongNumber {
            found: cycles.len(),
            needed,
        });
    }
    let mut rows = Eliminator::new(graph.edge_count());
    for (position, cycle) in cycles.iter().enumerate() {
        let columns = cycle
            .edges
            .iter()
            .filter_map(|&(e, _)| u32::try_from(e).ok());
        if !rows.insert(columns) {
            return Err(Violation::Dependent { cycle: position });
        }
    }
    Ok(())
}

/// Checks that the tree spans: every component has one root, every other node hangs one step below its parent by a tree
/// edge that really connects the two, and every edge is either tree edge or chord.
///
/// # Errors
/// The first [`Violation`] found.
pub fn check_tree(graph: &ConstraintGraph, tree: &SpanningTree) -> Result<(), Violation> {
    let nodes = graph.node_count();
    let components = graph.components().len();
    let roots = tree.roots().len();
    let not_spanning = |reached: usize| Violation::NotSpanning {
        reached,
        nodes,
        roots,
        components,
    };
    // A tree of another graph may have other indices altogether.
    let edges = tree.edges().len() + tree.chords().len();
    if tree.order().len() != nodes || edges != graph.edge_count() {
        return Err(not_spanning(tree.order().len()));
    }
    let mut reached = vec![false; nodes];
    for &node in tree.order() {
        // Parents come first, so a node whose parent has been reached is reached from a root.
        let sound = match tree.parent(node) {
            None => tree.depth(node) == 0 && tree.roots().contains(&node),
            Some(up) => {
                let [a, b] = graph.edge(up.edge).ends;
                let connects = (a, b) == (node, up.node) || (b, a) == (node, up.node);
                let step = tree.depth(node) == tree.depth(up.node) + 1;
                connects && step && reached[up.node] && tree.contains(up.edge)
            }
        };
        if !sound {
            return Err(Violation::BadParent {
                node: graph.node_name(node).to_string(),
            });
        }
        reached[node] = true;
    }
    let reached = reached.iter().filter(|&&r| r).count();
    if reached != nodes || roots != components || tree.edges().len() + roots != nodes {
        return Err(not_spanning(reached));
    }
    let mut is_chord = vec![false; graph.edge_count()];
    for &chord in tree.chords() {
        is_chord[chord] = true;
    }
    match (0..graph.edge_count()).find(|&edge| is_chord[edge] == tree.contains(edge)) {
        Some(edge) => Err(Violation::BadPartition {
            edge: graph.edge_name(edge).to_string(),
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::cycles::fundamental_cycles;
    use super::super::samples;
    use super::*;

    fn cycle(edges: &[(usize, bool)]) -> Cycle {
        Cycle {
            edges: edges.to_vec(),
        }
    }

    #[test]
    fn trees_and_their_cycles_pass() {
        for graph in [
            samples::cartesian_table(),
            samples::lattice(5, 7),
            samples::petersen(),
            samples::scissor(9, true),
            samples::graph_with_isolated("a", &[("1", "b", "c"), ("2", "b", "c")], &["d"]),
        ] {
            let tree = SpanningTree::low_depth(&graph);
            assert_eq!(check_tree(&graph, &tree), Ok(()));
            let cycles = fundamental_cycles(&graph, &tree);
            assert_eq!(check_basis(&graph, &cycles), Ok(()));
            assert!(super::super::peels(&cycles));
            for (cycle, &chord) in cycles.iter().zip(tree.chords()) {
                assert_eq!(cycle.len(), tree.fundamental_length(&graph, chord));
                assert!(cycle.edges.iter().any(|&(edge, _)| edge == chord));
            }
        }
    }

    /// A tree checked against another graph is found out.
    #[test]
    fn a_foreign_tree_fails() {
        let graph = samples::ring(6);
        let tree = SpanningTree::low_depth(&samples::serial_chain(6));
        assert!(check_tree(&graph, &tree).is_err());
        let crossed = samples::numbered(5, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0), (0, 2)]);
        let other = samples::numbered(5, [(0, 3), (1, 2), (2, 3), (3, 4), (4, 1), (0, 2)]);
        let tree = SpanningTree::low_depth(&crossed);
        assert_eq!(check_tree(&crossed, &tree), Ok(()));
        assert!(matches!(
            check_tree(&other, &tree),
            Err(Violation::BadParent { .. })
        ));
    }

    ///```text
    ///        C1          C5
    ///   B4 ══════ B1 ══════ B3 ⋯      C1, C2 forward are B1 → B4; C5, C8 forward are B3 → B1
    ///        C2          C8
    ///```
    #[test]
    fn broken_cycles_are_named() {
        let graph = samples::cartesian_table();
        let check = |edges: &[(usize, bool)]| check_cycles(&graph, &[cycle(edges)]).err();
        assert_eq!(check(&[(0, true), (1, false)]), None);
        assert!(matches!(
            check(&[(0, true), (1, true)]),
            Some(Violation::Torn { .. })
        ));
        assert!(matches!(
            check(&[(0, true)]),
            Some(Violation::TooShort { .. })
        ));
        assert!(matches!(
            check(&[(0, true), (0, false)]),
            Some(Violation::PassedTwice { .. })
        ));
        assert!(matches!(
            check(&[(0, true), (99, false)]),
            Some(Violation::NoSuchEdge { .. })
        ));
        let eight = [(0, true), (1, false), (4, false), (7, true)];
        assert!(matches!(check(&eight), Some(Violation::PassedTwice { .. })));
    }

    #[test]
    fn bases_are_counted_and_independent() {
        let graph = samples::cartesian_table();
        let tree = SpanningTree::low_depth(&graph);
        let mut cycles = fundamental_cycles(&graph, &tree);
        cycles.pop();
        assert!(matches!(
            check_basis(&graph, &cycles),
            Err(Violation::WrongNumber { .. })
        ));
        cycles.push(cycles[0].clone());
        assert_eq!(
            check_basis(&graph, &cycles),
            Err(Violation::Dependent { cycle: 4 })
        );
    }
}
