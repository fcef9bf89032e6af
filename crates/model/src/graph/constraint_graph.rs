//! What the constraint graph is: links, joints, couplings, and the order of their names.

use petgraph::graph::{NodeIndex, UnGraph};
use serde::Serialize;
use thiserror::Error;

/// A link (a rigid body), one node of the graph.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct NodeSpec {
    /// The link's name, unique among links.
    pub name: String,
}

/// A joint, one edge of the graph.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct EdgeSpec {
    /// The joint's name, unique among joints.
    pub name: String,
    /// Node indices of the predecessor and the successor link, in this order. They must differ.
    pub ends: [usize; 2],
    /// Number of variables of the joint, 0 to 6.
    pub freedom: usize,
    /// Name of the joint's class, for display only.
    pub class: String,
}

/// One extra equation over several joints, such as a gear or a mimic joint. It ties together joints that the graph alone
/// would treat apart.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ExtraRelation {
    /// The relation's name, unique among relations.
    pub name: String,
    /// Edge indices of the joints that take part.
    pub edges: Vec<usize>,
}

/// An edge seen from one of its two nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Incidence {
    /// Index of the edge.
    pub edge: usize,
    /// Index of the node at the other end.
    pub node: usize,
}

/// Why some data is not a constraint graph.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum GraphError {
    /// The ground does not name a node.
    #[error("the ground must be one of the {nodes} links, but is given as number {ground}")]
    GroundOutOfRange {
        /// The index given.
        ground: usize,
        /// How many nodes there are.
        nodes: usize,
    },
    /// An edge ends at a node that does not exist.
    #[error("joint `{edge}` must end at two of the {nodes} links, but one end is number {end}")]
    EndOutOfRange {
        /// Name of the edge.
        edge: String,
        /// The index given.
        end: usize,
        /// How many nodes there are.
        nodes: usize,
    },
    /// An edge has the same node at both ends.
    #[error("joint `{edge}` must connect two different links, but both ends are `{node}`")]
    SelfLoop {
        /// Name of the edge.
        edge: String,
        /// Name of the node.
        node: String,
    },
    /// A coupling speaks of an edge that does not exist.
    #[error("coupling `{coupling}` must name some of the {edges} joints, but names number {edge}")]
    CouplingOutOfRange {
        /// Name of the coupling.
        coupling: String,
        /// The index given.
        edge: usize,
        /// How many edges there are.
        edges: usize,
    },
}

/// The spatial constraint graph: links as nodes, joints as edges (parallel edges allowed, no self-loops), a ground node
/// and couplings over edges.
///
/// Node and edge indices are those of the vectors it was made of, and of [`ConstraintGraph::petgraph`].
#[derive(Debug, Clone)]
pub struct ConstraintGraph {
    ground: usize,
    graph: UnGraph<NodeSpec, EdgeSpec>,
    couplings: Vec<ExtraRelation>,
    nodes_by_name: Vec<usize>,
    edges_by_name: Vec<usize>,
    node_rank: Vec<usize>,
    edge_rank: Vec<usize>,
    /// Incidences of all nodes one after the other, those of node `n` at `first[n]..first[n + 1]`, by edge name.
    incidences: Vec<Incidence>,
    first: Vec<usize>,
}

impl ConstraintGraph {
    /// Builds the graph from data already known to be valid, as every `Mechanism` is.
    ///
    /// # Panics
    /// On data that [`ConstraintGraph::try_new`] refuses: that is a fault of the caller, not of a file.
    #[must_use]
    pub fn new(
        ground: usize,
        nodes: Vec<NodeSpec>,
        edges: Vec<EdgeSpec>,
        couplings: Vec<ExtraRelation>,
    ) -> Self {
        match Self::try_new(ground, nodes, edges, couplings) {
            Ok(graph) => graph,
            Err(error) => panic!("{error}"),
        }
    }

