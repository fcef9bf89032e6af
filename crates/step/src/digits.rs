//! How well the coordinates of a file are known by the digits with which they are printed.
//!
//! The uncertainty that a context states is the tolerance of the kernel that made the solids. Whoever converts a file may print it with
//! fewer digits than that tolerance wants: with so many decimals, so many significant digits, or from numbers of single precision. Then
//! an axis that two parts share is written as two, apart by what the printing has cut off.
//!
//! Numbers of ten significant digits and more are doubles, whose error is below every other one here. Where no number has more than
//! four, they are a designer's own and exact.

use crate::part21::Exchange;

/// Magnitudes up to this are residues of arithmetic, in whatever unit: their digits say nothing of others.
const RESIDUE: f64 = 1e-7;

/// The most significant digits with which a designer types.
const TYPED: usize = 4;

/// The most significant digits of numbers that were rounded: what has more is a double, or a number of single precision in full.
const ROUNDED: usize = 9;

/// Up to so many significant digits every decimal number is one of single precision too.
const ANY_SINGLE: usize = 7;

/// A number of single precision is off by this share of itself at most.
const SINGLE: f64 = 1.0 / (1u32 << 24) as f64;

/// How far a component of the entities of this keyword (`CARTESIAN_POINT`, `DIRECTION`) of three components may be off, in the unit of the file:
/// half a unit of the last digit. Zero where they are printed with ten digits and more, or with four and fewer.
pub(crate) fn uncertainty(file: &Exchange<'_>, keyword: &str) -> f64 {
    let mut digits = Digits::default();
    for instance in file.instances() {
        let Some(record) = instance.leaf(keyword) else {
            continue;
        };
        // What is wrong with a point is told where it is used; one of two components is no length but a parameter.
        let Ok(numbers) = record.numbers_at(1) else {
            continue;
        };
        if numbers.len() != 3 {
            continue;
        }
        if !numbers.into_iter().all(|number| digits.add(number)) {
            return 0.0;
        }
    }
    digits.uncertainty()
}

/// What is known of the numbers so far.
struct Digits {
    /// The largest magnitude with so many significant digits, by their number.
    largest: [f64; 18],
    /// Whether all of them are numbers of single precision.
    single: bool,
}

impl Default for Digits {
    fn default() -> Self {
        Self {
            largest: [0.0; 18],
            single: true,
        }
    }
}

impl Digits {
    /// Looks at one more number; false where it shows that all are doubles.
    fn add(&mut self, number: f64) -> bool {
        let size = number.abs();
        if !(size > RESIDUE) {
            return true;
        }
        let significant = significant_digits(size);
        self.single &= is_single(size);
        if let Some(largest) = self.largest.get_mut(significant) {
            *largest = largest.max(size);
        }
        significant <= ROUNDED || self.single
    }

    fn uncertainty(&self) -> f64 {
        let Some(most) = self.largest.iter().rposition(|size| *size > 0.0) else {
            return 0.0;
        };
        if most <= TYPED {
            return 0.0;
        }
        if self.single && most > ANY_SINGLE {
            return SINGLE * self.largest.iter().copied().fold(0.0, f64::max);
        }
        // One in ten has lost a zero at its end; what is much shorter was another's number.
        let full = self.largest.get(most - 1..).unwrap_or_default();
        let largest = full.iter().copied().fold(0.0, f64::max);
        // Of a number of `most` digits the last counts units of this power of ten.
        let last = largest.log10().floor() as i32 + 1 - most as i32;
        0.5 * 10f64.powi(last)
    }
}

/// Significant digits of the shortest text that is this number.
fn significant_digits(size: f64) -> usize {
    let text = format!("{size:e}");
    let mantissa = text.split('e').next().unwrap_or_default();
    mantissa.bytes().filter(u8::is_ascii_digit).count()
}

/// Whether a number is one of single precision, in full or by the shortest text of it.
fn is_single(size: f64) -> bool {
    let single = size as f32;
    f64::from(single) == size || single.to_string().parse::<f64>() == Ok(size)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(texts: &[&str]) -> f64 {
        let mut digits = Digits::default();
        let rounded = texts
            .iter()
            .all(|text| text.parse::<f64>().is_ok_and(|number| digits.add(number)));
        if rounded { digits.uncertainty() } else { 0.0 }
    }

    #[test]
    fn digits_say_how_numbers_were_printed() {
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
        // Decimals, some of which have lost their zeros; what was typed among them, and a residue.
        let decimals = ["12.34567", "-108.5", "108.1235", "0.00012", "80", "2.2e-16"];
        assert!(near(of(&decimals), 0.5e-4), "{}", of(&decimals));
        assert!(near(of(&["0.7352371", "-0.5492539", "1", "0"]), 0.5e-7));
        // Significant digits: small numbers have more decimals, the largest is off most.
        assert!(near(of(&["108.123", "0.00123456", "7.65432"]), 0.5e-3));
        // Single precision in full, and in its shortest text.
        let full = f64::from(80.123_46_f32).to_string();
        assert!(near(
            of(&[&full, "1.5"]),
            f64::from(80.123_46_f32) / f64::from(1 << 24)
        ));
        assert!(near(of(&["0.12345678"]), 0.123_456_78 / f64::from(1 << 24)));
        // Doubles, and what a designer types.
        assert_eq!(of(&["80.12345678901", "1.5"]), 0.0);
        assert_eq!(of(&["80", "12.25", "0.125"]), 0.0);
        assert_eq!(of(&[]), 0.0);
    }
}
