//! Decompositions of sets that are put together from known pieces.

#![allow(clippy::unwrap_used)]

use super::*;
use crate::Limits;
use crate::engine::radical_contains;
use proptest::prelude::*;

const N: usize = 3;

fn variable(index: usize) -> Polynomial {
    Polynomial::variable(index, N)
}

fn integer(value: i64) -> Polynomial {
    Polynomial::integer(value, N)
}

fn names() -> Vec<String> {
    ["x", "y", "z"].map(str::to_owned).to_vec()
}

fn decompose(equations: &[Polynomial], hints: &Hints) -> Decomposition {
    components(equations, N, hints, &Budget::unlimited()).unwrap()
}

fn pieces(equations: &[Polynomial]) -> Vec<(usize, Vec<String>)> {
    let found = decompose(equations, &Hints::default());
    assert!(found.complete);
    let text = |p: &Polynomial| p.text(&names());
    found
        .pieces
        .iter()
        .map(|piece| (piece.dimension, piece.equations.iter().map(text).collect()))
        .collect()
}

fn strings(texts: &[&str]) -> Vec<String> {
    texts.iter().map(|&t| t.to_owned()).collect()
}

/// x·y = x·z = 0: a plane and a line that meets it.
#[test]
fn plane_and_line() {
    let (x, y, z) = (variable(0), variable(1), variable(2));
    let found = pieces(&[&x * &y, &x * &z]);
    assert_eq!(found, [(2, strings(&["x"])), (1, strings(&["z", "y"]))]);
    // With a point in the plane, which is no piece of its own, and one outside.
    let one = integer(1);
    let inside = pieces(&[&(&x * &y) * &y, &x * &z, &(&x * &y) * &(&x - &one)]);
    assert_eq!(inside, [(2, strings(&["x"])), (1, strings(&["z", "y"]))]);
    let outside = pieces(&[&x * &(&x - &one), &x * &(&y - &one), &x * &(&z - &one)]);
    assert_eq!(
        outside,
        [
            (2, strings(&["x"])),
            (0, strings(&["z - 1", "y - 1", "x - 1"]))
        ]
    );
}

/// y² = x² + 16 is irreducible although it splits over x = 3: that no single value decides is what two are for.
#[test]
fn special_values_do_not_mislead() {
    let (x, y, z) = (variable(0), variable(1), variable(2));
    let curve = &(&y * &y) - &(&(&x * &x) + &integer(16));
    assert_eq!(pieces(&[curve.clone(), z.clone()]).len(), 1);
    // z² = 2 and y² = 2x² are the lines y = zx and y = -zx; neither equation factors.
    let two = &(&z * &z) - &integer(2);
    let twisted = &(&y * &y) - &(&x * &x).scaled(&Rational::from_integer(2.into()));
    let found = decompose(&[two, twisted], &Hints::default());
    assert!(found.complete);
    assert_eq!(found.pieces.len(), 2);
    assert!(found.pieces.iter().all(|p| p.dimension == 1));
    assert!(found.pieces.iter().all(|p| p.degree == Some(2)));
}

/// Only two branches through the point (0, 0) over z: y² = x²·(x + 1) is one piece though it crosses itself.
#[test]
fn a_curve_with_a_node_is_one_piece() {
    let (x, y, z) = (variable(0), variable(1), variable(2));
    let node = &(&y * &y) - &(&(&x * &x) * &(&x + &integer(1)));
    let found = decompose(&[node, z], &Hints::default());
    assert_eq!(found.pieces.len(), 1);
    assert_eq!(found.pieces[0].irreducible, Irreducible::Yes);
    assert_eq!(found.pieces[0].real, RealPoints::FullDimension);
    assert_eq!(found.pieces[0].degree, Some(3));
}

#[test]
fn repeated_equations_make_no_pieces() {
    let (x, y, z) = (variable(0), variable(1), variable(2));
    let circle = &(&(&x * &x) + &(&y * &y)) - &integer(1);
    // The circle twice; and a double structure that no single equation shows as a power.
    assert_eq!(pieces(&[circle.power(2), z.clone()]).len(), 1);
    let hidden = [
        &z * &z,
        &(&z * &x) - &(&circle * &y),
        &z * &circle,
        circle.power(2),
    ];
    let found = pieces(&hidden);
    assert_eq!(found, [(1, strings(&["z", "x^2 + y^2 - 1"]))]);
}

