//! Exact numbers beside their floating-point values.
//!
//! # The problem
//! Whether a mechanism moves often hangs on an equality between its dimensions: `sin(pi/6)` is one half, a Bennett linkage
//! needs `a·sin β = b·sin α`. A double cannot say whether such an equality holds or nearly holds. On the other hand
//! a file that says `0.866` does not mean a rational with denominator 500: it means something within half a unit of the third
//! place. So a number here has three faces: its **exact value**, its **nearest double**, and, where it was read as a
//! decimal, the **precision stated** by its digits ([`Stated`]).
//!
//! # What is exact
//! [`Exact`] lists the normal forms: rationals; sums of rational multiples of square roots ([`Surd`]); expressions of
//! rationals, square roots and circular functions of fractions of pi that are not such sums ([`Exact::Algebraic`]); and
//! angles, rational combinations of pi and of inverse circular functions of algebraic numbers ([`Angle`]), whose sine and
//! cosine are algebraic again by the addition theorems. Everything else stays an expression.
//!
//! # What the results must satisfy
//! - [`Number::value`] is the correctly rounded double (ties that 4000 bits do not resolve aside), on every platform.
//! - [`Number::evaluate`] has the relative error asked for, whatever cancels on the way: errors are carried along as balls
//!   and the working precision is raised until they are small enough.
//! - Two numbers are equal when their difference is zero. For everything exact that is a proof, for algebraic expressions
//!   by a separation bound (Burnikel, Funke, Mehlhorn, Schirra, Schmitt 2001). For other expressions no such bound is
//!   known: a difference that 400 binary places cannot tell from zero counts as zero, and [`Number::zero_test`] says so.
//! - No text makes it panic, overflow the stack or run away: normal forms are limited to 64 terms and 20 000 bits,
//!   expressions to 10 000 nodes.
//!
//! # Cost
//! Reading a decimal takes microseconds, its double is found while reading. Arithmetic on rationals and surds is that of
//! big integers; trees cost nothing until they are evaluated, and are evaluated once at 64 bits for their sign. Cloning is
//! a reference count.

mod angle;
mod arithmetic;
mod ball;
mod circle;
mod decimal;
mod derived;
mod error;
mod evaluate;
mod expression;
mod functions;
mod height;
mod magnitude;
mod roots;
mod separation;
mod source;
mod surd;
#[cfg(test)]
mod tests;
mod token;
mod tree;
mod view;

pub use angle::{Angle, Direction};
pub use decimal::Stated;
pub use derived::{Input, Inputs, Quantity};
pub use error::{NumberError, Reason};
pub use evaluate::ZeroTest;
pub use surd::Surd;
pub use tree::Tree;
pub use view::View;

use ball::{Ball, Clear};
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use dashu_ratio::RBig;
use evaluate::Decision;
use std::fmt;
use std::sync::{Arc, LazyLock, OnceLock};
use tree::{MAX_NODES, Operation, STORED_BITS};

/// Binary floating-point number of any precision, rounded half to even.
pub type Float = FBig<HalfEven, 2>;

/// A real number: exact where it can be, with its nearest double and the precision it was stated with.
///
/// Cheap to clone and shareable between threads. `==` holds where the difference is zero, see [`Number::zero_test`].
/// The operators `+ - *` and unary `-` never fail; see [`Number::checked_div`] for division. An expression that the
/// operators make larger than 10 000 nodes is replaced by its value to 4096 significant bits (only then
/// [`Number::evaluate`] is limited to these); [`Number::expression`] reports an error instead.
#[derive(Clone)]
pub struct Number(Arc<Inner>);

/// A number in normal form.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Exact {
    /// A fraction in lowest terms.
    Rational(RBig),
    /// An irrational sum of rational multiples of square roots of integers.
    Surd(Surd),
    /// Rationals, square roots (nested ones too) and circular functions of fractions of pi, joined by `+ - * /`: an
    /// algebraic number, kept as an expression. Equality is decided by a separation bound.
    Algebraic(Tree),
    /// A rational combination, not empty, of pi and inverse circular functions of algebraic numbers.
    Angle(Angle),
}

