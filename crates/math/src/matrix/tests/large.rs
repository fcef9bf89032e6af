//! Chains and lattices of loops, against the prime field and against each other.

use std::time::Instant;

use super::super::{
    Big, Field61, Method, SparseMatrix, coloops, decide, decide_by_qr, decide_by_singular_values,
    factor_modular, modular_rank, null_vectors, null_vectors_by_qr,
};
use super::{Geometry, Loops, integer_screws, regular_lattice_screws};

fn real(loops: &Loops, screws: &[[i64; 6]]) -> SparseMatrix<f64> {
    let screws: Vec<[f64; 6]> = screws.iter().map(|s| s.map(|x| x as f64)).collect();
    let mut matrix = loops.jacobian(0.0, &screws);
    matrix.scale_columns();
    matrix
}

fn modular(loops: &Loops, screws: &[[i64; 6]]) -> SparseMatrix<Field61> {
    let screws: Vec<[Field61; 6]> = screws
        .iter()
        .map(|s| s.map(|x| Field61::new(i128::from(x))))
        .collect();
    loops.jacobian(Field61::ZERO, &screws)
}

/// Real ranks by both routes, of the matrix and of its transpose, against the exact one.
fn check_ranks(loops: &Loops, screws: &[[i64; 6]], what: &str) -> usize {
    let (matrix, field) = (real(loops, screws), modular(loops, screws));
    let exact = modular_rank(&field);
    assert_eq!(modular_rank(&field.transpose()), exact);
    let by_values = decide_by_singular_values(&matrix, 0.0).unwrap();
    let (by_qr, _) = decide_by_qr(&matrix, 0.0).unwrap();
    let (left, _) = decide_by_qr(&matrix.transpose(), 0.0).unwrap();
    for decision in [by_values, by_qr, left] {
        assert_eq!(decision.rank, Some(exact), "{what} {decision:?}");
    }
    loops.joints - exact
}

#[test]
fn real_and_modular_ranks_agree_on_integer_geometry() {
    for loops in [
        Loops::chain(1),
        Loops::chain(40),
        Loops::chain(10).with_freedom(2),
        Loops::lattice(4),
        Loops::lattice(9),
        Loops::lattice(5).with_freedom(2),
        Loops::lattice(5).with_freedom(3),
    ] {
        for geometry in [Geometry::Planar, Geometry::Spherical, Geometry::Spatial] {
            for seed in 0..3 {
                let screws = integer_screws(loops.joints, geometry, seed);
                check_ranks(&loops, &screws, &format!("{geometry:?} {seed}"));
            }
        }
    }
}

#[test]
fn lattices_of_parallelograms_have_one_freedom() {
    // Links on the nodes, hinged to their neighbours halfway: all turn together, neighbours in
    // opposite senses.
    for side in [2, 3, 5, 10] {
        let screws = regular_lattice_screws(side);
        let freedoms = check_ranks(&Loops::lattice(side), &screws, &format!("side {side}"));
        assert_eq!(freedoms, 1);
    }
    // A large one, whose transpose alone would leave doubt: thousands of dropped columns amplify
    // rounding errors.
    let lattice = Loops::lattice(30);
    let matrix = real(&lattice, &regular_lattice_screws(30));
    let decision = decide(&matrix, 0.0).unwrap();
    assert_eq!(decision.nullity(), Some(1), "{decision:?}");
    let transposed = matrix.transpose();
    let left = decide(&transposed, 0.0).unwrap();
    assert_eq!(left.rank, decision.rank, "{left:?}");
    let null = null_vectors(&matrix, &decision, 1, 0).unwrap();
    assert!(null.residual < 1e-12);
    let stresses = null_vectors(&transposed, &left, 3, 0).unwrap();
    assert!(stresses.residual < 1e-10 && stresses.nullity == 6 * 841 - 1739);
}

