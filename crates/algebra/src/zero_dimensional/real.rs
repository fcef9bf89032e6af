//! Real zeros: the real roots of the polynomial of the representation, and boxes around the points that belong to them.

use super::FinitePoints;
use crate::engine::{Budget, Stop};
use crate::polynomial::Rational;
use crate::univariate::{RealRoot, Univariate, dyadic, fraction, integer_gcd, to_f64};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// A real point of a zero-dimensional system, enclosed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RealSolution {
    /// Lower and upper bound of every coordinate; equal where the point is rational.
    pub coordinates: Vec<(Rational, Rational)>,
    /// How often the point counts as a zero.
    pub multiplicity: u32,
    /// Which irreducible factor of the representation it belongs to: points of the same factor are conjugates, and no
    /// equation with rational coefficients tells them apart.
    pub factor: usize,
}

impl RealSolution {
    /// The coordinates in double precision: the middles of the bounds.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.coordinates
            .iter()
            .map(|(low, high)| to_f64(&((low + high) / BigInt::from(2))))
            .collect()
    }

    /// Whether all coordinates are known exactly.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.coordinates.iter().all(|(low, high)| low == high)
    }
}

impl FinitePoints {
    /// Number of distinct real points.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn real_count(&self, budget: &Budget) -> Result<usize, Stop> {
        let mut count = 0;
        for (factor, _) in &self.representation.factors {
            count += factor.real_roots(budget)?.len();
        }
        Ok(count)
    }

    /// The real points, every coordinate enclosed in an interval no wider than 2^-bits; in the order of the irreducible
    /// factors, then of the values of the separating form.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn real_solutions(&self, bits: u64, budget: &Budget) -> Result<Vec<RealSolution>, Stop> {
        let mut solutions = Vec::new();
        for (index, (factor, multiplicity)) in self.representation.factors.iter().enumerate() {
            let roots = factor.real_roots(budget)?;
            if roots.is_empty() {
                continue;
            }
            let functions = self.functions_modulo(factor);
            for root in roots {
                solutions.push(RealSolution {
                    coordinates: enclose(factor, &functions, root, bits, budget)?,
                    multiplicity: *multiplicity,
                    factor: index,
                });
            }
        }
        Ok(solutions)
    }

    /// Denominator and numerators with the multiples of a factor taken out, all times a common number.
    fn functions_modulo(&self, factor: &Univariate) -> Vec<Univariate> {
        let found = &self.representation;
        let all: Vec<&Univariate> = std::iter::once(&found.denominator)
            .chain(&found.numerators)
            .collect();
        let steps = all
            .iter()
            .map(|function| (function.degree() + 1).saturating_sub(factor.degree()))
            .max()
            .unwrap_or(0);
        let rests: Vec<Univariate> = all
            .iter()
            .map(|function| function.pseudo_remainder(factor, steps))
            .collect();
        let content = rests
            .iter()
            .fold(BigInt::zero(), |gcd, p| integer_gcd(&gcd, &p.content()));
        rests
            .iter()
            .map(|rest| Univariate::new(rest.coefficients().iter().map(|c| c / &content).collect()))
            .collect()
    }
}

/// The coordinates that belong to a root; the root is refined until they are known well enough.
fn enclose(
    factor: &Univariate,
    functions: &[Univariate],
    root: RealRoot,
    bits: u64,
    budget: &Budget,
) -> Result<Vec<(Rational, Rational)>, Stop> {
    if let Some(value) = exact_value(factor, &root) {
        return Ok(exact_coordinates(functions, &value));
    }
    let mut root = root;
    let mut digits = bits + 16;
    loop {
        budget.multiply(digits.div_ceil(64) * functions.len() as u64 * factor.degree() as u64)?;
        root = factor.refine(&root, digits);
        if let Some(value) = exact_value(factor, &root) {
            return Ok(exact_coordinates(functions, &value));
        }
        let enclosed = coordinates(functions, &root, digits).filter(|all| {
            all.iter()
                .all(|(low, high)| (high - low) << bits <= BigInt::one() << digits)
        });
        if let Some(all) = enclosed {
            return Ok(all
                .into_iter()
                .map(|(low, high)| (dyadic(low, digits), dyadic(high, digits)))
                .collect());
        }
        digits += digits / 2 + 32;
    }
}

