//! Incremental instancing: what a cycle determines goes into the next ones, in as many cases as there are choices.

use super::divide::{Clock, Step};
use super::group::{Local, Problem, about_the_same, basis_by_parts, mentioned};
use crate::{Budget, GroebnerBasis, MonomialOrder, Polynomial, Rational, Stop, factor};

/// Most cases that are carried side by side. Beyond it a choice stays an equation, and nothing is lost.
const MOST_CASES: usize = 64;

/// A variable and what took its place: a number, or an expression of first degree in other variables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instance {
    /// Index of the variable.
    pub variable: usize,
    /// What it is equal to.
    pub value: Polynomial,
}

/// What one cycle gave the unknowns, case by case.
#[derive(Clone, Debug)]
pub struct Learned {
    /// The cycle.
    pub cycle: String,
    /// The new instances of every case that the cycle leaves; of those that differ.
    pub cases: Vec<Vec<Instance>>,
}

/// One choice at every fork.
#[derive(Clone, Debug)]
pub struct Case {
    /// The variables that are no longer unknowns.
    pub instances: Vec<Instance>,
    /// The basis of what remains, in the ring of all variables; instances do not occur in it.
    pub basis: GroebnerBasis,
    /// Complex dimension of the solutions of this case in the variables of its part.
    pub dimension: usize,
}

impl Case {
    /// Its equations, instances included.
    fn equations(&self) -> Vec<Polynomial> {
        let instances = self.instances.iter().map(|instance| {
            let variables = instance.value.variables();
            &Polynomial::variable(instance.variable, variables) - &instance.value
        });
        instances
            .chain(self.basis.polynomials().iter().cloned())
            .collect()
    }
}

/// The result of incremental instancing: in every part the solutions are the union of its cases, and as parts share no
/// variable, all combinations of cases are solutions of the whole.
#[derive(Clone, Debug)]
pub struct Incremental {
    /// For every part one step per cycle and case, then one per case for what remains.
    pub steps: Vec<Step>,
    /// By part all cases that have solutions, complex ones included.
    pub parts: Vec<Vec<Case>>,
    /// Variables that occur in no equation.
    pub unused: usize,
    /// Every cycle of every part, and what it determined.
    pub learned: Vec<Learned>,
    /// Whether there was a choice anywhere: if not, the one case has the same ideal as the equations.
    pub forked: bool,
    /// Cycles at which a case turned out to have no solution.
    pub contradictions: Vec<String>,
    /// Whether a choice was left as an equation because there were too many cases.
    pub unsplit: bool,
}

impl Incremental {
    /// The largest dimension of the solutions; `None` if there is none.
    #[must_use]
    pub fn dimension(&self) -> Option<usize> {
        let largest = |cases: &Vec<Case>| cases.iter().map(|case| case.dimension).max();
        let parts = self.parts.iter().map(largest).sum::<Option<usize>>();
        parts.map(|dimension| dimension + self.unused)
    }

    /// Equations of the whole that are cheaper to work with: those of the one case where there was no choice, else `all`.
    pub(crate) fn simpler(&self, all: &[Polynomial]) -> Vec<Polynomial> {
        let only: Option<Vec<&Case>> = self.parts.iter().map(|cases| cases.first()).collect();
        match only {
            Some(only) if !self.forked => only.iter().flat_map(|case| case.equations()).collect(),
            _ => all.to_vec(),
        }
    }

    /// Sets of unknowns that are free in the cases of the largest dimension, a set for every part put together, at most so
    /// many.
    pub(crate) fn free(&self, variables: usize, most: usize) -> Vec<Vec<usize>> {
        let mut sets: Vec<Vec<usize>> = vec![Vec::new()];
        let mut mentioned = vec![false; variables];
        for cases in &self.parts {
            let largest = cases.iter().map(|case| case.dimension).max();
            let largest = cases.iter().filter(|case| Some(case.dimension) == largest);
            let own = self.variables_of(cases, variables);
            own.iter().for_each(|&v| mentioned[v] = true);
            let mut of_part: Vec<Vec<usize>> = Vec::new();
            for case in largest {
                let instanced = |v: &usize| case.instances.iter().any(|i| i.variable == *v);
                for set in case.basis.independent_sets(most) {
                    let set: Vec<usize> = set
                        .into_iter()
                        .filter(|v| own.contains(v) && !instanced(v))
                        .collect();
                    if !of_part.contains(&set) {
                        of_part.push(set);
                    }
                }
            }
            let joined = sets
                .iter()
                .flat_map(|a| of_part.iter().map(move |b| [&a[..], b].concat()));
            sets = joined.take(most).collect();
        }
        let unused: Vec<usize> = (0..variables).filter(|&v| !mentioned[v]).collect();
        for set in &mut sets {
            set.extend(&unused);
            set.sort_unstable();
        }
        sets.sort();
        sets
    }

