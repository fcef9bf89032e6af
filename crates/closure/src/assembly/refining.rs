//! Closed poses in more digits.

use super::super::displacement::JointState;
use super::super::geometry::Geometry;
use super::super::jacobian::{Part, jacobian};
use super::descent::{Kept, advance, largest, movable_columns};
use kutzbach_math::matrix::{LeastSquares, MatrixError, Real};
use kutzbach_model::mechanism::Mechanism;
use std::collections::BTreeSet;

/// Polishes states in an arithmetic of more digits, starting from states that close in double precision: Newton steps
/// whose residual is exact to the arithmetic while the direction is solved in double precision, which gains some fifteen
/// digits a step at a regular pose. Stops when the residual no longer falls; returns it.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn refine<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &mut [JointState<R>],
    part: &Part,
    held: &BTreeSet<usize>,
) -> Result<f64, MatrixError> {
    const STEPS: usize = 60;
    let mut here = jacobian(mechanism, geometry, states, part)?;
    let size = |r: &[R]| largest(&r.iter().map(Real::to_f64).collect::<Vec<_>>());
    let mut residual = size(&here.residual);
    for _ in 0..STEPS {
        if !(residual > 64.0 * geometry.one.unit_roundoff()) {
            break;
        }
        let movable = movable_columns(&here, held);
        let double = here.matrix.map(&0.0, Real::to_f64);
        // The residual is brought to order one before it is rounded to double, and the step back after.
        let right: Vec<f64> = here
            .residual
            .iter()
            .map(|r| -(r.clone() / geometry.one.constant(residual)).to_f64())
            .collect();
        let solution = LeastSquares::damped(&double, &right, 1e-24, Some(&movable))?;
        let increments: Vec<R> = solution
            .iter()
            .map(|x| geometry.one.constant(*x) * geometry.one.constant(residual))
            .collect();
        let before = Kept::of(part, states);
        advance(mechanism, geometry, &here, &movable, &increments, states);
        let there = jacobian(mechanism, geometry, states, part)?;
        let reached = size(&there.residual);
        if !(reached < 0.5 * residual) {
            before.put_back(states);
            break;
        }
        here = there;
        residual = reached;
    }
    Ok(residual)
}
