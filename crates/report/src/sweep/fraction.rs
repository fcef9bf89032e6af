//! Exact values of measures: fractions small enough for ordinary integers, and how they are written.

use std::fmt;

/// Digits that a number may have before and after its point together, and places its exponent may move the point.
const MOST_DIGITS: usize = 12;

/// A fraction in lowest terms, its denominator positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fraction {
    numerator: i128,
    denominator: i128,
}

impl Fraction {
    /// The fraction of two integers; `None` where the denominator is zero or a number too large.
    #[must_use]
    pub fn new(numerator: i128, denominator: i128) -> Option<Self> {
        if denominator == 0 || numerator == i128::MIN || denominator == i128::MIN {
            return None;
        }
        let common = common_divisor(numerator.unsigned_abs(), denominator.unsigned_abs());
        let common = i128::try_from(common).ok()?;
        let sign = denominator.signum();
        Some(Self {
            numerator: sign * numerator / common,
            denominator: sign * denominator / common,
        })
    }

    /// Reads `-0.25`, `1e-3` or `1/3`; `None` where it is something else, or has more than twelve digits.
    #[must_use]
    pub fn read(written: &str) -> Option<Self> {
        let written = written.trim();
        if let Some((above, below)) = written.split_once('/') {
            let (above, below) = (decimal(above.trim())?, decimal(below.trim())?);
            let numerator = above.numerator.checked_mul(below.denominator)?;
            return Self::new(numerator, above.denominator.checked_mul(below.numerator)?);
        }
        decimal(written)
    }

    /// The number that lies `part` of `whole` equal steps on the way from one number to another; `None` where `whole` is zero
    /// or a number gets too large.
    #[must_use]
    pub fn between(from: Self, to: Self, part: u64, whole: u64) -> Option<Self> {
        let common = common_divisor(
            from.denominator.unsigned_abs(),
            to.denominator.unsigned_abs(),
        );
        let common = i128::try_from(common).ok()?;
        // from = a / L and to = b / L with the least L.
        let least = (from.denominator / common).checked_mul(to.denominator)?;
        let a = from.numerator.checked_mul(to.denominator / common)?;
        let b = to.numerator.checked_mul(from.denominator / common)?;
        let left = i128::from(whole.checked_sub(part)?);
        let numerator = a
            .checked_mul(left)?
            .checked_add(b.checked_mul(i128::from(part))?)?;
        Self::new(numerator, least.checked_mul(i128::from(whole))?)
    }

    /// The number as an expression that is exact wherever a file is read: `3`, `1/200`. (A decimal of three places or more
    /// would say of itself that it is rounded.)
    #[must_use]
    pub fn expression(&self) -> String {
        match self.denominator {
            1 => self.numerator.to_string(),
            _ => format!("{}/{}", self.numerator, self.denominator),
        }
    }

    /// The number as a decimal with as many places as it needs; `None` where no number of places is enough, as for 1/3.
    #[must_use]
    pub fn decimal(&self) -> Option<String> {
        let (mut rest, mut twos, mut fives) = (self.denominator, 0_u32, 0_u32);
        while rest % 2 == 0 {
            rest /= 2;
            twos += 1;
        }
        while rest % 5 == 0 {
            rest /= 5;
            fives += 1;
        }
        if rest != 1 {
            return None;
        }
        let places = twos.max(fives);
        let scale = 10_i128.checked_pow(places)?;
        let scaled = self.numerator.checked_mul(scale / self.denominator)?;
        if places == 0 {
            return Some(scaled.to_string());
        }
        let sign = if scaled < 0 { "-" } else { "" };
        let (size, scale) = (scaled.unsigned_abs(), scale.unsigned_abs());
        let width = usize::try_from(places).ok()?;
        Some(format!("{sign}{}.{:0width$}", size / scale, size % scale))
    }
}

impl fmt::Display for Fraction {
    /// As a short decimal, or as a fraction where there is none.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.decimal() {
            Some(decimal) => f.write_str(&decimal),
            None => f.write_str(&self.expression()),
        }
    }
}