    /// The unknowns that the cases of a part speak of.
    fn variables_of(&self, cases: &[Case], variables: usize) -> Vec<usize> {
        let equations: Vec<Polynomial> = cases.iter().flat_map(Case::equations).collect();
        mentioned(&equations, variables)
    }

    /// The equations of every combination of cases; `None` where there are more than so many.
    pub(crate) fn combined(&self, most: usize) -> Option<Vec<Vec<Polynomial>>> {
        if self.combinations() > most {
            return None;
        }
        let mut all: Vec<Vec<Polynomial>> = vec![Vec::new()];
        for cases in &self.parts {
            let own: Vec<Vec<Polynomial>> = cases.iter().map(Case::equations).collect();
            all = all
                .iter()
                .flat_map(|a| own.iter().map(move |b| [&a[..], b].concat()))
                .collect();
        }
        Some(all)
    }

    /// Number of combinations of cases.
    #[must_use]
    pub fn combinations(&self) -> usize {
        let counts = self.parts.iter().map(Vec::len);
        counts.fold(1, usize::saturating_mul)
    }
}

/// What is known in a case on the way.
#[derive(Clone, Debug, Default)]
struct Known {
    instances: Vec<Instance>,
    /// Relations of the cycles so far, without the instances.
    relations: Vec<Polynomial>,
}

/// Works through the groups, the smallest first, for every independent part by itself.
///
/// Ruiz (1994), section 5.5.2, with three changes. A polynomial that factors opens one case per factor, all of which are
/// carried on; every relation of first degree removes a variable, not only those that give it a value; and cases of cycles
/// that share no joint, not even through others, are not multiplied.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn incremental_instancing(problem: &Problem, budget: &Budget) -> Result<Incremental, Stop> {
    let mut result = Incremental {
        steps: Vec::new(),
        parts: Vec::new(),
        unused: problem.variables - mentioned(&problem.equations, problem.variables).len(),
        learned: Vec::new(),
        forked: false,
        contradictions: Vec::new(),
        unsplit: false,
    };
    for part in problem.independent() {
        let cases = result.cases_of(&part, budget)?;
        result.parts.push(cases);
    }
    Ok(result)
}

impl Incremental {
    /// All cases of one part.
    fn cases_of(&mut self, part: &Problem, budget: &Budget) -> Result<Vec<Case>, Stop> {
        let variables = part.variables;
        let mut open = vec![Known::default()];
        for group in part.smallest_first() {
            let mut next: Vec<Known> = Vec::new();
            let mut left = open.len();
            let mut learned = Vec::new();
            for known in open {
                left -= 1;
                let equations = known.with(&part.equations_of(group));
                let clock = Clock::start(budget);
                let room = MOST_CASES.saturating_sub(next.len() + left).max(1);
                let pieces = pieces(&equations, variables, room, budget)?;
                self.unsplit |= pieces.unsplit;
                self.forked |= pieces.forked;
                if let Some(first) = pieces.whole {
                    let n = mentioned(&equations, variables).len();
                    let absent = variables - n;
                    let step = clock.step(&group.name, n, equations.len(), &first, absent);
                    self.steps.push(step);
                }
                if pieces.bases.is_empty() {
                    self.contradictions.push(group.name.clone());
                }
                for basis in &pieces.bases {
                    let wiser = known.learning(basis);
                    let new = wiser.instances[known.instances.len()..].to_vec();
                    if !learned.contains(&new) {
                        learned.push(new);
                    }
                    next.push(wiser);
                }
            }
            self.learned.push(Learned {
                cycle: group.name.clone(),
                cases: learned,
            });
            open = next;
        }
        let own = mentioned(&part.equations, variables).len();
        let rest = part.ungrouped();
        let mut cases = Vec::new();
        for known in open {
            let mut equations = known.with(&rest);
            equations.extend(known.relations.iter().cloned());
            equations.dedup();
            let clock = Clock::start(budget);
            let basis = basis_by_parts(&equations, variables, &MonomialOrder::Degrevlex, budget)?;
            let n = mentioned(&equations, variables).len();
            let step = clock.step("what remains", n, equations.len(), &basis, variables - n);
            self.steps.push(step);
            match basis.dimension() {
                None => self.contradictions.push("what remains".to_owned()),
                Some(dimension) => cases.push(Case {
                    dimension: dimension - known.instances.len() - (variables - own),
                    instances: known.instances,
                    basis,
                }),
            }
        }
        Ok(cases)
    }
}

