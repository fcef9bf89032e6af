//! YAML files as values, read as xacro's YAML reader reads them: version 1.1 of the language, and the tags for units.

use super::arithmetic::numbers;
use super::budget::Budget;
use super::keyed::Keyed;
use super::scope::Table;
use super::syntax::{Binary, parse};
use super::value::{Kind, Num, Value};
use super::yaml_scalar::{plain, tagged};
use super::{Outcome, Run, Trouble};
use crate::words::{cut, quoted};
use kutzbach_math::number::Number;
use saphyr_parser::{Event, Parser, ScalarStyle, Tag};
use std::collections::HashMap;
use std::rc::Rc;

/// Lists and dictionaries inside each other.
const DEEPEST: usize = 64;

/// A list or dictionary that is being read.
struct Open {
    anchor: usize,
    is_list: bool,
    /// Of a dictionary, keys and values in turn.
    items: Vec<Value>,
}

impl Run<'_> {
    /// `xacro.load_yaml('file')`.
    pub(super) fn load_yaml(&mut self, written: &str) -> Outcome<Value> {
        let path = self.resolved(written)?;
        let text = self.paid_file(&path)?;
        self.spend(text.len() / 8)?;
        self.yaml(&text).map_err(|trouble| {
            let message = format!("in `{}`: {}", path.display(), trouble.message);
            Box::new(Trouble {
                message,
                ..*trouble
            })
        })
    }

    /// The value of the first document.
    fn yaml(&mut self, text: &str) -> Outcome<Value> {
        let mut open: Vec<Open> = Vec::new();
        let mut anchors: HashMap<usize, Value> = HashMap::new();
        for event in Parser::new_from_str(text) {
            self.spend(1)?;
            let (event, _) = event.map_err(|error| Trouble::new(error.to_string()))?;
            let (anchor, value) = match event {
                Event::SequenceStart(anchor, _) | Event::MappingStart(anchor, _) => {
                    if open.len() >= DEEPEST {
                        return Err(Trouble::new(format!(
                            "lists are nested more than {DEEPEST} levels deep"
                        )));
                    }
                    open.push(Open {
                        anchor,
                        is_list: matches!(event, Event::SequenceStart(..)),
                        items: Vec::new(),
                    });
                    continue;
                }
                Event::SequenceEnd | Event::MappingEnd => match open.pop() {
                    Some(done) => (done.anchor, done.finish(&mut self.budget)?),
                    None => continue,
                },
                Event::Scalar(text, style, anchor, tag) => {
                    (anchor, self.scalar(&text, style, tag.as_deref())?)
                }
                Event::Alias(anchor) => {
                    let value = anchors.get(&anchor).cloned();
                    (
                        0,
                        value.ok_or_else(|| Trouble::new("an alias without its anchor"))?,
                    )
                }
                Event::DocumentEnd => break,
                _ => continue,
            };
            if anchor > 0 {
                anchors.insert(anchor, value.clone());
            }
            match open.last_mut() {
                Some(outer) => outer.items.push(value),
                None => return Ok(value),
            }
        }
        Ok(Value::None)
    }

    fn scalar(&mut self, text: &str, style: ScalarStyle, tag: Option<&Tag>) -> Outcome<Value> {
        if let Some(unit) = tag
            .filter(|tag| tag.handle == "!")
            .and_then(|tag| unit(&tag.suffix))
        {
            let tree = parse(&text.into())?;
            let names = Rc::new(Table::default());
            let value = self.evaluate(&tree, &names)?;
            let number = match (&value, value.number()) {
                (_, Some(number)) => Some(number),
                (Value::Text(text), _) => Num::read(text),
                _ => None,
            };
            let Some(number) = number else {
                return Err(Trouble::new(format!(
                    "needed a number, found {}",
                    value.sort()
                )));
            };
            return Ok(Value::Number(numbers(
                Binary::Multiply,
                &number,
                &unit,
                &mut self.budget,
            )?));
        }
        let core = tag.filter(|tag| tag.is_yaml_core_schema());
        match core {
            Some(tag) => tagged(text, &tag.suffix).ok_or_else(|| {
                let message = format!("{} is no `!!{}`", quoted(text), cut(&tag.suffix));
                Trouble::new(message)
            }),
            None if style == ScalarStyle::Plain => Ok(plain(text)),
            None => Ok(Value::text(text)),
        }
    }
}

