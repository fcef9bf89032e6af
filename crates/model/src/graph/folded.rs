//! The graph as people look at it: links that are fixed to one another are one.
//!
//! Files of robots are full of links that are only fixed to something: frames of sensors and tools, halves of a shell,
//! frames at which loops are closed. They say nothing about motion, and a drawing with all of them shows little else.

use super::constraint_graph::{ConstraintGraph, EdgeSpec, ExtraRelation, NodeSpec};
use super::spanning_tree::SpanningTree;
use crate::mechanism::Mechanism;
use petgraph::unionfind::UnionFind;
use std::collections::BTreeMap;

/// A constraint graph in which links joined by fixed joints of the spanning tree are one node.
///
/// A fixed joint that closes a loop stays, since it says where the loop is closed; so does one within a body that another
/// joint connects with itself, and one that a coupling names.
#[derive(Clone, Debug)]
pub struct FoldedGraph {
    /// What is left: a node is named after its link closest to the root.
    pub graph: ConstraintGraph,
    /// The spanning tree, closing loops where that of all links does.
    pub tree: SpanningTree,
    /// By node: the link that it is named after.
    pub links: Vec<usize>,
    /// By edge: the joint that it stands for.
    pub joints: Vec<usize>,
    /// The fixed joints that are not shown, by name.
    pub folded: Vec<usize>,
}

impl FoldedGraph {
    /// Folds the graph of a mechanism, whose tree is [`SpanningTree::of_mechanism`].
    ///
    /// # Complexity
    /// O((V + E) log (V + E)).
    #[must_use]
    pub fn new(graph: &ConstraintGraph, tree: &SpanningTree, mechanism: &Mechanism) -> Self {
        let folded = foldable(graph, tree, mechanism);
        let mut bodies = UnionFind::<usize>::new(graph.node_count());
        let mut is_folded = vec![false; graph.edge_count()];
        for &edge in &folded {
            let [a, b] = graph.edge(edge).ends;
            bodies.union(a, b);
            is_folded[edge] = true;
        }
        // Parents come first in the tree's order: the first link of a body is the one closest to the root.
        let mut named_after: BTreeMap<usize, usize> = BTreeMap::new();
        for &node in tree.order() {
            named_after.entry(bodies.find(node)).or_insert(node);
        }
        let mut links: Vec<usize> = named_after.values().copied().collect();
        links.sort_unstable();
        let position: BTreeMap<usize, usize> = links
            .iter()
            .enumerate()
            .map(|(position, link)| (bodies.find(*link), position))
            .collect();
        let at = |node: usize| position.get(&bodies.find(node)).copied().unwrap_or(0);
        let joints: Vec<usize> = (0..graph.edge_count()).filter(|e| !is_folded[*e]).collect();
        let mut edge_at = vec![0; graph.edge_count()];
        for (position, &joint) in joints.iter().enumerate() {
            edge_at[joint] = position;
        }
        let nodes = links
            .iter()
            .map(|&link| NodeSpec {
                name: graph.node_name(link).to_owned(),
            })
            .collect();
        let edges = joints
            .iter()
            .map(|&joint| EdgeSpec {
                ends: graph.edge(joint).ends.map(at),
                ..graph.edge(joint).clone()
            })
            .collect();
        let couplings = graph
            .couplings()
            .iter()
            .map(|coupling| ExtraRelation {
                name: coupling.name.clone(),
                edges: coupling.edges.iter().map(|&edge| edge_at[edge]).collect(),
            })
            .collect();
        let small = ConstraintGraph::new(at(graph.ground()), nodes, edges, couplings);
        let folded_tree = SpanningTree::rooted(&small, |edge| !tree.contains(joints[edge]));
        Self {
            graph: small,
            tree: folded_tree,
            links,
            joints,
            folded,
        }
    }
}

/// Fixed joints of the tree, by name, whose bodies no other joint connects with themselves.
fn foldable(graph: &ConstraintGraph, tree: &SpanningTree, mechanism: &Mechanism) -> Vec<usize> {
    let mut coupled = vec![false; graph.edge_count()];
    for coupling in graph.couplings() {
        for &edge in &coupling.edges {
            coupled[edge] = true;
        }
    }
    let fixed = |edge: &usize| {
        mechanism.joints()[*edge].freedom() == 0 && tree.contains(*edge) && !coupled[*edge]
    };
    let candidates: Vec<usize> = tree.edges().iter().copied().filter(fixed).collect();
    let mut bodies = UnionFind::<usize>::new(graph.node_count());
    let mut is_candidate = vec![false; graph.edge_count()];
    for &edge in &candidates {
        let [a, b] = graph.edge(edge).ends;
        bodies.union(a, b);
        is_candidate[edge] = true;
    }
    let mut kept_apart = vec![false; graph.node_count()];
    for edge in (0..graph.edge_count()).filter(|e| !is_candidate[*e]) {
        let [a, b] = graph.edge(edge).ends.map(|node| bodies.find(node));
        kept_apart[a] |= a == b;
    }
    candidates
        .into_iter()
        .filter(|&edge| !kept_apart[bodies.find(graph.edge(edge).ends[0])])
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::names;
    use super::*;
    use crate::mechanism::{JointBuilder, JointKind, MechanismBuilder};

    fn folded(builder: &MechanismBuilder) -> FoldedGraph {
        let mechanism = builder.clone().build().unwrap();
        let graph = ConstraintGraph::of(&mechanism);
        let tree = SpanningTree::of_mechanism(&graph, &mechanism);
        FoldedGraph::new(&graph, &tree, &mechanism)
    }

    ///```text
    ///   base ─mount─ torso ─hip─ leg ─sole─ foot         mount, sole and eye are fixed
    ///                  └─eye─ camera
    ///```
    fn robot() -> MechanismBuilder {
        let mut builder = MechanismBuilder::new("robot");
        for link in ["base", "torso", "leg", "foot", "camera"] {
            builder.link(link);
        }
        for (name, kind, from, to) in [
            ("mount", JointKind::Fixed, "base", "torso"),
            ("hip", JointKind::Revolute, "torso", "leg"),
            ("sole", JointKind::Fixed, "leg", "foot"),
            ("eye", JointKind::Fixed, "torso", "camera"),
        ] {
            builder.joint(JointBuilder::tree(name, kind, from, to));
        }
        builder
    }

    #[test]
    fn what_is_fixed_together_is_one() {
        let folded = folded(&robot());
        let graph = &folded.graph;
        assert_eq!((graph.node_count(), graph.edge_count()), (2, 1));
        assert_eq!(graph.node_name(graph.ground()), "base");
        assert_eq!(names(graph, folded.tree.edges()), ["hip"]);
        let [a, b] = graph.edge(0).ends;
        assert_eq!((graph.node_name(a), graph.node_name(b)), ("base", "leg"));
        assert_eq!(folded.folded.len(), 3);
    }

    #[test]
    fn loops_stay_where_they_close() {
        // A weld closes the loop of the leg, and a hinge connects the torso with its own camera.
        let mut builder = robot();
        builder.joint(JointBuilder::closing(
            "weld",
            JointKind::Fixed,
            "foot",
            "base",
        ));
        builder.joint(JointBuilder::closing(
            "lid",
            JointKind::Revolute,
            "camera",
            "torso",
        ));
        let folded = folded(&builder);
        assert_eq!(names(&folded.graph, folded.tree.chords()), ["lid", "weld"]);
        // The body of the torso is shown as the file has it.
        assert_eq!(folded.folded.len(), 1);
        assert_eq!(folded.graph.loop_count(), 2);
    }
}
