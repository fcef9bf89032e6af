//! Loops in the words of other tools: what they mean, and that they are written back as loops.
//!
//! ```text
//!   b ------- c          a stands; b, c and d are joined by revolute joints
//!   |         |          about z; the loop is closed between b and c or
//!   a ------- d          between c and d
//! ```

use crate::format_support;

use format_support::difference;
use kutzbach::format::{ReadOptions, Reading, is_told_first, read, read_with, write};
use kutzbach::mechanism::{Joint, JointKind};
use kutzbach::number::Number;

fn reading(text: &str) -> Reading {
    let reading =
        read(text, "file", &[]).unwrap_or_else(|error| panic!("{error} {:?}\n{text}", error.help));
    let written = write(&reading.mechanism);
    let again = read(&written, "written", &[]).unwrap_or_else(|error| panic!("{error}\n{written}"));
    assert_eq!(
        difference(&reading.mechanism, &again.mechanism),
        None,
        "{written}"
    );
    reading
}

/// Three bars in a row on a, with something more; the second bar is turned by `rpy`.
fn bars(rpy: &str, more: &str) -> String {
    let joint = |name: &str, parent: &str, child: &str, origin: &str| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{parent}'/><child link='{child}'/>\
             <origin {origin}/><axis xyz='0 0 1'/></joint>"
        )
    };
    format!(
        "<robot name='r' xmlns:drake='urn:drake' xmlns:joint='urn:joint'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>\n{}{}{}\n{more}</robot>",
        joint("ab", "a", "b", "xyz='0 1 0'"),
        joint("bc", "b", "c", &format!("xyz='2 0 0' rpy='{rpy}'")),
        joint("ad", "a", "d", "xyz='2 0 0'"),
    )
}

fn values(numbers: &[Number]) -> Vec<f64> {
    numbers.iter().map(Number::value).collect()
}

fn position(joint: &Joint) -> [Vec<f64>; 2] {
    [&joint.predecessor, &joint.successor].map(|side| values(&side.frame.position))
}

fn last(reading: &Reading) -> &Joint {
    reading.mechanism.joints().last().unwrap()
}

#[test]
fn a_joint_inside_gazebo_closes_a_loop() {
    let more = "<gazebo><joint name='dc' type='revolute'><parent>d</parent><child>r::c</child>\
                <pose>0 -0.5 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1e16</upper></limit></axis>\
                </joint></gazebo>";
    let reading = reading(&bars("0 0 0", more));
    let joint = last(&reading);
    assert_eq!(
        (joint.name.as_str(), joint.kind),
        ("dc", JointKind::Revolute)
    );
    assert!(joint.closes_loop);
    // c is at (2, 1) and d at (2, 0): the joint is half a metre above d.
    assert_eq!(position(joint), [vec![0.0, 0.5, 0.0], vec![0.0, -0.5, 0.0]]);
    assert_eq!(values(&joint.axis.0), [0.0, 0.0, 1.0]);
    let limit = joint.limit.as_ref().unwrap();
    assert_eq!(limit.lower.as_ref().map(Number::value), Some(-1.0));
    assert!(limit.upper.is_none(), "1e16 is no limit");
    assert_eq!(reading.format, "urdf+");
    assert!(
        reading.warnings[0]
            .message
            .contains("a tree with 3 degrees of freedom"),
        "{:?}",
        reading.warnings
    );
    assert!(reading.mechanism.precision().is_exact());
}

#[test]
fn both_sides_of_a_joint_inside_gazebo_follow_from_the_home_pose() {
    // c is turned by a quarter about x, then, in a second file, by angles without closed form.
    for (rpy, is_exact) in [
        ("${pi/2} 0 0", true),
        ("0 ${pi/2} ${pi/4}", true),
        ("0.3 0.2 0.1", false),
    ] {
        let more = "<gazebo><joint name='dc' type='ball'><parent>d</parent><child>c</child><pose>0 1 2 0 0 0</pose></joint></gazebo>";
        let reading = reading(&bars(rpy, more));
        let joint = last(&reading);
        let frame = &reading.mechanism.joints()[1].predecessor.frame;
        let [roll, pitch, yaw] = [0, 1, 2].map(|k| frame.roll_pitch_yaw[k].value());
        let turned = turn(roll, pitch, yaw, [0.0, 1.0, 2.0]);
        // The point in c, seen from d: c's origin is one above d's.
        let [seen, own] = position(joint);
        assert_eq!(own, [0.0, 1.0, 2.0]);
        for (found, expected) in seen.iter().zip([turned[0], 1.0 + turned[1], turned[2]]) {
            assert!(
                (found - expected).abs() < 1e-15,
                "{rpy}: {seen:?} {turned:?}"
            );
        }
        // And a direction.
        let [roll, pitch, yaw] =
            [0, 1, 2].map(|k| joint.predecessor.frame.roll_pitch_yaw[k].value());
        let (found, expected) = (turn(roll, pitch, yaw, [3.0, 1.0, 2.0]), {
            let [roll, pitch, yaw] = [0, 1, 2].map(|k| frame.roll_pitch_yaw[k].value());
            turn(roll, pitch, yaw, [3.0, 1.0, 2.0])
        });
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-14, "{rpy}");
        }
        let exact = |n: &Number| n.stated().is_none() && n.rational().is_none_or(|r| r.is_int());
        assert_eq!(
            joint.predecessor.frame.position.iter().all(exact),
            is_exact,
            "{rpy}"
        );
    }
}

/// `Rz(yaw) Ry(pitch) Rx(roll)` of a vector.
fn turn(roll: f64, pitch: f64, yaw: f64, v: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = v;
    let (y, z) = (
        y * roll.cos() - z * roll.sin(),
        y * roll.sin() + z * roll.cos(),
    );
    let (x, z) = (
        x * pitch.cos() + z * pitch.sin(),
        z * pitch.cos() - x * pitch.sin(),
    );
    [
        x * yaw.cos() - y * yaw.sin(),
        x * yaw.sin() + y * yaw.cos(),
        z,
    ]
}

