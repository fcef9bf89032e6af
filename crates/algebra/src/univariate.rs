//! Polynomials in one variable with integer coefficients, dense.
//!
//! Questions about many variables end here: the coordinates of finitely many points are roots of such polynomials, and
//! whether a surface falls apart is asked on a line that meets it. Everything is exact; gcds go through primes because
//! Euclid's algorithm over the rationals lets the coefficients grow.

mod gcd;
pub(super) mod residues;
mod roots;

pub use roots::RealRoot;
pub(super) use roots::to_f64;

use super::polynomial::{Polynomial, Rational};
use num_bigint::{BigInt, Sign};
use num_traits::{One, Signed, Zero};
use polycore::lehmer;
use std::ops::{Add, Mul, Neg, Sub};

/// A dense polynomial in one variable with rational coefficients, for divisions with remainder.
pub(super) type Dense = polycore::Uni<Rational>;

/// A polynomial in one variable with integer coefficients, by ascending power, without trailing zeros.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Univariate(Vec<BigInt>);

impl Univariate {
    /// From coefficients by ascending power.
    #[must_use]
    pub fn new(mut coefficients: Vec<BigInt>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    /// From small coefficients by ascending power.
    #[must_use]
    pub fn from_integers(coefficients: &[i64]) -> Self {
        Self::new(coefficients.iter().map(|&c| c.into()).collect())
    }

    /// The primitive polynomial with the same roots as one with rational coefficients by ascending power.
    #[must_use]
    pub fn from_rationals(coefficients: &[Rational]) -> Self {
        Self::new(integer_multiple(coefficients).0).primitive()
    }

    /// A polynomial of several variables in which only one occurs, made primitive; `None` where another one occurs.
    #[must_use]
    pub fn from_polynomial(polynomial: &Polynomial, variable: usize) -> Option<Self> {
        let mut coefficients = vec![Rational::zero(); polynomial.degree_in(variable) as usize + 1];
        for (exponents, coefficient) in polynomial.terms() {
            let alone = exponents
                .iter()
                .enumerate()
                .all(|(i, &e)| i == variable || e == 0);
            if !alone {
                return None;
            }
            coefficients[exponents[variable] as usize] = coefficient.clone();
        }
        Some(Self::from_rationals(&coefficients))
    }

    /// This polynomial of something else: the value where the variable is `argument`.
    #[must_use]
    pub fn of(&self, argument: &Polynomial) -> Polynomial {
        let variables = argument.variables();
        self.0
            .iter()
            .rev()
            .fold(Polynomial::zero(variables), |sum, c| {
                let constant = Polynomial::constant(Rational::from_integer(c.clone()), variables);
                &(&sum * argument) + &constant
            })
    }

    /// The coefficients by ascending power; none for zero.
    #[must_use]
    pub fn coefficients(&self) -> &[BigInt] {
        &self.0
    }

    /// Whether this is the zero polynomial.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The degree; 0 for the zero polynomial.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }

    /// The leading coefficient; 0 for the zero polynomial.
    #[must_use]
    pub fn leading(&self) -> BigInt {
        self.0.last().cloned().unwrap_or_default()
    }

    /// Multiplied by an integer.
    #[must_use]
    pub fn scaled(&self, factor: &BigInt) -> Self {
        Self::new(self.0.iter().map(|c| c * factor).collect())
    }

    /// The derivative.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Self::new(terms.map(|(i, c)| c * BigInt::from(i)).collect())
    }

    /// The greatest common divisor of the coefficients, not negative.
    #[must_use]
    pub fn content(&self) -> BigInt {
        self.0.iter().fold(BigInt::zero(), |gcd, c| {
            if gcd.is_one() {
                gcd
            } else {
                integer_gcd(&gcd, c)
            }
        })
    }

    /// With coprime coefficients, the leading one positive.
    #[must_use]
    pub fn primitive(&self) -> Self {
        let mut content = self.content();
        if content.is_zero() {
            return Self::default();
        }
        if self.leading().is_negative() {
            content = -content;
        }
        Self(self.0.iter().map(|c| c / &content).collect())
    }

    /// Value at a rational.
    #[must_use]
    pub fn value_at(&self, x: &Rational) -> Rational {
        let (numerator, denominator) = (x.numer(), x.denom());
        let mut scale = BigInt::one();
        let mut sum = BigInt::zero();
        for c in self.0.iter().rev() {
            sum = sum * numerator + c * &scale;
            scale *= denominator;
        }
        if self.is_zero() {
            return Rational::zero();
        }
        fraction(sum, &(scale / denominator))
    }

