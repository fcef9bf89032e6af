//! What is called on a value: `name.split('_')`, `sizes.get('x', 1)`.

use super::arithmetic::{LONGEST_TEXT, Said};
use super::functions::iterated;
use super::python_text::braces;
use super::text::{Joined, Text};
use super::value::{Value, found, has, set};
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

/// The value of `object.name(values)`.
pub(super) fn method(
    object: &Value,
    name: &str,
    values: &[Value],
    named: &[(Rc<str>, Value)],
) -> Said<Value> {
    let result = match object {
        Value::Text(text) => of_text(text, name, values, named)?,
        Value::List(items) | Value::Tuple(items) => match (name, values) {
            ("count", [item]) => Some(Value::int(
                items.iter().filter(|own| own.equals(item)).count(),
            )),
            ("index", [item]) => match items.iter().position(|own| own.equals(item)) {
                Some(index) => Some(Value::int(index)),
                None => return Err("the list has no such item".to_owned()),
            },
            _ => None,
        },
        Value::Set(items) => of_set(items, name, values),
        Value::Dict(items) => {
            let list = |values: Vec<Value>| Some(Value::List(values.into()));
            match (name, values) {
                ("keys", []) => list(items.iter().map(|(key, _)| key.clone()).collect()),
                ("values", []) => list(items.iter().map(|(_, value)| value.clone()).collect()),
                ("items", []) => list(
                    items
                        .iter()
                        .map(|(key, value)| Value::Tuple([key.clone(), value.clone()].into()))
                        .collect(),
                ),
                ("get", [key, rest @ ..]) if rest.len() < 2 => Some(
                    found(items, key)
                        .or(rest.first())
                        .cloned()
                        .unwrap_or(Value::None),
                ),
                _ => None,
            }
        }
        _ => None,
    };
    result.ok_or_else(|| format!("{}.{name}() does not take these values", object.sort()))
}

/// Methods of a set with one other collection.
fn of_set(items: &[Value], name: &str, values: &[Value]) -> Option<Value> {
    let [other] = values else {
        return None;
    };
    let other = iterated(other).ok()?;
    let common = items.iter().filter(|item| has(&other, item));
    Some(match name {
        "intersection" => Value::Set(common.cloned().collect()),
        "difference" => Value::Set(
            items
                .iter()
                .filter(|item| !has(&other, item))
                .cloned()
                .collect(),
        ),
        "union" => set(items.iter().cloned().chain(other)),
        "isdisjoint" => Value::Bool(common.count() == 0),
        "issubset" => Value::Bool(common.count() == items.len()),
        "issuperset" => Value::Bool(other.iter().all(|item| has(items, item))),
        _ => return None,
    })
}

fn of_text(
    text: &Text,
    name: &str,
    values: &[Value],
    named: &[(Rc<str>, Value)],
) -> Said<Option<Value>> {
    let whole = text.as_str();
    let plain = |text: &str| {
        if text.len() > LONGEST_TEXT {
            return Err("the text is too long".to_owned());
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
        ("format", _) => return Ok(braces(whole, values, named).map(|text| Value::text(&text))),
        ("join", _) => {
            let [items] = values else {
                return Ok(None);
            };
            let mut joined = Joined::default();
            for (index, item) in iterated(items).map_err(|t| t.message)?.iter().enumerate() {
                let Value::Text(item) = item else {
                    return Err(format!("join() needs texts, found {}", item.sort()));
                };
                if index > 0 {
                    joined.push(text);
                }
                joined.push(item);
                if joined.len() > LONGEST_TEXT {
                    return Err("the text is too long".to_owned());
                }
            }
            return Ok(Some(Value::Text(joined.finish())));
        }
        ("split" | "rsplit", _) => return Ok(split(text, name, values)),
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
            None => Err("the text has no such part".to_owned()),
        },
        ("count", [part]) if !part.is_empty() => Ok(Some(Value::int(whole.matches(part).count()))),
        ("replace", [old, new]) if !old.is_empty() => {
            let more = whole.matches(old).count().saturating_mul(new.len());
            if more > LONGEST_TEXT {
                return Err("the text is too long".to_owned());
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
fn split(text: &Text, name: &str, values: &[Value]) -> Option<Value> {
    let whole = text.as_str();
    let most = match values.get(1) {
        None => usize::MAX,
        Some(most) => {
            let most = most.number()?.double();
            if most < 0.0 {
                usize::MAX
            } else {
                most as usize
            }
        }
    };
    let mut cuts: Vec<(usize, usize)> = match values.first() {
        None | Some(Value::None) => {
            let words = whole.split_whitespace().map(|word| {
                let start = word.as_ptr() as usize - whole.as_ptr() as usize;
                Value::Text(text.slice(start..start + word.len()))
            });
            return Some(Value::List(words.collect()));
        }
        Some(Value::Text(separator)) if !separator.as_str().is_empty() => whole
            .match_indices(separator.as_str())
            .map(|(at, part)| (at, at + part.len()))
            .collect(),
        _ => return None,
    };
    if cuts.len() > most {
        match name {
            "rsplit" => drop(cuts.drain(..cuts.len() - most)),
            _ => cuts.truncate(most),
        }
    }
    let mut parts = Vec::with_capacity(cuts.len() + 1);
    let mut start = 0;
    for (end, next) in cuts {
        parts.push(Value::Text(text.slice(start..end)));
        start = next;
    }
    parts.push(Value::Text(text.slice(start..whole.len())));
    Some(Value::List(parts.into()))
}
