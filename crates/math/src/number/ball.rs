//! Arithmetic on balls: a number in many digits with a bound of its error.
//!
//! A ball (m, r) stands for some real x with |x − m| ≤ r. Each operation takes balls to a ball that contains every possible
//! result: the propagated error plus the rounding of the midpoint, which dashu rounds correctly, hence at most
//! |m|·2^-w at w bits (the radius below counts 2^(1-w)). Where the operands are not known well enough to say anything (a
//! divisor whose ball contains zero) the answer is [`Unclear::Precision`]: try again with more bits.
//! Ball arithmetic: van der Hoeven, "Ball arithmetic", 2009, sections 3 and 4.

use super::Float;
use super::magnitude::Magnitude;
use dashu_base::Sign;
use dashu_float::round::mode::HalfEven;
use dashu_float::{ConstCache, Context, FpError, FpResult};
use dashu_int::UBig;
use dashu_ratio::RBig;
use std::cell::RefCell;
use std::cmp::Ordering;

thread_local! {
    /// The digits of pi found so far; results are correctly rounded, so they do not depend on what is cached.
    static CONSTANTS: RefCell<ConstCache> = const { RefCell::new(ConstCache::new()) };
}

/// Why a ball could not be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unclear {
    /// More working bits may help.
    Precision,
    /// The exponent does not fit a machine word: no bits will help.
    Range,
}

pub(super) type Clear<T> = Result<T, Unclear>;

/// A midpoint and a bound of its distance to the number meant.
#[derive(Clone, Debug)]
pub(super) struct Ball {
    pub(super) middle: Float,
    pub(super) radius: Magnitude,
}

/// Working precision, in bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bits(pub(super) usize);

impl Bits {
    fn context(self) -> Context<HalfEven> {
        Context::new(self.0)
    }

    /// Midpoint as rounded by dashu, radius enlarged by that rounding.
    fn finish(self, middle: FpResult<Float>, propagated: Magnitude) -> Clear<Ball> {
        let middle = middle.map_err(|error| match error {
            FpError::Overflow(_) | FpError::Underflow(_) => Unclear::Range,
            _ => Unclear::Precision,
        })?;
        let middle = middle.value();
        if middle.repr().is_infinite() {
            return Err(Unclear::Range);
        }
        let rounding = Magnitude::of(&middle).1.scaled(1 - self.0 as i64);
        Ok(Ball {
            radius: propagated.plus(rounding),
            middle,
        })
    }

    pub(super) fn rational(self, x: &RBig) -> Clear<Ball> {
        self.finish(Ok(x.to_float(self.0)), Magnitude::ZERO)
    }

    pub(super) fn root_of_integer(self, n: &UBig) -> Clear<Ball> {
        let exact = Float::from(n.clone());
        self.finish(self.context().sqrt(exact.repr()), Magnitude::ZERO)
    }

    pub(super) fn pi(self) -> Clear<Ball> {
        let pi = CONSTANTS.with_borrow_mut(|cache| self.context().pi(Some(cache)));
        self.finish(Ok(pi), Magnitude::ZERO)
    }

    /// A stored number that is itself known to `known` bits only.
    pub(super) fn stored(self, x: &Float, known: usize) -> Clear<Ball> {
        let error = Magnitude::of(x).1.scaled(-(known as i64));
        self.finish(Ok(x.clone().with_precision(self.0)), error)
    }

    pub(super) fn add(self, a: &Ball, b: &Ball) -> Clear<Ball> {
        let sum = self.context().add(a.middle.repr(), b.middle.repr());
        self.finish(sum, a.radius.plus(b.radius))
    }

    pub(super) fn sub(self, a: &Ball, b: &Ball) -> Clear<Ball> {
        self.add(a, &b.negated())
    }

    pub(super) fn mul(self, a: &Ball, b: &Ball) -> Clear<Ball> {
        let product = self.context().mul(a.middle.repr(), b.middle.repr());
        let error = a.above().times(b.radius).plus(b.above().times(a.radius));
        self.finish(product, error.plus(a.radius.times(b.radius)))
    }

    pub(super) fn div(self, a: &Ball, b: &Ball) -> Clear<Ball> {
        let divisor = b.least();
        if divisor.is_zero() {
            return Err(Unclear::Precision);
        }
        // |a/b − A/B| ≤ (δa + |a/b| δb) / |B|.
        let quotient = a.above().over(Magnitude::of(&b.middle).0);
        let error = a.radius.plus(quotient.times(b.radius)).over(divisor);
        let middle = self.context().div(a.middle.repr(), b.middle.repr());
        self.finish(middle, error)
    }

    /// Square root of a number known not to be negative.
    pub(super) fn sqrt(self, a: &Ball) -> Clear<Ball> {
        if a.least().is_zero() || a.middle.repr().sign() == Sign::Negative {
            return Ok(Ball {
                middle: Float::ZERO,
                radius: a.above().plus(a.radius).sqrt(),
            });
        }
        // |√a − √A| = |a − A| / (√a + √A) ≤ δ / 2√l with l below both: nested roots that shrink errors keep doing so.
        let error = a.radius.over(a.least().sqrt_down()).scaled(-1);
        self.finish(self.context().sqrt(a.middle.repr()), error)
    }

