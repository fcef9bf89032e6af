//! How a frame that was worked out from others depends on the numbers of these, to first order.
//!
//! A frame at the end of a walk is a product of frames and of inverses of frames. Let `B` be the pose, seen from where the walk starts, of
//! what one of them is given in, `c` the origin of that frame and `e` that of the last one. Where a coordinate of its position grows, the
//! end moves along that axis of `B`; where its roll, pitch or yaw grows, the end turns at `ω`, the axis of that turn seen from the start,
//! and moves by `ω × (e − c)`: an angle counts with its lever arm. An inverse in the walk does the same backwards, and of derivatives the
//! size alone is kept. Cost: one product of poses per frame, and six derivatives of up to six numbers each.

use super::frame::Frame;
use kutzbach_math::number::{Inputs, Number, Quantity};
use kutzbach_math::space::{Rigid, Vector, cross, subtract};

/// Where the pitch is nearer to a right angle than this (rad), roll and yaw turn about nearly one axis, and a small turn about the one across
/// is a large change of both, without bound at the right angle itself. Their derivatives are those at this distance.
const UPRIGHT: f64 = 1.0 / 32.0;

/// One frame of a walk, from what it is given in to it, or back.
#[derive(Clone, Copy)]
pub(super) struct Step<'a> {
    pub frame: &'a Frame,
    pub back: bool,
}

impl<'a> Step<'a> {
    pub fn to(frame: &'a Frame) -> Self {
        Self { frame, back: false }
    }

    pub fn back_from(frame: &'a Frame) -> Self {
        Self { frame, back: true }
    }

    pub fn reversed(self) -> Self {
        Self {
            back: !self.back,
            ..self
        }
    }
}

/// The literals that x, y, z (m), roll, pitch and yaw (rad) of the frame at the end of a walk depend on.
pub(super) fn inputs_along(steps: &[Step<'_>]) -> [Inputs; 6] {
    let mut here = Rigid::identity(&1.0);
    let mut given_in = Vec::with_capacity(steps.len());
    for step in steps {
        let pose = step.frame.to_doubles();
        if step.back {
            here = here.compose(&pose.inverse());
            given_in.push(here.clone());
        } else {
            given_in.push(here.clone());
            here = here.compose(&pose);
        }
    }
    let mut found: [Inputs; 6] = Default::default();
    for (step, base) in steps.iter().zip(&given_in) {
        add_frame(&mut found, step.frame, base, &here);
    }
    found
}

/// Adds what the frame at the `end` has from the numbers of one that is given in `base`.
fn add_frame(found: &mut [Inputs; 6], frame: &Frame, base: &Rigid<f64>, end: &Rigid<f64>) {
    let (position, turned) = found.split_at_mut(3);
    let origin = base.apply(&frame.position.each_ref().map(Number::value));
    let arm = subtract(&end.translation, &origin);
    for (coordinate, axis) in frame.position.iter().zip(UNIT) {
        let moved = base.rotate(&axis);
        add(position, Quantity::Length, coordinate, &moved);
    }
    for (angle, axis) in frame.roll_pitch_yaw.iter().zip(frame.axes_of_turns()) {
        let axis = base.rotate(&axis);
        add(position, Quantity::Angle, angle, &cross(&axis, &arm));
        let rates = roll_pitch_yaw_rates(end, &axis);
        add(turned, Quantity::Angle, angle, &rates);
    }
}

fn add(inputs: &mut [Inputs], quantity: Quantity, number: &Number, slopes: &Vector<f64>) {
    for (inputs, slope) in inputs.iter_mut().zip(slopes) {
        inputs.add(quantity, number, *slope);
    }
}

const UNIT: [Vector<f64>; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// How fast roll, pitch and yaw of a pose grow (rad/s) while it turns at an angular velocity (rad/s, in what the pose is given in). Where
/// the pitch is within 1/32 of a right angle, where roll and yaw may grow without bound, they are those at that distance.
///
/// ```
/// # use kutzbach_model as kutzbach;
/// use kutzbach::mechanism::{Frame, roll_pitch_yaw_rates};
/// let straight = Frame::identity().to_doubles();
/// assert_eq!(roll_pitch_yaw_rates(&straight, &[1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
/// ```
#[must_use]
pub fn roll_pitch_yaw_rates(pose: &Rigid<f64>, velocity: &[f64; 3]) -> [f64; 3] {
    let [[x, ..], [y, ..], [z, ..]] = pose.rotation;
    let level = x.hypot(y);
    let (cos_yaw, sin_yaw) = match level > 0.0 {
        true => (x / level, y / level),
        false => (1.0, 0.0),
    };
    let [about_x, about_y, about_z] = velocity;
    let across = cos_yaw * about_x + sin_yaw * about_y;
    let roll = across / level.max(UPRIGHT);
    let pitch = cos_yaw * about_y - sin_yaw * about_x;
    [roll, pitch, about_z - z * roll]
}

impl Frame {
    /// The frame in doubles: roll, pitch and yaw about fixed axes, then the position (m).
    #[must_use]
    pub fn to_doubles(&self) -> Rigid<f64> {
        let position = self.position.each_ref().map(Number::value);
        let turned = |axis: usize| {
            let (sine, cosine) = self.roll_pitch_yaw[axis].value().sin_cos();
            Rigid::rotation(&UNIT[axis], &cosine, &sine)
        };
        Rigid::translation(position)
            .compose(&turned(2))
            .compose(&turned(1))
            .compose(&turned(0))
    }

    /// The axes that roll, pitch and yaw turn about, in what the frame is given in.
    fn axes_of_turns(&self) -> [Vector<f64>; 3] {
        let [_, pitch, yaw] = self.roll_pitch_yaw.each_ref().map(Number::value);
        let ((sin_pitch, cos_pitch), (sin_yaw, cos_yaw)) = (pitch.sin_cos(), yaw.sin_cos());
        [
            [cos_yaw * cos_pitch, sin_yaw * cos_pitch, -sin_pitch],
            [-sin_yaw, cos_yaw, 0.0],
            [0.0, 0.0, 1.0],
        ]
    }

    /// The literals that x, y, z (m), roll, pitch and yaw (rad) of the frame at the end of one chain depend on, seen from the end of another
    /// one that starts at the same place; see [`Frame::between`]. To first order; where the pitch is a right angle, roll and yaw are said
    /// to depend on less than they do (see [`roll_pitch_yaw_rates`]).
    #[must_use]
    pub fn inputs_between(from: &[&Self], to: &[&Self]) -> [Inputs; 6] {
        let back = from.iter().rev().map(|frame| Step::back_from(frame));
        let steps: Vec<Step<'_>> = back.chain(to.iter().map(|frame| Step::to(frame))).collect();
        inputs_along(&steps)
    }

    /// The same frame, its x, y, z, roll, pitch and yaw worked out from literals.
    #[must_use]
    pub fn derived_from(self, inputs: [Inputs; 6]) -> Self {
        let [x, y, z] = self.position;
        let [roll, pitch, yaw] = self.roll_pitch_yaw;
        let [of_x, of_y, of_z, of_roll, of_pitch, of_yaw] = inputs;
        Self {
            position: [
                x.derived_from(of_x),
                y.derived_from(of_y),
                z.derived_from(of_z),
            ],
            roll_pitch_yaw: [
                roll.derived_from(of_roll),
                pitch.derived_from(of_pitch),
                yaw.derived_from(of_yaw),
            ],
        }
    }
}

#[cfg(test)]
#[path = "derived_frames_tests.rs"]
mod tests;
