//! Steps of Newton's method across a kernel that is held, for large sparse systems.
//!
//! # The problem
//! A motion is followed by moving along the kernel of the closure equations and closing across it: the step wanted solves
//! `A x = b` in the sense of least squares with `h·x = 0` for every held direction `h`. Written as one problem, with the
//! directions as further rows, it is no longer sparse: each of them is as long as the mechanism is large.
//!
//! # The answer
//! Where A has exactly as many null directions as are held, the two can be separated. A sparse QR with dropped columns
//! gives some least-squares solution, the dropped unknowns being zero, and the null vectors N; then
//! `x + N c` with `(H N) c = −H x` is the step. R alone solves the least-squares problem, by seminormal equations corrected
//! once (Björck 1996, section 6.6.5): the error is that of a QR as long as the square of R₁₁'s condition times roundoff
//! is below one.
//!
//! Where A has another number of null directions, as redundant equations have at poses that do not close, there is no
//! answer of this kind, and the whole problem has to be solved. Cost: a sparse QR and a few solves, linear for chains.

use super::error::MatrixError;
use super::estimate::orthonormalise;
use super::frontal::factor_as_planned;
use super::multifrontal::{longest_passage, prepare};
use super::rank::ROUNDINGS;
use super::real::{Real, Ring};
use super::sparse::SparseMatrix;

/// Held directions must be seen in the null space at least so well: the smallest pivot of H N.
const SEEN: f64 = 1e-3;

/// A first solution that needs a larger correction than this is not trusted: the triangle is too badly conditioned.
const SMALL_CORRECTION: f64 = 1e-6;

/// The step `x` (one entry per column) for the right side `b` (one entry per row) and orthonormal held directions (one entry
/// per column each). `None` where the matrix has more or fewer null directions than are held, or where these lie too far
/// from them; nor where the matrix is too badly conditioned.
///
/// # Errors
/// [`MatrixError::Length`] where the right side or a direction does not fit; [`MatrixError::NotFinite`] for entries that are
/// not finite.
pub fn held_step(
    matrix: &SparseMatrix<f64>,
    right: &[f64],
    held: &[Vec<f64>],
) -> Result<Option<Vec<f64>>, MatrixError> {
    let columns = matrix.columns();
    if let Some(direction) = held.iter().find(|direction| direction.len() != columns) {
        return Err(MatrixError::Length {
            what: "held direction",
            expected: columns,
            found: direction.len(),
        });
    }
    let plan = prepare(matrix);
    let passage = longest_passage(matrix, &plan);
    let tolerance = ROUNDINGS * f64::EPSILON * passage as f64 * matrix.largest_entry()?.max(1.0);
    let factorization = factor_as_planned(matrix, &plan, tolerance)?;
    if factorization.exponent != 0 || columns - factorization.rank() != held.len() {
        return Ok(None);
    }
    let triangle = &factorization.triangle;
    let solve = |residual: &[f64]| -> Result<Vec<f64>, MatrixError> {
        let mut x = matrix.multiply_transposed(residual)?;
        triangle.forward_substitute(&mut x);
        for &column in triangle.dropped() {
            x[column] = 0.0;
        }
        triangle.back_substitute(&mut x);
        Ok(x)
    };
    let mut x = solve(right)?;
    let image = matrix.multiply(&x)?;
    let left: Vec<f64> = right.iter().zip(&image).map(|(b, y)| b - y).collect();
    let correction = solve(&left)?;
    // What is left after one correction is its square, relatively: rounding at most, if it is small.
    if !(0.0f64.norm(&correction) <= SMALL_CORRECTION * 0.0f64.norm(&x)) {
        return Ok(None);
    }
    x.iter_mut().zip(correction).for_each(|(x, d)| *x += d);
    if held.is_empty() {
        return Ok(finite(x));
    }
    let units: Vec<Vec<f64>> = (0..held.len())
        .map(|i| {
            (0..held.len())
                .map(|j| f64::from(u8::from(i == j)))
                .collect()
        })
        .collect();
    let mut null = factorization.null_vectors(&units)?;
    if !orthonormalise(&0.0, &mut null) {
        return Ok(None);
    }
    let size = held.len();
    let seen = nalgebra::DMatrix::from_fn(size, size, |i, j| 0.0f64.dot(&held[i], &null[j]));
    let wanted = nalgebra::DVector::from_fn(size, |i, _| -0.0f64.dot(&held[i], &x));
    let decomposed = seen.full_piv_lu();
    let smallest = decomposed
        .u()
        .diagonal()
        .iter()
        .fold(f64::INFINITY, |least, pivot| least.min(pivot.abs()));
    if !(smallest >= SEEN) {
        return Ok(None);
    }
    let Some(shares) = decomposed.solve(&wanted) else {
        return Ok(None);
    };
    for (share, vector) in shares.iter().zip(&null) {
        share.add_scaled(vector, &mut x);
    }
    Ok(finite(x))
}

