//! A gripper with a camera: what is fixed to it by an angle of any size tells of no loop, and all commands say the same.

use serde_json::Value;
use std::path::PathBuf;

/// A finger on a parallelogram on one side (±1) of the palm; its last hinge closes a loop as simulators write it.
fn finger(name: &str, side: i32, follows: &str) -> String {
    let hinge = |joint: &str, parent: &str, child: &str, at: &str, more: &str| {
        format!(
            r#"<link name="{name}_{child}"/><joint name="{name}_{joint}" type="continuous"><parent link="{parent}"/><child link="{name}_{child}"/>
            <origin xyz="{at}"/><axis xyz="0 0 {side}"/>{more}</joint>"#
        )
    };
    let (near, far) = (format!("7 {side} 0"), format!("5 {} 0", 3 * side));
    [
        hinge("drive", "palm", "finger", &near, follows),
        hinge("knuckle", &format!("{name}_finger"), "tip", "9 1 0", ""),
        hinge("guide", "palm", "bar", &far, ""),
        format!(
            r#"<gazebo><joint name="{name}_close" type="revolute"><parent>{name}_bar</parent><child>{name}_tip</child>
            <pose>-2 {} 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis></joint></gazebo>"#,
            2 * side
        ),
    ]
    .concat()
}

fn gripper() -> PathBuf {
    let text = format!(
        r#"<robot name="gripper"><link name="palm"/><link name="camera"/>
        <joint name="camera_frame" type="fixed"><parent link="palm"/><child link="camera"/><origin xyz="1 0 2" rpy="0 -0.52 0.3"/></joint>
        {}{}</robot>"#,
        finger("left", 1, ""),
        finger("right", -1, r#"<mimic joint="left_drive"/>"#)
    );
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("gripper_with_camera.urdf");
    std::fs::write(&path, text).unwrap();
    path
}

fn answer(command: &str) -> Value {
    // The whole takes longer than its blocks, each of which is small.
    let more: &[&str] = if command == "exact" {
        &["--time", "2"]
    } else {
        &[]
    };
    let output = crate::support::program()
        .args([command, "--format", "json"])
        .args(more)
        .arg(gripper())
        .output()
        .unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command}: {complaint}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn every_joint_and_link_of_a_gripper_moves_whatever_command_is_asked() {
    let report = answer("report");
    assert_eq!(report["mobility"]["finite"], 1);
    for joint in report["joints"].as_array().unwrap() {
        assert!(joint["freedom"] == 0 || joint["locked"] == false, "{joint}");
    }
    let motions = report["motions"].as_array().unwrap();
    for motion in motions.iter().filter(|motion| motion["link"] != "camera") {
        assert_eq!(motion["freedom"], 1, "{motion}");
    }
    assert_eq!(answer("exact")["dimension"], 1);
    let verified = answer("simulate");
    let branch = &verified["verification"]["branches"][0];
    assert_eq!(branch["dimension"], 1);
    assert_eq!(branch["finding"]["outcome"], "confirmed");
    assert!(answer("trace").is_object());
}

/// The hinges of a gripper that follow the left crank, and how: both fingers are parallelograms.
const FOLLOWERS: [(&str, i32); 5] = [
    ("left_rod", 1),
    ("left_pad", -1),
    ("right_crank", -1),
    ("right_rod", -1),
    ("right_pad", 1),
];

/// A gripper of whole millimetres with loops and mimics, of which one may have the wrong sign.
fn geared(random: &mut kutzbach::matrix::SplitMix64, wrong: Option<&str>) -> String {
    let mut below = |most: u64| (random.next_u64() % most) as f64 / 1000.0;
    let (foot, rise) = (
        [0.02 + below(20), 0.05 + below(20)],
        [0.005 + below(15), 0.01 + below(15)],
    );
    let crank = [0.02 + below(30), 0.03 + below(30)];
    let mut text = String::from("<robot name=\"gripper\"><link name=\"palm\"/>");
    for (side, way) in [("left", 1.0), ("right", -1.0)] {
        let mut hinge = |part: &str, parent: &str, [x, z]: [f64; 2]| {
            let name = format!("{side}_{part}");
            let follows = FOLLOWERS.iter().find(|(own, _)| *own == name);
            let mimic = follows.map_or(String::new(), |(_, factor)| {
                let factor = if wrong == Some(&name[..]) {
                    -factor
                } else {
                    *factor
                };
                format!("<mimic joint=\"left_crank\" multiplier=\"{factor}\"/>")
            });
            text += &format!(
                "<link name=\"l_{name}\"/><joint name=\"{name}\" type=\"continuous\"><parent link=\"{parent}\"/>\
                 <child link=\"l_{name}\"/><origin xyz=\"{:.3} 0 {z:.3}\"/><axis xyz=\"0 1 0\"/>{mimic}</joint>",
                way * x
            );
        };
        hinge("crank", "palm", foot);
        hinge("rod", "palm", [foot[0] - rise[0], foot[1] + rise[1]]);
        hinge("pad", &format!("l_{side}_crank"), crank);
        text += &format!(
            "<loop name=\"{side}_pin\" type=\"continuous\"><predecessor link=\"l_{side}_rod\"><origin xyz=\"{:.3} 0 {:.3}\"/></predecessor>\
             <successor link=\"l_{side}_pad\"><origin xyz=\"{:.3} 0 {:.3}\"/></successor><axis xyz=\"0 1 0\"/></loop>",
            way * crank[0],
            crank[1],
            -way * rise[0],
            rise[1]
        );
    }
    text + "</robot>"
}

/// Of 24 grippers half have one wrong sign: it is named, and nothing is said of the others.
#[test]
fn a_wrong_sign_of_a_gripper_is_named() {
    let mut random = kutzbach::matrix::SplitMix64::new(71);
    for case in 0..24 {
        let wrong = (case % 2 == 1).then_some(FOLLOWERS[case / 2 % FOLLOWERS.len()].0);
        let text = geared(&mut random, wrong);
        let reading = kutzbach::format::read(&text, "gripper", &[]).unwrap();
        let report = kutzbach::report::report(&reading, "gripper", &Default::default()).unwrap();
        let told = report
            .warnings
            .iter()
            .find(|text| text.text.contains("lock it together"));
        match wrong {
            None => assert_eq!((told, report.mobility.finite), (None, Some(1)), "{text}"),
            Some(name) => {
                assert_eq!(report.mobility.finite, Some(0), "{text}");
                let told = told.map_or("", |text| text.text.as_str());
                let wanted = format!("; with the other sign of `{name}.mimic` it has 1");
                assert!(told.ends_with(&wanted), "{told}\n{text}");
            }
        }
    }
}
