//! Groebner bases over the rationals.

use super::budget::{Budget, Limits, Stop};
use super::certificate::Certificate;
use super::dimension::Supports;
use super::f4::{is_basis, normal_forms, reduced_basis};
use super::hilbert::{HilbertSeries, small};
use super::modular::rational_basis;
use super::order::MonomialOrder;
use super::terms::Terms;
use crate::polynomial::{Polynomial, Rational};
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
    groebner_basis_noting(equations, variables, order, budget, &mut None)
}

/// The same. As soon as the basis modulo a first prime is known, the prime and the dimension that the leading monomials
/// there tell are noted: evidence of what the answer would be, should it not be reached.
pub(crate) fn groebner_basis_noting(
    equations: &[Polynomial],
    variables: usize,
    order: &MonomialOrder,
    budget: &Budget,
    modulo: &mut Option<(u64, Option<usize>)>,
) -> Result<GroebnerBasis, Stop> {
    let (monic, certificate) = rational_basis(equations, variables, order, None, budget, modulo)?;
    Ok(GroebnerBasis::assembled(
        monic,
        variables,
        order,
        certificate,
    ))
}

impl GroebnerBasis {
    /// From the monic polynomials of a reduced basis, smallest leading monomial first.
    pub(super) fn assembled(
        monic: Vec<Terms<Rational>>,
        variables: usize,
        order: &MonomialOrder,
        certificate: Certificate,
    ) -> Self {
        let polynomials = monic
            .iter()
            .map(|p| p.primitive().polynomial(variables))
            .collect();
        let leads = monic.iter().filter_map(Terms::lead);
        Self {
            order: order.clone(),
            variables,
            leads: leads
                .map(|m| m.iter().map(|&e| u32::from(e)).collect())
                .collect(),
            monic,
            polynomials,
            certificate,
        }
    }

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
    /// than the basis did. A polynomial with an exponent above 65535 stays as it is.
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

