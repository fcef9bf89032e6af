//! The numbers that geometry is written over.

use crate::decide::Sign;
use kutzbach_math::number::{Number, ZeroTest};
use std::fmt::Debug;

/// A number with a decidable sign, or one that says that it has none within its digits.
pub trait Scalar: Clone + Debug {
    /// An integer, exact.
    fn whole(n: i32) -> Self;
    /// Half of a turn in radians.
    fn half_turn() -> Self;
    /// The sum.
    fn plus(&self, other: &Self) -> Self;
    /// The difference.
    fn minus(&self, other: &Self) -> Self;
    /// The product.
    fn times(&self, other: &Self) -> Self;
    /// The square; never below zero.
    fn squared(&self) -> Self {
        self.times(self)
    }
    /// The opposite number.
    fn negated(&self) -> Self;
    /// The size without the sign.
    fn magnitude(&self) -> Self;
    /// The quotient; `None` where the divisor is not proven to differ from zero.
    fn over(&self, divisor: &Self) -> Option<Self>;
    /// The square root that is not negative; `None` where the number is certainly negative.
    fn root(&self) -> Option<Self>;
    /// The angle of the point (cosine, sine) in (−π, π], which need not lie on the unit circle; `None` for the origin.
    fn arctangent(sine: &Self, cosine: &Self) -> Option<Self>;
    /// The lesser of two numbers: where the digits do not tell which one, what the lesser one may be.
    fn least(&self, other: &Self) -> Self {
        match other.minus(self).sign() {
            Sign::Negative => other.clone(),
            _ => self.clone(),
        }
    }
    /// What is known of its sign.
    fn sign(&self) -> Sign;
    /// The nearest double, or the middle of what the digits allow.
    fn double(&self) -> f64;
}

impl Scalar for Number {
    fn whole(n: i32) -> Self {
        Self::integer(i64::from(n))
    }

    fn half_turn() -> Self {
        Self::pi()
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn negated(&self) -> Self {
        -self
    }

    fn magnitude(&self) -> Self {
        if self.signum() < 0 {
            -self
        } else {
            self.clone()
        }
    }

    fn over(&self, divisor: &Self) -> Option<Self> {
        self.checked_div(divisor).ok()
    }

    fn root(&self) -> Option<Self> {
        self.sqrt().ok()
    }

    fn arctangent(sine: &Self, cosine: &Self) -> Option<Self> {
        Self::atan2(sine, cosine).ok()
    }

    fn sign(&self) -> Sign {
        match (self.zero_test(), self.signum()) {
            (ZeroTest::Zero, _) => Sign::Zero,
            (ZeroTest::Indistinguishable, _) => Sign::Indistinguishable,
            (ZeroTest::NonZero, sign) if sign < 0 => Sign::Negative,
            (ZeroTest::NonZero, _) => Sign::Positive,
        }
    }

    fn double(&self) -> f64 {
        self.value()
    }
}
