//! Work shared out to all processors, whose results come in order.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Stack of a worker, as large as a main thread's usually is.
const STACK: usize = 8 << 20;

/// How long nothing may come before whoever waits is asked whether to go on.
const PATIENCE: Duration = Duration::from_millis(50);

/// What is handed over while work goes on.
pub enum Event<T> {
    /// The next result, in order.
    Next(T),
    /// No next one yet: another result came before it, or nothing for a while.
    Waiting,
}

/// How far the work has come.
struct State {
    /// The first piece of work that nobody has begun.
    next: u64,
    /// How many results have been handed over.
    taken: u64,
    /// Nothing more is to be begun.
    stopped: bool,
}

/// What workers look at before they begin another piece.
struct Gate {
    state: Mutex<State>,
    moved: Condvar,
    count: u64,
    window: u64,
}

impl Gate {
    fn state(&self) -> MutexGuard<'_, State> {
        // Nothing is left half done where a worker ends while it holds the state.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next piece of work; none where all are begun, or no more are wanted.
    fn claim(&self) -> Option<u64> {
        let mut state = self.state();
        loop {
            if state.stopped || state.next >= self.count {
                return None;
            }
            if state.next - state.taken < self.window {
                let index = state.next;
                state.next += 1;
                return Some(index);
            }
            state = self
                .moved
                .wait(state)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn take(&self) {
        self.state().taken += 1;
        self.moved.notify_all();
    }

    fn stop(&self) {
        self.state().stopped = true;
        self.moved.notify_all();
    }
}

/// Ends the work of all where one of them panics: nobody waits for a result that never comes.
struct Watch<'a>(&'a Gate);

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.stop();
        }
    }
}

/// Does pieces of work 0 to `count` − 1, as many at a time as there are processors, and hands over their results in order with how
/// many are done. No piece is begun that is `window` or more ahead of the last result handed over, which bounds what is held in
/// memory. Where `take` breaks, nothing more is begun.
pub fn in_order<T: Send>(
    count: u64,
    window: u64,
    work: impl Fn(u64) -> T + Sync,
    mut take: impl FnMut(u64, Event<T>) -> ControlFlow<()>,
) {
    let gate = Gate {
        state: Mutex::new(State {
            next: 0,
            taken: 0,
            stopped: false,
        }),
        moved: Condvar::new(),
        count,
        window: window.max(1),
    };
    let processors = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let workers = count.min(processors as u64);
    let (send, receive) = mpsc::channel();
    let mut started = 0;
    std::thread::scope(|scope| {
        for _ in 0..workers {
            let (send, gate, work) = (send.clone(), &gate, &work);
            let spawned = std::thread::Builder::new()
                .stack_size(STACK)
                .spawn_scoped(scope, move || one_after_another(gate, work, &send));
            // Fewer workers do the same work; with none at all it is done below.
            if spawned.is_err() {
                break;
            }
            started += 1;
        }
        drop(send);
        let mut done = 0;
        let mut ahead = BTreeMap::new();
        let mut next = 0;
        loop {
            match receive.recv_timeout(PATIENCE) {
                Ok((index, result)) => {
                    done += 1;
                    ahead.insert(index, result);
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            let mut event = ahead.remove(&next).map_or(Event::Waiting, Event::Next);
            loop {
                let is_next = matches!(event, Event::Next(_));
                if take(done, event).is_break() {
                    gate.stop();
                    return;
                }
                if !is_next {
                    break;
                }
                gate.take();
                next += 1;
                let Some(result) = ahead.remove(&next) else {
                    break;
                };
                event = Event::Next(result);
            }
        }
    });
    if started == 0 {
        for index in 0..count {
            if take(index + 1, Event::Next(work(index))).is_break() {
                break;
            }
        }
    }
}

fn one_after_another<T>(gate: &Gate, work: &impl Fn(u64) -> T, send: &Sender<(u64, T)>) {
    let _watch = Watch(gate);
    while let Some(index) = gate.claim() {
        if send.send((index, work(index))).is_err() {
            break;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_and_not_far_ahead() {
        for window in [1, 3, 1000] {
            let mut seen = Vec::new();
            let late = |index: u64| {
                if index.is_multiple_of(7) {
                    std::thread::sleep(Duration::from_millis(2));
                }
                index * index
            };
            in_order(100, window, late, |done, event| {
                if let Event::Next(square) = event {
                    seen.push(square);
                    assert!(done as usize >= seen.len() && done <= seen.len() as u64 + window);
                }
                ControlFlow::Continue(())
            });
            let squares: Vec<u64> = (0..100).map(|index| index * index).collect();
            assert_eq!(seen, squares);
        }
    }

    #[test]
    fn work_ends_where_nobody_wants_more() {
        let mut seen = 0;
        in_order(
            u64::MAX,
            10,
            |index| index,
            |_, event| match event {
                Event::Next(20) => ControlFlow::Break(()),
                Event::Next(_) => {
                    seen += 1;
                    ControlFlow::Continue(())
                }
                Event::Waiting => ControlFlow::Continue(()),
            },
        );
        assert_eq!(seen, 20);
    }

    #[test]
    fn no_work_is_done_at_once() {
        in_order(0, 1, |index| index, |_, _| panic!("nothing to take"));
    }

    #[test]
    #[should_panic(expected = "a scoped thread panicked")]
    fn a_panic_of_one_ends_all() {
        let work = |index: u64| assert_ne!(index, 3);
        in_order(1000, 2, work, |_, _| ControlFlow::Continue(()));
    }
}
