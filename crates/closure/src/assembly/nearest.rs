//! From a closed pose to the closed pose nearest to the drawn one.
//!
//! A closing may be far from the drawn pose though another one is near: at a singular pose a gap of some micrometres is
//! closed to first order only by steps of any length along the direction that gives way, and a start among many lies
//! anywhere. With `d` the way from the drawn pose to the present one, `F` the equations and `J` their derivative here, the
//! closed pose nearest to the drawn one is a fixed point of
//!
//! ```text
//! d ← argmin |y|²  subject to  J y = J d − F
//! ```
//!
//! which is Gauss–Newton for the constrained problem min |d|², F(d) = 0: whatever part of `d` lies in the kernel of `J` is
//! taken back, and the equations are closed again. A step counts only if the pose closes afterwards and is nearer.

use super::super::displacement::JointState;
use super::super::jacobian::{residual, variable_unit};
use super::descent::{
    Effort, Kept, PartOutcome, Task, advance, descend, largest, movable_columns, step,
};
use super::limits;
use super::search::has_ball;
use kutzbach_math::matrix::{LeastSquares, MatrixError};
use kutzbach_model::mechanism::FreedomPart;
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// Steps towards the drawn pose.
const STEPS: usize = 60;

/// A step moves no variable by more than this (rad, part lengths): beyond, the kernel has turned away.
const LONGEST_STEP: f64 = 0.25;

/// Steps that gain less than this share of the distance are the last.
const WORTHWHILE: f64 = 1e-3;

/// At a regular pose a gap is closed by joints moving some ten times as far, in radians and part lengths; the factor is one over the
/// smallest singular value. What moved farther is looked at again.
pub(super) const COMMENSURATE: f64 = 10.0;

/// The way from one pose of a part to another, in rad and part lengths, in the order of the columns.
pub(super) fn way(
    task: &Task<'_>,
    length: f64,
    from: &[JointState<f64>],
    to: &[JointState<f64>],
) -> Vec<f64> {
    task.part
        .joints
        .iter()
        .flat_map(|&joint| {
            let displacement = &task.geometry.displacements[joint];
            let freedoms = displacement.kind().freedoms();
            displacement
                .increments(&from[joint], &to[joint])
                .into_iter()
                .zip(freedoms)
                .map(move |(x, freedom)| x / variable_unit(*freedom, length))
        })
        .collect()
}

