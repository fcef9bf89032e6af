//! Scripts: lines that ask, and lines that make, rename and delete entities.

use super::parse::{query, statement};
use super::show::{Shown, answer_text};
use super::solve::{Answers, Known, Row, evaluate, solve};
use super::term::{Statement, Term, What};
use super::value::Value;
use crate::decide::{Answer, Certainty};
use crate::entity::Entity;
use crate::text::{Legible, Reading, TextError, TokenKind, tokens};
use crate::world::{Id, World};
use kutzbach_math::number::Number;
use std::collections::BTreeMap;
use std::ops::Range;

/// With this begin the lines of a transcript that the session has written; a script that has them is read without them.
const ANSWER: &str = "#|";

/// A world that is asked and changed.
#[derive(Clone, Debug)]
pub struct Session<S> {
    world: World<S>,
    numbers: BTreeMap<String, Number>,
    values: BTreeMap<String, S>,
}

/// What came of a line.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Told {
    /// The answers to a question.
    Answers(Answers),
    /// What was made: names, and what has them. Nothing where a construction found nothing.
    Made {
        /// What was made, by names.
        made: Vec<(String, Shown)>,
        /// How certain the case of the construction is.
        certainty: Certainty,
    },
    /// How many entities were deleted.
    Deleted(usize),
    /// An entity has another name.
    Renamed,
    /// All entities and numbers, by names.
    Listed(Vec<(String, Shown)>),
}

/// What a line of a script came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Reply {
    /// The line, counted from 1.
    pub line: usize,
    /// What came of it.
    pub told: Told,
}

/// A line of a script with its reply.
#[derive(Clone, Debug, PartialEq)]
pub struct TranscriptLine {
    /// The line as it was written.
    pub source: String,
    /// The reply; none to comments and empty lines.
    pub reply: Option<Reply>,
}

/// A script with its replies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transcript {
    /// The lines in order.
    pub lines: Vec<TranscriptLine>,
}

impl Transcript {
    /// The script with the replies below its lines as comments. Run again on the same world it gives the same text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        for line in &self.lines {
            text.push_str(&line.source);
            text.push('\n');
            for reply in line.reply.iter().flat_map(|reply| reply.told.lines()) {
                text.push_str(ANSWER);
                text.push(' ');
                text.push_str(&reply);
                text.push('\n');
            }
        }
        text
    }
}

impl Told {
    /// The reply for a person, line by line.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        match self {
            Self::Answers(answers) => answers.lines(),
            Self::Made { made, certainty } => {
                let doubt = doubt(certainty.answer(true));
                match made.is_empty() {
                    true => vec![format!("nothing{doubt}")],
                    false => made
                        .iter()
                        .map(|(name, is)| format!("{name}: {}{doubt}", is.text))
                        .collect(),
                }
            }
            Self::Deleted(count) => vec![format!("deleted {count}")],
            Self::Renamed => vec!["renamed".to_owned()],
            Self::Listed(all) => all
                .iter()
                .map(|(name, is)| format!("{name}: {}", is.text))
                .collect(),
        }
    }
}

/// What is said behind an answer that is not certain.
fn doubt(answer: Answer) -> String {
    match answer {
        Answer::Yes | Answer::No => String::new(),
        doubt => format!("  ({})", answer_text(doubt)),
    }
}

impl Answers {
    /// The answers for a person, line by line.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let mut lines: Vec<String> = self.rows.iter().map(|row| self.row(row)).collect();
        if self.names.is_empty() && self.rows.is_empty() {
            lines.push(answer_text(Answer::No).to_owned());
        }
        if !self.names.is_empty() {
            let doubtful = self.rows.iter().filter(|row| !row.holds.is_yes()).count();
            let count = match self.rows.len() {
                0 => "no answer".to_owned(),
                1 => "1 answer".to_owned(),
                count => format!("{count} answers"),
            };
            lines.push(match doubtful {
                0 => count,
                _ => format!("{count}, {doubtful} not certain"),
            });
        }
        if let Some(first) = &self.first_without_value {
            lines.push(format!(
                "without a value for {} of {} combinations; the first: {first}",
                self.without_value, self.tried
            ));
        }
        lines
    }

    fn row(&self, row: &Row) -> String {
        let found = self.names.iter().zip(&row.found);
        let mut parts: Vec<String> = found
            .map(|(name, is)| format!("?{name} = {}", is.text))
            .collect();
        parts.extend(row.values.iter().map(|value| format!("= {}", value.text)));
        if parts.is_empty() {
            return answer_text(row.holds).to_owned();
        }
        // Without free names the answer may be a plain no beside values.
        let refused = if row.holds.is_no() { "  (no)" } else { "" };
        format!("{}{}{refused}", parts.join(", "), doubt(row.holds))
    }
}

