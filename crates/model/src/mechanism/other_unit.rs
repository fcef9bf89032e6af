//! Numbers that a program rounded in degrees or inches, and then converted to radians or metres.
//!
//! `1.234567 rad` is 70.7355°, and `0.3135630 m` is 12.345 in. What rounds in such a unit and converts afterwards prints the digits of the
//! conversion, which say nothing of how far it rounded: in full they are those of doubles. All numbers of a kind are then multiples of
//! `10⁻ᵏ` units, as nearly as their own digits, and the rounding of the conversion, tell. A number that is known to ± t is as near to a multiple
//! of a step s by chance in `2t/s` of cases, and all of some numbers in the product of these; where that is below the chance allowed, they
//! were rounded to k decimals of the unit, and each may be half a step from the number meant.

/// Units that files are not written in, and programs compute in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OtherUnit {
    /// 0.0254 m.
    Inch,
    /// π/180 rad.
    Degree,
}

/// A number as it is printed: its value, and what its last digit is worth (m, rad).
pub(super) type Printed = (f64, f64);

/// Of more decimals of a degree or an inch no printed number tells: of a double of about 1, printed in full, the last digits are the
/// conversion's own from the fifteenth on.
const MOST_DECIMALS: i32 = 12;

/// A conversion multiplies by a rounded factor, rounds, and is printed and read: no more than four roundings.
const ROUNDINGS: f64 = 4.0;

impl OtherUnit {
    /// So much it is (m, rad).
    fn size(self) -> f64 {
        match self {
            Self::Inch => 0.0254,
            Self::Degree => std::f64::consts::PI / 180.0,
        }
    }

    /// Of so many decimals of the unit (m, rad).
    pub(super) fn step(self, decimals: i32) -> f64 {
        self.size() * 10f64.powi(-decimals)
    }

    /// To how many decimals of the unit some numbers were rounded, if the probability that they only seem so is not above `chance`.
    ///
    /// Linear in the numbers.
    pub(super) fn rounded_to(self, printed: &[Printed], chance: f64) -> Option<i32> {
        let largest = printed
            .iter()
            .fold(0.0f64, |most, (x, _)| x.abs().max(most));
        let conversion = ROUNDINGS * 0.5 * f64::EPSILON * largest;
        let within = |last: f64| 0.5 * last + conversion;
        let fits = |decimals: &i32| {
            let step = self.step(*decimals);
            let off = |x: f64| (x - (x / step).round() * step).abs();
            printed.iter().all(|(x, last)| off(*x) <= within(*last))
        };
        let decimals = (0..=MOST_DECIMALS).find(fits)?;
        let step = self.step(decimals);
        // However a zero is written, it is a multiple of everything.
        let telling = printed.iter().filter(|(x, _)| *x != 0.0);
        let by_chance: f64 = telling
            .map(|(_, last)| (2.0 * within(*last) / step).min(1.0))
            .product();
        (by_chance <= chance).then_some(decimals)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHANCE: f64 = 1e-4;

    /// Values printed to so many decimals.
    fn printed(values: &[f64], decimals: usize) -> Vec<Printed> {
        let last = 10f64.powi(-i32::try_from(decimals).unwrap_or(0));
        let read = |x: &f64| (format!("{x:.decimals$}").parse().unwrap_or(*x), last);
        values.iter().map(read).collect()
    }

    #[test]
    fn degrees_and_inches_are_told_by_their_decimals() {
        let degrees = [12.345, -70.738, 101.2, 0.003].map(f64::to_radians);
        let inches = [12.345, -0.671, 3.5, 8.002].map(|x| x * 0.0254);
        for decimals in [16, 12, 8] {
            let angles = printed(&degrees, decimals);
            assert_eq!(OtherUnit::Degree.rounded_to(&angles, CHANCE), Some(3));
            assert_eq!(OtherUnit::Inch.rounded_to(&angles, CHANCE), None);
            let lengths = printed(&inches, decimals);
            assert_eq!(OtherUnit::Inch.rounded_to(&lengths, CHANCE), Some(3));
        }
        // Micrometres tell mils.
        assert_eq!(
            OtherUnit::Inch.rounded_to(&printed(&inches, 6), CHANCE),
            Some(3)
        );
        // Tenths of a millimetre do not.
        assert_eq!(
            OtherUnit::Inch.rounded_to(&printed(&inches, 4), CHANCE),
            None
        );
    }

    #[test]
    fn other_numbers_are_no_multiples() {
        let numbers = [
            0.433_012_701_892_219_3,
            -0.183,
            0.612_372_435_695_794_5,
            0.0,
        ];
        for decimals in [3, 6, 9, 16] {
            let numbers = printed(&numbers, decimals);
            for unit in [OtherUnit::Degree, OtherUnit::Inch] {
                assert_eq!(unit.rounded_to(&numbers, CHANCE), None, "{decimals}");
            }
        }
        assert_eq!(OtherUnit::Inch.rounded_to(&[(0.0, 1.0)], CHANCE), None);
        assert_eq!(OtherUnit::Inch.rounded_to(&[], CHANCE), None);
    }
}
