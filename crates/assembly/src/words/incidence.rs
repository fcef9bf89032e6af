//! An incidence tree as text, data and graph.

use super::count;
use crate::collection::{Collection, Origin, Standard, standard};
use crate::placed::{Placed, Unsuited};
use crate::tree::{IncidenceTree, covering_sets, optimal_incidence_tree};
use kutzbach_model::graph::{ConstraintGraph, EdgeSpec, NodeSpec};
use kutzbach_model::mechanism::Mechanism;
use serde_json::{Value, json};
use std::fmt::Write;

/// The best incidence tree of a mechanism's standard collection.
#[derive(Clone, Debug)]
pub struct IncidenceWords {
    given: usize,
    standard: Standard,
    tree: Option<IncidenceTree>,
    covers: Option<usize>,
}

impl IncidenceWords {
    /// Finds it.
    ///
    /// # Errors
    /// [`Unsuited`] where the mechanism is no collection of bodies that share points.
    pub fn of(mechanism: &Mechanism) -> Result<Self, Unsuited> {
        let placed = Placed::of(mechanism)?;
        let standard = standard(&placed.collection);
        Ok(Self {
            given: placed.collection.bodies().len(),
            tree: optimal_incidence_tree(&standard.collection, &[], |_| true),
            covers: covering_sets(&standard.collection).map(|sets| sets.len()),
            standard,
        })
    }

    fn collection(&self) -> &Collection {
        &self.standard.collection
    }

    fn name(&self, body: usize) -> &str {
        &self.collection().bodies()[body].name
    }

    fn points(&self, points: &[usize]) -> Vec<&str> {
        points
            .iter()
            .map(|&p| self.collection().points()[p].as_str())
            .collect()
    }

    /// Lines for a person.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        let bodies = self.collection().bodies();
        let _ = writeln!(
            text,
            "{} given, {} as large as they can be in the standard collection",
            count(self.given, "body").replace("bodys", "bodies"),
            bodies.len()
        );
        for (body, origin) in bodies.iter().zip(&self.standard.origins) {
            let implied = if matches!(origin, Origin::Implied(_)) {
                ", implied"
            } else {
                ""
            };
            let _ = writeln!(
                text,
                "  {}: {}{implied}",
                body.name,
                self.points(&body.points).join(", ")
            );
        }
        let Some(tree) = &self.tree else {
            text.push_str("\nThere is no incidence tree.\n");
            return text;
        };
        let covers = self.covers.map_or(String::new(), |n| {
            format!(" of {}", count(n, "covering set"))
        });
        let best = if tree.exact {
            "the least"
        } else {
            "not known to be the least"
        };
        let _ = writeln!(
            text,
            "\nIncidence tree of weight {} ({best}{covers}), sum of depths {}",
            tree.weight, tree.depth_sum
        );
        let cover: Vec<&str> = tree.cover.iter().map(|&b| self.name(b)).collect();
        let _ = writeln!(text, "  covering set: {}", cover.join(", "));
        let _ = writeln!(text, "  root: {}", self.name(tree.root));
        for edge in &tree.edges {
            let _ = writeln!(
                text,
                "  {} placed by {}: {} left, sharing {}",
                self.name(edge.child),
                self.name(edge.parent),
                count(edge.weight, "unknown"),
                self.points(&edge.shared).join(", ")
            );
        }
        text
    }

    /// Everything, for a program.
    #[must_use]
    pub fn data(&self) -> Value {
        let bodies = self
            .collection()
            .bodies()
            .iter()
            .zip(&self.standard.origins);
        let bodies: Vec<Value> = bodies
            .map(|(body, origin)| {
                json!({
                    "name": body.name,
                    "points": self.points(&body.points),
                    "implied": matches!(origin, Origin::Implied(_)),
                })
            })
            .collect();
        let tree = self.tree.as_ref().map(|tree| {
            let edges: Vec<Value> = tree
                .edges
                .iter()
                .map(|e| {
                    json!({
                        "parent": self.name(e.parent),
                        "child": self.name(e.child),
                        "shared": self.points(&e.shared),
                        "weight": e.weight,
                    })
                })
                .collect();
            json!({
                "weight": tree.weight,
                "depth_sum": tree.depth_sum,
                "exact": tree.exact,
                "cover": tree.cover.iter().map(|&b| self.name(b)).collect::<Vec<_>>(),
                "root": self.name(tree.root),
                "edges": edges,
            })
        });
        json!({ "bodies": bodies, "covering_sets": self.covers, "tree": tree })
    }

    /// The bodies of the covering set and the edges of the tree, for pictures; `None` where there is no tree.
    #[must_use]
    pub fn graph(&self) -> Option<ConstraintGraph> {
        let tree = self.tree.as_ref()?;
        let place = |body: usize| tree.cover.iter().position(|&b| b == body).unwrap_or(0);
        let nodes = tree.cover.iter().map(|&b| NodeSpec {
            name: self.name(b).to_owned(),
        });
        let edges = tree.edges.iter().map(|edge| EdgeSpec {
            name: format!("{}: {}", edge.weight, self.points(&edge.shared).join(", ")),
            ends: [place(edge.parent), place(edge.child)],
            freedom: edge.weight,
            class: format!("weight {}", edge.weight),
        });
        ConstraintGraph::try_new(
            place(tree.root),
            nodes.collect(),
            edges.collect(),
            Vec::new(),
        )
        .ok()
    }

    /// The node of the root in that graph.
    #[must_use]
    pub fn root(&self) -> usize {
        self.tree.as_ref().map_or(0, |tree| {
            tree.cover.iter().position(|&b| b == tree.root).unwrap_or(0)
        })
    }
}
