//! The polynomials modulo an ideal with finitely many zeros: a finite-dimensional vector space, in which multiplication by a
//! variable is a matrix (Stetter 1996; Cox, Little and O'Shea, "Using Algebraic Geometry", chapter 2).

use crate::engine::{Budget, Stop};
use crate::polynomial::{Polynomial, Rational};
use crate::univariate::{fraction, integer_gcd, integer_multiple};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::collections::{BTreeMap, BTreeSet};

/// A vector of rationals: integers over one positive denominator, in lowest terms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Scaled {
    pub(super) values: Vec<BigInt>,
    pub(super) denominator: BigInt,
}

impl Scaled {
    fn new(values: Vec<BigInt>, denominator: BigInt) -> Self {
        let mut common = denominator.clone();
        for value in &values {
            if common.is_one() {
                break;
            }
            common = integer_gcd(&common, value);
        }
        if denominator.is_negative() {
            common = -common;
        }
        Self {
            values: values.into_iter().map(|v| v / &common).collect(),
            denominator: denominator / common,
        }
    }

    /// Of rationals.
    pub(super) fn of(values: &[Rational]) -> Self {
        let (values, denominator) = integer_multiple(values);
        Self {
            values,
            denominator,
        }
    }

    fn unit(index: usize, length: usize) -> Self {
        let mut values = vec![BigInt::zero(); length];
        values[index] = BigInt::one();
        Self {
            values,
            denominator: BigInt::one(),
        }
    }

    /// The sum of the products with another vector's entries.
    pub(super) fn dot(&self, other: &Self) -> Rational {
        let sum = self
            .values
            .iter()
            .zip(&other.values)
            .filter(|(a, b)| !a.is_zero() && !b.is_zero())
            .map(|(a, b)| a * b)
            .sum();
        fraction(sum, &(&self.denominator * &other.denominator))
    }
}

/// A variable times a standard monomial.
#[derive(Clone, Debug)]
pub(super) enum Column {
    /// Again a standard monomial.
    Standard(usize),
    /// A combination of them.
    Combination(Scaled),
}

/// The space of remainders modulo an ideal with finitely many zeros.
#[derive(Clone, Debug)]
pub(super) struct Quotient {
    /// The standard monomials, 1 first (none where the equations contradict one another).
    pub(super) monomials: Vec<Vec<u32>>,
    /// For every variable, its products with the standard monomials.
    pub(super) tables: Vec<Vec<Column>>,
}

impl Quotient {
    /// Modulo the ideal of a reduced Groebner basis with the given leading monomials; `None` where there are infinitely many
    /// zeros.
    pub(super) fn new(
        polynomials: &[Polynomial],
        heads: &[Vec<u32>],
        variables: usize,
        budget: &Budget,
    ) -> Result<Option<Self>, Stop> {
        let Some(monomials) = standard_monomials(heads, variables, budget)? else {
            return Ok(None);
        };
        let places: BTreeMap<&[u32], usize> = monomials
            .iter()
            .enumerate()
            .map(|(i, m)| (m.as_slice(), i))
            .collect();
        let mut border: BTreeMap<Vec<u32>, Scaled> = BTreeMap::new();
        for (polynomial, head) in polynomials.iter().zip(heads) {
            let mut remainder = vec![Rational::zero(); monomials.len()];
            let mut lead = Rational::one();
            for (exponents, coefficient) in polynomial.terms() {
                if exponents == head.as_slice() {
                    lead = -coefficient;
                } else if let Some(&place) = places.get(exponents) {
                    remainder[place] = coefficient.clone();
                }
            }
            let values: Vec<Rational> = remainder.into_iter().map(|c| c / &lead).collect();
            border.insert(head.clone(), Scaled::of(&values));
        }
        let quotient = Self {
            tables: Vec::new(),
            monomials: monomials.clone(),
        };
        let tables = quotient.fill_border(border, &places, variables, budget)?;
        Ok(Some(Self { monomials, tables }))
    }