    /// The sign of the value at a rational: -1, 0 or 1.
    #[must_use]
    pub fn sign_at(&self, x: &Rational) -> i8 {
        let (numerator, denominator) = (x.numer(), x.denom());
        let mut scale = BigInt::one();
        let mut sum = BigInt::zero();
        for c in self.0.iter().rev() {
            sum = sum * numerator + c * &scale;
            scale *= denominator;
        }
        match sum.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        }
    }

    /// The quotient where the divisor divides without remainder in integers.
    #[must_use]
    pub fn divided_by(&self, divisor: &Self) -> Option<Self> {
        let (head, tail) = divisor.0.split_last()?;
        if self.is_zero() {
            return Some(Self::default());
        }
        if self.0.len() < divisor.0.len() {
            return None;
        }
        let mut rest = self.0.clone();
        let mut quotient = vec![BigInt::zero(); rest.len() - tail.len()];
        for i in (0..quotient.len()).rev() {
            let top = &rest[i + tail.len()];
            let q = top / head;
            if &(&q * head) != top {
                return None;
            }
            for (r, c) in rest[i..].iter_mut().zip(tail) {
                *r -= &q * c;
            }
            quotient[i] = q;
        }
        rest[..tail.len()]
            .iter()
            .all(Zero::is_zero)
            .then(|| Self::new(quotient))
    }

    /// The remainder by a divisor of this polynomial times a power of the divisor's leading coefficient: one with the
    /// exponent `steps`, which is at least the number of steps of the division.
    pub(super) fn pseudo_remainder(&self, divisor: &Self, steps: usize) -> Self {
        let head = divisor.leading();
        let mut rest = self.0.clone();
        let mut taken = 0;
        while rest.len() >= divisor.0.len() && taken < steps {
            let Some(top) = rest.pop() else { break };
            let place = rest.len() + 1 - divisor.0.len();
            for value in &mut rest {
                *value *= &head;
            }
            for (value, c) in rest[place..].iter_mut().zip(&divisor.0) {
                *value -= &top * c;
            }
            taken += 1;
        }
        let missing = (taken..steps).fold(BigInt::one(), |power, _| power * &head);
        Self::new(rest.into_iter().map(|value| value * &missing).collect())
    }

    /// As text: `2*x^2 - 3`.
    #[must_use]
    pub fn text(&self, name: &str) -> String {
        Dense::new(self.rationals())
            .to_polynomial()
            .text(&[name.to_owned()])
    }

    /// The coefficients as rationals.
    pub(super) fn rationals(&self) -> Vec<Rational> {
        self.0.iter().cloned().map(Rational::from_integer).collect()
    }
}

/// Dense polynomials as sparse ones of one variable.
trait ToPolynomial {
    fn to_polynomial(&self) -> Polynomial;
}

impl ToPolynomial for Dense {
    fn to_polynomial(&self) -> Polynomial {
        let terms = self.0.iter().enumerate();
        Polynomial::from_terms(terms.map(|(i, c)| (vec![i as u32], c.clone())).collect(), 1)
    }
}

/// The greatest common divisor of two integers, not negative: Lehmer's algorithm, many times faster than that of the type.
pub(super) fn integer_gcd(a: &BigInt, b: &BigInt) -> BigInt {
    lehmer::gcd(a.magnitude(), b.magnitude()).into()
}

/// The quotient of two integers in lowest terms; the second is not zero.
pub(super) fn fraction(numerator: BigInt, denominator: &BigInt) -> Rational {
    let numerator = if denominator.is_negative() {
        -numerator
    } else {
        numerator
    };
    lehmer::fraction(numerator, denominator.magnitude())
}

/// An integer over a power of two, in lowest terms.
pub(super) fn dyadic(numerator: BigInt, exponent: u64) -> Rational {
    let twos = numerator.trailing_zeros().unwrap_or(exponent).min(exponent);
    Rational::new_raw(numerator >> twos, BigInt::one() << (exponent - twos))
}

/// Rationals times their smallest common denominator, and that denominator.
pub(super) fn integer_multiple(values: &[Rational]) -> (Vec<BigInt>, BigInt) {
    let mut denominator = BigInt::one();
    for value in values {
        if !(&denominator % value.denom()).is_zero() {
            let common = integer_gcd(&denominator, value.denom());
            denominator *= value.denom() / common;
        }
    }
    let integers = values
        .iter()
        .map(|value| value.numer() * (&denominator / value.denom()))
        .collect();
    (integers, denominator)
}

impl Add for &Univariate {
    type Output = Univariate;
    fn add(self, other: Self) -> Univariate {
        let (mut long, short) = if self.0.len() < other.0.len() {
            (other.0.clone(), &self.0)
        } else {
            (self.0.clone(), &other.0)
        };
        for (a, b) in long.iter_mut().zip(short) {
            *a += b;
        }
        Univariate::new(long)
    }
}

impl Neg for &Univariate {
    type Output = Univariate;
    fn neg(self) -> Univariate {
        Univariate(self.0.iter().map(|c| -c).collect())
    }
}

impl Sub for &Univariate {
    type Output = Univariate;
    fn sub(self, other: Self) -> Univariate {
        self + &-other
    }
}

impl Mul for &Univariate {
    type Output = Univariate;
    fn mul(self, other: Self) -> Univariate {
        if self.is_zero() || other.is_zero() {
            return Univariate::default();
        }
        let mut product = vec![BigInt::zero(); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        Univariate::new(product)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_signs_and_text() {
        let p = Univariate::from_integers(&[-3, 0, 2]);
        let half = Rational::new(1.into(), 2.into());
        assert_eq!(p.value_at(&half), Rational::new((-5).into(), 2.into()));
        assert_eq!(p.sign_at(&half), -1);
        assert_eq!(p.text("x"), "2*x^2 - 3");
        assert_eq!(Univariate::default().value_at(&half), Rational::zero());
    }

    #[test]
    fn division_is_exact_or_refused() {
        let p = Univariate::from_integers(&[-1, 0, 1]);
        let q = Univariate::from_integers(&[1, 1]);
        assert_eq!(p.divided_by(&q), Some(Univariate::from_integers(&[-1, 1])));
        assert_eq!(p.divided_by(&Univariate::from_integers(&[0, 1])), None);
        assert_eq!(p.divided_by(&Univariate::from_integers(&[0, 0, 2])), None);
        assert_eq!(q.divided_by(&p), None);
    }

    #[test]
    fn rationals_lose_their_common_factor() {
        let third = Rational::new((-2).into(), 3.into());
        let p = Univariate::from_rationals(&[Rational::from_integer(4.into()), third]);
        assert_eq!(p, Univariate::from_integers(&[-6, 1]));
        let (values, denominator) = integer_multiple(&[
            Rational::new(1.into(), 4.into()),
            Rational::new(1.into(), 6.into()),
        ]);
        assert_eq!((values, denominator), (vec![3.into(), 2.into()], 12.into()));
    }
}
