//! Angles that are no algebraic rotation as written, read as one within their own digits.
//!
//! `0.3491` has a transcendental cosine, and says no more than 0.34905 ≤ θ ≤ 0.34915. In that interval lies an angle whose
//! half has a rational tangent, so that cosine and sine are rational: a mechanism as good as the one written. It is
//! not the one that was meant, and only what is said of these numbers holds of them.
//!
//! The simplest such tangent is taken (of the smallest denominator; Graham, Knuth and Patashnik 1994, section 4.5): equal
//! texts are read alike, and opposite ones as opposite rotations, so that frames that undo one another still do.

use super::constants::{distance, half_unit, is_printed_double};
use super::model::{JointId, Mechanism};
use kutzbach_math::number::Number;
use std::f64::consts::TAU;

/// Intervals narrower than this are not told from the rounding of tangents in doubles.
const NARROWEST: f64 = 1e-14;

/// Numbers of fewer digits than this (rad) say too little for another one to stand for them.
const WIDEST: f64 = 1e-3;

/// How much of the interval is used, so that rounding does not lead out of it.
const USED: f64 = 0.9;

impl Mechanism {
    /// The mechanism with the literal angles of some joints read as rational rotations within their digits, where they
    /// are no algebraic ones as written, and how many these are. None are where the numbers of their sub-mechanism are exact.
    #[must_use]
    pub fn with_rational_rotations(&self, joints: &[JointId]) -> (Self, usize) {
        let mut result = self.clone();
        let mut count = 0;
        // What is in no loop bears on nothing, however it is turned.
        let exact = |joint: &JointId| {
            self.sub_mechanism(*joint).is_some() && self.precision_of(*joint).is_exact()
        };
        for joint in joints.iter().filter(|joint| !exact(joint)) {
            let joint = &mut result.joints[joint.0];
            for side in [&mut joint.predecessor, &mut joint.successor] {
                for angle in &mut side.frame.roll_pitch_yaw {
                    if let Some(near) = rotation_near(angle) {
                        *angle = near;
                        count += 1;
                    }
                }
            }
        }
        (result, count)
    }
}

/// The rational rotation that a literal is read as; `None` for what is none, for zero, and for what is too precise.
fn rotation_near(angle: &Number) -> Option<Number> {
    // What is rational and not zero has a transcendental cosine (Lindemann).
    angle.rational().filter(|x| !x.is_zero())?;
    let stated = angle.written()?;
    let half_unit = half_unit(stated.decimals);
    let known_to = match is_printed_double(angle) {
        true => half_unit.max(NARROWEST),
        false => half_unit,
    };
    if !(NARROWEST..=WIDEST).contains(&known_to) {
        return None;
    }
    let turns = (angle.value() / TAU).round();
    let size = (angle.value() - turns * TAU).abs();
    let [low, high] = [-USED, USED].map(|part| (0.5 * (size + part * known_to)).tan());
    if !(low > 0.0 && high > low) {
        return None;
    }
    let (p, q) = simplest_between(low, high, 64)?;
    let half = Number::ratio(p, q)?.atan();
    let turned = &half + &half;
    let turned = match angle.value() < turns * TAU {
        true => -&turned,
        false => turned,
    };
    let whole = &Number::pi() * &Number::integer(2 * turns as i64);
    let near = &turned + &whole;
    (distance(angle, &near) <= known_to).then_some(near)
}

/// The fraction of the smallest denominator in an interval of positive numbers.
fn simplest_between(low: f64, high: f64, steps: usize) -> Option<(i64, i64)> {
    let whole = low.floor();
    if steps == 0 || whole >= 1e9 {
        return None;
    }
    if whole + 1.0 <= high {
        return Some((whole as i64 + 1, 1));
    }
    let (p, q) = simplest_between((high - whole).recip(), (low - whole).recip(), steps - 1)?;
    Some(((whole as i64).checked_mul(p)?.checked_add(q)?, p))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn near(text: &str) -> Option<Number> {
        rotation_near(&Number::decimal(text).unwrap())
    }

    #[test]
    fn an_angle_is_read_as_a_rational_rotation_within_its_digits() {
        for (text, half_unit) in [
            ("0.3491", 5e-5),
            ("-0.3491", 5e-5),
            ("2.900", 5e-4),
            ("-1.567289850670234852", 1e-14),
            ("7.123456", 5e-7),
        ] {
            let read = near(text).unwrap();
            let (cos, sin) = read.cos_sin();
            assert!(
                cos.rational().is_some() && sin.rational().is_some(),
                "{text}"
            );
            let angle: f64 = text.parse().unwrap();
            assert!((read.value() - angle).abs() <= half_unit + 1e-15, "{text}");
        }
        let opposite = &near("0.3491").unwrap() + &near("-0.3491").unwrap();
        assert!(opposite.is_zero());
    }

    #[test]
    fn other_angles_stay() {
        assert!(near("0").is_none());
        assert!(rotation_near(&Number::pi()).is_none());
        assert!(near("0.3").is_none());
        // Chosen digits beyond those of doubles are not given up.
        assert!(near("0.34910000000000000001234567891").is_none());
    }
}
