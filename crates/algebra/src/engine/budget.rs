//! How long a computation may go on.

use kutzbach_math::interruption;
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use thiserror::Error;

/// Limits of a computation; `None` is no limit.
///
/// None of them reads a clock: the same question ends at the same place on every machine, whatever else the machine does.
#[derive(Clone, Debug, Default)]
pub struct Limits {
    /// Effort, in steps that take about a nanosecond: see [`Limits::seconds`].
    pub effort: Option<u64>,
    /// Work, in entries of the matrices that are eliminated; the same on every machine.
    pub work: Option<u64>,
    /// Entries of the largest matrix: what bounds the memory.
    pub entries: Option<u64>,
    /// Set from outside (another thread, a signal) to stop, and to be told what is known by then. Work that is to end without any answer
    /// is done [during an interruption](kutzbach_math::interruption::Interruption::during).
    pub cancelled: Option<Arc<AtomicBool>>,
    /// Where the computation says how far it is.
    pub progress: Option<Arc<Progress>>,
}

/// Memory where none is stated (bytes).
pub const MEMORY: u64 = 2_000_000_000;

/// An entry of a matrix takes about ten bytes; as much again is left to what stands beside the largest matrix.
const BYTES_PER_ENTRY: u64 = 20;

/// Entries that a matrix may have in so much memory (bytes).
#[must_use]
pub fn entries_in(memory: u64) -> u64 {
    memory / BYTES_PER_ENTRY
}

/// Effort that stands for a second. What counts effort states for each kind of step how many nanoseconds it took on one core of a
/// machine of 2024, release build, so that a second of that core is 10⁹; other machines take longer or shorter over the same effort.
const EFFORT_PER_SECOND: f64 = 1e9;

/// Effort of one unit of [`Budget::spend`]: an entry of a matrix that is filled, or a number of some words that is put in its place.
const EFFORT_OF_WORK: u64 = 20;

/// Effort of one unit of [`Budget::multiply`].
const EFFORT_OF_PRODUCT: u64 = 4;

impl Limits {
    /// The effort that stands for so many seconds, and two gigabytes. A time that is negative or no number is none at all; one that is
    /// infinite is no limit.
    #[must_use]
    pub fn seconds(seconds: f64) -> Self {
        // Saturating; not a number becomes zero.
        let effort = (seconds * EFFORT_PER_SECOND) as u64;
        Self {
            effort: (seconds != f64::INFINITY).then_some(effort),
            entries: Some(entries_in(MEMORY)),
            ..Self::default()
        }
    }
}

/// How far a computation is, to be read from another thread.
#[derive(Debug, Default)]
pub struct Progress {
    work: AtomicU64,
    phase: Mutex<String>,
}

impl Progress {
    /// Work done so far, in matrix entries.
    #[must_use]
    pub fn work(&self) -> u64 {
        self.work.load(Ordering::Relaxed)
    }

    /// What is being done, in a few words.
    #[must_use]
    pub fn phase(&self) -> String {
        self.phase
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }
}

/// Why a computation has no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Stop {
    /// The effort that a time stands for was used up.
    #[error("the time limit was reached")]
    Time,
    /// The work was used up.
    #[error("the work limit was reached")]
    Work,
    /// A matrix would have been too large, or an exponent above 65535.
    #[error("the memory limit was reached")]
    Memory,
    /// Somebody asked to stop.
    #[error("the computation was interrupted")]
    Cancelled,
    /// The rational numbers of the answer could not be found from their remainders.
    #[error("the coefficients of the answer are too large")]
    Coefficients,
    /// The number to compute modulo is no prime.
    #[error("the modulus is no prime number")]
    Modulus,
}

/// Limits and what has been used of them. One budget serves all steps of a question.
#[derive(Clone, Debug)]
pub struct Budget {
    limits: Limits,
    /// Shared with all copies and parts.
    effort: Arc<AtomicU64>,
    work: Cell<u64>,
}