#[test]
fn the_axis_is_in_the_joint_frame_or_in_the_models() {
    let more = |flag: &str, frame: &str| {
        format!(
            "<gazebo><joint name='dc' type='prismatic'><parent>d</parent><child>c</child>\
             <axis><xyz{frame}>0 0 1</xyz>{flag}</axis></joint></gazebo>"
        )
    };
    // c is turned by a quarter about x: its z is −y of the model.
    let seen_from_d = |more: &str| {
        let reading = reading(&bars("${pi/2} 0 0", more));
        let joint = last(&reading).clone();
        let [roll, pitch, yaw] =
            [0, 1, 2].map(|k| joint.predecessor.frame.roll_pitch_yaw[k].value());
        let axis = values(&joint.axis.0);
        turn(roll, pitch, yaw, [axis[0], axis[1], axis[2]]).map(f64::round)
    };
    assert_eq!(seen_from_d(&more("", "")), [0.0, -1.0, 0.0]);
    let flag = "<use_parent_model_frame>1</use_parent_model_frame>";
    assert_eq!(seen_from_d(&more(flag, "")), [0.0, 0.0, 1.0]);
    assert_eq!(
        seen_from_d(&more("", " expressed_in='__model__'")),
        [0.0, 0.0, 1.0]
    );
}

#[test]
fn threads_are_right_handed_in_metres_per_turn() {
    let lead = |pitch: &str| {
        let more = format!(
            "<gazebo><joint name='dc' type='screw'><parent>d</parent><child>c</child>\
             <axis><xyz>0 0 1</xyz></axis>{pitch}</joint></gazebo>"
        );
        last(&reading(&bars("0 0 0", &more)))
            .lead
            .as_ref()
            .unwrap()
            .value()
    };
    assert_eq!(lead("<screw_thread_pitch>0.01</screw_thread_pitch>"), 0.01);
    let old = lead("<thread_pitch>-100</thread_pitch>");
    assert!((old - std::f64::consts::TAU / 100.0).abs() < 1e-15, "{old}");
    assert_eq!(
        lead("<thread_pitch>5</thread_pitch><screw_thread_pitch>0.01</screw_thread_pitch>"),
        0.01
    );
}

#[test]
fn joints_of_old_gazebo_and_the_names_that_they_share() {
    // As the PR2's gripper: the slider has the name of a fixed joint, and its motor drives the slider.
    let more = "<link name='tip'/><joint name='grip' type='fixed'><parent link='c'/><child link='tip'/></joint>\n\
                <gazebo><joint:slider name='grip'><body1>d</body1><body2>c</body2><anchor>c</anchor><axis>0 1 0</axis>\
                <anchorOffset>0 -1 0</anchorOffset></joint:slider></gazebo>\n\
                <transmission name='t'><gap_joint name='grip'/><passive_joint name='ab'/></transmission>";
    let reading = reading(&bars("0 0 0", more));
    let joint = last(&reading);
    assert_eq!(
        (joint.name.as_str(), joint.kind),
        ("grip_in_gazebo", JointKind::Prismatic)
    );
    assert_eq!(position(joint), [vec![0.0, 0.0, 0.0], vec![0.0, -1.0, 0.0]]);
    let actuated = reading.mechanism.actuated();
    assert_eq!(actuated.len(), 1);
    assert_eq!(reading.mechanism.joint(actuated[0]).name, "grip_in_gazebo");
}

#[test]
fn what_the_tree_has_already_is_read_once() {
    let of_kind = |kind: &str, name: &str, parent: &str, child: &str| {
        format!(
            "<gazebo><joint name='{name}' type='{kind}'><parent>{parent}</parent><child>{child}</child></joint></gazebo>"
        )
    };
    let joint = |name: &str, parent: &str, child: &str| of_kind("fixed", name, parent, child);
    let told = |more: &str| {
        let reading = reading(&bars("0 0 0", more));
        (
            reading.mechanism.joints().len(),
            reading.warnings[0].message.clone(),
        )
    };
    let (joints, warning) = told(&of_kind("revolute", "ab", "a", "b"));
    assert!(joints == 3 && warning.contains("read once"), "{warning}");
    let (joints, warning) = told(&joint("other", "a", "b"));
    assert!(
        joints == 4 && warning.contains("the same two links as joint `ab`"),
        "{warning}"
    );
    let (joints, warning) = told(&joint("stand", "world", "a"));
    assert!(
        joints == 3 && warning.contains("holds the root link"),
        "{warning}"
    );
    let text = bars("0 0 0", &joint("ab", "a", "b"));
    let refused = read(&text, "bars.urdf", &[]).unwrap_err().to_string();
    let said = "joint `ab` is revolute in the tree and fixed inside <gazebo>";
    assert!(refused.contains(said), "{refused}");
}

#[test]
fn a_joint_to_the_world_leaves_the_root_free() {
    let more = "<gazebo><joint name='foot' type='revolute'><parent>world</parent><child>d</child><axis><xyz>0 0 1</xyz></axis></joint></gazebo>";
    let mechanism = reading(&bars("0 0 0", more)).mechanism;
    assert_eq!(mechanism.link(mechanism.ground()).name, "world");
    let foot = mechanism.joints().last().unwrap();
    assert_eq!(mechanism.link(foot.predecessor.link).name, "world");
    assert_eq!(position(foot)[0], [2.0, 0.0, 0.0]);
}

