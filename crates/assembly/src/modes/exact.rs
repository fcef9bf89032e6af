//! Exact algebra on the equations of a tree.

use crate::reduced::ReducedSystem;
use kutzbach_algebra::{Budget, RealSet, Stop};

/// Decides on a system.
pub(super) fn decide(system: &ReducedSystem, budget: &Budget) -> Result<RealSet, Stop> {
    let exported = system.exported();
    let canonical = |unknowns: &[f64]| canonical(system, unknowns);
    exported.system.real_set(canonical, budget)
}

/// Of the two quaternions of a rotation the one whose first component that is not zero is positive.
fn canonical(system: &ReducedSystem, values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    for turn in system.unknowns.iter().filter(|t| t.count() == 4) {
        let own = &mut values[turn.first()..turn.first() + 4];
        let sign = own
            .iter()
            .find(|x| x.abs() > 1e-9)
            .map_or(1.0, |x| x.signum());
        own.iter_mut().for_each(|x| *x *= sign);
    }
    values
}
