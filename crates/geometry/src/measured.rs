//! Doubles with their uncertainty, as intervals that are rounded outwards.

use crate::decide::Sign;
use crate::error::GeometryError;
use crate::scalar::Scalar;
use kutzbach_math::number::Number;
use std::f64::consts::PI;

/// Below this the error of a product may be lost to underflow.
const SMALL: f64 = 1e-290;

/// A double with its uncertainty: every value from [`Measured::low`] to [`Measured::high`] is meant alike.
///
/// Bounds are rounded outwards only where an operation rounds, so that integers stay exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    low: f64,
    high: f64,
}

impl Measured {
    /// The number `value ± uncertainty`.
    ///
    /// # Errors
    /// Where one of them is not finite, or the uncertainty is negative.
    pub fn new(value: f64, uncertainty: f64) -> Result<Self, GeometryError> {
        if !value.is_finite() || !uncertainty.is_finite() || uncertainty < 0.0 {
            return Err(GeometryError::NotMeasured { value, uncertainty });
        }
        // −0 has another angle than 0.
        let value = value + 0.0;
        Ok(Self {
            low: sum(value, -uncertainty).0,
            high: sum(value, uncertainty).1,
        })
    }

    /// A number as its literal states it: half a unit of its last decimal; integers and expressions are exact, to the
    /// rounding of their double.
    ///
    /// # Errors
    /// Where the number is beyond the range of doubles.
    pub fn stated(number: &Number) -> Result<Self, GeometryError> {
        let value = number.value();
        let half_unit = match number.stated() {
            Some(stated) if stated.decimals > 0 => (0.5 * 10f64.powi(-stated.decimals)).next_up(),
            _ => 0.0,
        };
        let own = Self::new(value, half_unit)?;
        match Number::from_f64(value) {
            Some(double) if double == *number => Ok(own),
            _ => Ok(Self {
                low: own.low.next_down(),
                high: own.high.next_up(),
            }),
        }
    }

    /// The least value.
    #[must_use]
    pub fn low(&self) -> f64 {
        self.low
    }

    /// The greatest value.
    #[must_use]
    pub fn high(&self) -> f64 {
        self.high
    }

    /// Half of the width, rounded upwards.
    #[must_use]
    pub fn uncertainty(&self) -> f64 {
        let middle = self.double();
        let most = sum(self.high, -middle).1;
        most.max(sum(middle, -self.low).1)
    }

    /// The interval of two bounds; everything where one is not a number.
    fn between(low: f64, high: f64) -> Self {
        Self {
            low: if low.is_nan() { f64::NEG_INFINITY } else { low },
            high: if high.is_nan() { f64::INFINITY } else { high },
        }
    }

    /// Whether zero is among the values.
    fn holds_zero(&self) -> bool {
        self.low <= 0.0 && self.high >= 0.0
    }

    /// The bounds of what an operation gives for the ends of two intervals.
    fn of_ends(a: &Self, b: &Self, operation: impl Fn(f64, f64) -> (f64, f64)) -> Self {
        let mut whole: Option<Self> = None;
        for x in [a.low, a.high] {
            for y in [b.low, b.high] {
                let (low, high) = operation(x, y);
                let next = Self::between(low, high);
                whole = Some(whole.map_or(next, |w| Self {
                    low: w.low.min(next.low),
                    high: w.high.max(next.high),
                }));
            }
        }
        whole.unwrap_or(Self::between(f64::NAN, f64::NAN))
    }
}

/// Bounds of a value that was rounded, from the sign of what rounding left out.
fn bounds(rounded: f64, left_out: f64) -> (f64, f64) {
    if left_out == 0.0 {
        (rounded, rounded)
    } else if left_out > 0.0 {
        (rounded, rounded.next_up())
    } else if left_out < 0.0 {
        (rounded.next_down(), rounded)
    } else {
        (rounded.next_down(), rounded.next_up())
    }
}

/// Bounds of a sum (the error of a sum is a double: Knuth, The Art of Computer Programming 2, section 4.2.2).
fn sum(a: f64, b: f64) -> (f64, f64) {
    let rounded = a + b;
    let part = rounded - a;
    let left_out = (a - (rounded - part)) + (b - part);
    bounds(rounded, left_out)
}

