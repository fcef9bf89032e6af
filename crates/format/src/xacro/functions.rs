//! The functions that expressions may call.

use super::arithmetic::{LONGEST_LIST, floor_to_int, kept, numbers as calculated, weight};
use super::budget::Budget;
use super::comparison::{extreme, sorted};
use super::keyed::Keyed;
use super::syntax::Binary;
use super::text::Text;
use super::token::base;
use super::value::{Kind, Num, Value};
use super::{Outcome, Run, Trouble};
use crate::words::quoted;
use kutzbach_math::number::Number;
use std::cmp::Ordering;
use std::rc::Rc;

const MODULES: [&str; 3] = ["math", "python", "xacro"];

/// Functions of doubles, with the same function of exact numbers where there is one.
type OfDouble = (&'static str, fn(f64) -> f64, fn(&Number) -> Option<Number>);
const OF_DOUBLE: [OfDouble; 21] = [
    ("sqrt", f64::sqrt, |x| x.sqrt().ok()),
    ("sin", f64::sin, |x| Some(x.cos_sin().1)),
    ("cos", f64::cos, |x| Some(x.cos_sin().0)),
    ("tan", f64::tan, |x| x.tan().ok()),
    ("asin", f64::asin, |x| x.asin().ok()),
    ("acos", f64::acos, |x| x.acos().ok()),
    ("atan", f64::atan, |x| Some(x.atan())),
    ("radians", radians, |x| Some(x.radians())),
    ("degrees", degrees, |x| {
        (x * &Number::integer(180)).checked_div(&Number::pi()).ok()
    }),
    ("fabs", f64::abs, |x| Some(x.abs())),
    ("exp", f64::exp, inexact),
    ("expm1", f64::exp_m1, inexact),
    ("log2", f64::log2, inexact),
    ("log10", f64::log10, inexact),
    ("log1p", f64::ln_1p, inexact),
    ("sinh", f64::sinh, inexact),
    ("cosh", f64::cosh, inexact),
    ("tanh", f64::tanh, inexact),
    ("asinh", f64::asinh, inexact),
    ("acosh", f64::acosh, inexact),
    ("atanh", f64::atanh, inexact),
];

/// Functions whose exact values take longest to find.
const IRRATIONAL: [&str; 10] = [
    "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "hypot", "pow",
];

/// Functions that what is left open may be given to: the result is exact for all its values alike.
const OF_OPEN: [&str; 9] = [
    "sqrt", "sin", "cos", "tan", "radians", "degrees", "float", "pow", "hypot",
];

/// All others.
const OTHERS: [&str; 55] = [
    "abs",
    "all",
    "any",
    "bool",
    "dict",
    "divmod",
    "enumerate",
    "float",
    "int",
    "len",
    "list",
    "map",
    "max",
    "min",
    "range",
    "reversed",
    "repr",
    "round",
    "sorted",
    "str",
    "sum",
    "tuple",
    "zip",
    "set",
    "frozenset",
    "ord",
    "chr",
    "filter",
    "isinstance",
    "type",
    "atan2",
    "ceil",
    "copysign",
    "floor",
    "fmod",
    "gcd",
    "hypot",
    "isclose",
    "isfinite",
    "isinf",
    "isnan",
    "log",
    "pow",
    "prod",
    "fsum",
    "trunc",
    "load_yaml",
    "abs_filename",
    "dotify",
    "arg",
    "message",
    "warning",
    "error",
    "fatal",
    "tokenize",
];

fn inexact(_: &Number) -> Option<Number> {
    None
}

fn radians(x: f64) -> f64 {
    x * (std::f64::consts::PI / 180.0)
}

fn degrees(x: f64) -> f64 {
    x * (180.0 / std::f64::consts::PI)
}

/// What a name stands for that no file has defined.
pub(super) fn builtin(name: &str) -> Option<Value> {
    let constant = |value: f64, exact: Option<Number>| {
        Some(Value::Number(Num {
            kind: Kind::Float(value),
            exact,
        }))
    };
    match name {
        "pi" => return constant(std::f64::consts::PI, Some(Number::pi())),
        "tau" => {
            return constant(
                std::f64::consts::TAU,
                Some(Number::pi() * Number::integer(2)),
            );
        }
        "e" => return constant(std::f64::consts::E, None),
        "inf" => return constant(f64::INFINITY, None),
        "nan" => return constant(f64::NAN, None),
        _ => {}
    }
    let known = |names: &[&'static str]| names.iter().find(|own| **own == name).copied();
    if let Some(module) = known(&MODULES) {
        return Some(Value::Module(module));
    }
    let of_double = OF_DOUBLE
        .iter()
        .map(|(own, ..)| *own)
        .find(|own| *own == name);
    of_double.or_else(|| known(&OTHERS)).map(Value::Function)
}

/// The items that Python's `for` goes through.
pub(super) fn iterated(value: &Value, budget: &mut Budget) -> Outcome<Vec<Value>> {
    budget.spend(length(value).unwrap_or(0))?;
    match value {
        Value::List(items) | Value::Tuple(items) => Ok(items.to_vec()),
        Value::Set(items) => Ok(items.to_vec()),
        Value::Dict(items) => Ok(items.iter().map(|(key, _)| key.clone()).collect()),
        Value::Text(text) => {
            value.known("a letter")?;
            let letters = text.as_str().chars();
            Ok(letters
                .map(|c| Value::text(c.encode_utf8(&mut [0; 4])))
                .collect())
        }
        other => Err(Trouble::new(format!("{} has no items", other.sort()))),
    }
}

/// How many items a value has.
fn length(value: &Value) -> Option<usize> {
    match value {
        Value::List(items) | Value::Tuple(items) => Some(items.len()),
        Value::Set(items) => Some(items.len()),
        Value::Dict(items) => Some(items.len()),
        Value::Text(text) => Some(text.as_str().chars().count()),
        _ => None,
    }
}

type Named = [(Rc<str>, Value)];

fn option<'a>(named: &'a Named, name: &str) -> Option<&'a Value> {
    named
        .iter()
        .find(|(own, _)| &**own == name)
        .map(|(_, value)| value)
}

