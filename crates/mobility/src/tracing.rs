//! Walking along a branch to generic poses of its own.
//!
//! What a branch allows is asked where nothing is special: a quarter radian and more away from the pose, in random
//! directions of the branch that go on and not back, three times. At each pose the cycles are closed, as far as rounding and
//! stated precision tell, and the kernel is taken anew.

use super::chart::{Kernel, SEED};
use super::pose_rank::{PartRank, Pose};
use kutzbach_closure::{
    CycleJacobian, JointState, Metric, Part, Section, entry_accuracy, jacobian,
};
use kutzbach_math::matrix::{MatrixError, Real, SplitMix64, decide, null_vectors};

/// A generic pose of a branch of one part.
#[derive(Clone, Debug)]
pub struct PartPose {
    /// States of the part's joints, in the part's order.
    pub states: Vec<JointState<f64>>,
    /// Basis of the branch's tangents: one rate per unknown of the part, in rad or m.
    pub tangents: Vec<Vec<f64>>,
    /// Instantaneous freedom here; `None` where the margin does not tell.
    pub instantaneous: Option<usize>,
    /// Unknowns less equations: what would be free if no equation were redundant.
    pub surplus: i64,
}

/// Where the walk stands: a tangent space and where it goes.
pub struct Tangents {
    /// Orthonormal in the metric.
    pub basis: Vec<Vec<f64>>,
    /// Instantaneous freedom.
    pub instantaneous: Option<usize>,
}

/// Poses to visit, and the length of a step between them in the metric: close to radians for hinges.
pub(super) const POSES: usize = 3;
const STEP: f64 = 0.25;

/// Closer than this (metric) to a pose where branches meet, a pose is not generic; so many short steps lead away.
pub(super) const FAR: f64 = 0.3;
pub(super) const APPROACHES: usize = 20;

/// Steps are halved so often where the cycles do not close.
const HALVINGS: usize = 8;

/// The kernel has at most this many vectors where a walk wants to know them all.
pub(super) const KERNEL_LIMIT: usize = 64;

/// A part with more unknowns is not walked along: its pose stands for a generic one.
pub(super) const WALKED_UNKNOWNS: usize = 3000;

/// Tangents in rad and m, from directions in the metric.
pub(super) fn natural(metric: &Metric, direction: &[f64]) -> Vec<f64> {
    direction
        .iter()
        .zip(&metric.weights)
        .map(|(z, weight)| z / weight)
        .collect()
}

/// Gram–Schmidt, twice for accuracy; vectors that depend on the ones before are left out.
pub(super) fn orthonormal(vectors: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut vector in vectors {
        let before = 0.0.norm(&vector);
        for _ in 0..2 {
            for other in &basis {
                let along: f64 = other.iter().zip(&vector).map(|(a, b)| a * b).sum();
                vector
                    .iter_mut()
                    .zip(other)
                    .for_each(|(x, o)| *x -= along * o);
            }
        }
        let length = 0.0.norm(&vector);
        if length > 1e-8 * before {
            vector.iter_mut().for_each(|x| *x /= length);
            basis.push(vector);
        }
    }
    basis
}

/// The kernel of the equations at some pose of the part, in the metric. `expected` is the freedom taken where the margin
/// of the rank is thin.
pub fn tangents_at(
    section: &Section<'_, f64>,
    states: &[JointState<f64>],
    stated: f64,
    expected: usize,
) -> Result<Option<(Tangents, CycleJacobian<f64>)>, MatrixError> {
    let here = jacobian(section.mechanism, section.geometry, states, section.part)?;
    let (_, rounding) = entry_accuracy(&here);
    let left = 0.0.norm(&here.residual);
    let mut matrix = here.matrix.clone();
    let scales = matrix.scale_columns();
    let decision = decide(&matrix, stated + rounding + left)?;
    let instantaneous = decision.nullity();
    let taken = match instantaneous {
        Some(freedom) => freedom,
        None if expected <= matrix.columns() => expected,
        None => return Ok(None),
    };
    if taken > KERNEL_LIMIT {
        return Ok(None);
    }
    let assumed = decision.assuming(matrix.columns() - taken);
    let Ok(null) = null_vectors(&matrix, &assumed, KERNEL_LIMIT, SEED) else {
        return Ok(None);
    };
    let there = Metric::of(section.mechanism, &here, &scales);
    let vectors = null
        .vectors
        .iter()
        .map(|vector| {
            natural(&there, vector)
                .iter()
                .zip(&section.metric.weights)
                .map(|(q, weight)| q * weight)
                .collect()
        })
        .collect();
    let tangents = Tangents {
        basis: orthonormal(vectors),
        instantaneous,
    };
    Ok(Some((tangents, here)))
}

