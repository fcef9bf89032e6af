//! Generated mechanisms of every kind: what is written reads back the same.

use crate::format_support;

use format_support::difference;
use kutzbach::format::{ReadOptions, read_with, write};
use kutzbach::mechanism::{
    Direction, Dynamics, Expectation, Frame, Geometry, Inertial, JointBuilder, JointKind, Limit,
    MechanismBuilder, Scene, Shape,
};
use kutzbach::number::Number;
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;

/// Literals, fractions, doubles and expressions.
fn any_number() -> impl Strategy<Value = Number> {
    prop_oneof![
        "-?[0-9]{1,3}\\.[0-9]{0,20}".prop_map(|text| Number::decimal(&text).unwrap()),
        "-?[0-9]\\.?[0-9]{0,5}e-?[0-9]".prop_map(|text| Number::decimal(&text).unwrap()),
        (-100i64..100, 1i64..50).prop_map(|(a, b)| Number::ratio(a, b).unwrap()),
        (-1e3..1e3).prop_map(|x| Number::from_f64(x).unwrap()),
        (1u32..50, 1u32..12, -9i32..9).prop_map(|(a, b, c)| {
            let text = format!("sqrt({a})/{b} + {c}*cos(pi/{b}) - radians(30)");
            Number::expression(&text, &mut |_| Ok(None)).unwrap()
        }),
        Just(Number::zero()),
    ]
}

fn positive() -> impl Strategy<Value = Number> {
    "[1-9]\\.[0-9]{0,9}".prop_map(|text| Number::decimal(&text).unwrap())
}

fn frame() -> impl Strategy<Value = Frame> {
    let triple = || [any_number(), any_number(), any_number()];
    prop_oneof![
        Just(Frame::identity()),
        (triple(), triple()).prop_map(|(position, roll_pitch_yaw)| Frame {
            position,
            roll_pitch_yaw
        }),
        triple().prop_map(Frame::at),
    ]
}

fn direction() -> impl Strategy<Value = Direction> {
    [any_number(), any_number(), any_number()]
        .prop_map(Direction)
        .prop_filter("a direction is not zero", |direction| !direction.is_zero())
}

fn shape() -> impl Strategy<Value = Shape> {
    let geometry = prop_oneof![
        [positive(), positive(), positive()].prop_map(Geometry::Box),
        (positive(), positive()).prop_map(|(radius, length)| Geometry::Cylinder { radius, length }),
        (positive(), positive()).prop_map(|(radius, length)| Geometry::Capsule { radius, length }),
        positive().prop_map(Geometry::Sphere),
        (
            "\\PC{0,12}",
            option::of([positive(), positive(), positive()])
        )
            .prop_map(|(filename, scale)| Geometry::Mesh { filename, scale }),
    ];
    (option::of("\\PC{0,8}"), frame(), geometry).prop_map(|(name, origin, geometry)| Shape {
        name,
        origin,
        geometry,
    })
}

#[derive(Clone, Debug)]
struct JointPlan {
    kind: JointKind,
    parent: prop::sample::Index,
    successor: prop::sample::Index,
    frames: [Frame; 2],
    axes: [Option<Direction>; 2],
    lead: Number,
    distance: Number,
    dynamics: Option<(Option<Number>, Option<Number>)>,
    limit: Option<[Option<Number>; 4]>,
    independent: Option<bool>,
    floating: bool,
    position: Vec<Number>,
}

fn joint_plan() -> impl Strategy<Value = JointPlan> {
    let kind = prop::sample::select(JointKind::ALL.to_vec());
    let axis = || option::of(direction());
    let maybe = || option::of(any_number());
    (
        (
            kind,
            any::<prop::sample::Index>(),
            any::<prop::sample::Index>(),
        ),
        ([frame(), frame()], [axis(), axis()]),
        (any_number(), positive()),
        option::of((maybe(), maybe())),
        option::of([maybe(), maybe(), maybe(), maybe()]),
        (
            option::of(any::<bool>()),
            prop::bool::weighted(0.1),
            vec(any_number(), 5),
        ),
    )
        .prop_map(
            |(
                (kind, parent, successor),
                (frames, axes),
                (lead, distance),
                dynamics,
                limit,
                rest,
            )| JointPlan {
                kind,
                parent,
                successor,
                frames,
                axes,
                lead,
                distance,
                dynamics,
                limit,
                independent: rest.0,
                floating: rest.1,
                position: rest.2,
            },
        )
}

