//! How much exact algebra may do, counted in work and not in time.

use kutzbach_algebra::{Budget, Closings, Limits, MEMORY, entries_in};
use std::collections::BTreeMap;

/// Matrix entries that are eliminated in about a second (release build, one core of a machine of 2024).
const WORK_PER_SECOND: f64 = 5e6;

/// How long exact algebra may take for one part where nothing is said.
const SECONDS: f64 = 0.2;

/// The parts of a mechanism share so many times the budget of one.
const PARTS: u64 = 5;

/// How much work exact algebra may do and how much memory it may take, for each part of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExactBudget {
    work: u64,
    memory: u64,
}

impl Default for ExactBudget {
    /// About 0.2 s, 2 GB.
    fn default() -> Self {
        Self::seconds(SECONDS)
    }
}

impl ExactBudget {
    /// Exact algebra is not asked.
    #[must_use]
    pub fn none() -> Self {
        Self {
            work: 0,
            memory: MEMORY,
        }
    }

    /// About as much work as takes so many seconds, the same on every machine. No time, or none that is a number, is
    /// [`Self::none`].
    #[must_use]
    pub fn seconds(seconds: f64) -> Self {
        // Saturating; not a number becomes zero.
        Self {
            work: (seconds * WORK_PER_SECOND) as u64,
            memory: MEMORY,
        }
    }

    /// The same with other memory (bytes). What would not fit is not begun: everything is counted before it is expanded.
    #[must_use]
    pub fn within(self, memory: u64) -> Self {
        Self { memory, ..self }
    }

    /// Work, in matrix entries.
    #[must_use]
    pub fn work(self) -> u64 {
        self.work
    }
}

/// What the parts of one mechanism may still spend.
#[derive(Debug)]
pub struct ExactAllowance {
    /// For one part.
    pub(super) each: u64,
    /// Bytes.
    pub(super) memory: u64,
    /// For all that are still to come.
    pub(super) left: u64,
    /// What is known of the closings of parts, by their joints; `None` where it was asked for in vain.
    pub(super) closings: BTreeMap<Vec<usize>, Option<Closings>>,
    /// Whether a part was found to close, if anywhere, elsewhere than at the pose it was asked about.
    pub(crate) elsewhere: bool,
}

impl ExactAllowance {
    /// All of it.
    pub(crate) fn new(budget: ExactBudget) -> Self {
        Self {
            each: budget.work,
            memory: budget.memory,
            left: budget.work.saturating_mul(PARTS),
            closings: BTreeMap::new(),
            elsewhere: false,
        }
    }

    /// What one part may take of it.
    pub(super) fn of_a_part(&self) -> Budget {
        Budget::new(Limits {
            work: Some(self.each.min(self.left)),
            entries: Some(entries_in(self.memory)),
            ..Limits::default()
        })
    }

    /// Takes what a part has taken.
    pub(super) fn take(&mut self, used: &Budget) {
        self.left -= used.work().min(self.each.min(self.left));
    }
}
