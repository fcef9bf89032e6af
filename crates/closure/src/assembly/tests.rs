use super::super::geometry::Arithmetic;
use super::super::jacobian::jacobian;
use super::super::samples::{
    CRANK_ROCKER, Place, Written, add_ring, four_bar, planar, ring, sarrus, sarrus_places,
};
use super::descent::{advance, largest, movable_columns, step};
use super::*;
use crate::Structure;
use kutzbach_math::number::Number;
use kutzbach_math::space::{length, subtract};
use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind, MechanismBuilder};

fn number(x: f64) -> Number {
    Number::from_f64(x).unwrap()
}

fn assembled(mechanism: &Mechanism, held: &[usize]) -> (Geometry<f64>, Assembly) {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let structure = Structure::new(mechanism);
    let held = held.iter().copied().collect();
    let assembly = assemble(mechanism, &geometry, &structure.parts, &held).unwrap();
    (geometry, assembly)
}

fn the_part(mechanism: &Mechanism) -> Part {
    Structure::new(mechanism).parts.swap_remove(0)
}

#[test]
fn what_is_drawn_closed_is_left_alone() {
    for mechanism in [four_bar(), sarrus()] {
        let (geometry, assembly) = assembled(&mechanism, &[]);
        assert!(assembly.closed);
        assert_eq!(assembly.steps, 0);
        assert_eq!(assembly.moved, 0.0);
        for (before, after) in geometry.states.iter().zip(&assembly.states) {
            assert_eq!(before.values, after.values, "bit for bit");
        }
        assert!(
            assembly
                .gaps
                .iter()
                .all(|gap| gap.position < 1e-15 && gap.angle < 1e-15)
        );
    }
}

/// Three plates fixed to each other in a ring, as an assembly of glued parts has them: what the walk around leaves is rounding, or the digits of
/// decimals, and nothing moves that could take it away.
#[test]
fn a_loop_of_fixed_joints_closes_to_rounding_and_within_its_digits() {
    let made = |number: &dyn Fn(i64) -> Number, off: i64| {
        let at = |units: [i64; 3]| Frame::at(units.map(number));
        let mut builder = MechanismBuilder::new("plates");
        for link in ["a", "b", "c"] {
            builder.link(link);
        }
        let fixed = JointKind::Fixed;
        let first = JointBuilder::tree("ab", fixed, "a", "b");
        builder.joint(first.origin(at([7664, -1563, -3914])));
        let second = JointBuilder::tree("ac", fixed, "a", "c");
        builder.joint(second.origin(at([6864, -2814, -4173])));
        let third = JointBuilder::closing("bc", fixed, "b", "c").origin(at([150, -1057, -1189]));
        builder.joint(third.successor_origin(at([950 + off, 194, -930])));
        builder.build().unwrap()
    };
    let exact = |units: i64| Number::ratio(units, 100_000).unwrap();
    let rounded = |units: i64| Number::decimal(&format!("{:.5}", units as f64 / 1e5)).unwrap();
    for (off, closed) in [(0, [true, true]), (1, [false, true]), (100, [false, false])] {
        let found = [made(&exact, off), made(&rounded, off)].map(|mechanism| {
            let (_, assembly) = assembled(&mechanism, &[]);
            assert!(!assembly.closed || assembly.steps == 0, "{assembly:?}");
            assembly.closed
        });
        assert_eq!(found, closed, "off by {off}");
    }
}

#[test]
fn a_four_bar_pulled_apart_closes_again() {
    let mechanism = ring(&planar(&CRANK_ROCKER), [0.5, -0.25, 0.0], Written::Exactly);
    let (_, assembly) = assembled(&mechanism, &[]);
    assert!(assembly.closed, "{assembly:?}");
    assert!(assembly.residual <= assembly.tolerance);
    assert!(assembly.moved > 0.05 && assembly.moved < 2.0);
    let gap = &assembly.gaps[0];
    assert!((gap.position - 0.5f64.hypot(0.25)).abs() < 1e-14);
    assert!(gap.left_position < 1e-12 && gap.left_angle < 1e-12);
}

