//! What is known of a sketch as text, data and graph.

use crate::analysis::{LeafKind, Node, STree, s_tree};
use crate::construction::{Construction, NotConstructive, Outcome, Shape};
use crate::counted::Counted;
use crate::named::{NamedSketch, Radius};
use crate::pebbles::{Circuit, Standing};
use crate::redundancy::{Redundancy, redundancy};
use crate::relation::Relation;
use crate::sketch::Element;
use crate::together::{Core, CoreOutcome, Placed, Together, together_within};
use crate::tree_picture::tree_svg;
use kutzbach_algebra::Limits;
use kutzbach_model::graph::{ConstraintGraph, EdgeSpec, NodeSpec};
use serde_json::{Value, json};
use std::fmt::Write;
use std::sync::OnceLock;

/// Steps, circuits and parts beyond so many are counted, not listed.
const MOST_LISTED: usize = 40;

/// Why there may be no solution where the count is right.
const NOWHERE: &str = "well-constrained says that the constraints are as many as it takes; their values fit nowhere together";

/// The analysis of a sketch, ready to be told.
#[derive(Clone, Debug)]
pub struct SketchWords<'a> {
    named: &'a NamedSketch,
    game: Counted,
    /// Made when it is asked for: what circles and lines construct is told without it.
    tree: OnceLock<STree>,
    construction: Result<Construction<'a>, NotConstructive>,
    /// Sides that were chosen, by step, in place of those drawn.
    chosen: Option<Vec<bool>>,
    /// Of a well-constrained sketch that is not constructed by circles and lines alone.
    together: Option<Together>,
}

impl<'a> SketchWords<'a> {
    /// Counts, and builds the order of construction; what is not constructed is solved at once.
    #[must_use]
    pub fn of(named: &'a NamedSketch) -> Self {
        Self::within(named, &Limits::default())
    }

    /// The same within limits of what is solved at once.
    #[must_use]
    pub fn within(named: &'a NamedSketch, limits: &Limits) -> Self {
        let construction = Construction::new(&named.sketch);
        let game = match construction {
            Ok(_) => Counted::of_constructed(&named.sketch),
            Err(_) => Counted::of(&named.sketch),
        };
        let hard = matches!(construction, Err(NotConstructive::Clusters(_)));
        let tree = OnceLock::new();
        let mut together = None;
        if hard {
            let tree = tree.get_or_init(|| s_tree(named.sketch.graph()));
            together = Some(together_within(&named.sketch, tree, limits));
        }
        Self {
            game,
            together,
            tree,
            construction,
            named,
            chosen: None,
        }
    }

    /// Chooses one of two places of the step that places an element: `left` or `right` of the way from the first to the second by which it is placed,
    /// `ahead` or `behind` along a line; of a line `left` is the way it points from the first to the second, and `right` the other way.
    ///
    /// # Errors
    /// Where no step places such an element, it has one place only, or the word is another one.
    pub fn choose(&mut self, element: &str, side: &str) -> Result<(), String> {
        let Ok(construction) = &self.construction else {
            return Err(
                "the sketch is not constructed step by step: it has no sides to choose".to_owned(),
            );
        };
        let left = match side {
            "left" | "ahead" => true,
            "right" | "behind" => false,
            _ => {
                return Err(format!(
                    "a side is `left` or `right`, `ahead` or `behind`, not `{side}`"
                ));
            }
        };
        let steps = 0..construction.drawn_left().len();
        let places = |step: &usize| self.named.names[construction.elements_of(*step).1] == element;
        let Some(step) = steps.into_iter().find(places) else {
            return Err(format!("no step places an element `{element}`"));
        };
        let mut sides = self.sides(construction);
        let two = matches!(construction.outcomes(&sides)[step], Outcome::Two { .. });
        if construction.is_rigid(step) || !two {
            return Err(format!("`{element}` has one place only, or none"));
        }
        sides[step] = left;
        self.chosen = Some(sides);
        Ok(())
    }

    /// The sides chosen, as drawn otherwise.
    fn sides(&self, construction: &Construction<'_>) -> Vec<bool> {
        let drawn = || construction.drawn_left().to_vec();
        self.chosen.clone().unwrap_or_else(drawn)
    }

