//! Loops in the words of other programs: Gazebo's plugins, constraints by element, Gepetto's YAML, frames whose names say that they close.
//!
//! ```text
//!   b ------- c          a stands; b, c and d are joined by revolute joints
//!   |         |          about z; the loop is closed between c and d
//!   a ------- d
//! ```

use crate::support::empty_folder;

use kutzbach::format::{FormatError, Reading, WarningKind, read, read_file, write};
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

/// The robot of Gepetto's two files: a tip at the end of c, and a pin on d that turns about z.
const TIP_AND_PIN: &str = "<link name='tip'/><link name='pin'/>\
    <joint name='closedloop1_A' type='fixed'><parent link='c'/><child link='tip'/><origin xyz='2 0 0'/></joint>\
    <joint name='closedloop1_B' type='continuous'><parent link='d'/><child link='pin'/><origin xyz='0 1 0'/><axis xyz='0 0 1'/></joint>";

const LOOP: &str = "closed_loop: [['closedloop1_A', 'closedloop1_B']]\n";

/// Reads YAML that stands beside the robot.
fn beside(test: &str, yaml: &str) -> Result<Reading, FormatError> {
    let folder = empty_folder(&format!("dialects_{test}"));
    std::fs::write(folder.join("robot.urdf"), bars(TIP_AND_PIN)).unwrap();
    std::fs::write(folder.join("robot.yaml"), yaml).unwrap();
    read_file(folder.join("robot.yaml"), &[])
}

#[test]
fn yaml_beside_a_urdf_closes_its_loops() {
    let yaml = format!("# made by hand\n{LOOP}type: ['6d']\nname_mot: ['ab', 'xy']\n");
    let reading = beside("weld", &yaml).unwrap();
    let mechanism = &reading.mechanism;
    let closing = joint(&reading, "closedloop1_A_closedloop1_B");
    assert_eq!(closing.kind, JointKind::Fixed);
    let sides = [&closing.predecessor, &closing.successor];
    let links = sides.map(|side| mechanism.link(side.link).name.as_str());
    assert_eq!(links, ["tip", "pin"]);
    assert_eq!(reading.format, "gepetto");
    assert_eq!(finite(&reading), Some(1));
    let motors = mechanism.actuated().iter();
    let motors: Vec<&str> = motors.map(|id| &mechanism.joint(*id).name[..]).collect();
    assert_eq!(motors, ["ab"]);
    let told: Vec<&str> = reading.warnings.iter().map(|w| &w.message[..]).collect();
    assert!(
        told.len() == 2 && told[0].contains("`robot.urdf`") && told[1].contains("`xy`"),
        "{told:?}"
    );
    // Who reads the URDF alone finds the open tree, and is told where to look.
    let open = with(TIP_AND_PIN);
    assert_eq!(finite(&open), Some(4));
    assert!(
        open.warnings[0].message.contains("`closed_loop`"),
        "{:?}",
        open.warnings
    );
    // A word stands for all joints that it is part of, names of links for their own frames, and a point lets the pin spin.
    let yaml = "type: [3D]\nclosed_loop:\n- [tip, pin]\nname_mot: closedloop\nLidmot: [0]\n";
    let reading = beside("point", yaml).unwrap();
    assert_eq!(joint(&reading, "tip_pin").kind, JointKind::Spherical);
    assert_eq!(finite(&reading), Some(2));
    assert_eq!(reading.mechanism.actuated().len(), 1);
    assert_eq!(reading.skipped[0].what, "the entry `Lidmot` of the YAML");
    assert_eq!((reading.skipped[0].line, reading.skipped[0].column), (5, 1));
    // Without types both frames are held together.
    let reading = beside("untyped", LOOP).unwrap();
    assert_eq!(finite(&reading), Some(1));
}

#[test]
fn yaml_says_of_what_kind_joints_are() {
    let yaml = format!(
        "{LOOP}type: [6d]\njoint_name: [bc, ad, ab]\njoint_type: [SPHERICAL, FIXED, UJOINT_ZX]\n"
    );
    let reading = beside("kinds", &yaml).unwrap();
    assert_eq!(joint(&reading, "bc").kind, JointKind::Spherical);
    assert_eq!(joint(&reading, "ad").kind, JointKind::Fixed);
    let universal = joint(&reading, "ab");
    assert_eq!(universal.kind, JointKind::Universal);
    let axes = [&universal.axis, &universal.axis2].map(|axis| axis.0.each_ref().map(|x| x.value()));
    assert_eq!(axes, [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    let old = beside("old", &format!("{LOOP}rotule_name: free\n")).unwrap();
    assert!(may_join(&old)[0].contains("`rotule_name`"));
}

#[test]
fn what_yaml_says_wrongly_is_told_where_it_stands() {
    for (yaml, message, place) in [
        (
            "closed_loop: [[tip, pn]]\n".to_owned(),
            "the URDF has no link or joint named `pn`",
            (1, 21),
        ),
        (
            format!("{LOOP}type: [6d, 6d]\n"),
            "there are 1 loops and 2 types",
            (2, 1),
        ),
        (
            format!("{LOOP}type: [5d]\n"),
            "needed 6d or 3d, found `5d`",
            (2, 8),
        ),
        (
            "closed_loop: [[tip, tip]]\n".to_owned(),
            "in one link",
            (1, 21),
        ),
        (
            "closed_loop: [[tip]]\n".to_owned(),
            "needed the names of two frames",
            (1, 15),
        ),
        (
            format!("{LOOP}joint_name: [ab]\n"),
            "there are 1 names of joints and 0 types",
            (2, 14),
        ),
        (
            format!("{LOOP}joint_name: [closedloop1_A]\njoint_type: [SPHERICAL]\n"),
            "is fixed in the URDF",
            (2, 14),
        ),
    ] {
        let error = beside("wrong", &yaml).unwrap_err();
        assert!(error.message.contains(message), "{error}");
        assert!(error.file.ends_with("robot.yaml"), "{}", error.file);
        assert_eq!((error.line, error.column), place, "{yaml}");
    }
    let error = read(LOOP, "standard input", &[]).unwrap_err();
    assert!(error.message.contains("in a file beside it"), "{error}");
}

#[test]
fn the_urdf_beside_yaml_is_that_of_its_name_or_the_only_one() {
    let folder = empty_folder("dialects_beside");
    let yaml = folder.join("legs.yaml");
    std::fs::write(&yaml, LOOP).unwrap();
    let error = read_file(&yaml, &[]).unwrap_err();
    assert!(error.message.contains("no URDF stands beside"), "{error}");
    let robot = |file: &str| {
        let text = bars(TIP_AND_PIN).replacen("'bars'", &format!("'{file}'"), 1);
        std::fs::write(folder.join(file), text).unwrap();
    };
    let name = || read_file(&yaml, &[]).map(|reading| reading.mechanism.name().to_owned());
    robot("a.urdf");
    assert_eq!(name().unwrap(), "a.urdf");
    robot("b.urdf");
    assert!(name().unwrap_err().message.contains("several URDF files"));
    robot("robot.urdf");
    assert_eq!(name().unwrap(), "robot.urdf");
    robot("legs.urdf");
    assert_eq!(name().unwrap(), "legs.urdf");
    // What is wrong with the URDF is told of that file.
    std::fs::write(folder.join("legs.urdf"), "<robot name='r'>\n<lnk/></robot>").unwrap();
    let error = read_file(&yaml, &[]).unwrap_err();
    assert!(
        error.file.ends_with("legs.urdf") && error.line == 2,
        "{error}"
    );
}
