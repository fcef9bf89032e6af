//! Plain vectors, and poses in the forms that messages and URDF want.

use kutzbach_closure::{Rigid, across};
use kutzbach_model::mechanism::Frame;

pub type Point = [f64; 3];

pub fn sum(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] + b[i])
}

pub fn difference(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] - b[i])
}

pub fn times(a: Point, factor: f64) -> Point {
    a.map(|x| x * factor)
}

/// Length without overflow on the way.
pub fn norm(a: Point) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

/// Whether every number of a pose is finite.
#[cfg(feature = "logs")]
pub fn is_finite(pose: &Rigid<f64>) -> bool {
    let mut entries = pose.rotation.iter().flatten().chain(&pose.translation);
    entries.all(|x| x.is_finite())
}

/// A frame at a point with its z axis along a direction; parallel to the reference frame where the direction has no
/// length.
pub fn along(point: Point, direction: Point) -> Rigid<f64> {
    let length = norm(direction);
    let mut pose = Rigid::translation(point);
    if length > 0.0 && length.is_finite() {
        let z = direction.map(|x| x / length);
        let (x, y) = across(&z);
        pose.rotation = [0, 1, 2].map(|i| [x[i], y[i], z[i]]);
    }
    pose
}

/// `link_from_frame` in double precision, with URDF's fixed-axis angles.
pub fn pose_of(frame: &Frame) -> Rigid<f64> {
    let mut pose = Rigid::translation([0, 1, 2].map(|i| frame.position[i].value()));
    for axis in [2, 1, 0] {
        let (sine, cosine) = frame.roll_pitch_yaw[axis].value().sin_cos();
        let mut direction = [0.0; 3];
        direction[axis] = 1.0;
        pose = pose.compose(&Rigid::rotation(&direction, &cosine, &sine));
    }
    pose
}

/// URDF's `rpy`: `R = Rz(yaw) Ry(pitch) Rx(roll)`. Where the pitch is a quarter turn, the yaw is zero.
#[cfg(feature = "logs")]
pub fn roll_pitch_yaw(rotation: &[[f64; 3]; 3]) -> [f64; 3] {
    let r = rotation;
    let level = r[0][0].hypot(r[1][0]);
    let pitch = (-r[2][0]).atan2(level);
    // Rounding leaves about 1e-16 of the first column's horizontal part at a quarter turn.
    let angles = if level > 1e-12 {
        [r[2][1].atan2(r[2][2]), pitch, r[1][0].atan2(r[0][0])]
    } else {
        [(-r[1][2]).atan2(r[1][1]), pitch, 0.0]
    };
    angles.map(|x| x + 0.0)
}

#[cfg(all(test, feature = "logs"))]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn turned(angles: [f64; 3]) -> Rigid<f64> {
        let mut pose = Rigid::identity(&0.0);
        for axis in [2, 1, 0] {
            let mut direction = [0.0; 3];
            direction[axis] = 1.0;
            let (sine, cosine) = angles[axis].sin_cos();
            pose = pose.compose(&Rigid::rotation(&direction, &cosine, &sine));
        }
        pose
    }

    fn far(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> f64 {
        let pairs = a.iter().flatten().zip(b.iter().flatten());
        pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_pitch_of_a_quarter_turn_is_still_the_same_rotation() {
        for pitch in [std::f64::consts::FRAC_PI_2, -std::f64::consts::FRAC_PI_2] {
            let pose = turned([0.4, pitch, -1.1]);
            let angles = roll_pitch_yaw(&pose.rotation);
            assert!(far(&turned(angles).rotation, &pose.rotation) < 1e-12);
        }
    }

    #[test]
    fn a_frame_along_nothing_is_not_turned() {
        assert_eq!(
            along([1.0; 3], [0.0; 3]).rotation,
            Rigid::identity(&0.0).rotation
        );
    }

    proptest! {
        #[test]
        fn rotations_survive(angles in prop::array::uniform3(-3.2..3.2f64)) {
            let pose = turned(angles);
            let again = turned(roll_pitch_yaw(&pose.rotation));
            prop_assert!(far(&again.rotation, &pose.rotation) < 1e-12);
        }

        #[test]
        fn z_points_along(direction in prop::array::uniform3(-1.0..1.0f64)) {
            prop_assume!(norm(direction) > 1e-3);
            let pose = along([0.0; 3], direction);
            let z = pose.rotate(&[0.0, 0.0, 1.0]);
            prop_assert!(norm(difference(times(z, norm(direction)), direction)) < 1e-15);
        }
    }
}
