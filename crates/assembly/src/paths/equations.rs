//! Polynomials with their derivatives, in complex numbers and in boxes of them.

use super::boxes::Region;
use super::complex::{Arithmetic, Complex};
use crate::real::Interval;
use kutzbach_algebra::{Polynomial, Rational};
use num_traits::{Signed, ToPrimitive, Zero};

/// A term: its coefficient, also enclosed, and the variables with their powers.
struct Term {
    near: f64,
    enclosed: Interval,
    factors: Vec<(usize, u32)>,
}

/// As many polynomials as variables, the largest coefficient of each being 1.
pub(super) struct Equations {
    rows: Vec<Vec<Term>>,
    degree: u32,
}

/// Values and slopes, row by row.
pub(super) struct Values<T> {
    pub(super) values: Vec<T>,
    pub(super) slopes: Vec<Vec<T>>,
}

/// What a coefficient may be off by when it is written as a double, in parts of it: some units in the last place. It is checked.
const OFF: f64 = 8.0 * f64::EPSILON;

impl Equations {
    /// `None` where coefficients are out of range.
    pub(super) fn of(polynomials: &[Polynomial]) -> Option<Self> {
        let degree = polynomials.iter().map(Polynomial::degree).max()?;
        let rows = polynomials.iter().map(row).collect::<Option<_>>()?;
        Some(Self { rows, degree })
    }

    pub(super) fn count(&self) -> usize {
        self.rows.len()
    }

    pub(super) fn terms(&self) -> usize {
        self.rows.iter().map(Vec::len).sum()
    }

    pub(super) fn at(&self, x: &[Complex]) -> Values<Complex> {
        self.evaluated(x, |term| Complex::new(term.near, 0.0))
    }

    pub(super) fn on(&self, x: &[Region]) -> Values<Region> {
        self.evaluated(x, |term| Region::real(term.enclosed))
    }

    fn evaluated<T: Arithmetic>(&self, x: &[T], coefficient: impl Fn(&Term) -> T) -> Values<T> {
        let count = self.count();
        let zero = T::integer(0);
        let powers: Vec<Vec<T>> = x
            .iter()
            .map(|&x| {
                let mut all = vec![T::integer(1)];
                for k in 0..self.degree as usize {
                    all.push(all[k].times(x));
                }
                all
            })
            .collect();
        let mut values = vec![zero; count];
        let mut slopes = vec![vec![zero; count]; count];
        for (r, row) in self.rows.iter().enumerate() {
            for term in row {
                let c = coefficient(term);
                let mut value = c;
                for &(v, e) in &term.factors {
                    value = value.times(powers[v][e as usize]);
                    let mut slope = c.times(T::integer(e)).times(powers[v][e as usize - 1]);
                    for &(w, f) in term.factors.iter().filter(|(w, _)| *w != v) {
                        slope = slope.times(powers[w][f as usize]);
                    }
                    slopes[r][v] = slopes[r][v].plus(slope);
                }
                values[r] = values[r].plus(value);
            }
        }
        Values { values, slopes }
    }
}

fn row(polynomial: &Polynomial) -> Option<Vec<Term>> {
    let largest = polynomial
        .terms()
        .map(|(_, c)| c.abs())
        .fold(Rational::zero(), |m, c| if c > m { c } else { m });
    if largest.is_zero() {
        return None;
    }
    let term = |(exponents, c): (&[u32], &Rational)| {
        let value = c / &largest;
        let near = value.to_f64()?;
        let written = Rational::from_float(near)?;
        let most = written.abs() * Rational::from_float(OFF)?;
        let factors = exponents.iter().enumerate().filter(|(_, e)| **e > 0);
        // A coefficient too small for a double is not one that can be enclosed in parts of it.
        ((&value - &written).abs() <= most).then(|| Term {
            near,
            enclosed: Interval::about(near, near.abs() * (2.0 * OFF)),
            factors: factors.map(|(v, &e)| (v, e)).collect(),
        })
    };
    polynomial.terms().map(term).collect()
}