/// Crank, coupler and rocker in a line that is a little longer than the frame: the loop closes by bending, about the root of the
/// excess, though to first order nothing closes it and the digits would let it count as closed.
#[test]
fn a_chain_drawn_nearly_stretched_is_bent_until_it_closes() {
    let line = [[0.0, 0.0], [0.12, 0.0], [0.31, 0.0], [0.45, 0.0]];
    for short in [1e-5, 1e-4] {
        // The last joint's side on the ground is nearer.
        let mechanism = ring(&planar(&line), [-short, 0.0, 0.0], Written::Decimals(6));
        let (_, assembly) = assembled(&mechanism, &[]);
        assert!(assembly.closed && assembly.residual < 1e-12, "{assembly:?}");
        let turned = assembly.joints.iter().map(|place| place.turned);
        let most = turned.fold(0.0, f64::max);
        assert!(
            most > 0.5 * short.sqrt() && most < 20.0 * short.sqrt(),
            "{most}"
        );
    }
}

#[test]
fn tolerances_in_metres_are_those_of_the_loop() {
    // Two hinges of one axis, 20 mm apart, of which one is aside.
    let places = [[0.0; 3], [0.0, 0.0, 0.02]].map(|at| (JointKind::Revolute, at, [0.0, 0.0, 1.0]));
    let mechanism = ring(&places, [9e-5, 0.0, 0.0], Written::Decimals(5));
    let (_, assembly) = assembled(&mechanism, &[]);
    let left = assembly.residual * assembly.length;
    assert!(left > 4e-5 && left < 1e-4, "{left}: {assembly:?}");
}

#[test]
fn convergence_is_quadratic() {
    // From a small gap, every step squares the residual, up to a factor that the geometry sets.
    for gap in [[0.05, 0.02, 0.0], [0.02, 0.0, 0.05]] {
        let mechanism = ring(&sarrus_places(), gap, Written::Exactly);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let part = the_part(&mechanism);
        let mut states = geometry.states.clone();
        let mut sizes = Vec::new();
        // What `descend` does, one step at a time.
        for _ in 0..5 {
            let here = jacobian(&mechanism, &geometry, &states, &part).unwrap();
            let square: f64 = here.residual.iter().map(|r| r * r).sum();
            sizes.push(square.sqrt());
            let columns = movable_columns(&here, &BTreeSet::new());
            let x = step(&here, &columns, square).unwrap().unwrap();
            advance(&mechanism, &geometry, &here, &columns, &x, &mut states);
        }
        for pair in sizes.windows(2).filter(|pair| pair[1] > 1e-14) {
            assert!(pair[1] < 20.0 * pair[0] * pair[0], "{sizes:?}");
        }
        assert!(sizes[4] < 1e-14, "{sizes:?}");
        let (_, assembly) = assembled(&mechanism, &[]);
        assert!(assembly.closed && assembly.steps <= 6, "{}", assembly.steps);
    }
}

#[test]
fn a_stretched_loop_with_its_gap_along_the_line_is_freed() {
    // All links on one line, and the gap on it too: to first order no joint can do anything about it.
    let points = [[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [4.5, 0.0]];
    let mechanism = ring(&planar(&points), [-0.5, 0.0, 0.0], Written::Exactly);
    let (geometry, assembly) = assembled(&mechanism, &[]);
    assert!(assembly.closed, "{assembly:?}");
    assert!(assembly.moved > 0.01);
    let turned = geometry.states.iter().zip(&assembly.states);
    assert!(
        turned
            .map(|(a, b)| (a.values[0] - b.values[0]).abs())
            .fold(0.0, f64::max)
            > 0.1
    );
}

#[test]
fn what_cannot_close_says_by_how_much() {
    // Links of 1, 1 and 1.5 m cannot span 5 m: stretched, 1.5 m are missing.
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.5, 0.0]];
    let mechanism = ring(&planar(&points), [1.5, 0.0, 0.0], Written::Exactly);
    let (_, assembly) = assembled(&mechanism, &[]);
    assert!(!assembly.closed);
    assert!((assembly.gaps[0].position - 1.5).abs() < 1e-14);
    assert!(
        (assembly.gaps[0].left_position - 1.5).abs() < 0.2,
        "{:?}",
        assembly.gaps
    );
    assert!(assembly.residual > assembly.tolerance);
    // A gap across the plane cannot be closed at all.
    let mechanism = ring(&planar(&CRANK_ROCKER), [0.0, 0.0, 0.25], Written::Exactly);
    let (_, assembly) = assembled(&mechanism, &[]);
    assert!(!assembly.closed);
    assert!((assembly.gaps[0].left_position - 0.25).abs() < 1e-6);
}

