//! `+ - * /` and powers: a normal form where there is one, a tree otherwise.

use super::error::{NumberError, Reason};
use super::surd::{MAX_BITS, Surd, fits};
use super::tree::Operation;
use super::{Exact, Form, Inner, Literal, Number};
use dashu_base::{BitTest, Sign};
use dashu_ratio::RBig;
use std::borrow::Cow;
use std::ops::{Add, Mul, Neg, Sub};
use std::sync::{Arc, OnceLock};

/// Largest surd whose nested root is compared with others; beyond it the comparison costs more than it saves.
const MAX_NESTED_TERMS: usize = 8;

/// The fewer decimals of two.
fn coarser(a: &Number, b: &Number) -> Option<i32> {
    match (a.0.coarsest, b.0.coarsest) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

/// `±√radicand` with a rational or a surd under the root.
struct Root<'a> {
    negative: bool,
    radicand: Cow<'a, Surd>,
}

impl Number {
    fn as_surd(&self) -> Option<Cow<'_, Surd>> {
        match self.exact()? {
            Exact::Rational(x) => Some(Cow::Owned(Surd::rational(x.clone()))),
            Exact::Surd(x) => Some(Cow::Borrowed(x)),
            _ => None,
        }
    }

    fn as_root(&self) -> Option<Root<'_>> {
        let tree = self.tree()?;
        let operand = tree.operands.first()?;
        match tree.operation {
            Operation::Negate => {
                let root = operand.as_root()?;
                Some(Root {
                    negative: !root.negative,
                    ..root
                })
            }
            Operation::Sqrt => operand.as_surd().and_then(|radicand| {
                (radicand.len() <= MAX_NESTED_TERMS).then_some(Root {
                    negative: false,
                    radicand,
                })
            }),
            _ => None,
        }
    }

    /// `±√x` for a sum that is not negative.
    pub(super) fn root_of(x: Surd, negative: bool) -> Self {
        let root = match x.sqrt() {
            Some(surd) => Self::from_surd(surd),
            None if x.is_zero() => Self::zero(),
            None => Self::from_tree(Operation::Sqrt, vec![Self::from_surd(x)]),
        };
        if negative { -root } else { root }
    }

    fn is_rational_zero(&self) -> bool {
        self.rational().is_some_and(RBig::is_zero)
    }

    fn is_rational_one(&self) -> bool {
        self.rational().is_some_and(RBig::is_one)
    }

    fn plus(&self, other: &Self) -> Self {
        let coarsest = coarser(self, other);
        let sum = if self.is_rational_zero() {
            other.clone()
        } else if other.is_rational_zero() {
            self.clone()
        } else {
            exact_sum(self, other).unwrap_or_else(|| {
                Self::from_tree(Operation::Add, vec![self.clone(), other.clone()])
            })
        };
        sum.with_coarsest(coarsest)
    }

    fn times(&self, other: &Self) -> Self {
        let coarsest = coarser(self, other);
        let product = if self.is_rational_zero() || other.is_rational_zero() {
            Self::zero()
        } else if self.is_rational_one() {
            other.clone()
        } else if other.is_rational_one() {
            self.clone()
        } else {
            exact_product(self, other).unwrap_or_else(|| {
                Self::from_tree(Operation::Multiply, vec![self.clone(), other.clone()])
            })
        };
        product.with_coarsest(coarsest)
    }

    /// Minus this; a literal stays a literal with its stated precision, and what was worked out keeps its inputs.
    fn opposite(&self) -> Self {
        // Of a literal that was read as something irrational, a name negated in a file is the negative of that.
        if let (Some(x), Some(literal)) = (self.rational(), &self.0.literal) {
            return self.opposite_literal(x, literal);
        }
        let opposite = match &self.0.form {
            Form::Exact(Exact::Rational(x)) => Self::from_rational(-x.clone()),
            Form::Exact(Exact::Surd(x)) => Self::from_surd(x.negated()),
            Form::Exact(Exact::Angle(x)) => Self::from_angle(x.scaled(&RBig::from(-1))),
            Form::Exact(Exact::Algebraic(tree)) | Form::Symbolic(tree) => {
                match (&tree.operation, tree.operands.as_slice()) {
                    (Operation::Negate, [x]) => x.clone(),
                    _ => Self::from_tree(Operation::Negate, vec![self.clone()]),
                }
            }
        };
        let opposite = opposite.with_coarsest(self.0.coarsest);
        opposite.with_inputs(self.0.inputs.clone())
    }

    fn opposite_literal(&self, x: &RBig, literal: &Literal) -> Self {
        let flipped = match literal.text.strip_prefix('-') {
            Some(rest) => rest.to_owned(),
            None => format!("-{}", literal.text.trim_start_matches('+')),
        };
        Self(Arc::new(Inner {
            form: Form::Exact(Exact::Rational(-x.clone())),
            literal: Some(Literal {
                text: flipped.into(),
                ..literal.clone()
            }),
            inputs: self.0.inputs.clone(),
            coarsest: self.0.coarsest,
            value: OnceLock::new(),
            decision: OnceLock::new(),
            coarse: OnceLock::new(),
        }))
    }

    /// `self / divisor`.
    ///
    /// # Errors
    /// Where the divisor is zero, be it only after simplification (see [`Number::zero_test`]); the offset is 0.
    pub fn checked_div(&self, divisor: &Self) -> Result<Self, NumberError> {
        if divisor.is_zero() {
            return Err(Reason::DivisionByZero(divisor.shown()).at(0));
        }
        let coarsest = coarser(self, divisor);
        let quotient = if self.is_rational_zero() {
            Self::zero()
        } else if divisor.is_rational_one() {
            self.clone()
        } else if let Some(quotient) = exact_quotient(self, divisor) {
            quotient
        } else {
            Self::from_tree(Operation::Divide, vec![self.clone(), divisor.clone()])
        };
        Ok(quotient.with_coarsest(coarsest))
    }

    /// This to an integer power.
    ///
    /// # Errors
    /// Zero to a negative power, and exponents beyond ±1000; the offset is 0. `0**0` is 1.
    pub fn power(&self, exponent: i32) -> Result<Self, NumberError> {
        if exponent.unsigned_abs() > 1000 {
            return Err(Reason::Exponent(exponent.to_string()).at(0));
        }
        if exponent < 0 && self.is_zero() {
            return Err(Reason::DivisionByZero(format!("0 to the power {exponent}")).at(0));
        }
        let power = match exponent {
            0 => Self::one(),
            1 => self.clone(),
            _ => exact_power(self, exponent)
                .unwrap_or_else(|| Self::from_tree(Operation::Power(exponent), vec![self.clone()])),
        };
        Ok(power.with_coarsest(self.0.coarsest))
    }
}

