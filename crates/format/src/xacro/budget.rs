//! What an expansion may cost.

use super::arithmetic::LONGEST_TEXT;
use super::text::Text;
use super::value::Value;
use super::{Outcome, Run, Trouble};

/// Elements, operations, items of lists that are walked, pairs of values that are compared and 64 bytes of text count as one
/// step, calls of macros and files as ten; a large robot takes a hundred thousand.
const MOST_STEPS: u64 = 1_000_000;
/// Elements, macros, expressions and lists inside each other: more than Python's own limit of 1000 calls lets xacro do. Names
/// are looked for level by level, so that depth costs time as well.
const DEEPEST: usize = 600;

#[derive(Debug, Default)]
pub(super) struct Budget {
    steps: u64,
    depth: usize,
}

impl Budget {
    pub(super) fn spend(&mut self, steps: usize) -> Outcome<()> {
        self.steps = self.steps.saturating_add(steps as u64);
        if self.steps > MOST_STEPS {
            return Err(Trouble::new(format!(
                "expanding the file takes more than {MOST_STEPS} steps"
            ))
            .help("does a macro call itself without end?"));
        }
        Ok(())
    }

    /// Counts what handling a value costs, without what is inside its items.
    pub(super) fn spend_on(&mut self, value: &Value) -> Outcome<()> {
        let size = match value {
            Value::Text(text) => text.as_str().len() / 64 + text.marks().len(),
            Value::List(items) | Value::Tuple(items) => items.len(),
            Value::Set(items) => items.len(),
            Value::Dict(items) => items.len(),
            _ => 0,
        };
        self.spend(size)
    }

    /// A value as text that is not endless.
    pub(super) fn text(&mut self, value: &Value) -> Outcome<Text> {
        self.written(value.to_text(LONGEST_TEXT))
    }

    /// A value as Python's `repr` writes it.
    pub(super) fn repr(&mut self, value: &Value) -> Outcome<Text> {
        self.written(value.repr(LONGEST_TEXT))
    }

    fn written(&mut self, text: Option<Text>) -> Outcome<Text> {
        let text = text.ok_or_else(|| Trouble::new("the text of the value is too long"))?;
        self.spend(text.as_str().len() / 64 + text.marks().len())?;
        Ok(text)
    }

    fn enter(&mut self) -> Outcome<()> {
        if self.depth >= DEEPEST {
            return Err(Trouble::new(format!(
                "macros, expressions or lists are nested more than {DEEPEST} levels deep"
            ))
            .help("does a macro call itself without end?"));
        }
        self.depth += 1;
        Ok(())
    }

    /// Does something one level deeper.
    pub(super) fn deeper<T>(&mut self, work: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        self.enter()?;
        let result = work(self);
        self.depth -= 1;
        result
    }
}

impl Run<'_> {
    pub(super) fn spend(&mut self, steps: usize) -> Outcome<()> {
        self.budget.spend(steps)
    }

    pub(super) fn spend_on(&mut self, value: &Value) -> Outcome<()> {
        self.budget.spend_on(value)
    }

    /// Does something one level deeper.
    pub(super) fn deeper<T>(&mut self, work: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        self.budget.enter()?;
        let result = work(self);
        self.budget.depth -= 1;
        result
    }

    /// A value as text, paid for.
    pub(super) fn paid_text(&mut self, value: &Value) -> Outcome<Text> {
        self.budget.text(value)
    }
}