impl<S: Legible> From<Reading<S>> for Session<S> {
    fn from(reading: Reading<S>) -> Self {
        Self {
            world: reading.world,
            numbers: reading.numbers,
            values: BTreeMap::new(),
        }
    }
}

impl<S: Legible> Session<S> {
    /// A session about a world.
    #[must_use]
    pub fn new(world: World<S>) -> Self {
        Self {
            world,
            numbers: BTreeMap::new(),
            values: BTreeMap::new(),
        }
    }

    /// The world as it is now.
    #[must_use]
    pub fn world(&self) -> &World<S> {
        &self.world
    }

    /// Answers a question.
    ///
    /// # Errors
    /// Where the text is no question, names what there is not, or asks what has no meaning: the column, what was needed and
    /// what was found.
    pub fn ask(&self, question: &str) -> Result<Answers, TextError> {
        let mut tokens = tokens(question)?;
        tokens.retain(|token| token.kind != TokenKind::LineEnd);
        let query = query(question, &tokens, &self.numbers)?;
        solve(question, &query, &self.known())
    }

    /// Runs a script: lines that ask, `name = construction`, `delete name`, `delete name with parts`, `rename old new`, `list`.
    ///
    /// # Errors
    /// At the first line that cannot be run. What the lines before it changed stays.
    pub fn run(&mut self, script: &str) -> Result<Transcript, TextError> {
        let tokens = tokens(script)?;
        let mut rest = tokens.as_slice();
        let mut transcript = Transcript::default();
        for (number, line) in script.lines().enumerate() {
            let count = rest
                .iter()
                .take_while(|t| t.kind != TokenKind::LineEnd)
                .count();
            let (own, after) = rest.split_at(count);
            rest = after.get(1..).unwrap_or_default();
            if line.starts_with(ANSWER) {
                continue;
            }
            let reply = match own.is_empty() {
                true => None,
                false => {
                    let statement = statement(script, own, &self.numbers)?;
                    Some(Reply {
                        line: number + 1,
                        told: self.told(script, statement, own.first().map(|t| t.span.clone()))?,
                    })
                }
            };
            transcript.lines.push(TranscriptLine {
                source: line.to_owned(),
                reply,
            });
        }
        Ok(transcript)
    }

