//! `quat_xyzw`, the other way in which URDF writes how a frame is turned (urdfdom 2 and later).
//!
//! A frame keeps roll, pitch and yaw. The angles are worked out in doubles and stated with as many decimals as the quaternion has besides zeros,
//! so that its precision stays part of the file; one whose squares add up to exactly 1, such as `0 0 0 1` or
//! `0.5 0.5 0.5 0.5`, states them in full.

use kutzbach_math::number::Number;

/// Decimals of angles in full double precision.
const FULL: usize = 15;

/// Roll, pitch and yaw (rad, about fixed axes) of a quaternion x, y, z, w of any length; `None` for the zero quaternion.
pub(super) fn roll_pitch_yaw(quaternion: &[Number; 4]) -> Option<[Number; 3]> {
    let [x, y, z, w] = quaternion.each_ref().map(Number::value);
    let length = x.hypot(y).hypot(z.hypot(w));
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let [x, y, z, w] = [x, y, z, w].map(|part| part / length);
    // The sine of the pitch, which rounding may carry beyond 1.
    let sine = 2.0 * (w * y - z * x);
    let angles = if sine.abs() >= 1.0 - 1e-15 {
        // Straight up or down, roll and yaw turn about one axis: all of it is told as yaw.
        let yaw = -2.0 * sine.signum() * x.atan2(w);
        [0.0, sine.signum() * std::f64::consts::FRAC_PI_2, yaw]
    } else {
        [
            (2.0 * (w * x + y * z)).atan2(1.0 - 2.0 * (x * x + y * y)),
            sine.asin(),
            (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z)),
        ]
    };
    let decimals = decimals_of(quaternion);
    let [roll, pitch, yaw] = angles.map(|angle| Number::decimal(&format!("{angle:.decimals$}")));
    Some([roll.ok()?, pitch.ok()?, yaw.ok()?])
}

/// The decimals that the angles are stated with.
fn decimals_of(quaternion: &[Number; 4]) -> usize {
    let squares = quaternion
        .iter()
        .fold(Number::zero(), |sum, part| &sum + &(part * part));
    if squares == Number::one() {
        return FULL;
    }
    quaternion
        .iter()
        .filter_map(Number::stated)
        .filter(|stated| stated.significant > 0)
        .map(|stated| stated.decimals)
        .max()
        .map_or(FULL, |most| usize::try_from(most).unwrap_or(0).min(FULL))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn angles(text: &str) -> [f64; 3] {
        let parts: Vec<Number> = text
            .split_whitespace()
            .map(|word| Number::decimal(word).unwrap())
            .collect();
        let parts: [Number; 4] = parts.try_into().unwrap();
        roll_pitch_yaw(&parts).unwrap().map(|angle| angle.value())
    }

    #[test]
    fn quarter_turns() {
        for (text, expected) in [
            ("0 0 0 1", [0.0, 0.0, 0.0]),
            ("1 0 0 0", [PI, 0.0, 0.0]),
            (
                "0 0 0.70710678118654757 0.70710678118654757",
                [0.0, 0.0, FRAC_PI_2],
            ),
            (
                "0 0.7071067811865476 0 0.7071067811865476",
                [0.0, FRAC_PI_2, 0.0],
            ),
            ("0.5 0.5 0.5 0.5", [FRAC_PI_2, 0.0, FRAC_PI_2]),
        ] {
            let found = angles(text);
            for (a, b) in found.iter().zip(expected) {
                assert!((a - b).abs() < 1e-14, "{text}: {found:?}");
            }
        }
    }

    #[test]
    fn a_product_of_turns_comes_back() {
        // Yaw, pitch and roll as quaternions, multiplied by hand.
        let (r, p, y) = (0.3_f64, -0.7_f64, 1.9_f64);
        let (cr, sr, cp, sp) = (
            (r / 2.0).cos(),
            (r / 2.0).sin(),
            (p / 2.0).cos(),
            (p / 2.0).sin(),
        );
        let (cy, sy) = ((y / 2.0).cos(), (y / 2.0).sin());
        let text = format!(
            "{:.17} {:.17} {:.17} {:.17}",
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy
        );
        for (found, expected) in angles(&text).iter().zip([r, p, y]) {
            assert!((found - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn the_angles_state_the_digits_of_the_quaternion() {
        let parts = ["0", "0", "0.7071", "0.7071"].map(|word| Number::decimal(word).unwrap());
        let [.., yaw] = roll_pitch_yaw(&parts).unwrap();
        assert_eq!(yaw.stated().unwrap().decimals, 4);
        let padded = ["0.000000", "0.000000", "0.7071", "0.7071"];
        let parts = padded.map(|word| Number::decimal(word).unwrap());
        let [.., yaw] = roll_pitch_yaw(&parts).unwrap();
        assert_eq!(yaw.stated().unwrap().decimals, 4);
        let zero = ["0", "0", "0", "0"].map(|word| Number::decimal(word).unwrap());
        assert!(roll_pitch_yaw(&zero).is_none());
    }
}
