//! MJCF: what its elements become, against what they mean.

use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::format::{FormatError, Reading, WarningKind, read, read_file};
use kutzbach::matrix::SplitMix64;
use kutzbach::mechanism::{JointKind, Mechanism, Placement};
use kutzbach::mobility::{AnalysisOptions, analyse};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

fn model(inside: &str) -> Result<Reading, FormatError> {
    read(&format!("<mujoco>{inside}</mujoco>"), "model.xml", &[])
}

fn mechanism(inside: &str) -> Mechanism {
    model(inside)
        .unwrap_or_else(|error| panic!("{error}\n{inside}"))
        .mechanism
}

fn finite(inside: &str) -> Option<usize> {
    let mechanism = mechanism(inside);
    analyse(&mechanism, &AnalysisOptions::default())
        .unwrap()
        .mobility
        .finite()
}

/// A parallelogram whose last hinge is left to equalities.
fn four_bar(equality: &str) -> String {
    format!(
        r#"<default><joint axis="0 0 1"/></default><worldbody>
        <body name="crank"><joint name="a"/><body name="coupler" pos="0 1 0"><joint name="b"/></body></body>
        <body name="rocker" pos="2 0 0"><joint name="c"/></body></worldbody>
        <equality>{equality}</equality>"#
    )
}