#[test]
fn many_digits_agree_on_a_lattice() {
    let loops = Loops::lattice(5);
    let screws = integer_screws(loops.joints, Geometry::Planar, 1);
    let big: Vec<[Big; 6]> = screws
        .iter()
        .map(|s| s.map(|x| Big::new(x as f64, 106)))
        .collect();
    let mut big = loops.jacobian(Big::new(0.0, 106), &big);
    big.scale_columns();
    let fine = decide(&big, 0.0).unwrap();
    assert_eq!(fine.method, Method::SparseQr);
    assert_eq!(fine.rank, decide(&real(&loops, &screws), 0.0).unwrap().rank);
    assert!(fine.dropped < 1e-29);
    let null = null_vectors(&big, &fine, 50, 0).unwrap();
    assert!(null.complete && null.residual < 1e-29);
}

/// A scissor lift: loop l is the rhombus (−1, 0), (0, 1), (0, −1), (1, 0) in its own frame.
fn scissor_screw(l: usize, joint: usize) -> [i64; 6] {
    let (x, y) = [(-1, 0), (0, 1), (0, -1), (1, 0)][joint - 3 * l];
    [0, 0, 1, y, -x, 0]
}

fn real_scissor(loops: &Loops) -> SparseMatrix<f64> {
    let screw = |l, joint| scissor_screw(l, joint).map(|x| x as f64);
    let mut matrix = loops.jacobian_by(0.0, screw);
    matrix.scale_columns();
    matrix
}

fn modular_scissor(loops: &Loops) -> SparseMatrix<Field61> {
    let screw = |l, joint| scissor_screw(l, joint).map(|x| Field61::new(i128::from(x)));
    loops.jacobian_by(Field61::ZERO, screw)
}

#[test]
fn a_scissor_of_ten_thousand_loops_has_one_freedom() {
    let loops = Loops::chain(10_000);
    let matrix = real_scissor(&loops);
    let (decision, factorization) = decide_by_qr(&matrix, 0.0).unwrap();
    assert_eq!(decision.rank, Some(30_000), "{decision:?}");
    assert_eq!(decision.nullity(), Some(1));
    assert!(factorization.stored() < 12 * loops.joints, "fill is linear");
    let null = null_vectors_by_qr(&matrix, &decision, &factorization, 1, 0).unwrap();
    assert!(null.residual < 1e-14);
    assert!(
        coloops(&null, &decision).zero.is_empty(),
        "every joint turns"
    );
    let exact = factor_modular(&modular_scissor(&loops));
    assert_eq!(exact.rank(), 30_000);
    assert!(exact.coloops(1).is_empty());
    // Self-stresses: three per loop.
    let (left, _) = decide_by_qr(&matrix.transpose(), 0.0).unwrap();
    assert_eq!(left.nullity(), Some(30_000));
}

