//! In which frame an assembly is written: its own, that of its ground, or one that its joints say.
//!
//! An assembly may stand askew in its file: the ground placed at some angle, everything else on it, or every solid written in its turned
//! place. Then every axis has three decimal fractions where the part was drawn with whole numbers, and what is parallel or at right angles for
//! its designer is so to the last decimal only. In the frame of the ground part the numbers are the designer's again. Where the parts
//! themselves are written turned, the frame is that of the direction which most joints have, and of the one that most have at right angles to it.

use super::geometry::Geometry;
use super::standing::{Agreement, standing};
use kutzbach_math::group::Pose;
use nalgebra::{Matrix3, Vector3};

/// Points that are nearer to each other (m), seen along an axis, say no direction across it.
const NEAREST: f64 = 1e-4;

/// The geometry of joints, each with a point where it is drawn, in the frame of the assembly; in that of the ground, which stands at `ground` in
/// the assembly, where more of the directions are along an axis of coordinates there; or in that of most joints, where more still are, unless some are
/// straight already and the numbers a designer's round ones.
pub(super) fn in_frame_of_most(
    joints: Vec<(Geometry, Vector3<f64>)>,
    ground: &Pose,
    within: Agreement,
) -> Vec<(Geometry, Vector3<f64>)> {
    let same = within.angle;
    let moved = |there: &Pose| -> Vec<(Geometry, Vector3<f64>)> {
        let moved = joints
            .iter()
            .map(|(geometry, drawn)| (geometry.moved(there), there.transform_point(drawn)));
        moved.collect()
    };
    let of_ground = moved(&ground.inverse());
    let of_most = own_frame(&joints, same).map(|frame| moved(&frame));
    let best = match along_axes(&of_ground, same) > along_axes(&joints, same) {
        true => of_ground,
        false => joints,
    };
    let straight = along_axes(&best, same);
    let better = |own: &Vec<_>| along_axes(own, same) > straight;
    let designed = || straight > 0 && standing(&best, within, true).0.is_exact();
    match of_most.filter(better) {
        Some(own) if !designed() => own,
        _ => best,
    }
}

/// The frame whose z is the direction that most joints have, and whose x is the one that most have at right angles to it; where none is, from the first
/// joint with an axis or a centre across z towards another. Its origin is there. As the displacement into it; `None` without a direction.
fn own_frame(joints: &[(Geometry, Vector3<f64>)], same: f64) -> Option<Pose> {
    let directions = frequent(joints, same);
    let z = *directions.first()?;
    // What has an axis or a centre first: where planes touch each other is nobody's measure.
    let with_points = joints
        .iter()
        .filter(|(geometry, _)| geometry.point().is_some());
    let points: Vec<Vector3<f64>> = with_points.chain(joints).map(place).collect();
    let origin = *points.first()?;
    let across = |v: Vector3<f64>, least: f64| (v - z * z.dot(&v)).try_normalize(least);
    let square = directions.iter().find(|d| d.dot(&z).abs() <= same);
    let x = square
        .and_then(|d| across(*d, 0.5))
        .or_else(|| {
            let mut others = points.iter().map(|point| point - origin);
            others.find_map(|other| across(other, NEAREST))
        })
        .or_else(|| across(Vector3::x(), 0.5))
        .or_else(|| across(Vector3::y(), 0.5))?;
    let rotation = Matrix3::from_columns(&[x, z.cross(&x), z]);
    Some(Pose::new(rotation, origin).inverse())
}

/// Where a joint is.
fn place((geometry, drawn): &(Geometry, Vector3<f64>)) -> Vector3<f64> {
    geometry.point().unwrap_or(*drawn)
}

/// The directions of joints, each of those that agree once, as their mean; those of most joints first.
fn frequent(joints: &[(Geometry, Vector3<f64>)], same: f64) -> Vec<Vector3<f64>> {
    let mut found: Vec<(Vector3<f64>, usize)> = Vec::new();
    for direction in joints
        .iter()
        .filter_map(|(geometry, _)| geometry.direction())
    {
        let agrees = |(sum, _): &&mut (Vector3<f64>, usize)| {
            sum.cross(&direction).norm() <= same * sum.norm()
        };
        match found.iter_mut().find(agrees) {
            Some((sum, count)) => {
                *sum += direction * sum.dot(&direction).signum();
                *count += 1;
            }
            None => found.push((direction, 1)),
        }
    }
    // The sort keeps the order of equal ones.
    found.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let means = found.into_iter().map(|(sum, _)| sum.try_normalize(0.5));
    means.flatten().collect()
}

/// How many directions are along an axis of coordinates.
fn along_axes(joints: &[(Geometry, Vector3<f64>)], same: f64) -> usize {
    let directions = joints
        .iter()
        .filter_map(|(geometry, _)| geometry.direction());
    let straight = |direction: &Vector3<f64>| {
        let largest = direction.iamax();
        let others = (0..3).filter(|place| *place != largest);
        others
            .map(|place| direction[place].abs())
            .all(|x| x <= same)
    };
    directions.filter(straight).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn within() -> Agreement {
        Agreement::of(0.0, 0.0)
    }

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
        let found = in_frame_of_most(askew, &ground, within());
        for ((geometry, _), (expected, _)) in found.iter().zip(&drawn) {
            let (one, two) = (geometry.direction(), expected.direction());
            assert!(one.zip(two).is_none_or(|(a, b)| (a - b).norm() < 1e-12));
        }
        // What is straight already stays as it is.
        assert_eq!(in_frame_of_most(drawn.clone(), &ground, within()), drawn);
    }

    #[test]
    fn solids_that_are_written_turned_are_straight_in_the_frame_of_their_joints() {
        let line = |point: [f64; 3], direction: Vector3<f64>| {
            let point = point.into();
            (Geometry::Line { point, direction }, Vector3::zeros())
        };
        // Three pins, one of them the other way round, and a slide at right angles to them.
        let drawn = [
            line([0.01, 0.02, 0.0], Vector3::z()),
            line([0.04, 0.06, 0.0], -Vector3::z()),
            line([0.09, 0.02, 0.0], Vector3::z()),
            (
                Geometry::Direction(Vector3::new(0.6, 0.8, 0.0)),
                Vector3::zeros(),
            ),
        ];
        let mut turn = Pose::from_roll_pitch_yaw(0.3, 0.8, -1.2);
        turn.translation = Vector3::new(0.1, 0.2, 0.3);
        let digits = |v: Vector3<f64>| v.map(|x| (x * 1e7).round() / 1e7);
        let printed = drawn.map(|(geometry, drawn)| {
            let geometry = match geometry.moved(&turn) {
                Geometry::Line { point, direction } => Geometry::Line {
                    point: digits(point),
                    direction: digits(direction),
                },
                Geometry::Direction(direction) => Geometry::Direction(digits(direction)),
                other => other,
            };
            (geometry, turn.transform_point(&drawn))
        });
        let found = in_frame_of_most(printed.to_vec(), &Pose::identity(), within());
        assert_eq!(along_axes(&found, within().angle), 4);
        let points: Vec<Vector3<f64>> = found.iter().filter_map(|(g, _)| g.point()).collect();
        for (point, expected) in points
            .iter()
            .zip([[0.0, 0.0], [0.05, 0.0], [0.048, -0.064]])
        {
            assert!((point.x - expected[0]).abs() < 1e-6, "{points:?}");
            assert!(
                (point.y.abs() - f64::abs(expected[1])).abs() < 1e-6,
                "{points:?}"
            );
        }
    }
}