    /// Builds the graph, checking that indices are in range and that no edge is a self-loop.
    ///
    /// # Errors
    /// [`GraphError`] for the first fault found.
    ///
    /// # Complexity
    /// O(V log V + E log E) comparisons of names.
    pub fn try_new(
        ground: usize,
        nodes: Vec<NodeSpec>,
        edges: Vec<EdgeSpec>,
        couplings: Vec<ExtraRelation>,
    ) -> Result<Self, GraphError> {
        check(ground, &nodes, &edges, &couplings)?;
        let nodes_by_name = sorted_by_name(nodes.len(), |n| &nodes[n].name);
        let edges_by_name = sorted_by_name(edges.len(), |e| &edges[e].name);
        let (incidences, first) = incidence_lists(nodes.len(), &edges, &edges_by_name);

        let mut graph = UnGraph::with_capacity(nodes.len(), edges.len());
        for node in nodes {
            graph.add_node(node);
        }
        for edge in edges {
            let [a, b] = edge.ends;
            graph.add_edge(NodeIndex::new(a), NodeIndex::new(b), edge);
        }
        Ok(Self {
            ground,
            graph,
            couplings,
            node_rank: inverse(&nodes_by_name),
            edge_rank: inverse(&edges_by_name),
            nodes_by_name,
            edges_by_name,
            incidences,
            first,
        })
    }

    /// Index of the fixed link.
    #[must_use]
    pub fn ground(&self) -> usize {
        self.ground
    }

    /// Number of links.
    #[must_use]
    pub fn node_count(&self) -> usize {
        self.graph.node_count()
    }

    /// Number of joints.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.graph.edge_count()
    }

    /// Number of independent cycles, E − V + C with C the number of connected components.
    #[must_use]
    pub fn loop_count(&self) -> usize {
        self.edge_count() + self.components().len() - self.node_count()
    }

    /// The link with this index.
    #[must_use]
    pub fn node(&self, node: usize) -> &NodeSpec {
        &self.graph[NodeIndex::new(node)]
    }

    /// The joint with this index.
    #[must_use]
    pub fn edge(&self, edge: usize) -> &EdgeSpec {
        &self.graph[petgraph::graph::EdgeIndex::new(edge)]
    }

    /// Name of a link.
    #[must_use]
    pub fn node_name(&self, node: usize) -> &str {
        &self.node(node).name
    }

    /// Name of a joint.
    #[must_use]
    pub fn edge_name(&self, edge: usize) -> &str {
        &self.edge(edge).name
    }

    /// The extra relations, in the order given.
    #[must_use]
    pub fn couplings(&self) -> &[ExtraRelation] {
        &self.couplings
    }

    /// The graph as petgraph sees it, with the same indices. For algorithms that are not offered here.
    #[must_use]
    pub fn petgraph(&self) -> &UnGraph<NodeSpec, EdgeSpec> {
        &self.graph
    }

    /// Number of edges at a node, parallel ones counted each.
    #[must_use]
    pub fn degree(&self, node: usize) -> usize {
        self.first[node + 1] - self.first[node]
    }

    /// The edges at a node, ordered by edge name.
    #[must_use]
    pub fn incident(&self, node: usize) -> &[Incidence] {
        &self.incidences[self.first[node]..self.first[node + 1]]
    }

    /// All node indices, ordered by name.
    #[must_use]
    pub fn nodes_by_name(&self) -> &[usize] {
        &self.nodes_by_name
    }

    /// All edge indices, ordered by name.
    #[must_use]
    pub fn edges_by_name(&self) -> &[usize] {
        &self.edges_by_name
    }

    /// Position of a node in [`ConstraintGraph::nodes_by_name`].
    #[must_use]
    pub fn node_rank(&self, node: usize) -> usize {
        self.node_rank[node]
    }

    /// Position of an edge in [`ConstraintGraph::edges_by_name`].
    #[must_use]
    pub fn edge_rank(&self, edge: usize) -> usize {
        self.edge_rank[edge]
    }
}

