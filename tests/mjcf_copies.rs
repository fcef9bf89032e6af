//! MJCF: keys as configurations, and copies of what is in `<replicate>`.

use kutzbach::format::{FormatError, Reading, read};

fn try_model(inside: &str) -> Result<Reading, FormatError> {
    read(&format!("<mujoco>{inside}</mujoco>"), "model.xml", &[])
}

fn model(inside: &str) -> Reading {
    try_model(inside).unwrap_or_else(|error| panic!("{error}\n{inside}"))
}

/// The configurations: names, joints, and values.
fn poses(reading: &Reading) -> Vec<(String, Vec<(String, f64)>)> {
    let mechanism = &reading.mechanism;
    let pose = |configuration: &kutzbach::mechanism::Configuration| {
        let positions = configuration.positions.iter().map(|(joint, values)| {
            let name = mechanism.joint(*joint).name.clone();
            (name, values[0].value())
        });
        (configuration.name.clone(), positions.collect())
    };
    mechanism.configurations().iter().map(pose).collect()
}

fn skipped(reading: &Reading) -> Vec<&str> {
    reading.skipped.iter().map(|skip| &skip.what[..]).collect()
}

const ARM: &str = r#"<worldbody><body name="base"><freejoint name="f"/>
    <body name="arm"><joint name="a" ref="90"/><body name="hand"><joint name="s" type="slide" ref="0.5"/></body></body>
    <body name="head"><joint name="b" type="ball"/></body></body></worldbody>"#;

#[test]
fn keys_are_configurations_from_the_pose_drawn() {
    let reading = model(&format!(
        r#"{ARM}<keyframe><key name="home" qpos="0 0 1 1 0 0 0 1.5 0.75 1 0 0 0"/><key qpos="0 0 1 1 0 0 0 0 0.5 1 0 0 0" qvel="0"/>
        <key name="short" qpos="1 2"/><key name="still"/></keyframe>"#
    ));
    let found = poses(&reading);
    let names: Vec<&str> = found.iter().map(|(name, _)| &name[..]).collect();
    assert_eq!(names, ["home", "key"]);
    let half_turn = std::f64::consts::FRAC_PI_2;
    for ((_, positions), expected) in found.iter().zip([[1.5 - half_turn, 0.25], [-half_turn, 0.0]])
    {
        let joints: Vec<&str> = positions.iter().map(|(joint, _)| &joint[..]).collect();
        assert_eq!(joints, ["a", "s"]);
        for ((_, value), expected) in positions.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-12, "{positions:?}");
        }
    }
    assert_eq!(
        skipped(&reading),
        [
            "values of balls and floating bodies in <key>",
            "`qvel` of <key>",
            "<key> with 2 numbers in `qpos`, where the joints have 13",
            "<key> without `qpos`",
        ]
    );
}

#[test]
fn with_equalities_a_key_says_where_the_motors_are() {
    let tied = |rest: &str| {
        model(&format!(
            r#"<worldbody><body name="x"><joint name="a"/><body name="y" pos="1 0 0"><joint name="b"/></body></body></worldbody>
            <equality><joint joint1="b" joint2="a" polycoef="0 0.5 0 0 0"/></equality>
            <keyframe><key name="k" qpos="0.4 0.2"/></keyframe>{rest}"#
        ))
    };
    let driven = tied(r#"<actuator><motor joint="a"/></actuator>"#);
    let expected = ("k".to_owned(), vec![("a".to_owned(), 0.4)]);
    assert_eq!(poses(&driven), [expected]);
    let free = tied("");
    assert!(poses(&free).is_empty());
    assert_eq!(
        skipped(&free),
        ["<key> of a mechanism with equalities and without motors"]
    );
}

#[test]
fn two_keys_of_one_name_are_an_error() {
    let error = try_model(
        r#"<worldbody><body><joint/></body></worldbody><keyframe><key name="k" qpos="0"/><key name="k" qpos="1"/></keyframe>"#,
    )
    .unwrap_err();
    assert!(error.message.contains("two configurations"), "{error}");
}
