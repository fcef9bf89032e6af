//! The solution set near one point.
//!
//! The dimension of all solutions says little about a mechanism at a pose: another component may be larger. Near a point the
//! leading monomials of an order that puts *low* degrees first tell the dimension. They come from an ordinary Groebner basis
//! after homogenisation with a variable t whose higher powers are larger (Lazard 1983; Greuel and Pfister, "A Singular
//! Introduction to Commutative Algebra", section 1.7): leading monomials with t = 1 put in.
//!
//! Modulo a prime. Let the coefficients and the point be integers modulo a prime p (no denominator divisible by p). Along the
//! section of the point the dimension of the fibres is upper semicontinuous (Chevalley; EGA IV 13.1.3), so that the
//! dimension at the point modulo p is never smaller than over the rationals: what is found is a proven upper bound, from one
//! prime, and almost always the dimension itself. This also serves points with algebraic coordinates, where these have
//! residues modulo p.

use super::budget::{Budget, Stop};
use super::dimension::Supports;
use super::f4::{leading_monomials_until, reduced_basis};
use super::hilbert::{HilbertSeries, small};
use super::monomials::degree;
use super::order::MonomialOrder;
use super::terms::{Terms, exponents};
use crate::polynomial::{Polynomial, Rational};
use groebner::Zp;
use num_traits::Zero;
use polycore::Primes;
use polycore::modp::is_prime;
use std::collections::BTreeMap;

/// Matrix entries spent on the whole solution set before only the neighbourhood of the point is looked at.
const GLOBAL_WORK: u64 = 3_000_000;

/// The local ring of a solution set at a point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LocalRing {
    /// Dimension of the complex solution set at the point: of the largest component through it. 0: the point is isolated.
    pub dimension: usize,
    /// Multiplicity of the point: 1 at a smooth point of a reduced solution set; at an isolated point the number of
    /// solutions that coincide there. `None` where it does not fit a machine number.
    pub multiplicity: Option<usize>,
    /// Leading monomials of the tangent cone, exponents by variable, none a multiple of another.
    pub leading_monomials: Vec<Vec<u32>>,
}

/// Terms of a polynomial modulo a prime: exponents and residue.
pub type ResidueTerms = Vec<(Vec<u32>, u64)>;

/// The local ring at the origin, of equations modulo a prime. `None`: the origin is no solution.
///
/// The dimension over the rationals is at most the one found, as the head of this module's source explains: a proof, where the
/// equations and the point have no denominator divisible by the prime.
///
/// # Errors
/// [`Stop::Modulus`] where `prime` is none; [`Stop`] where the budget does not suffice.
pub fn local_dimension_modulo(
    equations: &[ResidueTerms],
    variables: usize,
    prime: u64,
    budget: &Budget,
) -> Result<Option<LocalRing>, Stop> {
    let leads = local_leads(equations, variables, prime, |_| false, budget)?;
    let Some(series) = HilbertSeries::of(leads.clone(), variables, budget)? else {
        return Ok(None);
    };
    Ok(Some(LocalRing {
        dimension: series.dimension(),
        multiplicity: small(&series.degree()),
        leading_monomials: leads,
    }))
}

/// Whether the dimension at the origin is at most `bound`, modulo a prime and then over the rationals too. Ends as soon as
/// that is clear, usually long before the local ring is known. Also `true` where the origin is no solution.
///
/// # Errors
/// [`Stop::Modulus`] where `prime` is none; [`Stop`] where the budget does not suffice.
pub fn local_dimension_is_at_most(
    bound: usize,
    equations: &[ResidueTerms],
    variables: usize,
    prime: u64,
    budget: &Budget,
) -> Result<bool, Stop> {
    let within = |leads: &[Vec<u32>]| {
        let supports = Supports::new(leads.iter().map(Vec::as_slice), variables);
        supports.dimension().is_none_or(|d| d <= bound)
    };
    let leads = local_leads(equations, variables, prime, within, budget)?;
    Ok(within(&leads))
}

