//! Polynomials in a system's variables with coefficients in a field.

use super::element::{Element, Exponents, product, trim};
use super::field::Field;
use std::collections::BTreeMap;

/// A sparse polynomial; exponents without zeros at the end.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Poly(BTreeMap<Exponents, Element>);

impl Poly {
    pub(super) fn constant(value: Element) -> Self {
        let mut terms = BTreeMap::new();
        if !value.is_zero() {
            terms.insert(Vec::new(), value);
        }
        Self(terms)
    }

    pub(super) fn variable(index: usize) -> Self {
        let mut exponents = vec![0; index + 1];
        exponents[index] = 1;
        Self(BTreeMap::from([(exponents, Element::integer(1))]))
    }

    pub(super) fn terms(&self) -> impl ExactSizeIterator<Item = (&Exponents, &Element)> {
        self.0.iter()
    }

    fn add_term(&mut self, exponents: Exponents, coefficient: Element) {
        let sum = match self.0.remove(&exponents) {
            Some(old) => old.plus(&coefficient),
            None => coefficient,
        };
        if !sum.is_zero() {
            self.0.insert(exponents, sum);
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
        let mut difference = self.clone();
        for (exponents, coefficient) in &other.0 {
            difference.add_term(exponents.clone(), coefficient.negated());
        }
        difference
    }

    pub(super) fn times(&self, other: &Self, field: &Field) -> Self {
        let mut result = Self::default();
        for (x, a) in &self.0 {
            for (y, b) in &other.0 {
                result.add_term(product(x, y), field.multiply(a, b));
            }
        }
        result
    }

    pub(super) fn scaled(&self, factor: &Element, field: &Field) -> Self {
        let mut result = Self::default();
        for (x, a) in &self.0 {
            result.add_term(x.clone(), field.multiply(a, factor));
        }
        result
    }

    /// Squares of a sine by the circle: s² = (1 − c²)/|a|².
    pub(super) fn with_square(&self, sine: usize, square: &Self, field: &Field) -> Self {
        let mut result = self.clone();
        loop {
            let high = result
                .0
                .iter()
                .find(|(e, _)| e.get(sine).is_some_and(|e| *e >= 2))
                .map(|(e, c)| (e.clone(), c.clone()));
            let Some((exponents, coefficient)) = high else {
                return result;
            };
            result.0.remove(&exponents);
            let mut rest = exponents;
            rest[sine] -= 2;
            trim(&mut rest);
            let monomial = Self(BTreeMap::from([(rest, coefficient)]));
            result = result.plus(&monomial.times(square, field));
        }
    }
}
