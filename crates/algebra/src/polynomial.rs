//! Sparse polynomials with rational coefficients.

use num_rational::BigRational;
use num_traits::{One, Zero};
use polycore::{Monomial, Order, Poly};
use std::ops::{Add, Mul, Neg, Sub};

/// A rational number of any size.
pub type Rational = BigRational;

/// A polynomial over the rationals in a fixed number of variables, which are named by their index.
///
/// Operators take references. Both operands must have the same number of variables; a polynomial is never made without
/// saying how many there are, so a mismatch is a defect of the caller (the operators then panic).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polynomial(Poly<Rational>);

impl Polynomial {
    /// Zero in a ring of `variables` variables.
    #[must_use]
    pub fn zero(variables: usize) -> Self {
        Self(Poly::zero(variables, Order::GRevLex))
    }

    /// One in a ring of `variables` variables.
    #[must_use]
    pub fn one(variables: usize) -> Self {
        Self::constant(Rational::one(), variables)
    }

    /// A constant in a ring of `variables` variables.
    #[must_use]
    pub fn constant(value: Rational, variables: usize) -> Self {
        if value.is_zero() {
            return Self::zero(variables);
        }
        Self(Poly::constant(value, variables, Order::GRevLex))
    }

    /// An integer constant in a ring of `variables` variables.
    #[must_use]
    pub fn integer(value: i64, variables: usize) -> Self {
        Self::constant(Rational::from_integer(value.into()), variables)
    }

    /// The variable with this index in a ring of `variables` variables.
    #[must_use]
    pub fn variable(index: usize, variables: usize) -> Self {
        Self(Poly::var(index, variables, Order::GRevLex))
    }

    /// A polynomial from its terms: exponents (one per variable) and coefficient. Like terms are added.
    #[must_use]
    pub fn from_terms(terms: Vec<(Vec<u32>, Rational)>, variables: usize) -> Self {
        let terms = terms
            .into_iter()
            .map(|(exponents, coefficient)| (Monomial::new(exponents), coefficient))
            .collect();
        Self(Poly::new(terms, variables, Order::GRevLex))
    }

    /// The terms: exponents (one per variable) and coefficient, largest first in degrevlex.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&[u32], &Rational)> {
        self.0.terms.iter().map(|(m, c)| (m.exps(), c))
    }

    /// Number of variables of the ring.
    #[must_use]
    pub fn variables(&self) -> usize {
        self.0.nvars
    }

    /// Whether this is the zero polynomial.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.is_zero()
    }

    /// The value of a constant polynomial, zero included; `None` where a variable occurs.
    #[must_use]
    pub fn as_constant(&self) -> Option<Rational> {
        if self.is_zero() {
            return Some(Rational::zero());
        }
        self.0.is_constant().then(|| self.0.terms[0].1.clone())
    }

    /// The largest total degree of a term; 0 for the zero polynomial.
    #[must_use]
    pub fn degree(&self) -> u32 {
        self.0.total_degree()
    }

    /// The largest exponent of one variable.
    #[must_use]
    pub fn degree_in(&self, variable: usize) -> u32 {
        self.0.degree(variable)
    }

    /// Whether a variable occurs.
    #[must_use]
    pub fn mentions(&self, variable: usize) -> bool {
        self.degree_in(variable) > 0
    }

    /// This polynomial to a power.
    #[must_use]
    pub fn power(&self, exponent: u32) -> Self {
        Self(self.0.pow(exponent))
    }

    /// Multiplied by a rational.
    #[must_use]
    pub fn scaled(&self, factor: &Rational) -> Self {
        Self(self.0.scale(factor))
    }

    /// The partial derivative in one variable.
    #[must_use]
    pub fn derivative(&self, variable: usize) -> Self {
        Self(self.0.derivative(variable))
    }

    /// Value at a rational point, one coordinate per variable.
    #[must_use]
    pub fn value_at(&self, point: &[Rational]) -> Rational {
        self.0.eval(point)
    }

    /// A polynomial in place of every variable; all of them in one ring, which becomes the ring of the result.
    #[must_use]
    pub fn substitute(&self, replacements: &[Self]) -> Self {
        let variables = replacements
            .first()
            .map_or(self.variables(), Polynomial::variables);
        let mut sum = Self::zero(variables);
        for (exponents, coefficient) in self.terms() {
            let mut term = Self::constant(coefficient.clone(), variables);
            for (replacement, &exponent) in replacements.iter().zip(exponents) {
                if exponent > 0 {
                    term = &term * &replacement.power(exponent);
                }
            }
            sum = &sum + &term;
        }
        sum
    }

    /// The same polynomial in another ring: variable `i` becomes variable `places[i]` of `variables`.
    #[must_use]
    pub fn moved(&self, places: &[usize], variables: usize) -> Self {
        let terms = self
            .terms()
            .map(|(exponents, coefficient)| {
                let mut moved = vec![0; variables];
                for (&place, &exponent) in places.iter().zip(exponents) {
                    moved[place] += exponent;
                }
                (moved, coefficient.clone())
            })
            .collect();
        Self::from_terms(terms, variables)
    }

    /// With coprime integer coefficients, the first one (in degrevlex) positive.
    #[must_use]
    pub fn primitive(&self) -> Self {
        if self.is_zero() {
            return self.clone();
        }
        let primitive = self.0.primitive();
        let negative = primitive.lc().is_some_and(|c| *c < Rational::zero());
        if negative {
            Self(-&primitive)
        } else {
            Self(primitive)
        }
    }

    /// The quotient where the divisor divides without remainder.
    #[must_use]
    pub fn divided_by(&self, divisor: &Self) -> Option<Self> {
        self.0.exact(&divisor.0).map(Self)
    }

    /// As text, with the names of the variables: `2*x^2*y - 1/3`.
    #[must_use]
    pub fn text(&self, names: &[String]) -> String {
        if self.is_zero() {
            return "0".to_owned();
        }
        let mut text = String::new();
        for (exponents, coefficient) in self.terms() {
            let negative = *coefficient < Rational::zero();
            let size = if negative {
                -coefficient
            } else {
                coefficient.clone()
            };
            text.push_str(match (text.is_empty(), negative) {
                (true, false) => "",
                (true, true) => "-",
                (false, false) => " + ",
                (false, true) => " - ",
            });
            let factors: Vec<String> = exponents
                .iter()
                .zip(names)
                .filter(|&(&exponent, _)| exponent > 0)
                .map(|(&exponent, name)| match exponent {
                    1 => name.clone(),
                    _ => format!("{name}^{exponent}"),
                })
                .collect();
            if factors.is_empty() {
                text.push_str(&size.to_string());
            } else {
                if !size.is_one() {
                    text.push_str(&format!("{size}*"));
                }
                text.push_str(&factors.join("*"));
            }
        }
        text
    }

    pub(super) fn raw(&self) -> &Poly<Rational> {
        &self.0
    }

    pub(super) fn from_raw(raw: &Poly<Rational>) -> Self {
        Self(raw.reorder(Order::GRevLex))
    }
}

