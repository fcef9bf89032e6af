//! Monomial orders.

use std::cmp::Ordering;

/// Which of two monomials is the larger; the first variable is the most significant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MonomialOrder {
    /// Total degree first, ties by the smaller power of the last variable: almost always the cheapest.
    Degrevlex,
    /// Lexicographic: a triangular basis, at a price that explodes.
    Lexicographic,
    /// Every monomial with one of the first `k` variables is larger than all without; degrevlex in both groups.
    Elimination(usize),
}

impl MonomialOrder {
    /// Compares two monomials by their exponents.
    pub(super) fn compare(&self, a: &[u16], b: &[u16]) -> Ordering {
        match *self {
            Self::Degrevlex => degrevlex(a, b),
            Self::Lexicographic => a.cmp(b),
            Self::Elimination(first) => {
                let first = first.min(a.len());
                degrevlex(&a[..first], &b[..first])
                    .then_with(|| degrevlex(&a[first..], &b[first..]))
            }
        }
    }

    /// A number that the larger of two monomials has larger or equal: most comparisons need no more.
    pub(super) fn first_key(&self, exponents: &[u16]) -> u64 {
        match *self {
            Self::Degrevlex => degrevlex_key(exponents),
            Self::Lexicographic => {
                let most_significant = (0..4).map(|i| exponents.get(i).copied().unwrap_or(0));
                most_significant.fold(0, |key, e| key << 16 | u64::from(e))
            }
            Self::Elimination(first) => degrevlex_key(&exponents[..first.min(exponents.len())]),
        }
    }

    /// [`Self::compare`] for monomials of the same first key.
    pub(super) fn compare_after_key(&self, a: &[u16], b: &[u16]) -> Ordering {
        match *self {
            Self::Degrevlex if a.len() == b.len() => {
                // Without the degrees, which are equal (or so large that both keys are the largest number).
                let differing = a.iter().zip(b).rev().find(|(a, b)| a != b);
                let last = differing.map_or(Ordering::Equal, |(a, b)| b.cmp(a));
                if self.first_key(a) == u64::MAX {
                    return degree(a).cmp(&degree(b)).then(last);
                }
                last
            }
            _ => self.compare(a, b),
        }
    }

    /// Whether a monomial of larger total degree is always the larger: leading monomials then tell degrees.
    pub(super) fn is_graded(&self) -> bool {
        match *self {
            Self::Degrevlex => true,
            Self::Lexicographic => false,
            Self::Elimination(first) => first == 0,
        }
    }
}

fn degree(exponents: &[u16]) -> u32 {
    exponents.iter().map(|&e| u32::from(e)).sum()
}

/// The degree and the last three exponents; a degree that does not fit decides nothing.
fn degrevlex_key(exponents: &[u16]) -> u64 {
    let Ok(degree) = u16::try_from(degree(exponents)) else {
        return u64::MAX;
    };
    let last = exponents.iter().rev().copied().chain(std::iter::repeat(0));
    last.take(3).fold(u64::from(degree), |key, e| {
        key << 16 | u64::from(u16::MAX - e)
    })
}

fn degrevlex(a: &[u16], b: &[u16]) -> Ordering {
    degree(a)
        .cmp(&degree(b))
        .then_with(|| b.iter().rev().cmp(a.iter().rev()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use polycore::{Monomial, Order};

    #[test]
    fn orders_agree_with_those_of_the_polynomials() {
        let monomials: Vec<[u16; 3]> = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9]).collect();
        let raw = |m: &[u16]| Monomial::new(m.iter().map(|&e| u32::from(e)).collect::<Vec<_>>());
        for (order, reference) in [
            (MonomialOrder::Degrevlex, Order::GRevLex),
            (MonomialOrder::Lexicographic, Order::Lex),
            (MonomialOrder::Elimination(0), Order::elimination(0, 3)),
            (MonomialOrder::Elimination(1), Order::elimination(1, 2)),
            (MonomialOrder::Elimination(2), Order::elimination(2, 1)),
            (MonomialOrder::Elimination(3), Order::elimination(3, 0)),
        ] {
            for a in &monomials {
                for b in &monomials {
                    let expected = reference.compare(&raw(a), &raw(b));
                    assert_eq!(order.compare(a, b), expected, "{order:?} {a:?} {b:?}");
                    let keys = order.first_key(a).cmp(&order.first_key(b));
                    let by_key = keys.then_with(|| order.compare_after_key(a, b));
                    assert_eq!(by_key, expected, "{order:?} {a:?} {b:?}");
                }
            }
        }
    }
}