#[test]
fn constraints_of_drake() {
    let point = |what: &str, more: &str| {
        format!(
            "<drake:{what}><drake:{what}_body_A name='d'/><drake:{what}_body_B name='c'/>\
             <drake:{what}_p_AP value='0 1 0'/><drake:{what}_p_BQ value='0 0 0.5'/>{more}</drake:{what}>"
        )
    };
    let ball = reading(&bars("0 0 0", &point("ball_constraint", "")));
    assert_eq!(last(&ball).kind, JointKind::Spherical);
    assert_eq!(
        position(last(&ball)),
        [vec![0.0, 1.0, 0.0], vec![0.0, 0.0, 0.5]]
    );
    let rod = "<drake:distance_constraint_distance value='0.5'/>";
    let rod = reading(&bars("0 0 0", &point("distance_constraint", rod)));
    assert_eq!(last(&rod).kind, JointKind::Distance);
    let spring = "<drake:distance_constraint_distance value='0.5'/><drake:distance_constraint_stiffness value='10'/>";
    let spring = reading(&bars("0 0 0", &point("distance_constraint", spring)));
    assert_eq!(spring.mechanism.joints().len(), 3);
    assert!(spring.skipped[0].what.contains("a spring"));
    let bushing = reading(&bars(
        "0 0 0",
        "<drake:linear_bushing_rpy><drake:bushing_frameA name='c'/></drake:linear_bushing_rpy>",
    ));
    assert!(bushing.skipped[0].what.contains("leaves the motion free"));

    let typed = |joint: &str| {
        let more =
            format!("<link name='e'/>{joint}<parent link='a'/><child link='e'/></drake:joint>");
        last(&reading(&bars("0 0 0", &more))).clone()
    };
    let screw = typed(
        "<drake:joint name='s' type='screw'><axis xyz='0 0 1'/><drake:screw_thread_pitch value='0.02'/>",
    );
    assert_eq!(screw.lead.unwrap().value(), 0.02);
    let universal = typed("<drake:joint name='u' type='universal'>");
    assert_eq!(values(&universal.axis.0), [1.0, 0.0, 0.0]);
    assert_eq!(values(&universal.axis2.0), [0.0, 1.0, 0.0]);
    assert_eq!(
        typed("<drake:joint name='b' type='ball'>").kind,
        JointKind::Spherical
    );
    // Whether the prefix is declared does not matter.
    let undeclared =
        bars("0 0 0", &point("ball_constraint", "")).replace("xmlns:drake='urn:drake'", "");
    assert_eq!(last(&reading(&undeclared)).kind, JointKind::Spherical);
    let mimic = bars("0 0 0", "").replace("<axis", "<drake:mimic joint='ad' multiplier='2'/><axis");
    let mimic = mimic
        .replacen("<drake:mimic joint='ad' multiplier='2'/>", "", 2)
        .replace("joint='ad'", "joint='ab'");
    assert_eq!(reading(&mimic).mechanism.couplings().len(), 1);
}

#[test]
fn loops_of_isaac_sim_and_of_the_proposed_constraint() {
    for second in ["link2", "link1"] {
        let more = format!(
            "<loop_joint name='l' type='spherical'><link1 link='d' xyz='0 1 0' rpy='0 0 0'/><{second} link='c' xyz='0 0 0'/></loop_joint>"
        );
        let reading = reading(&bars("0 0 0", &more));
        assert_eq!(last(&reading).kind, JointKind::Spherical);
        assert_eq!(position(last(&reading))[0], [0.0, 1.0, 0.0]);
    }
    let more = "<constraint name='l' type='universal'><parent link='d'/><parent_origin xyz='0 1 0'/><parent_axis xyz='0 0 1'/>\
                <child link='c'/><child_origin xyz='0 0 3'/><child_axis xyz='1 0 0'/></constraint>";
    let reading = reading(&bars("0 0 0", more));
    let joint = last(&reading);
    assert_eq!(joint.kind, JointKind::Universal);
    assert_eq!(position(joint), [vec![0.0, 1.0, 0.0], vec![0.0, 0.0, 3.0]]);
    assert_eq!(
        (values(&joint.axis.0), values(&joint.axis2.0)),
        (vec![0.0, 0.0, 1.0], vec![1.0, 0.0, 0.0])
    );
}

#[test]
fn frames_that_are_named_like_a_closure_are_told() {
    let more = "<link name='closing_x_1'/><link name='closing_x_2'/>\
                <joint name='f1' type='fixed'><parent link='c'/><child link='closing_x_1'/></joint>\
                <joint name='f2' type='fixed'><parent link='d'/><child link='closing_x_2'/></joint>";
    let told = reading(&bars("0 0 0", more)).warnings;
    assert!(
        told.len() == 1
            && told[0]
                .message
                .contains("look like the two sides of a loop")
    );
    let more = format!(
        "{more}<loop name='l' type='fixed'><predecessor link='closing_x_1'/><successor link='closing_x_2'/></loop>"
    );
    assert!(reading(&bars("0 0 0", &more)).warnings.is_empty());
}

#[test]
fn rolling_is_what_a_coupling_means() {
    let more = |word: &str| {
        format!(
            "<coupling name='g'{word}><predecessor link='b'/><successor link='d'/><ratio value='6.0'/></coupling>"
        )
    };
    let plain = reading(&bars("0 0 0", &more(""))).mechanism;
    let rolling = reading(&bars("0 0 0", &more(" type='rolling'"))).mechanism;
    assert_eq!(difference(&plain, &rolling), None);
    let error = read(&bars("0 0 0", &more(" type='sliding'")), "f", &[]).unwrap_err();
    assert!(
        error.message.contains("needed rolling, found `sliding`"),
        "{error}"
    );
}

