//! Rigid parts first: tetrahedra that are cut in two along an edge and held by a bar between the halves.

use super::*;
use std::fmt::Write;

/// Three regular tetrahedra of edge 2√2 in a ring of balls with three bars of length √10, some of them cut.
fn ring(cut: [bool; 3]) -> Modes {
    let mut text = String::from("<robot name=\"ring\">\n");
    let half = |body: usize, end: bool| match (cut[body], end) {
        (true, true) => format!("body_{body}_far"),
        _ => format!("body_{body}"),
    };
    let [a, b, g, d] = ["-1 -1 -1", "-1 1 1", "1 -1 1", "1 1 -1"];
    let joint = |name: &str, kind: &str, ends: [(String, &str); 2], more: &str| {
        let [(near, at), (far, there)] = ends;
        if name.starts_with("edge") || ["corner_0", "corner_1"].contains(&name) {
            return format!(
                "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{near}\"/><child link=\"{far}\"><origin xyz=\"{there}\"/></child>\
                 <origin xyz=\"{at}\"/>{more}</joint>\n"
            );
        }
        format!(
            "<loop name=\"{name}\" type=\"{kind}\"><predecessor link=\"{near}\"><origin xyz=\"{at}\"/></predecessor>\
             <successor link=\"{far}\"><origin xyz=\"{there}\"/></successor>{more}</loop>\n"
        )
    };
    for (body, is_cut) in cut.into_iter().enumerate() {
        let next = (body + 1) % 3;
        let _ = writeln!(text, "<link name=\"body_{body}\"/>");
        let bar = "<distance value=\"${sqrt(10)}\"/>";
        let ends = [(half(body, false), g), (half(next, false), d)];
        text += &joint(&format!("bar_{body}"), "distance", ends, bar);
        if is_cut {
            let _ = writeln!(text, "<link name=\"body_{body}_far\"/>");
            let side = "<distance value=\"${2*sqrt(2)}\"/>";
            let ends = [(half(body, false), a), (half(body, true), b)];
            text += &joint(&format!("side_{body}"), "distance", ends, side);
            let axis = "<axis xyz=\"0 1 -1\"/>";
            let ends = [false, true].map(|end| (half(body, end), "1 0 0"));
            text += &joint(&format!("edge_{body}"), "revolute", ends, axis);
        }
        let ends = [(half(body, true), b), (half(next, false), a)];
        text += &joint(&format!("corner_{body}"), "spherical", ends, "");
    }
    text += "</robot>";
    let reading = kutzbach_format::read(&text, "ring.urdf", &[]).unwrap();
    let question = Question {
        held: Some(Vec::new()),
        limits: Limits::seconds(60.0),
    };
    assembly_modes(&reading.mechanism, &question).unwrap()
}

/// Weight and ways of each part, and the weight of the tree.
fn weights(modes: &Modes) -> (Vec<(usize, usize)>, usize) {
    let Way::Tree { parts, weight, .. } = &modes.way else {
        panic!("{:?}", modes.way);
    };
    (parts.iter().map(|p| (p.weight, p.ways)).collect(), *weight)
}

/// Ten ways where no tetrahedron is its mirror image, sixteen where one is: a tree over the pieces, four unknowns at once, has the same 26. A
/// reflection turns two mirror images into one and three into none.
#[test]
fn bodies_in_pieces_are_put_together_first() {
    let whole = ring([false; 3]);
    assert_eq!(weights(&whole), (vec![], 3));
    assert_eq!(whole.configurations.len(), 10);
    let one = ring([false, true, false]);
    assert_eq!(weights(&one), (vec![(1, 2)], 3));
    assert_eq!(
        (one.configurations.len(), &one.complete),
        (26, &Complete::Proven)
    );
    assert!(one.left_out.is_empty());
    // Six unknowns at once.
    let all = ring([true; 3]);
    assert_eq!(weights(&all), (vec![(1, 2); 3], 3));
    assert_eq!(
        (all.configurations.len(), &all.complete),
        (2 * (10 + 3 * 16), &Complete::Proven)
    );
    assert!(all.left_out.is_empty());
}
