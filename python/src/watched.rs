//! Work that Ctrl-C ends.

use crate::failure::Failure;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// How often signals are looked at while work goes on: Ctrl-C is answered within two of these.
const LOOK: Duration = Duration::from_millis(50);

/// Stack of a worker, as large as a main thread's usually is.
pub const STACK: usize = 8 << 20;

/// Does the work in a thread of its own, while other threads of Python go on and signals are looked at.
///
/// Where Python answers a signal with an exception, as it does with Ctrl-C, that exception is raised at once and the flag given to
/// the work is set. Work that does not look at it goes on in the background until it is done, and its result is dropped.
///
/// # Errors
/// The exception of a signal; what the work says.
pub fn watched<T, W>(py: Python<'_>, work: W) -> PyResult<T>
where
    T: Send + 'static,
    W: FnOnce(&Arc<AtomicBool>) -> Result<T, Failure> + Send + 'static,
{
    let cancelled = Arc::new(AtomicBool::new(false));
    let (send, mut receive) = mpsc::channel();
    let flag = Arc::clone(&cancelled);
    let worker = thread::Builder::new().name("kutzbach".to_owned());
    worker.stack_size(STACK).spawn(move || {
        let result = catch_unwind(AssertUnwindSafe(|| work(&flag)));
        // Nobody may be waiting any more.
        let _ = send.send(result);
    })?;
    loop {
        let waiting = &mut receive;
        match py.detach(move || waiting.recv_timeout(LOOK)) {
            Ok(Ok(result)) => return result.map_err(|failure| failure.raised(py)),
            Ok(Err(fault)) => return Err(Failure::of_panic(&*fault).raised(py)),
            Err(RecvTimeoutError::Disconnected) => {
                let failure = Failure::Fault("a worker ended without an answer".to_owned());
                return Err(failure.raised(py));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(exception) = py.check_signals() {
            cancelled.store(true, Ordering::Relaxed);
            return Err(exception);
        }
    }
}
