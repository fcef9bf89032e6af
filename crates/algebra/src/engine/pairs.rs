//! Critical pairs and the criteria of Gebauer and Moller (1988): which S-polynomials need no reduction.
//!
//! Becker and Weispfenning, "Groebner Bases" (1993), section 5.5.

use super::budget::{Budget, Stop};
use super::monomials::{degree, divides, divisibility_mask};

/// Two elements of the basis whose leading monomials meet in `lcm`.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    pub(super) first: usize,
    pub(super) second: usize,
    pub(super) lcm: Box<[u16]>,
    mask: u64,
    /// Degree that the S-polynomial would have, had the input been homogeneous (Giovini et al. 1991).
    pub(super) sugar: u32,
}

/// What the criteria need to know of an element.
#[derive(Clone, Debug)]
pub(super) struct Head {
    pub(super) lead: Box<[u16]>,
    pub(super) mask: u64,
    pub(super) sugar: u32,
    /// Whether its leading monomial is not a multiple of a later one.
    pub(super) active: bool,
}

impl Head {
    pub(super) fn new(lead: &[u16], sugar: u32) -> Self {
        Self {
            lead: lead.into(),
            mask: divisibility_mask(lead),
            sugar,
            active: true,
        }
    }
}

/// Effort of making a pair, beside that of looking whether another one divides it.
const EFFORT_OF_PAIR: u64 = 100;

/// Pairs that are still to be reduced.
#[derive(Debug, Default)]
pub(super) struct Pairs {
    pub(super) heads: Vec<Head>,
    waiting: Vec<Pair>,
}

impl Pairs {
    pub(super) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    pub(super) fn len(&self) -> usize {
        self.waiting.len()
    }

    /// Takes all pairs of the smallest sugar.
    pub(super) fn select(&mut self) -> Vec<Pair> {
        let Some(least) = self.waiting.iter().map(|pair| pair.sugar).min() else {
            return Vec::new();
        };
        let (selected, rest) = std::mem::take(&mut self.waiting)
            .into_iter()
            .partition(|pair| pair.sugar == least);
        self.waiting = rest;
        selected
    }

    /// Adds an element with its pairs.
    pub(super) fn add(&mut self, head: Head, budget: &Budget) -> Result<(), Stop> {
        if head.lead.iter().all(|&e| e == 0) {
            // The whole ring: nothing is left to do.
            self.waiting.clear();
            for other in &mut self.heads {
                other.active = false;
            }
            self.heads.push(head);
            return Ok(());
        }
        let new = self.pairs_with(&head, budget)?;
        let heads = &self.heads;
        let makes = |i: usize, lcm: &[u16]| {
            let pairs = heads[i].lead.iter().zip(&head.lead);
            pairs.zip(lcm).all(|((a, b), c)| a.max(b) == c)
        };
        self.waiting.retain(|pair| {
            head.mask & !pair.mask != 0
                || !divides(&head.lead, &pair.lcm)
                || makes(pair.first, &pair.lcm)
                || makes(pair.second, &pair.lcm)
        });
        self.waiting.extend(new);
        for other in self.heads.iter_mut().filter(|other| other.active) {
            other.active = head.mask & !other.mask != 0 || !divides(&head.lead, &other.lead);
        }
        self.heads.push(head);
        Ok(())
    }

    /// Forgets the pairs of which neither leading monomial has some variable: they belong to a basis, and reduce to zero.
    pub(super) fn settle_without(&mut self, variable: usize) {
        let heads = &self.heads;
        let mentions = |i: usize| heads[i].lead.get(variable).is_some_and(|&e| e > 0);
        self.waiting
            .retain(|pair| mentions(pair.first) || mentions(pair.second));
    }

    /// The pairs of a new element that no other pair of it makes superfluous.
    fn pairs_with(&self, head: &Head, budget: &Budget) -> Result<Vec<Pair>, Stop> {
        struct Candidate {
            pair: Pair,
            degree: u32,
            coprime: bool,
        }
        let second = self.heads.len();
        let head_degree = degree(&head.lead);
        let mut candidates: Vec<Candidate> = Vec::new();
        for (first, other) in self.heads.iter().enumerate().filter(|(_, o)| o.active) {
            let both = other.lead.iter().zip(&head.lead);
            let lcm: Box<[u16]> = both.clone().map(|(a, b)| *a.max(b)).collect();
            let of_lcm = degree(&lcm);
            let sugar =
                (other.sugar + of_lcm - degree(&other.lead)).max(head.sugar + of_lcm - head_degree);
            candidates.push(Candidate {
                coprime: both.clone().all(|(&a, &b)| a == 0 || b == 0),
                degree: of_lcm,
                pair: Pair {
                    first,
                    second,
                    mask: divisibility_mask(&lcm),
                    lcm,
                    sugar,
                },
            });
        }
        // In order of degree a divisor comes before what it divides. Of equal ones a coprime pair comes first, because it
        // makes the others superfluous and then goes itself.
        candidates.sort_by_key(|c| (c.degree, !c.coprime));
        let mut kept: Vec<usize> = Vec::new();
        for (i, candidate) in candidates.iter().enumerate() {
            budget.toil(EFFORT_OF_PAIR + kept.len() as u64)?;
            let superfluous = kept.iter().any(|&k| {
                let smaller = &candidates[k].pair;
                smaller.mask & !candidate.pair.mask == 0
                    && divides(&smaller.lcm, &candidate.pair.lcm)
            });
            if !superfluous {
                kept.push(i);
            }
        }
        let mut keep = vec![false; candidates.len()];
        for k in kept {
            keep[k] = !candidates[k].coprime;
        }
        let kept = candidates.into_iter().zip(keep);
        Ok(kept
            .filter_map(|(c, keep)| keep.then_some(c.pair))
            .collect())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn pairs(leads: &[&[u16]]) -> Pairs {
        let mut pairs = Pairs::default();
        for lead in leads {
            let head = Head::new(lead, degree(lead));
            pairs.add(head, &Budget::unlimited()).unwrap();
        }
        pairs
    }

    #[test]
    fn coprime_pairs_are_superfluous() {
        assert!(pairs(&[&[2, 0], &[0, 3]]).is_empty());
        assert_eq!(pairs(&[&[2, 1], &[0, 3]]).len(), 1);
    }

    #[test]
    fn a_chain_needs_only_its_links() {
        // xy, yz, xz: all three meet in xyz; two pairs imply the third.
        assert_eq!(pairs(&[&[1, 1, 0], &[0, 1, 1], &[1, 0, 1]]).len(), 2);
    }

    #[test]
    fn a_constant_ends_everything() {
        let pairs = pairs(&[&[2, 1], &[1, 3], &[0, 0]]);
        assert!(pairs.is_empty());
        assert_eq!(pairs.heads.iter().filter(|h| h.active).count(), 1);
    }
}
