//! Whether loops close: those of a simulated pose by moving joints as little as they have given way, and those next to the pose drawn.

use kutzbach_closure::{Geometry, JointState, Structure};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{Evaluation, LoopSystem, SystemPose};
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
    close(system, &mut system.pose(states), reach)
}

/// Singular values below this share of the largest are those of motions: rounding, and far from what loops are spoiled by.
const VANISHING: f64 = 1e-9;

/// Steps of a walk (rad, lengths of the part), and how many: on a way of one, loops that miss by a part in 10¹² are open by more than rounding.
/// A correction is shorter than this share of a step: one that leads back to an isolated pose is half of it at least.
const STEP: f64 = 0.025;
const WALK: usize = 40;
const CORRECTION: f64 = 0.4;

/// How far the loops of some part close to rounding at every step along a direction that is open at the pose given, whatever a simulation
/// does there (rad, lengths of the part); `None` where they do not.
pub(super) fn walks(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    states: &[JointState<f64>],
) -> Option<f64> {
    let parts = structure
        .parts
        .iter()
        .filter(|part| !part.cycles.is_empty());
    parts
        .filter_map(|part| LoopSystem::new(mechanism, geometry, states, part).ok())
        .filter(|system| system.unknowns() <= MOST_UNKNOWNS)
        .find_map(|system| {
            let start = system.pose(states);
            let open = open_directions(&system, &start);
            let mut ways = open.into_iter().map(|along| walk(&system, &start, along));
            ways.find_map(|way| way)
        })
}

/// Unit vectors of the unknowns that no equation sees at a pose.
fn open_directions(system: &LoopSystem, pose: &SystemPose) -> Vec<DVector<f64>> {
    let (n, m) = (system.unknowns(), system.equations());
    let mut here = Evaluation::default();
    system.evaluate(pose, &mut here);
    let mut rows = vec![0.0; n * m];
    system.fill_dense(&here, &mut rows);
    let matrix = DMatrix::from_row_slice(m, n, &rows).resize(n.max(m), n, 0.0);
    let svd = matrix.svd(false, true);
    let least = VANISHING * svd.singular_values.max();
    let directions = svd.v_t.into_iter().flat_map(|rows| {
        let rows: Vec<DVector<f64>> = rows.row_iter().map(|row| row.transpose()).collect();
        rows
    });
    let values = svd.singular_values.iter();
    let open = directions.zip(values).filter(|(_, value)| **value <= least);
    open.map(|(direction, _)| direction).collect()
}

/// A walk from a closed pose along an open direction, as far as it is open at the poses that follow.
fn walk(system: &LoopSystem, start: &SystemPose, mut along: DVector<f64>) -> Option<f64> {
    let mut pose = start.clone();
    for _ in 0..WALK {
        system.advance(&mut pose, (&along * STEP).as_slice());
        if !close(system, &mut pose, CORRECTION * STEP) {
            return None;
        }
        let open = open_directions(system, &pose);
        let on = open
            .iter()
            .map(|direction| direction * direction.dot(&along));
        along = on.fold(DVector::zeros(along.len()), |sum, part| sum + part);
        let size = along.norm();
        if !(size > 0.5) {
            return None;
        }
        along /= size;
    }
    let mut way = vec![0.0; system.unknowns()];
    system.way(start, &pose, &mut way);
    let farthest = way.iter().fold(0.0f64, |most, way| most.max(way.abs()));
    (farthest > 4.0 * STEP).then_some(farthest)
}

/// Closes the loops of a pose to rounding, no correction longer than `reach`.
fn close(system: &LoopSystem, pose: &mut SystemPose, reach: f64) -> bool {
    let (n, m) = (system.unknowns(), system.equations());
    // Every joint of the part is passed at most once.
    let rounding = ROUNDINGS * f64::EPSILON * n.min(12) as f64;
    let mut here = Evaluation::default();
    let mut rows = vec![0.0; n * m];
    let mut way = 0.0;
    for _ in 0..STEPS {
        system.evaluate(pose, &mut here);
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
        system.advance(pose, step.as_slice());
    }
    system.evaluate(pose, &mut here);
    here.largest() <= rounding
}
