//! How long a computation may go on.

use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use thiserror::Error;

/// Limits of a computation; `None` is no limit.
#[derive(Clone, Debug, Default)]
pub struct Limits {
    /// Wall time. Whether a computation ends within it depends on the machine.
    pub time: Option<Duration>,
    /// Work, in entries of the matrices that are eliminated; the same on every machine.
    pub work: Option<u64>,
    /// Entries of the largest matrix: what bounds the memory.
    pub entries: Option<u64>,
    /// Set from outside (another thread, a signal) to stop.
    pub cancelled: Option<Arc<AtomicBool>>,
}

/// Why a computation has no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Stop {
    /// The time was over.
    #[error("the time limit was reached")]
    Time,
    /// The work was used up.
    #[error("the work limit was reached")]
    Work,
    /// A matrix would have been too large.
    #[error("the memory limit was reached")]
    Memory,
    /// Somebody asked to stop.
    #[error("the computation was interrupted")]
    Cancelled,
    /// The rational numbers of the answer could not be found from their remainders.
    #[error("the coefficients of the answer are too large")]
    Coefficients,
}

/// Limits and what has been used of them. One budget serves all steps of a question.
#[derive(Clone, Debug)]
pub struct Budget {
    limits: Limits,
    started: Instant,
    work: Cell<u64>,
}

impl Budget {
    /// Starts the clock.
    #[must_use]
    pub fn new(limits: Limits) -> Self {
        Self {
            limits,
            started: Instant::now(),
            work: Cell::new(0),
        }
    }

    /// No limit at all.
    #[must_use]
    pub fn unlimited() -> Self {
        Self::new(Limits::default())
    }

    /// Work done so far, in matrix entries.
    #[must_use]
    pub fn work(&self) -> u64 {
        self.work.get()
    }

    /// Whether to go on.
    ///
    /// # Errors
    /// [`Stop`] with the first limit that was reached.
    pub fn check(&self) -> Result<(), Stop> {
        self.spend(0)
    }

    /// Adds work, then tells whether to go on.
    ///
    /// # Errors
    /// [`Stop`] with the first limit that was reached.
    pub fn spend(&self, work: u64) -> Result<(), Stop> {
        self.work.set(self.work.get().saturating_add(work));
        let limits = &self.limits;
        if limits
            .cancelled
            .as_ref()
            .is_some_and(|flag| flag.load(Ordering::Relaxed))
        {
            return Err(Stop::Cancelled);
        }
        if limits.work.is_some_and(|most| self.work.get() > most) {
            return Err(Stop::Work);
        }
        if limits
            .time
            .is_some_and(|most| self.started.elapsed() > most)
        {
            return Err(Stop::Time);
        }
        Ok(())
    }

    /// Takes over the work done on a copy of this budget.
    pub(super) fn take_over(&self, copy: &Self) {
        self.work.set(copy.work.get());
    }

    /// Adds the work of eliminating a matrix with this many entries, then tells whether to do it.
    ///
    /// # Errors
    /// [`Stop`] with the first limit that was reached.
    pub fn spend_matrix(&self, entries: u64) -> Result<(), Stop> {
        if self.limits.entries.is_some_and(|most| entries > most) {
            return Err(Stop::Memory);
        }
        self.spend(entries)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_limit_has_its_own_outcome() {
        let work = Budget::new(Limits {
            work: Some(10),
            ..Limits::default()
        });
        assert_eq!(work.spend(10), Ok(()));
        assert_eq!(work.spend(1), Err(Stop::Work));
        let entries = Budget::new(Limits {
            entries: Some(10),
            ..Limits::default()
        });
        assert_eq!(entries.spend_matrix(11), Err(Stop::Memory));
        let time = Budget::new(Limits {
            time: Some(Duration::ZERO),
            ..Limits::default()
        });
        std::thread::sleep(Duration::from_millis(1));
        assert_eq!(time.check(), Err(Stop::Time));
        let flag = Arc::new(AtomicBool::new(false));
        let stopped = Budget::new(Limits {
            cancelled: Some(Arc::clone(&flag)),
            ..Limits::default()
        });
        assert_eq!(stopped.check(), Ok(()));
        flag.store(true, Ordering::Relaxed);
        assert_eq!(stopped.check(), Err(Stop::Cancelled));
    }
}
