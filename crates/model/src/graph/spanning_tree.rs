//! The low-depth spanning tree: along which joints each link is reached.
//!
//! Every edge outside the tree (a *chord*) closes exactly one cycle with it, so the tree gives a basis of cycles, and a
//! shallow tree gives short ones: a cycle has at most 2·height + 1 edges. Finding the shallowest tree is not attempted;
//! the tree grows greedily from the nodes with the most edges.
//!
//! People are shown the tree that their file describes, rooted at the ground ([`SpanningTree::of_mechanism`]), so that
//! report, page and graph close loops where the file does. Equations are made from the shallow one.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::constraint_graph::{ConstraintGraph, Incidence};
use crate::mechanism::Mechanism;

/// A spanning tree of every connected component: a rooted forest that covers all nodes.
///
/// The root is the node of highest degree; the node to branch at next is the one of highest degree among those waiting;
/// ties go by node name (procedure `spanning_tree`, Ruiz 1994, section 5.4.2, there without a rule for ties). Which nodes
/// join does not depend on the order of the edges within a node, only which of several parallel edges becomes the tree's:
/// the first by edge name, in the low-depth tree one with the fewest freedoms: every cycle through the pair of links then has
/// that joint's few variables (as Ruiz chose by hand, table 6.7).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpanningTree {
    roots: Vec<usize>,
    order: Vec<usize>,
    parent: Vec<Option<Incidence>>,
    depth: Vec<usize>,
    /// An ancestor some way up (Myers 1983): following it whenever it does not overshoot finds ancestors in O(log depth).
    jump: Vec<usize>,
    in_tree: Vec<bool>,
    edges: Vec<usize>,
    chords: Vec<usize>,
}

impl SpanningTree {
    /// The low-depth tree, each component rooted at its node of highest degree.
    ///
    /// # Complexity
    /// O((V + E) + V log V).
    #[must_use]
    pub fn low_depth(graph: &ConstraintGraph) -> Self {
        Self::grow(graph, None, |_| false, |edge| graph.edge(edge).freedom)
    }

    /// The tree of the file: rooted at the ground, made of the joints that the file does not write as closing a loop. One
    /// that does is taken only where no other joint leads on, as to a body that loops alone hold. The graph's edges are
    /// the mechanism's joints, as in [`ConstraintGraph::of`].
    ///
    /// # Complexity
    /// O((V + E) log (V + E)).
    #[must_use]
    pub fn of_mechanism(graph: &ConstraintGraph, mechanism: &Mechanism) -> Self {
        Self::rooted(graph, |edge| mechanism.joints()[edge].closes_loop)
    }

    /// The tree rooted at the ground in which the edges that are `last` are taken only where no other leads on.
    ///
    /// # Complexity
    /// O((V + E) log (V + E)).
    #[must_use]
    pub fn rooted(graph: &ConstraintGraph, last: impl Fn(usize) -> bool) -> Self {
        Self::grow(graph, Some(graph.ground()), last, |_| 0)
    }

    /// The same with `node` as the root of its component, whatever its degree.
    ///
    /// # Panics
    /// If `node` is not a node of the graph.
    #[must_use]
    pub fn root_at(graph: &ConstraintGraph, node: usize) -> Self {
        Self::grow(graph, Some(node), |_| false, |_| 0)
    }

    /// Of parallel edges one of the least `weight` is taken.
    fn grow(
        graph: &ConstraintGraph,
        chosen: Option<usize>,
        last: impl Fn(usize) -> bool,
        weight: impl Fn(usize) -> usize,
    ) -> Self {
        let priority = |node: usize| (graph.degree(node), Reverse(graph.node_rank(node)));
        let nodes = graph.node_count();
        let mut tree = Self {
            roots: Vec::new(),
            order: Vec::with_capacity(nodes),
            parent: vec![None; nodes],
            depth: vec![0; nodes],
            jump: (0..nodes).collect(),
            in_tree: vec![false; graph.edge_count()],
            edges: Vec::new(),
            chords: Vec::new(),
        };
        let mut reached = vec![false; nodes];
        for component in graph.components() {
            let highest = component.iter().copied().max_by_key(|&n| priority(n));
            let root = chosen.filter(|c| component.contains(c)).or(highest);
            let Some(root) = root else { continue };
            tree.roots.push(root);
            reached[root] = true;
            let mut waiting = BinaryHeap::from([(priority(root), root)]);
            // Edges put off, the one closest to the root first, then by name.
            let mut later = BinaryHeap::new();
            loop {
                while let Some((_, node)) = waiting.pop() {
                    tree.order.push(node);
                    let mut incident: Vec<&Incidence> = graph.incident(node).iter().collect();
                    incident.sort_by_key(|incidence| weight(incidence.edge));
                    for incidence in incident {
                        let child = incidence.node;
                        if reached[child] {
                            continue;
                        }
                        if last(incidence.edge) {
                            let rank = graph.edge_rank(incidence.edge);
                            later.push((Reverse((tree.depth[node], rank)), node, *incidence));
                            continue;
                        }
                        reached[child] = true;
                        tree.attach(child, incidence.edge, node);
                        waiting.push((priority(child), child));
                    }
                }
                let Some((_, node, incidence)) = later.pop() else {
                    break;
                };
                let child = incidence.node;
                if !std::mem::replace(&mut reached[child], true) {
                    tree.attach(child, incidence.edge, node);
                    waiting.push((priority(child), child));
                }
            }
        }
        (tree.edges, tree.chords) = graph
            .edges_by_name()
            .iter()
            .partition(|&&edge| tree.in_tree[edge]);
        tree
    }

