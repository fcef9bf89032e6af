//! The value of a term, and how two of them compare.

use super::call::{WORDS, call};
use super::solve::{Solver, Trouble};
use super::term::{Comparison, Term, What};
use super::value::{Held, NoValue, Value};
use crate::decide::{Answer, Certainty, Sign};
use crate::entity::Kind;
use crate::text::{Legible, TextError};
use std::ops::Range;

impl<'w, S: Legible> Solver<'_, 'w, S> {
    /// Whether two terms compare so.
    pub(super) fn compare(
        &self,
        first: &Term,
        comparison: Comparison,
        second: &Term,
        bound: &[Option<Value<'w, S>>],
    ) -> Result<Answer, Trouble> {
        let (left, certainty) = self.value(first, bound)?;
        if let (Value::Word(word), What::Name(name)) = (&left, &second.what) {
            let equal = is_equal(comparison).filter(|_| WORDS.contains(&name.as_str()));
            return match equal {
                Some(equal) => Ok(certainty.answer((word == name) == equal)),
                None => Err(Trouble::Wrong(self.wrong(
                    &second.span,
                    format!(
                        "needed `=` or `!=` and one of {}, found `{name}`",
                        WORDS.join(", ")
                    ),
                ))),
            };
        }
        let (right, other) = self.value(second, bound)?;
        let certainty = certainty.max(other);
        let sure = certainty.answer(true);
        match (&left, &right) {
            (Value::Number(a), Value::Number(b)) => {
                let holds = in_order(a.minus(b).sign(), comparison);
                // A doubt about the case is one about the number.
                Ok(if sure.is_yes() { holds } else { sure })
            }
            (Value::Entity(a), Value::Entity(b)) => match (is_equal(comparison), a.name(), b.name()) {
                (Some(equal), Some(a), Some(b)) => {
                    Ok(Certainty::Proven.answer((a == b) == equal))
                }
                _ => Err(Trouble::NoValue(self.wrong(
                    &first.span,
                    "needed numbers, or names of entities with `=` or `!=`; `coincide` compares entities"
                        .to_owned(),
                ))),
            },
            _ => Err(Trouble::NoValue(self.wrong(
                &second.span,
                format!("needed two numbers, found {} and {}", left.sort(), right.sort()),
            ))),
        }
    }

    fn wrong(&self, span: &Range<usize>, message: String) -> TextError {
        TextError::at(self.source, span.clone(), message)
    }

    /// The value of a term. Terms are nested no deeper than the parser allows.
    pub(super) fn value(
        &self,
        term: &Term,
        bound: &[Option<Value<'w, S>>],
    ) -> Result<(Value<'w, S>, Certainty), Trouble> {
        match &term.what {
            What::Name(name) => {
                let value = self.named(name).ok_or_else(|| {
                    let message =
                        format!("needed the name of an entity or a number, found `{name}`");
                    Trouble::Wrong(self.wrong(&term.span, message))
                })?;
                Ok((value, Certainty::Proven))
            }
            What::Free(number) => match bound.get(*number) {
                Some(Some(value)) => Ok((value.clone(), Certainty::Proven)),
                _ => {
                    let message =
                        "needed a free name that a goal before has given a value".to_owned();
                    Err(Trouble::Wrong(self.wrong(&term.span, message)))
                }
            },
            What::Number(number) => match S::from_number(number) {
                Ok(number) => Ok((Value::Number(number), Certainty::Proven)),
                Err(error) => Err(Trouble::Wrong(self.wrong(&term.span, error.to_string()))),
            },
            What::List(terms) => {
                let (values, certainty) = self.all(terms, bound)?;
                Ok((Value::List(values), certainty))
            }
            What::Call(name, terms) => match (name.as_str(), terms.as_slice()) {
                ("is", [first, kind]) => self.is_kind(first, kind, bound),
                ("part", [first, whole]) => self.is_part(first, whole, bound),
                _ => {
                    let (values, certainty) = self.all(terms, bound)?;
                    let (value, own) = call(name, &values).map_err(|NoValue(message)| {
                        Trouble::NoValue(self.wrong(&term.span, message))
                    })?;
                    let certainty = certainty.max(own);
                    let value = match (value, certainty) {
                        (Value::Truth(_), doubt) if doubt != Certainty::Proven => {
                            Value::Truth(doubt.answer(true))
                        }
                        (value, _) => value,
                    };
                    Ok((value, certainty))
                }
            },
        }
    }

    fn all(
        &self,
        terms: &[Term],
        bound: &[Option<Value<'w, S>>],
    ) -> Result<(Vec<Value<'w, S>>, Certainty), Trouble> {
        let mut values = Vec::with_capacity(terms.len());
        let mut certainty = Certainty::Proven;
        for term in terms {
            let (value, own) = self.value(term, bound)?;
            certainty = certainty.max(own);
            values.push(value);
        }
        Ok((values, certainty))
    }

    fn named(&self, name: &str) -> Option<Value<'w, S>> {
        let world = self.known.world;
        if let Some(id) = world.find(name) {
            let (name, entity) = (world.name(id)?, world.get(id)?);
            return Some(Value::Entity(Held::Known(name, entity)));
        }
        if let Some(value) = self.known.values.get(name) {
            return Some(Value::Number(value.clone()));
        }
        let number = self.known.numbers.get(name)?;
        S::from_number(number).ok().map(Value::Number)
    }

    /// Whether an entity is of a kind.
    fn is_kind(
        &self,
        first: &Term,
        kind: &Term,
        bound: &[Option<Value<'w, S>>],
    ) -> Result<(Value<'w, S>, Certainty), Trouble> {
        let wanted = match &kind.what {
            What::Name(name) => KINDS.iter().find(|kind| kind.to_string() == *name).copied(),
            _ => None,
        };
        let Some(wanted) = wanted else {
            let kinds: Vec<String> = KINDS.iter().map(Kind::to_string).collect();
            let message = format!("needed one of {}", kinds.join(", "));
            return Err(Trouble::Wrong(self.wrong(&kind.span, message)));
        };
        let (value, certainty) = self.value(first, bound)?;
        let holds = matches!(&value, Value::Entity(held) if held.entity().kind() == wanted);
        Ok((Value::Truth(certainty.answer(holds)), certainty))
    }

    /// Whether one entity was made from the other.
    fn is_part(
        &self,
        first: &Term,
        whole: &Term,
        bound: &[Option<Value<'w, S>>],
    ) -> Result<(Value<'w, S>, Certainty), Trouble> {
        let (part, _) = self.value(first, bound)?;
        let (of, _) = self.value(whole, bound)?;
        let id = |value: &Value<'w, S>| match value {
            Value::Entity(held) => held.name().and_then(|name| self.known.world.find(name)),
            _ => None,
        };
        match (id(&part), id(&of)) {
            (Some(part), Some(of)) => {
                let holds = self.known.world.is_made_from(part, of);
                Ok((
                    Value::Truth(Certainty::Proven.answer(holds)),
                    Certainty::Proven,
                ))
            }
            _ => Err(Trouble::NoValue(self.wrong(
                &first.span,
                "needed two entities of the world".to_owned(),
            ))),
        }
    }
}

/// All kinds, for `is`.
const KINDS: [Kind; 12] = [
    Kind::Vector,
    Kind::Direction,
    Kind::Point,
    Kind::Line,
    Kind::Plane,
    Kind::Segment,
    Kind::Face,
    Kind::Boundary,
    Kind::Circle,
    Kind::Cylinder,
    Kind::Cone,
    Kind::Sphere,
];

/// The opposite of an answer; a doubt stays one.
pub(super) fn not(answer: Answer) -> Answer {
    match answer {
        Answer::Yes => Answer::No,
        Answer::No => Answer::Yes,
        doubt => doubt,
    }
}

/// Whether a comparison is for equality or difference.
fn is_equal(comparison: Comparison) -> Option<bool> {
    match comparison {
        Comparison::Equal => Some(true),
        Comparison::Different => Some(false),
        _ => None,
    }
}

/// Whether a difference of this sign is as a comparison wants it.
fn in_order(sign: Sign, comparison: Comparison) -> Answer {
    match comparison {
        Comparison::Equal => Answer::zero(sign),
        Comparison::Different => not(Answer::zero(sign)),
        Comparison::Greater => Answer::positive(sign),
        Comparison::GreaterOrEqual => Answer::not_negative(sign),
        Comparison::Less => not(Answer::not_negative(sign)),
        Comparison::LessOrEqual => not(Answer::positive(sign)),
    }
}
