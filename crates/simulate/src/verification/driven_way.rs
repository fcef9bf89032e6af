//! Which way a drive goes along a branch.
//!
//! The way is a stretch of the predicted motion along which one joint variable determines all others: from the start of the
//! trace to short of the next pose where the driven joint turns back, a joint meets its limit, or another branch passes.
//! At such poses a drive either cannot go on or a simulation may leave the branch, and nothing would be learnt of the
//! prediction.

use kutzbach_closure::{Geometry, JointState, Part, variable_unit};
use kutzbach_mobility::{Analysis, Branch};
use kutzbach_model::mechanism::{FreedomPart, JointKind, Mechanism};
use kutzbach_motion::{
    Curve, End, EndReason, EventKind, Motion, Trace, TraceOptions, Variable, inputs, trace,
};
use std::f64::consts::TAU;

/// A way along a branch that one driven freedom determines.
#[derive(Clone, Debug)]
pub(super) struct DrivenWay {
    /// The pose it starts from: not singular.
    pub start: Vec<JointState<f64>>,
    /// What is driven.
    pub driven: Variable,
    /// What is held: with the driven one, inputs of the branch.
    pub held: Vec<Variable>,
    /// Value of the driven variable at the start (rad, m).
    pub from: f64,
    /// And at the end.
    pub to: f64,
    /// Why it goes no farther, for people.
    pub ends: String,
    /// Whether something is seen to move: not so where all that is driven is the spin of rods between balls.
    shown: bool,
    /// Poses on the way, as predicted: a few, the first and the last one among them.
    pub poses: Vec<Vec<JointState<f64>>>,
    /// (time, value of the driven variable) along the way at a pace at which no joint goes faster than [`RATE`]; times
    /// ascend from zero.
    schedule: Vec<(f64, f64)>,
}

impl DrivenWay {
    /// Seconds that the way takes.
    pub fn duration(&self) -> f64 {
        self.schedule.last().map_or(0.0, |(time, _)| *time)
    }

    /// Where the driven variable is to be at a time, and how fast: (rad, rad/s) or (m, m/s).
    pub fn target(&self, time: f64) -> (f64, f64) {
        let after = self.schedule.partition_point(|(t, _)| *t <= time);
        if after == 0 || after >= self.schedule.len() {
            return (if after == 0 { self.from } else { self.to }, 0.0);
        }
        let ((t0, v0), (t1, v1)) = (self.schedule[after - 1], self.schedule[after]);
        let rate = (v1 - v0) / (t1 - t0);
        (v0 + rate * (time - t0), rate)
    }
}

/// The fastest joint of a way goes at this rate (rad/s, characteristic lengths per second). Inertia forces grow with its
/// square, so that a drive of limited force, and those that hold, keep their places.
pub(super) const RATE: f64 = 1.0;

/// Poses that the schedule of a way is made from.
const SCHEDULED: usize = 400;

/// One pose in so many of those is kept to be looked at by itself.
const KEPT_EVERY: usize = 40;

/// What is gone of the arclength to a pose that ends the way: the rest is where the drive has ever less leverage.
const SHARE: f64 = 0.85;

/// A way shorter than this (rad, part lengths) shows nothing.
const SHORTEST: f64 = 0.02;

/// Why a motion is not put to the test that nobody could see.
const UNSEEN: &str = "all that moves is the spin of rods about the lines through their balls: no joint and no point would show it";

/// Longest way of a freedom of a ball (rad): its rotation vector is unambiguous up to half a turn.
const BALL_WAY: f64 = 2.0;

/// Whether a variable is one of a ball's: a component of its rotation.
fn turns_a_ball(geometry: &Geometry<f64>, variable: &Variable) -> bool {
    let kind = geometry.displacements[variable.joint].kind();
    let rotations = kind
        .freedoms()
        .iter()
        .filter(|part| **part == FreedomPart::Rotation)
        .count();
    kind != JointKind::Universal
        && rotations > 1
        && kind.freedoms()[variable.freedom] == FreedomPart::Rotation
}

