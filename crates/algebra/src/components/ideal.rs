//! What the leading monomials of a basis say: independent variables and degree.

use crate::engine::{Budget, MonomialOrder, Stop, groebner_basis};
use crate::polynomial::Polynomial;
use std::cmp::Ordering;

/// Most independent sets that are looked at.
const MOST_SETS: usize = 4_000;

/// The exponents of the largest term in degrevlex.
pub(super) fn head(polynomial: &Polynomial) -> Vec<u32> {
    polynomial
        .terms()
        .next()
        .map(|(exponents, _)| exponents.to_vec())
        .unwrap_or_default()
}

/// Degrevlex: by degree, ties by the smaller power of the last variable.
pub(super) fn compare(a: &[u32], b: &[u32]) -> Ordering {
    let total = |m: &[u32]| m.iter().sum::<u32>();
    total(a)
        .cmp(&total(b))
        .then_with(|| b.iter().rev().cmp(a.iter().rev()))
}

/// The largest sets of variables of which no product is a head: the dimension is their size (Kredel and Weispfenning 1988).
///
/// In lexicographic order, as many as fit a limit; the flag says whether these are all of that size.
pub(super) fn independent_sets(heads: &[Vec<u32>], variables: usize) -> (Vec<Vec<usize>>, bool) {
    let supports: Vec<Vec<usize>> = heads
        .iter()
        .map(|head| (0..variables).filter(|&v| head[v] > 0).collect())
        .collect();
    let mut search = SetSearch {
        supports: &supports,
        variables,
        best: Vec::new(),
        all: true,
    };
    search.extend(&mut Vec::new(), 0);
    (search.best, search.all)
}

struct SetSearch<'a> {
    supports: &'a [Vec<usize>],
    variables: usize,
    best: Vec<Vec<usize>>,
    all: bool,
}

impl SetSearch<'_> {
    fn extend(&mut self, set: &mut Vec<usize>, next: usize) {
        let size = self.best.first().map_or(0, Vec::len);
        if set.len() > size {
            self.best.clear();
            self.all = true;
        }
        if set.len() >= size {
            if self.best.len() < MOST_SETS {
                self.best.push(set.clone());
            } else {
                self.all = false;
            }
        }
        for variable in next..self.variables {
            let size = self.best.first().map_or(0, Vec::len);
            if set.len() + self.variables - variable < size {
                return;
            }
            set.push(variable);
            let dependent = self
                .supports
                .iter()
                .any(|s| s.contains(&variable) && s.iter().all(|v| set.contains(v)));
            if !dependent {
                self.extend(set, variable + 1);
            }
            set.pop();
        }
    }
}

/// How many monomials in the other variables no head divides where the given variables may have any power; `None` where
/// there are infinitely many. This is how often the heads count along the coordinate plane of these variables.
pub(super) fn local_degree(heads: &[Vec<u32>], free: &[usize], variables: usize) -> Option<usize> {
    let others: Vec<usize> = (0..variables).filter(|v| !free.contains(v)).collect();
    let reduced: Vec<Vec<u32>> = heads
        .iter()
        .map(|head| others.iter().map(|&v| head[v]).collect())
        .collect();
    let bounds: Option<Vec<u32>> = (0..others.len())
        .map(|i| {
            reduced
                .iter()
                .filter(|m| m.iter().enumerate().all(|(j, &e)| j == i || e == 0))
                .map(|m| m[i])
                .min()
        })
        .collect();
    bounds.map(|_| count_below(&reduced, &mut vec![0; others.len()], 0))
}

/// The monomials that extend the first exponents and that no head divides.
fn count_below(heads: &[Vec<u32>], monomial: &mut Vec<u32>, next: usize) -> usize {
    let divided = heads
        .iter()
        .any(|h| h.iter().zip(monomial.iter()).all(|(a, b)| a <= b));
    if divided {
        return 0;
    }
    if next == monomial.len() {
        return 1;
    }
    let mut count = 0;
    loop {
        let more = count_below(heads, monomial, next + 1);
        count += more;
        if more == 0 {
            break;
        }
        monomial[next] += 1;
    }
    monomial[next] = 0;
    count
}

/// The degree of the largest-dimensional part, multiplicities counted; `None` where too many sets had to be looked at.
pub(super) fn degree(heads: &[Vec<u32>], variables: usize) -> Option<usize> {
    let (sets, all) = independent_sets(heads, variables);
    if !all {
        return None;
    }
    sets.iter()
        .map(|set| local_degree(heads, set, variables))
        .sum()
}

/// The reduced degrevlex basis.
pub(super) fn degrevlex(
    equations: &[Polynomial],
    variables: usize,
    budget: &Budget,
) -> Result<Vec<Polynomial>, Stop> {
    let basis = groebner_basis(equations, variables, &MonomialOrder::Degrevlex, budget)?;
    Ok(basis.polynomials().to_vec())
}

/// Whether these polynomials contradict one another, given as a reduced basis.
pub(super) fn is_one(basis: &[Polynomial]) -> bool {
    basis.iter().any(|p| p.degree() == 0 && !p.is_zero())
}

/// A basis in which every monomial with one of the `front` variables is larger than all without.
pub(super) fn with_front(
    equations: &[Polynomial],
    variables: usize,
    front: &[usize],
    budget: &Budget,
) -> Result<Vec<Polynomial>, Stop> {
    let back = (0..variables).filter(|v| !front.contains(v));
    let sequence: Vec<usize> = front.iter().copied().chain(back).collect();
    let mut places = vec![0; variables];
    for (place, &variable) in sequence.iter().enumerate() {
        places[variable] = place;
    }
    let moved: Vec<Polynomial> = equations
        .iter()
        .map(|p| p.moved(&places, variables))
        .collect();
    let order = MonomialOrder::Elimination(front.len());
    let basis = groebner_basis(&moved, variables, &order, budget)?;
    Ok(basis
        .polynomials()
        .iter()
        .map(|p| p.moved(&sequence, variables))
        .collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn degrees_of_monomial_ideals() {
        // x·y = 0 in space: two planes. x² = 0: a double plane.
        let planes = [vec![1, 1, 0]];
        let (sets, all) = independent_sets(&planes, 3);
        assert_eq!((sets, all), (vec![vec![0, 2], vec![1, 2]], true));
        assert_eq!(degree(&planes, 3), Some(2));
        assert_eq!(degree(&[vec![2, 0, 0]], 3), Some(2));
        assert_eq!(degree(&[vec![2, 0], vec![1, 1], vec![0, 3]], 2), Some(4));
        assert_eq!(local_degree(&planes, &[2], 3), None);
    }

    #[test]
    fn bases_with_chosen_variables_in_front() {
        let (x, y) = (Polynomial::variable(0, 2), Polynomial::variable(1, 2));
        let equations = [&(&x * &y) - &Polynomial::one(2), &x.power(2) - &y];
        let budget = Budget::unlimited();
        let without = |front: usize, basis: &[Polynomial]| {
            basis.iter().filter(|p| !p.mentions(front)).count()
        };
        for front in 0..2 {
            let basis = with_front(&equations, 2, &[front], &budget).unwrap();
            assert_eq!(without(front, &basis), 1);
        }
    }
}
