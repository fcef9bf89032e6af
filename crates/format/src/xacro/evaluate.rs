//! Expressions to values.

use super::arithmetic::{LONGEST_LIST, binary, negated, positive};
use super::comparison::compare;
use super::functions::{builtin, iterated};
use super::keyed::Keyed;
use super::methods::{has_method, method};
use super::scope::{Entry, Table};
use super::syntax::{Clause, Comprehension, Expr};
use super::text::Text;
use super::value::{Kind, Num, Value};
use super::{Outcome, Run, Trouble};
use crate::words::{did_you_mean, quoted};
use std::rc::Rc;

impl Run<'_> {
    /// The value of an expression where these names are known.
    pub(super) fn evaluate(&mut self, expression: &Expr, names: &Rc<Table>) -> Outcome<Value> {
        self.spend(1)?;
        self.deeper(|run| run.evaluate_node(expression, names))
    }

    fn evaluate_node(&mut self, expression: &Expr, names: &Rc<Table>) -> Outcome<Value> {
        match expression {
            Expr::Literal(value) => Ok(value.clone()),
            Expr::Name(name) => self.named(name, names),
            Expr::List(items) => Ok(Value::List(self.all(items, names)?.into())),
            Expr::Tuple(items) => Ok(Value::Tuple(self.all(items, names)?.into())),
            Expr::Dict(items) => {
                let mut all = Vec::with_capacity(items.len());
                for (key, value) in items {
                    all.push((self.evaluate(key, names)?, self.evaluate(value, names)?));
                }
                self.dictionary(all)
            }
            Expr::Negate(operand) => Ok(negated(&self.evaluate(operand, names)?)?),
            Expr::Plus(operand) => Ok(positive(&self.evaluate(operand, names)?)?),
            Expr::Not(operand) => {
                let value = self.evaluate(operand, names)?;
                Ok(Value::Bool(!value.truth("`not`")?))
            }
            Expr::Binary(operator, a, b) => {
                let a = self.evaluate(a, names)?;
                let b = self.evaluate(b, names)?;
                self.spend_on(&a)?;
                self.spend_on(&b)?;
                let result = binary(*operator, &a, &b, &mut self.budget)?;
                self.spend_on(&result)?;
                Ok(result)
            }
            Expr::Compare(first, rest) => {
                let mut left = self.evaluate(first, names)?;
                for (comparison, operand) in rest {
                    let right = self.evaluate(operand, names)?;
                    if !compare(*comparison, &left, &right, &mut self.budget)? {
                        return Ok(Value::Bool(false));
                    }
                    left = right;
                }
                Ok(Value::Bool(true))
            }
            Expr::And(a, b) => match self.evaluate(a, names)? {
                value if value.truth("`and`")? => self.evaluate(b, names),
                value => Ok(value),
            },
            Expr::Or(a, b) => match self.evaluate(a, names)? {
                value if value.truth("`or`")? => Ok(value),
                _ => self.evaluate(b, names),
            },
            Expr::Choice(parts) => {
                let [condition, value, otherwise] = &**parts;
                let holds = self.evaluate(condition, names)?.truth("`if`")?;
                self.evaluate(if holds { value } else { otherwise }, names)
            }
            Expr::Member(object, name) => {
                let object = self.evaluate(object, names)?;
                self.member(&object, name)
            }
            Expr::Index(object, index) => {
                let object = self.evaluate(object, names)?;
                let index = self.evaluate(index, names)?;
                self.item(&object, &index)
            }
            Expr::Slice(object, parts) => {
                let object = self.evaluate(object, names)?;
                let mut bounds = [None, None, None];
                for (bound, part) in bounds.iter_mut().zip(parts.iter()) {
                    *bound = match part {
                        Some(part) => integer(&self.evaluate(part, names)?)?,
                        None => None,
                    };
                }
                self.spend_on(&object)?;
                slice(&object, bounds)
            }
            Expr::Call(function, values, named) => {
                let result = self.call(function, values, named, names)?;
                self.spend_on(&result)?;
                Ok(result)
            }
            Expr::Comprehension(comprehension) => {
                let mut found = Vec::new();
                self.comprehend(comprehension, 0, names, &mut found)?;
                match comprehension.key {
                    None => Ok(Value::List(
                        found.into_iter().map(|(_, value)| value).collect(),
                    )),
                    Some(_) => self.dictionary(found),
                }
            }
        }
    }

    fn dictionary(&mut self, items: Vec<(Value, Value)>) -> Outcome<Value> {
        Ok(Value::Dict(Keyed::collect(items, &mut self.budget)?))
    }

    fn all(&mut self, items: &[Expr], names: &Rc<Table>) -> Outcome<Vec<Value>> {
        items
            .iter()
            .map(|item| self.evaluate(item, names))
            .collect()
    }

    /// What a name stands for: a definition of the file, or else what xacro knows itself.
    fn named(&mut self, name: &str, names: &Rc<Table>) -> Outcome<Value> {
        if let Some(value) = self.lookup(name, names)? {
            return Ok(value);
        }
        if let Some(value) = builtin(name) {
            return Ok(value);
        }
        let known = names.known();
        Err(
            Trouble::new(format!("there is no property named {}", quoted(name))).maybe_help(
                did_you_mean(name, known.iter().map(String::as_str), ("`", "`")),
            ),
        )
    }

    /// The value of a name that the file defines; text is evaluated at first use, where it was defined.
    pub(super) fn lookup(&mut self, name: &str, names: &Rc<Table>) -> Outcome<Option<Value>> {
        self.spend(names.level())?;
        let Some(owner) = names.owner(name) else {
            return Ok(None);
        };
        let (text, place) = match owner.own(name) {
            None => return Ok(None),
            Some(Entry::Ready(value)) => return Ok(Some(value)),
            Some(Entry::Busy) => {
                let mut circle = self.evaluating.clone();
                circle.push(name.to_owned());
                let from = circle.iter().position(|own| own == name).unwrap_or(0);
                let circle = circle.get(from..).unwrap_or_default();
                let shown: Vec<&str> = circle.iter().take(8).map(String::as_str).collect();
                return Err(Trouble::new(format!(
                    "{} is defined by itself: {}",
                    quoted(name),
                    shown.join(" -> ")
                ))
                .help("lazy_eval=\"false\" evaluates a property where it is defined"));
            }
            Some(Entry::Lazy(text, place)) => (text, place),
        };
        owner.set(name, Entry::Busy);
        self.evaluating.push(name.to_owned());
        let result = self.substitute(&text, place, &owner);
        self.evaluating.pop();
        match result {
            Ok(value) => {
                let value = match value {
                    Value::Text(text) => Value::literal(&text),
                    other => other,
                };
                let value = self.kept_symbolic(name, value)?;
                owner.set_value(name, value.clone());
                Ok(Some(value))
            }
            Err(trouble) => {
                owner.set(name, Entry::Lazy(text, place));
                Err(trouble)
            }
        }
    }

    fn member(&mut self, object: &Value, name: &str) -> Outcome<Value> {
        match object {
            Value::Module(_) => builtin(name).map(Ok).unwrap_or_else(|| {
                Err(Trouble::new(format!(
                    "there is no function named {}",
                    quoted(name)
                )))
            }),
            Value::Namespace(table) => {
                let table = table.clone();
                self.lookup(name, &table)?.map(Ok).unwrap_or_else(|| {
                    let known = table.known();
                    Err(
                        Trouble::new(format!("there is no property named {}", quoted(name)))
                            .maybe_help(did_you_mean(
                                name,
                                known.iter().map(String::as_str),
                                ("`", "`"),
                            )),
                    )
                })
            }
            Value::Dict(items) => match items.find(&Value::text(name), &mut self.budget)? {
                Some((_, value)) => Ok(value.clone()),
                None => Err(no_key(items, name)),
            },
            _ => Err(Trouble::new(format!(
                "{} has nothing named {}",
                object.sort(),
                quoted(name)
            ))),
        }
    }

    fn call(
        &mut self,
        function: &Expr,
        values: &[Expr],
        named: &[(Rc<str>, Expr)],
        names: &Rc<Table>,
    ) -> Outcome<Value> {
        let mut object = None;
        let mut callee = None;
        if let Expr::Member(of, name) = function {
            let value = self.evaluate(of, names)?;
            if has_method(&value, name) {
                object = Some((value, name));
            } else {
                callee = Some(self.member(&value, name)?);
            }
        } else {
            callee = Some(self.evaluate(function, names)?);
        }
        let values = self.all(values, names)?;
        let mut by_name = Vec::with_capacity(named.len());
        for (name, value) in named {
            by_name.push((name.clone(), self.evaluate(value, names)?));
        }
        for value in &values {
            self.spend_on(value)?;
        }
        if let Some((object, name)) = object {
            self.spend_on(&object)?;
            if let Value::Text(_) = &object {
                // What a method makes of a text forgets the numbers in it.
                let mut all = std::iter::once(&object).chain(&values);
                let named = by_name.iter().map(|(_, value)| value);
                all.by_ref()
                    .chain(named)
                    .try_for_each(|value| value.known(&format!("{name}()")))?;
            }
            return method(&object, name, &values, &by_name, &mut self.budget);
        }
        match callee {
            Some(Value::Function(name)) => self.apply(name, &values, &by_name),
            Some(other) => Err(Trouble::new(format!("{} cannot be called", other.sort()))),
            None => Err(Trouble::new("nothing to call")),
        }
    }

    /// `object[index]`.
    fn item(&mut self, object: &Value, index: &Value) -> Outcome<Value> {
        if let Value::Dict(items) = object {
            return match items.find(index, &mut self.budget)? {
                Some((_, value)) => Ok(value.clone()),
                None => {
                    let shown = index.to_text(100);
                    Err(no_key(items, shown.as_ref().map_or("", Text::as_str)))
                }
            };
        }
        let length = match object {
            Value::List(items) | Value::Tuple(items) => items.len(),
            Value::Text(text) => {
                self.spend_on(object)?;
                text.as_str().chars().count()
            }
            _ => {
                return Err(Trouble::new(format!("{} has no items", object.sort())));
            }
        };
        let Some(wanted) = integer(index)? else {
            return Err(Trouble::new("needed an integer as index, found None"));
        };
        let at = if wanted < 0 {
            wanted + length as i128
        } else {
            wanted
        };
        let at = usize::try_from(at).ok().filter(|at| *at < length);
        let Some(at) = at else {
            return Err(Trouble::new(format!(
                "there is no item {wanted}: {} has {length}",
                object.sort()
            )));
        };
        match object {
            Value::List(items) | Value::Tuple(items) => Ok(items[at].clone()),
            _ => slice(object, [Some(at as i128), Some(at as i128 + 1), None]),
        }
    }

    fn comprehend(
        &mut self,
        all: &Comprehension,
        clause: usize,
        names: &Rc<Table>,
        found: &mut Vec<(Value, Value)>,
    ) -> Outcome<()> {
        match all.clauses.get(clause) {
            None => {
                let key = match &all.key {
                    Some(key) => self.evaluate(key, names)?,
                    None => Value::None,
                };
                found.push((key, self.evaluate(&all.value, names)?));
                if found.len() > LONGEST_LIST {
                    return Err(Trouble::new("the list is too long"));
                }
                Ok(())
            }
            Some(Clause::If(condition)) => {
                if self.evaluate(condition, names)?.truth("`if`")? {
                    self.deeper(|run| run.comprehend(all, clause + 1, names, found))?;
                }
                Ok(())
            }
            Some(Clause::For(targets, items)) => {
                let items = self.evaluate(items, names)?;
                let inner = Table::inside(names);
                for item in iterated(&items, &mut self.budget)? {
                    if let [only] = &targets[..] {
                        inner.set_value(only, item);
                    } else {
                        let parts = iterated(&item, &mut self.budget)?;
                        if parts.len() != targets.len() {
                            return Err(Trouble::new(format!(
                                "needed {} values, found {}",
                                targets.len(),
                                parts.len()
                            )));
                        }
                        for (target, part) in targets.iter().zip(parts) {
                            inner.set_value(target, part);
                        }
                    }
                    self.deeper(|run| run.comprehend(all, clause + 1, &inner, found))?;
                }
                Ok(())
            }
        }
    }

    /// A number of a name that is to stay open.
    ///
    /// # Errors
    /// Where its value is no exact number.
    pub(super) fn kept_symbolic(&mut self, name: &str, value: Value) -> Outcome<Value> {
        if !self.options.symbolic.iter().any(|own| own == name) {
            return Ok(value);
        }
        self.met_names.insert(name.to_owned());
        match value {
            Value::Number(Num {
                kind,
                exact: Some(exact),
            }) => Ok(Value::Number(Num {
                kind,
                exact: Some(kutzbach_math::number::Number::parameter(name, exact)),
            })),
            other => Err(Trouble::new(format!(
                "{} cannot be left open: it is {} without an exact value",
                quoted(name),
                other.sort()
            ))),
        }
    }
}