/// The local ring at a rational point, one coordinate per variable, found modulo one prime: its dimension is an upper bound
/// of the one over the rationals, and almost always equal to it. `None`: the point is no solution.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn local_dimension(
    equations: &[Polynomial],
    point: &[Rational],
    budget: &Budget,
) -> Result<Option<LocalRing>, Stop> {
    if equations.iter().any(|p| !p.value_at(point).is_zero()) {
        return Ok(None);
    }
    let variables = point.len();
    let shifts: Vec<Polynomial> = point
        .iter()
        .enumerate()
        .map(|(i, value)| {
            let variable = Polynomial::variable(i, variables);
            &variable + &Polynomial::constant(value.clone(), variables)
        })
        .collect();
    let shifted: Vec<Polynomial> = equations
        .iter()
        .map(|p| p.primitive().substitute(&shifts))
        .collect();
    for prime in Primes::new().take(100) {
        let residues: Option<Vec<ResidueTerms>> = shifted
            .iter()
            .map(|p| {
                let terms = p.terms();
                terms
                    .map(|(m, c)| Some((m.to_vec(), Zp::from_rational(c, prime)?.value())))
                    .collect()
            })
            .collect();
        if let Some(residues) = residues {
            return local_dimension_modulo(&residues, variables, prime, budget);
        }
    }
    Err(Stop::Coefficients)
}

/// Leading monomials at the origin; all of them, unless `enough` is content with fewer.
fn local_leads(
    equations: &[ResidueTerms],
    variables: usize,
    prime: u64,
    enough: impl Fn(&[Vec<u32>]) -> bool,
    budget: &Budget,
) -> Result<Vec<Vec<u32>>, Stop> {
    if !is_prime(prime) {
        return Err(Stop::Modulus);
    }
    let equations: Vec<Terms<Zp>> = equations
        .iter()
        .map(|terms| {
            budget.check()?;
            collected(terms, prime)
        })
        .collect::<Result<_, Stop>>()?;
    let equations: Vec<Terms<Zp>> = equations.into_iter().filter(|p| !p.is_zero()).collect();
    // The forms of a basis that compares degrees generate all forms of the ideal, without solutions at infinity that the
    // equations themselves may have: mostly a much smaller problem.
    let little = budget.with_work(GLOBAL_WORK);
    let global = reduced_basis(
        &equations,
        variables,
        &MonomialOrder::Degrevlex,
        None,
        false,
        &little,
    );
    budget.take_over(&little);
    let generators = match global {
        Ok((basis, _)) => basis,
        Err(Stop::Work) => {
            budget.check()?;
            equations
        }
        Err(stop) => return Err(stop),
    };
    // t is the first variable; on forms, this order compares its powers first.
    let order = MonomialOrder::Elimination(1);
    let forms: Vec<Terms<Zp>> = generators
        .iter()
        .map(|p| homogenised(p, &order))
        .collect::<Result<_, Stop>>()?;
    let with_one_for_t = |leads: &mut dyn Iterator<Item = &[u16]>| {
        let mut local: Vec<Vec<u32>> = leads
            .map(|lead| lead[1..].iter().map(|&e| u32::from(e)).collect())
            .collect();
        local.sort_by(|a, b| {
            let degrees = a.iter().sum::<u32>().cmp(&b.iter().sum());
            degrees.then_with(|| b.cmp(a))
        });
        let mut minimal: Vec<Vec<u32>> = Vec::new();
        for lead in local {
            let multiple = |m: &Vec<u32>| m.iter().zip(&lead).all(|(a, b)| a <= b);
            if !minimal.iter().any(multiple) {
                minimal.push(lead);
            }
        }
        minimal
    };
    let leads = leading_monomials_until(
        &forms,
        variables + 1,
        &order,
        |leads| enough(&with_one_for_t(leads)),
        budget,
    )?;
    Ok(with_one_for_t(&mut leads.iter().map(|lead| &**lead)))
}

/// Like terms added, in degrevlex.
fn collected(terms: &[(Vec<u32>, u64)], prime: u64) -> Result<Terms<Zp>, Stop> {
    let mut sums: BTreeMap<&[u32], Zp> = BTreeMap::new();
    for (monomial, value) in terms {
        let sum = sums
            .entry(monomial)
            .or_insert_with(|| Zp::from_i64(0, prime));
        *sum = *sum + Zp::new(*value, prime);
    }
    sums.retain(|_, value| !value.is_zero());
    let terms = sums.iter().map(|(m, &c)| Ok((exponents(m)?, c)));
    let terms = terms.collect::<Result<_, Stop>>()?;
    Ok(Terms::sorted(terms, &MonomialOrder::Degrevlex))
}

