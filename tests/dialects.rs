//! Loops in the words of other programs: Gazebo's plugins, constraints by element, Gepetto's YAML, frames whose names say that they close.
//!
//! ```text
//!   b ------- c          a stands; b, c and d are joined by revolute joints
//!   |         |          about z; the loop is closed between c and d
//!   a ------- d
//! ```

use kutzbach::format::{FormatError, Reading, WarningKind, read, write};
use kutzbach::mechanism::{Joint, JointKind};
use kutzbach::mobility::{Analysis, AnalysisOptions, analyse};

/// Three bars of the square of two and one metres, with something more.
fn bars(more: &str) -> String {
    let joint = |name: &str, parent: &str, child: &str, xyz: &str| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{parent}'/><child link='{child}'/>\
             <origin xyz='{xyz}'/><axis xyz='0 0 1'/></joint>"
        )
    };
    format!(
        "<robot name='bars'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>{}{}{}{more}</robot>",
        joint("ab", "a", "b", "0 0 0"),
        joint("bc", "b", "c", "0 1 0"),
        joint("ad", "a", "d", "2 0 0"),
    )
}

fn try_bars(more: &str) -> Result<Reading, FormatError> {
    read(&bars(more), "bars.urdf", &[])
}

fn with(more: &str) -> Reading {
    try_bars(more).unwrap_or_else(|error| panic!("{error} {:?}\n{more}", error.help))
}

fn joint<'a>(reading: &'a Reading, name: &str) -> &'a Joint {
    let id = reading.mechanism.joint_named(name);
    reading
        .mechanism
        .joint(id.unwrap_or_else(|| panic!("no joint {name}")))
}

fn finite(reading: &Reading) -> Option<usize> {
    analyse(&reading.mechanism, &AnalysisOptions::default())
        .unwrap()
        .mobility
        .finite()
}

/// The messages of what may be another mechanism than the one meant.
fn may_join(reading: &Reading) -> Vec<&str> {
    let warnings = reading.warnings.iter();
    warnings
        .filter(|warning| warning.kind == WarningKind::MayJoin)
        .map(|warning| &warning.message[..])
        .collect()
}

fn near(found: &[f64; 3], expected: [f64; 3]) -> bool {
    found
        .iter()
        .zip(expected)
        .all(|(a, b)| (a - b).abs() < 1e-12)
}

/// Where a joint's frame is in both of its links.
fn places(joint: &Joint) -> [[f64; 3]; 2] {
    [&joint.predecessor, &joint.successor]
        .map(|side| side.frame.position.each_ref().map(|x| x.value()))
}

const DETACHABLE: &str = "<gazebo><plugin filename='gz-sim-detachable-joint-system' name='gz::sim::systems::DetachableJoint'>\
    <parent_link>d</parent_link><child_model>bars</child_model><child_link>c</child_link></plugin></gazebo>";

#[test]
fn a_detachable_joint_holds_two_links_of_the_robot_as_drawn() {
    let open = with("");
    assert_eq!(finite(&open), Some(3));
    for model in ["bars", "__model__", " bars "] {
        let reading = with(&DETACHABLE.replace(">bars<", &format!(">{model}<")));
        let held = joint(&reading, "d_c_detachable");
        assert_eq!(held.kind, JointKind::Fixed);
        assert!(held.closes_loop);
        let [in_d, in_c] = places(held);
        assert!(near(&in_d, [-2.0, 1.0, 0.0]) && near(&in_c, [0.0; 3]));
        // Of the three hinges in a row between a and a none can turn: they do not lie on one line.
        assert_eq!(finite(&reading), Some(0));
        let read_as = |kind: &WarningKind| matches!(kind, WarningKind::ReadAs { joint, .. } if joint == "d_c_detachable");
        assert!(reading.warnings.iter().any(|w| read_as(&w.kind)));
        assert!(may_join(&reading).is_empty(), "{:?}", reading.warnings);
    }
}

