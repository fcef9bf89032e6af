//! What is known of a sketch, for a person.

use super::{MOST_LISTED, SketchWords, more, reached};
use crate::analysis::{LeafKind, Node};
use crate::construction::{Construction, NotConstructive, Outcome, Shape};
use crate::redundancy::Redundancy;
use crate::sketch::Element;
use crate::together::{Core, CoreOutcome};
use std::fmt::Write;

/// Why there may be no solution where the count is right.
const NOWHERE: &str = "well-constrained says that the constraints are as many as it takes; their values fit nowhere together";

impl SketchWords<'_> {
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
}

/// A length or an angle above zero in four digits, without an exponent where a person would write none.
pub(super) fn short(size: f64) -> String {
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
