//! The tangent space of a branch at one of its poses, and how far its numbers can be trusted.
//!
//! What moves along a branch is read off the tangents of a few of its poses: a component that is zero at all of them is a
//! freedom that rests. None of the zeros is exact, so each reading needs to know how far a tangent can be from the true
//! one ([`Limits`]).
//!
//! # The error of a tangent
//! At a pose where the closure equations of a part are known to within ε (their rounding, what the file's precision
//! leaves open, what is left of their residual, and what is left of the equations for the tangents given), a null vector
//! of their Jacobian is off by ε/σ with σ its smallest kept singular value (Wedin 1972), all relative to the largest.
//! That needs the tangents to *be* its null space. Where it is larger, as along a permanently shaky branch, the equations
//! have a double zero: a residual of ε leaves the pose itself uncertain by √ε, its screws too, and a tangent by √ε/σ, where
//! singular values up to √ε count as zero.
//!
//! Cost: one rank decision for every part and, for `d` tangents with `n` components each, `n d²` operations.

use super::branch::BranchPose;
use super::one_sided::{dot, norm};
use super::pose_rank::known_to;
use kutzbach_closure::Structure;
use kutzbach_closure::{Geometry, Part, jacobian};
use kutzbach_math::matrix::{MatrixError, Real, SparseMatrix, decide};
use kutzbach_model::mechanism::{FreedomPart, Mechanism};

/// What counts as rest and what as motion among numbers that come from unit tangents.
///
/// Up to ten times the error a magnitude is zero, from a thousand times the error on it is not, and between it is
/// doubtful: the rule of [`kutzbach_math::matrix::coloops`]. Components of a unit vector of length n are of the order of a share,
/// 1/√n. However coarse the numbers, three ten-thousandths of a share are not called zero: lead screws and gears move joints by
/// a thousandth of others. Whatever exceeds both a hundredth of a share and three errors is called motion. An error beyond a third of a share leaves only exact zeros.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Bound on the error of a unit vector.
    pub error: f64,
    rest: f64,
    moves: f64,
}

impl Limits {
    pub fn new(error: f64, length: usize) -> Self {
        let share = 1.0 / (length.max(1) as f64).sqrt();
        // Written so that an error that is not a number is hopeless.
        if !(error <= share / 3.0) {
            return Self {
                error,
                rest: 0.0,
                moves: f64::INFINITY,
            };
        }
        Self {
            error,
            rest: (10.0 * error).min(3e-4 * share),
            moves: (1e3 * error).min((1e-2 * share).max(3.0 * error)),
        }
    }

    /// Whether a magnitude is motion (`Some(true)`), rest (`Some(false)`), or neither for certain.
    pub fn moves(&self, magnitude: f64) -> Option<bool> {
        if magnitude <= self.rest {
            Some(false)
        } else if magnitude >= self.moves {
            Some(true)
        } else {
            None
        }
    }

    /// How many singular values are not zero; `None` where one is doubtful.
    pub fn rank(&self, values: &[f64]) -> Option<usize> {
        values
            .iter()
            .map(|value| self.moves(*value).map(usize::from))
            .sum()
    }
}

/// An orthonormal basis of the tangent space, rotations in radians and translations in lengths of their part.
#[derive(Clone, Debug)]
pub(super) struct TangentSpace {
    /// The basis, one component per variable of the mechanism.
    pub basis: Vec<Vec<f64>>,
    /// Limits for what comes from all components together.
    pub limits: Limits,
    /// First variable of every joint, and the number of all.
    first: Vec<usize>,
    /// Radians or metres per unit of every variable.
    units: Vec<f64>,
    joint_limits: Vec<Limits>,
}