    pub(super) fn power(self, a: &Ball, exponent: i32) -> Clear<Ball> {
        let mut result = self.rational(&RBig::ONE)?;
        let mut square = a.clone();
        let mut left = exponent.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                result = self.mul(&result, &square)?;
            }
            left >>= 1;
            if left > 0 {
                square = self.mul(&square, &square)?;
            }
        }
        if exponent < 0 {
            self.div(&self.rational(&RBig::ONE)?, &result)
        } else {
            Ok(result)
        }
    }

    pub(super) fn cos(self, a: &Ball) -> Clear<Ball> {
        let x = a.middle.repr();
        let cos = CONSTANTS.with_borrow_mut(|cache| self.context().cos(x, Some(cache)));
        self.finish(cos, a.radius)
    }

    pub(super) fn sin(self, a: &Ball) -> Clear<Ball> {
        let x = a.middle.repr();
        let sin = CONSTANTS.with_borrow_mut(|cache| self.context().sin(x, Some(cache)));
        self.finish(sin, a.radius)
    }

    pub(super) fn tan(self, a: &Ball) -> Clear<Ball> {
        self.div(&self.sin(a)?, &self.cos(a)?)
    }

    /// Angle of the point (x, y), in (−π, π]; never called where the point is the origin or on the cut.
    pub(super) fn atan2(self, y: &Ball, x: &Ball) -> Clear<Ball> {
        let far = [y.least(), x.least()];
        let distance = if far[0].cmp(far[1]) == Ordering::Less {
            far[1]
        } else {
            far[0]
        };
        let error = x.radius.plus(y.radius);
        let left = x.middle.repr().sign() == Sign::Negative || x.least().is_zero();
        if distance.cmp(error.scaled(1)) != Ordering::Greater || (left && y.least().is_zero()) {
            return Err(Unclear::Precision);
        }
        // A point moved by δ ≤ r/2 at distance r turns by at most asin(δ/r) ≤ 2δ/r.
        let (x, y) = (x.middle.repr(), y.middle.repr());
        let angle = CONSTANTS.with_borrow_mut(|cache| self.context().atan2(y, x, Some(cache)));
        self.finish(angle, error.over(distance).scaled(1))
    }

    pub(super) fn atan(self, a: &Ball) -> Clear<Ball> {
        let x = a.middle.repr();
        let angle = CONSTANTS.with_borrow_mut(|cache| self.context().atan(x, Some(cache)));
        self.finish(angle, a.radius)
    }

    /// The leg of the right triangle with hypotenuse one.
    fn other_leg(self, a: &Ball) -> Clear<Ball> {
        let one = self.rational(&RBig::ONE)?;
        self.sqrt(&self.mul(&self.sub(&one, a)?, &self.add(&one, a)?)?)
    }

    pub(super) fn asin(self, a: &Ball) -> Clear<Ball> {
        self.atan2(a, &self.other_leg(a)?)
    }

    pub(super) fn acos(self, a: &Ball) -> Clear<Ball> {
        self.atan2(&self.other_leg(a)?, a)
    }
}

impl Ball {
    pub(super) fn negated(&self) -> Self {
        Self {
            middle: -self.middle.clone(),
            radius: self.radius,
        }
    }

    /// An upper bound of the midpoint's size.
    fn above(&self) -> Magnitude {
        Magnitude::of(&self.middle).1
    }

    /// A lower bound of the size of every number in the ball; zero where the ball contains zero (or nearly does).
    pub(super) fn least(&self) -> Magnitude {
        Magnitude::of(&self.middle).0.minus_down(self.radius)
    }

    /// An upper bound of the size of every number in the ball.
    pub(super) fn most(&self) -> Magnitude {
        self.above().plus(self.radius)
    }

    /// The sign of every number in the ball, if they have one.
    pub(super) fn sign(&self) -> Option<Sign> {
        (!self.least().is_zero()).then(|| self.middle.repr().sign())
    }

    /// Whether the relative error is at most 2^-bits.
    pub(super) fn is_accurate(&self, bits: usize) -> bool {
        let least = self.least();
        self.radius.is_zero()
            || (!least.is_zero()
                && self.radius.cmp(least.scaled(-(bits as i64))) != Ordering::Greater)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn rational(n: i64, d: u64) -> RBig {
        RBig::from_parts(n.into(), d.into())
    }

    /// Every operation at 80 bits encloses what it gives at 400 bits.
    #[test]
    fn more_bits_stay_inside() {
        type Unary = fn(Bits, &Ball) -> Clear<Ball>;
        let functions: [Unary; 8] = [
            Bits::sqrt,
            Bits::cos,
            Bits::sin,
            Bits::tan,
            Bits::atan,
            Bits::asin,
            Bits::acos,
            |bits, x| bits.power(x, -7),
        ];
        for (n, d) in [(1, 3), (2, 7), (99_999, 100_000), (1, 1_000_003)] {
            for (index, function) in functions.iter().enumerate() {
                let [coarse, fine] = [80, 400].map(|bits| {
                    let x = Bits(bits).rational(&rational(n, d)).unwrap();
                    function(Bits(bits), &x).unwrap()
                });
                let gap = Bits(400).sub(&coarse, &fine).unwrap();
                let distance = Magnitude::of(&gap.middle).0;
                let allowed = coarse.radius.plus(fine.radius);
                assert!(
                    distance.cmp(allowed) != Ordering::Greater,
                    "function {index} at {n}/{d}"
                );
                assert!(coarse.is_accurate(50), "function {index} at {n}/{d}");
            }
        }
    }

    #[test]
    fn unclear_where_the_operand_is() {
        let third = Bits(20).rational(&rational(1, 3)).unwrap();
        let zero = Bits(20).sub(&third, &third).unwrap();
        let division = Bits(20).div(&third, &zero);
        assert_eq!(division.unwrap_err(), Unclear::Precision);
        assert!(zero.sign().is_none());
        assert!(Bits(20).sqrt(&zero).unwrap().sign().is_none());
        let angle = Bits(20).atan2(&zero, &third.negated());
        assert_eq!(angle.unwrap_err(), Unclear::Precision);
    }
}
