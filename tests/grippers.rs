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