/// The value of a joint variable; that of a ball is its rotation since the start.
pub(super) fn value(
    geometry: &Geometry<f64>,
    variable: &Variable,
    start: &[JointState<f64>],
    states: &[JointState<f64>],
) -> f64 {
    let (joint, freedom) = (variable.joint, variable.freedom);
    if turns_a_ball(geometry, variable) {
        geometry.displacements[joint].increments(&start[joint], &states[joint])[freedom]
    } else {
        states[joint].values[freedom]
    }
}

/// The ways along a branch of a mechanism of some characteristic length (m), cut short where they would take longer (s),
/// one for each part of the mechanism that has loops and moves; one in all for mechanisms without loops. Before one is
/// traced it is asked for, by the name of what drives it where that is known; what is refused is left out.
///
/// # Errors
/// Why there is none, in words.
pub(super) fn ways_along(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    (length, longest): (f64, f64),
    analysis: &Analysis,
    branch: &Branch,
    (configuration, drive): (Option<&str>, Option<&str>),
    wanted: &mut dyn FnMut(Option<&str>) -> bool,
) -> Result<Vec<DrivenWay>, String> {
    if !wanted(drive) {
        return Ok(Vec::new());
    }
    let first = motion_of(mechanism, analysis, branch, configuration, drive)?;
    if drive.is_some() && !first.shown {
        return Err(UNSEEN.to_owned());
    }
    let mut ways = vec![way_of(mechanism, geometry, (length, longest), first)?];
    if drive.is_some() {
        return Ok(ways);
    }
    let inputs = inputs(mechanism, analysis, branch, configuration, Vec::new());
    let inputs = inputs.variables(mechanism);
    for part in &analysis.structure.parts {
        if part.joints.contains(&ways[0].driven.joint) {
            continue;
        }
        let mut inputs = inputs.iter();
        let input = inputs.find(|input| part.joints.contains(&input.joint));
        let input = input
            .cloned()
            .or_else(|| moves_most(mechanism, branch, part));
        let Some(variable) = input else { continue };
        if !wanted(Some(&variable.name)) {
            continue;
        }
        let motion = motion_of(
            mechanism,
            analysis,
            branch,
            configuration,
            Some(&variable.name),
        )?;
        ways.push(way_of(mechanism, geometry, (length, longest), motion)?);
    }
    ways.retain(|way| way.shown);
    match ways.is_empty() {
        true => Err(UNSEEN.to_owned()),
        false => Ok(ways),
    }
}

/// The variable of a part that moves most at a generic pose, by name where several do: what is driven where it is not known which
/// joints suffice.
fn moves_most(mechanism: &Mechanism, branch: &Branch, part: &Part) -> Option<Variable> {
    let offsets = mechanism.variable_offsets();
    let pose = branch.poses.first()?;
    let mut best: Option<(f64, Variable)> = None;
    for &joint in &part.joints {
        for freedom in 0..mechanism.joints()[joint].freedom() {
            let column = offsets[joint] + freedom;
            let size = pose
                .tangents
                .iter()
                .fold(0.0f64, |m, t| m.max(t[column].abs()));
            if size > 1.001 * best.as_ref().map_or(1e-9, |(most, _)| *most) {
                best = Some((size, Variable::of(mechanism, joint, freedom)));
            }
        }
    }
    best.map(|(_, variable)| variable)
}

fn motion_of(
    mechanism: &Mechanism,
    analysis: &Analysis,
    branch: &Branch,
    configuration: Option<&str>,
    drive: Option<&str>,
) -> Result<Motion, String> {
    let options = TraceOptions {
        branch: Some(branch.name.clone()),
        drive: drive.map(ToOwned::to_owned),
        configuration: configuration.map(ToOwned::to_owned),
        samples: 2,
        ..TraceOptions::default()
    };
    match trace(mechanism, analysis, &options) {
        Ok(Trace::Moving(motion)) => Ok(*motion),
        Ok(Trace::Still(still)) => Err(still.reason),
        Err(error) => Err(error.to_string()),
    }
}

