//! Constructed ranks, invariances, hard cases with known answers.

use proptest::prelude::*;

use super::super::jacobi;
use super::super::{
    Big, Factorization, MatrixError, Method, Refactoring, SparseMatrix, SplitMix64, coloops,
    decide, decide_by_qr, decide_by_singular_values, factor, null_basis, null_vectors,
};
use super::{from_rows, product, random_rows};

/// A random matrix of given rank as a product of random factors.
fn of_rank(seed: u64, rows: usize, columns: usize, rank: usize) -> Vec<Vec<f64>> {
    let mut random = SplitMix64::new(seed);
    let left = random_rows(&mut random, rows, rank);
    let right = random_rows(&mut random, rank, columns);
    product(&left, &right, columns)
}

#[test]
fn products_of_random_factors_have_the_rank_of_the_factors() {
    for (rows, columns) in [(6, 4), (6, 7), (12, 9), (40, 25), (25, 40), (1, 5), (5, 1)] {
        for rank in 1..=rows.min(columns) {
            let matrix = from_rows(&of_rank(rank as u64, rows, columns, rank), columns);
            let by_values = decide(&matrix, 0.0).unwrap();
            let (by_qr, factorization) = decide_by_qr(&matrix, 0.0).unwrap();
            assert_eq!(by_values.rank, Some(rank), "{by_values:?}");
            assert_eq!(by_qr.rank, Some(rank), "{by_qr:?}");
            assert_eq!(by_values.method, Method::Svd);
            assert_eq!(factorization.dropped_columns().len(), columns - rank);
            // Estimates bracket the truth: kept from above within a factor, largest from below.
            assert!(by_qr.kept > 0.01 * by_values.kept && by_qr.kept < 100.0 * by_values.kept);
            let ratio = by_qr.largest / by_values.largest;
            assert!(
                (0.9..=1.0 + 1e-12).contains(&ratio),
                "{ratio} {rows} {columns} {rank}"
            );
            let null = null_basis(&matrix, &by_values).unwrap();
            assert_eq!(null.vectors.len(), columns - rank);
            assert!(null.residual < 1e-14);
            let left = null_basis(&matrix.transpose(), &by_values.transposed()).unwrap();
            assert_eq!(left.vectors.len(), rows - rank);
            assert!(left.residual < 1e-14);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn order_units_and_blocks_do_not_matter(
        seed in any::<u64>(),
        rows in 1usize..14,
        columns in 1usize..12,
        rank in 1usize..8,
        exponent in -300i32..300,
        block in 1usize..7,
    ) {
        let rank = rank.min(rows).min(columns);
        let dense = of_rank(seed, rows, columns, rank);
        let plain = from_rows(&dense, columns);
        let mut random = SplitMix64::new(seed ^ 1);
        let mut row_order: Vec<usize> = (0..rows).collect();
        let mut column_order: Vec<usize> = (0..columns).collect();
        row_order.sort_by_key(|_| random.next_u64());
        column_order.sort_by_key(|_| random.next_u64());
        let factor = 2f64.powi(exponent);
        let moved = plain
            .triplets()
            .map(|(i, j, x)| (row_order[i], column_order[j], x * factor));
        let moved = SparseMatrix::from_triplets(rows, columns, 0.0, moved.collect::<Vec<_>>())
            .unwrap()
            .with_row_blocks_of(block);
        for (a, b) in [
            (decide(&plain, 0.0).unwrap(), decide(&moved, 0.0).unwrap()),
            (decide_by_qr(&plain, 0.0).unwrap().0, decide_by_qr(&moved, 0.0).unwrap().0),
        ] {
            // A random factor may itself be nearly singular: then both must doubt, or agree.
            prop_assert!(a.rank.is_none() || b.rank.is_none() || a.rank == b.rank);
            prop_assert!(a.candidates.1 >= rank.min(a.candidates.1));
            prop_assert!((b.largest / a.largest / factor - 1.0).abs() < 0.2);
            if a.method == Method::Svd {
                prop_assert!((a.kept - b.kept).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn doubles_and_many_digits_agree(
        seed in any::<u64>(),
        rows in 1usize..9,
        columns in 1usize..9,
        rank in 1usize..6,
    ) {
        let rank = rank.min(rows).min(columns);
        // Integer factors, so that the product has its rank exactly in any arithmetic.
        let mut random = SplitMix64::new(seed);
        let mut integers = |m: usize, n: usize| -> Vec<Vec<f64>> {
            (0..m)
                .map(|_| (0..n).map(|_| (random.next_u64() % 41) as f64 - 20.0).collect())
                .collect()
        };
        let (left, right) = (integers(rows, rank), integers(rank, columns));
        let matrix = from_rows(&product(&left, &right, columns), columns);
        let big = matrix.map(&Big::new(0.0, 106), |&x| Big::new(x, 106));
        let coarse = decide(&matrix, 0.0).unwrap();
        let fine = decide(&big, 0.0).unwrap();
        let (fine_qr, _) = decide_by_qr(&big, 0.0).unwrap();
        prop_assert!(fine.rank.is_some() && fine.rank == fine_qr.rank);
        prop_assert!(coarse.rank.is_none() || coarse.rank == fine.rank);
        prop_assert!((coarse.kept - fine.kept).abs() < 1e-13 || coarse.rank.is_none());
        prop_assert!(fine.dropped < 1e-30);
        let null = null_basis(&big, &fine).unwrap();
        prop_assert!(null.residual < 1e-29);
    }
}

/// [1 1; 1 1+2ε] and a block of ones: σ₁ = σ₂ = 2, σ₃ ≈ ε, and zeros.
fn nearly_dependent(small: f64) -> Vec<(usize, usize, f64)> {
    vec![
        (0, 0, 1.0),
        (0, 1, 1.0),
        (1, 0, 1.0),
        (1, 1, 1.0 + 2.0 * small),
        (2, 2, 1.0),
        (3, 2, 1.0),
        (2, 3, 1.0),
        (3, 3, 1.0),
    ]
}

#[test]
fn sigma_of_1e13_is_left_open_by_doubles_and_decided_by_106_bits() {
    // 2⁻⁴³ ≈ 1.1e-13 is exact in 1 + 2ε.
    let small = 2f64.powi(-43);
    let entries = nearly_dependent(small);
    let matrix = SparseMatrix::from_triplets(6, 6, 0.0, entries.clone()).unwrap();
    let doubles = decide(&matrix, 0.0).unwrap();
    assert_eq!(doubles.rank, None, "{doubles:?}");
    assert_eq!(doubles.candidates, (2, 3));
    // The sparse route meets fewer rows and may dare more, but not err.
    let (by_qr, _) = decide_by_qr(&matrix, 0.0).unwrap();
    assert!(by_qr.rank.is_none_or(|rank| rank == 3), "{by_qr:?}");
    for bits in [106, 212] {
        let big = matrix.map(&Big::new(0.0, bits), |&x| Big::new(x, bits));
        let decided = decide(&big, 0.0).unwrap();
        assert_eq!(decided.rank, Some(3), "{decided:?}");
        assert_eq!((decided.method, decided.bits), (Method::Jacobi, bits));
        assert!(
            (decided.kept / (small / 2.0) - 1.0).abs() < 0.1,
            "{decided:?}"
        );
        let (by_qr, _) = decide_by_qr(&big, 0.0).unwrap();
        assert_eq!(by_qr.rank, Some(3), "{by_qr:?}");
        // Entries known to 1e-12 only: no number of digits in the arithmetic helps.
        assert_eq!(decide(&big, 1e-12).unwrap().rank, Some(2));
        assert_eq!(decide(&big, 1e-14).unwrap().rank, None);
    }
    // Doubt also opens where the accuracy is said to be poor.
    assert_eq!(decide(&matrix, 1e-9).unwrap().rank, Some(2));
    let assumed = doubles.assuming(2);
    assert_eq!(null_basis(&matrix, &assumed).unwrap().vectors.len(), 4);
}

/// Kahan's triangle: unit-length pivots fall slowly, the last singular value very fast.
fn kahan(n: usize, angle: f64) -> SparseMatrix<f64> {
    let (s, c) = angle.sin_cos();
    let entries = (0..n).flat_map(|i| {
        (i..n).map(move |j| {
            let value = if i == j { 1.0 } else { -c };
            // Columns decrease by a hair, so that pivoting keeps their order.
            let hair = 1.0 - j as f64 * 1e-13;
            (i, j, s.powi(i as i32) * value * hair)
        })
    });
    SparseMatrix::from_triplets(n, n, 0.0, entries.collect::<Vec<_>>()).unwrap()
}

#[test]
fn kahan_does_not_deceive_the_qr() {
    let matrix = kahan(90, 1.2).with_row_blocks_of(90);
    let by_values = decide_by_singular_values(&matrix, 0.0).unwrap();
    let (by_qr, factorization) = decide_by_qr(&matrix, 0.0).unwrap();
    let pivot = factorization.smallest_kept() / by_qr.largest;
    assert!(pivot > 1e-5, "the pivots look harmless: {pivot:e}");
    assert!(
        by_values.rank.is_none_or(|rank| rank == 89),
        "{by_values:?}"
    );
    assert_eq!(by_qr.rank, None, "{by_qr:?}");
    assert_eq!(by_qr.candidates, (89, 90));
    // A mild one: the estimate is right where the pivot is off by orders of magnitude.
    let mild = kahan(40, 1.2).with_row_blocks_of(40);
    let values = decide_by_singular_values(&mild, 0.0).unwrap();
    let (qr, factorization) = decide_by_qr(&mild, 0.0).unwrap();
    assert_eq!((qr.rank, values.rank), (Some(40), Some(40)));
    assert!((qr.kept / values.kept - 1.0).abs() < 0.1);
    assert!(factorization.smallest_kept() / qr.largest > 1e3 * values.kept);
}

#[test]
fn structured_small_matrices_agree_with_jacobi() {
    // Entries in {0, ±1}, like the Jacobians of orthogonal mechanisms: some decompositions in use
    // return wrong singular values for a few of these.
    let mut random = SplitMix64::new(20_000);
    for case in 0..20_000 {
        let columns: Vec<Vec<f64>> = (0..7)
            .map(|_| {
                (0..6)
                    .map(|_| (random.next_u64() % 3) as f64 - 1.0)
                    .collect()
            })
            .collect();
        let triplets = columns
            .iter()
            .enumerate()
            .flat_map(|(j, column)| column.iter().enumerate().map(move |(i, &x)| (i, j, x)));
        let matrix = SparseMatrix::from_triplets(6, 7, 0.0, triplets.collect::<Vec<_>>()).unwrap();
        let decision = decide(&matrix, 0.0).unwrap();
        let expected = jacobi::singular_values(&0.0, columns).unwrap();
        let scale = expected[0].max(1.0);
        assert!(
            (decision.largest - expected[0]).abs() < 1e-13 * scale,
            "case {case}"
        );
        // Integer entries: singular values are zero or well away from it.
        let rank = expected.iter().filter(|&&x| x > 1e-9).count();
        assert_eq!(decision.rank, Some(rank), "case {case}: {decision:?}");
        if rank > 0 {
            let kept = expected[rank - 1] / expected[0];
            assert!((decision.kept - kept).abs() < 1e-13, "case {case}");
        }
        if case % 50 == 0 {
            let null = null_basis(&matrix, &decision).unwrap();
            assert_eq!(null.vectors.len(), 7 - rank);
            assert!(null.residual < 1e-14, "case {case}");
        }
    }
}

#[test]
fn degenerate_shapes_and_bad_numbers() {
    for (rows, columns) in [(0, 0), (0, 5), (5, 0), (6, 4), (400, 350)] {
        let zero = SparseMatrix::<f64>::from_triplets(rows, columns, 0.0, vec![]).unwrap();
        for decision in [
            decide(&zero, 0.0).unwrap(),
            decide_by_qr(&zero, 1e-6).unwrap().0,
            decide_by_singular_values(&zero, 0.0).unwrap(),
        ] {
            assert_eq!(
                (decision.rank, decision.nullity()),
                (Some(0), Some(columns))
            );
            assert_eq!((decision.kept, decision.dropped), (0.0, 0.0));
            assert_eq!(decision.gap, f64::INFINITY);
        }
        let decision = decide(&zero, 0.0).unwrap();
        let null = null_vectors(&zero, &decision, 3, 0).unwrap();
        assert_eq!(null.vectors.len(), columns.min(3));
        assert!(coloops(&null, &decision).zero.is_empty());
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let matrix =
            SparseMatrix::from_triplets(2, 3, 0.0, vec![(0, 0, 1.0), (1, 2, bad)]).unwrap();
        let expected = MatrixError::NotFinite { row: 1, column: 2 };
        assert_eq!(decide(&matrix, 0.0).unwrap_err(), expected);
        assert_eq!(decide_by_qr(&matrix, 0.0).unwrap_err(), expected);
        let big = matrix.map(&Big::new(0.0, 106), |&x| Big::new(x, 106));
        assert_eq!(decide(&big, 0.0).unwrap_err(), expected);
    }
    let one = SparseMatrix::from_triplets(1, 1, 0.0, vec![(0, 0, 5.0)]).unwrap();
    assert_eq!(decide(&one, 0.0).unwrap().rank, Some(1));
    assert_eq!(decide_by_qr(&one, 0.0).unwrap().0.rank, Some(1));
    for bad in [f64::NAN, -1.0, f64::INFINITY] {
        assert!(matches!(decide(&one, bad), Err(MatrixError::Tolerance(_))));
        assert!(matches!(
            decide_by_qr(&one, bad),
            Err(MatrixError::Tolerance(_))
        ));
    }
    // An accuracy no better than the matrix itself decides nothing.
    for poor in [0.2, 1.0, 50.0] {
        assert_eq!(decide(&one, poor).unwrap().rank, None);
        assert_eq!(decide_by_qr(&one, poor).unwrap().0.candidates, (0, 1));
    }
    // Largest and smallest doubles there are.
    for extreme in [f64::MAX, f64::MIN_POSITIVE, 5e-324] {
        let entries = vec![(0, 0, extreme), (1, 1, extreme), (2, 0, -extreme)];
        let matrix = SparseMatrix::from_triplets(3, 3, 0.0, entries).unwrap();
        assert_eq!(decide(&matrix, 0.0).unwrap().rank, Some(2), "{extreme:e}");
        assert_eq!(
            decide_by_qr(&matrix, 0.0).unwrap().0.rank,
            Some(2),
            "{extreme:e}"
        );
    }
}

#[test]
fn a_kept_order_of_elimination_serves_where_entries_vanish_or_appear() {
    let entries = |by: f64, corner: f64| {
        let chain = (0..6).flat_map(move |i| [(i, i, 2.0 + by), (i + 1, i, by * i as f64)]);
        let all = chain.chain([(6, 0, corner)]);
        SparseMatrix::from_triplets(7, 6, 0.0, all).unwrap()
    };
    let mut kept = Refactoring::default();
    for (by, corner) in [(1.0, 0.0), (0.0, 0.0), (0.5, 3.0), (2.0, 0.0)] {
        let matrix = entries(by, corner);
        let (one, two) = (
            kept.factor(&matrix, 0.0).unwrap(),
            factor(&matrix, 0.0).unwrap(),
        );
        assert_eq!((one.rank(), two.rank()), (6, 6));
        // R of A and R of A in another order have the same product of pivots and the same solutions of R' R x = b.
        let solve = |found: &Factorization<f64>| {
            let mut x: Vec<f64> = (0..6).map(|i| 1.0 + i as f64).collect();
            found.triangle.forward_substitute(&mut x);
            found.triangle.back_substitute(&mut x);
            x
        };
        for (a, b) in solve(&one).iter().zip(solve(&two)) {
            assert!((a - b).abs() < 1e-13, "{a} {b}");
        }
    }
}
