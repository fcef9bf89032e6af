//! `kutzbach convert --to pinocchio`: the program holds the open tree and what closes its loops.

use crate::convert_cli::{FOUR_BAR, MECHANISMS, finite};
use kutzbach::format::{Reading, read, read_file};
use kutzbach::report::convert::to_pinocchio;

/// The tree in a program, read again.
fn tree(program: &str) -> Reading {
    let (_, rest) = program.split_once("URDF = '''").unwrap();
    let (urdf, _) = rest.split_once("'''").unwrap();
    let urdf = urdf.replace("\\'", "'").replace("\\\\", "\\");
    read(&urdf, "tree.urdf", &[]).unwrap_or_else(|error| panic!("{error}\n{urdf}"))
}

#[test]
fn a_hinge_is_two_points_of_its_axis() {
    let reading = read(FOUR_BAR, "four_bar.urdf", &[]).unwrap();
    let text = to_pinocchio(&reading.mechanism).unwrap().text;
    let turned = "((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))";
    for (name, height) in [("d", "0.0"), ("d.2", "1.0")] {
        let expected = format!(
            "    (\n        \"{name}\",\n        \"CONTACT_3D\",\n        (\"coupler\", {turned}, (4.0, 3.0, {height})),\n        (\"rocker\", {turned}, (0.0, 5.0, {height})),\n    ),\n"
        );
        assert!(text.contains(&expected), "{expected}\n{text}");
    }
    let open = tree(&text);
    assert_eq!(open.format, "urdf");
    assert_eq!(finite(&open), Some(3));
    // urdfdom wants an effort and a rate in every <limit>.
    let a = open.mechanism.joint_named("a").unwrap();
    let limit = open.mechanism.joint(a).limit.as_ref().unwrap();
    assert!(limit.effort.is_some() && limit.velocity.is_some());
}

#[test]
fn other_kinds_hang_in_the_tree_and_coincide() {
    let text = r#"<robot name="jack"><link name="base"/><link name="nut"/>
      <joint name="slide" type="prismatic"><parent link="base"/><child link="nut"/><axis xyz="0 0 1"/></joint>
      <loop name="thread" type="screw"><predecessor link="base"/><successor link="nut"/><axis xyz="0 0 1"/><screw lead="0.01"/></loop>
      <coupling name="stop" offset="0.5"><term joint="slide" coefficient="2"/></coupling></robot>"#;
    let reading = read(text, "jack.urdf", &[]).unwrap();
    let converted = to_pinocchio(&reading.mechanism).unwrap();
    for part in [
        "\"CONTACT_6D\"",
        "(\"thread_carrier_link\", ",
        "(\"thread.lead\", [(\"thread.trans\", 1.0), (\"thread\", -0.00159154943091895",
        "(\"stop\", [(\"slide\", 2.0)], 0.5),",
    ] {
        assert!(converted.text.contains(part), "{part}\n{}", converted.text);
    }
    assert!(!converted.text.contains("<mimic"));
    // The slide, and the turn and the travel of the screw.
    assert_eq!(finite(&tree(&converted.text)), Some(3));
}

#[test]
fn all_trees_are_plain_urdf() {
    for (name, _) in MECHANISMS {
        let reading = read_file(format!("mechanisms/{name}.urdf"), &[]).unwrap();
        let converted = to_pinocchio(&reading.mechanism).unwrap();
        assert_eq!(tree(&converted.text).format, "urdf", "{name}");
        let loops = reading.mechanism.joints().iter();
        let loops = loops.filter(|joint| joint.closes_loop).count();
        assert!(
            converted.text.matches("\"CONTACT_").count() >= loops,
            "{name}"
        );
    }
}

#[test]
fn places_of_constraints_are_worked_out_before_their_rows() {
    // Pinocchio 4 leaves the places of new data at the origin of the world, and its rows are those of other points.
    let reading = read(FOUR_BAR, "four_bar.urdf", &[]).unwrap();
    let text = to_pinocchio(&reading.mechanism).unwrap().text;
    let at = |part: &str| text.find(part).unwrap();
    let (places, rows) = (
        at("made.calc(model, data, there)"),
        at("getConstraintJacobian("),
    );
    assert!(at("there = made.createData()") < places && places < rows);
}
