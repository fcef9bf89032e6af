//! What a file means: every element of the format, what is skipped, what is warned of, and which dialect it is.

use crate::format_support;

use format_support::{chain, difference, robot};
use kutzbach::format::{ReadOptions, Reading, read, read_with, write};
use kutzbach::mechanism::{CouplingOrigin, JointKind, Limit, Placement};

fn reading(text: &str) -> Reading {
    read(text, "file", &[]).unwrap_or_else(|error| panic!("{error} {:?}\n{text}", error.help))
}

fn values(numbers: &[kutzbach::number::Number]) -> Vec<f64> {
    numbers.iter().map(|number| number.value()).collect()
}

#[test]
fn every_type_word_is_a_kind() {
    let words = JointKind::ALL.map(|kind| (kind.word(), kind));
    let synonyms = [
        ("continuous", JointKind::Revolute),
        ("line_on_line", JointKind::Cylindrical),
        ("plane_on_plane", JointKind::Planar),
        ("point_on_point", JointKind::Spherical),
    ];
    for (word, kind) in words.into_iter().chain(synonyms) {
        let inside = match kind {
            JointKind::Screw | JointKind::TranslatingScrew => "<screw lead='-0.01'/>",
            JointKind::Distance => "<distance value='0.5'/>",
            JointKind::Universal => "<axis2 xyz='0 1 0'/>",
            _ => "",
        };
        let reading = reading(&chain(word, inside));
        let joint = &reading.mechanism.joints()[0];
        assert_eq!(joint.kind, kind, "{word}");
        assert!(!joint.closes_loop);
        assert_eq!(values(&joint.axis.0), [1.0, 0.0, 0.0], "the default axis");
        let plain = ["revolute", "continuous", "prismatic", "fixed", "planar"].contains(&word);
        assert_eq!(
            reading.format,
            if plain { "urdf" } else { "kutzbach-urdf" },
            "{word}"
        );
    }
}

#[test]
fn expressions_stand_wherever_numbers_do() {
    let text = robot(
        "<joint name='j' type='screw'><parent link='a'/><child link='b'/>\n\
         <origin xyz='${a} 0 ${ sqrt(3) / 2 }' rpy='$(arg twist) ${radians(30)} -${b}'/>\n\
         <axis xyz='${1/3} 0.50 -.5'/><screw lead='${2*$(arg twist)/b}'/><limit lower='${-b}'/></joint>\n\
         <joint name='k' type='fixed'><parent link='b'/><child link='c'/></joint>\n\
         <xacro:property name='a' value='2*b'/>\n\
         <xacro:property name='b' value='3/5'/><xacro:arg name='twist' default='pi/6'/>",
    );
    let reading = reading(&text);
    let joint = &reading.mechanism.joints()[0];
    let position = values(&joint.predecessor.frame.position);
    assert_eq!(position, [1.2, 0.0, 3f64.sqrt() / 2.0]);
    let angles = values(&joint.predecessor.frame.roll_pitch_yaw);
    let sixth = std::f64::consts::FRAC_PI_6;
    assert!(
        (angles[0] - sixth).abs() < 1e-15 && (angles[1] - sixth).abs() < 1e-15 && angles[2] == -0.6
    );
    assert!((joint.lead.as_ref().unwrap().value() - 2.0 * sixth / 0.6).abs() < 1e-14);
    assert_eq!(
        joint
            .limit
            .as_ref()
            .unwrap()
            .lower
            .as_ref()
            .unwrap()
            .value(),
        -0.6
    );
    let stated: Vec<Option<i32>> = joint
        .axis
        .0
        .iter()
        .map(|n| n.stated().map(|s| s.decimals))
        .collect();
    assert_eq!(
        stated,
        [None, Some(2), Some(1)],
        "only literals state a precision"
    );
    assert_eq!(reading.format, "kutzbach-urdf");
}

