//! Real numbers with as many bits as a question needs.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig, Repr};
use dashu_int::IBig;

use super::real::{Real, Ring};
use super::sums::Sum;

/// A binary floating-point number with a stated number of bits, rounded to nearest even.
///
/// Every number carries its precision; an operation on two works in the larger one. What has no
/// finite value (0/0, 1/0, √−1, overflow of an exponent of 62 bits) is one absorbing NaN, so no
/// operation panics. There is one zero, without sign.
#[derive(Clone)]
pub struct Big {
    /// `None` is NaN. Never an infinity, never a negative zero.
    value: Option<Repr<2>>,
    bits: usize,
}

impl Big {
    /// Fewest bits a number can have; smaller requests are raised to it.
    pub const MIN_BITS: u32 = 8;

    /// `value` rounded to `bits` bits (at least [`Big::MIN_BITS`]); NaN and infinities give NaN.
    #[must_use]
    pub fn new(value: f64, bits: u32) -> Self {
        let bits = bits.max(Self::MIN_BITS) as usize;
        let Ok(exact) = Repr::<2>::try_from(value) else {
            return Self::nan(bits);
        };
        Self::rounded(exact, bits)
    }

    /// The quotient of two integers rounded once to `bits` bits; NaN for a zero denominator.
    ///
    /// This is how exact numbers of a file enter: 0.1 is the tenth, not the double next to it.
    #[must_use]
    pub fn from_fraction(numerator: &IBig, denominator: &IBig, bits: u32) -> Self {
        let bits = bits.max(Self::MIN_BITS) as usize;
        let top = Repr::new(numerator.clone(), 0);
        let bottom = Repr::new(denominator.clone(), 0);
        Self::keep(Context::new(bits).div(&top, &bottom).ok(), bits)
    }

    /// A number of arbitrary precision rounded to `bits` bits; NaN for an infinity.
    #[must_use]
    pub fn from_float(value: &crate::number::Float, bits: u32) -> Self {
        let bits = bits.max(Self::MIN_BITS) as usize;
        if value.repr().is_infinite() {
            return Self::nan(bits);
        }
        Self::rounded(value.repr().clone(), bits)
    }

    /// The same number with another precision, rounded if that is smaller.
    #[must_use]
    pub fn with_bits(&self, bits: u32) -> Self {
        let bits = bits.max(Self::MIN_BITS) as usize;
        match &self.value {
            Some(repr) => Self::rounded(repr.clone(), bits),
            None => Self::nan(bits),
        }
    }

    fn nan(bits: usize) -> Self {
        Self { value: None, bits }
    }

    fn rounded(exact: Repr<2>, bits: usize) -> Self {
        if exact.is_infinite() {
            return Self::nan(bits);
        }
        let unlimited = FBig::<HalfEven, 2>::from_repr(exact, Context::new(0));
        Self::from_repr(unlimited.with_precision(bits).value().into_repr(), bits)
    }

    fn from_repr(repr: Repr<2>, bits: usize) -> Self {
        if repr.is_infinite() {
            return Self::nan(bits);
        }
        // One zero only, so that equality and order need no special case.
        let repr = if repr.significand().is_zero() {
            Repr::zero()
        } else {
            repr
        };
        Self {
            value: Some(repr),
            bits,
        }
    }

    fn keep<E>(
        result: Option<dashu_base::Approximation<FBig<HalfEven, 2>, E>>,
        bits: usize,
    ) -> Self {
        match result {
            Some(number) => Self::from_repr(number.value().into_repr(), bits),
            None => Self::nan(bits),
        }
    }

    /// Σ aᵢ bᵢ, rounded once to the finest precision among the numbers and `bits`.
    pub(super) fn sum_of_products<'a>(
        pairs: impl Iterator<Item = (&'a Self, &'a Self)> + Clone,
        bits: usize,
    ) -> Self {
        let finest = pairs.clone().map(|(a, b)| a.bits.max(b.bits));
        let bits = finest.fold(bits, usize::max);
        let mut sum = Sum::new(bits);
        for (a, b) in pairs {
            match (&a.value, &b.value) {
                (Some(a), Some(b)) => sum.add_product(a, b),
                _ => return Self::nan(bits),
            }
        }
        Self::rounded(sum.into_repr(), bits)
    }

    /// `self + a b`, rounded once to the finest precision of the three.
    pub(super) fn plus_product(&self, a: &Self, b: &Self) -> Self {
        let bits = self.bits.max(a.bits).max(b.bits);
        match (&self.value, &a.value, &b.value) {
            (Some(own), Some(a), Some(b)) => {
                let mut sum = Sum::new(bits);
                sum.add(own);
                sum.add_product(a, b);
                Self::rounded(sum.into_repr(), bits)
            }
            _ => Self::nan(bits),
        }
    }

    fn is_one(&self) -> bool {
        self.value.as_ref().is_some_and(Repr::is_one)
    }

    /// One operation on two finite numbers in the larger precision of the two.
    fn combine<E>(
        &self,
        other: &Self,
        operation: impl FnOnce(
            &Context<HalfEven>,
            &Repr<2>,
            &Repr<2>,
        ) -> Option<dashu_base::Approximation<FBig<HalfEven, 2>, E>>,
    ) -> Self {
        let bits = self.bits.max(other.bits);
        match (&self.value, &other.value) {
            (Some(a), Some(b)) => Self::keep(operation(&Context::new(bits), a, b), bits),
            _ => Self::nan(bits),
        }
    }
}

