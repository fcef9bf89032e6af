//! How much memory reading may fill, which says how large files may be.
//!
//! # Why a scope, and not an argument
//! Files include others, archives hold texts, copies are written out: how much there is becomes known far below where reading begins, in
//! every format. The limit is that of the reading that is under way on this thread; a thread that reads by itself begins its own.

use std::cell::Cell;

/// Bytes of memory where nothing else is said.
pub const MEMORY: u64 = 2_000_000_000;

/// Bytes of memory for a byte of text: measured at a chain of 60,000 hinges, 11 MB, which takes 227 MB to be read and written again.
pub(super) const PER_BYTE: u64 = 20;

thread_local! {
    static LIMIT: Cell<u64> = const { Cell::new(MEMORY) };
}

/// Puts the limit back, also where reading panics.
struct Before(u64);

impl Drop for Before {
    fn drop(&mut self) {
        LIMIT.set(self.0);
    }
}

/// Reads within so much memory (bytes) on this thread: a file that would take more is refused before it is read. Twenty bytes of memory are
/// reckoned for a byte of text, so that files of 100 MB are read where nothing else is said (2 GB).
///
/// ```
/// # mod kutzbach { pub use kutzbach_format as format; }
/// use kutzbach::format::{read, within_memory};
///
/// let text = r#"<robot name="r"><link name="a"/></robot>"#;
/// let refused = within_memory(500, || read(text, "r.urdf", &[])).unwrap_err();
/// assert!(refused.help.is_some_and(|help| help.contains("--memory")));
/// assert!(within_memory(2000, || read(text, "r.urdf", &[])).is_ok());
/// ```
pub fn within_memory<T>(memory: u64, read: impl FnOnce() -> T) -> T {
    let _before = Before(LIMIT.replace(memory));
    read()
}

/// Bytes of the largest file that is read within so much memory (bytes).
#[must_use]
pub const fn largest_file(memory: u64) -> u64 {
    memory / PER_BYTE
}

/// Bytes of memory that the reading under way may fill.
pub(super) fn limit() -> u64 {
    LIMIT.get()
}
