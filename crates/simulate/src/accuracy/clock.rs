//! How times are taken: the median of a few runs, and of one where a run is long.

use super::result::WayTiming;
use std::time::Instant;

/// How often, and for how long, something is timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Patience {
    /// Runs at most.
    pub runs: usize,
    /// No further run is begun after so many seconds.
    pub seconds: f64,
}

impl Patience {
    /// What can be waited for.
    pub const FULL: Self = Self {
        runs: 7,
        seconds: 0.3,
    };
    /// A first impression.
    pub const QUICK: Self = Self {
        runs: 3,
        seconds: 0.05,
    };

    /// Does something once or more; the last result, and the median time.
    pub fn time<T>(self, mut work: impl FnMut() -> T) -> (T, WayTiming) {
        let begun = Instant::now();
        let mut times = Vec::with_capacity(self.runs);
        loop {
            let before = Instant::now();
            let done = work();
            times.push(before.elapsed().as_secs_f64());
            if times.len() >= self.runs || begun.elapsed().as_secs_f64() >= self.seconds {
                times.sort_by(f64::total_cmp);
                let timing = WayTiming {
                    seconds: times[times.len() / 2],
                    runs: times.len(),
                };
                return (done, timing);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_work_is_timed_once_and_short_work_often() {
        let mut calls = 0;
        let patience = Patience {
            runs: 5,
            seconds: 1e9,
        };
        let (last, timing) = patience.time(|| {
            calls += 1;
            calls
        });
        assert_eq!((last, timing.runs), (5, 5));
        let patience = Patience {
            runs: 5,
            seconds: 0.0,
        };
        let (_, timing) = patience.time(|| ());
        assert_eq!(timing.runs, 1);
        assert!(timing.seconds >= 0.0);
    }
}