#[test]
fn links_that_only_gazebo_knows() {
    // e stands at (2, 0.5) of the model and is held by two joints: a bar between c and d.
    let more = "<gazebo><link name='e'><inertial><mass>1</mass></inertial><pose>2 0.5 0 0 0 0</pose></link></gazebo>\
                <gazebo><joint name='ce' type='revolute'><parent>c</parent><child>e</child><pose>0 0.5 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis></joint>\
                <joint name='de' type='revolute'><parent>d</parent><child>e</child><pose relative_to='d'/><axis><xyz>0 0 1</xyz></axis></joint></gazebo>";
    let reading = reading(&bars("0 0 0", more));
    let mechanism = &reading.mechanism;
    assert_eq!((mechanism.links().len(), mechanism.joints().len()), (5, 5));
    assert_eq!(mechanism.link(mechanism.ground()).name, "a");
    let [ce, de] = [3, 4].map(|index| position(&mechanism.joints()[index]));
    assert_eq!(ce, [vec![0.0, 0.0, 0.0], vec![0.0, 0.5, 0.0]]);
    assert_eq!(de, [vec![0.0, 0.0, 0.0], vec![0.0, -0.5, 0.0]]);
}

#[test]
fn one_name_is_one_value() {
    // The tree measures with `gap` how far a frame is from d, and Gazebo how far c is.
    let more = "<link name='frame'/><joint name='gap' type='prismatic'><parent link='d'/><child link='frame'/></joint>\
                <gazebo><joint name='gap' type='prismatic'><parent>d</parent><child>c</child><axis><xyz>1 0 0</xyz></axis></joint></gazebo>";
    let reading = reading(&bars("0 0 0", more));
    assert_eq!(reading.mechanism.couplings().len(), 1);
    assert!(
        reading
            .warnings
            .iter()
            .any(|w| w.message.contains("both have one value"))
    );
    assert!(
        reading
            .warnings
            .iter()
            .any(|w| w.message.contains("a tree with 4 degrees"))
    );
}

/// The fault of three bars with something more.
fn fault(more: &str) -> String {
    match read(&bars("0 0 0", more), "file", &[]) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("read: {more}"),
    }
}

#[test]
fn what_bears_on_a_loop_and_is_not_read_is_refused() {
    let sdf = |parts: &str| {
        format!(
            "<gazebo><joint name='l' type='revolute'><parent>d</parent><child>c</child>{parts}</joint></gazebo>"
        )
    };
    let isaac = |parts: &str| format!("<loop_joint name='l' type='revolute'>{parts}</loop_joint>");
    let sides = "<link1 link='d' xyz='0 1 0'/><link2 link='c'/>";
    let proposed = |parts: &str| {
        format!(
            "<constraint name='l' type='revolute'><parent link='d'/><child link='c'/>{parts}</constraint>"
        )
    };
    for (more, said) in [
        (sdf("<axis xyz='1 0 0'/>"), "written as SDFormat does"),
        (sdf("<axis><xzy>1 0 0</xzy></axis>"), "<xzy>"),
        (
            sdf("<axis><xyz>1 0 0</xyz></axis><axis><xyz>0 0 1</xyz></axis>"),
            "second <axis>",
        ),
        (sdf("<origin xyz='0 1 0'/><axis/>"), "<origin>"),
        (sdf("<axis/><mimic joint='ab'/>"), "<mimic>"),
        (
            isaac("<link1 link='d'><origin xyz='0 1 0'/></link1><link2 link='c'/>"),
            "<origin>",
        ),
        (isaac(&format!("{sides}<axsi xyz='0 0 1'/>")), "<axsi>"),
        (isaac(&format!("{sides}<mimic joint='ab'/>")), "<mimic>"),
        (proposed("<parent_orign xyz='0 1 0'/>"), "<parent_orign>"),
        (proposed("<axis xyz='0 0 1'/>"), "<axis>"),
        (proposed("<mimic joint='ab'/>"), "<mimic>"),
        (
            "<mujoco><equality><weld body1='b'/></equality></mujoco>".to_owned(),
            "in the world",
        ),
        (
            "<loop name='l' type='revolute'><predecessor link='d' xyz='0 1 0'/><successor link='c'/></loop>".to_owned(),
            "`xyz` is not read in <predecessor>",
        ),
        (
            "<loop name='l' type='revolute'><predecessor link='d'/><successor link='c' rpy='0 0 1'/></loop>".to_owned(),
            "`rpy` is not read in <successor>",
        ),
        (
            "<mujoco><equality><weld site1='x' site2='y'/></equality></mujoco>".to_owned(),
            "joins two links",
        ),
    ] {
        let told = fault(&more);
        assert!(told.contains(said), "{more}: {told}");
    }
}

#[test]
fn the_childs_axis_alone_is_the_axis() {
    let more = "<constraint name='l' type='revolute'><parent link='d'/><child link='c'/><child_axis xyz='1 0 0'/></constraint>";
    assert_eq!(
        values(&last(&reading(&bars("0 0 0", more))).axis.0),
        [1.0, 0.0, 0.0]
    );
}

#[test]
fn a_joint_inside_gazebo_may_follow_another() {
    let more = "<gazebo><joint name='l' type='revolute'><parent>d</parent><child>c</child><axis><xyz>0 0 1</xyz>\
                <mimic joint='ab'><multiplier>0.5</multiplier><offset>1</offset><reference>4</reference></mimic></axis></joint></gazebo>";
    let reading = reading(&bars("0 0 0", more));
    let [coupling] = reading.mechanism.couplings() else {
        panic!("one coupling")
    };
    let mut factors: Vec<f64> = coupling.terms.iter().map(|t| t.factor.value()).collect();
    factors.sort_by(f64::total_cmp);
    assert_eq!(factors, [-0.5, 1.0]);
    // 0.5 (ab − 4) + 1.
    assert_eq!(coupling.offset.value().abs(), 1.0);
}