fn no_key(items: &[(Value, Value)], name: &str) -> Box<Trouble> {
    let keys: Vec<&str> = items
        .iter()
        .filter_map(|(key, _)| match key {
            Value::Text(text) => Some(text.as_str()),
            _ => None,
        })
        .collect();
    Trouble::new(format!("the dictionary has no key {}", quoted(name))).maybe_help(did_you_mean(
        name,
        keys,
        ("`", "`"),
    ))
}

/// An index as an integer; `None` for Python's None.
fn integer(value: &Value) -> Outcome<Option<i128>> {
    value.known("an index")?;
    match value.number().map(|number| number.kind) {
        Some(Kind::Int(index)) => Ok(Some(index)),
        _ if matches!(value, Value::None) => Ok(None),
        _ => Err(Trouble::new(format!(
            "needed an integer as index, found {}",
            value.sort()
        ))),
    }
}

/// `object[start:stop:step]` with Python's treatment of what lies outside.
fn slice(object: &Value, [start, stop, step]: [Option<i128>; 3]) -> Outcome<Value> {
    object.known("a part of a text")?;
    let step = step.unwrap_or(1);
    if step == 0 {
        return Err(Trouble::new("a slice with step 0"));
    }
    let pick = |length: usize| -> Vec<usize> {
        let length = length as i128;
        let clamp = |bound: i128, low: i128, high: i128| {
            let bound = if bound < 0 {
                bound.saturating_add(length)
            } else {
                bound
            };
            bound.clamp(low, high)
        };
        let mut picked = Vec::new();
        if step > 0 {
            let mut at = start.map_or(0, |start| clamp(start, 0, length));
            let end = stop.map_or(length, |stop| clamp(stop, 0, length));
            while at < end {
                picked.push(at as usize);
                at = at.saturating_add(step);
            }
        } else {
            let mut at = start.map_or(length - 1, |start| clamp(start, -1, length - 1));
            let end = stop.map_or(-1, |stop| clamp(stop, -1, length - 1));
            while at > end {
                picked.push(at as usize);
                at = at.saturating_add(step);
            }
        }
        picked
    };
    Ok(match object {
        Value::List(items) => Value::List(
            pick(items.len())
                .into_iter()
                .map(|at| items[at].clone())
                .collect(),
        ),
        Value::Tuple(items) => Value::Tuple(
            pick(items.len())
                .into_iter()
                .map(|at| items[at].clone())
                .collect(),
        ),
        Value::Text(text) => {
            let whole = text.as_str();
            let places: Vec<usize> = whole.char_indices().map(|(at, _)| at).collect();
            let picked = pick(places.len());
            let end_of = |index: usize| places.get(index + 1).copied().unwrap_or(whole.len());
            if let (1, Some(first), Some(last)) = (step, picked.first(), picked.last()) {
                return Ok(Value::Text(text.slice(places[*first]..end_of(*last))));
            }
            let chars = picked.into_iter().map(|at| &whole[places[at]..end_of(at)]);
            Value::text(&chars.collect::<String>())
        }
        _ => return Err(Trouble::new(format!("{} has no items", object.sort()))),
    })
}