/// Whether an option is given and true.
fn is_wanted(option: Option<&Value>) -> Outcome<bool> {
    option.map_or(Ok(false), |value| value.truth("an option"))
}

impl Run<'_> {
    /// The value of a function.
    pub(super) fn apply(
        &mut self,
        name: &'static str,
        values: &[Value],
        named: &Named,
    ) -> Outcome<Value> {
        let list = |items: Vec<Value>| {
            if items.len() > LONGEST_LIST {
                return Err(Trouble::new("the list is too long"));
            }
            Ok(Value::List(items.into()))
        };
        let wrong = || {
            Err(Trouble::new(format!(
                "{name}() does not take {}",
                match values {
                    [] => "no value".to_owned(),
                    [one] => one.sort().to_owned(),
                    several => format!("these {} values", several.len()),
                }
            )))
        };
        let truth = |value| Ok(Value::Bool(value));
        match (name, values) {
            ("str", []) => Ok(Value::text("")),
            ("str", [value]) => Ok(Value::Text(self.paid_text(value)?)),
            ("repr", [value]) => Ok(Value::Text(self.budget.repr(value)?)),
            ("bool", [value]) => truth(value.truth("bool()")?),
            ("len", [value]) => match length(value) {
                Some(length) => Ok(Value::int(length)),
                None => wrong(),
            },
            ("list", []) => list(Vec::new()),
            ("list", [value]) => list(iterated(value, &mut self.budget)?),
            ("tuple", [value]) => Ok(Value::Tuple(iterated(value, &mut self.budget)?.into())),
            ("set" | "frozenset", []) => Ok(Value::Set(Rc::default())),
            ("set" | "frozenset", [value]) => {
                let items = iterated(value, &mut self.budget)?;
                Ok(Value::Set(Keyed::collect(items, &mut self.budget)?))
            }
            ("dict", _) => made_dictionary(values, named, &mut self.budget),
            ("dotify", [value]) => Ok(value.clone()),
            ("sorted", [value]) => {
                let descending = is_wanted(option(named, "reverse"))?;
                let items = iterated(value, &mut self.budget)?;
                sorted(items, descending, &mut self.budget).and_then(list)
            }
            ("reversed", [value]) => list(
                iterated(value, &mut self.budget)?
                    .into_iter()
                    .rev()
                    .collect(),
            ),
            ("range", _) => range(values).and_then(list),
            ("enumerate", [value]) => {
                let pairs = iterated(value, &mut self.budget)?.into_iter().enumerate();
                list(
                    pairs
                        .map(|(at, value)| pair(Value::int(at), value))
                        .collect(),
                )
            }
            ("zip", [first, second]) => {
                let pairs = iterated(first, &mut self.budget)?
                    .into_iter()
                    .zip(iterated(second, &mut self.budget)?);
                list(pairs.map(|(a, b)| pair(a, b)).collect())
            }
            ("map", [Value::Function(function), value]) => {
                let mut results = Vec::new();
                for item in iterated(value, &mut self.budget)? {
                    self.spend(1)?;
                    results.push(self.deeper(|run| run.apply(function, &[item], &[]))?);
                }
                list(results)
            }
            ("filter", [Value::None, value]) => {
                let mut items = Vec::new();
                for item in iterated(value, &mut self.budget)? {
                    if item.truth("filter()")? {
                        items.push(item);
                    }
                }
                list(items)
            }
            ("any" | "all", [value]) => {
                for item in iterated(value, &mut self.budget)? {
                    if item.truth(&format!("{name}()"))? == (name == "any") {
                        return truth(name == "any");
                    }
                }
                truth(name == "all")
            }
            ("min", _) => extreme(values, Ordering::Less, &mut self.budget),
            ("max", _) => extreme(values, Ordering::Greater, &mut self.budget),
            ("sum" | "fsum" | "prod", [value]) => {
                let (operator, first) = match name {
                    "prod" => (Binary::Multiply, 1),
                    _ => (Binary::Add, 0),
                };
                let mut total = Value::int(first);
                for item in iterated(value, &mut self.budget)? {
                    self.spend(1)?;
                    total = super::arithmetic::binary(operator, &total, &item, &mut self.budget)?;
                }
                Ok(total)
            }
            ("ord", [Value::Text(text)]) => {
                let mut chars = text.as_str().chars();
                match (chars.next(), chars.next()) {
                    (Some(c), None) => Ok(Value::int(c as usize)),
                    _ => wrong(),
                }
            }
            ("tokenize", [Value::Text(text), rest @ ..]) => {
                let separators = match rest.first().or_else(|| option(named, "sep")) {
                    Some(Value::Text(separators)) => separators.as_str().to_owned(),
                    _ => ",; ".to_owned(),
                };
                let skip_empty = rest.get(1).or_else(|| option(named, "skip_empty"));
                let keep_empty = skip_empty.is_some() && !is_wanted(skip_empty)?;
                list(tokenized(text, &separators, keep_empty))
            }
            ("fatal", _) => {
                Err(Trouble::new(self.said_text(values)?).help("the file itself says so"))
            }
            ("message" | "warning" | "error", _) => {
                let message = self.said_text(values)?;
                self.said(name, message);
                Ok(Value::text(""))
            }
            ("arg", [Value::Text(argument)]) => Ok(Value::Text(self.argument(argument.as_str())?)),
            ("load_yaml", [Value::Text(path)]) => {
                let path = path.as_str().to_owned();
                self.load_yaml(&path)
            }
            ("abs_filename", [Value::Text(path)]) => {
                let path = self.resolved(path.as_str())?;
                Ok(Value::text(&path.to_string_lossy()))
            }
            ("isinstance" | "type", [value, ..]) if value.known("").is_err() => {
                value.known(&format!("{name}()")).and_then(|()| wrong())
            }
            ("isinstance", [value, Value::Function(sort)]) => truth(match *sort {
                "str" => matches!(value, Value::Text(_)),
                "bool" => matches!(value, Value::Bool(_)),
                "int" => value.number().is_some_and(|n| n.is_int()),
                "float" => matches!(value, Value::Number(n) if !n.is_int()),
                "list" => matches!(value, Value::List(_)),
                "dict" => matches!(value, Value::Dict(_)),
                "tuple" => matches!(value, Value::Tuple(_)),
                "set" => matches!(value, Value::Set(_)),
                _ => return wrong(),
            }),
            _ => {
                let number = numeric(name, values, &mut self.budget)?;
                let is_exact = matches!(&number, Some(Value::Number(Num { exact: Some(_), .. })));
                if !(is_exact && OF_OPEN.contains(&name)) {
                    values
                        .iter()
                        .try_for_each(|value| value.known(&format!("{name}()")))?;
                }
                number.map_or_else(wrong, Ok)
            }
        }
    }

    /// What a file says by `xacro.warning(...)`.
    fn said_text(&mut self, values: &[Value]) -> Outcome<String> {
        let mut all = Vec::new();
        for value in values {
            all.push(self.paid_text(value)?.as_str().to_owned());
        }
        Ok(all.join(" "))
    }
}

