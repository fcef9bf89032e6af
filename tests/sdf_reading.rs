//! SDFormat: what is refused, told or passed over, and files that are long.

use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::format::{FormatError, Reading, WarningKind, read};
use kutzbach::mechanism::JointKind;
use std::fmt::Write as _;
use std::time::Instant;

fn sdf(version: &str, inside: &str) -> Result<Reading, FormatError> {
    let text = format!("<sdf version='{version}'>{inside}</sdf>");
    read(&text, "model.sdf", &[])
}

/// A model of version 1.9.
fn model(inside: &str) -> Reading {
    sdf("1.9", &format!("<model name='m'>{inside}</model>"))
        .unwrap_or_else(|error| panic!("{error}\n{inside}"))
}

/// Two links and a joint between them.
fn pair(kind: &str, inside: &str) -> String {
    format!(
        "<link name='a'/><link name='b'/>\n<joint name='j' type='{kind}'><parent>a</parent><child>b</child>{inside}</joint>"
    )
}

fn hinge(name: &str, parent: &str, child: &str) -> String {
    format!(
        "<joint name='{name}' type='revolute'><parent>{parent}</parent><child>{child}</child><axis><xyz>0 0 1</xyz></axis></joint>"
    )
}

/// The height of a link above the root at home, where all of them are straight.
fn height(reading: &Reading, link: &str) -> f64 {
    let geometry = Geometry::new(&reading.mechanism, None, &Arithmetic::double());
    geometry.home[reading.mechanism.link_named(link).unwrap().0].translation[2]
}

fn skipped(reading: &Reading) -> Vec<&str> {
    reading.skipped.iter().map(|skip| &skip.what[..]).collect()
}

fn limited(lower: &str, upper: &str) -> String {
    format!(
        "<axis><xyz>0 0 1</xyz><limit><lower>{lower}</lower><upper>{upper}</upper></limit></axis>"
    )
}

#[test]
fn a_continuous_joint_has_no_limits_and_bounds_that_are_none_say_nothing() {
    for (kind, axis, bounds, told) in [
        ("revolute", limited("-1", "0.5"), Some((-1.0, 0.5)), false),
        ("Revolute", limited("-1", "0.5"), Some((-1.0, 0.5)), false),
        ("continuous", limited("-1", "0.5"), None, true),
        ("continuous", limited("-1e16", "1e16"), None, false),
        ("revolute", limited("-1e16", "1e16"), None, false),
        ("revolute", limited("2", "1"), None, true),
    ] {
        let reading = model(&pair(kind, &axis));
        assert_eq!(reading.mechanism.joints()[0].bounds(), bounds, "{axis}");
        let no_limit = |warning: &kutzbach::format::Warning| warning.kind == WarningKind::NoLimit;
        assert_eq!(reading.warnings.iter().any(no_limit), told, "{kind} {axis}");
    }
}

#[test]
fn ranges_that_are_not_read_are_told_and_those_that_are_none_are_not() {
    let second = "<axis2><xyz>1 0 0</xyz></axis2>";
    for (kind, axis, warned, counted) in [
        ("universal", limited("-1", "1") + second, true, false),
        ("universal", limited("-1e16", "1e16") + second, false, false),
        ("ball", limited("-1", "1"), true, false),
        ("fixed", limited("-1", "1"), false, true),
        ("fixed", limited("-inf", "inf"), false, false),
    ] {
        let reading = model(&pair(kind, &axis));
        let told =
            |warning: &kutzbach::format::Warning| warning.message.contains("range of one axis");
        assert_eq!(reading.warnings.iter().any(told), warned, "{kind} {axis}");
        assert_eq!(
            !reading.skipped.is_empty(),
            counted,
            "{kind}: {:?}",
            reading.skipped
        );
    }
}

#[test]
fn what_is_read_is_not_told_as_passed_over() {
    let axis = "<axis><xyz>0 0 1</xyz><dynamics><damping>0.5</damping><friction>0.25</friction>
        <spring_reference>0</spring_reference><spring_stiffness>0</spring_stiffness></dynamics></axis>";
    let shape = "<link name='c'><visual name='v'><geometry><empty/></geometry></visual></link>";
    let reading = model(&(pair("revolute", axis) + shape));
    assert_eq!(skipped(&reading), [""; 0]);
    let damping = reading.mechanism.joints()[0].dynamics.as_ref();
    let damping = damping.and_then(|dynamics| dynamics.damping.as_ref());
    assert_eq!(damping.map(|damping| damping.value()), Some(0.5));
    // A spring is no friction, and of two solids one is read.
    let spring = axis.replace("stiffness>0<", "stiffness>7<");
    let two = "<link name='c'><visual name='v'><geometry><sphere><radius>1</radius></sphere><box><size>1 1 1</size></box></geometry></visual></link>";
    let reading = model(&(pair("revolute", &spring) + two));
    for what in [
        "<spring_stiffness>",
        "<box>, a second solid of one <geometry>",
    ] {
        assert!(
            skipped(&reading).contains(&what),
            "{what}: {:?}",
            reading.skipped
        );
    }
}

