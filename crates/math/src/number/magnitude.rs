//! Upper bounds of errors: a positive double with an exponent of its own.
//!
//! An error bound needs few digits but a wide range (an error of 2^-20000 is ordinary here), so it is a mantissa in
//! [1/2, 1) and a separate exponent. Every operation is done in double precision, whose relative error is at most 2^-53,
//! and then enlarged by [`UP`]: the result is never below the true one.

use super::Float;
use dashu_base::BitTest;
use dashu_int::UBig;
use std::cmp::Ordering;

/// 1 + 2^-50: more than covers the at most four roundings (2^-53 each) in one operation below.
const UP: f64 = 1.0 + 1.0 / (1u64 << 50) as f64;

/// `mantissa * 2^exponent`, zero where the mantissa is zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Magnitude {
    mantissa: f64,
    exponent: i64,
}

impl Magnitude {
    pub(super) const ZERO: Self = Self {
        mantissa: 0.0,
        exponent: 0,
    };

    /// `mantissa * 2^exponent` for a finite mantissa that is normal or zero.
    fn new(mantissa: f64, exponent: i64) -> Self {
        if mantissa <= 0.0 {
            return Self::ZERO;
        }
        let bits = mantissa.to_bits();
        let shift = ((bits >> 52) & 0x7ff) as i64 - 1022;
        Self {
            mantissa: f64::from_bits((bits & !(0x7ff << 52)) | (1022 << 52)),
            exponent: exponent.saturating_add(shift),
        }
    }

    /// 2^exponent.
    pub(super) fn power_of_two(exponent: i64) -> Self {
        Self::new(1.0, exponent)
    }

    /// Bounds `|x|` from below and above.
    pub(super) fn of(x: &Float) -> (Self, Self) {
        let (low, high) = Self::of_integer(&x.repr().significand().clone().into_parts().1);
        let shift = x.repr().exponent() as i64;
        (low.scaled(shift), high.scaled(shift))
    }

    /// Bounds a natural number from below and above.
    pub(super) fn of_integer(n: &UBig) -> (Self, Self) {
        let shift = n.bit_len().saturating_sub(53);
        // 53 bits are left, so the conversion and the increment are exact.
        let top = u64::try_from(n >> shift).unwrap_or(u64::MAX >> 11) as f64;
        let above = if shift == 0 { top } else { top + 1.0 };
        (Self::new(top, shift as i64), Self::new(above, shift as i64))
    }

    pub(super) fn is_zero(self) -> bool {
        self.mantissa == 0.0
    }

    /// Times a power of two (exact).
    pub(super) fn scaled(self, shift: i64) -> Self {
        Self {
            mantissa: self.mantissa,
            exponent: self.exponent.saturating_add(shift),
        }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        let (large, small) = if self.cmp(other) == Ordering::Less {
            (other, self)
        } else {
            (self, other)
        };
        if small.is_zero() {
            return large;
        }
        let gap = large.exponent.saturating_sub(small.exponent).min(60) as i32;
        Self::new(
            (large.mantissa + small.mantissa * 2f64.powi(-gap)) * UP,
            large.exponent,
        )
    }

    /// A lower bound of `self - other`, zero where that is negative. Both must be lower and upper bound respectively.
    pub(super) fn minus_down(self, other: Self) -> Self {
        if self.cmp(other) != Ordering::Greater {
            return Self::ZERO;
        }
        if other.is_zero() {
            return self;
        }
        let gap = self.exponent.saturating_sub(other.exponent).min(60) as i32;
        let taken = other.mantissa * 2f64.powi(-gap) * UP;
        Self::new((self.mantissa - taken) / UP, self.exponent)
    }

    pub(super) fn times(self, other: Self) -> Self {
        Self::new(
            self.mantissa * other.mantissa * UP,
            self.exponent.saturating_add(other.exponent),
        )
    }

    /// `self / other` for a lower bound `other` that is not zero.
    pub(super) fn over(self, other: Self) -> Self {
        Self::new(
            self.mantissa / other.mantissa * UP,
            self.exponent.saturating_sub(other.exponent),
        )
    }

    pub(super) fn sqrt(self) -> Self {
        self.sqrt_times(UP)
    }

    /// A lower bound of the square root of a lower bound.
    pub(super) fn sqrt_down(self) -> Self {
        self.sqrt_times(1.0 / UP)
    }

    /// The root within a rounding, times a factor that is nearly one.
    fn sqrt_times(self, factor: f64) -> Self {
        let odd = self.exponent.rem_euclid(2);
        let mantissa = if odd == 1 {
            self.mantissa * 2.0
        } else {
            self.mantissa
        };
        Self::new(mantissa.sqrt() * factor, (self.exponent - odd) / 2)
    }

    pub(super) fn cmp(self, other: Self) -> Ordering {
        match (self.is_zero(), other.is_zero()) {
            (true, true) => Ordering::Equal,
            (true, false) => Ordering::Less,
            (false, true) => Ordering::Greater,
            (false, false) => self
                .exponent
                .cmp(&other.exponent)
                .then(self.mantissa.total_cmp(&other.mantissa)),
        }
    }

    /// Base-two logarithm rounded up to an integer (of zero: a very negative number).
    pub(super) fn log2(self) -> i64 {
        if self.is_zero() {
            i64::MIN / 4
        } else {
            self.exponent
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(m: Magnitude) -> f64 {
        m.mantissa * 2f64.powi(m.exponent as i32)
    }

    #[test]
    fn operations_round_upwards() {
        for (a, b) in [(3.0, 5.0), (1e-20, 7.0), (1.0 / 3.0, 0.1), (1e17, 1.0)] {
            let (x, y) = (Magnitude::new(a, 0), Magnitude::new(b, 0));
            assert_eq!(value(x), a);
            for (got, want) in [
                (x.plus(y), a + b),
                (x.times(y), a * b),
                (x.over(y), a / b),
                (x.sqrt(), a.sqrt()),
            ] {
                assert!(value(got) >= want && value(got) <= want * (1.0 + 1e-14));
            }
            let root = value(x.sqrt_down());
            assert!(root <= a.sqrt() && root >= a.sqrt() * (1.0 - 1e-14));
            let difference = value(x.minus_down(y));
            assert!(difference <= (a - b).max(0.0));
        }
    }

    #[test]
    fn long_integers_are_enclosed() {
        let n = (UBig::ONE << 200) + UBig::ONE;
        let (low, high) = Magnitude::of_integer(&n);
        assert_eq!(low.cmp(Magnitude::power_of_two(200)), Ordering::Equal);
        assert_eq!(high.cmp(Magnitude::power_of_two(200)), Ordering::Greater);
    }
}
