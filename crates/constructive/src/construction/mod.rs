//! Construction: every solution of a sketch by two circles, a circle and a line, or two lines, step by step.
//!
//! # The problem
//! Reduction gives the order. A merge of three clusters places one element by its measures from two that are placed already:
//! at most two places, told apart by a side. So k steps have up to 2ᵏ solutions: they are never listed unless asked for.
//!
//! # What is counted, and how
//! Whether circles meet hangs on earlier choices only through measures that are no constraints themselves. Steps fall into
//! classes that hang together; the solutions are a product over the classes, and only within a class choices are tried, up to a
//! stated number. A step that is impossible spoils the lengths of its cluster: what stands on it is tried again with choices that
//! are possible. Solutions that differ by a motion of the plane are one, mirror images are two.
//!
//! # Signs
//! The side is that of the third element, seen from the first to the second of the two that are placed: left or right of the way
//! between two points; ahead or behind along a line; for a line by two points, on which side its own left lies. The drawing
//! has a side for every step, and the first solution takes it wherever it leads to one.
//!
//! # The drawing
//! Where intersections lose the sides drawn to rounding, the drawing itself is looked at, and corrected by Newton's method where it is a
//! little off: a drawing that has all values is a solution, however long the chain.
//!
//! # Cost
//! An element moves with the smaller clusters only: V log V in all, and V in a chain.

mod classes;
mod correction;
mod count;
mod depend;
mod derived;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod drawing_tests;
mod exact;
mod frame;
mod plan;
mod shape;
mod solutions;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
mod third;

pub use count::Count;
pub(crate) use frame::as_drawn as laid_on;
pub(crate) use shape::Motion;
pub use shape::Shape;
pub use solutions::Solutions;
pub use third::Outcome;
pub(crate) use third::drawn_side;

use crate::analysis::{Reduction, reduce};
use crate::counted::Counted;
use crate::pebbles::Circuit;
use crate::sketch::Sketch;
use plan::Plan;
use std::sync::OnceLock;
use thiserror::Error;

/// Why a sketch is not constructed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NotConstructive {
    /// Some constraints follow from others, or contradict them.
    #[error("{} constraints too many: constraint {} follows from those before it among {} elements",
        .0.len(), .0[0].edge, .0[0].vertices.len())]
    Over(Vec<Circuit>),
    /// Freedoms are left.
    #[error("{freedoms} freedoms are left between {} rigid parts", parts.len())]
    Under {
        /// How many.
        freedoms: usize,
        /// The largest rigid parts.
        parts: Vec<Vec<usize>>,
    },
    /// Well-constrained, but not by ruler and compass: clusters that no three of which share three elements.
    #[error("not by ruler and compass: {} clusters are left that do not merge", .0.len())]
    Clusters(Vec<Vec<usize>>),
}

/// A step that cannot be done.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("step {step} cannot be done: {outcome:?}")]
pub struct Impossible {
    /// The step: an index of [`Reduction::merges`].
    pub step: usize,
    /// Why.
    pub outcome: Outcome,
}

/// Where everything is.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// By element; turned and shifted as a whole to the drawing.
    pub shapes: Vec<Shape>,
    /// Whether a step takes the left one of two places.
    pub left: Vec<bool>,
}

/// A sketch that ruler and compass construct.
#[derive(Clone, Debug)]
pub struct Construction<'a> {
    sketch: &'a Sketch,
    reduction: Reduction,
    plan: Plan,
    frames: Vec<Vec<Shape>>,
    drawn: Vec<Shape>,
    drawn_left: Vec<bool>,
    /// Whether a step places what a rigid body has: on the side drawn only.
    rigid: Vec<bool>,
    /// Whether its two places are one figure, with lines the other way round: on the side drawn only.
    senseless: Vec<bool>,
    /// Places beside those drawn that have all values; sought once, where intersections lose them.
    corrected: OnceLock<Option<Vec<Shape>>>,
}

