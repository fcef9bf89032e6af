//! How far long work has come: a bar on standard error.
//!
//! Library code knows nothing of terminals; it calls `&mut dyn FnMut(done, total) -> ControlFlow<()>` between steps and
//! stops where it says so. [`Progress::tick`] is such a function.

use super::interrupt;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// A bar that appears when work takes long, and only on a terminal.
pub struct Progress {
    what: &'static str,
    began: Instant,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Work begins; `what` names it (`simulating`). Ctrl-C is listened to from here on.
    #[must_use]
    pub fn new(what: &'static str) -> Self {
        interrupt::listen();
        Self {
            what,
            began: Instant::now(),
            bar: None,
        }
    }

    /// So much of a total is done. Breaks where Ctrl-C was pressed.
    pub fn tick(&mut self, done: u64, total: u64) -> ControlFlow<()> {
        if self.bar.is_none() && self.began.elapsed() >= PATIENCE {
            self.bar = Some(bar(self.what, self.began.elapsed()));
        }
        if let Some(bar) = &self.bar {
            bar.set_length(total);
            bar.set_position(done.min(total));
        }
        if interrupt::asked() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// Work is over: the bar goes, and leaves the line to what follows.
    pub fn finish(self) {}
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// How far work has come that says no share of the whole, only what it is about: the time that it may take fills the bar.
pub struct Sign {
    bar: Option<ProgressBar>,
    began: Instant,
    most: f64,
}

/// What is shown of it.
const SIGN: &str = "{msg} [{bar:30}] {elapsed}, {prefix} at most";

impl Sign {
    /// Work begins that ends after so many seconds at the latest.
    #[must_use]
    pub fn new(most: f64) -> Self {
        Self {
            bar: None,
            began: Instant::now(),
            most,
        }
    }

    /// Seconds since it began.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Shows what the work is about, once it has taken long.
    pub fn tick(&mut self, what: impl FnOnce() -> String) {
        const PARTS: f64 = 1000.0;
        if self.began.elapsed() < PATIENCE {
            return;
        }
        let (began, most) = (self.began, self.most);
        let share = (self.seconds() / most).clamp(0.0, 1.0);
        let bar = self.bar.get_or_insert_with(|| {
            let target = ProgressDrawTarget::stderr_with_hz(10);
            let bar = ProgressBar::with_draw_target(Some(PARTS as u64), target);
            bar.set_style(
                ProgressStyle::with_template(SIGN).unwrap_or_else(|_| ProgressStyle::default_bar()),
            );
            bar.with_elapsed(began.elapsed())
                .with_prefix(format!("{most} s"))
        });
        bar.set_message(what());
        bar.set_position((share * PARTS) as u64);
    }
}

impl Drop for Sign {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn bar(what: &'static str, elapsed: Duration) -> ProgressBar {
    // Draws nothing where standard error is not a terminal; ten times a second where it is.
    let target = ProgressDrawTarget::stderr_with_hz(10);
    let bar = ProgressBar::with_draw_target(None, target).with_elapsed(elapsed);
    let style = ProgressStyle::with_template("{msg} [{bar:30}] {percent}% ({eta} left)");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.with_message(what)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_work_shows_no_bar() {
        let mut progress = Progress::new("working");
        for done in 0..100 {
            assert_eq!(progress.tick(done, 100), ControlFlow::Continue(()));
        }
        assert!(progress.bar.is_none());
        progress.finish();
    }

    #[test]
    fn long_work_shows_one_and_takes_any_count() {
        let mut progress = Progress::new("working");
        progress.began -= PATIENCE;
        for (done, total) in [(0, 0), (5, 3), (u64::MAX, u64::MAX)] {
            assert_eq!(progress.tick(done, total), ControlFlow::Continue(()));
        }
        assert!(progress.bar.is_some());
    }

    #[test]
    fn the_templates_are_some() {
        assert!(ProgressStyle::with_template("{msg} [{bar:30}] {percent}% ({eta} left)").is_ok());
        assert!(ProgressStyle::with_template(SIGN).is_ok());
    }

    #[test]
    fn a_sign_says_what_it_is_about_and_fills_as_time_goes() {
        let mut sign = Sign::new(10.0);
        sign.tick(|| panic!("not yet"));
        assert!(sign.bar.is_none());
        sign.began -= Duration::from_secs(5);
        sign.tick(|| "looking".to_owned());
        let bar = sign.bar.as_ref();
        let shown = bar.map(|bar| {
            (
                bar.message(),
                bar.prefix(),
                bar.position() / 10,
                bar.length(),
            )
        });
        assert_eq!(
            shown,
            Some(("looking".to_owned(), "10 s".to_owned(), 50, Some(1000)))
        );
        // Longer than it may take: full, not beyond.
        sign.began -= Duration::from_secs(20);
        sign.tick(String::new);
        assert_eq!(sign.bar.as_ref().map(ProgressBar::position), Some(1000));
    }
}