#[test]
fn loops_couplings_and_mimics() {
    let text = robot(
        "<joint name='j' type='continuous' independent='true'><parent link='a'/><child link='b'/></joint>\n\
         <joint name='k' type='prismatic' independent='0'><parent link='b'/><child link='c'/>\
           <mimic joint='j' multiplier='-2'/></joint>\n\
         <loop name='l' type='cylindrical'><predecessor link='c'><origin xyz='1 2 3'/></predecessor>\
           <successor link='a'/><axis xyz='0 0 2'/></loop>\n\
         <coupling name='g'><predecessor link='a'/><successor link='c'/><ratio value='6.0'/>\
           <carrier link='b'/></coupling>",
    );
    let mechanism = reading(&text).mechanism;
    assert_eq!(mechanism.joints().len(), 3);
    let closing = &mechanism.joints()[2];
    assert!(closing.closes_loop);
    assert_eq!(values(&closing.predecessor.frame.position), [1.0, 2.0, 3.0]);
    assert!(closing.successor.frame.is_identity());
    let independent: Vec<Option<bool>> = mechanism.joints().iter().map(|j| j.independent).collect();
    assert_eq!(independent, [Some(true), Some(false), None]);
    assert_eq!(mechanism.couplings().len(), 2);
    for coupling in mechanism.couplings() {
        match &coupling.origin {
            CouplingOrigin::Mimic {
                multiplier, offset, ..
            } => {
                assert_eq!((multiplier.value(), offset.value()), (-2.0, 0.0));
            }
            CouplingOrigin::Ratio { ratio, carrier, .. } => {
                assert_eq!((ratio.value(), carrier.map(|link| link.0)), (6.0, Some(1)));
            }
            CouplingOrigin::Sum => panic!("no sum"),
        }
    }
    assert_eq!(
        difference(&mechanism, &reading(&write(&mechanism)).mechanism),
        None
    );
    let urdf_plus = text
        .replace("cylindrical", "revolute")
        .replace("link='a'/><successor link='c'", "link='d'/><successor link='c'")
        .replace("<carrier link='b'/>", "")
        .replace("<loop", "<link name='d'/><joint name='d' type='continuous'><parent link='b'/><child link='d'/></joint><loop");
    assert_eq!(reading(&urdf_plus).format, "urdf+");
}

#[test]
fn ground_poses_scene_and_expectation() {
    let text = chain("cylindrical", "").replace(
        "</robot>",
        "<ground link='c'/>\n\
         <configuration name='open'><position joint='j' value='0.1 ${pi}'/></configuration>\n\
         <scene><gravity xyz='0 0 -9.81'/><contact/><friction/></scene>\n\
         <expect finite='2' instantaneous='2' redundant='-1' kutzbach='3' pose='singular' kind='cusp' locked='j.rot j.trans' idle=' b ' \
          branches='3' branch_dimensions='2 1'/></robot>",
    );
    let mechanism = reading(&text).mechanism;
    assert_eq!(mechanism.link(mechanism.ground()).name, "c");
    let open = mechanism.configuration("open").unwrap();
    assert_eq!(values(&open.positions[0].1), [0.1, std::f64::consts::PI]);
    let scene = mechanism.scene().unwrap();
    assert!(scene.contact && scene.friction && !scene.limits && !scene.damping);
    assert_eq!(values(scene.gravity.as_ref().unwrap()), [0.0, 0.0, -9.81]);
    let expected = mechanism.expectation().unwrap();
    assert_eq!(
        (expected.finite, expected.redundant, expected.kutzbach),
        (Some(2), Some(-1), Some(3))
    );
    assert_eq!(expected.locked.as_deref().unwrap(), ["j.rot", "j.trans"]);
    assert_eq!(expected.idle.as_deref().unwrap(), ["b"]);
    assert_eq!(expected.branch_dimensions.as_deref().unwrap(), [1, 2]);
}

