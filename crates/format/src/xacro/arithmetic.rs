//! The operators of Python on values, each number calculated twice: as Python does, and exactly.
//!
//! Which branch a condition takes and how a number is printed in a name follow Python's doubles; geometry gets the exact
//! value. Multiplying by 1 or −1 and adding 0 keep the very number, and so the precision that its digits state.

use super::budget::Budget;
use super::keyed::Keyed;
use super::syntax::Binary;
use super::text::Joined;
use super::value::{Kind, Num, Value};
use super::{Outcome, Trouble};
use kutzbach_math::number::{Exact, Number};

/// Texts and lists made by an expression are no longer than this.
pub(super) const LONGEST_TEXT: usize = 1 << 20;
pub(super) const LONGEST_LIST: usize = 100_000;

/// Exact numbers of more nodes are given up for their doubles: hostile chains of operations must not take minutes.
const MOST_NODES: u32 = 200;
/// Likewise integers of more bits.
const MOST_BITS: usize = 4000;

/// What an operation says where it fails.
pub(super) type Said<T> = Result<T, String>;

const OVERFLOW: &str = "the integer is too large";

/// An exact number, where it is small enough to be worth keeping.
pub(super) fn kept(number: Number) -> Option<Number> {
    (number.size() <= MOST_NODES && number.height() <= MOST_BITS).then_some(number)
}

/// The integer of a double without fraction.
pub(super) fn floor_to_int(value: f64) -> Option<Num> {
    // Doubles up to 2^120 are exact integers of 128 bits.
    (value.is_finite() && value.abs() < 1e36).then(|| Num::int(value as i128))
}

/// The value of `a + b` and the like, whose operands are paid for.
pub(super) fn binary(
    operator: Binary,
    a: &Value,
    b: &Value,
    budget: &mut Budget,
) -> Outcome<Value> {
    if let (Some(x), Some(y)) = (a.number(), b.number()) {
        return numbers(operator, &x, &y, budget).map(Value::Number);
    }
    let too_long = || {
        Err(Trouble::new(format!(
            "the result of `{}` is too long",
            operator.sign()
        )))
    };
    let mismatched = || Err(Trouble::new(mismatch(operator, a, b)));
    match (operator, a, b) {
        (Binary::Add, Value::Text(x), Value::Text(y)) => {
            if x.as_str().len() + y.as_str().len() > LONGEST_TEXT {
                return too_long();
            }
            let mut joined = Joined::default();
            joined.push(x);
            joined.push(y);
            Ok(Value::Text(joined.finish()))
        }
        (Binary::Add, Value::List(x), Value::List(y)) => {
            if x.len() + y.len() > LONGEST_LIST {
                return too_long();
            }
            Ok(Value::List(x.iter().chain(y.iter()).cloned().collect()))
        }
        (Binary::Add, Value::Tuple(x), Value::Tuple(y)) => {
            if x.len() + y.len() > LONGEST_LIST {
                return too_long();
            }
            Ok(Value::Tuple(x.iter().chain(y.iter()).cloned().collect()))
        }
        (Binary::Subtract, Value::Set(x), Value::Set(y)) => {
            let mut left = Vec::new();
            for item in x.iter() {
                if y.find(item, budget)?.is_none() {
                    left.push(item.clone());
                }
            }
            Ok(Value::Set(Keyed::collect(left, budget)?))
        }
        (Binary::Multiply, Value::Text(_) | Value::List(_), _) => match times(b) {
            Some(count) => repeated(a, count).map_or_else(too_long, Ok),
            None => mismatched(),
        },
        (Binary::Multiply, _, Value::Text(_) | Value::List(_)) => match times(a) {
            Some(count) => repeated(b, count).map_or_else(too_long, Ok),
            None => mismatched(),
        },
        (Binary::Remainder, Value::Text(template), _) => {
            // A formatted number is a text of one value.
            let parts = match b {
                Value::Tuple(items) => items,
                other => std::slice::from_ref(other),
            };
            parts.iter().try_for_each(|value| value.known("`%`"))?;
            match super::percent::percent(template.as_str(), b, budget)? {
                Some(text) => Ok(Value::text(&text)),
                None => Err(Trouble::new(
                    "the values after `%` do not fit the format before it",
                )),
            }
        }
        _ => mismatched(),
    }
}

