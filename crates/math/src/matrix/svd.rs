//! Dense singular values and vectors of small matrices.
//!
//! The fast routine is faer's. A wrong answer must not pass for a rank, so its values are checked
//! against Σσ² = ‖A‖_F² and its vectors against A V = U Σ; where a check fails the caller falls back
//! to slower independent code.

use faer::linalg::solvers::Svd;
use faer::{Mat, MatRef};

use super::frontal::factor;
use super::jacobi;
use super::real::{Real, Ring};
use super::sparse::SparseMatrix;

/// Singular values of the matrix divided by `scale`, largest first, min(rows, columns) of them;
/// `None` if a check failed.
///
/// `scale` is the largest entry, not zero.
pub(crate) fn singular_values<R: Real>(matrix: &SparseMatrix<R>, scale: f64) -> Option<Vec<f64>> {
    let dense = dense(matrix, scale);
    let values = dense.singular_values().ok()?;
    let squares: Vec<f64> = matrix
        .triplets()
        .map(|(_, _, value)| Real::to_f64(value) / scale)
        .collect();
    let expected = 0.0f64.dot(&squares, &squares);
    let found = 0.0f64.dot(&values, &values);
    // Rounding of both sums: a few units per term.
    let bound = 1e-14 * (matrix.rows().max(matrix.columns()) as f64 + 10.0);
    let agrees = (found - expected).abs() <= bound * expected;
    let ordered = values.is_sorted_by(|a, b| a >= b) && values.iter().all(|&v| v >= 0.0);
    if !agrees || !ordered {
        return None;
    }
    Some(values)
}

/// The same by Jacobi rotations in the arithmetic of the matrix, rounded to doubles at the end.
///
/// Applied to the rows of the triangular factor of a pivoted QR, where few sweeps are needed
/// (Drmač and Veselić 2008, §2).
pub(crate) fn jacobi_values<R: Real>(matrix: &SparseMatrix<R>, scale: f64) -> Option<Vec<f64>> {
    let zero = matrix.zero();
    let unit = zero.constant(scale);
    let scaled = matrix
        .map(zero, |value| value.clone() / unit.clone())
        .with_row_blocks_of(matrix.rows());
    let triangle = factor(&scaled, 0.0).ok()?.triangle;
    let mut rows = vec![vec![zero.clone(); matrix.columns()]; triangle.rank()];
    for (row, column, value) in triangle.entries() {
        rows[row][column] = value.clone();
    }
    let values = jacobi::singular_values(zero, rows)?;
    let mut values: Vec<f64> = values.iter().map(Real::to_f64).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values.resize(matrix.rows().min(matrix.columns()), 0.0);
    Some(values)
}

/// An orthonormal basis of the right null space for a given rank; `None` if a check failed.
///
/// The vectors belong to the smallest singular values, in rising order of these.
pub(crate) fn null_basis<R: Real>(
    matrix: &SparseMatrix<R>,
    scale: f64,
    rank: usize,
) -> Option<Vec<Vec<f64>>> {
    let dense = dense(matrix, scale);
    let columns = matrix.columns();
    // V must be square; U only as wide as needed.
    let svd = if matrix.rows() >= columns {
        dense.thin_svd().ok()?
    } else {
        dense.svd().ok()?
    };
    if !reproduces(dense.as_ref(), &svd) {
        return None;
    }
    let v = svd.V();
    let vectors = (rank..columns)
        .rev()
        .map(|j| (0..columns).map(|i| v[(i, j)]).collect());
    Some(vectors.collect())
}

/// Whether A V = U Σ and VᵀV = I to a few units of roundoff per operation.
fn reproduces(matrix: MatRef<'_, f64>, svd: &Svd<f64>) -> bool {
    let (u, s, v) = (svd.U(), svd.S().column_vector(), svd.V());
    let image = matrix * v;
    let gram = v.transpose() * v;
    let count = s.nrows();
    let largest = if count > 0 { s[0] } else { 0.0 };
    let bound = 1e-14 * (matrix.nrows().max(matrix.ncols()) as f64 + 10.0);
    let mut worst = 0.0f64;
    for j in 0..v.ncols() {
        for i in 0..matrix.nrows() {
            let expected = if j < count { u[(i, j)] * s[j] } else { 0.0 };
            worst = worst.max((image[(i, j)] - expected).abs() / largest);
        }
        for i in 0..v.ncols() {
            let expected = f64::from(u8::from(i == j));
            worst = worst.max((gram[(i, j)] - expected).abs());
        }
    }
    worst <= bound
}

fn dense<R: Real>(matrix: &SparseMatrix<R>, scale: f64) -> Mat<f64> {
    let mut dense = Mat::zeros(matrix.rows(), matrix.columns());
    for (row, column, value) in matrix.triplets() {
        dense[(row, column)] = Real::to_f64(value) / scale;
    }
    dense
}
