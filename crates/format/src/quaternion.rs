//! `quat_xyzw`, the other way in which URDF writes how a frame is turned (urdfdom 2 and later).
//!
//! A frame keeps roll, pitch and yaw. The angles are worked out in doubles, in full, and where the quaternion was rounded they know its parts, so that its
//! precision stays part of the file; one whose squares add up to exactly 1, such as `0 0 0 1` or `0.5 0.5 0.5 0.5`, is exact. So it is with other ways
//! of saying how a frame is turned ([`worked_out`]).

use kutzbach_math::number::{Inputs, Number, Quantity};
use kutzbach_math::space::{cross, dot, length};
use kutzbach_model::mechanism::{Frame, Precision, roll_pitch_yaw_rates};
use std::array::from_fn;

/// Decimals of angles in full double precision.
const FULL: usize = 15;

/// Numbers are changed by so much to see how a turn depends on them, components of directions by so much of their size: what is left of the third order, and of rounding, is
/// 1e-10 of that.
const STEP: f64 = 1e-5;

/// What is left of a derivative that is zero is below this.
const NO_RATE: f64 = 1e-8;

/// No turn follows what says it so fast (rad, per size of that): it jumps, as the least turn from z to −z does, and has no derivative.
const JUMP: f64 = 100.0;

/// Roll, pitch and yaw (rad, about fixed axes) of a quaternion x, y, z, w of any length; `None` for the zero quaternion.
pub(super) fn roll_pitch_yaw(quaternion: &[Number; 4]) -> Option<[Number; 3]> {
    match is_rounded(quaternion) {
        false => angles_of(quaternion.each_ref().map(Number::value)),
        true => {
            let parts = quaternion.each_ref();
            worked_out(parts.map(|x| (Quantity::Angle, x)), Some)
        }
    }
}

/// Roll, pitch and yaw (rad, in full) of the quaternion x, y, z, w, of any length, that `turn` makes of some numbers; they know these numbers.
/// `None` where it makes none of them.
pub(super) fn worked_out<const N: usize>(
    numbers: [(Quantity, &Number); N],
    turn: impl Fn([f64; N]) -> Option<[f64; 4]>,
) -> Option<[Number; 3]> {
    let values = numbers.map(|(_, number)| number.value());
    let found = angles_of(turn(values)?)?;
    let pose = Frame {
        roll_pitch_yaw: found.clone(),
        ..Frame::identity()
    };
    let pose = pose.to_doubles();
    let directions = numbers.iter().zip(values);
    let directions = directions.filter(|((quantity, _), _)| *quantity == Quantity::Direction);
    let size = directions.fold(0.0, |size: f64, (_, value)| size.max(value.abs()));
    let mut inputs: [Inputs; 3] = Default::default();
    for (index, (quantity, number)) in numbers.into_iter().enumerate() {
        let step = match quantity {
            Quantity::Direction => STEP * size,
            _ => STEP,
        };
        let moved = |by: f64| turn(from_fn(|i| values[i] + if i == index { by } else { 0.0 }));
        let (Some(before), Some(after)) = (moved(-step), moved(step)) else {
            continue;
        };
        let turned = turned_between(before, after);
        if length(&turned) > 2.0 * STEP * JUMP {
            continue;
        }
        let rates = roll_pitch_yaw_rates(&pose, &turned.map(|x| x / (2.0 * step)));
        for (inputs, rate) in inputs.iter_mut().zip(rates) {
            let rate = if rate.abs() > NO_RATE { rate } else { 0.0 };
            inputs.add(quantity, number, rate);
        }
    }
    let [roll, pitch, yaw] = found;
    let [of_roll, of_pitch, of_yaw] = inputs;
    Some([
        roll.derived_from(of_roll),
        pitch.derived_from(of_pitch),
        yaw.derived_from(of_yaw),
    ])
}

/// The rotation vector (rad) of the small turn from one orientation to another one: quaternions of any length.
fn turned_between(from: [f64; 4], to: [f64; 4]) -> [f64; 3] {
    let [x, y, z, w] = from;
    let [x, y, z, w] = product(to, [-x, -y, -z, w]);
    [x, y, z].map(|part| 2.0 * part / w)
}

