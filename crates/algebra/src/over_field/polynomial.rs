//! Polynomials over a number field.

use crate::system::{FieldElement, NumberField};
use std::collections::BTreeMap;

/// A sparse polynomial with coefficients in a [`NumberField`]; exponents by unknown, without zeros at the end.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct FieldPolynomial(BTreeMap<Vec<u8>, FieldElement>);

impl FieldPolynomial {
    /// A constant.
    #[must_use]
    pub fn constant(value: FieldElement) -> Self {
        let mut terms = BTreeMap::new();
        if !value.is_zero() {
            terms.insert(Vec::new(), value);
        }
        Self(terms)
    }

    /// An unknown.
    #[must_use]
    pub fn unknown(index: usize) -> Self {
        let mut exponents = vec![0; index + 1];
        exponents[index] = 1;
        Self(BTreeMap::from([(exponents, FieldElement::integer(1))]))
    }

    /// Exponents and coefficients.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&[u8], &FieldElement)> {
        self.0.iter().map(|(e, c)| (e.as_slice(), c))
    }

    /// Whether this is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether no unknown occurs.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.0.keys().all(Vec::is_empty)
    }

    /// Largest total degree of a term.
    #[must_use]
    pub fn degree(&self) -> usize {
        let degree = |e: &Vec<u8>| e.iter().map(|&e| usize::from(e)).sum();
        self.0.keys().map(degree).max().unwrap_or(0)
    }

    fn add_term(&mut self, exponents: Vec<u8>, coefficient: &FieldElement) {
        let sum = match self.0.remove(&exponents) {
            Some(old) => old.plus(coefficient),
            None => coefficient.clone(),
        };
        if !sum.is_zero() {
            self.0.insert(exponents, sum);
        }
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        for (e, c) in &other.0 {
            sum.add_term(e.clone(), c);
        }
        sum
    }

    /// The difference.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        let zero = FieldElement::default();
        for (e, c) in &other.0 {
            sum.add_term(e.clone(), &zero.minus(c));
        }
        sum
    }

    /// The product.
    #[must_use]
    pub fn times(&self, other: &Self, field: &NumberField) -> Self {
        let mut result = Self::default();
        for (x, a) in &self.0 {
            for (y, b) in &other.0 {
                let (long, short) = if x.len() >= y.len() { (x, y) } else { (y, x) };
                let mut exponents = long.clone();
                for (e, more) in exponents.iter_mut().zip(short) {
                    *e += more;
                }
                result.add_term(exponents, &field.times(a, b));
            }
        }
        result
    }

    /// Times a constant.
    #[must_use]
    pub fn scaled(&self, factor: &FieldElement, field: &NumberField) -> Self {
        let mut result = Self::default();
        for (e, c) in &self.0 {
            result.add_term(e.clone(), &field.times(c, factor));
        }
        result
    }
}
