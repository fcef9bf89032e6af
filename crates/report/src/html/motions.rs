//! The predicted motions that a page plays.
//!
//! A branch of dimension one is one curve, whichever joint is driven; of one with more freedoms every choice of a driven
//! joint gives another curve, with other joints held. Curves are sampled evenly in arclength, and at everything met on the
//! way, so that a page can stop exactly there.

use kutzbach_closure::{JointState, Rigid};
use kutzbach_mobility::{Analysis, Branch};
use kutzbach_model::mechanism::{FreedomPart, JointKind, Mechanism};
use kutzbach_motion::{EndReason, Motion, Trace, TraceOptions, Variable, inputs, trace};
use kutzbach_scene::Roles;

/// Samples of a motion, at least and at most, whatever the number of links.
const SAMPLES: [usize; 2] = [24, 180];

/// Motions of a branch of several freedoms, at most.
const DRIVES: usize = 6;

/// Of large mechanisms fewer: their variables, over all motions.
const DRIVEN_VARIABLES: usize = 140;

/// Larger mechanisms are not traced for a page: nobody sees one link of so many.
const LINKS: usize = 1500;

/// Branches that are traced at most.
const BRANCHES: usize = 12;

/// How far a joint of a branch of several freedoms is followed (rad, part lengths): once around, and a little more to see
/// that it closes.
const REACH: f64 = 7.0;

/// Poses computed of such a motion each way, at least and at most: enough for once around in a mechanism of few joints, and
/// to see where it goes in one of many.
const POSES: [usize; 2] = [24, 300];

/// What they may cost, all motions of a branch together, a pose costing about the square of the number of variables.
const WORK: usize = 80_000;

/// What goes on and on is shown for two turns of a hinge, or for a slide by the part's length.
const SHOWN_TURN: f64 = 4.0 * std::f64::consts::PI;

/// Samples closer than this (parts of the whole way) cannot be told apart in single precision.
const SAME: f64 = 1e-6;