/// The turn `a` after the turn `b`, as quaternions x, y, z, w.
pub(super) fn product(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    let [ax, ay, az, aw] = a;
    let [bx, by, bz, bw] = b;
    [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
}

/// Roll, pitch and yaw of a quaternion that was computed, stated in full.
pub(super) fn angles_of(quaternion: [f64; 4]) -> Option<[Number; 3]> {
    let [roll, pitch, yaw] =
        angles(quaternion)?.map(|angle| Number::decimal(&format!("{angle:.FULL$}")));
    Some([roll.ok()?, pitch.ok()?, yaw.ok()?])
}

/// Roll, pitch and yaw of a matrix of rotation by its rows; `None` where it is none: its columns are not orthonormal, or left-handed.
///
/// Solvers store matrices that are off by what they stop at, so the rotation taken is one near by: the turn that the columns say best. A
/// matrix that is orthonormal in doubles says its angles exactly, and another one as well as its entries are known.
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
    match off > ORTHONORMAL && rounded_to(&larger).is_some() {
        false => angles_of(of_columns(columns)),
        true => {
            let entries = from_fn(|i| (Quantity::Angle, &rows[i / 3][i % 3]));
            worked_out::<9>(entries, |at| {
                let column = |j: usize| [at[j], at[j + 3], at[j + 6]];
                Some(of_columns([column(0), column(1), column(2)]))
            })
        }
    }
}

/// Products of columns of a matrix in doubles are off by so much, with some steps of computing behind it.
const ORTHONORMAL: f64 = 3e-15;

/// Products of columns beyond this are no rotation that was rounded to three decimals, or left by a solver: entries that are off by half a unit of the third
/// change a product by up to that times the sizes of all entries of two columns, 2 √3 at most.
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
fn rounded_to(numbers: &[Number]) -> Option<i32> {
    let stated = numbers.iter().filter_map(Number::stated);
    let decimals = stated
        .filter(|own| own.significant > 0)
        .map(|own| own.decimals);
    decimals
        .max()
        .filter(|most| *most > Precision::EXACT_DECIMALS)
}

/// Decimals beyond these are below the rounding of a double.
const IN_DOUBLES: i32 = 15;

/// Programs print single precision with so many significant digits at least.
const OF_SINGLE_PRECISION: u32 = 8;

/// The square of the length of a unit quaternion in single precision is off by less than this: four units of roundoff for its parts, and as
/// many for the arithmetic behind them.
const SINGLE: f64 = 8.0 / (1u64 << 24) as f64;

