//! How well the coordinates of a file are known by the digits with which they are printed.
//!
//! The uncertainty that a context states is the tolerance of the kernel that made the solids. Whoever converts a file may print it with
//! fewer digits than that tolerance wants: with so many decimals, so many significant digits, or from numbers of single precision. Then
//! an axis that two parts share is written as two, apart by what the printing has cut off.
//!
//! Numbers of ten significant digits and more are doubles, whose error is below every other one here. Where no number has more than
//! four, they are a designer's own and exact, unless they look as rounding leaves them: nine in ten with a last digit, any of the nine.

use crate::part21::Exchange;
use std::collections::BTreeMap;

/// Magnitudes up to this are residues of arithmetic, in whatever unit: their digits say nothing of others.
const RESIDUE: f64 = 1e-7;

/// The most significant digits with which a designer types.
const TYPED: usize = 4;

/// So many different numbers at least tell what was rounded from what was typed.
const MANY: usize = 20;

/// Of rounded numbers at least this share goes to the last place: nine in ten do, and some are a designer's, such as heights of what was turned in its
/// plane. Of typed ones a quarter does.
const FULL: f64 = 0.6;

/// Of these, no digit ends more than this share: one in nine does of rounded ones, and of typed ones mostly a five.
const EVEN: f64 = 1.0 / 3.0;

/// The most significant digits of numbers that were rounded: what has more is a double, or a number of single precision in full.
const ROUNDED: usize = 9;

/// Up to so many significant digits every decimal number is one of single precision too.
const ANY_SINGLE: usize = 7;

/// A number of single precision is off by this share of itself at most.
const SINGLE: f64 = 1.0 / (1u32 << 24) as f64;

/// How far a component of the entities of this keyword (`CARTESIAN_POINT`, `DIRECTION`) of three components may be off, in the unit of the file:
/// half a unit of the last digit. Zero where they are printed with ten digits and more, or typed.
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
    /// The different ones of [`TYPED`] digits at most, by the bits of their magnitudes.
    few: BTreeMap<u64, Shortest>,
}

impl Default for Digits {
    fn default() -> Self {
        Self {
            largest: [0.0; 18],
            single: true,
            few: BTreeMap::new(),
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
        let shortest = Shortest::of(size);
        let significant = shortest.significant;
        if significant <= TYPED {
            self.few.insert(size.to_bits(), shortest);
        }
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
            return self.of_few(most);
        }
        if self.single && most > ANY_SINGLE {
            return SINGLE * self.largest.iter().copied().fold(0.0, f64::max);
        }
        // One in ten has lost a zero at its end; what is much shorter was another's number.
        let full = self.largest.get(most - 1..).unwrap_or_default();
        half_of_last(full.iter().copied().fold(0.0, f64::max), most)
    }

    /// The same where no number has more digits than one types: printed with so many decimals, or with so many significant digits.
    fn of_few(&self, most: usize) -> f64 {
        let decimals = self.few.values().map(|own| own.decimals).max();
        // Whole numbers of the unit are chosen.
        let Some(decimals) = decimals.filter(|decimals| *decimals > 0) else {
            return 0.0;
        };
        if self.are_rounded(|own| own.decimals == decimals) {
            return 0.5 * 0.1f64.powi(decimals);
        }
        if most == TYPED && self.are_rounded(|own| own.significant == most) {
            let largest = self.largest.get(most).copied().unwrap_or_default();
            return half_of_last(largest, most);
        }
        0.0
    }

    /// Whether rounding left these numbers, where those in full go to the last place.
    fn are_rounded(&self, is_full: impl Fn(&Shortest) -> bool) -> bool {
        let mut ends = [0_usize; 10];
        for own in self.few.values().filter(|own| is_full(own)) {
            if let Some(count) = ends.get_mut(usize::from(own.last)) {
                *count += 1;
            }
        }
        let full: usize = ends.iter().sum();
        let most = ends.iter().copied().max().unwrap_or(0);
        self.few.len() >= MANY
            && full as f64 >= FULL * self.few.len() as f64
            && most as f64 <= EVEN * full as f64
    }
}

/// Half a unit of the last of so many significant digits of a number.
fn half_of_last(size: f64, digits: usize) -> f64 {
    let last = size.log10().floor() as i32 + 1 - digits as i32;
    0.5 * 10f64.powi(last)
}

/// The shortest text that is a number.
struct Shortest {
    /// Its significant digits, and those behind the point, which are negative where zeros stand before it.
    significant: usize,
    decimals: i32,
    /// The last of its digits.
    last: u8,
}

impl Shortest {
    fn of(size: f64) -> Self {
        let text = format!("{size:e}");
        let (mantissa, power) = text.split_once('e').unwrap_or((text.as_str(), "0"));
        let digits = || mantissa.bytes().filter(u8::is_ascii_digit);
        let significant = digits().count();
        let power: i32 = power.parse().unwrap_or(0);
        Self {
            significant,
            decimals: significant as i32 - 1 - power,
            last: digits().next_back().map_or(0, |digit| digit - b'0'),
        }
    }
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

    /// Coordinates of a design that was turned in its plane and printed in hundredths, or in four digits, and of one that was typed.
    #[test]
    fn few_digits_are_rounded_where_they_end_in_all_ways() {
        let turned = |print: &dyn Fn(f64) -> String| -> Vec<String> {
            let (sine, cosine) = 0.3f64.sin_cos();
            let corners = (1..20).map(|i| (f64::from(3 * i), f64::from(i * i % 17)));
            let both = corners.flat_map(|(x, y)| [x * cosine - y * sine, x * sine + y * cosine]);
            let heights = ["5".to_owned(), "7.5".to_owned()].into_iter();
            both.map(print).chain(heights).collect()
        };
        let of_texts =
            |texts: Vec<String>| of(&texts.iter().map(String::as_str).collect::<Vec<_>>());
        let hundredths = turned(&|x| format!("{x:.2}"));
        assert!((of_texts(hundredths.clone()) / 0.5e-2 - 1.0).abs() < 1e-9);
        // A few of them may be anybody's.
        assert_eq!(of_texts(hundredths.into_iter().take(12).collect()), 0.0);
        let four = turned(&|x| format!("{x:.3e}"));
        assert!((of_texts(four) / 0.5e-2 - 1.0).abs() < 1e-9);
        let typed = |i: u32| f64::from(i) * if i.is_multiple_of(3) { 0.5 } else { 1.25 };
        assert_eq!(
            of_texts((1..60).map(|i| typed(i).to_string()).collect()),
            0.0
        );
        assert_eq!(
            of_texts((1..60).map(|i| (7 * i).to_string()).collect()),
            0.0
        );
    }
}
