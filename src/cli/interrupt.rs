//! Ctrl-C: it ends the process at once, unless work listens that ends by itself and tells what it has.

use super::failure::Failure;
use kutzbach::interruption::Interruption;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, OnceLock};

/// Exit code of a process ended by Ctrl-C, as shells have it: 128 + SIGINT.
pub const INTERRUPTED: u8 = 130;

/// What work looks at on its way.
static OWN: LazyLock<Interruption> = LazyLock::new(Interruption::default);

/// Whether there is work that ends by itself.
static LISTENED: AtomicBool = AtomicBool::new(false);

/// From here on Ctrl-C, and the request to terminate, end the process with a line and an exit code; where the system does not let
/// it, as ever. Files are written beside and renamed, so that none is left half done.
pub fn end_at_once() {
    static HANDLED: OnceLock<bool> = OnceLock::new();
    HANDLED.get_or_init(|| {
        ctrlc::set_handler(|| {
            let again = OWN.is_asked();
            OWN.interrupt();
            if LISTENED.load(Ordering::SeqCst) && !again {
                // That standard error is closed is nobody's concern.
                let _ = writeln!(
                    std::io::stderr(),
                    "note: interrupted; what is known is told, Ctrl-C again ends at once"
                );
                return;
            }
            Failure::Plain {
                message: "interrupted: there is no answer".to_owned(),
                help: None,
            }
            .tell();
            std::process::exit(i32::from(INTERRUPTED));
        })
        .is_ok()
    });
}

/// Starts to listen for Ctrl-C: the first one asks the work to come to an end, the second one ends the process. Listening twice is
/// listening once.
pub fn listen() {
    LISTENED.store(true, Ordering::SeqCst);
    end_at_once();
}

/// Whether the work has been asked to end.
#[must_use]
pub fn asked() -> bool {
    OWN.is_asked()
}

/// The flag itself, for limits that hold one.
#[must_use]
pub fn flag() -> Arc<AtomicBool> {
    OWN.flag()
}

/// Does work that is to end without an answer where Ctrl-C is pressed; then there is none.
pub fn during<T>(work: impl FnOnce() -> T) -> Option<T> {
    OWN.during(work).ok()
}