impl fmt::Debug for Big {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{:e} ({} bits)", Real::to_f64(self), self.bits)
    }
}

impl PartialEq for Big {
    /// Equality of values, whatever the precisions; NaN equals nothing.
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Big {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match (&self.value, &other.value) {
            (Some(a), Some(b)) => Some(a.cmp(b)),
            _ => None,
        }
    }
}

// Much of what is computed with is zero or one: frames along the axes, rows of a plane.
impl Add for Big {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        if self.is_zero() && self.bits <= other.bits {
            return other;
        }
        if other.is_zero() && other.bits <= self.bits {
            return self;
        }
        self.combine(&other, |context, a, b| context.add(a, b).ok())
    }
}

impl Sub for Big {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        if other.is_zero() && other.bits <= self.bits {
            return self;
        }
        self.combine(&other, |context, a, b| context.sub(a, b).ok())
    }
}

impl Mul for Big {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let zero = |a: &Self, b: &Self| a.is_zero() && b.value.is_some();
        if zero(&self, &other) || zero(&other, &self) {
            return Self::from_repr(Repr::zero(), self.bits.max(other.bits));
        }
        if self.is_one() && self.bits <= other.bits {
            return other;
        }
        if other.is_one() && other.bits <= self.bits {
            return self;
        }
        self.combine(&other, |context, a, b| context.mul(a, b).ok())
    }
}

impl Div for Big {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.combine(&other, |context, a, b| context.div(a, b).ok())
    }
}

impl Neg for Big {
    type Output = Self;
    fn neg(self) -> Self {
        match self.value {
            Some(repr) => Self::from_repr(-repr, self.bits),
            None => self,
        }
    }
}

impl Ring for Big {
    fn zero_like(&self) -> Self {
        Self::from_repr(Repr::zero(), self.bits)
    }

    fn one_like(&self) -> Self {
        Self::from_repr(Repr::one(), self.bits)
    }

    fn is_zero(&self) -> bool {
        self.value
            .as_ref()
            .is_some_and(|repr| repr.significand().is_zero())
    }

    fn dot(&self, a: &[Self], b: &[Self]) -> Self {
        Self::sum_of_products(a.iter().zip(b), self.bits)
    }

    fn add_scaled(&self, x: &[Self], y: &mut [Self]) {
        for (yi, xi) in y.iter_mut().zip(x) {
            *yi = yi.plus_product(self, xi);
        }
    }
}

/// Angles from 2^1024 on are refused: reducing them needs as many digits of π as their exponent.
const LARGEST_ANGLE_EXPONENT: usize = 1024;

impl Real for Big {
    fn constant(&self, value: f64) -> Self {
        let Ok(exact) = Repr::<2>::try_from(value) else {
            return Self::nan(self.bits);
        };
        Self::rounded(exact, self.bits)
    }

    fn to_f64(&self) -> f64 {
        match &self.value {
            Some(repr) => repr.to_f64().value(),
            None => f64::NAN,
        }
    }

    fn abs(&self) -> Self {
        if self < &self.zero_like() {
            -self.clone()
        } else {
            self.clone()
        }
    }

    fn sqrt(&self) -> Self {
        match &self.value {
            Some(repr) => Self::keep(Context::new(self.bits).sqrt(repr).ok(), self.bits),
            None => self.clone(),
        }
    }

    fn sin_cos(&self) -> (Self, Self) {
        let nan = || (Self::nan(self.bits), Self::nan(self.bits));
        let Some(repr) = &self.value else {
            return nan();
        };
        if repr.significand().is_zero() {
            return (self.zero_like(), self.one_like());
        }
        let top = repr.exponent().saturating_add_unsigned(repr.digits());
        if top > LARGEST_ANGLE_EXPONENT as isize {
            return nan();
        }
        if top < -(self.bits as isize) {
            // sin x = x (1 − x²/6 + …) and cos x = 1 − x²/2 + …: both corrections are below half
            // a unit in the last place. Saves a series at a precision that grows with the exponent.
            return (self.clone(), self.one_like());
        }
        let (sine, cosine) = Context::<HalfEven>::new(self.bits).sin_cos(repr, None);
        (
            Self::keep(sine.ok(), self.bits),
            Self::keep(cosine.ok(), self.bits),
        )
    }

    fn atan2(&self, x: &Self) -> Self {
        if self.is_zero() && x.value.is_some() {
            let bits = self.bits.max(x.bits);
            return if x < &x.zero_like() {
                Self::keep(Some(Context::<HalfEven>::new(bits).pi::<2>(None)), bits)
            } else {
                self.zero_like().with_bits(bits as u32)
            };
        }
        self.combine(x, |context, y, x| context.atan2(y, x, None).ok())
    }

