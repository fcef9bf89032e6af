//! Bases of equations that share no variable, put together.

use super::basis::GroebnerBasis;
use super::budget::Stop;
use super::certificate::Certificate;
use super::order::MonomialOrder;
use super::terms::Terms;
use crate::polynomial::{Polynomial, Rational};

impl GroebnerBasis {
    /// The basis of several sets of equations no two of which share a variable, from the basis of each in the ring of its own
    /// variables and the places of these in the large ring, ascending. Of a single set it is the same basis in a larger ring.
    ///
    /// Leading monomials of different sets have no common factor, so that the S-polynomials reduce to zero (Buchberger's
    /// first criterion; Cox, Little and O'Shea 2015, §2.9, proposition 4), and nothing needs to be computed. The certificate
    /// is the weakest: that of the set with the fewest primes.
    ///
    /// # Errors
    /// [`Stop::Memory`] if an exponent does not fit, which no basis has.
    pub fn of_parts(
        parts: &[(Self, Vec<usize>)],
        variables: usize,
        order: &MonomialOrder,
    ) -> Result<Self, Stop> {
        let certificate = parts
            .iter()
            .map(|(basis, _)| basis.certificate())
            .min_by_key(|c| (c.proven, c.primes, c.fresh_prime))
            .cloned()
            .unwrap_or_else(Certificate::over_the_rationals);
        if parts.iter().any(|(basis, _)| basis.is_inconsistent()) {
            let one = Terms::of(&Polynomial::one(variables), order)?.monic();
            return Ok(Self::assembled(vec![one], variables, order, certificate));
        }
        let mut monic: Vec<Terms<Rational>> = Vec::new();
        for (basis, places) in parts {
            for polynomial in basis.polynomials() {
                monic.push(Terms::of(&polynomial.moved(places, variables), order)?.monic());
            }
        }
        monic.sort_by(|a, b| match (a.lead(), b.lead()) {
            (Some(a), Some(b)) => order.compare(a, b),
            (a, b) => a.is_some().cmp(&b.is_some()),
        });
        Ok(Self::assembled(monic, variables, order, certificate))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{Budget, groebner_basis};

    /// x y = 1, x² + y² = 4 in any two variables.
    fn pair(x: usize, y: usize, n: usize) -> Vec<Polynomial> {
        let (x, y) = (Polynomial::variable(x, n), Polynomial::variable(y, n));
        let four = Polynomial::constant(Rational::from_integer(4.into()), n);
        vec![
            &(&x * &y) - &Polynomial::one(n),
            &(&(&x * &x) + &(&y * &y)) - &four,
        ]
    }

    #[test]
    fn together_they_are_the_basis_of_all() {
        let budget = Budget::unlimited();
        for order in [MonomialOrder::Degrevlex, MonomialOrder::Lexicographic] {
            let small = groebner_basis(&pair(0, 1, 2), 2, &order, &budget).unwrap();
            let parts = [(small.clone(), vec![0, 3]), (small, vec![1, 2])];
            let together = GroebnerBasis::of_parts(&parts, 5, &order).unwrap();
            let all = [pair(0, 3, 5), pair(1, 2, 5)].concat();
            let direct = groebner_basis(&all, 5, &order, &budget).unwrap();
            assert_eq!(together.polynomials(), direct.polynomials());
            assert_eq!(together.dimension(), Some(1));
            assert!(all.iter().all(|p| together.contains(p)));
        }
    }

    #[test]
    fn a_part_without_solution_leaves_none() {
        let (budget, order) = (Budget::unlimited(), MonomialOrder::Degrevlex);
        let none = groebner_basis(&[Polynomial::one(1)], 1, &order, &budget).unwrap();
        let some = groebner_basis(&pair(0, 1, 2), 2, &order, &budget).unwrap();
        let parts = [(some, vec![0, 1]), (none, vec![2])];
        let together = GroebnerBasis::of_parts(&parts, 3, &order).unwrap();
        assert!(together.is_inconsistent());
        assert_eq!(together.polynomials(), [Polynomial::one(3)]);
    }
}
