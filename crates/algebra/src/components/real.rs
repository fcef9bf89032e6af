//! Real points of a piece: points over rational values of the free variables, counted exactly.

use super::Hints;
use super::fibre::Fibre;
use super::split::Whole;
use crate::engine::{Budget, Stop};
use crate::polynomial::{Polynomial, Rational};
use crate::univariate::Univariate;
use crate::zero_dimensional::{FinitePoints, RealSolution};
use num_traits::{Signed, Zero};

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
    /// There are none: an equation of the piece has no real solution, or none with cosines and sines between -1 and 1.
    None,
    /// Not looked for.
    Unknown,
}

/// Looks for real points of a piece, whose equations in all variables are given too.
pub(super) fn real_points(
    whole: &Whole,
    equations: &[Polynomial],
    hints: &Hints,
    budget: &Budget,
) -> Result<RealPoints, Stop> {
    let piece = &whole.piece;
    if whole.free.is_empty() {
        return Ok(match piece.points(budget)? {
            Some(points) => {
                let multiplicities = right_points(&points, whole, &[], hints, budget)?;
                RealPoints::Finite(multiplicities.len())
            }
            None => RealPoints::Unknown,
        });
    }
    for equation in &piece.equations {
        if contradicts_reality(equation, budget)? {
            return Ok(RealPoints::None);
        }
    }
    if equations.iter().any(|p| is_out_of_reach(p, hints)) {
        return Ok(RealPoints::None);
    }
    let mut found = RealPoints::NotFound;
    for values in samples(whole, hints) {
        // Whatever the values: where a solution over them is simple, the piece is a graph over the free variables.
        let Some(fibre) = Fibre::new(piece, &whole.free, &values, budget)? else {
            continue;
        };
        let multiplicities = right_points(&fibre.points, whole, &values, hints, budget)?;
        if multiplicities.contains(&1) {
            return Ok(RealPoints::FullDimension);
        }
        if !multiplicities.is_empty() {
            found = RealPoints::Some;
        }
    }
    Ok(found)
}

/// Whether no real point satisfies an equation: a polynomial of one variable without real roots, or a sum of even powers
/// with a constant of the same sign.
fn contradicts_reality(equation: &Polynomial, budget: &Budget) -> Result<bool, Stop> {
    let mentioned: Vec<usize> = (0..equation.variables())
        .filter(|&v| equation.mentions(v))
        .collect();
    if let &[only] = mentioned.as_slice()
        && let Some(one) = Univariate::from_polynomial(equation, only)
    {
        for (part, _) in one.squarefree() {
            if !part.real_roots(budget)?.is_empty() {
                return Ok(false);
            }
        }
        return Ok(true);
    }
    let even = equation
        .terms()
        .all(|(m, _)| m.iter().all(|e| e.is_multiple_of(2)));
    let constant = equation.terms().any(|(m, _)| m.iter().all(|&e| e == 0));
    let positive = equation.terms().all(|(_, c)| c.is_positive());
    let negative = equation.terms().all(|(_, c)| c.is_negative());
    Ok(even && constant && (positive || negative))
}

/// Whether an equation among cosines and sines has no solution with all of them between -1 and 1: its links do not reach.
fn is_out_of_reach(equation: &Polynomial, hints: &Hints) -> bool {
    let on_circle = |v: usize| hints.angles.iter().any(|&(c, s)| c == v || s == v);
    let (mut low, mut high) = (Rational::zero(), Rational::zero());
    for (exponents, c) in equation.terms() {
        let mut used = exponents.iter().enumerate().filter(|(_, e)| **e > 0);
        if !used.all(|(v, _)| on_circle(v)) {
            return false;
        }
        let constant = exponents.iter().all(|&e| e == 0);
        let even = exponents.iter().all(|e| e.is_multiple_of(2));
        // A product of even powers is between 0 and 1, another product between -1 and 1.
        if constant || c.is_positive() || !even {
            high += if constant { c.clone() } else { c.abs() };
        }
        if constant || c.is_negative() || !even {
            low += if constant { c.clone() } else { -c.abs() };
        }
    }
    low.is_positive() || high.is_negative()
}

/// Values of the free variables, near the known points first.
fn samples(whole: &Whole, hints: &Hints) -> Vec<Vec<Rational>> {
    let alive = &whole.piece.ring.alive;
    let near = hints.points.iter().filter_map(|point| {
        let coordinates = whole.free.iter().map(|&v| {
            let value = *point.get(alive[v])?;
            // A step of 1/256 beside the point: the point itself may be special.
            let steps = (value * 256.0).round();
            (steps.abs() < 1e15).then(|| Rational::new((steps as i64).into(), 256.into()))
        });
        coordinates.collect()
    });
    let spread = (0..SAMPLES).map(|number| sample(number, whole, hints));
    near.chain(spread).collect()
}

/// Rational values for the free variables: cosines and sines of angles with both rational, other variables small.
fn sample(number: usize, whole: &Whole, hints: &Hints) -> Vec<Rational> {
    const CIRCLE: [(i64, i64); 13] = [
        (3, 5),
        (-4, 5),
        (12, 13),
        (0, 1),
        (-5, 13),
        (1, 1),
        (-1, 1),
        (4, 5),
        (-3, 5),
        (8, 17),
        (-15, 17),
        (24, 25),
        (-24, 25),
    ];
    const LENGTHS: [(i64, i64); 13] = [
        (1, 2),
        (-1, 1),
        (2, 1),
        (1, 3),
        (-3, 1),
        (5, 1),
        (-1, 4),
        (4, 1),
        (10, 1),
        (0, 1),
        (7, 3),
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

/// The multiplicities of the real points at which every algebraic number is the root it stands for.
fn right_points(
    points: &FinitePoints,
    whole: &Whole,
    values: &[Rational],
    hints: &Hints,
    budget: &Budget,
) -> Result<Vec<u32>, Stop> {
    let mut multiplicities = Vec::new();
    if hints.numbers.is_empty() {
        for (factor, multiplicity) in &points.representation().factors {
            let roots = factor.real_roots(budget)?.len();
            multiplicities.extend(std::iter::repeat_n(*multiplicity, roots));
        }
        return Ok(multiplicities);
    }
    let mut bits = FIRST_BITS;
    loop {
        let solutions = points.real_solutions(bits, budget)?;
        let decided: Option<Vec<bool>> = solutions
            .iter()
            .map(|solution| is_right(solution, whole, values, hints))
            .collect();
        if let Some(decided) = decided {
            for (solution, right) in solutions.iter().zip(decided) {
                if right {
                    multiplicities.push(solution.multiplicity);
                }
            }
            return Ok(multiplicities);
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
                if c.is_positive() {
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
