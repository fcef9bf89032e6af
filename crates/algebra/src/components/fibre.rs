//! The points of a piece over rational values of its free variables.

use super::piece::Piece;
use crate::engine::{Budget, MonomialOrder, Stop, groebner_basis};
use crate::polynomial::{Polynomial, Rational};
use crate::zero_dimensional::{FinitePoints, Representation};
use num_traits::Zero;

/// Values that are tried before a piece is left unexamined.
pub(super) const MOST_VALUES: usize = 12;

/// Finitely many points over fixed values of the free variables.
pub(super) struct Fibre {
    pub(super) points: FinitePoints,
}

impl Fibre {
    /// `None` where there are infinitely many points or none.
    pub(super) fn new(
        piece: &Piece,
        free: &[usize],
        values: &[Rational],
        budget: &Budget,
    ) -> Result<Option<Self>, Stop> {
        let bound = piece.variables() - free.len();
        let equations = specialised(piece, free, values);
        let basis = groebner_basis(&equations, bound, &MonomialOrder::Degrevlex, budget)?;
        let points = FinitePoints::new(&basis, budget)?.filter(|points| points.count() > 0);
        Ok(points.map(|points| Self { points }))
    }

    pub(super) fn representation(&self) -> &Representation {
        self.points.representation()
    }

    /// Number of classes of conjugate points.
    pub(super) fn classes(&self) -> usize {
        self.representation().factors.len()
    }

    /// Whether no point counts more than once.
    pub(super) fn is_simple(&self) -> bool {
        self.representation().factors.iter().all(|(_, m)| *m == 1)
    }

    /// Whether all points are conjugate and simple, for certain.
    pub(super) fn is_one_class(&self) -> bool {
        self.classes() == 1 && self.is_simple() && self.representation().complete
    }
}

/// The equations of a piece with values in place of the free variables, in the ring of the others.
fn specialised(piece: &Piece, free: &[usize], values: &[Rational]) -> Vec<Polynomial> {
    let bound = piece.variables() - free.len();
    let mut next = 0;
    let replacements: Vec<Polynomial> = (0..piece.variables())
        .map(|v| match free.iter().position(|&f| f == v) {
            Some(place) => Polynomial::constant(values[place].clone(), bound),
            None => {
                next += 1;
                Polynomial::variable(next - 1, bound)
            }
        })
        .collect();
    piece
        .equations
        .iter()
        .map(|p| p.substitute(&replacements))
        .filter(|p| !p.is_zero())
        .collect()
}

/// Integers without pattern, the same every time; small ones first.
pub(super) fn integer_values(number: usize, length: usize) -> Vec<Rational> {
    const VALUES: [i64; 13] = [3, -2, 5, 7, -5, 11, 4, -7, 13, 6, -11, 9, 17];
    (0..length)
        .map(|i| {
            let index = (number * 5 + i * (number + 3)) % VALUES.len();
            Rational::from_integer(VALUES[index].into())
        })
        .collect()
}

/// Whether one of some polynomials in the free variables is zero at given values.
pub(super) fn is_exceptional(
    exceptions: &[Polynomial],
    free: &[usize],
    values: &[Rational],
) -> bool {
    exceptions.iter().any(|f| {
        let mut point = vec![Rational::zero(); f.variables()];
        for (&v, value) in free.iter().zip(values) {
            point[v] = value.clone();
        }
        f.value_at(&point).is_zero()
    })
}
