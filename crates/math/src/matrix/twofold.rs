//! Real numbers with twice the digits of a double, as the sum of two.
//!
//! Ten times as fast as [`super::big::Big`] with as many bits, because nothing is allocated. Sums and products are those of
//! the `qd` crate (Dekker 1971; error bounds: Joldes, Muller and Popescu 2017, "Tight and rigorous error bounds for basic
//! building blocks of double-word arithmetic"); sine, cosine and arctangent are here.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use qd::Quad;

use super::real::{Real, Ring};

/// The sum of two doubles of which the second is at most half a unit in the last place of the first: 106 bits, in the range
/// of doubles. From 2^-916 down, the last bits of products fall below it and are lost.
///
/// With u = 2^-53, sums are wrong by at most 3 u² of their value (Joldes et al., algorithm 6). Products are by less than 8 u²:
/// two roundings of what is at most 2 u and 3 u of them, u² that is not added up, and the last sum. Quotients, roots, sines and
/// arctangents, which take some operations each, stay below 16 u² in all that was tried; that is the [`Real::unit_roundoff`].
/// What has no finite value is not finite in one of the two, and stays so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twofold(Quad);

/// 2^-102: sixteen times the square of 2^-53.
const ROUNDOFF: f64 = 16.0 * (f64::EPSILON / 2.0) * (f64::EPSILON / 2.0);

/// Below, what is missing of the multiples of π/2 that are taken off an angle is less than 2^-143: nothing beside rounding.
pub(super) const LARGEST_ANGLE: f64 = 1_048_576.0;

/// π/2 in three doubles, each the nearest to what the ones before it leave: 2^-163 is missing.
const HALF_PI: [f64; 3] = [
    std::f64::consts::FRAC_PI_2,
    6.123_233_995_736_766e-17,
    -1.497_384_904_859_169_8e-33,
];

/// Terms of the series of sine and cosine. At π/4 the first one left out is below 2^-112.
const TERMS: usize = 14;

/// 1/2, 1/(2·3), …: what each term of the series of sine (`first` 2) or cosine (`first` 1) has more than the one before it.
const fn ratios(first: u32) -> [Quad; TERMS] {
    let mut ratios = [Quad::ZERO; TERMS];
    let mut i = 0;
    while i < TERMS {
        let n = first + 2 * i as u32;
        ratios[i] = Quad::ONE.const_div(Quad((n * (n + 1)) as f64, 0.0));
        i += 1;
    }
    ratios
}

const OF_SINE: [Quad; TERMS] = ratios(2);
const OF_COSINE: [Quad; TERMS] = ratios(1);

/// 1 − x² r₀ (1 − x² r₁ (1 − …)), of which the innermost terms come first.
fn series(square: Quad, ratios: &[Quad; TERMS]) -> Quad {
    ratios.iter().rev().fold(Quad::ONE, |inner, ratio| {
        Quad::ONE.sub_accurate(square.mul(*ratio).mul(inner))
    })
}

impl Twofold {
    /// Bits of its significand.
    pub const BITS: u32 = 106;

    /// The sum of two doubles, of whatever size.
    #[must_use]
    pub fn of_sum(a: f64, b: f64) -> Self {
        Self(Quad(a, 0.0).add_accurate(Quad(b, 0.0)))
    }

    /// The two doubles, the larger one first.
    #[must_use]
    pub fn parts(&self) -> [f64; 2] {
        [self.0.0, self.0.1]
    }
}

impl From<f64> for Twofold {
    fn from(value: f64) -> Self {
        Self(Quad(value, 0.0))
    }
}

impl PartialOrd for Twofold {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Quad::partial_cmp(self.0, other.0)
    }
}

impl Add for Twofold {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0.add_accurate(other.0))
    }
}

impl Sub for Twofold {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0.sub_accurate(other.0))
    }
}

impl Mul for Twofold {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0.mul(other.0))
    }
}

impl Div for Twofold {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self(self.0.div(other.0))
    }
}

impl Neg for Twofold {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.neg())
    }
}

impl Ring for Twofold {
    fn zero_like(&self) -> Self {
        Self(Quad::ZERO)
    }

    fn one_like(&self) -> Self {
        Self(Quad::ONE)
    }

    fn is_zero(&self) -> bool {
        self.0.0 == 0.0 && self.0.1 == 0.0
    }
}

impl Real for Twofold {
    fn constant(&self, value: f64) -> Self {
        Self::from(value)
    }

    fn to_f64(&self) -> f64 {
        if Real::is_finite(self) {
            self.0.0
        } else {
            f64::NAN
        }
    }

    fn abs(&self) -> Self {
        Self(self.0.abs())
    }

    fn sqrt(&self) -> Self {
        Self(self.0.sqrt())
    }

