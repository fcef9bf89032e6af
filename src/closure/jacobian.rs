//! The derivative of the cycle equations: joint screws stacked cycle by cycle.

use super::cycle::{Walk, WalkedCycle};
use super::displacement::JointState;
use super::geometry::{Geometry, Uncertainty};
use crate::matrix::{MatrixError, Real, SparseMatrix};
use crate::mechanism::{FreedomPart, Mechanism};

/// A part of a mechanism whose equations stand alone: some joints, the cycles through them, the couplings between them.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Joints in the order of their columns, each once.
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
        variable_unit(
            mechanism.joints()[joint].kind.freedoms()[variable],
            self.length,
        )
    }
}

fn variable_unit(part: FreedomPart, length: f64) -> f64 {
    match part {
        FreedomPart::Translation => length,
        FreedomPart::Rotation | FreedomPart::Screw => 1.0,
    }
}

/// Builds the linearised equations of a part at given joint states. Joints that a cycle passes outside the part have no
/// columns: they stand still.
///
/// # Errors
/// [`MatrixError::Length`] where geometry or states belong to another mechanism; [`MatrixError::NotFinite`] where
/// coordinates leave the range of numbers.
pub fn jacobian<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    part: &Part,
) -> Result<CycleJacobian<R>, MatrixError> {
    for (what, found) in [
        ("joints of the geometry", geometry.displacements.len()),
        ("joint states", states.len()),
    ] {
        let expected = mechanism.joints().len();
        if found != expected {
            return Err(MatrixError::Length {
                what,
                expected,
                found,
            });
        }
    }
    linearised(geometry, states, part)
}

/// [`jacobian`] of a geometry that may differ from any mechanism's, as where a joint is relaxed to see what that would do.
pub(crate) fn linearised<R: Real>(
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    part: &Part,
) -> Result<CycleJacobian<R>, MatrixError> {
    let one = &geometry.one;
    let freedoms = |joint: usize| geometry.displacements[joint].kind().freedoms();
    let walks: Vec<WalkedCycle<R>> = part
        .cycles
        .iter()
        .map(|cycle: &Vec<(usize, bool)>| WalkedCycle::walk(geometry, states, cycle as &Walk))
        .collect();
    let lengths: Vec<f64> = walks.iter().map(|walk| walk.length).collect();
    let length = if walks.is_empty() {
        1.0
    } else {
        0.0.norm(&lengths) / (walks.len() as f64).sqrt()
    };
    let mut first_column = std::collections::HashMap::with_capacity(part.joints.len());
    let mut variables = Vec::new();
    for &joint in &part.joints {
        first_column.insert(joint, variables.len());
        variables.extend((0..freedoms(joint).len()).map(|variable| (joint, variable)));
    }
    let mut triplets = Vec::new();
    let mut residual = Vec::new();
    for (index, walk) in walks.iter().enumerate() {
        for joint in &walk.joints {
            let Some(&first) = first_column.get(&joint.joint) else {
                continue;
            };
            for (variable, screw) in joint.screws.iter().enumerate() {
                let part = freedoms(joint.joint)[variable];
                let unit = one.constant(variable_unit(part, length));
                for (row, entry) in walk.column(joint, screw).into_iter().enumerate() {
                    let entry = if part == FreedomPart::Translation {
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
                let unit = freedoms(*joint)
                    .first()
                    .map_or(1.0, |part| variable_unit(*part, length));
                (*joint, factor.clone(), factor.clone() * one.constant(unit))
            })
            .collect();
        // The row is brought to unit length, so that a gear of ratio 1000 weighs as much as one of ratio 1.
        let row_entries: Vec<R> = weights
            .iter()
            .map(|(_, _, weight)| weight.clone())
            .collect();
        let mut norm = one.norm(&row_entries);
        if norm.is_zero() {
            norm = one.clone();
        }
        let mut value = -offset.clone();
        for (joint, factor, weight) in weights {
            if let Some(variable) = states[joint].values.first() {
                value = value + factor * variable.clone();
            }
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
/// every screw of the cycle by up to `u` (relative: `u / L`); one of a direction or an angle turns every screw by as much
/// and moves it by up to that angle times the cycle's extent. Errors of different numbers are independent and uniform in
/// ±u: their root sum of squares is 1.7 standard deviations of the total, and twice that is used. A cycle of `n` columns
/// is then off by at most `√n` times as much. Rounding in the arithmetic is bounded the same way, with `u` = unit roundoff
/// times the largest coordinate met, summed, since it is not random.
pub fn entry_accuracy<R: Real>(mechanism: &Mechanism, jacobian: &CycleJacobian<R>) -> (f64, f64) {
    let exact = mechanism.precision().is_exact();
    let mut stated = 0.0f64;
    let mut rounding = 0.0f64;
    let roundoff = jacobian.matrix.zero().unit_roundoff();
    for walk in &jacobian.walks {
        let columns: usize = walk.joints.iter().map(|j| j.screws.len()).sum();
        let spread = (2.0 * columns as f64).sqrt();
        if !exact {
            let Uncertainty { lengths, angles } = walk.uncertainty;
            let places = lengths / walk.length;
            let tilts = angles * (walk.extent / walk.length).hypot(1.0);
            stated = stated.max(2.0 * (columns as f64).sqrt() * places.hypot(tilts));
        }
        // Each joint composes three displacements; a dozen roundings of coordinates up to the reach, in units of length.
        let steps = 12.0 * walk.joints.len() as f64;
        rounding = rounding.max(spread * steps * roundoff * (1.0 + walk.reach / walk.length));
    }
    // Couplings: their factors are exact or rounded like any number; one rounding each.
    (stated, rounding.max(4.0 * roundoff))
}