#[test]
fn what_names_two_joints_or_links_and_is_not_read_is_told_first() {
    let joins = |more: &str| {
        let reading = reading(&bars("0 0 0", more));
        let warnings = reading.warnings.iter();
        warnings
            .filter(|w| w.message.contains(kutzbach::format::MAY_JOIN))
            .count()
    };
    for more in [
        "<ros2_control><joint name='ab'><param name='mimic'>ad</param><param name='multiplier'>x</param></joint></ros2_control>",
        "<mujoco><equality><joint joint1='ab' joint2='ad' polycoef='0 1 0.5 0 0'/></equality></mujoco>",
        "<mujoco><tendon><fixed name='t'><joint joint='ab' coef='1'/><joint joint='ad' coef='-1'/></fixed></tendon></mujoco>",
        "<gazebo><plugin filename='x.so'><joint>ab</joint><mimicJoint>ad</mimicJoint></plugin></gazebo>",
        "<gazebo><plugin filename='x.so'><parentLink>r::c</parentLink><childLink>r::d</childLink></plugin></gazebo>",
        "<gear joint1='ab' joint2='ad' ratio='-2'/>",
        "<loop_closure><base link='c'/><tip link='d'/></loop_closure>",
    ] {
        assert_eq!(joins(more), 1, "{more}");
    }
    for more in [
        "<ros2_control><joint name='ab'/><joint name='ad'/></ros2_control>",
        "<gazebo><plugin filename='drive.so'><leftJoint>ab</leftJoint><rightJoint>ad</rightJoint></plugin></gazebo>",
        "<gazebo><plugin filename='p3d.so'><bodyName>b</bodyName><frameName>a</frameName></plugin></gazebo>",
        "<transmission name='t'><joint name='ab'/><other joint='ad'/></transmission>",
        "<disable_collisions link1='a' link2='b'/>",
    ] {
        assert_eq!(joins(more), 0, "{more}");
    }
    // What <mimic> says too is said.
    let both = bars(
        "0 0 0",
        "<gazebo><plugin><joint>ab</joint><mimicJoint>ad</mimicJoint></plugin></gazebo>",
    )
    .replacen(
        "<origin xyz='2 0 0'/><axis xyz='0 0 1'/></joint>\n<gazebo>",
        "<origin xyz='2 0 0'/><axis xyz='0 0 1'/><mimic joint='ab'/></joint>\n<gazebo>",
        1,
    );
    assert!(both.contains("<mimic joint"));
    assert!(read(&both, "file", &[]).unwrap().warnings.is_empty());
}

#[test]
fn a_joint_follows_in_one_way() {
    let two = "<link name='e'/><joint name='ce' type='continuous'><parent link='c'/><child link='e'/>\
               <mimic joint='ab' multiplier='2'/><drake:mimic joint='ab' multiplier='3'/></joint>";
    assert!(fault(two).contains("in two ways"));
    let slip = two
        .replace("<mimic joint='ab' multiplier='2'/>", "")
        .replace("drake:mimic", "drake:mimc");
    assert!(fault(&slip).contains("<drake:mimc>"));
}

/// What is told before everything else.
fn told_first(text: &str) -> Vec<String> {
    let warnings = reading(text).warnings.into_iter();
    warnings
        .map(|warning| warning.message)
        .filter(|message| is_told_first(message))
        .collect()
}

#[test]
fn the_world_of_drake_is_a_link_that_no_file_writes() {
    let arm = |links: &str, parent: &str, child: &str| {
        format!(
            "<robot name='r'>{links}<link name='base'/><link name='arm'/>\
             <joint name='weld' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>\
             <joint name='pivot' type='continuous'><parent link='base'/><child link='arm'/><axis xyz='0 1 0'/></joint></robot>"
        )
    };
    for (parent, child) in [("world", "base"), ("base", "world")] {
        let text = arm("", parent, child);
        let mechanism = reading(&text).mechanism;
        assert_eq!(mechanism.link(mechanism.ground()).name, "world");
        assert_eq!(mechanism.freedom(), 1);
        assert_eq!(
            told_first(&text),
            ["no link of the file is called `world`: it is the ground, as in Drake"]
        );
    }
    // A world that is written is a link like any other, and one that is nearly written is probably meant.
    assert!(told_first(&arm("<link name='world'/>", "world", "base")).is_empty());
    for near in ["World", "wrold"] {
        let text = arm(&format!("<link name='{near}'/>"), "world", "base");
        let error = read(&text, "f", &[]).unwrap_err();
        assert_eq!(error.message, "there is no link named `world`");
        assert_eq!(error.help.unwrap(), format!("did you mean `{near}`?"));
    }
    // To choose the ground is not to join it.
    let ground = arm("<ground link='world'/><link name='w'/>", "w", "base");
    assert!(read(&ground, "f", &[]).is_err());
}

#[test]
fn what_no_joint_places_floats_in_a_file_of_drakes() {
    let two = |more: &str| {
        format!(
            "<robot name='r' xmlns:drake='urn:drake'><link name='a'/><link name='b'/><link name='c'/>\
             <joint name='j' type='continuous'><parent link='b'/><child link='c'/><axis xyz='0 1 0'/></joint>{more}</robot>"
        )
    };
    let error = read(&two(""), "f", &[]).unwrap_err();
    assert!(
        error.message.contains("nothing connects it to `a`"),
        "{error}"
    );
    assert!(error.help.unwrap().contains("type=\"floating\""));

    let ball = "<drake:ball_constraint><drake:ball_constraint_body_A name='a'/><drake:ball_constraint_body_B name='c'/>\
                <drake:ball_constraint_p_AP value='0 0 0'/><drake:ball_constraint_p_BQ value='0 0 0'/></drake:ball_constraint>";
    assert_eq!(
        told_first(&two(ball)),
        ["no joint places `b`: such a link floats, as in Drake"]
    );
    let mechanism = reading(&two(ball)).mechanism;
    assert_eq!(mechanism.link(mechanism.ground()).name, "a");

    // In a world, every link that nothing places floats.
    let weld =
        "<loop name='l' type='fixed'><predecessor link='world'/><successor link='c'/></loop>";
    let told = told_first(&two(weld));
    assert_eq!(told.len(), 2);
    // In the order of the file.
    assert_eq!(
        told[0],
        "no joint places `a` and `b`: such a link floats, as in Drake"
    );
    let mechanism = reading(&two(weld)).mechanism;
    assert_eq!(mechanism.link(mechanism.ground()).name, "world");
}