fn exact_sum(a: &Number, b: &Number) -> Option<Number> {
    match (a.exact()?, b.exact()?) {
        (Exact::Rational(x), Exact::Rational(y)) => small(x + y),
        (Exact::Angle(x), Exact::Angle(y)) => x.add(y).map(Number::from_angle),
        _ => match (a.as_surd(), b.as_surd()) {
            (Some(x), Some(y)) => x.add(&y).map(Number::from_surd),
            _ => root_sum(&a.as_root()?, &b.as_root()?),
        },
    }
}

/// ±√A ± √B where √(A/B) is a surd r: (±r ± 1)·√B.
fn root_sum(a: &Root<'_>, b: &Root<'_>) -> Option<Number> {
    let ratio = a.radicand.mul(&b.radicand.inverse()?)?.sqrt()?;
    let sign = |negative| if negative { -1 } else { 1 };
    let signed = |r: Number, negative| if negative { -r } else { r };
    let factor = signed(Number::from_surd(ratio), a.negative) + Number::integer(sign(b.negative));
    scaled_root(
        &factor,
        &Root {
            negative: false,
            radicand: b.radicand.clone(),
        },
    )
}

/// s·(±√A) = ±√(s²·A) for a rational or surd s.
fn scaled_root(factor: &Number, root: &Root<'_>) -> Option<Number> {
    let radicand = factor.as_surd()?.square()?.mul(&root.radicand)?;
    if radicand.len() > MAX_NESTED_TERMS {
        return None;
    }
    Some(Number::root_of(
        radicand,
        root.negative != (factor.signum() < 0),
    ))
}

