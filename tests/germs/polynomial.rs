//! Polynomials in a few variables with exact coefficients.

use kutzbach::number::Number;
use std::collections::BTreeMap;
use std::ops::{Add, Mul};

/// Coefficients by exponents; no zeros.
#[derive(Clone)]
pub struct Polynomial {
    pub variables: usize,
    pub terms: BTreeMap<Vec<usize>, Number>,
}

impl Polynomial {
    /// `Σ coefficient · x^exponents`.
    pub fn of(variables: usize, terms: &[(&[usize], Number)]) -> Self {
        let each = |(exponents, c): &(&[usize], Number)| Self {
            variables,
            terms: BTreeMap::from([(exponents.to_vec(), c.clone())]),
        };
        let zero = Self {
            variables,
            terms: BTreeMap::new(),
        };
        terms.iter().map(each).fold(zero, |sum, term| sum + term)
    }

    /// A sum of variables with whole factors.
    pub fn linear(factors: &[i64]) -> Self {
        let unit =
            |i: usize| -> Vec<usize> { (0..factors.len()).map(|j| usize::from(i == j)).collect() };
        let terms: Vec<(Vec<usize>, Number)> = factors
            .iter()
            .enumerate()
            .map(|(i, c)| (unit(i), Number::integer(*c)))
            .collect();
        let terms: Vec<(&[usize], Number)> =
            terms.iter().map(|(e, c)| (&e[..], c.clone())).collect();
        Self::of(factors.len(), &terms)
    }

    pub fn constant(variables: usize, value: Number) -> Self {
        Self::of(variables, &[(&vec![0; variables], value)])
    }

    pub fn power(&self, exponent: usize) -> Self {
        let one = Self::constant(self.variables, Number::one());
        (0..exponent).fold(one, |product, _| product * self.clone())
    }

    /// The polynomial of other polynomials.
    pub fn at(&self, inner: &[Self]) -> Self {
        let variables = inner[0].variables;
        let zero = Self::of(variables, &[]);
        self.terms.iter().fold(zero, |sum, (exponents, c)| {
            let one = Self::constant(variables, c.clone());
            let factors = exponents.iter().zip(inner);
            sum + factors.fold(one, |product, (e, x)| product * x.power(*e))
        })
    }

    pub fn scaled(&self, factor: &Number) -> Self {
        Self::constant(self.variables, factor.clone()) * self.clone()
    }
}

impl Add for Polynomial {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        for (exponents, c) in other.terms {
            let sum = match self.terms.get(&exponents) {
                Some(own) => own + &c,
                None => c,
            };
            if sum.is_zero() {
                self.terms.remove(&exponents);
            } else {
                self.terms.insert(exponents, sum);
            }
        }
        self
    }
}

impl Mul for Polynomial {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let zero = Self::of(self.variables, &[]);
        let pairs = self
            .terms
            .iter()
            .flat_map(|a| other.terms.iter().map(move |b| (a, b)));
        pairs.fold(zero, |sum, ((a, c), (b, d))| {
            let exponents: Vec<usize> = a.iter().zip(b).map(|(a, b)| a + b).collect();
            sum + Self::of(self.variables, &[(&exponents, c * d)])
        })
    }
}
