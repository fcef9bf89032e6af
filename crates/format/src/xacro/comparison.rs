//! Equality, order and membership, as Python has them, each pair of values compared paid for.
//!
//! Values may share their parts, `[a, a]` of lists of such lists: what is one value in memory is compared once, and what was
//! built twice is walked as long as the budget lasts.

use super::budget::Budget;
use super::functions::iterated;
use super::syntax::Comparison;
use super::value::{Kind, Value};
use super::{Outcome, Trouble};
use std::cmp::Ordering;
use std::rc::Rc;

/// The truth of `a < b`, `a in b` and the like.
pub(super) fn compare(
    operator: Comparison,
    a: &Value,
    b: &Value,
    budget: &mut Budget,
) -> Outcome<bool> {
    let is_nan = |value: &Value| value.number().is_some_and(|n| n.double().is_nan());
    let mut ordered = |wanted: fn(Ordering) -> bool| {
        if is_nan(a) || is_nan(b) {
            return Ok(false);
        }
        match order(a, b, budget)? {
            Some(ordering) => Ok(wanted(ordering)),
            None => Err(Trouble::new(format!(
                "{} and {} have no order",
                a.sort(),
                b.sort()
            ))),
        }
    };
    match operator {
        Comparison::Equal => equals(a, b, budget),
        Comparison::Unequal => Ok(!equals(a, b, budget)?),
        Comparison::Less => ordered(Ordering::is_lt),
        Comparison::LessOrEqual => ordered(Ordering::is_le),
        Comparison::Greater => ordered(Ordering::is_gt),
        Comparison::GreaterOrEqual => ordered(Ordering::is_ge),
        Comparison::In => contains(b, a, budget),
        Comparison::NotIn => Ok(!contains(b, a, budget)?),
        Comparison::Is => is_same(a, b, budget),
        Comparison::IsNot => Ok(!is_same(a, b, budget)?),
    }
}

/// `is`, which is meant for None and truth values.
fn is_same(a: &Value, b: &Value, budget: &mut Budget) -> Outcome<bool> {
    Ok(std::mem::discriminant(a) == std::mem::discriminant(b) && equals(a, b, budget)?)
}

/// What is said to ask for the value of what is left open.
const COMPARISON: &str = "a comparison";

/// Refuses to compare what is left open.
fn both_known(a: &Value, b: &Value) -> Outcome<()> {
    a.known(COMPARISON)?;
    b.known(COMPARISON)
}

/// Python's `==`.
pub(super) fn equals(a: &Value, b: &Value, budget: &mut Budget) -> Outcome<bool> {
    budget.spend(1)?;
    if let (Some(x), Some(y)) = (a.number(), b.number()) {
        both_known(a, b)?;
        return Ok(match (x.kind, y.kind) {
            (Kind::Int(x), Kind::Int(y)) => x == y,
            _ => x.double() == y.double(),
        });
    }
    match (a, b) {
        (Value::None, Value::None) => Ok(true),
        (Value::Text(x), Value::Text(y)) => {
            both_known(a, b)?;
            if x.as_str().len() != y.as_str().len() {
                return Ok(false);
            }
            budget.spend_on(a)?;
            Ok(x.as_str() == y.as_str())
        }
        (Value::List(x), Value::List(y)) | (Value::Tuple(x), Value::Tuple(y)) => {
            // A collection equals itself even where it holds a NaN: Python asks for identity first.
            if Rc::ptr_eq(x, y) {
                return Ok(true);
            }
            if x.len() != y.len() {
                return Ok(false);
            }
            budget.deeper(|budget| all_equal(x, y, budget))
        }
        (Value::Set(x), Value::Set(y)) => {
            if Rc::ptr_eq(x, y) {
                return Ok(true);
            }
            Ok(x.len() == y.len() && is_subset(x, b, budget)?)
        }
        (Value::Dict(x), Value::Dict(y)) => {
            if Rc::ptr_eq(x, y) {
                return Ok(true);
            }
            if x.len() != y.len() {
                return Ok(false);
            }
            budget.deeper(|budget| {
                for (key, value) in x.iter() {
                    match y.find(key, budget)? {
                        Some((_, other)) if equals(value, other, budget)? => {}
                        _ => return Ok(false),
                    }
                }
                Ok(true)
            })
        }
        (Value::Function(x), Value::Function(y)) | (Value::Module(x), Value::Module(y)) => {
            Ok(x == y)
        }
        _ => Ok(false),
    }
}

