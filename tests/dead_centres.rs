//! Chains of linkages at dead centre, each of which drives the crank of the next: what is decided must not depend on their length.

use crate::support;

use std::fmt::Write;

/// Cranks of length 2 and rods of length 3, in one line as drawn; the end of each rod takes the next crank along by an arm of length 1
/// across that line, or, without `held`, nothing stops the last one. The last rod ends on the ground.
fn chain(count: usize, held: bool) -> kutzbach::mechanism::Mechanism {
    let mut text = String::from("<robot name=\"chain\"><link name=\"ground\"/>");
    let axis = "<axis xyz=\"0 0 1\"/>";
    for k in 0..count {
        let _ = write!(text, "<link name=\"crank_{k}\"/><link name=\"rod_{k}\"/>");
        for (name, parent, child, x, y) in [
            ("pivot", "ground".to_owned(), format!("crank_{k}"), 5 * k, k),
            ("pin", format!("crank_{k}"), format!("rod_{k}"), 2, 0),
        ] {
            let _ = write!(
                text,
                "<joint name=\"{name}_{k}\" type=\"continuous\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
                 <origin xyz=\"{x} {} 0\"/>{axis}</joint>",
                -(y as i64)
            );
        }
        let next = k + 1;
        let (link, at) = match next == count {
            true => ("ground".to_owned(), format!("{} -{k} 0", 5 * next)),
            false => (format!("crank_{next}"), "0 1 0".to_owned()),
        };
        if next < count || held {
            let _ = write!(
                text,
                "<loop name=\"end_{k}\" type=\"continuous\"><predecessor link=\"rod_{k}\"><origin xyz=\"3 0 0\"/></predecessor>\
                 <successor link=\"{link}\"><origin xyz=\"{at}\"/></successor>{axis}</loop>"
            );
        }
    }
    text.push_str("</robot>");
    kutzbach::format::read(&text, "chain.urdf", &[])
        .unwrap()
        .mechanism
}

/// The last crank and rod are stretched between two fixed points, so they stand still, and so does each pair before them.
#[test]
fn chains_of_dead_centres_are_rigid_at_any_length() {
    for count in [2, 6, 9, 12, 20] {
        let analysis = support::analysis(&chain(count, true));
        assert_eq!(analysis.mobility.finite(), Some(0), "{count}");
    }
}

/// Where the last rod is loose, all of it moves.
#[test]
fn chains_with_a_loose_end_move() {
    for count in [3, 12] {
        let analysis = support::analysis(&chain(count, false));
        assert_eq!(analysis.mobility.finite(), Some(2), "{count}");
    }
}
