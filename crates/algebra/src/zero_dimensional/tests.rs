//! Points of small systems whose solutions are known.

#![allow(clippy::unwrap_used)]

use super::*;
use crate::{MonomialOrder, Polynomial, Rational, groebner_basis};
use proptest::prelude::*;

fn points(equations: &[Polynomial], variables: usize, order: &MonomialOrder) -> FinitePoints {
    let budget = Budget::unlimited();
    let basis = groebner_basis(equations, variables, order, &budget).unwrap();
    FinitePoints::new(&basis, &budget).unwrap().unwrap()
}

fn counts(points: &FinitePoints) -> (usize, usize, usize) {
    let budget = Budget::unlimited();
    let real = points.real_count(&budget).unwrap();
    let form = points.trace_form(&budget).unwrap();
    assert_eq!((form.rank, form.signature), (points.count(), real));
    (points.multiplicity(), points.count(), real)
}

fn xy() -> (Polynomial, Polynomial) {
    (Polynomial::variable(0, 2), Polynomial::variable(1, 2))
}

/// x² + y² = 1 and x·y = 1/4: four real points. With x·y = 1: four complex ones.
#[test]
fn circle_and_hyperbola() {
    let (x, y) = xy();
    let circle = &(&(&x * &x) + &(&y * &y)) - &Polynomial::one(2);
    let quarter = Polynomial::constant(Rational::new(1.into(), 4.into()), 2);
    let equations = [circle.clone(), &(&x * &y) - &quarter];
    let order = MonomialOrder::Degrevlex;
    let found = points(&equations, 2, &order);
    assert_eq!(counts(&found), (4, 4, 4));
    for solution in found.real_solutions(60, &Budget::unlimited()).unwrap() {
        let values = solution.values();
        assert!((values[0] * values[0] + values[1] * values[1] - 1.0).abs() < 1e-15);
        assert!((values[0] * values[1] - 0.25).abs() < 1e-15);
        assert_eq!(solution.multiplicity, 1);
    }
    let far = [circle, &(&x * &y) - &Polynomial::one(2)];
    assert_eq!(counts(&points(&far, 2, &order)), (4, 4, 0));
}

/// (x - 1)² = 0 and y² = x: two points, each double; the rational ones come out exact.
#[test]
fn multiple_points() {
    let (x, y) = xy();
    let one = Polynomial::one(2);
    let equations = [(&x - &one).power(2), &(&y * &y) - &x];
    for order in [MonomialOrder::Degrevlex, MonomialOrder::Lexicographic] {
        let found = points(&equations, 2, &order);
        assert_eq!(counts(&found), (4, 2, 2));
        let solutions = found.real_solutions(10, &Budget::unlimited()).unwrap();
        assert!(solutions.iter().all(RealSolution::is_exact));
        let mut values: Vec<Vec<f64>> = solutions.iter().map(RealSolution::values).collect();
        values.sort_by(|a, b| a[1].total_cmp(&b[1]));
        assert_eq!(values, [[1.0, -1.0], [1.0, 1.0]]);
        assert!(solutions.iter().all(|s| s.multiplicity == 2));
    }
}

/// A triple point at the origin that no single line sees as it is: x² = x·y = y² = 0.
#[test]
fn fat_point() {
    let (x, y) = xy();
    let found = points(&[&x * &x, &x * &y, &y * &y], 2, &MonomialOrder::Degrevlex);
    assert_eq!(counts(&found), (3, 1, 1));
    let solutions = found.real_solutions(5, &Budget::unlimited()).unwrap();
    assert_eq!(solutions[0].values(), [0.0, 0.0]);
    assert_eq!(solutions[0].multiplicity, 3);
}

#[test]
fn infinitely_many_or_none() {
    let (x, y) = xy();
    let budget = Budget::unlimited();
    let order = MonomialOrder::Degrevlex;
    let line = groebner_basis(&[&x - &y], 2, &order, &budget).unwrap();
    assert!(FinitePoints::new(&line, &budget).unwrap().is_none());
    let equations = [x.clone(), &x - &Polynomial::one(2)];
    let found = points(&equations, 2, &order);
    assert_eq!(counts(&found), (0, 0, 0));
    assert!(found.real_solutions(10, &budget).unwrap().is_empty());
}

#[test]
fn narrow_intervals_hold_the_root() {
    let (x, y) = xy();
    // x³ = 2, y = x² + x: x is the real cube root.
    let two = Polynomial::integer(2, 2);
    let equations = [&x.power(3) - &two, &y - &(&(&x * &x) + &x)];
    let found = points(&equations, 2, &MonomialOrder::Degrevlex);
    assert_eq!(counts(&found), (3, 3, 1));
    let solutions = found.real_solutions(200, &Budget::unlimited()).unwrap();
    let (low, high) = &solutions[0].coordinates[0];
    let two = Rational::from_integer(2.into());
    assert!(low * low * low <= two && high * high * high >= two);
    assert!((solutions[0].values()[1] - (4_f64.cbrt() + 2_f64.cbrt())).abs() < 1e-15);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    /// All combinations of given coordinates: the points of (x - a)(x - b)... = 0, (y - c)... = 0, seen from turned axes.
    #[test]
    fn grids(
        xs in proptest::collection::btree_set(-9_i64..10, 1..4),
        ys in proptest::collection::btree_set(-9_i64..10, 1..4),
        slope in -3_i64..4,
    ) {
        let (x, y) = xy();
        let tilted = &x + &y.scaled(&Rational::from_integer(slope.into()));
        let product = |base: &Polynomial, roots: &std::collections::BTreeSet<i64>| {
            roots.iter().fold(Polynomial::one(2), |p, &r| &p * &(base - &Polynomial::integer(r, 2)))
        };
        let equations = [product(&tilted, &xs), product(&y, &ys)];
        let found = points(&equations, 2, &MonomialOrder::Degrevlex);
        let number = xs.len() * ys.len();
        prop_assert_eq!(counts(&found), (number, number, number));
        let mut values: Vec<Vec<f64>> = found
            .real_solutions(20, &Budget::unlimited())
            .unwrap()
            .iter()
            .map(RealSolution::values)
            .collect();
        values.sort_by(|a, b| a.partial_cmp(b).unwrap());
        let mut expected: Vec<Vec<f64>> = xs
            .iter()
            .flat_map(|&a| ys.iter().map(move |&b| vec![(a - slope * b) as f64, b as f64]))
            .collect();
        expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
        prop_assert_eq!(values, expected);
    }
}
