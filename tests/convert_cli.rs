//! `kutzbach convert`: what is written reads back as the same mechanism, and what cannot be said is told.

use kutzbach::format::{Reading, read, read_file, write};
use kutzbach::mechanism::JointKind;
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::report::convert::{Hinges, in_full, relaxed, to_mjcf, to_urdf};
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

pub fn finite(reading: &Reading) -> Option<usize> {
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

/// Mechanisms and their mobility.
pub const MECHANISMS: [(&str, usize); 17] = [
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
];

#[test]
fn mechanisms_keep_their_mobility_in_mjcf() {
    for (name, expected) in MECHANISMS {
        let reading = read_file(format!("mechanisms/{name}.urdf"), &[]).unwrap();
        assert_eq!(finite(&reading), Some(expected), "{name}");
        for hinges in [Hinges::TwoPoints, Hinges::Body] {
            let again = through_mjcf(&reading, hinges);
            assert_eq!(finite(&again), Some(expected), "{name} {hinges:?}");
        }
    }
}

/// `12.001` and `0.125` would be numbers known to three decimals, within which rigid linkages move.
#[test]
fn exact_numbers_stay_exact_in_mjcf() {
    for (name, expected) in [
        ("spherical_four_bar_stretched", 0),
        ("four_creases_in_a_corner", 0),
        ("crossed_creases_flat", 1),
        ("bennett_spoiled", 0),
        ("griffis_duffy_spoiled", 0),
        ("bennett_equilateral", 1),
        ("spherical_strap", 1),
    ] {
        let reading = read_file(format!("mechanisms/{name}.urdf"), &[]).unwrap();
        let again = through_mjcf(&reading, Hinges::TwoPoints);
        assert_eq!(finite(&again), Some(expected), "{name}");
    }
}

/// Two links, joined by one kind of joint in the tree, and by hinges and a slide that make a loop of it.
pub fn one_joint(kind: JointKind) -> String {
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
        let refused = |told: &String| told.contains("urdfdom refuses");
        assert!(urdf.not_said.iter().all(refused), "{:?}", urdf.not_said);
        let again = read(&urdf.text, "tree.urdf", &[]).unwrap();
        assert_eq!(again.format, "urdf", "{}", urdf.text);
        assert_eq!(finite(&again), expected, "{kind}");
    }
}

pub const FOUR_BAR: &str = r#"<robot name="four_bar">
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

/// Whether the file moves as what was read is asked of an analysis, which may not be possible.
#[test]
fn what_cannot_be_analysed_is_written_and_told() {
    let text = r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
      <joint name="j" type="continuous"><parent link="a"/><child link="b"/>
        <origin xyz="0.312345 0 0" quat_xyzw="0 0 0.382683 0.923880"/><axis xyz="0 0 1"/></joint>
      <joint name="k" type="continuous"><parent link="a"/><child link="c"/>
        <origin xyz="0.312345 0 0"/><axis xyz="0 0 1"/></joint>
      <loop name="l" type="distance"><predecessor link="b"/><successor link="c"/></loop></robot>"#;
    let reading = read(text, "rod.urdf", &[]).unwrap();
    let options = AnalysisOptions::default();
    assert!(analyse(&reading.mechanism, &options).is_err());
    let found = in_full(&reading.mechanism, &options);
    assert!(found.assembly.is_none());
    assert!(found.note.unwrap().contains("points coincide"));
    let again = read(&write(&found.mechanism), "rod.urdf", &[]).unwrap();
    assert_eq!(again.mechanism.joints().len(), 3);
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
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let back = read(&text(&output.stdout), "back.sdf", &[]).unwrap();
    assert_eq!((back.format, finite(&back)), ("sdf", Some(1)));
    let output = convert(&[source, "--to", "pinocchio"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("def build():"));

    let output = convert(&[source, "--to", "usd"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn what_mjcf_cannot_say_of_the_ground_and_of_efforts_is_told() {
    // The ground is the second link, a quarter turn about x beside the root: what pulls along −z of the world pulls along −y of the ground.
    let text = r#"<robot name="turned"><link name="root"/>
      <link name="held"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link><link name="arm"/>
      <joint name="a" type="continuous"><parent link="root"/><child link="held"/><origin rpy="${pi/2} 0 0"/><axis xyz="1 0 0"/></joint>
      <joint name="b" type="revolute"><parent link="held"/><child link="arm"/><axis xyz="0 0 1"/>
        <limit lower="-1" upper="1" effort="3"/></joint>
      <ground link="held"/><scene><gravity xyz="0 0 -10"/></scene></robot>"#;
    let reading = read(text, "turned.urdf", &[]).unwrap();
    let converted = to_mjcf(&reading.mechanism, Hinges::TwoPoints);
    let line = converted.text.lines().find(|line| line.contains("gravity"));
    let words = line.unwrap().split('"').nth(1).unwrap().split(' ');
    let gravity: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
    for (found, expected) in gravity.iter().zip([0.0, -10.0, 0.0]) {
        assert!((found - expected).abs() < 1e-12, "{gravity:?}");
    }
    for what in [
        "the mass of the ground",
        "the largest effort of `b`, which no motor drives",
    ] {
        let told = converted.not_said.iter().any(|told| told.contains(what));
        assert!(told, "{what}: {:?}", converted.not_said);
    }
}

#[test]
fn urdf_says_what_it_can_and_what_urdfdom_refuses() {
    // `b` follows `a`; `b` is coupled to `c` as well, which then follows `b`.
    let text = r#"<robot name="three"><link name="base"/><link name="x"/><link name="y"/><link name="z"/><link name="box"/>
      <joint name="a" type="revolute"><parent link="base"/><child link="x"/><axis xyz="0 0 1"/><limit lower="-1" upper="1"/></joint>
      <joint name="b" type="continuous"><parent link="base"/><child link="y"/><axis xyz="0 0 1"/><mimic joint="a"/></joint>
      <joint name="c" type="prismatic"><parent link="base"/><child link="z"/><axis xyz="0 0 1"/></joint>
      <joint name="d" type="cylindrical"><parent link="z"/><child link="tip"/><axis xyz="0 0 1"/><dynamics damping="1"/></joint>
      <link name="tip"/>
      <joint name="d.rot" type="floating"><parent link="base"/><child link="box"/></joint>
      <coupling name="two---dashes" offset="0"><term joint="b" coefficient="1"/><term joint="c" coefficient="-4"/></coupling>
      <coupling name="none--at all" offset="1"><term joint="a" coefficient="1"/></coupling></robot>"#;
    let reading = read(text, "three.urdf", &[]).unwrap();
    let converted = to_urdf(&reading.mechanism).unwrap();
    for what in [
        "an effort and a rate of `a`, `c`, `d.trans`",
        "damping and friction of `d`",
        "coupling `none--at all`",
    ] {
        let told = converted.not_said.iter().any(|told| told.contains(what));
        assert!(told, "{what}: {:?}", converted.not_said);
    }
    // What is told stands in a comment, which is one.
    let again = read(&converted.text, "tree.urdf", &[]);
    let again = again.unwrap_or_else(|error| panic!("{error}\n{}", converted.text));
    assert_eq!(again.mechanism.couplings().len(), 2, "{}", converted.text);
    let c = again.mechanism.joint_named("c").unwrap();
    assert!(again.mechanism.couplings().iter().any(|coupling| {
        let of_c = coupling.terms.iter().find(|term| term.joint == c);
        of_c.is_some()
    }));
    assert_eq!(
        again.mechanism.links().len(),
        reading.mechanism.links().len() + 1
    );
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
