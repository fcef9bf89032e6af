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

/// Steps of a branch at which pitches are looked at before the extremes are refined.
const LOOKED_AT: usize = 200;

/// Parabolas through three pitches around an extreme, at most, each narrower than the one before; no more where its sides are lower
/// by this part only.
const PARABOLAS: usize = 12;
const NARROWER: f64 = 3.0;
const FLAT: f64 = 1e-6;

/// Halvings of a step in which the axis turns by more than 60 degrees: where it is left at the end, the motion turns back.
const HALVINGS: usize = 12;

/// Half the distance of the two poses that a pitch is taken between, in steps looked at: a secant's error goes with its
/// square, its rounding with its inverse.
const SECANT: f64 = 1e-3;

/// A link that turns this much slower than at its fastest rests nearby.
const RESTS: f64 = 1e-3;

/// One that rests and slides still, this much slower than at its fastest or less, has a pitch that goes to infinity. One that stands
/// still altogether, as at a dead centre, slides as little as it turns.
const SLIDES: f64 = 0.03;

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
    let links = [link, seen_from];
    let (first, last) = motion.curve.arclengths();
    let step = (last - first) / LOOKED_AT as f64;
    let seen = sharpened(motion, links, steps(motion, links)?)?;
    let greatest = |part: fn(&SmallScrew) -> f64| {
        let parts = seen.iter().map(|(_, screw)| part(screw).abs());
        parts.fold(0.0f64, f64::max)
    };
    let (fastest, farthest) = (greatest(|s| s.angle), greatest(SmallScrew::along));
    let (resting, seen): (Vec<_>, Vec<_>) =
        seen.iter().partition(|(_, s)| s.angle <= RESTS * fastest);
    if resting
        .iter()
        .any(|(_, s)| s.along().abs() > SLIDES * farthest)
    {
        return None;
    }
    let mut refined = |sign: f64| {
        let higher = |a: &SmallScrew, b: &SmallScrew| (sign * a.pitch).total_cmp(&(sign * b.pitch));
        let (best, _) = seen.iter().max_by(|a, b| higher(&a.1, &b.1))?;
        let mut pitch = |at: f64| Some(sign * screw(motion, at, links, step)?.pitch);
        let highest = highest(&mut pitch, *best, step)?;
        Some(sign * highest)
    };
    Some([refined(-1.0)?, refined(1.0)?])
}

/// The screws from each predicted pose to the next, by arclength: near the extremes, whose place they tell.
fn steps(motion: &Motion, links: [usize; 2]) -> Option<Vec<(f64, SmallScrew)>> {
    let (first, last) = motion.curve.arclengths();
    let step = (last - first) / LOOKED_AT as f64;
    let relative = |index: usize| {
        let arclength = (first + step * index as f64).min(last);
        let pose = motion.curve.predicted_at(arclength)?;
        Some(seen_from(&motion.curve.link_poses(&pose), links))
    };
    let poses: Vec<Rigid<f64>> = (0..=LOOKED_AT).map(relative).collect::<Option<_>>()?;
    let between = |(index, two): (usize, &[Rigid<f64>])| {
        let middle = first + step * (index as f64 + 0.5);
        (middle, small_screw(&two[1].compose(&two[0].inverse())))
    };
    Some(poses.windows(2).enumerate().map(between).collect())
}

/// More screws where the axis turns much from one to the next: where a link nearly rests, its pitch has a narrow extreme.
fn sharpened(
    motion: &mut Motion,
    links: [usize; 2],
    seen: Vec<(f64, SmallScrew)>,
) -> Option<Vec<(f64, SmallScrew)>> {
    let turns = |a: &SmallScrew, b: &SmallScrew| {
        2.0 * dot(&a.axis, &b.axis) < (dot(&a.axis, &a.axis) * dot(&b.axis, &b.axis)).sqrt()
    };
    let mut sharpened = Vec::with_capacity(seen.len());
    for next in seen {
        let mut waiting = vec![(next, 0)];
        while let Some((next, halvings)) = waiting.pop() {
            let last: Option<&(f64, SmallScrew)> = sharpened.last();
            let turned = last.filter(|last| halvings < HALVINGS && turns(&last.1, &next.1));
            let Some(&(before, _)) = turned else {
                sharpened.push(next);
                continue;
            };
            let gap = next.0 - before;
            let between = before + 0.5 * gap;
            let mut screw = screw(motion, between, links, gap)?;
            // As fast as it would be over a whole step.
            let (first, last) = motion.curve.arclengths();
            screw.angle *= (last - first) / LOOKED_AT as f64 / (2.0 * SECANT * gap);
            waiting.push((next, halvings + 1));
            waiting.push(((between, screw), halvings + 1));
        }
    }
    Some(sharpened)
}

