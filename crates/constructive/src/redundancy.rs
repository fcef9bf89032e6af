//! Whether a constraint that others imply agrees with them.

use crate::construction::{Construction, Shape};
use crate::pebbles::Circuit;
use crate::sketch::{Constraint, Element, Sketch};

/// Solutions of the others that are compared, at most.
const MOST_SOLUTIONS: usize = 256;
/// Part of the largest coordinate by which a value may be off that agrees: rounding, with what flat triangles make of it.
const SAME: f64 = 1e-9;

/// What the other constraints say of one that they imply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Redundancy {
    /// Some of their solutions have its value, to rounding.
    Agrees,
    /// None of their solutions has; this is the nearest value (length, rad).
    Contradicts {
        /// That value.
        nearest: f64,
    },
    /// They have no solutions by ruler and compass, or too many to compare.
    Unknown,
}

/// Compares the constraint of a circuit with all solutions of the independent constraints that imply it; `refused` are the
/// edges that are not independent.
#[must_use]
pub fn redundancy(sketch: &Sketch, circuit: &Circuit, refused: &[usize]) -> Redundancy {
    let local = |e: usize| circuit.vertices.binary_search(&e).ok();
    let elements: Vec<Element> = circuit
        .vertices
        .iter()
        .map(|&e| sketch.elements()[e])
        .collect();
    let moved = |(i, c): (usize, &Constraint)| {
        let [u, v] = c.ends;
        (!refused.contains(&i)).then_some(())?;
        Some(Constraint {
            ends: [local(u)?, local(v)?],
            value: c.value.clone(),
        })
    };
    let constraints = sketch.constraints().iter().enumerate().filter_map(moved);
    let Ok(others) = Sketch::new(elements, constraints.collect()) else {
        return Redundancy::Unknown;
    };
    let rigid = sketch
        .rigid_triangles()
        .into_iter()
        .filter_map(|(three, places)| {
            let [a, b, c] = three.map(local);
            Some(([a?, b?, c?], places))
        });
    let others = others.with_rigid(rigid.collect());
    let Ok(construction) = Construction::new(&others) else {
        return Redundancy::Unknown;
    };
    let asked = &sketch.constraints()[circuit.edge];
    let [Some(u), Some(v)] = asked.ends.map(local) else {
        return Redundancy::Unknown;
    };
    let value = asked.value.value();
    let angle = asked
        .ends
        .iter()
        .all(|&e| matches!(sketch.elements()[e], Element::Line { .. }));
    let mut nearest: Option<(f64, f64)> = None;
    let mut solutions = construction.solutions();
    for solution in solutions.by_ref().take(MOST_SOLUTIONS) {
        let found = Construction::value_between(&solution.shapes[u], &solution.shapes[v]);
        let off = match angle {
            true => (found - value).sin().atan2((found - value).cos()).abs(),
            false => (found - value).abs(),
        };
        let size = solution.shapes.iter().map(Shape::extent);
        let size = if angle {
            1.0
        } else {
            size.fold(value.abs(), f64::max)
        };
        if off <= SAME * size {
            return Redundancy::Agrees;
        }
        if nearest.is_none_or(|(least, _)| off < least) {
            nearest = Some((off, found));
        }
    }
    let count = construction.count();
    let all = count.complete && !count.degenerate && count.between.is_none();
    match nearest.filter(|_| all && solutions.next().is_none()) {
        Some((_, nearest)) => Redundancy::Contradicts { nearest },
        None => Redundancy::Unknown,
    }
}
