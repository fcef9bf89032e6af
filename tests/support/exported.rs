//! A mechanism written as programs that draw write it: every link in the frame of the joint that it hangs on, every axis `0 0 1`, places
//! and angles with so many decimals.

use super::rewrite::Draft;
use kutzbach::closure::{Arithmetic, Geometry, Rigid};
use kutzbach::matrix::SplitMix64;
use kutzbach::mechanism::{Direction, Frame, Mechanism};
use kutzbach::number::Number;
use std::collections::BTreeMap;

/// Where the frames stand about their axes, and those of links that hang on no joint, is drawn by lot.
pub fn exported(mechanism: &Mechanism, decimals: usize, seed: u64) -> Mechanism {
    let mut random = SplitMix64::new(seed);
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let mut draft = Draft::of(mechanism);
    draft.poses.clear();
    let mut turned = Vec::new();
    let mut frames: BTreeMap<String, Rigid<f64>> = draft
        .links
        .iter()
        .map(|link| (link.clone(), any_rotation(&mut random)))
        .collect();
    for (joint, sides) in draft.joints.iter().zip(&geometry.sides) {
        let turn = match joint.kind.uses_axis() {
            true => onto(&joint.axis, &mut random),
            false => any_rotation(&mut random),
        };
        if !joint.closes_loop {
            frames.insert(joint.ends[1].link.clone(), sides[1].compose(&turn));
        }
        turned.push(turn);
    }
    let write = |pose: &Rigid<f64>| frame(pose, decimals);
    for ((joint, sides), turn) in draft.joints.iter_mut().zip(&geometry.sides).zip(&turned) {
        for (end, side) in joint.ends.iter_mut().zip(sides) {
            end.frame = write(&frames[&end.link].inverse().compose(side).compose(turn));
        }
        if !joint.closes_loop {
            joint.ends[1].frame = Frame::identity();
        }
        if joint.kind.uses_axis() {
            joint.axis = Direction([Number::zero(), Number::zero(), Number::one()]);
        }
        if joint.kind.uses_second_axis() {
            let second = turn.rotate_back(&unit(&joint.axis2));
            joint.axis2 = Direction(second.map(|x| decimal(x, decimals)));
        }
        for length in joint.lead.iter_mut().chain(&mut joint.distance) {
            *length = decimal(length.value(), decimals);
        }
    }
    assert!(draft.placed.is_empty(), "{}: a link floats", draft.name);
    draft.build()
}

fn unit(direction: &Direction) -> [f64; 3] {
    let values = direction.0.each_ref().map(Number::value);
    let length = values.iter().map(|x| x * x).sum::<f64>().sqrt();
    values.map(|x| x / length)
}

fn any_rotation(random: &mut SplitMix64) -> Rigid<f64> {
    let angles = [0; 3].map(|_| 3.0 * random.symmetric());
    Rigid::exponential(&angles, &[0.0; 3])
}

/// A rotation that takes z onto the axis, and x anywhere.
fn onto(axis: &Direction, random: &mut SplitMix64) -> Rigid<f64> {
    let [x, y, z] = unit(axis);
    let tilt = z.clamp(-1.0, 1.0).acos();
    let across = y.hypot(x);
    let hinge = match across > 0.0 {
        true => [-y / across, x / across, 0.0],
        false => [1.0, 0.0, 0.0],
    };
    let about = Rigid::exponential(&[0.0, 0.0, 3.0 * random.symmetric()], &[0.0; 3]);
    Rigid::exponential(&hinge.map(|h| h * tilt), &[0.0; 3]).compose(&about)
}

fn frame(pose: &Rigid<f64>, decimals: usize) -> Frame {
    let r = &pose.rotation;
    let pitch = (-r[2][0]).clamp(-1.0, 1.0).asin();
    let (roll, yaw) = match r[2][0].abs() < 1.0 - 1e-12 {
        true => (r[2][1].atan2(r[2][2]), r[1][0].atan2(r[0][0])),
        // Only their sum, or their difference, is determined.
        false => ((-r[1][2]).atan2(r[1][1]), 0.0),
    };
    let written = |x: f64| decimal(x, decimals);
    Frame {
        position: pose.translation.map(written),
        roll_pitch_yaw: [roll, pitch, yaw].map(written),
    }
}

fn decimal(value: f64, decimals: usize) -> Number {
    let text = format!("{value:.decimals$}");
    // No sign before a zero.
    let text = match text.trim_start_matches(['-', '0', '.']).is_empty() {
        true => text.trim_start_matches('-'),
        false => &text,
    };
    Number::decimal(text).unwrap()
}
