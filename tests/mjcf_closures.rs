//! MJCF: what `<connect>`, `<weld>` and flags leave of the motion, against MuJoCo 4.0.0: degrees of freedom less the rank of the equalities' Jacobian, and the
//! poses at which their residual is zero.

use kutzbach::format::{FormatError, Reading, WarningKind, read};
use kutzbach::mechanism::{Joint, JointKind, Mechanism};
use kutzbach::mobility::{AnalysisOptions, analyse};

fn try_model(inside: &str) -> Result<Reading, FormatError> {
    read(&format!("<mujoco>{inside}</mujoco>"), "model.xml", &[])
}

fn model(inside: &str) -> Reading {
    try_model(inside).unwrap_or_else(|error| panic!("{error}\n{inside}"))
}

fn finite(mechanism: &Mechanism) -> Option<usize> {
    let analysis = analyse(mechanism, &AnalysisOptions::default()).unwrap();
    analysis.mobility.finite()
}

/// The joints that close loops.
fn closing(reading: &Reading) -> Vec<&Joint> {
    let joints = reading.mechanism.joints().iter();
    joints.filter(|joint| joint.closes_loop).collect()
}

fn skipped(reading: &Reading) -> Vec<&str> {
    reading.skipped.iter().map(|skip| &skip.what[..]).collect()
}

/// A four-bar linkage whose last hinge is left to equalities, between sites of the coupler and of a rocker that stands as `rocker` says.
fn four_bar(rocker: &str, sites: &str, equality: &str) -> String {
    format!(
        r#"<default><joint axis="0 0 1"/></default><worldbody>
        <body name="crank"><joint name="a"/><body name="coupler" pos="0 1 0"><joint name="b"/>
        <site name="s1" pos="2 -1 0"/><site name="s2" pos="2 -1 0.1"/><site name="s3" pos="1 -1 0"/></body></body>
        <body name="rocker" pos="2 0 0" {rocker}{sites}</body></worldbody>
        <equality>{equality}</equality>"#
    )
}

