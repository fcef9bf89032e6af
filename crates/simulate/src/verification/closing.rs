//! Whether the loops of a simulated pose close by moving joints as little as they have given way.

use kutzbach_closure::{Geometry, JointState, Structure};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{Evaluation, LoopSystem};
use nalgebra::{DMatrix, DVector};

/// Newton's method doubles the digits: from a millionth, three steps are rounding, and three more are to spare.
const STEPS: usize = 6;

/// Singular values below this share of the largest are those of equations that repeat others or of motions: what loops that have moved by a
/// fifth of a radian are held by is larger where they can be closed at all.
const REPEATED: f64 = 1e-7;

/// Roundings per joint passed on the way around a loop, in the closure of a pose that is closed as well as numbers allow.
const ROUNDINGS: f64 = 4.0;

/// Parts of more unknowns are not closed.
const MOST_UNKNOWNS: usize = 150;

/// Whether all loops close to rounding next to given states: no correction is longer than `reach` (rad, lengths of the part). A loop that
/// misses by a part in 10¹³ of its length at these states does not.
pub(super) fn closes(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    states: &[JointState<f64>],
    reach: f64,
) -> bool {
    let parts = structure
        .parts
        .iter()
        .filter(|part| !part.cycles.is_empty());
    parts
        .map(|part| LoopSystem::new(mechanism, geometry, states, part))
        .all(|system| {
            system.is_ok_and(|system| {
                system.unknowns() <= MOST_UNKNOWNS && closes_part(&system, states, reach)
            })
        })
}

fn closes_part(system: &LoopSystem, states: &[JointState<f64>], reach: f64) -> bool {
    let (n, m) = (system.unknowns(), system.equations());
    // Every joint of the part is passed at most once.
    let rounding = ROUNDINGS * f64::EPSILON * n.min(12) as f64;
    let mut pose = system.pose(states);
    let mut here = Evaluation::default();
    let mut rows = vec![0.0; n * m];
    let mut way = 0.0;
    for _ in 0..STEPS {
        system.evaluate(&pose, &mut here);
        if here.largest() <= rounding {
            return true;
        }
        system.fill_dense(&here, &mut rows);
        let size = n.max(m);
        let matrix = DMatrix::from_row_slice(m, n, &rows).resize(size, n, 0.0);
        let right = DVector::from_fn(size, |i, _| here.residual.get(i).map_or(0.0, |r| -r));
        let svd = matrix.svd(true, true);
        let least = REPEATED * svd.singular_values.max();
        let Ok(step) = svd.solve(&right, least) else {
            return false;
        };
        way += step.norm();
        if !(way <= reach) {
            return false;
        }
        system.advance(&mut pose, step.as_slice());
    }
    system.evaluate(&pose, &mut here);
    here.largest() <= rounding
}
