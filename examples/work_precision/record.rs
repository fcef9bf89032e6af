//! What was measured, as it is kept: one row per setting.

use crate::measure::{POSES, Ready, Result, SOLVERS, SUBJECTS, SUBSTEPS};
use kutzbach::simulate::verification::order_between;
use serde::{Deserialize, Serialize};

/// Wall times are the best of so many runs: what else the machine does only adds to them.
pub const RUNS: usize = 7;

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
    /// Measures every setting; `tell` is called after each.
    pub fn measure(date: &str, machine: &str, mut tell: impl FnMut(&str)) -> Result<Self> {
        let mut record = Self {
            date: date.to_owned(),
            machine: machine.to_owned(),
            simulations: Vec::new(),
            traces: Vec::new(),
        };
        for subject in SUBJECTS {
            let ready = Ready::new(subject)?;
            let mechanism = subject.name.to_owned();
            for (solver, solver_name) in SOLVERS {
                for substeps in SUBSTEPS {
                    let shown = ready.simulate(solver, substeps)?;
                    let mut wall_time = f64::INFINITY;
                    for _ in 0..RUNS {
                        wall_time = wall_time.min(ready.simulation_time(solver, substeps)?);
                    }
                    record.simulations.push(Simulation {
                        mechanism: mechanism.clone(),
                        solver: solver_name.to_owned(),
                        substeps,
                        closure_error: digits(shown.closure_error),
                        distance: digits(shown.distance),
                        turned: digits(shown.turned),
                        wall_time: digits(wall_time),
                    });
                    tell(&format!("{mechanism}, {solver_name}, {substeps} substeps"));
                }
            }
            for poses in POSES {
                let traced = ready.trace(poses)?;
                let (mut whole, mut alone) = (f64::INFINITY, f64::INFINITY);
                for _ in 0..RUNS {
                    let time = ready.trace_time(poses)?;
                    whole = whole.min(time.whole);
                    alone = alone.min(time.poses);
                }
                record.traces.push(Trace {
                    mechanism: mechanism.clone(),
                    poses,
                    closure_error: digits(traced.closure_error),
                    equations: digits(traced.equations),
                    wall_time: digits(whole),
                    poses_per_second: digits(poses as f64 / alone),
                });
                tell(&format!("{mechanism}, trace of {poses} poses"));
            }
        }
        Ok(record)
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
