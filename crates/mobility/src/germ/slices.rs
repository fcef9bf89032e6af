//! Power series on a random linear subspace.

use super::splitting::dot;
use kutzbach_math::group::{Monomials, Series};
use kutzbach_math::matrix::SplitMix64;
use std::sync::Arc;

/// `dimension` random orthonormal vectors of `size` coordinates; fewer where the space has fewer.
pub(super) fn random_subspace(
    size: usize,
    dimension: usize,
    random: &mut SplitMix64,
) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(dimension);
    while basis.len() < dimension.min(size) {
        let mut vector: Vec<f64> = (0..size).map(|_| random.symmetric()).collect();
        for _ in 0..2 {
            for before in &basis {
                let along = dot(before, &vector);
                vector
                    .iter_mut()
                    .zip(before)
                    .for_each(|(x, b)| *x -= along * b);
            }
        }
        let norm = dot(&vector, &vector).sqrt();
        // A random vector that lies almost in the span of the others is drawn again.
        if norm > 1e-2 {
            basis.push(vector.iter().map(|x| x / norm).collect());
        }
    }
    basis
}

/// Every series f(y) as a series in the coordinates of the subspace, f(Σ z_i basis_i); `None` where the table of monomials
/// would be too large.
pub(super) fn restricted(series: &[Series], basis: &[Vec<f64>]) -> Option<Vec<Series>> {
    let Some(first) = series.first() else {
        return Some(Vec::new());
    };
    let from = first.monomials();
    let to: Arc<Monomials> = Monomials::new(basis.len(), from.degree()).ok()?;
    let linear: Vec<Series> = (0..from.variables())
        .map(|i| {
            let coefficients: Vec<f64> = basis.iter().map(|b| b[i]).collect();
            Series::linear(&to, &coefficients)
        })
        .collect();
    composed(series, &linear)
}

/// Every series with series in the place of its variables, none of which has a constant term.
pub(super) fn composed(series: &[Series], variables: &[Series]) -> Option<Vec<Series>> {
    let (Some(first), Some(inner)) = (series.first(), variables.first()) else {
        return Some(Vec::new());
    };
    let (from, to) = (first.monomials(), inner.monomials());
    // Every monomial is one of lower degree times a variable, and comes later in the numbering.
    let mut powers: Vec<Series> = vec![Series::constant(to, 1.0)];
    for slot in 1..from.count() {
        let mut exponents = from.exponents(slot).to_vec();
        let variable = exponents.iter().position(|e| *e > 0)?;
        exponents[variable] -= 1;
        let lower = from.index_of(&exponents)?;
        powers.push(&variables[variable] * &powers[lower]);
    }
    let compose = |f: &Series| {
        let mut sum = Series::zero(to);
        for (c, power) in f.coefficients().iter().zip(&powers) {
            if *c != 0.0 {
                sum.add_scaled(*c, power);
            }
        }
        sum
    };
    Some(series.iter().map(compose).collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn restriction_is_evaluation_on_the_subspace() {
        let m = Monomials::new(4, 5).unwrap();
        let coefficients = (0..m.count()).map(|i| ((7 * i + 2) % 11) as f64 - 5.0);
        let f = Series::from_coefficients(&m, coefficients.collect());
        let basis = random_subspace(4, 2, &mut SplitMix64::new(1));
        let g = &restricted(std::slice::from_ref(&f), &basis).unwrap()[0];
        let z = [0.3, -0.4];
        let y: Vec<f64> = (0..4)
            .map(|i| z[0] * basis[0][i] + z[1] * basis[1][i])
            .collect();
        assert!((f.evaluate(&y) - g.evaluate(&z)).abs() < 1e-12);
        for (i, a) in basis.iter().enumerate() {
            for (j, b) in basis.iter().enumerate() {
                assert!((dot(a, b) - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn on_a_point_only_the_constant_is_left() {
        let m = Monomials::new(2, 3).unwrap();
        let f = &Series::constant(&m, 2.0) + &Series::linear(&m, &[1.0, 1.0]);
        let g = restricted(&[f], &[]).unwrap();
        assert_eq!(g[0].coefficients(), [2.0]);
        assert!(restricted(&[], &[]).unwrap().is_empty());
    }
}
