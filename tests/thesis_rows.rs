//! The worked examples of Ruiz (1994), row by row: dimension, what is free, what is fixed and where, number of pieces.
//!
//! The files of `tests/thesis` have the source's own frames and measures, so that the unknowns are the source's up to their
//! names, and the equations written here have to generate the very ideals of `tests/thesis/systems.json`. Canonical
//! relations of lines are oriented, the positional ones of the source are not: a line may be laid on another either way
//! round, so that numbers of pieces differ.

#[path = "thesis/row.rs"]
mod row;

use kutzbach::algebra::Formulation;
use row::{
    Row, answer_with, canonical, of_bodies, of_simple_joints, of_sleeves, of_the_block,
    of_the_plug, positional, shape,
};

#[test]
fn a_plug_on_lines_and_points() {
    let row = |file: &str| {
        Row::new(
            positional(&format!("tests/thesis/{file}.urdf")),
            of_the_plug,
        )
    };
    let line = row("plug_one_line");
    line.is("Ex1/DPH nc 1 line (3.9)");
    assert_eq!(shape(&line.answer), (Some(2), 2));
    line.free(&["Tx", "x33"]);

    // R = diag(∓1, ±1, −1), Ty = n = 3, Tz = −d = −4.
    let either: &[f64] = &[-1.0, 1.0];
    let turned = [
        ("x11", either),
        ("x12", &[0.0]),
        ("x13", &[0.0]),
        ("x21", &[0.0]),
        ("x22", either),
        ("x23", &[0.0]),
        ("x31", &[0.0]),
        ("x32", &[0.0]),
        ("x33", &[-1.0]),
        ("Ty", &[3.0]),
        ("Tz", &[-4.0]),
    ];
    let lines = row("plug_two_lines");
    lines.is("Ex1/DPH nc 2 lines (3.11)");
    assert_eq!(shape(&lines.answer), (Some(1), 2));
    lines.free(&["Tx"]);
    lines.fixed(&turned);
    lines.follows(&["x11 + x22"]);

    let point = row("plug_lines_and_point");
    point.is("Ex1/DPH nc +P1onP3 (3.12)");
    assert_eq!(shape(&point.answer), (Some(0), 2));
    // Tx = w ∓ c.
    point.fixed(&[&turned[..], &[("Tx", &[5.0, 9.0])]].concat());
    point.follows(&["2*x22 + 7 - Tx", "2*x11 - 7 + Tx"]);

    let points = row("plug_lines_and_points");
    points.is("Ex1/DPH nc +P2onP4 (3.13)");
    assert_eq!(shape(&points.answer), (None, 0));
}

#[test]
fn a_double_peg() {
    let row = Row::new(canonical("tests/thesis/double_peg.urdf"), |name| {
        of_sleeves("peg_", name)
    });
    row.is("Ex1/DPH canonical (4.12)");
    assert_eq!(shape(&row.answer), (Some(1), 1));
    row.free(&["x2"]);
    // θ1 = −90°, θ2 = 90°, x1 = x2 − c.
    row.fixed(&[
        ("c1", &[0.0]),
        ("s1", &[-1.0]),
        ("c2", &[0.0]),
        ("s2", &[1.0]),
    ]);
    row.follows(&["x1 - x2 + 2"]);
    // In other frames, and without regard to sense.
    let file = "mechanisms/double_peg_and_hole.urdf";
    assert_eq!(shape(&canonical(file)), (Some(1), 1));
    assert_eq!(shape(&positional(file)), (Some(1), 2));
}

#[test]
fn three_bodies_canonical() {
    let row = Row::new(canonical("tests/thesis/three_bodies.urdf"), |name| {
        of_sleeves("R", name)
    });
    row.is("Ex2 canonical (4.16)");
    assert_eq!(shape(&row.answer), (Some(2), 1));
    row.free(&["x3", "s3"]);
    row.fixed(&[("x1", &[0.0]), ("c1", &[1.0]), ("s1", &[0.0])]);
    row.follows(&["x2 + x3", "s2 + s3", "c2 - c3"]);
    assert_eq!(
        shape(&canonical("mechanisms/three_body_assembly.urdf")),
        (Some(2), 1)
    );
}

