//! What circles and lines do not construct: its elements are placed all at once, by exact algebra, and the construction goes on
//! from there.
//!
//! # The problem
//! K₃,₃ and the prism are rigid and have no triangle to begin with: any place of any element depends on all constraints. There are
//! finitely many solutions at generic values, and all of them are wanted: 16 over the complex numbers for K₃,₃, 24 for the prism.
//!
//! # How
//! A *core* is such a part whose constraints are all given: a triconnected leaf of the s-tree whose edges are all constraints, or else what is
//! left of the sketch when elements of two constraints are taken off one after the other. With one constraint pinned to the axes its
//! equations are polynomials with exact coefficients, of which all real solutions are found with proof. Each of them makes the core
//! one rigid body, on which the rest is constructed as usual; the numbers of solutions add up.
//!
//! # What it costs
//! With D complex solutions about D³ operations; a limit on work, the same on every machine, ends in an answer that says so, with the solutions
//! that Newton's method finds from the drawing and around it. A core that
//! needs the lengths between elements of other parts takes these parts in, and grows with them.
//!
//! Source: A. Soto i Riera (2002) names what is left over; counts by J. Capco, M. Gallet, G. Grasegger, C. Koutschan, N. Lubbes, J.
//! Schicho, "The number of realizations of a Laman graph" (2018).

mod building;
mod part;
mod related;
mod search;
mod system;
mod unknown_values;

pub use part::{Core, CoreOutcome, Placed};

use crate::analysis::{STree, reduce};
use crate::construction::{Construction, Shape};
use crate::graph::Graph;
use crate::planar::hold;
use crate::sketch::{Constraint, Element, Sketch};
use kutzbach_algebra::{Budget, Limits};
use kutzbach_math::number::Number;

/// Matrix entries that one core may take where nothing is asked for.
const WORK: u64 = 200_000_000;

/// Matrix entries in a second of a usual machine: with coefficients of thirty digits, as the squares of printed doubles have.
const WORK_PER_SECOND: f64 = 7e6;

/// About as much work for each core as takes so many seconds, the same on every machine.
#[must_use]
pub fn seconds(seconds: f64) -> Limits {
    Limits {
        // Saturating; not a number becomes zero.
        work: Some((seconds * WORK_PER_SECOND) as u64),
        ..Limits::default()
    }
}

/// Combinations of the cores' solutions that are constructed on; beyond that the number of solutions is a lower bound.
const MOST_COMBINATIONS: usize = 256;

/// A sketch that is not constructed by circles and lines alone, solved as far as it goes.
#[derive(Clone, Debug)]
pub struct Together {
    /// The parts that were solved at once.
    pub cores: Vec<Core>,
    /// How many solutions the sketch has; `None` where a core or what stands on it was not solved.
    pub total: Option<Total>,
}

/// A number of solutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Total {
    /// So many, or at least so many.
    pub least: u128,
    /// Whether these are all.
    pub all: bool,
}

impl std::fmt::Display for Total {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let bound = if self.all { "" } else { "at least " };
        write!(f, "{bound}{}", self.least)
    }
}

/// Solves the cores of a well-constrained sketch that does not reduce to one cluster, and counts what stands on them.
#[must_use]
pub fn together(sketch: &Sketch, tree: &STree) -> Together {
    together_within(sketch, tree, &Limits::default())
}

/// The same within other limits, of which those of work are for each core.
#[must_use]
pub fn together_within(sketch: &Sketch, tree: &STree, limits: &Limits) -> Together {
    together_from(sketch, tree, &Budget::new(limits.clone()))
}

/// The same with what is left of a budget.
#[must_use]
pub fn together_from(sketch: &Sketch, tree: &STree, budget: &Budget) -> Together {
    let peeled = part::peeled(sketch);
    let tries = match sketch.relations().is_empty() {
        true => vec![part::leaves(sketch, tree), peeled],
        // They tie more than the graph knows. Mirror images may coincide, on which nothing stands: then all is one core.
        false => {
            let all: Vec<usize> = (0..sketch.elements().len()).collect();
            let larger = peeled.first() != Some(&all);
            let mut tries = vec![peeled];
            tries.extend(larger.then(|| vec![all]));
            tries
        }
    };
    let last = tries.len() - 1;
    for (k, cores) in tries.into_iter().enumerate() {
        if cores.is_empty() || !reduces(sketch, &cores) {
            continue;
        }
        let work = budget.limits().work.or(Some(WORK));
        let cores: Vec<Core> = cores
            .into_iter()
            .map(|elements| Core::solved(sketch, elements, &budget.part(1.0, work)))
            .collect();
        let total = total(sketch, &cores);
        let nothing_stands = total.is_none() && cores.iter().all(|c| c.places().is_some());
        if nothing_stands && k < last && !sketch.relations().is_empty() {
            continue;
        }
        return Together { cores, total };
    }
    Together {
        cores: Vec::new(),
        total: None,
    }
}

impl Together {
    /// All solutions, with their multiplicities, where these are known to be all and no more than `most`; each up to a motion of the plane.
    #[must_use]
    pub fn solutions(&self, sketch: &Sketch, most: usize) -> Option<Vec<(Vec<Shape>, usize)>> {
        self.total.filter(|t| t.all && t.least <= most as u128)?;
        let mut all = Vec::new();
        for choice in choices(&self.cores)? {
            let multiplicity = choice.iter().map(|placed| placed.multiplicity).product();
            if let Some(shapes) = whole(sketch, &self.cores, &choice) {
                all.push((shapes, multiplicity));
                continue;
            }
            let sketch = standing_on(sketch, &self.cores, &choice)?;
            let construction = Construction::new(&sketch).ok()?;
            all.extend(construction.solutions().map(|s| (s.shapes, multiplicity)));
        }
        Some(all)
    }
}

