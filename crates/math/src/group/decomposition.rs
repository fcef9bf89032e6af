//! Singular value decompositions of small matrices, and the margin of a decision about rank.

use faer::Mat;
use nalgebra::{DMatrix, Vector6};

use super::GroupError;

/// How clearly a chain of rank decisions was taken.
///
/// Each decision compares singular values with its own tolerance τ. `kept` is the smallest of all singular
/// values counted as nonzero and `dropped` the largest of all counted as zero, each divided by the τ of its
/// decision. So `kept` > 1 ≥ `dropped`, and both tolerances could be wrong by the factor that separates
/// them without changing a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margin {
    /// Smallest singular value taken as nonzero, in tolerances; infinite where none was.
    pub kept: f64,
    /// Largest singular value taken as zero, in tolerances; zero where none was.
    pub dropped: f64,
}

impl Margin {
    /// The margin of no decision at all.
    pub const CERTAIN: Self = Self {
        kept: f64::INFINITY,
        dropped: 0.0,
    };

    /// The worse of two margins, for conclusions that rest on both.
    pub fn and(self, other: Self) -> Self {
        Self {
            kept: self.kept.min(other.kept),
            dropped: self.dropped.max(other.dropped),
        }
    }

    /// The worst gap: smallest value kept over largest value dropped (σ_k/σ_{k+1} for one decision).
    /// Infinite where nothing was kept or what was dropped is exactly zero.
    pub fn gap(&self) -> f64 {
        if self.dropped == 0.0 {
            f64::INFINITY
        } else {
            self.kept / self.dropped
        }
    }

    /// True where a person may act on the result: the gap is at least 10³ and everything kept stands
    /// at least ten tolerances above zero.
    ///
    /// This guards what was *kept*. What was dropped is zero within the stated accuracy and no better: the
    /// tolerances are worst-case bounds, some 10 to 50 times the error to be expected, so a
    /// `dropped` between 0.01 and 1 means "zero if the geometry is no more accurate than stated". Exact
    /// geometry under a tolerance of 10⁻⁹ leaves 10⁻⁴ and less; a caller that knows it to be exact should state a smaller tolerance.
    pub fn is_clear(&self) -> bool {
        self.kept >= 10.0 && self.gap() >= 1e3
    }

    /// Splits a list of singular values at a tolerance: how many are nonzero, and how clearly.
    pub(super) fn decide(values: &[f64], tolerance: f64) -> (usize, Self) {
        let mut margin = Self::CERTAIN;
        let mut rank = 0;
        for value in values {
            let ratio = value / tolerance;
            if ratio > 1.0 {
                rank += 1;
                margin.kept = margin.kept.min(ratio);
            } else {
                margin.dropped = margin.dropped.max(ratio);
            }
        }
        (rank, margin)
    }
}

/// Backward error of a decomposition relative to its largest singular value.
///
/// Householder reductions of a matrix with at most six rows (or columns) lose a small multiple of
/// 6 ε; 32 ε has been enough in every case tried and is far below any stated accuracy.
pub(super) const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// A thin decomposition by another library; `None` where that does not converge either, or does not rebuild the matrix, as
/// happens for some matrices of few different entries.
fn by_nalgebra(matrix: &Mat<f64>) -> Option<Decomposition> {
    const ITERATIONS: usize = 1000;
    let copy = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)]);
    // Values and vectors in descending order.
    let svd = copy.clone().try_svd(true, true, f64::EPSILON, ITERATIONS)?;
    let (left, right) = (svd.u?, svd.v_t?);
    let rebuilt = &left * DMatrix::from_diagonal(&svd.singular_values) * &right;
    let accurate = (rebuilt - &copy).amax() < ROUNDING * (1.0 + svd.singular_values.max());
    accurate.then(|| Decomposition {
        left: Mat::from_fn(left.nrows(), left.ncols(), |i, j| left[(i, j)]),
        right: Mat::from_fn(right.ncols(), right.nrows(), |i, j| right[(j, i)]),
        values: svd.singular_values.iter().copied().collect(),
    })
}

/// A = U diag(values) Vᵀ, singular values descending.
pub(super) struct Decomposition {
    left: Mat<f64>,
    right: Mat<f64>,
    /// min(rows, columns) singular values.
    pub values: Vec<f64>,
}

