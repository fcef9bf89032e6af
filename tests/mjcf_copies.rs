//! MJCF: keys as configurations, and copies of what is in `<replicate>`.

use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::format::{FormatError, Reading, read};
use kutzbach::mechanism::Mechanism;

fn try_model(inside: &str) -> Result<Reading, FormatError> {
    read(&format!("<mujoco>{inside}</mujoco>"), "model.xml", &[])
}

fn model(inside: &str) -> Reading {
    try_model(inside).unwrap_or_else(|error| panic!("{error}\n{inside}"))
}

/// The configurations: names, joints, and values.
fn poses(reading: &Reading) -> Vec<(String, Vec<(String, f64)>)> {
    let mechanism = &reading.mechanism;
    let pose = |configuration: &kutzbach::mechanism::Configuration| {
        let positions = configuration.positions.iter().map(|(joint, values)| {
            let name = mechanism.joint(*joint).name.clone();
            (name, values[0].value())
        });
        (configuration.name.clone(), positions.collect())
    };
    mechanism.configurations().iter().map(pose).collect()
}

fn skipped(reading: &Reading) -> Vec<&str> {
    reading.skipped.iter().map(|skip| &skip.what[..]).collect()
}

const ARM: &str = r#"<worldbody><body name="base"><freejoint name="f"/>
    <body name="arm"><joint name="a" ref="90"/><body name="hand"><joint name="s" type="slide" ref="0.5"/></body></body>
    <body name="head"><joint name="b" type="ball"/></body></body></worldbody>"#;

#[test]
fn keys_are_configurations_from_the_pose_drawn() {
    let reading = model(&format!(
        r#"{ARM}<keyframe><key name="home" qpos="0 0 1 1 0 0 0 1.5 0.75 1 0 0 0"/><key qpos="0 0 1 1 0 0 0 0 0.5 1 0 0 0" qvel="0"/>
        <key name="short" qpos="1 2"/><key name="still"/></keyframe>"#
    ));
    let found = poses(&reading);
    let names: Vec<&str> = found.iter().map(|(name, _)| &name[..]).collect();
    assert_eq!(names, ["home", "key"]);
    let half_turn = std::f64::consts::FRAC_PI_2;
    for ((_, positions), expected) in found
        .iter()
        .zip([[1.5 - half_turn, 0.25], [-half_turn, 0.0]])
    {
        let joints: Vec<&str> = positions.iter().map(|(joint, _)| &joint[..]).collect();
        assert_eq!(joints, ["a", "s"]);
        for ((_, value), expected) in positions.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-12, "{positions:?}");
        }
    }
    assert_eq!(
        skipped(&reading),
        [
            "values of balls and floating bodies in <key>",
            "`qvel` of <key>",
            "<key> with 2 numbers in `qpos`, where the joints have 13",
            "<key> without `qpos`",
        ]
    );
}

#[test]
fn with_equalities_a_key_says_where_assembly_begins() {
    let tied = |rest: &str| {
        model(&format!(
            r#"<worldbody><body name="x"><joint name="a"/><body name="y" pos="1 0 0"><joint name="b"/></body></body></worldbody>
            <equality><joint joint1="b" joint2="a" polycoef="0 0.5 0 0 0"/></equality>
            <keyframe><key name="k" qpos="0.4 0.2"/></keyframe>{rest}"#
        ))
    };
    for motors in ["", r#"<actuator><motor joint="a"/></actuator>"#] {
        let reading = tied(motors);
        let values = vec![("a".to_owned(), 0.4), ("b".to_owned(), 0.2)];
        assert_eq!(poses(&reading), [("k".to_owned(), values)]);
        let configuration = reading.mechanism.configuration("k").unwrap();
        assert_eq!(configuration.held().count(), 0);
        assert_eq!(configuration.free.len(), 2);
        assert!(skipped(&reading).is_empty());
    }
}

