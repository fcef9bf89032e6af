//! Dimension and free variables, read off the leading monomials.
//!
//! A set of variables is independent modulo the leading ideal when no leading monomial is a product of these variables
//! alone. The largest number of independent variables is the dimension of the complex solution set (Kredel and Weispfenning
//! 1988; Cox, Little and O'Shea, "Ideals, Varieties, and Algorithms", section 9.1), in every monomial order. Such a set can
//! be chosen freely almost everywhere on some component of that dimension; which sets of that size the leading ideal shows
//! depends on the order.
//!
//! The complement of an independent set meets the variables of every leading monomial. So the search is one for the smallest
//! sets that meet given sets: branch and bound over sets of bits. Disjoint sets bound the size from below, and what shares no variable
//! is solved apart; that settles most systems with little branching. The worst case is exponential in the number of
//! variables, as the problem is NP-hard.

/// Variables as bits; missing words are zero.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Bits(Vec<u64>);

impl Bits {
    fn none(variables: usize) -> Self {
        Self(vec![0; variables.div_ceil(64)])
    }

    fn add(&mut self, variable: usize) {
        if self.0.len() <= variable / 64 {
            self.0.resize(variable / 64 + 1, 0);
        }
        self.0[variable / 64] |= 1 << (variable % 64);
    }

    fn has(&self, variable: usize) -> bool {
        let word = self.0.get(variable / 64).copied().unwrap_or(0);
        word >> (variable % 64) & 1 == 1
    }

    fn len(&self) -> u32 {
        self.0.iter().map(|word| word.count_ones()).sum()
    }

    fn meets(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).any(|(a, b)| a & b != 0)
    }

    fn is_within(&self, other: &Self) -> bool {
        self.without(other).len() == 0
    }

    fn join(&mut self, other: &Self) {
        let words = self.0.len().max(other.0.len());
        self.0.resize(words, 0);
        for (a, b) in self.0.iter_mut().zip(&other.0) {
            *a |= b;
        }
    }

    fn without(&self, other: &Self) -> Self {
        let theirs = other.0.iter().copied().chain(std::iter::repeat(0));
        Self(self.0.iter().zip(theirs).map(|(a, b)| a & !b).collect())
    }

    fn members(&self) -> impl Iterator<Item = usize> {
        (0..64 * self.0.len()).filter(|&v| self.has(v))
    }
}

/// The variables of monomials, as sets of which none contains another.
#[derive(Clone, Debug)]
pub(super) struct Supports {
    variables: usize,
    sets: Vec<Bits>,
}

impl Supports {
    pub(super) fn new<'a>(monomials: impl Iterator<Item = &'a [u32]>, variables: usize) -> Self {
        let sets = monomials
            .map(|monomial| {
                let mut bits = Bits::none(variables);
                for (variable, _) in monomial.iter().enumerate().filter(|&(_, &e)| e > 0) {
                    bits.add(variable);
                }
                bits
            })
            .collect();
        Self {
            variables,
            sets: minimal(sets),
        }
    }

    /// The largest number of independent variables; `None` where a monomial is 1.
    pub(super) fn dimension(&self) -> Option<usize> {
        self.dimension_with(Bits::none(self.variables))
    }

    /// The same among the independent sets that hold certain variables; `None` where there is none.
    fn dimension_with(&self, held: Bits) -> Option<usize> {
        let covers = smallest_covers(self.without(&held), u32::MAX, 1)?;
        Some(self.variables - covers.size as usize)
    }

    /// The sets without some variables.
    fn without(&self, variables: &Bits) -> Vec<Bits> {
        self.sets.iter().map(|set| set.without(variables)).collect()
    }

    /// Whether some largest independent set holds a variable.
    pub(super) fn is_free(&self, variable: usize) -> bool {
        let mut held = Bits::none(self.variables);
        held.add(variable);
        let with = self.dimension_with(held);
        with.is_some() && with == self.dimension()
    }

    /// Independent sets of largest size, at most `limit` of them, in lexicographic order.
    pub(super) fn independent_sets(&self, limit: usize) -> Vec<Vec<usize>> {
        let Some(covers) = smallest_covers(self.sets.clone(), u32::MAX, limit.max(1)) else {
            return Vec::new();
        };
        let mut sets: Vec<Vec<usize>> = covers
            .found
            .iter()
            .take(limit)
            .map(|cover| {
                let free = (0..self.variables).filter(|&v| !cover.has(v));
                free.collect()
            })
            .collect();
        sets.sort();
        sets
    }
}

