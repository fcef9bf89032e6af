//! Poses that are nearly singular, and those where a joint stands at a dead centre.
//!
//! # What nearly singular means
//! The smallest kept singular value σ of a part's equations, relative to the largest, says how much a joint's error, play or force
//! is magnified: by 1/σ. It is small in two ways: because the pose is close to one of less rank, or because the mechanism is
//! long, whatever its pose. Only the first is worth a word, and it is told from the second by moving: a singular value
//! that vanishes at some pose grows with the distance from it. So a pose is called nearly singular where σ is below
//! [`SMALL`], or below [`NEVER_SMALL`] and within two decades of the rank's tolerance, and ten times as large, or more, at a
//! pose of the same branch not far away. Where it stays small, only a σ close to its tolerance is mentioned, as one that no pose nearby makes clearer.
//!
//! Cost: nothing for clear poses; else up to ten closings and ranks of the part. Closing is iterative, and takes as many rounds as
//! a long part has unknowns: of parts with more than [`FOLLOWED_UNKNOWNS`], where length alone makes a singular value small,
//! no other pose is looked at.

use super::branch::{Branch, BranchPose, Tangent};
use super::pose_rank::PartRank;
use super::roles::NULL_VECTORS;
use super::tangent_space::TangentSpace;
use kutzbach_closure::Structure;
use kutzbach_closure::{Geometry, JointState, Part, entry_accuracy, follow, jacobian};
use kutzbach_math::matrix::{MatrixError, Real, SplitMix64, decide};
use kutzbach_model::mechanism::Mechanism;

/// A thousandfold magnification: a hundredth of a millimetre of play in a joint is a centimetre somewhere.
const SMALL: f64 = 1e-3;

/// Two decades.
const NEAR_TOLERANCE: f64 = 100.0;

/// More than this share of the largest is nothing to warn of, however coarse the numbers are: where it is near the tolerance,
/// the margin of the rank says so.
const NEVER_SMALL: f64 = 0.1;

/// A regular pose is clearer by a decade.
const CLEARER: f64 = 10.0;

/// How far to look, in radians or part lengths of the fastest joint: 0.1° to 10°.
const WAYS: [f64; 5] = [0.00175, 0.0087, 0.035, 0.087, 0.175];

/// Parts of more unknowns are not followed to other poses.
const FOLLOWED_UNKNOWNS: usize = 600;

/// A part whose pose is nearly singular.
#[derive(Clone, Debug, PartialEq)]
pub struct NearSingular {
    /// Index of the part in [`Structure::parts`].
    pub part: usize,
    /// Smallest singular value kept, relative to the largest.
    pub kept: f64,
    /// What counts as zero.
    pub tolerance: f64,
    /// Whether other poses were looked at: those of very large parts are not.
    pub followed: bool,
    /// A clearer pose, if one was found.
    pub nearest: Option<ClearerPose>,
}

/// A pose nearby where the rank is clear.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearerPose {
    /// Index of the joint that moves most on the way there.
    pub joint: usize,
    /// Its variable.
    pub variable: usize,
    /// How far it moves (rad or m).
    pub way: f64,
    /// Smallest singular value kept there, relative to the largest.
    pub kept: f64,
}

/// The parts whose pose is nearly singular.
///
/// # Errors
/// [`MatrixError`] where numbers leave their range.
pub(super) fn near_singular(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    states: &[JointState<f64>],
    ranks: &[PartRank],
) -> Result<Vec<NearSingular>, MatrixError> {
    let mut found = Vec::new();
    let mut trial = states.to_vec();
    for (index, (part, rank)) in structure.parts.iter().zip(ranks).enumerate() {
        let (kept, tolerance) = (rank.decision.kept, rank.decision.tolerance);
        let close = kept < NEVER_SMALL && kept < NEAR_TOLERANCE * tolerance;
        if rank.instantaneous.is_none() || !(kept > 0.0) || !(kept < SMALL || close) {
            continue;
        }
        let followed = rank.unknowns() <= FOLLOWED_UNKNOWNS;
        let nearest = if followed {
            clearer(mechanism, geometry, &mut trial, part, rank)?
        } else {
            None
        };
        if nearest.is_some() || close {
            found.push(NearSingular {
                part: index,
                kept,
                tolerance,
                followed,
                nearest,
            });
        }
    }
    Ok(found)
}

