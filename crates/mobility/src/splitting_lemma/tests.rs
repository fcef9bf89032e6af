use super::*;
use crate::leftover::ORDERS;

/// A polynomial: coefficients with exponents.
struct Polynomial(Vec<(f64, Vec<usize>)>);

impl Equation for Polynomial {
    fn value(&mut self, at: &[Extended]) -> Result<Extended, Doubt> {
        let mut sum = at[0].zero_like();
        for (c, exponents) in &self.0 {
            let mut term = at[0].constant(*c);
            for (x, exponent) in at.iter().zip(exponents) {
                for _ in 0..*exponent {
                    term = term * x.clone();
                }
            }
            sum = sum + term;
        }
        Ok(sum)
    }
}

fn told(terms: &[(f64, [usize; 3])]) -> Result<((usize, usize), Option<Rest>), Doubt> {
    let mut equation = Polynomial(terms.iter().map(|(c, e)| (*c, e.to_vec())).collect());
    let one = Extended::new(1.0, bits_of_squares(0));
    let found = squares(&mut equation, 3, &one, 0.0)?;
    if found.null.is_empty() || found.signature == (0, 0) {
        return Ok((found.signature, None));
    }
    let near = rest(&mut equation, &found, found.near(ORDERS, 0))?;
    // Farther out it is the same, if anything is found.
    if let Ok(far) = rest(&mut equation, &found, found.farther(ORDERS, 0)) {
        assert_eq!(far, near);
    }
    Ok((found.signature, Some(near)))
}

#[test]
fn planes_that_cross_at_any_angle_leave_nothing() {
    for angle in [1.0, 1e-3, 1e-9, 1e-20] {
        // x (x + angle (y + z)), and the same bent: with x + y² for x.
        let planes = [(1.0, [2, 0, 0]), (angle, [1, 1, 0]), (angle, [1, 0, 1])];
        assert_eq!(
            told(&planes).unwrap(),
            ((1, 1), Some(Rest::Zero)),
            "{angle}"
        );
        let bent = [
            (1.0, [2, 0, 0]),
            (2.0, [1, 2, 0]),
            (1.0, [0, 4, 0]),
            (angle, [1, 1, 0]),
            (angle, [0, 3, 0]),
            (angle, [1, 0, 1]),
            (angle, [0, 2, 1]),
        ];
        assert_eq!(told(&bent).unwrap(), ((1, 1), Some(Rest::Zero)), "{angle}");
    }
}

#[test]
fn what_keeps_planes_from_being_two_is_seen_to_high_order() {
    for order in [3, 4, 7, 20] {
        for size in [1.0, 1e-9] {
            let terms = [(1.0, [2, 0, 0]), (1e-6, [1, 1, 0]), (size, [0, 0, order])];
            let positive = [true, order % 2 == 0];
            let wanted = Rest::Some(Some((order as u32, positive)));
            assert_eq!(
                told(&terms).unwrap(),
                ((1, 1), Some(wanted)),
                "{order} {size}"
            );
        }
    }
}

#[test]
fn definite_forms_of_rank_two_are_told_by_one_variable() {
    let with = |c: f64, order: usize| {
        told(&[(1.0, [2, 0, 0]), (1e-9, [0, 2, 0]), (c, [0, 0, order])])
            .unwrap()
            .1
    };
    assert_eq!(with(1e-9, 4), Some(Rest::Some(Some((4, [true, true])))));
    assert_eq!(with(-1.0, 6), Some(Rest::Some(Some((6, [false, false])))));
    assert_eq!(with(-1.0, 5), Some(Rest::Some(Some((5, [false, true])))));
    assert_eq!(with(0.0, 3), Some(Rest::Zero));
}

#[test]
fn a_form_of_full_rank_leaves_no_variable() {
    let cone = [(1.0, [2, 0, 0]), (2.0, [0, 2, 0]), (-1e-12, [0, 0, 2])];
    assert_eq!(told(&cone).unwrap(), ((2, 1), None));
}

/// What is left of terms of order four is no quadratic form.
#[test]
fn a_germ_without_quadratic_terms_has_none() {
    let quartic = [
        (1e-3, [4, 0, 0]),
        (-0.5, [0, 4, 0]),
        (1.0, [1, 1, 2]),
        (2.0, [0, 0, 4]),
        (7.0, [3, 0, 0]),
    ];
    assert_eq!(told(&quartic).unwrap(), ((0, 0), None));
}

#[test]
fn the_lines_of_an_indefinite_form_are_its_zeros() {
    let mut planes = Polynomial(vec![(1.0, vec![2, 0]), (-4.0, vec![0, 2])]);
    let one = Extended::new(1.0, bits_of_squares(0));
    let lines = squares(&mut planes, 2, &one, 0.0).unwrap().lines.unwrap();
    for line in lines {
        assert!((line[0].abs() - 2.0 * line[1].abs()).abs() < 1e-15);
    }
}