    /// The products that are neither standard nor heads of the basis follow from smaller ones (Faugère, Gianni, Lazard and
    /// Mora 1993): such a product is a variable times another product that is not standard.
    fn fill_border(
        &self,
        mut known: BTreeMap<Vec<u32>, Scaled>,
        places: &BTreeMap<&[u32], usize>,
        variables: usize,
        budget: &Budget,
    ) -> Result<Vec<Vec<Column>>, Stop> {
        let mut waiting: BTreeSet<Vec<u32>> = BTreeSet::new();
        for monomial in &self.monomials {
            for variable in 0..variables {
                let product = raised(monomial, variable);
                if !places.contains_key(product.as_slice()) && !known.contains_key(&product) {
                    waiting.insert(product);
                }
            }
        }
        // Each pass finds at least the smallest of those that are left.
        while !waiting.is_empty() {
            let before = waiting.len();
            let mut later = BTreeSet::new();
            for product in waiting {
                match self.border_product(&product, &known, places, budget)? {
                    Some(value) => {
                        known.insert(product, value);
                    }
                    None => {
                        later.insert(product);
                    }
                }
            }
            waiting = later;
            if waiting.len() == before {
                return Err(Stop::Coefficients);
            }
        }
        let column = |monomial: &Vec<u32>, variable| {
            let product = raised(monomial, variable);
            match places.get(product.as_slice()) {
                Some(&place) => Column::Standard(place),
                None => Column::Combination(known[&product].clone()),
            }
        };
        Ok((0..variables)
            .map(|variable| self.monomials.iter().map(|m| column(m, variable)).collect())
            .collect())
    }

    fn border_product(
        &self,
        product: &[u32],
        known: &BTreeMap<Vec<u32>, Scaled>,
        places: &BTreeMap<&[u32], usize>,
        budget: &Budget,
    ) -> Result<Option<Scaled>, Stop> {
        for variable in 0..product.len() {
            if product[variable] == 0 {
                continue;
            }
            let mut smaller = product.to_vec();
            smaller[variable] -= 1;
            let Some(value) = known.get(&smaller) else {
                continue;
            };
            let mut parts = Vec::new();
            let mut all_known = true;
            for (c, monomial) in value.values.iter().zip(&self.monomials) {
                if c.is_zero() {
                    continue;
                }
                let next = raised(monomial, variable);
                if let Some(&place) = places.get(next.as_slice()) {
                    parts.push((c, Column::Standard(place)));
                } else if let Some(combination) = known.get(&next) {
                    parts.push((c, Column::Combination(combination.clone())));
                } else {
                    all_known = false;
                    break;
                }
            }
            if all_known {
                let parts: Vec<(&BigInt, &Column)> = parts.iter().map(|(c, p)| (*c, p)).collect();
                return self
                    .combination(&parts, &value.denominator, budget)
                    .map(Some);
            }
        }
        Ok(None)
    }

    /// Dimension of the space: the number of zeros with their multiplicities.
    pub(super) fn dimension(&self) -> usize {
        self.monomials.len()
    }

    fn combination(
        &self,
        parts: &[(&BigInt, &Column)],
        denominator: &BigInt,
        budget: &Budget,
    ) -> Result<Scaled, Stop> {
        let mut common = BigInt::one();
        for (_, column) in parts {
            if let Column::Combination(vector) = column
                && !(&common % &vector.denominator).is_zero()
            {
                let shared = integer_gcd(&common, &vector.denominator);
                common *= &vector.denominator / shared;
            }
        }
        let mut values = vec![BigInt::zero(); self.dimension()];
        for (c, column) in parts {
            match column {
                Column::Standard(place) => values[*place] += *c * &common,
                Column::Combination(vector) => {
                    budget.multiply(words(c) * words(&vector.denominator) * values.len() as u64)?;
                    let factor = *c * (&common / &vector.denominator);
                    for (value, v) in values.iter_mut().zip(&vector.values) {
                        if !v.is_zero() {
                            *value += &factor * v;
                        }
                    }
                }
            }
        }
        Ok(Scaled::new(values, common * denominator))
    }

