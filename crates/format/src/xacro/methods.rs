//! What is called on a value: `name.split('_')`, `sizes.get('x', 1)`.

use super::arithmetic::{LONGEST_LIST, LONGEST_TEXT};
use super::budget::Budget;
use super::comparison::{equals, position};
use super::field::braces;
use super::functions::iterated;
use super::keyed::Keyed;
use super::text::{Joined, Text};
use super::value::Value;
use super::{Outcome, Trouble};
use std::ops::Range;
use std::rc::Rc;

const OF_TEXT: [&str; 26] = [
    "capitalize",
    "count",
    "endswith",
    "find",
    "format",
    "index",
    "isalnum",
    "isalpha",
    "isdigit",
    "islower",
    "isupper",
    "join",
    "ljust",
    "lower",
    "lstrip",
    "replace",
    "rfind",
    "rjust",
    "rsplit",
    "rstrip",
    "split",
    "startswith",
    "strip",
    "title",
    "upper",
    "zfill",
];
const OF_LIST: [&str; 2] = ["count", "index"];
const OF_SET: [&str; 6] = [
    "difference",
    "intersection",
    "isdisjoint",
    "issubset",
    "issuperset",
    "union",
];
const OF_DICT: [&str; 4] = ["get", "items", "keys", "values"];

pub(super) fn has_method(value: &Value, name: &str) -> bool {
    match value {
        Value::Text(_) => OF_TEXT.contains(&name),
        Value::List(_) | Value::Tuple(_) => OF_LIST.contains(&name),
        Value::Set(_) => OF_SET.contains(&name),
        Value::Dict(_) => OF_DICT.contains(&name),
        _ => false,
    }
}

/// The value of `object.name(values)`, all of them paid for.
pub(super) fn method(
    object: &Value,
    name: &str,
    values: &[Value],
    named: &[(Rc<str>, Value)],
    budget: &mut Budget,
) -> Outcome<Value> {
    let result = match object {
        Value::Text(text) => of_text(text, name, values, named, budget)?,
        Value::List(items) | Value::Tuple(items) => of_list(items, name, values, budget)?,
        Value::Set(items) => of_set(items, name, values, budget)?,
        Value::Dict(items) => of_dictionary(items, name, values, budget)?,
        _ => None,
    };
    result.ok_or_else(|| {
        Trouble::new(format!(
            "{}.{name}() does not take these values",
            object.sort()
        ))
    })
}

fn of_list(
    items: &[Value],
    name: &str,
    values: &[Value],
    budget: &mut Budget,
) -> Outcome<Option<Value>> {
    match (name, values) {
        ("count", [item]) => {
            let mut count = 0;
            for own in items {
                count += usize::from(equals(own, item, budget)?);
            }
            Ok(Some(Value::int(count)))
        }
        ("index", [item]) => match position(items, item, budget)? {
            Some(index) => Ok(Some(Value::int(index))),
            None => Err(Trouble::new("the list has no such item")),
        },
        _ => Ok(None),
    }
}

fn of_dictionary(
    items: &Keyed<(Value, Value)>,
    name: &str,
    values: &[Value],
    budget: &mut Budget,
) -> Outcome<Option<Value>> {
    let list = |values: Vec<Value>| Ok(Some(Value::List(values.into())));
    match (name, values) {
        ("keys", []) => list(items.iter().map(|(key, _)| key.clone()).collect()),
        ("values", []) => list(items.iter().map(|(_, value)| value.clone()).collect()),
        ("items", []) => list(
            items
                .iter()
                .map(|(key, value)| Value::Tuple([key.clone(), value.clone()].into()))
                .collect(),
        ),
        ("get", [key, rest @ ..]) if rest.len() < 2 => {
            let own = items.find(key, budget)?.map(|(_, value)| value);
            Ok(Some(own.or(rest.first()).cloned().unwrap_or(Value::None)))
        }
        _ => Ok(None),
    }
}

