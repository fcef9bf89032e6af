//! Which runs there are.

use super::crank::{Crank, STEPS_OF_A_TURN};
use super::record::{Record, Run};
use super::scissor::{STEP_RATE, Scissor};
use super::stewart::{STEPS_OF_A_PERIOD, Stewart};
use super::watch::{Result, Seen, watch};
use kutzbach::simulate::Solver;
use serde::{Deserialize, Serialize};

/// What runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Subject {
    /// Bennett's linkage, its crank driven.
    Bennett,
    /// A scissor that swings.
    Scissor,
    /// A Stewart platform whose motors correct the lengths of their legs.
    Stewart,
    /// A Stewart platform whose motors are told velocities only.
    StewartUncorrected,
}

impl Subject {
    /// For a table.
    pub fn title(self) -> &'static str {
        match self {
            Self::Bennett => "Bennett, driven",
            Self::Scissor => "scissor, swinging",
            Self::Stewart => "Stewart, shaken",
            Self::StewartUncorrected => "Stewart, shaken by velocities alone",
        }
    }

    /// For a legend.
    pub fn short(self) -> &'static str {
        match self {
            Self::Bennett => "Bennett",
            Self::Scissor => "scissor",
            Self::Stewart | Self::StewartUncorrected => "Stewart",
        }
    }

    /// What drifts are counted by: its name, and how many steps it has.
    pub fn span(self) -> (&'static str, usize) {
        match self {
            Self::Bennett => ("turn", STEPS_OF_A_TURN),
            Self::Scissor => ("second", STEP_RATE as usize),
            Self::Stewart | Self::StewartUncorrected => ("period", STEPS_OF_A_PERIOD),
        }
    }
}

/// How trees are held.
pub const SOLVERS: [Solver; 2] = [Solver::Multibody, Solver::Impulse];

/// A run that is to be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// What runs.
    pub subject: Subject,
    /// How its tree is held.
    pub solver: Solver,
    /// Substeps of a step.
    pub substeps: usize,
    /// All steps.
    pub steps: usize,
    /// Windows that these are divided into.
    pub windows: usize,
}

/// All runs: of each subject and solver the long one first, then shorter ones that differ in their substeps.
pub fn settings() -> Vec<Setting> {
    let mut settings = Vec::new();
    for (subject, substeps, steps, shorter) in [
        (Subject::Bennett, [1, 2, 4], 1_000_000, 10),
        (Subject::Scissor, [4, 2, 8], 120_000, 1),
        (Subject::Stewart, [2, 1, 4], 120_000, 10),
        (Subject::StewartUncorrected, [2, 1, 4], 12_000, 1),
    ] {
        for solver in SOLVERS {
            for (index, substeps) in substeps.into_iter().enumerate() {
                let steps = if index == 0 { steps } else { steps / shorter };
                // Windows of whole turns and periods.
                let windows = match subject {
                    Subject::Stewart | Subject::StewartUncorrected => steps / STEPS_OF_A_PERIOD,
                    _ => 100,
                };
                settings.push(Setting {
                    subject,
                    solver,
                    substeps,
                    steps,
                    windows,
                });
            }
        }
    }
    settings
}

impl Setting {
    /// Runs the first windows of it.
    pub fn seen(&self, windows: usize) -> Result<Seen> {
        let steps = self.steps / self.windows * windows;
        let (solver, substeps) = (self.solver, self.substeps);
        match self.subject {
            Subject::Bennett => watch(&Crank::bennett(solver)?, substeps, steps, windows),
            Subject::Scissor => watch(&Scissor::new(solver)?, substeps, steps, windows),
            Subject::Stewart => watch(&Stewart::new(solver, true)?, substeps, steps, windows),
            Subject::StewartUncorrected => {
                watch(&Stewart::new(solver, false)?, substeps, steps, windows)
            }
        }
    }
}

/// Makes all runs, on two threads; `tell` is called after each.
pub fn measure(date: &str, machine: &str, tell: impl Fn(&str) + Sync) -> Result<Record> {
    let settings = settings();
    let next = std::sync::atomic::AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            let Some(setting) = settings.get(index) else {
                return Ok(done);
            };
            let seen = setting.seen(setting.windows).map_err(|e| e.to_string())?;
            tell(&format!("{setting:?}"));
            done.push((index, Run::new(setting, &seen)));
        }
    };
    let mut runs: Vec<(usize, Run)> = std::thread::scope(|scope| {
        let workers = [scope.spawn(work), scope.spawn(work)];
        let mut all = Vec::new();
        for worker in workers {
            let done: std::result::Result<Vec<_>, String> =
                worker.join().map_err(|_| "a run broke off".to_owned())?;
            all.extend(done?);
        }
        Ok::<_, String>(all)
    })?;
    runs.sort_by_key(|(index, _)| *index);
    Ok(Record {
        date: date.to_owned(),
        machine: machine.to_owned(),
        runs: runs.into_iter().map(|(_, run)| run).collect(),
    })
}
