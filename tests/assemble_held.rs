//! `kutzbach assemble` and `graph` where joints are held that make several links one body.

use std::io::Write;
use std::process::Stdio;

/// Three links whose joints `ab` and `bc` are held become one body; a dyad of two links hangs on it. The rest of the loop of
/// three is a joint with its second side at a frame.
fn held_triangle(kind: &str, axes: &str, frame: &str) -> String {
    let hinge = |name: &str, parent: &str, child: &str, at: &str| {
        format!(
            "<joint name=\"{name}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"{child}\"/><origin xyz=\"{at}\"/>\
             <axis xyz=\"0 0 1\"/></joint>"
        )
    };
    let links: String = ["a", "b", "c", "d", "e"]
        .iter()
        .map(|name| format!("<link name=\"{name}\"/>"))
        .collect();
    format!(
        "<robot name=\"triangle\">{links}{}{}{}{}\
         <loop name=\"ca\" type=\"{kind}\"><predecessor link=\"c\"/><successor link=\"a\"><origin {frame}/></successor>{axes}</loop>\
         <loop name=\"ec\" type=\"revolute\"><predecessor link=\"e\"><origin xyz=\"-4 0 0\"/></predecessor>\
         <successor link=\"c\"><origin xyz=\"1 1 0\"/></successor><axis xyz=\"0 0 1\"/></loop></robot>",
        hinge("ab", "a", "b", "1 0 0"),
        hinge("bc", "b", "c", "1 2 0"),
        hinge("ad", "a", "d", "5 0 0"),
        hinge("de", "d", "e", "0 4 0"),
    )
}

/// What a command says of it with two joints held.
fn said_of_held(command: &[&str], text: &str) -> String {
    let mut child = crate::support::program()
        .args([command[0], "-"])
        .args(&command[1..])
        .args(["--hold", "ab=0", "--hold", "bc=0"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child
        .stdin
        .take()
        .unwrap()
        .write_all(text.as_bytes())
        .unwrap();
    let output = child.wait_with_output().unwrap();
    String::from_utf8([output.stdout, output.stderr].concat()).unwrap()
}

#[test]
fn a_joint_within_held_links_has_to_close_there() {
    let z = "<axis xyz=\"0 0 1\"/>";
    let x = "<axis xyz=\"1 0 0\"/>";
    let two = "<axis xyz=\"0 0 1\"/><axis2 xyz=\"1 0 0\"/>";
    let (here, away, up) = ("xyz=\"2 2 0\"", "xyz=\"5 5 0\"", "xyz=\"2 2 3\"");
    let beside = "xyz=\"7 2 0\"";
    let tilted = "xyz=\"2 2 0\" rpy=\"${pi/6} 0 0\"";
    for (kind, axes, closing, open) in [
        (
            "fixed",
            "",
            vec![here],
            vec![(away, "4242.641 mm"), (tilted, "30.000°")],
        ),
        (
            "revolute",
            z,
            vec![here],
            vec![
                (away, "4242.641 mm"),
                (up, "3000.000 mm"),
                (tilted, "30.000°"),
            ],
        ),
        (
            "spherical",
            "",
            vec![here, tilted],
            vec![(away, "4242.641 mm")],
        ),
        (
            "prismatic",
            x,
            vec![here, beside],
            vec![(away, "3000.000 mm"), (tilted, "30.000°")],
        ),
        (
            "cylindrical",
            z,
            vec![here, up],
            vec![(away, "4242.641 mm"), (tilted, "30.000°")],
        ),
        (
            "planar",
            z,
            vec![here, away],
            vec![(up, "3000.000 mm"), (tilted, "30.000°")],
        ),
        (
            "universal",
            two,
            vec![here, tilted],
            vec![(away, "4242.641 mm")],
        ),
        (
            "distance",
            "<distance value=\"5\"/>",
            vec!["xyz=\"5 6 0\""],
            vec![(here, "5000.000 mm")],
        ),
    ] {
        for frame in closing {
            let text = said_of_held(&["assemble"], &held_triangle(kind, axes, frame));
            assert!(
                text.starts_with("2 configurations, and no other"),
                "{kind} {frame}: {text}"
            );
        }
        for (frame, gap) in open {
            let text = said_of_held(&["assemble"], &held_triangle(kind, axes, frame));
            assert!(
                text.starts_with("It cannot be put together"),
                "{kind} {frame}: {text}"
            );
            // Of three joints that are all fixed any may be the one that does not close.
            let joint = if kind == "fixed" { "" } else { "joint `ca` " };
            let words =
                format!("{joint}joins two sides of one body, that of link `a`, which are {gap}");
            assert!(text.contains(&words), "{kind} {frame}: {text}");
        }
    }
}

/// With other digits the joint may or may not close; a gap beyond them is one.
#[test]
fn rounded_numbers_within_held_links() {
    let hinge = |frame: &str| {
        let text = held_triangle("revolute", "<axis xyz=\"0 0 1\"/>", frame);
        let rounded = text.replace("xyz=\"1 2 0\"", "xyz=\"1.00001 2.00001 0\"");
        said_of_held(&["assemble"], &rounded)
    };
    for frame in ["xyz=\"2.00001 2.00001 0\"", "xyz=\"2.00002 2.00001 0\""] {
        let text = hinge(frame);
        assert!(
            text.starts_with("2 configurations within the digits"),
            "{text}"
        );
        assert!(text.contains("the numbers are rounded"), "{text}");
        assert!(
            text.contains("(drawn; closes within rounding, not proved)"),
            "{text}"
        );
    }
    assert!(hinge("xyz=\"2.1 2 0\"").starts_with("It cannot be put together"));
}

#[test]
fn a_sketch_with_held_links_has_to_close_there() {
    let graph = ["graph", "--constructive"];
    let z = "<axis xyz=\"0 0 1\"/>";
    let x = "<axis xyz=\"1 0 0\"/>";
    for (kind, axis, frame) in [
        ("revolute", z, "xyz=\"2 2 0\""),
        ("prismatic", x, "xyz=\"7 2 0\""),
    ] {
        let text = said_of_held(&graph, &held_triangle(kind, axis, frame));
        assert!(text.contains("solutions: 2\n"), "{text}");
    }
    for (kind, axis, frame, words) in [
        (
            "revolute",
            z,
            "xyz=\"5 5 0\"",
            "one body, that of link `a`, which are 4242.641 mm apart",
        ),
        (
            "revolute",
            z,
            "xyz=\"2 2 3\"",
            "sides of joint `ca` are 3000.000 mm apart along the hinges",
        ),
        (
            "prismatic",
            x,
            "xyz=\"7 5 0\"",
            "one body, that of link `a`, which are 3000.000 mm apart",
        ),
        (
            "prismatic",
            x,
            "xyz=\"2 2 0\" rpy=\"0 0 ${pi/6}\"",
            "one body, that of link `a`, which are 30.000° apart",
        ),
        (
            "prismatic",
            x,
            "xyz=\"2 2 0\" rpy=\"${pi} 0 0\"",
            "side of joint `ca` is turned out of the plane",
        ),
    ] {
        let text = said_of_held(&graph, &held_triangle(kind, axis, frame));
        assert!(
            text.replace(['\n', '│'], " ")
                .split_whitespace()
                .collect::<Vec<_>>()
                .join(" ")
                .contains(words),
            "{kind} {frame}: {text}"
        );
    }
}
