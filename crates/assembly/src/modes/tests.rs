//! Whole mechanisms.

use super::*;
use crate::samples;
use std::path::Path;
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

/// A shipped mechanism with some of its text replaced, its inputs held as proposed.
fn rewritten(name: &str, changes: &[(&str, &str)]) -> Modes {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../mechanisms/{name}.urdf"));
    let mut text = std::fs::read_to_string(path).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "{name}: {from}");
        text = text.replace(from, to);
    }
    let mechanism = kutzbach_format::read(&text, "x.urdf", &[])
        .unwrap()
        .mechanism;
    let question = Question {
        held: None,
        limits: Limits::seconds(60.0),
    };
    assembly_modes(&mechanism, &question).unwrap()
}

/// With exact numbers four configurations. Six decimals, taken literally, leave two of them; within the digits there are no more than the
/// four, and whether each of these closes is not proven.
#[test]
fn rounded_numbers_hide_no_configuration_of_more_equations_than_unknowns() {
    assert_eq!(modes_of("altmann_six_bar").configurations.len(), 4);
    let rounded = rewritten(
        "altmann_six_bar",
        &[
            ("${-94/13}", "-7.230769"),
            ("${180/13}", "13.846154"),
            ("${-75/13}", "-5.769231"),
            ("${-180/13}", "-13.846154"),
            ("${-244/13}", "-18.769231"),
        ],
    );
    assert_eq!(rounded.complete, Complete::Proven);
    assert!(rounded.configurations.iter().all(|c| !c.proven));
    let drawn = rounded.configurations.iter().filter(|c| c.drawn).count();
    assert_eq!((drawn, rounded.configurations.len()), (1, 4));
}

/// A double configuration is split or lost by rounding; nothing closes, or a pair that are hardly apart.
#[test]
fn rounded_numbers_prove_nothing_of_double_configurations() {
    let square = "${sqrt(22 + 4*sqrt(6))}";
    for bar in ["5.638967", "5.638968"] {
        let modes = rewritten("tetra_i", &[(square, bar)]);
        let Complete::Unknown(why) = &modes.complete else {
            panic!("called proven");
        };
        assert!(why.contains("rounded"), "{why}");
    }
}

/// Simple solutions of as many equations as unknowns stay with other digits, and so does it that nothing comes near to closing.
#[test]
fn rounded_numbers_leave_simple_configurations() {
    for (bar, count) in [("3.16227766", 10), ("7.00000001", 0)] {
        let modes = rewritten("tetra_iii", &[("${sqrt(10)}", bar)]);
        assert_eq!(modes.complete, Complete::Proven, "{bar}");
        assert_eq!(modes.configurations.len(), count, "{bar}");
    }
}

#[test]
fn what_cannot_close_is_proven_not_to() {
    let text = std::fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../mechanisms/tetra_iii.urdf"),
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
