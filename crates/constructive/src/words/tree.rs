//! The s-tree of a sketch, as a picture and as a graph.

use super::SketchWords;
use crate::analysis::Node;
use crate::tree_picture::tree_svg;
use kutzbach_model::graph::{ConstraintGraph, EdgeSpec, NodeSpec};

impl SketchWords<'_> {
    /// The s-tree as SVG.
    #[must_use]
    pub fn tree_svg(&self) -> String {
        tree_svg(self.tree(), |node| match node {
            Node::Split { pair, .. } => format!("split at {}", self.list(pair)),
            Node::Leaf { vertices, .. } => self.list(vertices),
        })
    }

    /// The s-tree as a graph whose node 0 is its root, for pictures; edges to sides with a virtual edge say so.
    #[must_use]
    pub fn graph(&self) -> Option<ConstraintGraph> {
        let mut edges = Vec::new();
        let mut nodes = Vec::new();
        for (i, node) in self.tree().nodes.iter().enumerate() {
            let name = match node {
                Node::Split { pair, .. } => format!("{i}: split at {}", self.list(pair)),
                Node::Leaf { vertices, .. } => format!("{i}: {}", self.list(vertices)),
            };
            nodes.push(NodeSpec { name });
            let Node::Split {
                sides, virtual_in, ..
            } = node
            else {
                continue;
            };
            for (k, &side) in sides.iter().enumerate() {
                let with = if k == *virtual_in { "with" } else { "without" };
                edges.push(EdgeSpec {
                    name: format!("{side}: {with}"),
                    ends: [i, side],
                    freedom: 1,
                    class: format!("{with} a virtual edge"),
                });
            }
        }
        ConstraintGraph::try_new(0, nodes, edges, Vec::new()).ok()
    }
}
