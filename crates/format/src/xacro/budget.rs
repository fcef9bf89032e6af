//! What an expansion may cost.

use super::evaluate::text_of;
use super::text::Text;
use super::value::Value;
use super::{Outcome, Run, Trouble};

/// Elements, operations and 64 bytes of text count as one step, calls of macros and files as ten; a large robot takes a hundred
/// thousand.
const MOST_STEPS: u64 = 1_000_000;
/// Elements, macros and expressions inside each other: more than Python's own limit of 1000 calls lets xacro do. Names are
/// looked for level by level, so that depth costs time as well.
const DEEPEST: usize = 600;
/// Bytes of the expanded text, as of any file.
pub(super) const MOST_BYTES: usize = crate::guard::MOST_BYTES;

#[derive(Debug, Default)]
pub(super) struct Budget {
    steps: u64,
    depth: usize,
}

impl Run<'_> {
    pub(super) fn spend(&mut self, steps: usize) -> Outcome<()> {
        self.budget.steps = self.budget.steps.saturating_add(steps as u64);
        if self.budget.steps > MOST_STEPS {
            return Err(Trouble::new(format!(
                "expanding the file takes more than {MOST_STEPS} steps"
            ))
            .help("does a macro call itself without end?"));
        }
        Ok(())
    }

    /// Counts what handling a value costs.
    pub(super) fn spend_on(&mut self, value: &Value) -> Outcome<()> {
        let size = match value {
            Value::Text(text) => text.as_str().len() / 64 + text.marks().len(),
            Value::List(items) | Value::Tuple(items) => items.len(),
            Value::Dict(items) => items.len(),
            _ => 0,
        };
        self.spend(size)
    }

    /// Does something one level deeper.
    pub(super) fn deeper<T>(&mut self, work: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        if self.budget.depth >= DEEPEST {
            return Err(Trouble::new(format!(
                "macros and expressions are nested more than {DEEPEST} levels deep"
            ))
            .help("does a macro call itself without end?"));
        }
        self.budget.depth += 1;
        let result = work(self);
        self.budget.depth -= 1;
        result
    }

    /// A value as text, paid for.
    pub(super) fn paid_text(&mut self, value: &Value) -> Outcome<Text> {
        let text = text_of(value)?;
        self.spend(text.as_str().len() / 64)?;
        Ok(text)
    }
}
