//! Groebner bases over the rationals.

use super::budget::{Budget, Stop};
use super::modular::rational_basis;
use super::order::MonomialOrder;
use crate::algebra::polynomial::{Polynomial, Rational};
use groebner::PolynomialExt;
use polycore::Poly;

/// What was checked of a basis.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Certificate {
    /// Primes modulo which the basis was found the same.
    pub primes: usize,
}

/// A reduced Groebner basis: every polynomial primitive, no term of one divisible by the leading monomial of another.
#[derive(Clone, Debug)]
pub struct GroebnerBasis {
    order: MonomialOrder,
    variables: usize,
    monic: Vec<Poly<Rational>>,
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
    let raw_order = order.raw(variables);
    let (mut monic, certificate) = rational_basis(equations, &raw_order, budget)?;
    monic.sort_by(|a, b| raw_order.compare(&a.terms[0].0, &b.terms[0].0));
    let polynomials = monic
        .iter()
        .map(|p| Polynomial::from_raw(p).primitive())
        .collect();
    Ok(GroebnerBasis {
        order: order.clone(),
        variables,
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
        self.monic.iter().map(|p| p.terms[0].0.exps())
    }

    /// Whether the equations contradict one another: no solution, not even a complex one.
    #[must_use]
    pub fn is_inconsistent(&self) -> bool {
        self.monic.iter().any(Poly::is_constant)
    }

    /// What remains of a polynomial modulo the ideal.
    #[must_use]
    pub fn normal_form(&self, polynomial: &Polynomial) -> Polynomial {
        let ordered = polynomial.raw().reorder(self.order.raw(self.variables));
        Polynomial::from_raw(&ordered.normal_form(&self.monic))
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