/// The highest value around a place, by parabolas that become narrower.
fn highest(value: &mut impl FnMut(f64) -> Option<f64>, at: f64, width: f64) -> Option<f64> {
    let (mut at, mut width) = (at, width);
    let mut most = value(at)?;
    for _ in 0..PARABOLAS {
        let (centre, before) = (at, most);
        let sides = [value(centre - width)?, value(centre + width)?];
        let bend = sides[0] - 2.0 * before + sides[1];
        let vertex = 0.5 * width * (sides[0] - sides[1]) / bend;
        let mut tried = vec![(centre - width, sides[0]), (centre + width, sides[1])];
        if bend < 0.0 && vertex.abs() < width {
            tried.push((centre + vertex, value(centre + vertex)?));
        }
        for (place, found) in tried {
            if found > most {
                (at, most) = (place, found);
            }
        }
        if before - sides[0].min(sides[1]) <= FLAT * most.abs() {
            break;
        }
        width /= NARROWER;
    }
    Some(most)
}

/// A small displacement as a screw.
#[derive(Clone, Copy, Debug)]
struct SmallScrew {
    /// Of any length.
    axis: [f64; 3],
    /// rad
    angle: f64,
    /// m/rad
    pitch: f64,
}

/// The screw between two poses on both sides of an arclength, of the first link seen from the second.
fn screw(motion: &mut Motion, arclength: f64, links: [usize; 2], step: f64) -> Option<SmallScrew> {
    let (first, last) = motion.curve.arclengths();
    let half = SECANT * step;
    let middle = arclength.clamp(first + half, last - half);
    let mut relative = |arclength: f64| {
        let found = motion.curve.pose_at_arclength(arclength)?;
        Some(seen_from(&motion.curve.link_poses(&found.pose), links))
    };
    let [before, after] = [relative(middle - half)?, relative(middle + half)?];
    Some(small_screw(&after.compose(&before.inverse())))
}

/// Angle and pitch of a small displacement.
fn small_screw(displacement: &Rigid<f64>) -> SmallScrew {
    let r = &displacement.rotation;
    let axis = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
    let sine = dot(&axis, &axis).sqrt() / 2.0;
    let angle = sine.atan2((r[0][0] + r[1][1] + r[2][2] - 1.0) / 2.0);
    let along = dot(&axis, &displacement.translation) / (2.0 * sine);
    SmallScrew {
        axis,
        angle,
        pitch: along / angle,
    }
}

impl SmallScrew {
    /// The way along the axis (m).
    fn along(&self) -> f64 {
        self.angle * self.pitch
    }
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The pose of the first link seen from the second.
fn seen_from(poses: &[Rigid<f64>], links: [usize; 2]) -> Rigid<f64> {
    poses[links[1]].inverse().compose(&poses[links[0]])
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn narrow_and_broad_peaks_are_climbed() {
        for (width, peak) in [(1.0, 0.3), (1e-3, 0.01), (0.05, -0.4)] {
            // 1 / (1 + x²), as a pitch is near a pose of least rotation.
            let mut value = |x: f64| Some(1.0 / (1.0 + ((x - peak) / width).powi(2)));
            let found = highest(&mut value, 0.0, 0.5).unwrap();
            assert!((found - 1.0).abs() < 1e-6, "{width} {peak}: {found}");
        }
    }

    #[test]
    fn the_end_of_a_range_may_be_the_highest() {
        // As `screw` does it: beyond the end is the end.
        let found = highest(&mut |x: f64| Some(x.min(0.7)), 0.5, 0.5).unwrap();
        assert!((found - 0.7).abs() < 1e-12, "{found}");
    }
}
