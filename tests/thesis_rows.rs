//! The worked examples of Ruiz (1994), from mechanism files: dimension, number of pieces, what is free, what is fixed.
//!
//! Canonical relations of lines are oriented, the positional ones of the source are not (a line may be laid on another
//! either way round), so that numbers of pieces differ.

#![allow(clippy::unwrap_used)]

use kutzbach::algebra::{
    Budget, ExactAnswer, ExactOptions, Formulation, Limits, SystemOptions, exact_answer,
};
use kutzbach::format::{Reading, read_file};
use std::path::Path;

fn read(file: &str, settings: &[(&str, &str)]) -> Reading {
    let settings: Vec<(String, String)> = settings
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    read_file(&path, &settings).unwrap()
}

fn answer_with(file: &str, settings: &[(&str, &str)], formulation: Formulation) -> ExactAnswer {
    let options = ExactOptions {
        system: SystemOptions {
            formulation,
            unoriented: formulation == Formulation::Positional,
            ..SystemOptions::default()
        },
        ..ExactOptions::default()
    };
    // Generous: a slow machine must not fail a test of mathematics.
    let budget = Budget::new(Limits::seconds(300.0));
    let answer = exact_answer(&read(file, settings).mechanism, &options, &budget).unwrap();
    assert_eq!(answer.stopped, None, "{file}");
    answer
}

fn canonical(file: &str) -> ExactAnswer {
    answer_with(file, &[], Formulation::Canonical)
}

fn positional(file: &str) -> ExactAnswer {
    answer_with(file, &[], Formulation::Positional)
}

/// Dimension and number of pieces, all of which must be proven irreducible.
fn shape(answer: &ExactAnswer) -> (Option<usize>, usize) {
    assert!(answer.decomposed);
    (answer.dimension.unwrap(), answer.pieces.len())
}

fn fixed(answer: &ExactAnswer) -> Vec<&str> {
    answer
        .fixed
        .iter()
        .map(|f| answer.system.variables[f.variable].name.as_str())
        .collect()
}

/// Whether some largest set of free variables consists of these.
fn can_be_free(answer: &ExactAnswer, wanted: &[&str]) -> bool {
    answer.free.iter().any(|set| {
        let names: Vec<&str> = set
            .iter()
            .map(|&v| answer.system.variables[v].name.as_str())
            .collect();
        names == wanted
    })
}

#[test]
fn plug_on_lines_and_points() {
    let rows = [
        ("tests/thesis/plug_one_line.urdf", (Some(2), 2)),
        ("tests/thesis/plug_two_lines.urdf", (Some(1), 2)),
        ("tests/thesis/plug_lines_and_point.urdf", (Some(0), 2)),
        ("tests/thesis/plug_lines_and_points.urdf", (None, 0)),
    ];
    for (file, expected) in rows {
        assert_eq!(shape(&positional(file)), expected, "{file}");
    }
    let two_lines = positional("tests/thesis/plug_two_lines.urdf");
    assert!(can_be_free(&two_lines, &["Tx(plug)"]));
    assert_eq!(fixed(&two_lines).len(), 11);
}

#[test]
fn double_peg_and_hole() {
    let answer = canonical("mechanisms/double_peg_and_hole.urdf");
    assert_eq!(shape(&answer), (Some(1), 1));
    // Both angles are fixed, and one slide follows the other.
    assert_eq!(fixed(&answer).len(), 4);
    assert_eq!(
        shape(&positional("mechanisms/double_peg_and_hole.urdf")),
        (Some(1), 2)
    );
}

#[test]
fn three_bodies() {
    let answer = canonical("mechanisms/three_body_assembly.urdf");
    assert_eq!(shape(&answer), (Some(2), 1));
    // x1 = θ1 = 0.
    assert_eq!(fixed(&answer).len(), 3);
    assert_eq!(
        shape(&positional("mechanisms/three_body_assembly.urdf")),
        (Some(2), 4)
    );
}

#[test]
fn block_and_corner() {
    assert_eq!(
        shape(&positional("mechanisms/block_and_corner.urdf")),
        (Some(0), 4)
    );
    // In canonical form two balls count every pose four times.
    assert_eq!(
        shape(&canonical("mechanisms/block_and_corner.urdf")).0,
        Some(0)
    );
}

#[test]
fn thomas_and_torras() {
    let answer = canonical("mechanisms/thomas_torras_assembly.urdf");
    assert_eq!(shape(&answer), (Some(2), 1));
    // x1..x3 = θ1..θ3 = 0: three variables each.
    assert_eq!(fixed(&answer).len(), 9);
    assert_eq!(
        shape(&positional("mechanisms/thomas_torras_assembly.urdf")).0,
        Some(2)
    );
}

#[test]
fn cartesian_table() {
    let answer = canonical("mechanisms/cartesian_table.urdf");
    assert_eq!(shape(&answer), (Some(3), 8));
    let home: Vec<bool> = answer
        .pieces
        .iter()
        .map(|piece| piece.contains_home.unwrap())
        .collect();
    assert_eq!(home.iter().filter(|on| **on).count(), 1);
    assert_eq!(answer.dimension_at_home(), Some(3));
    // Two cycles hold the bars of the cross together.
    let clusters: usize = answer.cycles.iter().map(|cycle| cycle.clusters.len()).sum();
    assert_eq!(clusters, 2);
}

#[test]
fn oldham_couplings() {
    let rows = [
        ("mechanisms/oldham.urdf", (Some(1), 1)),
        ("mechanisms/oldham_measures.urdf", (Some(1), 1)),
        ("mechanisms/oldham_cylindrical_shafts.urdf", (Some(2), 1)),
        ("mechanisms/oldham_parallel_grooves.urdf", (Some(1), 2)),
    ];
    for (file, expected) in rows {
        assert_eq!(shape(&canonical(file)), expected, "{file}");
    }
    let cylindrical = canonical("mechanisms/oldham_cylindrical_centre.urdf");
    assert_eq!(cylindrical.dimension, Some(Some(1)));
    let wrong = answer_with(
        "mechanisms/oldham_measures.urdf",
        &[("L12", "0.1")],
        Formulation::Canonical,
    );
    assert_eq!(shape(&wrong), (None, 0));
}

#[test]
fn four_hinges() {
    let rows = [
        ("mechanisms/four_bar_two_circles.urdf", (Some(1), 2)),
        ("mechanisms/four_bar_crossing_axes.urdf", (Some(0), 2)),
        ("mechanisms/four_bar_coaxial_link.urdf", (Some(1), 1)),
        ("mechanisms/bennett.urdf", (Some(1), 1)),
    ];
    for (file, expected) in rows {
        assert_eq!(shape(&canonical(file)), expected, "{file}");
    }
    let bennett = canonical("mechanisms/bennett.urdf");
    assert_eq!(bennett.pieces[0].component.degree, Some(4));
    assert!(fixed(&bennett).is_empty());
    // Both angles of the coaxial loop's elbow and wrist stand still.
    assert_eq!(
        fixed(&canonical("mechanisms/four_bar_coaxial_link.urdf")).len(),
        4
    );
}

#[test]
fn complex_freedom_is_not_motion() {
    let answer = canonical("mechanisms/four_bar_stretched.urdf");
    assert_eq!(answer.dimension, Some(Some(1)));
    assert_eq!(answer.dimension_at_home(), Some(1));
}
