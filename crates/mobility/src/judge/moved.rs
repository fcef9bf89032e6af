//! Makes an engine claim one freedom more or fewer than it does, on this thread.

use crate::claim::Bounds;
use crate::vocabulary::EngineName;
use std::cell::Cell;

thread_local! {
    static MOVED: Cell<Option<(EngineName, i8)>> = const { Cell::new(None) };
}

/// Runs something while an engine claims so many freedoms more.
pub fn with_moved<T>(engine: EngineName, by: i8, run: impl FnOnce() -> T) -> T {
    MOVED.set(Some((engine, by)));
    let done = run();
    MOVED.set(None);
    done
}

/// Bounds of a claim, moved where they are to be. What says nothing says nothing still.
pub fn moved(engine: EngineName, bounds: Bounds) -> Bounds {
    match MOVED.get() {
        Some((wrong, by)) if wrong == engine && bounds != Bounds::ANY => Bounds {
            lower: bounds.lower.saturating_add_signed(by.into()),
            upper: bounds
                .upper
                .map(|upper| upper.saturating_add_signed(by.into())),
        },
        _ => bounds,
    }
}
