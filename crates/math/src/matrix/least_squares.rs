//! Damped least squares: the step of an assembly iteration. No rank is decided here.

use super::DENSE_COLUMNS;
use super::error::MatrixError;
use super::frontal::{Factorization, factor};
use super::sparse::SparseMatrix;
use faer::linalg::solvers::SolveLstsq;

/// Solves `min |A x − b|² + damping |x|²`.
#[derive(Clone, Copy, Debug)]
pub struct LeastSquares;

impl LeastSquares {
    /// The minimiser `x`, one entry per column; columns marked `false` in `movable` stay zero.
    ///
    /// The damping is raised to at least 1e-20, so that the solution is unique; with columns of unit length this changes a
    /// step by less than 1e-10 of itself along directions that matter, and keeps it short along null directions.
    /// Dense Householder QR of `[A; √damping I]` up to 300 columns; conjugate gradients on the normal equations in
    /// product form (CGLS, Björck 1996, section 7.4) beyond, to a relative accuracy of 1e-12 or as far as it gets in twice
    /// as many iterations as columns, at most 5000. The triangle of a sparse QR of `[A; σ I]`, with a σ that hides only what
    /// is below a ten-thousandth of the largest entry, is their preconditioner where no row is longer than 128 entries: a few
    /// iterations do, and the cost is that of the factor.
    ///
    /// # Errors
    /// [`MatrixError::Length`] where `b` or `movable` does not fit, [`MatrixError::NotFinite`] for NaN and infinities.
    pub fn damped(
        matrix: &SparseMatrix<f64>,
        right: &[f64],
        damping: f64,
        movable: Option<&[bool]>,
    ) -> Result<Vec<f64>, MatrixError> {
        if right.len() != matrix.rows() {
            return Err(MatrixError::Length {
                what: "right-hand side",
                expected: matrix.rows(),
                found: right.len(),
            });
        }
        if let Some(movable) = movable
            && movable.len() != matrix.columns()
        {
            return Err(MatrixError::Length {
                what: "movable columns",
                expected: matrix.columns(),
                found: movable.len(),
            });
        }
        matrix.largest_entry()?;
        if !right.iter().all(|x| x.is_finite()) || !damping.is_finite() {
            return Err(MatrixError::NotFinite { row: 0, column: 0 });
        }
        let damping = damping.max(1e-20);
        let kept: Vec<usize> = (0..matrix.columns())
            .filter(|c| movable.is_none_or(|m| m[*c]))
            .collect();
        if kept.is_empty() {
            return Ok(vec![0.0; matrix.columns()]);
        }
        if kept.len() <= DENSE_COLUMNS {
            Ok(dense(matrix, right, damping, &kept))
        } else {
            cgls(matrix, right, damping, movable)
        }
    }
}

fn dense(matrix: &SparseMatrix<f64>, right: &[f64], damping: f64, kept: &[usize]) -> Vec<f64> {
    let mut position = vec![usize::MAX; matrix.columns()];
    for (index, &column) in kept.iter().enumerate() {
        position[column] = index;
    }
    let rows = matrix.rows();
    let mut augmented = faer::Mat::<f64>::zeros(rows + kept.len(), kept.len());
    for (row, column, value) in matrix.triplets() {
        if position[column] != usize::MAX {
            augmented[(row, position[column])] = *value;
        }
    }
    for index in 0..kept.len() {
        augmented[(rows + index, index)] = damping.sqrt();
    }
    let target = faer::Mat::<f64>::from_fn(rows + kept.len(), 1, |i, _| {
        right.get(i).copied().unwrap_or(0.0)
    });
    let solution = augmented.qr().solve_lstsq(&target);
    let mut x = vec![0.0; matrix.columns()];
    for (index, &column) in kept.iter().enumerate() {
        x[column] = solution[(index, 0)];
    }
    x
}

/// Singular values below this part of the largest entry are left to the iterations: with σ of this size no column is dropped,
/// and null directions are not preferred by more than the roundings divided by its square.
const SHIFT: f64 = 1e-4;

/// A row that ties together more unknowns than this, such as a held direction as long as the mechanism or a loop of hundreds of
/// joints, fills the factor: iterations without one are cheaper.
const LONGEST_ROW: usize = 128;

/// `R` with `RᵀR = AᵀA + σ²I`, columns that are held being left out; `None` where a row is too long, or entries are too large or
/// small for it.
fn preconditioner(
    matrix: &SparseMatrix<f64>,
    damping: f64,
    movable: Option<&[bool]>,
) -> Result<Option<Factorization<f64>>, MatrixError> {
    let (rows, columns) = (matrix.rows(), matrix.columns());
    if (0..rows).any(|row| matrix.row(row).len() > LONGEST_ROW) {
        return Ok(None);
    }
    let shift = (SHIFT * matrix.largest_entry()?).max(damping.sqrt());
    let moves = |column: usize| movable.is_none_or(|m| m[column]);
    let entries = matrix
        .triplets()
        .filter(|&(_, column, _)| moves(column))
        .map(|(row, column, value)| (row, column, *value));
    let shifts = (0..columns).map(|column| (rows + column, column, shift));
    let starts = (0..matrix.block_count()).map(|block| matrix.block_rows(block).start);
    let starts = starts.chain(rows..rows + columns).collect();
    let shifted = SparseMatrix::from_triplets(rows + columns, columns, 0.0, entries.chain(shifts))?
        .with_row_blocks(starts)?;
    let found = factor(&shifted, 0.0)?;
    Ok(Some(found).filter(|f| f.exponent == 0 && f.rank() == columns))
}

