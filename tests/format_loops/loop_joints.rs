//! Joints of the loop itself, however they are written.

use super::*;

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
