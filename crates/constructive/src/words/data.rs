//! What is known of a sketch, for a program.

use super::{MOST_LISTED, SketchWords, reached};
use crate::construction::{Construction, Outcome, Shape};
use crate::named::Radius;
use crate::redundancy::Redundancy;
use crate::relation::Relation;
use crate::together::{Core, CoreOutcome, Placed};
use serde_json::{Value, json};

impl SketchWords<'_> {
    /// Everything for a program.
    #[must_use]
    pub fn data(&self) -> Value {
        let names = |elements: &[usize]| -> Vec<&str> {
            elements.iter().map(|&e| &*self.named.names[e]).collect()
        };
        let circuits = self.game.circuits().iter().enumerate().map(|(i, c)| {
            let ends = match self.named.sketch.constraints().get(c.edge) {
                Some(constraint) => constraint.ends.to_vec(),
                None => {
                    let beyond = c.edge - self.named.sketch.constraints().len();
                    self.named.sketch.relations()[beyond].elements()
                }
            };
            // Each is compared with all solutions of the others.
            let judged = match i < MOST_LISTED {
                true => self.redundancy(c),
                false => Redundancy::Unknown,
            };
            let (verdict, nearest) = match judged {
                Redundancy::Agrees => ("agrees", None),
                Redundancy::WithinDigits { nearest } => ("within_digits", Some(nearest)),
                Redundancy::Contradicts { nearest } => ("contradicts", Some(nearest)),
                Redundancy::Unknown => ("unknown", None),
            };
            json!({ "between": names(&ends), "among": names(&c.vertices), "verdict": verdict, "nearest": nearest })
        });
        let parts: Vec<Vec<&str>> = match self.game.freedoms() {
            0 => Vec::new(),
            _ => self.game.rigid_parts().iter().map(|p| names(p)).collect(),
        };
        let construction = self.construction.as_ref().ok();
        let count = construction.map(Construction::count);
        let total = self.together.as_ref().and_then(|t| t.total);
        let steps = construction.map(|c| {
            let sides = self.sides(c);
            let outcomes = c.outcomes(&sides);
            let reached = reached(&outcomes);
            let step = |(i, o): (usize, &Outcome)| {
                let (by, element) = c.elements_of(i);
                let (outcome, size) = match i < reached {
                    true => (word(o), size(o)),
                    false => ("not_reached", None),
                };
                json!({ "element": names(&[element])[0], "by": names(&by), "outcome": outcome, "size": size,
                    "left": sides[i] })
            };
            outcomes.iter().enumerate().map(step).collect::<Vec<Value>>()
        });
        let told = |all: &[Relation]| all.iter().map(|r| self.named.told(r)).collect::<Vec<_>>();
        let (relations, follow) = (
            told(self.named.sketch.relations()),
            told(&self.named.follow),
        );
        let circles = self.named.circles.iter().map(|c| {
            let radius = match &c.radius {
                Radius::Known(number) => Some(number.value()),
                Radius::Unknown(_) => None,
            };
            json!({ "name": c.name, "center": self.named.names[c.centre], "radius": radius })
        });
        let circles: Vec<Value> = circles.collect();
        json!({
            "schema": "kutzbach-sketch-1",
            "name": self.named.name,
            "elements": self.named.names,
            "constraints": self.named.sketch.constraints().len(),
            "relations": relations,
            "follow": follow,
            "circles": circles,
            "standing": self.standing(),
            "freedoms": self.game.freedoms(),
            "too_many": circuits.collect::<Vec<Value>>(),
            "rigid_parts": parts,
            "constructive": self.construction.is_ok(),
            "triconnected": self.triconnected(),
            "solved_at_once": self.together.iter().flat_map(|t| &t.cores).map(|c| self.core_data(c)).collect::<Vec<Value>>(),
            "solutions": count.as_ref().map(ToString::to_string).or_else(|| total.map(|t| t.to_string())),
            "solutions_complete": count.as_ref().map(|c| c.complete).or_else(|| total.map(|t| t.all)),
            "solutions_degenerate": count.as_ref().map(|c| c.degenerate),
            "solutions_infinite": count.as_ref().map(|c| c.infinite),
            "steps": steps,
        })
    }

    fn core_data(&self, core: &Core) -> Value {
        let names: Vec<&str> = core
            .elements
            .iter()
            .map(|&e| &*self.named.names[e])
            .collect();
        let [unknowns, equations, degree] = match core.size {
            Some(size) => size.map(Some),
            None => [None; 3],
        };
        let shape = |s: &Shape| match s {
            Shape::Point(p) => json!(p),
            Shape::Line { direction, offset } => {
                json!({ "direction": direction, "offset": offset })
            }
        };
        let (outcome, complex, places, why) = match &core.outcome {
            CoreOutcome::Solved { complex, places } => ("solved", *complex, Some(places), None),
            CoreOutcome::Found { places, why } => ("found", None, Some(places), Some(why)),
            CoreOutcome::Infinite => ("infinite", None, None, None),
            CoreOutcome::Open(why) => ("open", None, None, Some(why)),
        };
        let places = places.map(|all| {
            let place = |p: &Placed| {
                let shapes: Vec<Value> = p.shapes.iter().map(shape).collect();
                json!({ "at": shapes, "multiplicity": p.multiplicity })
            };
            all.iter().map(place).collect::<Vec<Value>>()
        });
        json!({ "elements": names, "unknowns": unknowns, "equations": equations, "degree": degree, "outcome": outcome,
            "complex": complex, "places": places, "why": why })
    }
}

const fn word(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Two { .. } => "two",
        Outcome::Touching { within: 0.0 } => "touching",
        Outcome::Touching { .. } => "touching_or_nearly",
        Outcome::One => "one",
        Outcome::Apart { .. } => "apart",
        Outcome::Degenerate => "degenerate",
    }
}

const fn size(outcome: &Outcome) -> Option<f64> {
    match outcome {
        Outcome::Two { by } | Outcome::Apart { by } | Outcome::Touching { within: by } => Some(*by),
        _ => None,
    }
}