#[test]
fn a_floating_joint_places_and_does_not_constrain() {
    let reading = reading(&chain(
        "floating",
        "<origin xyz='1 0 0'/><axis xyz='0 0 0'/>",
    ));
    assert_eq!(reading.mechanism.joints().len(), 1);
    let b = reading.mechanism.link_named("b").unwrap();
    assert!(
        matches!(&reading.mechanism.link(b).placement, Placement::Floating { name, .. } if name == "j")
    );
    assert_eq!(reading.warnings.len(), 1);
}

#[test]
fn what_says_nothing_about_motion_is_skipped_and_counted() {
    let text = chain("revolute", "<safety_controller k_velocity='1'/><calibration rising='0'/><gazebo><a>text</a></gazebo><axis xyz='0 0 1'/>")
        .replace("xmlns:xacro", "xmlns:o='urn:other' o:mark='1' xmlns:xacro")
        .replace(
            "</robot>",
            "<gazebo reference='a'><b c='d'/></gazebo><transmission/><material name='red'/><sensor/><o:thing x='1'>text</o:thing>\n\
             <link name='d'><visual><geometry><ball/></geometry></visual>\
             <visual><geometry><sphere radius='1'/></geometry><material name='red'/></visual></link>\
             <joint name='m' type='fixed'><parent link='a'/><child link='d'/></joint></robot>",
        );
    let reading = reading(&text);
    let told: Vec<(&str, usize, bool)> = reading
        .skipped
        .iter()
        .map(|s| (s.what.as_str(), s.count, s.standard))
        .collect();
    let expected = [
        ("attribute `mark` of <robot>", 1, false),
        ("<safety_controller>", 1, true),
        ("<calibration>", 1, true),
        ("<gazebo>", 2, true),
        ("<transmission>", 1, true),
        ("<material>", 2, true),
        ("<sensor>", 1, true),
        ("<o:thing>", 1, false),
        (
            "<visual>: <geometry> needs a solid, found nothing",
            1,
            false,
        ),
        ("<ball>", 1, false),
    ];
    assert_eq!(told, expected);
    let place = |index: usize| (reading.skipped[index].line, reading.skipped[index].column);
    assert_eq!((place(1), place(3), place(8)), ((5, 1), (5, 61), (9, 16)));
    assert!(reading.warnings.is_empty());
    let d = reading.mechanism.link_named("d").unwrap();
    assert_eq!(reading.mechanism.link(d).visuals.len(), 1);
    assert_eq!(reading.format, "urdf");
}

