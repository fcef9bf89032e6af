use super::*;
use crate::families::scissor_lift;
use crate::{AnalysisOptions, analyse};
use kutzbach_closure::Arithmetic;
use kutzbach_closure::samples::{
    CRANK_ROCKER, Place, Written, add_ring, flat_parallelogram, four_bar, general_four, planar,
    ring, sarrus, sarrus_places, spherical,
};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind, MechanismBuilder};
use proptest::prelude::*;

const O: [f64; 3] = [0.0; 3];
const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

pub(super) fn findings(mechanism: &Mechanism) -> Vec<SubgroupFinding> {
    let analysis = analyse(mechanism, &AnalysisOptions::default()).unwrap();
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let structure = &analysis.structure;
    structure
        .parts
        .iter()
        .zip(&analysis.parts)
        .map(|(part, rank)| {
            let states = &analysis.assembly.states;
            subgroup_finding(mechanism, &geometry, states, structure, part, rank).unwrap()
        })
        .collect()
}

pub(super) fn finding(mechanism: &Mechanism) -> SubgroupFinding {
    let mut all = findings(mechanism);
    assert_eq!(all.len(), 1);
    all.remove(0)
}

fn exactly(places: &[Place]) -> Mechanism {
    ring(places, O, Written::Exactly)
}

pub(super) fn answer(finding: &SubgroupFinding) -> (Option<usize>, Option<MobilityClass>) {
    (finding.finite, finding.class)
}

const TRIVIAL: Option<MobilityClass> = Some(MobilityClass::Trivial);
const EXCEPTIONAL: Option<MobilityClass> = Some(MobilityClass::Exceptional);

/// A joint of a network: name, kind, its two links, where it is and along which axis.
pub(super) type Between<'a> = (&'a str, JointKind, &'a str, &'a str, [f64; 3], [f64; 3]);

/// Joints between links that all have the world's frame at home.
pub(super) fn network(joints: &[Between]) -> Mechanism {
    let mut builder = MechanismBuilder::new("network");
    builder.link("a");
    let mut known = vec!["a"];
    let exactly = Written::Exactly;
    for (_, _, from, to, _, _) in joints {
        for link in [from, to] {
            if !known.contains(link) {
                known.push(link);
                builder.link(link);
                builder.floating(&format!("place_{link}"), "a", link, Frame::identity());
            }
        }
    }
    for (name, kind, from, to, at, along) in joints {
        let frame = || Frame::at(at.map(|x| exactly.number(x)));
        let mut joint = JointBuilder::closing(name, *kind, from, to)
            .origin(frame())
            .successor_origin(frame());
        if kind.uses_axis() {
            joint = joint.axis(kutzbach_model::mechanism::Direction(
                along.map(|x| exactly.number(x)),
            ));
        }
        builder.joint(joint);
    }
    builder.build().unwrap()
}

#[test]
fn all_displacements_of_a_loop_in_one_subgroup() {
    let found = finding(&four_bar());
    assert_eq!(answer(&found), (Some(1), TRIVIAL));
    assert_eq!((found.lower, found.upper), (1, Some(1)));
    assert!(found.steps.is_empty() && found.margin > 1e3);
    assert_eq!(
        found.text,
        "every displacement of the loop `r_a` `r_b` `r_c` `r_d` lies in G (planar motion normal to (0, 0, 1)); its 3 \
         equations are independent"
    );
    let ball = finding(&exactly(&spherical([0.5, 0.0, 1.0], [1.0, 0.5, 2.0, 1.0])));
    assert_eq!(answer(&ball), (Some(1), TRIVIAL));
    assert!(
        ball.text
            .contains("S (rotation about the point (0.5, 0, 1))"),
        "{}",
        ball.text
    );
}

#[test]
fn two_chains_that_generate_subgroups() {
    let found = finding(&sarrus());
    assert_eq!(answer(&found), (Some(1), EXCEPTIONAL));
    assert_eq!(found.steps.len(), 1);
    assert_eq!(
        found.text,
        "chain `r_a` `r_b` `r_c` generates G (planar motion normal to (1, 0, 0)), chain `r_d` `r_e` `r_f` generates G \
         (planar motion normal to (0, 1, 0)); they meet in T (translation along (0, 0, 1)); the 5 equations that the loops still \
         ask for are independent"
    );
}