/// A random unit direction in the span of an orthonormal basis, leaning on the one gone before.
fn onward(random: &mut SplitMix64, basis: &[Vec<f64>], before: Option<&[f64]>) -> Option<Vec<f64>> {
    let mut direction = vec![0.0; basis.first()?.len()];
    for vector in basis {
        let along = before.map_or(0.0, |b| {
            vector.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()
        });
        let weight = 2.0 * along + random.symmetric();
        direction
            .iter_mut()
            .zip(vector)
            .for_each(|(d, x)| *d += weight * x);
    }
    let mut length = 0.0.norm(&direction);
    if let Some(before) = before {
        // Straight on, not back, regardless of the random draw.
        let along: f64 = direction.iter().zip(before).map(|(a, b)| a * b).sum();
        if along < 0.0 {
            length = -length;
        }
    }
    (length != 0.0).then(|| direction.iter().map(|x| x / length).collect())
}

/// Walks along a branch from a pose where its tangent space is known, moving the states, to as many generic poses as are `wanted`. Fewer, or
/// none, where the cycles do not close on the way. The first step leans on `toward`, a unit vector in the metric.
///
/// `away` is how far a pose is where other branches pass, in the metric. Branches that touch there part by a power of the
/// distance only, so that a step is at most half as long; infinite where there are none.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn walk(
    section: &Section<'_, f64>,
    states: &mut [JointState<f64>],
    tangents: Vec<Vec<f64>>,
    toward: Option<Vec<f64>>,
    stated: f64,
    wanted: usize,
    mut away: f64,
) -> Result<Vec<PartPose>, MatrixError> {
    let dimension = tangents.len();
    let mut random = SplitMix64::new(SEED + 1);
    let mut basis = tangents;
    let mut before = toward;
    let mut poses = Vec::new();
    let keep = |states: &[JointState<f64>]| -> Vec<JointState<f64>> {
        section
            .part
            .joints
            .iter()
            .map(|&j| states[j].clone())
            .collect()
    };
    // Short steps lead to no generic pose yet.
    let mut attempts = 2 * wanted + if away < FAR { APPROACHES } else { 0 };
    while poses.len() < wanted && attempts > 0 {
        attempts -= 1;
        let Some(direction) = onward(&mut random, &basis, before.as_deref()) else {
            break;
        };
        let from = keep(states);
        let mut size = STEP.min(0.5 * away);
        let mut reached = false;
        for _ in 0..HALVINGS {
            let z: Vec<f64> = direction.iter().map(|x| x * size).collect();
            section.advance_by(states, &z);
            let closing = section.close(states, &basis, 30)?;
            if closing.residual <= 4.0 * closing.rounding + stated && closing.way <= 0.7 * size {
                reached = true;
                break;
            }
            for (&joint, state) in section.part.joints.iter().zip(&from) {
                states[joint] = state.clone();
            }
            size *= 0.5;
        }
        if !reached {
            break;
        }
        let Some((there, here)) = tangents_at(section, states, stated, dimension)? else {
            break;
        };
        before = Some(direction);
        away += size;
        if there.basis.len() != dimension {
            // A special pose on the way: the old directions serve to leave it again.
            continue;
        }
        basis = there.basis;
        if away < FAR {
            continue;
        }
        poses.push(PartPose {
            states: keep(states),
            tangents: basis.iter().map(|b| natural(section.metric, b)).collect(),
            instantaneous: there.instantaneous,
            surplus: here.matrix.columns() as i64 - here.matrix.rows() as i64,
        });
    }
    Ok(poses)
}

/// The generic poses of the one branch through a regular pose.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn poses_of_regular_part(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
) -> Result<Vec<PartPose>, MatrixError> {
    let section = Section {
        mechanism: pose.mechanism,
        geometry: pose.geometry,
        part,
        metric: &kernel.metric,
    };
    let mut poses = Vec::new();
    if rank.unknowns() <= WALKED_UNKNOWNS && kernel.basis.complete {
        let tangents = kernel.basis.vectors.clone();
        poses = pose.try_on(part, |states| {
            let stated = rank.open_by_digits();
            walk(
                &section,
                states,
                tangents,
                None,
                stated,
                POSES,
                f64::INFINITY,
            )
        })?;
    }
    if poses.is_empty() {
        poses.push(PartPose {
            states: part
                .joints
                .iter()
                .map(|&j| pose.states[j].clone())
                .collect(),
            tangents: kernel
                .basis
                .vectors
                .iter()
                .map(|v| natural(&kernel.metric, v))
                .collect(),
            instantaneous: rank.instantaneous,
            surplus: rank.unknowns() as i64 - rank.equations() as i64,
        });
    }
    Ok(poses)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
