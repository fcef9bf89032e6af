//! The least largest entry of a solution of linear equations.
//!
//! Wanted is z with A z = b whose largest entry is least. By duality
//!
//! ```text
//! min ‖z‖∞  over A z = b   =   max yᵀb / ‖Aᵀy‖₁
//! ```
//!
//! so that every y gives a lower bound and every solution an upper one. With weights d > 0 the solution of least Σ d z² is z = Aᵀy / d; the
//! weights d ← |Aᵀy| make its entries alike, all but those that need not be as large (iteratively reweighted least squares for the
//! dual, a fit in the 1-norm: Schlossmacher 1973). It ends where the two bounds meet.

use faer::Mat;
use nalgebra::{DMatrix, DVector};

/// Rounds of weighing.
const ROUNDS: usize = 120;

/// The bounds have met where they differ by no more than this share.
const MET: f64 = 5e-3;

/// Solutions are accurate to this share.
const ACCURATE: f64 = 1e-6;

/// Weights are at least this share of the largest, so that the normal equations stay well conditioned.
const LIGHTEST: f64 = 1e-7;

/// A solution, and what the largest entry of any has to be at least.
pub(super) struct LeastLargest {
    pub z: Vec<f64>,
    pub at_least: f64,
}

/// Linear equations with their singular value decomposition, made once for all that is asked of them.
pub(super) struct Decomposed<'a> {
    pub matrix: &'a Mat<f64>,
    pub svd: faer::linalg::solvers::Svd<f64>,
}

impl<'a> Decomposed<'a> {
    /// `None` where the decomposition fails.
    pub fn of(matrix: &'a Mat<f64>) -> Option<Self> {
        let svd = matrix.thin_svd().ok()?;
        Some(Self { matrix, svd })
    }

    /// What is left of a right side where so much along each left singular vector is rounding.
    pub fn but_for_rounding(&self, b: &[f64], rounding: f64) -> Vec<f64> {
        let u = self.svd.U();
        let mut left = vec![0.0; b.len()];
        for j in 0..u.ncols() {
            let along: f64 = b.iter().enumerate().map(|(i, b)| u[(i, j)] * b).sum();
            let beyond = (along.abs() - rounding).max(0.0).copysign(along);
            for (i, left) in left.iter_mut().enumerate() {
                *left += beyond * u[(i, j)];
            }
        }
        left
    }

    /// The solution of `a z = b` whose largest entry is least, in the sense of least squares and without the equations whose singular
    /// value is below a share of the largest, which is told to `dependent`; `None` where none is found.
    pub fn least_largest(&self, b: &[f64], dependent: impl Fn(f64) -> f64) -> Option<LeastLargest> {
        let (u, s, v) = (self.svd.U(), self.svd.S().column_vector(), self.svd.V());
        let kept = (0..s.nrows())
            .take_while(|&j| s[j] > dependent(s[0]) * s[0] && s[j] > 0.0)
            .count();
        // Orthonormal rows: Vᵀ z = c.
        let rows = DMatrix::from_fn(v.nrows(), kept, |i, j| v[(i, j)]);
        let right = DVector::from_fn(kept, |j, _| {
            (0..b.len()).map(|i| u[(i, j)] * b[i]).sum::<f64>() / s[j]
        });
        least_largest_of(&rows, &right)
    }
}

/// [`Decomposed::least_largest`] of equations that are asked once; `None` where their decomposition fails, too.
pub(super) fn least_largest(
    a: &Mat<f64>,
    b: &[f64],
    dependent: impl Fn(f64) -> f64,
) -> Option<LeastLargest> {
    Decomposed::of(a)?.least_largest(b, dependent)
}

