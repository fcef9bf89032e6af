//! Rank decisions with margins.
//!
//! # The problem
//! The closure equations of a mechanism with loops, linearised, are a matrix: one column per joint
//! freedom, six rows per loop. Its rank separates mobile from rigid, its null vectors are the
//! motions to first order, the null vectors of its transpose the self-stresses. The mechanisms worth
//! asking about have more columns or rows than rank: they sit exactly where a rank drops, and
//! rounding hides that.
//!
//! # What a result must satisfy
//! - A rank comes with its margins: the last singular value kept, the first dropped, the tolerance
//!   and where it comes from. Where the margins do not suffice the rank is *undecided*, with both
//!   candidates, and the caller can ask again with more digits.
//! - No product AᵀA is formed where a rank is decided; that would square the margins.
//! - The result does not depend on the order of rows or columns or on a common factor, beyond
//!   rounding. The same input gives the same output bit by bit on one kind of machine.
//! - Any shape is accepted: no rows, no columns, all zeros. Entries that are not finite are a
//!   [`MatrixError`], never a panic.
//!
//! # The way through
//! - [`real`]: arithmetic in general; `f64`, and [`extended`] for more bits: pairs of doubles
//!   ([`twofold`]) up to 106, [`big`] beyond.
//! - [`sparse`]: matrices with rows in blocks.
//! - [`rank`]: the decision. Small matrices by singular values (faer, checked; [`jacobi`] for many
//!   digits), large ones by sparse QR ([`frontal`], in the order of [`ordering`]) with the smallest
//!   kept singular value from inverse iteration ([`estimate`]).
//! - [`null_space`] and [`mod@coloops`]: what the rank leaves free, and what it locks.
//! - [`modular`]: the same elimination over a prime field: generic rank without rounding.
//!
//! # Cost
//! Dense: O(m n min(m, n)); microseconds for one loop. Sparse: linear in the number of loops for
//! chains, trees and rings of loops; for a k × k lattice O(k³), as in nested dissection.

pub mod big;
pub mod coloops;
pub mod error;
pub mod estimate;
pub mod extended;
pub mod frontal;
pub mod held_step;
pub mod jacobi;
pub mod least_squares;
pub mod modular;
mod multifrontal;
pub mod null_space;
pub mod ordering;
pub mod random;
pub mod rank;
pub mod real;
pub mod sparse;
mod sums;
mod svd;
pub mod twofold;

/// Largest number of columns for which a matrix of doubles is decomposed densely.
pub const DENSE_COLUMNS: usize = 300;
/// Largest number of rows for which it is.
pub const DENSE_ROWS: usize = 1500;

pub use big::Big;
pub use coloops::{Coloops, coloops};
pub use error::MatrixError;
pub use extended::Extended;
pub use frontal::{Factorization, Refactoring, factor};
pub use held_step::held_step;
pub use least_squares::LeastSquares;
pub use modular::{Field61, ModularFactorization, factor_modular, modular_rank};
pub use null_space::{NullVectors, null_basis, null_vectors, null_vectors_by_qr};
pub use random::SplitMix64;
pub use rank::{
    CLEARANCE, Method, ROUNDINGS, RankDecision, Ranks, decide, decide_by_qr,
    decide_by_singular_values, decide_each, relative_singular_values,
};
pub use real::{Real, Ring};
pub use sparse::SparseMatrix;
pub use twofold::Twofold;

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