    fn attach(&mut self, child: usize, edge: usize, parent: usize) {
        self.in_tree[edge] = true;
        self.parent[child] = Some(Incidence { edge, node: parent });
        self.depth[child] = self.depth[parent] + 1;
        let far = self.jump[parent];
        let farther = self.jump[far];
        let equal_steps =
            self.depth[parent] - self.depth[far] == self.depth[far] - self.depth[farther];
        self.jump[child] = if equal_steps { farther } else { parent };
    }

    /// The root of every component, that of the ground's component first.
    #[must_use]
    pub fn roots(&self) -> &[usize] {
        &self.roots
    }

    /// All nodes in the order in which the tree branched at them. A parent comes before its children.
    #[must_use]
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// The edge and node above `node`, or `None` at a root.
    #[must_use]
    pub fn parent(&self, node: usize) -> Option<Incidence> {
        self.parent[node]
    }

    /// Number of edges from the root to `node`.
    #[must_use]
    pub fn depth(&self, node: usize) -> usize {
        self.depth[node]
    }

    /// The largest depth; 0 for a graph without edges.
    #[must_use]
    pub fn height(&self) -> usize {
        self.depth.iter().copied().max().unwrap_or(0)
    }

    /// Whether the edge belongs to the tree.
    #[must_use]
    pub fn contains(&self, edge: usize) -> bool {
        self.in_tree[edge]
    }

    /// The edges of the tree, by name.
    #[must_use]
    pub fn edges(&self) -> &[usize] {
        &self.edges
    }

    /// The edges outside the tree, by name.
    #[must_use]
    pub fn chords(&self) -> &[usize] {
        &self.chords
    }

