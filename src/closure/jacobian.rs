//! The derivative of the cycle equations: joint screws stacked cycle by cycle.

use super::cycle::{Walk, WalkedCycle};
use super::displacement::JointState;
use super::geometry::Geometry;
use crate::matrix::{MatrixError, Real, SparseMatrix};
use crate::mechanism::{FreedomPart, Joint, Mechanism};

/// A part of a mechanism whose equations stand alone: some joints, the cycles through them, the couplings between them.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Joints, ascending.
    pub joints: Vec<usize>,
    /// Independent cycles.
    pub cycles: Vec<Vec<(usize, bool)>>,
    /// Couplings between these joints.
    pub couplings: Vec<usize>,
}

/// The linearised equations of a part.
///
/// Rows: six per cycle (three angular, three linear about the cycle's centre, in units of the cycle's length), then one
/// per coupling. Columns: the variables of the joints in order; a translation counts in units of [`length`](Self::length).
/// Row operations do not change the kernel, so every cycle may have its own centre and length.
#[derive(Clone, Debug)]
pub struct CycleJacobian<R> {
    /// The matrix, its columns not normalised.
    pub matrix: SparseMatrix<R>,
    /// (joint, index of the variable in the joint) of every column.
    pub variables: Vec<(usize, usize)>,
    /// The residual of every row.
    pub residual: Vec<R>,
    /// The part's length (m): RMS of its cycles' lengths.
    pub length: f64,
    /// The walks the rows come from.
    pub walks: Vec<WalkedCycle<R>>,
}

impl<R: Real> CycleJacobian<R> {
    /// Radians or metres per unit of a column.
    pub fn unit(&self, mechanism: &Mechanism, column: usize) -> f64 {
        let (joint, variable) = self.variables[column];
        variable_unit(&mechanism.joints()[joint], variable, self.length)
    }
}

fn variable_unit(joint: &Joint, variable: usize, length: f64) -> f64 {
    match joint.kind.freedoms()[variable] {
        FreedomPart::Translation => length,
        FreedomPart::Rotation | FreedomPart::Screw => 1.0,
    }
}

/// Builds the linearised equations of a part at given joint states.
///
/// # Errors
/// Only if a cycle names a joint outside the part.
pub fn jacobian<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    part: &Part,
) -> Result<CycleJacobian<R>, MatrixError> {
    let one = &geometry.one;
    let walks: Vec<WalkedCycle<R>> = part
        .cycles
        .iter()
        .map(|cycle: &Vec<(usize, bool)>| WalkedCycle::walk(geometry, states, cycle as &Walk))
        .collect();
    let length = if walks.is_empty() {
        1.0
    } else {
        (walks.iter().map(|w| w.length * w.length).sum::<f64>() / walks.len() as f64).sqrt()
    };
    let mut first_column = std::collections::HashMap::with_capacity(part.joints.len());
    let mut variables = Vec::new();
    for &joint in &part.joints {
        first_column.insert(joint, variables.len());
        variables
            .extend((0..geometry.displacements[joint].freedom()).map(|variable| (joint, variable)));
    }
    let mut triplets = Vec::new();
    let mut residual = Vec::new();
    for (index, walk) in walks.iter().enumerate() {
        for joint in &walk.joints {
            let Some(&first) = first_column.get(&joint.joint) else {
                continue;
            };
            for (variable, screw) in joint.screws.iter().enumerate() {
                let unit = one.constant(variable_unit(
                    &mechanism.joints()[joint.joint],
                    variable,
                    length,
                ));
                let translation = mechanism.joints()[joint.joint].kind.freedoms()[variable]
                    == FreedomPart::Translation;
                for (row, entry) in walk.column(joint, screw).into_iter().enumerate() {
                    let entry = if translation {
                        entry * unit.clone()
                    } else {
                        entry
                    };
                    triplets.push((6 * index + row, first + variable, entry));
                }
            }
        }
        residual.extend(walk.residual());
    }
    let mut block_starts: Vec<usize> = (0..walks.len()).map(|i| 6 * i).collect();
    for &coupling in &part.couplings {
        let row = residual.len();
        block_starts.push(row);
        let (terms, offset) = &geometry.couplings[coupling];
        let weights: Vec<(usize, R, R)> = terms
            .iter()
            .map(|(joint, factor)| {
                let unit = variable_unit(&mechanism.joints()[*joint], 0, length);
                (*joint, factor.clone(), factor.clone() * one.constant(unit))
            })
            .collect();
        // The row is brought to unit length, so that a gear of ratio 1000 weighs as much as one of ratio 1.
        let norm = weights
            .iter()
            .fold(one.zero_like(), |sum, (_, _, w)| {
                sum + w.clone() * w.clone()
            })
            .sqrt();
        let mut value = -offset.clone();
        for (joint, factor, weight) in weights {
            value = value + factor * states[joint].values[0].clone();
            if let Some(&first) = first_column.get(&joint) {
                triplets.push((row, first, weight / norm.clone()));
            }
        }
        residual.push(value / norm);
    }
    let matrix =
        SparseMatrix::from_triplets(residual.len(), variables.len(), one.zero_like(), triplets)?
            .with_row_blocks(block_starts)?;
    Ok(CycleJacobian {
        matrix,
        variables,
        residual,
        length,
        walks,
    })
}

