//! Elements of a number field as polynomials in its generators.

use super::fraction::{Fraction, lcm, size, to_f64};
use dashu_base::Gcd;
use dashu_int::UBig;
use std::collections::BTreeMap;

/// Exponents of the generators, without zeros at the end, so that a field may grow under its elements.
pub(super) type Exponents = Vec<u16>;

/// A polynomial in the generators of a [`Field`](super::field::Field). Reduced by it, equal elements look equal.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Element(pub(super) BTreeMap<Exponents, Fraction>);

impl Element {
    pub(super) fn zero() -> Self {
        Self::default()
    }

    pub(super) fn rational(value: Fraction) -> Self {
        let mut terms = BTreeMap::new();
        if !value.is_zero() {
            terms.insert(Vec::new(), value);
        }
        Self(terms)
    }

    pub(super) fn integer(value: i64) -> Self {
        Self::rational(Fraction::from(value))
    }

    /// The generator with this index.
    pub(super) fn generator(index: usize) -> Self {
        let mut exponents = vec![0; index + 1];
        exponents[index] = 1;
        Self(BTreeMap::from([(exponents, Fraction::ONE)]))
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The value of an element in which no generator occurs.
    pub(super) fn as_rational(&self) -> Option<Fraction> {
        match self.0.len() {
            0 => Some(Fraction::ZERO),
            1 => self.0.get(&Vec::new()).cloned(),
            _ => None,
        }
    }

    /// Number of generators up to the last one that occurs.
    pub(super) fn level(&self) -> usize {
        self.0.keys().map(Vec::len).max().unwrap_or(0)
    }

    pub(super) fn scaled(&self, factor: &Fraction) -> Self {
        if factor.is_zero() {
            return Self::zero();
        }
        Self(
            self.0
                .iter()
                .map(|(e, c)| (e.clone(), c * factor))
                .collect(),
        )
    }

    pub(super) fn negated(&self) -> Self {
        Self(
            self.0
                .iter()
                .map(|(e, c)| (e.clone(), -c.clone()))
                .collect(),
        )
    }

    /// Adds a multiple of a monomial.
    pub(super) fn add_term(&mut self, exponents: Exponents, coefficient: Fraction) {
        if coefficient.is_zero() {
            return;
        }
        match self.0.entry(exponents) {
            std::collections::btree_map::Entry::Vacant(place) => {
                place.insert(coefficient);
            }
            std::collections::btree_map::Entry::Occupied(mut place) => {
                *place.get_mut() += coefficient;
                if place.get().is_zero() {
                    place.remove();
                }
            }
        }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        let (mut sum, rest) = if self.0.len() >= other.0.len() {
            (self.clone(), other)
        } else {
            (other.clone(), self)
        };
        for (exponents, coefficient) in &rest.0 {
            sum.add_term(exponents.clone(), coefficient.clone());
        }
        sum
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    /// Coefficients by the power of one generator.
    pub(super) fn by_power(&self, generator: usize) -> Vec<Self> {
        let mut parts: Vec<Self> = Vec::new();
        for (exponents, coefficient) in &self.0 {
            let power = usize::from(exponents.get(generator).copied().unwrap_or(0));
            if parts.len() <= power {
                parts.resize(power + 1, Self::zero());
            }
            let mut rest = exponents.clone();
            if let Some(exponent) = rest.get_mut(generator) {
                *exponent = 0;
            }
            trim(&mut rest);
            parts[power].add_term(rest, coefficient.clone());
        }
        parts
    }

    /// Whether a generator occurs.
    pub(super) fn mentions(&self, generator: usize) -> bool {
        self.0
            .keys()
            .any(|exponents| exponents.get(generator).is_some_and(|e| *e > 0))
    }

    /// The least common multiple of the denominators, at least 1.
    pub(super) fn denominator(&self) -> UBig {
        self.0
            .values()
            .fold(UBig::ONE, |all, c| lcm(&all, c.denominator()))
    }

    /// The greatest common divisor of integral coefficients; 0 for zero.
    pub(super) fn content(&self) -> UBig {
        self.0.values().fold(UBig::ZERO, |all, c| {
            let c = size(c);
            if all == UBig::ZERO { c } else { all.gcd(&c) }
        })
    }

    /// The value where every generator has one, in doubles.
    pub(super) fn approximate(&self, generators: &[f64]) -> f64 {
        self.0
            .iter()
            .map(|(exponents, coefficient)| {
                exponents
                    .iter()
                    .zip(generators)
                    .fold(to_f64(coefficient), |product, (e, x)| {
                        product * x.powi(i32::from(*e))
                    })
            })
            .sum()
    }
}

pub(super) fn trim(exponents: &mut Exponents) {
    while exponents.last() == Some(&0) {
        exponents.pop();
    }
}

/// Exponents of a product.
pub(super) fn product(a: &[u16], b: &[u16]) -> Exponents {
    let (long, short) = if a.len() >= b.len() { (a, b) } else { (b, a) };
    let mut sum = long.to_vec();
    for (x, y) in sum.iter_mut().zip(short) {
        *x += y;
    }
    sum
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn parts_by_power_add_up() {
        let x = Element::generator(1);
        let y = Element::generator(0);
        let sum = x.plus(&y.scaled(&Fraction::from(3)));
        let parts = sum.by_power(1);
        assert_eq!(parts.len(), 2);
        assert_eq!(parts[1], Element::integer(1));
        assert!(parts[0].mentions(0) && !parts[0].mentions(1));
        assert_eq!(sum.minus(&sum), Element::zero());
        assert_eq!(sum.level(), 2);
    }
}
