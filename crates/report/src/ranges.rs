//! How far joints go along branches that are curves, and the pitches of screw motions over all of such a branch.
//!
//! Ranges of a branch of several degrees of freedom depend on what is held, so nothing is said of them.

use super::motions::{SEEN, screwing};
use super::schema::{JointRange, Motion as Row, Report};
use kutzbach_mobility::Analysis;
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{EndReason, Motion, Trace, TraceOptions, trace};

/// Larger mechanisms are not followed for a report; `kutzbach trace` follows any.
const VARIABLES: usize = 40;

/// No more branches are followed.
const BRANCHES: usize = 4;

/// Poses computed of a branch, each way.
const POSES: usize = 2000;

/// Follows every branch that is a curve; `first` is the motion along the first, where it was followed. Nothing here changes the
/// verdict.
pub(super) fn lay_over(
    report: &mut Report,
    mechanism: &Mechanism,
    analysis: &Analysis,
    configuration: &str,
    first: Option<Motion>,
) {
    let branches = analysis.branches.as_deref().unwrap_or_default();
    if mechanism.freedom() > VARIABLES || branches.len() > BRANCHES {
        return;
    }
    let mut first = first;
    for branch in branches.iter().filter(|branch| branch.dimension == 1) {
        let known = first.take_if(|known| known.branch == branch.name);
        let motion = known.or_else(|| {
            let options = TraceOptions {
                branch: Some(branch.name.clone()),
                samples: 2,
                poses: POSES,
                configuration: Some(configuration.to_owned()),
                ..TraceOptions::default()
            };
            match trace(mechanism, analysis, &options) {
                Ok(Trace::Moving(motion)) => Some(*motion),
                // A branch that cannot be followed has no ranges to tell.
                _ => None,
            }
        });
        if let Some(mut motion) = motion {
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
        let Some(found) = motion.pitches(moving, seen_from) else {
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