#[test]
fn the_turn_of_a_ball_begins_where_its_quaternion_says() {
    let reading = model(
        r#"<worldbody><body name="x"><joint name="a"/></body>
        <body name="y"><joint name="b" type="ball"/></body>
        <body name="z"><frame euler="0 0 90"><joint name="c" type="ball"/></frame></body></worldbody>
        <equality><joint joint1="a" polycoef="0 1 0 0 0"/></equality>
        <keyframe><key name="k" qpos="0 -1 0 0 -1 1 0.1 0 0"/></keyframe>"#,
    );
    let configuration = reading.mechanism.configuration("k").unwrap();
    let named = |name: &str| {
        let id = reading.mechanism.joint_named(name).unwrap();
        let found = configuration.positions.iter().find(|(own, _)| *own == id);
        let values = found.unwrap().1.iter();
        values.map(|value| value.value()).collect::<Vec<f64>>()
    };
    // −(1, 0, 0, 1) is the quarter turn about z; (1, 0.1, 0, 0) one by 2 atan 0.1 about x of the body, which is −y of the turned frame.
    let quarter = std::f64::consts::FRAC_PI_2;
    let turned = 2.0 * 0.1f64.atan();
    for (found, expected) in [
        (named("b"), [0.0, 0.0, quarter]),
        (named("c"), [0.0, -turned, 0.0]),
    ] {
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-12, "{found:?} {expected:?}");
        }
    }
    assert_eq!(configuration.held().count(), 0);
}

#[test]
fn two_keys_of_one_name_are_an_error() {
    let error = try_model(
        r#"<worldbody><body><joint/></body></worldbody><keyframe><key name="k" qpos="0"/><key name="k" qpos="1"/></keyframe>"#,
    )
    .unwrap_err();
    assert!(error.message.contains("two configurations"), "{error}");
}

fn names(mechanism: &Mechanism) -> (Vec<&str>, Vec<&str>) {
    let links = mechanism.links().iter().map(|link| &link.name[..]);
    let joints = mechanism.joints().iter().map(|joint| &joint.name[..]);
    (links.collect(), joints.collect())
}

fn place(mechanism: &Mechanism, link: &str) -> [f64; 3] {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    geometry.home[mechanism.link_named(link).unwrap().0].translation
}

fn is_near(found: [f64; 3], expected: [f64; 3]) {
    for (a, b) in found.into_iter().zip(expected) {
        assert!((a - b).abs() < 1e-12, "{found:?} {expected:?}");
    }
}

