//! Factors on a line lifted to factors in the space around it, as power series in the distances from the line.
//!
//! Linear Hensel lifting with the distances in the role of the prime (Musser 1975). All polynomials are monic in t, the
//! parameter along the line; that holds after a change of coordinates, so no leading coefficients have to be guessed.

use crate::engine::{Budget, Stop};
use crate::polynomial::{Polynomial, Rational};
use crate::univariate::Dense;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// A polynomial in t for every monomial in the distances. Zero polynomials are left out.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Series {
    parts: BTreeMap<Vec<u32>, Dense>,
}

fn order_of(monomial: &[u32]) -> u32 {
    monomial.iter().sum()
}

impl Series {
    /// Of a polynomial in t (the variable `pivot`) and the distances (all others).
    pub(super) fn of(polynomial: &Polynomial, pivot: usize) -> Self {
        let mut parts: BTreeMap<Vec<u32>, Vec<Rational>> = BTreeMap::new();
        for (exponents, coefficient) in polynomial.terms() {
            let mut distances = exponents.to_vec();
            let power = std::mem::take(&mut distances[pivot]) as usize;
            let part = parts.entry(distances).or_default();
            if part.len() <= power {
                part.resize(power + 1, Rational::zero());
            }
            part[power] = coefficient.clone();
        }
        Self {
            parts: parts
                .into_iter()
                .map(|(m, part)| (m, Dense::new(part)))
                .collect(),
        }
    }

    /// As a polynomial with t in the place of the pivot.
    pub(super) fn polynomial(&self, pivot: usize, variables: usize) -> Polynomial {
        let mut terms = Vec::new();
        for (monomial, part) in &self.parts {
            for (power, coefficient) in part.0.iter().enumerate() {
                let mut exponents = monomial.clone();
                exponents[pivot] = power as u32;
                terms.push((exponents, coefficient.clone()));
            }
        }
        Polynomial::from_terms(terms, variables)
    }

    fn on_line(part: Dense, variables: usize) -> Self {
        Self {
            parts: BTreeMap::from([(vec![0; variables], part)]),
        }
    }

    fn add(&mut self, monomial: &[u32], part: &Dense) {
        let sum = match self.parts.get(monomial) {
            Some(old) => old + part,
            None => part.clone(),
        };
        if sum.is_zero() {
            self.parts.remove(monomial);
        } else {
            self.parts.insert(monomial.to_vec(), sum);
        }
    }

    /// The product up to an order in the distances.
    pub(super) fn product(&self, other: &Self, order: u32) -> Self {
        let mut product = Self {
            parts: BTreeMap::new(),
        };
        for (m, a) in &self.parts {
            for (n, b) in &other.parts {
                if order_of(m) + order_of(n) <= order {
                    let monomial: Vec<u32> = m.iter().zip(n).map(|(x, y)| x + y).collect();
                    product.add(&monomial, &(a * b));
                }
            }
        }
        product
    }

    /// The power up to an order in the distances.
    pub(super) fn power(&self, exponent: u32, order: u32) -> Self {
        (1..exponent).fold(self.clone(), |p, _| p.product(self, order))
    }

    /// Without the terms above an order in the distances.
    pub(super) fn truncated(&self, order: u32) -> Self {
        let kept = self.parts.iter().filter(|(m, _)| order_of(m) <= order);
        Self {
            parts: kept.map(|(m, part)| (m.clone(), part.clone())).collect(),
        }
    }
}

/// Lifts monic, pairwise coprime factors on the line up to an order in the distances.
pub(super) fn lift_all(
    whole: &Series,
    factors: &[Dense],
    variables: usize,
    order: u32,
    budget: &Budget,
) -> Result<Vec<Series>, Stop> {
    let mut lifted = Vec::new();
    let mut rest = whole.truncated(order);
    for (i, factor) in factors.iter().enumerate() {
        if i + 1 == factors.len() {
            lifted.push(rest);
            break;
        }
        let others = factors[i + 1..]
            .iter()
            .fold(Dense::constant(Rational::one()), |p, f| &p * f);
        let (this, remaining) = lift_two(&rest, factor, &others, variables, order, budget)?;
        lifted.push(this);
        rest = remaining;
    }
    Ok(lifted)
}

/// Lifts two coprime monic factors.
///
/// With s·g + u·h = 1 on the line, what is missing at a monomial, e, is made up for by the remainder of u·e modulo g in the
/// first factor; the second gets the quotient that is left.
fn lift_two(
    whole: &Series,
    g: &Dense,
    h: &Dense,
    variables: usize,
    order: u32,
    budget: &Budget,
) -> Result<(Series, Series), Stop> {
    let (_, u, _) = g.bezout(h);
    let mut first = Series::on_line(g.clone(), variables);
    let mut second = Series::on_line(h.clone(), variables);
    let size = ((g.deg() + 1) * (h.deg() + 1)) as u64;
    for level in 1..=order {
        // Products of terms of lower order that land in this level.
        let mut missing = Series {
            parts: BTreeMap::new(),
        };
        for (m, part) in &whole.parts {
            if order_of(m) == level {
                missing.add(m, part);
            }
        }
        for (m, a) in &first.parts {
            for (n, b) in &second.parts {
                if order_of(m) + order_of(n) == level {
                    budget.multiply(size)?;
                    let monomial: Vec<u32> = m.iter().zip(n).map(|(x, y)| x + y).collect();
                    missing.add(&monomial, &-&(a * b));
                }
            }
        }
        for (monomial, e) in missing.parts {
            budget.multiply(size)?;
            let correction = &(&u * &e) % g;
            let rest = &(&e - &(&correction * h)) / g;
            first.add(&monomial, &correction);
            second.add(&monomial, &rest);
        }
    }
    Ok((first, second))
}

/// The monic polynomial whose power is a given one, if there is one: its coefficients in t from the highest down.
pub(super) fn root(whole: &Series, exponent: u32, variables: usize, order: u32) -> Option<Series> {
    if exponent == 1 {
        return Some(whole.clone());
    }
    let on_line = vec![0; variables];
    let degree = whole.parts.get(&on_line)?.deg();
    if !degree.is_multiple_of(exponent as usize) {
        return None;
    }
    let root_degree = degree / exponent as usize;
    let mut top = vec![Rational::zero(); root_degree + 1];
    top[root_degree] = Rational::one();
    let mut root = Series::on_line(Dense::new(top), variables);
    let divisor = Rational::from_integer(exponent.into());
    for place in (0..root_degree).rev() {
        // The coefficient of t^(degree - root_degree + place) in the power is exponent·root[place] + known ones.
        let power = root.power(exponent, order);
        let target = degree - root_degree + place;
        let mut monomials: Vec<&Vec<u32>> = whole.parts.keys().chain(power.parts.keys()).collect();
        monomials.sort();
        monomials.dedup();
        let mut corrections = Vec::new();
        for monomial in monomials {
            let at = |series: &Series| {
                let part = series.parts.get(monomial);
                part.and_then(|p| p.0.get(target).cloned())
                    .unwrap_or_else(Rational::zero)
            };
            let value = (at(whole) - at(&power)) / &divisor;
            if !value.is_zero() {
                let mut part = vec![Rational::zero(); place + 1];
                part[place] = value;
                corrections.push((monomial.clone(), Dense::new(part)));
            }
        }
        for (monomial, part) in corrections {
            root.add(&monomial, &part);
        }
    }
    (root.power(exponent, order) == whole.truncated(order)).then_some(root)
}
