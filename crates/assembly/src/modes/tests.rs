//! Whole mechanisms.

use super::*;
use crate::samples;
use std::time::Duration;

fn modes_of(name: &str) -> Modes {
    let question = Question {
        limits: Limits {
            time: Some(Duration::from_secs(60)),
            ..Limits::default()
        },
        held: None,
    };
    assembly_modes(&samples::own(name), &question).unwrap()
}

#[test]
fn the_drawn_configuration_is_among_all() {
    for (name, count) in [
        ("tetra_ii", 4),
        ("tetra_iii", 10),
        ("pent", 8),
        ("quad_16_17_18_19", 8),
    ] {
        let modes = modes_of(name);
        assert_eq!(modes.complete, Complete::Proven, "{name}");
        assert_eq!(modes.configurations.len(), count, "{name}");
        let drawn = modes.configurations.iter().filter(|c| c.drawn).count();
        assert_eq!(drawn, 1, "{name}");
    }
}

#[test]
fn double_solutions_and_curves_are_told_as_such() {
    let double = modes_of("tetra_i");
    assert_eq!(double.complete, Complete::Proven);
    assert_eq!(double.configurations.len(), 1);
    assert_eq!(double.configurations[0].multiplicity, Some(2));
    assert!(double.configurations[0].drawn);
    let question = Question {
        held: Some(Vec::new()),
        limits: Limits::seconds(60.0),
    };
    let curve = assembly_modes(&samples::own("quad"), &question).unwrap();
    assert!(matches!(curve.complete, Complete::Unknown(_)));
    assert_eq!((curve.moves, curve.proposed.len()), (Some(1), 1));
    // With what is proposed held there are finitely many.
    let held = modes_of("quad");
    assert_eq!((held.freedom, held.held.len()), (Some(1), 1));
    assert_eq!(
        (held.configurations.len(), held.complete),
        (6, Complete::Proven)
    );
}

/// Textbook counts with the input held: two closings of a dyad, of a slider crank, of an RSSR; one of Bennett's loop.
#[test]
fn mechanisms_of_one_loop_have_their_textbook_counts() {
    for (name, count) in [
        ("planar_four_bar", 2),
        ("slider_crank", 2),
        ("spherical_four_bar", 2),
        ("rssr", 2),
        ("bennett", 1),
        ("bricard_orthogonal", 2),
    ] {
        let modes = modes_of(name);
        assert_eq!(modes.complete, Complete::Proven, "{name}");
        assert_eq!(modes.configurations.len(), count, "{name}");
        assert_eq!(
            modes.configurations.iter().filter(|c| c.drawn).count(),
            1,
            "{name}"
        );
    }
}

#[test]
fn what_cannot_close_is_proven_not_to() {
    let text = std::fs::read_to_string(
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../mechanisms/tetra_iii.urdf"),
    )
    .unwrap();
    let read = |text: &str| {
        kutzbach_format::read(text, "x.urdf", &[])
            .unwrap()
            .mechanism
    };
    let question = Question {
        held: Some(Vec::new()),
        limits: Limits::seconds(60.0),
    };
    let long = assembly_modes(&read(&text.replace("${sqrt(10)}", "7")), &question).unwrap();
    assert_eq!(long.complete, Complete::Proven);
    assert!(long.configurations.is_empty() && long.contradiction.is_none());
    // The corners of two bodies that share two points are not equally far apart.
    let twice = text.replace(
        "<loop name=\"bar_12\"",
        "<loop name=\"again\" type=\"spherical\"><predecessor link=\"body_1\"><origin xyz=\"1 -1 1\"/></predecessor>\
         <successor link=\"body_2\"><origin xyz=\"1 1 2\"/></successor></loop><loop name=\"bar_12\"",
    );
    let contradicted = assembly_modes(&read(&twice), &question).unwrap();
    assert_eq!(contradicted.complete, Complete::Proven);
    assert!(contradicted.configurations.is_empty());
    assert!(contradicted.contradiction.unwrap().contains("m apart in"));
}
