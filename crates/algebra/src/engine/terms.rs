//! Polynomials in the order of a computation, and the ways to and from [`Polynomial`].

use super::budget::Stop;
use super::order::MonomialOrder;
use crate::polynomial::{Polynomial, Rational};
use groebner::Zp;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use polycore::lehmer::gcd;
use polycore::{Monomial, Order, Poly};

/// The terms of a polynomial, largest monomial first, no coefficient zero.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Terms<C> {
    pub(super) monomials: Vec<Box<[u16]>>,
    pub(super) coefficients: Vec<C>,
}

impl<C: Clone> Terms<C> {
    /// From distinct monomials in any order.
    pub(super) fn sorted(mut terms: Vec<(Box<[u16]>, C)>, order: &MonomialOrder) -> Self {
        terms.sort_by(|(a, _), (b, _)| order.compare(b, a));
        let (monomials, coefficients) = terms.into_iter().unzip();
        Self {
            monomials,
            coefficients,
        }
    }

    /// Sorted in another order; with it where each term was before.
    pub(super) fn reordered(&self, order: &MonomialOrder) -> (Self, Vec<u32>) {
        let mut places: Vec<u32> = (0..self.monomials.len() as u32).collect();
        let monomial = |place: u32| &*self.monomials[place as usize];
        places.sort_by(|&a, &b| order.compare(monomial(b), monomial(a)));
        let sorted = Self {
            monomials: places.iter().map(|&i| monomial(i).into()).collect(),
            coefficients: places
                .iter()
                .map(|&i| self.coefficients[i as usize].clone())
                .collect(),
        };
        (sorted, places)
    }

    pub(super) fn lead(&self) -> Option<&[u16]> {
        self.monomials.first().map(|m| &**m)
    }

    pub(super) fn is_zero(&self) -> bool {
        self.monomials.is_empty()
    }
}

/// Exponents as they are stored; larger ones than 65535 do not fit.
pub(super) fn exponents(exponents: &[u32]) -> Result<Box<[u16]>, Stop> {
    exponents
        .iter()
        .map(|&e| u16::try_from(e).map_err(|_| Stop::Memory))
        .collect()
}

impl Terms<Rational> {
    pub(super) fn of(polynomial: &Polynomial, order: &MonomialOrder) -> Result<Self, Stop> {
        let terms: Result<Vec<_>, Stop> = polynomial
            .raw()
            .terms
            .iter()
            .map(|(monomial, c)| Ok((exponents(monomial.exps())?, c.clone())))
            .collect();
        Ok(Self::sorted(terms?, order))
    }

    pub(super) fn polynomial(&self, variables: usize) -> Polynomial {
        let monomial = |m: &[u16]| {
            let exponents: Vec<u32> = m.iter().map(|&e| u32::from(e)).collect();
            Monomial::new(exponents)
        };
        let terms = self.monomials.iter().zip(&self.coefficients);
        let terms = terms.map(|(m, c)| (monomial(m), c.clone())).collect();
        Polynomial::from_raw(&Poly::new(terms, variables, Order::GRevLex))
    }

    /// Divided by the leading coefficient.
    pub(super) fn monic(&self) -> Self {
        let Some(lead) = self.coefficients.first() else {
            return self.clone();
        };
        Self {
            monomials: self.monomials.clone(),
            coefficients: self.coefficients.iter().map(|c| c / lead).collect(),
        }
    }

    /// A monic polynomial with coprime integer coefficients, the first one in degrevlex positive.
    pub(super) fn primitive(&self) -> Self {
        let mut common = BigInt::one();
        for c in &self.coefficients {
            let denominator = c.denom();
            if !(&common % denominator).is_zero() {
                let shared = BigInt::from(gcd(common.magnitude(), denominator.magnitude()));
                common = common / shared * denominator;
            }
        }
        // Nothing divides all of the numerators: the leading coefficient is the common denominator, and every power of a prime
        // in that is also in the denominator of some coefficient.
        let degrevlex = |a: &usize, b: &usize| {
            MonomialOrder::Degrevlex.compare(&self.monomials[*a], &self.monomials[*b])
        };
        let first = (0..self.monomials.len()).max_by(degrevlex);
        if first.is_some_and(|i| self.coefficients[i].is_negative()) {
            common = -common;
        }
        let integer = |c: &Rational| Rational::from_integer(&common / c.denom() * c.numer());
        Self {
            monomials: self.monomials.clone(),
            coefficients: self.coefficients.iter().map(integer).collect(),
        }
    }

    /// The coefficients modulo a prime, zeros included; `None` where the prime divides a denominator or the leading
    /// coefficient.
    pub(super) fn residues(&self, prime: u64) -> Option<Vec<Zp>> {
        let residues: Vec<Zp> = self
            .coefficients
            .iter()
            .map(|c| Zp::from_rational(c, prime))
            .collect::<Option<_>>()?;
        let keeps_lead = residues.first().is_none_or(|lead| !lead.is_zero());
        keeps_lead.then_some(residues)
    }

    /// The polynomial modulo a prime, under the same condition.
    pub(super) fn modulo(&self, prime: u64) -> Option<Terms<Zp>> {
        Some(Terms::without_zeros(&self.monomials, self.residues(prime)?))
    }
}

impl Terms<Zp> {
    pub(super) fn without_zeros(monomials: &[Box<[u16]>], coefficients: Vec<Zp>) -> Self {
        let terms = monomials.iter().zip(coefficients);
        let (monomials, coefficients) = terms
            .filter(|(_, c)| !c.is_zero())
            .map(|(m, c)| (m.clone(), c))
            .unzip();
        Self {
            monomials,
            coefficients,
        }
    }
}