#[test]
fn a_loop_joint_without_a_type_turns_about_its_axis() {
    let more = |parts: &str| {
        format!(
            "<loop_joint name='l'><link1 link='d' xyz='0 1 0'/><link2 link='c'/>{parts}</loop_joint>"
        )
    };
    let text = bars("0 0 0", &more("<axis xyz='0 0 1'/>"));
    assert_eq!(last(&reading(&text)).kind, JointKind::Revolute);
    assert_eq!(
        told_first(&text),
        ["loop `l` has an <axis> and no type: it is read as revolute"]
    );
    let error = read(&bars("0 0 0", &more("")), "f", &[]).unwrap_err();
    assert!(
        error.message.contains("needs the attribute `type`"),
        "{error}"
    );
    assert!(error.help.unwrap().contains("<axis"));
}

#[test]
fn a_loop_joint_may_write_its_point_in_both_links() {
    let more = |first: &str, second: &str, axis: &str| {
        format!(
            "<loop_joint name='l' type='revolute'><parent link='d'/><child link='c'/>\
             <parent_origin xyz='{first}'/><child_origin xyz='{second}'/><axis {axis}/></loop_joint>"
        )
    };
    // c stands one above d and is turned by a quarter about x: what is written in the parent is turned into the child.
    let text = bars(
        "${pi/2} 0 0",
        &more("0 1 2", "0 2 0", "xyz='0 0 1' frame='parent'"),
    );
    let joint = reading(&text);
    let joint = last(&joint);
    assert_eq!(position(joint), [vec![0.0, 1.0, 2.0], vec![0.0, 2.0, 0.0]]);
    assert_eq!(values(&joint.axis.0), [0.0, 0.0, 1.0]);
    assert_eq!(
        values(&joint.successor.frame.roll_pitch_yaw)[0],
        -std::f64::consts::FRAC_PI_2
    );
    // Without `frame` these are frames of their own.
    let text = bars("0 0 0", &more("0 1 0", "0 0 3", "xyz='0 0 1'"));
    assert_eq!(
        position(last(&reading(&text))),
        [vec![0.0, 1.0, 0.0], vec![0.0, 0.0, 3.0]]
    );
    for (more, said) in [
        (
            more("0 1 2", "0 1 2", "xyz='0 0 1' frame='parent'"),
            "are apart",
        ),
        (
            more("0 1 0", "0 0 0", "xyz='0 0 1' frame='child'"),
            "in another frame",
        ),
        (
            "<loop_joint name='l' type='fixed'><parent link='d'/></loop_joint>".to_owned(),
            "needs two sides",
        ),
    ] {
        let told = fault(&more);
        assert!(told.contains(said), "{more}: {told}");
    }
}

#[test]
fn a_joint_whose_leader_is_not_there_is_free() {
    let text = bars("0 0 0", "").replacen("<axis", "<mimic joint='abb'/><axis", 1);
    let found = reading(&text);
    assert!(found.mechanism.couplings().is_empty());
    assert_eq!(
        told_first(&text),
        [
            "joint `ab` follows `abb`, which the file does not have: it is free, as in ROS (did you mean `ab`?)"
        ]
    );
}

#[test]
fn a_connection_of_mujoco_is_a_ball() {
    let connect = |what: &str| format!("<mujoco><equality><connect {what}/></equality></mujoco>");
    // c is at (2, 1), d at (2, 0), b at (0, 1).
    for (what, sides, at) in [
        (
            "name='x' body1='c' body2='d' anchor='0 0 1'",
            ["c", "d"],
            [0.0, 1.0, 1.0],
        ),
        ("body1='b' anchor='1 0 0'", ["b", "a"], [1.0, 1.0, 0.0]),
        (
            "body1='b' body2='world' anchor='1 0 0'",
            ["b", "a"],
            [1.0, 1.0, 0.0],
        ),
    ] {
        let found = reading(&bars("0 0 0", &connect(what)));
        let joint = last(&found);
        let links = [&joint.predecessor, &joint.successor]
            .map(|side| &found.mechanism.link(side.link).name);
        assert_eq!(
            (joint.kind, links[0].as_str(), links[1].as_str()),
            (JointKind::Spherical, sides[0], sides[1])
        );
        assert_eq!(position(joint)[1], at, "{what}");
        assert!(joint.closes_loop);
    }
    let off = reading(&bars(
        "0 0 0",
        &connect("body1='c' body2='d' anchor='0 0 1' active='false'"),
    ));
    assert_eq!(off.mechanism.joints().len(), 3);
    assert!(off.skipped.iter().any(|s| s.what.contains("not active")));
    assert!(fault(&connect("body1='c' body2='e' anchor='0 0 1'")).contains("no link named `e`"));
    assert!(fault(&connect("body1='c' body2='d' anchor='0 1'")).contains("expected 3 numbers"));
    assert!(fault(&connect("body1='c' body2='d'")).contains("joins two links"));
}

