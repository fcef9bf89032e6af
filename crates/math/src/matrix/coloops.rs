//! Columns that no linear dependency uses.
//!
//! A column is a *coloop* of the matrix if it lies in every basis of the column space, which is to
//! say that its component is zero in all null vectors (Oxley 2011, §2.1). For the Jacobian of a
//! mechanism these are the joint freedoms that do not move to first order.
//!
//! Numerically a component is never exactly zero. A computed null vector x of unit length has
//! ‖A x‖ = ρ, and the matrix itself is known to within ‖ΔA‖ ≤ a; so x is at most (ρ + a)/σ_k away
//! from a true null vector (Wedin 1972; all relative to σ₁). Components below ten times that are
//! zero, components above a hundred times that again are not, and what lies between is undecided.

use super::null_space::NullVectors;
use super::rank::RankDecision;
use super::real::Real;

/// A component is called zero up to this multiple of its error bound.
const CLEARANCE: f64 = 10.0;

/// A component is called nonzero only beyond the largest zero by this factor.
const SMALLEST_GAP: f64 = 100.0;

/// Which columns vanish in all null vectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Coloops {
    /// Columns that are zero in all null vectors, increasing.
    pub zero: Vec<usize>,
    /// Columns too small to be called nonzero and too large to be called zero, increasing.
    pub undecided: Vec<usize>,
    /// Up to this magnitude a component counts as zero; vectors have unit length.
    pub tolerance: f64,
    /// Largest magnitude among the columns called zero; zero if there are none.
    pub largest_zero: f64,
    /// Smallest magnitude among the columns called nonzero; infinite if there are none.
    pub smallest_nonzero: f64,
}

/// Finds the columns that are zero in all of `null`; `decision` is the one the vectors rest on.
///
/// With a basis the magnitude of a column is the length of its row in the basis, which does not
/// depend on the choice of basis. With random members it is the largest component; a coloop is
/// found with certainty, another column is taken for one with probability zero, up to margins.
/// Without null vectors every column is a coloop.
#[must_use]
pub fn coloops<R: Real>(null: &NullVectors<R>, decision: &RankDecision) -> Coloops {
    let tolerance = if decision.kept > 0.0 {
        CLEARANCE * (null.residual + decision.accuracy) / decision.kept
    } else {
        // Rank 0: every vector is a null vector and nothing was computed.
        0.0
    };
    let mut result = Coloops {
        zero: Vec::new(),
        undecided: Vec::new(),
        tolerance,
        largest_zero: 0.0,
        smallest_nonzero: f64::INFINITY,
    };
    for column in 0..null.length {
        let components = null
            .vectors
            .iter()
            .map(|vector| Real::to_f64(&vector[column]));
        let magnitude = if null.complete {
            let row: Vec<f64> = components.collect();
            Real::norm(&0.0, &row)
        } else {
            components.fold(0.0, |top: f64, x| top.max(x.abs()))
        };
        if magnitude <= tolerance {
            result.zero.push(column);
            result.largest_zero = result.largest_zero.max(magnitude);
        } else if magnitude < SMALLEST_GAP * tolerance {
            result.undecided.push(column);
        } else {
            result.smallest_nonzero = result.smallest_nonzero.min(magnitude);
        }
    }
    result
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::null_space::{null_basis, null_vectors};
    use super::super::rank::decide;
    use super::super::sparse::SparseMatrix;
    use super::*;

    fn of(rows: &[&[f64]]) -> SparseMatrix<f64> {
        let entries = rows
            .iter()
            .enumerate()
            .flat_map(|(i, row)| row.iter().enumerate().map(move |(j, &value)| (i, j, value)));
        SparseMatrix::from_triplets(rows.len(), rows[0].len(), 0.0, entries).unwrap()
    }

    fn found(matrix: &SparseMatrix<f64>) -> Coloops {
        let decision = decide(matrix, 0.0).unwrap();
        let by_basis = coloops(&null_basis(matrix, &decision).unwrap(), &decision);
        let sample = null_vectors(matrix, &decision, 0, 1).unwrap();
        assert_eq!(sample.vectors.len(), 0);
        by_basis
    }

    #[test]
    fn parallel_columns_move_and_the_lone_one_is_locked() {
        let result = found(&of(&[&[1.0, 2.0, 0.3], &[0.0, 0.0, 0.7]]));
        assert_eq!(result.zero, [2]);
        assert!(result.undecided.is_empty());
        assert!(result.smallest_nonzero > 0.4);
    }

    #[test]
    fn full_rank_locks_everything_and_rank_zero_nothing() {
        assert_eq!(found(&of(&[&[1.0, 2.0], &[0.0, 1.0]])).zero, [0, 1]);
        let nothing = SparseMatrix::<f64>::from_triplets(2, 3, 0.0, vec![]).unwrap();
        assert!(found(&nothing).zero.is_empty());
    }

    #[test]
    fn small_but_real_components_are_not_called_zero() {
        // Null vector proportional to (1, −ε, 0).
        for (small, expected) in [(1e-6, 0), (1e-14, 1)] {
            let result = found(&of(&[&[small, 1.0, 0.0], &[0.0, 0.0, 1.0]]));
            assert!(result.zero.contains(&2));
            assert!(!result.zero.contains(&0));
            let doubtful = result.zero.len() + result.undecided.len() - 1;
            assert_eq!(doubtful, expected, "{small:e}: {result:?}");
        }
    }

    #[test]
    fn random_members_agree_with_the_basis() {
        // Six columns in three rows; column 3 alone carries the third row.
        let matrix = of(&[
            &[1.0, 2.0, -1.0, 0.0, 0.5, 3.0],
            &[0.0, 1.0, 1.0, 0.0, 2.0, -1.0],
            &[0.0, 0.0, 0.0, 4.0, 0.0, 0.0],
        ]);
        let decision = decide(&matrix, 0.0).unwrap();
        let sample = null_vectors(&matrix, &decision, 2, 9).unwrap();
        assert!(!sample.complete && sample.vectors.len() == 2 && sample.nullity == 3);
        assert_eq!(coloops(&sample, &decision).zero, found(&matrix).zero);
    }
}
