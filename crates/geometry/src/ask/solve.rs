//! Answers to questions: candidates for free names, goal by goal.
//!
//! Goals are taken in the order in which they are written, negations after all others. What is known after each goal is a table of
//! candidates; a goal fills the free names in it that are still empty with every entity of the world, and keeps the rows for
//! which it may hold.

use super::evaluate::not;
use super::show::Shown;
use super::term::{Comparison, Goal, Query, Term, What};
use super::value::{Held, Value};
use crate::decide::{Answer, Certainty};
use crate::entity::Entity;
use crate::text::{Legible, TextError};
use crate::world::World;
use kutzbach_math::number::Number;
use std::collections::BTreeMap;

/// So many combinations are looked at for one question.
const MOST_TRIED: usize = 4_000_000;
/// So many rows a table may have.
const MOST_ROWS: usize = 200_000;

/// One answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What the free names stand for, in the order of [`Answers::names`].
    pub found: Vec<Shown>,
    /// The values of goals that are no statements, such as a distance, in their order.
    pub values: Vec<Shown>,
    /// Whether it holds; never *no* where there are free names.
    pub holds: Answer,
}

/// The answers to a question.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    /// The free names outside of negations, without question marks.
    pub names: Vec<String>,
    /// The answers. Of a question without free names one, which may be *no*.
    pub rows: Vec<Row>,
    /// How many combinations were looked at.
    pub tried: usize,
    /// For how many of them a function had no value, for example since it has no meaning for such entities.
    pub without_value: usize,
    /// What the first of those said.
    pub first_without_value: Option<String>,
}

/// What a name may stand for.
pub(super) struct Known<'w, S> {
    pub(super) world: &'w World<S>,
    pub(super) values: &'w BTreeMap<String, S>,
    pub(super) numbers: &'w BTreeMap<String, Number>,
}

/// A row while it is made.
#[derive(Clone)]
struct Partial<'w, S> {
    bound: Vec<Option<Value<'w, S>>>,
    values: Vec<Shown>,
    holds: Answer,
}

/// Why a term has no value.
pub(super) enum Trouble {
    /// For these entities.
    NoValue(TextError),
    /// For none: the question is wrong.
    Wrong(TextError),
}

/// What a goal came to for one row.
struct Reached<'w, S> {
    holds: Answer,
    shown: Option<Shown>,
    /// A free name that became known, with what it may stand for.
    binds: Option<(usize, Vec<Value<'w, S>>)>,
}

type Table<'w, S> = Vec<Partial<'w, S>>;

pub(super) struct Solver<'q, 'w, S> {
    pub(super) source: &'q str,
    pub(super) known: &'q Known<'w, S>,
    candidates: Vec<(&'w str, &'w Entity<S>)>,
    tried: usize,
    without_value: usize,
    first_without_value: Option<String>,
}

/// Answers a question.
pub(super) fn solve<S: Legible>(
    source: &str,
    query: &Query,
    known: &Known<'_, S>,
) -> Result<Answers, TextError> {
    let candidates = known.world.iter().map(|(name, _, entity)| (name, entity));
    let mut solver = Solver {
        source,
        known,
        candidates: candidates.collect(),
        tried: 0,
        without_value: 0,
        first_without_value: None,
    };
    let start = Partial {
        bound: vec![None; query.free.len()],
        values: Vec::new(),
        holds: Answer::Yes,
    };
    let is_free = !query.free.is_empty();
    let mut table = solver.goals(&query.goals, vec![start], is_free)?;
    let mut outside = Vec::new();
    for goal in query.goals.iter().filter(|goal| !is_negation(goal)) {
        outside.extend(goal.free_names());
    }
    outside.sort_unstable();
    outside.dedup();
    if is_free {
        table.retain(|row| !row.holds.is_no());
    }
    let rows = table.into_iter().map(|partial| {
        let shown = |number: &usize| partial.bound.get(*number)?.as_ref().map(Shown::of);
        Row {
            found: outside.iter().filter_map(shown).collect(),
            values: partial.values,
            holds: partial.holds,
        }
    });
    Ok(Answers {
        rows: rows.collect(),
        names: outside
            .iter()
            .filter_map(|number| query.free.get(*number).cloned())
            .collect(),
        tried: solver.tried,
        without_value: solver.without_value,
        first_without_value: solver.first_without_value,
    })
}