/// The root where it is known exactly; that of a linear polynomial is rational.
fn exact_value(factor: &Univariate, root: &RealRoot) -> Option<Rational> {
    match factor.coefficients() {
        [constant, slope] => Some(fraction(-constant, slope)),
        _ => root.is_exact().then(|| root.low.clone()),
    }
}

fn exact_coordinates(functions: &[Univariate], value: &Rational) -> Vec<(Rational, Rational)> {
    let mut values = functions.iter().map(|function| function.value_at(value));
    let denominator = values.next().unwrap_or_else(Rational::one);
    values
        .map(|numerator| {
            let coordinate = numerator / &denominator;
            (coordinate.clone(), coordinate)
        })
        .collect()
}

/// Two integers that stand for the numbers 2^digits times smaller: the ends of an interval.
type Interval = (BigInt, BigInt);

/// The quotients of the functions after the first by the first, where that is not zero in the whole interval.
fn coordinates(functions: &[Univariate], root: &RealRoot, digits: u64) -> Option<Vec<Interval>> {
    let argument = (
        floor_quotient(&(root.low.numer() << digits), root.low.denom()),
        ceiling_quotient(&(root.high.numer() << digits), root.high.denom()),
    );
    let (denominator, numerators) = functions.split_first()?;
    let mut below = range(denominator, &argument, digits);
    let mut sign = BigInt::one();
    if below.1.is_negative() {
        below = (-below.1, -below.0);
        sign = -sign;
    }
    if !below.0.is_positive() {
        return None;
    }
    let quotient = |numerator: &Univariate| {
        let (low, high) = range(numerator, &argument, digits);
        let (low, high) = if sign.is_negative() {
            (-high, -low)
        } else {
            (low, high)
        };
        // A positive end is smallest over the larger denominator, a negative one over the smaller.
        let smallest = if low.is_negative() {
            &below.0
        } else {
            &below.1
        };
        let largest = if high.is_negative() {
            &below.1
        } else {
            &below.0
        };
        (
            floor_quotient(&(low << digits), smallest),
            ceiling_quotient(&(high << digits), largest),
        )
    };
    Some(numerators.iter().map(quotient).collect())
}

/// The quotient by a positive integer, rounded down.
fn floor_quotient(numerator: &BigInt, denominator: &BigInt) -> BigInt {
    let quotient = numerator / denominator;
    if (&quotient * denominator) > *numerator {
        quotient - 1
    } else {
        quotient
    }
}

/// The quotient by a positive integer, rounded up.
fn ceiling_quotient(numerator: &BigInt, denominator: &BigInt) -> BigInt {
    -floor_quotient(&-numerator, denominator)
}

/// An enclosure of the values of a polynomial on an interval, by Horner's scheme.
fn range(polynomial: &Univariate, argument: &Interval, digits: u64) -> Interval {
    let mut value = (BigInt::zero(), BigInt::zero());
    for c in polynomial.coefficients().iter().rev() {
        let product = times(&value, argument);
        // Shifting rounds down; the upper end is rounded up.
        let down = product.0 >> digits;
        let up = -(-product.1 >> digits);
        let c = c << digits;
        value = (down + &c, up + c);
    }
    value
}

fn times(a: &Interval, b: &Interval) -> Interval {
    let [first, rest @ ..] = [&a.0 * &b.0, &a.0 * &b.1, &a.1 * &b.0, &a.1 * &b.1];
    rest.into_iter()
        .fold((first.clone(), first), |(low, high), value| {
            if value < low {
                (value, high)
            } else if value > high {
                (low, value)
            } else {
                (low, high)
            }
        })
}