/// Methods of a set with one other collection.
fn of_set(
    items: &Keyed<Value>,
    name: &str,
    values: &[Value],
    budget: &mut Budget,
) -> Outcome<Option<Value>> {
    let [other] = values else {
        return Ok(None);
    };
    let other = Keyed::collect(iterated(other, budget)?, budget)?;
    let mut common = Vec::new();
    let mut different = Vec::new();
    for item in items.iter() {
        match other.find(item, budget)? {
            Some(_) => common.push(item.clone()),
            None => different.push(item.clone()),
        }
    }
    let set = |items: Vec<Value>, budget: &mut Budget| {
        Ok(Some(Value::Set(Keyed::collect(items, budget)?)))
    };
    let truth = |value| Ok(Some(Value::Bool(value)));
    match name {
        "intersection" => set(common, budget),
        "difference" => set(different, budget),
        "union" => set(items.iter().chain(other.iter()).cloned().collect(), budget),
        "isdisjoint" => truth(common.is_empty()),
        "issubset" => truth(different.is_empty()),
        "issuperset" => truth(common.len() == other.len()),
        _ => Ok(None),
    }
}

fn of_text(
    text: &Text,
    name: &str,
    values: &[Value],
    named: &[(Rc<str>, Value)],
    budget: &mut Budget,
) -> Outcome<Option<Value>> {
    let whole = text.as_str();
    let plain = |text: &str| {
        if text.len() > LONGEST_TEXT {
            return Err(Trouble::new("the text is too long"));
        }
        Ok(Some(Value::text(text)))
    };
    let truth = |value| Ok(Some(Value::Bool(value)));
    let place = |byte: Option<usize>| match byte {
        Some(byte) => Value::int(whole[..byte].chars().count()),
        None => Value::Number(super::value::Num::int(-1)),
    };
    let all = |test: fn(char) -> bool| !whole.is_empty() && whole.chars().all(test);
    let texts: Vec<&str> = values
        .iter()
        .map_while(|value| match value {
            Value::Text(text) => Some(text.as_str()),
            _ => None,
        })
        .collect();
    let only_texts = texts.len() == values.len();
    match (name, &texts[..]) {
        ("format", _) => {
            let filled = braces(whole, values, named, budget)?;
            return Ok(filled.map(|text| Value::text(&text)));
        }
        ("join", _) => {
            let [items] = values else {
                return Ok(None);
            };
            let mut joined = Joined::default();
            for (index, item) in iterated(items, budget)?.iter().enumerate() {
                let Value::Text(item) = item else {
                    return Err(Trouble::new(format!(
                        "join() needs texts, found {}",
                        item.sort()
                    )));
                };
                if index > 0 {
                    joined.push(text);
                }
                joined.push(item);
                if joined.len() > LONGEST_TEXT {
                    return Err(Trouble::new("the text is too long"));
                }
            }
            return Ok(Some(Value::Text(joined.finish())));
        }
        ("split" | "rsplit", _) => return split(text, name, values, budget),
        ("zfill" | "ljust" | "rjust", _) => {
            let [width] = values else {
                return Ok(None);
            };
            let width = width
                .number()
                .map_or(0.0, |n| n.double())
                .clamp(0.0, 4096.0) as usize;
            let missing = width.saturating_sub(whole.chars().count());
            return plain(&match name {
                "ljust" => format!("{whole}{}", " ".repeat(missing)),
                "rjust" => format!("{}{whole}", " ".repeat(missing)),
                _ => match whole.strip_prefix('-') {
                    Some(rest) => format!("-{}{rest}", "0".repeat(missing)),
                    None => format!("{}{whole}", "0".repeat(missing)),
                },
            });
        }
        _ => {}
    }
    if !only_texts {
        return Ok(None);
    }
    let stripped = |characters: Option<&&str>| {
        let gone = |c: char| match characters {
            Some(characters) => characters.contains(c),
            None => c.is_whitespace(),
        };
        let start = match name {
            "rstrip" => 0,
            _ => whole.len() - whole.trim_start_matches(gone).len(),
        };
        let end = match name {
            "lstrip" => whole.len(),
            _ => whole.trim_end_matches(gone).len().max(start),
        };
        text.slice(start..end)
    };
    match (name, &texts[..]) {
        ("strip" | "lstrip" | "rstrip", [] | [_]) => Ok(Some(Value::Text(stripped(texts.first())))),
        ("lower", []) => plain(&whole.to_lowercase()),
        ("upper", []) => plain(&whole.to_uppercase()),
        ("capitalize", []) => plain(&capitalized(whole)),
        ("title", []) => {
            let mut start = true;
            let title: String = whole
                .chars()
                .flat_map(|c| {
                    let cased: Vec<char> = match start {
                        true => c.to_uppercase().collect(),
                        false => c.to_lowercase().collect(),
                    };
                    start = !c.is_alphabetic();
                    cased
                })
                .collect();
            plain(&title)
        }
        ("startswith", [part]) => truth(whole.starts_with(part)),
        ("endswith", [part]) => truth(whole.ends_with(part)),
        ("find", [part]) => Ok(Some(place(whole.find(part)))),
        ("rfind", [part]) => Ok(Some(place(whole.rfind(part)))),
        ("index", [part]) => match whole.find(part) {
            Some(byte) => Ok(Some(place(Some(byte)))),
            None => Err(Trouble::new("the text has no such part")),
        },
        ("count", [part]) if !part.is_empty() => Ok(Some(Value::int(whole.matches(part).count()))),
        ("replace", [old, new]) if !old.is_empty() => {
            let more = whole.matches(old).count().saturating_mul(new.len());
            if more > LONGEST_TEXT {
                return Err(Trouble::new("the text is too long"));
            }
            plain(&whole.replace(old, new))
        }
        ("isdigit", []) => truth(all(|c| c.is_ascii_digit())),
        ("isalpha", []) => truth(all(char::is_alphabetic)),
        ("isalnum", []) => truth(all(char::is_alphanumeric)),
        ("islower", []) => truth(whole.to_lowercase() == whole && whole.to_uppercase() != whole),
        ("isupper", []) => truth(whole.to_uppercase() == whole && whole.to_lowercase() != whole),
        _ => Ok(None),
    }
}

