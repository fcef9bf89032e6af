//! Whole files: every mechanism of the repository and every reference file reads, writes and reads back the same; what
//! other readers of URDF understand of our output is what they understand of the original.

use crate::format_support;

use crate::support::{folder, shared};
use format_support::{difference, files_below, own_files};
use kutzbach::format::{ReadOptions, read, read_file, read_file_with, write};
use std::path::PathBuf;

fn assert_round_trip(path: &PathBuf) {
    let reading = read_file(path, &[]).unwrap_or_else(|error| panic!("{error}\n{:?}", error.help));
    let text = write(&reading.mechanism);
    let again = read(&text, "written", &[])
        .unwrap_or_else(|error| panic!("{}: {error}\n{text}", path.display()));
    if let Some(difference) = difference(&reading.mechanism, &again.mechanism) {
        panic!("{}: {difference}", path.display());
    }
    assert_eq!(text, write(&again.mechanism), "writing is a fixed point");
    // What is said of names holds of the same names.
    let said = |message: &str| reading.warnings.iter().any(|w| w.message == message);
    let new = again.warnings.iter().find(|w| !said(&w.message));
    assert!(
        new.is_none() && again.skipped.is_empty(),
        "{}: {new:?}",
        path.display()
    );
}

#[test]
fn own_mechanisms_round_trip() {
    own_files().iter().for_each(assert_round_trip);
}

#[test]
fn zoo_round_trips() {
    let files = files_below(&folder("tests/zoo"));
    assert!(files.len() >= 100, "found {} files", files.len());
    files.iter().for_each(assert_round_trip);
}

#[test]
#[ignore = "needs the robots of others in ../shared/models, or KUTZBACH_SHARED"]
fn robots_of_others_round_trip() {
    let models = shared("models");
    let files = files_below(&models);
    assert!(files.len() >= 8, "found {} files", files.len());
    files.iter().for_each(assert_round_trip);
}

#[test]
#[ignore = "needs the robots of others in ../shared/models, or KUTZBACH_SHARED"]
fn robots_of_others_are_read_in_full() {
    let models = shared("models");
    for (file, links, joints, couplings, format) in [
        ("grbda_four_bar/four_bar.urdf", 4, 4, 0, "urdf+"),
        (
            "grbda_planar_leg_linkage/planar_leg_linkage.urdf",
            5,
            5,
            0,
            "urdf+",
        ),
        ("grbda_six_bar/six_bar.urdf", 6, 6, 0, "urdf+"),
        (
            "grbda_mit_humanoid_leg/mit_humanoid_leg.urdf",
            11,
            10,
            5,
            "urdf+",
        ),
        ("gepetto_5bar_linkage/robot.urdf", 8, 7, 0, "urdf"),
        ("gepetto_5bar_linkage_iso3d/robot.urdf", 9, 8, 0, "urdf"),
        ("gepetto_robot_delta/robot.urdf", 16, 15, 0, "urdf"),
        ("gepetto_digit_like/robot.urdf", 36, 35, 0, "urdf"),
    ] {
        let reading = read_file(models.join(file), &[]).unwrap();
        let mechanism = &reading.mechanism;
        let found = (
            mechanism.links().len(),
            mechanism.joints().len(),
            mechanism.couplings().len(),
            reading.format,
        );
        assert_eq!(found, (links, joints, couplings, format), "{file}");
    }
}

/// What URDF readers other than ours see: an independent check of names, frames, axes, limits and masses.
fn seen_by_others(text: &str) -> String {
    let robot = urdf_rs::read_from_string(text).unwrap();
    let mut lines = Vec::new();
    for link in &robot.links {
        let inertial = &link.inertial;
        lines.push(format!(
            "{} {:?} {:?} {:?} {:?}",
            link.name,
            inertial.mass,
            inertial.inertia,
            inertial.origin,
            link.collision
                .iter()
                .map(|c| (&c.origin, &c.geometry))
                .collect::<Vec<_>>()
        ));
    }
    for joint in &robot.joints {
        // A fixed joint has no axis; a revolute joint without a range is continuous to other readers.
        let axis = (joint.joint_type != urdf_rs::JointType::Fixed).then_some(&joint.axis);
        let limit = (
            &joint.limit.lower,
            &joint.limit.upper,
            &joint.limit.effort,
            &joint.limit.velocity,
        );
        lines.push(format!(
            "{} {} {} {:?} {axis:?} {limit:?} {:?} {:?}",
            joint.name,
            joint.parent.link,
            joint.child.link,
            joint.origin,
            joint.dynamics,
            joint.mimic
        ));
    }
    lines.join("\n")
}

