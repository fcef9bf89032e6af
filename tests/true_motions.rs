//! Every row about how a link moves, held against displacements of the link along traced curves, by code of its own.
//!
//! A row that names a subgroup has to hold every displacement from pose to pose of every curve; one that says that an axis moves
//! or that a link screws has to be seen doing so. Rounded files are held to what their rounding leaves open.

use crate::support;

use kutzbach::group::{DisplacementSubgroup as G, Pose, Twist};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, Branch, RelativeMotion, analyse};
use kutzbach::motion::{TraceOptions, trace};
use nalgebra::{DMatrix, Matrix3, Vector3};
use support::rewrite::Draft;
use support::{KNOWN_OWN, KNOWN_ZOO, assert_none, decimal, in_parallel, sample, whole};

/// Curves traced on every branch, each driven by another joint.
const CURVES: usize = 5;

/// Poses of every curve.
const SAMPLES: usize = 48;

/// What is taken for none: of exact files, and of those with four decimals, in radians and mechanism sizes.
const NONE: [f64; 2] = [1e-6, 2e-2];

/// How far curves are followed (rad): beside singular poses, rounding is magnified without bound.
const REACH: [f64; 2] = [6.0, 1.0];

/// Poses of every link of one curve.
type Curve = Vec<Vec<Pose>>;

fn curves(mechanism: &Mechanism, analysis: &Analysis, branch: &Branch, reach: f64) -> Vec<Curve> {
    let free = |index: &usize| {
        let joint = &mechanism.joints()[*index];
        joint.freedom() == 1 && branch.roles[*index].locked != Some(true)
    };
    let joints: Vec<usize> = (0..mechanism.joints().len()).filter(free).collect();
    let step = match branch.dimension {
        1 => joints.len().max(1),
        _ => joints.len().div_ceil(CURVES).max(1),
    };
    let drives = joints.iter().step_by(step).map(|joint| Some(*joint));
    let mut found = Vec::new();
    for drive in std::iter::once(None).chain(drives) {
        let options = TraceOptions {
            branch: Some(branch.name.clone()),
            drive: drive.map(|joint| mechanism.joints()[joint].name.clone()),
            samples: SAMPLES,
            reach,
            poses: 400,
            ..TraceOptions::default()
        };
        let Ok(traced) = trace(mechanism, analysis, &options) else {
            continue;
        };
        let Some(motion) = traced.into_motion() else {
            continue;
        };
        let samples = motion.samples.iter().map(|sample| {
            let links = sample.links.iter();
            links
                .map(|link| {
                    let rotation = Matrix3::from_fn(|i, j| link.rotation[i][j]);
                    Pose::new(rotation, link.translation.into())
                })
                .collect()
        });
        found.push(samples.collect());
    }
    found
}

/// The distance of a displacement from a subgroup, in radians and sizes.
fn outside(subgroup: &G, moved: &Pose, size: f64) -> f64 {
    let (turn, way) = (&moved.rotation, &moved.translation);
    let turned = (turn - Matrix3::identity()).norm();
    let keeps = |d: &Vector3<f64>| (turn * d - d).norm();
    let shift = |p: &Vector3<f64>| moved.transform_point(p) - p;
    // Signed angle about a direction that is kept.
    let angle = |d: &Vector3<f64>| {
        let skew = Vector3::new(
            turn[(2, 1)] - turn[(1, 2)],
            turn[(0, 2)] - turn[(2, 0)],
            turn[(1, 0)] - turn[(0, 1)],
        );
        (0.5 * skew.dot(d)).atan2(0.5 * (turn.trace() - 1.0))
    };
    let lead = |along: f64, pitch: f64, angle: f64| {
        let whole = std::f64::consts::TAU * pitch.abs();
        let left = (along - pitch * angle).rem_euclid(whole);
        left.min(whole - left)
    };
    match subgroup {
        G::Identity => turned.max(way.norm() / size),
        G::Rotation { axis } => keeps(&axis.direction).max(shift(&axis.point).norm() / size),
        G::Translation { direction } => turned.max(way.cross(direction).norm() / size),
        G::Helical { axis, pitch } => {
            let (d, way) = (&axis.direction, shift(&axis.point));
            let along = lead(way.dot(d), *pitch, angle(d)) / size;
            keeps(d).max(way.cross(d).norm() / size).max(along)
        }
        G::Cylindrical { axis } => {
            let d = &axis.direction;
            keeps(d).max(shift(&axis.point).cross(d).norm() / size)
        }
        G::PlanarTranslation { normal } => turned.max(way.dot(normal).abs() / size),
        G::Spherical { centre } => shift(centre).norm() / size,
        G::Planar { normal } => keeps(normal).max(way.dot(normal).abs() / size),
        G::SpatialTranslation => turned,
        G::TranslatingScrew { direction, pitch } => {
            let along = lead(way.dot(direction), *pitch, angle(direction)) / size;
            keeps(direction).max(along)
        }
        G::Schoenflies { direction } => keeps(direction),
        G::General => 0.0,
    }
}