/// A pose of a curve.
#[derive(Clone, Debug)]
pub(super) struct Pose {
    pub arclength: f64,
    pub values: Vec<f64>,
    pub states: Vec<JointState<f64>>,
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

/// Traces every branch. `link_poses`: how many poses of links there may be, all motions together.
pub(super) fn repertoire(
    mechanism: &Mechanism,
    analysis: &Analysis,
    configuration: Option<&str>,
    link_poses: usize,
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
    let links = mechanism.links().len().max(1);
    if links > LINKS {
        repertoire.nothing = Some(format!(
            "not shown: a page plays up to {LINKS} links, this mechanism has {links}; `kutzbach trace` follows it"
        ));
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
        let options = TraceOptions {
            branch: Some(branch.name.clone()),
            ..options.clone()
        };
        let mut still = None;
        for options in ways(mechanism, analysis, branch, &options) {
            match trace(mechanism, analysis, &options) {
                Ok(Trace::Moving(motion)) => found.push((index, *motion)),
                Ok(Trace::Still(why)) => still = still.or(Some(why.reason)),
                Err(error) => still = still.or(Some(error.to_string())),
            }
        }
        // What cannot be driven is not offered, as long as something is.
        still = still.filter(|_| found.last().is_none_or(|(branch, _)| *branch != index));
        repertoire.still.push(still);
    }
    let [least, most] = SAMPLES;
    let samples = (link_poses / links / found.len().max(1)).clamp(least, most);
    for (branch, motion) in found {
        let drives = drives(mechanism, &motion);
        let driven = drives.first().map(|variable| variable.joint);
        let roles = Roles::of(mechanism, analysis, Some(&branches[branch]), driven);
        let played = play(mechanism, branch, motion, drives, roles, samples);
        // A curve of which no pose can be computed is none to show.
        match played.poses.is_empty() {
            false => repertoire.played.push(played),
            true => {
                let still = &mut repertoire.still[branch];
                still.get_or_insert_with(|| "no pose of this motion could be computed".to_owned());
            }
        }
    }
    repertoire
}

/// Whether one number says where a variable is: the turns of a ball are no inputs.
fn can_drive(mechanism: &Mechanism, variable: &Variable) -> bool {
    let kind = mechanism.joints()[variable.joint].kind;
    let freedoms = kind.freedoms();
    let turns = freedoms
        .iter()
        .filter(|f| **f == FreedomPart::Rotation)
        .count();
    turns <= 1
        || kind == JointKind::Universal
        || freedoms[variable.freedom] != FreedomPart::Rotation
}

/// What to trace of a branch: one curve, or for several freedoms one for each of some joints that are driven. Inputs
/// come first, then joints of one freedom that are not of dummy links, those at the ground, and names.
fn ways(
    mechanism: &Mechanism,
    analysis: &Analysis,
    branch: &Branch,
    options: &TraceOptions,
) -> Vec<TraceOptions> {
    let Some(pose) = branch.poses.first().filter(|_| branch.dimension > 1) else {
        return vec![options.clone()];
    };
    let configuration = options.configuration.as_deref();
    let inputs = inputs(mechanism, analysis, branch, configuration, Vec::new());
    let inputs = inputs.variables(mechanism);
    let place = |variable: &Variable| {
        let place = inputs.iter().position(|input| input == variable);
        place.unwrap_or(inputs.len())
    };
    let mut variables: Vec<((usize, usize, bool), Variable)> = Variable::all(mechanism)
        .into_iter()
        .enumerate()
        .filter(|(column, variable)| {
            let moves = pose.tangents.iter().any(|tangent| tangent[*column] != 0.0);
            moves && can_drive(mechanism, variable)
        })
        .map(|(_, variable)| {
            let joint = &mechanism.joints()[variable.joint];
            let ends = [joint.predecessor.link, joint.successor.link];
            let order = (
                place(&variable),
                variable.rank(mechanism),
                !ends.contains(&mechanism.ground()),
            );
            (order, variable)
        })
        .collect();
    variables.sort_by(|a, b| {
        let by_name = || crate::natural_order(&a.1.name, &b.1.name);
        a.0.cmp(&b.0).then_with(by_name)
    });
    let most = (DRIVEN_VARIABLES / mechanism.freedom().max(1)).clamp(1, DRIVES);
    let cost = mechanism.freedom().pow(2).max(1) * most;
    let [least_poses, most_poses] = POSES;
    let poses = (WORK / cost).clamp(least_poses, most_poses);
    if variables.is_empty() {
        return vec![options.clone()];
    }
    let drives = variables.into_iter().take(most);
    drives
        .map(|(_, variable)| TraceOptions {
            drive: Some(variable.name),
            reach: REACH,
            poses,
            ..options.clone()
        })
        .collect()
}

/// What can be driven: the input first, and on a curve any other joint that moves.
fn drives(mechanism: &Mechanism, motion: &Motion) -> Vec<Variable> {
    let mut drives = vec![motion.driven.clone()];
    if motion.dimension > 1 {
        return drives;
    }
    let moving = motion.ranges.iter().filter(|range| range.moves);
    drives.extend(
        moving
            .map(|range| range.variable.clone())
            .filter(|v| *v != motion.driven && can_drive(mechanism, v)),
    );
    drives
}

fn play(
    mechanism: &Mechanism,
    branch: usize,
    mut motion: Motion,
    drives: Vec<Variable>,
    roles: Roles,
    samples: usize,
) -> Played {
    let window = window(mechanism, &motion);
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
                states,
            });
        }
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
fn window(mechanism: &Mechanism, motion: &Motion) -> (f64, f64) {
    let (first, last) = motion.curve.arclengths();
    let goes_on = motion
        .ends
        .iter()
        .any(|end| end.reason == EndReason::GoesOn);
    if motion.closed.is_some() || !goes_on {
        return (first, last);
    }
    let unknowns = motion.curve.system().variables();
    let most: Vec<f64> = unknowns
        .iter()
        .map(
            |&(joint, freedom)| match Variable::of(mechanism, joint, freedom).unit(mechanism) {
                "m" => motion.length_unit,
                _ => SHOWN_TURN,
            },
        )
        .collect();
    let Some((_, start)) = motion
        .curve
        .poses()
        .find(|(arclength, _)| *arclength >= 0.0)
    else {
        return (first, last);
    };
    let near = |values: &[f64]| {
        let mut pairs = values.iter().zip(start).zip(&most);
        pairs.all(|((a, b), most)| (a - b).abs() <= *most)
    };
    // The last pose near the start on either side; whatever lies beyond one that is far is not shown.
    let mut shown = (0.0, 0.0);
    for (arclength, values) in motion.curve.poses() {
        match (near(values), arclength < 0.0) {
            (true, true) if shown.0 == 0.0 => shown.0 = arclength,
            (false, true) => shown.0 = 0.0,
            (true, false) => shown.1 = arclength,
            (true, true) => {}
            (false, false) => break,
        }
    }
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
