//! Tangency at lengths that follow from choices, decided exactly for a few points.
//!
//! In complex numbers a point by two circles is x + (z − x)(t ± i h) with t = (d² + r² − s²) / 2d² and h = √D / 2d², where
//! D = 4d²r² − (d² + r² − s²)²: sixteen times the square of the triangle's area. Circles meet where D is above zero and touch
//! where it is zero. Only squares of lengths occur, so that every step adds one square root.

use super::plan::Plan;
use super::third::Outcome;
use crate::analysis::Merge;
use crate::sketch::{Element, Sketch};
use kutzbach_math::number::{Number, ZeroTest};
use std::collections::BTreeMap;

/// Square roots stand in each other as deep as there are steps, and a proof that one is zero takes twice the digits for each.
const MOST_STEPS: usize = 6;

type Complex = [Number; 2];

fn minus(a: &Complex, b: &Complex) -> Complex {
    [0, 1].map(|k| &a[k] - &b[k])
}

fn plus(a: &Complex, b: &Complex) -> Complex {
    [0, 1].map(|k| &a[k] + &b[k])
}

fn times(a: &Complex, b: &Complex) -> Complex {
    [
        &(&a[0] * &b[0]) - &(&a[1] * &b[1]),
        &(&a[0] * &b[1]) + &(&a[1] * &b[0]),
    ]
}

fn square(a: &Complex) -> Number {
    &(&a[0] * &a[0]) + &(&a[1] * &a[1])
}

fn ratio(a: &Complex, b: &Complex) -> Option<Complex> {
    let [x, y] = times(a, &[b[0].clone(), -&b[1]]);
    let long = square(b);
    Some([x.checked_div(&long).ok()?, y.checked_div(&long).ok()?])
}

/// What is needed to place clusters exactly for one choice of places.
pub(super) struct Derived<'a> {
    pub(super) sketch: &'a Sketch,
    pub(super) merges: &'a [Merge],
    pub(super) plan: &'a Plan,
    pub(super) left: &'a [bool],
}

/// A cluster's points by element.
type Places = BTreeMap<usize, Complex>;

/// Three clusters in the order of a step: the one that stays, the two that move; and how the circles lie to each other.
struct Triangle {
    places: [Places; 3],
    /// Squares of the distances of first and third, first and second, second and third of the shared elements.
    squares: [Number; 3],
    /// Sixteen times the square of the area.
    area: Number,
}

impl Derived<'_> {
    /// How a step turns out; `None` where lines take part, too many steps, one that is impossible, or numbers that are not
    /// algebraic.
    pub(super) fn outcome(&self, step: usize) -> Option<Outcome> {
        let mut steps = MOST_STEPS;
        let Triangle { squares, area, .. } = self.triangle(step, &mut steps)?;
        let [d, r, s] = squares.map(|x| x.value().sqrt());
        let factors = [r + s - d, d - r + s, d + r - s];
        let least = factors.iter().copied().fold(f64::INFINITY, f64::min);
        let others: f64 = factors.iter().filter(|f| **f > least).product();
        // The margin that its sign belongs to, from the product of all.
        let by = (area.value() / (others * (d + r + s))).abs();
        match (area.zero_test(), area.signum()) {
            (ZeroTest::Zero, _) => Some(Outcome::Touching { within: 0.0 }),
            (ZeroTest::NonZero, 1) => Some(Outcome::Two { by }),
            (ZeroTest::NonZero, _) => Some(Outcome::Apart { by }),
            _ => None,
        }
    }

    fn triangle(&self, step: usize, steps: &mut usize) -> Option<Triangle> {
        let merge = &self.merges[step];
        let [x, y, z] = self.plan.moves[step].shared;
        let first = merge.shared.iter().position(|&e| e == x)?;
        let mut place = |k: usize| self.places(merge.parts[(first + k) % 3], steps);
        let places = [place(0)?, place(1)?, place(2)?];
        let between = |k: usize, a: usize, b: usize| {
            let of = &places[k];
            Some(square(&minus(of.get(&a)?, of.get(&b)?)))
        };
        let squares = [between(0, x, z)?, between(1, x, y)?, between(2, y, z)?];
        let [d, r, s] = &squares;
        let sum = &(d + r) - s;
        let area = &(&Number::integer(4) * &(d * r)) - &(&sum * &sum);
        Some(Triangle {
            places,
            squares,
            area,
        })
    }

    fn places(&self, cluster: usize, steps: &mut usize) -> Option<Places> {
        let constraints = self.sketch.constraints();
        let Some(step) = cluster.checked_sub(constraints.len()) else {
            let constraint = &constraints[cluster];
            let point = |e: &usize| matches!(self.sketch.elements()[*e], Element::Point(_));
            let [u, v] = constraint.ends;
            let zero = Number::zero;
            let ends = [
                (u, [zero(), zero()]),
                (v, [constraint.value.clone(), zero()]),
            ];
            return constraint.ends.iter().all(point).then(|| ends.into());
        };
        *steps = steps.checked_sub(1)?;
        let Triangle {
            places: [mut kept, second, last],
            squares: [d, r, s],
            area,
        } = self.triangle(step, steps)?;
        let [x, y, z] = self.plan.moves[step].shared;
        let twice = &Number::integer(2) * &d;
        let along = (&(&d + &r) - &s).checked_div(&twice).ok()?;
        let height = area.sqrt().ok()?.checked_div(&twice).ok()?;
        let height = if self.left[step] { height } else { -&height };
        let base = minus(kept.get(&z)?, kept.get(&x)?);
        let at_x = kept.get(&x)?.clone();
        let at_y = plus(&at_x, &times(&base, &[along, height]));
        let at_z = kept.get(&z)?.clone();
        for (moved, [a, b], [to_a, to_b]) in [
            (second, [x, y], [&at_x, &at_y]),
            (last, [y, z], [&at_y, &at_z]),
        ] {
            let from = moved.get(&a)?.clone();
            let turn = ratio(&minus(to_b, to_a), &minus(moved.get(&b)?, &from))?;
            for (element, place) in moved {
                kept.entry(element)
                    .or_insert_with(|| plus(to_a, &times(&minus(&place, &from), &turn)));
            }
        }
        Some(kept)
    }
}
