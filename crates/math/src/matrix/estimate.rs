//! Estimates of extreme singular values of large matrices.
//!
//! A pivoted factor bounds σ_{k+1} from above but says little about σ_k: Kahan's triangles have
//! moderate pivots and a tiny σ_k. Inverse iteration on the kept triangle R₁₁ finds that out for the
//! price of a few solves, as SPQR_RANK does (Foster and Davis 2013, §2). Since adding columns never
//! lowers a singular value, σ_k(\[R₁₁ R₁₂\]) ≥ σ_min(R₁₁): the estimate errs towards doubt.
//!
//! How far it errs depends on which columns were dropped. In a long chain of loops the motions of
//! the ends may differ by a factor of 10²⁰; if the column of the small end is dropped, R₁₁ is
//! singular to working precision although the rank is clear. [`smallest_singular_values`] then
//! factors \[R₁₁ R₁₂\]ᵀ in turn, which leaves a square triangle with exactly the singular values of
//! \[R₁₁ R₁₂\] (a complete orthogonal decomposition, Golub and Van Loan 2013, §5.4.7).

use super::error::MatrixError;
use super::frontal::{Factorization, factor, times_power_of_two};
use super::jacobi;
use super::random::SplitMix64;
use super::real::Real;
use super::sparse::SparseMatrix;
use crate::interruption;

/// Steps of power iteration: a random start has a component of about 1/√n along the wanted vector,
/// so after 20 steps the estimate is typically below σ₁ by no more than a factor n^(1/40), which is
/// 1.4 for a million columns.
const POWER_STEPS: usize = 20;

/// Steps of inverse iteration: by the same reasoning an estimate typically exceeds σ_min by no more
/// than a factor n^(1/10) when much of the spectrum is close to it, and by nothing at a gap.
const INVERSE_STEPS: usize = 5;

/// An estimate of the largest singular value, from below, in the arithmetic of doubles.
///
/// At least the length of the longest column; zero for a matrix without entries; cut off at the
/// largest double.
///
/// # Errors
/// [`MatrixError::NotFinite`] for entries that are not finite doubles.
pub fn largest_singular_value<R: Real>(matrix: &SparseMatrix<R>) -> Result<f64, MatrixError> {
    let largest = matrix.largest_entry()?;
    if largest == 0.0 {
        return Ok(0.0);
    }
    // Entries of at most 1, so that no product overflows.
    let doubles = matrix.map(&0.0, |value| Real::to_f64(value) / largest);
    let mut squares = vec![0.0f64; matrix.columns()];
    for (_, column, value) in doubles.triplets() {
        squares[column] += value * value;
    }
    let longest = squares.iter().fold(0.0f64, |top, &x| top.max(x)).sqrt();
    let mut random = SplitMix64::new(0x5eed);
    let mut x: Vec<f64> = (0..matrix.columns()).map(|_| random.symmetric()).collect();
    let mut estimate = longest;
    for _ in 0..POWER_STEPS {
        let length = 0.0f64.norm(&x);
        if length == 0.0 {
            break;
        }
        x.iter_mut().for_each(|value| *value /= length);
        let image = doubles.multiply(&x)?;
        estimate = estimate.max(0.0f64.norm(&image));
        x = doubles.multiply_transposed(&image)?;
    }
    Ok((estimate * largest).min(f64::MAX))
}

/// Estimates, from above, of the `count` smallest singular values of the kept columns, smallest
/// first; fewer where the rank is smaller. Zero where a solve overflowed.
///
/// Cost: 2 · `count` · 5 solves with the factor.
#[must_use]
pub fn smallest_kept_singular_values<R: Real>(
    factorization: &Factorization<R>,
    count: usize,
) -> Vec<f64> {
    let triangle = &factorization.triangle;
    let zero = triangle.zero();
    let count = count.min(triangle.rank());
    let kept: Vec<usize> = triangle.kept().collect();
    let mut random = SplitMix64::new(0x1d1e);
    // Vectors hold the kept components, in the order of `kept`.
    let mut basis: Vec<Vec<R>> = (0..count)
        .map(|_| {
            kept.iter()
                .map(|_| zero.constant(random.symmetric()))
                .collect()
        })
        .collect();
    let mut images: Vec<Vec<R>> = Vec::new();
    let mut full = vec![zero.clone(); triangle.columns()];
    for _ in 0..INVERSE_STEPS {
        if !orthonormalise(zero, &mut basis) {
            return vec![0.0; count];
        }
        images.clear();
        for vector in &mut basis {
            full.fill(zero.clone());
            for (&name, value) in kept.iter().zip(vector.iter()) {
                full[name] = value.clone();
            }
            triangle.forward_substitute(&mut full);
            images.push(kept.iter().map(|&name| full[name].clone()).collect());
            for &name in triangle.dropped() {
                full[name] = zero.clone();
            }
            triangle.back_substitute(&mut full);
            for (value, &name) in vector.iter_mut().zip(&kept) {
                *value = full[name].clone();
            }
        }
    }
    // Singular values of R₁₁⁻ᵀ on a subspace never exceed those of R₁₁⁻ᵀ itself.
    match jacobi::singular_values(zero, images) {
        Some(values) => values
            .iter()
            .map(|value| {
                let inverse = zero.one_like() / value.clone();
                times_power_of_two(Real::to_f64(&inverse), factorization.exponent)
            })
            .collect(),
        None => vec![0.0; count],
    }
}

