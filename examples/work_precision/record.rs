//! What was measured, as it is kept: one row per setting.

use crate::measure::{POSES, Ready, Result, SOLVERS, SUBJECTS, SUBSTEPS};
use kutzbach::simulate::verification::order_between;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Wall times are the best of so many rounds over all settings: what else the machine does only adds to them.
pub const ROUNDS: usize = 9;

/// In a round, what takes less than this (s) is run again until it is over.
const SHORT: f64 = 0.05;

/// All rows, with when and where the times were measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The day, as given.
    pub date: String,
    /// The kind of machine, as given.
    pub machine: String,
    /// Mechanism by mechanism, solver by solver, from few substeps to many.
    pub simulations: Vec<Simulation>,
    /// Mechanism by mechanism.
    pub traces: Vec<Trace>,
}

/// A simulated turn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Simulation {
    /// Name of the mechanism.
    pub mechanism: String,
    /// How its tree was held.
    pub solver: String,
    /// Substeps of a step.
    pub substeps: usize,
    /// See [`crate::measure::Shown::closure_error`].
    pub closure_error: f64,
    /// See [`crate::measure::Shown::distance`].
    pub distance: f64,
    /// See [`crate::measure::Shown::turned`].
    pub turned: f64,
    /// Seconds for the steps of the turn.
    pub wall_time: f64,
}

/// A traced turn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// Name of the mechanism.
    pub mechanism: String,
    /// Poses of the turn.
    pub poses: usize,
    /// See [`crate::measure::Traced::closure_error`].
    pub closure_error: f64,
    /// See [`crate::measure::Traced::equations`].
    pub equations: f64,
    /// Seconds from the mechanism as read to the last pose.
    pub wall_time: f64,
    /// Poses per second once the curve is known.
    pub poses_per_second: f64,
}

impl Record {
    /// Measures every setting: the errors once, the times in rounds over all settings, so that a slow minute of the machine
    /// does not fall on one of them alone. `tell` is called before each round.
    pub fn measure(date: &str, machine: &str, mut tell: impl FnMut(&str)) -> Result<Self> {
        tell("errors");
        let all = SUBJECTS
            .into_iter()
            .map(Ready::new)
            .collect::<Result<Vec<Ready>>>()?;
        let mut record = Self::errors(&all)?;
        record.date = date.to_owned();
        record.machine = machine.to_owned();
        for round in 1..=ROUNDS {
            tell(&format!("times, round {round} of {ROUNDS}"));
            record.times(&all)?;
        }
        Ok(record)
    }

    /// All rows without times.
    fn errors(all: &[Ready]) -> Result<Self> {
        let mut record = Self {
            date: String::new(),
            machine: String::new(),
            simulations: Vec::new(),
            traces: Vec::new(),
        };
        for ready in all {
            for (solver, solver_name) in SOLVERS {
                for substeps in SUBSTEPS {
                    let shown = ready.simulate(solver, substeps)?;
                    record.simulations.push(Simulation {
                        mechanism: ready.subject.name.to_owned(),
                        solver: solver_name.to_owned(),
                        substeps,
                        closure_error: digits(shown.closure_error),
                        distance: digits(shown.distance),
                        turned: digits(shown.turned),
                        wall_time: f64::INFINITY,
                    });
                }
            }
            for poses in POSES {
                let traced = ready.trace(poses)?;
                record.traces.push(Trace {
                    mechanism: ready.subject.name.to_owned(),
                    poses,
                    closure_error: digits(traced.closure_error),
                    equations: digits(traced.equations),
                    wall_time: f64::INFINITY,
                    poses_per_second: 0.0,
                });
            }
        }
        Ok(record)
    }

    /// Times every setting once more; the best times stay.
    fn times(&mut self, all: &[Ready]) -> Result<()> {
        let of = |name: &str| -> Result<&Ready> {
            let ready = all.iter().find(|ready| ready.subject.name == name);
            Ok(ready.ok_or("a row of no mechanism")?)
        };
        for row in &mut self.simulations {
            let ready = of(&row.mechanism)?;
            let solver = SOLVERS.into_iter().find(|(_, name)| *name == row.solver);
            let (solver, _) = solver.ok_or("a row of no solver")?;
            again_and_again(|| {
                let time = ready.simulation_time(solver, row.substeps)?;
                row.wall_time = row.wall_time.min(digits(time));
                Ok(())
            })?;
        }
        for row in &mut self.traces {
            let ready = of(&row.mechanism)?;
            again_and_again(|| {
                let time = ready.trace_time(row.poses)?;
                row.wall_time = row.wall_time.min(digits(time.whole));
                let speed = row.poses as f64 / time.poses;
                row.poses_per_second = row.poses_per_second.max(digits(speed));
                Ok(())
            })?;
        }
        Ok(())
    }

    /// The simulations of one mechanism with one solver, from few substeps to many.
    pub fn ladder<'a>(
        &'a self,
        mechanism: &'a str,
        solver: &'a str,
    ) -> impl Iterator<Item = &'a Simulation> {
        let rows = self.simulations.iter();
        rows.filter(move |row| row.mechanism == mechanism && row.solver == solver)
    }

    /// The traces of one mechanism.
    pub fn traces_of<'a>(&'a self, mechanism: &'a str) -> impl Iterator<Item = &'a Trace> {
        let rows = self.traces.iter();
        rows.filter(move |row| row.mechanism == mechanism)
    }

    /// The simulation that reaches an error soonest.
    pub fn soonest<'a>(&'a self, mechanism: &'a str, error: f64) -> Option<&'a Simulation> {
        let rows = self.simulations.iter();
        rows.filter(|row| row.mechanism == mechanism && row.closure_error <= error)
            .min_by(|a, b| a.wall_time.total_cmp(&b.wall_time))
    }

    /// Seconds that a mechanism's simulation to an error would take with the solver and the step that suit it best, if steps
    /// cost nothing beyond their substeps, which need not be whole numbers. The error falls with the square of the
    /// substeps; the time of one is taken from ladders of sixteen and more.
    pub fn least_time(&self, mechanism: &str, error: f64) -> f64 {
        let of = |solver: &'static str| {
            let fine = || {
                self.ladder(mechanism, solver)
                    .filter(|row| row.substeps >= 16)
            };
            let needed = fine()
                .map(|row| row.substeps as f64 * (row.closure_error / error).sqrt())
                .fold(f64::INFINITY, f64::min);
            let each = fine()
                .map(|row| row.wall_time / row.substeps as f64)
                .fold(f64::INFINITY, f64::min);
            needed * each
        };
        let all = SOLVERS.into_iter().map(|(_, solver)| of(solver));
        all.fold(f64::INFINITY, f64::min)
    }

    /// The order at which the closure error fell to a simulation from the one with half as many substeps.
    pub fn order(&self, row: &Simulation) -> Option<f64> {
        let before = self
            .ladder(&row.mechanism, &row.solver)
            .find(|other| 2 * other.substeps == row.substeps)?;
        order_between(
            (before.substeps, before.closure_error),
            (row.substeps, row.closure_error),
        )
    }
}

/// Four digits: more are noise, in times at least.
fn digits(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// Runs once, and again while little time has gone.
fn again_and_again(mut run: impl FnMut() -> Result<()>) -> Result<()> {
    let begun = Instant::now();
    loop {
        run()?;
        if begun.elapsed().as_secs_f64() >= SHORT {
            return Ok(());
        }
    }
}
