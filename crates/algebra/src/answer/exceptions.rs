//! For which values of the parameters is there no solution although no condition says so?
//!
//! Elimination gives the closure of the values for which there is one: tan α = 1/x leaves no condition on α, and α = 0 has no
//! solution. Where the leading coefficients of a basis, as one in the unknowns over the polynomials in the parameters, do not
//! vanish, the basis stays one when values are put in (Kalkbrener 1997; of elements whose leading monomials in the unknowns
//! divide one another the smallest is enough, Suzuki and Sato 2006), so that there is a solution if no element is without
//! unknowns. Where a factor of one vanishes the question is asked again with that factor as an equation, until nothing is left.

use super::conditions::{coefficients_in, given, is_given, never_vanishes};
use crate::{
    Budget, DesignConditions, MonomialOrder, Origin, Polynomial, PolynomialSystem, Stop, factor,
    groebner_basis, radical_contains, saturate,
};
use kutzbach_model::mechanism::JointId;
use std::collections::BTreeMap;

/// Most sets of values that are looked at one by one.
const MOST_PLACES: usize = 24;

/// Values for which there is no solution.
#[derive(Clone, Debug)]
pub struct Exception {
    /// The values: where all of these vanish.
    pub on: Vec<Polynomial>,
    /// What has to vanish there as well for a solution; the one polynomial 1 where nothing helps.
    pub only_if: Vec<Polynomial>,
}

/// Values that satisfy all conditions and still have no solution.
#[derive(Clone, Debug)]
pub struct Exceptions {
    /// All that were found.
    pub found: Vec<Exception>,
    /// Whether there are no others.
    pub complete: bool,
}

impl DesignConditions {
    /// Which values that satisfy the conditions have no solution all the same; with `joint`, none with almost every position
    /// of that joint. Over the complex numbers.
    #[must_use]
    pub fn exceptions(
        &self,
        system: &PolynomialSystem,
        joint: Option<JointId>,
        budget: &Budget,
    ) -> Exceptions {
        let mut search = Search {
            system,
            kept: joint.map_or(&[], |joint| &system.joint_variables[joint.0]),
            circle: own_equations(system, joint),
            given: given(system),
            equations: system.polynomials(),
            seen: Vec::new(),
            found: Vec::new(),
            complete: true,
        };
        let conditions = self.conditions.iter().map(|c| c.polynomial.clone());
        if !self.is_impossible() && search.run(conditions.collect(), budget).is_err() {
            search.complete = false;
        }
        Exceptions {
            found: search.found,
            complete: search.complete,
        }
    }
}

/// The equations that a joint's variables satisfy whatever the mechanism.
pub(super) fn own_equations(system: &PolynomialSystem, joint: Option<JointId>) -> Vec<Polynomial> {
    let equations = system.equations.iter();
    equations
        .filter(|e| matches!(e.origin, Origin::Freedom { joint: own } if Some(own) == joint))
        .map(|e| e.polynomial.clone())
        .collect()
}

struct Search<'s> {
    system: &'s PolynomialSystem,
    /// The variables of the joint that is to take every position.
    kept: &'s [usize],
    /// What these satisfy.
    circle: Vec<Polynomial>,
    /// What the parameters satisfy.
    given: Vec<Polynomial>,
    /// The equations, where no denominator vanishes.
    equations: Vec<Polynomial>,
    /// Places that were looked at, each as the reduced basis of its equations.
    seen: Vec<Vec<Polynomial>>,
    found: Vec<Exception>,
    complete: bool,
}

