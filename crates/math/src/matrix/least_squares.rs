//! Damped least squares: the step of an assembly iteration. No rank is decided here.

use super::DENSE_COLUMNS;
use super::error::MatrixError;
use super::sparse::SparseMatrix;
use faer::linalg::solvers::SolveLstsq;

/// What is left of a column beside those before it has to be more than half so many roundings of each of its entries: less is none for the
/// decomposition (faer 0.24), which leaves such a column out, and then has no solution at all.
const DISTINCT: f64 = 32.0;

/// Solves `min |A x − b|² + damping |x|²`.
#[derive(Clone, Copy, Debug)]
pub struct LeastSquares;

impl LeastSquares {
    /// The minimiser `x`, one entry per column; columns marked `false` in `movable` stay zero.
    ///
    /// The damping is raised to at least 1e-20, so that the solution is unique; with columns of unit length this changes a
    /// step by less than 1e-10 of itself along directions that matter, and keeps it short along null directions. Columns that are so long that it
    /// is no more than their rounding are damped by that.
    /// Dense Householder QR of `[A; √damping I]` up to 300 columns; conjugate gradients on the normal equations in
    /// product form (CGLS, Björck 1996, section 7.4) beyond, to a relative accuracy of 1e-12 or as far as it gets in twice
    /// as many iterations as columns, at most 5000.
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
    let distinct = DISTINCT * (rows + kept.len()) as f64 * f64::EPSILON;
    let mut augmented = faer::Mat::<f64>::zeros(rows + kept.len(), kept.len());
    for (row, column, value) in matrix.triplets() {
        if position[column] != usize::MAX {
            augmented[(row, position[column])] = *value;
        }
    }
    for index in 0..kept.len() {
        let size = augmented.col(index).norm_l2();
        augmented[(rows + index, index)] = damping.sqrt().max(distinct * size);
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

fn cgls(
    matrix: &SparseMatrix<f64>,
    right: &[f64],
    damping: f64,
    movable: Option<&[bool]>,
) -> Result<Vec<f64>, MatrixError> {
    let hold = |v: &mut [f64]| {
        if let Some(movable) = movable {
            for (x, m) in v.iter_mut().zip(movable) {
                if !m {
                    *x = 0.0;
                }
            }
        }
    };
    let square = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
    let mut x = vec![0.0; matrix.columns()];
    let mut residual = right.to_vec();
    let mut gradient = matrix.multiply_transposed(&residual)?;
    hold(&mut gradient);
    let mut direction = gradient.clone();
    let mut size = square(&gradient);
    let goal = size * 1e-24;
    for _ in 0..(2 * matrix.columns()).min(5000) {
        if size <= goal || size == 0.0 {
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
        let next = square(&gradient);
        let keep = next / size;
        for (d, g) in direction.iter_mut().zip(&gradient) {
            *d = g + keep * *d;
        }
        size = next;
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

    /// Of loops that are short beside what they carry, columns are long: two that are the same have the shortest solution still.
    #[test]
    fn long_columns_that_repeat_one_another_have_a_solution() {
        for size in [1.0, 1e5, 1e9] {
            let matrix =
                SparseMatrix::from_triplets(1, 2, 0.0, [(0, 0, size), (0, 1, size)]).unwrap();
            let x = LeastSquares::damped(&matrix, &[size], 0.0, None).unwrap();
            assert!((x[0] + x[1] - 1.0).abs() < 1e-9, "{size:e}: {x:?}");
            assert!((x[0] - x[1]).abs() < 0.5, "{size:e}: {x:?}");
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
