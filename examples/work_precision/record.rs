//! What was measured, as it is kept: one row per setting.

use super::measure::SOLVERS;
use kutzbach::simulate::verification::order_between;
use serde::{Deserialize, Serialize};

/// All rows, with when and where the times were measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The day, as given.
    pub date: String,
    /// The kind of machine, as given.
    pub machine: String,
    /// Times are the best of so many rounds over all settings.
    pub rounds: usize,
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
    /// See [`super::measure::Shown::closure_error`].
    pub closure_error: f64,
    /// See [`super::measure::Shown::distance`].
    pub distance: f64,
    /// See [`super::measure::Shown::turned`].
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
    /// See [`super::measure::Traced::closure_error`].
    pub closure_error: f64,
    /// See [`super::measure::Traced::equations`].
    pub equations: f64,
    /// Seconds from the mechanism as read to the last pose.
    pub wall_time: f64,
    /// Poses per second once the curve is known.
    pub poses_per_second: f64,
}

impl Record {
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