/// Bounds of a product.
fn product(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 || b == 0.0 {
        // Also where the other is a bound beyond the range: that bound stands for numbers, not for infinity.
        return (0.0, 0.0);
    }
    let rounded = a * b;
    if rounded.abs() < SMALL {
        return (rounded.next_down(), rounded.next_up());
    }
    bounds(rounded, a.mul_add(b, -rounded))
}

/// Bounds of a quotient by a number that is not zero.
fn fraction(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 {
        return (0.0, 0.0);
    }
    let rounded = a / b;
    if rounded.abs() > SMALL && a.abs() > SMALL && (-rounded).mul_add(b, a) == 0.0 {
        return (rounded, rounded);
    }
    (rounded.next_down(), rounded.next_up())
}

/// Bounds of the root of a number that is not negative.
fn root(x: f64) -> (f64, f64) {
    let rounded = x.sqrt();
    if x == 0.0 || x > SMALL && (-rounded).mul_add(rounded, x) == 0.0 {
        return (rounded, rounded);
    }
    (rounded.next_down().max(0.0), rounded.next_up())
}

/// Bounds of an angle that the system's library is off by less than two units of its last place.
fn turned(sine: f64, cosine: f64) -> (f64, f64) {
    let angle = sine.atan2(cosine);
    if sine == 0.0 && cosine > 0.0 {
        return (0.0, 0.0);
    }
    (angle.next_down().next_down(), angle.next_up().next_up())
}

impl Scalar for Measured {
    fn whole(n: i32) -> Self {
        let value = f64::from(n);
        Self {
            low: value,
            high: value,
        }
    }

    fn half_turn() -> Self {
        Self {
            low: PI,
            high: PI.next_up(),
        }
    }

    fn plus(&self, other: &Self) -> Self {
        Self::between(sum(self.low, other.low).0, sum(self.high, other.high).1)
    }

    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    fn times(&self, other: &Self) -> Self {
        Self::of_ends(self, other, product)
    }

    fn squared(&self) -> Self {
        let size = self.magnitude();
        Self::between(
            product(size.low, size.low).0.max(0.0),
            product(size.high, size.high).1,
        )
    }

    fn negated(&self) -> Self {
        // Zero minus, so that there is no −0, which has another angle.
        Self {
            low: 0.0 - self.high,
            high: 0.0 - self.low,
        }
    }

    fn magnitude(&self) -> Self {
        if self.low >= 0.0 {
            *self
        } else if self.high <= 0.0 {
            self.negated()
        } else {
            Self {
                low: 0.0,
                high: self.high.max(-self.low),
            }
        }
    }

    fn over(&self, divisor: &Self) -> Option<Self> {
        (!divisor.holds_zero()).then(|| Self::of_ends(self, divisor, fraction))
    }

    fn root(&self) -> Option<Self> {
        (self.high >= 0.0).then(|| Self::between(root(self.low.max(0.0)).0, root(self.high).1))
    }

    fn arctangent(sine: &Self, cosine: &Self) -> Option<Self> {
        if sine.sign() == Sign::Zero && cosine.sign() == Sign::Zero {
            return None;
        }
        // Across the half line where the angle jumps, and at the origin, it may be anything.
        if cosine.low <= 0.0 && sine.low < 0.0 && sine.high >= 0.0 {
            return Some(Self {
                low: -PI.next_up(),
                high: PI.next_up(),
            });
        }
        // A box in the upper half plane with the origin on its border.
        if cosine.holds_zero() && sine.low == 0.0 {
            return Some(Self {
                low: 0.0,
                high: PI.next_up(),
            });
        }
        Some(Self::of_ends(sine, cosine, turned))
    }

    fn least(&self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.min(other.high),
        }
    }

    fn sign(&self) -> Sign {
        if self.low > 0.0 {
            Sign::Positive
        } else if self.high < 0.0 {
            Sign::Negative
        } else if self.low == 0.0 && self.high == 0.0 {
            Sign::Zero
        } else {
            Sign::WithinDigits
        }
    }

    fn double(&self) -> f64 {
        0.5 * self.low + 0.5 * self.high
    }
}
