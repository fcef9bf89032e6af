//! Moving a point onto the zero set: damped Gauss–Newton steps on a sphere or in an affine slice.

use super::small::{dot, least_squares, length, plus, project, singular, unit};
use super::system::{Level, Work};
use kutzbach_math::interruption;

/// Where the point may go.
pub(super) enum Within<'a> {
    /// The unit sphere.
    Sphere,
    /// The affine space through the start whose directions are orthogonal to these orthonormal ones.
    Slice(&'a [Vec<f64>]),
}

/// Where the iteration ended.
#[derive(Clone, Debug)]
pub(super) struct Landing {
    pub(super) z: Vec<f64>,
    /// Largest weighted value in units of the noise.
    pub(super) above_noise: f64,
    /// Largest weighted value in units of noise and truncation.
    pub(super) above_truncation: f64,
    /// Euclidean norm of the weighted values.
    pub(super) size: f64,
}

/// One damped step from `z`, where `work` holds values and derivatives; lengths in units of the radius.
fn step(work: &Work, z: &[f64], within: &Within<'_>, damping: f64) -> Vec<f64> {
    let columns = z.len();
    let own;
    let fixed: &[Vec<f64>] = match within {
        Within::Sphere => {
            own = [z.to_vec()];
            &own
        }
        Within::Slice(directions) => directions,
    };
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(work.jacobian.len() + fixed.len() + columns);
    let mut largest = 0.0_f64;
    for row in &work.jacobian {
        let free = plus(row, -1.0, &project(row, fixed));
        largest = largest.max(length(&free));
        rows.push(free);
    }
    let mut right: Vec<f64> = work.values.iter().map(|v| -v).collect();
    // The fixed directions get the size of the largest row, so that no scale is mixed in.
    let size = if largest > 0.0 { largest } else { 1.0 };
    for direction in fixed {
        rows.push(direction.iter().map(|x| size * x).collect());
        right.push(0.0);
    }
    if damping > 0.0 {
        for i in 0..columns {
            let mut row = vec![0.0; columns];
            row[i] = damping.sqrt() * size;
            rows.push(row);
            right.push(0.0);
        }
    }
    least_squares(&mut rows, &mut right, columns)
}

/// Levenberg–Marquardt (Moré 1978) until the values are rounding, or no longer fall.
///
/// At a multiple zero the values still fall by a factor of about 4 to e in each step, the point converges linearly: forty steps
/// reach the noise, with as many digits in the point as a root of the multiplicity leaves.
pub(super) fn land(
    level: &Level<'_>,
    start: &[f64],
    within: &Within<'_>,
    steps: usize,
    work: &mut Work,
) -> Landing {
    let mut z = start.to_vec();
    let mut damping = 1e-3;
    let mut idle = 0;
    level.evaluate(&z, work);
    let mut size = length(&work.values);
    let mut trial_work = Work::default();
    for _ in 0..steps {
        // Values of a few roundings, relative to the parts they are the sum of, cannot be improved.
        let ended = size <= 4.0 * f64::EPSILON || idle >= 6 || damping > 1e12;
        if ended || interruption::asked() {
            break;
        }
        let mut move_by = step(work, &z, within, damping);
        let reach = length(&move_by);
        if reach > 0.5 {
            move_by.iter_mut().for_each(|x| *x *= 0.5 / reach);
        }
        let mut trial = plus(&z, 1.0, &move_by);
        if matches!(within, Within::Sphere) {
            trial = unit(trial);
        }
        level.evaluate(&trial, &mut trial_work);
        let trial_size = length(&trial_work.values);
        if trial_size < size {
            idle = if trial_size > 0.9 * size { idle + 1 } else { 0 };
            damping = (damping * 0.1).max(1e-15);
            z = trial;
            size = trial_size;
            std::mem::swap(work, &mut trial_work);
        } else {
            damping *= 8.0;
            if reach < 1e-15 {
                break;
            }
            // Near the noise a refused step says that the bottom is reached.
            if level.above_noise(&work.values) <= 0.1 {
                break;
            }
        }
    }
    Landing {
        above_noise: level.above_noise(&work.values),
        above_truncation: level.above_truncation(&work.values),
        size,
        z,
    }
}

/// The shortest step that solves the linearised equations, these taken to have the given rank: what is left of the
/// smaller singular values is noise, or the terms cut off. With the smallest singular value used.
fn step_of_rank(work: &Work, z: &[f64], rank: usize) -> (Vec<f64>, f64) {
    let rows: Vec<Vec<f64>> = work
        .jacobian
        .iter()
        .map(|row| plus(row, -dot(row, z), z))
        .collect();
    let (values, vectors) = singular(&rows, z.len());
    let mut sum = vec![0.0; z.len()];
    for (value, direction) in values.iter().zip(&vectors).take(rank) {
        if *value > 0.0 {
            let image: f64 = rows
                .iter()
                .zip(&work.values)
                .map(|(row, v)| dot(row, direction) * v)
                .sum();
            sum = plus(&sum, -image / (value * value), direction);
        }
    }
    (sum, if rank > 0 { values[rank - 1] } else { 1.0 })
}

/// Gauss–Newton without damping on a set of dimension δ − rank, accepted only where it contracts at once and the first
/// correction is at most `trust` times the smallest singular value. `None` otherwise.
///
/// Where another sheet passes at a distance d, the smallest singular value is about d (second derivatives are at most
/// of size 1 after scaling): a start that is off by more than d reaches the trusted neighbourhood of the wrong
/// sheet only by chance, and one that is off by less is corrected to the right one.
pub(super) fn contract(
    level: &Level<'_>,
    start: &[f64],
    rank: usize,
    trust: f64,
    work: &mut Work,
) -> Option<Landing> {
    let mut z = start.to_vec();
    let mut last = f64::INFINITY;
    let mut first = 0.0;
    for iteration in 0..10 {
        level.evaluate(&z, work);
        let (correction, smallest) = step_of_rank(work, &z, rank);
        let reach = length(&correction);
        if !reach.is_finite() || reach > 0.3 {
            return None;
        }
        if iteration == 0 {
            if reach > trust * smallest {
                return None;
            }
            first = reach;
        }
        // Far above rounding each correction must be a quarter of the last; near rounding anything goes.
        let floor = 1e-11_f64.max(1e-6 * first);
        if reach > 0.25 * last && last > floor {
            return None;
        }
        z = unit(plus(&z, 1.0, &correction));
        if reach < 1e-14 || (reach >= 0.25 * last && last <= floor) {
            break;
        }
        last = reach;
    }
    level.evaluate(&z, work);
    Some(Landing {
        above_noise: level.above_noise(&work.values),
        above_truncation: level.above_truncation(&work.values),
        size: length(&work.values),
        z,
    })
}