fn coordinates(twist: &Twist, size: f64) -> [f64; 6] {
    let (w, v) = (twist.angular, twist.linear / size);
    [w.x, w.y, w.z, v.x, v.y, v.z]
}

/// How many independent directions displacements have.
fn rank(columns: &[[f64; 6]], least: f64) -> usize {
    if columns.is_empty() {
        return 0;
    }
    let matrix = DMatrix::from_fn(6, columns.len(), |i, j| columns[j][i]);
    let values = matrix.svd(false, false).singular_values;
    values.iter().filter(|value| **value > least).count()
}

/// Everything wrong with one row.
fn faults(
    motion: &RelativeMotion,
    dimension: usize,
    curves: &[Curve],
    size: f64,
    [none, reach]: [f64; 2],
) -> Vec<String> {
    let seen = |poses: &[Pose]| poses[motion.relative_to].inverse() * poses[motion.link];
    let mut wrong = Vec::new();
    let mut logs = Vec::new();
    let mut worst: f64 = 0.0;
    let mut turned: f64 = 0.0;
    let mut pitches: Vec<f64> = Vec::new();
    for curve in curves {
        let Some(first) = curve.first() else { continue };
        let back = seen(first).inverse();
        for (poses, next) in curve
            .iter()
            .zip(curve.iter().skip(1).map(Some).chain([None]))
        {
            let moved = seen(poses) * back;
            if let Some(subgroup) = motion.class.or(motion.within) {
                worst = worst.max(outside(&subgroup, &moved, size));
            }
            let log = coordinates(&moved.log(), size);
            turned = turned.max(log[..3].iter().map(|x| x * x).sum::<f64>().sqrt());
            logs.push(log);
            if let Some(next) = next {
                let step = (seen(next) * seen(poses).inverse()).log();
                let angle = step.angular.norm();
                if angle > 1e-3 {
                    pitches.push(step.angular.dot(&step.linear) / (angle * angle));
                }
            }
        }
    }
    if worst > none {
        wrong.push(format!("leaves the subgroup by {worst:.1e}"));
    }
    let largest = logs.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    match motion.freedom {
        Some(0) if largest > none => wrong.push(format!("moves by {largest:.1e}")),
        Some(freedom) => {
            let most = rank(&logs, NONE[0] * 1e-2);
            // Where there are more, a few curves do not show all of them.
            if dimension == 1 && most < freedom && !curves.is_empty() {
                wrong.push(format!("{freedom} freedoms, of which {most} are seen"));
            }
            if freedom > dimension {
                wrong.push(format!("{freedom} freedoms on a branch of {dimension}"));
            }
        }
        None => {}
    }
    match motion.rotations {
        Some(0) if turned > none => wrong.push(format!("turns by {turned:.1e}")),
        Some(n) if n > 0 && dimension == 1 && !(turned > NONE[0]) && !curves.is_empty() => {
            wrong.push("does not turn".to_owned());
        }
        _ => {}
    }
    if motion.axes_move
        && motion.freedom == Some(1)
        && !curves.is_empty()
        && rank(&logs, NONE[0]) < 2
    {
        wrong.push("its axis does not move".to_owned());
    }
    if let (Some([least, greatest]), false) = (motion.pitches, pitches.is_empty()) {
        let seen = |f: fn(f64, f64) -> f64| pitches.iter().copied().reduce(f).unwrap_or(0.0);
        let (from, to) = (seen(f64::min), seen(f64::max));
        // Between two samples the pitch is that of neither.
        let slack = none * size + 0.1 * (to - from) + 1e-3 * size;
        if (least, greatest) == (0.0, 0.0) && from.abs().max(to.abs()) > slack {
            wrong.push(format!("screws with pitch {from:.3} to {to:.3}"));
        }
        // Curves that are followed a little way only do not come to all poses of the branch.
        let whole = reach >= REACH[0];
        if whole && dimension == 1 && (least < from - slack || greatest > to + slack) {
            wrong.push(format!(
                "pitch {least:.3} to {greatest:.3}, seen {from:.3} to {to:.3}"
            ));
        }
    }
    wrong
}

