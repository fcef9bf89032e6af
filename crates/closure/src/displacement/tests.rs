use super::*;
use kutzbach_math::matrix::{Big, Ring, SplitMix64};

const AXIS: Vector<f64> = [0.5, -1.0, 0.25];
const SECOND: Vector<f64> = [0.25, 0.75, 1.0];
/// Metres per radian, and metres.
const PITCH: f64 = 0.15;
const DISTANCE: f64 = 0.7;

fn joint(kind: JointKind) -> JointDisplacement<f64> {
    JointDisplacement::new(kind, &AXIS, &SECOND, &PITCH, &DISTANCE)
}

fn joint_in(kind: JointKind, bits: u32) -> JointDisplacement<Big> {
    let many = |v: Vector<f64>| v.map(|x| Big::new(x, bits));
    JointDisplacement::new(
        kind,
        &many(AXIS),
        &many(SECOND),
        &Big::new(PITCH, bits),
        &Big::new(DISTANCE, bits),
    )
}

/// Random values: rotations up to ±3.1 rad, screws over several turns, translations up to ±3.1 m.
fn random_values(kind: JointKind, random: &mut SplitMix64) -> Vec<f64> {
    let turns = if kind.uses_lead() { 6.0 } else { 1.0 };
    let values = (0..kind.freedom()).map(|_| 3.1 * random.symmetric());
    values
        .enumerate()
        .map(|(i, x)| {
            if i + 1 == kind.freedom() {
                x * turns
            } else {
                x
            }
        })
        .collect()
}

fn apart(a: &Rigid<f64>, b: &Rigid<f64>) -> f64 {
    let off = a.inverse().compose(b);
    length(&off.translation) + length(&off.rotation_vector())
}

#[test]
fn every_kind_has_as_many_variables_as_freedoms() {
    for kind in JointKind::ALL {
        let joint = joint(kind);
        let generators: usize = joint.factors.iter().map(|f| f.generators.len()).sum();
        assert_eq!(generators, kind.freedom(), "{kind}");
        assert_eq!(joint.freedom(), kind.freedom());
        assert_eq!(joint.home().values.len(), kind.freedom());
        assert_eq!(joint.screws(&joint.home()).len(), kind.freedom());
    }
}

#[test]
fn variables_are_what_the_kind_calls_them() {
    use kutzbach_model::mechanism::FreedomPart;
    for kind in JointKind::ALL {
        let joint = joint(kind);
        for (screw, part) in joint.screws(&joint.home()).iter().zip(kind.freedoms()) {
            let turns = length(&screw.angular) > 0.5;
            let slides = length(&screw.linear) > 0.0;
            let found = match (turns, slides) {
                (true, false) => FreedomPart::Rotation,
                (false, true) => FreedomPart::Translation,
                _ => FreedomPart::Screw,
            };
            assert_eq!(found, *part, "{kind}");
        }
    }
}

#[test]
fn home_is_the_identity_for_kinds_that_meet_there() {
    for kind in JointKind::ALL {
        let joint = joint(kind);
        let off = apart(&joint.displacement(&joint.home()), &Rigid::identity(&0.0));
        match kind {
            JointKind::Distance => assert!((off - DISTANCE).abs() < 1e-15),
            // The line is turned into the plane; the two are not perpendicular here.
            JointKind::LineOnPlane => assert!(off > 0.1),
            _ => assert_eq!(off, 0.0, "{kind}"),
        }
    }
}

#[test]
fn screws_are_the_derivative_of_the_displacement() {
    // Central differences in 212 bits with a step of 1e-20: their error is of the order of 1e-40.
    let bits = 212;
    let step = Big::new(1e-20, bits);
    for kind in JointKind::ALL {
        let joint = joint_in(kind, bits);
        let mut random = SplitMix64::named(kind.word());
        let values = random_values(kind, &mut random)
            .into_iter()
            .map(|x| Big::new(x, bits));
        let state = joint.at(&values.collect::<Vec<_>>());
        let here = joint.displacement(&state);
        for (variable, screw) in joint.screws(&state).iter().enumerate() {
            let shifted = |by: &Big| {
                let mut state = state.clone();
                let mut increments = vec![by.zero_like(); kind.freedom()];
                increments[variable] = by.clone();
                joint.advance(&mut state, &increments);
                joint.displacement(&state)
            };
            let (ahead, behind) = (shifted(&step), shifted(&-step.clone()));
            let double = step.clone() + step.clone();
            let turned = ahead.compose(&behind.inverse()).rotation_vector();
            let angular = turned.map(|x| x / double.clone());
            assert!(
                length(&subtract(&angular, &screw.angular)).to_f64() < 1e-35,
                "{kind}"
            );
            // The successor's own origin moves as the twist says.
            let way = subtract(&ahead.translation, &behind.translation);
            let velocity = way.map(|x| x / double.clone());
            let (_, expected) = screw.about(&here.translation);
            assert!(
                length(&subtract(&velocity, &expected)).to_f64() < 1e-35,
                "{kind}"
            );
        }
    }
}