#[test]
fn three_bodies_positional() {
    let row = Row::new(positional("tests/thesis/three_bodies.urdf"), of_bodies);
    row.is("Ex2 non-canonical (4.13)");
    assert_eq!(shape(&row.answer), (Some(2), 4));
    row.free(&["D2_14", "D2_33"]);
    // The drawer stays at the identity or at the half turn about the upright line through (−1 5 0); the pin keeps to its line,
    // either way round.
    let either: &[f64] = &[-1.0, 1.0];
    row.fixed(&[
        ("D2_11", either),
        ("D2_12", &[0.0]),
        ("D2_13", &[0.0]),
        ("D2_21", &[0.0]),
        ("D2_31", &[0.0]),
        ("D2_24", &[5.0]),
        ("D2_34", &[2.0]),
        ("D3_11", either),
        ("D3_12", &[0.0]),
        ("D3_13", &[0.0]),
        ("D3_14", &[-2.0, 0.0]),
        ("D3_21", &[0.0]),
        ("D3_22", either),
        ("D3_23", &[0.0]),
        ("D3_24", &[0.0, 10.0]),
        ("D3_31", &[0.0]),
        ("D3_32", &[0.0]),
        ("D3_33", &[1.0]),
        ("D3_34", &[0.0]),
    ]);
    row.follows(&["D3_11 - D3_22", "5*D3_22 + D3_24 - 5", "5*D3_14 + D3_24"]);
    assert_eq!(
        shape(&positional("mechanisms/three_body_assembly.urdf")),
        (Some(2), 4)
    );
}

#[test]
fn block_and_corner() {
    let row = Row::new(
        positional("tests/thesis/block_and_corner.urdf"),
        of_the_block,
    );
    row.is("BC nc brute");
    assert_eq!(shape(&row.answer), (Some(0), 4));
    let either: &[f64] = &[-1.0, 1.0];
    row.fixed(&[
        ("x11", either),
        ("x12", &[0.0]),
        ("x13", &[0.0]),
        ("x21", &[0.0]),
        ("x22", either),
        ("x23", &[0.0]),
        ("x31", &[0.0]),
        ("x32", &[0.0]),
        ("x33", either),
        ("Tx", &[0.0]),
        ("Ty", &[0.0]),
        ("Tz", &[0.0]),
    ]);
    row.follows(&["x11 - x22*x33"]);
    let file = "mechanisms/block_and_corner.urdf";
    assert_eq!(shape(&positional(file)), (Some(0), 4));
    // In canonical form two balls count every pose four times.
    assert_eq!(shape(&canonical(file)).0, Some(0));
}

#[test]
fn thomas_and_torras_canonical() {
    let rows = [
        ("thomas_torras_offset", "T&T[C3//x] can brute"),
        ("thomas_torras_upright", "T&T[C3//z] can brute"),
    ];
    for (file, known) in rows {
        let answer = canonical(&format!("tests/thesis/{file}.urdf"));
        let row = Row::new(answer, |name| of_sleeves("C", name));
        row.is(known);
        assert_eq!(shape(&row.answer), (Some(2), 1));
        row.free(&["x6", "s6"]);
        let (zero, one): (&[f64], &[f64]) = (&[0.0], &[1.0]);
        let names = ["x1", "s1", "x2", "s2", "x3", "s3"].map(|name| (name, zero));
        let cosines = ["c1", "c2", "c3"].map(|name| (name, one));
        row.fixed(&[&names[..], &cosines].concat());
        row.follows(&[
            "x4 + x6", "x5 + x6", "s4 + s6", "s5 + s6", "c4 - c6", "c5 - c6",
        ]);
    }
    assert_eq!(
        shape(&canonical("mechanisms/thomas_torras_assembly.urdf")),
        (Some(2), 1)
    );
}

