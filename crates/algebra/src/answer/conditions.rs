//! Conditions on measures that were left open: for which values can the mechanism be put together, for which does it move?

use super::exceptions::own_equations;
use super::hints;
use crate::{
    Budget, Hints, Meaning, MonomialOrder, Origin, Polynomial, PolynomialSystem, Rational, Stop,
    components, eliminate, factor, groebner_basis, radical_contains, saturate,
};
use kutzbach_model::mechanism::JointId;
use num_traits::Signed;
use std::collections::BTreeMap;

/// Conditions on the parameters. They are necessary for real mechanisms; over the complex numbers (limits included) they are
/// also sufficient for assembly.
#[derive(Clone, Debug)]
pub struct DesignConditions {
    /// The variables that stand for parameters.
    pub parameters: Vec<usize>,
    /// Every one of these has to vanish; none: no condition.
    pub conditions: Vec<Condition>,
}

/// A polynomial in the parameters that has to vanish, as a product.
#[derive(Clone, Debug)]
pub struct Condition {
    /// The polynomial.
    pub polynomial: Polynomial,
    /// Its different factors that real values can make vanish; one of them has to.
    pub factors: Vec<Polynomial>,
}

/// Mechanisms that satisfy all conditions in one way: an irreducible piece of the set of all.
#[derive(Clone, Debug)]
pub struct Family {
    /// Its equations, in the parameters (and algebraic numbers) alone.
    pub equations: Vec<Polynomial>,
    /// How many parameters can be chosen freely; the cosine and sine of an angle count as one.
    pub dimension: usize,
}

/// Which values of the parameters let the equations have a solution.
///
/// All unknowns are eliminated; what is left speaks of the parameters alone (Ruiz 1994, (7.4), finds his condition in the
/// same way). Equations that always hold for parameters (the circle of an angle) are left out.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn assembly_conditions(
    system: &PolynomialSystem,
    budget: &Budget,
) -> Result<DesignConditions, Stop> {
    let remaining = remaining_without(system, &[], budget)?;
    conditions(system, remaining, budget)
}

/// Which values of the parameters let a joint take every position: necessary for the mechanism to move with that joint
/// moving.
///
/// All unknowns but those of the joint are eliminated. What is left, reduced by the joint's own circle, must vanish for
/// every position: coefficient by coefficient. So Bennett's ratio of lengths and sines of twists comes out of the closure of
/// four hinges with everything left open (Bennett 1903).
///
/// `None`: the joint has no variables of its own (the tree form leaves joints out, the positional form all of them), so that
/// its positions cannot be spoken of; the canonical form has variables for every joint that moves.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn motion_conditions(
    system: &PolynomialSystem,
    joint: JointId,
    budget: &Budget,
) -> Result<Option<DesignConditions>, Stop> {
    let kept = &system.joint_variables[joint.0];
    if kept.is_empty() {
        return Ok(None);
    }
    let remaining = remaining_without(system, kept, budget)?;
    let own = own_equations(system, Some(joint));
    let variables = system.variables.len();
    let circle = groebner_basis(&own, variables, &MonomialOrder::Degrevlex, budget)?;
    let mut coefficients = Vec::new();
    for polynomial in remaining {
        let reduced = circle.normal_form_within(&polynomial, budget)?;
        coefficients.extend(coefficients_in(&reduced, kept));
    }
    conditions(system, coefficients, budget).map(Some)
}

/// What the equations say about the parameters and some unknowns that are kept, where no denominator vanishes.
fn remaining_without(
    system: &PolynomialSystem,
    kept: &[usize],
    budget: &Budget,
) -> Result<Vec<Polynomial>, Stop> {
    let variables = system.variables.len();
    let mut equations = system.polynomials();
    for nonzero in &system.nonzero {
        equations = saturate(&equations, variables, nonzero, budget)?;
    }
    let eliminated: Vec<usize> = (0..variables)
        .filter(|v| !kept.contains(v) && !is_given(&system.variables[*v].meaning))
        .collect();
    eliminate(&equations, variables, &eliminated, budget)
}

/// Whether a variable is a measure of the mechanism and no unknown.
pub(super) fn is_given(meaning: &Meaning) -> bool {
    matches!(
        meaning,
        Meaning::Parameter { .. } | Meaning::Algebraic { .. }
    )
}

/// The coefficients of a polynomial seen as one in some of its variables.
pub(super) fn coefficients_in(polynomial: &Polynomial, variables: &[usize]) -> Vec<Polynomial> {
    let mut parts: BTreeMap<Vec<u32>, Vec<(Vec<u32>, Rational)>> = BTreeMap::new();
    for (exponents, coefficient) in polynomial.terms() {
        let power = variables.iter().map(|&v| exponents[v]).collect();
        let mut rest = exponents.to_vec();
        for &v in variables {
            rest[v] = 0;
        }
        parts
            .entry(power)
            .or_default()
            .push((rest, coefficient.clone()));
    }
    parts
        .into_values()
        .map(|terms| Polynomial::from_terms(terms, polynomial.variables()))
        .collect()
}

