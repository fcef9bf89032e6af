//! Work that is asked from outside to end before it is done.
//!
//! # The problem
//! An analysis of a large mechanism takes seconds to minutes, and goes through many engines. Whoever waits for it may want to end it
//! at any moment, and must then not be handed what only looks like an answer.
//!
//! # What holds
//! * A flag is set once and never taken back. Work looks at it where it counts its steps anyway: before every matrix that is made or
//!   decomposed, and wherever a budget is charged. It then ends by the ways it has for errors and for budgets that are used up.
//! * [`Interruption::during`] looks at the flag once more when the work is over. Work that saw it set anywhere, and made do without what
//!   it could not compute, is therefore never taken for done: the result is [`Interrupted`], whatever the work gave back.
//! * Where nobody interrupts, nothing depends on the flag: the same question has the same answer, bit by bit.
//!
//! # Cost
//! A look is a few nanoseconds. Flags are those of a thread: threads that the work starts look at none, unless they call
//! [`Interruption::during`] themselves.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use thiserror::Error;

thread_local! {
    /// What the work on this thread looks at; one for each [`Interruption::during`] that is under way.
    static WATCHED: RefCell<Vec<Interruption>> = const { RefCell::new(Vec::new()) };
}

/// The work was asked to end before it was done: there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("interrupted before there was an answer")]
pub struct Interrupted;

/// A flag by which work is asked to end. Clones are the same flag, and may be set from any thread.
///
/// ```
/// # mod kutzbach { pub use kutzbach_math::interruption; }
/// use kutzbach::interruption::{Interrupted, Interruption};
///
/// let interruption = Interruption::default();
/// assert_eq!(interruption.during(|| 1 + 1), Ok(2));
/// // Another thread, or a handler of signals, keeps a clone.
/// interruption.clone().interrupt();
/// assert_eq!(interruption.during(|| 1 + 1), Err(Interrupted));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Interruption(Arc<AtomicBool>);

impl Interruption {
    /// Asks the work to end. There is no way back: other work takes another flag.
    pub fn interrupt(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the work has been asked to end.
    #[must_use]
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// The flag itself, for limits that hold one. It may be set, but not be taken back.
    #[must_use]
    pub fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }

    /// Does the work on this thread, which looks at the flag on its way.
    ///
    /// Inside other work with a flag of its own both are looked at.
    ///
    /// # Errors
    /// [`Interrupted`] where the flag is set before the work begins, which it then does not, or before it is over. What the work
    /// gave back is dropped.
    pub fn during<T>(&self, work: impl FnOnce() -> T) -> Result<T, Interrupted> {
        let _watch = Watch::on(self);
        look()?;
        let done = work();
        look()?;
        Ok(done)
    }
}

/// Takes a flag off the list of its thread, also where the work panics.
struct Watch;

impl Watch {
    fn on(own: &Interruption) -> Self {
        WATCHED.with_borrow_mut(|watched| watched.push(own.clone()));
        Self
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        WATCHED.with_borrow_mut(Vec::pop);
    }
}

/// Whether the work on this thread has been asked to end; never outside [`Interruption::during`].
#[must_use]
pub fn asked() -> bool {
    WATCHED.with_borrow(|watched| watched.iter().any(Interruption::is_asked))
}

/// The same, to be passed on by `?`.
///
/// # Errors
/// [`Interrupted`] where the work has been asked to end.
pub fn look() -> Result<(), Interrupted> {
    match asked() {
        true => Err(Interrupted),
        false => Ok(()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::matrix::{MatrixError, SparseMatrix, decide};
    use std::panic::{AssertUnwindSafe, catch_unwind};

    #[test]
    fn what_the_work_made_do_with_is_no_answer() {
        let own = Interruption::default();
        let seen = own.during(|| {
            assert!(!asked());
            own.interrupt();
            assert_eq!(look(), Err(Interrupted));
            "an answer"
        });
        assert_eq!(seen, Err(Interrupted));
        // Work that begins after it looks at nothing.
        assert!(!asked());
        assert!(own.is_asked() && own.flag().load(Ordering::Relaxed));
    }

    #[test]
    fn no_work_begins_after_the_flag_is_set() {
        let own = Interruption::default();
        own.interrupt();
        let mut begun = false;
        assert_eq!(own.during(|| begun = true), Err(Interrupted));
        assert!(!begun);
    }

    #[test]
    fn work_inside_other_work_looks_at_both_flags() {
        let (outer, inner) = (Interruption::default(), Interruption::default());
        let seen = outer.during(|| {
            outer.interrupt();
            inner.during(|| ())
        });
        assert_eq!(seen, Err(Interrupted));
        assert!(!inner.is_asked());
        let (outer, inner) = (Interruption::default(), Interruption::default());
        let seen = outer.during(|| {
            inner.interrupt();
            // The inner flag does not concern what follows.
            (inner.during(|| ()), asked())
        });
        assert_eq!(seen, Ok((Err(Interrupted), false)));
    }

    #[test]
    fn a_panic_leaves_no_flag_behind() {
        let own = Interruption::default();
        let fault = catch_unwind(AssertUnwindSafe(|| {
            own.during(|| assert!(asked(), "as it is"))
        }));
        assert!(fault.is_err());
        own.interrupt();
        assert!(!asked());
    }

    #[test]
    fn other_threads_are_not_concerned() {
        let own = Interruption::default();
        let seen = own.during(|| {
            own.interrupt();
            std::thread::spawn(asked).join().unwrap()
        });
        assert_eq!(seen, Err(Interrupted));
        assert!(!std::thread::spawn(asked).join().unwrap());
    }

    #[test]
    fn matrices_are_neither_made_nor_decomposed() {
        let one = || SparseMatrix::from_triplets(1, 1, 0.0_f64, [(0, 0, 1.0)]);
        let made = one().unwrap();
        let own = Interruption::default();
        let mut seen = None;
        let done = own.during(|| {
            assert_eq!(decide(&made, 0.0).unwrap().rank, Some(1));
            own.interrupt();
            seen = Some((one().err(), decide(&made, 0.0).err()));
        });
        assert_eq!(done, Err(Interrupted));
        let interrupted = Some(MatrixError::Interrupted(Interrupted));
        assert_eq!(seen, Some((interrupted.clone(), interrupted)));
        assert_eq!(decide(&made, 0.0).unwrap().rank, Some(1));
    }
}