#[test]
fn held_joints_stay_held() {
    let mut builder = MechanismBuilder::new("held");
    builder.link("ground");
    add_ring(
        &mut builder,
        "r",
        "ground",
        &planar(&CRANK_ROCKER),
        [0.0; 3],
        Written::Exactly,
    );
    builder.configuration("turned", vec![("r_a".to_owned(), vec![number(0.5)])]);
    let mechanism = builder.build().unwrap();
    let configuration = mechanism.configuration("turned");
    let geometry = Geometry::new(&mechanism, configuration, &Arithmetic::double());
    let parts = Structure::new(&mechanism).parts;
    let held = BTreeSet::from([0]);
    let assembly = assemble(&mechanism, &geometry, &parts, &held).unwrap();
    assert!(assembly.closed);
    assert_eq!(assembly.states[0].values, [0.5], "bit for bit");
    assert!(
        assembly.states[1].values[0].abs() > 0.01,
        "the others follow"
    );
    // With everything held nothing closes.
    let held = (0..4).collect();
    let assembly = assemble(&mechanism, &geometry, &parts, &held).unwrap();
    assert!(!assembly.closed && assembly.steps == 0);
}

#[test]
fn couplings_are_closed_too() {
    let mut builder = MechanismBuilder::new("geared");
    builder.link("ground");
    for (index, name) in ["p", "q"].into_iter().enumerate() {
        let shift = 10.0 * index as f64;
        let points: Vec<[f64; 2]> = CRANK_ROCKER.iter().map(|[x, y]| [x + shift, *y]).collect();
        add_ring(
            &mut builder,
            name,
            "ground",
            &planar(&points),
            [0.0; 3],
            Written::Exactly,
        );
    }
    builder.mimic("q_a", "p_a", number(-2.0), number(0.25));
    let mechanism = builder.build().unwrap();
    let (_, assembly) = assembled(&mechanism, &[]);
    assert!(assembly.closed);
    let value = |name: &str| assembly.states[mechanism.joint_named(name).unwrap().0].values[0];
    assert!((value("q_a") + 2.0 * value("p_a") - 0.25).abs() < 1e-13);
}

#[test]
fn numbers_of_few_digits_close_within_them_and_no_further() {
    // A Sarrus linkage whose gap is what four decimals leave open, and one that is ten times more.
    let close = |gap: f64| {
        let mut places = sarrus_places();
        places[0].1[0] += 0.3333;
        let places: Vec<Place> = places
            .into_iter()
            .map(|(kind, at, u)| (kind, at.map(|x| (x * 1e4).round() / 1e4), u))
            .collect();
        // Across both planes of motion nothing can give way; tilt one axis to make the gap.
        let mut tilted = places;
        tilted[4].2 = [gap, 1.0, gap];
        let mechanism = ring(&tilted, [0.0, 0.0, gap], Written::Decimals(4));
        assembled(&mechanism, &[]).1
    };
    let within = close(1e-4);
    assert!(within.closed && within.residual <= within.tolerance);
    assert!(within.tolerance < 0.02 && within.tolerance > 1e-4);
}

#[test]
fn digits_lost_to_distance_do_not_count_as_closed() {
    // A four-bar of metres whose frames are 1e17 m away: rounding alone exceeds its size.
    let points: Vec<[f64; 2]> = CRANK_ROCKER
        .iter()
        .map(|[x, y]| [x * 1e-3, y * 1e-3])
        .collect();
    let places: Vec<Place> = planar(&points);
    let mut builder = MechanismBuilder::new("far");
    builder.link("ground");
    let far: Vec<Place> = places
        .iter()
        .map(|(kind, [x, y, z], u)| (*kind, [x + 1e17, *y, *z], *u))
        .collect();
    add_ring(
        &mut builder,
        "r",
        "ground",
        &far,
        [0.25, 0.0, 0.5],
        Written::Exactly,
    );
    let mechanism = builder.build().unwrap();
    let (_, assembly) = assembled(&mechanism, &[]);
    assert!(assembly.tolerance <= 0.02);
}

#[test]
fn parts_close_independently_of_each_other() {
    let alone = {
        let mechanism = ring(&planar(&CRANK_ROCKER), [0.5, -0.25, 0.0], Written::Exactly);
        assembled(&mechanism, &[]).1
    };
    let mut builder = MechanismBuilder::new("two");
    builder.link("ground");
    add_ring(
        &mut builder,
        "other",
        "ground",
        &sarrus_places(),
        [0.1, 0.0, 0.2],
        Written::Exactly,
    );
    add_ring(
        &mut builder,
        "r",
        "ground",
        &planar(&CRANK_ROCKER),
        [0.5, -0.25, 0.0],
        Written::Exactly,
    );
    let mechanism = builder.build().unwrap();
    let (_, both) = assembled(&mechanism, &[]);
    assert!(both.closed);
    for (letter, state) in ["a", "b", "c", "d"].into_iter().zip(&alone.states) {
        let joint = mechanism.joint_named(&format!("r_{letter}")).unwrap().0;
        assert_eq!(both.states[joint].values, state.values);
    }
}