impl TangentSpace {
    /// `None` where numbers leave their range or the pose belongs to another mechanism.
    ///
    /// Joints in no loop and no coupling move on every branch: where the tangents leave such a freedom out it is added.
    pub fn at(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        structure: &Structure,
        pose: &BranchPose,
    ) -> Option<Self> {
        let mut first = Vec::with_capacity(mechanism.joints().len() + 1);
        let mut count = 0;
        for joint in mechanism.joints() {
            first.push(count);
            count += joint.freedom();
        }
        first.push(count);
        if pose.tangents.iter().any(|tangent| tangent.len() != count) {
            return None;
        }
        let mut units = vec![1.0; count];
        let mut equations = Vec::with_capacity(structure.parts.len());
        for part in &structure.parts {
            let found = PartEquations::at(mechanism, geometry, pose, part).ok()?;
            set_units(mechanism, &part.joints, found.length, &first, &mut units);
            equations.push(found);
        }
        // Nothing measures a free slider: the whole mechanism's size does as well as any length.
        let size = if geometry.size > geometry.least_length() {
            geometry.size
        } else {
            1.0
        };
        set_units(mechanism, &structure.free_joints, size, &first, &mut units);
        let mut vectors: Vec<Vec<f64>> = pose
            .tangents
            .iter()
            .map(|tangent| {
                tangent
                    .iter()
                    .zip(&units)
                    .map(|(x, unit)| x / unit)
                    .collect()
            })
            .collect();
        for &joint in &structure.free_joints {
            for variable in first[joint]..first[joint + 1] {
                if vectors.iter().all(|vector| vector[variable] == 0.0) {
                    let mut alone = vec![0.0; count];
                    alone[variable] = 1.0;
                    vectors.push(alone);
                }
            }
        }
        let basis = orthonormalised(vectors)?;
        let free: usize = structure
            .free_joints
            .iter()
            .map(|&joint| first[joint + 1] - first[joint])
            .sum();
        let freedom = |kernel: fn(&PartEquations) -> &Kernel| {
            equations
                .iter()
                .map(|part| kernel(part).nullity)
                .sum::<Option<usize>>()
                .map(|sum| sum + free)
        };
        let whole_kernel = freedom(|part| &part.simple) == Some(basis.len())
            && freedom(|part| &part.multiple).is_none_or(|freedom| freedom == basis.len());
        let own = |length| Limits::new(8.0 * f64::EPSILON, length);
        let mut joint_limits = vec![own(1); mechanism.joints().len()];
        let mut worst: f64 = 8.0 * f64::EPSILON;
        for (part, equations) in structure.parts.iter().zip(&equations) {
            let error = equations.tangent_error(&part.joints, &first, &basis, whole_kernel)?;
            worst = worst.max(error);
            let variables = part.joints.iter().map(|&j| first[j + 1] - first[j]).sum();
            for &joint in &part.joints {
                joint_limits[joint] = Limits::new(error, variables);
            }
        }
        Some(Self {
            basis,
            limits: Limits::new(worst, count),
            first,
            units,
            joint_limits,
        })
    }

    /// The variables of a joint.
    pub fn variables(&self, joint: usize) -> std::ops::Range<usize> {
        self.first[joint]..self.first[joint + 1]
    }

    /// Limits for the components of a joint.
    pub fn limits_of(&self, joint: usize) -> Limits {
        self.joint_limits[joint]
    }

    /// Rate of a variable (rad or m) along a basis vector.
    pub fn rate(&self, vector: usize, variable: usize) -> f64 {
        self.basis[vector][variable] * self.units[variable]
    }

    /// How much a variable moves in all of the tangent space: the length of its row in the basis, whichever basis it is.
    pub fn magnitude(&self, variable: usize) -> f64 {
        let row: Vec<f64> = self.basis.iter().map(|vector| vector[variable]).collect();
        norm(&row)
    }
}

fn set_units(
    mechanism: &Mechanism,
    joints: &[usize],
    length: f64,
    first: &[usize],
    units: &mut [f64],
) {
    for &joint in joints {
        let freedoms = mechanism.joints()[joint].kind.freedoms();
        for (unit, part) in units[first[joint]..].iter_mut().zip(freedoms) {
            if *part == FreedomPart::Translation {
                *unit = length;
            }
        }
    }
}

/// The closure equations of a part at a pose, as far as they tell how good a tangent is.
struct PartEquations {
    length: f64,
    /// What the equations are uncertain by.
    uncertainty: f64,
    /// The kernel if the equations have a simple zero here, and if they have a double one.
    simple: Kernel,
    multiple: Kernel,
    matrix: SparseMatrix<f64>,
}

/// What a rank decision says of the kernel.
struct Kernel {
    /// Smallest kept singular value, relative to the largest.
    kept: f64,
    nullity: Option<usize>,
}

impl Kernel {
    fn within(matrix: &SparseMatrix<f64>, uncertainty: f64) -> Result<Self, MatrixError> {
        let decision = decide(matrix, uncertainty)?;
        Ok(Self {
            kept: if decision.kept > 0.0 {
                decision.kept.min(1.0)
            } else {
                1.0
            },
            nullity: decision.nullity(),
        })
    }
}