    /// The edges from `node` up to its root, each with the node it leads to.
    pub fn path_to_root(&self, node: usize) -> impl Iterator<Item = Incidence> + '_ {
        std::iter::successors(self.parent[node], |step| self.parent[step.node])
    }

    /// The deepest node above (or equal to) both, or `None` if they are in different components.
    ///
    /// # Complexity
    /// O(log depth).
    #[must_use]
    pub fn lowest_common_ancestor(&self, a: usize, b: usize) -> Option<usize> {
        let (mut a, mut b) = if self.depth[a] >= self.depth[b] {
            (a, b)
        } else {
            (b, a)
        };
        while self.depth[a] > self.depth[b] {
            let above = self.parent[a]?.node;
            a = if self.depth[self.jump[a]] >= self.depth[b] {
                self.jump[a]
            } else {
                above
            };
        }
        // Nodes of equal depth have jumps of equal length, so both climb together.
        while a != b {
            let (above_a, above_b) = (self.parent[a]?.node, self.parent[b]?.node);
            (a, b) = if self.jump[a] == self.jump[b] {
                (above_a, above_b)
            } else {
                (self.jump[a], self.jump[b])
            };
        }
        Some(a)
    }

    /// Number of edges of the cycle that `edge` closes with the tree, without walking it. For a tree edge this is 2, the
    /// edge there and back.
    #[must_use]
    pub fn fundamental_length(&self, graph: &ConstraintGraph, edge: usize) -> usize {
        let [a, b] = graph.edge(edge).ends;
        let top = self.lowest_common_ancestor(a, b);
        self.depth[a] + self.depth[b] + 1 - 2 * top.map_or(0, |top| self.depth[top])
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::constraint_graph::{EdgeSpec, NodeSpec};
    use super::super::samples::{self, names};
    use super::*;

    ///```text
    ///        C1          C5         C6          C3
    ///   B4 ══════ B1 ══════ B3 ══════ B2 ══════ B5      each double line two joints
    ///        C2          C8         C9          C4
    ///    └────────────────── C7 ──────────────────┘
    ///```
    /// B1, B2 and B3 have four joints each. Ruiz starts at B3 and goes on with B1 and B2; by name the root is B1, and the
    /// tree has the same edges. (The text of section 5.4.2 prints C4 as a tree edge, the cycles of Table 5.2 need C3.)
    #[test]
    fn cartesian_table() {
        let graph = samples::cartesian_table();
        let by_name = SpanningTree::low_depth(&graph);
        assert_eq!(graph.node_name(by_name.roots()[0]), "B1");
        let tree = SpanningTree::root_at(&graph, 2);
        assert_eq!(graph.node_name(tree.roots()[0]), "B3");
        let order: Vec<_> = tree.order().iter().map(|&n| graph.node_name(n)).collect();
        assert_eq!(order, ["B3", "B1", "B2", "B4", "B5"]);
        for tree in [by_name, tree] {
            assert_eq!(names(&graph, tree.edges()), ["C1", "C3", "C5", "C6"]);
            assert_eq!(names(&graph, tree.chords()), ["C2", "C4", "C7", "C8", "C9"]);
        }
    }

    ///```text
    ///   a ── b ── c        degrees a 2, b 3, c 2, d 3: the root is b (before d, by name),
    ///   │    │    │        then d, which waits with the highest degree, and not a
    ///   └─── d ───┘
    ///```
    #[test]
    fn degree_goes_before_name() {
        let graph = samples::graph(
            "a",
            &[
                ("1", "a", "b"),
                ("2", "b", "c"),
                ("3", "a", "d"),
                ("4", "b", "d"),
                ("5", "c", "d"),
            ],
        );
        let tree = SpanningTree::low_depth(&graph);
        let order: Vec<_> = tree.order().iter().map(|&n| graph.node_name(n)).collect();
        assert_eq!(order, ["b", "d", "a", "c"]);
        assert_eq!(tree.height(), 1);
        assert_eq!(names(&graph, tree.chords()), ["3", "5"]);
    }

    #[test]
    fn a_forest_has_one_root_for_each_component() {
        let graph = samples::graph_with_isolated("z", &[("1", "a", "b"), ("2", "y", "z")], &["m"]);
        let tree = SpanningTree::low_depth(&graph);
        let roots: Vec<_> = tree.roots().iter().map(|&n| graph.node_name(n)).collect();
        assert_eq!(roots, ["y", "a", "m"]);
        assert_eq!(tree.order().len(), 5);
        let at_z = SpanningTree::root_at(&graph, graph.ground());
        assert_eq!(graph.node_name(at_z.roots()[0]), "z");
        assert_eq!(graph.node_name(at_z.roots()[1]), "a");
        assert_eq!(
            tree.lowest_common_ancestor(tree.roots()[0], tree.roots()[1]),
            None
        );
    }

    ///```text
    ///   base ─a─ hip ─b─ knee      the file's tree is the arm and the rod; `c` closes the loop, `d` and `e` hold a
    ///     │        └─ c ──┐        body that no other joint reaches: the one nearer the base is taken
    ///     └───r─── rod ───┘─e─ float,  base ─d─ float
    ///```
    #[test]
    fn loops_close_where_the_file_closes_them() {
        let graph = samples::graph(
            "base",
            &[
                ("a", "base", "hip"),
                ("b", "hip", "knee"),
                ("r", "base", "rod"),
                ("c", "hip", "rod"),
                ("d", "base", "float"),
                ("e", "rod", "float"),
            ],
        );
        let closes = |edge: usize| ["c", "d", "e"].contains(&graph.edge_name(edge));
        let tree = SpanningTree::rooted(&graph, closes);
        assert_eq!(graph.node_name(tree.roots()[0]), "base");
        assert_eq!(names(&graph, tree.chords()), ["c", "e"]);
        assert_eq!(tree.order().len(), 5);
        assert_eq!(tree.order()[0], graph.ground());
        // The shallow tree is another: it starts where most joints are.
        assert_ne!(tree, SpanningTree::low_depth(&graph));
    }

    #[test]
    fn common_ancestors_agree_with_walking_up() {
        let graph = samples::scissor(40, false);
        let tree = SpanningTree::low_depth(&graph);
        let chain = |node: usize| -> Vec<usize> {
            std::iter::once(node)
                .chain(tree.path_to_root(node).map(|step| step.node))
                .collect()
        };
        for a in 0..graph.node_count() {
            let above = chain(a);
            for b in (0..graph.node_count()).step_by(3) {
                let met = chain(b).into_iter().find(|n| above.contains(n));
                assert_eq!(tree.lowest_common_ancestor(a, b), met);
            }
        }
    }

    #[test]
    fn deep_chains_do_not_overflow() {
        let tree = SpanningTree::root_at(&samples::serial_chain(100_000), 0);
        assert_eq!(tree.height(), 99_999);
    }

    #[test]
    fn of_parallel_joints_the_one_with_the_fewest_freedoms_is_the_trees() {
        // Two bodies joined three times: by name `a` would be the tree's.
        let joint = |name: &str, freedom| EdgeSpec {
            name: name.to_owned(),
            ends: [0, 1],
            freedom,
            class: String::new(),
        };
        let bodies = ["block", "corner"].map(|name| NodeSpec {
            name: name.to_owned(),
        });
        let joints = vec![joint("a", 3), joint("b", 5), joint("c", 2)];
        let graph = ConstraintGraph::new(0, bodies.to_vec(), joints, Vec::new());
        let tree = SpanningTree::low_depth(&graph);
        assert_eq!(tree.edges(), [2]);
        assert_eq!(SpanningTree::root_at(&graph, 0).edges(), [0]);
    }
}