/// The nearest pose met on a random way along the kernel, there and back, that is clearer by a decade.
fn clearer(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    rank: &PartRank,
) -> Result<Option<ClearerPose>, MatrixError> {
    if rank.instantaneous <= Some(0) {
        return Ok(None);
    }
    let Ok(Some(null)) = rank.null_vectors(NULL_VECTORS, 1) else {
        return Ok(None);
    };
    let mut random = SplitMix64::new(7);
    let mut direction = vec![0.0; rank.matrix.columns()];
    for vector in &null.vectors {
        let weight = random.symmetric();
        for ((d, x), scale) in direction.iter_mut().zip(vector).zip(&rank.column_scales) {
            *d += if *scale > 0.0 {
                weight * x / scale
            } else {
                0.0
            };
        }
    }
    let fastest = (0..direction.len()).max_by(|&a, &b| {
        let (one, other): (f64, f64) = (direction[a], direction[b]);
        one.abs().total_cmp(&other.abs())
    });
    let Some(fastest) = fastest.filter(|&f| direction[f] != 0.0 && direction[f].is_finite()) else {
        return Ok(None);
    };
    let largest = direction[fastest];
    for size in WAYS {
        for sign in [1.0, -1.0] {
            let way: Vec<f64> = direction
                .iter()
                .map(|d| sign * size * d / largest)
                .collect();
            let kept = follow(mechanism, geometry, states, part, &way, |there| {
                let moved = jacobian(mechanism, geometry, there, part)?;
                let (_, rounding) = entry_accuracy(&moved);
                let left = 0.0.norm(&moved.residual);
                let mut matrix = moved.matrix;
                matrix.scale_columns();
                let decision = decide(&matrix, rank.open_by_digits() + rounding + left)?;
                let same = decision.nullity().is_some() && decision.nullity() == rank.instantaneous;
                Ok(same.then_some(decision.kept))
            })?;
            if let Some(kept) = kept
                .flatten()
                .filter(|&k| k >= CLEARER * rank.decision.kept)
            {
                let (joint, variable) = rank.jacobian.variables[fastest];
                return Ok(Some(ClearerPose {
                    joint,
                    variable,
                    way: sign * size * rank.jacobian.unit(mechanism, fastest),
                    kept,
                }));
            }
        }
    }
    Ok(None)
}

/// The pose itself as one of the branch, if it is regular: its tangents are then those of the kernel. `None` where they are too
/// many for a basis, or their dimension is not the branch's.
#[must_use]
pub fn pose_of_branch(
    mechanism: &Mechanism,
    structure: &Structure,
    states: &[JointState<f64>],
    ranks: &[PartRank],
    branch: &Branch,
) -> Option<BranchPose> {
    let first = mechanism.variable_offsets();
    let count = mechanism.freedom();
    let mut tangents = Vec::new();
    for rank in ranks {
        let decision = rank.settled()?;
        if decision.nullity() == Some(0) {
            continue;
        }
        let null = rank.null_vectors(NULL_VECTORS, 1).ok()??;
        if !null.complete {
            return None;
        }
        for vector in &null.vectors {
            let columns = rank.jacobian.variables.iter().zip(vector).enumerate();
            let rates = columns.map(|(column, (&(joint, variable), x))| {
                let scale = rank.column_scales[column];
                // A column of zeros is a variable that moves nothing else: its own null vector is as long as one likes.
                let scale = if scale > 0.0 { scale } else { 1.0 };
                let rate = x / scale * rank.jacobian.unit(mechanism, column);
                (first[joint] + variable, rate)
            });
            tangents.push(Tangent::new(count, rates));
        }
    }
    for &joint in &structure.free_joints {
        for variable in first[joint]..first[joint + 1] {
            tangents.push(Tangent::new(count, [(variable, 1.0)]));
        }
    }
    let held = branch.dimension.checked_sub(6 * structure.loose_pieces)?;
    (tangents.len() == held).then_some(BranchPose {
        states: states.to_vec(),
        tangents,
    })
}

/// Joints of one freedom that rest at the pose while they move on the branch: dead centres, by joint index.
pub(super) fn dead_centres(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    branch: &Branch,
    here: &BranchPose,
) -> Vec<usize> {
    let Some(tangents) = TangentSpace::at(mechanism, geometry, structure, here) else {
        return Vec::new();
    };
    (0..mechanism.joints().len())
        .filter(|&joint| {
            let moves = branch.roles.get(joint).map(|role| role.locked) == Some(Some(false));
            let limits = tangents.limits_of(joint);
            mechanism.joints()[joint].freedom() == 1
                && moves
                && limits.moves(tangents.magnitude(tangents.variables(joint).start)) == Some(false)
        })
        .collect()
}
