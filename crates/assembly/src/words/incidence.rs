//! An incidence tree as text, data and graph.

use super::count;
use crate::collection::{Collection, RigidPart, rigid_parts, standard, with_triangles};
use crate::placed::{Placed, Unsuited};
use crate::tree::{Cover, IncidenceTree, covering_sets, optimal_incidence_tree, tree_along};
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
    /// The bodies given that become one before.
    parts: Vec<RigidPart>,
    names: Vec<String>,
    tree: Option<IncidenceTree>,
    /// Weight of the best tree, where another was asked for.
    instead_of: Option<usize>,
    covers: Option<Vec<Cover>>,
}

/// Covering sets of one weight that are written out.
const MOST_LISTED: usize = 20;

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
            parts: rigid_parts(&given),
            names: given.bodies().iter().map(|b| b.name.clone()).collect(),
            instead_of: None,
            tree: optimal_incidence_tree(&collection, &[], |_| true),
            covers: covering_sets(&collection),
            collection,
            implied,
            is_standard,
        })
    }

    /// The lightest tree of this covering set in place of the best of all.
    ///
    /// # Errors
    /// A sentence, where there is no such body or no such tree.
    pub fn on_cover(mut self, names: &[String]) -> Result<Self, String> {
        let cover: Vec<usize> = names
            .iter()
            .map(|name| self.body(name))
            .collect::<Result<_, _>>()?;
        let tree = optimal_incidence_tree(&self.collection, &cover, |b| cover.contains(&b));
        let tree = tree.ok_or("these bodies do not have all points")?;
        self.instead_of = self.tree.map(|best| best.weight);
        self.tree = Some(tree);
        Ok(self)
    }

    /// The tree of these pairs `child=parent` in place of the best of all.
    ///
    /// # Errors
    /// A sentence, where there is no such body or these are no tree.
    pub fn along(mut self, pairs: &[String]) -> Result<Self, String> {
        let bodies = |pair: &String| {
            let mut cuts = pair.match_indices('=').map(|(at, _)| at);
            let both = |at: usize| {
                Some([
                    self.body(&pair[..at]).ok()?,
                    self.body(&pair[at + 1..]).ok()?,
                ])
            };
            let found = cuts.find_map(both);
            found.ok_or_else(|| {
                format!("`{pair}` is not of the form CHILD=PARENT with two bodies of the list")
            })
        };
        let pairs: Vec<[usize; 2]> = pairs.iter().map(bodies).collect::<Result<_, _>>()?;
        let tree = tree_along(&self.collection, &pairs).map_err(|why| why.to_string())?;
        self.instead_of = self.tree.map(|best| best.weight);
        self.tree = Some(tree);
        Ok(self)
    }

    fn body(&self, name: &str) -> Result<usize, String> {
        let found = self.collection.bodies().iter().position(|b| b.name == name);
        found.ok_or_else(|| format!("there is no body `{name}` in the list"))
    }

    /// The covering sets by weight, and those of the least one by one.
    #[must_use]
    pub fn covers_text(&self) -> String {
        let Some(covers) = &self.covers else {
            return "\nThe covering sets are too many to be listed.\n".to_owned();
        };
        let mut by_weight: std::collections::BTreeMap<usize, Vec<&Cover>> =
            std::collections::BTreeMap::new();
        for cover in covers {
            by_weight.entry(cover.weight).or_default().push(cover);
        }
        let mut text = format!("\n{}\n", count(covers.len(), "covering set"));
        for (weight, sets) in by_weight {
            let _ = writeln!(text, "  weight {weight}: {}", sets.len());
            for set in sets.iter().take(MOST_LISTED) {
                let names: Vec<&str> = set.bodies.iter().map(|&b| self.name(b)).collect();
                let _ = writeln!(text, "    {}", names.join(", "));
            }
            if sets.len() > MOST_LISTED {
                let _ = writeln!(text, "    and {} more", sets.len() - MOST_LISTED);
            }
        }
        text
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
        for part in &self.parts {
            let names: Vec<&str> = part
                .bodies
                .iter()
                .map(|&b| self.names[b].as_str())
                .collect();
            let _ = writeln!(
                text,
                "  put together first, into {}: {}",
                part.name,
                names.join(", ")
            );
        }
        let Some(tree) = &self.tree else {
            text.push_str("\nThere is no incidence tree.\n");
            return text;
        };
        let _ = writeln!(
            text,
            "\nIncidence tree of weight {} ({}), sum of depths {}",
            tree.weight,
            self.compared(tree),
            tree.depth_sum
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

    /// How a tree's weight compares with that of others.
    fn compared(&self, tree: &IncidenceTree) -> String {
        let covers = self.covers.as_ref().map_or(String::new(), |sets| {
            format!(" of {}", count(sets.len(), "covering set"))
        });
        let best = match (tree.exact || self.instead_of.is_some(), &covers) {
            (true, covers) if !covers.is_empty() => "the least",
            _ => "not known to be the least",
        };
        match self.instead_of {
            Some(weight) => format!("as asked for; {weight} is {best}{covers}"),
            None => format!("{best}{covers}"),
        }
    }

    /// Everything, for a program; with all covering sets where these are asked for.
    #[must_use]
    pub fn data_with_covers(&self) -> Value {
        let sets = self.covers.iter().flatten();
        let sets: Vec<Value> = sets
            .map(|set| {
                let names: Vec<&str> = set.bodies.iter().map(|&b| self.name(b)).collect();
                json!({"bodies": names, "weight": set.weight})
            })
            .collect();
        let mut data = self.data();
        data["covers"] = json!(sets);
        data
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
        let parts: Vec<Value> = self
            .parts
            .iter()
            .map(|part| {
                let names: Vec<&str> = part
                    .bodies
                    .iter()
                    .map(|&b| self.names[b].as_str())
                    .collect();
                json!({"name": part.name, "bodies": names})
            })
            .collect();
        json!({ "bodies": bodies, "standard": self.is_standard, "parts": parts, "covering_sets": self.covers.as_ref().map(Vec::len), "tree": tree })
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
