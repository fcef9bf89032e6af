//! The point of a convex set nearest to the origin, where the set is known by its extreme points only.
//!
//! Wolfe's algorithm (Wolfe 1976, "Finding the nearest point in a polytope", Mathematical Programming 11): keep a few
//! extreme points, affinely independent, and the point of their hull nearest to the origin; ask for the extreme point
//! farthest against it; add that, and drop points until the nearest point of the new affine hull lies inside the hull.
//! For a polytope this ends; for a round set the distance between bounds shrinks quickly, and the caller says when to stop.

use super::splitting::dot;
use nalgebra::{DMatrix, DVector};

/// Rounds after which the point found so far is returned.
const ROUNDS: usize = 300;

/// Weights below this are taken for zero.
const NO_WEIGHT: f64 = 1e-12;

/// The nearest point found.
pub(super) struct Nearest {
    /// The point.
    pub point: Vec<f64>,
    /// Least product of any point of the set with the unit vector along `point`: a lower bound of the distance.
    pub depth: f64,
}

/// Finds the point of a convex set nearest to the origin. `extreme(direction)` is a point of the set with the smallest
/// product with the direction; `start` is any point of the set. Stops when the lower bound of the distance is at least
/// `share` of the upper bound, or where the upper bound is at most `zero`.
pub(super) fn nearest_to_origin(
    start: Vec<f64>,
    extreme: &mut dyn FnMut(&[f64]) -> Option<Vec<f64>>,
    share: f64,
    zero: f64,
) -> Option<Nearest> {
    let mut corral = vec![start];
    let mut weights = vec![1.0];
    let mut best: Option<Nearest> = None;
    for _ in 0..ROUNDS {
        let point = combine(&corral, &weights);
        let distance = dot(&point, &point).sqrt();
        if !(distance > zero) {
            return best.or(Some(Nearest { point, depth: 0.0 }));
        }
        let direction: Vec<f64> = point.iter().map(|x| x / distance).collect();
        let farthest = extreme(&direction)?;
        let depth = dot(&farthest, &direction);
        if best.as_ref().is_none_or(|b| depth > b.depth) {
            best = Some(Nearest {
                point: point.clone(),
                depth,
            });
        }
        if depth >= share * distance {
            return best;
        }
        corral.push(farthest);
        weights.push(0.0);
        while let Some(affine) = affine_minimiser(&corral) {
            if affine.iter().all(|w| *w > NO_WEIGHT) {
                weights = affine;
                break;
            }
            // Go from the old weights towards the new ones as far as none becomes negative.
            let step = weights
                .iter()
                .zip(&affine)
                .filter(|(_, a)| **a <= NO_WEIGHT)
                .map(|(w, a)| w / (w - a).max(f64::MIN_POSITIVE))
                .fold(1.0, f64::min);
            for (w, a) in weights.iter_mut().zip(&affine) {
                *w += step * (a - *w);
            }
            let keep: Vec<bool> = weights.iter().map(|w| *w > NO_WEIGHT).collect();
            if keep.iter().all(|k| *k) || !keep.iter().any(|k| *k) {
                break;
            }
            let mut kept = keep.iter();
            corral.retain(|_| *kept.next().unwrap_or(&true));
            let mut kept = keep.iter();
            weights.retain(|_| *kept.next().unwrap_or(&true));
        }
        let total: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|w| *w /= total);
    }
    best
}

fn combine(points: &[Vec<f64>], weights: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; points.first().map_or(0, Vec::len)];
    for (point, weight) in points.iter().zip(weights) {
        sum.iter_mut()
            .zip(point)
            .for_each(|(s, p)| *s += weight * p);
    }
    sum
}

/// Weights of sum one of the point of the affine hull nearest to the origin; `None` where the points are dependent.
fn affine_minimiser(points: &[Vec<f64>]) -> Option<Vec<f64>> {
    let count = points.len();
    let scale = points
        .iter()
        .map(|p| dot(p, p))
        .fold(f64::MIN_POSITIVE, f64::max);
    // Stationarity of |Σ w p|² with Σ w = 1; adding 1 to every product does not change the minimiser's direction.
    let gram = DMatrix::from_fn(count, count, |i, j| {
        1.0 + dot(&points[i], &points[j]) / scale
    });
    let solution = gram.lu().solve(&DVector::from_element(count, 1.0))?;
    let total: f64 = solution.iter().sum();
    let weights: Vec<f64> = solution.iter().map(|w| w / total).collect();
    weights.iter().all(|w| w.is_finite()).then_some(weights)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn polytope(points: &[[f64; 3]], share: f64) -> Nearest {
        let mut extreme = |d: &[f64]| {
            let at = |p: &[f64; 3]| dot(p, d);
            points
                .iter()
                .min_by(|a, b| at(a).total_cmp(&at(b)))
                .map(|p| p.to_vec())
        };
        nearest_to_origin(points[0].to_vec(), &mut extreme, share, 1e-12).unwrap()
    }

    #[test]
    fn a_corner_an_edge_and_a_face() {
        let close = |points: &[[f64; 3]], expected: [f64; 3]| {
            let found = polytope(points, 1.0 - 1e-12);
            for (x, e) in found.point.iter().zip(expected) {
                assert!((x - e).abs() < 1e-9, "{:?}", found.point);
            }
        };
        close(
            &[[3.0, 2.0, 1.0], [1.0, 0.0, 1.0], [4.0, 0.0, 1.0]],
            [1.0, 0.0, 1.0],
        );
        close(
            &[[1.0, 2.0, 0.0], [1.0, -1.0, 0.0], [5.0, 0.0, 1.0]],
            [1.0, 0.0, 0.0],
        );
        close(
            &[
                [1.0, 2.0, 0.0],
                [1.0, -1.0, 1.0],
                [1.0, -1.0, -1.0],
                [2.0, 0.0, 0.0],
            ],
            [1.0, 0.0, 0.0],
        );
    }

    #[test]
    fn around_the_origin_there_is_no_distance() {
        let found = polytope(
            &[
                [1.0, 0.0, 0.0],
                [-1.0, 1.0, 0.0],
                [-1.0, -1.0, 1.0],
                [-1.0, -1.0, -1.0],
            ],
            0.9,
        );
        assert!(found.depth <= 0.0);
    }

    #[test]
    fn a_ball_is_round() {
        let centre = [3.0, -1.0, 2.0, 0.5];
        let mut extreme =
            |d: &[f64]| Some(centre.iter().zip(d).map(|(c, d)| c - 2.0 * d).collect());
        let start = vec![5.0, -1.0, 2.0, 0.5];
        let found = nearest_to_origin(start, &mut extreme, 0.999_999, 1e-12).unwrap();
        let expected = dot(&centre, &centre).sqrt() - 2.0;
        assert!((found.depth - expected).abs() < 1e-5 * expected);
    }
}