#[derive(Clone, Debug)]
struct Plan {
    name: String,
    prefix: String,
    tree: Vec<JointPlan>,
    loops: Vec<JointPlan>,
    inertial: Option<([Number; 6], Number, Frame)>,
    shapes: Vec<Shape>,
    ground: Option<prop::sample::Index>,
    mimic: Option<(Number, Number)>,
    ratio: Option<Number>,
    gravity: Option<[Number; 3]>,
    effects: [bool; 4],
    expected: (Option<usize>, Option<i64>, bool, bool, Option<Vec<usize>>),
}

fn plan() -> impl Strategy<Value = Plan> {
    let six = [
        any_number(),
        any_number(),
        any_number(),
        any_number(),
        any_number(),
        any_number(),
    ];
    (
        // Characters that XML must escape, white space, and letters of several bytes.
        ("[a-z<>&\"' \t\n\réλ]{0,8}", "[a-z<>&\"' \t\n\ré]{1,4}"),
        (vec(joint_plan(), 1..8), vec(joint_plan(), 0..4)),
        (option::of((six, positive(), frame())), vec(shape(), 0..3)),
        (
            option::of(any::<prop::sample::Index>()),
            option::of((any_number(), any_number())),
            option::of(any_number()),
        ),
        (
            option::of([any_number(), any_number(), any_number()]),
            any::<[bool; 4]>(),
        ),
        (
            option::of(0usize..9),
            option::of(-9i64..9),
            any::<bool>(),
            any::<bool>(),
            option::of(vec(0usize..4, 0..4)),
        ),
    )
        .prop_map(|(names, joints, solid, relations, scene, expected)| Plan {
            name: names.0,
            prefix: names.1,
            tree: joints.0,
            loops: joints.1,
            inertial: solid.0,
            shapes: solid.1,
            ground: relations.0,
            mimic: relations.1,
            ratio: relations.2,
            gravity: scene.0,
            effects: scene.1,
            expected,
        })
}

fn joint(plan: &JointPlan, mut builder: JointBuilder) -> JointBuilder {
    let kind = plan.kind;
    builder = builder
        .origin(plan.frames[0].clone())
        .successor_origin(plan.frames[1].clone());
    let [axis, axis2] = plan.axes.clone();
    if let Some(axis) = axis.filter(|_| kind.uses_axis()) {
        builder = builder.axis(axis);
    }
    let axis2 = match kind {
        JointKind::Universal => Some(across(plan.axes[0].as_ref(), axis2)),
        _ => axis2,
    };
    if let Some(axis2) = axis2.filter(|_| kind.uses_second_axis()) {
        builder = builder.axis2(axis2);
    }
    if kind.uses_lead() {
        builder = builder.lead(plan.lead.clone());
    }
    if kind == JointKind::Distance {
        builder = builder.distance(plan.distance.clone());
    }
    if let Some((damping, friction)) = plan.dynamics.clone() {
        builder = builder.dynamics(Dynamics { damping, friction });
    }
    if let Some([lower, upper, effort, velocity]) =
        plan.limit.clone().filter(|_| kind.freedom() == 1)
    {
        let ordered = !matches!((&lower, &upper), (Some(a), Some(b)) if a.value() > b.value());
        let (lower, upper) = if ordered {
            (lower, upper)
        } else {
            (upper, lower)
        };
        builder = builder.limit(Limit {
            lower,
            upper,
            effort,
            velocity,
        });
    }
    if let Some(independent) = plan.independent {
        builder = builder.independent(independent);
    }
    builder
}

/// The second axis of a universal joint, or another one where it is parallel to the first: x where none is given.
fn across(axis: Option<&Direction>, axis2: Option<Direction>) -> Direction {
    let x = Direction::x();
    let first = axis.unwrap_or(&x).0.each_ref().map(Number::value);
    let crosses = |other: &Direction| {
        let second = other.0.each_ref().map(Number::value);
        let minors =
            [(0, 1), (1, 2), (2, 0)].map(|(i, j)| first[i] * second[j] - first[j] * second[i]);
        let size = |v: [f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
        size(minors) > 1e-6 * size(first) * size(second)
    };
    let others = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|v| Direction::of(v).unwrap());
    let mut known = axis2.into_iter().chain(others);
    known.find(crosses).unwrap()
}

