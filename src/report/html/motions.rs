//! The predicted motions that a page plays.
//!
//! A branch of dimension one is one curve, whichever joint is driven; of one with more freedoms every choice of a driven
//! joint gives another curve, with other joints held. Curves are sampled evenly in arclength, and at everything met on the
//! way, so that a page can stop exactly there.

use crate::closure::{JointState, Rigid};
use crate::mechanism::{FreedomPart, Mechanism};
use crate::mobility::{Analysis, Branch};
use crate::motion::{EndReason, Motion, Trace, TraceOptions, Variable, trace};
use crate::record::Roles;

/// Poses of links that a page holds at most, all motions together; about 40 bytes each.
const LINK_POSES: usize = 24_000;

/// Samples of a motion, at least and at most, whatever the number of links.
const SAMPLES: [usize; 2] = [24, 240];

/// Motions of a branch of several freedoms, at most.
const DRIVES: usize = 6;

/// Branches that are traced at most.
const BRANCHES: usize = 12;

/// How far a joint of a branch of several freedoms is followed (rad, part lengths): once around, and a little more to see
/// that it closes.
const REACH: f64 = 7.0;

/// What goes on and on is shown for two turns of a hinge, or for a slide by the part's length.
const SHOWN_TURN: f64 = 4.0 * std::f64::consts::PI;

/// Poses looked at to see how far that is.
const LOOKS: usize = 256;

/// Samples closer than this (parts of the whole way) cannot be told apart in single precision.
const SAME: f64 = 1e-6;

/// A pose of a curve.
#[derive(Clone, Debug)]
pub(super) struct Pose {
    pub arclength: f64,
    pub values: Vec<f64>,
    pub links: Vec<Rigid<f64>>,
}

/// A curve with its poses.
#[derive(Debug)]
pub(super) struct Played {
    /// Index of the branch.
    pub branch: usize,
    pub motion: Motion,
    pub poses: Vec<Pose>,
    /// The pose it starts at.
    pub start: usize,
    /// Variables that can be driven; the first is.
    pub drives: Vec<Variable>,
    pub roles: Roles,
}

impl Played {
    /// The pose closest to an arclength.
    pub fn nearest(&self, arclength: f64) -> usize {
        let distance = |pose: &Pose| (pose.arclength - arclength).abs();
        let best =
            |a: &usize, b: &usize| distance(&self.poses[*a]).total_cmp(&distance(&self.poses[*b]));
        (0..self.poses.len()).min_by(best).unwrap_or(0)
    }
}

/// All that a page plays, and why branches are still.
#[derive(Debug)]
pub(super) struct Repertoire {
    pub played: Vec<Played>,
    /// By branch: why it is not shown.
    pub still: Vec<Option<String>>,
    /// Why nothing is shown at all.
    pub nothing: Option<String>,
}

/// Traces every branch.
pub(super) fn repertoire(
    mechanism: &Mechanism,
    analysis: &Analysis,
    configuration: Option<&str>,
) -> Repertoire {
    let mut repertoire = Repertoire {
        played: Vec::new(),
        still: Vec::new(),
        nothing: None,
    };
    let branches = analysis.branches.as_deref().unwrap_or_default();
    let options = TraceOptions {
        samples: 2,
        configuration: configuration.map(str::to_owned),
        ..TraceOptions::default()
    };
    if branches.is_empty() {
        repertoire.nothing = Some(match trace(mechanism, analysis, &options) {
            Ok(Trace::Still(still)) => still.reason,
            Ok(Trace::Moving(_)) => "nothing moves: no branch is known".to_owned(),
            Err(error) => error.to_string(),
        });
        return repertoire;
    }
    let mut found: Vec<(usize, Motion)> = Vec::new();
    for (index, branch) in branches.iter().enumerate() {
        if index >= BRANCHES {
            let text =
                format!("not shown: more than {BRANCHES} branches; `kutzbach trace` follows any");
            repertoire.still.push(Some(text));
            continue;
        }
        let mut options = TraceOptions {
            branch: Some(branch.name.clone()),
            ..options.clone()
        };
        if branch.dimension > 1 {
            options.reach = REACH;
        }
        match trace(mechanism, analysis, &options) {
            Ok(Trace::Moving(motion)) => {
                let others = if motion.dimension > 1 {
                    other_drives(mechanism, branch, &motion)
                } else {
                    Vec::new()
                };
                found.push((index, *motion));
                for drive in others {
                    let options = TraceOptions {
                        drive: Some(drive.name),
                        ..options.clone()
                    };
                    // What cannot be driven is not offered.
                    if let Ok(Trace::Moving(motion)) = trace(mechanism, analysis, &options) {
                        found.push((index, *motion));
                    }
                }
                repertoire.still.push(None);
            }
            Ok(Trace::Still(still)) => repertoire.still.push(Some(still.reason)),
            Err(error) => repertoire.still.push(Some(error.to_string())),
        }
    }
    let links = mechanism.links().len().max(1);
    let [least, most] = SAMPLES;
    let samples = (LINK_POSES / links / found.len().max(1)).clamp(least, most);
    for (branch, motion) in found {
        let roles = Roles::of(
            mechanism,
            analysis,
            Some(&branches[branch]),
            Some(motion.driven.joint),
        );
        repertoire
            .played
            .push(play(mechanism, branch, motion, roles, samples));
    }
    repertoire
}