#[test]
fn thomas_and_torras_positional() {
    // The source does not say which way the joint of the two bodies runs: with the number of pieces that it has, along x.
    let rows = [
        ("thomas_torras_offset", "T&T[C3//x] nc brute", 4),
        ("thomas_torras_upright", "T&T[C3//z] nc brute", 2),
    ];
    for (file, known, pieces) in rows {
        let answer = positional(&format!("tests/thesis/{file}.urdf"));
        let row = Row::new(answer, of_bodies);
        row.is(known);
        assert_eq!(shape(&row.answer), (Some(2), pieces));
        row.free(&["D4_14", "D4_33"]);
        row.follows(&[
            "D4_24 - 5",
            "D4_34 - 2",
            "D3_11 - D3_22",
            "D2_11 - D2_22",
            "D2_11 - D3_11",
        ]);
    }
    // Where the pin meets the slides, jaws can be turned over in more ways.
    let answer = positional("mechanisms/thomas_torras_assembly.urdf");
    assert_eq!(shape(&answer), (Some(2), 16));
}

/// The source writes a line on a plane as twix(θ) XTOY trans(0, y, z) twix(φ), with the quarter turn about z; here that turn is
/// about −y. So θ = θ' + 90°, φ = φ' − 90°, y = z', z = −y'. The plane on the plane runs from the top to the bed, because the
/// source turns before it slides: θ7, y7, z7 change sign.
fn of_the_table(name: &str) -> String {
    let (kind, number) = name.split_at(name.len() - 1);
    let line_on_plane = matches!(number, "1" | "2" | "3" | "4");
    match (kind, line_on_plane) {
        ("ct", true) => format!("-sin(C{number}.rot1)"),
        ("st", true) => format!("cos(C{number}.rot1)"),
        ("cp", true) => format!("sin(C{number}.rot2)"),
        ("sp", true) => format!("-cos(C{number}.rot2)"),
        ("y", true) => format!("C{number}.trans2"),
        ("z", true) => format!("-C{number}.trans1"),
        ("st", _) if number == "7" => "-sin(C7.rot)".to_owned(),
        ("y", _) => format!("-C{number}.trans1"),
        ("z", _) => format!("-C{number}.trans2"),
        ("x", _) => format!("C{number}.trans"),
        ("st", _) => format!("sin(C{number}.rot)"),
        _ => format!("cos(C{number}.rot)"),
    }
}

#[test]
fn cartesian_table() {
    let row = Row::new(canonical("tests/thesis/cartesian_table.urdf"), of_the_table);
    row.is("CT can brute (5.7)");
    assert_eq!(shape(&row.answer), (Some(3), 8));
    row.free(&["z4", "y7", "z7"]);
    let either: &[f64] = &[-1.0, 1.0];
    let zero: &[f64] = &[0.0];
    // θ5 = −90°, θ6 = 90°, θ8 = θ9 = 0, x5 = 1, x6 = −1, x8 = x9 = 2; the other angles are quarter turns either way.
    let crossed = [
        "cp1", "ct1", "st2", "sp2", "cp3", "st3", "ct4", "sp4", "ct7", "ct5", "ct6",
    ];
    let crossed = crossed.map(|name| (name, zero));
    let turned = [
        "sp1", "st1", "ct2", "cp2", "sp3", "ct3", "st4", "cp4", "st7",
    ];
    let turned = turned.map(|name| (name, either));
    let table: [(&str, &[f64]); 10] = [
        ("st5", &[-1.0]),
        ("st6", &[1.0]),
        ("st8", &[0.0]),
        ("ct8", &[1.0]),
        ("st9", &[0.0]),
        ("ct9", &[1.0]),
        ("x5", &[1.0]),
        ("x6", &[-1.0]),
        ("x8", &[2.0]),
        ("x9", &[2.0]),
    ];
    row.fixed(&[&crossed[..], &turned, &table].concat());
    assert_eq!(row.answer.dimension_at_home(), Some(3));

    let answer = canonical("mechanisms/cartesian_table.urdf");
    assert_eq!(shape(&answer), (Some(3), 8));
    let home = answer.pieces.iter().map(|piece| piece.contains_home);
    assert_eq!(home.filter(|on| *on == Some(true)).count(), 1);
    // Two cycles hold the bars of the cross together.
    let clusters: usize = answer.cycles.iter().map(|cycle| cycle.clusters.len()).sum();
    assert_eq!(clusters, 2);
}