#[test]
fn a_detachable_joint_to_what_the_robot_has_not_is_told() {
    for (said, instead) in [
        (">bars<", ">crate<"),
        (">c<", ">lid<"),
        (">d<", ">table<"),
        ("<child_model>bars</child_model>", ""),
        (">c<", ">d<"),
    ] {
        let reading = with(&DETACHABLE.replace(said, instead));
        assert_eq!(reading.mechanism.joints().len(), 3, "{instead}");
        let told = reading.skipped.iter();
        assert!(
            told.map(|skipped| &skipped.what[..])
                .any(|what| what.starts_with("<plugin> DetachableJoint")),
            "{instead}: {:?}",
            reading.skipped
        );
    }
    // Where the name is taken, another one is made.
    let two = DETACHABLE.replace("</gazebo>", "") + DETACHABLE.trim_start_matches("<gazebo>");
    let reading = with(&two);
    assert_eq!(joint(&reading, "d_c_detachable_2").kind, JointKind::Fixed);
}

#[test]
fn crossed_limits_inside_gazebo_are_told() {
    let reading = with(
        "<gazebo><joint name='cd' type='revolute'><parent>d</parent><child>c</child>\
         <axis><xyz>0 0 1</xyz><limit><lower>1</lower><upper>-1</upper></limit></axis></joint></gazebo>",
    );
    assert!(joint(&reading, "cd").limit.is_none());
    let told = reading.warnings.iter();
    assert_eq!(
        told.filter(|warning| warning.kind == WarningKind::NoLimit)
            .count(),
        1
    );
}

#[test]
fn constraints_name_their_kinds_with_joint_behind() {
    let constraint = |kind: &str, axes: [&str; 2]| {
        format!(
            "<constraint name='tip' type='{kind}'><parent link='d'/><parent_origin xyz='0 1 0' rpy='0 0 0'/>{}\
             <child link='c'/><child_origin xyz='2 0 0'/>{}</constraint>",
            axes[0], axes[1]
        )
    };
    let z = ["<parent_axis xyz='0 0 1'/>", "<child_axis xyz='0 0 1'/>"];
    let across = ["<parent_axis xyz='0 0 1'/>", "<child_axis xyz='1 0 0'/>"];
    for (word, axes, kind) in [
        ("spherical", ["", ""], JointKind::Spherical),
        ("revolute", z, JointKind::Revolute),
        ("universal", across, JointKind::Universal),
        ("fixed", ["", ""], JointKind::Fixed),
    ] {
        let plain = with(&constraint(word, axes));
        let long = with(&constraint(&format!("{word}_joint"), axes));
        let (long_tip, plain_tip) = (joint(&long, "tip"), joint(&plain, "tip"));
        assert_eq!(long_tip.kind, kind);
        assert_eq!(places(long_tip), places(plain_tip));
        assert_eq!(
            (&long_tip.axis, &long_tip.axis2),
            (&plain_tip.axis, &plain_tip.axis2)
        );
        assert_eq!(long.warnings, plain.warnings, "{word}");
    }
    // Four hinges in a plane, of which one is a ball here.
    let ball = with(&constraint("spherical_joint", ["", ""]));
    assert_eq!(finite(&ball), Some(1));
    let error = try_bars(&constraint("screw_joint", ["", ""])).unwrap_err();
    assert!(error.message.contains("`screw_joint`"), "{error}");
}

const CLOSING: &str = "<link name='closing_pin_1'/><link name='closing_pin_2'/>\
    <joint name='f1' type='fixed'><parent link='c'/><child link='closing_pin_1'/><origin xyz='2 0 0'/></joint>\
    <joint name='f2' type='fixed'><parent link='d'/><child link='closing_pin_2'/><origin xyz='0 1 0'/></joint>";

#[test]
fn the_loop_between_frames_that_are_named_so_is_printed_to_be_written() {
    let open = with(CLOSING);
    assert_eq!(finite(&open), Some(3));
    let told = may_join(&open);
    assert_eq!(told.len(), 1, "{:?}", open.warnings);
    let start = told[0].find("<loop ").unwrap();
    let end = told[0].find("</loop>").unwrap() + "</loop>".len();
    let printed = &told[0][start..end];
    let closed = with(&format!("{CLOSING}{printed}"));
    assert!(may_join(&closed).is_empty());
    assert_eq!(joint(&closed, "pin").kind, JointKind::Revolute);
    assert_eq!(finite(&closed), Some(1));
    // A name that is taken is not proposed.
    let taken = with(&CLOSING.replace("'f1'", "'pin'"));
    assert!(may_join(&taken)[0].contains("name=\"pin_2\""));
}