#[test]
fn what_ros_reads_is_read() {
    let inside_link = |inside: &str| {
        robot(&format!(
            "<link name='d'>{inside}</link>\n\
             <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>\n\
             <joint name='k' type='fixed'><parent link='a'/><child link='c'/></joint>\n\
             <joint name='m' type='fixed'><parent link='a'/><child link='d'/></joint>"
        ))
    };
    let inertia = "iyy='1' izz='1'";
    for (text, part) in [
        (
            inside_link("<contact><lateral_friction value='1'/></contact>"),
            "<contact>",
        ),
        (
            inside_link("<self_collision_checking/>"),
            "<self_collision_checking>",
        ),
        (inside_link("<origin xyz='1 2 3'/>"), "<origin>"),
        (inside_link("stray"), "text inside <link>"),
        (
            inside_link(
                "<inertial><mass value='-1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>",
            ),
            "the mass is negative",
        ),
        (
            inside_link("<inertial><mass value='1'/></inertial>"),
            "needs <inertia>",
        ),
        (
            inside_link(&format!(
                "<inertial><mass value='1'/><inertia ixx='1' {inertia}/></inertial>"
            )),
            "`iyz`, taken as 0",
        ),
        (inside_link("<collision/>"), "needs <geometry>"),
        (
            inside_link("<collision><geometry><sphere radius='-1'/></geometry></collision>"),
            "negative",
        ),
        (
            inside_link(
                "<collision><geometry><sphere radius='1'/><box size='1 1 1'/></geometry></collision>",
            ),
            "second solid",
        ),
        (
            inside_link("").replace("name='d'>", "name='d' type='x'>"),
            "attribute `type` of <link>",
        ),
        (
            robot_of_one("<ros2_control name='x'/><frame name='f' link='a'/>"),
            "<frame>",
        ),
        (robot_of_one("<mujoco><compiler/></mujoco>"), "<mujoco>"),
        (
            chain(
                "revolute",
                "<limit effort='1' velocity='1' command_effort='3'/>",
            ),
            "`command_effort` of <limit>",
        ),
        (
            chain("revolute", "<axis xyz='1 0 0' rpy='0 0 0'>x<b/></axis>"),
            "attribute `rpy` of <axis>",
        ),
        (
            chain("revolute", "<dynamics damping='1'/><dynamics damping='2'/>"),
            "second <dynamics>",
        ),
        (
            chain("revolute", "<axis xyz='1 0 0'/><axis xyz='1 0 0'/>"),
            "second <axis>",
        ),
        (
            chain("revolute", "<dynamics damping='a' D='1'/>"),
            "<dynamics>:",
        ),
        (
            chain("revolute", "<limit effort='inf' velocity='1'/>"),
            "`effort` of <limit>",
        ),
        (
            chain("revolute", "").replace(
                "<joint name=\"j\"",
                "<joint dont_collapse='true' name=\"j\"",
            ),
            "`dont_collapse`",
        ),
    ] {
        let reading = reading(&text);
        let told: Vec<&str> = reading.skipped.iter().map(|s| s.what.as_str()).collect();
        assert!(
            told.iter().any(|what| what.contains(part)),
            "{part}: {told:?}\n{text}"
        );
    }
    // Nothing to tell of.
    assert_eq!(
        reading("<robot><link name='a'/></robot>").mechanism.name(),
        "unnamed"
    );
    for word in ["True", "TRUE", " true "] {
        let text = chain("revolute", "")
            .replace("name=\"j\"", &format!("name=\"j\" independent=\"{word}\""));
        assert_eq!(reading(&text).mechanism.joints()[0].independent, Some(true));
    }
    let numbers = chain("revolute", "<axis xyz='  +1\t0 \n 1E-3 '/>");
    assert_eq!(
        values(&reading(&numbers).mechanism.joints()[0].axis.0),
        [1.0, 0.0, 1e-3]
    );
}

fn robot_of_one(inside: &str) -> String {
    format!("<robot name='r'><link name='a'/>{inside}</robot>")
}

#[test]
fn xml_that_ros_reads_is_read() {
    for (text, part) in [
        (
            "<robot name='r'><!-- a -- b ---><link name='a'/></robot>",
            "a comment with `--`",
        ),
        (
            "\n<?xml version='1.0'?><robot name='r'><link name='a'/></robot>",
            "very start",
        ),
        (
            "<robot name='r'><link name='a'/><x:y z:w='1'/></robot>",
            "the prefix `x` is not declared",
        ),
    ] {
        let reading = reading(text);
        assert!(
            reading.warnings[0].message.contains(part),
            "{:?}",
            reading.warnings
        );
        assert_eq!(reading.mechanism.links().len(), 1);
    }
}

#[test]
fn a_strict_reading_refuses_what_is_skipped() {
    let strict = |text: &str| {
        let options = ReadOptions {
            strict: true,
            ..ReadOptions::default()
        };
        read_with(text, "file", &options)
    };
    let text = robot_of_one("\n<frame name='f'/><frame name='g'/><material name='red'/>");
    let error = strict(&text).unwrap_err();
    assert_eq!((error.line, error.column), (2, 1));
    assert_eq!(error.message, "<frame> is not read, here and 1 times more");
    assert!(error.others.is_empty());
    assert!(strict(&text.replace("frame", "material")).is_ok());
}