/// Whether the terms show that no real values make a polynomial vanish: a constant and others of its sign, where even powers
/// of parameters are not negative, and roots have the sign that they have in the file.
pub(super) fn never_vanishes(system: &PolynomialSystem, polynomial: &Polynomial) -> bool {
    let mut has_constant = false;
    let mut signs = polynomial.terms().map(|(exponents, coefficient)| {
        let mut negative = coefficient.is_negative();
        has_constant |= exponents.iter().all(|&e| e == 0);
        for (&exponent, variable) in exponents.iter().zip(&system.variables) {
            match &variable.meaning {
                _ if exponent % 2 == 0 => {}
                Meaning::Algebraic { value } => negative ^= value.signum() < 0,
                _ => return None,
            }
        }
        Some(negative)
    });
    let Some(Some(first)) = signs.next() else {
        return false;
    };
    signs.all(|sign| sign == Some(first)) && has_constant
}

/// Equations that hold for parameters and algebraic numbers anyway.
pub(super) fn given(system: &PolynomialSystem) -> Vec<Polynomial> {
    let mentions_given_only = |polynomial: &Polynomial| {
        let variables = system.variables.iter().enumerate();
        let mut unknowns = variables.filter(|(_, variable)| !is_given(&variable.meaning));
        unknowns.all(|(v, _)| !polynomial.mentions(v))
    };
    system
        .equations
        .iter()
        .filter(|e| {
            matches!(
                e.origin,
                Origin::Parameter { .. } | Origin::MinimalPolynomial { .. }
            )
        })
        .map(|e| e.polynomial.clone())
        .filter(mentions_given_only)
        .collect()
}

/// The conditions that do not hold anyway, as a reduced basis, factored.
fn conditions(
    system: &PolynomialSystem,
    found: Vec<Polynomial>,
    budget: &Budget,
) -> Result<DesignConditions, Stop> {
    let variables = system.variables.len();
    let given = given(system);
    let known = groebner_basis(&given, variables, &MonomialOrder::Degrevlex, budget)?;
    let mut all = given;
    all.extend(found);
    let basis = groebner_basis(&all, variables, &MonomialOrder::Degrevlex, budget)?;
    let mut conditions = Vec::new();
    for polynomial in basis.polynomials() {
        if known.normal_form_within(polynomial, budget)?.is_zero() {
            continue;
        }
        let factors = factor(polynomial, budget)?
            .factors
            .into_iter()
            .map(|(factor, _)| factor)
            // What must not vanish is no way to satisfy the condition, nor what no real value can meet.
            .filter(|f| {
                let mut nonzero = system.nonzero.iter();
                !nonzero.any(|n| n.primitive() == f.primitive()) && !never_vanishes(system, f)
            })
            .collect();
        conditions.push(Condition {
            polynomial: polynomial.clone(),
            factors,
        });
    }
    let parameters = (0..variables)
        .filter(|&v| matches!(system.variables[v].meaning, Meaning::Parameter { .. }))
        .collect();
    Ok(DesignConditions {
        parameters,
        conditions,
    })
}

impl DesignConditions {
    /// Whether no real values of the parameters will do: a condition has no factor that can vanish.
    #[must_use]
    pub fn is_impossible(&self) -> bool {
        self.conditions.iter().any(|c| c.factors.is_empty())
    }

    /// The ways to satisfy all conditions together, none within another, and whether every one is proven irreducible over
    /// the rationals. Of many conditions with many factors this is what can be read: of four hinges, for example, the
    /// planar loops, Bennett's, and those with two hinges on one line. Where a denominator vanishes there is no family.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn families(
        &self,
        system: &PolynomialSystem,
        budget: &Budget,
    ) -> Result<(Vec<Family>, bool), Stop> {
        let kept: Vec<usize> = (0..system.variables.len())
            .filter(|&v| is_given(&system.variables[v].meaning))
            .collect();
        let narrowed = |polynomial: &Polynomial| {
            let terms = polynomial.terms().map(|(exponents, coefficient)| {
                let powers = kept.iter().map(|&v| exponents[v]).collect();
                (powers, coefficient.clone())
            });
            Polynomial::from_terms(terms.collect(), kept.len())
        };
        let mut equations: Vec<Polynomial> = given(system).iter().map(narrowed).collect();
        let conditions = self.conditions.iter();
        equations.extend(conditions.map(|condition| narrowed(&condition.polynomial)));
        let numbers = hints(system, budget)?.numbers.into_iter();
        let numbers = numbers.filter_map(|mut number| {
            number.variable = kept.iter().position(|&v| v == number.variable)?;
            Some(number)
        });
        let hints = Hints {
            numbers: numbers.collect(),
            ..Hints::default()
        };
        let found = components(&equations, kept.len(), &hints, budget)?;
        let mut families = Vec::new();
        'pieces: for piece in found.pieces {
            for denominator in &system.nonzero {
                let denominator = narrowed(denominator);
                if radical_contains(&piece.equations, kept.len(), &denominator, budget)? {
                    continue 'pieces;
                }
            }
            let back = |p: &Polynomial| p.moved(&kept, system.variables.len());
            let equations: Vec<Polynomial> = piece.equations.iter().map(back).collect();
            if equations.iter().any(|p| never_vanishes(system, p)) {
                continue;
            }
            families.push(Family {
                equations,
                dimension: piece.dimension,
            });
        }
        Ok((families, found.complete))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_of_a_motion() {
        // (a − 1)·c + b, in the ring of c, a, b: all positions c only for a = 1 and b = 0.
        let [c, a, b] = [0, 1, 2].map(|i| Polynomial::variable(i, 3));
        let one = Polynomial::one(3);
        let p = &(&(&a - &one) * &c) + &b;
        assert_eq!(coefficients_in(&p, &[0]), [b, &a - &one]);
    }
}