#[test]
fn names_that_hold_colons_are_found_as_they_are_written() {
    // As libsdformat before its tenth version writes a model that another one includes.
    let text = format!(
        "<link name='base'/><link name='arm::upper'/><link name='arm::hand'><pose relative_to='arm::wrist'>0 0 1 0 0 0</pose></link>{}{}",
        hinge("arm::shoulder", "base", "arm::upper"),
        "<joint name='arm::wrist' type='revolute'><pose relative_to='base'/><parent>arm::upper</parent><child>arm::hand</child>
         <axis><xyz>0 0 1</xyz><mimic joint='arm::shoulder'/></axis></joint>",
    );
    let reading = model(&text);
    assert_eq!(reading.mechanism.couplings().len(), 1);
    assert_eq!(height(&reading, "arm::hand"), 1.0);
}

/// libsdformat refuses it (`JOINT_CHILD_LINK_INVALID`); the joint is the same.
#[test]
fn a_joint_with_the_world_below_it_is_told() {
    for (kind, finite) in [("revolute", 1), ("fixed", 0)] {
        for (parent, child, told) in [("a", "world", 1), ("world", "a", 0)] {
            let reading = model(&format!(
                "<link name='a'/><joint name='k' type='{kind}'><parent>{parent}</parent><child>{child}</child><axis><xyz>0 0 1</xyz></axis></joint>"
            ));
            let of_child = reading.warnings.iter();
            let of_child = of_child.filter(|one| one.message.contains("the world is its child"));
            assert_eq!(of_child.count(), told, "{:?}", reading.warnings);
            let freedom: usize = reading.mechanism.joints().iter().map(|j| j.freedom()).sum();
            assert_eq!(freedom, finite);
        }
    }
}

#[test]
#[rustfmt::skip]
fn contradictions_are_told_with_their_place() {
    let two = "<link name='a'/><link name='b'/>";
    let hinge = hinge("j", "a", "b");
    for (inside, line, told) in [
        (pair("universal", "<axis><xyz>0 0 1</xyz></axis>\n<axis2><xyz>0 0 -2</xyz></axis2>"), 3, "its two axes are parallel"),
        (pair("revolute2", "<axis><xyz>0.6 0.8 0</xyz></axis>\n<axis2><xyz>3 4 0</xyz></axis2>"), 3, "its two axes are parallel"),
        (format!("{two}<frame name='j'/>\n{hinge}"), 2, "two things of one model are called `j`"),
        (format!("{two}{hinge}\n<frame name='j'/>"), 2, "two things of one model are called `j`"),
        (format!("{two}{hinge}\n{hinge}"), 2, "two things of one model are called `j`"),
        (format!("{two}\n<joint name='j' type='fixed'><parent>a</parent><child>j</child></joint>"), 2, "names itself as its child"),
        (format!("{two}{hinge}\n<frame name='f' attached_to='c'><pose relative_to='a'/></frame>"), 2, "nothing is called `c`"),
        (format!("{two}{hinge}\n<frame name='f' attached_to='f'><pose relative_to='a'/></frame>"), 2, "`f` is attached to itself"),
        (format!("{two}{hinge}<frame name='f' attached_to='g'/>\n<frame name='g' attached_to='f'/>"), 1, "`f` and `g` are attached to one another in a circle"),
        (format!("{two}{hinge}\n<frame name='f'><pose relative_to='f'/></frame>"), 2, "`f` is given in itself"),
        (format!("<pose relative_to='a'>0 0 1 0 0 0</pose>\n{two}{hinge}"), 1, "nothing is called `a`"),
        (format!("<pose relative_to='__model__'>0 0 1 0 0 0</pose>{two}{hinge}"), 1, "nothing is called `__model__`"),
        (format!("{two}{hinge}<model name='n' canonical_link='q'>\n<link name='r'/></model>"), 1, "nothing is called `q`"),
        (format!("{two}<link name='c'><inertial/>\n<inertial/></link>"), 2, "<link> has a second <inertial>"),
        (pair("revolute", "<axis><xyz>0 0 1</xyz><limit><lower>-1</lower></limit>\n<limit/></axis>"), 3, "<axis> has a second <limit>"),
        (pair("revolute", "<axis><xyz>0 0 1</xyz><limit><lower>-1</lower>\n<lower>-2</lower></limit></axis>"), 3, "<limit> has a second <lower>"),
        (pair("revolute", "<axis><xyz>0 0 1</xyz><limit>\n<lowr>-1</lowr></limit></axis>"), 3, "<lowr> is not known inside <limit>"),
    ] {
        let error = sdf("1.9", &format!("<model name='m'>{inside}</model>")).unwrap_err();
        assert!(error.message.contains(told), "{error}\n{inside}");
        assert_eq!(error.line, line, "{error}");
    }
    let twice = "<model name='m'><link name='a'/></model>";
    let error = sdf("1.9", &format!("<world name='w'>{twice}\n{twice}</world>")).unwrap_err();
    assert!(error.message.contains("two things of the world are called `m`"), "{error}");
    // Before version 1.7 joints and links had names of their own.
    let old = format!("<model name='m'>{two}{}</model>", self::hinge("a", "a", "b"));
    assert_eq!(sdf("1.6", &old).unwrap().mechanism.joints()[0].kind, JointKind::Revolute);
    assert!(sdf("1.7", &old).is_err());
}