fn pair(a: Value, b: Value) -> Value {
    Value::Tuple([a, b].into())
}

fn made_dictionary(values: &[Value], named: &Named, budget: &mut Budget) -> Outcome<Value> {
    let mut items = Vec::new();
    match values {
        [] => {}
        [Value::Dict(own)] => items.extend(own.iter().cloned()),
        [other] => {
            for item in iterated(other, budget)? {
                match &iterated(&item, budget)?[..] {
                    [key, value] => items.push((key.clone(), value.clone())),
                    _ => return Err(Trouble::new("dict() needs pairs")),
                }
            }
        }
        _ => return Err(Trouble::new("dict() takes one value")),
    }
    items.extend(
        named
            .iter()
            .map(|(name, value)| (Value::text(name), value.clone())),
    );
    Ok(Value::Dict(Keyed::collect(items, budget)?))
}

fn range(values: &[Value]) -> Outcome<Vec<Value>> {
    let mut bounds = Vec::new();
    for value in values {
        value.known("range()")?;
        match value.number().map(|number| number.kind) {
            Some(Kind::Int(bound)) => bounds.push(bound),
            _ => return Err(Trouble::new("range() needs integers")),
        }
    }
    let (start, stop, step) = match bounds[..] {
        [stop] => (0, stop, 1),
        [start, stop] => (start, stop, 1),
        [start, stop, step] if step != 0 => (start, stop, step),
        _ => {
            return Err(Trouble::new(
                "range() takes one to three integers, the step not 0",
            ));
        }
    };
    let mut items = Vec::new();
    let mut at = start;
    while (step > 0 && at < stop) || (step < 0 && at > stop) {
        if items.len() >= LONGEST_LIST {
            return Err(Trouble::new(format!(
                "a range of more than {LONGEST_LIST} numbers"
            )));
        }
        items.push(Value::Number(Num::int(at)));
        at = at.saturating_add(step);
    }
    Ok(items)
}

