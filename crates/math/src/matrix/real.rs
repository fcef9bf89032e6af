//! The arithmetic that every numeric routine of the crate is written in.
//!
//! Geometry and linear algebra are generic over [`Real`], so that one text serves double precision
//! and as many bits as a doubtful case asks for ([`super::big::Big`]). A number of arbitrary
//! precision knows its precision only by example, so constants are made *like* an existing number:
//! `x.one_like()`, `x.constant(0.5)`.
//!
//! [`Ring`] is the part that also holds in a prime field, where there is no order and no rounding.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Numbers that add and multiply: reals of any precision and elements of prime fields.
pub trait Ring:
    Clone
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    /// Zero in the arithmetic (precision, field) of `self`.
    fn zero_like(&self) -> Self;

    /// One in the arithmetic of `self`.
    fn one_like(&self) -> Self;

    /// Whether the number is exactly zero. False for NaN.
    fn is_zero(&self) -> bool;

    /// Σ aᵢ bᵢ over the common length; `self` only tells the arithmetic.
    fn dot(&self, a: &[Self], b: &[Self]) -> Self {
        dot_term_by_term(self, a, b)
    }

    /// a₀ b₀ + a₁ b₁ + a₂ b₂.
    #[inline]
    fn dot_of_three(a: &[Self; 3], b: &[Self; 3]) -> Self {
        a[0].clone() * b[0].clone() + a[1].clone() * b[1].clone() + a[2].clone() * b[2].clone()
    }

    /// `y ← y + self · x` over the common length.
    fn add_scaled(&self, x: &[Self], y: &mut [Self]) {
        for (yi, xi) in y.iter_mut().zip(x) {
            *yi = yi.clone() + self.clone() * xi.clone();
        }
    }
}

/// [`Ring::dot`] with a rounding at every term.
pub(super) fn dot_term_by_term<R: Ring>(like: &R, a: &[R], b: &[R]) -> R {
    let mut sum = like.zero_like();
    for (x, y) in a.iter().zip(b) {
        sum = sum + x.clone() * y.clone();
    }
    sum
}

/// Real numbers with rounding: `f64`, [`super::twofold::Twofold`] or [`super::big::Big`] with any number of bits.
///
/// Operations never panic. What has no finite real value (division by zero, square root of a
/// negative number, overflow) gives NaN or an infinity, both of which fail [`Real::is_finite`] and
/// survive further arithmetic, so that one test at the end of a computation is enough.
pub trait Real: Ring + PartialOrd + Div<Output = Self> {
    /// `value` in the arithmetic of `self`, rounded to its precision.
    fn constant(&self, value: f64) -> Self;

    /// The nearest double; infinite where the range of a double is exceeded, NaN for NaN.
    fn to_f64(&self) -> f64;

    /// Magnitude.
    fn abs(&self) -> Self;

    /// Square root; NaN for negative numbers.
    fn sqrt(&self) -> Self;

    /// Sine and cosine of an angle in radians. NaN for infinite and for absurdly large angles.
    fn sin_cos(&self) -> (Self, Self);

    /// The angle in (−π, π] of the point with ordinate `self` and abscissa `x`; zero for the origin.
    fn atan2(&self, x: &Self) -> Self;

    /// False for NaN and infinities.
    fn is_finite(&self) -> bool;

    /// Number of bits of the significand: 53 for a double.
    fn bits(&self) -> u32;

    /// Largest relative error of one rounding: 2^−bits for rounding to nearest.
    fn unit_roundoff(&self) -> f64 {
        // Below 2^-1022 a double would be subnormal, and below 2^-1074 zero: an arithmetic finer
        // than that is reported as the smallest normal number, which errs on the safe side.
        2f64.powi(-(self.bits().min(1022) as i32))
    }

    /// Euclidean length of a vector; zero for none.
    ///
    /// Doubles are guarded against overflow and underflow of the squares; `self` only tells the
    /// arithmetic.
    fn norm(&self, vector: &[Self]) -> Self {
        self.dot(vector, vector).sqrt()
    }
}

