//! Equations in groups: one group per basic cycle.

use crate::algebra::{Budget, GroebnerBasis, MonomialOrder, Polynomial, Stop, groebner_basis};
use std::collections::BTreeSet;

/// Equations that belong together, such as those of one cycle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// What a person calls it.
    pub name: String,
    /// Indices of its equations.
    pub equations: Vec<usize>,
}

/// A system of equations and how it falls into groups. An equation may belong to several groups or to none.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Number of variables of the ring.
    pub variables: usize,
    /// All equations.
    pub equations: Vec<Polynomial>,
    /// The groups.
    pub groups: Vec<Group>,
}

impl Problem {
    /// The equations of a group.
    pub fn equations_of(&self, group: &Group) -> Vec<Polynomial> {
        group
            .equations
            .iter()
            .filter_map(|&index| self.equations.get(index).cloned())
            .collect()
    }

    /// The groups, those with the fewest variables first: what a short cycle determines makes the longer ones small.
    pub fn smallest_first(&self) -> Vec<&Group> {
        let size = |group: &&Group| {
            (0..self.variables)
                .filter(|&v| {
                    let equations = group.equations.iter();
                    equations
                        .filter_map(|&e| self.equations.get(e))
                        .any(|p| p.mentions(v))
                })
                .count()
        };
        let mut groups: Vec<&Group> = self.groups.iter().collect();
        groups.sort_by_key(size);
        groups
    }

    /// The equations that belong to no group.
    pub fn ungrouped(&self) -> Vec<Polynomial> {
        let grouped: BTreeSet<usize> = self
            .groups
            .iter()
            .flat_map(|group| group.equations.iter().copied())
            .collect();
        self.equations
            .iter()
            .enumerate()
            .filter(|(index, _)| !grouped.contains(index))
            .map(|(_, equation)| equation.clone())
            .collect()
    }
}

/// Those polynomials that hold no other variables than `equations` do: what they say may be used together with these.
pub(super) fn about_the_same<'a>(
    polynomials: impl IntoIterator<Item = &'a Polynomial>,
    equations: &[Polynomial],
) -> Vec<Polynomial> {
    let touched = |v: usize| equations.iter().any(|p| p.mentions(v));
    polynomials
        .into_iter()
        .filter(|p| (0..p.variables()).all(|v| !p.mentions(v) || touched(v)))
        .filter(|p| !equations.contains(p))
        .cloned()
        .collect()
}

/// Some equations in the ring of just the variables that occur in them.
pub(in crate::algebra) struct Local {
    /// The variables of the large ring, in its order.
    pub(in crate::algebra) variables: Vec<usize>,
    /// Number of variables of the large ring.
    all: usize,
    /// The equations in the small ring.
    pub(in crate::algebra) equations: Vec<Polynomial>,
}

impl Local {
    /// Moves equations into the ring of their own variables.
    pub(in crate::algebra) fn new(equations: &[Polynomial], all: usize) -> Self {
        let variables: Vec<usize> = (0..all)
            .filter(|&v| equations.iter().any(|p| p.mentions(v)))
            .collect();
        let mut places = vec![0; all];
        for (place, &variable) in variables.iter().enumerate() {
            places[variable] = place;
        }
        let equations = equations
            .iter()
            .map(|p| {
                let terms = p.terms().map(|(exponents, coefficient)| {
                    let kept = variables.iter().map(|&v| exponents[v]).collect();
                    (kept, coefficient.clone())
                });
                Polynomial::from_terms(terms.collect(), variables.len())
            })
            .collect();
        Self {
            variables,
            all,
            equations,
        }
    }

    /// Equations in the ring of all variables.
    pub(in crate::algebra) fn whole(equations: &[Polynomial], all: usize) -> Self {
        Self {
            variables: (0..all).collect(),
            all,
            equations: equations.to_vec(),
        }
    }

    /// The basis of the equations, in the small ring.
    pub(in crate::algebra) fn basis(
        &self,
        order: &MonomialOrder,
        budget: &Budget,
    ) -> Result<GroebnerBasis, Stop> {
        groebner_basis(&self.equations, self.variables.len(), order, budget)
    }

    /// A polynomial of the large ring that mentions only variables of the small one, there.
    pub(in crate::algebra) fn lower(&self, polynomial: &Polynomial) -> Polynomial {
        let mut places = vec![0; self.all];
        for (place, &variable) in self.variables.iter().enumerate() {
            places[variable] = place;
        }
        polynomial.moved(&places, self.variables.len())
    }

    /// A polynomial of the small ring in the large one.
    pub(in crate::algebra) fn lift(&self, polynomial: &Polynomial) -> Polynomial {
        polynomial.moved(&self.variables, self.all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn local_rings_keep_the_order_of_the_variables() {
        let [_, y, z] = [0, 1, 2].map(|i| Polynomial::variable(i, 3));
        let p = &(&y * &y) - &z;
        let local = Local::new(std::slice::from_ref(&p), 3);
        assert_eq!(local.variables, [1, 2]);
        assert_eq!(local.equations[0].variables(), 2);
        assert_eq!(local.lift(&local.equations[0]), p);
    }

    #[test]
    fn equations_without_a_group_are_not_forgotten() {
        let p = Polynomial::variable(0, 2);
        let q = Polynomial::variable(1, 2);
        let problem = Problem {
            variables: 2,
            equations: vec![p.clone(), q.clone()],
            groups: vec![Group {
                name: "C1".to_owned(),
                equations: vec![0],
            }],
        };
        assert_eq!(problem.equations_of(&problem.groups[0]), [p]);
        assert_eq!(problem.ungrouped(), [q]);
    }
}