    /// A variable times an element.
    pub(super) fn times(
        &self,
        variable: usize,
        element: &Scaled,
        budget: &Budget,
    ) -> Result<Scaled, Stop> {
        let parts: Vec<(&BigInt, &Column)> = element
            .values
            .iter()
            .zip(&self.tables[variable])
            .filter(|(c, _)| !c.is_zero())
            .collect();
        self.combination(&parts, &element.denominator, budget)
    }

    /// All products of two standard monomials.
    pub(super) fn products(&self, budget: &Budget) -> Result<Products, Stop> {
        let mut products: BTreeMap<Vec<u32>, Scaled> = self
            .monomials
            .iter()
            .enumerate()
            .map(|(i, m)| (m.clone(), Scaled::unit(i, self.dimension())))
            .collect();
        // By degree: a product of degree d + 1 is a variable times one of degree d.
        let mut by_degree: BTreeMap<u32, BTreeMap<Vec<u32>, usize>> = BTreeMap::new();
        for (i, a) in self.monomials.iter().enumerate() {
            for b in &self.monomials[i..] {
                let product: Vec<u32> = a.iter().zip(b).map(|(x, y)| x + y).collect();
                if let Some(variable) = b.iter().position(|&e| e > 0)
                    && !products.contains_key(&product)
                {
                    let degree = product.iter().sum();
                    let level: &mut BTreeMap<_, _> = by_degree.entry(degree).or_default();
                    level.entry(product).or_insert(variable);
                }
            }
        }
        for (product, variable) in by_degree.into_values().flatten() {
            let mut smaller = product.clone();
            smaller[variable] -= 1;
            let value = self.times(variable, &products[&smaller], budget)?;
            products.insert(product, value);
        }
        Ok(Products(products))
    }
}

/// Size of an integer in words: what a multiplication by it costs.
pub(super) fn words(value: &BigInt) -> u64 {
    value.bits() / 64 + 1
}

fn raised(monomial: &[u32], variable: usize) -> Vec<u32> {
    let mut product = monomial.to_vec();
    product[variable] += 1;
    product
}

/// The monomials that no head divides, by degree; `None` where there are infinitely many.
fn standard_monomials(
    heads: &[Vec<u32>],
    variables: usize,
    budget: &Budget,
) -> Result<Option<Vec<Vec<u32>>>, Stop> {
    let divides = |head: &[u32], m: &[u32]| head.iter().zip(m).all(|(a, b)| a <= b);
    let finite = (0..variables).all(|variable| {
        heads.iter().any(|head| {
            head.iter()
                .enumerate()
                .all(|(i, &exponent)| i == variable || exponent == 0)
        })
    });
    if !finite {
        return Ok(None);
    }
    let mut monomials = Vec::new();
    let mut level = BTreeSet::from([vec![0; variables]]);
    while !level.is_empty() {
        budget.multiply((level.len() * heads.len()) as u64)?;
        level.retain(|m| !heads.iter().any(|head| divides(head, m)));
        monomials.extend(level.iter().cloned());
        level = level
            .iter()
            .flat_map(|m| (0..variables).map(|variable| raised(m, variable)))
            .collect();
    }
    Ok(Some(monomials))
}

/// Products of two standard monomials, in the space of remainders.
pub(super) struct Products(BTreeMap<Vec<u32>, Scaled>);

impl Products {
    /// The product of two standard monomials.
    pub(super) fn of(&self, a: &[u32], b: &[u32]) -> &Scaled {
        let product: Vec<u32> = a.iter().zip(b).map(|(x, y)| x + y).collect();
        &self.0[&product]
    }
}