fn capitalized(text: &str) -> String {
    let mut chars = text.chars();
    match chars.next() {
        Some(first) => first
            .to_uppercase()
            .chain(chars.as_str().to_lowercase().chars())
            .collect(),
        None => String::new(),
    }
}

/// The parts of a text, each with its marks.
fn split(text: &Text, name: &str, values: &[Value], budget: &mut Budget) -> Outcome<Option<Value>> {
    let whole = text.as_str();
    let most = match values.get(1).map(Value::number) {
        None => usize::MAX,
        Some(None) => return Ok(None),
        Some(Some(most)) if most.double() < 0.0 => usize::MAX,
        Some(Some(most)) => most.double() as usize,
    };
    let mut cuts: Vec<(usize, usize)> = match values.first() {
        None | Some(Value::None) => {
            let words = whole.split_whitespace().map(|word| {
                let start = word.as_ptr() as usize - whole.as_ptr() as usize;
                start..start + word.len()
            });
            return parts(text, words.collect(), budget);
        }
        Some(Value::Text(separator)) if !separator.as_str().is_empty() => whole
            .match_indices(separator.as_str())
            .map(|(at, part)| (at, at + part.len()))
            .collect(),
        _ => return Ok(None),
    };
    if cuts.len() > most {
        match name {
            "rsplit" => drop(cuts.drain(..cuts.len() - most)),
            _ => cuts.truncate(most),
        }
    }
    let mut ranges = Vec::with_capacity(cuts.len() + 1);
    let mut start = 0;
    for (end, next) in cuts {
        ranges.push(start..end);
        start = next;
    }
    ranges.push(start..whole.len());
    parts(text, ranges, budget)
}

fn parts(text: &Text, ranges: Vec<Range<usize>>, budget: &mut Budget) -> Outcome<Option<Value>> {
    if ranges.len() > LONGEST_LIST {
        return Err(Trouble::new("the list is too long"));
    }
    budget.spend(ranges.len())?;
    let parts = ranges
        .into_iter()
        .map(|range| Value::Text(text.slice(range)));
    Ok(Some(Value::List(parts.collect())))
}