impl Add for &Polynomial {
    type Output = Polynomial;
    fn add(self, other: Self) -> Polynomial {
        Polynomial(&self.0 + &other.0)
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;
    fn sub(self, other: Self) -> Polynomial {
        Polynomial(&self.0 - &other.0)
    }
}

impl Mul for &Polynomial {
    type Output = Polynomial;
    fn mul(self, other: Self) -> Polynomial {
        Polynomial(&self.0 * &other.0)
    }
}

impl Neg for &Polynomial {
    type Output = Polynomial;
    fn neg(self) -> Polynomial {
        Polynomial(-&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_reads_like_a_formula() {
        let names = ["x".to_owned(), "y".to_owned()];
        let (x, y) = (Polynomial::variable(0, 2), Polynomial::variable(1, 2));
        let third = Rational::new((-1).into(), 3.into());
        let p = &(&(&x * &x) * &y).scaled(&Rational::from_integer(2.into()))
            + &Polynomial::constant(third, 2);
        assert_eq!(p.text(&names), "2*x^2*y - 1/3");
        assert_eq!((&x - &x).text(&names), "0");
        assert_eq!((-&x).text(&names), "-x");
    }

    #[test]
    fn substitution_is_evaluation() {
        let (x, y) = (Polynomial::variable(0, 2), Polynomial::variable(1, 2));
        let p = &(&x * &x) - &y;
        let swapped = p.substitute(&[y.clone(), x.clone()]);
        assert_eq!(swapped, &(&y * &y) - &x);
        let three = Rational::from_integer(3.into());
        assert_eq!(
            p.value_at(&[three.clone(), three.clone()]),
            Rational::from_integer(6.into())
        );
        assert_eq!(p.moved(&[2, 0], 3).variables(), 3);
    }

    #[test]
    fn primitive_parts_have_coprime_integers_and_a_positive_head() {
        let x = Polynomial::variable(0, 1);
        let p = &x.scaled(&Rational::new((-4).into(), 3.into())) + &Polynomial::integer(2, 1);
        assert_eq!(p.primitive().text(&["x".to_owned()]), "2*x - 3");
        let square = &p * &p;
        assert_eq!(square.divided_by(&p), Some(p.clone()));
        assert_eq!(square.divided_by(&(&x + &Polynomial::one(1))), None);
    }
}
