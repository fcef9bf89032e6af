//! An incidence tree as text, data and graph.

use super::count;
use crate::collection::{Collection, standard, with_triangles};
use crate::placed::{Placed, Unsuited};
use crate::tree::{IncidenceTree, covering_sets, optimal_incidence_tree};
use kutzbach_model::graph::{ConstraintGraph, EdgeSpec, NodeSpec};
use kutzbach_model::mechanism::Mechanism;
use serde_json::{Value, json};
use std::fmt::Write;

/// The best incidence tree of a mechanism's standard collection, or of the bodies given where it has none.
#[derive(Clone, Debug)]
pub struct IncidenceWords {
    given: usize,
    collection: Collection,
    /// Whether each body is implied, by body.
    implied: Vec<bool>,
    is_standard: bool,
    tree: Option<IncidenceTree>,
    covers: Option<usize>,
}

impl IncidenceWords {
    /// Finds it.
    ///
    /// # Errors
    /// [`Unsuited`] where the mechanism is no collection of bodies that share points.
    pub fn of(mechanism: &Mechanism) -> Result<Self, Unsuited> {
        let given = Placed::of(mechanism)?.collection;
        let standard = standard(&given);
        let is_standard = standard.holds(&given);
        let (collection, implied) = if is_standard {
            let implied = standard.implied();
            let all = 0..standard.origins.len();
            let implied = all.map(|body| implied.contains(&body)).collect();
            (standard.collection, implied)
        } else {
            let collection = with_triangles(&given);
            let implied = (0..collection.bodies().len()).map(|body| body >= given.bodies().len());
            let implied = implied.collect();
            (collection, implied)
        };
        Ok(Self {
            given: given.bodies().len(),
            tree: optimal_incidence_tree(&collection, &[], |_| true),
            covers: covering_sets(&collection).map(|sets| sets.len()),
            collection,
            implied,
            is_standard,
        })
    }

    pub(super) fn collection(&self) -> &Collection {
        &self.collection
    }

    pub(super) fn tree(&self) -> Option<&IncidenceTree> {
        self.tree.as_ref()
    }

    /// How many bodies there are, and where they come from.
    fn heading(&self) -> String {
        let given = bodies(self.given);
        if self.is_standard {
            let all = self.collection.bodies().len();
            return format!(
                "{given} given, {all} as large as they can be in the standard collection"
            );
        }
        let triangles = match self.collection.bodies().len() - self.given {
            0 => String::new(),
            more => format!(", {} implied", count(more, "triangle")),
        };
        format!(
            "{given} given{triangles}; there is no standard collection, since with generic dimensions they would not close: \
             what would be rigid then may move here"
        )
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
        let _ = writeln!(text, "{}", self.heading());
        for (body, implied) in self.collection.bodies().iter().zip(&self.implied) {
            let implied = if *implied { ", implied" } else { "" };
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
        let bodies = self.collection.bodies().iter().zip(&self.implied);
        let bodies: Vec<Value> = bodies
            .map(|(body, implied)| {
                json!({
                    "name": body.name,
                    "points": self.points(&body.points),
                    "implied": implied,
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
        json!({ "bodies": bodies, "standard": self.is_standard, "covering_sets": self.covers, "tree": tree })
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

fn bodies(number: usize) -> String {
    match number {
        1 => "1 body".to_owned(),
        _ => format!("{number} bodies"),
    }
}