/// Smallest sets of variables that meet given sets.
struct Covers {
    size: u32,
    found: Vec<Bits>,
}

/// The smallest sets that meet all of `open`, at most `limit` of them; `None` where they have more than `at_most` members or
/// a set is empty.
fn smallest_covers(open: Vec<Bits>, at_most: u32, limit: usize) -> Option<Covers> {
    let open = minimal(open);
    if open.first().is_some_and(|set| set.len() == 0) || lower_bound(&open) > at_most {
        return None;
    }
    let parts = connected(open);
    if parts.len() != 1 {
        return covers_of_parts(parts, at_most, limit);
    }
    let open = &parts[0];
    let smallest = open.first()?;
    // The variable that meets most sets first: it finds a small set early.
    let mut choices: Vec<(usize, usize)> = smallest
        .members()
        .map(|v| (open.iter().filter(|set| set.has(v)).count(), v))
        .collect();
    choices.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut best: Option<Covers> = None;
    let mut refused = Bits(Vec::new());
    for (_, variable) in choices {
        let useful = match &best {
            None => at_most,
            Some(best) if best.found.len() < limit => best.size,
            Some(best) => best.size - 1,
        };
        let rest = open.iter().filter(|set| !set.has(variable));
        let rest = rest.map(|set| set.without(&refused)).collect();
        let with = useful
            .checked_sub(1)
            .and_then(|left| smallest_covers(rest, left, limit));
        if let Some(mut with) = with {
            with.size += 1;
            for cover in &mut with.found {
                cover.add(variable);
            }
            match &mut best {
                Some(best) if best.size == with.size => {
                    let room = limit - best.found.len();
                    best.found.extend(with.found.into_iter().take(room));
                }
                _ => best = Some(with),
            }
        }
        // Sets with this variable are all found; the next ones do without.
        refused.add(variable);
    }
    best
}

/// The sets that have no other one within, smallest first.
fn minimal(mut sets: Vec<Bits>) -> Vec<Bits> {
    sets.sort_by_key(Bits::len);
    let mut kept: Vec<Bits> = Vec::new();
    for set in sets {
        if !kept.iter().any(|smaller| smaller.is_within(&set)) {
            kept.push(set);
        }
    }
    kept
}

/// Groups of sets that share no variable with those of other groups.
fn connected(sets: Vec<Bits>) -> Vec<Vec<Bits>> {
    let mut parts: Vec<(Bits, Vec<Bits>)> = Vec::new();
    for set in sets {
        let mut union = set.clone();
        let mut members = vec![set];
        parts.retain_mut(|(variables, others)| {
            let apart = !variables.meets(&union);
            if !apart {
                union.join(variables);
                members.append(others);
            }
            apart
        });
        parts.push((union, members));
    }
    let parts = parts.into_iter().map(|(_, mut members)| {
        members.sort_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
        members
    });
    parts.collect()
}

/// Every part has to be covered on its own; the covers are all combinations.
fn covers_of_parts(parts: Vec<Vec<Bits>>, at_most: u32, limit: usize) -> Option<Covers> {
    let bounds: Vec<u32> = parts.iter().map(|part| lower_bound(part)).collect();
    let mut others: u32 = bounds.iter().sum();
    let mut all = Covers {
        size: 0,
        found: vec![Bits(Vec::new())],
    };
    for (part, bound) in parts.into_iter().zip(bounds) {
        others -= bound;
        let left = at_most.checked_sub(all.size + others)?;
        let covers = smallest_covers(part, left, limit)?;
        all.size += covers.size;
        let pairs = all.found.iter().flat_map(|a| {
            covers.found.iter().map(|b| {
                let mut both = a.clone();
                both.join(b);
                both
            })
        });
        all.found = pairs.take(limit).collect();
    }
    Some(all)
}