impl<'a> Construction<'a> {
    /// The order of construction.
    ///
    /// # Errors
    /// Where the sketch is over- or under-constrained, does not reduce to one cluster, or has relations; with the reason.
    pub fn new(sketch: &'a Sketch) -> Result<Self, NotConstructive> {
        let reduction = reduce(sketch.graph());
        if !reduction.solved || !sketch.relations().is_empty() {
            return Err(why_not(sketch, &reduction));
        }
        let plan = Plan::new(sketch, &reduction);
        let drawn: Vec<Shape> = sketch.elements().iter().map(Shape::drawn).collect();
        let rigid = |m: &plan::Move| sketch.rigid(m.shared);
        let side = |m: &plan::Move| {
            let three = rigid(m).map(|r| r.map(|e| Shape::drawn(&e)));
            let [x, y, z] = three.unwrap_or_else(|| m.shared.map(|e| drawn[e]));
            third::drawn_side([&x, &z], &y) >= 0.0
        };
        Ok(Self {
            drawn_left: plan.moves.iter().map(side).collect(),
            rigid: plan.moves.iter().map(|m| rigid(m).is_some()).collect(),
            senseless: senseless(sketch, &plan),
            frames: frame::of_edges(sketch),
            sketch,
            reduction,
            plan,
            drawn,
            corrected: OnceLock::new(),
        })
    }

    /// The merges that are the steps, in their order.
    #[must_use]
    pub const fn reduction(&self) -> &Reduction {
        &self.reduction
    }

    /// Whether the drawing has the third element of each step on the left.
    #[must_use]
    pub fn drawn_left(&self) -> &[bool] {
        &self.drawn_left
    }

    /// Whether the three elements of a step belong to one rigid body, so that it has one place only.
    #[must_use]
    pub fn is_rigid(&self, step: usize) -> bool {
        self.rigid[step]
    }

    /// Whether the two places of a step make the same figure, with lines that point the other way: one of them is enough.
    #[must_use]
    pub fn is_senseless(&self, step: usize) -> bool {
        self.senseless[step]
    }

    /// The elements of a step: the two that are placed, and the one that is placed by them.
    #[must_use]
    pub fn elements_of(&self, step: usize) -> ([usize; 2], usize) {
        let [x, y, z] = self.plan.moves[step].shared;
        ([x, z], y)
    }

    /// How every step turns out for the sides chosen. Where a step is impossible the nearest thing stands in, so that later steps
    /// are told too; what they say then hangs on that.
    #[must_use]
    pub fn outcomes(&self, left: &[bool]) -> Vec<Outcome> {
        self.carried(left).outcomes
    }

    /// The solution with these sides.
    ///
    /// # Errors
    /// At the first step that cannot be done.
    pub fn with_sides(&self, left: &[bool]) -> Result<Solution, Impossible> {
        let carried = self.carried(left);
        let impossible = carried.outcomes.iter().position(|o| !o.is_possible());
        if let Some(step) = impossible {
            let outcome = carried.outcomes[step];
            return Err(Impossible { step, outcome });
        }
        let mut shapes = self.drawn.clone();
        for (&element, shape) in self.plan.order.iter().zip(carried.shapes) {
            shapes[element] = shape;
        }
        frame::as_drawn(&mut shapes, &self.drawn);
        let left = left.to_vec();
        Ok(Solution { shapes, left })
    }

    /// The solution with the sides of the drawing.
    ///
    /// # Errors
    /// At the first step that cannot be done.
    pub fn as_drawn(&self) -> Result<Solution, Impossible> {
        self.with_sides(&self.drawn_left)
    }

    /// How many times an element is moved for one solution: what a solution costs.
    #[must_use]
    pub const fn moved(&self) -> u64 {
        self.plan.moved
    }

    /// How many solutions there are, without listing them.
    #[must_use]
    pub fn count(&self) -> Count {
        Count::of(&self.classes())
    }