fn mismatch(operator: Binary, a: &Value, b: &Value) -> String {
    let mut message = format!(
        "`{}` does not join {} and {}",
        operator.sign(),
        a.sort(),
        b.sort()
    );
    let expression = |value: &Value| match value {
        Value::Text(text) => Number::expression(text.as_str(), &mut |_| Ok(None))
            .ok()
            .map(|_| text.as_str().to_owned()),
        _ => None,
    };
    if let Some(text) = expression(a).or_else(|| expression(b)) {
        message = format!("{message}: `{text}` is a text to xacro; write ${{{text}}} for a number");
    }
    message
}

fn times(count: &Value) -> Option<usize> {
    // How often a list is repeated is no matter of what is left open.
    count.known("").ok()?;
    match count.number()?.kind {
        Kind::Int(count) => Some(usize::try_from(count.max(0)).unwrap_or(usize::MAX)),
        Kind::Float(_) => None,
    }
}

fn repeated(value: &Value, count: usize) -> Option<Value> {
    match value {
        Value::Text(text) => {
            let length = text.as_str().len().checked_mul(count)?;
            (length <= LONGEST_TEXT).then(|| Value::text(&text.as_str().repeat(count)))
        }
        Value::List(items) => {
            let length = items.len().checked_mul(count)?;
            let items = items.iter().cycle().take(length).cloned();
            (length <= LONGEST_LIST).then(|| Value::List(items.collect()))
        }
        _ => None,
    }
}

/// What calculating with an exact number costs, as a factor: sums of roots are multiplied term by term, and all of it takes
/// longer the longer the integers are.
pub(super) fn weight(number: &Number) -> usize {
    match number.exact() {
        Some(Exact::Rational(x)) => {
            let (_, numerator) = x.numerator().as_sign_words();
            1 + numerator.len().max(x.denominator().as_words().len()) / 16
        }
        Some(Exact::Surd(x)) => x.terms().len(),
        Some(Exact::Angle(x)) => 1 + x.parts().count(),
        _ => 1 + number.size() as usize / 50,
    }
}

/// Steps of an operation beyond the one that every operation costs, so that none takes much more than a microsecond a step.
fn steps(operator: Binary, a: &Num, b: &Num) -> usize {
    let (Some(x), Some(y)) = (&a.exact, &b.exact) else {
        return 0;
    };
    let (x, y) = (weight(x), weight(y));
    match operator {
        Binary::Add | Binary::Subtract => x + y - 2,
        Binary::Multiply => x * y - 1,
        // A sum of roots is multiplied by its conjugates.
        Binary::Divide => y * (x + 2 * y) - 3,
        // Squared up to ten times; a sum of n roots has products of all of them in its powers, up to 64.
        Binary::Power => {
            let terms = 1 << x.min(7).saturating_sub(1);
            (16 + 2 * terms) * terms * terms - 18
        }
        Binary::FloorDivide | Binary::Remainder => 0,
    }
}

/// The value of an operation on numbers.
pub(super) fn numbers(operator: Binary, a: &Num, b: &Num, budget: &mut Budget) -> Outcome<Num> {
    budget.spend(steps(operator, a, b))?;
    let kind = kind_of(operator, a, b)?;
    // An integer that fits needs no more than itself, unless it is a number with a name or with stated digits.
    let exact = exact_of(operator, a, b).and_then(kept);
    if exact.is_none() || matches!(operator, Binary::Power) {
        let asked = format!("`{}`", operator.sign());
        let base_is_kept = exact.is_some();
        let operands = if base_is_kept { &[b][..] } else { &[a, b][..] };
        for operand in operands {
            Value::Number((*operand).clone()).known(&asked)?;
        }
    }
    Ok(match (kind, exact) {
        (Kind::Int(value), None) => Num::int(value),
        (kind, exact) => Num { kind, exact },
    })
}

