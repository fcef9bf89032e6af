//! The predicted motion by itself: the samples of a trace, one after another.

use super::error::RecordError;
use super::messages::{Closure, ClosureError, Level, Motion, Prediction};
use super::recorder::Recorder;
use kutzbach_closure::JointState;
use kutzbach_motion::EventKind;
use std::io::Write;

/// A unit of arclength, a radian of a joint or so, takes a second.
const PACE: f64 = 1.0;

/// What an event is called on the time line.
fn event_name(kind: &EventKind) -> String {
    match kind {
        EventKind::DeadCentre { variable, .. } => format!("dead centre of {}", variable.name),
        EventKind::JointLimit { variable, .. } => format!("limit of {}", variable.name),
        EventKind::Singular { .. } => "singular pose".to_owned(),
        EventKind::Cusp { .. } => "cusp".to_owned(),
    }
}

/// The values of every joint's variables.
#[must_use]
pub fn values_of(states: &[JointState<f64>]) -> Vec<Vec<f64>> {
    states.iter().map(|state| state.values.clone()).collect()
}

/// Records the samples of a traced motion from a time on (s), in the order of arclength; what is met between two samples is
/// told at the second. Returns the time of the last sample.
///
/// # Errors
/// The recorder's.
pub fn record_motion<W: Write>(
    recorder: &mut Recorder<'_, W>,
    motion: &kutzbach_motion::Motion,
    begins: f64,
) -> Result<f64, RecordError> {
    recorder.log(
        begins,
        Level::Info,
        &format!("predicted motion of branch {}", motion.branch),
    )?;
    let mut samples: Vec<&kutzbach_motion::Sample> = motion.samples.iter().collect();
    samples.sort_by(|a, b| a.arclength.total_cmp(&b.arclength));
    let first = samples.first().map_or(0.0, |s| s.arclength);
    let mut until = begins;
    let mut before = f64::NEG_INFINITY;
    for sample in samples {
        let time = begins + (sample.arclength - first) / PACE;
        let joints = motion.curve.by_joint(&sample.values);
        let predicted = Motion {
            joints: &joints,
            ..Motion::of_links(&sample.links)
        };
        recorder.moment(time, Some(&predicted), None)?;
        recorder.closure(
            time,
            &Closure {
                // The loop equations are not kept apart: each of the two is at most this.
                predicted: Some(ClosureError {
                    position: sample.closure * motion.length_unit,
                    angle: sample.closure,
                    relative: sample.closure,
                    joints: Vec::new(),
                }),
                simulated: None,
            },
        )?;
        let met: Vec<String> = motion
            .events
            .iter()
            .filter(|event| event.arclength > before && event.arclength <= sample.arclength)
            .map(|event| event_name(&event.kind))
            .collect();
        let event = met.join(", ");
        if !event.is_empty() {
            recorder.log(time, Level::Info, &event)?;
        }
        recorder.prediction(
            time,
            &Prediction {
                branch: motion.branch.clone(),
                parameter: sample.arclength,
                drive: motion.driven.name.clone(),
                predicted: sample.drive,
                simulated: None,
                distance: None,
                margin: None,
                event,
            },
        )?;
        before = sample.arclength;
        until = time;
    }
    Ok(until)
}