    fn is_finite(&self) -> bool {
        self.value.is_some()
    }

    fn bits(&self) -> u32 {
        u32::try_from(self.bits).unwrap_or(u32::MAX)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn big(value: f64) -> Big {
        Big::new(value, 106)
    }

    #[test]
    fn carries_its_precision_and_takes_the_larger() {
        let third = Big::from_fraction(&IBig::from(1), &IBig::from(3), 212);
        assert_eq!(third.bits(), 212);
        let sum = third.clone() + big(1.0);
        assert_eq!(sum.bits(), 212);
        // 3 · (1/3) differs from 1 by at most a rounding of 2^-212.
        let defect = (third * big(3.0) - big(1.0)).abs();
        assert!(Real::to_f64(&defect) < 1e-62);
        let coarse = Big::from_fraction(&IBig::from(1), &IBig::from(3), 20);
        let error = Real::to_f64(&(coarse.with_bits(212) * big(3.0) - big(1.0))).abs();
        assert!(
            error > 1e-8 && error < 2e-6,
            "20 bits keep six digits: {error:e}"
        );
    }

    #[test]
    fn what_has_no_value_is_an_absorbing_nan() {
        let zero = big(0.0);
        let one = big(1.0);
        for nan in [
            zero.clone() / zero.clone(),
            one.clone() / zero.clone(),
            (-one.clone()).sqrt(),
            big(f64::NAN),
            big(f64::INFINITY),
            one.constant(f64::NEG_INFINITY),
        ] {
            assert!(!nan.is_finite());
            assert!(Real::to_f64(&nan).is_nan());
            assert!(!(nan.clone() + one.clone()).is_finite());
            assert!(!(nan.clone() * zero.clone()).is_finite());
            assert!(!nan.sin_cos().0.is_finite());
            assert!(!nan.atan2(&one).is_finite());
            assert!(!one.atan2(&nan).is_finite());
            assert!(!zero.atan2(&nan).is_finite());
            assert_eq!(nan.partial_cmp(&one), None);
            assert!(nan != nan.clone());
            assert!(!nan.is_zero());
        }
    }

    #[test]
    fn one_zero_and_plain_order() {
        let zero = big(0.0);
        assert!((-zero.clone()).is_zero());
        assert_eq!(-zero.clone(), zero);
        assert_eq!(big(-0.0), zero);
        assert!(big(-1.0) < zero && zero < big(1e-300));
        assert!(big(2.0) > Big::new(1.5, 212));
        assert_eq!(big(-2.5).abs(), big(2.5));
    }

    #[test]
    fn leaves_the_range_of_doubles_without_harm() {
        let mut tiny = big(1e-300);
        let mut huge = big(1e300);
        for _ in 0..7 {
            tiny = tiny.clone() * tiny;
            huge = huge.clone() * huge;
        }
        assert_eq!(Real::to_f64(&tiny), 0.0);
        assert_eq!(Real::to_f64(&huge), f64::INFINITY);
        assert!(huge.is_finite() && !tiny.is_zero());
        assert!((Real::to_f64(&(tiny.clone() * huge.clone())) - 1.0).abs() < 1e-12);
        assert_eq!(tiny.sin_cos().0, tiny);
        assert!(!huge.sin_cos().0.is_finite());
        assert_eq!(Real::to_f64(&-huge), f64::NEG_INFINITY);
    }

    #[test]
    fn trigonometry_keeps_its_identities_to_the_last_bits() {
        for bits in [106, 212] {
            let unit = Big::new(1.0, bits);
            let bound = 8.0 * unit.unit_roundoff();
            for k in -20..=20 {
                let angle = Big::new(f64::from(k) * 0.37, bits);
                let (s, c) = angle.sin_cos();
                let one = s.clone() * s.clone() + c.clone() * c.clone();
                assert!(Real::to_f64(&(one - unit.clone()).abs()) <= bound);
                assert!((Real::to_f64(&s) - (f64::from(k) * 0.37).sin()).abs() < 1e-15);
                let back = s.atan2(&c);
                let (s2, c2) = back.sin_cos();
                assert!(Real::to_f64(&(s2 - s).abs()) <= bound);
                assert!(Real::to_f64(&(c2 - c).abs()) <= bound);
            }
        }
    }

    #[test]
    fn angles_on_the_axes() {
        let (zero, one) = (big(0.0), big(1.0));
        assert!(zero.atan2(&zero).is_zero());
        assert!(zero.atan2(&one).is_zero());
        let pi = zero.atan2(&-one.clone());
        assert!(Real::to_f64(&pi.sin_cos().0).abs() < 1e-31);
        let half = one.atan2(&zero);
        assert!(Real::to_f64(&(half + big(0.0).constant(0.0) - pi / big(2.0))).abs() < 1e-31);
    }
}