/// Frames, each given in the one before and attached to it, and a link at the end.
fn frames(count: usize, pose: &str) -> String {
    let mut text = String::from("<link name='a'/>");
    let before = |i: usize| match i {
        0 => "a".to_owned(),
        _ => format!("f{}", i - 1),
    };
    for i in 0..count {
        let from = before(i);
        let _ = write!(
            text,
            "<frame name='f{i}' attached_to='{from}'><pose relative_to='{from}'>{pose}</pose></frame>"
        );
    }
    let last = before(count);
    let _ = write!(text, "<link name='b'><pose relative_to='{last}'/></link>");
    text + &hinge("j", &last, "b")
}

/// A walk along the whole chain for each link, joint or frame took minutes.
#[test]
fn chains_of_ten_thousand_are_read_soon() {
    let started = Instant::now();
    let count = 10_000;
    let reading = model(&frames(count, "0 0 0.25 0 0 0"));
    assert_eq!(height(&reading, "b"), 2500.0);
    let joint = &reading.mechanism.joints()[0];
    let [parent, child] = [&joint.predecessor, &joint.successor];
    assert_eq!(parent.frame.position[2].value(), 2500.0);
    assert!(child.frame.is_identity());
    // Every joint leads back to the first link, and the frames are turned: four quarters, and a degree or so.
    for turn in ["1.5707963267948966", "0.02"] {
        let count = 4000;
        let mut text = String::from("<link name='l0'/>");
        for i in 1..=count {
            let before = i - 1;
            let _ = write!(
                text,
                "<link name='l{i}'><pose relative_to='l{before}'>0 0 0.25 0 0 {turn}</pose></link>{}",
                hinge(&format!("j{i}"), "l0", &format!("l{i}"))
            );
        }
        let reading = model(&text);
        assert!(
            (height(&reading, &format!("l{count}")) - 1000.0).abs() < 1e-9,
            "{turn}"
        );
    }
    assert!(
        started.elapsed().as_secs() < 60,
        "took {:?}",
        started.elapsed()
    );
}

#[test]
fn loops_inside_gazebo_on_a_deep_tree_are_read_soon() {
    let started = Instant::now();
    let count = 2000;
    let mut text = String::from("<robot name='r'><link name='l0'/>");
    for i in 1..=count {
        let before = i - 1;
        let _ = write!(
            text,
            "<link name='l{i}'/><joint name='j{i}' type='revolute'><parent link='l{before}'/><child link='l{i}'/>\
             <origin xyz='0 0 0.25' rpy='0 0 0.01'/><axis xyz='0 0 1'/></joint>"
        );
    }
    // The model's frame for the axis, too: that of the root, far above.
    for i in 0..count / 2 {
        let other = count - i;
        let _ = write!(
            text,
            "<gazebo><joint name='g{i}' type='revolute'><parent>l{i}</parent><child>l{other}</child>\
             <axis><xyz expressed_in='__model__'>0 0 1</xyz></axis></joint></gazebo>"
        );
    }
    let reading = read(&(text + "</robot>"), "deep.urdf", &[]).unwrap();
    let joint = reading.mechanism.joint_named("g0").unwrap();
    let joint = reading.mechanism.joint(joint);
    let height = joint.predecessor.frame.position[2].value();
    assert!((height - 500.0).abs() < 1e-9, "{height}");
    assert!(
        started.elapsed().as_secs() < 60,
        "took {:?}",
        started.elapsed()
    );
}

#[test]
fn thousands_of_bodies_without_names_are_read_soon() {
    let started = Instant::now();
    let bodies = "<body><joint/></body>".repeat(6000);
    let text = format!("<mujoco><worldbody>{bodies}</worldbody></mujoco>");
    let reading = read(&text, "bodies.xml", &[]).unwrap();
    let names = reading.mechanism.links().iter().map(|link| &link.name[..]);
    let names: Vec<&str> = names.collect();
    assert_eq!(names[..4], ["world", "body", "body_2", "body_3"]);
    assert_eq!(names[6000], "body_6000");
    assert!(
        started.elapsed().as_secs() < 60,
        "took {:?}",
        started.elapsed()
    );
    let classes = "<default class='c'>".repeat(100);
    let classes: String = (0..100).fold(classes, |text, i| {
        text.replacen("'c'", &format!("'c{i}'"), 1)
    });
    let text = format!(
        "<mujoco><default>{classes}{}</default><worldbody/></mujoco>",
        "</default>".repeat(100)
    );
    let error = read(&text, "classes.xml", &[]).unwrap_err();
    assert!(
        error.message.contains("nested more than 64 levels"),
        "{error}"
    );
}