/// How far the entries of a part's Jacobian may be from those of the mechanism meant, relative to unit columns, in the
/// spectral norm: (by the file's stated precision, by rounding in the arithmetic).
///
/// A cycle's entries depend on the frames passed before them. To first order, an uncertainty `u` of a position moves
/// every screw of the cycle by up to `u` (relative: `u / L`), one of a direction or an angle turns every screw by as much
/// and moves it by up to that angle times the cycle's extent, which is of the order of `L`. Rounding errors of different
/// numbers are independent and uniform in ±u: their root sum of squares is 1.7 standard deviations of the total, and twice
/// that is used. A cycle of `n` columns is then off by at most `√n` times as much. Rounding in the arithmetic is bounded
/// the same way, with `u` = unit roundoff times the largest coordinate met, summed, since it is not random.
pub fn entry_accuracy<R: Real>(mechanism: &Mechanism, jacobian: &CycleJacobian<R>) -> (f64, f64) {
    let precision = mechanism.precision();
    let exact = precision.is_exact();
    let mut stated = 0.0f64;
    let mut rounding = 0.0f64;
    let roundoff = jacobian.matrix.zero().unit_roundoff();
    for walk in &jacobian.walks {
        let columns: usize = walk.joints.iter().map(|j| j.screws.len()).sum();
        let spread = (2.0 * columns as f64).sqrt();
        if !exact {
            let square: f64 = walk
                .joints
                .iter()
                .map(|j| squared_uncertainty(mechanism, &mechanism.joints()[j.joint], walk.length))
                .sum();
            stated = stated.max(2.0 * (columns as f64).sqrt() * square.sqrt());
        }
        // Each joint composes three displacements; a dozen roundings of coordinates up to the reach, in units of length.
        let steps = 12.0 * walk.joints.len() as f64;
        rounding = rounding.max(spread * steps * roundoff * (1.0 + walk.reach / walk.length));
    }
    // Couplings: their factors are exact or rounded like any number; one rounding each.
    (stated, rounding.max(4.0 * roundoff))
}

/// Sum of the squared uncertainties that one joint brings into its cycle, in units of the cycle's length (angles in rad).
fn squared_uncertainty(mechanism: &Mechanism, joint: &Joint, length: f64) -> f64 {
    let precision = mechanism.precision();
    let square = |numbers: &[crate::number::Number; 3]| -> f64 {
        numbers
            .iter()
            .map(|n| precision.uncertainty(n).powi(2))
            .sum()
    };
    let mut sum = 0.0;
    for side in [&joint.predecessor, &joint.successor] {
        sum += square(&side.frame.position) / length.powi(2) + square(&side.frame.roll_pitch_yaw);
    }
    for (axis, used) in [
        (&joint.axis, joint.kind.uses_axis()),
        (&joint.axis2, joint.kind.uses_second_axis()),
    ] {
        if used {
            let size: f64 = axis.0.iter().map(|n| n.value().powi(2)).sum();
            sum += square(&axis.0) / size;
        }
    }
    for scalar in joint.lead.iter().chain(&joint.distance) {
        sum += (precision.uncertainty(scalar) / length).powi(2);
    }
    sum
}
