//! Monomial orders.

use polycore::Order;

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
            Self::Elimination(first) => Order::elimination(first, variables - first),
        }
    }
}
