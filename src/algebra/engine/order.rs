//! Monomial orders.

use polycore::Order;
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
    pub(super) fn raw(&self, variables: usize) -> Order {
        match *self {
            Self::Degrevlex => Order::GRevLex,
            Self::Lexicographic => Order::Lex,
            Self::Elimination(first) => {
                let first = first.min(variables);
                Order::elimination(first, variables - first)
            }
        }
    }

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

fn degrevlex(a: &[u16], b: &[u16]) -> Ordering {
    degree(a)
        .cmp(&degree(b))
        .then_with(|| b.iter().rev().cmp(a.iter().rev()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use polycore::Monomial;

    #[test]
    fn orders_agree_with_those_of_the_polynomials() {
        let monomials: Vec<[u16; 3]> = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9]).collect();
        let raw = |m: &[u16]| Monomial::new(m.iter().map(|&e| u32::from(e)).collect::<Vec<_>>());
        for order in [
            MonomialOrder::Degrevlex,
            MonomialOrder::Lexicographic,
            MonomialOrder::Elimination(0),
            MonomialOrder::Elimination(1),
            MonomialOrder::Elimination(2),
            MonomialOrder::Elimination(3),
        ] {
            for a in &monomials {
                for b in &monomials {
                    let expected = order.raw(3).compare(&raw(a), &raw(b));
                    assert_eq!(order.compare(a, b), expected, "{order:?} {a:?} {b:?}");
                }
            }
        }
    }
}