/// A crank of 2 m at the origin, a coupler from (0, 2) to (4, 4), a rocker from (5, 0): the bars of a four-bar as they are drawn.
const CRANK_ROCKER: &str = r#"<mujoco><default><joint axis="0 0 1"/></default><worldbody>
    <body name="crank"><joint name="a"/><body name="coupler" pos="0 2 0"><joint name="b"/></body></body>
    <body name="rocker" pos="5 0 0"><joint name="c"/></body></worldbody>
    <equality><connect name="pin" body1="coupler" body2="rocker" anchor="4 2 0"/></equality>
    <actuator><motor joint="a"/></actuator>
    <keyframe><key name="near" qpos="0.004 -0.003 0.002"/><key name="other" qpos="0 -1.688 1.891"/></keyframe></mujoco>"#;

fn at(reading: &Reading, configuration: &str) -> Analysis {
    let options = AnalysisOptions {
        configuration: Some(configuration.to_owned()),
        ..AnalysisOptions::default()
    };
    analyse(&reading.mechanism, &options).unwrap()
}

/// Where assembly took the hinges of the crank-rocker (rad).
fn hinges(reading: &Reading, analysis: &Analysis) -> [f64; 3] {
    ["a", "b", "c"].map(|name| {
        let id = reading.mechanism.joint_named(name).unwrap();
        let mut places = analysis.assembly.joints.iter();
        let place = places.find(|place| place.joint == id.0);
        place.unwrap().values[0]
    })
}

#[test]
fn a_key_of_three_digits_assembles_at_the_nearest_pose() {
    let reading = read(CRANK_ROCKER, "crank_rocker.xml", &[]).unwrap();
    for (name, expected) in [
        ("near", [0.004, -0.003, 0.002]),
        // The coupler's end mirrored in the line from the crank's end to the rocker's pivot.
        ("other", [0.0, -1.688_307_972, 1.890_622_573]),
    ] {
        let analysis = at(&reading, name);
        assert!(analysis.assembly.closed, "{name}");
        // Nothing is held, the driven joint neither.
        assert!(analysis.assembly.held.is_empty(), "{name}");
        let found = hinges(&reading, &analysis);
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 0.01,
                "{name}: {found} {expected}"
            );
        }
        assert_eq!(analysis.mobility.finite(), Some(1), "{name}");
    }
}

#[test]
fn a_joint_begins_at_its_start_and_is_held_at_its_value() {
    let square = |position: &str| {
        format!(
            "<loop name='cd' type='revolute'><predecessor link='d'><origin xyz='0 1 0'/></predecessor><successor link='c'><origin xyz='2 0 0'/></successor>\
             <axis xyz='0 0 1'/></loop><configuration name='k'><position joint='ad' {position}/><position joint='ab' value='0.3'/></configuration>"
        )
    };
    // A parallelogram turned by 0.3: the rocker, d, follows the crank, b.
    let begun = with(&square("start='0.298'"));
    let analysis = at(&begun, "k");
    let held: Vec<usize> = analysis.assembly.held.iter().copied().collect();
    let id = |name: &str| begun.mechanism.joint_named(name).unwrap();
    assert!(analysis.assembly.closed);
    assert_eq!(held, [id("ab").0]);
    let mut places = analysis.assembly.joints.iter();
    let rocker = places.find(|place| place.joint == id("ad").0);
    assert!((rocker.unwrap().values[0] - 0.3).abs() < 1e-9);
    // Written and read again it says the same.
    let written = write(&begun.mechanism);
    assert!(written.contains("start=\"0.298\""), "{written}");
    let again = read(&written, "written", &[]).unwrap();
    assert_eq!(
        again.mechanism.configurations(),
        begun.mechanism.configurations()
    );
    // Held there it does not close.
    let held = with(&square("value='0.25'"));
    assert!(!at(&held, "k").assembly.closed);
    for (position, told) in [
        ("value='1' start='1'", "not both"),
        ("", "needs the attribute `value`"),
        ("begin='1'", "no attribute `begin`"),
    ] {
        let error = try_bars(&square(position)).unwrap_err();
        assert!(error.message.contains(told), "{error}");
    }
}