#[test]
fn what_may_be_meant_otherwise_is_warned_of() {
    let warning = |text: &str| {
        let reading = reading(text);
        assert_eq!(reading.warnings.len(), 1, "{:?}", reading.warnings);
        let warning = &reading.warnings[0];
        (warning.line, warning.column, warning.message.clone())
    };
    for (text, line, column, part) in [
        (
            chain("fixed", "<axis xyz='0 0 0'/>"),
            5,
            1,
            "<axis> means nothing for a fixed joint",
        ),
        (
            chain("spherical", " <axis xyz='1 0 0'/>"),
            5,
            2,
            "<axis> means nothing for a spherical joint",
        ),
        (
            chain(
                "planar",
                "<limit effort='1' velocity='1'/><axis xyz='0 0 1'/>",
            ),
            5,
            1,
            "<limit> means nothing for a planar joint",
        ),
        (
            chain(
                "revolute",
                "<joint_properties friction='0'/><axis xyz='0 0 1'/>",
            ),
            5,
            1,
            "old name of <dynamics>",
        ),
        (
            chain(
                "continuous",
                "<limit lower='-1' upper='1' effort='3'/><axis xyz='0 0 1'/>",
            ),
            5,
            1,
            "turns without end",
        ),
        (
            chain(
                "revolute",
                "<limit lower='1' upper='-1'/><axis xyz='0 0 1'/>",
            ),
            5,
            1,
            "means no limit",
        ),
        (
            chain("fixed", "<mimic joint='k'/>"),
            5,
            1,
            "<mimic> means nothing for a fixed joint",
        ),
        (
            chain("floating", "<mimic joint='k'/>"),
            5,
            1,
            "<mimic> means nothing for a floating joint",
        ),
        (
            chain("fixed", "").replace(
                "</robot>",
                "<joint name='m' type='fixed'><parent link='a'/><child link='c'/></joint></robot>",
            ),
            8,
            1,
            "joint `m` closes a loop: link `c` is the child of joint `k` already",
        ),
    ] {
        let (found_line, found_column, message) = warning(&text);
        assert_eq!((found_line, found_column), (line, column), "{message}");
        assert!(message.contains(part), "{message}");
    }
    let text = chain("continuous", "<limit lower='-1' upper='1' effort='3'/>");
    let limit = reading(&text).mechanism.joints()[0].limit.clone().unwrap();
    assert!(limit.lower.is_none() && limit.upper.is_none() && limit.effort.is_some());
}

#[test]
fn names_and_text_survive_the_quirks_of_xml() {
    let text = "\u{feff}<?xml version='1.0' encoding='utf-8'?>\r\n<!-- - -->\r\n<?pi x?><robot xmlns='urn:any' name=\"a &amp; 'b' &#233;\">\
                <!-- <link/> --><link name='\u{3bb}'></link><![CDATA[ \n]]></robot>\n<!-- end -->\n";
    let reading = reading(text);
    assert_eq!(reading.mechanism.name(), "a & 'b' é");
    assert_eq!(reading.mechanism.links()[0].name, "λ");
}

