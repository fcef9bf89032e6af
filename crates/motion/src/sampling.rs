//! Samples of a curve: equidistant in the driven variable where that singles out a pose, otherwise in arclength.

use super::curve::{Curve, CurvePose};
use super::result::{End, EndReason, Sample, Spacing, TraceOptions, Unreached};
use kutzbach_math::interruption;

pub(super) struct Sampled {
    pub spacing: Spacing,
    pub samples: Vec<Sample>,
    pub unreached: Vec<Unreached>,
}

fn tell(curve: &Curve, found: CurvePose) -> Sample {
    Sample {
        arclength: found.arclength,
        drive: found.pose.values[curve.drive],
        values: curve.values(&found.pose),
        links: curve.link_poses(&found.pose),
        closure: found.closure,
    }
}

/// The numbers of the samples, as long as the work is not asked to end.
fn places(options: &TraceOptions) -> impl Iterator<Item = usize> {
    (0..options.samples).take_while(|_| !interruption::asked())
}

pub(super) fn sample(curve: &mut Curve, options: &TraceOptions, ends: &[End]) -> Sampled {
    let (low, high) = curve.drive_range();
    let last = (options.samples - 1) as f64;
    let mut unreached = Vec::new();
    let mut samples = Vec::new();
    if let Some((from, to)) = options.range {
        for index in places(options) {
            let value = from + (to - from) * (index as f64 / last);
            if let Some(found) = curve.pose_at_drive(value) {
                samples.push(tell(curve, found));
            }
        }
        for (wanted, reached, up) in [(from.min(to), low, false), (from.max(to), high, true)] {
            let missed = if up {
                wanted > reached + 1e-12
            } else {
                wanted < reached - 1e-12
            };
            if missed {
                unreached.push(Unreached {
                    wanted,
                    reached,
                    reason: why(curve, ends, reached),
                });
            }
        }
        return Sampled {
            spacing: Spacing::Drive,
            samples,
            unreached,
        };
    }
    let (first, end) = curve.arclengths();
    let (a, b) = (curve.milestones.first(), curve.milestones.last());
    let (from, to) = curve.stretch();
    let monotone = from == 0 && to + 1 == curve.milestones.len() && to > 0;
    if let (Some(a), Some(b), true) = (a.copied(), b.copied(), monotone) {
        for index in places(options) {
            let value = a.1 + (b.1 - a.1) * (index as f64 / last);
            let found = if index + 1 == options.samples {
                curve.pose_at_arclength(end)
            } else {
                curve.pose_at_drive(value)
            };
            samples.extend(found.map(|f| tell(curve, f)));
        }
        return Sampled {
            spacing: Spacing::Drive,
            samples,
            unreached,
        };
    }
    for index in places(options) {
        let arc = first + (end - first) * (index as f64 / last);
        let found = curve.pose_at_arclength(arc);
        samples.extend(found.map(|f| tell(curve, f)));
    }
    Sampled {
        spacing: Spacing::Arclength,
        samples,
        unreached,
    }
}

/// Why the driven variable goes no farther than a value.
fn why(curve: &Curve, ends: &[End], reached: f64) -> String {
    let end = ends
        .iter()
        .filter(|e| (e.drive - reached).abs() < 1e-9)
        .map(|e| match &e.reason {
            EndReason::JointLimit { variable, value } => {
                format!("joint limit {value} of `{}`", variable.name)
            }
            EndReason::GoesOn => "followed far enough: the motion goes on".to_owned(),
            EndReason::CannotGoOn => "no pose is found beyond".to_owned(),
        })
        .next();
    let _ = curve;
    end.unwrap_or_else(|| {
        format!("dead centre: the driven joint turns back at {reached}, beyond it the loops cannot close")
    })
}