impl Open {
    fn finish(self, budget: &mut Budget) -> Outcome<Value> {
        if self.is_list {
            return Ok(Value::List(self.items.into()));
        }
        let mut merged = Vec::new();
        let mut own = Vec::new();
        let mut merge = |value: &Value, budget: &mut Budget| -> Outcome<()> {
            budget.spend_on(value)?;
            if let Value::Dict(more) = value {
                merged.extend(more.iter().cloned());
            }
            Ok(())
        };
        let mut items = self.items.into_iter();
        while let (Some(key), Some(value)) = (items.next(), items.next()) {
            let is_merge = matches!(&key, Value::Text(key) if key.as_str() == "<<");
            match (is_merge, &value) {
                (true, Value::Dict(_)) => merge(&value, budget)?,
                (true, Value::List(several)) => {
                    // Of several, the first has the last word.
                    for one in several.iter().rev() {
                        merge(one, budget)?;
                    }
                }
                _ => own.push((key, value)),
            }
        }
        let all = merged.into_iter().chain(own);
        Ok(Value::Dict(Keyed::collect(all, budget)?))
    }
}

/// What a unit is in metres or radians.
fn unit(tag: &str) -> Option<Num> {
    let of = |kind: f64, exact: Option<Number>| {
        Some(Num {
            kind: Kind::Float(kind),
            exact,
        })
    };
    match tag {
        "radians" | "meters" => of(1.0, Some(Number::one())),
        "degrees" => of(
            std::f64::consts::PI / 180.0,
            Some(Number::integer(1).radians()),
        ),
        "millimeters" => of(0.001, Number::ratio(1, 1000)),
        "foot" => of(0.3048, Number::ratio(3048, 10000)),
        "inches" => of(0.0254, Number::ratio(254, 10000)),
        _ => None,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::ReadOptions;

    fn shown(text: &str) -> String {
        let options = ReadOptions::default();
        let value = Run::new(&options).yaml(text).unwrap();
        value.repr(1000).unwrap().as_str().to_owned()
    }

    #[test]
    fn words_are_what_version_1_1_makes_of_them() {
        for (text, value) in [
            ("[1, -2, 0x10, 010, 1_000]", "[1, -2, 16, 8, 1000]"),
            (
                "[1.5, 1e3, 1.0e3, 1.0e+3, .5, 5.]",
                "[1.5, '1e3', '1.0e3', 1000.0, 0.5, 5.0]",
            ),
            (
                "[yes, off, ~, null, 'yes', \"1\"]",
                "[True, False, None, None, 'yes', '1']",
            ),
            (
                "a: {b: 1}\nc: [x, y z]",
                "{'a': {'b': 1}, 'c': ['x', 'y z']}",
            ),
            (
                "a: &x {b: 1, c: 2}\nd: {<<: *x, c: 3}",
                "{'a': {'b': 1, 'c': 2}, 'd': {'b': 1, 'c': 3}}",
            ),
            ("[1:30, 0b101, !!float 1, !!str 7]", "[90, 5, 1.0, '7']"),
            ("", "None"),
        ] {
            assert_eq!(shown(text), value, "{text}");
        }
    }

    #[test]
    fn units_are_exact() {
        let options = ReadOptions::default();
        let value = Run::new(&options).yaml("!degrees 30").unwrap();
        let exact = value.number().unwrap().exact.unwrap();
        assert_eq!(exact, Number::integer(30).radians());
        assert_eq!(
            shown("[!degrees 180, !millimeters 5, !inches 1]"),
            "[3.141592653589793, 0.005, 0.0254]"
        );
    }

    #[test]
    fn depth_is_bounded() {
        let options = ReadOptions::default();
        assert!(Run::new(&options).yaml(&"[".repeat(100_000)).is_err());
        assert!(Run::new(&options).yaml("a: [").is_err());
    }
}
