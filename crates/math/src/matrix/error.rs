//! What can be wrong with a matrix before any arithmetic starts.

use crate::interruption::Interrupted;
use thiserror::Error;

/// Why a matrix was refused, or why a decomposition gave no answer.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MatrixError {
    /// An entry names a row or column outside the stated shape.
    #[error("entry ({row}, {column}) lies outside a matrix of {rows} rows and {columns} columns")]
    OutOfShape {
        /// Row of the offending entry, from 0.
        row: usize,
        /// Column of the offending entry, from 0.
        column: usize,
        /// Stated number of rows.
        rows: usize,
        /// Stated number of columns.
        columns: usize,
    },
    /// An entry is NaN, infinite, or too large for the range of a double.
    #[error("entry ({row}, {column}) is not a finite number")]
    NotFinite {
        /// Row of the offending entry, from 0.
        row: usize,
        /// Column of the offending entry, from 0.
        column: usize,
    },
    /// Two lengths that must agree do not.
    #[error("{what}: expected length {expected}, found {found}")]
    Length {
        /// Which vector or list.
        what: &'static str,
        /// The length that was needed.
        expected: usize,
        /// The length that was given.
        found: usize,
    },
    /// Row block boundaries must start at 0, increase, and stay below the number of rows.
    #[error(
        "row block {block} starts at row {start}, which is not after the block before it and inside {rows} rows"
    )]
    RowBlocks {
        /// Index of the offending block.
        block: usize,
        /// Its first row.
        start: usize,
        /// Number of rows of the matrix.
        rows: usize,
    },
    /// A tolerance or accuracy is negative, NaN or infinite.
    #[error("a tolerance must be a finite number that is not negative, found {0}")]
    Tolerance(f64),
    /// An iterative decomposition did not converge, or its factors do not reproduce the matrix.
    #[error("the singular value decomposition of a {rows} x {columns} matrix failed: {reason}")]
    Decomposition {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
        /// What was found wrong.
        reason: &'static str,
    },
    /// The work was asked to end: see [`crate::interruption`].
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

/// Refuses tolerances that are not finite and non-negative.
pub(crate) fn check_tolerance(value: f64) -> Result<(), MatrixError> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(MatrixError::Tolerance(value))
    }
}
