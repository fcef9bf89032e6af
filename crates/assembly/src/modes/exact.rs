//! Exact algebra on the equations of a tree.

use crate::reduced::{Poly, ReducedSystem};
use kutzbach_algebra::{Budget, OverRationals, RealSet, Stop};

/// Decides on a system.
pub(super) fn decide(system: &ReducedSystem, budget: &Budget) -> Result<RealSet, Stop> {
    let canonical = |unknowns: &[f64]| canonical(system, unknowns);
    system.exported().system.real_set(canonical, budget)
}

/// Decides on a system of which more equations are known to hold at all real solutions.
pub(super) fn decide_with(
    system: &ReducedSystem,
    more: &[Poly],
    budget: &Budget,
) -> Result<RealSet, Stop> {
    let canonical = |unknowns: &[f64]| canonical(system, unknowns);
    let closures = system.closures.iter().map(|c| c.polynomial.clone());
    let relations = system.unknowns.iter().map(|u| u.relation(&system.field));
    let all: Vec<Poly> = closures
        .chain(relations)
        .chain(more.iter().cloned())
        .collect();
    let over = OverRationals::new(&all, system.unknown_count(), &system.field);
    over.real_set(canonical, budget)
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