/// The value of a term without free names.
pub(super) fn evaluate<'w, S: Legible>(
    source: &str,
    term: &Term,
    known: &Known<'w, S>,
) -> Result<(Value<'w, S>, Certainty), TextError> {
    let solver = Solver {
        source,
        known,
        candidates: Vec::new(),
        tried: 0,
        without_value: 0,
        first_without_value: None,
    };
    solver.value(term, &[]).map_err(|trouble| match trouble {
        Trouble::NoValue(error) | Trouble::Wrong(error) => error,
    })
}

fn is_negation(goal: &Goal) -> bool {
    matches!(goal, Goal::Not(_))
}

impl<'w, S: Legible> Solver<'_, 'w, S> {
    /// The rows of a table for which all goals may hold; of a question without free names the row stays, with its answer.
    fn goals(
        &mut self,
        goals: &[Goal],
        mut table: Table<'w, S>,
        is_free: bool,
    ) -> Result<Table<'w, S>, TextError> {
        let positive = goals.iter().filter(|goal| !is_negation(goal));
        let negative = goals.iter().filter(|goal| is_negation(goal));
        for goal in positive.chain(negative) {
            let mut next = Vec::new();
            for row in table {
                match goal {
                    Goal::Not(inner) => self.negation(inner, row, is_free, &mut next)?,
                    _ => self.goal(goal, &row, is_free, &mut next)?,
                }
                if next.len() > MOST_ROWS {
                    return Err(self.too_many("answers", MOST_ROWS));
                }
            }
            table = next;
        }
        Ok(table)
    }

    fn too_many(&self, what: &str, most: usize) -> TextError {
        let message =
            format!("needed a question with at most {most} {what} on its way, found more");
        TextError::at(self.source, 0..self.source.len(), message)
            .help("narrow free names first, for example by `is(?f, face)` or `part(?f, plate)`")
    }

    fn negation(
        &mut self,
        goals: &[Goal],
        mut row: Partial<'w, S>,
        is_free: bool,
        next: &mut Table<'w, S>,
    ) -> Result<(), TextError> {
        let local = goals.iter().any(|goal| {
            let names = goal.free_names();
            names
                .iter()
                .any(|n| matches!(row.bound.get(*n), Some(None)))
        });
        let without_value = self.without_value;
        let inner = Partial {
            bound: row.bound.clone(),
            values: Vec::new(),
            holds: Answer::Yes,
        };
        let found = self.goals(goals, vec![inner], is_free)?;
        // Where a function has no meaning for what is known, neither it nor its opposite holds.
        if !local && found.is_empty() && self.without_value > without_value {
            return Ok(());
        }
        let any = found.iter().map(|r| r.holds).fold(Answer::No, Answer::or);
        row.holds = row.holds.and(not(any));
        if !(is_free && row.holds.is_no()) {
            next.push(row);
        }
        Ok(())
    }

    /// Adds the rows that a goal makes of one.
    fn goal(
        &mut self,
        goal: &Goal,
        row: &Partial<'w, S>,
        is_free: bool,
        next: &mut Table<'w, S>,
    ) -> Result<(), TextError> {
        let target = binding(goal, &row.bound);
        let names = goal.free_names();
        let has_names = !names.is_empty();
        let open: Vec<usize> = names
            .into_iter()
            .filter(|n| matches!(row.bound.get(*n), Some(None)))
            .filter(|n| target != Some(*n))
            .collect();
        let mut choice = vec![0; open.len()];
        if !open.is_empty() && self.candidates.is_empty() {
            return Ok(());
        }
        loop {
            self.tried += 1;
            if self.tried > MOST_TRIED {
                return Err(self.too_many("combinations", MOST_TRIED));
            }
            let mut bound = row.bound.clone();
            for (name, pick) in open.iter().zip(&choice) {
                let candidate = self.candidates.get(*pick).copied();
                if let (Some(slot), Some((name, entity))) = (bound.get_mut(*name), candidate) {
                    *slot = Some(Value::Entity(Held::Known(name, entity)));
                }
            }
            match self.reached(goal, &bound, target) {
                Ok(reached) => add(row, bound, reached, is_free, next),
                Err(Trouble::NoValue(error)) if has_names => {
                    self.without_value += 1;
                    self.first_without_value.get_or_insert(error.message);
                }
                Err(Trouble::NoValue(error) | Trouble::Wrong(error)) => return Err(error),
            }
            if next.len() > MOST_ROWS {
                return Err(self.too_many("answers", MOST_ROWS));
            }
            if !advance(&mut choice, self.candidates.len()) {
                return Ok(());
            }
        }
    }

    /// What a goal comes to where everything but the target is known.
    fn reached(
        &self,
        goal: &Goal,
        bound: &[Option<Value<'w, S>>],
        target: Option<usize>,
    ) -> Result<Reached<'w, S>, Trouble> {
        let plain = |holds: Answer, shown: Option<Shown>| Reached {
            holds,
            shown,
            binds: None,
        };
        match goal {
            Goal::Holds(term) => match self.value(term, bound)? {
                (Value::Truth(answer), _) => Ok(plain(answer, None)),
                (value, certainty) => {
                    let shown = match &value {
                        // By itself an entity is told with its numbers.
                        Value::Entity(held) if matches!(term.what, What::Name(_)) => {
                            Shown::of(&Value::<S>::made(held.entity().clone()))
                        }
                        other => Shown::of(other),
                    };
                    Ok(plain(certainty.answer(true), Some(shown)))
                }
            },
            Goal::Compare(first, comparison, second) => {
                if let Some(target) = target {
                    let is_first = matches!(first.what, What::Free(n) if n == target);
                    let given = if is_first { second } else { first };
                    let (value, certainty) = self.value(given, bound)?;
                    let members = match value {
                        Value::List(members) => members,
                        one => vec![one],
                    };
                    return Ok(Reached {
                        binds: Some((target, members)),
                        ..plain(certainty.answer(true), None)
                    });
                }
                let answer = self.compare(first, *comparison, second, bound)?;
                Ok(plain(answer, None))
            }
            // Seen to elsewhere.
            Goal::Not(_) => Ok(plain(Answer::Yes, None)),
        }
    }
}