#[test]
fn real_points_are_told_from_complex_ones() {
    let (x, y, z) = (variable(0), variable(1), variable(2));
    let squares = &(&x * &x) + &(&y * &y);
    let real = |equations: &[Polynomial]| decompose(equations, &Hints::default()).pieces[0].real;
    assert_eq!(real(&[&squares + &integer(1), z.clone()]), RealPoints::None);
    assert_eq!(
        real(&[&squares - &integer(1), z.clone()]),
        RealPoints::FullDimension
    );
    // A pair of complex lines with one real point.
    assert_eq!(real(&[squares.clone(), z.clone()]), RealPoints::Some);
    assert_eq!(
        real(&[&squares + &integer(1), &x - &y, z.clone()]),
        RealPoints::Finite(0)
    );
    assert_eq!(
        real(&[&squares - &integer(1), &x - &y, z]),
        RealPoints::Finite(2)
    );
}

/// z stands for √2 and not for -√2: x² = z has real solutions, x² = -z has none.
#[test]
fn algebraic_numbers_are_the_right_roots() {
    let (x, y, z) = (variable(0), variable(1), variable(2));
    let root = &(&z * &z) - &integer(2);
    let hints = Hints {
        numbers: vec![AlgebraicNumber {
            variable: 2,
            low: Rational::from_integer(1.into()),
            high: Rational::from_integer(2.into()),
        }],
        ..Hints::default()
    };
    let real = |equation: &Polynomial| {
        let equations = [root.clone(), equation.clone(), y.clone()];
        decompose(&equations, &hints).pieces[0].real
    };
    assert_eq!(real(&(&(&x * &x) - &z)), RealPoints::Finite(2));
    assert_eq!(real(&(&(&x * &x) + &z)), RealPoints::Finite(0));
    // And over a free variable.
    let free = |equation: Polynomial| decompose(&[root.clone(), equation], &hints).pieces[0].real;
    let squares = &(&x * &x) + &(&y * &y);
    assert_eq!(free(&squares - &z), RealPoints::FullDimension);
    assert_eq!(free(&squares + &z), RealPoints::NotFound);
}

/// What is between -1 and 1 does not reach farther, with or without squares; what is no angle may reach anywhere.
#[test]
fn cosines_do_not_reach_far() {
    let (x, y, z) = (variable(0), variable(1), variable(2));
    let hints = Hints {
        angles: vec![(0, 1)],
        ..Hints::default()
    };
    let real = |equation: &Polynomial| {
        let circle = &(&(&x * &x) + &(&y * &y)) - &integer(1);
        decompose(&[circle, equation.clone()], &hints).pieces[0].real
    };
    // z·x and z reach anywhere.
    assert_eq!(real(&(&(&z * &x) - &integer(9))), RealPoints::FullDimension);
    let square = &(&z * &z) - &integer(2);
    assert_eq!(real(&(&square - &x)), RealPoints::FullDimension);
    assert_eq!(real(&(&square + &integer(3))), RealPoints::None);
    // Four angles, and four bars that are too long to close: one equation shows it.
    let n = 4;
    let v = |i| Polynomial::variable(i, n);
    let unit = |i| &(&v(i).power(2) + &v(i + 1).power(2)) - &Polynomial::one(n);
    let hints = Hints {
        angles: vec![(0, 1), (2, 3)],
        ..Hints::default()
    };
    for (value, expected) in [
        (1, RealPoints::FullDimension),
        (3, RealPoints::None),
        (-2, RealPoints::None),
    ] {
        let equation = &(&v(0).power(2) + &v(2)) - &Polynomial::integer(value, n);
        let equations = [unit(0), unit(2), equation];
        let found = components(&equations, n, &hints, &Budget::unlimited()).unwrap();
        assert!(found.pieces.iter().all(|p| p.real == expected), "{value}");
    }
}

#[test]
fn known_points_show_where_to_look() {
    let (x, y, z) = (variable(0), variable(1), variable(2));
    // A small circle far away from the values that are tried.
    let far = &x - &integer(1000);
    let circle = &(&(&far * &far) + &(&y * &y))
        - &Polynomial::constant(Rational::new(1.into(), 100.into()), N);
    let equations = [circle, z];
    assert_eq!(
        decompose(&equations, &Hints::default()).pieces[0].real,
        RealPoints::FullDimension
    );
    let both = &(&(&y - &integer(999)) * &(&y - &integer(999))) + &(&far * &far);
    let circle = &both - &Polynomial::constant(Rational::new(1.into(), 100.into()), N);
    let equations = [circle, variable(2)];
    assert_eq!(
        decompose(&equations, &Hints::default()).pieces[0].real,
        RealPoints::NotFound
    );
    let hints = Hints {
        points: vec![vec![1000.05, 999.05, 0.0]],
        ..Hints::default()
    };
    assert_eq!(
        decompose(&equations, &hints).pieces[0].real,
        RealPoints::FullDimension
    );
}