    /// NaN for angles from 2^20 rad on.
    fn sin_cos(&self) -> (Self, Self) {
        if !(self.0.0.abs() < LARGEST_ANGLE) {
            return (Self(Quad::NAN), Self(Quad::NAN));
        }
        let quarters = (self.0.0 / HALF_PI[0]).round();
        let rest = HALF_PI.iter().fold(self.0, |rest, part| {
            rest.sub_accurate(Quad(quarters, 0.0).mul(Quad(*part, 0.0)))
        });
        let square = rest.mul(rest);
        let sine = Self(rest.mul(series(square, &OF_SINE)));
        let cosine = Self(series(square, &OF_COSINE));
        match quarters.rem_euclid(4.0) as u32 {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }

    fn atan2(&self, x: &Self) -> Self {
        if !Real::is_finite(self) || !Real::is_finite(x) {
            return Self(Quad::NAN);
        }
        if self.is_zero() {
            return if x.0.0 < 0.0 {
                Self::of_sum(2.0 * HALF_PI[0], 2.0 * HALF_PI[1])
            } else {
                self.zero_like()
            };
        }
        // Of moderate size, so that products neither overflow nor lose digits: a power of two changes no digit.
        let largest = self.0.0.abs().max(x.0.0.abs());
        let scale = Self::from(2f64.powi(-(largest.log2().floor() as i32)));
        let (y, x) = (*self * scale, *x * scale);
        // The double is wrong by δ ≈ 2^-53; tan δ = δ but for δ³/3.
        let near = Self::from(f64::atan2(y.0.0, x.0.0));
        let (sine, cosine) = near.sin_cos();
        near + (y * cosine - x * sine) / (x * cosine + y * sine)
    }

    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }

    fn bits(&self) -> u32 {
        Self::BITS
    }

    fn unit_roundoff(&self) -> f64 {
        ROUNDOFF
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::big::Big;
    use super::super::random::SplitMix64;
    use super::*;

    const MANY: u32 = 300;

    fn many(x: Twofold) -> Big {
        x.parts()
            .into_iter()
            .map(|part| Big::new(part, MANY))
            .fold(Big::new(0.0, MANY), |sum, part| sum + part)
    }

    /// Relative error of a result.
    fn error(found: Twofold, exact: &Big) -> f64 {
        let off = Real::to_f64(&((many(found) - exact.clone()) / exact.clone()));
        assert!(off.is_finite());
        off.abs()
    }

    /// Random numbers with all their digits, of sizes from 2^-20 to 2^20.
    fn random(source: &mut SplitMix64) -> Twofold {
        let size = 2f64.powf(20.0 * source.symmetric());
        let high = source.symmetric() * size;
        Twofold::of_sum(high, high * source.symmetric() * f64::EPSILON / 2.0)
    }

    #[test]
    fn every_operation_is_as_exact_as_it_says() {
        let mut source = SplitMix64::new(7);
        let mut worst = [0.0f64; 8];
        for _ in 0..20_000 {
            let (a, b) = (random(&mut source), random(&mut source));
            let (x, y) = (many(a), many(b));
            let (sine, cosine) = a.sin_cos();
            let (exact_sine, exact_cosine) = x.sin_cos();
            let found = [
                error(a + b, &(x.clone() + y.clone())),
                error(a - b, &(x.clone() - y.clone())),
                error(a * b, &(x.clone() * y.clone())),
                error(a / b, &(x.clone() / y.clone())),
                error(a.abs().sqrt(), &x.abs().sqrt()),
                error(a.atan2(&b), &x.atan2(&y)),
                // Near their zeros by as much as near one.
                Real::to_f64(&(many(sine) - exact_sine).abs()),
                Real::to_f64(&(many(cosine) - exact_cosine).abs()),
            ];
            for (worst, found) in worst.iter_mut().zip(found) {
                *worst = worst.max(found);
            }
        }
        let bound = Twofold::from(1.0).unit_roundoff();
        for (i, worst) in worst.into_iter().enumerate() {
            assert!(worst < bound, "{i}: {worst:e} of {bound:e}");
            assert!(worst > 1e-4 * bound, "{i}: {worst:e} is too good");
        }
    }

    #[test]
    fn small_angles_keep_all_digits() {
        for exponent in [-1, -20, -60, -200] {
            let angle = Twofold::from(2f64.powi(exponent)) / Twofold::from(3.0);
            let (sine, cosine) = angle.sin_cos();
            let bound = angle.unit_roundoff();
            assert!(error(sine, &many(angle).sin_cos().0) < bound);
            assert!(error(sine.atan2(&cosine), &many(angle)) < 2.0 * bound);
        }
    }

    #[test]
    fn what_has_no_finite_value_stays_so() {
        let (zero, one) = (Twofold::from(0.0), Twofold::from(1.0));
        let huge = Twofold::from(1e300);
        for none in [
            zero / zero,
            one / zero,
            (-one).sqrt(),
            huge * huge,
            huge * huge - huge * huge,
            Twofold::from(f64::NAN),
            Twofold::from(f64::INFINITY),
            huge.sin_cos().0,
        ] {
            for next in [none, none + one, one - none, none * zero, one / none] {
                assert!(!Real::is_finite(&next), "{none:?} → {next:?}");
            }
            assert!(Real::to_f64(&none).is_nan());
            assert!(!Real::is_finite(&none.sin_cos().0));
            assert!(!Real::is_finite(&none.atan2(&one)));
            assert!(!Real::is_finite(&one.atan2(&none)));
            assert!(!none.is_zero());
        }
    }

    #[test]
    fn angles_on_the_axes_and_between() {
        let (zero, one) = (Twofold::from(0.0), Twofold::from(1.0));
        assert!(zero.atan2(&zero).is_zero());
        assert!((-zero).atan2(&one).is_zero());
        let pi = (-zero).atan2(&-one);
        assert!(error(pi, &Big::new(0.0, MANY).atan2(&Big::new(-1.0, MANY))) < ROUNDOFF);
        assert!(Real::to_f64(&pi.sin_cos().0).abs() < 1e-31);
        for (y, x) in [(1e-300, 1e-300), (-1e300, 1e300), (1e-200, -1e100)] {
            let (y, x) = (Twofold::from(y), Twofold::from(x));
            assert!(error(y.atan2(&x), &many(y).atan2(&many(x))) < ROUNDOFF);
        }
    }
}