fn all_equal(x: &[Value], y: &[Value], budget: &mut Budget) -> Outcome<bool> {
    for (a, b) in x.iter().zip(y) {
        if !equals(a, b, budget)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The order of numbers, of texts, and of lists of such.
pub(super) fn order(a: &Value, b: &Value, budget: &mut Budget) -> Outcome<Option<Ordering>> {
    budget.spend(1)?;
    both_known(a, b)?;
    if let (Some(x), Some(y)) = (a.number(), b.number()) {
        return Ok(match (x.kind, y.kind) {
            (Kind::Int(x), Kind::Int(y)) => Some(x.cmp(&y)),
            _ => x.double().partial_cmp(&y.double()),
        });
    }
    match (a, b) {
        (Value::Text(x), Value::Text(y)) => {
            budget.spend(x.as_str().len().min(y.as_str().len()) / 64)?;
            Ok(Some(x.as_str().cmp(y.as_str())))
        }
        (Value::List(x), Value::List(y)) | (Value::Tuple(x), Value::Tuple(y)) => {
            if Rc::ptr_eq(x, y) {
                return Ok(Some(Ordering::Equal));
            }
            budget.deeper(|budget| {
                for (a, b) in x.iter().zip(y.iter()) {
                    if !equals(a, b, budget)? {
                        return order(a, b, budget);
                    }
                }
                Ok(Some(x.len().cmp(&y.len())))
            })
        }
        _ => Ok(None),
    }
}

/// The place of an item.
pub(super) fn position(
    items: &[Value],
    item: &Value,
    budget: &mut Budget,
) -> Outcome<Option<usize>> {
    for (place, own) in items.iter().enumerate() {
        if equals(own, item, budget)? {
            return Ok(Some(place));
        }
    }
    Ok(None)
}

/// `item in container`.
pub(super) fn contains(container: &Value, item: &Value, budget: &mut Budget) -> Outcome<bool> {
    match (container, item) {
        (Value::List(items) | Value::Tuple(items), _) => {
            Ok(position(items, item, budget)?.is_some())
        }
        (Value::Set(items), _) => Ok(items.find(item, budget)?.is_some()),
        (Value::Dict(items), _) => Ok(items.find(item, budget)?.is_some()),
        (Value::Text(text), Value::Text(part)) => {
            both_known(container, item)?;
            budget.spend_on(container)?;
            budget.spend_on(item)?;
            Ok(text.as_str().contains(part.as_str()))
        }
        _ => Err(Trouble::new(format!(
            "`in` does not look for {} in {}",
            item.sort(),
            container.sort()
        ))),
    }
}

/// Whether all of some items are in a container.
pub(super) fn is_subset(items: &[Value], container: &Value, budget: &mut Budget) -> Outcome<bool> {
    for item in items {
        if !contains(container, item, budget)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The least or greatest of some values.
pub(super) fn extreme(values: &[Value], wanted: Ordering, budget: &mut Budget) -> Outcome<Value> {
    let items = match values {
        [one] => iterated(one, budget)?,
        several => several.to_vec(),
    };
    let mut items = items.into_iter();
    let Some(mut best) = items.next() else {
        return Err(Trouble::new("the least or greatest of no values"));
    };
    for item in items {
        match order(&item, &best, budget)? {
            Some(ordering) if ordering == wanted => best = item,
            Some(_) => {}
            None => return Err(Trouble::new("these values have no order")),
        }
    }
    Ok(best)
}

/// The items in ascending or descending order, equal ones as they were.
///
/// Merges runs by hand: a comparison may fail, and sorting by one that is no order may panic.
pub(super) fn sorted(
    mut items: Vec<Value>,
    is_descending: bool,
    budget: &mut Budget,
) -> Outcome<Vec<Value>> {
    let mut length = 1;
    while length < items.len() {
        let mut merged = Vec::with_capacity(items.len());
        for pair in items.chunks(2 * length) {
            let (left, right) = pair.split_at(length.min(pair.len()));
            merge(left, right, is_descending, &mut merged, budget)?;
        }
        items = merged;
        length *= 2;
    }
    Ok(items)
}

fn merge(
    mut left: &[Value],
    mut right: &[Value],
    is_descending: bool,
    merged: &mut Vec<Value>,
    budget: &mut Budget,
) -> Outcome<()> {
    let wanted = if is_descending {
        Ordering::Greater
    } else {
        Ordering::Less
    };
    while let ([a, rest_of_left @ ..], [b, rest_of_right @ ..]) = (left, right) {
        match order(b, a, budget)? {
            Some(ordering) if ordering == wanted => {
                merged.push(b.clone());
                right = rest_of_right;
            }
            Some(_) => {
                merged.push(a.clone());
                left = rest_of_left;
            }
            None => return Err(Trouble::new("sorted() needs values of one sort")),
        }
    }
    merged.extend(left.iter().chain(right).cloned());
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::value::Num;
    use super::*;

    fn numbers(values: &[f64]) -> Vec<Value> {
        let number = |value: &f64| Value::Number(Num::float(*value));
        values.iter().map(number).collect()
    }

    fn shown(values: Vec<Value>) -> String {
        let text = Value::List(values.into()).repr(1000).unwrap();
        text.as_str().to_owned()
    }

    #[test]
    fn sorting_is_stable_and_refuses_what_has_no_order() {
        let budget = &mut Budget::default();
        let items = numbers(&[3.0, 1.0, 2.0, 5.0, 4.0]);
        let up = sorted(items.clone(), false, budget).unwrap();
        assert_eq!(shown(up), "[1.0, 2.0, 3.0, 4.0, 5.0]");
        let down = sorted(items, true, budget).unwrap();
        assert_eq!(shown(down), "[5.0, 4.0, 3.0, 2.0, 1.0]");
        let equal = vec![Value::int(1), Value::Bool(true), Value::int(0)];
        let up = sorted(equal.clone(), false, budget).unwrap();
        assert_eq!(shown(up), "[0, 1, True]");
        assert_eq!(shown(sorted(equal, true, budget).unwrap()), "[1, True, 0]");
        assert!(sorted(numbers(&[1.0, f64::NAN]), false, budget).is_err());
        assert!(sorted(vec![Value::int(1), Value::text("a")], false, budget).is_err());
        assert!(sorted(Vec::new(), false, budget).unwrap().is_empty());
    }

    /// A list of two lists of two lists ..., each level one list in memory.
    fn doubled(levels: usize) -> Value {
        (0..levels).fold(Value::int(1), |inner, _| {
            Value::List([inner.clone(), inner].into())
        })
    }

    #[test]
    fn what_is_one_value_in_memory_is_compared_once() {
        let budget = &mut Budget::default();
        let (one, other) = (doubled(60), doubled(60));
        let around = |value: &Value| Value::List([value.clone(), Value::int(1)].into());
        assert!(equals(&around(&one), &around(&one), budget).unwrap());
        assert!(contains(&around(&one), &one, budget).unwrap());
        assert_eq!(
            order(&around(&one), &around(&one), budget).unwrap(),
            Some(Ordering::Equal)
        );
        let nan = Value::List(numbers(&[f64::NAN]).into());
        assert!(equals(&nan, &nan, budget).unwrap());
        for refused in [
            equals(&one, &other, &mut Budget::default()).map(|_| ()),
            order(&one, &other, &mut Budget::default()).map(|_| ()),
            contains(&around(&one), &other, &mut Budget::default()).map(|_| ()),
        ] {
            assert!(refused.unwrap_err().message.contains("steps"));
        }
        let deep = |levels| (0..levels).fold(Value::None, |inner, _| around(&inner));
        let (one, other) = (deep(5000), deep(5000));
        let told = equals(&one, &other, budget).unwrap_err().message;
        assert!(told.contains("levels deep"), "{told}");
    }
}