/// Whether one number says where a variable is: the turns of a ball are no inputs.
fn can_drive(mechanism: &Mechanism, variable: &Variable) -> bool {
    let freedoms = mechanism.joints()[variable.joint].kind.freedoms();
    let turns = freedoms
        .iter()
        .filter(|f| **f == FreedomPart::Rotation)
        .count();
    turns <= 1 || freedoms[variable.freedom] != FreedomPart::Rotation
}

/// Other variables of a branch that can be driven: those at the ground first, then by name.
fn other_drives(mechanism: &Mechanism, branch: &Branch, motion: &Motion) -> Vec<Variable> {
    let Some(pose) = branch.poses.first() else {
        return Vec::new();
    };
    let mut others: Vec<(bool, String, Variable)> = Variable::all(mechanism)
        .into_iter()
        .enumerate()
        .filter(|(column, variable)| {
            let moves = pose.tangents.iter().any(|tangent| tangent[*column] != 0.0);
            moves && *variable != motion.driven && can_drive(mechanism, variable)
        })
        .map(|(_, variable)| {
            let joint = &mechanism.joints()[variable.joint];
            let ground =
                [joint.predecessor.link, joint.successor.link].contains(&mechanism.ground());
            (!ground, variable.name.clone(), variable)
        })
        .collect();
    others.sort_by(|a, b| {
        let by_name = || crate::report::natural_order(&a.1, &b.1);
        a.0.cmp(&b.0).then_with(by_name)
    });
    others.truncate(DRIVES - 1);
    others
        .into_iter()
        .map(|(_, _, variable)| variable)
        .collect()
}

fn play(
    mechanism: &Mechanism,
    branch: usize,
    mut motion: Motion,
    roles: Roles,
    samples: usize,
) -> Played {
    let window = window(mechanism, &mut motion);
    motion
        .events
        .retain(|event| (window.0..=window.1).contains(&event.arclength));
    let arclengths = arclengths(&motion, window, samples);
    let mut poses = Vec::with_capacity(arclengths.len());
    for arclength in arclengths {
        if let Some(found) = motion.curve.pose_at_arclength(arclength) {
            let states = motion.curve.states(&found.pose);
            poses.push(Pose {
                arclength,
                values: all_values(&states),
                links: motion.curve.link_poses(&found.pose),
            });
        }
    }
    let mut drives = vec![motion.driven.clone()];
    if motion.dimension == 1 {
        let moving = motion.ranges.iter().filter(|range| range.moves);
        drives.extend(
            moving
                .map(|range| range.variable.clone())
                .filter(|v| *v != motion.driven && can_drive(mechanism, v)),
        );
    }
    let mut played = Played {
        branch,
        motion,
        poses,
        start: 0,
        drives,
        roles,
    };
    played.start = played.nearest(0.0);
    played
}

/// The arclengths to show: all of a curve that closes or has ends; of one that goes on, as long as no joint has gone too
/// far from the start.
fn window(mechanism: &Mechanism, motion: &mut Motion) -> (f64, f64) {
    let (first, last) = motion.curve.arclengths();
    let goes_on = motion
        .ends
        .iter()
        .any(|end| end.reason == EndReason::GoesOn);
    if motion.closed.is_some() || !goes_on {
        return (first, last);
    }
    let most: Vec<f64> = Variable::all(mechanism)
        .iter()
        .map(|variable| match variable.unit(mechanism) {
            "m" => motion.length_unit,
            _ => SHOWN_TURN,
        })
        .collect();
    let curve = &mut motion.curve;
    let mut values = |arclength: f64| -> Option<Vec<f64>> {
        let found = curve.pose_at_arclength(arclength)?;
        Some(all_values(&curve.states(&found.pose)))
    };
    let Some(start) = values(0.0) else {
        return (first, last);
    };
    let mut reached = |end: f64| {
        let mut kept = 0.0;
        for look in 1..=LOOKS {
            let arclength = end * look as f64 / LOOKS as f64;
            let near = values(arclength).is_some_and(|values| {
                let pairs = values.iter().zip(&start).zip(&most);
                pairs
                    .into_iter()
                    .all(|((a, b), most)| (a - b).abs() <= *most)
            });
            if !near {
                break;
            }
            kept = arclength;
        }
        kept
    };
    let shown = (reached(first), reached(last));
    // A step of the look-out may be too long already.
    if shown.1 > shown.0 {
        shown
    } else {
        (first, last)
    }
}

fn all_values(states: &[JointState<f64>]) -> Vec<f64> {
    let values = states.iter().flat_map(|state| state.values.iter());
    values.copied().collect()
}

/// Evenly spaced, but that what is met, and the start, have samples of their own.
fn arclengths(motion: &Motion, (first, last): (f64, f64), samples: usize) -> Vec<f64> {
    let way = last - first;
    let mut own: Vec<f64> = motion.events.iter().map(|e| e.arclength).collect();
    own.extend([0.0, first, last]);
    own.retain(|arclength| (first..=last).contains(arclength));
    own.sort_by(f64::total_cmp);
    own.dedup_by(|b, a| *b - *a <= SAME * way);
    let step = way / (samples - 1) as f64;
    let mut all = own.clone();
    for index in 0..samples {
        let even = first + way * (index as f64 / (samples - 1) as f64);
        let near = own.partition_point(|arclength| *arclength < even);
        let taken = own[near.saturating_sub(1)..(near + 1).min(own.len())]
            .iter()
            .any(|arclength| (arclength - even).abs() < 0.25 * step);
        if !taken {
            all.push(even);
        }
    }
    all.sort_by(f64::total_cmp);
    all
}
