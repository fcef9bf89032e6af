//! Tests of what needs no STEP text; those with texts are in `tests/step.rs`.

#![allow(clippy::unwrap_used)]

use super::geometry::{Geometry, for_kind};
use super::is_step;
use super::standing::{Agreement, Standing, standing};
use kutzbach_model::mechanism::JointKind;
use kutzbach_step::{Contact, ContactKind};
use nalgebra::Vector3;

fn line(point: [f64; 3], direction: [f64; 3]) -> (Geometry, Vector3<f64>) {
    let geometry = Geometry::Line {
        point: point.into(),
        direction: direction.into(),
    };
    (geometry, Vector3::zeros())
}

/// The axis of a joint as text.
fn axis(standing: &Standing) -> String {
    let axis = standing.axis.as_ref().unwrap();
    axis.0.each_ref().map(|n| n.source()).join(" ")
}

#[test]
fn axes_that_agree_are_one_and_others_are_not() {
    let z = [0.0, 0.0, 1.0];
    let (_, found) = standing(
        &[
            line([0.02, 0.01, 0.005], z),
            // The noise of a kernel, and the other way round.
            line([0.02 + 3e-9, 0.01 - 2e-8, 0.9], [1e-9, -2e-8, -1.0]),
            // A tenth of a micrometre and more beside it.
            line([0.02 + 4e-7, 0.01, 0.0], z),
            line([0.02, 0.01, 0.0], [1e-5, 0.0, 1.0]),
        ],
        Agreement::of(0.0, 0.0),
        true,
    );
    assert_eq!(found[0], found[1]);
    assert_ne!(found[0].position, found[2].position);
    assert_eq!(axis(&found[0]), axis(&found[2]));
    assert_ne!(axis(&found[0]), axis(&found[3]));
}

#[test]
fn round_numbers_are_exact_and_others_state_seven_decimals() {
    let z = [0.0, 0.0, 1.0];
    let place = |x: f64, exact: bool| {
        let (grid, found) = standing(&[line([x, 0.0, 0.0], z)], Agreement::of(0.0, 0.0), exact);
        let frame = grid.frame(&found[0].position, &[0; 3]);
        let [x, y, _] = frame.position;
        assert!(y.is_zero());
        (x.source(), x.value(), x.stated().is_none())
    };
    let (_, value, exact) = place(0.0205, true);
    assert_eq!((value, exact), (0.0205, true));
    // Of what is stated by hand, and of what is not round, the digits say how well it is known.
    assert_eq!(
        place(0.0205, false),
        ("0.0205000".to_owned(), 0.0205, false)
    );
    let (text, _, exact) = place(-0.012_345_678_9, true);
    assert_eq!((text.as_str(), exact), ("-0.0123457", false));
    let length = |stated: f64| Agreement::of(stated, 0.0).length;
    assert_eq!((length(0.0), length(1e-6), length(1.0)), (1e-7, 1e-6, 1e-5));
}

#[test]
fn axes_that_meet_pass_one_point() {
    // A joint cross that is tilted: neither direction is one of the assembly's.
    let (a, b) = ([0.8, 0.36, 0.48], [-0.6, 0.48, 0.64]);
    let centre = Vector3::new(0.1, 0.2, 0.3) / 3.0;
    let beside = |along: [f64; 3], way: f64| centre + Vector3::from(along) * way;
    let (_, found) = standing(
        &[
            line(beside(a, 0.04).into(), a),
            line(beside(b, -0.07).into(), b),
            (Geometry::Point(centre), Vector3::zeros()),
        ],
        Agreement::of(0.0, 0.0),
        true,
    );
    assert_eq!(found[0].position, found[1].position);
    assert_eq!(found[0].position, found[2].position);
}

#[test]
fn loops_close_exactly_in_differences() {
    let z = [0.0, 0.0, 1.0];
    let joints: Vec<_> = [
        [0.1, 0.2, 0.0],
        [1.0 / 3.0, 0.2, 0.0],
        [0.7, 2.0 / 7.0, 0.0],
    ]
    .map(|point| line(point, z))
    .to_vec();
    let (grid, found) = standing(&joints, Agreement::of(0.0, 0.0), true);
    let origin = [0; 3];
    let step = |to: &Standing, from: &[i128; 3]| grid.frame(&to.position, from).position;
    for coordinate in 0..2 {
        let direct = step(&found[2], &origin)[coordinate].clone();
        let first = step(&found[0], &origin)[coordinate].clone();
        let second = step(&found[1], &found[0].position)[coordinate].clone();
        let third = step(&found[2], &found[1].position)[coordinate].clone();
        let way = &(&first + &second) + &third;
        assert!((&way - &direct).is_zero());
    }
}

#[test]
fn a_correction_takes_its_axis_from_a_round_contact() {
    let contact = |kind: ContactKind| Contact {
        first: 0,
        second: 1,
        kind,
        axis: Vector3::z(),
        point: Vector3::new(0.1, 0.0, 0.0),
        clearance: 0.0,
        misfit: 0.0,
        size: 0.01,
        faces: (1, 2),
    };
    let round = [
        contact(ContactKind::Planar),
        contact(ContactKind::Cylindrical),
    ];
    let axis = Geometry::Line {
        point: Vector3::new(0.1, 0.0, 0.0),
        direction: Vector3::z(),
    };
    assert_eq!(for_kind(JointKind::Screw, None, &round), Some(axis));
    let along = Some(Geometry::Direction(Vector3::z()));
    assert_eq!(for_kind(JointKind::Prismatic, None, &round), along);
    assert_eq!(for_kind(JointKind::Planar, None, &round[..1]), along);
    assert_eq!(for_kind(JointKind::Revolute, None, &round[..1]), None);
    assert_eq!(for_kind(JointKind::Spherical, None, &round), None);
    assert_eq!(for_kind(JointKind::Fixed, None, &[]), Some(Geometry::Free));
}

#[test]
fn a_step_file_is_known_by_its_first_word() {
    assert!(is_step(b"ISO-10303-21;\nHEADER;"));
    assert!(is_step(b"\xef\xbb\xbf\r\n ISO-10303-21 ;"));
    assert!(!is_step(b"<robot/>") && !is_step(b""));
}