#[test]
fn motors_are_read_in_every_form() {
    let actuated = |inside: &str| -> Vec<String> {
        let text = chain("revolute", "")
            .replace("fixed", "revolute")
            .replace("</robot>", &format!("{inside}</robot>"));
        let mechanism = reading(&text).mechanism;
        let names = mechanism.actuated().iter();
        names.map(|id| mechanism.joint(*id).name.clone()).collect()
    };
    assert_eq!(
        actuated("<transmission name='t'><type>x</type><joint name='k'/></transmission>"),
        ["k"]
    );
    assert_eq!(
        actuated(
            "<transmission type='t' name='t'><joint name='k'/><joint name='j'/></transmission>"
        ),
        ["j", "k"]
    );
    let control = "<ros2_control name='r'><hardware><plugin>p</plugin></hardware>\
                   <joint name='j'><command_interface name='position'/></joint>\
                   <joint name='k'><state_interface name='position'/></joint></ros2_control>";
    assert_eq!(actuated(control), ["j"]);
    assert_eq!(
        actuated(
            "<mujoco><actuator><motor joint='j'/><position name='p' joint='k'/></actuator></mujoco>"
        ),
        ["j", "k"]
    );
    assert!(actuated("").is_empty());
    // A motor of a joint that does not exist, and one of a joint that cannot move.
    let text = chain("fixed", "").replace(
        "</robot>",
        "<transmission><joint name='j'/></transmission><transmission><joint name='x'/></transmission></robot>",
    );
    let reading = reading(&text);
    assert!(reading.mechanism.actuated().is_empty());
    let told = |part: &str| reading.skipped.iter().any(|s| s.what.contains(part));
    assert!(told("`j` cannot move") && told("`x` does not exist"));
    assert_eq!(reading.skipped.len(), 2, "{:?}", reading.skipped);
}

/// Two links on a base, with more inside the robot.
fn two_joints(inside: &str) -> String {
    robot(&format!(
        "<joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint>\
         <joint name='k' type='prismatic'><parent link='b'/><child link='c'/><origin xyz='0 2 0'/><axis xyz='0 0 -3'/></joint>{inside}"
    ))
}

#[test]
fn what_was_read_is_not_told_as_not_read() {
    for read in [
        "<transmission name='t'><type>x</type><joint name='k'/></transmission>",
        "<mujoco><actuator><motor joint='j'/></actuator></mujoco>",
        "<mujoco><equality><connect body1='b' body2='a' anchor='0 0 0'/></equality></mujoco>",
        "<mujoco><equality><joint joint1='j' joint2='k'/></equality></mujoco>",
        "<ros2_control name='r'><joint name='j'><command_interface name='position'/></joint></ros2_control>",
    ] {
        let reading = reading(&two_joints(read));
        assert!(reading.skipped.is_empty(), "{read}: {:?}", reading.skipped);
        let first = reading.warnings.iter().find(|w| w.kind.is_told_first());
        assert!(first.is_none(), "{read}: {first:?}");
    }
    // Parts that are not read are told by their own names.
    let text = two_joints(
        "<mujoco><compiler angle='radian'/><actuator><motor joint='j'/></actuator></mujoco>",
    );
    let skipped: Vec<String> = reading(&text).skipped.into_iter().map(|s| s.what).collect();
    assert_eq!(skipped, ["<compiler> inside <mujoco>"]);
}

#[test]
fn every_equality_constrains_or_is_told_first() {
    let with = |equality: &str| {
        reading(&two_joints(&format!(
            "<mujoco><equality>{equality}</equality></mujoco>"
        )))
    };
    // Held where the coefficient says, as the joint would stand there: q = 0.3 about z, 0.5 m along -z.
    for (equality, joint, frame) in [
        ("<joint joint1='j' polycoef='0 0 0 0 0'/>", "j", [0.0, 0.0]),
        ("<joint joint1='j'/>", "j", [0.0, 0.0]),
        ("<joint joint1='j' polycoef='0.3'/>", "j", [-0.3, 0.0]),
        ("<joint joint1='k' polycoef='0.5 1'/>", "k", [0.0, 0.5]),
    ] {
        let reading = with(equality);
        let mechanism = &reading.mechanism;
        let held = mechanism.joint(mechanism.joint_named(joint).unwrap());
        assert_eq!(held.kind, JointKind::Fixed, "{equality}");
        assert_eq!(mechanism.freedom(), 1, "{equality}");
        let side = &held.successor.frame;
        let found = [side.roll_pitch_yaw[2].value(), side.position[2].value()];
        assert_eq!(found, frame, "{equality}");
        assert!(
            reading
                .warnings
                .iter()
                .any(|w| w.message.contains("read as fixed"))
        );
        assert!(reading.skipped.is_empty());
    }
    for equality in [
        "<tendon tendon1='t'/>",
        "<distance geom1='x' geom2='y'/>",
        "<joint joint1='j' joint2='k' polycoef='0 1 2'/>",
        "<joint joint1='nobody'/>",
    ] {
        let reading = with(equality);
        assert_eq!(reading.mechanism.freedom(), 2);
        let first: Vec<_> = reading
            .warnings
            .iter()
            .filter(|w| w.kind.is_told_first())
            .collect();
        assert_eq!(first.len(), 1, "{equality}: {:?}", reading.warnings);
    }
    let idle = with("<joint joint1='j' active='false'/>");
    assert_eq!(idle.mechanism.freedom(), 2);
    assert!(idle.warnings.is_empty() && idle.skipped[0].what.contains("not active"));
}

