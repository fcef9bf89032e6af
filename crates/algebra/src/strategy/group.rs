//! Equations in groups: one group per basic cycle.

use crate::{Budget, GroebnerBasis, MonomialOrder, Polynomial, Stop, groebner_basis};
use petgraph::unionfind::UnionFind;
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

    /// Problems that share no variable and no group, each in the ring of all variables.
    pub(crate) fn independent(&self) -> Vec<Self> {
        let tied = self.groups.iter().map(|g| g.equations.as_slice());
        independent_parts(&self.equations, self.variables, tied)
            .into_iter()
            .map(|part| {
                let place = |index: &usize| part.binary_search(index).ok();
                let groups = self.groups.iter().filter_map(|group| {
                    let equations: Option<Vec<usize>> = group.equations.iter().map(place).collect();
                    let equations = equations.filter(|e| !e.is_empty())?;
                    Some(Group {
                        name: group.name.clone(),
                        equations,
                    })
                });
                Self {
                    variables: self.variables,
                    groups: groups.collect(),
                    equations: part.iter().map(|&i| self.equations[i].clone()).collect(),
                }
            })
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

/// Numbers of polynomials that belong together because they share variables, directly or through others: each set
/// ascending, in the order of their first members. Polynomials without a variable are sets of their own. Those `tied` are not
/// parted in any case.
pub(super) fn independent_parts<'a>(
    polynomials: &[Polynomial],
    variables: usize,
    tied: impl IntoIterator<Item = &'a [usize]>,
) -> Vec<Vec<usize>> {
    // The first polynomial that mentions a variable stands for it.
    let mut first = vec![None; variables];
    let mut parts = UnionFind::<usize>::new(polynomials.len());
    for set in tied {
        for pair in set.windows(2) {
            parts.union(pair[0], pair[1]);
        }
    }
    for (index, polynomial) in polynomials.iter().enumerate() {
        for (variable, first) in first.iter_mut().enumerate() {
            if polynomial.mentions(variable) {
                parts.union(*first.get_or_insert(index), index);
            }
        }
    }
    let mut sets: Vec<(usize, Vec<usize>)> = Vec::new();
    for index in 0..polynomials.len() {
        let root = parts.find(index);
        match sets.iter_mut().find(|(r, _)| *r == root) {
            Some((_, set)) => set.push(index),
            None => sets.push((root, vec![index])),
        }
    }
    sets.into_iter().map(|(_, set)| set).collect()
}

/// The basis of equations, found for each independent part by itself.
pub(crate) fn basis_by_parts(
    equations: &[Polynomial],
    variables: usize,
    order: &MonomialOrder,
    budget: &Budget,
) -> Result<GroebnerBasis, Stop> {
    let mut parts = Vec::new();
    for part in independent_parts(equations, variables, []) {
        let equations: Vec<Polynomial> = part.iter().map(|&i| equations[i].clone()).collect();
        let local = Local::new(&equations, variables);
        parts.push((local.basis(order, budget)?, local.variables));
    }
    GroebnerBasis::of_parts(&parts, variables, order)
}

/// The variables that occur in some equations, ascending.
pub(super) fn mentioned(equations: &[Polynomial], all: usize) -> Vec<usize> {
    (0..all)
        .filter(|&v| equations.iter().any(|p| p.mentions(v)))
        .collect()
}

/// Some equations in the ring of just the variables that occur in them.
pub(crate) struct Local {
    /// The variables of the large ring, in its order.
    pub(crate) variables: Vec<usize>,
    /// Number of variables of the large ring.
    all: usize,
    /// The equations in the small ring.
    pub(crate) equations: Vec<Polynomial>,
}

impl Local {
    /// Moves equations into the ring of their own variables.
    pub(crate) fn new(equations: &[Polynomial], all: usize) -> Self {
        let variables = mentioned(equations, all);
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
    pub(crate) fn whole(equations: &[Polynomial], all: usize) -> Self {
        Self {
            variables: (0..all).collect(),
            all,
            equations: equations.to_vec(),
        }
    }

    /// The basis of the equations, in the small ring.
    pub(crate) fn basis(
        &self,
        order: &MonomialOrder,
        budget: &Budget,
    ) -> Result<GroebnerBasis, Stop> {
        let order = match *order {
            MonomialOrder::Elimination(first) => {
                MonomialOrder::Elimination(self.variables.partition_point(|&v| v < first))
            }
            ref order => order.clone(),
        };
        groebner_basis(&self.equations, self.variables.len(), &order, budget)
    }

    /// A polynomial of the large ring that mentions only variables of the small one, there.
    pub(crate) fn lower(&self, polynomial: &Polynomial) -> Polynomial {
        let mut places = vec![0; self.all];
        for (place, &variable) in self.variables.iter().enumerate() {
            places[variable] = place;
        }
        polynomial.moved(&places, self.variables.len())
    }

    /// A polynomial of the small ring in the large one.
    pub(crate) fn lift(&self, polynomial: &Polynomial) -> Polynomial {
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
    fn what_shares_no_variable_is_told_apart() {
        let x = |i: usize| Polynomial::variable(i, 6);
        let all = [
            &x(0) - &x(1),
            &x(2) * &x(3),
            Polynomial::one(6),
            &x(1) + &x(4),
            x(3),
        ];
        assert_eq!(
            independent_parts(&all, 6, []),
            [vec![0, 3], vec![1, 4], vec![2]]
        );
        assert_eq!(
            independent_parts(&all, 6, [[2, 4].as_slice()]),
            [vec![0, 3], vec![1, 2, 4]]
        );
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