/// Every term filled up to the degree of the polynomial with powers of an additional first variable.
fn homogenised(p: &Terms<Zp>, order: &MonomialOrder) -> Result<Terms<Zp>, Stop> {
    let most = p.monomials.iter().map(|m| degree(m)).max().unwrap_or(0);
    let forms = p
        .monomials
        .iter()
        .zip(&p.coefficients)
        .map(|(monomial, &c)| {
            let missing = u16::try_from(most - degree(monomial)).map_err(|_| Stop::Memory)?;
            let mut form = vec![missing];
            form.extend_from_slice(monomial);
            Ok((form.into(), c))
        });
    Ok(Terms::sorted(forms.collect::<Result<_, Stop>>()?, order))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod oracle;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::engine::testing::parse;

    /// Dimension and multiplicity at a point of space.
    fn at(equations: &[&str], point: [i64; 3]) -> Option<(usize, usize)> {
        let equations: Vec<Polynomial> = equations.iter().map(|text| parse(text)).collect();
        let point = point.map(|c| Rational::from_integer(c.into()));
        let ring = local_dimension(&equations, &point, &Budget::unlimited()).unwrap();
        ring.map(|ring| (ring.dimension, ring.multiplicity.unwrap()))
    }

    #[test]
    fn curves_with_a_node_and_a_cusp() {
        let node = ["y^2 - x^3 - x^2", "z"];
        assert_eq!(at(&node, [0, 0, 0]), Some((1, 2)));
        assert_eq!(at(&node, [-1, 0, 0]), Some((1, 1)));
        assert_eq!(at(&["y^2 - x^3", "z"], [0, 0, 0]), Some((1, 2)));
        assert_eq!(at(&["y^2 - x^3", "z"], [1, 1, 0]), Some((1, 1)));
        assert_eq!(at(&["y^2 - x^3", "z"], [1, 2, 0]), None);
    }

    #[test]
    fn a_component_elsewhere_does_not_count() {
        // The line x = 1 and the origin.
        let equations = ["x*(x - 1)", "y*(x - 1)", "z"];
        assert_eq!(at(&equations, [0, 0, 0]), Some((0, 1)));
        assert_eq!(at(&equations, [1, 0, 0]), Some((1, 1)));
        assert_eq!(at(&equations, [1, 7, 0]), Some((1, 1)));
        // A plane, and a fat point off it.
        let fat = ["x^2*(z - 1)", "x*y*(z - 1)", "y^3*(z - 1)", "z*(z - 1)"];
        assert_eq!(at(&fat, [0, 0, 0]), Some((0, 4)));
        assert_eq!(at(&fat, [0, 0, 1]), Some((2, 1)));
    }

    #[test]
    fn a_point_where_components_meet_has_the_larger_dimension() {
        // The plane z = 0 and the line x = y = 0.
        let equations = ["x*z", "y*z"];
        assert_eq!(at(&equations, [0, 0, 0]), Some((2, 1)));
        assert_eq!(at(&equations, [0, 0, 1]), Some((1, 1)));
        assert_eq!(at(&equations, [1, 0, 0]), Some((2, 1)));
        assert_eq!(at(&[], [1, 2, 3]), Some((3, 1)));
    }

    #[test]
    fn an_isolated_real_point_may_lie_on_complex_curves() {
        // The stretched four-bar to second order: x² + y² = 0 is two complex lines.
        assert_eq!(at(&["x^2 + y^2", "z"], [0, 0, 0]), Some((1, 2)));
    }

    #[test]
    fn the_true_tangent_cone_needs_more_than_the_lowest_terms() {
        // The lowest terms x² and x y leave a line; the equations imply y⁵ too. The intersection multiplicity of x² with
        // y (x + y²) is 2 + 4.
        assert_eq!(at(&["x^2", "x*y + y^3", "z"], [0, 0, 0]), Some((0, 6)));
    }

    #[test]
    fn the_bound_is_enough_before_the_ring_is_known() {
        let terms = |text: &str| -> ResidueTerms {
            let p = parse(text);
            let prime = 1_000_003;
            let residue = |c| Zp::from_rational(c, prime).unwrap().value();
            p.terms().map(|(m, c)| (m.to_vec(), residue(c))).collect()
        };
        let equations = [terms("x + y^2 + z^3"), terms("y + x*z + z^4")];
        let budget = Budget::unlimited();
        let at_most =
            |bound| local_dimension_is_at_most(bound, &equations, 3, 1_000_003, &budget).unwrap();
        assert!(at_most(1) && at_most(2) && !at_most(0));
        assert_eq!(
            local_dimension_is_at_most(1, &equations, 3, 1_000_001, &budget),
            Err(Stop::Modulus)
        );
        let ring = local_dimension_modulo(&equations, 3, 1_000_003, &budget)
            .unwrap()
            .unwrap();
        assert_eq!(ring.leading_monomials, [[1, 0, 0], [0, 1, 0]]);
    }
}
