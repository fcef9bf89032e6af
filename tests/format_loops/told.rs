//! What is refused or told, because a loop may hang on it.

use super::*;

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
fn what_names_two_joints_or_links_and_is_not_read_is_told_first() {
    let joins = |more: &str| {
        let reading = reading(&bars("0 0 0", more));
        let warnings = reading.warnings.iter();
        warnings
            .filter(|w| w.kind == kutzbach::format::WarningKind::MayJoin)
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
        assert!(warnings[0].kind.is_told_first());
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
fn a_bound_left_out_beside_the_other_is_0() {
    let with = |version: &str, limit: &str| {
        let text = bars("0 0 0", "").replacen("continuous", "revolute", 1);
        let text = text.replacen("<robot", &format!("<robot version='{version}'"), 1);
        let text = text.replacen("<axis", &format!("{limit}<axis"), 1);
        let reading = read(&text, "f", &[]).unwrap();
        let told = reading.warnings[0].message.clone();
        (reading.mechanism.joints()[0].bounds().unwrap(), told)
    };
    let (least, most) = (f64::NEG_INFINITY, f64::INFINITY);
    for (version, limit, bounds, told) in [
        ("1.0", "upper='0.3'", (0.0, 0.3), "without `lower`: it is 0"),
        ("1.1", "lower='-2'", (-2.0, 0.0), "without `upper`: it is 0"),
        // 0 beside these would leave no range.
        ("1.0", "upper='-0.3'", (least, -0.3), "with one bound only"),
        ("1.0", "lower='0'", (0.0, most), "with one bound only"),
        ("1.2", "upper='0.3'", (least, 0.3), "with one bound only"),
        // Written as endless it is not left out.
        ("1.0", "lower='-1e308' upper='0.3'", (least, 0.3), ""),
    ] {
        let limit = format!("<limit {limit} effort='1' velocity='1'/>");
        if told.is_empty() {
            let text = bars("0 0 0", "").replacen("continuous", "revolute", 1);
            let text = text.replacen("<axis", &format!("{limit}<axis"), 1);
            let reading = read(&text, "f", &[]).unwrap();
            assert_eq!(reading.mechanism.joints()[0].bounds(), Some(bounds));
            assert!(reading.warnings.is_empty(), "{:?}", reading.warnings);
            continue;
        }
        let (read, message) = with(version, &limit);
        assert_eq!(read, bounds, "{limit}");
        assert!(message.contains(told), "{message}");
    }
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
