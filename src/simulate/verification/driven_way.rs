//! Which way a drive goes along a branch.
//!
//! The way is a stretch of the predicted motion along which one joint variable determines all others: from the start of the
//! trace to short of the next pose where the driven joint turns back, a joint meets its limit, or another branch passes.
//! At such poses a drive either cannot go on or a simulation may leave the branch, and nothing would be learnt of the
//! prediction.

use crate::closure::{Geometry, JointState};
use crate::mechanism::Mechanism;
use crate::mobility::{Analysis, Branch};
use crate::motion::{Curve, EndReason, EventKind, Motion, Trace, TraceOptions, Variable, trace};
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
}

/// What is gone of the arclength to a pose that ends the way: the rest is where the drive has ever less leverage.
const SHARE: f64 = 0.85;

/// A way shorter than this (rad, part lengths) shows nothing.
const SHORTEST: f64 = 0.02;

/// Longest way of a freedom of a ball (rad): its rotation vector is unambiguous up to half a turn.
const BALL_WAY: f64 = 2.0;

/// Halvings that place the end of a way.
const HALVINGS: usize = 50;

/// The value of a joint variable; that of a ball is its rotation since the start.
pub(super) fn value(
    geometry: &Geometry<f64>,
    variable: &Variable,
    start: &[JointState<f64>],
    states: &[JointState<f64>],
) -> f64 {
    let (joint, freedom) = (variable.joint, variable.freedom);
    let counted = states[joint].values.get(freedom).copied();
    counted.unwrap_or_else(|| {
        geometry.displacements[joint]
            .increments(&start[joint], &states[joint])
            .get(freedom)
            .copied()
            .unwrap_or(0.0)
    })
}

/// The ways along a branch, one for each part of the mechanism that has loops and moves; one in all for mechanisms without
/// loops.
///
/// # Errors
/// Why there is none, in words.
pub(super) fn ways_along(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    analysis: &Analysis,
    branch: &Branch,
    configuration: Option<&str>,
    drive: Option<&str>,
) -> Result<Vec<DrivenWay>, String> {
    let first = motion_of(mechanism, analysis, branch, configuration, drive)?;
    let mut ways = vec![way_of(geometry, first)?];
    if drive.is_some() {
        return Ok(ways);
    }
    let offsets = mechanism.variable_offsets();
    for part in &analysis.structure.parts {
        if part.joints.contains(&ways[0].driven.joint) {
            continue;
        }
        // The variable of the part that moves most at a generic pose, by name where several do.
        let Some(pose) = branch.poses.first() else {
            continue;
        };
        let mut best: Option<(f64, Variable)> = None;
        for &joint in &part.joints {
            for freedom in 0..mechanism.joints()[joint].freedom() {
                let column = offsets[joint] + freedom;
                let size = pose.tangents.iter().fold(0.0f64, |m, t| m.max(t[column].abs()));
                if size > 1.001 * best.as_ref().map_or(1e-9, |(most, _)| *most) {
                    best = Some((size, Variable::of(mechanism, joint, freedom)));
                }
            }
        }
        let Some((_, variable)) = best else { continue };
        let motion = motion_of(
            mechanism,
            analysis,
            branch,
            configuration,
            Some(&variable.name),
        )?;
        ways.push(way_of(geometry, motion)?);
    }
    Ok(ways)
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

/// What ends a way, and at which arclength.
struct Barrier {
    arclength: f64,
    what: String,
}

fn way_of(geometry: &Geometry<f64>, mut motion: Motion) -> Result<DrivenWay, String> {
    let start = states_at(&mut motion.curve, 0.0).ok_or("no pose of the branch is found")?;
    let driven = motion.driven.clone();
    let at = |curve: &mut Curve, arclength: f64| {
        states_at(curve, arclength).map(|states| value(geometry, &driven, &start, &states))
    };
    let from = at(&mut motion.curve, 0.0).ok_or("no pose of the branch is found")?;
    let scalar = start[driven.joint].values.get(driven.freedom).is_some();
    let mut best: Option<(f64, String)> = None;
    for side in [1.0, -1.0] {
        let barrier = barrier(&motion, side);
        let mut reach = barrier.arclength;
        let mut what = barrier.what;
        // A turn is enough, and half of one for a ball.
        let longest = if scalar { TAU } else { BALL_WAY };
        let travelled = |curve: &mut Curve, s: f64| at(curve, s).map(|v| (v - from).abs());
        if travelled(&mut motion.curve, reach).is_none_or(|t| t > longest) {
            let (mut low, mut high) = (0.0, reach);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                match travelled(&mut motion.curve, middle) {
                    Some(t) if t <= longest => low = middle,
                    _ => high = middle,
                }
            }
            reach = low;
            what = "a full turn".to_owned();
            if !scalar {
                what = "as far as a ball is driven".to_owned();
            }
        }
        let Some(to) = at(&mut motion.curve, reach) else {
            continue;
        };
        if best
            .as_ref()
            .is_none_or(|(other, _)| (to - from).abs() > 1.001 * (other - from).abs())
        {
            best = Some((to, what));
        }
    }
    match best {
        Some((to, ends)) if (to - from).abs() > SHORTEST * motion.length_unit.min(1.0) => {
            Ok(DrivenWay {
                start,
                driven,
                held: motion.held.into_iter().map(|h| h.variable).collect(),
                from,
                to,
                ends,
            })
        }
        _ => Err(format!(
            "no stretch of the branch is long enough to drive `{}` along",
            driven.name
        )),
    }
}

/// The first pose on one side that a drive should not reach.
fn barrier(motion: &Motion, side: f64) -> Barrier {
    let (first, last) = motion.curve.arclengths();
    let mut nearest = if let Some(around) = motion.closed {
        Barrier {
            arclength: side * around,
            what: "once around".to_owned(),
        }
    } else {
        let end = motion
            .ends
            .iter()
            .find(|end| end.arclength * side > 0.0 || end.arclength == 0.0 && side < 0.0);
        let arclength = if side > 0.0 { last } else { first };
        match end.map(|end| &end.reason) {
            Some(EndReason::GoesOn) => Barrier {
                arclength,
                what: "far enough".to_owned(),
            },
            Some(EndReason::JointLimit { variable, .. }) => Barrier {
                arclength: SHARE * arclength,
                what: format!("short of the limit of `{}`", variable.name),
            },
            Some(EndReason::CannotGoOn) | None => Barrier {
                arclength: SHARE * arclength,
                what: "short of where the branch is followed to".to_owned(),
            },
        }
    };
    let around = motion.closed.unwrap_or(0.0);
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
        // On a closed curve an event lies ahead both ways.
        for arclength in [event.arclength, event.arclength - around, event.arclength + around] {
            let ahead = arclength * side;
            if ahead > 0.0 && SHARE * ahead < nearest.arclength * side {
                nearest = Barrier {
                    arclength: SHARE * arclength,
                    what: what.clone(),
                };
            }
        }
    }
    nearest
}

fn states_at(curve: &mut Curve, arclength: f64) -> Option<Vec<JointState<f64>>> {
    let found = curve.pose_at_arclength(arclength)?;
    Some(curve.states(&found.pose))
}