/// Whether the rest is constructed once these are rigid, wherever their elements are.
fn reduces(sketch: &Sketch, cores: &[Vec<usize>]) -> bool {
    let inside = |ends: &[usize; 2]| {
        let holds = |core: &Vec<usize>| ends.iter().all(|e| core.contains(e));
        cores.iter().any(holds)
    };
    let kept = sketch.graph().edges().iter().filter(|ends| !inside(ends));
    // Two elements hold all others.
    let held = |core: &Vec<usize>| -> Vec<[usize; 2]> {
        let pairs = core.iter().enumerate().skip(1);
        let by_two = pairs.flat_map(|(i, &e)| core.iter().take(i.min(2)).map(move |&two| [two, e]));
        by_two.collect()
    };
    let all = kept.copied().chain(cores.iter().flat_map(held));
    Graph::new(sketch.graph().vertices(), all).is_ok_and(|graph| reduce(&graph).solved)
}

/// A place for every core, in all combinations, up to one more than are constructed on; `None` where a core was not solved.
fn choices(cores: &[Core]) -> Option<Vec<Vec<&Placed>>> {
    let places: Vec<&[Placed]> = cores.iter().map(Core::places).collect::<Option<_>>()?;
    let mut all: Vec<Vec<&Placed>> = vec![Vec::new()];
    for places in places {
        let longer = all.iter().flat_map(|choice| {
            places.iter().map(move |placed| {
                let mut longer = choice.clone();
                longer.push(placed);
                longer
            })
        });
        all = longer.take(MOST_COMBINATIONS + 1).collect();
    }
    Some(all)
}

/// The places of all elements, where one core has them all.
fn whole(sketch: &Sketch, cores: &[Core], choice: &[&Placed]) -> Option<Vec<Shape>> {
    let ([core], [placed]) = (cores, choice) else {
        return None;
    };
    (core.elements.len() == sketch.elements().len()).then(|| placed.shapes.clone())
}

/// The sketch with its cores as rigid bodies.
fn standing_on(sketch: &Sketch, cores: &[Core], choice: &[&Placed]) -> Option<Sketch> {
    let bodies: Vec<(Vec<usize>, Vec<Shape>)> = cores
        .iter()
        .zip(choice)
        .map(|(core, placed)| (core.elements.clone(), placed.shapes.clone()))
        .collect();
    with_bodies(sketch, &bodies)
}

fn total(sketch: &Sketch, cores: &[Core]) -> Option<Total> {
    let choices = choices(cores)?;
    let mut total = Total {
        least: 0,
        all: choices.len() <= MOST_COMBINATIONS && cores.iter().all(Core::has_all),
    };
    for choice in choices.iter().take(MOST_COMBINATIONS) {
        if whole(sketch, cores, choice).is_some() {
            total.least += 1;
            continue;
        }
        let sketch = standing_on(sketch, cores, choice)?;
        let count = Construction::new(&sketch).ok()?.count();
        let sure = match count.between {
            Some([least, _]) => Some(least),
            None => count.value(),
        };
        total.all &= sure.is_some()
            && count.complete
            && !count.degenerate
            && !count.infinite
            && count.between.is_none();
        total.least = total.least.checked_add(sure?)?;
    }
    Some(total)
}

/// The sketch with these elements as rigid bodies, at shapes that are known to rounding; `None` where a body has no points to
/// hold it.
fn with_bodies(sketch: &Sketch, bodies: &[(Vec<usize>, Vec<Shape>)]) -> Option<Sketch> {
    let inside = |elements: &[usize]| {
        bodies
            .iter()
            .any(|(body, _)| elements.iter().all(|e| body.contains(e)))
    };
    let kept = sketch.constraints().iter().filter(|c| !inside(&c.ends));
    let mut constraints: Vec<Constraint> = kept.cloned().collect();
    let kept = sketch.rigid_triangles().into_iter();
    let mut triangles: Vec<([usize; 3], [Element; 3])> =
        kept.filter(|(three, _)| !inside(three)).collect();
    for (elements, shapes) in bodies {
        let exact = elements.iter().zip(shapes);
        let held: Vec<_> = exact
            .map(|(&e, shape)| Some((e, exact_shape(shape)?)))
            .collect::<Option<_>>()?;
        let held = hold(&held)?;
        constraints.extend(held.constraints);
        triangles.extend(held.triangles);
    }
    let result = Sketch::new(sketch.elements().to_vec(), constraints).ok()?;
    let result = result.with_rigid(triangles).known_to_rounding();
    Some(match sketch.senses_count() {
        true => result,
        false => result.of_figures(),
    })
}

/// The place as exact numbers, to take lengths from.
fn exact_shape(shape: &Shape) -> Option<crate::planar::Exact> {
    let pair = |[x, y]: [f64; 2]| Some([Number::from_f64(x)?, Number::from_f64(y)?]);
    Some(match *shape {
        Shape::Point(p) => crate::planar::Exact::Point(pair(p)?),
        Shape::Line { direction, offset } => {
            let through = [-direction[1] * offset, direction[0] * offset];
            crate::planar::Exact::Line(pair(through)?, pair(direction)?)
        }
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