/// The length of the way from the reference (rad, part lengths); infinite where nothing is known.
pub(super) fn distance(
    task: &Task<'_>,
    reference: &[JointState<f64>],
    states: &[JointState<f64>],
    outcome: &PartOutcome,
) -> f64 {
    let Some(here) = &outcome.jacobian else {
        return f64::INFINITY;
    };
    let way = way(task, here.length, reference, states);
    way.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Walks from a closed pose towards the reference, as far as the closed poses and the joint limits allow. The states end at the nearest pose
/// found, with its outcome.
pub(super) fn settle(
    task: &Task<'_>,
    reference: &[JointState<f64>],
    states: &mut [JointState<f64>],
    outcome: PartOutcome,
    work: &mut f64,
) -> Result<PartOutcome, MatrixError> {
    let mut best = outcome;
    let mut nearest = distance(task, reference, states, &best);
    let mut shorten = 1.0;
    let mut outside = limits::excess(task, states);
    for _ in 0..STEPS {
        let Some(here) = best.jacobian.as_ref().filter(|_| best.closed()) else {
            break;
        };
        if !(*work > 0.0) || nearest == 0.0 {
            break;
        }
        let movable = movable_columns(here, task.held);
        let gone = way(task, here.length, reference, states);
        let mut right = here.matrix.multiply(&gone)?;
        right
            .iter_mut()
            .zip(&here.residual)
            .for_each(|(x, r)| *x -= r);
        let target = LeastSquares::damped(&here.matrix, &right, 0.0, Some(&movable))?;
        let mut increments: Vec<f64> = target.iter().zip(&gone).map(|(y, d)| y - d).collect();
        let longest = largest(&increments);
        if !longest.is_finite() {
            break;
        }
        let factor = shorten * (LONGEST_STEP / longest).min(1.0);
        increments.iter_mut().for_each(|x| *x *= factor);
        let before = Kept::of(task.part, states);
        advance(
            task.mechanism,
            task.geometry,
            here,
            &movable,
            &increments,
            states,
        );
        let there = descend(task, states, Effort::SHORT)?;
        *work -= 2.0 * there.work;
        let reached = distance(task, reference, states, &there);
        // Limits go before nearness: no step leads out of them, or farther out.
        let out = limits::excess(task, states);
        if there.closed() && reached < nearest && out <= outside {
            outside = out;
            let gained = nearest - reached;
            best = PartOutcome {
                steps: best.steps + there.steps,
                ..there
            };
            let done = factor == 1.0 && gained < WORTHWHILE * nearest;
            nearest = reached;
            shorten = (2.0 * shorten).min(1.0);
            if done {
                break;
            }
        } else {
            before.put_back(states);
            shorten *= 0.25;
            if shorten < 1e-3 {
                break;
            }
        }
    }
    Ok(best)
}

/// Poses beside the drawn one to close from, in units of the root of the gap: at a singular pose a gap is closed by going
/// about so far along the direction that gives way.
const BESIDE: [f64; 3] = [0.3, 1.0, 3.0];

/// Where a closing from the drawn pose moved out of proportion to the gap: looks for one that is less than half as far.
/// The states end there, or where they were.
pub(super) fn commensurate(
    task: &Task<'_>,
    reference: &[JointState<f64>],
    states: &mut [JointState<f64>],
    outcome: PartOutcome,
    work: &mut f64,
) -> Result<PartOutcome, MatrixError> {
    let gap = {
        let drawn = residual(task.mechanism, task.geometry, reference, task.part)?;
        largest(&drawn)
    };
    let first = distance(task, reference, states, &outcome);
    if !(first > COMMENSURATE * gap) || task.part.joints.is_empty() {
        return Ok(outcome);
    }
    let as_found = Kept::of(task.part, states);
    let steps = outcome.steps;
    let mut nearest: Option<(f64, Kept<f64>, PartOutcome)> = None;
    for beside in std::iter::once(None).chain(BESIDE.map(Some)) {
        let begun = match beside {
            None => {
                // The closing found, without its Jacobian, which stays with it.
                descend(task, states, Effort::SHORT)?
            }
            Some(factor) => {
                Kept::of(task.part, reference).put_back(states);
                super::descent::nudge(task, (factor * gap.sqrt()).min(1.0), states)?;
                descend(task, states, Effort::SHORT)?
            }
        };
        *work -= begun.work;
        if !begun.closed() {
            continue;
        }
        let settled = settle(task, reference, states, begun, work)?;
        let far = distance(task, reference, states, &settled);
        if nearest.as_ref().is_none_or(|(least, ..)| far < *least) {
            nearest = Some((far, Kept::of(task.part, states), settled));
        }
    }
    match nearest {
        Some((far, pose, settled)) if far < 0.5 * first => {
            pose.put_back(states);
            Ok(PartOutcome {
                steps: steps + settled.steps,
                ..settled
            })
        }
        _ => {
            as_found.put_back(states);
            Ok(outcome)
        }
    }
}

/// A gap is clear of rounding where it is so many times what rounding leaves: nearer to that, what a pose beside it leaves over may be
/// less by luck.
const CLEAR: f64 = 1e3;

/// Where a pose counts as closed and its gap is more than rounding: looks for a pose beside it that closes. At a singular pose such a
/// gap ε lies across all that the joints do to first order, and is closed to second order by going about √ε along the direction that
/// gives way, one way or the other: drawn a little short of stretched, a chain is closed by bending it. A gap that stays open there too
/// is a misfit of dimensions. The states end at the closed pose, or where they were.
pub(super) fn second_order(
    task: &Task<'_>,
    reference: &[JointState<f64>],
    states: &mut [JointState<f64>],
    outcome: &PartOutcome,
    work: &mut f64,
) -> Result<Option<PartOutcome>, MatrixError> {
    let gap = outcome.residual;
    if !(gap > CLEAR * outcome.rounding) {
        return Ok(None);
    }
    let drawn = residual(task.mechanism, task.geometry, reference, task.part)?;
    let farthest = COMMENSURATE * gap.max(largest(&drawn)).sqrt();
    let as_found = Kept::of(task.part, states);
    let mut nearest: Option<(f64, Kept<f64>, PartOutcome)> = None;
    for factor in std::iter::once(0.0).chain(BESIDE) {
        as_found.put_back(states);
        if factor > 0.0 {
            super::descent::nudge(task, (factor * gap.sqrt()).min(1.0), states)?;
        }
        let begun = descend(task, states, Effort::TO_ROUNDING)?;
        *work -= begun.work;
        let far = distance(task, reference, states, &begun);
        let closes = begun.residual <= begun.rounding && far <= farthest;
        if closes && nearest.as_ref().is_none_or(|(least, ..)| far < *least) {
            nearest = Some((far, Kept::of(task.part, states), begun));
        }
    }
    let Some((_, pose, begun)) = nearest else {
        as_found.put_back(states);
        return Ok(None);
    };
    pose.put_back(states);
    Ok(Some(PartOutcome {
        steps: outcome.steps + begun.steps.max(1),
        ..begun
    }))
}

/// Steps towards where the joints can mend no more of a gap.
const MENDING: usize = 12;

/// Where a pose counts as closed and a gap is left: moves it to where the joints can mend no more of it, so that what is left is a misfit
/// of dimensions and not of the pose. Steps are damped by the gap ε, so that directions whose singular value is above √ε are polished,
/// and those below it, which the misfit itself may have made, are hardly moved along: by at most √ε/2 a step.
pub(super) fn mended(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    mut outcome: PartOutcome,
) -> Result<PartOutcome, MatrixError> {
    let gap = outcome.residual;
    let rounding = outcome.rounding;
    if !(gap > CLEAR * rounding) {
        return Ok(outcome);
    }
    let sum = |r: &[f64]| r.iter().map(|x| x * x).sum::<f64>();
    for _ in 0..MENDING {
        let Some(here) = &outcome.jacobian else { break };
        let columns = movable_columns(here, task.held);
        let Some(increments) = step(here, &columns, gap)? else {
            break;
        };
        if largest(&increments) <= rounding {
            break;
        }
        let before = Kept::of(task.part, states);
        advance(
            task.mechanism,
            task.geometry,
            here,
            &columns,
            &increments,
            states,
        );
        let there = descend(task, states, Effort::NONE)?;
        let better = there
            .jacobian
            .as_ref()
            .is_some_and(|t| sum(&t.residual) < sum(&here.residual));
        if !better {
            before.put_back(states);
            break;
        }
        outcome = PartOutcome {
            steps: outcome.steps + 1,
            ..there
        };
    }
    Ok(outcome)
}

/// The drawn pose, where it counts as closed and its joints are less far open than after it was closed further: residuals count lengths
/// in those of the loop, and where all axes nearly meet in a point these are short, so that a small step there is closed by turning the
/// whole loop about that point.
pub(super) fn no_worse_than_drawn(
    task: &Task<'_>,
    drawn: &Kept<f64>,
    states: &mut [JointState<f64>],
    outcome: PartOutcome,
) -> Result<PartOutcome, MatrixError> {
    if outcome.residual <= outcome.rounding {
        return Ok(outcome);
    }
    let moved = Kept::of(task.part, states);
    drawn.put_back(states);
    let as_drawn = descend(task, states, Effort::NONE)?;
    if as_drawn.closed() && as_drawn.gap(task.mechanism) < outcome.gap(task.mechanism) {
        return Ok(as_drawn);
    }
    moved.put_back(states);
    Ok(outcome)
}

/// Takes back whole turns of hinges: to within half a turn of the reference, or to where the limits allow it. What a
/// coupling relates counts its turns.
pub(super) fn unwind(
    task: &Task<'_>,
    reference: &[JointState<f64>],
    states: &mut [JointState<f64>],
) {
    let coupled: BTreeSet<usize> = task
        .part
        .couplings
        .iter()
        .flat_map(|&coupling| task.geometry.couplings[coupling].joints())
        .collect();
    for &joint in &task.part.joints {
        let described = &task.mechanism.joints()[joint];
        if task.held.contains(&joint) || coupled.contains(&joint) || has_ball(described.kind) {
            continue;
        }
        let mut values = states[joint].values.clone();
        let drawn = &reference[joint].values;
        for (variable, freedom) in described.kind.freedoms().iter().enumerate() {
            if *freedom != FreedomPart::Rotation {
                continue;
            }
            let turns = ((values[variable] - drawn[variable]) / TAU).round();
            values[variable] -= TAU * turns;
            let over = limits::beyond(described, values[variable]);
            let back = values[variable] - TAU * over.signum();
            if over != 0.0 && limits::beyond(described, back) == 0.0 {
                values[variable] = back;
            }
        }
        if values != states[joint].values {
            states[joint] = task.geometry.displacements[joint].at(&values);
        }
    }
}
