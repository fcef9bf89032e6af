//! How far joints go along branches that are curves, and the pitches of screw motions over all of such a branch.
//!
//! Ranges of a branch of several degrees of freedom depend on what is held, so nothing is said of them.

use super::motions::{SEEN, screwing};
use super::schema::{JointRange, Motion as Row, Report};
use kutzbach_closure::Rigid;
use kutzbach_mobility::Analysis;
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{EndReason, Motion, Trace, TraceOptions, trace};

/// Larger mechanisms are not followed for a report; `kutzbach trace` follows any.
const VARIABLES: usize = 40;

/// No more branches are followed.
const BRANCHES: usize = 4;

/// Poses computed of a branch, each way.
const POSES: usize = 2000;

/// Poses of a branch at which pitches are looked at before the extremes are refined.
const LOOKED_AT: usize = 200;

/// Halvings of the interval around an extreme: each step between two poses looked at shrinks to a 4000th.
const HALVINGS: usize = 12;

/// Half the distance of the two poses that a pitch is taken between, in steps of [`LOOKED_AT`]: a secant's error goes with its
/// square, its rounding with its inverse.
const SECANT: f64 = 1e-3;

/// Where a link turns this much slower than at its fastest, its pitch goes to infinity nearby.
const RESTS: f64 = 1e-3;

/// Follows every branch that is a curve. Nothing here changes the verdict.
pub(super) fn lay_over(
    report: &mut Report,
    mechanism: &Mechanism,
    analysis: &Analysis,
    configuration: &str,
) {
    let branches = analysis.branches.as_deref().unwrap_or_default();
    if mechanism.freedom() > VARIABLES || branches.len() > BRANCHES {
        return;
    }
    for branch in branches.iter().filter(|branch| branch.dimension == 1) {
        let options = TraceOptions {
            branch: Some(branch.name.clone()),
            samples: 2,
            poses: POSES,
            configuration: Some(configuration.to_owned()),
            ..TraceOptions::default()
        };
        // A branch that cannot be followed has no ranges to tell.
        if let Ok(Trace::Moving(mut motion)) = trace(mechanism, analysis, &options) {
            joints(report, mechanism, &motion);
            pitches(report, mechanism, &mut motion);
        }
    }
}

/// Lays the ranges of the joints over the report.
fn joints(report: &mut Report, mechanism: &Mechanism, motion: &Motion) {
    let endless = endless(motion);
    for range in motion.ranges.iter().filter(|range| range.moves) {
        let joint = &mechanism.joints()[range.variable.joint];
        let part = range.variable.name.strip_prefix(joint.name.as_str());
        let part = part.and_then(|rest| rest.strip_prefix('.'));
        if let Some(row) = report.joints.iter_mut().find(|row| row.name == joint.name) {
            row.ranges.push(JointRange {
                branch: motion.branch.clone(),
                part: part.map(str::to_owned),
                min: range.min,
                max: range.max,
                turns: range.turns,
                angle: range.variable.unit(mechanism) == "rad",
                at_least: endless,
            });
        }
    }
}

/// Whether the motion goes on beyond what was followed.
fn endless(motion: &Motion) -> bool {
    let mut ends = motion.ends.iter();
    ends.any(|end| end.reason == EndReason::GoesOn)
}

/// Replaces the pitches seen at some poses by those of the whole branch.
fn pitches(report: &mut Report, mechanism: &Mechanism, motion: &mut Motion) {
    if endless(motion) {
        return;
    }
    let link = |name: &str| mechanism.links().iter().position(|link| link.name == name);
    let branch = motion.branch.clone();
    for row in report.motions.iter_mut().filter(|row| screws(row, &branch)) {
        let (Some(moving), Some(seen_from)) = (link(&row.link), link(&row.relative_to)) else {
            continue;
        };
        let Some(found) = extremes(motion, moving, seen_from) else {
            continue;
        };
        let looked_at = screwing(row.pitches, SEEN);
        row.pitches = Some(found);
        row.whole_branch = true;
        if row.text == looked_at {
            row.text = screwing(row.pitches, "");
        }
    }
}

/// Whether a row tells of a link that screws along this branch.
fn screws(row: &Row, branch: &str) -> bool {
    let slides = row.pitches.is_some_and(|pitches| pitches != [0.0, 0.0]);
    row.branch == branch && slides
}

/// Least and greatest pitch along a curve; `None` where it goes to infinity or a pose is missing.
fn extremes(motion: &mut Motion, link: usize, seen_from: usize) -> Option<[f64; 2]> {
    let mut seen = Vec::with_capacity(LOOKED_AT + 1);
    let (first, last) = motion.curve.arclengths();
    let step = (last - first) / LOOKED_AT as f64;
    for index in 0..=LOOKED_AT {
        let arclength = first + step * index as f64;
        seen.push((arclength, screw(motion, arclength, [link, seen_from])?));
    }
    let fastest = seen.iter().fold(0.0f64, |most, (_, s)| most.max(s.angle));
    if seen.iter().any(|(_, s)| s.angle <= RESTS * fastest) {
        return None;
    }
    let mut refined = |sign: f64| {
        let (start, best) = seen
            .iter()
            .max_by(|a, b| (sign * a.1.pitch).total_cmp(&(sign * b.1.pitch)))?;
        let (mut at, mut most) = (*start, best.pitch);
        let mut width = step;
        for _ in 0..HALVINGS {
            width /= 2.0;
            for other in [at - width, at + width] {
                let found = screw(motion, other, [link, seen_from])?.pitch;
                if sign * found > sign * most {
                    (at, most) = (other, found);
                }
            }
        }
        Some(most)
    };
    Some([refined(-1.0)?, refined(1.0)?])
}

/// A small displacement as a screw.
#[derive(Clone, Copy, Debug)]
struct SmallScrew {
    /// rad
    angle: f64,
    /// m/rad
    pitch: f64,
}

/// The screw between two poses on both sides of an arclength, of the first link seen from the second.
fn screw(motion: &mut Motion, arclength: f64, links: [usize; 2]) -> Option<SmallScrew> {
    let (first, last) = motion.curve.arclengths();
    let half = SECANT * (last - first) / LOOKED_AT as f64;
    let middle = arclength.clamp(first + half, last - half);
    let mut relative = |arclength: f64| {
        let found = motion.curve.pose_at_arclength(arclength)?;
        let poses = motion.curve.link_poses(&found.pose);
        Some(poses[links[1]].inverse().compose(&poses[links[0]]))
    };
    let [before, after] = [relative(middle - half)?, relative(middle + half)?];
    Some(small_screw(&after.compose(&before.inverse())))
}

/// Angle and pitch of a small displacement.
fn small_screw(displacement: &Rigid<f64>) -> SmallScrew {
    let r = &displacement.rotation;
    let axis = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
    let dot = |a: &[f64; 3], b: &[f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let sine = dot(&axis, &axis).sqrt() / 2.0;
    let angle = sine.atan2((r[0][0] + r[1][1] + r[2][2] - 1.0) / 2.0);
    let along = dot(&axis, &displacement.translation) / (2.0 * sine);
    SmallScrew {
        angle,
        pitch: along / angle,
    }
}