/// What ends a way, at which arclength from its origin.
struct Barrier {
    origin: f64,
    arclength: f64,
    what: String,
}

/// A way to one side, as far as it was looked at.
struct Side {
    to: f64,
    ends: String,
    poses: Vec<Vec<JointState<f64>>>,
    schedule: Vec<(f64, f64)>,
}

fn way_of(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    (length, longest): (f64, f64),
    mut motion: Motion,
) -> Result<DrivenWay, String> {
    let shown = motion.shown;
    let nothing = "no pose of the branch is found";
    let least = least_margin(&motion.curve);
    let origin = origin(&motion.curve, least);
    let start = states_at(&mut motion.curve, origin).ok_or(nothing)?;
    let driven = motion.driven.clone();
    let from = value(geometry, &driven, &start, &start);
    let units = units(mechanism, length);
    let part = mechanism.joints()[driven.joint].kind.freedoms()[driven.freedom];
    let slides = part == FreedomPart::Translation;
    let mut best: Option<Side> = None;
    for side in [1.0, -1.0] {
        let barrier = barrier(&motion, origin, least, side);
        let found = side_of(
            geometry,
            (&units, longest),
            &start,
            (&driven, slides),
            &mut motion.curve,
            &barrier,
        );
        if best
            .as_ref()
            .is_none_or(|other| (found.to - from).abs() > 1.001 * (other.to - from).abs())
        {
            best = Some(found);
        }
    }
    let unit = variable_unit(part, length);
    match best {
        Some(best) if (best.to - from).abs() > SHORTEST * unit => Ok(DrivenWay {
            start,
            driven,
            held: motion.held.into_iter().map(|h| h.variable).collect(),
            from,
            to: best.to,
            ends: best.ends,
            shown,
            poses: best.poses,
            schedule: best.schedule,
        }),
        _ => Err(format!(
            "no stretch of the branch is long enough to drive `{}` along",
            driven.name
        )),
    }
}

/// Radians or characteristic lengths per unit of every joint variable, joint by joint.
fn units(mechanism: &Mechanism, length: f64) -> Vec<Vec<f64>> {
    mechanism
        .joints()
        .iter()
        .map(|joint| {
            joint
                .kind
                .freedoms()
                .iter()
                .map(|part| 1.0 / variable_unit(*part, length))
                .collect()
        })
        .collect()
}

/// Follows the curve to one side until the barrier, a full turn, or the time is over; a slide as many characteristic lengths.
fn side_of(
    geometry: &Geometry<f64>,
    (units, longest): (&[Vec<f64>], f64),
    start: &[JointState<f64>],
    (driven, slides): (&Variable, bool),
    curve: &mut Curve,
    barrier: &Barrier,
) -> Side {
    let from = value(geometry, driven, start, start);
    let (most, turn) = if turns_a_ball(geometry, driven) {
        (BALL_WAY, "as far as a ball is driven")
    } else if slides {
        let unit = units[driven.joint][driven.freedom];
        (TAU / unit, "as far as a slide is driven")
    } else {
        (TAU, "a full turn")
    };
    let mut found = Side {
        to: from,
        ends: barrier.what.clone(),
        poses: vec![start.to_vec()],
        schedule: vec![(0.0, from)],
    };
    let mut before = start.to_vec();
    let mut time = 0.0;
    for step in 1..=SCHEDULED {
        let arclength = barrier.origin + barrier.arclength * step as f64 / SCHEDULED as f64;
        let Some(states) = states_at(curve, arclength) else {
            found.ends = "short of where the branch is followed to".to_owned();
            break;
        };
        let mut fastest: f64 = 0.0;
        for (joint, units) in units.iter().enumerate() {
            let displacement = &geometry.displacements[joint];
            let increments = displacement.increments(&before[joint], &states[joint]);
            for (increment, unit) in increments.iter().zip(units) {
                fastest = fastest.max((increment * unit).abs());
            }
        }
        let to = value(geometry, driven, start, &states);
        if (to - from).abs() > 1.0001 * most {
            found.ends = turn.to_owned();
            break;
        }
        time += fastest / RATE;
        if time > longest {
            found.ends = "far enough".to_owned();
            break;
        }
        if fastest > 0.0 {
            found.schedule.push((time, to));
            found.to = to;
        }
        if step % KEPT_EVERY == 0 {
            found.poses.push(states.clone());
        }
        before = states;
    }
    found.poses.push(before);
    found
}