#[test]
fn followers_in_the_words_of_other_tools() {
    let ros = |numbers: &str| {
        format!(
            "<ros2_control><joint name='ad'><param name='mimic'>ab</param>{numbers}</joint></ros2_control>"
        )
    };
    let plugin = |numbers: &str| {
        format!(
            "<gazebo><plugin filename='libroboticsgroup_gazebo_mimic_joint_plugin.so'><joint>ab</joint><mimicJoint>ad</mimicJoint>{numbers}</plugin></gazebo>"
        )
    };
    let equality = |numbers: &str| {
        format!("<mujoco><equality><joint joint1='ad' joint2='ab' {numbers}/></equality></mujoco>")
    };
    let with = |mimic: &str, more: &str| {
        let text = bars("0 0 0", more);
        let at = text.rfind("<axis xyz='0 0 1'/></joint>").unwrap();
        format!("{}{mimic}{}", &text[..at], &text[at..])
    };
    for more in [
        ros("<param name='multiplier'>-2</param><param name='offset'>0.5</param>"),
        plugin("<multiplier>-2.0</multiplier><offset>0.5</offset>"),
        equality("polycoef='0.5 -2 0 0 0'"),
    ] {
        let plain = reading(&with(
            "<mimic joint='ab' multiplier='-2' offset='0.5'/>",
            "",
        ));
        let said = reading(&with("", &more));
        assert_eq!(
            difference(&plain.mechanism, &said.mechanism),
            None,
            "{more}"
        );
        assert!(said.warnings[0].message.contains("it is read as <mimic>"));
        // Said twice alike, and said otherwise.
        let twice = reading(&with(
            "<mimic joint='ab' multiplier='-2' offset='0.5'/>",
            &more,
        ));
        assert_eq!(
            difference(&plain.mechanism, &twice.mechanism),
            None,
            "{more}"
        );
        assert!(twice.warnings.is_empty(), "{:?}", twice.warnings);
        let other = with("<mimic joint='ab' multiplier='2'/>", &more);
        let error = read(&other, "f", &[]).unwrap_err();
        assert!(
            error.message.contains("says otherwise than <mimic>"),
            "{error}"
        );
    }
    // Through another follower, and the other way about.
    let chain = with(
        "<mimic joint='bc' multiplier='2'/>",
        &ros("<param name='multiplier'>6</param>"),
    )
    .replacen(
        "<axis xyz='0 0 1'/></joint>\n",
        "<axis xyz='0 0 1'/></joint>",
        1,
    )
    .replacen(
        "rpy='0 0 0'/>",
        "rpy='0 0 0'/><mimic joint='ab' multiplier='3'/>",
        1,
    );
    assert_eq!(reading(&chain).mechanism.couplings().len(), 2);
    let back = with(
        "<mimic joint='ab' multiplier='4'/>",
        "<ros2_control><joint name='ab'><param name='mimic'>ad</param><param name='multiplier'>0.25</param></joint></ros2_control>",
    );
    assert_eq!(reading(&back).mechanism.couplings().len(), 1);
    let off = reading(&with("", &equality("active='false'")));
    assert!(off.mechanism.couplings().is_empty());
}

#[test]
fn a_turn_in_unknown_words_is_refused() {
    let text =
        |origin: &str| bars("0 0 0", "").replace("xyz='0 1 0'", &format!("xyz='0 1 0' {origin}"));
    for word in [
        "quat='1 0 0 0'",
        "quat_wxyz='1 0 0 0'",
        "orientation='0 0 0 1'",
    ] {
        let error = read(&text(word), "f", &[]).unwrap_err();
        assert!(error.message.contains("turns the frame"), "{word}: {error}");
        assert!(error.help.unwrap().contains("quat_xyzw"));
    }
    reading(&text("quat_xyzw='0 0 0 1'"));
}

#[test]
fn a_missing_axis_is_told_in_one_line() {
    let bare = |count: usize| bars("0 0 0", "").replacen("<axis xyz='0 0 1'/>", "", count);
    assert!(told_first(&bare(0)).is_empty());
    assert_eq!(
        told_first(&bare(1)),
        ["`ab` has no <axis>: x is taken, as URDF says"]
    );
    assert_eq!(
        told_first(&bare(3)),
        ["`ab`, `bc` and `ad` have no <axis>: x is taken, as URDF says"]
    );
    let closing = |loops: &str| told_first(&bars("0 0 0", loops));
    for loops in [
        "<loop name='l' type='revolute'><predecessor link='d'/><successor link='c'/></loop>",
        "<loop_joint name='l' type='revolute'><link1 link='d'/><link2 link='c'/></loop_joint>",
        "<constraint name='l' type='revolute'><parent link='d'/><child link='c'/></constraint>",
    ] {
        assert_eq!(
            closing(loops),
            ["`l` has no <axis>: x is taken, as URDF says"]
        );
    }
    assert!(
        closing(
            "<loop name='l' type='spherical'><predecessor link='d'/><successor link='c'/></loop>"
        )
        .is_empty()
    );
}

#[test]
fn the_second_axis_of_a_universal_joint_is_another_one() {
    let joint = |axes: &str| {
        format!(
            "<loop name='l' type='universal'><predecessor link='d'/><successor link='c'/>{axes}</loop>"
        )
    };
    let told = told_first(&bars("0 0 0", &joint("<axis xyz='0 1 0'/>")));
    assert_eq!(told, ["`l` has no <axis2>: x is taken"]);
    assert!(fault(&joint("")).contains("without <axis2> its two axes are parallel"));
    assert!(
        fault(&joint("<axis xyz='0 1 1'/><axis2 xyz='0 -2 -2'/>"))
            .contains("its two axes are parallel")
    );
    reading(&bars(
        "0 0 0",
        &joint("<axis xyz='0 1 1'/><axis2 xyz='0 1 1.001'/>"),
    ));
}