/// Reads a decimal with or without an exponent.
fn decimal(written: &str) -> Option<Fraction> {
    let (mantissa, exponent) = match written.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (written, 0),
    };
    let (negative, size) = match mantissa.strip_prefix('-') {
        Some(size) => (true, size),
        None => (false, mantissa.strip_prefix('+').unwrap_or(mantissa)),
    };
    let (whole, places) = size.split_once('.').unwrap_or((size, ""));
    let digits = format!("{whole}{places}");
    let is_number = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    if !is_number || digits.trim_start_matches('0').len() > MOST_DIGITS {
        return None;
    }
    // Zeros alone may be many; a number of them is still zero.
    let value: i128 = match digits.trim_start_matches('0') {
        "" => 0,
        significant => significant.parse().ok()?,
    };
    let value = if negative { -value } else { value };
    let shift = i64::from(exponent) - i64::try_from(places.len()).ok()?;
    let scale = u32::try_from(shift.unsigned_abs()).ok()?;
    if scale as usize > MOST_DIGITS {
        return (value == 0).then_some(Fraction {
            numerator: 0,
            denominator: 1,
        });
    }
    let scale = 10_i128.checked_pow(scale)?;
    match shift < 0 {
        true => Fraction::new(value, scale),
        false => Fraction::new(value.checked_mul(scale)?, 1),
    }
}

/// Euclid's algorithm; 1 where both are zero.
fn common_divisor(a: u128, b: u128) -> u128 {
    let (mut a, mut b) = (a, b);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn read(written: &str) -> Fraction {
        Fraction::read(written).unwrap()
    }

    #[test]
    fn numbers_are_read_exactly() {
        assert_eq!(read("0.25"), Fraction::new(1, 4).unwrap());
        assert_eq!(read(" -1.50 "), Fraction::new(-3, 2).unwrap());
        assert_eq!(read("1e-3"), Fraction::new(1, 1000).unwrap());
        assert_eq!(read("2.5E2"), Fraction::new(250, 1).unwrap());
        assert_eq!(read("1/3"), Fraction::new(1, 3).unwrap());
        assert_eq!(read("1/-4"), Fraction::new(-1, 4).unwrap());
        assert_eq!(read(".5"), read("5e-1"));
        assert_eq!(read("0.00000000000000"), Fraction::new(0, 1).unwrap());
        for other in [
            "",
            ".",
            "-",
            "pi",
            "1/0",
            "1//2",
            "0x1",
            "1e99",
            "1e",
            "1234567890123",
            "--1",
        ] {
            assert_eq!(Fraction::read(other), None, "{other}");
        }
    }

    #[test]
    fn steps_are_exact_and_short() {
        let steps: Vec<String> = (0..=400)
            .map(|k| {
                Fraction::between(read("0"), read("2"), k, 400)
                    .unwrap()
                    .to_string()
            })
            .collect();
        assert_eq!(&steps[..4], ["0", "0.005", "0.010", "0.015"].map(trimmed));
        assert_eq!(&steps[399..], ["1.995", "2"]);
        let third = Fraction::between(read("0"), read("1"), 1, 3).unwrap();
        assert_eq!(
            (third.to_string(), third.expression()),
            ("1/3".into(), "1/3".into())
        );
        let back = Fraction::between(read("0.1"), read("-0.1"), 3, 4).unwrap();
        assert_eq!(
            (back.to_string(), back.expression()),
            ("-0.05".into(), "-1/20".into())
        );
        assert_eq!(Fraction::between(read("0"), read("1"), 0, 0), None);
        assert_eq!(Fraction::between(read("0"), read("1"), 2, 1), None);
    }

    fn trimmed(decimal: &str) -> String {
        match decimal.contains('.') {
            true => decimal.trim_end_matches('0').to_owned(),
            false => decimal.to_owned(),
        }
    }
}
