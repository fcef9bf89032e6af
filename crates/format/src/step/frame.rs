//! In which frame an assembly is written: its own, or that of its ground.
//!
//! An assembly may stand askew in its file: the ground placed at some angle, everything else on it. Then every axis has three
//! decimal fractions where the part was drawn with whole numbers, and what is parallel or at right angles for its designer is so to the last decimal
//! only. In the frame of the ground part the numbers are the designer's again.

use super::geometry::Geometry;
use super::standing::SAME_DIRECTION;
use kutzbach_math::group::Pose;
use nalgebra::Vector3;

/// The geometry of joints, each with a point where it is drawn, in the frame of the assembly; in that of the ground, which stands at `ground` in
/// the assembly, where more of the directions are along an axis of coordinates there.
pub(super) fn in_frame_of_most(
    joints: Vec<(Geometry, Vector3<f64>)>,
    ground: &Pose,
) -> Vec<(Geometry, Vector3<f64>)> {
    let there = ground.inverse();
    let moved: Vec<(Geometry, Vector3<f64>)> = joints
        .iter()
        .map(|(geometry, drawn)| (geometry.moved(&there), there.transform_point(drawn)))
        .collect();
    match along_axes(&moved) > along_axes(&joints) {
        true => moved,
        false => joints,
    }
}

/// How many directions are along an axis of coordinates.
fn along_axes(joints: &[(Geometry, Vector3<f64>)]) -> usize {
    let directions = joints
        .iter()
        .filter_map(|(geometry, _)| geometry.direction());
    let straight = |direction: &Vector3<f64>| {
        let largest = direction.iamax();
        let others = (0..3).filter(|place| *place != largest);
        others
            .map(|place| direction[place].abs())
            .all(|x| x <= SAME_DIRECTION)
    };
    directions.filter(straight).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_askew_is_written_as_its_ground_was_drawn() {
        let axis = |direction: Vector3<f64>| Geometry::Line {
            point: Vector3::new(0.04, 0.0, 0.0),
            direction,
        };
        let drawn = vec![
            (axis(Vector3::z()), Vector3::zeros()),
            (Geometry::Direction(Vector3::x()), Vector3::y()),
            (Geometry::Free, Vector3::zeros()),
        ];
        let mut ground = Pose::from_roll_pitch_yaw(0.3, 0.8, -1.2);
        ground.translation = Vector3::new(0.1, 0.2, 0.3);
        let askew: Vec<(Geometry, Vector3<f64>)> = drawn
            .iter()
            .map(|(geometry, point)| (geometry.moved(&ground), ground.transform_point(point)))
            .collect();
        let found = in_frame_of_most(askew, &ground);
        for ((geometry, _), (expected, _)) in found.iter().zip(&drawn) {
            let (one, two) = (geometry.direction(), expected.direction());
            assert!(one.zip(two).is_none_or(|(a, b)| (a - b).norm() < 1e-12));
        }
        // What is straight already stays as it is.
        assert_eq!(in_frame_of_most(drawn.clone(), &ground), drawn);
    }
}