impl Search<'_> {
    fn run(&mut self, conditions: Vec<Polynomial>, budget: &Budget) -> Result<(), Stop> {
        let count = self.system.variables.len();
        for nonzero in &self.system.nonzero {
            self.equations = saturate(&self.equations, count, nonzero, budget)?;
            for (on, _) in factor(nonzero, budget)?.factors {
                self.exclude(vec![on]);
            }
        }
        // What holds on more values is found first, and said once.
        let mut places = BTreeMap::from([((0, 0), conditions)]);
        let mut number = 0;
        while let Some(((equations, _), place)) = places.pop_first() {
            if self.seen.len() >= MOST_PLACES {
                self.complete = false;
                break;
            }
            for next in self.at(place, equations == 0, budget)? {
                number += 1;
                places.insert((next.len(), number), next);
            }
        }
        Ok(())
    }

    fn exclude(&mut self, on: Vec<Polynomial>) {
        let only_if = vec![Polynomial::one(self.system.variables.len())];
        self.found.push(Exception { on, only_if });
    }

    /// A place, narrowed to where what is known already leaves a solution.
    fn narrowed(&self, mut place: Vec<Polynomial>) -> Vec<Polynomial> {
        let known = self.found.iter();
        let concerned = known.filter(|e| e.on.iter().all(|p| place.contains(p)));
        let asked: Vec<Polynomial> = concerned.flat_map(|e| e.only_if.clone()).collect();
        for equation in asked {
            if !place.contains(&equation) {
                place.push(equation);
            }
        }
        place
    }

    /// Looks at the values where some polynomials vanish; the places within them that have to be looked at.
    fn at(
        &mut self,
        place: Vec<Polynomial>,
        first: bool,
        budget: &Budget,
    ) -> Result<Vec<Vec<Polynomial>>, Stop> {
        let count = self.system.variables.len();
        let place = self.narrowed(place);
        if place.iter().any(|p| never_vanishes(self.system, p)) {
            return Ok(Vec::new());
        }
        let mut all = self.given.clone();
        all.extend(place.iter().cloned());
        let known = groebner_basis(&all, count, &MonomialOrder::Degrevlex, budget)?;
        let known = known.polynomials().to_vec();
        if is_one(&known) || self.seen.contains(&known) {
            return Ok(Vec::new());
        }
        self.seen.push(known.clone());
        let (asked, leading) = self.leading_coefficients(&place, budget)?;
        let mut only_if = Vec::new();
        for condition in asked {
            if !radical_contains(&known, count, &condition, budget)? {
                only_if.push(condition);
            }
        }
        if is_one(&only_if) {
            self.exclude(place);
            return Ok(Vec::new());
        }
        if !only_if.is_empty() {
            if first {
                // What holds at the start are all conditions there are.
                self.complete = false;
            }
            let mut within = place.clone();
            within.extend(only_if.iter().cloned());
            self.found.push(Exception { on: place, only_if });
            return Ok(vec![within]);
        }
        let mut next = Vec::new();
        for coefficient in leading {
            for vanishing in self.vanishing(&coefficient, budget)? {
                let mut within = place.clone();
                for equation in vanishing {
                    if !within.contains(&equation) {
                        within.push(equation);
                    }
                }
                if within.len() > place.len() {
                    next.push(within);
                } else {
                    self.complete = false;
                }
            }
        }
        Ok(next)
    }

    /// The ways in which a coefficient can vanish for all positions of the joint.
    fn vanishing(
        &self,
        coefficient: &Polynomial,
        budget: &Budget,
    ) -> Result<Vec<Vec<Polynomial>>, Stop> {
        if coefficient.as_constant().is_some() {
            return Ok(Vec::new());
        }
        if self.kept.is_empty() {
            let factors = factor(coefficient, budget)?.factors.into_iter();
            return Ok(factors.map(|(f, _)| vec![f.primitive()]).collect());
        }
        let parts = coefficients_in(coefficient, self.kept);
        Ok(match parts.iter().any(|p| p.as_constant().is_some()) {
            true => Vec::new(),
            false => vec![parts.iter().map(Polynomial::primitive).collect()],
        })
    }

    /// What a place asks of the parameters, and the leading coefficients whose vanishing asks for more.
    fn leading_coefficients(
        &self,
        place: &[Polynomial],
        budget: &Budget,
    ) -> Result<(Vec<Polynomial>, Vec<Polynomial>), Stop> {
        let count = self.system.variables.len();
        let stays =
            |v: usize| self.kept.contains(&v) || is_given(&self.system.variables[v].meaning);
        let mut order: Vec<usize> = (0..count).filter(|&v| !stays(v)).collect();
        let unknowns = order.len();
        order.extend((0..count).filter(|&v| stays(v)));
        let mut places = vec![0; count];
        for (place, &variable) in order.iter().enumerate() {
            places[variable] = place;
        }
        let equations = self.equations.iter().chain(place);
        let moved: Vec<Polynomial> = equations.map(|p| p.moved(&places, count)).collect();
        let basis = groebner_basis(&moved, count, &MonomialOrder::Elimination(unknowns), budget)?;
        let own = groebner_basis(&self.circle, count, &MonomialOrder::Degrevlex, budget)?;
        let mut asked = Vec::new();
        let mut leads: Vec<(Vec<u32>, Polynomial)> = Vec::new();
        for (polynomial, lead) in basis.polynomials().iter().zip(basis.leading_monomials()) {
            let lead = lead[..unknowns].to_vec();
            let terms = polynomial
                .terms()
                .filter(|(m, _)| m[..unknowns] == lead[..]);
            let terms = terms.map(|(m, c)| {
                let mut rest = m.to_vec();
                rest[..unknowns].fill(0);
                (rest, c.clone())
            });
            let coefficient = Polynomial::from_terms(terms.collect(), count).moved(&order, count);
            let coefficient = own.normal_form_within(&coefficient, budget)?;
            if lead.iter().all(|&e| e == 0) {
                asked.extend(coefficients_in(&coefficient, self.kept));
            } else {
                leads.push((lead, coefficient));
            }
        }
        leads.sort_by_key(|(lead, c)| (lead.iter().sum::<u32>(), c.degree()));
        let mut least: Vec<(Vec<u32>, Polynomial)> = Vec::new();
        for (lead, coefficient) in leads {
            let divides =
                |(known, _): &(Vec<u32>, Polynomial)| known.iter().zip(&lead).all(|(a, b)| a <= b);
            if !least.iter().any(divides) {
                least.push((lead, coefficient));
            }
        }
        asked.retain(|p| !p.is_zero());
        if asked.iter().any(|p| p.as_constant().is_some()) {
            asked = vec![Polynomial::one(count)];
        }
        Ok((asked, least.into_iter().map(|(_, c)| c).collect()))
    }
}

fn is_one(polynomials: &[Polynomial]) -> bool {
    polynomials
        .iter()
        .any(|p| p.as_constant().is_some_and(|_| !p.is_zero()))
}