#[test]
fn angles_that_look_like_others_are_told_where_loops_close() {
    let text = |rpy: &str, closed: &str| {
        bars(
            "0 0 0",
            &format!(
                "<loop name='l' type='fixed'><predecessor link='d'/><successor link='{closed}'><origin rpy='{rpy}'/></successor></loop>"
            ),
        )
    };
    assert_eq!(
        told_first(&text("-1.57 0 3.142", "c")),
        [
            "`1.57` in `rpy` looks like ${pi/2} and is read as 1.57 rad; write what is meant, or more digits",
            "`3.142` in `rpy` looks like ${pi} and is read as 3.142 rad; write what is meant, or more digits"
        ]
    );
    assert!(told_first(&text("1.5708 0.3 ${pi/2}", "c")).is_empty());
    // A tree can stand anyhow, and of numbers meant as written nothing is told.
    assert!(told_first(&bars("1.57 0 0", "")).is_empty());
    let literal = ReadOptions {
        literal: true,
        ..ReadOptions::default()
    };
    assert!(
        read_with(&text("1.57 0 0", "c"), "f", &literal)
            .unwrap()
            .warnings
            .is_empty()
    );
    let twice = read(&text("1.57 0 1.57", "c"), "f", &[]).unwrap();
    assert_eq!((twice.warnings.len(), twice.warnings[0].count), (1, 2));
}

#[test]
fn a_limit_without_bounds_is_told() {
    let with = |kind: &str, limit: &str| {
        let text = bars("0 0 0", "").replacen("continuous", kind, 1);
        let text = text.replacen("<axis", &format!("{limit}<axis"), 1);
        read(&text, "f", &[]).unwrap().warnings
    };
    for kind in ["revolute", "prismatic"] {
        let warnings = with(kind, "<limit effort='1' velocity='1'/>");
        let told = "`ab` has a <limit> without `lower` and `upper`, which is 0…0 in URDF";
        assert!(warnings[0].message.contains(told));
        assert!(is_told_first(&warnings[0].message));
    }
    for (kind, limit) in [
        ("continuous", "<limit effort='1' velocity='1'/>"),
        ("revolute", "<limit upper='1' effort='1'/>"),
        ("revolute", "<limit lower='1' upper='-1'/>"),
        ("revolute", ""),
    ] {
        let warnings = with(kind, limit);
        assert!(
            !warnings.iter().any(|w| w.message.contains("0…0")),
            "{kind} {limit}"
        );
    }
}

#[test]
fn two_joints_with_one_child_meet_at_its_origin() {
    let joint = |inside: &str| {
        format!(
            "<joint name='dc' type='continuous'><parent link='d'/><child link='c'>{inside}</child><origin xyz='0 1 0'/><axis xyz='0 0 1'/></joint>"
        )
    };
    let told = told_first(&bars("0 0 0", &joint("")));
    assert!(
        told.len() == 1
            && told[0].contains("both hold it at its origin, as <child> has no <origin> inside"),
        "{told:?}"
    );
    assert!(told_first(&bars("0 0 0", &joint("<origin xyz='1 0 0'/>"))).is_empty());
}

#[test]
fn names_that_announce_a_loop_are_told_where_there_is_none() {
    let named = |name: &str| bars("0 0 0", "").replacen("'ab'", &format!("'{name}'"), 1);
    for name in ["closing_knee", "loop_1", "closed_loop_pin", "Knee_Closure"] {
        let told = told_first(&named(name));
        assert_eq!(told.len(), 1, "{name}");
        assert!(
            told[0].contains(&format!("`{name}` has the name of what closes a loop")),
            "{told:?}"
        );
    }
    assert!(told_first(&named("enclosure_door")).is_empty());
    let closed = named("closing_knee").replace(
        "</robot>",
        "<loop name='l' type='fixed'><predecessor link='d'/><successor link='c'/></loop></robot>",
    );
    assert!(told_first(&closed).is_empty());
}

#[test]
fn a_joint_that_is_stated_again_is_the_same() {
    // c stands at (2, 1) and turns about z; its frame may be turned about x.
    let again = |rpy: &str, parts: &str| {
        bars(
            rpy,
            &format!(
                "<gazebo><joint name='bc' type='revolute'><parent>b</parent><child>c</child>{parts}</joint></gazebo>"
            ),
        )
    };
    for (rpy, parts) in [
        ("0 0 0", ""),
        ("0 0 0", "<axis><xyz>0 0 -2</xyz></axis>"),
        (
            "0 0 0",
            "<pose>0 0 3 0 0 1</pose><axis><xyz>0 0 1</xyz></axis>",
        ),
        ("0.3 0.2 0", "<axis><xyz>0 0 1</xyz></axis>"),
        (
            "1.570796 0 0",
            "<axis><xyz>0 -1 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>",
        ),
    ] {
        let found =
            read(&again(rpy, parts), "f", &[]).unwrap_or_else(|error| panic!("{error}: {parts}"));
        assert_eq!(found.mechanism.joints().len(), 3);
        assert!(
            found.warnings[0].message.contains("read once"),
            "{:?}",
            found.warnings
        );
    }
    for (parts, what) in [
        ("<axis><xyz>0 1 0</xyz></axis>", "with another axis"),
        (
            "<pose>1 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis>",
            "with another place",
        ),
        (
            "<pose>0 0 0 0.1 0 0</pose><axis><xyz>0 0 1</xyz></axis>",
            "with another axis",
        ),
        (
            "<axis><xyz>0 0 1</xyz><mimic joint='ab'/></axis>",
            "what it follows",
        ),
    ] {
        let error = read(&again("0 0 0", parts), "f", &[]).unwrap_err();
        assert!(error.message.contains(what), "{parts}: {error}");
        assert_eq!(error.line, 3, "{error}");
    }
}

#[test]
fn the_tree_without_gazebo_floats_where_its_base_does() {
    let more = "<gazebo><joint name='dc' type='revolute'><parent>d</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint></gazebo>";
    let text = bars("0 0 0", more).replacen(
        "<link name='a'/>",
        "<link name='w'/><joint name='f' type='floating'><parent link='w'/><child link='a'/></joint><link name='a'/>",
        1,
    );
    let warnings = reading(&text).warnings;
    assert!(
        warnings[0]
            .message
            .contains("a tree with 9 degrees of freedom"),
        "{warnings:?}"
    );
}