#[test]
fn points_by_sites_are_the_joint_that_anchors_are() {
    let sites = r#"><joint name="c"/><site name="t1"/><site name="t2" pos="0 0 0.1"/><site name="t3" pos="-1 0 0"/>"#;
    let sites_of = |one: &str, other: &str| format!(r#"<connect site1="{one}" site2="{other}"/>"#);
    let first = sites_of("s1", "t1");
    for (equality, kind, expected) in [
        (first.clone(), JointKind::Spherical, 1),
        (
            first.clone() + &sites_of("s2", "t2"),
            JointKind::Revolute,
            1,
        ),
        // The bodies in the other order, and one of the two points by an anchor.
        (
            first.clone() + &sites_of("t2", "s2"),
            JointKind::Revolute,
            1,
        ),
        (
            first.clone() + r#"<connect body1="coupler" body2="rocker" anchor="2 -1 0.1"/>"#,
            JointKind::Revolute,
            1,
        ),
        (
            r#"<connect body1="coupler" body2="rocker" anchor="2 -1 0"/><connect body1="rocker" body2="coupler" anchor="0 0 0.1"/>"#
                .to_owned(),
            JointKind::Revolute,
            1,
        ),
        (
            first.clone() + &sites_of("s2", "t2") + &sites_of("s3", "t3"),
            JointKind::Fixed,
            0,
        ),
    ] {
        let reading = model(&four_bar("", sites, &equality));
        let closing = closing(&reading);
        let kinds: Vec<JointKind> = closing.iter().map(|joint| joint.kind).collect();
        assert_eq!(kinds, [kind], "{equality}");
        assert_eq!(finite(&reading.mechanism), Some(expected), "{equality}");
        let told = reading
            .warnings
            .iter()
            .filter(|warning| matches!(warning.kind, WarningKind::ReadAs { .. }));
        assert_eq!(told.count(), usize::from(kind != JointKind::Spherical));
    }
}

#[test]
fn sites_that_do_not_meet_as_drawn_are_one_joint_too() {
    let equality = r#"<connect site1="s1" site2="t1"/><connect site1="s2" site2="t2"/>"#;
    for (rocker, sites, kinds) in [
        (
            "",
            r#"><joint name="c"/><site name="t1" pos="0.1 0 0"/><site name="t2" pos="0.1 0 0.1"/>"#,
            &[JointKind::Revolute][..],
        ),
        // The rocker's y is the world's z.
        (
            r#"euler="90 0 0""#,
            r#"><joint name="c" axis="0 1 0"/><site name="t1" pos="0.1 0 0"/><site name="t2" pos="0.1 0.1 0"/>"#,
            &[JointKind::Revolute],
        ),
        // Farther from one another on one side: they cannot meet.
        (
            "",
            r#"><joint name="c"/><site name="t1" pos="0.1 0 0"/><site name="t2" pos="0.1 0 0.15"/>"#,
            &[JointKind::Spherical, JointKind::Spherical],
        ),
    ] {
        let reading = model(&four_bar(rocker, sites, equality));
        let found: Vec<JointKind> = closing(&reading).iter().map(|joint| joint.kind).collect();
        assert_eq!(found, kinds, "{sites}");
        // What cannot meet does not assemble.
        if kinds.len() == 1 {
            assert_eq!(finite(&reading.mechanism), Some(1), "{sites}");
        }
    }
}

/// A parallel-axis four-bar in a plane normal to 1 2 3, in so many decimals; its last hinge is two anchors, 0.1 m apart.
fn tilted(decimals: usize) -> String {
    let normal = nalgebra::Vector3::new(1.0, 2.0, 3.0).normalize();
    let u = normal.cross(&nalgebra::Vector3::z()).normalize();
    let v = normal.cross(&u);
    let text = |point: nalgebra::Vector3<f64>| {
        let [x, y, z]: [f64; 3] = point.into();
        format!("{x:.decimals$} {y:.decimals$} {z:.decimals$}")
    };
    let (crank, coupler) = (v * 0.7 + u * 0.2, u * 1.3);
    let [axis, b, c, one, other] = [
        normal,
        crank,
        u * 1.3 - v * 0.1,
        coupler,
        coupler + normal * 0.1,
    ]
    .map(text);
    format!(
        r#"<default><joint axis="{axis}"/></default><worldbody><body name="crank"><joint name="a"/><body name="coupler" pos="{b}"><joint name="b"/></body></body>
        <body name="rocker" pos="{c}"><joint name="c"/></body></worldbody><equality>
        <connect body1="coupler" body2="rocker" anchor="{one}"/><connect body1="coupler" body2="rocker" anchor="{other}"/></equality>"#
    )
}

#[test]
fn a_hinge_on_the_line_of_rounded_anchors_is_as_well_known_as_they_are() {
    for decimals in [4, 5, 6, 7, 8, 12] {
        let reading = model(&tilted(decimals));
        assert_eq!(finite(&reading.mechanism), Some(1), "{decimals}");
    }
}

#[test]
fn what_hangs_on_a_mocap_body_holds_nothing() {
    let inside = |equality: &str| {
        format!(
            r#"<worldbody><body name="m" mocap="true" pos="2 0 0"><site name="ms"/><body name="fixed" pos="0 0 1"><site name="fs" pos="0 0 -1"/></body>
            <body name="hung"><joint name="h" axis="1 0 0"/></body></body>
            <body name="b" pos="1 0 0"><joint name="j"/><site name="bs" pos="1 0 0"/></body></worldbody><equality>{equality}</equality>"#
        )
    };
    for equality in [
        r#"<weld site1="ms" site2="bs"/>"#,
        r#"<connect site1="bs" site2="ms"/>"#,
        r#"<weld site1="fs" site2="bs"/>"#,
        r#"<connect body1="b" body2="fixed" anchor="1 0 0"/>"#,
        r#"<weld body1="fixed" body2="b"/>"#,
    ] {
        let reading = model(&inside(equality));
        assert_eq!(finite(&reading.mechanism), Some(2), "{equality}");
        let [what] = skipped(&reading)[..] else {
            panic!("{:?}", reading.skipped);
        };
        assert!(what.contains("mocap"), "{what}");
    }
    // A body with a joint moves against the mocap body.
    let reading = model(&inside(r#"<weld body1="hung" body2="b"/>"#));
    assert_eq!(finite(&reading.mechanism), Some(0));
}

#[test]
fn sites_of_one_body_hold_nothing() {
    for name in ["connect", "weld"] {
        let text = format!(
            r#"<worldbody><body name="a"><joint/><site name="s"/><site name="t" pos="0 0 1"/></body></worldbody>
            <equality><{name} site1="s" site2="t"/></equality>"#
        );
        let reading = model(&text);
        assert_eq!(finite(&reading.mechanism), Some(1));
        assert_eq!(
            skipped(&reading),
            [format!("<{name}> between two sites of one body")]
        );
    }
}

#[test]
fn relpose_says_where_the_anchor_is() {
    // A body that can stand anywhere is welded to one that is turned; at zero residual MuJoCo has its anchor at `relpose` in the first body.
    let text = |more: &str| {
        format!(
            r#"<worldbody><body name="p" pos="0 0 1"/><body name="b" pos="1 0 1"><freejoint/></body></worldbody>
            <equality><weld body1="p" body2="b" relpose="0.5 0.2 0.1 1 0 0 1" {more}/></equality>"#
        )
    };
    let sides = |more: &str| {
        let reading = model(&text(more));
        let joint = closing(&reading)[0].clone();
        let position = |index: usize| {
            let sides = [&joint.predecessor, &joint.successor];
            sides[index].frame.position.each_ref().map(|x| x.value())
        };
        let turned = joint.predecessor.frame.roll_pitch_yaw[2].value();
        (joint.kind, position(0), position(1), turned)
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let relpose = [0.5, 0.2, 0.1];
    let anchor = [0.3, 0.1, 0.2];
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found}");
    let (kind, one, other, turned) = sides("");
    assert_eq!(
        (kind, one, other),
        (JointKind::Fixed, relpose, [0.0, 0.0, 0.0])
    );
    near(turned, quarter);
    let (kind, one, other, turned) = sides(r#"anchor="0.3 0.1 0.2""#);
    assert_eq!((kind, one, other), (JointKind::Fixed, relpose, anchor));
    near(turned, quarter);
    let (kind, one, other, _) = sides(r#"anchor="0.3 0.1 0.2" torquescale="0""#);
    assert_eq!((kind, one, other), (JointKind::Spherical, relpose, anchor));
    let loose = model(&text(r#"anchor="0.3 0.1 0.2" torquescale="0""#));
    assert_eq!(finite(&loose.mechanism), Some(3));
}

#[test]
fn a_short_polynomial_is_filled_up_with_the_identity() {
    let wheels = r#"<worldbody><body><joint name="a"/></body><body><joint name="b"/></body></worldbody>
        <tendon><fixed name="t"><joint joint="a" coef="1"/></fixed><fixed name="u"><joint joint="b" coef="1"/></fixed></tendon>"#;
    for (says, offset, factors) in [
        ("", 0.0, vec![-1.0]),
        (r#"polycoef="0.1""#, 0.1, vec![-1.0]),
        (r#"polycoef="0.1 2""#, 0.1, vec![-2.0]),
        (r#"polycoef="0.1 2 0.5""#, 0.1, vec![-2.0, -0.5]),
    ] {
        for equality in [
            format!(r#"<joint joint1="a" joint2="b" {says}/>"#),
            format!(r#"<tendon tendon1="t" tendon2="u" {says}/>"#),
        ] {
            let reading = model(&format!("{wheels}<equality>{equality}</equality>"));
            let coupling = &reading.mechanism.couplings()[0];
            assert_eq!(coupling.offset.value(), offset, "{equality}");
            let leader = reading.mechanism.joint_named("b").unwrap();
            let mut terms = coupling.terms.iter();
            let term = terms.find(|term| term.joint == leader).unwrap();
            let found: Vec<f64> = term.factors().map(|x| x.value()).collect();
            assert_eq!(found, factors, "{equality}");
        }
    }
    let long = r#"<equality><joint joint1="a" joint2="b" polycoef="0 1 0 0 0 0"/></equality>"#;
    let error = try_model(&format!("{wheels}{long}")).unwrap_err();
    assert!(error.message.contains("5 numbers at most"), "{error}");
}

#[test]
fn flags_switch_equalities_limits_and_motors_off() {
    let inside = |flags: &str| {
        format!(
            r#"<option>{flags}</option><worldbody><body><joint name="a" range="-90 90"/></body></worldbody>
            <equality><joint joint1="a"/></equality><actuator><motor joint="a"/></actuator>
            <keyframe><key name="k" qpos="0.5"/></keyframe>"#
        )
    };
    for (flags, freedom, is_limited) in [
        ("", 0, true),
        (r#"<flag equality="disable"/>"#, 1, true),
        (r#"<flag constraint="disable"/>"#, 1, false),
        (
            r#"<flag equality="disable"/><flag contact="disable"/>"#,
            1,
            true,
        ),
        (
            r#"<flag equality="disable"/></option><option><flag equality="enable"/>"#,
            0,
            true,
        ),
        (r#"<flag equality="disable" limit="disable"/>"#, 1, false),
    ] {
        let reading = model(&inside(flags));
        assert_eq!(finite(&reading.mechanism), Some(freedom), "{flags}");
        let limited = reading.mechanism.joints()[0].bounds().is_some();
        assert_eq!(limited, is_limited && freedom == 1, "{flags}");
        let told = reading.warnings.iter().any(|warning| {
            let is_of_flags =
                matches!(&warning.kind, WarningKind::ReadersDiffer { what } if what == "flag");
            is_of_flags && warning.message.contains("none is read")
        });
        assert_eq!(told, freedom == 1, "{flags}");
        let limits = "limits of joints, which a <flag> switches off";
        assert_eq!(skipped(&reading).contains(&limits), !is_limited, "{flags}");
        // A key of a model that nothing ties is a configuration.
        let configurations = reading.mechanism.configurations().len();
        assert_eq!(configurations, freedom, "{flags}");
    }
    let motors = |flags: &str| {
        let reading = model(&inside(flags));
        reading.mechanism.actuated().len()
    };
    assert_eq!(motors(r#"<flag equality="disable"/>"#), 1);
    assert_eq!(
        motors(r#"<flag equality="disable" actuation="disable"/>"#),
        0
    );
}

#[test]
fn values_of_coupled_joints_count_from_their_refs() {
    // MuJoCo: q1 − ref1 = 0.1 + 2 (q2 − ref2), in radians and metres; here the values are the differences.
    let text = r#"<worldbody><body><joint name="h" ref="30" pos="1 0 0"/><body pos="1 0 0"><joint name="s" type="slide" axis="1 0 0" ref="0.2" range="0 0.5"/></body></body></worldbody>
        <equality><joint joint1="h" joint2="s" polycoef="0.1 2 0 0 0"/></equality>"#;
    let reading = model(text);
    let coupling = &reading.mechanism.couplings()[0];
    let factors: Vec<f64> = coupling
        .terms
        .iter()
        .map(|term| term.factor.value())
        .collect();
    assert_eq!((factors, coupling.offset.value()), (vec![1.0, -2.0], 0.1));
    let slide = reading.mechanism.joint_named("s").unwrap();
    let (lower, upper) = reading.mechanism.joint(slide).bounds().unwrap();
    assert!((lower + 0.2).abs() < 1e-15 && (upper - 0.3).abs() < 1e-15);
}

#[test]
fn what_is_not_in_the_answer_is_told_by_name() {
    let spatial = r#"<worldbody><site name="w"/><body pos="0 0 1"><joint name="a" type="slide"/><site name="s"/></body></worldbody>
        <tendon><spatial name="t" range="0 1"><site site="w"/><site site="s"/></spatial></tendon>"#;
    assert_eq!(skipped(&model(spatial)), ["`range` of a tendon"]);
    let text = r#"<worldbody><body name="a"><joint/><flexcomp name="f" type="grid" count="3 3 1"/></body><composite type="cable" count="5 1 1"/></worldbody>
        <equality><flex flex="f"/></equality>"#;
    let reading = model(text);
    assert_eq!(finite(&reading.mechanism), Some(1));
    let told: Vec<&str> = reading
        .warnings
        .iter()
        .filter(|warning| warning.kind == WarningKind::MayJoin)
        .map(|warning| &warning.message[..])
        .collect();
    for name in [
        "<flexcomp> is not read",
        "<composite> is not read",
        "<flex> in <equality>",
    ] {
        assert!(
            told.iter().any(|message| message.contains(name)),
            "{told:?}"
        );
    }
    let off = r#"<compiler autolimits="false"/><worldbody><body><joint range="0 90"/></body></worldbody>"#;
    let expected = ["`range` of a joint without `limited`, where `autolimits` is off"];
    assert_eq!(skipped(&model(off)), expected);
}
