//! Real zeros: the real roots of the polynomial of the representation, and boxes around the points that belong to them.

use super::FinitePoints;
use crate::algebra::engine::{Budget, Stop};
use crate::algebra::polynomial::Rational;
use crate::algebra::univariate::{Dense, RealRoot, Univariate, integer_multiple, to_f64};
use num_bigint::BigInt;
use num_traits::{One, Zero};

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

    /// Denominator and numerators with the multiples of a factor taken out, times a common number.
    fn functions_modulo(&self, factor: &Univariate) -> Vec<Univariate> {
        let divisor = Dense::new(factor.rationals());
        let width = factor.degree();
        let all = std::iter::once(&self.representation.denominator)
            .chain(&self.representation.numerators);
        let flat: Vec<Rational> = all
            .flat_map(|function| {
                let mut rest = (&Dense::new(function.rationals()) % &divisor).0;
                rest.resize(width, Rational::zero());
                rest
            })
            .collect();
        let (integers, _) = integer_multiple(&flat);
        integers
            .chunks(width)
            .map(|chunk| Univariate::new(chunk.to_vec()))
            .collect()
    }
}

type Interval = (Rational, Rational);

/// The coordinates that belong to a root; the root is refined until they are known well enough.
fn enclose(
    factor: &Univariate,
    functions: &[Univariate],
    root: RealRoot,
    bits: u64,
    budget: &Budget,
) -> Result<Vec<Interval>, Stop> {
    let root = rational_root(factor, root);
    let mut digits = bits + 16;
    let mut root = factor.refine(&root, digits);
    let width = Rational::new(BigInt::one(), BigInt::one() << bits);
    loop {
        budget.spend(digits * functions.len() as u64 * factor.degree() as u64)?;
        if let Some(coordinates) = coordinates(functions, &root)
            && coordinates.iter().all(|(low, high)| high - low <= width)
        {
            return Ok(coordinates);
        }
        digits += digits / 2 + 32;
        root = factor.refine(&root, digits);
    }
}

/// The root of a linear polynomial is rational.
fn rational_root(factor: &Univariate, root: RealRoot) -> RealRoot {
    match factor.coefficients() {
        [constant, slope] => {
            let value = Rational::new(-constant, slope.clone());
            RealRoot {
                low: value.clone(),
                high: value,
            }
        }
        _ => root,
    }
}

/// The quotients where the denominator is not zero in the whole interval.
fn coordinates(functions: &[Univariate], root: &RealRoot) -> Option<Vec<Interval>> {
    let (denominator, numerators) = functions.split_first()?;
    let below = range(denominator, root);
    if below.0 <= Rational::zero() && below.1 >= Rational::zero() {
        return None;
    }
    let reciprocal = (below.1.recip(), below.0.recip());
    Some(
        numerators
            .iter()
            .map(|numerator| times(&range(numerator, root), &reciprocal))
            .collect(),
    )
}

/// An enclosure of the values of a polynomial on an interval, by Horner's scheme.
fn range(polynomial: &Univariate, root: &RealRoot) -> Interval {
    let argument = (root.low.clone(), root.high.clone());
    polynomial
        .coefficients()
        .iter()
        .rev()
        .fold((Rational::zero(), Rational::zero()), |value, c| {
            let product = times(&value, &argument);
            (product.0 + c, product.1 + c)
        })
}

fn times(a: &Interval, b: &Interval) -> Interval {
    let products = [&a.0 * &b.0, &a.0 * &b.1, &a.1 * &b.0, &a.1 * &b.1];
    let [first, rest @ ..] = products;
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
