//! How far joints are outside their limits.

use super::super::displacement::JointState;
use super::descent::Task;
use kutzbach_model::mechanism::{Joint, Mechanism};

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
    let Some((lower, upper)) = joint.bounds() else {
        return 0.0;
    };
    let by = if value > upper {
        value - upper
    } else if value < lower {
        value - lower
    } else {
        0.0
    };
    if by.abs() > NO_EXCESS { by } else { 0.0 }
}

/// The joints outside their limits, farthest first.
pub(super) fn outside(mechanism: &Mechanism, states: &[JointState<f64>]) -> Vec<OutsideLimit> {
    let mut found: Vec<OutsideLimit> = mechanism
        .joints()
        .iter()
        .zip(states)
        .enumerate()
        .filter_map(|(joint, (described, state))| {
            let by = beyond(described, *state.values.first()?);
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