/// Disjoint sets need one variable each.
fn lower_bound(open: &[Bits]) -> u32 {
    let mut disjoint: Vec<&Bits> = Vec::new();
    for set in open {
        if !disjoint.iter().any(|other| other.meets(set)) {
            disjoint.push(set);
        }
    }
    disjoint.len() as u32
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn supports(monomials: &[Vec<u32>], variables: usize) -> Supports {
        Supports::new(monomials.iter().map(Vec::as_slice), variables)
    }

    #[test]
    fn a_plane_and_a_line() {
        // xz, yz: the plane z = 0 and the line x = y = 0.
        let s = supports(&[vec![1, 0, 1], vec![0, 1, 1]], 3);
        assert_eq!(s.dimension(), Some(2));
        assert_eq!(s.independent_sets(9), [[0, 1]]);
        assert!(s.is_free(0) && s.is_free(1) && !s.is_free(2));
    }

    #[test]
    fn no_equation_leaves_all_free_and_one_leaves_nothing() {
        assert_eq!(supports(&[], 3).dimension(), Some(3));
        assert_eq!(supports(&[], 3).independent_sets(9), [[0, 1, 2]]);
        let contradiction = supports(&[vec![0, 0]], 2);
        assert_eq!(contradiction.dimension(), None);
        assert!(contradiction.independent_sets(9).is_empty());
        assert!(!contradiction.is_free(0));
    }

    #[test]
    fn sixty_variables_are_no_obstacle() {
        // A chain x0 x1, x1 x2, ...: every second variable meets all.
        let chain: Vec<Vec<u32>> = (0..59)
            .map(|i| (0..60).map(|v| u32::from(v == i || v == i + 1)).collect())
            .collect();
        assert_eq!(supports(&chain, 60).dimension(), Some(30));
        assert_eq!(supports(&chain, 60).independent_sets(5).len(), 5);
        // Twenty disjoint triangles need two of three variables each: the bound by disjoint sets is half of the truth.
        let triangles: Vec<Vec<u32>> = (0..60)
            .map(|i| {
                let (base, skipped) = (i / 3 * 3, i % 3);
                (0..60)
                    .map(|v| u32::from(v / 3 * 3 == base && v % 3 != skipped))
                    .collect()
            })
            .collect();
        assert_eq!(supports(&triangles, 60).dimension(), Some(20));
    }

    proptest! {
        #[test]
        fn the_search_agrees_with_trying_all_sets(
            sets in prop::collection::vec(1_u32..256, 0..8)
        ) {
            let monomials: Vec<Vec<u32>> =
                sets.iter().map(|set| (0..8).map(|v| set >> v & 1).collect()).collect();
            let s = supports(&monomials, 8);
            let independent = |free: u32| sets.iter().all(|set| set & !free != 0);
            let all: Vec<u32> = (0..256).filter(|&free| independent(free)).collect();
            let largest = all.iter().map(|free| free.count_ones()).max().unwrap();
            prop_assert_eq!(s.dimension(), Some(largest as usize));
            let mut expected: Vec<Vec<usize>> = all
                .iter()
                .filter(|free| free.count_ones() == largest)
                .map(|free| (0..8).filter(|v| free >> v & 1 == 1).collect())
                .collect();
            expected.sort();
            for v in 0..8 {
                prop_assert_eq!(s.is_free(v), expected.iter().any(|set| set.contains(&v)));
            }
            prop_assert_eq!(s.independent_sets(1000), expected);
        }
    }
}