impl Budget {
    /// Nothing is used yet.
    #[must_use]
    pub fn new(limits: Limits) -> Self {
        Self {
            limits,
            effort: Arc::default(),
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

    /// What was allowed at the start.
    #[must_use]
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// The effort that is left; `None` where there is no limit.
    #[must_use]
    pub fn left(&self) -> Option<u64> {
        let used = self.effort.load(Ordering::Relaxed);
        self.limits.effort.map(|most| most.saturating_sub(used))
    }

    /// Whether to go on.
    ///
    /// # Errors
    /// [`Stop`] with the first limit that was reached.
    pub fn check(&self) -> Result<(), Stop> {
        self.toil(0)
    }

    /// Adds work, then tells whether to go on.
    ///
    /// # Errors
    /// [`Stop`] with the first limit that was reached.
    pub fn spend(&self, work: u64) -> Result<(), Stop> {
        self.work.set(self.work.get().saturating_add(work));
        self.toil(work.saturating_mul(EFFORT_OF_WORK))
    }

    /// Adds as much work as products of words, or of remainders, in long rows, then tells whether to go on.
    ///
    /// # Errors
    /// [`Stop`] with the first limit that was reached.
    pub(crate) fn multiply(&self, products: u64) -> Result<(), Stop> {
        self.work.set(self.work.get().saturating_add(products));
        self.toil(products.saturating_mul(EFFORT_OF_PRODUCT))
    }

    /// Adds effort that is no work, in nanoseconds that it takes about, then tells whether to go on.
    ///
    /// # Errors
    /// [`Stop`] with the first limit that was reached.
    pub fn toil(&self, effort: u64) -> Result<(), Stop> {
        // Copies of a budget are not used at once: no sum is lost.
        let used = self.effort.load(Ordering::Relaxed).saturating_add(effort);
        self.effort.store(used, Ordering::Relaxed);
        let limits = &self.limits;
        if let Some(progress) = &limits.progress {
            progress.work.store(self.work.get(), Ordering::Relaxed);
        }
        let cancelled = limits.cancelled.as_ref();
        if interruption::asked() || cancelled.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Err(Stop::Cancelled);
        }
        if limits.work.is_some_and(|most| self.work.get() > most) {
            return Err(Stop::Work);
        }
        if limits.effort.is_some_and(|most| used > most) {
            return Err(Stop::Time);
        }
        Ok(())
    }

    /// A copy with at most so much further work.
    pub(crate) fn with_work(&self, work: u64) -> Self {
        let mut copy = self.clone();
        let most = self.work.get().saturating_add(work);
        copy.limits.work = Some(copy.limits.work.map_or(most, |limit| limit.min(most)));
        copy
    }

    /// A copy with at most a share of the effort that is left.
    pub(crate) fn with_share(&self, share: f64) -> Self {
        let mut copy = self.clone();
        let used = self.effort.load(Ordering::Relaxed);
        let shared = |left: u64| used.saturating_add((left as f64 * share) as u64);
        copy.limits.effort = self.left().map(shared);
        copy
    }

    /// A budget with at most a share of the effort that is left, which what it uses is taken from, and with work of its own.
    #[must_use]
    pub fn part(&self, share: f64, work: Option<u64>) -> Self {
        let mut part = self.with_share(share);
        part.limits.work = work;
        part.work = Cell::new(0);
        part
    }

    /// With at most so much of the effort that is left.
    #[must_use]
    pub fn at_most(mut self, effort: u64) -> Self {
        let most = self.effort.load(Ordering::Relaxed).saturating_add(effort);
        let limit = self.limits.effort.map_or(most, |limit| limit.min(most));
        self.limits.effort = Some(limit);
        self
    }

    /// Takes over the work done on a copy of this budget.
    pub(crate) fn take_over(&self, copy: &Self) {
        self.work.set(copy.work.get());
    }

    /// Says what is being done, where somebody listens.
    pub fn phase(&self, text: impl FnOnce() -> String) {
        if let Some(progress) = &self.limits.progress {
            *progress
                .phase
                .lock()
                .unwrap_or_else(PoisonError::into_inner) = text();
        }
    }

    /// Whether a matrix may have this many entries, without counting them yet.
    pub(super) fn check_entries(&self, entries: u64) -> Result<(), Stop> {
        match self.limits.entries {
            Some(most) if entries > most => return Err(Stop::Memory),
            _ => {}
        }
        match self.limits.work {
            Some(most) if self.work.get().saturating_add(entries) > most => Err(Stop::Work),
            _ => Ok(()),
        }
    }

    /// Adds the work of eliminating a matrix with this many entries, then tells whether to do it.
    ///
    /// # Errors
    /// [`Stop`] with the first limit that was reached.
    pub fn spend_matrix(&self, entries: u64) -> Result<(), Stop> {
        self.check_entries(entries)?;
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
        let effort = Budget::new(Limits {
            effort: Some(10),
            ..Limits::default()
        });
        assert_eq!(effort.toil(10), Ok(()));
        assert_eq!(effort.toil(1), Err(Stop::Time));
        let flag = Arc::new(AtomicBool::new(false));
        let stopped = Budget::new(Limits {
            cancelled: Some(Arc::clone(&flag)),
            ..Limits::default()
        });
        assert_eq!(stopped.check(), Ok(()));
        flag.store(true, Ordering::Relaxed);
        assert_eq!(stopped.check(), Err(Stop::Cancelled));
        let own = interruption::Interruption::default();
        let mut seen = Vec::new();
        let done = own.during(|| {
            seen.push(Budget::unlimited().check());
            own.interrupt();
            seen.push(Budget::unlimited().check());
        });
        assert_eq!(done, Err(interruption::Interrupted));
        assert_eq!(seen, [Ok(()), Err(Stop::Cancelled)]);
    }

    #[test]
    fn seconds_that_are_none_leave_no_time() {
        assert_eq!(Limits::seconds(f64::NAN).effort, Some(0));
        assert_eq!(Limits::seconds(-1.0).effort, Some(0));
        assert_eq!(Limits::seconds(1.5).effort, Some(1_500_000_000));
        assert_eq!(Limits::seconds(f64::INFINITY).effort, None);
    }

    #[test]
    fn what_a_part_uses_is_taken_from_the_whole() {
        let whole = Budget::new(Limits {
            effort: Some(100),
            ..Limits::default()
        });
        let part = whole.part(0.5, Some(3));
        assert_eq!(part.toil(50), Ok(()));
        assert_eq!((part.left(), whole.left()), (Some(0), Some(50)));
        assert_eq!(part.toil(1), Err(Stop::Time));
        assert_eq!(whole.part(1.0, Some(3)).spend(4), Err(Stop::Work));
        assert_eq!((whole.work(), whole.check()), (0, Err(Stop::Time)));
    }

    #[test]
    fn progress_is_seen_from_outside() {
        let progress = Arc::new(Progress::default());
        let budget = Budget::new(Limits {
            progress: Some(Arc::clone(&progress)),
            ..Limits::default()
        });
        assert_eq!(budget.spend(7), Ok(()));
        budget.phase(|| "thinking".to_owned());
        assert_eq!(
            (progress.work(), progress.phase()),
            (7, "thinking".to_owned())
        );
    }
}