fn tokenized(text: &Text, separators: &str, keep_empty: bool) -> Vec<Value> {
    let whole = text.as_str();
    let mut start = 0;
    let mut parts = Vec::new();
    for (at, c) in whole
        .char_indices()
        .filter(|(_, c)| separators.contains(*c))
    {
        parts.push(start..at);
        start = at + c.len_utf8();
    }
    parts.push(start..whole.len());
    parts.retain(|part| keep_empty || !part.is_empty());
    parts
        .into_iter()
        .map(|part| Value::Text(text.slice(part)))
        .collect()
}

/// `int(text, base)` for bases 2 to 36, and 0 for the one that the text's first digits tell.
fn based(text: &str, wanted: &Value) -> Option<Num> {
    let Kind::Int(wanted) = wanted.number()?.kind else {
        return None;
    };
    let wanted = u32::try_from(wanted).ok()?;
    let plain = text.trim();
    let digits = plain.strip_prefix(['+', '-']).unwrap_or(plain);
    let told = base(digits).filter(|told| wanted == 0 || wanted == *told);
    let digits = match told {
        Some(_) => &digits[2..],
        None => digits,
    };
    let used = told.unwrap_or(if wanted == 0 { 10 } else { wanted });
    let is_read = digits.starts_with(|c: char| c.is_ascii_alphanumeric());
    if !(2..=36).contains(&used) || !is_read {
        return None;
    }
    let value = i128::from_str_radix(digits, used).ok()?;
    Some(Num::int(match plain.starts_with('-') {
        true => -value,
        false => value,
    }))
}

