//! Points of the unit circle: fractions of pi, rotation, half angles.

use super::evaluate::fraction;
use super::surd::Surd;
use super::tree::Operation;
use super::{Angle, Number};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// cos and sin of the sum of two angles given by their cos and sin.
pub(super) fn rotate(a: &(Number, Number), b: &(Number, Number)) -> (Number, Number) {
    (
        &(&a.0 * &b.0) - &(&a.1 * &b.1),
        &(&a.1 * &b.0) + &(&a.0 * &b.1),
    )
}

/// cos and sin of half an angle in [0, π/2] given by its cos.
pub(super) fn halved(cos: &Number) -> Option<(Number, Number)> {
    let half = Number::from_rational(fraction(1, 2));
    let one = Number::one();
    let cos_half = (&(&one + cos) * &half).sqrt().ok()?;
    let sin_half = (&(&one - cos) * &half).sqrt().ok()?;
    Some((cos_half, sin_half))
}

/// cos and sin of r·π: by square roots where the denominator of r divides 240, otherwise as `cos(k/n*pi)` with an angle
/// in [0, π/4], so that equal values look equal.
pub(super) fn fraction_of_pi(r: &RBig) -> (Number, Number) {
    if let Some(point) = table(r) {
        return point;
    }
    let two = RBig::from(2);
    let turn = r - &two * RBig::from((r / &two).floor());
    octant(turn)
}

/// Reflects r in [0, 2) to [0, 1/4].
fn octant(r: RBig) -> (Number, Number) {
    if r > RBig::ONE {
        let (cos, sin) = octant(RBig::from(2) - r);
        return (cos, -sin);
    }
    if r > fraction(1, 2) {
        let (cos, sin) = octant(RBig::ONE - r);
        return (-cos, sin);
    }
    if r > fraction(1, 4) {
        let (cos, sin) = octant(fraction(1, 2) - r);
        return (sin, cos);
    }
    let angle = Number::from_angle(Angle::of_pi(r));
    (
        Number::from_tree(Operation::Cos, vec![angle.clone()]),
        Number::from_tree(Operation::Sin, vec![angle]),
    )
}

/// cos and sin of r·π by square roots, where the denominator of r divides 240 = 16·3·5.
///
/// k/240 = x/16 + y/3 + z/5 (modulo 2) by the Chinese remainder theorem, and each of the three is elementary: thirds and
/// fifths directly, sixteenths by halving. Multiples of π/12 come out as [`Surd`]s this way.
pub(super) fn table(r: &RBig) -> Option<(Number, Number)> {
    let k = r * RBig::from(240);
    if !k.is_int() {
        return None;
    }
    let full_turn = IBig::from(480);
    let rest = ((k.numerator() % &full_turn) + &full_turn) % &full_turn;
    let k = i64::try_from(rest).ok()?;
    // 240/16 = 15, 240/3 = 80 = 2 (mod 3), 240/5 = 48 = 3 (mod 5); 2·2 = 1 (mod 3), 3·2 = 1 (mod 5).
    let y = 2 * k % 3;
    let z = 2 * k % 5;
    let x = (k - 80 * y - 48 * z) / 15;
    let point = rotate(&thirds(y)?, &fifths(z)?);
    Some(rotate(&point, &sixteenths(x.rem_euclid(32))?))
}

fn root(n: u32, denominator: u32) -> Option<Number> {
    // √n / d = √(n/d²).
    let square = RBig::from_parts(n.into(), UBig::from(denominator).pow(2));
    Surd::root(&square).map(Number::from_surd)
}

/// y·π/3 for y in 0..3.
fn thirds(y: i64) -> Option<(Number, Number)> {
    Some(match y {
        0 => (Number::one(), Number::zero()),
        1 => (Number::ratio(1, 2)?, root(3, 2)?),
        _ => (Number::ratio(-1, 2)?, root(3, 2)?),
    })
}

/// z·π/5 for z in 0..5. cos π/5 = (√5 + 1)/4, cos 2π/5 = (√5 − 1)/4.
fn fifths(z: i64) -> Option<(Number, Number)> {
    let quarter = Number::ratio(1, 4)?;
    let cos = match z {
        0 => return Some((Number::one(), Number::zero())),
        1 => root(5, 4)? + quarter,
        2 => root(5, 4)? - quarter,
        3 => quarter - root(5, 4)?,
        _ => -(root(5, 4)? + quarter),
    };
    let sin = (&Number::one() - &(&cos * &cos)).sqrt().ok()?;
    Some((cos, sin))
}

/// x·π/16 for x in 0..32.
fn sixteenths(x: i64) -> Option<(Number, Number)> {
    if x >= 8 {
        let (cos, sin) = sixteenths(x - 8)?;
        return Some((-sin, cos));
    }
    if x > 4 {
        let (cos, sin) = sixteenths(8 - x)?;
        return Some((sin, cos));
    }
    match x {
        0 => Some((Number::one(), Number::zero())),
        4 => Some((root(2, 2)?, root(2, 2)?)),
        _ => halved(&sixteenths(2 * x)?.0),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::number::Exact;

    #[test]
    fn all_table_entries_agree_with_doubles_and_lie_on_the_circle() {
        for k in -5..490 {
            let (cos, sin) = table(&fraction(k, 240)).unwrap();
            let angle = k as f64 * std::f64::consts::PI / 240.0;
            // pi, the product and the quotient are each off by 2^-53 of at most 6.5, the result by one rounding.
            let tolerance = 3.0 * 6.5 * 2f64.powi(-53) + f64::EPSILON;
            assert!((cos.value() - angle.cos()).abs() < tolerance, "{k}");
            assert!((sin.value() - angle.sin()).abs() < tolerance, "{k}");
        }
        for k in [1, 7, 15, 16, 30, 48, 100, 239] {
            let (cos, sin) = table(&fraction(k, 240)).unwrap();
            assert_eq!(&(&cos * &cos) + &(&sin * &sin), Number::one(), "{k}");
        }
        assert!(table(&fraction(1, 7)).is_none());
    }

    #[test]
    fn multiples_of_fifteen_degrees_are_surds() {
        for k in 0..24 {
            let (cos, sin) = table(&fraction(k, 12)).unwrap();
            for x in [cos, sin] {
                assert!(
                    matches!(x.exact(), Some(Exact::Rational(_) | Exact::Surd(_))),
                    "{k}: {x:?}"
                );
            }
        }
    }

    #[test]
    fn other_fractions_are_reduced_to_the_first_octant() {
        let (cos, sin) = fraction_of_pi(&fraction(2, 9));
        let (cos_far, sin_far) = fraction_of_pi(&fraction(5, 18));
        assert_eq!(cos, sin_far);
        assert_eq!(sin, cos_far);
        let (back, _) = fraction_of_pi(&fraction(-29, 9));
        assert_eq!(back, -&cos);
    }
}