    fn known(&self) -> Known<'_, S> {
        Known {
            world: &self.world,
            values: &self.values,
            numbers: &self.numbers,
        }
    }

    fn told(
        &mut self,
        source: &str,
        statement: Statement,
        place: Option<Range<usize>>,
    ) -> Result<Told, TextError> {
        match statement {
            Statement::Ask(query) => solve(source, &query, &self.known()).map(Told::Answers),
            Statement::Define(name, place, term) => self.define(source, &name, place, &term),
            Statement::Delete(name, place, whole) => self.delete(source, &name, place, whole),
            Statement::Rename(old, place, new) => {
                self.check_number_name(source, &new, place.clone())?;
                let id = self.id(source, &old, place.clone())?;
                let renamed = self.world.rename(id, &new);
                renamed.map_err(|error| TextError::at(source, place, error.to_string()))?;
                Ok(Told::Renamed)
            }
            Statement::List => {
                let entities = self.world.iter().map(|(name, _, entity)| {
                    (
                        name.to_owned(),
                        Shown::of(&Value::<S>::made(entity.clone())),
                    )
                });
                let mut all: Vec<(String, Shown)> = entities.collect();
                for (name, value) in &self.values {
                    all.push((name.clone(), Shown::of(&Value::Number(value.clone()))));
                }
                for (name, number) in &self.numbers {
                    let value = S::from_number(number).map_err(|error| {
                        let place = place.clone().unwrap_or(0..0);
                        TextError::at(source, place, format!("`{name}`: {error}"))
                    })?;
                    all.push((name.clone(), Shown::of(&Value::Number(value))));
                }
                Ok(Told::Listed(all))
            }
        }
    }

    fn id(&self, source: &str, name: &str, place: Range<usize>) -> Result<Id, TextError> {
        let message = || format!("needed the name of an entity, found `{name}`");
        let found = self.world.find(name);
        found.ok_or_else(|| TextError::at(source, place, message()))
    }

    /// A name that no number has.
    fn check_number_name(
        &self,
        source: &str,
        name: &str,
        place: Range<usize>,
    ) -> Result<(), TextError> {
        match self.values.contains_key(name) || self.numbers.contains_key(name) {
            false => Ok(()),
            true => {
                let message =
                    format!("needed a name that nothing has, found that of the number `{name}`");
                Err(TextError::at(source, place, message))
            }
        }
    }

    fn delete(
        &mut self,
        source: &str,
        name: &str,
        place: Range<usize>,
        whole: bool,
    ) -> Result<Told, TextError> {
        if self.values.remove(name).is_some() || self.numbers.remove(name).is_some() {
            return Ok(Told::Deleted(1));
        }
        let id = self.id(source, name, place.clone())?;
        let deleted = match whole {
            true => self.world.delete_with_all_made_from_it(id),
            false => self.world.delete(id).map(|_| 1),
        };
        deleted.map(Told::Deleted).map_err(|error| {
            TextError::at(source, place, error.to_string())
                .help("`delete NAME with parts` deletes what was made from it too")
        })
    }

    /// Gives the value of a term a name; the members of a list get the names `name.1`, `name.2`, and so on.
    fn define(
        &mut self,
        source: &str,
        name: &str,
        place: Range<usize>,
        term: &Term,
    ) -> Result<Told, TextError> {
        let (value, certainty) = evaluate(source, term, &self.known())?;
        let members: Vec<(String, Value<'_, S>)> = match value {
            Value::List(members) => {
                let named = members.into_iter().zip(1..);
                named
                    .map(|(member, n)| (format!("{name}.{n}"), member))
                    .collect()
            }
            one => vec![(name.to_owned(), one)],
        };
        let mut owned = Vec::with_capacity(members.len());
        for (own, member) in members {
            let shown = match &member {
                Value::Entity(held) => Shown::of(&Value::<S>::made(held.entity().clone())),
                other => Shown::of(other),
            };
            owned.push((own, Owned::of(source, &member, &term.span)?, shown));
        }
        let mut others = Vec::new();
        self.named_in(term, &mut others);
        let mut made = Vec::with_capacity(owned.len());
        for (own, value, shown) in owned {
            self.check_number_name(source, &own, place.clone())?;
            match value {
                Owned::Entity(entity) => {
                    let stored = self.world.store_made_from(&own, *entity, &others);
                    stored.map_err(|e| TextError::at(source, place.clone(), e.to_string()))?;
                }
                Owned::Number(number) => {
                    if self.world.find(&own).is_some() {
                        let message = format!("needed a name that nothing has, found `{own}`");
                        return Err(TextError::at(source, place, message));
                    }
                    self.values.insert(own.clone(), number);
                }
            }
            made.push((own, shown));
        }
        Ok(Told::Made { made, certainty })
    }

    /// The entities that a term names.
    fn named_in(&self, term: &Term, found: &mut Vec<Id>) {
        let mut open = vec![term];
        while let Some(term) = open.pop() {
            match &term.what {
                What::Name(name) => found.extend(self.world.find(name)),
                What::List(terms) | What::Call(_, terms) => open.extend(terms),
                What::Free(_) | What::Number(_) => {}
            }
        }
        found.sort_unstable();
        found.dedup();
    }
}

/// A value that borrows nothing.
enum Owned<S> {
    Entity(Box<Entity<S>>),
    Number(S),
}

impl<S: Legible> Owned<S> {
    fn of(source: &str, value: &Value<'_, S>, span: &Range<usize>) -> Result<Self, TextError> {
        match value {
            Value::Entity(held) => Ok(Self::Entity(Box::new(held.entity().clone()))),
            Value::Number(number) => Ok(Self::Number(number.clone())),
            other => Err(TextError::needed(
                source,
                span.clone(),
                "an entity or a number for the name",
                other.sort(),
            )),
        }
    }
}