/// Nothing where the solution left the range of numbers.
fn finite(x: Vec<f64>) -> Option<Vec<f64>> {
    x.iter().all(|value| value.is_finite()).then_some(x)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::random::SplitMix64;
    use super::*;

    /// A chain of blocks of four rows in six columns, two shared with the next; the last row of each repeats the first, so
    /// that some equations are redundant.
    fn chain(blocks: usize) -> SparseMatrix<f64> {
        let mut random = SplitMix64::new(3);
        let mut triplets = Vec::new();
        for block in 0..blocks {
            let rows: Vec<Vec<f64>> = (0..3)
                .map(|_| (0..6).map(|_| random.symmetric()).collect())
                .collect();
            for row in 0..4 {
                for (column, entry) in rows[row % 3].iter().enumerate() {
                    triplets.push((4 * block + row, 4 * block + column, *entry));
                }
            }
        }
        SparseMatrix::from_triplets(4 * blocks, 4 * blocks + 2, 0.0, triplets).unwrap()
    }

    fn held_kernel(matrix: &SparseMatrix<f64>) -> Vec<Vec<f64>> {
        let decision = super::super::rank::decide(matrix, 0.0).unwrap();
        super::super::null_space::null_basis(matrix, &decision)
            .unwrap()
            .vectors
    }

    #[test]
    fn the_step_is_that_of_the_whole_problem() {
        let matrix = chain(12);
        let held = held_kernel(&matrix);
        assert_eq!(held.len(), 14);
        let mut random = SplitMix64::new(9);
        let truth: Vec<f64> = (0..matrix.columns()).map(|_| random.symmetric()).collect();
        let right = matrix.multiply(&truth).unwrap();
        let x = held_step(&matrix, &right, &held).unwrap().unwrap();
        for direction in &held {
            assert!(0.0f64.dot(direction, &x).abs() < 1e-12);
        }
        // With the whole kernel held it is the shortest solution.
        let mut shortest = truth;
        for direction in &held {
            let along = 0.0f64.dot(direction, &shortest);
            (-along).add_scaled(direction, &mut shortest);
        }
        for (a, b) in x.iter().zip(&shortest) {
            assert!((a - b).abs() < 1e-10, "{a} {b}");
        }
    }

    #[test]
    fn directions_near_the_kernel_may_be_held_too() {
        let matrix = chain(3);
        let mut held = held_kernel(&matrix);
        let mut random = SplitMix64::new(4);
        for direction in &mut held {
            direction
                .iter_mut()
                .for_each(|x| *x += 0.05 * random.symmetric());
        }
        assert!(orthonormalise(&0.0, &mut held));
        let right = matrix.multiply(&vec![1.0; matrix.columns()]).unwrap();
        let x = held_step(&matrix, &right, &held).unwrap().unwrap();
        for direction in &held {
            assert!(0.0f64.dot(direction, &x).abs() < 1e-11);
        }
        let image = matrix.multiply(&x).unwrap();
        for (a, b) in image.iter().zip(&right) {
            assert!((a - b).abs() < 1e-10);
        }
    }

    #[test]
    fn another_number_of_null_directions_is_no_step() {
        let matrix = chain(3);
        let mut held = held_kernel(&matrix);
        held.pop();
        let right = vec![1.0; matrix.rows()];
        assert_eq!(held_step(&matrix, &right, &held).unwrap(), None);
        // Nor are directions that the kernel does not contain.
        held.push(matrix.triplets().filter(|t| t.0 == 0).fold(
            vec![0.0; matrix.columns()],
            |mut row, (_, column, value)| {
                row[column] = *value;
                row
            },
        ));
        assert_eq!(held_step(&matrix, &right, &held).unwrap(), None);
    }
}