#[test]
fn following_a_motion_ends_on_it_and_puts_the_states_back() {
    let mechanism = four_bar();
    let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
    let part = the_part(&mechanism);
    let mut states = geometry.states.clone();
    let direction = [0.05, 0.0, 0.0, 0.0];
    let turned = follow(
        &mechanism,
        &geometry,
        &mut states,
        &part,
        &direction,
        |there| {
            let here = jacobian(&mechanism, &geometry, there, &part)?;
            assert!(largest(&here.residual) < 1e-13);
            Ok(there[0].values[0])
        },
    );
    assert!(turned.unwrap().unwrap().abs() > 0.01);
    assert!(states.iter().all(|state| state.values == [0.0]));
    // A rigid loop cannot be followed anywhere else: it comes back, or does not close.
    let triangle = ring(&planar(&CRANK_ROCKER[..3]), [0.0; 3], Written::Exactly);
    let geometry = Geometry::new(&triangle, None, &Arithmetic::double());
    let part = the_part(&triangle);
    let mut states = geometry.states.clone();
    let back = follow(
        &triangle,
        &geometry,
        &mut states,
        &part,
        &[0.05; 3],
        |there| Ok(there[0].values[0]),
    );
    assert!(back.unwrap().is_none_or(|turned| turned.abs() < 1e-9));
}

#[test]
fn refining_reaches_the_digits_of_the_arithmetic() {
    let mechanism = ring(&planar(&CRANK_ROCKER), [0.5, -0.25, 0.0], Written::Exactly);
    let (double, assembly) = assembled(&mechanism, &[]);
    let part = the_part(&mechanism);
    let geometry = Geometry::new(&mechanism, None, &Arithmetic::bits(212));
    let mut states: Vec<_> = geometry
        .displacements
        .iter()
        .zip(double.displacements.iter().zip(&assembly.states))
        .map(|(joint, (double, state))| joint.adopt(double, state))
        .collect();
    let left = refine(&mechanism, &geometry, &mut states, &part, &BTreeSet::new()).unwrap();
    assert!(left < 1e-60, "{left:e}");
    // Held joints keep their digits.
    let before = states[0].values[0].clone();
    let held = BTreeSet::from([0]);
    refine(&mechanism, &geometry, &mut states, &part, &held).unwrap();
    assert_eq!(states[0].values[0], before);
}

#[test]
fn poses_follow_the_joints_and_the_ground_stays() {
    let mechanism = four_bar();
    let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
    let (poses, in_tree) = spanning_poses(&mechanism, &geometry, &geometry.states);
    for (pose, home) in poses.iter().zip(&geometry.home) {
        assert!(length(&subtract(&pose.translation, &home.translation)) < 1e-15);
    }
    assert_eq!(in_tree, [true, true, true, false]);
}

#[test]
fn a_nan_is_the_largest() {
    assert_eq!(largest(&[1.0, -3.0, 2.0]), 3.0);
    assert!(largest(&[1.0, f64::NAN, 2.0]).is_nan());
    assert_eq!(largest(&[]), 0.0);
    assert_eq!(largest(&[1.0, f64::NEG_INFINITY]), f64::INFINITY);
}

#[test]
fn joints_of_many_kinds_come_together() {
    let places: Vec<Place> = vec![
        (JointKind::Revolute, [0.0, 0.0, 0.0], [0.0, 0.5, 1.0]),
        (JointKind::Spherical, [1.0, 0.5, 0.0], [1.0, 0.0, 0.0]),
        (JointKind::Cylindrical, [2.0, 0.0, 0.5], [1.0, 0.25, 0.0]),
        (JointKind::Screw, [2.0, -1.0, 0.0], [0.0, 1.0, 1.0]),
        (JointKind::Planar, [1.0, -2.0, 0.0], [0.5, 1.0, 0.0]),
        (JointKind::PointOnPlane, [0.5, -1.0, 0.0], [0.0, 0.0, 1.0]),
    ];
    let mechanism = ring(&places, [0.25, -0.125, 0.5], Written::Exactly);
    let (_, assembly) = assembled(&mechanism, &[]);
    assert!(assembly.closed && assembly.steps < 10, "{assembly:?}");
}
