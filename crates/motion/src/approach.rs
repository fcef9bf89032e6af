//! The pose at which joints have given values, reached along the branch drawn.
//!
//! A mechanism closes in several configurations with a joint held, and closing from afar may end in any of them. Here one joint after
//! the other is driven to its value along the curve that [`trace`] follows from the pose so far; the pose there is where
//! assembly begins, which then moves nothing but what rounding leaves.

use super::result::{EndReason, Motion, Trace, TraceOptions};
use super::trace::trace;
use kutzbach_closure::JointState;
use kutzbach_math::number::Number;
use kutzbach_mobility::{AnalysisOptions, Depth, Structure, analyse};
use kutzbach_model::mechanism::{Configuration, FreedomPart, JointId, Mechanism};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// Why a joint does not get to its value along the branch drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotReached {
    /// The joint.
    pub joint: JointId,
    /// Why, as the end of a sentence.
    pub why: String,
}

/// The configuration in which joints have given values (one each: rad, m), followed from the pose of a configuration of the
/// mechanism (home if `None`); it says of all other joints where assembly begins. `None` where there is nothing to follow: no loop, or a
/// joint of several freedoms.
///
/// # Errors
/// [`NotReached`] where the branch drawn does not lead there, as far as it is known and followed.
pub fn approach(
    mechanism: &Mechanism,
    from: Option<&str>,
    wanted: &Configuration,
) -> Result<Option<Configuration>, NotReached> {
    let structure = Structure::new(mechanism);
    let single = |values: &[Number]| values.len() == 1;
    if structure.parts.is_empty() || !wanted.positions.iter().all(|(_, values)| single(values)) {
        return Ok(None);
    }
    let mut begun = mechanism.clone();
    let mut at = from.map(str::to_owned);
    let mut held: Vec<JointId> = Vec::new();
    for (joint, values) in &wanted.positions {
        // What is in no loop stands where it is put.
        if structure.free_joints.contains(&joint.0) {
            continue;
        }
        let states = driven_to((&begun, at.as_deref()), (*joint, &values[0]), &held)?;
        held.push(*joint);
        let reached = configuration(mechanism, wanted, &states);
        at = Some(reached.name.clone());
        begun = begun.with_configuration(reached);
    }
    let reached = at.as_deref().and_then(|name| begun.configuration(name));
    Ok(reached.filter(|_| !held.is_empty()).cloned())
}

/// All joints where they stand, those wanted at the values wanted; assembly may move the others.
fn configuration(
    mechanism: &Mechanism,
    wanted: &Configuration,
    states: &[JointState<f64>],
) -> Configuration {
    let mut positions = wanted.positions.clone();
    let mut free = BTreeSet::new();
    for (joint, state) in states.iter().enumerate() {
        let joint = JointId(joint);
        let given = wanted.positions.iter().any(|(other, _)| *other == joint);
        let values = state.values.iter().map(|&value| Number::from_f64(value));
        let values: Option<Vec<Number>> = values.collect();
        if let Some(values) = values.filter(|_| !given && mechanism.joint(joint).freedom() > 0) {
            positions.push((joint, values));
            free.insert(joint);
        }
    }
    positions.sort_by_key(|(joint, _)| *joint);
    Configuration {
        name: wanted.name.clone(),
        positions,
        free,
    }
}

/// The poses of all joints where one has been driven to a value, others that have theirs held.
fn driven_to(
    (mechanism, at): (&Mechanism, Option<&str>),
    (joint, value): (JointId, &Number),
    held: &[JointId],
) -> Result<Vec<JointState<f64>>, NotReached> {
    let failed = |why: String| NotReached { joint, why };
    let options = AnalysisOptions {
        configuration: at.map(str::to_owned),
        depth: Depth::Motions,
        ..AnalysisOptions::default()
    };
    let analysis = analyse(mechanism, &options).map_err(|error| failed(error.to_string()))?;
    let mechanism = analysis.of(mechanism);
    let name = |joint: &JointId| mechanism.joint(*joint).name.clone();
    let here = &analysis.assembly.states[joint.0].values;
    let value = value.value();
    if here
        .first()
        .is_some_and(|here| (here - value).abs() <= THERE)
    {
        return Ok(analysis.assembly.states.clone());
    }
    let options = TraceOptions {
        drive: Some(name(&joint)),
        hold: held.iter().map(name).collect(),
        samples: 2,
        configuration: at.map(str::to_owned),
        ..TraceOptions::default()
    };
    let traced =
        trace(mechanism, &analysis, &options).map_err(|error| failed(error.to_string()))?;
    let mut motion = match traced {
        Trace::Moving(motion) => *motion,
        Trace::Still(still) => return Err(failed(still.reason)),
    };
    let turns = mechanism.joint(joint).kind.freedoms() == [FreedomPart::Rotation];
    let whole_turns: &[f64] = if turns { &[0.0, -TAU, TAU] } else { &[0.0] };
    // Without turning back, if that leads there.
    for around in whole_turns {
        let straight = motion.curve.pose_at_drive(value + around);
        if let Some(pose) = straight {
            return Ok(motion.curve.states(&pose.pose));
        }
    }
    for around in whole_turns {
        if let Some(pose) = motion.curve.nearest_at_drive(value + around) {
            return Ok(motion.curve.states(&pose.pose));
        }
    }
    Err(failed(ends(mechanism, &motion)))
}

/// A joint that is so near its value (rad, m) has it: it is held there, and the loops follow by no more than closing takes.
const THERE: f64 = 1e-9;

/// Where the driven joint turns back or stops.
fn ends(mechanism: &Mechanism, motion: &Motion) -> String {
    let own = motion.ranges.iter();
    let mut own = own.filter(|range| range.variable == motion.driven);
    let range = own.next();
    let (low, high) = range.map_or((f64::NAN, f64::NAN), |range| (range.min, range.max));
    let limits: Vec<String> = motion
        .ends
        .iter()
        .filter_map(|end| match &end.reason {
            EndReason::JointLimit { variable, .. } => Some(format!("`{}`", variable.name)),
            _ => None,
        })
        .collect();
    let turns = motion.driven.unit(mechanism) == "rad";
    let shown = |value: f64| match turns {
        true => format!("{:.2}°", value.to_degrees()),
        false => format!("{:.2} mm", 1e3 * value),
    };
    let stopped = match limits.as_slice() {
        [] => String::new(),
        limits => format!(", where limits of {} are met", limits.join(" and ")),
    };
    format!(
        "it goes from {} to {} along the branch drawn{stopped}",
        shown(low),
        shown(high)
    )
}
