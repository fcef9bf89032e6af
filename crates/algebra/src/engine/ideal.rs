//! Questions about ideals that a Groebner basis in a larger ring answers.
//!
//! Cox, Little and O'Shea, "Ideals, Varieties, and Algorithms", sections 3.1, 4.2 and 4.4. Every answer rests on what its
//! bases rest on: see [`Certificate`](super::Certificate).

use super::basis::{GroebnerBasis, groebner_basis};
use super::budget::{Budget, Stop};
use super::modular::{leads_modulo_a_prime, rational_basis};
use super::order::MonomialOrder;
use crate::polynomial::Polynomial;

/// Whether a polynomial vanishes on all complex solutions of the equations: whether they and `f ≠ 0` contradict one another
/// (Rabinowitsch 1929).
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn radical_contains(
    equations: &[Polynomial],
    variables: usize,
    f: &Polynomial,
    budget: &Budget,
) -> Result<bool, Stop> {
    if f.is_zero() {
        return Ok(true);
    }
    let system = with_inverse(equations, variables, f);
    let basis = groebner_basis(&system, variables + 1, &MonomialOrder::Degrevlex, budget)?;
    Ok(basis.is_inconsistent())
}

/// [`radical_contains`] for equations that are a reduced basis in degrevlex, where most answers are no.
///
/// One prime proves that. If it divides no leading coefficient, the basis stays one modulo the prime, and what it reduces to zero
/// over the rationals it reduces to zero there: were a power of f in the ideal, `f ≠ 0` would contradict the equations there, too.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn radical_of_basis_contains(
    basis: &[Polynomial],
    variables: usize,
    f: &Polynomial,
    budget: &Budget,
) -> Result<bool, Stop> {
    if f.is_zero() {
        return Ok(true);
    }
    let system = with_inverse(basis, variables, &f.primitive());
    let order = MonomialOrder::Degrevlex;
    let (all, inverse) = (variables + 1, Some(variables));
    let leads = leads_modulo_a_prime(&system, all, &order, inverse, budget)?;
    if !leads.iter().any(|lead| lead.iter().all(|&e| e == 0)) {
        return Ok(false);
    }
    let (monic, certificate) = rational_basis(&system, all, &order, inverse, budget, &mut None)?;
    Ok(GroebnerBasis::assembled(monic, all, &order, certificate).is_inconsistent())
}

/// A Groebner basis of the combinations of the equations in which some variables do not occur. Their complex solutions are
/// the closure of what remains of the solutions when those variables are forgotten.
///
/// The polynomials stay in the ring of the equations. A contradiction gives the one polynomial 1, no condition gives none.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn eliminate(
    equations: &[Polynomial],
    variables: usize,
    eliminated: &[usize],
    budget: &Budget,
) -> Result<Vec<Polynomial>, Stop> {
    // The eliminated variables come first.
    let mut order: Vec<usize> = (0..variables).filter(|v| eliminated.contains(v)).collect();
    let count = order.len();
    order.extend((0..variables).filter(|v| !eliminated.contains(v)));
    let moved = in_sequence(equations, &order);
    let basis = groebner_basis(
        &moved,
        variables,
        &MonomialOrder::Elimination(count),
        budget,
    )?;
    Ok(without_first(&basis, count)
        .map(|p| p.moved(&order, variables))
        .collect())
}

/// The polynomials with the variables of this sequence in the places of its elements.
fn in_sequence(polynomials: &[Polynomial], sequence: &[usize]) -> Vec<Polynomial> {
    let mut places = vec![0; sequence.len()];
    for (place, &variable) in sequence.iter().enumerate() {
        places[variable] = place;
    }
    let moved = polynomials.iter().map(|p| p.moved(&places, sequence.len()));
    moved.collect()
}

/// What of a basis in an elimination order does not mention the first variables.
fn without_first(basis: &GroebnerBasis, count: usize) -> impl Iterator<Item = &Polynomial> {
    let all = basis.polynomials().iter().zip(basis.leading_monomials());
    all.filter(move |(_, lead)| lead[..count].iter().all(|&e| e == 0))
        .map(|(p, _)| p)
}

/// A Groebner basis of `I : f^∞`, the polynomials that come into the ideal when multiplied by a power of `f`. Their complex
/// solutions are the closure of those of the equations where `f` is not zero.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn saturate(
    equations: &[Polynomial],
    variables: usize,
    f: &Polynomial,
    budget: &Budget,
) -> Result<Vec<Polynomial>, Stop> {
    let system = with_inverse(equations, variables, f);
    let saturated = eliminate(&system, variables + 1, &[variables], budget)?;
    Ok(without_last(&saturated, variables))
}