#[test]
fn fitting_finds_every_displacement_again() {
    for kind in JointKind::ALL {
        let joint = joint(kind);
        let mut random = SplitMix64::named(kind.word());
        for _ in 0..200 {
            let values = random_values(kind, &mut random);
            let wanted = joint.displacement(&joint.at(&values));
            let found = joint.displacement(&joint.fit(&wanted));
            assert!(apart(&wanted, &found) < 1e-13, "{kind}: {values:?}");
        }
    }
}

#[test]
fn fitting_counts_the_turns_of_screws() {
    let screw = joint(JointKind::Screw);
    for value in [-40.0, -3.2, 3.1, 3.2, 6.5, 100.0] {
        let state = screw.fit(&screw.displacement(&screw.at(&[value])));
        assert!((state.values[0] - value).abs() < 1e-12, "{value}");
    }
    // Without a lead there is nothing to count by.
    let flat = JointDisplacement::new(JointKind::Screw, &AXIS, &SECOND, &0.0, &0.0);
    let state = flat.fit(&flat.displacement(&flat.at(&[7.0])));
    assert!((state.values[0] - (7.0 - std::f64::consts::TAU)).abs() < 1e-14);
}

#[test]
fn fitting_projects_what_the_joint_cannot_do() {
    let wanted = Rigid::exponential(&[0.0, 0.0, 0.3], &[0.0, 0.0, 0.0]);
    let mut wanted = wanted;
    wanted.translation = [0.1, -0.2, 0.5];
    let axis = [0.0, 0.0, 2.0];
    let cylinder = JointDisplacement::new(JointKind::Cylindrical, &axis, &axis, &0.0, &0.0);
    let state = cylinder.fit(&wanted);
    assert!((state.values[0] - 0.5).abs() < 1e-15 && (state.values[1] - 0.3).abs() < 1e-15);
    let rod = JointDisplacement::new(JointKind::Distance, &axis, &axis, &0.0, &2.0);
    let reached = rod.displacement(&rod.fit(&wanted));
    assert!((length(&reached.translation) - 2.0).abs() < 1e-15);
    assert!(length(&cross(&reached.translation, &wanted.translation)) < 1e-15);
}

/// What each kind of joint keeps, whatever its state.
#[test]
fn displacements_keep_what_defines_the_kind() {
    let (axis, second) = (unit(&AXIS), unit(&SECOND));
    let near = |x: f64, y: f64| (x - y).abs() < 1e-13;
    let same = |a: &Vector<f64>, b: &Vector<f64>| length(&subtract(a, b)) < 1e-13;
    for kind in JointKind::ALL {
        let joint = joint(kind);
        let mut random = SplitMix64::named(kind.word());
        for _ in 0..20 {
            let values = random_values(kind, &mut random);
            let d = joint.displacement(&joint.at(&values));
            let t = d.translation;
            let still = same(&t, &[0.0; 3]);
            let unturned = length(&d.rotation_vector()) < 1e-13;
            let keeps_axis = same(&d.rotate(&axis), &axis);
            let in_plane = near(dot(&t, &axis), 0.0);
            let along_axis = length(&cross(&t, &axis)) < 1e-13;
            // The predecessor's origin as the successor sees it.
            let origin = d.inverse().translation;
            let turn = values.last().copied().unwrap_or(0.0);
            let holds = match kind {
                JointKind::Fixed => still && unturned,
                JointKind::Revolute => still && keeps_axis,
                JointKind::Prismatic => unturned && along_axis && near(dot(&t, &axis), turn),
                JointKind::Screw => keeps_axis && along_axis && near(dot(&t, &axis), PITCH * turn),
                JointKind::Cylindrical => keeps_axis && along_axis,
                // The angle between the first axis and the second is that at home.
                JointKind::Universal => {
                    still && near(dot(&axis, &d.rotate(&second)), dot(&axis, &second))
                }
                JointKind::PlanarTranslation => unturned && in_plane,
                JointKind::Planar => keeps_axis && in_plane,
                JointKind::Spherical => still,
                JointKind::Translational => unturned,
                JointKind::TranslatingScrew => keeps_axis && near(dot(&t, &axis), PITCH * turn),
                JointKind::Schoenflies => keeps_axis,
                JointKind::PointOnLine => length(&cross(&origin, &second)) < 1e-13,
                JointKind::PointOnPlane => near(dot(&origin, &second), 0.0),
                JointKind::LineOnPlane => {
                    let line = d.rotate_back(&axis);
                    near(dot(&origin, &second), 0.0) && near(dot(&line, &second), 0.0)
                }
                JointKind::Distance => near(length(&t), DISTANCE),
            };
            assert!(holds, "{kind} at {values:?}");
        }
    }
}

