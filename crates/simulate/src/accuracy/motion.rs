//! Poses per second of a trace, by the tolerance of its samples.
//!
//! The curve is found once, to rounding. Between two of its poses a cubic predicts the pose asked for, and Newton's method
//! closes it as far as the tolerance asks; so a coarse tolerance saves steps of that method, and nothing else.

use super::clock::Patience;
use super::result::{Motion, MotionTiming, Traced, TracedTiming};
use crate::joint_gaps;
use crate::verification::{distance_between, largest_gap};
use kutzbach_closure::{Geometry, Rigid};
use kutzbach_mobility::Analysis;
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{Curve, Trace, TraceOptions, trace};
use std::hint::black_box;

/// The tolerances (rad, cycle lengths).
pub(super) const TOLERANCES: [f64; 7] = [1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14];

/// Poses along the curve, and fewer where links are many: about as many link poses.
const POSES: usize = 400;
const LINK_POSES: usize = 20_000;

/// Poses at least.
const FEWEST: usize = 40;

/// Traces a motion with every tolerance. `length` is the characteristic length (m).
pub(super) fn traced(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    analysis: &Analysis,
    options: &TraceOptions,
    length: f64,
    patience: Patience,
) -> Motion {
    let still = |why: String| Motion {
        still: Some(why),
        ..Motion::default()
    };
    let options = TraceOptions {
        samples: 2,
        tolerance: 0.0,
        ..options.clone()
    };
    let (found, timing) = patience.time(|| trace(mechanism, analysis, &options));
    let motion = match found {
        Ok(Trace::Moving(motion)) => *motion,
        Ok(Trace::Still(found)) => return still(found.reason),
        Err(error) => return still(error.to_string()),
    };
    let mut curve = motion.curve;
    let (first, last) = curve.arclengths();
    let count = (LINK_POSES / mechanism.links().len().max(1)).clamp(FEWEST, POSES);
    let place = |index: usize| first + (last - first) * (index as f64 + 0.5) / count as f64;
    let exact = poses(&mut curve, count, place);
    let rows = TOLERANCES
        .into_iter()
        .map(|tolerance| {
            curve.set_tolerance(tolerance);
            let (links, timing) = patience.time(|| poses(&mut curve, count, place));
            let mut row = Traced {
                tolerance,
                poses: links.iter().flatten().count(),
                closure_error: 0.0,
                distance: 0.0,
                timing: TracedTiming::default(),
            };
            for (links, exact) in links.iter().zip(&exact) {
                let (Some(links), Some(exact)) = (links, exact) else {
                    continue;
                };
                let gap = largest_gap(&joint_gaps(mechanism, geometry, links), length);
                let off = distance_between(mechanism, geometry, links, exact, length);
                for (most, now) in [(&mut row.closure_error, gap), (&mut row.distance, off)] {
                    *most = most.max(now);
                }
            }
            row.timing.poses_per_second = row.poses as f64 / timing.seconds.max(1e-9);
            black_box(links);
            row
        })
        .collect();
    Motion {
        still: None,
        branch: motion.branch,
        driven: motion.driven.name,
        nodes: curve.poses().count(),
        arclengths: [first, last],
        rows,
        timing: MotionTiming {
            seconds: timing.seconds,
        },
    }
}

/// Poses of all links at places along a curve; `None` where there is none, close to a singular pose.
fn poses(
    curve: &mut Curve,
    count: usize,
    place: impl Fn(usize) -> f64,
) -> Vec<Option<Vec<Rigid<f64>>>> {
    (0..count)
        .map(|index| {
            let found = curve.pose_at_arclength(place(index))?;
            Some(curve.link_poses(&found.pose))
        })
        .collect()
}
