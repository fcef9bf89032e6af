//! Real points of a piece: points over rational values of the free variables, counted exactly.

use super::Hints;
use super::fibre::{Fibre, is_exceptional};
use super::split::{Whole, contradicts_reality};
use crate::algebra::engine::{Budget, MonomialOrder, Stop, groebner_basis};
use crate::algebra::polynomial::{Polynomial, Rational};
use crate::algebra::zero_dimensional::{FinitePoints, RealSolution};
use num_traits::Zero;

/// Values of the free variables that are tried.
const SAMPLES: usize = 16;

/// Bits to which an algebraic number is known before it is asked which of the roots it is.
const FIRST_BITS: u64 = 32;

/// Whether a piece has real points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RealPoints {
    /// So many real points, and no others: the piece consists of finitely many points.
    Finite(usize),
    /// The real points have the dimension of the piece: a real point was found at which the equations over the free
    /// variables have a simple solution, so that the piece is there a graph over them.
    FullDimension,
    /// There are real points; whether they have the dimension of the piece is not known.
    Some,
    /// None was found over the values that were tried. That is no proof: there may be a few, or outside of these values.
    NotFound,
    /// There are none: an equation of the piece has no real solution.
    None,
    /// Not looked for.
    Unknown,
}

/// Looks for real points.
pub(super) fn real_points(
    whole: &Whole,
    hints: &Hints,
    budget: &Budget,
) -> Result<RealPoints, Stop> {
    let piece = &whole.piece;
    for equation in &piece.equations {
        if contradicts_reality(equation, budget)? {
            return Ok(if whole.free.is_empty() {
                RealPoints::Finite(0)
            } else {
                RealPoints::None
            });
        }
    }
    if whole.free.is_empty() {
        let order = MonomialOrder::Degrevlex;
        let basis = groebner_basis(&piece.equations, piece.variables(), &order, budget)?;
        return match FinitePoints::new(&basis, budget)? {
            Some(points) => {
                let right = right_solutions(&points, whole, &[], hints, budget)?;
                Ok(RealPoints::Finite(right.len()))
            }
            None => Ok(RealPoints::Unknown),
        };
    }
    let mut found = RealPoints::NotFound;
    for number in 0..SAMPLES {
        let values = sample(number, whole, hints);
        if is_exceptional(&whole.exceptions, &whole.free, &values) {
            continue;
        }
        let Some(fibre) = Fibre::new(piece, &whole.free, &values, budget)? else {
            continue;
        };
        let right = right_solutions(&fibre.points, whole, &values, hints, budget)?;
        if right.iter().any(|solution| solution.multiplicity == 1) {
            return Ok(RealPoints::FullDimension);
        }
        if !right.is_empty() {
            found = RealPoints::Some;
        }
    }
    Ok(found)
}

/// Rational values for the free variables: cosines and sines of angles with both rational, other variables small.
fn sample(number: usize, whole: &Whole, hints: &Hints) -> Vec<Rational> {
    const CIRCLE: [(i64, i64); 11] = [
        (3, 5),
        (-4, 5),
        (12, 13),
        (0, 1),
        (-5, 13),
        (4, 5),
        (-3, 5),
        (8, 17),
        (-15, 17),
        (24, 25),
        (-24, 25),
    ];
    const LENGTHS: [(i64, i64); 11] = [
        (1, 2),
        (-1, 1),
        (2, 1),
        (1, 3),
        (-3, 1),
        (5, 1),
        (-1, 4),
        (4, 1),
        (10, 1),
        (-7, 1),
        (1, 10),
    ];
    whole
        .free
        .iter()
        .enumerate()
        .map(|(i, &v)| {
            let original = whole.piece.ring.alive[v];
            let index = (number * (2 * i + 1) + 3 * i) % CIRCLE.len();
            let on_circle = hints
                .angles
                .iter()
                .any(|&(c, s)| c == original || s == original);
            let (numerator, denominator) = if on_circle {
                CIRCLE[index]
            } else {
                LENGTHS[index]
            };
            Rational::new(numerator.into(), denominator.into())
        })
        .collect()
}

/// The real solutions at which every algebraic number is the root it stands for.
fn right_solutions(
    points: &FinitePoints,
    whole: &Whole,
    values: &[Rational],
    hints: &Hints,
    budget: &Budget,
) -> Result<Vec<RealSolution>, Stop> {
    let mut bits = FIRST_BITS;
    loop {
        let solutions = points.real_solutions(bits, budget)?;
        let decided: Option<Vec<bool>> = solutions
            .iter()
            .map(|solution| is_right(solution, whole, values, hints))
            .collect();
        if let Some(decided) = decided {
            return Ok(solutions
                .into_iter()
                .zip(decided)
                .filter_map(|(solution, right)| right.then_some(solution))
                .collect());
        }
        bits *= 2;
    }
}

type Interval = (Rational, Rational);

/// Whether the algebraic numbers are in their intervals; `None` where the enclosures are too wide to say.
fn is_right(
    solution: &RealSolution,
    whole: &Whole,
    values: &[Rational],
    hints: &Hints,
) -> Option<bool> {
    let mut bound = solution.coordinates.iter();
    let coordinates: Vec<Interval> = (0..whole.piece.variables())
        .map(|v| match whole.free.iter().position(|&f| f == v) {
            Some(place) => Some((values[place].clone(), values[place].clone())),
            None => bound.next().cloned(),
        })
        .collect::<Option<_>>()?;
    for number in &hints.numbers {
        let linear = &whole.piece.ring.embedding[number.variable];
        let (low, high) = linear_range(linear, &coordinates);
        if high < number.low || low > number.high {
            return Some(false);
        }
        if low < number.low || high > number.high {
            return None;
        }
    }
    Some(true)
}

/// The range of a linear polynomial in a box.
fn linear_range(linear: &Polynomial, coordinates: &[Interval]) -> Interval {
    let mut range = (Rational::zero(), Rational::zero());
    for (exponents, c) in linear.terms() {
        let (low, high) = match exponents.iter().position(|&e| e > 0) {
            None => (c.clone(), c.clone()),
            Some(v) => {
                let (low, high) = &coordinates[v];
                if *c > Rational::zero() {
                    (low * c, high * c)
                } else {
                    (high * c, low * c)
                }
            }
        };
        range = (range.0 + low, range.1 + high);
    }
    range
}
