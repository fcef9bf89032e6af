//! The polynomial in one variable alone that the equations imply.
//!
//! A variable is locked where there is one: it can take finitely many values only. The coefficients come from the normal
//! forms of 1, v, v², ... modulo primes. If these are independent modulo one prime, they are independent over the
//! rationals; so a prime can show that there is no such polynomial of a degree, and the largest degree found is the true
//! one. That the polynomial lies in the ideal is then checked over the rationals.

use super::basis::GroebnerBasis;
use super::budget::{Budget, Stop};
use super::f4::{normal_forms, reduced_basis};
use super::terms::Terms;
use crate::polynomial::{Polynomial, Rational};
use groebner::Zp;
use num_bigint::BigInt;
use num_traits::{One, Zero};
use polycore::Primes;
use polycore::crt::{WangContext, try_garner};
use std::collections::BTreeMap;

/// Largest degree that is tried where the ideal does not bound it.
const MOST_DEGREE: usize = 16;
/// The value taken by lot, negated.
const BY_LOT: i64 = -1_234_567_890_123_457;
/// Matrix entries spent on whether a variable takes any value.
const LITTLE_WORK: u64 = 1_000_000;
/// Most primes before the coefficients count as too large.
const MOST_PRIMES: usize = 500;

impl GroebnerBasis {
    /// The polynomial of least degree in one variable alone that is a combination of the equations, primitive.
    ///
    /// `None`: there is none, or none of degree up to 16; where the equations have finitely many solutions, all degrees up
    /// to their number are tried. A contradiction gives 1.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn univariate_in(
        &self,
        variable: usize,
        budget: &Budget,
    ) -> Result<Option<Polynomial>, Stop> {
        let alone = |lead: &[u32]| {
            lead.iter()
                .enumerate()
                .all(|(v, &e)| v == variable || e == 0)
        };
        if !self.leading_monomials().any(alone) {
            // Its leading monomial would be a power of the variable, and so would one of these.
            return Ok(None);
        }
        let solutions = match self.dimension() {
            Some(0) => self.degree(),
            _ if self.takes_any_value(variable, budget)? => return Ok(None),
            _ => None,
        };
        let most = solutions.unwrap_or(MOST_DEGREE);
        let mut primes = Primes::new();
        let mut coefficients: Vec<BigInt> = Vec::new();
        let mut modulus = BigInt::one();
        let mut count = 0_usize;
        for _ in 0..MOST_PRIMES {
            let Some(prime) = primes.next() else { break };
            let Some(basis) = self.modulo(prime) else {
                continue;
            };
            let Some(relation) = self.relation(&basis, variable, prime, most, budget)? else {
                return Ok(None);
            };
            if relation.len() < coefficients.len() {
                continue;
            }
            if relation.len() > coefficients.len() {
                coefficients = vec![BigInt::zero(); relation.len()];
                modulus = BigInt::one();
                count = 0;
            }
            try_garner(&mut coefficients, &mut modulus, &relation, prime)
                .map_err(|_| Stop::Coefficients)?;
            count += 1;
            if count.is_power_of_two() || count.is_multiple_of(8) {
                let values = WangContext::new(&modulus)
                    .and_then(|context| context.reconstruct_many(&coefficients));
                let candidate = values.map(|values| self.in_one_variable(&values, variable));
                if let Some(candidate) = candidate
                    && self.normal_form_within(&candidate, budget)?.is_zero()
                {
                    return Ok(Some(candidate.primitive()));
                }
            }
        }
        Err(Stop::Coefficients)
    }

    /// Whether there are solutions modulo a prime where the variable has a value taken by lot: it is then no root of any
    /// polynomial of the ideal, unless chance hit one of its few values. What takes long to tell is not told.
    fn takes_any_value(&self, variable: usize, budget: &Budget) -> Result<bool, Stop> {
        let found = Primes::new().find_map(|prime| Some((prime, self.modulo(prime)?)));
        let Some((prime, mut equations)) = found else {
            return Ok(false);
        };
        let mut exponents = vec![0; self.variables()];
        let constant = exponents.clone();
        exponents[variable] = 1;
        equations.push(Terms {
            monomials: vec![exponents.into(), constant.into()],
            coefficients: vec![Zp::from_i64(1, prime), Zp::from_i64(BY_LOT, prime)],
        });
        let little = budget.with_work(LITTLE_WORK);
        let basis = reduced_basis(
            &equations,
            self.variables(),
            self.order(),
            None,
            false,
            &little,
        );
        budget.take_over(&little);
        match basis {
            Ok((basis, _)) => {
                let is_one =
                    |p: &Terms<Zp>| p.lead().is_some_and(|lead| lead.iter().all(|&e| e == 0));
                Ok(!basis.iter().any(is_one))
            }
            Err(Stop::Work) => budget.check().map(|()| false),
            Err(stop) => Err(stop),
        }
    }

    fn in_one_variable(&self, coefficients: &[Rational], variable: usize) -> Polynomial {
        let terms = coefficients.iter().enumerate().map(|(power, c)| {
            let mut exponents = vec![0; self.variables()];
            exponents[variable] = power as u32;
            (exponents, c.clone())
        });
        Polynomial::from_terms(terms.collect(), self.variables())
    }

    /// The monic relation of least degree between the powers of a variable modulo a prime, constant coefficient first.
    fn relation(
        &self,
        basis: &[Terms<Zp>],
        variable: usize,
        prime: u64,
        most: usize,
        budget: &Budget,
    ) -> Result<Option<Vec<u64>>, Stop> {
        let mut power = Terms {
            monomials: vec![vec![0; self.variables()].into()],
            coefficients: vec![Zp::from_i64(1, prime)],
        };
        let mut known = Dependence::default();
        for degree in 0..=most {
            let reduced = normal_forms(&[power], basis, self.variables(), self.order(), budget)?;
            let Some(mut rest) = reduced.into_iter().next() else {
                return Ok(None);
            };
            if let Some(relation) = known.add(&rest, degree, prime) {
                return Ok(Some(relation));
            }
            for monomial in &mut rest.monomials {
                let exponent = &mut monomial[variable];
                *exponent = exponent.checked_add(1).ok_or(Stop::Memory)?;
            }
            power = Terms::sorted(
                rest.monomials.into_iter().zip(rest.coefficients).collect(),
                self.order(),
            );
        }
        Ok(None)
    }
}