/// Poses whose margin is below this share of the curve's median are kept away from: the same closure error leaves the
/// simulated pose so many times as far off, and finer substeps are needed before the order shows.
const WELL_CONDITIONED: f64 = 0.15;

/// The margin that a pose of the way has to have.
fn least_margin(curve: &Curve) -> f64 {
    let mut margins: Vec<f64> = curve.margins().map(|(_, margin)| margin).collect();
    margins.sort_by(f64::total_cmp);
    margins.get(margins.len() / 2).copied().unwrap_or(0.0) * WELL_CONDITIONED
}

/// Where a way starts: where the trace does, unless that pose is ill-conditioned; then where the margin is greatest.
fn origin(curve: &Curve, least: f64) -> f64 {
    let near = curve
        .margins()
        .min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    if near.is_none_or(|(_, margin)| margin >= least) {
        return 0.0;
    }
    curve
        .margins()
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0.0, |(arclength, _)| arclength)
}

/// The first pose on one side of an origin that a drive should not reach; arclengths are counted from the origin.
fn barrier(motion: &Motion, origin: f64, least_margin: f64, side: f64) -> Barrier {
    let (first, last) = motion.curve.arclengths();
    let mut nearest = if let Some(around) = motion.closed {
        Barrier {
            origin,
            arclength: side * around,
            what: "once around".to_owned(),
        }
    } else {
        let arclength = if side > 0.0 { last } else { first };
        let end = motion
            .ends
            .iter()
            .min_by(|a, b| {
                let off = |end: &End| (end.arclength - arclength).abs();
                off(a).total_cmp(&off(b))
            })
            .map(|end| &end.reason);
        let arclength = arclength - origin;
        match end {
            Some(EndReason::GoesOn) => Barrier {
                origin,
                arclength,
                what: "far enough".to_owned(),
            },
            Some(EndReason::JointLimit { variable, .. }) => Barrier {
                origin,
                arclength: SHARE * arclength,
                what: format!("short of the limit of `{}`", variable.name),
            },
            Some(EndReason::CannotGoOn) | None => Barrier {
                origin,
                arclength: SHARE * arclength,
                what: "short of where the branch is followed to".to_owned(),
            },
        }
    };
    let around = motion.closed.unwrap_or(0.0);
    let mut meet = |arclength: f64, share: f64, what: &str| {
        // On a closed curve what is met lies ahead both ways.
        for arclength in [arclength, arclength - around, arclength + around] {
            let ahead = (arclength - origin) * side;
            if ahead > 0.0 && share * ahead < nearest.arclength * side {
                nearest = Barrier {
                    origin,
                    arclength: share * (arclength - origin),
                    what: what.to_owned(),
                };
            }
        }
    };
    for event in &motion.events {
        let what = match &event.kind {
            EventKind::DeadCentre { variable, .. } if *variable == motion.driven => {
                format!("short of a dead centre of `{}`", variable.name)
            }
            EventKind::DeadCentre { .. } => continue,
            EventKind::JointLimit { variable, .. } => {
                format!("short of the limit of `{}`", variable.name)
            }
            EventKind::Singular { .. } => "short of a singular pose".to_owned(),
            EventKind::Cusp { .. } => "short of a cusp".to_owned(),
        };
        meet(event.arclength, SHARE, &what);
    }
    for (arclength, margin) in motion.curve.margins() {
        if margin < least_margin {
            meet(
                arclength,
                1.0,
                "short of where the equations are ill-conditioned",
            );
        }
    }
    nearest
}

fn states_at(curve: &mut Curve, arclength: f64) -> Option<Vec<JointState<f64>>> {
    let found = curve.pose_at_arclength(arclength)?;
    Some(curve.states(&found.pose))
}