/// [`saturate`] for equations that are a reduced basis in degrevlex, and mostly the answer themselves.
///
/// One prime proves that. If it divides no leading coefficient, the basis stays one modulo the prime. Were `f g` in the ideal
/// and g not, so could g be with integers over denominators that the prime does not divide, in normal form and not zero modulo the
/// prime: then it would not be in the ideal there, either, but `f g` would. So where f divides no zero modulo the prime, which leading
/// monomials tell, it divides none over the rationals.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn saturate_basis(
    basis: &[Polynomial],
    variables: usize,
    f: &Polynomial,
    budget: &Budget,
) -> Result<Vec<Polynomial>, Stop> {
    if f.is_zero() {
        return Ok(vec![Polynomial::one(variables)]);
    }
    let all = variables + 1;
    let sequence: Vec<usize> = [variables].into_iter().chain(0..variables).collect();
    let system = in_sequence(&with_inverse(basis, variables, &f.primitive()), &sequence);
    let order = MonomialOrder::Elimination(1);
    let leads = leads_modulo_a_prime(&system, all, &order, Some(0), budget)?;
    let left = leads.iter().filter(|lead| lead[0] == 0);
    let mut left: Vec<&[u32]> = left.map(|lead| &lead[1..]).collect();
    let mut before: Vec<&[u32]> = basis
        .iter()
        .filter_map(|p| p.terms().next().map(|(lead, _)| lead))
        .collect();
    left.sort_unstable();
    before.sort_unstable();
    if left == before {
        return Ok(basis.to_vec());
    }
    let (monic, certificate) = rational_basis(&system, all, &order, Some(0), budget, &mut None)?;
    let saturated = GroebnerBasis::assembled(monic, all, &order, certificate);
    let rest: Vec<Polynomial> = without_first(&saturated, 1)
        .map(|p| p.moved(&sequence, all))
        .collect();
    Ok(without_last(&rest, variables))
}

/// Generators of `I : f`, the polynomials that come into the ideal when multiplied by `f`.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn quotient(
    equations: &[Polynomial],
    variables: usize,
    f: &Polynomial,
    budget: &Budget,
) -> Result<Vec<Polynomial>, Stop> {
    if f.is_zero() {
        return Ok(vec![Polynomial::one(variables)]);
    }
    // The intersection of I and (f) is what t I + (1 - t) (f) holds without t; every element of it is a multiple of f.
    let t = Polynomial::variable(variables, variables + 1);
    let mut system: Vec<Polynomial> = equations
        .iter()
        .map(|p| &widened(p, variables) * &t)
        .collect();
    system.push(&(&Polynomial::one(variables + 1) - &t) * &widened(f, variables));
    let both = eliminate(&system, variables + 1, &[variables], budget)?;
    Ok(without_last(&both, variables)
        .iter()
        .filter_map(|p| p.divided_by(f))
        .map(|p| p.primitive())
        .collect())
}

/// The equations and `z f = 1`, with `z` as an additional last variable.
fn with_inverse(equations: &[Polynomial], variables: usize, f: &Polynomial) -> Vec<Polynomial> {
    let inverse = Polynomial::variable(variables, variables + 1);
    let mut system: Vec<Polynomial> = equations.iter().map(|p| widened(p, variables)).collect();
    system.push(&(&inverse * &widened(f, variables)) - &Polynomial::one(variables + 1));
    system
}

/// The same polynomial with one more variable.
fn widened(p: &Polynomial, variables: usize) -> Polynomial {
    let places: Vec<usize> = (0..variables).collect();
    p.moved(&places, variables + 1)
}

