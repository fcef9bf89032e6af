//! `kutzbach convert --to sdf`: what is written reads back as the same mechanism, and what SDF cannot say is told.

use crate::convert_cli::{FOUR_BAR, MECHANISMS, finite, one_joint};
use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::format::{Reading, read, read_file};
use kutzbach::mechanism::{CouplingOrigin, Geometry as Solid, Inertial, JointKind, Mechanism};
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::report::convert::{Converted, to_sdf};

fn native(text: &str) -> Reading {
    read(text, "native.urdf", &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn written(reading: &Reading) -> Converted {
    to_sdf(&reading.mechanism).unwrap_or_else(|error| panic!("{error}"))
}

/// The mechanism as SDF and read again.
fn again(converted: &Converted) -> Reading {
    let text = &converted.text;
    let reading = read(text, "model.sdf", &[]);
    let reading = reading.unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(reading.format, "sdf");
    reading
}

fn tells(converted: &Converted, what: &str) {
    let told = converted.not_said.iter().any(|told| told.contains(what));
    assert!(told, "{what}: {:?}", converted.not_said);
}

#[test]
fn mechanisms_keep_their_mobility_and_verdict() {
    for (name, expected) in MECHANISMS {
        let reading = read_file(format!("mechanisms/{name}.urdf"), &[]).unwrap();
        let analysed = |reading: &Reading| {
            let options = AnalysisOptions::default();
            analyse(&reading.mechanism, &options).unwrap().mobility
        };
        let (here, there) = (analysed(&reading), analysed(&again(&written(&reading))));
        assert_eq!(there.finite(), Some(expected), "{name}");
        assert_eq!(there.verdict, here.verdict, "{name}");
        assert_eq!(there.pose, here.pose, "{name}");
    }
}

/// `12.001` would be a number known to three decimals, within which Bennett's linkage moves.
#[test]
fn exact_numbers_stay_exact() {
    for name in ["bennett_spoiled", "waldron_six_bar_spoiled"] {
        let reading = read_file(format!("mechanisms/{name}.urdf"), &[]).unwrap();
        assert_eq!(finite(&again(&written(&reading))), Some(0), "{name}");
    }
}

#[test]
fn every_kind_of_joint_is_written() {
    for kind in JointKind::ALL {
        let text = one_joint(kind);
        let expected = Some(kind.freedom() + 1);
        let forward = native(&text);
        assert_eq!(finite(&again(&written(&forward))), expected, "{kind}");
        // The tree seen from its end: every joint is written backwards.
        let held = native(&text.replace("</robot>", "<ground link=\"arm\"/></robot>"));
        let found = finite(&again(&written(&held)));
        assert_eq!(found, expected, "{kind} backwards");
    }
}

/// Where a point of the link behind J of [`one_joint`] is in the link before it, at some values of J.
fn moved(mechanism: &Mechanism, values: &[f64]) -> [f64; 3] {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let joint = mechanism.joint_named("J").unwrap().0;
    let [before, behind] = &geometry.sides[joint];
    let displacement = &geometry.displacements[joint];
    let displacement = displacement.displacement(&displacement.at(values));
    let at = before.compose(&displacement).compose(&behind.inverse());
    at.apply(&[0.25, 0.5, 1.0])
}

#[test]
fn joints_move_as_they_did() {
    for kind in [
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Screw,
        JointKind::Universal,
        JointKind::Spherical,
    ] {
        let reading = native(&one_joint(kind));
        let there = again(&written(&reading));
        let values = [0.3, -0.2, 0.7];
        let values = &values[..kind.freedom()];
        let one = moved(&reading.mechanism, values);
        let other = moved(&there.mechanism, values);
        for (a, b) in one.iter().zip(other) {
            assert!((a - b).abs() < 1e-12, "{kind}: {one:?}, {other:?}");
        }
    }
}

#[test]
fn a_four_bar_in_sdf() {
    let converted = written(&native(FOUR_BAR));
    let mass = "<inertial><mass>0.1</mass><inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia></inertial>";
    let link = |name: &str, joint: &str| {
        format!(
            r#"    <link name="{name}">
      <pose relative_to="{joint}">0 0 0 0 0 0</pose>
      {mass}
    </link>
"#
        )
    };
    let joint = |name: &str, word: &str, place: [&str; 2], child: &str, limit: [&str; 2]| {
        let ([parent, at], [lower, upper]) = (place, limit);
        format!(
            r#"    <joint name="{name}" type="{word}">
      <pose relative_to="{parent}">{at} 0 0 0</pose>
      <parent>{parent}</parent>
      <child>{child}</child>
      <axis>
        <xyz>0 0 1</xyz>
        <limit>
          <lower>{lower}</lower>
          <upper>{upper}</upper>
        </limit>
      </axis>
    </joint>
"#
        )
    };
    let none = ["-1e16", "1e16"];
    let expected = vec![
        "<?xml version=\"1.0\"?>\n<sdf version=\"1.11\">\n  <model name=\"four_bar\">\n".to_owned(),
        "    <link name=\"ground\"/>\n".to_owned(),
        link("crank", "a"),
        link("coupler", "c"),
        link("rocker", "b"),
        "    <joint name=\"ground_held\" type=\"fixed\">\n".to_owned(),
        "      <parent>world</parent>\n      <child>ground</child>\n    </joint>\n".to_owned(),
        joint("a", "revolute", ["ground", "0 0 0"], "crank", ["-1.5", "2"]),
        joint("c", "continuous", ["crank", "0 2 0"], "coupler", none),
        joint("b", "continuous", ["ground", "4 0 0"], "rocker", none),
        joint("d", "continuous", ["coupler", "4 3 0"], "rocker", none),
        "  </model>\n</sdf>\n".to_owned(),
    ];
    assert_eq!(converted.text, expected.concat());
    assert_eq!(converted.not_said.len(), 1, "{:?}", converted.not_said);
    tells(&converted, "3 got 0.1 kg");
    let there = again(&converted);
    assert_eq!(finite(&there), Some(1));
    let a = there.mechanism.joint_named("a").unwrap();
    assert_eq!(there.mechanism.joint(a).bounds(), Some((-1.5, 2.0)));
}

#[test]
fn loops_that_are_open_as_drawn_are_drawn_closed() {
    let wide = native(&FOUR_BAR.replace("0 5 0", "0 5.5 0"));
    let converted = written(&wide);
    tells(&converted, "the pose drawn, where loops are open");
    let there = again(&converted);
    assert_eq!(finite(&there), Some(1));
    // The pose has moved within the limits, which are as far apart as before.
    let a = there.mechanism.joint_named("a").unwrap();
    let (lower, upper) = there.mechanism.joint(a).bounds().unwrap();
    assert!((upper - lower - 3.5).abs() < 1e-12 && lower < 0.0 && upper > 0.0);
    assert!((lower + 1.5).abs() > 1e-3, "{lower}");
    // The lengths are those of the file: the rocker's two pins are 5.5 apart.
    let d = there.mechanism.joint_named("d").unwrap();
    let b = there.mechanism.joint_named("b").unwrap();
    let geometry = Geometry::new(&there.mechanism, None, &Arithmetic::double());
    let rocker = there.mechanism.link_named("rocker").unwrap();
    let pin = |id: kutzbach::mechanism::JointId| {
        let joint = there.mechanism.joint(id);
        let side = usize::from(joint.successor.link == rocker);
        geometry.sides[id.0][side].translation
    };
    let apart: f64 = pin(d)
        .iter()
        .zip(pin(b))
        .map(|(x, y)| (x - y).powi(2))
        .sum();
    assert!((apart.sqrt() - 5.5).abs() < 1e-9, "{apart}");
    // What closes nowhere is not written.
    let never = native(&FOUR_BAR.replace("0 5 0", "0 50 0"));
    assert!(to_sdf(&never.mechanism).is_err());
}

#[test]
fn masses_shapes_limits_and_motors_are_kept() {
    let reading = native(
        r#"<robot name="arm"><link name="base"/>
      <link name="arm"><inertial><origin xyz="0 0 0.5"/><mass value="2.50"/><inertia ixx="0.2" iyy="0.2" izz="0.1"/></inertial>
        <collision><geometry><box size="0.1 0.1 1"/></geometry></collision>
        <collision><geometry><sphere radius="0"/></geometry></collision>
        <visual><origin xyz="0 0 0.1"/><geometry><mesh filename="package://arm/arm.stl" scale="2 2 2"/></geometry></visual></link>
      <joint name="lift" type="prismatic"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
        <limit lower="0" upper="0.8" effort="40" velocity="1"/><dynamics damping="3" friction="0.5"/></joint>
      <transmission name="t"><joint name="lift"/></transmission></robot>"#,
    );
    let converted = written(&reading);
    for part in [
        "<pose>0 0 0.5 0 0 0</pose>",
        "<mass>2.50</mass>",
        "<ixx>0.2</ixx><ixy>0</ixy><ixz>0</ixz><iyy>0.2</iyy><iyz>0</iyz><izz>0.1</izz>",
        "<box><size>0.1 0.1 1</size></box>",
        "<mesh><uri>package://arm/arm.stl</uri><scale>2 2 2</scale></mesh>",
        "<upper>0.8</upper>",
        "<effort>40</effort>",
        "<velocity>1</velocity>",
        "<damping>3</damping>",
        "<friction>0.5</friction>",
        "<joint_name>lift</joint_name>",
    ] {
        assert!(converted.text.contains(part), "{part}\n{}", converted.text);
    }
    tells(&converted, "shapes without extent: 1");
    let there = again(&converted);
    let lift = there.mechanism.joint_named("lift").unwrap();
    assert_eq!(there.mechanism.actuated(), [lift]);
    let limit = there.mechanism.joint(lift).limit.as_ref().unwrap();
    assert_eq!(limit.effort.as_ref().unwrap().value(), 40.0);
    let link = |reading: &Reading| {
        let id = reading.mechanism.link_named("arm").unwrap();
        reading.mechanism.link(id).clone()
    };
    let (here, back) = (link(&reading), link(&there));
    let (one, other) = (here.inertial.unwrap(), back.inertial.unwrap());
    assert_eq!(one.mass.value(), other.mass.value());
    let values = |numbers: &[kutzbach::number::Number]| -> Vec<f64> {
        numbers.iter().map(|number| number.value()).collect()
    };
    assert_eq!(values(&one.inertia), values(&other.inertia));
    let place = |inertial: &Inertial| values(&inertial.origin.position);
    assert_eq!(place(&one), place(&other));
    assert_eq!(back.collisions.len(), 1);
    assert!(matches!(back.collisions[0].geometry, Solid::Box(_)));
    assert_eq!(back.visuals[0].geometry, here.visuals[0].geometry);
}

/// The factor of one joint in a coupling, over that of another.
fn ratio(mechanism: &Mechanism, [one, other]: [&str; 2]) -> f64 {
    let factor = |name: &str| {
        let id = mechanism.joint_named(name).unwrap();
        let terms = mechanism.couplings().iter().flat_map(|c| &c.terms);
        let mut found = terms.filter(|term| term.joint == id);
        found.next().unwrap().factor.value()
    };
    factor(one) / factor(other)
}

fn wheels(axis: &str, coupling: &str, ground: &str) -> Reading {
    native(&format!(
        r#"<robot name="wheels"><link name="frame"/><link name="a"/><link name="b"/><link name="c"/>
      <joint name="p" type="continuous"><parent link="frame"/><child link="a"/><axis xyz="0 0 1"/></joint>
      <joint name="q" type="continuous"><parent link="frame"/><child link="b"/><origin xyz="3 0 0"/><axis xyz="{axis}"/></joint>
      <joint name="r" type="prismatic"><parent link="frame"/><child link="c"/><origin xyz="0 5 0"/><axis xyz="1 0 0"/></joint>
      {coupling}{ground}</robot>"#
    ))
}

#[test]
fn gears_and_followers_keep_their_ratio() {
    let mesh = "<coupling name=\"mesh\"><predecessor link=\"a\"/><successor link=\"b\"/><ratio value=\"-2.5\"/></coupling>";
    for axis in ["0 0 1", "0 0 -1", "0 1 0"] {
        for ground in ["", "<ground link=\"a\"/>", "<ground link=\"b\"/>"] {
            let reading = wheels(axis, mesh, ground);
            let converted = written(&reading);
            assert!(converted.text.contains("type=\"gearbox\""));
            let there = again(&converted);
            let [here, found] =
                [&reading, &there].map(|reading| ratio(&reading.mechanism, ["p", "q"]));
            assert!(
                (here - found).abs() < 1e-12,
                "{axis} {ground}: {here}, {found}"
            );
            assert_eq!(finite(&there), finite(&reading));
        }
    }
    // A slide and a hinge are no gears; the sum is 0.5.
    let rack = "<coupling name=\"rack\" offset=\"0.5\"><term joint=\"r\" coefficient=\"2\"/><term joint=\"p\" coefficient=\"1\"/></coupling>";
    let converted = written(&wheels("0 0 1", rack, ""));
    let there = again(&converted);
    let coupling = &there.mechanism.couplings()[0];
    assert!(matches!(coupling.origin, CouplingOrigin::Mimic { .. }));
    assert!((ratio(&there.mechanism, ["r", "p"]) - 2.0).abs() < 1e-12);
    let scale = coupling.terms[0].factor.value();
    let of_r = there.mechanism.joint_named("r").unwrap();
    assert_eq!(coupling.terms[0].joint, of_r);
    assert!((coupling.offset.value() / scale - 0.25).abs() < 1e-12);
}

#[test]
fn couplings_that_sdf_has_no_words_for_are_told_or_hold() {
    let sum = "<coupling name=\"sum\" offset=\"0\"><term joint=\"p\" coefficient=\"1\"/><term joint=\"q\" coefficient=\"1\"/><term joint=\"r\" coefficient=\"1\"/></coupling>";
    tells(&written(&wheels("0 0 1", sum, "")), "coupling `sum`");
    let hold =
        "<coupling name=\"brake\" offset=\"0\"><term joint=\"q\" coefficient=\"3\"/></coupling>";
    let reading = wheels("0 0 1", hold, "");
    let converted = written(&reading);
    tells(&converted, "coupling `brake`, which holds it");
    let there = again(&converted);
    let q = there.mechanism.joint_named("q").unwrap();
    assert_eq!(there.mechanism.joint(q).kind, JointKind::Fixed);
    assert_eq!(finite(&there), finite(&reading));
    let away = hold.replace("offset=\"0\"", "offset=\"3\"");
    tells(
        &written(&wheels("0 0 1", &away, "")),
        "coupling `brake`: SDF",
    );
}

#[test]
fn names_are_those_that_sdf_takes() {
    let reading = native(
        r#"<robot name="two::arms"><link name="base"/><link name="left::hand"/><link name="world"/><link name="arm"/>
      <joint name="arm" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint>
      <joint name="a" type="continuous"><parent link="arm"/><child link="left::hand"/><axis xyz="1 0 0"/></joint>
      <joint name="b" type="continuous"><parent link="arm"/><child link="world"/><axis xyz="1 0 0"/></joint></robot>"#,
    );
    let converted = written(&reading);
    for what in [
        "`left::hand`, which is called `left_hand`",
        "`world`, which is called `world_link`",
        "joint `arm`, which is called `arm_joint`",
    ] {
        tells(&converted, what);
    }
    let there = again(&converted);
    assert_eq!(finite(&there), Some(3));
    assert!(there.mechanism.joint_named("arm_joint").is_some());
}

#[test]
fn a_ground_called_world_is_the_world() {
    let text = FOUR_BAR.replace("\"ground\"", "\"world\"");
    // The loop ends at the world, as its successor.
    let text = text.replace(
        r#"<joint name="b" type="continuous"><parent link="world"/><child link="rocker"/><origin xyz="4 0 0"/>"#,
        r#"<joint name="b" type="continuous"><parent link="coupler"/><child link="rocker"/><origin xyz="4 3 0"/>"#,
    );
    let text = text.replace(
        r#"<predecessor link="coupler"><origin xyz="4 3 0"/></predecessor>
    <successor link="rocker"><origin xyz="0 5 0"/></successor>"#,
        r#"<predecessor link="rocker"><origin xyz="0 -5 0"/></predecessor>
    <successor link="world"><origin xyz="4 0 0"/></successor>"#,
    );
    let reading = native(&text);
    assert_eq!(finite(&reading), Some(1));
    let converted = written(&reading);
    assert!(!converted.text.contains("<link name=\"world"));
    assert!(!converted.text.contains("<child>world</child>"));
    let there = again(&converted);
    assert_eq!(there.mechanism.links().len(), 4);
    assert_eq!(finite(&there), Some(1));
    // Read and written again it is the same file.
    assert_eq!(written(&there).text.matches("<joint").count(), 4);
}

#[test]
fn threads_are_right_handed_in_metres_per_turn() {
    let reading = native(&one_joint(JointKind::Screw));
    let converted = written(&reading);
    let pitch = "<screw_thread_pitch>0.01</screw_thread_pitch>";
    assert!(converted.text.contains(pitch), "{}", converted.text);
    let there = again(&converted);
    let screw = there.mechanism.joint_named("J").unwrap();
    let lead = there.mechanism.joint(screw).lead.as_ref().unwrap();
    assert_eq!(lead.value(), 0.01);
}