/// The solution of equations whose rows, the columns of `rows`, are orthonormal.
fn least_largest_of(rows: &DMatrix<f64>, right: &DVector<f64>) -> Option<LeastLargest> {
    let (count, kept) = rows.shape();
    let zero = LeastLargest {
        z: vec![0.0; count],
        at_least: 0.0,
    };
    if kept == 0 {
        return Some(zero);
    }
    let mut weights = vec![1.0; count];
    let mut best = (f64::INFINITY, zero.z);
    let mut at_least = 0.0f64;
    for _ in 0..ROUNDS {
        let scaled = DMatrix::from_fn(count, kept, |i, j| rows[(i, j)] / weights[i]);
        let Some(factor) = (rows.transpose() * &scaled).cholesky() else {
            break;
        };
        let y = factor.solve(right);
        let dual = rows * &y;
        let z: Vec<f64> = dual.iter().zip(&weights).map(|(x, w)| x / w).collect();
        let largest = z.iter().fold(0.0f64, |m, x| x.abs().max(m));
        let sum: f64 = dual.iter().map(|x| x.abs()).sum();
        if !largest.is_finite() || !(sum > 0.0) {
            break;
        }
        // No bound exceeds a solution: where it does, or that is none, the weights have become too different for the arithmetic.
        let solved = (rows.tr_mul(&DVector::from_column_slice(&z)) - right).norm();
        let bound = right.dot(&y) / sum;
        if solved > ACCURATE * right.norm() || !(bound <= largest * (1.0 + ACCURATE)) {
            break;
        }
        at_least = at_least.max(bound);
        if largest < best.0 {
            best = (largest, z);
        }
        if best.0 <= (1.0 + MET) * at_least {
            break;
        }
        let most = dual.iter().fold(0.0f64, |m, x| x.abs().max(m));
        for (weight, x) in weights.iter_mut().zip(dual.iter()) {
            *weight = x.abs().max(LIGHTEST * most);
        }
    }
    best.0.is_finite().then_some(LeastLargest {
        z: best.1,
        at_least,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn three_points_of_a_line_share_what_they_miss() {
        // x₁ − 2 x₂ + x₃ = 3: a change of 3/4 each is the least.
        let a = Mat::from_fn(1, 3, |_, j| [1.0, -2.0, 1.0][j]);
        let found = least_largest(&a, &[3.0], |_| 1e-9).unwrap();
        let largest = found.z.iter().fold(0.0f64, |m, x| x.abs().max(m));
        assert!(
            (largest - 0.75).abs() < 0.01 && found.at_least > 0.74,
            "{:?}",
            found.z
        );
    }

    #[test]
    fn rounding_asks_for_no_change() {
        let a = Mat::from_fn(2, 2, |i, j| [[1.0, 0.0], [0.0, 1e-8]][i][j]);
        let equations = Decomposed::of(&a).unwrap();
        let b = [0.5, 1e-6];
        let least = |b: &[f64]| equations.least_largest(b, |_| 1e-9).unwrap().at_least;
        assert!(least(&b) > 90.0);
        let beyond = equations.but_for_rounding(&b, 2e-6);
        assert!((beyond[0] - 0.5).abs() < 1e-5 && beyond[1].abs() < 1e-12);
        assert!(least(&beyond) < 1.0, "{}", least(&beyond));
    }

    #[test]
    fn bounds_meet_on_dependent_equations() {
        // Two equations, one of them twice, in five unknowns of different reach.
        let row = |i: usize, j: usize| match i {
            1 => [0.0, 1.0, 3.0, -1.0, 0.1][j],
            _ => [1.0, 0.5, -2.0, 0.0, 0.3][j],
        };
        let a = Mat::from_fn(3, 5, row);
        let found = least_largest(&a, &[1.0, 2.0, 1.0], |_| 1e-9).unwrap();
        let largest = found.z.iter().fold(0.0f64, |m, x| x.abs().max(m));
        assert!(
            largest <= 1.02 * found.at_least,
            "{largest} {}",
            found.at_least
        );
        for (i, b) in [(0, 1.0), (1, 2.0)] {
            let sum: f64 = (0..5).map(|j| row(i, j) * found.z[j]).sum();
            assert!((sum - b).abs() < 1e-9);
        }
    }
}