/// Whether a row leaves anything open.
fn is_open(motion: &RelativeMotion) -> bool {
    let Some(freedom) = motion.freedom else {
        return true;
    };
    let known = motion.class.is_some() || motion.axes_move;
    let screws = (freedom, motion.rotations) == (1, Some(1))
        && motion.within.is_none_or(|within| within == G::General);
    !known || motion.rotations.is_none() || screws && motion.pitches.is_none()
}

/// Rows, rows left open, and what is wrong.
type Found = (usize, Vec<String>, Vec<String>);

fn checked(
    name: &str,
    mechanism: &Mechanism,
    analysis: &Analysis,
    [none, reach]: [f64; 2],
) -> Found {
    let (mut rows, mut open, mut wrong) = (0, Vec::new(), Vec::new());
    for branch in analysis.branches.iter().flatten() {
        let curves = curves(mechanism, analysis, branch, reach);
        let size = curves
            .iter()
            .flatten()
            .flatten()
            .map(|pose| pose.translation.norm())
            .fold(1e-3, f64::max);
        for motion in &branch.motions {
            rows += 1;
            let link = &mechanism.links()[motion.link].name;
            if is_open(motion) {
                open.push(format!("{name} {} {link}: {motion:?}", branch.name));
            }
            let faults = faults(motion, branch.dimension, &curves, size, [none, reach]);
            wrong.extend(
                faults
                    .iter()
                    .map(|fault| format!("{name} {} {link}: {fault}; {motion:?}", branch.name)),
            );
        }
        let links = mechanism.links().len() - 1;
        if branch.motions.len() != links {
            wrong.push(format!(
                "{name} {}: {} rows of {links}",
                branch.name,
                branch.motions.len()
            ));
        }
    }
    (rows, open, wrong)
}

fn all(found: Vec<Found>, most_open: f64) {
    let rows: usize = found.iter().map(|found| found.0).sum();
    let open: Vec<String> = found.iter().flat_map(|found| found.1.clone()).collect();
    let wrong: Vec<String> = found.iter().flat_map(|found| found.2.clone()).collect();
    println!("{rows} rows, {} open, {} wrong", open.len(), wrong.len());
    assert_none(&wrong);
    assert!(
        open.len() as f64 <= most_open * rows as f64,
        "{} of {rows} open:\n{}",
        open.len(),
        open.join("\n")
    );
    let least = if whole() { 800 } else { 200 };
    assert!(rows > least, "{rows} rows");
}

#[test]
fn of_exact_files() {
    let known = sample(KNOWN_ZOO.iter().chain(KNOWN_OWN.iter()), 3);
    let found = in_parallel(&known, |(name, mechanism, analysis)| {
        checked(name, mechanism, analysis, [NONE[0], REACH[0]])
    });
    // Measured: 30 of 1473 in all.
    all(found, if whole() { 0.021 } else { 0.04 });
}

#[test]
fn of_files_with_four_decimals() {
    let known = sample(KNOWN_ZOO.iter().chain(KNOWN_OWN.iter()), 3);
    let found = in_parallel(&known, |(name, mechanism, _)| {
        let draft = Draft::of(mechanism).each_number(&|number| decimal::rounded(number, 4));
        let rounded = draft.build();
        match analyse(&rounded, &Default::default()) {
            // What is told of a mechanism that is meant is held against that one.
            Ok(analysis) => checked(name, analysis.of(&rounded), &analysis, [NONE[1], REACH[1]]),
            Err(_) => (0, Vec::new(), Vec::new()),
        }
    });
    // Measured: 231 of 1018 in all.
    all(found, if whole() { 0.24 } else { 0.16 });
}
