//! The equations of the cycles at a pose, before their derivative is asked for.

use super::cycle::{Walk, WalkedCycle};
use super::displacement::JointState;
use super::geometry::Geometry;
use super::jacobian::Part;
use kutzbach_math::matrix::{MatrixError, Real};
use kutzbach_model::mechanism::Mechanism;

/// A coupling's row, divided by the length of all its factors.
#[derive(Clone, Debug)]
pub struct CouplingRow<R> {
    /// Joints and their weights.
    pub weights: Vec<(usize, R)>,
    /// Joints and the further Taylor coefficients of their shares, from that of the square on (per radian or metre); none where the
    /// coupling is linear.
    pub higher: Vec<(usize, Vec<R>)>,
}

/// What a part's equations come to at a pose. Their derivative costs as much again, and whoever only wants to know whether
/// the part closes does not ask for it: see [`super::jacobian()`] for the order of rows.
#[derive(Clone, Debug)]
pub struct Equations<R> {
    /// The walks around the cycles.
    pub walks: Vec<WalkedCycle<R>>,
    /// The part's length (m): RMS of its cycles' lengths.
    pub length: f64,
    /// The value of every equation: six per cycle (rad, cycle lengths), then one per coupling.
    pub residual: Vec<R>,
    /// Rows of the couplings.
    pub coupling_rows: Vec<CouplingRow<R>>,
}

impl<R: Real> Equations<R> {
    /// Evaluates a part's equations.
    ///
    /// # Errors
    /// [`MatrixError::Length`] where geometry or states belong to another mechanism; [`MatrixError::NotFinite`] where
    /// coordinates leave the range of numbers.
    pub fn at(
        mechanism: &Mechanism,
        geometry: &Geometry<R>,
        states: &[JointState<R>],
        part: &Part,
    ) -> Result<Self, MatrixError> {
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
        Self::evaluated(geometry, states, part)
    }

    /// [`Self::at`] for a geometry that may differ from any mechanism's.
    ///
    /// # Errors
    /// [`MatrixError::NotFinite`] where coordinates leave the range of numbers.
    pub fn evaluated(
        geometry: &Geometry<R>,
        states: &[JointState<R>],
        part: &Part,
    ) -> Result<Self, MatrixError> {
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
        let mut residual = Vec::with_capacity(6 * walks.len() + part.couplings.len());
        residual.extend(walks.iter().flat_map(WalkedCycle::residual));
        let mut coupling_rows = Vec::with_capacity(part.couplings.len());
        for &coupling in &part.couplings {
            let (row, value) = coupling_row(geometry, states, coupling, length);
            coupling_rows.push(row);
            residual.push(value);
        }
        if let Some(row) = residual.iter().position(|r| !r.is_finite()) {
            return Err(MatrixError::NotFinite { row, column: 0 });
        }
        Ok(Self {
            walks,
            length,
            residual,
            coupling_rows,
        })
    }

    /// The largest equation (rad, cycle lengths); zero where there are none.
    pub fn largest(&self) -> f64 {
        self.residual
            .iter()
            .fold(0.0, |largest, x| x.to_f64().abs().max(largest))
    }
}

/// A coupling's row, and its value.
fn coupling_row<R: Real>(
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    coupling: usize,
    length: f64,
) -> (CouplingRow<R>, R) {
    let one = &geometry.one;
    let equation = &geometry.couplings[coupling];
    let (value, taylor) = equation.at(states);
    let unit = |joint: usize| geometry.coupled_unit(joint, length);
    let norm = equation.norm(unit);
    let slopes = equation.joints().zip(taylor.iter().map(|own| &own[0]));
    let weights = slopes.map(|(joint, slope)| {
        let weight = slope.clone() * one.constant(unit(joint));
        (joint, weight / norm.clone())
    });
    let higher = equation.joints().zip(&taylor).filter_map(|(joint, own)| {
        let further = own[1..].iter().map(|x| x.clone() / norm.clone());
        (own.len() > 1).then(|| (joint, further.collect()))
    });
    let row = CouplingRow {
        higher: higher.collect(),
        weights: weights.collect(),
    };
    (row, value / norm)
}
