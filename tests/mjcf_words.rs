//! MJCF: attributes that are not read are told by name, and slips are errors.

use kutzbach::format::{FormatError, Reading, read};

fn model(inside: &str) -> Result<Reading, FormatError> {
    read(&format!("<mujoco>{inside}</mujoco>"), "model.xml", &[])
}

#[test]
fn attributes_that_are_not_read_are_told_once_by_name() {
    let reading = model(
        r#"<compiler meshdir="parts"/><option timestep="0.01"/>
        <default><joint armature="0.1"/><default class="q"><geom rgba="1 0 0 1"/><equality solref="0.1 1"/></default></default>
        <worldbody><body name="a" gravcomp="1"><joint name="j" armature="1" margin="0.01" stiffness="2" springdamper="1 1"/>
        <frame pos="0 0 1"><geom size="0.1" friction="1" solref="0.02 1"/><site name="s" size="0.1"/></frame>
        <body name="b"><joint name="k" user="1"/></body></body></worldbody>
        <tendon><fixed name="t" damping="1"><joint joint="j" coef="1"/></fixed></tendon>
        <equality><joint joint1="j" joint2="k" solimp="0.9 0.95 0.001"/></equality>
        <keyframe><key name="x" time="1" qpos="0 0" ctrl=""/></keyframe>"#,
    )
    .unwrap();
    let mut told: Vec<&str> = reading.skipped.iter().map(|skip| &skip.what[..]).collect();
    told.sort_unstable();
    let expected = [
        "<option>",
        "`armature`, `margin`, `user` of <joint>",
        "`ctrl` of <key>",
        "`damping` of tendons",
        "`friction`, `rgba`, `solref` of <geom>",
        "`gravcomp` of <body>",
        "`meshdir` of <compiler>",
        "`size` of <site>",
        "`solimp`, `solref` of equalities",
        "`springdamper` of a joint",
        "`stiffness` of a joint",
        "`time` of <key>",
    ];
    assert_eq!(told, expected);
    let of_joints = reading.skipped.iter();
    let of_joints = of_joints.filter(|skip| skip.what.contains("armature"));
    assert!(
        of_joints
            .map(|skip| (skip.line, skip.standard))
            .eq([(2, true)])
    );
    // What is read is not told.
    let plain = model(
        r#"<worldbody><body name="a" pos="0 0 1" euler="0 0 90"><joint name="j" type="slide" axis="1 0 0" range="0 1" damping="1"/>
        <geom type="box" size="1 1 1" group="1" mass="1"/><site name="s" pos="0 0 1"/></body></worldbody>
        <equality><connect body1="a" body2="world" anchor="0 0 0"/></equality>"#,
    );
    let plain = plain.unwrap();
    assert!(plain.skipped.is_empty(), "{:?}", plain.skipped);
}

/// MuJoCo 4.0.0 refuses all of these.
#[test]
fn a_slip_of_what_is_read_is_an_error_and_another_word_is_told() {
    for (inside, told) in [
        (
            "<worldbody><body>\n<joint axsi='1 0 0'/></body></worldbody>",
            "<joint> has no attribute `axsi`",
        ),
        (
            "<worldbody><body/>\n<body poss='1 0 0'/></worldbody>",
            "<body> has no attribute `poss`",
        ),
        (
            "<default>\n<joint rnage='0 1'/></default>",
            "<joint> has no attribute `rnage`",
        ),
        (
            "<worldbody><body name='b'><joint/></body></worldbody><equality>\n<connect body1='b' anchr='0 0 0'/></equality>",
            "<connect> has no attribute `anchr`",
        ),
    ] {
        let error = model(inside).unwrap_err();
        assert_eq!(error.message, told);
        assert_eq!(error.line, 2, "{error}");
    }
    let reading = model("<worldbody><body colour='red'><joint/></body></worldbody>").unwrap();
    assert_eq!(reading.skipped[0].what, "attribute `colour` of <body>");
    assert!(!reading.skipped[0].standard);
}
