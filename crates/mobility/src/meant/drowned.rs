//! Directions of the dimensions' equations that tell nothing, because what numbers do to second order drowns what they do to first.

use super::least_largest::Decomposed;
use super::nearest::STALLED;

/// Singular values of the dimensions' equations below this share of the largest are zero at a solution: difference quotients
/// leave less of them.
pub(super) const DEPENDENT: f64 = 1e-9;

/// What the second order of all numbers together may be, in units of the square of their first.
const SECOND_ORDER: f64 = 3.0;

/// However coarse the numbers are, directions above this share tell something: the coarsest are mostly along axes, where they do
/// nothing to second order.
const COARSEST: f64 = 3e-3;

/// The share of the `most` that numbers do below which directions tell nothing: numbers within their digits leave over, to second order,
/// about the square of what they do to first order.
pub(super) fn drowned(most: f64) -> f64 {
    (SECOND_ORDER * most).clamp(DEPENDENT, COARSEST)
}

/// What the largest entry of z has to be at least for `a z = b` in the directions that tell nothing else, what z leaves over to second
/// order allowed for: where numbers written in full would have to change, those written with fewer digits do not help.
///
/// Along a left singular vector u of these, `|uᵀb| ≤ ‖Aᵀu‖₁ z + Q z²` where Q bounds the second order of all numbers together.
pub(super) fn least_of_drowned(equations: &Decomposed<'_>, b: &[f64]) -> f64 {
    let a = equations.matrix;
    let (u, s) = (equations.svd.U(), equations.svd.S().column_vector());
    let most = if s.nrows() > 0 { s[0] } else { 0.0 };
    let second = SECOND_ORDER * most * most * a.ncols() as f64;
    let least = |j: usize| {
        let along = |column: &dyn Fn(usize) -> f64| -> f64 {
            (0..a.nrows()).map(|i| u[(i, j)] * column(i)).sum()
        };
        // Poses are closed, and quotients taken, to so much.
        let missing = (along(&|i| b[i]).abs() - 10.0 * STALLED).max(0.0);
        let first: f64 = (0..a.ncols()).map(|k| along(&|i| a[(i, k)]).abs()).sum();
        // Half of it by either order.
        let by_first = 0.5 * missing / first.max(f64::MIN_POSITIVE);
        let by_second = (0.5 * missing / second.max(f64::MIN_POSITIVE)).sqrt();
        by_first.min(by_second)
    };
    (0..s.nrows())
        .filter(|&j| s[j] <= drowned(most) * most)
        .map(least)
        .fold(0.0, f64::max)
}