#[test]
fn a_line_finds_its_plane_whatever_the_normal() {
    // Parallel and nearly parallel directions leave nothing of the normal but rounding errors.
    for (axis, normal) in [
        ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0]),
        ([0.3, -0.7, 0.2], [-0.3, 0.7, -0.2]),
        ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0 + 1e-12]),
        ([1.0, 0.0, 0.0], [1.0, 1e-2, 0.0]),
        ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ] {
        let joint = JointDisplacement::new(JointKind::LineOnPlane, &axis, &normal, &0.0, &0.0);
        let d = joint.displacement(&joint.at(&[0.4, 0.1, -0.2, 1.1]));
        let normal = d.rotate(joint.second_axis());
        assert!(
            dot(&normal, joint.axis()).abs() < 1e-15,
            "{axis:?} {normal:?}"
        );
        assert!(apart(&joint.displacement(&joint.fit(&d)), &d) < 1e-13);
    }
}

#[test]
fn rods_point_anywhere() {
    let rod = joint(JointKind::Distance);
    for to in [
        [-0.7, 0.0, 0.0],
        [-0.7, 1e-17, -1e-17],
        [-0.7, 1e-9, 0.0],
        [0.7, 1e-17, 0.0],
        [0.0, 0.0, 0.7],
    ] {
        let mut wanted = Rigid::exponential(&[0.2, 2.0, -1.0], &[0.0; 3]);
        wanted.translation = to;
        assert!(
            apart(&rod.displacement(&rod.fit(&wanted)), &wanted) < 1e-15,
            "{to:?}"
        );
    }
}

#[test]
fn states_are_adopted_by_other_arithmetics() {
    for kind in JointKind::ALL {
        let (double, many) = (joint(kind), joint_in(kind, 212));
        let mut random = SplitMix64::named(kind.word());
        for _ in 0..10 {
            let state = double.at(&random_values(kind, &mut random));
            let adopted = many.adopt(&double, &state);
            let reached = many.displacement(&adopted);
            let rounded = Rigid {
                rotation: reached.rotation.clone().map(|row| row.map(|x| x.to_f64())),
                translation: reached.translation.clone().map(|x| x.to_f64()),
            };
            assert!(
                apart(&rounded, &double.displacement(&state)) < 2e-14,
                "{kind}"
            );
            // It is a displacement of the joint to the last bit, not a rounded one.
            let again = many.displacement(&many.fit(&reached));
            let off = again.inverse().compose(&reached);
            assert!(length(&off.translation).to_f64() < 1e-60, "{kind}");
            assert!(length(&off.rotation_vector()).to_f64() < 1e-60, "{kind}");
        }
    }
}

#[test]
fn directions_in_a_plane_may_differ_between_arithmetics() {
    // The same normal but for the last digit, which decides what is its smallest component.
    let double = JointDisplacement::new(
        JointKind::Planar,
        &[1.0 - 1e-16, 1.0, 5.0],
        &SECOND,
        &0.0,
        &0.0,
    );
    let other = JointDisplacement::new(
        JointKind::Planar,
        &[1.0, 1.0 - 1e-16, 5.0],
        &SECOND,
        &0.0,
        &0.0,
    );
    assert!(length(&subtract(&double.across().0, &other.across().0)) > 0.1);
    let state = double.at(&[0.3, -0.8, 0.5]);
    let adopted = other.adopt(&double, &state);
    assert!(apart(&other.displacement(&adopted), &double.displacement(&state)) < 1e-14);
}

#[test]
fn increments_lead_from_one_state_to_another() {
    let mut random = SplitMix64::new(5);
    for kind in JointKind::ALL {
        let joint = joint(kind);
        for _ in 0..20 {
            let from = joint.at(&random_values(kind, &mut random));
            let mut to = from.clone();
            let small: Vec<f64> = (0..kind.freedom())
                .map(|_| 0.01 * random.symmetric())
                .collect();
            joint.advance(&mut to, &small);
            let found = joint.increments(&from, &to);
            for (a, b) in found.iter().zip(&small) {
                assert!((a - b).abs() < 1e-13, "{kind}: {found:?} for {small:?}");
            }
            let mut again = from.clone();
            joint.advance(&mut again, &found);
            assert!(apart(&joint.displacement(&again), &joint.displacement(&to)) < 1e-13);
        }
    }
}
