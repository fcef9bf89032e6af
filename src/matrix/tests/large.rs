//! Chains and lattices of loops, against the prime field and against each other.

use std::time::Instant;

use super::super::{
    Big, Field61, Method, SparseMatrix, coloops, decide, decide_by_qr, decide_by_singular_values,
    factor_modular, modular_rank, null_vectors, null_vectors_by_qr,
};
use super::{Geometry, Loops, integer_screws};

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

#[test]
fn real_and_modular_ranks_agree_on_integer_geometry() {
    for loops in [
        Loops::chain(1),
        Loops::chain(40),
        Loops::lattice(4),
        Loops::lattice(9),
    ] {
        for geometry in [Geometry::Planar, Geometry::Spherical, Geometry::Spatial] {
            for seed in 0..3 {
                let screws = integer_screws(loops.joints, geometry, seed);
                let matrix = real(&loops, &screws);
                let exact = modular_rank(&modular(&loops, &screws));
                let by_values = decide_by_singular_values(&matrix, 0.0).unwrap();
                let (by_qr, _) = decide_by_qr(&matrix, 0.0).unwrap();
                assert_eq!(by_values.rank, Some(exact), "{geometry:?} {by_values:?}");
                assert_eq!(by_qr.rank, Some(exact), "{geometry:?} {by_qr:?}");
                let (left, _) = decide_by_qr(&matrix.transpose(), 0.0).unwrap();
                assert_eq!(left.rank, Some(exact), "{geometry:?} {left:?}");
                assert_eq!(modular_rank(&modular(&loops, &screws).transpose()), exact);
            }
        }
    }
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
        println!("{decision:?} exact {exact}");
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

/// Prints times of the large cases; run it in a release build with `--nocapture`.
#[test]
fn timings() {
    let time = |name: &str, work: &mut dyn FnMut() -> String| {
        let start = Instant::now();
        let result = work();
        println!("{name:<48} {:>10.3?}  {result}", start.elapsed());
    };
    let chain = Loops::chain(10_000);
    let (matrix, field) = (real_scissor(&chain), modular_scissor(&chain));
    time("chain 60000 x 30001, QR", &mut || {
        format!("{:?}", decide_by_qr(&matrix, 0.0).unwrap().0)
    });
    let transposed = matrix.transpose();
    time("chain transposed, QR", &mut || {
        format!("{:?}", decide_by_qr(&transposed, 0.0).unwrap().0.candidates)
    });
    time("chain 60000 x 30001, field", &mut || {
        format!("{}", modular_rank(&field))
    });
    for geometry in [Geometry::Planar, Geometry::Spatial] {
        let lattice = Loops::lattice(30);
        let screws = integer_screws(lattice.joints, geometry, 12);
        let (matrix, field) = (real(&lattice, &screws), modular(&lattice, &screws));
        time("lattice 5046 x 1740, QR", &mut || {
            let (decision, factorization) = decide_by_qr(&matrix, 0.0).unwrap();
            format!("{decision:?}, {} stored", factorization.stored())
        });
        let transposed = matrix.transpose();
        time("lattice transposed, QR", &mut || {
            format!("{:?}", decide_by_qr(&transposed, 0.0).unwrap().0.candidates)
        });
        time("lattice, field", &mut || {
            format!("{}", modular_rank(&field))
        });
    }
    let single = Loops::chain(1);
    let small = real(&single, &integer_screws(4, Geometry::Planar, 2));
    time("6 x 4, doubles, 1000 times", &mut || {
        let ranks = (0..1000).map(|_| decide(&small, 0.0).unwrap().rank.unwrap());
        format!("{}", ranks.sum::<usize>())
    });
    let big = small.map(&Big::new(0.0, 106), |&x| Big::new(x, 106));
    time("6 x 4, 106 bits, 100 times", &mut || {
        let ranks = (0..100).map(|_| decide(&big, 1e-15).unwrap().rank.unwrap());
        format!("{}", ranks.sum::<usize>())
    });
}