/// Whether a unit quaternion was rounded. One of another length, such as `1 0 0 1`, was chosen and says its angle exactly, as does one whose length
/// is exactly 1.
fn is_rounded(quaternion: &[Number; 4]) -> bool {
    let Some(decimals) = rounded_to(quaternion) else {
        return false;
    };
    let squares = quaternion
        .iter()
        .fold(Number::zero(), |sum, part| &sum + &(part * part));
    // Parts that are off by half a unit each change the square of the length by up to twice their sum.
    let parts: f64 = quaternion.iter().map(|part| part.value().abs()).sum();
    let open = parts * 0.1f64.powi(decimals.min(IN_DOUBLES));
    let off = (squares.value() - 1.0).abs();
    let long = |part: &Number| {
        let stated = part.stated();
        stated.is_some_and(|stated| stated.significant >= OF_SINGLE_PRECISION)
    };
    let room = match quaternion.iter().any(long) {
        true => (2.0 * open).max(SINGLE),
        false => 2.0 * open,
    };
    squares != Number::one() && off <= room
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
    fn a_matrix_is_a_rotation_within_three_decimals() {
        let stretched = |by: f64| {
            let text = format!("{by:.6}");
            let [one, zero] = [&text[..], "0.000000"];
            let rows = [
                [one, zero, zero],
                [zero, "1.000000", zero],
                [zero, zero, "1.000000"],
            ];
            let rows = rows.map(|row| row.map(|entry| Number::decimal(entry).unwrap()));
            roll_pitch_yaw_of_rows(&rows).is_some()
        };
        // The first column times itself is off by twice as much.
        assert!(stretched(1.00149) && stretched(0.99851));
        assert!(!stretched(1.00151) && !stretched(0.99849));
    }

    #[test]
    fn a_turn_that_jumps_has_no_derivative() {
        let number = |text: &str| (Quantity::Direction, Number::decimal(text).unwrap());
        let [x, z] = [number("0.000000"), number("-1.000000")];
        let turned = |numbers: [(Quantity, &Number); 2]| {
            worked_out(numbers, |[x, z]| {
                let half = 0.5 * x.atan2(z);
                Some([0.0, half.sin(), 0.0, half.cos()])
            })
        };
        // The angle of a point on a circle is π or −π where x changes its sign, which is one turn; twice its half is not.
        let [_, pitch, _] = turned([(x.0, &x.1), (z.0, &z.1)]).unwrap();
        assert!(pitch.inputs().iter().all(|input| input.slope <= 1.0 + 1e-6));
        let jumping = worked_out([(x.0, &x.1), (z.0, &z.1)], |[x, _]| {
            let half = if x > 0.0 { 0.5 } else { -0.5 };
            Some([half, 0.0, 0.0, 1.0])
        });
        assert!(
            jumping
                .unwrap()
                .iter()
                .all(|angle| angle.inputs().is_empty())
        );
    }

    /// Half a unit of the fourth decimal of every part, as far as it turns the angles.
    #[test]
    fn the_angles_are_as_uncertain_as_the_parts_of_the_quaternion() {
        let parts = ["0.1830", "-0.3652", "0.5489", "0.7291"];
        let parts = parts.map(|word| Number::decimal(word).unwrap());
        let found = roll_pitch_yaw(&parts).unwrap();
        let half = 0.5e-4;
        let spreads = found.each_ref().map(|angle| {
            let slopes = angle.inputs().iter().map(|input| input.slope);
            slopes.sum::<f64>() * half
        });
        let values = parts.each_ref().map(Number::value);
        let mut nearest = [0.0f64; 3];
        for corner in 0..16 {
            let meant = [0, 1, 2, 3].map(|i| match (corner >> i) & 1 {
                1 => values[i] + half,
                _ => values[i] - half,
            });
            let meant = super::angles(meant).unwrap();
            for i in 0..3 {
                let off = (found[i].value() - meant[i]).abs();
                // Products of two changes are left out.
                let most = 1.001 * spreads[i];
                assert!(off <= most, "{off:e} is more than {most:e}");
                nearest[i] = nearest[i].max(off / spreads[i]);
            }
        }
        assert!(nearest.iter().all(|share| *share > 0.5), "{nearest:?}");
    }

    #[test]
    fn what_is_chosen_has_no_inputs_and_single_precision_has() {
        let inputs = |parts: [&str; 4]| {
            let parts = parts.map(|word| Number::decimal(word).unwrap());
            let [.., yaw] = roll_pitch_yaw(&parts).unwrap();
            yaw.inputs().len()
        };
        assert_eq!(inputs(["0", "0", "1", "1"]), 0);
        assert_eq!(inputs(["0", "0", "0.6", "0.8"]), 0);
        assert_eq!(inputs(["0", "0", "0.38268", "0.23"]), 0);
        assert!(inputs(["0", "0", "3.826834261e-01", "9.238795042e-01"]) > 0);
    }

    /// 0.707108 is not cos 45°: as angles of six decimals such turns were off by up to 5e-7, and a body behind two of them by 8e-7.
    #[test]
    fn the_angles_are_those_of_the_parts_as_written_and_know_their_digits() {
        for [z, w] in [
            ["0.7071", "0.7071"],
            ["0.707108", "0.707105"],
            ["0.252", "0.968"],
        ] {
            for zero in ["0", "0.000000"] {
                let parts = [zero, zero, z, w].map(|word| Number::decimal(word).unwrap());
                let [.., yaw] = roll_pitch_yaw(&parts).unwrap();
                let expected = 2.0 * parts[2].value().atan2(parts[3].value());
                assert!((yaw.value() - expected).abs() < 2e-15, "{z} {w}");
                let decimals = i32::try_from(z.len() - 2).unwrap();
                let mut known = yaw.inputs().iter().map(|own| own.literal.stated().unwrap());
                assert!(!yaw.inputs().is_empty() && known.all(|own| own.decimals == decimals));
            }
        }
        let zero = ["0", "0", "0", "0"].map(|word| Number::decimal(word).unwrap());
        assert!(roll_pitch_yaw(&zero).is_none());
    }
}