#[test]
fn limits_beyond_all_numbers_are_none() {
    let limit = "<limit lower='-1.79769e+308' upper='1.79769e+308' effort='1.79769e+308' velocity='1e400'/>";
    let reading = reading(&chain("revolute", limit));
    let joint = &reading.mechanism.joints()[0];
    assert!(joint.bounds().is_none() && joint.limit == Some(Limit::default()));
    assert!(reading.warnings.iter().all(|w| !w.message.contains("0…0")));
    let mechanism =
        self::reading(&chain("revolute", "<limit lower='-1e101' upper='2'/>")).mechanism;
    assert_eq!(
        mechanism.joints()[0].bounds(),
        Some((f64::NEG_INFINITY, 2.0))
    );
}

#[test]
fn bounds_left_out_mean_another_thing_in_version_1_2() {
    let text = chain("revolute", "<limit effort='1' velocity='2'/>");
    for (version, part) in [
        ("1.0", "0…0 in URDF"),
        ("1.2", "some readers of URDF 1.2 refuse"),
    ] {
        let text = text.replacen("<robot", &format!("<robot version='{version}'"), 1);
        let warnings = reading(&text).warnings;
        assert!(
            warnings.iter().any(|w| w.message.contains(part)),
            "{version}: {warnings:?}"
        );
    }
}

#[test]
fn quaternions_before_version_1_1_are_read_and_told() {
    let text = chain("revolute", "<origin quat_xyzw='0 0 1 0'/>");
    for (version, told) in [
        ("", true),
        (" version='1.0'", true),
        (" version='1.1'", false),
        (" version='1.2'", false),
    ] {
        let reading = reading(&text.replacen("<robot", &format!("<robot{version}"), 1));
        let turned = &reading.mechanism.joints()[0]
            .predecessor
            .frame
            .roll_pitch_yaw[2];
        assert!((turned.value() - std::f64::consts::PI).abs() < 1e-12);
        let said = reading
            .warnings
            .iter()
            .any(|w| w.message.contains("version 1.1"));
        assert_eq!(said, told, "{version}");
    }
}

#[test]
fn a_call_left_over_from_an_expansion_is_skipped_and_said_so() {
    let text = chain("revolute", "<axis xyz='1 0 0'/>").replace(
        "</robot>",
        "<xacro:sensors xmlns:xacro='http://www.ros.org/wiki/xacro' side='left'/></robot>",
    );
    let error = read(&text, "robot.xacro", &[]).unwrap_err();
    assert!(error.message.contains("unknown macro `sensors`"), "{error}");
    assert_eq!((error.line, error.column), (8, 1));
    let reading = read(&text, "robot.urdf", &[]).unwrap();
    assert_eq!(reading.format, "urdf");
    let told: Vec<&str> = reading.skipped.iter().map(|s| s.what.as_str()).collect();
    assert!(
        told.iter()
            .any(|what| what.contains("<xacro:sensors>, the call of a macro")),
        "{told:?}"
    );
    let [warning] = &reading.warnings[..] else {
        panic!("{:?}", reading.warnings);
    };
    assert_eq!((warning.line, warning.column), (8, 1));
    assert!(warning.message.contains("<xacro:sensors>"), "{warning:?}");
}

