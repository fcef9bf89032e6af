//! A well-formed selection as text, data and graph.

use super::{IncidenceWords, count};
use crate::placed::Unsuited;
use crate::seams::{Copied, Seam, SeamGraph, Selection, well_formed};
use kutzbach_model::graph::{ConstraintGraph, EdgeSpec, NodeSpec};
use kutzbach_model::mechanism::Mechanism;
use serde_json::{Value, json};
use std::fmt::Write;

/// The seam graph of the bodies of a mechanism's incidence tree, and the equations selected in it.
#[derive(Clone, Debug)]
pub struct SeamWords {
    incidence: IncidenceWords,
    /// `None` where there is no incidence tree.
    found: Option<(SeamGraph, Selection)>,
}

impl SeamWords {
    /// Finds them.
    ///
    /// # Errors
    /// [`Unsuited`] where the mechanism is no collection of bodies that share points.
    pub fn of(mechanism: &Mechanism) -> Result<Self, Unsuited> {
        let incidence = IncidenceWords::of(mechanism)?;
        let found = incidence.tree().map(|tree| {
            let collection = incidence.collection();
            let graph = SeamGraph::of(collection, &tree.cover);
            (graph, well_formed(collection, tree))
        });
        Ok(Self { incidence, found })
    }

    fn point(&self, point: usize) -> &str {
        &self.incidence.collection().points()[point]
    }

    fn body(&self, body: usize) -> &str {
        &self.incidence.collection().bodies()[body].name
    }

    /// Lines for a person.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = self.incidence.text();
        let Some((graph, selected)) = &self.found else {
            return text;
        };
        let mut points: Vec<usize> = graph.copies.iter().map(|c| c.0).collect();
        points.dedup();
        let _ = writeln!(
            text,
            "\nSeam graph: {} of {}, {} that bodies share",
            match graph.copies.len() {
                1 => "1 copy".to_owned(),
                many => format!("{many} copies"),
            },
            count(points.len(), "point"),
            count(graph.pairs.len(), "pair")
        );
        let equations = selected.equations();
        let rigid = 6 * (graph.bodies.len() as i64 - 1);
        let agrees = match equations as i64 == selected.removed {
            true => "as many".to_owned(),
            false => format!("{}", selected.removed),
        };
        let _ = writeln!(
            text,
            "Well-formed selection: {}, {agrees} as sharing points removes degrees of freedom; {rigid} make the bodies rigid, bars \
             included",
            count(equations, "equation")
        );
        for seam in &selected.seams {
            let [one, other] = seam.bodies.map(|b| self.body(b));
            let tree = if seam.of_tree { ", of the tree" } else { "" };
            let _ = writeln!(
                text,
                "  {}: {one} – {other}, {} of 3 equations{tree}",
                self.point(seam.point),
                seam.equations
            );
        }
        text
    }

    /// Everything, for a program.
    #[must_use]
    pub fn data(&self) -> Value {
        let mut data = self.incidence.data();
        let seams = self.found.as_ref().map(|(graph, selected)| {
            let seam = |s: &Seam| {
                json!({ "point": self.point(s.point), "bodies": s.bodies.map(|b| self.body(b)),
                    "equations": s.equations, "of_tree": s.of_tree })
            };
            let pairs = graph.pairs.iter().map(|(pair, bodies)| {
                let bodies: Vec<&str> = bodies.iter().map(|&b| self.body(b)).collect();
                json!({ "points": pair.map(|p| self.point(p)), "bodies": bodies })
            });
            json!({ "copies": graph.copies.len(), "pairs": pairs.collect::<Vec<Value>>(), "removed": selected.removed,
                "equations": selected.equations(), "selected": selected.seams.iter().map(seam).collect::<Vec<Value>>() })
        });
        if let Value::Object(fields) = &mut data {
            fields.insert("seams".to_owned(), seams.unwrap_or(Value::Null));
        }
        data
    }

    /// Copies of points, joined by the line seam edges and the point seam edges selected, for pictures; `None` where no points are
    /// shared.
    #[must_use]
    pub fn graph(&self) -> Option<ConstraintGraph> {
        let (graph, selected) = self.found.as_ref()?;
        let name = |&(point, body): &Copied| NodeSpec {
            name: format!("{} in {}", self.point(point), self.body(body)),
        };
        let place = |copy: Copied| graph.copies.iter().position(|c| *c == copy);
        let lines = graph.line_edges().filter_map(|[a, b]| {
            Some(EdgeSpec {
                name: format!(
                    "{}, {} in {}",
                    self.point(a.0),
                    self.point(b.0),
                    self.body(a.1)
                ),
                ends: [place(a)?, place(b)?],
                freedom: 0,
                class: "line seam edge".to_owned(),
            })
        });
        let points = selected.seams.iter().filter_map(|seam| {
            let [one, other] = seam.bodies;
            Some(EdgeSpec {
                name: format!(
                    "{}: {} and {}, {}",
                    self.point(seam.point),
                    self.body(one),
                    self.body(other),
                    count(seam.equations, "equation")
                ),
                ends: [place((seam.point, one))?, place((seam.point, other))?],
                freedom: seam.equations,
                class: format!("{} equations", seam.equations),
            })
        });
        let edges = lines.chain(points).collect();
        ConstraintGraph::try_new(
            0,
            graph.copies.iter().map(name).collect(),
            edges,
            Vec::new(),
        )
        .ok()
    }
}
