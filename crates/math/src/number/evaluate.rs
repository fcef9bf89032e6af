//! From a number to its digits: balls, doubles, signs.

use super::ball::{Ball, Bits, Clear, Unclear};
use super::magnitude::Magnitude;
use super::separation;
use super::tree::{Operation, STORED_BITS, Tree};
use super::{Exact, Float, Form, Inner, Number};
use dashu_base::Sign;
use dashu_float::Context;
use dashu_int::IBig;
use dashu_ratio::RBig;
use std::cmp::Ordering;
use std::collections::HashMap;

/// Bits of the evaluation that is cached with every number.
pub(super) const COARSE: usize = 64;
/// A symbolic expression whose value is below 2^-this counts as zero.
///
/// Nothing is known below which such a value must vanish, so this is a convention, not a derivation: 400 binary places are
/// 120 decimals, and two expressions a person writes that agree to 120 decimals by accident have not been seen.
const SYMBOLIC_ZERO: i64 = 400;
/// Working bits at which an evaluation gives up. Reached only by values that differ from zero by less than 2^-100000.
const MOST_BITS: usize = 1 << 17;
/// Working bits at which a double that still seems to lie half-way between two others is rounded as it stands.
const TIE_BITS: usize = 4_096;

/// What is known about a number being zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZeroTest {
    /// It is zero, proven by exact arithmetic or a separation bound.
    Zero,
    /// It is not zero, proven.
    NonZero,
    /// It is below 2^-400 in size and no separation bound of practical size is known: it counts as zero.
    Indistinguishable,
}

/// The sign (−1, 0, 1) and whether it is proven.
#[derive(Clone, Copy, Debug)]
pub(super) struct Decision {
    pub(super) sign: i8,
    proven: bool,
}

impl Number {
    /// The nearest double, correctly rounded (half to even); ±infinity beyond the range of doubles, never NaN or −0.
    ///
    /// Found once and remembered. A value that 4096 working bits cannot tell from the middle between two doubles is rounded
    /// as if it lay there.
    #[must_use]
    pub fn value(&self) -> f64 {
        *self.0.value.get_or_init(|| match self.rational() {
            Some(x) => x.to_f64().value() + 0.0,
            None => self.nearest_double(),
        })
    }

    fn nearest_double(&self) -> f64 {
        if self.decision().sign == 0 {
            return 0.0;
        }
        let mut bits = COARSE;
        loop {
            match self.ball(bits) {
                Ok(ball) if ball.sign().is_some() => {
                    // The ends of a slightly larger ball, exactly.
                    let width = Float::from_parts(IBig::ONE, ball.radius.log2() as isize);
                    let exactly = Context::new(0);
                    let ends = [
                        exactly.sub(ball.middle.repr(), width.repr()),
                        exactly.add(ball.middle.repr(), width.repr()),
                    ];
                    if let [Ok(low), Ok(high)] = ends.map(|x: Result<_, _>| {
                        x.map(|x: dashu_base::Approximation<Float, _>| x.value().to_f64().value())
                    }) && (low == high || bits >= TIE_BITS)
                    {
                        return if low == high {
                            low
                        } else {
                            ball.middle.to_f64().value()
                        };
                    }
                }
                Err(Unclear::Range) => return f64::INFINITY * f64::from(self.decision().sign),
                _ => {}
            }
            if bits > MOST_BITS {
                return 0.0;
            }
            bits *= 2;
        }
    }

    /// The value with a relative error of at most 2^-bits; an exact 0 where the number is zero (see
    /// [`Number::zero_test`]). The result carries at least `bits` bits of precision. 0 bits are taken as 1.
    ///
    /// Cancellation inside an expression is met with more working bits. An exponent beyond the machine word, which only
    /// long chains of the operators can make, gives ±infinity.
    #[must_use]
    pub fn evaluate(&self, bits: usize) -> Float {
        let wanted = bits.max(1);
        let zero = || Float::ZERO.with_precision(wanted).value();
        let mut working = (wanted + 32).max(COARSE);
        let mut best = zero();
        while working <= MOST_BITS.max(4 * wanted) {
            match self.ball(working) {
                Ok(ball) if ball.is_accurate(wanted) => return ball.middle,
                Ok(ball) => best = ball.middle,
                Err(Unclear::Range) => {
                    return match self.decision().sign {
                        0 => zero(),
                        -1 => Float::NEG_INFINITY,
                        _ => Float::INFINITY,
                    };
                }
                Err(Unclear::Precision) => {}
            }
            if self.decision().sign == 0 {
                return zero();
            }
            working *= 2;
        }
        best
    }

    /// Whether this is zero, and whether that is proven.
    #[must_use]
    pub fn zero_test(&self) -> ZeroTest {
        match self.decision() {
            Decision { sign: 0, proven } if proven => ZeroTest::Zero,
            Decision { sign: 0, .. } => ZeroTest::Indistinguishable,
            _ => ZeroTest::NonZero,
        }
    }

