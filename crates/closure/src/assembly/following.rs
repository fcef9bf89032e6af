//! A short way along a motion.

use super::super::displacement::JointState;
use super::super::geometry::Geometry;
use super::super::jacobian::{Part, jacobian};
use super::descent::{Effort, Kept, Task, advance, descend};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::Mechanism;
use std::collections::BTreeSet;

/// Follows a motion of a part for a short finite way: all variables move along `direction` (in the Jacobian's units), then
/// the cycles are closed again. Calls `there` with the states reached; `None` where the cycles do not close from there.
/// The states are put back before it returns.
///
/// # Errors
/// [`MatrixError`] where numbers overflow, and those of `there`.
pub fn follow<T>(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    direction: &[f64],
    there: impl FnOnce(&[JointState<f64>]) -> Result<T, MatrixError>,
) -> Result<Option<T>, MatrixError> {
    let here = jacobian(mechanism, geometry, states, part)?;
    let movable = vec![true; here.variables.len()];
    let before = Kept::of(part, states);
    advance(mechanism, geometry, &here, &movable, direction, states);
    let nobody = BTreeSet::new();
    let task = Task {
        mechanism,
        geometry,
        part,
        held: &nobody,
        tolerance: None,
    };
    let found = match descend(&task, states, Effort::LONG) {
        Ok(outcome) if outcome.residual <= outcome.tolerance => there(states).map(Some),
        Ok(_) => Ok(None),
        Err(error) => Err(error),
    };
    before.put_back(states);
    found
}
