//! Joints inside `<gazebo>`, as SDFormat writes them.

use super::*;

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
    // libsdformat's default.
    assert_eq!(lead(""), 1.0);
}

#[test]
fn a_continuous_joint_inside_gazebo_has_no_limits() {
    let more = "<gazebo><joint name='dc' type='continuous'><parent>d</parent><child>c</child>\
                <axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis></joint></gazebo>";
    let reading = reading(&bars("0 0 0", more));
    assert_eq!(last(&reading).bounds(), None);
    let mut told = reading.warnings.iter();
    assert!(told.any(|warning| warning.kind == kutzbach::format::WarningKind::NoLimit));
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
fn links_of_gazebo_that_stand_in_one_another_are_told() {
    let link = |name: &str, reference: &str| {
        format!("<link name='{name}'><pose relative_to='{reference}'>0 0 1 0 0 0</pose></link>")
    };
    for (links, told) in [
        (
            link("e", "e"),
            "poses run in a circle: `e` is given in itself",
        ),
        (
            link("e", "f") + &link("f", "e"),
            "poses run in a circle: `e` and `f` are each given in the next one",
        ),
    ] {
        let error = read(
            &bars("0 0 0", &format!("<gazebo>{links}</gazebo>")),
            "t.urdf",
            &[],
        );
        let error = error.unwrap_err();
        assert_eq!((error.message.as_str(), error.line), (told, 3), "{error}");
    }
}

#[test]
fn a_joint_inside_gazebo_with_the_world_below_it_is_told() {
    let joint = |parent: &str, child: &str| {
        format!(
            "<gazebo><joint name='k' type='revolute'><parent>{parent}</parent><child>{child}</child><axis><xyz>0 0 1</xyz></axis></joint></gazebo>"
        )
    };
    for (parent, child, told) in [("d", "world", 1), ("world", "d", 0)] {
        let warnings = reading(&bars("0 0 0", &joint(parent, child))).warnings;
        let of_child = warnings
            .iter()
            .filter(|one| one.message.contains("the world is its child"));
        assert_eq!(of_child.count(), told, "{warnings:?}");
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