impl Known {
    /// Equations with the instances put in, zero ones left out, together with the relations about the same variables.
    fn with(&self, equations: &[Polynomial]) -> Vec<Polynomial> {
        let mut reduced: Vec<Polynomial> = equations
            .iter()
            .map(|p| {
                self.instances
                    .iter()
                    .fold(p.clone(), |p, i| replaced(&p, i))
            })
            .filter(|p| !p.is_zero())
            .collect();
        let known = about_the_same(&self.relations, &reduced);
        reduced.extend(known);
        reduced
    }

    /// What is known once a basis holds as well.
    fn learning(&self, basis: &GroebnerBasis) -> Self {
        let mut known = self.clone();
        let mut relations = Vec::new();
        for polynomial in basis.polynomials() {
            match as_instance(polynomial) {
                // A reduced basis has no instanced variable in its other polynomials.
                Some(instance) => {
                    for earlier in &mut known.instances {
                        earlier.value = replaced(&earlier.value, &instance);
                    }
                    known.relations = known
                        .relations
                        .iter()
                        .map(|p| replaced(p, &instance))
                        .filter(|p| !p.is_zero())
                        .collect();
                    known.instances.push(instance);
                }
                None => relations.push(polynomial.clone()),
            }
        }
        for relation in relations {
            if !known.relations.contains(&relation) {
                known.relations.push(relation);
            }
        }
        known
    }
}

/// A polynomial of first degree as an instance of its leading variable.
fn as_instance(polynomial: &Polynomial) -> Option<Instance> {
    if polynomial.degree() != 1 {
        return None;
    }
    let (exponents, coefficient) = polynomial.terms().next()?;
    let variable = exponents.iter().position(|&e| e > 0)?;
    let head = Polynomial::variable(variable, polynomial.variables());
    let value = &head - &polynomial.scaled(&coefficient.recip());
    Some(Instance { variable, value })
}

/// A polynomial with an instance put in: Σ aₖ xᵏ becomes Σ aₖ vᵏ, by Horner's rule.
fn replaced(polynomial: &Polynomial, instance: &Instance) -> Polynomial {
    let x = instance.variable;
    if !polynomial.mentions(x) {
        return polynomial.clone();
    }
    let variables = polynomial.variables();
    let mut by_power: Vec<Vec<(Vec<u32>, Rational)>> =
        vec![Vec::new(); polynomial.degree_in(x) as usize + 1];
    for (exponents, coefficient) in polynomial.terms() {
        let mut rest = exponents.to_vec();
        let power = std::mem::take(&mut rest[x]);
        by_power[power as usize].push((rest, coefficient.clone()));
    }
    let coefficients = by_power.into_iter().rev();
    coefficients.fold(Polynomial::zero(variables), |sum, terms| {
        &(&sum * &instance.value) + &Polynomial::from_terms(terms, variables)
    })
}

/// A set of equations taken apart.
struct Pieces {
    /// The basis of all of them, if it was needed.
    whole: Option<GroebnerBasis>,
    /// One basis per piece that has solutions.
    bases: Vec<GroebnerBasis>,
    /// Whether something that factors was left as it is.
    unsplit: bool,
    /// Whether there was anything to choose.
    forked: bool,
}