#[test]
fn contradictions_have_no_pieces_and_no_equations_all_space() {
    let x = variable(0);
    let none = decompose(&[x.clone(), &x - &integer(1)], &Hints::default());
    assert!(none.pieces.is_empty() && none.complete);
    let all = decompose(&[], &Hints::default());
    assert_eq!(all.pieces.len(), 1);
    assert_eq!((all.pieces[0].dimension, all.complete), (N, true));
    assert_eq!(all.pieces[0].real, RealPoints::FullDimension);
}

#[test]
fn a_spent_budget_gives_what_was_found() {
    let (x, y, z) = (variable(0), variable(1), variable(2));
    let equations = [
        &(&x * &x) - &integer(1),
        &(&y * &y) - &integer(1),
        &(&z * &z) - &integer(1),
    ];
    let with = |work| {
        let limits = Limits {
            work: Some(work),
            ..Limits::default()
        };
        components(&equations, N, &Hints::default(), &Budget::new(limits))
    };
    let mut partial = 0;
    for work in (0..20_000).step_by(500) {
        match with(work) {
            Err(stop) => assert_eq!(stop, Stop::Work),
            Ok(found) if found.complete => assert_eq!(found.pieces.len(), 8),
            Ok(found) => {
                partial += 1;
                assert_eq!(found.why, Some(Incomplete::Stopped(Stop::Work)));
                // All eight points are in some piece.
                for signs in 0..8 {
                    let at = |i: usize| {
                        Rational::from_integer(if signs >> i & 1 == 1 { 1 } else { -1 }.into())
                    };
                    let point = [at(0), at(1), at(2)];
                    let on =
                        |p: &Polynomial| p.value_at(&point) == Rational::from_integer(0.into());
                    assert!(found.pieces.iter().any(|piece| piece.contains_point(&on)));
                }
            }
        }
    }
    assert!(partial > 0);
}

/// Equations of a point, a line, a plane, a circle or a sphere.
fn block() -> impl Strategy<Value = Vec<Polynomial>> {
    (0_usize..5, -2_i64..3, -2_i64..3, -2_i64..3).prop_map(|(kind, a, b, c)| {
        let (x, y, z) = (variable(0), variable(1), variable(2));
        let from = |v: &Polynomial, value: i64| v - &integer(value);
        let (dx, dy, dz) = (from(&x, a), from(&y, b), from(&z, c));
        let circle = &(&(&dx * &dx) + &(&dy * &dy)) - &integer(1);
        match kind {
            0 => vec![dx, dy, dz],
            1 => vec![&dx - &dy, &dz + &dx],
            2 => vec![&(&dx + &dy) - &z],
            3 => vec![circle, dz],
            _ => vec![&circle + &(&dz * &dz)],
        }
    })
}

/// The equations of a union: all products of an equation of each.
fn union(blocks: &[Vec<Polynomial>]) -> Vec<Polynomial> {
    blocks.iter().fold(vec![integer(1)], |products, block| {
        let product = |p: &Polynomial| block.iter().map(|q| p * q).collect::<Vec<_>>();
        products.iter().flat_map(product).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn unions_fall_apart_into_their_blocks(blocks in proptest::collection::vec(block(), 1..4)) {
        let alone = |block: &[Polynomial]| {
            let found = decompose(block, &Hints::default());
            prop_assert_eq!(found.pieces.len(), 1);
            Ok(found.pieces[0].clone())
        };
        let budget = Budget::unlimited();
        let mut expected: Vec<Component> = Vec::new();
        for (i, block) in blocks.iter().enumerate() {
            let piece = alone(block)?;
            let mut contained = false;
            for (j, other) in blocks.iter().enumerate() {
                let inside = other.iter().all(|p| radical_contains(block, N, p, &budget).unwrap());
                let same = block.iter().all(|p| radical_contains(other, N, p, &budget).unwrap());
                contained |= inside && (!same || j < i);
            }
            if !contained {
                expected.push(piece);
            }
        }
        let found = decompose(&union(&blocks), &Hints::default());
        prop_assert!(found.complete);
        prop_assert_eq!(found.pieces.len(), expected.len());
        for piece in expected {
            prop_assert!(found.pieces.contains(&piece), "{:?} is missing", piece);
        }
    }
}
