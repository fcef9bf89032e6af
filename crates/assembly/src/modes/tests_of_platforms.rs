//! Platforms on six legs of given lengths between points: forty poses over the complex numbers, eighty with both signs of a quaternion.

use super::*;
use kutzbach_math::space::{length, subtract};
use std::fmt::Write;

type Points = [[f64; 3]; 6];

const FLAT: Points = [
    [0.0, 0.0, 0.0],
    [7.0, 1.0, 0.0],
    [9.0, 6.0, 0.0],
    [4.0, 9.0, 0.0],
    [-3.0, 8.0, 0.0],
    [-4.0, 3.0, 0.0],
];

/// The points with other heights.
fn at_heights(points: Points, heights: [f64; 6]) -> Points {
    let mut points = points;
    points.iter_mut().zip(heights).for_each(|(p, z)| p[2] = z);
    points
}

/// Above the base, a little smaller.
fn platform(heights: [f64; 6]) -> Points {
    let flat = [
        [1.0, 1.0, 0.0],
        [5.0, 0.0, 0.0],
        [7.0, 4.0, 0.0],
        [4.0, 7.0, 0.0],
        [0.0, 6.0, 0.0],
        [-2.0, 2.0, 0.0],
    ];
    at_heights(flat, heights)
}

fn modes_of(base: &Points, platform: &Points) -> Modes {
    let mut text = String::from(
        "<robot name=\"h\"><link name=\"base\"/><link name=\"platform\"/>\
         <joint name=\"place\" type=\"floating\"><parent link=\"base\"/><child link=\"platform\"/></joint>",
    );
    let at = |p: &[f64; 3]| format!("<origin xyz=\"{} {} {}\"/>", p[0], p[1], p[2]);
    for (leg, (b, p)) in base.iter().zip(platform).enumerate() {
        let _ = write!(
            text,
            "<loop name=\"leg_{leg}\" type=\"distance\"><predecessor link=\"base\">{}</predecessor>\
             <successor link=\"platform\">{}</successor></loop>",
            at(b),
            at(p)
        );
    }
    text.push_str("</robot>");
    let reading = kutzbach_format::read(&text, "hexapod.urdf", &[]).unwrap();
    let question = Question {
        held: None,
        limits: Limits::seconds(10.0),
    };
    assembly_modes(&reading.mechanism, &question).unwrap()
}

/// The numbers of real poses are those that Newton's method finds from 700 starts by lot in a rotation vector and a translation.
#[test]
fn all_poses_of_a_platform_on_six_legs_are_found_and_proven() {
    let rough = at_heights(FLAT, [0.0, 1.0, -2.0, 3.0, 0.0, 2.0]);
    for (base, heights, count) in [
        (rough, [8.0, 9.0, 11.0, 10.0, 8.0, 9.0], 2),
        (FLAT, [8.0; 6], 8),
        (FLAT, [7.0, 11.0, 13.0, 10.0, 6.0, 4.0], 4),
    ] {
        let platform = platform(heights);
        let modes = modes_of(&base, &platform);
        assert_eq!(modes.complete, Complete::Proven, "{count}");
        assert_eq!(modes.configurations.len(), count);
        let drawn = modes.configurations.iter().filter(|c| c.drawn).count();
        assert_eq!(drawn, 1, "{count}");
        let Way::Polynomials { complex, paths, .. } = modes.way else {
            panic!("{:?}", modes.way);
        };
        assert_eq!((complex, paths), (Some(80), true));
        for configuration in &modes.configurations {
            let pose = configuration.poses[1].as_ref().unwrap();
            for (b, p) in base.iter().zip(&platform) {
                let leg = length(&subtract(&pose.apply(p), b));
                let given = length(&subtract(p, b));
                assert!((leg - given).abs() < 1e-9, "{count}: {leg} {given}");
            }
        }
    }
}

/// Legs to one point of the platform leave it to turn about it: a curve is not counted, and not said to be finitely many.
#[test]
fn a_platform_that_moves_has_no_list_of_all_poses() {
    let mut platform = platform([8.0; 6]);
    platform[3] = platform[2];
    platform[4] = platform[2];
    platform[5] = platform[2];
    let modes = modes_of(&FLAT, &platform);
    assert!(matches!(modes.complete, Complete::Unknown(_)));
}