fn kind_of(operator: Binary, a: &Num, b: &Num) -> Said<Kind> {
    let zero = || Err("division by zero".to_owned());
    if let (Kind::Int(x), Kind::Int(y)) = (a.kind, b.kind) {
        let result = match operator {
            Binary::Add => x.checked_add(y),
            Binary::Subtract => x.checked_sub(y),
            Binary::Multiply => x.checked_mul(y),
            Binary::Divide if y == 0 => return zero(),
            Binary::Divide => return Ok(Kind::Float(x as f64 / y as f64)),
            Binary::FloorDivide | Binary::Remainder if y == 0 => return zero(),
            // Python rounds towards minus infinity.
            Binary::FloorDivide => x
                .checked_div(y)
                .map(|q| q - i128::from(x % y != 0 && (x < 0) != (y < 0))),
            Binary::Remainder => x.checked_rem(y).map(|r| {
                if r != 0 && (r < 0) != (y < 0) {
                    r + y
                } else {
                    r
                }
            }),
            Binary::Power => match u32::try_from(y) {
                Ok(exponent) => x.checked_pow(exponent),
                Err(_) if x == 0 => return zero(),
                Err(_) if y < 0 => return Ok(Kind::Float((x as f64).powf(y as f64))),
                Err(_) => None,
            },
        };
        return result.map(Kind::Int).ok_or_else(|| OVERFLOW.to_owned());
    }
    let (x, y) = (a.double(), b.double());
    Ok(Kind::Float(match operator {
        Binary::Add => x + y,
        Binary::Subtract => x - y,
        Binary::Multiply => x * y,
        Binary::Divide | Binary::FloorDivide | Binary::Remainder if y == 0.0 => return zero(),
        Binary::Divide => x / y,
        Binary::FloorDivide => floor_and_rest(x, y).0,
        Binary::Remainder => floor_and_rest(x, y).1,
        Binary::Power if x == 0.0 && y < 0.0 => return zero(),
        Binary::Power if x < 0.0 && y.fract() != 0.0 => {
            return Err("the power is not a real number".to_owned());
        }
        Binary::Power => x.powf(y),
    }))
}

/// `x // y` and `x % y`: the rest has the sign of the divisor, and a quotient of zero that of the exact one.
fn floor_and_rest(x: f64, y: f64) -> (f64, f64) {
    let mut rest = x % y;
    let mut quotient = (x - rest) / y;
    if rest == 0.0 {
        rest = 0.0_f64.copysign(y);
    } else if (rest < 0.0) != (y < 0.0) {
        rest += y;
        quotient -= 1.0;
    }
    let floor = match quotient {
        0.0 => 0.0_f64.copysign(x / y),
        quotient => quotient.round(),
    };
    (floor, rest)
}

fn is_unit(number: &Number) -> Option<bool> {
    let fraction = number.rational()?;
    if *fraction == dashu_ratio::RBig::ONE {
        Some(true)
    } else if *fraction == -dashu_ratio::RBig::ONE {
        Some(false)
    } else {
        None
    }
}

fn exact_of(operator: Binary, a: &Num, b: &Num) -> Option<Number> {
    let (x, y) = (a.exact.as_ref()?, b.exact.as_ref()?);
    let signed = |number: &Number, positive| {
        if positive { number.clone() } else { -number }
    };
    match operator {
        Binary::Add if y.rational().is_some_and(|y| y.is_zero()) => Some(x.clone()),
        Binary::Add if x.rational().is_some_and(|x| x.is_zero()) => Some(y.clone()),
        Binary::Add => Some(x + y),
        Binary::Subtract if y.rational().is_some_and(|y| y.is_zero()) => Some(x.clone()),
        Binary::Subtract => Some(x - y),
        Binary::Multiply => Some(match (is_unit(x), is_unit(y)) {
            (_, Some(positive)) => signed(x, positive),
            (Some(positive), _) => signed(y, positive),
            _ => x * y,
        }),
        Binary::Divide => match is_unit(y) {
            Some(positive) => Some(signed(x, positive)),
            None => x.checked_div(y).ok(),
        },
        // Whole quotients are exact in doubles far beyond any use; remainders of fractions are not known exactly.
        Binary::FloorDivide | Binary::Remainder => None,
        Binary::Power => match b.kind {
            Kind::Int(exponent) => x.power(i32::try_from(exponent).ok()?).ok(),
            Kind::Float(_) => x.half_power(y).ok(),
        },
    }
}

