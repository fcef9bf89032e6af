//! Work that Ctrl-C ends.

use crate::failure::Failure;
use kutzbach::interruption::Interruption;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// How often signals are looked at while work goes on: Ctrl-C is answered within two of these.
const LOOK: Duration = Duration::from_millis(50);

/// Stack of a worker, as large as a main thread's usually is.
pub const STACK: usize = 8 << 20;

/// Does the work in a thread of its own, while other threads of Python go on and signals are looked at.
///
/// Where Python answers a signal with an exception, as it does with Ctrl-C, that exception is raised at once and the work is
/// interrupted: it looks at the flag on its way, ends soon after, and whatever it gives back is dropped. What it hands to other threads
/// takes the flag along.
///
/// # Errors
/// The exception of a signal; what the work says.
pub fn watched<T, W>(py: Python<'_>, work: W) -> PyResult<T>
where
    T: Send + 'static,
    W: FnOnce(&Interruption) -> Result<T, Failure> + Send + 'static,
{
    let interruption = Interruption::default();
    let (send, mut receive) = mpsc::channel();
    let own = interruption.clone();
    let worker = thread::Builder::new().name("kutzbach".to_owned());
    worker.stack_size(STACK).spawn(move || {
        let result = catch_unwind(AssertUnwindSafe(|| own.during(|| work(&own))));
        // Nobody may be waiting any more.
        let _ = send.send(result);
    })?;
    loop {
        let waiting = &mut receive;
        match py.detach(move || waiting.recv_timeout(LOOK)) {
            Ok(Ok(Ok(result))) => return result.map_err(|failure| failure.raised(py)),
            // Nobody but this loop interrupts it, and that no longer waits.
            Ok(Ok(Err(interrupted))) => {
                return Err(Failure::Fault(interrupted.to_string()).raised(py));
            }
            Ok(Err(fault)) => return Err(Failure::of_panic(&*fault).raised(py)),
            Err(RecvTimeoutError::Disconnected) => {
                let failure = Failure::Fault("a worker ended without an answer".to_owned());
                return Err(failure.raised(py));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(exception) = py.check_signals() {
            interruption.interrupt();
            return Err(exception);
        }
    }
}
