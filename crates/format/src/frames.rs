//! Frames one after another, in doubles where digits cannot be kept.

use super::quaternion::{angles_of, of_columns};
use kutzbach_math::number::Number;
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::Frame;

/// A number in full double precision.
pub(super) fn in_full(value: f64) -> Number {
    Number::decimal(&format!("{value:.15}")).unwrap_or_else(|_| Number::zero())
}

/// A sum that keeps the digits of a number to which nothing is added.
pub(super) fn sum(a: &Number, b: &Number) -> Number {
    match (a.is_zero(), b.is_zero()) {
        (true, _) => b.clone(),
        (_, true) => a.clone(),
        _ => a + b,
    }
}

/// Whether a frame is turned.
pub(super) fn is_turned(frame: &Frame) -> bool {
    frame.roll_pitch_yaw.iter().any(|angle| !angle.is_zero())
}

/// A frame in doubles: roll, pitch and yaw about fixed axes, then the position.
pub(super) fn pose_of(frame: &Frame) -> Rigid<f64> {
    let position = frame.position.each_ref().map(Number::value);
    let turned = |axis: [f64; 3], angle: &Number| {
        let (sine, cosine) = angle.value().sin_cos();
        Rigid::rotation(&axis, &cosine, &sine)
    };
    let [roll, pitch, yaw] = &frame.roll_pitch_yaw;
    Rigid::translation(position)
        .compose(&turned([0.0, 0.0, 1.0], yaw))
        .compose(&turned([0.0, 1.0, 0.0], pitch))
        .compose(&turned([1.0, 0.0, 0.0], roll))
}

/// A frame in doubles as one that is stated in full.
pub(super) fn frame_of(pose: &Rigid<f64>) -> Frame {
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| pose.rotate(&e));
    Frame {
        position: pose.apply(&[0.0; 3]).map(in_full),
        roll_pitch_yaw: angles_of(of_columns(columns))
            .unwrap_or_else(|| Frame::identity().roll_pitch_yaw),
    }
}

/// A frame in another one. Straight ones add up and keep their digits; after a turn the position is worked out in doubles.
pub(super) fn one_after_another(first: &Frame, second: &Frame) -> Frame {
    if second.is_identity() {
        return first.clone();
    }
    if is_turned(first) {
        return frame_of(&pose_of(first).compose(&pose_of(second)));
    }
    Frame {
        position: [0, 1, 2].map(|i| sum(&first.position[i], &second.position[i])),
        roll_pitch_yaw: second.roll_pitch_yaw.clone(),
    }
}