#[test]
fn copies_are_what_they_are_written_out() {
    let copied = model(
        r#"<worldbody><replicate count="3" offset="0.1 0 0" sep="_"><body name="b" pos="0 1 0"><joint name="j" axis="0 1 0"/>
        <body name="c" pos="0 0 2"><joint name="k"/></body></body></replicate><body name="last"/></worldbody>
        <equality><joint name="e" joint1="j" joint2="k"/></equality><actuator><motor name="m" joint="j"/></actuator>"#,
    );
    let mut bodies = String::new();
    let (mut equalities, mut motors) = (String::new(), String::new());
    for i in 0..3 {
        bodies += &format!(
            r#"<body name="b_{i}" pos="0.{i} 1 0"><joint name="j_{i}" axis="0 1 0"/>
            <body name="c_{i}" pos="0 0 2"><joint name="k_{i}"/></body></body>"#
        );
        equalities += &format!(r#"<joint name="e_{i}" joint1="j_{i}" joint2="k_{i}"/>"#);
        motors += &format!(r#"<motor joint="j_{i}"/>"#);
    }
    let written = model(&format!(
        r#"<worldbody>{bodies}<body name="last"/></worldbody><equality>{equalities}</equality><actuator>{motors}</actuator>"#
    ));
    let (a, b) = (&copied.mechanism, &written.mechanism);
    assert_eq!(names(a), names(b));
    for (a, b) in a.joints().iter().zip(b.joints()) {
        assert_eq!(a.predecessor.frame, b.predecessor.frame);
        assert_eq!(a.kind, b.kind);
    }
    assert_eq!(a.actuated(), b.actuated());
    assert_eq!((a.couplings().len(), b.couplings().len()), (3, 3));
}

#[test]
fn copies_have_the_class_that_the_replicate_gives() {
    let reading = model(
        r#"<default><default class="q"><joint axis="0 1 0"/></default></default>
        <worldbody><replicate count="2" childclass="q" offset="1 0 0"><body name="b"><joint/></body></replicate></worldbody>"#,
    );
    for joint in reading.mechanism.joints() {
        // As MuJoCo 4.0.0 has them.
        let axis = joint.axis.0.each_ref().map(|part| part.value());
        assert_eq!(axis, [0.0, 1.0, 0.0], "{}", joint.name);
    }
}

#[test]
fn copies_are_moved_and_turned_again_and_again() {
    let around = model(
        r#"<worldbody><replicate count="4" euler="0 0 90"><body name="b" pos="1 0 0.5"><joint/></body></replicate></worldbody>"#,
    );
    let corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    for (i, [x, y]) in corners.into_iter().enumerate() {
        is_near(place(&around.mechanism, &format!("b{i}")), [x, y, 0.5]);
    }
    // As MuJoCo 4.0.0 has them.
    let moved = model(
        r#"<worldbody><replicate count="3" offset="1 0 0" euler="0 0 90"><body name="b" pos="0 1 0"><joint/></body></replicate></worldbody>"#,
    );
    for (i, at) in [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
        .into_iter()
        .enumerate()
    {
        is_near(place(&moved.mechanism, &format!("b{i}")), at);
    }
    // Angles are multiplied, which is not the turn done again.
    let tumbled = model(
        r#"<worldbody><replicate count="4" offset="0.3 -0.2 0.1" euler="20 30 0"><body name="b"><joint/></body></replicate></worldbody>"#,
    );
    let places = [
        ("b1", [0.3, -0.2, 0.1]),
        ("b2", [0.609808, -0.366255, -0.027978]),
        ("b3", [0.84641, -0.384602, -0.317258]),
    ];
    for (name, at) in places {
        let found = place(&tumbled.mechanism, name);
        for (a, b) in found.into_iter().zip(at) {
            assert!((a - b).abs() < 1e-6, "{name}: {found:?}");
        }
    }
    let turned = model(
        r#"<worldbody><frame euler="60 90 0"><body name="b"><joint/></body></frame></worldbody>"#,
    );
    let axis = |mechanism: &Mechanism, name: &str| {
        let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
        geometry.home[mechanism.link_named(name).unwrap().0].rotate(&[1.0, 2.0, 3.0])
    };
    is_near(axis(&tumbled.mechanism, "b3"), axis(&turned.mechanism, "b"));
}

/// A seventh of a turn in four decimals is three times as uncertain after three of them.
#[test]
fn copies_know_the_literals_that_they_are_multiples_of() {
    let inputs = |replicate: &str| {
        let reading = model(&format!(
            r#"<worldbody><replicate count="4" {replicate}><body name="b"><joint/></body></replicate></worldbody>"#
        ));
        let mechanism = &reading.mechanism;
        let joint = mechanism.joint(mechanism.joint_named("b3_joint").unwrap());
        let frame = &joint.predecessor.frame;
        let numbers = frame.position.iter().chain(&frame.roll_pitch_yaw);
        let of = |number: &kutzbach::number::Number| -> Vec<(String, f64)> {
            let all = number.inputs().iter();
            all.map(|own| (own.literal.literal_text().unwrap().to_owned(), own.slope))
                .collect()
        };
        numbers.map(of).collect::<Vec<_>>()
    };
    let is = |found: &[(String, f64)], expected: &[(&str, f64)]| {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for ((text, slope), (of, size)) in found.iter().zip(expected) {
            assert_eq!(text, of);
            assert!((slope - size).abs() < 1e-9, "{found:?}");
        }
    };
    let degrees = std::f64::consts::PI / 180.0;
    let along = inputs(r#"offset="0 0 0.1234" euler="0 0 51.4286""#);
    is(&along[0], &[]);
    is(&along[2], &[("0.1234", 3.0)]);
    is(&along[5], &[("51.4286", 3.0 * degrees)]);
    // The third offset is turned twice, the second once.
    let across = inputs(r#"offset="0.1234 0 0" euler="0 0 51.4286""#);
    let place = [("0.1234", 3.0), ("51.4286", 3.0 * 0.1234 * degrees)];
    is(&across[0], &place);
    is(&across[5], &[("51.4286", 3.0 * degrees)]);
    // Whole numbers were chosen.
    for numbers in inputs(r#"offset="0 0 2" euler="0 0 90""#) {
        is(&numbers, &[]);
    }
}

#[test]
fn replicates_inside_replicates_multiply() {
    let reading = model(
        r#"<worldbody><replicate count="2" offset="1 0 0" sep="-"><replicate count="11" sep="_" offset="0 1 0">
        <body name="b"><joint name="j"/></body></replicate></replicate></worldbody>
        <tendon><fixed name="t"><joint joint="j" coef="1"/></fixed></tendon><equality><tendon tendon1="t"/></equality>"#,
    );
    let (links, _) = names(&reading.mechanism);
    assert_eq!(links.len(), 23);
    assert_eq!(links[1..3], ["b_00-0", "b_01-0"]);
    assert_eq!(links[22], "b_10-1");
    is_near(place(&reading.mechanism, "b_10-1"), [1.0, 10.0, 0.0]);
    assert_eq!(reading.mechanism.couplings().len(), 22);
    // As many digits as the count has, which the last index need not have.
    for (count, last) in [(9, "b-8"), (10, "b-09"), (11, "b-10"), (100, "b-099")] {
        let copies = model(&format!(
            r#"<worldbody><replicate count="{count}" sep="-"><body name="b"/></replicate></worldbody>"#
        ));
        let (links, _) = names(&copies.mechanism);
        assert_eq!(links.last(), Some(&last));
    }
    let none = model(
        r#"<worldbody><replicate count="0"><body name="b"/></replicate><body name="c"/></worldbody>"#,
    );
    assert_eq!(names(&none.mechanism).0, ["world", "c"]);
}

#[test]
fn what_cannot_be_copied_is_told_with_its_place() {
    let pair = |equality: &str| {
        format!(
            "<worldbody><body><joint name='o'/></body><replicate count='2' offset='1 0 0'><body name='b'><joint name='j'/></body></replicate>\
             <replicate count='3' offset='0 1 0'><body name='c'/></replicate></worldbody>\n<equality>{equality}</equality>"
        )
    };
    for (inside, line, told) in [
        (
            "<worldbody>\n<replicate count='1000'>\n<replicate count='101'/></replicate></worldbody>".to_owned(),
            3,
            "more than 100000 copies",
        ),
        (
            "<worldbody><body>\n<replicate count='2'>\n<joint/></replicate></body></worldbody>".to_owned(),
            3,
            "cannot stand directly in <replicate>",
        ),
        (
            "<worldbody>\n<replicate count='-1'/></worldbody>".to_owned(),
            2,
            "how many copies",
        ),
        (
            "<worldbody>\n<replicate count='2'>\n<body name='b'>\n<joint type='x'/></body></replicate></worldbody>".to_owned(),
            4,
            "no type of joint `x`",
        ),
        (
            pair("<joint joint1='j' joint2='o'/>"),
            2,
            "`o` is in no <replicate>, and what <joint> names beside it is in one",
        ),
        (pair("<weld body1='b' body2='c'/>"), 2, "`c` is in other copies"),
        (pair("<joint joint1='j2' joint2='o'/>"), 2, "no joint `j2`"),
    ] {
        let error = try_model(&inside).unwrap_err();
        assert!(error.message.contains(told), "{error}");
        assert_eq!(error.line, line, "{error}");
    }
    // By the names of the copies.
    let mixed = model(&pair("<joint joint1='j1' joint2='o'/>"));
    assert_eq!(mixed.mechanism.couplings().len(), 1);
    // The world is in all copies.
    for ends in [
        "body1='b' body2='world'",
        "body2='b' body1='world'",
        "body1='b'",
    ] {
        let held = model(&pair(&format!("<connect {ends} anchor='0 0 0'/>")));
        let loops = held.mechanism.joints().iter().filter(|j| j.closes_loop);
        assert_eq!(loops.count(), 2, "{ends}");
    }
}
