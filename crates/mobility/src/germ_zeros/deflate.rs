//! Multiple zeros: the equations together with the derivatives that vanish there too.
//!
//! At a zero where the Jacobian has rank r below its generic value, combinations uᵀκ with uᵀJ = 0 have a vanishing gradient.
//! Adding these gradients to the equations makes the zero simple again if its multiplicity is two (Leykin, Verschelde and Zhao
//! 2006; here u is found anew in each step instead of being an unknown). Gauss–Newton on κ alone converges linearly there,
//! and hardly at all where the second derivatives are of different sizes.

use super::correct::{Landing, Within, land};
use super::small::{distance, dot, least_squares, length, plus, singular, unit};
use super::system::{Level, Work};

/// How far the deflated iteration may move a point, in units of the radius.
const REACH: f64 = 0.1;

/// A zero on the sphere; where damped Gauss–Newton ends above the noise, by deflation if that reaches the noise.
pub(super) fn land_firmly(level: &Level<'_>, start: &[f64], work: &mut Work) -> Landing {
    let landed = land(level, start, &Within::Sphere, 60, work);
    if landed.above_noise <= 1.0 || landed.above_truncation > 1.0 {
        return landed;
    }
    deflated(level, &landed, work).unwrap_or(landed)
}

/// The multiple zero near a point, for the largest rank with which one is found.
pub(super) fn deflated(level: &Level<'_>, near: &Landing, work: &mut Work) -> Option<Landing> {
    let largest = level.system.count().min(near.z.len() - 1);
    (0..largest)
        .rev()
        .find_map(|rank| with_rank(level, near, rank, work))
}

fn with_rank(level: &Level<'_>, near: &Landing, rank: usize, work: &mut Work) -> Option<Landing> {
    let columns = near.z.len();
    let count = level.system.count();
    let mut z = near.z.clone();
    for _ in 0..12 {
        level.evaluate(&z, work);
        let transposed: Vec<Vec<f64>> = (0..columns)
            .map(|i| work.jacobian.iter().map(|row| row[i]).collect())
            .collect();
        let (_, left) = singular(&transposed, count);
        let flat = &left[rank..];
        let mut rows = work.jacobian.clone();
        let mut right: Vec<f64> = work.values.iter().map(|v| -v).collect();
        let gradients = |jacobian: &[Vec<f64>]| -> Vec<f64> {
            flat.iter()
                .flat_map(|u| {
                    (0..columns)
                        .map(move |i| u.iter().zip(jacobian).map(|(w, row)| w * row[i]).sum())
                })
                .collect()
        };
        right.extend(gradients(&work.jacobian).iter().map(|g| -g));
        // Central differences: exact for quadratic gradients, otherwise wrong by the square of the step.
        const STEP: f64 = 1e-4;
        let mut second = vec![vec![0.0; columns]; flat.len() * columns];
        for i in 0..columns {
            for sign in [1.0, -1.0] {
                let mut moved = z.clone();
                moved[i] += sign * STEP;
                level.evaluate(&moved, work);
                for (row, g) in second.iter_mut().zip(gradients(&work.jacobian)) {
                    row[i] += sign * g / (2.0 * STEP);
                }
            }
        }
        rows.extend(second);
        rows.push(z.clone());
        right.push(0.0);
        for i in 0..columns {
            let mut row = vec![0.0; columns];
            row[i] = 1e-7;
            rows.push(row);
            right.push(0.0);
        }
        let by = least_squares(&mut rows, &mut right, columns);
        let by = plus(&by, -dot(&by, &z), &z);
        let reach = length(&by);
        z = unit(plus(&z, 1.0, &by));
        if !reach.is_finite() || distance(&z, &near.z) > REACH {
            return None;
        }
        if reach < 1e-13 {
            break;
        }
    }
    level.evaluate(&z, work);
    let landing = Landing {
        above_noise: level.above_noise(&work.values),
        above_truncation: level.above_truncation(&work.values),
        size: length(&work.values),
        z,
    };
    (landing.above_noise <= 1.0).then_some(landing)
}
