//! What is known of a sketch as text, data and graph.

mod data;
mod text;
mod tree;

use crate::analysis::{LeafKind, STree, s_tree};
use crate::construction::{Construction, NotConstructive, Outcome};
use crate::counted::Counted;
use crate::named::NamedSketch;
use crate::pebbles::{Circuit, Standing};
use crate::redundancy::{Redundancy, redundancy};
use crate::together::{CoreOutcome, Together, together_within};
use kutzbach_algebra::Limits;
use std::sync::OnceLock;

/// Steps, circuits and parts beyond so many are counted, not listed.
const MOST_LISTED: usize = 40;

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

    fn redundancy(&self, circuit: &Circuit) -> Redundancy {
        let refused: Vec<usize> = self.game.circuits().iter().map(|c| c.edge).collect();
        redundancy(&self.named.sketch, circuit, &refused)
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
}

/// Steps up to the first that is impossible, with it.
fn reached(outcomes: &[Outcome]) -> usize {
    let impossible = outcomes.iter().position(|o| !o.is_possible());
    impossible.map_or(outcomes.len(), |k| k + 1)
}

fn more(lines: &mut Vec<String>, count: usize) {
    if count > MOST_LISTED {
        lines.push(format!("and {} more", count - MOST_LISTED));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