#[test]
fn motions_that_fade_along_a_chain_do_not_spoil_the_rank() {
    // Loop l turns its right joint by a third of its left one: over 200 loops the motion fades by
    // 10⁹⁵. The rank is clear all the same, whichever end is dropped.
    for fade in [1.0 / 3.0, 3.0] {
        let loops = Loops::chain(200);
        let screw = |l: usize, joint: usize| {
            let (x, y) = [(-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (fade, 0.0)][joint - 3 * l];
            [0.0, 0.0, 1.0, y, -x, 0.0]
        };
        let mut matrix = loops.jacobian_by(0.0, screw);
        matrix.scale_columns();
        let (by_qr, _) = decide_by_qr(&matrix, 0.0).unwrap();
        let by_values = decide_by_singular_values(&matrix, 0.0).unwrap();
        assert_eq!(by_values.rank, Some(600));
        assert_eq!(by_qr.rank, Some(600), "{by_qr:?}");
        assert!((by_qr.kept / by_values.kept - 1.0).abs() < 0.5);
    }
}

#[test]
fn random_chains_are_decided_rightly_or_left_open() {
    // Random four-bars, now and then singular, with motions that fade along the chain: the exact
    // rank comes from the field.
    for (length, seed) in [(100, 1), (300, 2), (1000, 3), (3000, 4)] {
        let loops = Loops::chain(length);
        let screws = integer_screws(loops.joints, Geometry::Planar, seed);
        let exact = modular_rank(&modular(&loops, &screws));
        let (decision, _) = decide_by_qr(&real(&loops, &screws), 0.0).unwrap();
        assert!(
            decision.rank.is_none_or(|rank| rank == exact),
            "{decision:?} {exact}"
        );
    }
}

#[test]
fn coloops_of_a_lattice_agree_with_the_field() {
    let loops = Loops::lattice(8);
    for geometry in [Geometry::Planar, Geometry::Spherical] {
        let screws = integer_screws(loops.joints, geometry, 5);
        let matrix = real(&loops, &screws);
        let exact = factor_modular(&modular(&loops, &screws)).coloops(1);
        let decision = decide(&matrix, 0.0).unwrap();
        let by_basis = null_vectors(&matrix, &decision, usize::MAX, 0).unwrap();
        assert_eq!(coloops(&by_basis, &decision).zero, exact, "{geometry:?}");
        let (by_qr, factorization) = decide_by_qr(&matrix, 0.0).unwrap();
        let sample = null_vectors_by_qr(&matrix, &by_qr, &factorization, 2, 3).unwrap();
        assert_eq!(coloops(&sample, &by_qr).zero, exact, "{geometry:?}");
    }
}

/// The large cases of the module's goals; in a release build with `--nocapture` it tells the times.
#[test]
fn large_cases_agree_with_the_field() {
    fn time<T: std::fmt::Debug>(name: &str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        println!("{name:<34} {:>10.3?}  {result:?}", start.elapsed());
        result
    }
    let chain = Loops::chain(10_000);
    let lattice = Loops::lattice(30);
    let spatial = lattice.with_freedom(3);
    let regular = regular_lattice_screws(30);
    let random = integer_screws(lattice.joints, Geometry::Spatial, 12);
    let many = integer_screws(spatial.joints, Geometry::Spatial, 12);
    for (name, matrix, field) in [
        ("scissor", real_scissor(&chain), modular_scissor(&chain)),
        (
            "regular lattice",
            real(&lattice, &regular),
            modular(&lattice, &regular),
        ),
        (
            "random lattice",
            real(&lattice, &random),
            modular(&lattice, &random),
        ),
        (
            "lattice of 3 freedoms per joint",
            real(&spatial, &many),
            modular(&spatial, &many),
        ),
    ] {
        println!("{name}: {} x {}", matrix.rows(), matrix.columns());
        let exact = time("  field", || modular_rank(&field));
        let decision = time("  decide", || decide(&matrix, 0.0).unwrap());
        assert_eq!(decision.rank, Some(exact));
        let null = time("  two null vectors", || {
            let null = null_vectors(&matrix, &decision, 2, 0).unwrap();
            (null.vectors.len(), null.residual)
        });
        assert!(null.1 < 1e-10 && null.0 == 2.min(matrix.columns() - exact));
    }
    let single = Loops::chain(1);
    let small = real(&single, &integer_screws(4, Geometry::Planar, 2));
    let big = small.map(&Big::new(0.0, 106), |&x| Big::new(x, 106));
    let ranks = time("6 x 4, doubles, 1000 times", || {
        (0..1000)
            .map(|_| decide(&small, 0.0).unwrap().rank.unwrap())
            .sum::<usize>()
    });
    assert_eq!(ranks, 3000);
    // Rounded columns: the accuracy of the entries is that of doubles.
    let ranks = time("6 x 4, 106 bits, 100 times", || {
        (0..100)
            .map(|_| decide(&big, 1e-15).unwrap().rank.unwrap())
            .sum::<usize>()
    });
    assert_eq!(ranks, 300);
}
