//! What was measured, as it is kept.

use super::claims::SWING;
use super::runs::{Setting, Subject};
use super::watch::Seen;
use kutzbach::simulate::Solver;
use kutzbach::simulate::verification::order_between;
use serde::{Deserialize, Serialize};

/// All runs, with when and where they were made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The day, as given.
    pub date: String,
    /// The kind of machine, as given.
    pub machine: String,
    /// In the order of the settings.
    pub runs: Vec<Run>,
}

/// One run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// What ran.
    pub subject: Subject,
    /// How its tree was held.
    pub solver: String,
    /// Substeps of a step.
    pub substeps: usize,
    /// All steps.
    pub steps: usize,
    /// What was seen, window by window, to six digits.
    pub seen: Seen,
}

impl Run {
    /// A run that was made.
    pub fn new(setting: &Setting, seen: &Seen) -> Self {
        let rounded = |list: &[f64]| list.iter().copied().map(digits).collect();
        Self {
            subject: setting.subject,
            solver: setting.solver.word().to_owned(),
            substeps: setting.substeps,
            steps: setting.steps,
            seen: Seen {
                closure: rounded(&seen.closure),
                distance: rounded(&seen.distance),
                energy_least: rounded(&seen.energy_least),
                energy_mean: rounded(&seen.energy_mean),
                energy_most: rounded(&seen.energy_most),
                behind: rounded(&seen.behind),
            },
        }
    }

    /// How many windows there are.
    pub fn windows(&self) -> usize {
        self.seen.closure.len()
    }

    /// Turns, seconds or periods of all of it.
    pub fn spans(&self) -> f64 {
        self.steps as f64 / self.subject.span().1 as f64
    }

    /// The windows before the energy of a free swing has changed by [`SWING`]; of what is driven, all.
    pub fn calm(&self) -> usize {
        if self.subject != Subject::Scissor {
            return self.windows();
        }
        let extremes = self.seen.energy_least.iter().zip(&self.seen.energy_most);
        extremes
            .take_while(|(least, most)| least.abs().max(most.abs()) <= SWING)
            .count()
    }

    /// The drift that the run shows, by the straight line that fits best: of its energy where nothing is driven, as long as
    /// the swing is about what it was; else of how far the drives are behind; in a turn, second or period.
    pub fn own_rate(&self) -> f64 {
        let list = match self.subject {
            Subject::Scissor => &self.seen.energy_mean[..self.calm()],
            _ => &self.seen.behind,
        };
        drift(list) / list.len() as f64 * self.windows() as f64 / self.spans()
    }
}

impl Record {
    /// The runs of a subject with a solver, from few substeps to many.
    pub fn ladder(&self, subject: Subject, solver: Solver) -> Vec<&Run> {
        let of = |run: &&Run| run.subject == subject && run.solver == solver.word();
        let mut runs: Vec<&Run> = self.runs.iter().filter(of).collect();
        runs.sort_by_key(|run| run.substeps);
        runs
    }

    /// The longest run of a subject with a solver: the first of its settings.
    pub fn long(&self, subject: Subject, solver: Solver) -> Option<&Run> {
        let mut of = self.runs.iter();
        of.find(|run| run.subject == subject && run.solver == solver.word())
    }
}

/// The order at which something fell from the first run of a ladder to its last.
pub fn order(ladder: &[&Run], of: impl Fn(&Run) -> f64) -> Option<f64> {
    let (first, last) = (ladder.first()?, ladder.last()?);
    order_between(
        (first.substeps, of(first).abs()),
        (last.substeps, of(last).abs()),
    )
}

/// The largest of some windows.
pub fn largest(list: &[f64]) -> f64 {
    list.iter().copied().fold(0.0, f64::max)
}

/// The largest of the last tenth of the windows over that of the first tenth.
pub fn growth(list: &[f64]) -> f64 {
    let tenth = (list.len() / 10).max(1);
    largest(&list[list.len().saturating_sub(tenth)..]) / largest(&list[..tenth.min(list.len())])
}

/// By how much the straight line that fits best, by least squares, changes from the beginning to the end.
pub fn drift(list: &[f64]) -> f64 {
    let count = list.len() as f64;
    let mean = list.iter().sum::<f64>() / count;
    let middle = 0.5 * (count - 1.0);
    let steepness = |(index, value): (usize, &f64)| (index as f64 - middle) * (value - mean);
    let above: f64 = list.iter().enumerate().map(steepness).sum();
    let below: f64 = (0..list.len()).map(|i| (i as f64 - middle).powi(2)).sum();
    if below > 0.0 {
        above / below * count
    } else {
        0.0
    }
}

/// [`drift`] as a share of the mean.
pub fn drift_share(list: &[f64]) -> f64 {
    drift(list) / (list.iter().sum::<f64>() / list.len() as f64)
}

/// Six digits: differences of windows are no larger in the fourth.
fn digits(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}