#[test]
fn rates_and_forces_of_a_limit_are_no_slips_of_each_other() {
    let limit = "<limit effort='1' k_velocity='0' velocity='2'/>";
    let reading = reading(&chain("revolute", limit));
    assert_eq!(reading.skipped.len(), 1);
    let slip = chain("revolute", "<limit lowr='0' upper='1'/>");
    let error = kutzbach::format::read(&slip, "slip.urdf", &[]).unwrap_err();
    assert_eq!(error.help.as_deref(), Some("did you mean `lower`?"));
}

#[test]
fn a_quaternion_turns_a_frame_as_its_angles_do() {
    let with = |turned: &str| {
        let text = chain("revolute", &format!("<origin xyz='1 2 3' {turned}/>"));
        kutzbach::format::read(&text, "turned.urdf", &[])
    };
    let yaw = |turned: &str| {
        let mechanism = with(turned)
            .unwrap_or_else(|error| panic!("{error}"))
            .mechanism;
        let joint = mechanism.joint_named("j").expect("the joint");
        mechanism.joint(joint).predecessor.frame.roll_pitch_yaw[2].value()
    };
    let by_angle = yaw("rpy='0 0 1.5707963267948966'");
    let by_quaternion = yaw("quat_xyzw='0 0 0.70710678118654757 0.70710678118654757'");
    assert_eq!(by_angle, by_quaternion);
    assert!(with("rpy='0 0 1' quat_xyzw='0 0 0 1'").is_err());
    assert!(with("quat_xyzw='0 0 0 0'").is_err());
    assert!(with("quat_xyzw='0 0 1'").is_err());
}

#[test]
fn couplings_are_sums_over_any_number_of_joints() {
    let arm = |name: &str| {
        format!(
            "<link name='{name}'/><joint name='j{name}' type='continuous'><parent link='base'/><child link='{name}'/></joint>"
        )
    };
    let text = |inside: &str| {
        let arms: String = ["a", "b", "c", "d"].map(arm).concat();
        format!("<robot name='sums'><link name='base'/>{arms}{inside}</robot>")
    };
    let sum = "<coupling name='s' offset='0.5'><term joint='ja' coefficient='1'/><term joint='jb' coefficient='${1/3}'/><term joint='jd' coefficient='-2'/></coupling>";
    let read = reading(&text(sum));
    let coupling = &read.mechanism.couplings()[0];
    assert_eq!(coupling.origin, CouplingOrigin::Sum);
    let terms: Vec<(usize, f64)> = coupling
        .terms
        .iter()
        .map(|term| (term.joint.0, term.factor.value()))
        .collect();
    assert_eq!(terms, [(0, 1.0), (1, 1.0 / 3.0), (3, -2.0)]);
    assert_eq!(coupling.offset.value(), 0.5);
    let again = reading(&write(&read.mechanism)).mechanism;
    assert_eq!(difference(&read.mechanism, &again), None);
    for (inside, told) in [
        (
            "<coupling name='s'><term joint='ja' coefficient='1'/><term joint='ja' coefficient='2'/></coupling>",
            "joint `ja` has two terms",
        ),
        (
            "<coupling name='s'><term joint='ja' coefficient='0'/></coupling>",
            "coefficient that is not zero",
        ),
        (
            "<coupling name='s'><term joint='jx' coefficient='1'/></coupling>",
            "`jx`",
        ),
        (
            "<coupling name='s'><term joint='ja' coefficient='1'/><ratio value='1'/></coupling>",
            "<ratio> beside <term>",
        ),
    ] {
        let error = kutzbach::format::read(&text(inside), "sums", &[]).unwrap_err();
        assert!(error.message.contains(told), "{error}");
    }
}