/// The middle hinge of one side in the plane of the other two: both sides fold flat, and each spans two dimensions only.
#[test]
fn chains_that_do_not_span_prove_nothing() {
    let mut places = sarrus_places();
    places[1].1 = [0.0, -1.0, 1.0];
    places[4].1 = [1.0, 0.0, 1.0];
    let found = finding(&exactly(&places));
    assert_eq!(answer(&found), (None, None));
    assert!(found.upper > Some(1) && found.lower == 0);
    let flat = finding(&flat_parallelogram());
    assert_eq!(answer(&flat), (None, None));
    assert_eq!((flat.lower, flat.upper), (0, Some(2)));
}

#[test]
fn what_no_velocity_moves_stands() {
    let found = finding(&general_four());
    assert_eq!(answer(&found), (Some(0), None));
    assert!(found.text.contains("no velocity"));
}

/// An Oldham coupling whose slides may turn: they do not, and what remains is planar. The slides have to be taken apart,
/// one from its beginning and one from its end.
#[test]
fn joints_are_taken_apart() {
    let c = JointKind::Cylindrical;
    let r = JointKind::Revolute;
    let found = finding(&exactly(&[
        (r, O, Z),
        (c, [0.25, 0.5, 0.0], X),
        (c, [0.5, 0.25, 0.0], Y),
        (r, [1.0, 0.0, 0.0], Z),
    ]));
    assert_eq!(answer(&found), (Some(1), EXCEPTIONAL));
    for part in [
        "`r_b` stays in T (translation along (1, 0, 0))",
        "`r_c` stays in T (translation along (0, 1, 0))",
    ] {
        assert!(found.text.contains(part), "{}", found.text);
    }
}

/// ```text
///        c1 --- p2, p1 --- a      cranks d-a, e-b of a parallelogram, coupler b,
///   a --d1-- d --d2-- b           and slides along x and y between ground and coupler
///   a --e1-- e --e2-- b
/// ```
/// With equal and parallel cranks the coupler is translated, which the slides let it. With cranks that are only parallel at
/// the pose it turns as soon as it moves, which they do not.
fn coupler_on_slides(second_crank: f64) -> Mechanism {
    use JointKind::{Prismatic, Revolute};
    network(&[
        ("d1", Revolute, "a", "d", O, Z),
        ("d2", Revolute, "d", "b", [0.5, 1.0, 0.0], Z),
        ("e1", Revolute, "a", "e", [2.0, 0.0, 0.0], Z),
        (
            "e2",
            Revolute,
            "e",
            "b",
            [2.0 + 0.5 * second_crank, second_crank, 0.0],
            Z,
        ),
        ("p1", Prismatic, "a", "c", O, X),
        ("p2", Prismatic, "c", "b", O, Y),
    ])
}

#[test]
fn a_parallelogram_translates() {
    let found = finding(&coupler_on_slides(1.0));
    assert_eq!(answer(&found), (Some(1), EXCEPTIONAL), "{}", found.text);
    assert!(found.text.contains("parallelogram"), "{}", found.text);
    let shaky = finding(&coupler_on_slides(1.5));
    assert_eq!(shaky.upper, Some(1), "at the pose it is as mobile");
    assert_eq!(answer(&shaky), (None, None), "{}", shaky.text);
}

/// A parallelogram, and a third bar parallel to its cranks: the coupler's translation is that of the cranks, and not of the bar.
#[test]
fn a_parallel_bar_of_another_length_is_no_crank() {
    let with_bar = |length: f64| {
        use JointKind::Revolute;
        finding(&network(&[
            ("a0", Revolute, "a", "d", O, Z),
            ("b0", Revolute, "d", "b", [0.0, 2.0, 0.0], Z),
            ("a1", Revolute, "a", "e", [4.0, 0.0, 0.0], Z),
            ("b1", Revolute, "e", "b", [4.0, 2.0, 0.0], Z),
            ("a2", Revolute, "a", "f", [9.0, 1.0, 0.0], Z),
            ("b2", Revolute, "f", "b", [9.0, 1.0 + length, 0.0], Z),
        ]))
    };
    for length in [2.0 + 1e-6, 2.3, 1.0] {
        let found = with_bar(length);
        assert_eq!(found.upper, Some(1), "at the pose it moves");
        assert_eq!(answer(&found), (None, None), "{length}: {}", found.text);
    }
}