impl Decomposition {
    /// Decomposes the matrix with these entries. `full` asks for complete orthogonal U and V, which is
    /// meant for matrices with at most six rows and columns.
    pub fn of(
        rows: usize,
        columns: usize,
        full: bool,
        entry: impl Fn(usize, usize) -> f64,
    ) -> Result<Self, GroupError> {
        if rows == 0 || columns == 0 {
            return Ok(Self {
                left: Mat::identity(rows, rows),
                right: Mat::identity(columns, columns),
                values: Vec::new(),
            });
        }
        let matrix = Mat::from_fn(rows, columns, entry);
        if columns == 1 && !full {
            // A single column is its own decomposition.
            let norm = matrix.norm_l2();
            return Ok(Self {
                left: if norm > 0.0 {
                    matrix * faer::Scale(1.0 / norm)
                } else {
                    Mat::from_fn(rows, 1, |i, _| f64::from(u8::from(i == 0)))
                },
                right: Mat::identity(1, 1),
                values: vec![norm],
            });
        }
        let found = if full {
            matrix.svd()
        } else {
            matrix.thin_svd()
        };
        let Ok(svd) = found else {
            // Some few matrices, with nothing strange about them, end faer's iteration before it has converged.
            return by_nalgebra(&matrix)
                .filter(|_| !full)
                .ok_or(GroupError::NoConvergence { rows, columns });
        };
        let values = svd.S().column_vector().iter().copied().collect();
        Ok(Self {
            left: svd.U().to_owned(),
            right: svd.V().to_owned(),
            values,
        })
    }

    /// A matrix with six rows of which nothing is known but that its singular values are at most this. Its vectors mean nothing.
    pub fn bounded_by(norm: f64) -> Self {
        Self {
            left: Mat::identity(6, 1),
            right: Mat::identity(1, 1),
            values: vec![norm],
        }
    }

    /// Thin decomposition of a list of six-vectors as columns.
    pub fn of_columns(columns: &[Vector6<f64>]) -> Result<Self, GroupError> {
        Self::of(6, columns.len(), false, |i, j| columns[j][i])
    }

    /// Largest singular value, 0 for an empty matrix.
    pub fn norm(&self) -> f64 {
        self.values.first().copied().unwrap_or(0.0)
    }

    /// Entry `row` of the left singular vector `index`.
    pub fn left(&self, row: usize, index: usize) -> f64 {
        self.left[(row, index)]
    }

    /// Entry `row` of the right singular vector `index`.
    pub fn right(&self, row: usize, index: usize) -> f64 {
        self.right[(row, index)]
    }

    /// Left singular vector of a matrix with six rows.
    pub fn left6(&self, index: usize) -> Vector6<f64> {
        Vector6::from_fn(|row, _| self.left(row, index))
    }

    /// Σ basis\[j\]·V\[j, index\]: the combination of `basis` by a right singular vector.
    pub fn combine(&self, basis: &[Vector6<f64>], index: usize) -> Vector6<f64> {
        let terms = basis.iter().enumerate();
        terms.fold(Vector6::zeros(), |sum, (j, b)| {
            sum + b * self.right(j, index)
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn margins_combine_to_the_worst() {
        let (rank, first) = Margin::decide(&[2.0, 1e-3, 1e-9], 1e-6);
        assert_eq!(rank, 2);
        assert!((first.kept - 1e3).abs() < 1e-9 && (first.dropped - 1e-3).abs() < 1e-15);
        assert!(first.is_clear());
        let (_, second) = Margin::decide(&[5e-5, 5e-7], 1e-6);
        let both = first.and(second);
        assert!((both.gap() - 100.0).abs() < 1e-9);
        assert!(!both.is_clear());
        assert_eq!(Margin::decide(&[], 1.0), (0, Margin::CERTAIN));
    }

    proptest! {
        /// Structured entries 0, ±1 are where a faulty decomposition shows; the product must rebuild
        /// the matrix.
        #[test]
        fn decompositions_rebuild_the_matrix(
            entries in proptest::collection::vec(-1..=1_i32, 42), columns in 1..=7_usize, full: bool,
        ) {
            let entry = |i: usize, j: usize| f64::from(entries[6 * j + i]);
            let usual = Decomposition::of(6, columns, full, entry).unwrap();
            let other = by_nalgebra(&Mat::from_fn(6, columns, entry));
            for d in std::iter::once(usual).chain(other) {
                prop_assert!(d.values.is_sorted_by(|a, b| a >= b));
                for i in 0..6 {
                    for j in 0..columns {
                        let terms = d.values.iter().enumerate();
                        let sum: f64 = terms.map(|(k, s)| d.left(i, k) * s * d.right(j, k)).sum();
                        prop_assert!((sum - entry(i, j)).abs() < ROUNDING * (1.0 + d.norm()));
                    }
                }
            }
        }
    }
}