/// The free name that a goal gives a value: one side of `=`, which is still empty and not inside of the other side.
fn binding<S>(goal: &Goal, bound: &[Option<Value<'_, S>>]) -> Option<usize> {
    let Goal::Compare(first, Comparison::Equal, second) = goal else {
        return None;
    };
    let sides = [(first, second), (second, first)];
    sides.into_iter().find_map(|(side, other)| {
        let What::Free(number) = side.what else {
            return None;
        };
        let mut inside = Vec::new();
        other.free_names(&mut inside);
        let is_empty = matches!(bound.get(number), Some(None));
        (is_empty && !inside.contains(&number)).then_some(number)
    })
}

/// The next combination; none after the last.
fn advance(choice: &mut [usize], count: usize) -> bool {
    for pick in choice.iter_mut().rev() {
        *pick += 1;
        if *pick < count {
            return true;
        }
        *pick = 0;
    }
    false
}

/// Adds what a goal made of a row.
fn add<'w, S: Clone>(
    row: &Partial<'w, S>,
    bound: Vec<Option<Value<'w, S>>>,
    reached: Reached<'w, S>,
    is_free: bool,
    next: &mut Table<'w, S>,
) {
    let holds = row.holds.and(reached.holds);
    if is_free && holds.is_no() {
        return;
    }
    let mut values = row.values.clone();
    values.extend(reached.shown);
    let Some((target, members)) = reached.binds else {
        next.push(Partial {
            bound,
            values,
            holds,
        });
        return;
    };
    for member in members {
        let mut own = bound.clone();
        if let Some(slot) = own.get_mut(target) {
            *slot = Some(member);
        }
        next.push(Partial {
            bound: own,
            values: values.clone(),
            holds,
        });
    }
}