/// Estimates, from above, of the `count` smallest nonzero singular values of \[R₁₁ R₁₂\], smallest
/// first: those of the matrix itself but for the backward error. Fewer where the rank is smaller.
///
/// Costs a second factorization, of the factor.
///
/// # Errors
/// [`MatrixError::NotFinite`] if the factor is not finite.
pub fn smallest_singular_values<R: Real>(
    factorization: &Factorization<R>,
    count: usize,
) -> Result<Vec<f64>, MatrixError> {
    let triangle = &factorization.triangle;
    let transposed = triangle
        .entries()
        .map(|(row, column, value)| (column, row, value.clone()));
    let transposed = SparseMatrix::from_triplets(
        triangle.columns(),
        triangle.rank(),
        triangle.zero().clone(),
        transposed,
    )?;
    let second = factor(&transposed, 0.0)?;
    if second.rank() < triangle.rank() {
        // A remainder that is exactly zero: R₁₁ has rows beyond the range of the arithmetic.
        return Ok(vec![0.0; count.min(triangle.rank())]);
    }
    let unscaled = |value| times_power_of_two(value, factorization.exponent);
    let values = smallest_kept_singular_values(&second, count);
    Ok(values.into_iter().map(unscaled).collect())
}

/// Orthonormalises vectors by Gram–Schmidt, twice; false if one vanishes or is not finite, or the work is asked to end.
///
/// Twice is enough for orthogonality to working precision (Giraud, Langou and Rozložník 2005).
pub(crate) fn orthonormalise<R: Real>(zero: &R, vectors: &mut [Vec<R>]) -> bool {
    for current in 0..vectors.len() {
        if interruption::asked() {
            return false;
        }
        let (before, rest) = vectors.split_at_mut(current);
        let vector = &mut rest[0];
        let mut length = zero.norm(vector);
        // A first normalisation keeps the products below in range.
        for _ in 0..3 {
            if length.is_zero() || !length.is_finite() {
                return false;
            }
            vector
                .iter_mut()
                .for_each(|value| *value = value.clone() / length.clone());
            if before.is_empty() {
                break;
            }
            for earlier in before.iter() {
                let product = zero.dot(earlier, vector);
                (-product).add_scaled(earlier, vector);
            }
            length = zero.norm(vector);
        }
        if !before.is_empty() {
            if length.is_zero() {
                return false;
            }
            vector
                .iter_mut()
                .for_each(|value| *value = value.clone() / length.clone());
        }
    }
    true
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::frontal::factor;
    use super::super::real::Ring;
    use super::*;

    #[test]
    fn a_diagonal_tells_its_extremes() {
        let entries = (0..50).map(|i| (i, i, 2f64.powi(-(i as i32))));
        let matrix = SparseMatrix::from_triplets(50, 50, 0.0, entries).unwrap();
        let largest = largest_singular_value(&matrix).unwrap();
        assert!((largest - 1.0).abs() < 1e-12);
        let factorization = factor(&matrix, 0.0).unwrap();
        let smallest = smallest_kept_singular_values(&factorization, 2);
        assert!((smallest[0] / 2f64.powi(-49) - 1.0).abs() < 1e-6);
        assert!((smallest[1] / 2f64.powi(-48) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn nothing_to_estimate() {
        let empty = SparseMatrix::<f64>::from_triplets(3, 2, 0.0, vec![]).unwrap();
        assert_eq!(largest_singular_value(&empty).unwrap(), 0.0);
        let factorization = factor(&empty, 0.0).unwrap();
        assert!(smallest_kept_singular_values(&factorization, 2).is_empty());
    }

    #[test]
    fn extreme_units_change_nothing() {
        for scale in [1e-300, 1e-90, 1e90, 1e300] {
            let entries = vec![(0, 0, scale), (1, 1, 0.5 * scale), (0, 1, 0.25 * scale)];
            let matrix = SparseMatrix::from_triplets(2, 2, 0.0, entries).unwrap();
            let factorization = factor(&matrix, 0.0).unwrap();
            let smallest = smallest_kept_singular_values(&factorization, 2);
            let product = (smallest[0] / scale) * (smallest[1] / scale);
            assert!(
                (product - 0.5).abs() < 1e-10,
                "determinant 1/2, found {product}"
            );
        }
    }

    #[test]
    fn dependent_vectors_are_noticed() {
        let mut vectors = vec![vec![1.0, 0.0], vec![2.0, 0.0]];
        assert!(!orthonormalise(&0.0, &mut vectors));
        let mut vectors = vec![vec![1.0, 1e-9, 0.0], vec![1.0, 0.0, 1e-9]];
        assert!(orthonormalise(&0.0, &mut vectors));
        assert!(0.0f64.dot(&vectors[0], &vectors[1]).abs() < 1e-15);
    }
}
