//! Constraints and followers of Drake, Isaac Sim, MuJoCo and others.

use super::*;

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
fn a_joint_follows_in_one_way() {
    let two = "<link name='e'/><joint name='ce' type='continuous'><parent link='c'/><child link='e'/>\
               <mimic joint='ab' multiplier='2'/><drake:mimic joint='ab' multiplier='3'/></joint>";
    assert!(fault(two).contains("in two ways"));
    let slip = two
        .replace("<mimic joint='ab' multiplier='2'/>", "")
        .replace("drake:mimic", "drake:mimc");
    assert!(fault(&slip).contains("<drake:mimc>"));
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