#[test]
fn equalities_leave_what_they_say() {
    let at = |z: &str| format!(r#"<connect body1="coupler" body2="rocker" anchor="2 0 {z}"/>"#);
    let closed = at("0");
    for (equality, expected) in [
        (String::new(), 3),
        (closed.clone(), 1),
        (closed.clone() + &at("0.1"), 1),
        // Three points that are not in line hold the two bodies together.
        (
            closed.clone()
                + &at("0.1")
                + r#"<connect body1="coupler" body2="rocker" anchor="1 0 0"/>"#,
            0,
        ),
        (r#"<weld body1="coupler" body2="rocker"/>"#.to_owned(), 0),
        (
            r#"<weld body1="coupler" body2="rocker" anchor="0 1 0" torquescale="0"/>"#.to_owned(),
            1,
        ),
        (r#"<weld body1="coupler"/>"#.to_owned(), 1),
        (closed.replace("<connect", r#"<connect active="false""#), 3),
        (
            r#"<joint joint1="a" joint2="b" polycoef="0 -1 0 0 0"/>"#.to_owned(),
            2,
        ),
        (r#"<joint joint1="a"/>"#.to_owned(), 2),
        (closed.clone() + r#"<joint joint1="c"/>"#, 0),
        (closed.clone() + r#"<joint joint1="a" joint2="c"/>"#, 1),
    ] {
        assert_eq!(finite(&four_bar(&equality)), Some(expected), "{equality}");
    }
    let tendon = r#"<tendon><fixed name="t"><joint joint="a" coef="2"/><joint joint="c" coef="-3"/></fixed></tendon>"#;
    let coupled = four_bar(r#"<tendon tendon1="t"/>"#) + tendon;
    assert_eq!(finite(&coupled), Some(2));
    let mechanism = mechanism(&coupled);
    let terms = &mechanism.couplings()[0].terms;
    let ratio = terms[1].factor.value() / terms[0].factor.value();
    assert!((ratio + 1.5).abs() < 1e-15);
    // The sum of three turns is that of the tendon; a second tendon takes a share of it.
    let of_three = tendon.replace("</fixed>", r#"<joint joint="b" coef="1"/></fixed><fixed name="u"><joint joint="b" coef="0.5"/></fixed>"#);
    for (equality, coefficients) in [
        (r#"<tendon tendon1="t"/>"#, [2.0, -3.0, 1.0]),
        (
            r#"<tendon tendon1="t" tendon2="u" polycoef="0 4 0 0 0"/>"#,
            [2.0, -3.0, -1.0],
        ),
    ] {
        let text = four_bar(equality) + &of_three;
        assert_eq!(finite(&text), Some(2));
        let mechanism = self::mechanism(&text);
        let terms = mechanism.couplings()[0].terms.iter();
        let found: Vec<f64> = terms.map(|term| term.factor.value()).collect();
        assert_eq!(found, coefficients);
    }
}

#[test]
fn joints_may_follow_several_and_one_another() {
    let wheel = |name: &str| format!(r#"<body><joint name="{name}"/></body>"#);
    let wheels: String = ["a", "b", "c", "d"].map(wheel).concat();
    let left = |equality: &str| {
        finite(&format!(
            "<worldbody>{wheels}</worldbody><equality>{equality}</equality>"
        ))
    };
    let follows = |one: &str, other: &str| format!(r#"<joint joint1="{one}" joint2="{other}"/>"#);
    let held = |one: &str| format!(r#"<joint joint1="{one}"/>"#);
    for (equality, expected) in [
        (follows("a", "b") + &follows("b", "c"), 2),
        (follows("a", "b") + &follows("a", "c"), 2),
        (follows("a", "b") + &follows("b", "a"), 3),
        (
            follows("a", "b") + &follows("b", "c") + &follows("c", "a"),
            2,
        ),
        // The same again says nothing new.
        (follows("a", "b") + &follows("a", "b"), 3),
        (held("a") + &follows("b", "a"), 2),
        (held("b") + &follows("b", "a"), 2),
        (held("a") + &held("b") + &follows("b", "a"), 2),
    ] {
        assert_eq!(left(&equality), Some(expected), "{equality}");
    }
}

#[test]
fn names_that_are_made_are_none_of_the_file() {
    let text = r#"<worldbody><body><joint/><body><joint/></body></body><body name="body"><joint name="body_2_joint"/><joint/></body>
        <body name="body_1"/></worldbody>"#;
    let mechanism = mechanism(text);
    assert_eq!((mechanism.links().len(), mechanism.freedom()), (6, 4));
}

#[test]
fn sections_of_defaults_say_something_of_one_class() {
    let text = r#"<default class="robot"><joint type="slide"/><default class="arm"><joint axis="1 0 0"/></default></default>
        <default><joint damping="2"/></default>
        <worldbody><body><joint class="robot"/><body><joint class="arm"/></body></body></worldbody>"#;
    let mechanism = mechanism(text);
    for joint in mechanism.joints() {
        assert_eq!(joint.kind, JointKind::Prismatic);
        let dynamics = joint.dynamics.as_ref().unwrap();
        assert_eq!(dynamics.damping.as_ref().unwrap().value(), 2.0);
    }
}

#[test]
fn a_site_from_one_point_to_another_is_between_them() {
    let ends = r#"<site name="s" fromto="1 0 0 3 0 0"/>"#;
    let text = format!(
        r#"<worldbody>{ends}<body pos="2 0 0"><joint/><site name="t"/></body></worldbody>
        <equality><connect site1="s" site2="t"/></equality>"#
    );
    let mechanism = mechanism(&text);
    let side = &mechanism
        .joint(mechanism.joint_named("s_t").unwrap())
        .predecessor;
    assert_eq!(
        side.frame.position.each_ref().map(|x| x.value()),
        [2.0, 0.0, 0.0]
    );
    assert_eq!(finite(&text), Some(1));
}

#[test]
fn joints_of_a_body_follow_one_another() {
    let body = |joints: &str| {
        format!(
            r#"<worldbody><body name="b" pos="1 2 3" euler="0 0 30">{joints}</body></worldbody>"#
        )
    };
    for (joints, expected) in [
        ("", 0),
        (r#"<freejoint/>"#, 6),
        (r#"<joint type="free"/>"#, 6),
        (r#"<joint type="ball" pos="0 1 0"/>"#, 3),
        (
            r#"<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint/>"#,
            3,
        ),
        (
            r#"<joint axis="1 0 0" pos="0 0 1"/><joint axis="0 1 0" pos="0 0 -1"/>"#,
            2,
        ),
    ] {
        assert_eq!(finite(&body(joints)), Some(expected), "{joints}");
    }
    // The hinge stays where it is in the body, whatever turns the body.
    let mechanism = mechanism(&body(r#"<joint name="j" pos="0.5 0 0"/>"#));
    let joint = mechanism.joint_named("j").unwrap();
    assert_eq!(mechanism.joint(joint).kind, JointKind::Revolute);
    let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
    let pin =
        geometry.home[mechanism.joint(joint).successor.link.0].compose(&geometry.sides[joint.0][1]);
    let expected = [1.0 + 0.5 * (30f64).to_radians().cos(), 2.25, 3.0];
    for (found, expected) in pin.translation.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-15, "{:?}", pin.translation);
    }
}

#[test]
fn limits_count_from_the_pose_drawn() {
    let bounds = |compiler: &str, joint: &str| {
        let text = format!(
            r#"<compiler {compiler}/><worldbody><body><joint name="j" {joint}/></body></worldbody>"#
        );
        mechanism(&text).joints()[0].bounds()
    };
    let near = |found: Option<(f64, f64)>, (lower, upper): (f64, f64)| {
        let (a, b) = found.unwrap();
        assert!(
            (a - lower).abs() < 1e-15 && (b - upper).abs() < 1e-15,
            "{found:?}"
        );
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    near(bounds("", r#"range="-90 180""#), (-quarter, 2.0 * quarter));
    near(
        bounds("", r#"range="-90 180" ref="90""#),
        (-2.0 * quarter, quarter),
    );
    near(
        bounds(r#"angle="radian""#, r#"range="-1 2" ref="0.5""#),
        (-1.5, 1.5),
    );
    near(bounds("", r#"type="slide" range="-0.5 2""#), (-0.5, 2.0));
    assert_eq!(bounds("", r#"range="-90 90" limited="false""#), None);
    assert_eq!(bounds(r#"autolimits="false""#, r#"range="-90 90""#), None);
    assert_eq!(bounds("", r#"range="0 0""#), None);
}

#[test]
fn classes_say_what_is_left_out() {
    let text = r#"<default><joint axis="1 0 0"/><default class="inner"><joint type="slide"/>
        <default class="innermost"><joint axis="0 1 0"/></default></default></default>
        <worldbody><body childclass="inner"><joint name="a"/><body><joint name="b" class="innermost"/>
        <frame childclass="innermost" pos="0 0 1"><body><joint name="c"/></body></frame></body></body>
        <body><joint name="d"/></body></worldbody>"#;
    let mechanism = mechanism(text);
    let of = |name: &str| {
        let joint = mechanism.joint(mechanism.joint_named(name).unwrap());
        (joint.kind, joint.axis.0.each_ref().map(|x| x.value()))
    };
    assert_eq!(of("a"), (JointKind::Prismatic, [1.0, 0.0, 0.0]));
    assert_eq!(of("b"), (JointKind::Prismatic, [0.0, 1.0, 0.0]));
    assert_eq!(of("c"), (JointKind::Prismatic, [0.0, 1.0, 0.0]));
    assert_eq!(of("d"), (JointKind::Revolute, [1.0, 0.0, 0.0]));
}

/// How a frame is turned, as MJCF writes it and as a rotation.
fn turn(random: &mut SplitMix64, sequence: &str) -> (String, Rotation3<f64>) {
    let mut number = || (random.next_u64() % 2001) as f64 / 1000.0 - 1.0;
    let [a, b, c, d] = [number(), number(), number(), number()];
    let axis = Vector3::new(a, b, c);
    match random.next_u64() % 5 {
        0 => {
            let q = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(d, a, b, c));
            (format!(r#"quat="{d} {a} {b} {c}""#), q.to_rotation_matrix())
        }
        1 => {
            let mut whole = Rotation3::identity();
            for (letter, angle) in sequence.chars().zip([a, b, c]) {
                let axis = match letter.to_ascii_lowercase() {
                    'x' => Vector3::x_axis(),
                    'y' => Vector3::y_axis(),
                    _ => Vector3::z_axis(),
                };
                let turn = Rotation3::from_axis_angle(&axis, angle);
                whole = match letter.is_ascii_lowercase() {
                    true => whole * turn,
                    false => turn * whole,
                };
            }
            (format!(r#"euler="{a} {b} {c}""#), whole)
        }
        2 => {
            let turn = Rotation3::from_axis_angle(&nalgebra::Unit::new_normalize(axis), d);
            (format!(r#"axisangle="{a} {b} {c} {d}""#), turn)
        }
        3 => {
            let x = axis.normalize();
            let y = Vector3::new(d, a, b);
            let y = (y - x * x.dot(&y)).normalize();
            let columns = Matrix3::from_columns(&[x, y, x.cross(&y)]);
            (
                format!(r#"xyaxes="{a} {b} {c} {d} {a} {b}""#),
                Rotation3::from_matrix_unchecked(columns),
            )
        }
        _ => {
            let turn = Rotation3::rotation_between(&Vector3::z(), &axis).unwrap();
            (format!(r#"zaxis="{a} {b} {c}""#), turn)
        }
    }
}

#[test]
fn frames_are_turned_as_they_are_written() {
    let mut random = SplitMix64::new(55);
    let sequences = ["xyz", "zyx", "XYZ", "ZYX", "zxz", "XYX", "xYz", "yXZ"];
    for case in 0..400 {
        let sequence = sequences[case % sequences.len()];
        let (text, expected) = turn(&mut random, sequence);
        let (inner, then) = turn(&mut random, sequence);
        let model = format!(
            r#"<compiler angle="radian" eulerseq="{sequence}"/><worldbody><frame pos="1 0 0" {text}>
            <body name="b" pos="0 1 0" {inner}><joint/></body></frame></worldbody>"#
        );
        let mechanism = mechanism(&model);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let home = &geometry.home[mechanism.link_named("b").unwrap().0];
        let whole = expected * then;
        let place = Vector3::new(1.0, 0.0, 0.0) + expected * Vector3::y();
        for i in 0..3 {
            let mut axis = [0.0; 3];
            axis[i] = 1.0;
            let found = Vector3::from(home.rotate(&axis));
            let off = (found - whole.matrix().column(i)).norm();
            assert!(off < 1e-9, "{off:e} {model}");
            assert!((home.translation[i] - place[i]).abs() < 1e-9, "{model}");
        }
    }
}

#[test]
fn what_cannot_be_read_is_told_with_its_place() {
    for (inside, line, told) in [
        (
            "\n<worldbody><body><joint type='hing'/></body></worldbody>",
            2,
            "no type of joint `hing`",
        ),
        (
            "<worldbody>\n<body name='b'/>\n<body name='b'/></worldbody>",
            3,
            "two bodies are called `b`",
        ),
        (
            "<worldbody>\n<attach model='arm' body='a' prefix='l'/></worldbody>",
            2,
            "no model `arm`",
        ),
        (
            "<worldbody><body name='arm'/></worldbody>\n<equality><weld body1='amr'/></equality>",
            2,
            "no body `amr`",
        ),
        (
            "<worldbody>\n<body pos='1 2'/></worldbody>",
            2,
            "expected 3 numbers, found 2",
        ),
        (
            "<worldbody>\n<body pos='1 2 nan'/></worldbody>",
            2,
            "`nan` is no number",
        ),
        (
            "<worldbody>\n<body quat='0 0 0 0'/></worldbody>",
            2,
            "`quat` says no direction",
        ),
        (
            "<worldbody>\n<body class='x'/></worldbody>",
            2,
            "no default class `x`",
        ),
        (
            "<worldbody><body><joint name='j'/>\n<joint name='j'/></body></worldbody>",
            2,
            "two joints are called `j`",
        ),
        (
            "<worldbody><body><joint name='j'/></body></worldbody>\n<equality><joint joint1='j' joint2='k'/></equality>",
            2,
            "no joint `k`",
        ),
        (
            "<worldbody><body><body>\n<freejoint/></body></body></worldbody>",
            2,
            "only bodies of the world itself can float",
        ),
    ] {
        let error = model(inside).unwrap_err();
        assert!(error.message.contains(told), "{error}");
        assert_eq!(error.line, line, "{error}");
    }
}

#[test]
fn polynomials_are_read_whole() {
    let factors = |equality: &str, more: &str| -> (Vec<(usize, Vec<f64>)>, f64) {
        let mechanism = mechanism(&(four_bar(equality) + more));
        let coupling = &mechanism.couplings()[0];
        let terms = coupling.terms.iter().map(|term| {
            let all = term.factors().map(|x| x.value()).collect();
            (term.joint.0, all)
        });
        (terms.collect(), coupling.offset.value())
    };
    let joints = r#"<joint joint1="a" joint2="c" polycoef="0.1 1 0.5 0 -2"/>"#;
    let expected = vec![(0, vec![1.0]), (2, vec![-1.0, -0.5, 0.0, 2.0])];
    assert_eq!(factors(joints, ""), (expected, 0.1));
    // A tendon of one joint is a multiple of it, whose powers are those of the multiple.
    let tendons = r#"<tendon tendon1="t" tendon2="u" polycoef="0 1 0.5"/>"#;
    let over = r#"<tendon><fixed name="t"><joint joint="a" coef="2"/></fixed><fixed name="u"><joint joint="c" coef="3"/></fixed></tendon>"#;
    let expected = vec![(0, vec![2.0]), (2, vec![-3.0, -4.5])];
    assert_eq!(factors(tendons, over), (expected, 0.0));
    // Held at another value than the one it is drawn at.
    let held = r#"<joint joint1="a" polycoef="0.25 0 0 0 0"/>"#;
    assert_eq!(factors(held, ""), (vec![(0, vec![1.0])], 0.25));
}

#[test]
fn what_is_dropped_or_taken_for_something_else_is_told() {
    let reading = model(&(four_bar(
        r#"<tendon tendon1="t" tendon2="u" polycoef="0 1 0.5"/><weld body1="coupler" body2="hand"/>"#,
    ).replace("</worldbody>", r#"<body name="hand" mocap="true"/></worldbody>"#)
        + r#"<tendon><fixed name="t"><joint joint="a" coef="1"/></fixed><fixed name="u"><joint joint="b" coef="1"/><joint joint="c" coef="1"/></fixed></tendon>"#))
    .unwrap();
    assert_eq!(reading.warnings[0].kind, WarningKind::MayJoin);
    assert!(
        reading.warnings[0]
            .message
            .contains("a power of a tendon over several joints")
    );
    let skipped: Vec<&str> = reading
        .skipped
        .iter()
        .map(|skip| skip.what.as_str())
        .collect();
    assert_eq!(skipped, ["<weld> to a body that a user moves (mocap)"]);
    assert_eq!(reading.format, "mjcf");
}

#[test]
fn files_include_others() {
    let folder = std::env::temp_dir().join(format!("kutzbach_mjcf_{}", std::process::id()));
    std::fs::create_dir_all(folder.join("parts")).unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    write(
        "main.xml",
        "<mujoco><include file='parts/common.xml'/>\n<worldbody><include file='parts/arm.xml'/>\n<body name='b'><joint/></body></worldbody></mujoco>",
    );
    write(
        "parts/common.xml",
        "<mujocoinclude><default><joint type='slide'/></default></mujocoinclude>",
    );
    write(
        "parts/arm.xml",
        "<mujocoinclude>\n<body name='a'><joint/><strange/></body><include file='leaf.xml'/></mujocoinclude>",
    );
    write("parts/leaf.xml", "<mujoco><body name='leaf'/></mujoco>");
    let main = folder.join("main.xml");
    let reading = read_file(&main, &[]).unwrap();
    let names: Vec<&str> = reading
        .mechanism
        .links()
        .iter()
        .map(|link| link.name.as_str())
        .collect();
    assert_eq!(names, ["world", "a", "leaf", "b"]);
    assert!(
        reading
            .mechanism
            .joints()
            .iter()
            .all(|joint| joint.kind != JointKind::Revolute)
    );
    let skip = &reading.skipped[0];
    assert_eq!(
        (skip.what.as_str(), skip.line),
        ("<strange> (in arm.xml, line 2)", 2)
    );
    write(
        "parts/leaf.xml",
        "<mujoco>\n<body name='leaf'><joint type='x'/></body></mujoco>",
    );
    let error = read_file(&main, &[]).unwrap_err();
    assert!(
        error.file.ends_with("leaf.xml") && error.line == 2,
        "{error}"
    );
    write(
        "parts/leaf.xml",
        "<mujoco><include file='parts/arm.xml'/></mujoco>",
    );
    let error = read_file(&main, &[]).unwrap_err();
    assert!(error.message.contains("included twice"), "{error}");
    std::fs::remove_dir_all(&folder).unwrap();
    let text = "<mujoco><include file='x.xml'/></mujoco>";
    assert!(
        read(text, "t", &[])
            .unwrap_err()
            .message
            .contains("no folder")
    );
}

#[test]
fn bodies_may_be_nested_deeply() {
    let deep = 4000;
    let text = "<body><joint/>".repeat(deep) + &"</body>".repeat(deep);
    let reading = model(&format!("<worldbody>{text}</worldbody>")).unwrap();
    assert_eq!(reading.mechanism.freedom(), deep);
    assert!(matches!(
        reading.mechanism.links()[1].placement,
        Placement::Joint(_)
    ));
}

#[test]
fn joints_in_frames_of_their_body_are_turned_and_moved_with_them() {
    // In frames that are turned by a quarter about x, their y is the body's z; the hinge lies where the frame puts it.
    let plain = four_bar(r#"<connect body1="coupler" body2="rocker" anchor="2 0 0"/>"#);
    assert_eq!(finite(&plain), Some(1));
    let framed = plain
        .replace(
            r#"<joint name="a"/>"#,
            r#"<frame euler="90 0 0"><joint name="a" axis="0 1 0"/></frame>"#,
        )
        .replace(
            r#"<joint name="c"/>"#,
            r#"<frame pos="0.5 0 0"><frame euler="90 0 0"><joint name="c" axis="0 1 0" pos="-0.5 0 0"/></frame></frame>"#,
        );
    assert_eq!(finite(&framed), Some(1));
    let moved = framed.replace(r#"pos="-0.5 0 0""#, r#"pos="-0.25 0 0.25""#);
    let hinge = |text: &str| {
        let mechanism = mechanism(text);
        let joint = mechanism.joint_named("c").unwrap();
        let place = &mechanism.joint(joint).predecessor.frame.position;
        place.each_ref().map(|part| part.value())
    };
    for (found, expected) in hinge(&framed).into_iter().zip([2.0, 0.0, 0.0]) {
        assert!((found - expected).abs() < 1e-12);
    }
    // z of the frame is the body's -y.
    for (found, expected) in hinge(&moved).into_iter().zip([2.25, -0.25, 0.0]) {
        assert!((found - expected).abs() < 1e-12);
    }
    assert!(model(r#"<worldbody><frame><joint/></frame></worldbody>"#).is_err());
}