/// Six slides along z, one of them made of two cylindrical joints, on the edges of a tetrahedron: no two are in series or
/// in parallel.
#[test]
fn networks_that_are_neither_series_nor_parallel() {
    use JointKind::{Cylindrical, Prismatic};
    let found = finding(&network(&[
        ("c1", Cylindrical, "a", "b", O, Z),
        ("c2", Cylindrical, "a", "b", X, Z),
        ("p1", Prismatic, "a", "c", O, Z),
        ("p2", Prismatic, "a", "d", O, Z),
        ("p3", Prismatic, "b", "c", O, Z),
        ("p4", Prismatic, "b", "d", O, Z),
        ("p5", Prismatic, "c", "d", O, Z),
    ]));
    // Every loop lies in the translations along z once the two cylinders do not turn.
    assert_eq!(answer(&found), (Some(3), EXCEPTIONAL), "{}", found.text);
    assert!(found.text.contains("`c1` stays in T"), "{}", found.text);
}

/// A Sarrus linkage whose two sides carry six-freedom chains to a further link: they hold nothing.
#[test]
fn chains_without_effect_hold_nothing() {
    use JointKind::{Spherical, Translational};
    let mut joints = Vec::new();
    let links = ["a", "s1", "s2", "b", "s3", "s4", "a"];
    let names = ["r1", "r2", "r3", "r4", "r5", "r6"];
    for (i, (kind, at, along)) in sarrus_places().into_iter().enumerate() {
        joints.push((names[i], kind, links[i], links[i + 1], at, along));
    }
    for (ball, slide, middle, from, to) in [
        ("t1", "u1", "m1", "s1", "s3"),
        ("t2", "u2", "m2", "s2", "s4"),
        ("t3", "u3", "m3", "s1", "b"),
    ] {
        joints.push((ball, Spherical, from, middle, [0.5, 0.25, 1.0], Z));
        joints.push((slide, Translational, middle, to, O, Z));
    }
    let found = finding(&network(&joints));
    assert_eq!(answer(&found), (Some(1), EXCEPTIONAL), "{}", found.text);
}

#[test]
fn couplings_count_with_loop_spaces_and_with_what_loops_leave() {
    let mut builder = MechanismBuilder::new("coupled");
    builder.link("ground");
    let five = [[0.0, 0.0], [0.0, 2.0], [2.0, 4.0], [4.0, 5.0], [4.0, 0.0]];
    add_ring(
        &mut builder,
        "p",
        "ground",
        &planar(&five),
        O,
        Written::Exactly,
    );
    let mut alone = builder.clone();
    alone.mimic("p_b", "p_a", Number::one(), Number::zero());
    let found = finding(&alone.build().unwrap());
    assert_eq!(answer(&found), (Some(1), TRIVIAL));
    assert!(found.text.contains("coupling"), "{}", found.text);
    add_ring(
        &mut builder,
        "s",
        "ground",
        &sarrus_places(),
        O,
        Written::Exactly,
    );
    builder.mimic("s_b", "p_a", Number::one(), Number::zero());
    let found = finding(&builder.build().unwrap());
    // Two freedoms of the five-bar and one of Sarrus' loop, which no loop space explains, less one.
    assert_eq!(answer(&found), (Some(2), EXCEPTIONAL), "{}", found.text);
    assert!(found.text.contains("coupling"), "{}", found.text);
}

