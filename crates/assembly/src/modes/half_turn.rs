//! Angles whose cosine is no number that exact equations can have, such as 0.5 rad.
//!
//! With t the tangent of half an angle, cosine and sine are (1 − t²)/(1 + t²) and 2t/(1 + t²): fractions wherever t is one. The
//! angles of such t are dense, so that there is one within any distance of the angle asked for.

use kutzbach_algebra::NumberField;
use kutzbach_math::number::Number;

/// An angle held may differ from the one asked for by so much (rad).
pub const WITHIN: f64 = 1e-12;

/// An angle in place of another one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HalfTurn {
    /// Tangent of half the angle, as a fraction.
    pub tangent: [i64; 2],
}

impl HalfTurn {
    /// The angle with the shortest fraction within [`WITHIN`] of a given one; `None` where that has an algebraic cosine of low
    /// degree itself, or none was found.
    pub(super) fn near(angle: &Number) -> Option<Self> {
        if is_algebraic(angle) {
            return None;
        }
        let half = angle * &Number::ratio(1, 2)?;
        fraction_near(half.tan().ok()?.value()).map(|tangent| Self { tangent })
    }

    /// The angle (rad).
    pub(super) fn angle(&self) -> Option<Number> {
        let [p, q] = self.tangent;
        let t = Number::ratio(p, q)?;
        let one = Number::one();
        Number::atan2(&(&t + &t), &(&one - &(&t * &t))).ok()
    }
}

/// Whether exact equations can have the cosine and sine of an angle.
fn is_algebraic(angle: &Number) -> bool {
    let (cos, sin) = angle.cos_sin();
    let numbers = [cos, sin];
    NumberField::of(&numbers)
        .is_some_and(|mut field| numbers.iter().all(|number| field.read(number).is_some()))
}

/// The first convergent of a tangent's continued fraction whose angle is near enough.
fn fraction_near(tangent: f64) -> Option<[i64; 2]> {
    // Beyond this the digits of a double are used up.
    const MOST: f64 = 1e13;
    let (mut before, mut last) = ([0.0, 1.0], [1.0, 0.0]);
    let mut rest = tangent;
    loop {
        let whole = rest.floor();
        let next: [f64; 2] = [0, 1].map(|i| whole * last[i] + before[i]);
        if !next.iter().all(|x| x.abs() < MOST) {
            return None;
        }
        (before, last) = (last, next);
        // Of a difference of two angles the tangent, without cancellation of the angles themselves.
        let off = (next[0] - tangent * next[1]) / (next[1] + tangent * next[0]);
        if 2.0 * off.abs() < WITHIN {
            #[expect(clippy::cast_possible_truncation, reason = "whole and below 10¹³")]
            return Some(next.map(|x| x as i64));
        }
        rest = 1.0 / (rest - whole);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_get_a_fraction_within_a_picoradian() {
        for angle in [0.5, -0.5, 1.0, 3.1, -3.1, 7.0, 1e-3, 100.0] {
            let half = HalfTurn::near(&Number::from_f64(angle).unwrap_or_else(Number::zero));
            let [p, q] = half.map_or([0, 1], |half| half.tangent);
            let found = 2.0 * (p as f64).atan2(q as f64);
            let off = ((found - angle) / std::f64::consts::TAU).fract().abs();
            assert!(off.min(1.0 - off) < 1e-12, "{angle}: {p}/{q}, off by {off}");
        }
    }

    #[test]
    fn angles_with_an_algebraic_cosine_stay() {
        let thirty_degrees = Number::integer(30).radians();
        let of_a_triangle = Number::ratio(3, 5).and_then(|c| c.acos().ok());
        for angle in [Number::zero(), Number::pi(), thirty_degrees] {
            assert_eq!(HalfTurn::near(&angle), None);
        }
        assert!(of_a_triangle.is_some_and(|angle| HalfTurn::near(&angle).is_none()));
    }
}