impl Ring for f64 {
    fn zero_like(&self) -> Self {
        0.0
    }

    fn one_like(&self) -> Self {
        1.0
    }

    fn is_zero(&self) -> bool {
        *self == 0.0
    }

    fn dot(&self, a: &[Self], b: &[Self]) -> Self {
        // Four running sums in a fixed order: the same digits on every machine, and no wait for
        // one addition before the next can start.
        let length = a.len().min(b.len());
        let (a, b) = (&a[..length], &b[..length]);
        let whole = length - length % 4;
        let mut sums = [0.0f64; 4];
        for (x, y) in a[..whole].chunks_exact(4).zip(b[..whole].chunks_exact(4)) {
            for lane in 0..4 {
                sums[lane] += x[lane] * y[lane];
            }
        }
        let mut rest = 0.0;
        for (x, y) in a[whole..].iter().zip(&b[whole..]) {
            rest += x * y;
        }
        (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
    }

    fn add_scaled(&self, x: &[Self], y: &mut [Self]) {
        for (yi, xi) in y.iter_mut().zip(x) {
            *yi += self * xi;
        }
    }
}

impl Real for f64 {
    fn constant(&self, value: f64) -> Self {
        value
    }

    fn to_f64(&self) -> f64 {
        *self
    }

    fn abs(&self) -> Self {
        f64::abs(*self)
    }

    fn sqrt(&self) -> Self {
        f64::sqrt(*self)
    }

    fn sin_cos(&self) -> (Self, Self) {
        f64::sin_cos(*self)
    }

    fn atan2(&self, x: &Self) -> Self {
        if *self == 0.0 && *x == 0.0 {
            // IEEE distinguishes four origins by the signs of zero; here there is one.
            return 0.0;
        }
        f64::atan2(*self, *x)
    }

    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }

    fn bits(&self) -> u32 {
        53
    }

    fn norm(&self, vector: &[Self]) -> Self {
        let square = self.dot(vector, vector);
        // Outside this range some square may have overflowed or lost digits to underflow.
        if (1e-200..=1e200).contains(&square) {
            return square.sqrt();
        }
        let largest = vector.iter().fold(0.0f64, |top, x| {
            if x.is_nan() || top.is_nan() {
                f64::NAN
            } else {
                top.max(x.abs())
            }
        });
        if largest == 0.0 || !largest.is_finite() {
            return largest;
        }
        let scaled: Vec<f64> = vector.iter().map(|x| x / largest).collect();
        self.dot(&scaled, &scaled).sqrt() * largest
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn dot_agrees_with_the_plain_sum_at_every_length() {
        for length in 0..20usize {
            let a: Vec<f64> = (0..length).map(|i| i as f64 + 1.0).collect();
            let b: Vec<f64> = (0..length).map(|i| 2.0 * i as f64 - 3.0).collect();
            let plain: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
            assert_eq!(0.0f64.dot(&a, &b), plain, "integers add without rounding");
        }
    }

    #[test]
    fn norm_survives_extreme_entries() {
        assert_eq!(0.0f64.norm(&[]), 0.0);
        assert_eq!(0.0f64.norm(&[3.0, 4.0]), 5.0);
        assert!((0.0f64.norm(&[3e200, 4e200]) / 5e200 - 1.0).abs() < 1e-15);
        assert!((0.0f64.norm(&[3e-200, 4e-200]) / 5e-200 - 1.0).abs() < 1e-15);
        assert!(0.0f64.norm(&[1.0, f64::NAN]).is_nan());
        assert!(0.0f64.norm(&[1e200, f64::NAN]).is_nan());
    }

    #[test]
    fn the_origin_has_one_angle() {
        assert_eq!(Real::atan2(&-0.0, &-0.0), 0.0);
        assert_eq!(Real::atan2(&0.0, &-1.0), std::f64::consts::PI);
    }
}
