//! `quat_xyzw`, the other way in which URDF writes how a frame is turned (urdfdom 2 and later).
//!
//! A frame keeps roll, pitch and yaw. The angles are worked out in doubles and stated with as many decimals as the quaternion has besides zeros,
//! so that its precision stays part of the file; one whose squares add up to exactly 1, such as `0 0 0 1` or
//! `0.5 0.5 0.5 0.5`, states them in full.

use kutzbach_math::number::Number;
use kutzbach_math::space::{cross, dot};
use kutzbach_model::mechanism::Precision;

/// Decimals of angles in full double precision.
const FULL: usize = 15;

/// Roll, pitch and yaw (rad, about fixed axes) of a quaternion x, y, z, w of any length; `None` for the zero quaternion.
pub(super) fn roll_pitch_yaw(quaternion: &[Number; 4]) -> Option<[Number; 3]> {
    let values = quaternion.each_ref().map(Number::value);
    stated(angles(values)?, decimals_of(quaternion))
}

/// Roll, pitch and yaw of a quaternion that was computed, stated in full.
pub(super) fn angles_of(quaternion: [f64; 4]) -> Option<[Number; 3]> {
    stated(angles(quaternion)?, FULL)
}

/// Roll, pitch and yaw of a matrix of rotation by its rows; `None` where it is none: its columns are not orthonormal, or left-handed.
///
/// Solvers store matrices that are off by what they stop at, so the rotation taken is one near by: the turn that the columns say best. A
/// matrix that is orthonormal in doubles says its angles in full, and another one with as many decimals as its larger entries have.
pub(super) fn roll_pitch_yaw_of_rows(rows: &[[Number; 3]; 3]) -> Option<[Number; 3]> {
    let columns = [0, 1, 2].map(|j| [0, 1, 2].map(|i| rows[i][j].value()));
    let [x, y, z] = &columns;
    let off = (0..3)
        .flat_map(|j| (0..=j).map(move |k| (j, k)))
        .map(|(j, k)| (dot(&columns[j], &columns[k]) - if j == k { 1.0 } else { 0.0 }).abs())
        .fold(0.0, f64::max);
    if !(off <= NEARLY_ORTHONORMAL && dot(&cross(x, y), z) > 0.0) {
        return None;
    }
    let larger: Vec<Number> = rows
        .as_flattened()
        .iter()
        .filter(|entry| entry.value().abs() > 1e-3)
        .cloned()
        .collect();
    let decimals = match off <= ORTHONORMAL {
        true => FULL,
        false => most_decimals(&larger).unwrap_or(FULL),
    };
    stated(angles(of_columns(columns))?, decimals)
}

/// Products of columns of a matrix in doubles are off by so much, with some steps of computing behind it.
const ORTHONORMAL: f64 = 3e-15;

/// Products of columns beyond this are no rotation that was rounded to three decimals, or left by a solver.
const NEARLY_ORTHONORMAL: f64 = 3e-3;

/// The quaternion of a rotation that takes the axes to these columns, which are orthonormal.
pub(super) fn of_columns([x, y, z]: [[f64; 3]; 3]) -> [f64; 4] {
    let trace = x[0] + y[1] + z[2];
    // The largest of the four parts is divided by: Shepperd's method.
    let parts = [
        [
            1.0 + x[0] - y[1] - z[2],
            y[0] + x[1],
            z[0] + x[2],
            y[2] - z[1],
        ],
        [
            y[0] + x[1],
            1.0 - x[0] + y[1] - z[2],
            z[1] + y[2],
            z[0] - x[2],
        ],
        [
            z[0] + x[2],
            z[1] + y[2],
            1.0 - x[0] - y[1] + z[2],
            x[1] - y[0],
        ],
        [y[2] - z[1], z[0] - x[2], x[1] - y[0], 1.0 + trace],
    ];
    let diagonal = |i: usize| parts[i][i];
    let largest = (0..4).max_by(|&i, &j| diagonal(i).total_cmp(&diagonal(j)));
    let row = parts[largest.unwrap_or(3)];
    let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
    row.map(|part| part / length)
}

fn stated(angles: [f64; 3], decimals: usize) -> Option<[Number; 3]> {
    let [roll, pitch, yaw] = angles.map(|angle| Number::decimal(&format!("{angle:.decimals$}")));
    Some([roll.ok()?, pitch.ok()?, yaw.ok()?])
}

fn angles([x, y, z, w]: [f64; 4]) -> Option<[f64; 3]> {
    let length = x.hypot(y).hypot(z.hypot(w));
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let [x, y, z, w] = [x, y, z, w].map(|part| part / length);
    // The sine of the pitch, which rounding may carry beyond 1.
    let sine = 2.0 * (w * y - z * x);
    Some(if sine.abs() >= 1.0 - 1e-15 {
        // Straight up or down, roll and yaw turn about one axis: all of it is told as yaw.
        let yaw = -2.0 * sine.signum() * x.atan2(w);
        [0.0, sine.signum() * std::f64::consts::FRAC_PI_2, yaw]
    } else {
        [
            (2.0 * (w * x + y * z)).atan2(1.0 - 2.0 * (x * x + y * y)),
            sine.asin(),
            (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z)),
        ]
    })
}

/// The decimals of numbers that were rounded to them; `None` where they were chosen, with fewer than anybody rounds to.
fn most_decimals(numbers: &[Number]) -> Option<usize> {
    numbers
        .iter()
        .filter_map(Number::stated)
        .filter(|stated| stated.significant > 0)
        .map(|stated| stated.decimals)
        .max()
        .filter(|most| *most > Precision::EXACT_DECIMALS)
        .map(|most| usize::try_from(most).unwrap_or(0).min(FULL))
}

/// The decimals that the angles are stated with: those of a unit quaternion that was rounded to them. One of another length, such as
/// `1 0 0 1`, was chosen and says its angle in full.
fn decimals_of(quaternion: &[Number; 4]) -> usize {
    let Some(decimals) = most_decimals(quaternion) else {
        return FULL;
    };
    let squares = quaternion
        .iter()
        .fold(Number::zero(), |sum, part| &sum + &(part * part));
    // Parts that are off by half a unit each change the square of the length by up to twice their sum.
    let parts: f64 = quaternion.iter().map(|part| part.value().abs()).sum();
    let open = parts * 0.1f64.powi(i32::try_from(decimals).unwrap_or(0));
    let off = (squares.value() - 1.0).abs();
    match squares == Number::one() || off > 2.0 * open {
        true => FULL,
        false => decimals,
    }
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
    fn a_quaternion_of_another_length_or_of_few_decimals_says_its_angle_in_full() {
        for (text, yaw) in [
            ("0 0 1 1", FRAC_PI_2),
            ("0 0 0.7 0.7", FRAC_PI_2),
            ("0 0 0.1 0.9", 2.0 * 0.1f64.atan2(0.9)),
            ("0 0 0.38268 0.23", 2.0 * 0.38268f64.atan2(0.23)),
        ] {
            assert!((angles(text)[2] - yaw).abs() < 1e-14, "{text}");
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
