//! The real zero set near one of its points away from the origin: its dimension and tangent space.

use super::correct::{Landing, Within, land};
use super::search::random_direction;
use super::small::{distance, dot, orthonormal, plus, singular, unit};
use super::system::{Level, Work};
use kutzbach_math::matrix::SplitMix64;

/// What the zero set looks like near a point.
#[derive(Clone, Debug)]
pub(super) struct Local {
    /// Real dimension there.
    pub(super) dimension: usize,
    /// Orthonormal basis of the tangent space, in coordinates of the germ; for a set that is not reduced only as accurate
    /// as a secant.
    pub(super) tangent: Vec<Vec<f64>>,
    /// Whether the Jacobian has rank δ − dimension.
    pub(super) reduced: bool,
    /// Rank of the Jacobian.
    pub(super) rank: usize,
    /// Smallest singular value that counts, over the largest possible.
    pub(super) smallest: f64,
}

/// How far, in units of the radius, the zero set is probed; the second where it is too curved for the first.
const PROBES: [f64; 2] = [0.03, 0.003];

/// Random spaces tried for each dimension below that of the kernel.
const SPACES: usize = 4;

/// Singular values up to this are zero: a double zero is known to the root of the accuracy of the values, and there the
/// derivative is as large as that error.
pub(super) fn rank_threshold(level: &Level<'_>, size: f64) -> f64 {
    3.0 * level.tolerance().max(size).sqrt()
}

/// Largest d such that d coordinates can be prescribed at random near the point and the equations still solved.
///
/// The kernel of the Jacobian bounds d. One coordinate, the radius, is known to be free. Each larger d is tried with
/// random offsets; a set of smaller dimension misses the prescribed values for all but a null set of choices.
pub(super) fn local(
    level: &Level<'_>,
    point: &Landing,
    random: &mut SplitMix64,
    work: &mut Work,
) -> Local {
    let variables = point.z.len();
    level.evaluate(&point.z, work);
    let (values, vectors) = singular(&work.jacobian, variables);
    let threshold = rank_threshold(level, point.size);
    let rank = values.iter().filter(|v| **v > threshold).count();
    let kernel = &vectors[rank..];
    let smallest = if rank > 0 { values[rank - 1] } else { 1.0 };
    // A random space may happen to be nearly parallel to the set: several are tried.
    let tries = (2..kernel.len()).rev().flat_map(|d| [d; SPACES]);
    for dimension in std::iter::once(kernel.len()).chain(tries) {
        let whole = dimension == kernel.len();
        if whole && dimension < 2 {
            break;
        }
        let directions = if whole {
            kernel.to_vec()
        } else {
            random_subspace(kernel, dimension, random)
        };
        let accuracy = level.tolerance().max(point.size);
        // A double zero is missed by the square of the offset, which has to be seen.
        let reaches = PROBES
            .into_iter()
            .filter(|reach| reach * reach > 1e3 * accuracy);
        let probed = reaches.into_iter().find(|reach| {
            (0..dimension + 2).all(|_| {
                let offset: Vec<f64> = directions
                    .iter()
                    .map(|_| reach * random.symmetric())
                    .collect();
                probe(level, point, &directions, &offset, work).is_some()
            })
        });
        if let Some(reach) = probed {
            let tangent = if whole {
                kernel.to_vec()
            } else {
                secants(level, point, &directions, reach, work)
            };
            return Local {
                dimension,
                tangent,
                reduced: whole,
                rank,
                smallest,
            };
        }
    }
    Local {
        dimension: 1,
        tangent: kernel.to_vec(),
        reduced: kernel.len() <= 1,
        rank,
        smallest,
    }
}

/// A zero near the point at which the Jacobian has a larger rank, if there is one: then the point is a singular one of a
/// branch that is otherwise reduced there, and says nothing about the branch.
pub(super) fn more_regular(
    level: &Level<'_>,
    point: &Landing,
    rank: usize,
    random: &mut SplitMix64,
    work: &mut Work,
) -> Option<Landing> {
    for scale in [0.03, 0.03, 0.03, 0.1, 0.1, 0.1] {
        let by = random_direction(point.z.len(), random);
        let start = unit(plus(&point.z, scale, &by));
        let landed = land(level, &start, &Within::Sphere, 80, work);
        if landed.above_truncation > 1.0 || distance(&landed.z, &point.z) > 4.0 * scale {
            continue;
        }
        level.evaluate(&landed.z, work);
        let (values, _) = singular(&work.jacobian, point.z.len());
        let threshold = rank_threshold(level, landed.size.max(point.size));
        // Ten times the threshold: a multiple zero that was reached a little less well is not more regular.
        if values.iter().filter(|v| **v > 10.0 * threshold).count() > rank {
            return Some(landed);
        }
    }
    None
}

/// The zero near `point` whose coordinates along `directions` differ from it by `offset`.
fn probe(
    level: &Level<'_>,
    point: &Landing,
    directions: &[Vec<f64>],
    offset: &[f64],
    work: &mut Work,
) -> Option<Vec<f64>> {
    let mut start = point.z.clone();
    for (direction, by) in directions.iter().zip(offset) {
        start = plus(&start, *by, direction);
    }
    let landed = land(level, &start, &Within::Slice(directions), 60, work);
    let zero = landed.above_noise <= 1.0 || landed.size <= 5.0 * point.size;
    (zero && distance(&landed.z, &start) <= 0.2).then_some(landed.z)
}

fn secants(
    level: &Level<'_>,
    point: &Landing,
    directions: &[Vec<f64>],
    reach: f64,
    work: &mut Work,
) -> Vec<Vec<f64>> {
    let mut tangent = Vec::new();
    for i in 0..directions.len() {
        let mut ends = Vec::new();
        for sign in [1.0, -1.0] {
            let mut offset = vec![0.0; directions.len()];
            offset[i] = 0.3 * sign * reach;
            ends.extend(probe(level, point, directions, &offset, work));
        }
        tangent.push(match &ends[..] {
            [plus_end, minus_end] => plus(plus_end, -1.0, minus_end),
            _ => directions[i].clone(),
        });
    }
    orthonormal(&tangent)
}

fn random_subspace(space: &[Vec<f64>], dimension: usize, random: &mut SplitMix64) -> Vec<Vec<f64>> {
    let vectors: Vec<Vec<f64>> = (0..dimension)
        .map(|_| {
            let mut sum = vec![0.0; space[0].len()];
            for direction in space {
                sum = plus(&sum, random.symmetric(), direction);
            }
            sum
        })
        .collect();
    orthonormal(&vectors)
}

/// Cosine of the angle between a vector and a space given by orthonormal vectors.
pub(super) fn within(space: &[Vec<f64>], vector: &[f64]) -> f64 {
    let inside: f64 = space.iter().map(|d| dot(d, vector).powi(2)).sum();
    (inside / dot(vector, vector)).sqrt()
}