fn cgls(
    matrix: &SparseMatrix<f64>,
    right: &[f64],
    damping: f64,
    movable: Option<&[bool]>,
) -> Result<Vec<f64>, MatrixError> {
    let factor = preconditioner(matrix, damping, movable)?;
    let hold = |v: &mut [f64]| {
        if let Some(movable) = movable {
            for (x, m) in v.iter_mut().zip(movable) {
                if !m {
                    *x = 0.0;
                }
            }
        }
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let square = |v: &[f64]| dot(v, v);
    let scaled = |gradient: &[f64]| {
        let mut z = gradient.to_vec();
        if let Some(factor) = &factor {
            factor.triangle.forward_substitute(&mut z);
            factor.triangle.back_substitute(&mut z);
            hold(&mut z);
        }
        z
    };
    let mut x = vec![0.0; matrix.columns()];
    let mut residual = right.to_vec();
    let mut gradient = matrix.multiply_transposed(&residual)?;
    hold(&mut gradient);
    let goal = square(&gradient) * 1e-24;
    let mut direction = scaled(&gradient);
    let mut size = dot(&gradient, &direction);
    for _ in 0..(2 * matrix.columns()).min(5000) {
        if square(&gradient) <= goal || !(size > 0.0) {
            break;
        }
        let image = matrix.multiply(&direction)?;
        let length = size / (square(&image) + damping * square(&direction));
        for (x, d) in x.iter_mut().zip(&direction) {
            *x += length * d;
        }
        for (r, i) in residual.iter_mut().zip(&image) {
            *r -= length * i;
        }
        gradient = matrix.multiply_transposed(&residual)?;
        for (g, x) in gradient.iter_mut().zip(&x) {
            *g -= damping * x;
        }
        hold(&mut gradient);
        let next = scaled(&gradient);
        let before = std::mem::replace(&mut size, dot(&gradient, &next));
        for (d, z) in direction.iter_mut().zip(&next) {
            *d = z + size / before * *d;
        }
    }
    Ok(x)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn chain(length: usize) -> SparseMatrix<f64> {
        let triplets = (0..length).flat_map(|i| [(i, i, 1.0), (i, i + 1, -0.5)]);
        SparseMatrix::from_triplets(length, length + 1, 0.0, triplets).unwrap()
    }

    #[test]
    fn dense_and_iterative_solutions_agree() {
        let matrix = chain(40);
        let right: Vec<f64> = (0..40).map(|i| f64::from(i).sin()).collect();
        let all: Vec<usize> = (0..41).collect();
        let direct = dense(&matrix, &right, 1e-12, &all);
        let iterated = cgls(&matrix, &right, 1e-12, None).unwrap();
        for (a, b) in direct.iter().zip(&iterated) {
            assert!((a - b).abs() < 1e-8, "{a} {b}");
        }
    }

    #[test]
    fn what_nothing_asks_for_stays_short_in_large_systems() {
        // A square lattice of springs along x and y, each stated twice, and one column that is in no row: redundant, with null
        // directions (all of one row of nodes together), and a condition that plain iterations would feel.
        let side = 12;
        let node = |i: usize, k: usize| 2 * (side * i + k);
        let mut triplets = Vec::new();
        let mut row = 0;
        let mut spring = |a: usize, b: usize, size: f64| {
            triplets.extend([(row, a, size), (row, b, -size)]);
            triplets.extend([(row + 1, a, size), (row + 1, b, -size)]);
            row += 2;
        };
        for i in 0..side {
            for k in 1..side {
                let size = 0.3 + ((i * side + k) as f64).sin().abs();
                spring(node(i, k - 1), node(i, k), size);
                spring(node(k - 1, i) + 1, node(k, i) + 1, size);
            }
        }
        let columns = 2 * side * side + 1;
        let matrix = SparseMatrix::from_triplets(row, columns, 0.0, triplets).unwrap();
        let right: Vec<f64> = (0..row).map(|i| (i as f64).cos()).collect();
        let all: Vec<usize> = (0..columns).collect();
        let direct = dense(&matrix, &right, 1e-14, &all);
        let iterated = cgls(&matrix, &right, 1e-14, None).unwrap();
        let size = direct.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for (a, b) in direct.iter().zip(&iterated) {
            assert!((a - b).abs() < 1e-6 * size, "{a} {b} of {size}");
        }
        let mut movable = vec![true; columns];
        movable[node(5, 5)] = false;
        let held = cgls(&matrix, &right, 1e-14, Some(&movable)).unwrap();
        assert_eq!(held[node(5, 5)], 0.0);
        let kept: Vec<usize> = all.into_iter().filter(|&c| movable[c]).collect();
        let direct = dense(&matrix, &right, 1e-14, &kept);
        for (a, b) in direct.iter().zip(&held) {
            assert!((a - b).abs() < 1e-6 * size, "{a} {b} of {size}");
        }
    }

    #[test]
    fn held_columns_stay() {
        let matrix = chain(4);
        let movable = [true, true, false, true, true];
        let x = LeastSquares::damped(&matrix, &[1.0; 4], 0.0, Some(&movable)).unwrap();
        assert_eq!(x[2], 0.0);
        let image = matrix.multiply(&x).unwrap();
        assert!(image.iter().all(|y| (y - 1.0).abs() < 1e-8), "{image:?}");
    }
}
