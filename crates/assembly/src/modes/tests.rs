//! Whole mechanisms.

use super::*;
use crate::samples;
use std::path::Path;

fn modes_of(name: &str) -> Modes {
    let question = Question {
        limits: Limits::seconds(60.0),
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

/// A square of side 2 with triangles of height 3 on its sides: two tips that stand on opposite sides, each a third of the height out, are
/// √40 apart, and no two are farther. Over the complex numbers the equations have a curve.
#[test]
fn bars_as_long_as_they_can_be_leave_two_configurations() {
    let with = |square: &str| {
        let length = format!("<distance value=\"${{sqrt({square})}}\"/>");
        rewritten("quad", &[("<distance value=\"4\"/>", &length)])
    };
    let stretched = with("40");
    assert_eq!(stretched.complete, Complete::Proven);
    assert_eq!(stretched.configurations.len(), 2);
    for configuration in &stretched.configurations {
        assert!(configuration.proven && configuration.finite == Some(0));
        assert_eq!(configuration.multiplicity, None);
    }
    let longer = with("401/10");
    assert_eq!(
        (longer.configurations.len(), longer.complete),
        (0, Complete::Proven)
    );
    let shorter = with("39");
    assert!(shorter.configurations.len() > 2 || shorter.moves != Some(0));
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

fn told(text: &str) -> Modes {
    let mechanism = kutzbach_format::read(text, "x.urdf", &[])
        .unwrap()
        .mechanism;
    let question = Question {
        held: Some(Vec::new()),
        limits: Limits::seconds(60.0),
    };
    assembly_modes(&mechanism, &question).unwrap()
}

/// A ball beside the axis of a hinge holds a flap, although both balls of the strut could be reached from another angle. Two hinges through
/// one point hold that point in a third body, so that no hinge beside it turns.
#[test]
fn three_shared_points_leave_nothing_free() {
    let flap = "<robot name=\"flap\"><link name=\"frame\"/><link name=\"flap\"/><link name=\"strut\"/>\
         <joint name=\"pin\" type=\"continuous\"><parent link=\"frame\"/><child link=\"flap\"/><axis xyz=\"1 0 0\"/></joint>\
         <loop name=\"ball\" type=\"spherical\"><predecessor link=\"frame\"><origin xyz=\"0 2 1\"/></predecessor>\
         <successor link=\"flap\"><origin xyz=\"0 2 1\"/></successor></loop>\
         <joint name=\"foot\" type=\"spherical\"><parent link=\"frame\"/><child link=\"strut\"/><origin xyz=\"2 -1 1\"/></joint>\
         <loop name=\"head\" type=\"spherical\"><predecessor link=\"flap\"><origin xyz=\"1 3 2\"/></predecessor>\
         <successor link=\"strut\"><origin xyz=\"-1 4 1\"/></successor></loop></robot>";
    let turns = "<robot name=\"turns\"><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\
         <joint name=\"p\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"1 1 0\"/></joint>\
         <joint name=\"q\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/><origin xyz=\"0 1 0\"/><axis xyz=\"0 0 1\"/></joint>\
         <loop name=\"r\" type=\"continuous\"><predecessor link=\"c\"><origin xyz=\"0 -1 0\"/></predecessor>\
         <successor link=\"a\"/><axis xyz=\"1 0 1\"/></loop></robot>";
    for text in [flap, turns] {
        let modes = told(text);
        assert_eq!(modes.complete, Complete::Proven);
        assert_eq!(modes.configurations.len(), 1);
        let only = &modes.configurations[0];
        assert!(only.drawn && only.proven);
        assert_eq!((only.multiplicity, only.finite), (Some(1), Some(0)));
    }
    let longer = flap.replace("-1 4 1", "-1 5 1");
    let open = told(&longer);
    assert_eq!(open.complete, Complete::Proven);
    assert!(open.configurations.is_empty());
    assert!(open.contradiction.unwrap().contains("`strut`"));
}

/// A crank held upright: the rocker stands to either side, and one of them is beyond its stop.
#[test]
fn configurations_beyond_a_limit_are_left_out_and_told() {
    let four_bar = |limit: &str| {
        format!(
            "<robot name=\"four\"><link name=\"g\"/><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\
             <joint name=\"crank\" type=\"fixed\"><parent link=\"g\"/><child link=\"a\"/></joint>\
             <joint name=\"p\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/><origin xyz=\"0 2 0\"/><axis xyz=\"0 0 1\"/></joint>\
             <joint name=\"rocker\" type=\"revolute\"><parent link=\"g\"/><child link=\"c\"/><origin xyz=\"4 0 0\"/><axis xyz=\"0 0 1\"/>{limit}</joint>\
             <loop name=\"q\" type=\"continuous\"><predecessor link=\"b\"><origin xyz=\"4 1 0\"/></predecessor>\
             <successor link=\"c\"><origin xyz=\"0 3 0\"/></successor><axis xyz=\"0 0 1\"/></loop></robot>"
        )
    };
    assert_eq!(told(&four_bar("")).configurations.len(), 2);
    let stopped = told(&four_bar("<limit lower=\"-1\" upper=\"1\"/>"));
    assert_eq!(stopped.complete, Complete::Proven);
    assert_eq!(
        (stopped.configurations.len(), stopped.left_out.len()),
        (1, 1)
    );
    assert!(stopped.configurations[0].drawn);
    let mechanism_joint = match stopped.left_out[0].why {
        Why::Limit { joint, value } => (joint.0, value.abs() > 1.0),
        other => panic!("{other:?}"),
    };
    assert_eq!(mechanism_joint, (2, true));
    // The drawn one may be beyond as well.
    let away = told(&four_bar("<limit lower=\"2\" upper=\"3\"/>"));
    assert_eq!(away.complete, Complete::Proven);
    assert!(away.configurations.iter().all(|c| !c.drawn));
    assert!(away.left_out.iter().any(|out| out.configuration.drawn));
}
