//! Factors of polynomials in several variables.

#![allow(clippy::unwrap_used)]

use super::*;
use proptest::prelude::*;

const NAMES: [&str; 4] = ["w", "x", "y", "z"];

fn names() -> Vec<String> {
    NAMES.iter().map(|&n| n.to_owned()).collect()
}

fn variable(index: usize) -> Polynomial {
    Polynomial::variable(index, NAMES.len())
}

fn integer(value: i64) -> Polynomial {
    Polynomial::integer(value, NAMES.len())
}

fn factors(polynomial: &Polynomial) -> Vec<String> {
    let outcome = factor(polynomial, &Budget::unlimited()).unwrap();
    assert!(outcome.complete);
    let product = outcome.factors.iter().fold(
        Polynomial::constant(outcome.unit.clone(), NAMES.len()),
        |p, (f, power)| &p * &f.power(*power),
    );
    assert_eq!(product, *polynomial);
    outcome
        .factors
        .iter()
        .map(|(f, power)| match power {
            1 => f.text(&names()),
            _ => format!("({})^{power}", f.text(&names())),
        })
        .collect()
}

#[test]
fn equations_of_mechanisms() {
    let (w, x, y, z) = (variable(0), variable(1), variable(2), variable(3));
    let one = integer(1);
    // c3·c4 + c3 + c4 + 1
    let folded = &(&(&w * &x) + &(&w + &x)) + &one;
    assert_eq!(factors(&folded), ["w + 1", "x + 1"]);
    // s3·c4 + s3
    assert_eq!(factors(&(&(&y * &x) + &y)), ["y", "x + 1"]);
    // A difference of squares with a rational coefficient.
    let squares = (&(&x * &x) - &(&y * &y).scaled(&Rational::from_integer(4.into())))
        .scaled(&Rational::new((-2).into(), 3.into()));
    assert_eq!(factors(&squares), ["x + 2*y", "x - 2*y"]);
    // The unit circle and a quadric of four variables do not factor.
    let circle = &(&(&x * &x) + &(&y * &y)) - &one;
    assert_eq!(factors(&circle), ["x^2 + y^2 - 1"]);
    let turned = &(&(&w * &z) - &(&x * &y)) - &one;
    assert_eq!(factors(&turned).len(), 1);
    let split = &(&w * &z) - &(&x * &z);
    assert_eq!(factors(&split), ["z", "w - x"]);
    // Powers of factors that are no monomials.
    let power = &(&circle * &circle) * &(&(&x - &w) * &(&x - &w)).power(2);
    assert_eq!(factors(&power), ["(w - x)^4", "(x^2 + y^2 - 1)^2"]);
    let mixed = &(&circle * &(&x + &y).power(3)) * &(&z * &z);
    assert_eq!(factors(&mixed), ["(z)^2", "(x + y)^3", "x^2 + y^2 - 1"]);
}

#[test]
fn irreducible_over_the_rationals_only() {
    let (x, y) = (variable(1), variable(2));
    // x² - 2y² falls apart over the reals, x⁴ + 4y⁴ over the rationals, x⁴ + y⁴ only with √2.
    let two = Rational::from_integer(2.into());
    assert_eq!(factors(&(&(&x * &x) - &(&y * &y).scaled(&two))).len(), 1);
    let four = Rational::from_integer(4.into());
    assert_eq!(
        factors(&(&x.power(4) + &y.power(4).scaled(&four))),
        ["x^2 + 2*x*y + 2*y^2", "x^2 - 2*x*y + 2*y^2"]
    );
    assert_eq!(factors(&(&x.power(4) + &y.power(4))).len(), 1);
}

#[test]
fn constants_and_zero() {
    assert!(factors(&integer(6)).is_empty());
    assert!(factors(&integer(0)).is_empty());
    assert_eq!(factors(&variable(2)), ["y"]);
}

/// Dense around a line with too many terms: irreducible ones are recognised all the same, products are not split, and that
/// is said.
#[test]
fn what_is_too_large_is_not_called_irreducible() {
    let n = 12;
    let sum = |power: u32| {
        (0..n).fold(Polynomial::integer(1, n), |sum, i| {
            &sum + &Polynomial::variable(i, n).power(power)
        })
    };
    let budget = Budget::unlimited();
    let irreducible = factor(&sum(7), &budget).unwrap();
    assert_eq!((irreducible.factors.len(), irreducible.complete), (1, true));
    let product = factor(&(&sum(4) * &sum(3)), &budget).unwrap();
    assert_eq!((product.factors.len(), product.complete), (1, false));
}

#[test]
fn a_spent_budget_stops() {
    let budget = Budget::new(crate::Limits {
        work: Some(10),
        ..Default::default()
    });
    let p = &(&variable(0) * &variable(1)) - &integer(1);
    assert_eq!(factor(&(&p * &p), &budget), Err(Stop::Work));
}

fn polynomial() -> impl Strategy<Value = Polynomial> {
    let term = (proptest::collection::vec(0_u32..2, 4), -4_i64..5);
    proptest::collection::vec(term, 2..5)
        .prop_map(|terms| {
            let terms = terms
                .into_iter()
                .map(|(exponents, c)| (exponents, Rational::from_integer(c.into())))
                .collect();
            Polynomial::from_terms(terms, NAMES.len())
        })
        .prop_filter("constant or large", |p| (1..=3).contains(&p.degree()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn products_fall_apart(parts in proptest::collection::vec(polynomial(), 1..4)) {
        let whole = parts.iter().fold(integer(1), |p, q| &p * q);
        let outcome = factor(&whole, &Budget::unlimited()).unwrap();
        prop_assert!(outcome.complete);
        let product = outcome.factors.iter().fold(
            Polynomial::constant(outcome.unit.clone(), NAMES.len()),
            |p, (f, power)| &p * &f.power(*power),
        );
        prop_assert_eq!(product, whole);
        let count: u32 = outcome.factors.iter().map(|(_, power)| power).sum();
        prop_assert!(count as usize >= parts.len());
        for (found, _) in &outcome.factors {
            let alone = factor(found, &Budget::unlimited()).unwrap();
            prop_assert_eq!(&alone.factors, &vec![(found.clone(), 1)]);
        }
    }
}