#[test]
fn oldham_coupling() {
    let row = Row::new(canonical("tests/thesis/oldham.urdf"), of_simple_joints);
    row.is("Oldham (7.5)");
    assert_eq!(shape(&row.answer), (Some(1), 1));
    row.free(&["s4"]);
    row.free(&["c4"]);
    row.fixed(&[]);
    row.follows(&["x1 + 3*s4", "x2 + 3*c4", "s3 - s4", "c3 + c4"]);
    for file in ["mechanisms/oldham.urdf", "mechanisms/oldham_measures.urdf"] {
        assert_eq!(shape(&canonical(file)), (Some(1), 1), "{file}");
    }
    // A wrong length along the shafts.
    let wrong = [
        ("tests/thesis/oldham.urdf", "40"),
        ("mechanisms/oldham_measures.urdf", "0.1"),
    ];
    for (file, length) in wrong {
        let answer = answer_with(file, &[("L12", length)], Formulation::Canonical);
        assert_eq!(shape(&answer), (None, 0));
        assert!(answer.basis.unwrap().is_inconsistent());
    }
}

#[test]
fn oldham_with_sleeves_in_the_grooves() {
    let file = "tests/thesis/oldham_cylindrical_centre_heights.urdf";
    let row = Row::new(canonical(file), |name| match name {
        "s3" | "c3" | "s4" | "c4" => of_simple_joints(name),
        _ => of_sleeves("R", name),
    });
    row.is("Oldham var1 (7.6)");
    assert_eq!(shape(&row.answer), (Some(1), 1));
    row.free(&["c4"]);
    // θ1 = 0, θ2 = −90°.
    row.fixed(&[
        ("s1", &[0.0]),
        ("c1", &[1.0]),
        ("s2", &[-1.0]),
        ("c2", &[0.0]),
    ]);
    row.follows(&["x1 + 3*s4", "x2 + 3*c4", "s3 - s4", "c3 + c4"]);
    // With the grooves at one height the disc can be put in upside down as well.
    let level = answer_with(file, &[("L7", "0"), ("L12", "34")], Formulation::Canonical);
    assert_eq!(shape(&level), (Some(1), 2));
    assert_eq!(
        shape(&canonical("mechanisms/oldham_cylindrical_centre.urdf")),
        (Some(1), 2)
    );
}

#[test]
fn oldham_with_sliding_shafts() {
    let row = Row::new(
        canonical("tests/thesis/oldham_cylindrical_shafts.urdf"),
        |name| match name {
            "x1" | "x2" => of_simple_joints(name),
            _ => of_sleeves("R", name),
        },
    );
    row.is("Oldham var2 (7.7)");
    assert_eq!(shape(&row.answer), (Some(2), 1));
    row.free(&["x4", "s4"]);
    row.fixed(&[]);
    row.follows(&[
        "x3 + x4 - 39",
        "x1 + 3*s4",
        "x2 + 3*c4",
        "s3 - s4",
        "c3 + c4",
    ]);
    assert_eq!(
        shape(&canonical("mechanisms/oldham_cylindrical_shafts.urdf")),
        (Some(2), 1)
    );
}

#[test]
fn oldham_with_parallel_grooves() {
    let file = "tests/thesis/oldham_parallel_grooves.urdf";
    let row = Row::new(canonical(file), of_simple_joints);
    row.is("Oldham var3 (7.8)");
    assert_eq!(shape(&row.answer), (Some(1), 2));
    row.free(&["x2"]);
    // θ4 = ±90°, and θ3 is 180° or 0.
    let either: &[f64] = &[-1.0, 1.0];
    row.fixed(&[
        ("c4", &[0.0]),
        ("s4", either),
        ("c3", either),
        ("s3", &[0.0]),
    ]);
    row.follows(&["c3 + s4", "x1 + x2 + 3*s4"]);
    assert_eq!(
        shape(&canonical("mechanisms/oldham_parallel_grooves.urdf")),
        (Some(1), 2)
    );
}

