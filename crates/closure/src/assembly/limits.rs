//! How far joints are outside their limits.

use super::super::displacement::JointState;
use super::descent::Task;
use kutzbach_model::mechanism::{FreedomPart, Joint, Mechanism};
use std::f64::consts::TAU;

/// Excesses below this (rad, m) are rounding in values that were computed.
const NO_EXCESS: f64 = 1e-9;

/// A joint that stands outside its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutsideLimit {
    /// Index of the joint.
    pub joint: usize,
    /// By how much its variable exceeds the limit (rad, m); negative below the lower one.
    pub by: f64,
}

/// The limits of a joint that has both.
pub(super) fn range(joint: &Joint) -> Option<(f64, f64)> {
    joint
        .bounds()
        .filter(|(lower, upper)| lower.is_finite() && upper.is_finite())
}

/// By how much a value is outside a joint's limits; zero within them.
pub(super) fn beyond(joint: &Joint, value: f64) -> f64 {
    let by = excess_of(joint, value);
    if by.abs() > NO_EXCESS { by } else { 0.0 }
}

fn excess_of(joint: &Joint, value: f64) -> f64 {
    let Some((lower, upper)) = joint.bounds() else {
        return 0.0;
    };
    if value > upper {
        value - upper
    } else if value < lower {
        value - lower
    } else {
        0.0
    }
}

/// A joint's variable (rad or m), for a hinge with whole turns added or taken away so that it is within the limits or misses
/// them by least: the links stand at the same place. Not for joints of a coupling, which counts turns;
/// as it is where a limit is missing.
/// Of a hinge from −90° to 180°, −140° is 220°, and 40° outside.
#[must_use]
pub fn nearest_turn(joint: &Joint, value: f64) -> f64 {
    if joint.kind.freedoms() != [FreedomPart::Rotation] {
        return value;
    }
    let Some((lower, upper)) = range(joint) else {
        return value;
    };
    // The first turn at or above the lower limit, and the last at or below the upper one.
    let candidates = [
        value,
        value + TAU * ((lower - value) / TAU).ceil(),
        value + TAU * ((upper - value) / TAU).floor(),
    ];
    let miss = |x: f64| excess_of(joint, x).abs();
    candidates
        .into_iter()
        .fold(value, |best, x| if miss(x) < miss(best) { x } else { best })
}

/// Of every joint whether a coupling relates it to others.
#[must_use]
pub fn coupled_joints(mechanism: &Mechanism) -> Vec<bool> {
    let mut coupled = vec![false; mechanism.joints().len()];
    for term in mechanism.couplings().iter().flat_map(|c| &c.terms) {
        coupled[term.joint.0] = true;
    }
    coupled
}

/// The joints outside their limits, farthest first.
pub(super) fn outside(mechanism: &Mechanism, states: &[JointState<f64>]) -> Vec<OutsideLimit> {
    let coupled = coupled_joints(mechanism);
    let mut found: Vec<OutsideLimit> = mechanism
        .joints()
        .iter()
        .zip(states)
        .enumerate()
        .filter_map(|(joint, (described, state))| {
            let value = *state.values.first()?;
            let by = match coupled[joint] {
                true => beyond(described, value),
                false => beyond(described, nearest_turn(described, value)),
            };
            (by != 0.0).then_some(OutsideLimit { joint, by })
        })
        .collect();
    found.sort_by(|a, b| {
        let names = [a, b].map(|x| &mechanism.joints()[x.joint].name);
        b.by.abs()
            .total_cmp(&a.by.abs())
            .then_with(|| names[0].cmp(names[1]))
    });
    found
}

/// The sum of what the joints of a part are outside their limits; held ones are where they are wanted.
pub(super) fn excess(task: &Task<'_>, states: &[JointState<f64>]) -> f64 {
    task.part
        .joints
        .iter()
        .filter(|joint| !task.held.contains(joint))
        .filter_map(|&joint| {
            let value = states[joint].values.first()?;
            Some(beyond(&task.mechanism.joints()[joint], *value).abs())
        })
        .sum()
}