#[test]
fn plain_urdf_stays_plain_urdf() {
    let text = r#"<robot name="arm">
  <link name="base">
    <inertial>
      <origin xyz="0 0 0.1" rpy="0 0.5 0"/>
      <mass value="2.5"/>
      <inertia ixx="0.01" ixy="0" ixz="1e-5" iyy="0.02" iyz="0" izz="0.03"/>
    </inertial>
    <collision name="foot"><origin xyz="0 0 0.05"/><geometry><box size="0.2 0.2 0.1"/></geometry></collision>
    <collision><geometry><cylinder radius="0.05" length="0.3"/></geometry></collision>
  </link>
  <link name="upper"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="lower"><collision><geometry><mesh filename="package://arm/l.stl" scale="0.001 0.001 0.001"/></geometry></collision></link>
  <link name="hand"/>
  <link name="tool"/>
  <link name="finger"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 0.3" rpy="0 0 1.5"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" effort="20" velocity="3"/><dynamics damping="0.1" friction="0.2"/>
  </joint>
  <joint name="elbow" type="prismatic">
    <parent link="upper"/><child link="lower"/><origin xyz="0.25 -.5 0."/><axis xyz="0 0 -1"/>
    <limit lower="0" upper="0.4" effort="5" velocity="1"/>
  </joint>
  <joint name="wrist" type="continuous">
    <parent link="lower"/><child link="hand"/><axis xyz="0 0 1"/><mimic joint="elbow" multiplier="-2" offset="0.125"/>
  </joint>
  <joint name="flange" type="fixed"><parent link="hand"/><child link="tool"/><origin rpy="0.1 0.2 0.3"/></joint>
  <joint name="slide" type="planar"><parent link="tool"/><child link="finger"/><axis xyz="0 0 1"/></joint>
</robot>"#;
    let reading = read(text, "arm", &[]).unwrap();
    assert_eq!(reading.format, "urdf");
    assert!(reading.warnings.is_empty() && reading.skipped.is_empty());
    let written = write(&reading.mechanism);
    assert_eq!(read(&written, "arm", &[]).unwrap().format, "urdf");
    assert_eq!(seen_by_others(text), seen_by_others(&written));
    // What the other reader sees is what ours sees.
    let robot = urdf_rs::read_from_string(text).unwrap();
    for (joint, other) in reading.mechanism.joints().iter().zip(&robot.joints) {
        assert_eq!(joint.name, other.name);
        let position = joint
            .predecessor
            .frame
            .position
            .each_ref()
            .map(|n| n.value());
        let angles = joint
            .predecessor
            .frame
            .roll_pitch_yaw
            .each_ref()
            .map(|n| n.value());
        assert_eq!((position, angles), (other.origin.xyz.0, other.origin.rpy.0));
    }
}

#[test]
#[ignore = "needs the robots of others in ../shared/models, or KUTZBACH_SHARED"]
fn robots_of_others_look_the_same_to_others() {
    let models = shared("models");
    for path in files_below(&models) {
        let original = std::fs::read_to_string(&path).unwrap();
        // As written: what is read as 0 and π/2 is written back, but a frame that vanishes is left out.
        let options = ReadOptions {
            literal: true,
            ..ReadOptions::default()
        };
        let written = write(&read_file_with(&path, &options).unwrap().mechanism);
        let without_old_names = original.replace("joint_properties", "dynamics");
        assert_eq!(
            seen_by_others(&without_old_names),
            seen_by_others(&written),
            "{}",
            path.display()
        );
    }
}