    /// The solution on the chosen sides, element by element; nothing where none were chosen.
    fn places(&self, construction: &Construction<'_>) -> Vec<String> {
        let Some(sides) = &self.chosen else {
            return Vec::new();
        };
        let Ok(solution) = construction.with_sides(sides) else {
            return vec!["no solution on these sides".to_owned()];
        };
        let all = self.named.whole(&solution.shapes);
        // None is written as minus zero.
        let shown = |x: f64| if x.abs() < 5e-7 { 0.0 } else { x };
        let line = |(name, shape): (&String, &Shape)| match shape {
            Shape::Point([x, y]) => format!("{name} at {:.6} {:.6}", shown(*x), shown(*y)),
            Shape::Line {
                direction: [c, s],
                offset,
            } => format!(
                "{name} through {:.6} {:.6} pointing {:.6} {:.6}",
                shown(-s * offset),
                shown(c * offset),
                shown(*c),
                shown(*s)
            ),
        };
        let mut lines: Vec<String> = self.named.names.iter().zip(&all).map(line).collect();
        lines.truncate(MOST_LISTED);
        more(&mut lines, all.len());
        lines
    }

    /// The construction, where there is one.
    ///
    /// # Errors
    /// Why there is none.
    pub const fn construction(&self) -> Result<&Construction<'a>, &NotConstructive> {
        self.construction.as_ref()
    }

    /// Names, as far as they are listed.
    fn list(&self, elements: &[usize]) -> String {
        let listed = elements.iter().take(MOST_LISTED);
        let mut names: Vec<String> = listed.map(|&e| self.named.names[e].clone()).collect();
        more(&mut names, elements.len());
        names.join(" ")
    }

    fn standing(&self) -> &'static str {
        match self.game.standing() {
            _ if !self.game.is_known() => "too large to be counted",
            Standing::Well => "well-constrained",
            Standing::Under => "under-constrained",
            Standing::Over => "over-constrained",
        }
    }

    /// Everything for a person.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = format!(
            "{}: {}, {}\n",
            self.named.name,
            self.named.size(),
            self.standing()
        );
        let follow = self.named.follow.iter().take(MOST_LISTED);
        let follow = follow.map(|r| format!("follows: {}", self.named.told(r)));
        let mut follow: Vec<String> = follow.collect();
        more(&mut follow, self.named.follow.len());
        let lines = self.reasons().into_iter().chain(self.told()).chain(follow);
        for line in lines {
            let _ = writeln!(text, "{line}");
        }
        text
    }

    /// Why it is over- or under-constrained.
    fn reasons(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if !self.game.is_known() {
            return lines;
        }
        for circuit in self.game.circuits().iter().take(MOST_LISTED) {
            let asked = self.named.sketch.constraints().get(circuit.edge);
            let asked = asked.map(|c| c.value.value());
            let judged = match (self.redundancy(circuit), asked) {
                (Redundancy::Agrees, _) => "and agrees with them".to_owned(),
                (Redundancy::WithinDigits { nearest }, Some(asked)) => format!(
                    "and agrees with them within the digits: they leave {nearest:.6}, it asks for {asked:.6}"
                ),
                (Redundancy::WithinDigits { .. }, None) => {
                    "and agrees with them within the digits".to_owned()
                }
                (Redundancy::Contradicts { nearest }, Some(asked)) => format!(
                    "and contradicts them: they leave {nearest:.6} at the nearest, it asks for {asked:.6}"
                ),
                (Redundancy::Contradicts { nearest }, None) => {
                    format!(
                        "and contradicts them: they leave it off by {} at the nearest",
                        short(nearest)
                    )
                }
                (Redundancy::Unknown, _) => "whether it agrees with them is not known".to_owned(),
            };
            lines.push(format!(
                "too many: {} is fixed already by the constraints among {}, {judged}",
                self.named.statement(circuit.edge),
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

    fn redundancy(&self, circuit: &Circuit) -> Redundancy {
        let refused: Vec<usize> = self.game.circuits().iter().map(|c| c.edge).collect();
        redundancy(&self.named.sketch, circuit, &refused)
    }

    /// The construction, or what stands in its way.
    fn told(&self) -> Vec<String> {
        let construction = match &self.construction {
            Ok(construction) => construction,
            Err(NotConstructive::Clusters(_)) => {
                let hard = self.tree().nodes.iter().filter_map(|node| match node {
                    Node::Leaf {
                        kind: LeafKind::Triconnected,
                        vertices,
                        ..
                    } => Some(format!("triconnected: {}", self.list(vertices))),
                    _ => None,
                });
                let mut lines = vec!["not constructed by circles and lines alone".to_owned()];
                if !self.has_tree() {
                    lines.extend(self.solved_together());
                    return lines;
                }
                let all = self.triconnected();
                lines.extend(hard.take(MOST_LISTED));
                more(&mut lines, all);
                lines.extend(self.solved_together());
                return lines;
            }
            Err(_) => return Vec::new(),
        };
        let count = construction.count();
        let mut lines = vec![
            format!("steps: {}", construction.drawn_left().len()),
            format!("solutions: {count}"),
        ];
        if count.degenerate && !count.infinite && count.value() != Some(0) {
            lines.push(
                "other choices end where nothing fixes an element; they are not counted".to_owned(),
            );
        }
        if count.value() == Some(0) && count.complete && !count.infinite && !count.degenerate {
            lines.push(NOWHERE.to_owned());
        }
        if count.between.is_some() {
            lines.push(
                "circles touch or nearly do: doubles do not tell none, one and two places apart"
                    .to_owned(),
            );
        }
        let outcomes = construction.outcomes(&self.sides(construction));
        let reached = reached(&outcomes);
        for (step, outcome) in outcomes.iter().enumerate().take(reached.min(MOST_LISTED)) {
            lines.push(self.step(construction, step, outcome));
        }
        more(&mut lines, reached);
        if reached < outcomes.len() {
            lines.push(format!(
                "not reached on the sides {}: {} after it",
                if self.chosen.is_some() {
                    "chosen"
                } else {
                    "drawn"
                },
                plural(outcomes.len() - reached, "step")
            ));
        }
        lines.extend(self.places(construction));
        let open = construction.left_open_by_rounding();
        lines.extend(open.iter().take(MOST_LISTED).map(|step| {
            format!(
                "step {}: with other digits after those stated it turns out otherwise",
                step + 1
            )
        }));
        more(&mut lines, open.len());
        lines
    }

    /// What was solved at once, and what it makes in all.
    fn solved_together(&self) -> Vec<String> {
        let Some(together) = &self.together else {
            return Vec::new();
        };
        if together.cores.is_empty() {
            return vec!["solutions: not known, no part of it can be solved by itself".to_owned()];
        }
        let mut lines: Vec<String> = together.cores.iter().map(|c| self.core(c)).collect();
        lines.push(match together.total {
            Some(total) => format!("solutions: {total}"),
            None => "solutions: not known".to_owned(),
        });
        if together.total.is_some_and(|t| t.all && t.least == 0) {
            lines.push(NOWHERE.to_owned());
        }
        lines
    }

    fn core(&self, core: &Core) -> String {
        let size = core
            .size
            .filter(|[unknowns, ..]| *unknowns > 0)
            .map_or_else(String::new, |[unknowns, equations, degree]| {
                format!(
                    ", {} in {} of degree {degree} at most",
                    plural(equations, "equation"),
                    plural(unknowns, "unknown")
                )
            });
        let came = match &core.outcome {
            CoreOutcome::Solved { complex, places } => {
                let double = places.iter().filter(|p| p.multiplicity > 1).count();
                let double = match double {
                    0 => String::new(),
                    some => format!(", {some} of them multiple"),
                };
                let complex =
                    complex.map_or_else(String::new, |c| format!(", {c} over the complex numbers"));
                format!(
                    "{}{double}, and no other, by exact algebra{complex}",
                    plural(places.len(), "place")
                )
            }
            CoreOutcome::Found { places, why } => format!(
                "{} found by Newton's method from the drawing and around it, each proven; whether there are others is not decided: {why}",
                plural(places.len(), "place")
            ),
            CoreOutcome::Infinite => "infinitely many places: it moves".to_owned(),
            CoreOutcome::Open(why) => format!("not decided: {why}"),
        };
        format!(
            "solved at once: {}{size}: {came}",
            self.list(&core.elements)
        )
    }

    fn step(&self, construction: &Construction<'_>, step: usize, outcome: &Outcome) -> String {
        let (by, element) = construction.elements_of(step);
        let what = match outcome {
            _ if construction.is_rigid(step) => "one place, on the same body".to_owned(),
            Outcome::Two { .. } if construction.is_senseless(step) => {
                "one place, whichever way the line points".to_owned()
            }
            Outcome::Two { .. } => {
                let [drawn, taken] = [construction.drawn_left(), &self.sides(construction)]
                    .map(|sides| self.side(by, element, sides[step]));
                match drawn == taken {
                    true => format!("two places, drawn {drawn}"),
                    false => format!("two places, drawn {drawn}, chosen {taken}"),
                }
            }
            Outcome::Touching { within: 0.0 } => format!("{} touch: a double solution", self.tools(by, element)),
            Outcome::Touching { within } => format!(
                "{} touch or nearly do, within {within:.1e}: none, one or two places",
                self.tools(by, element)
            ),
            Outcome::One => "one place".to_owned(),
            Outcome::Apart { by: off } => {
                format!("{} do not meet, they are {} apart", self.tools(by, element), short(*off))
            }
            Outcome::Degenerate => {
                "degenerate: what it is placed by coincides or is parallel, and 1 degree of freedom is left"
                    .to_owned()
            }
        };
        format!(
            "step {}: {} by {}: {what}",
            step + 1,
            self.list(&[element]),
            self.list(&by)
        )
    }

    fn is_line(&self, element: usize) -> bool {
        matches!(self.named.sketch.elements()[element], Element::Line { .. })
    }

    /// What a step intersects.
    fn tools(&self, by: [usize; 2], element: usize) -> &'static str {
        let lines = by.iter().filter(|&&e| self.is_line(e)).count();
        match (self.is_line(element), lines) {
            (false, 0) => "circles",
            (false, 1) => "circle and line",
            (false, _) => "lines",
            (true, 0) => "distances of the line",
            (true, _) => "directions",
        }
    }

    /// Which of two places is drawn, as [`crate::construction`] tells them apart.
    fn side(&self, by: [usize; 2], element: usize, left: bool) -> String {
        let [p, q] = by.map(|e| &self.named.names[e]);
        match (self.is_line(element), self.tools(by, element), left) {
            (true, _, true) => format!("pointing from {p} to {q}"),
            (true, _, false) => format!("pointing from {q} to {p}"),
            (false, "circle and line", true) => "ahead along the line".to_owned(),
            (false, "circle and line", false) => "behind along the line".to_owned(),
            (false, _, true) => "on the left".to_owned(),
            (false, _, false) => "on the right".to_owned(),
        }
    }

    /// Whether what is solved at once was stopped by its limits.
    #[must_use]
    pub fn stopped(&self) -> bool {
        let cores = self.together.iter().flat_map(|t| &t.cores);
        let mut open = cores.map(|c| &c.outcome);
        open.any(|o| matches!(o, CoreOutcome::Found { .. } | CoreOutcome::Open(_)))
    }

    fn tree(&self) -> &STree {
        let graph = self.named.sketch.graph();
        self.tree.get_or_init(|| s_tree(graph))
    }

    /// How many parts no circles and lines construct: none of what is constructed.
    fn triconnected(&self) -> usize {
        match self.construction {
            Ok(_) => 0,
            Err(_) => self.tree().leaves(LeafKind::Triconnected),
        }
    }

    /// Whether the s-tree says something: constraints of more than two elements are not in it.
    #[must_use]
    pub fn has_tree(&self) -> bool {
        self.named.sketch.relations().is_empty()
    }

    /// The s-tree as SVG.
    #[must_use]
    pub fn tree_svg(&self) -> String {
        tree_svg(self.tree(), |node| match node {
            Node::Split { pair, .. } => format!("split at {}", self.list(pair)),
            Node::Leaf { vertices, .. } => self.list(vertices),
        })
    }

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

/// Steps up to the first that is impossible, with it.
fn reached(outcomes: &[Outcome]) -> usize {
    let impossible = outcomes.iter().position(|o| !o.is_possible());
    impossible.map_or(outcomes.len(), |k| k + 1)
}

/// A length or an angle above zero in four digits, without an exponent where a person would write none.
fn short(size: f64) -> String {
    if !(1e-4..1e6).contains(&size) {
        return format!("{size:.3e}");
    }
    let decimals = (3 - size.log10().floor() as i32).max(0) as usize;
    let text = format!("{size:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// `1 step`, `2 steps`.
fn plural(count: usize, word: &str) -> String {
    format!("{count} {word}{}", if count == 1 { "" } else { "s" })
}

fn more(lines: &mut Vec<String>, count: usize) {
    if count > MOST_LISTED {
        lines.push(format!("and {} more", count - MOST_LISTED));
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::sketch::{Constraint, Sketch};
    use kutzbach_math::number::Number;

    fn said(elements: Vec<Element>, constraints: &[(usize, usize, &str)]) -> String {
        let constraint = |&(u, v, value): &(usize, usize, &str)| Constraint {
            ends: [u, v],
            value: Number::decimal(value)
                .unwrap_or_else(|_| Number::expression(value, &mut |_: &str| Ok(None)).unwrap()),
        };
        let names = (0..elements.len()).map(|k| format!("e{k}")).collect();
        let constraints = constraints.iter().map(constraint).collect();
        let sketch = Sketch::new(elements, constraints).unwrap();
        let named = NamedSketch::new("x".to_owned(), names, sketch);
        SketchWords::of(&named).text()
    }

    fn points(places: &[[f64; 2]]) -> Vec<Element> {
        places.iter().map(|&p| Element::Point(p)).collect()
    }

    #[test]
    fn a_constraint_too_many_agrees_or_contradicts() {
        let square = points(&[[0.0; 2], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let with = |last| {
            let sides = [
                (0, 1, "1"),
                (1, 2, "1"),
                (2, 3, "1"),
                (3, 0, "1"),
                (0, 2, "sqrt(2)"),
                (1, 3, last),
            ];
            said(square.clone(), &sides)
        };
        assert!(
            with("sqrt(2)").contains("among e0 e1 e2 e3, and agrees with them"),
            "{}",
            with("sqrt(2)")
        );
        let text = with("1.4142");
        let told =
            "and agrees with them within the digits: they leave 1.414214, it asks for 1.414200";
        assert!(text.contains(told), "{text}");
        let text = with("2");
        assert!(
            text.contains(
                "and contradicts them: they leave 1.414214 at the nearest, it asks for 2.000000"
            ),
            "{text}"
        );
    }

    #[test]
    fn sides_along_lines_are_ahead_and_behind() {
        let line = Element::Line {
            through: [0.0; 2],
            direction: [1.0, 0.0],
        };
        let at = |x: f64| vec![line, Element::Point([0.0; 2]), Element::Point([x, 2.0])];
        let constraints = [(0, 1, "0"), (0, 2, "2"), (1, 2, "4")];
        assert!(said(at(3.0), &constraints).contains("two places, drawn ahead along the line"));
        assert!(said(at(-3.0), &constraints).contains("two places, drawn behind along the line"));
        let tangent = |direction| {
            let line = Element::Line {
                through: [0.0, 1.0],
                direction,
            };
            let elements = vec![Element::Point([0.0; 2]), Element::Point([4.0, 0.0]), line];
            said(elements, &[(0, 1, "4"), (0, 2, "-1"), (1, 2, "1/2")])
        };
        let [one, other] = [[3.0, 1.0], [-3.0, -1.0]].map(tangent);
        let pointing = |text: &str| {
            let (_, rest) = text.split_once("drawn pointing ").unwrap();
            rest.trim().to_owned()
        };
        assert_ne!(pointing(&one), pointing(&other));
    }

    #[test]
    fn nothing_is_said_of_steps_that_are_not_reached() {
        let places = points(&[[0.0; 2], [1.0, 0.0], [0.5, 1.0], [1.5, 1.0]]);
        let bars = [
            (0, 1, "1"),
            (0, 2, "1"),
            (1, 2, "5"),
            (1, 3, "1"),
            (2, 3, "1"),
        ];
        let text = said(places, &bars);
        assert!(
            text.contains("circles do not meet, they are 3 apart"),
            "{text}"
        );
        assert!(
            text.contains("solutions: 0\nwell-constrained says that"),
            "{text}"
        );
        assert!(
            text.contains("not reached on the sides drawn: 1 step after it"),
            "{text}"
        );
        assert!(!text.contains("step 2:"), "{text}");
        assert_eq!(
            [short(0.000_123), short(12.5), short(123_456.7), short(2e-9)],
            ["0.000123", "12.5", "123457", "2.000e-9"]
        );
        // Whole numbers are as they are: other digits are no question.
        assert!(!text.contains("other digits"), "{text}");
    }
}