impl PartEquations {
    fn at(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        pose: &BranchPose,
        part: &Part,
    ) -> Result<Self, MatrixError> {
        let here = jacobian(mechanism, geometry, &pose.states, part)?;
        let (stated, rounding, coarse) = known_to(mechanism, &here);
        let residual = 0.0.norm(&here.residual);
        let uncertainty = rounding + residual + if coarse { 0.0 } else { stated };
        let mut scaled = here.matrix.clone();
        scaled.scale_columns();
        Ok(Self {
            length: here.length,
            uncertainty,
            simple: Kernel::within(&scaled, uncertainty)?,
            multiple: Kernel::within(&scaled, uncertainty.sqrt())?,
            matrix: here.matrix,
        })
    }

    /// The error of unit tangents in the components of this part.
    fn tangent_error(
        &self,
        joints: &[usize],
        first: &[usize],
        basis: &[Vec<f64>],
        whole_kernel: bool,
    ) -> Option<f64> {
        let mut left: f64 = 0.0;
        for vector in basis {
            let own: Vec<f64> = joints
                .iter()
                .flat_map(|&joint| &vector[first[joint]..first[joint + 1]])
                .copied()
                .collect();
            left = left.max(norm(&self.matrix.multiply(&own).ok()?));
        }
        let uncertainty = self.uncertainty + left;
        Some(if whole_kernel {
            uncertainty / self.simple.kept
        } else {
            uncertainty.sqrt() / self.multiple.kept
        })
    }
}

/// Gram–Schmidt, each vector twice (Giraud, Langou & Rozložník 2005); what is left of a dependent vector is dropped.
/// `None` where numbers are not finite.
fn orthonormalised(vectors: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(vectors.len());
    for mut vector in vectors {
        let largest = vector.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        if !vector.iter().all(|x| x.is_finite()) {
            return None;
        }
        if largest == 0.0 {
            continue;
        }
        vector.iter_mut().for_each(|x| *x /= largest);
        let before = norm(&vector);
        for _ in 0..2 {
            for done in &basis {
                let along = dot(done, &vector);
                if along != 0.0 {
                    vector
                        .iter_mut()
                        .zip(done)
                        .for_each(|(x, y)| *x -= along * y);
                }
            }
        }
        let left = norm(&vector);
        // Half of the digits have to survive for the rest to be a direction.
        if left > 1e-8 * before {
            vector.iter_mut().for_each(|x| *x /= left);
            basis.push(vector);
        }
    }
    Some(basis)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn limits_leave_a_gap_between_rest_and_motion() {
        for length in [1, 10, 1000] {
            for exponent in -16..2 {
                let limits = Limits::new(10f64.powi(exponent), length);
                assert!(3.0 * limits.rest <= limits.moves, "{limits:?}");
                assert!(limits.moves >= 3.0 * limits.error, "{limits:?}");
                assert_eq!(limits.moves(0.0), Some(false));
            }
        }
        let fine = Limits::new(1e-13, 4);
        assert_eq!(fine.rank(&[0.7, 1e-3, 1e-14]), Some(2));
        assert_eq!(fine.rank(&[0.7, 1e-11]), None);
        // Coarse numbers: a component of some per cent of a share may be rounding and may be not.
        let coarse = Limits::new(3e-3, 100);
        assert_eq!(coarse.moves(0.02), Some(true));
        assert_eq!(coarse.moves(0.004), None);
        assert_eq!(coarse.moves(1e-5), Some(false));
        assert_eq!(Limits::new(0.1, 100).moves(0.9), None);
        assert_eq!(Limits::new(f64::NAN, 100).moves(0.9), None);
    }

    #[test]
    fn bases_are_orthonormal_and_dependent_vectors_dropped() {
        let basis = orthonormalised(vec![
            vec![1e200, 1e200, 0.0],
            vec![0.0, 0.0, 0.0],
            vec![2.0, 2.0, 0.0],
            vec![1.0, 0.0, 1e-3],
        ])
        .unwrap();
        assert_eq!(basis.len(), 2);
        assert!(dot(&basis[0], &basis[1]).abs() < 1e-15);
        assert!((norm(&basis[1]) - 1.0).abs() < 1e-15);
        assert!(orthonormalised(vec![vec![f64::INFINITY, 1.0]]).is_none());
    }
}
