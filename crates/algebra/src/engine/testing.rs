//! Polynomials in x, y and z for the tests of the engine.

use crate::polynomial::Polynomial;
use polycore::{Order, Ring};

pub(super) fn names() -> Vec<String> {
    ["x", "y", "z"].map(str::to_owned).to_vec()
}

#[allow(clippy::unwrap_used)]
pub(super) fn parse(text: &str) -> Polynomial {
    let ring = Ring::new(names(), Order::GRevLex);
    let parsed = ring.parse(text).unwrap();
    let terms = parsed.terms.iter();
    let terms = terms.map(|(m, c)| (m.exps().to_vec(), c.clone())).collect();
    Polynomial::from_terms(terms, 3)
}

pub(super) fn texts(polynomials: &[Polynomial]) -> Vec<String> {
    polynomials.iter().map(|p| p.text(&names())).collect()
}