/// Takes equations apart along the factors of their basis, into at most `room` pieces.
fn pieces(
    equations: &[Polynomial],
    variables: usize,
    room: usize,
    budget: &Budget,
) -> Result<Pieces, Stop> {
    let mut pieces = Pieces {
        whole: None,
        bases: Vec::new(),
        unsplit: false,
        forked: false,
    };
    let mut open = vec![equations.to_vec()];
    while let Some(equations) = open.pop() {
        let local = Local::new(&equations, variables);
        let small = local.basis(&MonomialOrder::Degrevlex, budget)?;
        if pieces.whole.is_none() {
            pieces.whole = Some(in_large_ring(&local, &small, variables)?);
        }
        if small.is_inconsistent() {
            continue;
        }
        match first_choice(&small, budget)? {
            Some(choices) if pieces.bases.len() + open.len() + choices.len() <= room => {
                pieces.forked = true;
                // The last one pushed is worked on first: in reverse, so that the order is that of the factors.
                for choice in choices.iter().rev() {
                    let mut with: Vec<Polynomial> =
                        small.polynomials().iter().map(|p| local.lift(p)).collect();
                    with.push(local.lift(choice));
                    open.push(with);
                }
            }
            choice => {
                pieces.unsplit |= choice.is_some();
                pieces.bases.push(in_large_ring(&local, &small, variables)?);
            }
        }
    }
    Ok(pieces)
}

/// The factors of the first basis polynomial that has several, or one that is a power.
fn first_choice(basis: &GroebnerBasis, budget: &Budget) -> Result<Option<Vec<Polynomial>>, Stop> {
    for polynomial in basis.polynomials() {
        if polynomial.degree() < 2 {
            continue;
        }
        let factors = factor(polynomial, budget)?.factors;
        let power = factors.iter().any(|(_, exponent)| *exponent > 1);
        if factors.len() > 1 || power {
            return Ok(Some(
                factors.into_iter().map(|(factor, _)| factor).collect(),
            ));
        }
    }
    Ok(None)
}

fn in_large_ring(
    local: &Local,
    basis: &GroebnerBasis,
    variables: usize,
) -> Result<GroebnerBasis, Stop> {
    let parts = [(basis.clone(), local.variables.clone())];
    GroebnerBasis::of_parts(&parts, variables, basis.order())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::components::components_of;
    use crate::strategy::Group;
    use crate::{Hints, components, groebner_basis};

    #[test]
    fn cases_tell_what_the_basis_of_the_whole_tells() {
        // Two parts: x² = 1 with y = x z, and u v = 0; w is in no equation.
        let [x, y, z, u, v] = [0, 1, 2, 3, 4].map(|i| Polynomial::variable(i, 6));
        let one = Polynomial::one(6);
        let equations = vec![&(&x * &x) - &one, &y - &(&x * &z), &u * &v];
        let group = |name: &str, equations: &[usize]| Group {
            name: name.to_owned(),
            equations: equations.to_vec(),
        };
        let problem = Problem {
            variables: 6,
            equations: equations.clone(),
            groups: vec![group("C1", &[0]), group("C2", &[1]), group("C3", &[2])],
        };
        let budget = Budget::unlimited();
        let cases = incremental_instancing(&problem, &budget).unwrap();
        assert!(cases.forked);
        let order = MonomialOrder::Degrevlex;
        let basis = groebner_basis(&equations, 6, &order, &budget).unwrap();
        assert_eq!(cases.dimension(), basis.dimension());
        let free = cases.free(6, 9);
        assert_eq!(
            free,
            [[1, 3, 5], [1, 4, 5], [2, 3, 5], [2, 4, 5]].map(|set| set.to_vec())[2..].to_vec()
        );
        assert_eq!(cases.combined(3), None);
        let all = cases.combined(4).unwrap();
        let hints = Hints::default();
        assert_eq!(
            components_of(&all, 6, &hints, &budget).unwrap(),
            components(&equations, 6, &hints, &budget).unwrap()
        );
        let first = cases
            .learned
            .iter()
            .find(|learned| learned.cycle == "C1")
            .unwrap();
        let values: Vec<Polynomial> = first
            .cases
            .iter()
            .map(|case| case[0].value.clone())
            .collect();
        assert!(
            values.contains(&one) && values.contains(&-&one),
            "{values:?}"
        );
    }
}