#[derive(Clone, Debug)]
enum Form {
    Exact(Exact),
    Symbolic(Tree),
}

struct Inner {
    form: Form,
    /// What a decimal was read from.
    literal: Option<Literal>,
    /// The literals that it was worked out from, where a reader did that.
    inputs: Option<Arc<[Input]>>,
    /// Fewest decimals among the literals this was computed from.
    coarsest: Option<i32>,
    value: OnceLock<f64>,
    decision: OnceLock<Decision>,
    /// Ball at [`evaluate::COARSE`] bits.
    coarse: OnceLock<Clear<Ball>>,
}

/// The text of a decimal, for writing it back, and its digits.
#[derive(Clone, Debug)]
struct Literal {
    text: Box<str>,
    /// The digits of the text.
    written: Stated,
    /// The precision they state; `None` where the text was read as a number that is exact.
    stated: Option<Stated>,
}

impl Number {
    fn build(form: Form, coarsest: Option<i32>) -> Self {
        Self(Arc::new(Inner {
            form,
            literal: None,
            inputs: None,
            coarsest,
            value: OnceLock::new(),
            decision: OnceLock::new(),
            coarse: OnceLock::new(),
        }))
    }

    fn from_rational(x: RBig) -> Self {
        Self::build(Form::Exact(Exact::Rational(x)), None)
    }

    fn from_surd(x: Surd) -> Self {
        match x.as_rational() {
            Some(rational) => Self::from_rational(rational),
            None => Self::build(Form::Exact(Exact::Surd(x)), None),
        }
    }

    fn from_angle(x: Angle) -> Self {
        if x.is_empty() {
            Self::zero()
        } else {
            Self::build(Form::Exact(Exact::Angle(x)), None)
        }
    }

    fn from_tree(operation: Operation, operands: Vec<Number>) -> Self {
        let number = Self::from_tree_of_any_size(operation, operands);
        if number.nodes() <= MAX_NODES {
            return number;
        }
        let stored = Operation::Stored(number.evaluate(STORED_BITS));
        let tree = Tree::stored(stored, number.is_open());
        Self::build(Form::Symbolic(tree), number.0.coarsest)
    }

    fn from_tree_of_any_size(operation: Operation, operands: Vec<Number>) -> Self {
        let coarsest = operands.iter().filter_map(|x| x.0.coarsest).min();
        let tree = Tree::new(operation, operands);
        let form = if tree.is_algebraic() {
            Form::Exact(Exact::Algebraic(tree))
        } else {
            Form::Symbolic(tree)
        };
        Self::build(form, coarsest)
    }

    /// The same number as computed from literals with at least so few decimals.
    fn with_coarsest(self, coarsest: Option<i32>) -> Self {
        if self.0.coarsest == coarsest && self.0.literal.is_none() {
            return self;
        }
        Self::build(self.0.form.clone(), coarsest)
    }

    /// The number 0.
    #[must_use]
    pub fn zero() -> Self {
        // Frames and axes are full of it: one that all share.
        static ZERO: LazyLock<Number> = LazyLock::new(|| Number::from_rational(RBig::ZERO));
        ZERO.clone()
    }

    /// The number 1.
    #[must_use]
    pub fn one() -> Self {
        static ONE: LazyLock<Number> = LazyLock::new(|| Number::from_rational(RBig::ONE));
        ONE.clone()
    }

    /// The ratio of a circle's circumference to its diameter.
    #[must_use]
    pub fn pi() -> Self {
        Self::from_angle(Angle::of_pi(RBig::ONE))
    }

    /// An integer, exact.
    #[must_use]
    pub fn integer(n: i64) -> Self {
        Self::from_rational(RBig::from(n))
    }