fn exact_product(a: &Number, b: &Number) -> Option<Number> {
    match (a.exact()?, b.exact()?) {
        (Exact::Rational(x), Exact::Rational(y)) => small(x * y),
        (Exact::Rational(x), Exact::Angle(y)) | (Exact::Angle(y), Exact::Rational(x)) => {
            y.scaled(x).checked().map(Number::from_angle)
        }
        _ => match (a.as_surd(), b.as_surd()) {
            (Some(x), Some(y)) => x.mul(&y).map(Number::from_surd),
            (Some(_), None) => scaled_root(a, &b.as_root()?),
            (None, Some(_)) => scaled_root(b, &a.as_root()?),
            (None, None) => {
                let (x, y) = (a.as_root()?, b.as_root()?);
                let radicand = x.radicand.mul(&y.radicand)?;
                (radicand.len() <= MAX_NESTED_TERMS)
                    .then(|| Number::root_of(radicand, x.negative != y.negative))
            }
        },
    }
}

fn exact_quotient(a: &Number, b: &Number) -> Option<Number> {
    if let (Some(Exact::Angle(x)), Some(Exact::Angle(y))) = (a.exact(), b.exact()) {
        return x.ratio(y).map(Number::from_rational);
    }
    match b.exact()? {
        Exact::Rational(y) => {
            let inverse = Number::from_rational(RBig::ONE / y);
            if a.is_rational_one() {
                Some(inverse)
            } else {
                exact_product(a, &inverse)
            }
        }
        _ => {
            let inverse = match (b.as_surd(), b.as_root()) {
                (Some(y), _) => Number::from_surd(y.inverse()?),
                (None, Some(y)) => Number::root_of(y.radicand.inverse()?, y.negative),
                (None, None) => return None,
            };
            if a.is_rational_one() {
                Some(inverse)
            } else {
                exact_product(a, &inverse)
            }
        }
    }
}

fn exact_power(base: &Number, exponent: i32) -> Option<Number> {
    if let Some(x) = base.rational() {
        let bits = x.numerator().bit_len().max(x.denominator().bit_len());
        let size = bits.saturating_mul(exponent.unsigned_abs() as usize);
        return (size <= MAX_BITS)
            .then(|| x.pow(exponent as isize))
            .and_then(small);
    }
    if let Some(root) = base.as_root() {
        // (±√A)ⁿ = Aᵐ·(±√A)^(n−2m).
        let square = Number::from_surd(root.radicand.into_owned());
        let even = square.power(exponent.div_euclid(2)).ok()?;
        return if exponent.rem_euclid(2) == 0 {
            Some(even)
        } else {
            exact_product(&even, base)
        };
    }
    let mut result = Surd::rational(RBig::ONE);
    let mut square = base.as_surd()?.into_owned();
    let mut left = exponent.unsigned_abs();
    while left > 0 {
        if left & 1 == 1 {
            result = result.mul(&square)?;
        }
        left >>= 1;
        if left > 0 {
            square = square.square()?;
        }
    }
    if exponent < 0 {
        result = result.inverse()?;
    }
    Some(Number::from_surd(result))
}

fn small(x: RBig) -> Option<Number> {
    fits(&x).then(|| Number::from_rational(x))
}

impl Number {
    /// The size of this.
    #[must_use]
    pub fn abs(&self) -> Self {
        let negative = match self.rational() {
            Some(x) => x.sign() == Sign::Negative,
            None => self.signum() < 0,
        };
        if negative { -self } else { self.clone() }
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, |$a:ident, $b:ident| $body:expr) => {
        impl $trait<&Number> for &Number {
            type Output = Number;
            fn $method(self, other: &Number) -> Number {
                let ($a, $b) = (self, other);
                $body
            }
        }
        impl $trait<Number> for Number {
            type Output = Number;
            fn $method(self, other: Number) -> Number {
                $trait::$method(&self, &other)
            }
        }
        impl $trait<&Number> for Number {
            type Output = Number;
            fn $method(self, other: &Number) -> Number {
                $trait::$method(&self, other)
            }
        }
        impl $trait<Number> for &Number {
            type Output = Number;
            fn $method(self, other: Number) -> Number {
                $trait::$method(self, &other)
            }
        }
    };
}

operator!(Add, add, |a, b| a.plus(b));
operator!(Sub, sub, |a, b| a.plus(&b.opposite()));
operator!(Mul, mul, |a, b| a.times(b));

impl Neg for &Number {
    type Output = Number;
    fn neg(self) -> Number {
        self.opposite()
    }
}

impl Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        self.opposite()
    }
}