/// `+value`: a number, of a truth value as well.
pub(super) fn positive(value: &Value) -> Said<Value> {
    let number = value.number().map(Value::Number);
    number.ok_or_else(|| format!("`+` needs a number, found {}", value.sort()))
}

pub(super) fn negated(value: &Value) -> Said<Value> {
    let number = value
        .number()
        .ok_or_else(|| format!("`-` needs a number, found {}", value.sort()))?;
    let kind = match number.kind {
        Kind::Int(value) => Kind::Int(value.checked_neg().ok_or(OVERFLOW)?),
        Kind::Float(value) => Kind::Float(-value),
    };
    Ok(Value::Number(Num {
        kind,
        exact: number.exact.map(|exact| -exact),
    }))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn read(text: &str) -> Value {
        Value::literal(&text.into())
    }

    fn calculated(operator: Binary, a: &str, b: &str) -> Outcome<Value> {
        binary(operator, &read(a), &read(b), &mut Budget::default())
    }

    fn shown(operator: Binary, a: &str, b: &str) -> String {
        let value = calculated(operator, a, b).unwrap();
        value.to_text(100).unwrap().as_str().to_owned()
    }

    #[test]
    fn integers_and_doubles_calculate_as_in_python() {
        for (operator, a, b, result) in [
            (Binary::Add, "1", "2", "3"),
            (Binary::Add, "0.1", "0.2", "0.30000000000000004"),
            (Binary::Divide, "4", "2", "2.0"),
            (Binary::FloorDivide, "-7", "2", "-4"),
            (Binary::Remainder, "-7", "2", "1"),
            (Binary::Remainder, "7", "-2", "-1"),
            (Binary::FloorDivide, "-7.5", "2", "-4.0"),
            (Binary::Remainder, "-7.5", "2", "0.5"),
            (Binary::FloorDivide, "-0.0", "2", "-0.0"),
            (Binary::FloorDivide, "0.0", "-2.5", "-0.0"),
            (Binary::FloorDivide, "0.5", "-2.5", "-1.0"),
            (Binary::Remainder, "5.0", "-2.5", "-0.0"),
            (Binary::Remainder, "-5.0", "2.5", "0.0"),
            (Binary::Power, "2", "-1", "0.5"),
            (Binary::Power, "2", "10", "1024"),
            (Binary::Multiply, "true", "3", "3"),
            (Binary::Multiply, "ab", "2", "abab"),
        ] {
            assert_eq!(shown(operator, a, b), result, "{a} {} {b}", operator.sign());
        }
        for (operator, a, b) in [
            (Binary::Divide, "1", "0"),
            (Binary::Power, "2", "200"),
            (Binary::Power, "-1.0", "0.5"),
            (Binary::Multiply, "a", "1000000000000"),
            (Binary::Add, "a", "1"),
        ] {
            assert!(calculated(operator, a, b).is_err());
        }
    }

    #[test]
    fn a_sign_keeps_the_stated_digits() {
        let Ok(Value::Number(product)) = calculated(Binary::Multiply, "-1", "0.10") else {
            panic!("a number");
        };
        let exact = product.exact.unwrap();
        assert_eq!(exact.source(), "-0.10");
        assert_eq!(exact.stated().unwrap().decimals, 2);
    }
}