    /// The solutions one by one, that with the sides of the drawing first if there is one.
    #[must_use]
    pub fn solutions(&self) -> Solutions<'_> {
        Solutions::new(self, self.classes())
    }

    /// The largest difference between what a constraint asks for and what a solution has, lengths and radians alike.
    #[must_use]
    pub fn residual(&self, solution: &Solution) -> f64 {
        let off = |c: &crate::sketch::Constraint| {
            let [u, v] = c.ends.map(|e| &solution.shapes[e]);
            let off = frame::value_between(u, v) - c.value.value();
            match u.is_line() && v.is_line() {
                true => off.sin().abs().max(1.0 - off.cos()),
                false => off.abs(),
            }
        };
        let constraints = self.sketch.constraints().iter();
        constraints.map(off).fold(0.0, f64::max)
    }

    /// The value of a constraint between two shapes: length, distance to the left of a line, or angle (rad).
    #[must_use]
    pub fn value_between(one: &Shape, other: &Shape) -> f64 {
        frame::value_between(one, other)
    }

    /// Steps that rounded numbers leave open: circles that meet, touch or stay apart with other digits after those stated. Looked
    /// at are steps all of whose measures are constraints.
    #[must_use]
    pub fn left_open_by_rounding(&self) -> Vec<usize> {
        exact::left_open(self.sketch, &self.plan)
    }

    fn carried(&self, left: &[bool]) -> frame::Carried {
        let mut carried = frame::carry_out(&self.plan, self.frames.clone(), |step| left[step]);
        let lost = carried.outcomes.iter().find(|o| !o.is_possible());
        if matches!(lost, Some(Outcome::Apart { .. }))
            && left == self.drawn_left
            && let Some(places) = self.corrected()
        {
            carried = frame::as_it_is(&self.plan, places);
        }
        if self.sketch.is_known_to_rounding() {
            return carried;
        }
        let derived = derived::Derived {
            sketch: self.sketch,
            merges: &self.reduction.merges,
            plan: &self.plan,
            left,
        };
        exact::settle(&derived, &mut carried.outcomes);
        carried
    }

    /// The drawing, corrected where it is a little off, if it has all values then and every element is on the side drawn.
    fn corrected(&self) -> Option<&[Shape]> {
        let found = self.corrected.get_or_init(|| {
            let places = correction::corrected(self.sketch, &self.drawn)?;
            let outcomes = frame::as_it_is(&self.plan, &places).outcomes;
            let on_side = |((m, outcome), &left): ((&plan::Move, &Outcome), &bool)| {
                let [x, y, z] = m.shared.map(|e| &places[e]);
                let sides = matches!(outcome, Outcome::Two { .. });
                !sides || (third::drawn_side([x, z], y) >= 0.0) == left
            };
            let steps = self.plan.moves.iter().zip(&outcomes);
            let there = steps.zip(&self.drawn_left).all(on_side);
            there.then_some(places)
        });
        found.as_deref()
    }

    fn classes(&self) -> Vec<classes::Class> {
        let steps = self.plan.moves.len();
        let depends = depend::dependence(self.sketch, &self.reduction.merges);
        let classes = classes::classes(depends.as_deref(), steps);
        let edges = self.sketch.constraints().len();
        let made_by = |m: &crate::analysis::Merge| {
            let steps = m.parts.iter().filter_map(|p| p.checked_sub(edges));
            steps.collect()
        };
        let parts: Vec<Vec<usize>> = self.reduction.merges.iter().map(made_by).collect();
        let one_side = self.rigid.iter().zip(&self.senseless);
        let one_side: Vec<bool> = one_side.map(|(r, s)| r | s).collect();
        classes::tried(classes, &one_side, &parts, |other| {
            let sides = self.drawn_left.iter().zip(other);
            self.outcomes(
                &sides
                    .map(|(left, other)| left ^ other)
                    .collect::<Vec<bool>>(),
            )
        })
    }
}

/// Of every class of lines whose sense is free a step whose sides are the two senses: one that places a line of it by two points, or else a
/// point along a line of it. Turning the class round changes the side of all of these and of no other step.
fn senseless(sketch: &Sketch, plan: &Plan) -> Vec<bool> {
    let mut chosen = vec![false; plan.moves.len()];
    let line = |e: usize| sketch.elements()[e].is_line();
    for class in crate::senses::free(sketch) {
        let inside = |e: usize| class.binary_search(&e).is_ok();
        let places_line = |m: &plan::Move| {
            let [x, y, z] = m.shared;
            inside(y) && !line(x) && !line(z)
        };
        let along_line = |m: &plan::Move| {
            let [x, y, z] = m.shared;
            !line(y) && line(x) != line(z) && (inside(x) || inside(z))
        };
        let step = plan.moves.iter().position(places_line);
        let step = step.or_else(|| plan.moves.iter().position(along_line));
        if let Some(step) = step {
            chosen[step] = true;
        }
    }
    chosen
}

fn why_not(sketch: &Sketch, reduction: &Reduction) -> NotConstructive {
    let game = Counted::of(sketch);
    if !game.is_known() {
        NotConstructive::Clusters(Vec::new())
    } else if !game.circuits().is_empty() {
        NotConstructive::Over(game.circuits().to_vec())
    } else if game.freedoms() > 0 {
        NotConstructive::Under {
            freedoms: game.freedoms(),
            parts: game.rigid_parts(),
        }
    } else {
        NotConstructive::Clusters(reduction.left.iter().map(|l| l.1.clone()).collect())
    }
}
