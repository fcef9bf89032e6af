//! `kutzbach convert`: what is written reads back as the same mechanism, and what cannot be said is told.

use kutzbach::format::{Reading, read, read_file};
use kutzbach::mechanism::JointKind;
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::report::convert::{Hinges, relaxed, to_mjcf, to_urdf};
use kutzbach::report::{Options, report};
use std::io::Write;
use std::process::{Command, Output, Stdio};

fn convert(arguments: &[&str]) -> Output {
    program(arguments).stdin(Stdio::null()).output().unwrap()
}

fn program(arguments: &[&str]) -> Command {
    let mut program = crate::support::program();
    program
        .arg("convert")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"));
    program
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn finite(reading: &Reading) -> Option<usize> {
    analyse(&reading.mechanism, &AnalysisOptions::default())
        .unwrap()
        .mobility
        .finite()
}

/// The mechanism as MJCF and read again.
fn through_mjcf(reading: &Reading, hinges: Hinges) -> Reading {
    let written = to_mjcf(&reading.mechanism, hinges).text;
    let again = read(&written, "model.xml", &[]);
    again.unwrap_or_else(|error| panic!("{error}\n{written}"))
}

#[test]
fn mechanisms_keep_their_mobility_in_mjcf() {
    for (name, expected) in [
        ("planar_four_bar", 1),
        ("slider_crank", 1),
        ("screw_jack", 1),
        ("differential_screw", 1),
        ("cardan_shaft", 1),
        ("stewart", 6),
        ("oldham", 1),
        ("oldham_cylindrical_shafts", 2),
        ("kelvin_clamp", 0),
        ("block_and_corner", 0),
        ("crossed_schoenflies", 3),
        ("rssr", 2),
        ("three_upu", 3),
        ("four_bar_lifting_box", 7),
        ("gripper", 1),
        ("double_pendulum", 2),
        ("tripteron", 3),
    ] {
        let reading = read_file(format!("mechanisms/{name}.urdf"), &[]).unwrap();
        assert_eq!(finite(&reading), Some(expected), "{name}");
        for hinges in [Hinges::TwoPoints, Hinges::Body] {
            let again = through_mjcf(&reading, hinges);
            assert_eq!(finite(&again), Some(expected), "{name} {hinges:?}");
        }
    }
}

/// Two links, joined by one kind of joint in the tree, and by hinges and a slide that make a loop of it.
fn one_joint(kind: JointKind) -> String {
    let tree = match kind {
        JointKind::Distance => "<distance value=\"1\"/>",
        _ if kind.uses_lead() => "<axis xyz=\"0 0.6 0.8\"/><screw lead=\"0.01\"/>",
        _ if kind.uses_second_axis() && !kind.uses_axis() => "<axis2 xyz=\"0 0.6 0.8\"/>",
        _ if kind.uses_second_axis() => "<axis xyz=\"1 0 0\"/><axis2 xyz=\"0 0.6 0.8\"/>",
        _ if kind.uses_axis() => "<axis xyz=\"0 0.6 0.8\"/>",
        _ => "",
    };
    format!(
        r#"<robot name="one"><link name="base"/><link name="hand"/><link name="arm"/>
        <joint name="J" type="{}"><parent link="base"/><child link="hand"/><origin xyz="0.5 0.25 0.75" rpy="0 0 0.3"/>{tree}</joint>
        <joint name="K" type="revolute"><parent link="hand"/><child link="arm"/><origin xyz="0.25 0 0"/><axis xyz="0 1 0"/></joint>
        </robot>"#,
        kind.word()
    )
}

#[test]
fn every_kind_of_joint_is_written() {
    for kind in JointKind::ALL {
        let text = one_joint(kind);
        let reading = read(&text, "one.urdf", &[]).unwrap_or_else(|error| panic!("{error}"));
        let expected = Some(kind.freedom() + 1);
        assert_eq!(finite(&reading), expected, "{kind}");
        assert_eq!(
            finite(&through_mjcf(&reading, Hinges::TwoPoints)),
            expected,
            "{kind}"
        );
        // The tree seen from its end: every joint is written backwards.
        let held = text.replace("</robot>", "<ground link=\"arm\"/></robot>");
        let held = read(&held, "one.urdf", &[]).unwrap();
        assert_eq!(finite(&held), expected, "{kind}");
        let again = through_mjcf(&held, Hinges::TwoPoints);
        assert_eq!(finite(&again), expected, "{kind} backwards");
        let urdf = to_urdf(&reading.mechanism).unwrap();
        assert_eq!(urdf.not_said, Vec::<String>::new());
        let again = read(&urdf.text, "tree.urdf", &[]).unwrap();
        assert_eq!(again.format, "urdf", "{}", urdf.text);
        assert_eq!(finite(&again), expected, "{kind}");
    }
}

const FOUR_BAR: &str = r#"<robot name="four_bar">
  <link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
  <joint name="a" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/>
    <limit lower="-1.5" upper="2"/></joint>
  <joint name="b" type="continuous"><parent link="ground"/><child link="rocker"/><origin xyz="4 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="c" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0 2 0"/><axis xyz="0 0 1"/></joint>
  <loop name="d" type="continuous">
    <predecessor link="coupler"><origin xyz="4 3 0"/></predecessor>
    <successor link="rocker"><origin xyz="0 5 0"/></successor>
    <axis xyz="0 0 1"/>
  </loop>
</robot>"#;

#[test]
fn a_four_bar_in_mjcf() {
    let mass = "<inertial pos=\"0 0 0\" mass=\"0.1\" diaginertia=\"0.001 0.001 0.001\"/>";
    let reading = read(FOUR_BAR, "four_bar.urdf", &[]).unwrap();
    let converted = to_mjcf(&reading.mechanism, Hinges::TwoPoints);
    let expected = format!(
        r#"<mujoco model="four_bar">
  <compiler angle="radian" eulerseq="XYZ" autolimits="false" inertiafromgeom="false"/>
  <worldbody>
    <body name="crank">
      <joint name="a" type="hinge" pos="0 0 0" axis="0 0 1" limited="true" range="-1.5 2"/>
      {mass}
      <body name="coupler" pos="0 2 0">
        <joint name="c" type="hinge" pos="0 0 0" axis="0 0 1" limited="false"/>
        {mass}
      </body>
    </body>
    <body name="rocker" pos="4 0 0">
      <joint name="b" type="hinge" pos="0 0 0" axis="0 0 1" limited="false"/>
      {mass}
    </body>
  </worldbody>
  <equality>
    <connect name="d" body1="coupler" body2="rocker" anchor="4 3 0"/>
    <connect name="d.2" body1="coupler" body2="rocker" anchor="4 3 1"/>
  </equality>
</mujoco>
"#
    );
    assert_eq!(converted.text, expected);
    assert_eq!(converted.not_said.len(), 2, "{:?}", converted.not_said);
    let again = read(&converted.text, "model.xml", &[]).unwrap();
    let joint = again.mechanism.joint_named("d").unwrap();
    assert_eq!(again.mechanism.joint(joint).kind, JointKind::Revolute);
}

#[test]
fn relaxed_loops_have_independent_equations() {
    for name in ["planar_four_bar", "slider_crank", "sarrus"] {
        let file = format!("mechanisms/{name}.urdf");
        let reading = read_file(&file, &[]).unwrap();
        let found = relaxed(&reading, &file).unwrap();
        assert!(found.independent, "{name}: {:?}", found.notes);
        let changed = Reading {
            mechanism: found.mechanism,
            ..reading.clone()
        };
        let again = through_mjcf(&changed, Hinges::Body);
        let told = report(&again, "model.xml", &Options::default()).unwrap();
        assert_eq!(told.home.redundant, Some(0), "{name}");
        assert_eq!(told.mobility.finite, finite(&reading), "{name}");
    }
    let open = read_file("mechanisms/double_pendulum.urdf", &[]).unwrap();
    let found = relaxed(&open, "double_pendulum.urdf").unwrap();
    assert!(found.independent);
    assert_eq!(
        found.notes,
        ["no constraint is redundant: nothing is relaxed"]
    );
}

#[test]
fn a_loop_that_is_open_as_drawn_is_told_and_stays_what_it_is() {
    let wide = FOUR_BAR.replace("0 5 0", "0 5.5 0");
    let reading = read(&wide, "four_bar.urdf", &[]).unwrap();
    let converted = to_mjcf(&reading.mechanism, Hinges::TwoPoints);
    let told = converted.not_said.iter();
    let open = told.filter(|what| what.contains("is open as drawn"));
    assert_eq!(open.count(), 1, "{:?}", converted.not_said);
    assert_eq!(converted.text.matches("site1=").count(), 2);
    assert!(read(&converted.text, "model.xml", &[]).is_ok());
}

#[test]
fn masses_shapes_and_motors_are_kept() {
    let text = r#"<robot name="arm"><link name="base"/>
      <link name="arm"><inertial><origin xyz="0 0 0.5"/><mass value="2.50"/><inertia ixx="0.2" iyy="0.2" izz="0.1"/></inertial>
        <collision><geometry><box size="0.1 0.1 1"/></geometry></collision>
        <visual><geometry><mesh filename="arm.stl"/></geometry></visual></link>
      <joint name="lift" type="prismatic"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
        <limit lower="0" upper="0.8" effort="40" velocity="1"/><dynamics damping="3" friction="0.5"/></joint>
      <transmission name="t"><joint name="lift"/></transmission></robot>"#;
    let reading = read(text, "arm.urdf", &[]).unwrap();
    let converted = to_mjcf(&reading.mechanism, Hinges::TwoPoints);
    for part in [
        r#"mass="2.50" diaginertia="0.2 0.2 0.1""#,
        r#"type="box" size="0.05 0.05 0.5""#,
        r#"limited="true" range="0 0.8" damping="3" frictionloss="0.5""#,
        r#"<motor name="lift" joint="lift" gear="1" ctrllimited="true" ctrlrange="-40 40"/>"#,
    ] {
        assert!(converted.text.contains(part), "{part}\n{}", converted.text);
    }
    for what in ["meshes", "largest rate", "contact"] {
        let told = converted.not_said.iter().any(|told| told.contains(what));
        assert!(told, "{what}: {:?}", converted.not_said);
    }
    let again = through_mjcf(&reading, Hinges::TwoPoints);
    assert_eq!(again.mechanism.actuated().len(), 1);
}

#[test]
fn the_command_writes_and_tells() {
    let output = convert(&["mechanisms/planar_four_bar.urdf", "--to", "mjcf"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).starts_with("<mujoco model=\"planar_four_bar\">\n"));
    assert!(text(&output.stderr).contains("note: not said: configuration `quarter_turn`"));

    let output = convert(&["mechanisms/planar_four_bar.urdf", "--to", "urdf"]);
    let lost = "revolute joint `rocker_pin` between `coupler` and `rocker`, which closes a loop";
    assert!(text(&output.stdout).contains(lost));
    assert!(text(&output.stderr).contains(lost));

    let folder = crate::support::empty_folder("convert");
    let file = folder.join("bar.xml");
    let name = file.to_str().unwrap();
    let source = "mechanisms/slider_crank.urdf";
    let output = convert(&[source, "--to", "mjcf", "--relax", "-o", name]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(output.stdout.is_empty());
    let output = convert(&[name, "--to", "native"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let back = read(&text(&output.stdout), "back.urdf", &[]).unwrap();
    assert_eq!(finite(&back), Some(1));

    let output = convert(&[source, "--to", "sdf"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn standard_input_is_read() {
    let mut child = program(&["-", "--to", "mjcf"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    input.write_all(FOUR_BAR.as_bytes()).unwrap();
    drop(input);
    let output = child.wait_with_output().unwrap();
    assert!(text(&output.stdout).contains("<connect name=\"d\""));
}