fn build(plan: &Plan) -> MechanismBuilder {
    let mut builder = MechanismBuilder::new(&plan.name);
    let link = |index: usize| format!("{}{index}", plan.prefix);
    let inertial = plan
        .inertial
        .clone()
        .map(|(inertia, mass, origin)| Inertial {
            origin,
            mass,
            inertia,
        });
    builder.detailed_link(
        &link(0),
        inertial,
        plan.shapes.clone(),
        plan.shapes.iter().rev().cloned().collect(),
    );
    let mut moving: Vec<String> = Vec::new();
    let mut positions = Vec::new();
    for (index, joint_plan) in plan.tree.iter().enumerate() {
        let (parent, child) = (link(joint_plan.parent.index(index + 1)), link(index + 1));
        let name = format!("{}j{index}", plan.prefix);
        builder.link(&child);
        if joint_plan.floating {
            builder.floating(&name, &parent, &child, joint_plan.frames[0].clone());
            continue;
        }
        let freedom = joint_plan.kind.freedom();
        if freedom == 1 {
            moving.push(name.clone());
        }
        if freedom > 0 {
            positions.push((name.clone(), joint_plan.position[..freedom].to_vec()));
        }
        builder.joint(joint(
            joint_plan,
            JointBuilder::tree(&name, joint_plan.kind, &parent, &child),
        ));
    }
    let links = plan.tree.len() + 1;
    for (index, joint_plan) in plan.loops.iter().enumerate() {
        let predecessor = joint_plan.parent.index(links);
        let successor = (predecessor + 1 + joint_plan.successor.index(links - 1)) % links;
        let name = format!("{}loop{index}", plan.prefix);
        let closing =
            JointBuilder::closing(&name, joint_plan.kind, &link(predecessor), &link(successor));
        builder.joint(joint(joint_plan, closing));
    }
    if let (Some((multiplier, offset)), [leader, .., follower]) = (&plan.mimic, moving.as_slice()) {
        builder.mimic(follower, leader, multiplier.clone(), offset.clone());
    }
    if let Some(ground) = plan.ground {
        builder.ground(&link(ground.index(links)));
    }
    builder.configuration("home & away", positions.clone());
    builder.configuration("empty", Vec::new());
    let [contact, limits, friction, damping] = plan.effects;
    if contact || limits {
        let gravity = plan.gravity.clone();
        let share = plan.ratio.clone();
        builder.scene(Scene {
            gravity,
            contact,
            restitution: share.filter(|share| contact && (0.0..=1.0).contains(&share.value())),
            limits,
            friction,
            damping,
            drives: Vec::new(),
        });
    }
    if let Some(driven) = moving.first().filter(|_| friction) {
        builder.drive(driven, plan.tree[0].distance.clone(), plan.ratio.clone());
    }
    let (finite, redundant, singular, locked, branch_dimensions) = plan.expected.clone();
    builder.expect(Expectation {
        finite,
        instantaneous: finite,
        redundant,
        kutzbach: redundant,
        pose: singular.then(|| "singular".to_owned()),
        kind: singular.then(|| "permanently_shaky".to_owned()),
        locked: locked.then(|| vec!["all".to_owned()]),
        idle: (!locked).then(Vec::new),
        branches: finite,
        branch_dimensions: branch_dimensions.map(|mut dimensions| {
            dimensions.sort_unstable();
            dimensions
        }),
    });
    builder
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    #[test]
    fn what_is_written_reads_back_the_same(plan in plan()) {
        let builder = build(&plan);
        let mut coupled = builder.clone();
        if let Some(ratio) = &plan.ratio {
            let last = plan.tree.len();
            coupled.coupling("belt", &format!("{}0", plan.prefix), &format!("{}{last}", plan.prefix), ratio.clone());
        }
        // Not every tree has a path that can be coupled.
        let mechanism = coupled.build().or_else(|_| builder.build()).unwrap();
        let text = write(&mechanism);
        // As written: a decimal that is a constant within its digits is one, and the builder's was not read.
        let literal = ReadOptions {
            literal: true,
            ..ReadOptions::default()
        };
        let reading = match read_with(&text, "written", &literal) {
            Ok(reading) => reading,
            Err(error) => return Err(TestCaseError::fail(format!("{error} {:?}\n{text}", error.help))),
        };
        prop_assert_eq!(difference(&mechanism, &reading.mechanism), None, "{}", text);
        // What is left out, or odd, is told.
        let left_out = ["without `lower` and `upper`", "x is taken", "looks like degrees", "the limits of"];
        let told = |message: &str| left_out.iter().any(|part| message.contains(part));
        prop_assert!(
            reading.warnings.iter().all(|w| told(&w.message)),
            "{:?}",
            reading.warnings
        );
        prop_assert!(reading.skipped.is_empty());
        prop_assert_eq!(write(&reading.mechanism), text);
    }
}
