//! Groebner bases over the rationals.

use super::budget::{Budget, Limits, Stop};
use super::certificate::Certificate;
use super::dimension::Supports;
use super::f4::{normal_forms, reduced_basis};
use super::hilbert::{HilbertSeries, small};
use super::modular::rational_basis;
use super::order::MonomialOrder;
use super::terms::Terms;
use crate::algebra::polynomial::{Polynomial, Rational};
use groebner::Zp;

/// Monomials handled before the degree of an ideal counts as too costly.
const DEGREE_WORK: u64 = 20_000_000;

/// A reduced Groebner basis: every polynomial primitive, no term of one divisible by the leading monomial of another.
#[derive(Clone, Debug)]
pub struct GroebnerBasis {
    order: MonomialOrder,
    variables: usize,
    monic: Vec<Terms<Rational>>,
    leads: Vec<Vec<u32>>,
    polynomials: Vec<Polynomial>,
    certificate: Certificate,
}

/// The reduced basis of the ideal of some equations in a ring of `variables` variables.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn groebner_basis(
    equations: &[Polynomial],
    variables: usize,
    order: &MonomialOrder,
    budget: &Budget,
) -> Result<GroebnerBasis, Stop> {
    let (monic, certificate) = rational_basis(equations, variables, order, budget)?;
    let polynomials = monic
        .iter()
        .map(|p| p.polynomial(variables).primitive())
        .collect();
    let leads = monic.iter().filter_map(Terms::lead);
    Ok(GroebnerBasis {
        order: order.clone(),
        variables,
        leads: leads
            .map(|m| m.iter().map(|&e| u32::from(e)).collect())
            .collect(),
        monic,
        polynomials,
        certificate,
    })
}

impl GroebnerBasis {
    /// The polynomials, smallest leading monomial first, with coprime integer coefficients.
    #[must_use]
    pub fn polynomials(&self) -> &[Polynomial] {
        &self.polynomials
    }

    /// The order.
    #[must_use]
    pub fn order(&self) -> &MonomialOrder {
        &self.order
    }

    /// Number of variables of the ring.
    #[must_use]
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// What was checked.
    #[must_use]
    pub fn certificate(&self) -> &Certificate {
        &self.certificate
    }

    /// The exponents of the leading monomials, in the order of [`Self::polynomials`].
    pub fn leading_monomials(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        self.leads.iter().map(Vec::as_slice)
    }

    /// Whether the equations contradict one another: no solution, not even a complex one.
    #[must_use]
    pub fn is_inconsistent(&self) -> bool {
        self.leads.iter().any(|lead| lead.iter().all(|&e| e == 0))
    }

    /// The dimension of the complex solution set; `None` where there is no solution.
    #[must_use]
    pub fn dimension(&self) -> Option<usize> {
        self.supports().dimension()
    }

    /// Sets of variables that can be chosen freely almost everywhere on some part of highest dimension, as the leading
    /// monomials show them: every one as large as the dimension, at most `limit` of them, in lexicographic order.
    #[must_use]
    pub fn independent_sets(&self, limit: usize) -> Vec<Vec<usize>> {
        self.supports().independent_sets(limit)
    }

    /// Whether a variable belongs to some set of [`Self::independent_sets`]. Another monomial order may show others: `false`
    /// does not mean that the variable is locked, for that see [`Self::univariate_in`].
    #[must_use]
    pub fn is_free(&self, variable: usize) -> bool {
        variable < self.variables && self.supports().is_free(variable)
    }

    fn supports(&self) -> Supports {
        Supports::new(self.leading_monomials(), self.variables)
    }