/// The same polynomials without the last variable, which they do not mention.
fn without_last(polynomials: &[Polynomial], variables: usize) -> Vec<Polynomial> {
    let cut = |exponents: &[u32]| exponents[..variables].to_vec();
    polynomials
        .iter()
        .map(|p| {
            let terms = p.terms().map(|(m, c)| (cut(m), c.clone())).collect();
            Polynomial::from_terms(terms, variables)
        })
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::engine::testing::{names, parse, texts};

    fn unlimited() -> Budget {
        Budget::unlimited()
    }

    #[test]
    fn radicals_know_more_than_ideals() {
        // Cox, Little and O'Shea, section 4.2: y - x² + 1 lies in the radical of (x y² + 2 y², x⁴ - 2 x² + 1).
        let equations = [parse("x*y^2 + 2*y^2"), parse("x^4 - 2*x^2 + 1")];
        let f = parse("y - x^2 + 1");
        assert_eq!(radical_contains(&equations, 3, &f, &unlimited()), Ok(true));
        let basis = groebner_basis(&equations, 3, &MonomialOrder::Degrevlex, &unlimited()).unwrap();
        assert!(!basis.contains(&f));
        assert!(basis.contains(&f.power(3)));
        let other = parse("y - x");
        assert_eq!(
            radical_contains(&equations, 3, &other, &unlimited()),
            Ok(false)
        );
    }

    /// Of a basis the same is told as of any equations, whether f vanishes, divides zero or neither.
    #[test]
    fn a_basis_is_asked_modulo_a_prime_first() {
        let systems: [&[&str]; 4] = [
            &["x*y^2 + 2*y^2", "x^4 - 2*x^2 + 1"],
            &["x^2*y", "x*z"],
            &["x*y - z^2", "x^2 - 3*y*z + 5"],
            &["2*x^2 - 7*y + 1", "x*y*z - z^3", "y^2*z - x*z"],
        ];
        let asked = [
            "x",
            "y - x^2 + 1",
            "y - x",
            "z",
            "3*x - 2*y*z",
            "x^2 + y^2",
            "1",
            "0",
        ];
        let mut kinds = [0; 3];
        for system in systems {
            let equations: Vec<Polynomial> = system.iter().map(|text| parse(text)).collect();
            let order = MonomialOrder::Degrevlex;
            let basis = groebner_basis(&equations, 3, &order, &unlimited()).unwrap();
            let basis = basis.polynomials();
            for f in asked.map(parse) {
                let inside = radical_of_basis_contains(basis, 3, &f, &unlimited());
                assert_eq!(inside, radical_contains(&equations, 3, &f, &unlimited()));
                let left = saturate_basis(basis, 3, &f, &unlimited());
                assert_eq!(left, saturate(&equations, 3, &f, &unlimited()), "{f:?}");
                let kind = if inside == Ok(true) {
                    0
                } else {
                    1 + usize::from(left.unwrap() == basis)
                };
                kinds[kind] += 1;
            }
        }
        assert!(kinds.iter().all(|&count| count > 2), "{kinds:?}");
    }

    #[test]
    fn elimination_implicitises_the_twisted_cubic() {
        // x = t, y = t², z = t³ with t as a fourth variable.
        let names = ["t", "x", "y", "z"].map(str::to_owned);
        let variable = |i| Polynomial::variable(i, 4);
        let t = variable(0);
        let equations = [
            &variable(1) - &t,
            &variable(2) - &t.power(2),
            &variable(3) - &t.power(3),
        ];
        let found = eliminate(&equations, 4, &[0], &unlimited()).unwrap();
        let texts: Vec<String> = found.iter().map(|p| p.text(&names)).collect();
        assert_eq!(texts, ["y^2 - x*z", "x*y - z", "x^2 - y"]);
        // Forgetting t and z in the other order of names leaves the parabola.
        let found = eliminate(&equations, 4, &[3, 0], &unlimited()).unwrap();
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].text(&names), "x^2 - y");
    }

    #[test]
    fn saturation_removes_a_component_and_its_multiplicity() {
        // x² y and x z: the plane x = 0, and the line y = z = 0.
        let equations = [parse("x^2*y"), parse("x*z")];
        let found = saturate(&equations, 3, &parse("x"), &unlimited()).unwrap();
        assert_eq!(texts(&found), ["z", "y"]);
        let nothing = saturate(&equations, 3, &parse("0"), &unlimited()).unwrap();
        assert_eq!(texts(&nothing), ["1"]);
        let all = saturate(&equations, 3, &parse("1"), &unlimited()).unwrap();
        assert_eq!(texts(&all), ["x*z", "x^2*y"]);
    }

    #[test]
    fn a_quotient_removes_one_factor() {
        let equations = [parse("x^2*y"), parse("x*z")];
        let once = quotient(&equations, 3, &parse("x"), &unlimited()).unwrap();
        assert_eq!(texts(&once), ["z", "x*y"]);
        let twice = quotient(&once, 3, &parse("x"), &unlimited()).unwrap();
        assert_eq!(texts(&twice), ["z", "y"]);
        let all = quotient(&equations, 3, &parse("0"), &unlimited()).unwrap();
        assert_eq!(texts(&all), ["1"]);
    }

    #[test]
    fn no_equations_are_no_condition() {
        assert_eq!(eliminate(&[], 3, &[0], &unlimited()), Ok(Vec::new()));
        assert_eq!(names().len(), 3);
        assert_eq!(
            radical_contains(&[], 3, &parse("x"), &unlimited()),
            Ok(false)
        );
        assert_eq!(
            radical_contains(&[], 3, &parse("0"), &unlimited()),
            Ok(true)
        );
    }
}