    /// Whether this is zero: proven for exact numbers; for other expressions a value below 2^-400 counts as zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.decision().sign == 0
    }

    /// −1, 0 or 1, with zero as in [`Number::is_zero`].
    #[must_use]
    pub fn signum(&self) -> i8 {
        self.decision().sign
    }

    pub(super) fn decision(&self) -> Decision {
        *self.0.decision.get_or_init(|| self.decide())
    }

    fn decide(&self) -> Decision {
        let proven = |sign| Decision { sign, proven: true };
        if let Some(x) = self.rational() {
            return proven(match x.sign() {
                _ if x.is_zero() => 0,
                Sign::Positive => 1,
                Sign::Negative => -1,
            });
        }
        let mut bits = COARSE;
        let mut proven_zero_below = None;
        loop {
            match self.ball(bits) {
                Ok(ball) => {
                    match ball.sign() {
                        Some(Sign::Positive) => return proven(1),
                        Some(Sign::Negative) => return proven(-1),
                        None => {}
                    }
                    // Asked only once it matters: nearly every number shows its sign at once.
                    let bound = proven_zero_below.get_or_insert_with(|| self.zero_below());
                    let (places, is_proof) = match *bound {
                        Some(places) => (places, true),
                        None => (SYMBOLIC_ZERO, false),
                    };
                    let limit = Magnitude::power_of_two(-places);
                    if ball.most().cmp(limit) == Ordering::Less {
                        return Decision {
                            sign: 0,
                            proven: is_proof,
                        };
                    }
                }
                Err(Unclear::Range) => return proven(1),
                Err(Unclear::Precision) => {}
            }
            if bits > MOST_BITS {
                return Decision {
                    sign: 0,
                    proven: false,
                };
            }
            bits *= 2;
        }
    }

    /// Binary places b such that a value below 2^-b must be zero, where such a bound is known.
    fn zero_below(&self) -> Option<i64> {
        match &self.0.form {
            // Zero has no other normal form than the rational zero, so that any bound does.
            Form::Exact(Exact::Rational(_) | Exact::Surd(_)) => Some(i64::MAX / 4),
            Form::Exact(Exact::Algebraic(_)) => separation::bound(self),
            Form::Exact(Exact::Angle(angle)) => angle.zero_below(),
            Form::Symbolic(_) => None,
        }
    }

    /// The value at a number of working bits; operands first, without recursion, shared ones once.
    pub(super) fn ball(&self, bits: usize) -> Clear<Ball> {
        let mut known = Known {
            bits,
            balls: HashMap::new(),
        };
        let mut stack = vec![(self, false)];
        while let Some((number, ready)) = stack.pop() {
            if known.get(number).is_some() {
                continue;
            }
            match &number.0.form {
                Form::Exact(Exact::Algebraic(tree)) | Form::Symbolic(tree) => {
                    if ready {
                        let ball = tree.ball(&known);
                        known.set(number, ball);
                    } else {
                        stack.push((number, true));
                        stack.extend(tree.operands.iter().map(|x| (x, false)));
                    }
                }
                Form::Exact(exact) => known.set(number, exact.ball(Bits(bits))),
            }
        }
        known.get(self).cloned().unwrap_or(Err(Unclear::Precision))
    }
}

/// Balls found so far at one precision: beside the numbers at [`COARSE`] bits, in a table otherwise.
struct Known {
    bits: usize,
    balls: HashMap<*const Inner, Clear<Ball>>,
}

impl Known {
    fn get<'a>(&'a self, number: &'a Number) -> Option<&'a Clear<Ball>> {
        if self.bits == COARSE {
            number.0.coarse.get()
        } else {
            self.balls.get(&(&raw const *number.0))
        }
    }

    fn set(&mut self, number: &Number, ball: Clear<Ball>) {
        if self.bits == COARSE {
            // Another thread may have been faster; it found the same.
            let _ = number.0.coarse.set(ball);
        } else {
            self.balls.insert(&raw const *number.0, ball);
        }
    }
}

impl Exact {
    /// Leaves only; an algebraic tree is handled by its operands.
    fn ball(&self, bits: Bits) -> Clear<Ball> {
        match self {
            Self::Rational(x) => bits.rational(x),
            Self::Surd(x) => x.ball(bits),
            Self::Angle(x) => x.ball(bits),
            Self::Algebraic(_) => Err(Unclear::Precision),
        }
    }
}

impl Tree {
    fn ball(&self, known: &Known) -> Clear<Ball> {
        let bits = Bits(known.bits);
        let operand = |index: usize| match self.operands.get(index).and_then(|x| known.get(x)) {
            Some(Ok(ball)) => Ok(ball),
            Some(Err(unclear)) => Err(*unclear),
            None => Err(Unclear::Precision),
        };
        match &self.operation {
            Operation::Add => bits.add(operand(0)?, operand(1)?),
            Operation::Multiply => bits.mul(operand(0)?, operand(1)?),
            Operation::Divide => bits.div(operand(0)?, operand(1)?),
            Operation::Negate => Ok(operand(0)?.negated()),
            Operation::Sqrt => bits.sqrt(operand(0)?),
            Operation::Power(n) => bits.power(operand(0)?, *n),
            Operation::Cos => bits.cos(operand(0)?),
            Operation::Sin => bits.sin(operand(0)?),
            Operation::Tan => bits.tan(operand(0)?),
            Operation::Asin => bits.asin(operand(0)?),
            Operation::Acos => bits.acos(operand(0)?),
            Operation::Atan => bits.atan(operand(0)?),
            Operation::Atan2 => bits.atan2(operand(0)?, operand(1)?),
            Operation::Parameter(_) => operand(0).cloned(),
            Operation::Stored(x) => bits.stored(x, STORED_BITS),
        }
    }
}

/// `x` to the nearest integer, for a table look-up; `None` where it is not within 1e-6 of one.
pub(super) fn near_integer(x: f64) -> Option<i64> {
    let nearest = x.round();
    ((x - nearest).abs() < 1e-6 && nearest.abs() < 1e9).then_some(nearest as i64)
}

/// A small rational from its parts; the denominator is not zero.
pub(super) fn fraction(numerator: i64, denominator: u32) -> RBig {
    RBig::from_parts(numerator.into(), denominator.max(1).into())
}
