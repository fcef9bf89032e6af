//! Motions of parts of many loops.
use crate::support;

use kutzbach::families::{miura_sheet, scissor_lift};
use kutzbach::mechanism::{JointKind, Mechanism};
use kutzbach::motion::{Motion, TraceOptions, trace};
use support::analysis;

fn driven(mechanism: &Mechanism, joint: &str, range: (f64, f64), samples: usize) -> Motion {
    let options = TraceOptions {
        drive: Some(joint.to_owned()),
        range: Some(range),
        samples,
        ..TraceOptions::default()
    };
    trace(mechanism, &analysis(mechanism), &options)
        .unwrap()
        .into_motion()
        .unwrap()
}

#[test]
fn a_scissor_lift_of_forty_stages_rises_as_its_bars_turn() {
    let stages = 40;
    let lift = scissor_lift(stages).unwrap();
    // Bars of two metres, drawn at the angle of the 3-4-5 triangle.
    let home = 0.6f64.atan2(0.8);
    let motion = driven(&lift, "lower_pin", (-0.3, 0.4), 15);
    assert_eq!((motion.samples.len(), motion.unreached.len()), (15, 0));
    assert!(
        motion.largest_closure <= 1e-12,
        "{:e}",
        motion.largest_closure
    );
    let platform = lift.link_named("platform").unwrap().0;
    for sample in &motion.samples {
        let height = 2.0 * stages as f64 * (home + sample.drive).sin();
        let found = &sample.links[platform];
        assert!(
            (found.translation[1] - height).abs() < 1e-9,
            "{}",
            sample.drive
        );
        assert!(found.rotation_vector().iter().all(|x| x.abs() < 1e-10));
    }
}

#[test]
fn a_miura_sheet_folds_alike_everywhere() {
    let sheet = miura_sheet(5, 4).unwrap();
    let motion = driven(&sheet, "along_1_0", (-0.2, 0.3), 11);
    assert_eq!((motion.samples.len(), motion.unreached.len()), (11, 0));
    assert!(
        motion.largest_closure <= 1e-12,
        "{:e}",
        motion.largest_closure
    );
    // Creases of one family turn by the same angle, to and fro.
    let names: Vec<&str> = sheet.joints().iter().map(|j| j.name.as_str()).collect();
    for sample in &motion.samples {
        for (name, value) in names.iter().zip(&sample.values) {
            if name.starts_with("along_") {
                assert!(
                    (value.abs() - sample.drive.abs()).abs() < 1e-10,
                    "{name}: {value} at {}",
                    sample.drive
                );
            }
        }
    }
}

/// Where all bars lie almost flat, the equations hardly see how they turn together. There, too, all turn alike: every pose, of many in a
/// segment, is as near the true one as rounding and the least singular value allow.
#[test]
fn poses_of_a_lift_that_lies_almost_flat_are_as_near_as_the_least_singular_value_allows() {
    let lift = scissor_lift(60).unwrap();
    let home = 0.6f64.atan2(0.8);
    let joints = lift.joints().iter().enumerate();
    let hinges: Vec<usize> = joints
        .filter(|(_, joint)| joint.kind == JointKind::Revolute)
        .map(|(at, _)| at)
        .collect();
    // Many poses on the way, and some of the stretch that is passed without solving for them.
    for (from, to, samples) in [(0.3, 0.15, 400), (0.08, 0.02, 6)] {
        let motion = driven(&lift, "lower_pin", (from - home, to - home), samples);
        assert_eq!((motion.samples.len(), motion.unreached.len()), (samples, 0));
        let margins: Vec<(f64, f64)> = motion.curve.margins().collect();
        for sample in &motion.samples {
            let after = margins.partition_point(|(arc, _)| *arc <= sample.arclength);
            let beside = [after.saturating_sub(1), after.min(margins.len() - 1)];
            let [before, after] = beside.map(|at| margins[at].1);
            let margin = before.min(after);
            assert!(margin < 0.05, "{margin}: nowhere near");
            let unknowns = sample.values.len() as f64;
            let allowed = 8.0 * unknowns.sqrt() * f64::EPSILON / margin;
            for &hinge in &hinges {
                // Bars turn by the driven angle, against one another by twice as much.
                let turns = (sample.values[hinge] / sample.drive).round();
                assert!(turns.abs() == 1.0 || turns.abs() == 2.0, "{turns}");
                let off = (sample.values[hinge] - turns * sample.drive).abs();
                assert!(off <= allowed, "{off:e} at {}, {allowed:e}", sample.drive);
            }
        }
    }
}

/// Polynomials are kept from pose to pose: what is asked for before must not show.
#[test]
fn a_pose_is_the_same_whatever_was_asked_for_before() {
    for (mechanism, poses) in [
        (scissor_lift(40).unwrap(), 300),
        (scissor_lift(2).unwrap(), 3000),
    ] {
        let analysis = analysis(&mechanism);
        let options = TraceOptions {
            samples: 2,
            ..TraceOptions::default()
        };
        let motion = trace(&mechanism, &analysis, &options).unwrap();
        let mut curve = motion.into_motion().unwrap().curve;
        let fresh = curve.clone();
        let (first, last) = curve.arclengths();
        for index in 0..poses {
            let arclength = first + (last - first) * (index as f64 + 0.3) / poses as f64;
            let next = curve.pose_at_arclength(arclength).unwrap();
            assert!(next.closure < 3e-14, "{:e}", next.closure);
            if index % 7 != 0 {
                continue;
            }
            let alone = fresh.clone().pose_at_arclength(arclength).unwrap();
            let pairs = next.pose.values.iter().zip(&alone.pose.values);
            let apart = pairs.fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
            assert!(apart < 1e-11, "{arclength}: {apart:e}");
        }
    }
}
