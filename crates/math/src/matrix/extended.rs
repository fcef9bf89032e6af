//! Real numbers with more digits than a double: two doubles where these suffice, arbitrary precision beyond.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::big::Big;
use super::real::{Real, Ring, dot_term_by_term};
use super::twofold::{LARGEST_ANGLE, Twofold};

/// Beyond 2^±400, products of two may leave the range in which [`Twofold`] keeps its digits.
const FAR: f64 = 2.6e120;

/// A number with a stated number of bits. An operation on two of different kinds or precisions works in the finer one.
#[derive(Clone, Debug)]
pub enum Extended {
    /// Up to 106 bits.
    Twofold(Twofold),
    /// More, or a size out of the other's range.
    Big(Big),
}

impl Extended {
    /// `value` with `bits` bits, or a few more.
    #[must_use]
    pub fn new(value: f64, bits: u32) -> Self {
        if bits <= Twofold::BITS && fits(value) {
            Self::Twofold(Twofold::from(value))
        } else {
            Self::Big(Big::new(value, bits))
        }
    }

    /// A number of arbitrary precision with `bits` bits, or a few more; NaN for an infinity.
    #[must_use]
    pub fn from_float(value: &crate::number::Float, bits: u32) -> Self {
        let rounded = Big::from_float(value, bits);
        if bits > Twofold::BITS {
            return Self::Big(rounded);
        }
        twofold(&rounded).map_or(Self::Big(rounded), Self::Twofold)
    }

    /// The same number rounded to fewer bits, or itself where it has no more.
    #[must_use]
    pub fn rounded_to(&self, bits: u32) -> Self {
        match self {
            Self::Big(big) if big.bits() > bits => Self::Big(big.with_bits(bits)),
            _ => self.clone(),
        }
    }

    fn as_big(&self) -> Option<&Big> {
        match self {
            Self::Big(big) => Some(big),
            Self::Twofold(_) => None,
        }
    }

    fn big(&self) -> Big {
        match self {
            Self::Big(big) => big.clone(),
            Self::Twofold(pair) => {
                let [high, low] = pair.parts().map(|part| Big::new(part, Twofold::BITS));
                high + low
            }
        }
    }

    fn combine(
        self,
        other: Self,
        pairs: impl FnOnce(Twofold, Twofold) -> Twofold,
        bigs: impl FnOnce(Big, Big) -> Big,
    ) -> Self {
        match (self, other) {
            (Self::Twofold(a), Self::Twofold(b)) => Self::Twofold(pairs(a, b)),
            (a, b) => Self::Big(bigs(a.big(), b.big())),
        }
    }
}

/// Whether a number is of a size at which its square keeps all digits.
fn fits(value: f64) -> bool {
    value == 0.0 || (1.0 / FAR..FAR).contains(&value.abs())
}

/// The nearest pair of doubles, where the size allows it.
fn twofold(big: &Big) -> Option<Twofold> {
    let high = Real::to_f64(big);
    let low = Real::to_f64(&(big.clone() - big.constant(high)));
    fits(high).then(|| Twofold::of_sum(high, low))
}

impl PartialEq for Extended {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Extended {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match (self, other) {
            (Self::Twofold(a), Self::Twofold(b)) => a.partial_cmp(b),
            (a, b) => a.big().partial_cmp(&b.big()),
        }
    }
}

impl Add for Extended {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, Add::add, Add::add)
    }
}

impl Sub for Extended {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combine(other, Sub::sub, Sub::sub)
    }
}

impl Mul for Extended {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, Mul::mul, Mul::mul)
    }
}

impl Div for Extended {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.combine(other, Div::div, Div::div)
    }
}

impl Neg for Extended {
    type Output = Self;
    fn neg(self) -> Self {
        match self {
            Self::Twofold(pair) => Self::Twofold(-pair),
            Self::Big(big) => Self::Big(-big),
        }
    }
}

impl Ring for Extended {
    fn zero_like(&self) -> Self {
        match self {
            Self::Twofold(pair) => Self::Twofold(pair.zero_like()),
            Self::Big(big) => Self::Big(big.zero_like()),
        }
    }

    fn one_like(&self) -> Self {
        match self {
            Self::Twofold(pair) => Self::Twofold(pair.one_like()),
            Self::Big(big) => Self::Big(big.one_like()),
        }
    }

    fn is_zero(&self) -> bool {
        match self {
            Self::Twofold(pair) => pair.is_zero(),
            Self::Big(big) => big.is_zero(),
        }
    }

    fn dot(&self, a: &[Self], b: &[Self]) -> Self {
        let pairs = a.iter().zip(b);
        let mut both = pairs.clone().map(|(a, b)| a.as_big().zip(b.as_big()));
        match self {
            Self::Big(own) if both.all(|pair| pair.is_some()) => {
                let bigs = pairs.filter_map(|(a, b)| a.as_big().zip(b.as_big()));
                Self::Big(Big::sum_of_products(bigs, own.bits() as usize))
            }
            _ => dot_term_by_term(self, a, b),
        }
    }

    fn dot_of_three(a: &[Self; 3], b: &[Self; 3]) -> Self {
        a[0].dot(a, b)
    }