/// Functions of numbers; `None` where the values do not fit.
fn numeric(name: &str, values: &[Value], budget: &mut Budget) -> Outcome<Option<Value>> {
    let made = |kind, exact: Option<Number>| {
        Ok(Some(Value::Number(Num {
            kind,
            exact: exact.and_then(kept),
        })))
    };
    let float = |value: f64| made(Kind::Float(value), None);
    match (name, values) {
        ("int", [Value::Text(text)]) => {
            return match Num::read_int(text) {
                Some(number) => Ok(Some(Value::Number(number))),
                None => Err(Trouble::new(format!(
                    "int() finds no integer in {}",
                    quoted(text.as_str())
                ))),
            };
        }
        ("int", [Value::Text(text), base]) => {
            let digits = based(text.as_str(), base);
            return match digits {
                Some(number) => Ok(Some(Value::Number(number))),
                None => Err(Trouble::new(format!(
                    "int() finds no integer of this base in {}",
                    quoted(text.as_str())
                ))),
            };
        }
        ("float", [Value::Text(text)]) => {
            return match Num::read_float(text) {
                Some(number) => Ok(Some(Value::Number(number))),
                None => Err(Trouble::new(format!(
                    "float() finds no number in {}",
                    quoted(text.as_str())
                ))),
            };
        }
        _ => {}
    }
    let Some(numbers) = values
        .iter()
        .map(Value::number)
        .collect::<Option<Vec<Num>>>()
    else {
        return Ok(None);
    };
    if IRRATIONAL.contains(&name) {
        let exact = numbers.iter().filter_map(|number| number.exact.as_ref());
        // Roots are found, and directions squared, term by term.
        budget.spend(exact.map(|x| 40 * weight(x).pow(2) - 20).sum())?;
    }
    let whole = |value: f64, number: &Num| match number.kind {
        Kind::Int(_) => Ok(Some(Value::Number(number.clone()))),
        Kind::Float(_) => match floor_to_int(value) {
            Some(number) => Ok(Some(Value::Number(number))),
            None => Err(Trouble::new(format!(
                "{name}() of a number that is too large"
            ))),
        },
    };
    match (name, &numbers[..]) {
        ("float", [x]) => made(Kind::Float(x.double()), x.exact.clone()),
        ("int" | "trunc", [x]) => whole(x.double().trunc(), x),
        ("floor", [x]) => whole(x.double().floor(), x),
        ("ceil", [x]) => whole(x.double().ceil(), x),
        ("round", [x]) => whole(x.double().round_ties_even(), x),
        ("round", [x, places]) => match (x.kind, places.kind) {
            (Kind::Float(value), Kind::Int(places @ 0..=30)) => {
                let places = places as usize;
                float(format!("{value:.places$}").parse().unwrap_or(value))
            }
            (Kind::Int(_), Kind::Int(0..=30)) => Ok(Some(Value::Number(x.clone()))),
            _ => Ok(None),
        },
        ("abs", [x]) => {
            let kind = match x.kind {
                Kind::Int(value) => Kind::Int(
                    value
                        .checked_abs()
                        .ok_or_else(|| Trouble::new("the integer is too large"))?,
                ),
                Kind::Float(value) => Kind::Float(value.abs()),
            };
            made(kind, x.exact.as_ref().map(Number::abs))
        }
        ("atan2", [y, x]) => {
            let exact = match (&y.exact, &x.exact) {
                (Some(y), Some(x)) => Number::atan2(y, x).ok(),
                _ => None,
            };
            made(Kind::Float(y.double().atan2(x.double())), exact)
        }
        ("pow", [x, y]) => {
            let number = calculated(Binary::Power, x, y, budget)?;
            made(Kind::Float(number.double()), number.exact)
        }
        ("hypot", several) => {
            let square = several.iter().try_fold(Number::zero(), |sum, x| {
                let x = x.exact.as_ref()?;
                kept(&sum + &(x * x))
            });
            let value = match several {
                [x, y] => x.double().hypot(y.double()),
                _ => several
                    .iter()
                    .map(|x| x.double().powi(2))
                    .sum::<f64>()
                    .sqrt(),
            };
            made(
                Kind::Float(value),
                square.and_then(|square| square.sqrt().ok()),
            )
        }
        ("log", [x]) if x.double() > 0.0 => float(x.double().ln()),
        ("log", [x, base]) if x.double() > 0.0 && base.double() > 0.0 => {
            float(x.double().ln() / base.double().ln())
        }
        ("copysign", [x, y]) => float(x.double().copysign(y.double())),
        ("fmod", [x, y]) if y.double() != 0.0 => float(x.double() % y.double()),
        ("isnan", [x]) => Ok(Some(Value::Bool(x.double().is_nan()))),
        ("isinf", [x]) => Ok(Some(Value::Bool(x.double().is_infinite()))),
        ("isfinite", [x]) => Ok(Some(Value::Bool(x.double().is_finite()))),
        ("isclose", [x, y]) => {
            let (x, y) = (x.double(), y.double());
            // Python's default: nine digits of the larger one.
            let close = x == y || (x - y).abs() <= 1e-9 * x.abs().max(y.abs());
            Ok(Some(Value::Bool(close)))
        }
        ("gcd", [a, b]) => match (a.kind, b.kind) {
            (Kind::Int(mut a), Kind::Int(mut b)) => {
                while b != 0 {
                    (a, b) = (b, a.checked_rem(b).unwrap_or(0));
                }
                Ok(Some(Value::Number(Num::int(a.saturating_abs()))))
            }
            _ => Ok(None),
        },
        ("divmod", [a, b]) => {
            let quotient = calculated(Binary::FloorDivide, a, b, budget)?;
            let remainder = calculated(Binary::Remainder, a, b, budget)?;
            Ok(Some(pair(
                Value::Number(quotient),
                Value::Number(remainder),
            )))
        }
        (_, [x]) => {
            let Some((_, function, exact)) = OF_DOUBLE.iter().find(|(own, ..)| *own == name) else {
                return Ok(None);
            };
            let value = function(x.double());
            if value.is_nan() && !x.double().is_nan() {
                return Err(Trouble::new(format!("{name}() has no value there")));
            }
            made(Kind::Float(value), x.exact.as_ref().and_then(exact))
        }
        _ => Ok(None),
    }
}