    /// Whether these polynomials are a basis of what they generate, shown over the rationals: their S-polynomials reduce to zero
    /// (Buchberger's criterion). That they generate the ideal of the equations is another question: see
    /// [`Self::certificate`].
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn is_basis(&self, budget: &Budget) -> Result<bool, Stop> {
        is_basis(&self.monic, self.variables, &self.order, budget)
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
        let (basis, _) =
            reduced_basis(&equations, self.variables, &self.order, None, false, budget)?;
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
    use crate::engine::testing::parse;
    use proptest::prelude::*;

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

    /// The two largest primes that are tried, which the equations below are made for.
    fn first_primes() -> Vec<i64> {
        let primes = polycore::Primes::new().take(2);
        primes.map(|p| i64::try_from(p).unwrap()).collect()
    }

    /// x + y and x + (1 + f) y: the origin, but a line modulo the divisors of f.
    fn line_modulo(factors: &[i64]) -> Vec<Polynomial> {
        let (x, y) = (Polynomial::variable(0, 2), Polynomial::variable(1, 2));
        let product = factors.iter().fold(Polynomial::one(2), |product, &f| {
            &product * &Polynomial::integer(f, 2)
        });
        let first = &x + &y;
        let second = &first + &(&product * &y);
        vec![first, second]
    }

    #[test]
    fn unlucky_primes_are_outvoted() {
        let primes = first_primes();
        for unlucky in [&primes[..1], &primes[1..], &primes[..]] {
            let basis = groebner_basis(
                &line_modulo(unlucky),
                2,
                &MonomialOrder::Degrevlex,
                &Budget::unlimited(),
            )
            .unwrap();
            assert_eq!(basis.dimension(), Some(0), "{unlucky:?}");
            assert_eq!(basis.polynomials().len(), 2);
        }
    }

    #[test]
    fn a_prime_that_divides_a_leading_coefficient_is_not_used() {
        let (x, y) = (Polynomial::variable(0, 2), Polynomial::variable(1, 2));
        let prime = first_primes()[0];
        let equation = &(&Polynomial::integer(prime, 2) * &x) - &y;
        let basis = groebner_basis(
            std::slice::from_ref(&equation),
            2,
            &MonomialOrder::Degrevlex,
            &Budget::unlimited(),
        )
        .unwrap();
        assert_eq!(basis.polynomials(), [equation]);
        assert_ne!(basis.certificate().fresh_prime, u64::try_from(prime).ok());
    }

    #[test]
    fn no_equations_are_the_whole_space() {
        let order = MonomialOrder::Degrevlex;
        let zero = [Polynomial::zero(3)];
        let mut basis = groebner_basis(&zero, 3, &order, &Budget::unlimited()).unwrap();
        assert!(basis.polynomials().is_empty() && basis.certificate().proven);
        assert_eq!((basis.dimension(), basis.degree()), (Some(3), Some(1)));
        assert!(basis.contains(&zero[0]) && !basis.contains(&Polynomial::one(3)));
        assert_eq!(basis.prove(&[], &Budget::unlimited()), Ok(true));
    }

    #[test]
    fn degrees_need_an_order_that_knows_them() {
        // A line and a conic in space, and their four points with a sphere.
        let curve = [parse("x*z"), parse("x^2 + x*y - y*z - z"), parse("y*x - x")];
        let budget = Budget::unlimited();
        let degrevlex = groebner_basis(&curve, 3, &MonomialOrder::Degrevlex, &budget).unwrap();
        let lexicographic =
            groebner_basis(&curve, 3, &MonomialOrder::Lexicographic, &budget).unwrap();
        assert_eq!(degrevlex.dimension(), lexicographic.dimension());
        assert!(degrevlex.degree().is_some());
        assert_eq!(lexicographic.degree(), None);
        let points = [parse("x^2 - 1"), parse("y^3"), parse("z - x")];
        for order in [MonomialOrder::Degrevlex, MonomialOrder::Lexicographic] {
            let basis = groebner_basis(&points, 3, &order, &budget).unwrap();
            assert_eq!(basis.degree(), Some(6));
        }
    }

    fn small_polynomial() -> impl Strategy<Value = Polynomial> {
        let term = (prop::collection::vec(0_u32..3, 3), -5_i64..6);
        prop::collection::vec(term, 1..4).prop_map(|terms| {
            let rational = |c: i64| Rational::from_integer(c.into());
            let terms = terms.into_iter().map(|(m, c)| (m, rational(c))).collect();
            Polynomial::from_terms(terms, 3)
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        /// The computation over the rationals shares no prime with the other one.
        #[test]
        fn primes_and_fractions_find_the_same(
            equations in prop::collection::vec(small_polynomial(), 1..4),
            cofactors in prop::collection::vec(small_polynomial(), 3),
            which in 0_usize..3,
        ) {
            let order = [
                MonomialOrder::Degrevlex,
                MonomialOrder::Lexicographic,
                MonomialOrder::Elimination(1),
            ][which].clone();
            let budget = Budget::new(Limits {
                work: Some(20_000),
                ..Limits::default()
            });
            // What takes long in this ring, takes long over the rationals.
            let Ok(mut basis) = groebner_basis(&equations, 3, &order, &budget) else {
                return Ok(());
            };
            let sum = equations.iter().zip(&cofactors).fold(Polynomial::zero(3), |sum, (p, c)| {
                &sum + &(p * c)
            });
            prop_assert!(basis.contains(&sum));
            let budget = Budget::new(Limits {
                work: Some(3_000_000),
                ..Limits::default()
            });
            prop_assert_ne!(basis.prove(&equations, &budget), Ok(false));
            let hilbert = basis.hilbert(&Budget::unlimited()).unwrap();
            if let Some(hilbert) = hilbert {
                prop_assert_eq!(Some(hilbert.dimension()), basis.dimension());
            }
        }
    }
}
