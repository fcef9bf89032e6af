//! A trace as comma-separated rows.

use kutzbach::mechanism::Mechanism;
use kutzbach::motion::{Trace, Variable};
use kutzbach::report::traced::LinkPoint;
use kutzbach::report::traced::quaternion;

/// A field of a row: quoted where a name has a comma, a quotation mark or a line break in it (RFC 4180).
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

fn header(mechanism: &Mechanism, points: &[LinkPoint]) -> String {
    let mut header = ["drive", "arclength", "closure"]
        .map(str::to_owned)
        .to_vec();
    header.extend(Variable::all(mechanism).iter().map(|v| field(&v.name)));
    for link in mechanism.links() {
        for part in ["x", "y", "z", "qw", "qx", "qy", "qz"] {
            header.push(field(&format!("{}.{part}", link.name)));
        }
    }
    for point in points {
        for part in ["x", "y", "z"] {
            header.push(field(&format!("{}.{part}", point.name)));
        }
    }
    header.join(",")
}

/// One row per pose: drive value, arclength, closure, joint variables by name, then x y z and qw qx qy qz of every link, then x y z of
/// every point asked for.
/// Nothing but the header where nothing moves.
pub fn csv(mechanism: &Mechanism, trace: &Trace, points: &[LinkPoint]) -> String {
    let mut text = header(mechanism, points);
    let samples = trace.motion().map_or(&[][..], |motion| &motion.samples);
    for sample in samples {
        text.push('\n');
        push_number(&mut text, sample.drive);
        let mut put = |numbers: &[f64]| {
            for number in numbers {
                text.push(',');
                push_number(&mut text, *number);
            }
        };
        put(&[sample.arclength, sample.closure]);
        put(&sample.values);
        for pose in &sample.links {
            put(&pose.translation);
            put(&quaternion(pose));
        }
        for point in points {
            put(point.place(&sample.links).as_ref().map_or(&[], |at| at));
        }
    }
    text.push('\n');
    text
}

/// The shortest digits that give the same number back, in the form of `{:?}`; of two that are as near, the even one.
fn push_number(text: &mut String, number: f64) {
    if number.to_bits() == 0 {
        return text.push_str("0.0");
    }
    let mut buffer = zmij::Buffer::new();
    let written = buffer.format(number);
    let size = number.abs();
    if size == 0.0 || (1e-4..1e16).contains(&size) {
        return text.push_str(written);
    }
    // An exponent is short: it is looked for from the end.
    let place = written.bytes().rposition(|byte| byte == b'e');
    let Some((digits, exponent)) = place.and_then(|at| written.split_at_checked(at)) else {
        return text.push_str(&format!("{number:?}"));
    };
    // Without `.0`, and without sign and zeros of a positive exponent.
    text.push_str(digits.strip_suffix(".0").unwrap_or(digits));
    let value = exponent.trim_start_matches(['e', '+', '-', '0']);
    text.push_str(if exponent.starts_with("e-") {
        "e-"
    } else {
        "e"
    });
    text.push_str(value);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_in_full_and_in_one_form() {
        let mut seed = 1u64;
        let random = std::iter::repeat_with(|| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            f64::from_bits(seed)
        });
        let powers = (-330..310).map(|e| 10f64.powi(e));
        let ends = [
            0.0,
            -0.0,
            1.0,
            0.1,
            -1.5e-5,
            1e-4,
            9.999e-5,
            1e15,
            1e16,
            1.5e16,
            f64::MAX,
        ];
        let odd = [f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE, 5e-324];
        let all = random
            .filter(|x| !x.is_nan())
            .take(20_000)
            .chain(powers)
            .chain(ends)
            .chain(odd);
        for number in all {
            for number in [number, -number, number.abs().sqrt()] {
                let mut text = String::new();
                push_number(&mut text, number);
                let known = format!("{number:?}");
                let form = |text: &str| -> String {
                    let digit = |c: char| if c.is_ascii_digit() { '0' } else { c };
                    text.chars().map(digit).collect()
                };
                assert_eq!(form(&text), form(&known));
                assert_eq!(text.parse(), Ok(number), "{known}");
            }
        }
    }
}
