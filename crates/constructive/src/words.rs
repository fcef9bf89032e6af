//! What is known of a sketch as text, data and graph.

use crate::analysis::{LeafKind, Node, STree, s_tree};
use crate::construction::{Construction, NotConstructive, Outcome};
use crate::pebbles::{PebbleGame, Standing};
use crate::sketch::NamedSketch;
use kutzbach_model::graph::{ConstraintGraph, EdgeSpec, NodeSpec};
use serde_json::{Value, json};
use std::fmt::Write;

/// Steps, circuits and parts beyond so many are counted, not listed.
const MOST_LISTED: usize = 40;

/// The analysis of a sketch, ready to be told.
#[derive(Clone, Debug)]
pub struct SketchWords<'a> {
    named: &'a NamedSketch,
    game: PebbleGame,
    tree: STree,
    construction: Result<Construction<'a>, NotConstructive>,
}

impl<'a> SketchWords<'a> {
    /// Plays the pebble game, builds the s-tree and the order of construction.
    #[must_use]
    pub fn of(named: &'a NamedSketch) -> Self {
        Self {
            game: PebbleGame::play(named.sketch.graph()),
            tree: s_tree(named.sketch.graph()),
            construction: Construction::new(&named.sketch),
            named,
        }
    }

    /// The construction, where there is one.
    ///
    /// # Errors
    /// Why there is none.
    pub const fn construction(&self) -> Result<&Construction<'a>, &NotConstructive> {
        self.construction.as_ref()
    }

    fn list(&self, elements: &[usize]) -> String {
        let names: Vec<&str> = elements.iter().map(|&e| &*self.named.names[e]).collect();
        names.join(" ")
    }

    fn standing(&self) -> &'static str {
        match self.game.standing() {
            Standing::Well => "well-constrained",
            Standing::Under => "under-constrained",
            Standing::Over => "over-constrained",
        }
    }

    /// Everything for a person.
    #[must_use]
    pub fn text(&self) -> String {
        let graph = self.named.sketch.graph();
        let mut text = format!(
            "{}: {} elements, {} constraints, {}\n",
            self.named.name,
            graph.vertices(),
            graph.edges().len(),
            self.standing()
        );
        let lines = self.reasons().into_iter().chain(self.told());
        for line in lines {
            let _ = writeln!(text, "{line}");
        }
        text
    }

    /// Why it is over- or under-constrained.
    fn reasons(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for circuit in self.game.circuits().iter().take(MOST_LISTED) {
            let [u, v] = self.named.sketch.graph().edges()[circuit.edge];
            lines.push(format!(
                "too many: {} is fixed already by the constraints among {}",
                self.list(&[u, v]),
                self.list(&circuit.vertices)
            ));
        }
        more(&mut lines, self.game.circuits().len());
        if self.game.freedoms() > 0 {
            let parts = self.game.rigid_parts();
            lines.push(format!("freedoms left: {}", self.game.freedoms()));
            let rigid = parts.iter().take(MOST_LISTED);
            lines.extend(rigid.map(|p| format!("rigid in itself: {}", self.list(p))));
            more(&mut lines, parts.len());
        }
        lines
    }

    /// The construction, or what stands in its way.
    fn told(&self) -> Vec<String> {
        let construction = match &self.construction {
            Ok(construction) => construction,
            Err(NotConstructive::Clusters(_)) => {
                let hard = self.tree.nodes.iter().filter_map(|node| match node {
                    Node::Leaf {
                        kind: LeafKind::Triconnected,
                        vertices,
                        ..
                    } => Some(format!("triconnected: {}", self.list(vertices))),
                    _ => None,
                });
                let first = "not constructed by circles and lines alone".to_owned();
                return [first].into_iter().chain(hard).collect();
            }
            Err(_) => return Vec::new(),
        };
        let count = construction.count();
        let mut lines = vec![
            format!("steps: {}", construction.drawn_left().len()),
            format!("solutions: {count}"),
        ];
        if count.degenerate {
            lines.push(
                "other choices end where nothing fixes an element; they are not counted".to_owned(),
            );
        }
        let outcomes = construction.outcomes(construction.drawn_left());
        for (step, outcome) in outcomes.iter().enumerate().take(MOST_LISTED) {
            lines.push(self.step(construction, step, outcome));
        }
        more(&mut lines, outcomes.len());
        for step in construction.left_open_by_rounding() {
            lines.push(format!(
                "step {}: with other digits after those stated it turns out otherwise",
                step + 1
            ));
        }
        lines
    }

    fn step(&self, construction: &Construction<'_>, step: usize, outcome: &Outcome) -> String {
        let (by, element) = construction.elements_of(step);
        let what = match outcome {
            _ if construction.is_rigid(step) => "one place, on the same body".to_owned(),
            Outcome::Two { .. } if construction.drawn_left()[step] => {
                "two places, drawn on the left".to_owned()
            }
            Outcome::Two { .. } => "two places, drawn on the right".to_owned(),
            Outcome::Touching { proven: true } => "circles touch: a double solution".to_owned(),
            Outcome::Touching { proven: false } => {
                "circles touch to rounding: a double solution".to_owned()
            }
            Outcome::One => "one place".to_owned(),
            Outcome::Apart { by } => format!("circles do not meet, they are {by:.3e} apart"),
            Outcome::Degenerate => {
                "degenerate: what it is placed by coincides or is parallel".to_owned()
            }
        };
        format!(
            "step {}: {} by {}: {what}",
            step + 1,
            self.list(&[element]),
            self.list(&by)
        )
    }

    /// Everything for a program.
    #[must_use]
    pub fn data(&self) -> Value {
        let names = |elements: &[usize]| -> Vec<&str> {
            elements.iter().map(|&e| &*self.named.names[e]).collect()
        };
        let circuits = self.game.circuits().iter().map(|c| {
            let ends = self.named.sketch.graph().edges()[c.edge];
            json!({ "between": names(&ends), "among": names(&c.vertices) })
        });
        let parts: Vec<Vec<&str>> = match self.game.freedoms() {
            0 => Vec::new(),
            _ => self.game.rigid_parts().iter().map(|p| names(p)).collect(),
        };
        let construction = self.construction.as_ref().ok();
        let count = construction.map(Construction::count);
        let steps = construction.map(|c| {
            let outcomes = c.outcomes(c.drawn_left());
            let step = |(i, o): (usize, &Outcome)| {
                let (by, element) = c.elements_of(i);
                json!({ "element": names(&[element])[0], "by": names(&by), "outcome": word(o), "size": size(o),
                    "left": c.drawn_left()[i] })
            };
            outcomes.iter().enumerate().map(step).collect::<Vec<Value>>()
        });
        json!({
            "schema": "kutzbach-sketch-1",
            "name": self.named.name,
            "elements": self.named.names,
            "constraints": self.named.sketch.constraints().len(),
            "standing": self.standing(),
            "freedoms": self.game.freedoms(),
            "too_many": circuits.collect::<Vec<Value>>(),
            "rigid_parts": parts,
            "constructive": self.tree.solved,
            "triconnected": self.tree.leaves(LeafKind::Triconnected),
            "solutions": count.as_ref().map(ToString::to_string),
            "solutions_complete": count.as_ref().map(|c| c.complete),
            "solutions_degenerate": count.as_ref().map(|c| c.degenerate),
            "steps": steps,
        })
    }

    /// The s-tree as a graph whose node 0 is its root, for pictures; edges to sides with a virtual edge say so.
    #[must_use]
    pub fn graph(&self) -> Option<ConstraintGraph> {
        let mut edges = Vec::new();
        let mut nodes = Vec::new();
        for (i, node) in self.tree.nodes.iter().enumerate() {
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

fn more(lines: &mut Vec<String>, count: usize) {
    if count > MOST_LISTED {
        lines.push(format!("and {} more", count - MOST_LISTED));
    }
}

const fn word(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Two { .. } => "two",
        Outcome::Touching { proven: true } => "touching",
        Outcome::Touching { proven: false } => "touching_to_rounding",
        Outcome::One => "one",
        Outcome::Apart { .. } => "apart",
        Outcome::Degenerate => "degenerate",
    }
}

const fn size(outcome: &Outcome) -> Option<f64> {
    match outcome {
        Outcome::Two { by } | Outcome::Apart { by } => Some(*by),
        _ => None,
    }
}