    /// The Hilbert series of the affine solution set; `None` where there is no solution, or where neither the order compares
    /// degrees first nor the solutions are finitely many.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn hilbert(&self, budget: &Budget) -> Result<Option<HilbertSeries>, Stop> {
        if !self.order.is_graded() && self.dimension() != Some(0) {
            return Ok(None);
        }
        HilbertSeries::of(self.leads.clone(), self.variables, budget)
    }

    /// The degree of the part of highest dimension, multiplicities counted; in dimension 0 the number of complex solutions
    /// with multiplicity. `None` where [`Self::hilbert`] has none or would take more than some seconds.
    #[must_use]
    pub fn degree(&self) -> Option<usize> {
        let budget = Budget::new(Limits {
            work: Some(DEGREE_WORK),
            ..Limits::default()
        });
        let series = self.hilbert(&budget).ok().flatten()?;
        small(&series.degree())
    }

    /// The polynomials modulo a prime, monic; `None` where the prime divides a denominator.
    pub(super) fn modulo(&self, prime: u64) -> Option<Vec<Terms<Zp>>> {
        self.monic.iter().map(|p| p.modulo(prime)).collect()
    }

    /// What remains of a polynomial modulo the ideal: no term is a multiple of a leading monomial.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn normal_form_within(
        &self,
        polynomial: &Polynomial,
        budget: &Budget,
    ) -> Result<Polynomial, Stop> {
        let polynomial = [Terms::of(polynomial, &self.order)?];
        let rest = normal_forms(
            &polynomial,
            &self.monic,
            self.variables,
            &self.order,
            budget,
        )?;
        let zero = Polynomial::zero(self.variables);
        Ok(rest
            .first()
            .map_or(zero, |rest| rest.polynomial(self.variables)))
    }

    /// [`Self::normal_form_within`] without a limit: for polynomials of the degree of the equations, where it takes less time
    /// than the basis did.
    #[must_use]
    pub fn normal_form(&self, polynomial: &Polynomial) -> Polynomial {
        self.normal_form_within(polynomial, &Budget::unlimited())
            .unwrap_or_else(|_| polynomial.clone())
    }

    /// Whether a polynomial is a combination of the equations.
    #[must_use]
    pub fn contains(&self, polynomial: &Polynomial) -> bool {
        self.normal_form(polynomial).is_zero()
    }

    /// Computes the basis again over the rationals. `true`: it is the same, and the certificate says from now on that
    /// nothing rests on primes. `false`: these are not the equations of this basis.
    ///
    /// Fractions grow much more in this computation than in its result; it is meant for small systems.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice; nothing has changed then.
    pub fn prove(&mut self, equations: &[Polynomial], budget: &Budget) -> Result<bool, Stop> {
        let equations: Vec<Terms<Rational>> = equations
            .iter()
            .filter(|p| !p.is_zero())
            .map(|p| Terms::of(p, &self.order))
            .collect::<Result<_, Stop>>()?;
        let (basis, _) = reduced_basis(&equations, self.variables, &self.order, false, budget)?;
        let same = basis == self.monic;
        if same {
            self.certificate = Certificate::over_the_rationals();
        }
        Ok(same)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::algebra::Limits;

    /// x² + y² = 1 and x = y.
    fn circle_and_diagonal() -> Vec<Polynomial> {
        let (x, y) = (Polynomial::variable(0, 2), Polynomial::variable(1, 2));
        let circle = &(&(&x * &x) + &(&y * &y)) - &Polynomial::one(2);
        vec![circle, &x - &y]
    }

    #[test]
    fn basis_of_two_points() {
        let names = ["x".to_owned(), "y".to_owned()];
        let equations = circle_and_diagonal();
        for order in [
            MonomialOrder::Degrevlex,
            MonomialOrder::Lexicographic,
            MonomialOrder::Elimination(1),
        ] {
            let basis = groebner_basis(&equations, 2, &order, &Budget::unlimited()).unwrap();
            let mut texts: Vec<String> =
                basis.polynomials().iter().map(|p| p.text(&names)).collect();
            if order == MonomialOrder::Degrevlex {
                texts.reverse();
            }
            assert_eq!(texts, ["2*y^2 - 1", "x - y"]);
            assert!(basis.normal_form(&equations[0]).is_zero());
            assert!(!basis.is_inconsistent());
        }
    }

    #[test]
    fn contradictions_give_one() {
        let mut equations = circle_and_diagonal();
        equations.push(&Polynomial::variable(0, 2) - &Polynomial::integer(2, 2));
        let basis = groebner_basis(
            &equations,
            2,
            &MonomialOrder::Degrevlex,
            &Budget::unlimited(),
        )
        .unwrap();
        assert!(basis.is_inconsistent());
    }

    #[test]
    fn a_budget_that_is_used_up_stops_the_computation() {
        let budget = Budget::new(Limits {
            work: Some(1),
            ..Limits::default()
        });
        let result = groebner_basis(
            &circle_and_diagonal(),
            2,
            &MonomialOrder::Degrevlex,
            &budget,
        );
        assert_eq!(result.err(), Some(Stop::Work));
    }
}