#[test]
fn four_hinges_on_two_lines() {
    let file = "tests/thesis/four_hinges_two_circles.urdf";
    let row = Row::new(canonical(file), of_simple_joints);
    row.is("4R thesis 'Bennett' (7.11)");
    assert_eq!(shape(&row.answer), (Some(1), 2));
    // Each on one of the circles.
    row.free(&["s4"]);
    row.free(&["s3"]);
    row.fixed(&[]);
    row.follows(&[
        "c3*c4 + c3 + c4 + 1",
        "s3*s4",
        "s1 + s3",
        "c1 - c3",
        "s2 + s4",
        "c2 - c4",
    ]);
    let degrees = row.answer.pieces.iter().map(|piece| piece.component.degree);
    assert!(degrees.eq([Some(2), Some(2)]));
    assert_eq!(
        shape(&canonical("mechanisms/four_bar_two_circles.urdf")),
        (Some(1), 2)
    );
}

#[test]
fn four_hinges_that_stand_still() {
    let file = "tests/thesis/four_hinges_structure.urdf";
    let row = Row::new(canonical(file), of_simple_joints);
    row.is("4R structure (7.12)");
    assert_eq!(shape(&row.answer), (Some(0), 2));
    let solutions = row.answer.solutions.as_ref().unwrap();
    assert_eq!((solutions.complex, solutions.real.len()), (2, 2));
    row.fixed(&[
        ("c4", &[-1.0, 1.0]),
        ("s4", &[0.0]),
        ("c2", &[-1.0, 1.0]),
        ("s2", &[0.0]),
        ("c1", &[-0.8, 0.0]),
        ("s1", &[-1.0, -0.6]),
        ("c3", &[-0.8, 0.0]),
        ("s3", &[0.6, 1.0]),
    ]);
    row.follows(&[
        "5*s1 + c4 + 4",
        "5*c1 - 2*c4 + 2",
        "c2 - c4",
        "5*s3 - c4 - 4",
        "c1 - c3",
    ]);
    assert_eq!(
        shape(&canonical("mechanisms/four_bar_crossing_axes.urdf")),
        (Some(0), 2)
    );
}

#[test]
fn four_hinges_with_a_washer() {
    let file = "tests/thesis/four_hinges_coaxial_link.urdf";
    let row = Row::new(canonical(file), of_simple_joints);
    row.is("4R coaxial link (7.13)");
    assert_eq!(shape(&row.answer), (Some(1), 1));
    row.free(&["s4"]);
    // θ2 = θ3 = 90°, θ1 = π − θ4.
    row.fixed(&[
        ("c2", &[0.0]),
        ("s2", &[1.0]),
        ("c3", &[0.0]),
        ("s3", &[1.0]),
    ]);
    row.follows(&["c1 + c4", "s1 - s4"]);
    let answer = canonical("mechanisms/four_bar_coaxial_link.urdf");
    assert_eq!((shape(&answer), answer.fixed.len()), ((Some(1), 1), 4));
}

#[test]
fn genuine_bennett() {
    let row = Row::new(canonical("tests/thesis/bennett.urdf"), of_simple_joints);
    row.is("Bennett genuine 4:3");
    assert_eq!(shape(&row.answer), (Some(1), 1));
    assert_eq!(row.answer.pieces[0].component.degree, Some(4));
    row.free(&["s4"]);
    row.fixed(&[]);
    row.follows(&[
        // (tan θ3/2 · tan θ4/2)² = 25 with tan² θ/2 = (1 − c)/(1 + c): (1 − c3)(1 − c4) = 25 (1 + c3)(1 + c4).
        "24*c3*c4 + 26*c3 + 26*c4 + 24",
        // Of the two roots it is 5, with tan θ/2 = s/(1 + c): s3 s4 = 5 (1 + c3)(1 + c4).
        "s3*s4 - 5*c3*c4 - 5*c3 - 5*c4 - 5",
        "c1 - c3",
        "s1 - s3",
        "c2 - c4",
        "s2 - s4",
    ]);
    let own = canonical("mechanisms/bennett.urdf");
    assert_eq!(shape(&own), (Some(1), 1));
    assert_eq!(own.pieces[0].component.degree, Some(4));
    assert!(own.fixed.is_empty());
}

#[test]
fn complex_freedom_is_not_motion() {
    let answer = canonical("mechanisms/four_bar_stretched.urdf");
    assert_eq!(answer.dimension, Some(Some(1)));
    assert_eq!(answer.dimension_at_home(), Some(1));
}
