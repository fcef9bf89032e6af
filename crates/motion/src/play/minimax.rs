//! The least common bound on several vectors that together solve linear equations.

use nalgebra::{DMatrix, DVector};

/// The bound is found to this share.
const GAP: f64 = 0.01;

/// Rounds of reweighting at most.
const ROUNDS: usize = 500;

/// Weights do not fall below this share of the largest: a vector that is not needed would divide by zero.
const LEAST_WEIGHT: f64 = 1e-9;

/// Eigenvalues below this share of the largest are no direction that the vectors reach.
const REACHED: f64 = 1e-13;

/// What is left of the right side, relative to it, where the vectors reach it.
const SOLVED: f64 = 1e-6;

/// A solution.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Minimax {
    /// The vectors.
    pub vectors: Vec<DVector<f64>>,
    /// The largest of their lengths.
    pub most: f64,
    /// No solution has a smaller one.
    pub at_least: f64,
}

/// Vectors `u_j` with `Σ A_j u_j = b` whose longest is as short as possible, within one hundredth where reweighting gets so far;
/// `None` where there are none.
///
/// By duality the least length is `max bᵀy / Σ ‖A_jᵀ y‖`, a bound from below for every `y`. With weights `w_j` the solution of
/// least `Σ w_j ‖u_j‖²` is `u_j = A_jᵀ y / w_j` for the `y` that solves `(Σ A_j A_jᵀ / w_j) y = b`; weights that are multiplied by the
/// lengths of their vectors again and again (Lawson's algorithm) make the longest ones alike.
pub(super) fn minimax(blocks: &[DMatrix<f64>], b: &DVector<f64>) -> Option<Minimax> {
    if b.norm() == 0.0 {
        return Some(Minimax {
            vectors: blocks.iter().map(|a| DVector::zeros(a.ncols())).collect(),
            most: 0.0,
            at_least: 0.0,
        });
    }
    let mut weights = vec![1.0; blocks.len()];
    let mut best: Option<Minimax> = None;
    for _ in 0..ROUNDS {
        let y = multipliers(blocks, &weights, b)?;
        let pulled: Vec<DVector<f64>> = blocks.iter().map(|a| a.transpose() * &y).collect();
        let sum: f64 = pulled.iter().map(DVector::norm).sum();
        let at_least = b.dot(&y) / sum;
        let vectors: Vec<DVector<f64>> = pulled.iter().zip(&weights).map(|(p, w)| p / *w).collect();
        let most = vectors.iter().map(DVector::norm).fold(0.0, f64::max);
        let known = best
            .as_ref()
            .map_or(0.0, |best| best.at_least)
            .max(at_least);
        match &mut best {
            Some(best) if best.most <= most => best.at_least = known,
            _ => {
                best = Some(Minimax {
                    vectors: vectors.clone(),
                    most,
                    at_least: known,
                });
            }
        }
        let here = best.as_ref()?;
        if here.most <= here.at_least * (1.0 + GAP) {
            break;
        }
        weights
            .iter_mut()
            .zip(&vectors)
            .for_each(|(w, v)| *w *= v.norm() / most);
        let largest = weights.iter().copied().fold(0.0, f64::max);
        weights
            .iter_mut()
            .for_each(|w| *w = (*w / largest).max(LEAST_WEIGHT));
    }
    best
}

/// The `y` of the weighted solution; `None` where the vectors do not reach the right side.
fn multipliers(blocks: &[DMatrix<f64>], weights: &[f64], b: &DVector<f64>) -> Option<DVector<f64>> {
    let mut normal = DMatrix::zeros(b.len(), b.len());
    for (a, w) in blocks.iter().zip(weights) {
        normal.gemm(1.0 / *w, a, &a.transpose(), 1.0);
    }
    let eigen = normal.clone().symmetric_eigen();
    let most = eigen.eigenvalues.max();
    let mut y = DVector::zeros(b.len());
    for (value, vector) in eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
    {
        if *value > REACHED * most {
            y.axpy(vector.dot(b) / value, &vector, 1.0);
        }
    }
    let left = (&normal * &y - b).norm();
    (left <= SOLVED * b.norm()).then_some(y)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // a test may panic
mod tests {
    use super::*;

    fn row(entries: &[f64]) -> DMatrix<f64> {
        DMatrix::from_row_slice(1, entries.len(), entries)
    }

    #[test]
    fn what_several_can_share_is_shared() {
        let three = vec![row(&[1.0]), row(&[1.0]), row(&[1.0])];
        let found = minimax(&three, &DVector::from_element(1, 0.6)).unwrap();
        assert!((found.most - 0.2).abs() < 1e-12 && found.at_least > 0.198);
        // The longer lever does as much as the two others together.
        let levers = vec![row(&[2.0]), row(&[1.0]), row(&[1.0])];
        let found = minimax(&levers, &DVector::from_element(1, 1.0)).unwrap();
        assert!((found.most - 0.25).abs() < 0.0025, "{}", found.most);
    }

    #[test]
    fn a_line_between_three_points_is_chebyshev_s() {
        // Points at 0, 1 and 3 with heights 0, 1, 0: deviations u with u₀ − (3/2) u₁ + (1/2) u₂ = −3/2 … the least largest is 1/2.
        let blocks = vec![row(&[1.0]), row(&[-1.5]), row(&[0.5])];
        let found = minimax(&blocks, &DVector::from_element(1, 1.5)).unwrap();
        assert!((found.most - 0.5).abs() < 0.005, "{}", found.most);
        assert!(found.at_least <= 0.5 + 1e-12 && found.at_least > 0.495);
    }

    #[test]
    fn random_problems_are_solved_to_a_hundredth() {
        use kutzbach_math::matrix::SplitMix64;
        let mut random = SplitMix64::new(5);
        for _ in 0..100 {
            let blocks: Vec<DMatrix<f64>> = (0..7)
                .map(|_| DMatrix::from_fn(6, 5, |_, _| random.symmetric()))
                .collect();
            let b = DVector::from_fn(6, |_, _| random.symmetric());
            let found = minimax(&blocks, &b).unwrap();
            let sum = blocks.iter().zip(&found.vectors);
            let left = sum.fold(-b.clone(), |sum, (a, u)| sum + a * u);
            assert!(left.norm() < 1e-9);
            assert!(found.most <= 1.0101 * found.at_least, "{found:?}");
        }
    }

    #[test]
    fn what_nothing_reaches_has_no_solution() {
        let blocks = vec![DMatrix::from_row_slice(2, 1, &[1.0, 0.0])];
        assert!(minimax(&blocks, &DVector::from_row_slice(&[0.0, 1.0])).is_none());
    }
}