/// Vectors in echelon form, each with the combination of the powers that it is.
#[derive(Default)]
struct Dependence {
    columns: BTreeMap<Box<[u16]>, usize>,
    /// Leading column, entries by column, combination by power.
    rows: Vec<(usize, Vec<Zp>, Vec<Zp>)>,
}

impl Dependence {
    /// Adds the next power; a relation where it depends on the ones before.
    fn add(&mut self, power: &Terms<Zp>, degree: usize, prime: u64) -> Option<Vec<u64>> {
        let zero = Zp::from_i64(0, prime);
        for monomial in &power.monomials {
            let next = self.columns.len();
            self.columns.entry(monomial.clone()).or_insert(next);
        }
        let mut vector = vec![zero; self.columns.len()];
        for (monomial, &c) in power.monomials.iter().zip(&power.coefficients) {
            vector[self.columns[monomial]] = c;
        }
        let mut combination = vec![zero; degree + 1];
        combination[degree] = Zp::from_i64(1, prime);
        for (lead, entries, powers) in &self.rows {
            let factor = vector[*lead];
            if factor.is_zero() {
                continue;
            }
            for (a, &b) in vector.iter_mut().zip(entries) {
                *a = *a - factor * b;
            }
            for (a, &b) in combination.iter_mut().zip(powers) {
                *a = *a - factor * b;
            }
        }
        let Some(lead) = vector.iter().position(|c| !c.is_zero()) else {
            return Some(combination.iter().map(|c| c.value()).collect());
        };
        let inverse = Zp::from_i64(1, prime) / vector[lead];
        for c in vector.iter_mut().chain(&mut combination) {
            *c = *c * inverse;
        }
        self.rows.push((lead, vector, combination));
        None
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::engine::testing::{names, parse};
    use crate::{MonomialOrder, groebner_basis};

    fn locked(equations: &[&str], variable: usize) -> Option<String> {
        let equations: Vec<Polynomial> = equations.iter().map(|text| parse(text)).collect();
        let budget = Budget::unlimited();
        let basis = groebner_basis(&equations, 3, &MonomialOrder::Degrevlex, &budget).unwrap();
        let found = basis.univariate_in(variable, &budget).unwrap();
        found.map(|p| p.text(&names()))
    }

    #[test]
    fn values_of_a_locked_variable() {
        // Two circles that meet in two points of the same x.
        let circles = ["x^2 + y^2 - 1", "(x - 1)^2 + y^2 - 1"];
        assert_eq!(locked(&circles, 0).as_deref(), Some("2*x - 1"));
        assert_eq!(locked(&circles, 1).as_deref(), Some("4*y^2 - 3"));
        assert_eq!(locked(&circles, 2), None);
    }

    #[test]
    fn a_power_among_the_leading_monomials_does_not_lock() {
        // x² is a leading monomial, but x takes all values.
        assert_eq!(locked(&["x^2 - y*z", "y - z"], 0), None);
        assert_eq!(locked(&["x^2 + y^2 - 1"], 0), None);
        assert_eq!(locked(&["x^2 + y^2 - 1", "y^2 - 2*y*z + z^2"], 0), None);
    }

    #[test]
    fn a_contradiction_locks_everything() {
        assert_eq!(locked(&["x", "x - 1"], 1).as_deref(), Some("1"));
    }

    #[test]
    fn large_coefficients_need_several_primes() {
        let text = "123456789012345678901*x^3 - 98765432109876543210987*x + 7";
        let found = locked(&[text, "y - x^2", "z - y^2"], 0);
        assert_eq!(found.as_deref(), Some(text));
    }
}