#[test]
fn rounded_numbers_are_read_within_their_precision() {
    let turned = |written| {
        let (s, c) = 0.3f64.sin_cos();
        let turn = |[x, y, z]: [f64; 3]| [c * x - s * y, s * x + c * y, z];
        let places: Vec<Place> = sarrus_places()
            .into_iter()
            .map(|(kind, at, along)| (kind, turn(at), turn(along)))
            .collect();
        finding(&ring(&places, O, written))
    };
    let found = turned(Written::Decimals(7));
    assert_eq!(answer(&found), (Some(1), EXCEPTIONAL), "{}", found.text);
    assert!(found.text.starts_with("within the stated precision, "));
    // A tilt at the limit of the precision may be meant or not.
    let mut tilted = sarrus_places();
    tilted[1].2 = [1.0, 0.002, 0.0];
    let open = finding(&ring(&tilted, O, Written::Decimals(3)));
    assert_eq!(answer(&open), (None, None), "{}", open.text);
    // Millimetres that are known to half a one: the equations are independent all the same.
    let points = [[0.0, 0.0], [0.003, 0.02], [0.04, 0.05], [0.04, 0.001]];
    let coarse = finding(&ring(&planar(&points), O, Written::Decimals(3)));
    assert_eq!(answer(&coarse), (Some(1), TRIVIAL));
    assert!(coarse.text.starts_with("within the stated precision, "));
}

#[test]
fn a_ladder_of_loops_is_told_in_one_sentence() {
    let found = finding(&scissor_lift(40).unwrap());
    assert_eq!(answer(&found), (Some(1), TRIVIAL));
    assert_eq!(
        found.text,
        "of the displacements around the loops, those of 41 loops each lie in G (planar motion); the 123 equations that \
         this leaves are independent"
    );
}

#[test]
fn the_order_of_the_file_changes_no_word() {
    let rings = |order: [usize; 2]| {
        let mut builder = MechanismBuilder::new("two");
        builder.link("ground");
        for i in order {
            let name = ["p", "q"][i];
            add_ring(
                &mut builder,
                name,
                "ground",
                &sarrus_places(),
                O,
                Written::Exactly,
            );
        }
        let mut found = findings(&builder.build().unwrap());
        found.sort_by(|a, b| a.text.cmp(&b.text));
        found
    };
    assert_eq!(rings([0, 1]), rings([1, 0]));
}

/// A rotation by `angle` about a direction, then a shift.
fn moved(places: &[Place], axis: [f64; 3], angle: f64, shift: [f64; 3]) -> Vec<Place> {
    use nalgebra::{Rotation3, Unit, Vector3};
    let turn = Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::from(axis)), angle);
    let place = |at: [f64; 3]| (turn * Vector3::from(at) + Vector3::from(shift)).into();
    places
        .iter()
        .map(|(kind, at, along)| (*kind, place(*at), (turn * Vector3::from(*along)).into()))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn where_the_world_is_changes_nothing(
        axis in prop::array::uniform3(-1.0..1.0f64),
        angle in -3.0..3.0f64,
        shift in prop::array::uniform3(-20.0..20.0f64),
    ) {
        prop_assume!(axis.iter().any(|x| x.abs() > 0.1));
        let (c, r) = (JointKind::Cylindrical, JointKind::Revolute);
        let mut flat = sarrus_places();
        flat[1].1 = [0.0, -1.0, 1.0];
        for places in [
            planar(&CRANK_ROCKER),
            planar(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [2.0, 0.0]]),
            sarrus_places(),
            flat,
            spherical([0.5, 0.0, 1.0], [1.0, 0.5, 2.0, 1.0]),
            vec![(r, O, Z), (c, [0.25, 0.5, 0.0], X), (c, [0.5, 0.25, 0.0], Y), (r, X, Z)],
            vec![(c, O, Z), (c, X, Z)],
        ] {
            let here = finding(&exactly(&places));
            let there = finding(&exactly(&moved(&places, axis, angle, shift)));
            prop_assert_eq!(answer(&here), answer(&there), "{} / {}", here.text, there.text);
            prop_assert_eq!((here.lower, here.upper), (there.lower, there.upper));
            prop_assert_eq!(here.steps.len(), there.steps.len());
        }
    }
}