fn check(
    ground: usize,
    nodes: &[NodeSpec],
    edges: &[EdgeSpec],
    couplings: &[ExtraRelation],
) -> Result<(), GraphError> {
    let count = nodes.len();
    if ground >= count {
        return Err(GraphError::GroundOutOfRange {
            ground,
            nodes: count,
        });
    }
    for edge in edges {
        let [a, b] = edge.ends;
        if let Some(&end) = edge.ends.iter().find(|&&end| end >= count) {
            return Err(GraphError::EndOutOfRange {
                edge: edge.name.clone(),
                end,
                nodes: count,
            });
        }
        if a == b {
            return Err(GraphError::SelfLoop {
                edge: edge.name.clone(),
                node: nodes[a].name.clone(),
            });
        }
    }
    for coupling in couplings {
        if let Some(&edge) = coupling.edges.iter().find(|&&edge| edge >= edges.len()) {
            return Err(GraphError::CouplingOutOfRange {
                coupling: coupling.name.clone(),
                edge,
                edges: edges.len(),
            });
        }
    }
    Ok(())
}

fn sorted_by_name<'a>(count: usize, name: impl Fn(usize) -> &'a String) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| name(a).cmp(name(b)));
    order
}

fn inverse(order: &[usize]) -> Vec<usize> {
    let mut rank = vec![0; order.len()];
    for (position, &index) in order.iter().enumerate() {
        rank[index] = position;
    }
    rank
}

/// Filling the lists edge by edge in the order of names leaves each of them sorted.
fn incidence_lists(
    nodes: usize,
    edges: &[EdgeSpec],
    edges_by_name: &[usize],
) -> (Vec<Incidence>, Vec<usize>) {
    let mut first = vec![0; nodes + 1];
    for edge in edges {
        for end in edge.ends {
            first[end + 1] += 1;
        }
    }
    for node in 0..nodes {
        first[node + 1] += first[node];
    }
    let mut next = first.clone();
    let mut incidences = vec![Incidence { edge: 0, node: 0 }; 2 * edges.len()];
    for &edge in edges_by_name {
        let [a, b] = edges[edge].ends;
        for (here, there) in [(a, b), (b, a)] {
            incidences[next[here]] = Incidence { edge, node: there };
            next[here] += 1;
        }
    }
    (incidences, first)
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn indices_are_those_of_the_input() {
        let graph = samples::cartesian_table();
        assert_eq!(graph.node_count(), 5);
        assert_eq!(graph.edge_count(), 9);
        assert_eq!(graph.loop_count(), 5);
        assert_eq!(graph.node_name(2), "B3");
        assert_eq!(graph.edge_name(6), "C7");
        let (a, b) = graph
            .petgraph()
            .edge_endpoints(petgraph::graph::EdgeIndex::new(6))
            .map_or((9, 9), |(a, b)| (a.index(), b.index()));
        assert_eq!([a, b], graph.edge(6).ends);
    }

    #[test]
    fn incidences_come_by_edge_name() {
        let graph = samples::graph("ground", &[("z", "ground", "b"), ("a", "b", "ground")]);
        let names: Vec<_> = graph
            .incident(graph.ground())
            .iter()
            .map(|i| graph.edge_name(i.edge))
            .collect();
        assert_eq!(names, ["a", "z"]);
    }

    #[test]
    fn faults_are_told() {
        let nodes = || vec![NodeSpec { name: "a".into() }, NodeSpec { name: "b".into() }];
        let edge = |ends| EdgeSpec {
            name: "j".into(),
            ends,
            freedom: 1,
            class: "R".into(),
        };
        let fault = |ground, ends, coupled| {
            let relation = ExtraRelation {
                name: "gear".into(),
                edges: vec![coupled],
            };
            ConstraintGraph::try_new(ground, nodes(), vec![edge(ends)], vec![relation]).err()
        };
        assert_eq!(fault(0, [0, 1], 0), None);
        assert!(matches!(
            fault(2, [0, 1], 0),
            Some(GraphError::GroundOutOfRange { .. })
        ));
        assert!(matches!(
            fault(0, [0, 2], 0),
            Some(GraphError::EndOutOfRange { .. })
        ));
        assert!(matches!(
            fault(0, [1, 1], 0),
            Some(GraphError::SelfLoop { .. })
        ));
        assert!(matches!(
            fault(0, [0, 1], 1),
            Some(GraphError::CouplingOutOfRange { .. })
        ));
    }
}