    fn add_scaled(&self, x: &[Self], y: &mut [Self]) {
        for (yi, xi) in y.iter_mut().zip(x) {
            *yi = match (&*yi, self, xi) {
                (Self::Big(y), Self::Big(share), Self::Big(x)) => {
                    Self::Big(y.plus_product(share, x))
                }
                _ => yi.clone() + self.clone() * xi.clone(),
            };
        }
    }
}

impl Real for Extended {
    fn constant(&self, value: f64) -> Self {
        match self {
            Self::Twofold(_) => Self::new(value, Twofold::BITS),
            Self::Big(big) => Self::Big(big.constant(value)),
        }
    }

    fn to_f64(&self) -> f64 {
        match self {
            Self::Twofold(pair) => pair.to_f64(),
            Self::Big(big) => big.to_f64(),
        }
    }

    fn abs(&self) -> Self {
        match self {
            Self::Twofold(pair) => Self::Twofold(Real::abs(pair)),
            Self::Big(big) => Self::Big(Real::abs(big)),
        }
    }

    fn sqrt(&self) -> Self {
        match self {
            Self::Twofold(pair) => Self::Twofold(Real::sqrt(pair)),
            Self::Big(big) => Self::Big(Real::sqrt(big)),
        }
    }

    fn sin_cos(&self) -> (Self, Self) {
        match self {
            Self::Twofold(pair) if pair.to_f64().abs() < LARGEST_ANGLE => {
                let (sine, cosine) = pair.sin_cos();
                (Self::Twofold(sine), Self::Twofold(cosine))
            }
            _ => {
                let (sine, cosine) = self.big().sin_cos();
                (Self::Big(sine), Self::Big(cosine))
            }
        }
    }

    fn atan2(&self, x: &Self) -> Self {
        match (self, x) {
            (Self::Twofold(y), Self::Twofold(x)) => Self::Twofold(y.atan2(x)),
            _ => Self::Big(self.big().atan2(&x.big())),
        }
    }

    fn is_finite(&self) -> bool {
        match self {
            Self::Twofold(pair) => Real::is_finite(pair),
            Self::Big(big) => Real::is_finite(big),
        }
    }

    fn bits(&self) -> u32 {
        match self {
            Self::Twofold(pair) => pair.bits(),
            Self::Big(big) => big.bits(),
        }
    }

    fn unit_roundoff(&self) -> f64 {
        match self {
            Self::Twofold(pair) => pair.unit_roundoff(),
            Self::Big(big) => big.unit_roundoff(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_int::IBig;

    fn of(value: f64, bits: u32) -> Extended {
        Extended::new(value, bits)
    }

    #[test]
    fn two_doubles_serve_up_to_106_bits() {
        assert!(matches!(of(0.1, 106), Extended::Twofold(_)));
        assert!(matches!(of(0.1, 107), Extended::Big(_)));
        // A third to 240 bits.
        let digits = (IBig::ONE << 240) / IBig::from(3);
        let third = crate::number::Float::from_parts(digits, -240);
        for bits in [106, 212] {
            let third = Extended::from_float(&third, bits);
            assert_eq!(third.bits(), bits);
            let defect = (third.clone() * third.constant(3.0) - third.one_like()).abs();
            assert!(defect.to_f64() <= 2.0 * third.unit_roundoff(), "{bits}");
        }
    }

    #[test]
    fn sizes_out_of_range_keep_their_digits() {
        for size in [1e-150, 1e150, 1e-250, 1e250] {
            let far = of(size, 106);
            assert!(matches!(far, Extended::Big(_)));
            let square = far.clone() * far.clone();
            assert!(square.is_finite() && !square.is_zero());
            let back = square / far.clone() / far.clone() - far.one_like();
            assert!(back.abs().to_f64() < 1e-30);
            assert!(matches!(of(1.0, 106).constant(size), Extended::Big(_)));
        }
        let zero = of(0.0, 106);
        assert!(zero.is_zero() && matches!(zero, Extended::Twofold(_)));
    }

    #[test]
    fn kinds_mix() {
        let (short, long) = (of(3.0, 106), of(7.0, 212));
        for (mixed, value) in [
            (short.clone() + long.clone(), 10.0),
            (long.clone() - short.clone(), 4.0),
            (short.clone() * long.clone(), 21.0),
            (short.clone().atan2(&long), 3f64.atan2(7.0)),
        ] {
            assert_eq!((mixed.bits(), mixed.to_f64()), (212, value));
        }
        let quotient = short.clone() / long.clone();
        assert!((quotient.to_f64() * 7.0 - 3.0).abs() < 1e-15);
        assert_eq!(short.partial_cmp(&long), Some(Ordering::Less));
        assert_eq!(long.partial_cmp(&short), Some(Ordering::Greater));
        assert_eq!(of(3.0, 212), short);
        assert!(!of(f64::NAN, 106).is_finite());
        assert_eq!(of(f64::NAN, 106).partial_cmp(&short), None);
    }

    #[test]
    fn angles_of_any_size() {
        for (angle, bits) in [(2e6, 106), (2e6, 212), (1.0, 106), (-1e5, 106)] {
            let (sine, cosine) = of(angle, bits).sin_cos();
            assert!((sine.to_f64() - angle.sin()).abs() < 1e-15);
            assert!((cosine.to_f64() - angle.cos()).abs() < 1e-15);
        }
    }
}
