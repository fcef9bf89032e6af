//! Long work on a thread of its own, so that Ctrl-C is answered at once, wherever the work is.
//!
//! A simulation asks between two moments whether it should go on; following a branch of a large mechanism takes a minute
//! and asks nobody. So the work tells what it has through a channel, and the thread that listens writes the log. Where
//! the work does not end soon after Ctrl-C, the listener closes the log and ends the process.

use crate::cli::interrupt;
use std::sync::mpsc::{RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

/// How often Ctrl-C is looked for while nothing is heard.
const POLL: Duration = Duration::from_millis(50);

/// After Ctrl-C the work gets so long to end by itself, with a result.
const GRACE: Duration = Duration::from_secs(2);

/// Messages that may wait: work is not held up by a log that is written now and then, and memory stays small.
const BACKLOG: usize = 64;

/// The stack of the work, as large as that of a main thread.
const STACK: usize = 8 << 20;

/// Whoever listens to the work.
pub trait Listener<M> {
    /// The work has told something.
    fn hear(&mut self, message: M);
    /// The work goes on; called now and then.
    fn waits(&mut self) {}
    /// Ctrl-C was pressed, and the work does not end.
    fn abandon(&mut self) -> !;
}

enum Heard<M, T> {
    Message(M),
    Done(T),
}

/// Tells the listener; `false` where nobody listens any more.
pub struct Sender<'t, M>(&'t dyn Fn(M) -> bool);

impl<M> Sender<'_, M> {
    pub fn tell(&self, message: M) -> bool {
        (self.0)(message)
    }
}

/// Does work aside, and lets the listener hear what it tells, in order.
///
/// # Errors
/// What the system says where it has no thread to give.
pub fn aside<M: Send, T: Send>(
    listener: &mut dyn Listener<M>,
    work: impl FnOnce(&Sender<'_, M>) -> T + Send,
) -> std::io::Result<T> {
    interrupt::listen();
    let (sender, receiver) = sync_channel(BACKLOG);
    std::thread::scope(|scope| {
        let worker =
            std::thread::Builder::new()
                .stack_size(STACK)
                .spawn_scoped(scope, move || {
                    let sender: SyncSender<Heard<M, T>> = sender;
                    let tell = |message| sender.send(Heard::Message(message)).is_ok();
                    let result = work(&Sender(&tell));
                    // A listener that is gone has no use for it.
                    let _ = sender.send(Heard::Done(result));
                })?;
        let mut asked: Option<Instant> = None;
        loop {
            listener.waits();
            match receiver.recv_timeout(POLL) {
                Ok(Heard::Message(message)) => listener.hear(message),
                Ok(Heard::Done(result)) => return Ok(result),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => match worker.join() {
                    // It tells its result before it ends, unless it panicked.
                    Ok(()) => return Err(std::io::Error::other("the work ended without a result")),
                    Err(panic) => std::panic::resume_unwind(panic),
                },
            }
            if interrupt::asked() && asked.get_or_insert_with(Instant::now).elapsed() >= GRACE {
                listener.abandon();
            }
        }
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    struct Kept(Vec<usize>);

    impl Listener<usize> for Kept {
        fn hear(&mut self, message: usize) {
            self.0.push(message);
        }

        fn abandon(&mut self) -> ! {
            unreachable!("nobody pressed Ctrl-C")
        }
    }

    #[test]
    fn everything_is_heard_in_order_and_before_the_result() {
        let mut kept = Kept(Vec::new());
        let count = 10 * BACKLOG;
        let result = aside(&mut kept, |sender| (0..count).all(|i| sender.tell(i)));
        assert!(result.unwrap());
        assert!(kept.0.iter().copied().eq(0..count));
    }

    #[test]
    #[should_panic(expected = "as it is")]
    fn a_panic_is_passed_on() {
        let _ = aside(&mut Kept(Vec::new()), |_: &Sender<'_, usize>| {
            panic!("as it is")
        });
    }
}