    /// `numerator / denominator`, exact; `None` where the denominator is zero.
    #[must_use]
    pub fn ratio(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator != 0).then(|| {
            Self::from_rational(RBig::from_parts_signed(
                numerator.into(),
                denominator.into(),
            ))
        })
    }

    /// A value that keeps a name: it evaluates like the value, and where formulas are made of it
    /// (`kutzbach::algebra::polynomial_system`) it stands for any value. Decisions (whether something is zero, which root is
    /// meant) are made at the value. Of a parameter of that name already, itself.
    #[must_use]
    pub fn parameter(name: &str, value: Self) -> Self {
        match value.view() {
            View::Parameter(known, _) if known == name => value,
            _ => Self::from_tree(Operation::Parameter(name.into()), vec![value]),
        }
    }

    /// Whether this was computed from a [`parameter`](Self::parameter): then it stands for any value, and whatever asks for
    /// its size or sign (`abs`, a comparison) has no answer.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.tree().is_some_and(Tree::is_open)
    }

    /// The name of a [`parameter`](Self::parameter) that this was computed from, where there is one and its name is kept.
    #[must_use]
    pub fn open_name(&self) -> Option<&str> {
        let mut tree = self.tree().filter(|tree| tree.is_open())?;
        loop {
            if let tree::Operation::Parameter(name) = &tree.operation {
                return Some(name);
            }
            tree = tree
                .operands
                .iter()
                .filter(|x| x.is_open())
                .find_map(Self::tree)?;
        }
    }

    /// The exact (dyadic) value of a double, without a stated precision; `None` where it is not finite.
    #[must_use]
    pub fn from_f64(x: f64) -> Option<Self> {
        let number = Self::from_rational(RBig::try_from(x).ok()?);
        // A fresh cell; adding zero turns −0 into 0.
        let _ = number.0.value.set(x + 0.0);
        Some(number)
    }

    /// Reads a decimal: `0.866`, `-1e-3`, `+.5`, with up to 10 000 digits and an exponent up to ±1000. The value is exact
    /// and the digits state its precision.
    ///
    /// # Errors
    /// Anything else, among it `nan`, `inf`, hexadecimal, blanks around the number and an empty text; the offset is where
    /// the text stops being a decimal.
    pub fn decimal(text: &str) -> Result<Self, NumberError> {
        let decimal = decimal::parse(text)?;
        let coarsest = (decimal.stated.decimals > 0).then_some(decimal.stated.decimals);
        Ok(Self(Arc::new(Inner {
            form: Form::Exact(Exact::Rational(decimal.value)),
            literal: Some(Literal {
                text: text.into(),
                written: decimal.stated,
                stated: Some(decimal.stated),
            }),
            inputs: None,
            coarsest,
            value: OnceLock::from(decimal.nearest),
            decision: OnceLock::new(),
            coarse: OnceLock::new(),
        })))
    }

    /// Reads the text between `${` and `}`.
    ///
    /// Operators `+ - * / **` with the precedence and grouping of Python (`-2**2` is −4, `2**3**2` is 512), parentheses,
    /// `pi`, and the functions `sqrt sin cos tan asin acos atan atan2 abs radians`, angles in radians. A name
    /// (`[A-Za-z_][A-Za-z0-9_.]*`) is given to `lookup`: `Ok(None)` where it is not defined, `Err` with a message where
    /// its own definition is wrong. A decimal in an expression is exact: it states no precision. A name alone, or a
    /// name negated, is the number it stands for, with its stated precision.
    ///
    /// # Errors
    /// With the offset in bytes of what is wrong: syntax, unknown names, arguments outside a function's domain (decided
    /// exactly where it can be), division by anything that is zero, exponents that are not half-integers of at most 1000,
    /// more than 10 000 nodes, values beyond 2^±20000.
    pub fn expression(
        text: &str,
        lookup: &mut dyn FnMut(&str) -> Result<Option<Number>, String>,
    ) -> Result<Self, NumberError> {
        expression::parse(text, lookup)
    }

    /// The normal form, where there is one.
    #[must_use]
    pub fn exact(&self) -> Option<&Exact> {
        match &self.0.form {
            Form::Exact(exact) => Some(exact),
            Form::Symbolic(_) => None,
        }
    }

    /// The value as a fraction, where it is one and is known to be.
    #[must_use]
    pub fn rational(&self) -> Option<&RBig> {
        match self.exact() {
            Some(Exact::Rational(x)) => Some(x),
            _ => None,
        }
    }

    /// The precision stated by the digits of a literal; `None` for expressions and constructed values, which are exact, and
    /// for literals that were [read as](Self::read_as) such.
    #[must_use]
    pub fn stated(&self) -> Option<Stated> {
        self.0.literal.as_ref()?.stated
    }

    /// The digits of a literal as its text has them, whatever it was read as.
    #[must_use]
    pub fn written(&self) -> Option<Stated> {
        Some(self.0.literal.as_ref()?.written)
    }

    /// The text of a literal.
    pub fn literal_text(&self) -> Option<&str> {
        Some(&self.0.literal.as_ref()?.text)
    }

    /// A literal read as another number: with that value and that stated precision, and with this text when it is written
    /// back. What is no literal becomes the other number. A number that [was worked out](Self::derived_from) keeps its inputs where the
    /// other one states a precision.
    ///
    /// ```
    /// # use kutzbach_math as kutzbach;
    /// use kutzbach::number::Number;
    /// let angle = Number::decimal("1.5707963267948966")?.read_as(&(&Number::pi() * &Number::decimal("0.5")?));
    /// assert_eq!(angle.source(), "1.5707963267948966");
    /// assert!(angle.stated().is_none() && angle.cos_sin().0.is_zero());
    /// # Ok::<(), kutzbach::number::NumberError>(())
    /// ```
    #[must_use]
    pub fn read_as(&self, other: &Self) -> Self {
        let Some(literal) = &self.0.literal else {
            return other.clone();
        };
        let stated = other.stated();
        let mut inner = Self::build(other.0.form.clone(), stated.and(other.0.coarsest)).0;
        // Nobody else has it yet.
        if let Some(fresh) = Arc::get_mut(&mut inner) {
            fresh.literal = Some(Literal {
                stated,
                ..literal.clone()
            });
            fresh.inputs = self.0.inputs.clone().filter(|_| stated.is_some());
        }
        Self(inner)
    }

    /// Fewest decimals among the literals read by [`Number::decimal`] that this number was computed from, by whatever
    /// operations. Integers count as exact and do not enter; `None` where nothing inexact did.
    #[must_use]
    pub fn coarsest_input(&self) -> Option<i32> {
        self.0.coarsest
    }

    /// Size as an expression: 1 for anything in a closed normal form.
    fn nodes(&self) -> u32 {
        self.tree().map_or(1, Tree::nodes)
    }

    fn tree(&self) -> Option<&Tree> {
        match &self.0.form {
            Form::Exact(Exact::Algebraic(tree)) | Form::Symbolic(tree) => Some(tree),
            Form::Exact(_) => None,
        }
    }

    /// Whether this is known to be an algebraic number by its form.
    fn is_algebraic(&self) -> bool {
        matches!(self.exact(), Some(exact) if !matches!(exact, Exact::Angle(_)))
    }
}

impl fmt::Debug for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Number({})", decimal::excerpt(&self.source()))
    }
}

/// By proven equality of the difference to zero; see [`Number::zero_test`] for what cannot be proven.
impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        if Arc::ptr_eq(&self.0, &other.0) {
            return true;
        }
        match (self.rational(), other.rational()) {
            (Some(a), Some(b)) => a == b,
            _ if self.nodes().saturating_add(other.nodes()) < MAX_NODES - 1 => {
                (self - other).is_zero()
            }
            // The difference is only asked for its sign, so that there is no need to shorten it.
            _ => Self::from_tree_of_any_size(Operation::Add, vec![self.clone(), -other]).is_zero(),
        }
    }
}
