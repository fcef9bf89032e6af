//! The settings of a grid one after the other, while there is room for their work.

use super::between::settings_between;
use super::grid::{Grid, Wish};
use super::watch::{Watch, Watched};
use crate::accuracy::pareto::pareto_front;
use crate::accuracy::result::{RunTiming, Setting, State};
use crate::{Solver, WorldOptions};

/// Goes over a grid and keeps account of the work.
pub(super) struct Account<'g, 'w, 'v> {
    grid: &'g Grid,
    /// An error for which a setting is looked for between those of the grid.
    wanted: Option<f64>,
    /// Work of all that was run.
    spent: f64,
    watch: &'v mut Watch<'w>,
}

/// Runs a setting; `None` where it was broken off.
pub(super) type Run<'r, E> =
    dyn FnMut(&WorldOptions, &mut Watched<'_, '_>) -> Result<Option<Outcome>, E> + 'r;

/// What became of a setting.
pub(super) struct Outcome {
    pub state: State,
    /// Largest gap of any loop (rad, characteristic lengths).
    pub closure_error: f64,
    /// Distance to the predicted motion (rad, characteristic lengths), where there is one.
    pub distance: Option<f64>,
    /// The share of the drive that was covered, where there is one.
    pub came: Option<f64>,
    /// Wall time of all steps (s).
    pub step_time: f64,
    /// Simulated time (s).
    pub time: f64,
}

/// Settings looked for between those of the grid take this share of the whole, for a progress bar.
const REFINED: f64 = 0.2;

impl<'g, 'w, 'v> Account<'g, 'w, 'v> {
    pub fn new(grid: &'g Grid, wanted: Option<f64>, watch: &'v mut Watch<'w>) -> Self {
        Self {
            grid,
            wanted,
            spent: 0.0,
            watch,
        }
    }

    /// Runs every setting that there is room for; also whether that was broken off. `cost`: the work of a setting.
    ///
    /// # Errors
    /// The first of `run`, after which no setting is tried.
    pub fn rows<E>(
        &mut self,
        cost: &dyn Fn(Solver, f64, usize) -> f64,
        run: &mut Run<'_, E>,
    ) -> Result<(Vec<Setting>, bool), E> {
        let share = if self.wanted.is_some() {
            1.0 - REFINED
        } else {
            1.0
        };
        let settings = self.grid.settings();
        let (mut rows, mut stopped) = self.all(&settings, (0.0, share), cost, run)?;
        if let Some(wanted) = self.wanted
            && !stopped
        {
            let between = settings_between(&rows, wanted, cost);
            let (more, broken) = self.all(&between, (share, REFINED), cost, run)?;
            rows.extend(more.into_iter().filter(|row| row.state != State::LeftOut));
            stopped = broken;
        }
        rows.sort_by(in_order);
        let points: Vec<Option<(f64, f64)>> = rows
            .iter()
            .map(|row| Some((row.seconds()?, row.error()?)))
            .collect();
        for (row, on_front) in rows.iter_mut().zip(pareto_front(&points)) {
            if let Some(timing) = &mut row.timing {
                timing.pareto = on_front;
            }
        }
        Ok((rows, stopped))
    }

    fn all<E>(
        &mut self,
        settings: &[Wish],
        (from, share): (f64, f64),
        cost: &dyn Fn(Solver, f64, usize) -> f64,
        run: &mut Run<'_, E>,
    ) -> Result<(Vec<Setting>, bool), E> {
        // The cheapest settings come first, whatever their place in the table.
        let mut order: Vec<usize> = (0..settings.len()).collect();
        let work = |i: usize| cost(settings[i].0, settings[i].1, settings[i].2);
        order.sort_by(|&a, &b| work(a).total_cmp(&work(b)).then(a.cmp(&b)));
        let before = self.spent;
        order.retain(|&i| {
            // The cheapest one may take all there is: one setting says more than none.
            let first = self.spent == 0.0;
            let small = first || work(i) <= self.grid.work;
            let room = small && self.spent + work(i) <= self.grid.all_work;
            if room {
                self.spent += work(i);
            }
            room
        });
        let total = (self.spent - before).max(1e-12);
        let mut rows: Vec<Setting> = settings.iter().map(left_out).collect();
        let (mut done, mut stopped) = (0.0, false);
        for i in order {
            if stopped {
                rows[i].state = State::BrokenOff;
                continue;
            }
            let (solver, time_step, substeps) = settings[i];
            let options = WorldOptions {
                solver,
                time_step,
                substeps,
                ..WorldOptions::default()
            };
            let mut watched = Watched {
                watch: self.watch,
                from: from + share * done / total,
                share: share * work(i) / total,
            };
            match run(&options, &mut watched)? {
                Some(outcome) => rows[i].take(&outcome),
                None => {
                    rows[i].state = State::BrokenOff;
                    stopped = true;
                }
            }
            done += work(i);
        }
        Ok((rows, stopped))
    }
}

impl Setting {
    /// Takes over what became of it. Errors that are no numbers are left out: there is no place for them in a figure.
    fn take(&mut self, outcome: &Outcome) {
        let finite = |x: &f64| x.is_finite();
        self.state = outcome.state;
        self.closure_error = Some(outcome.closure_error).filter(finite);
        self.distance = outcome.distance.filter(finite);
        self.came = outcome.came.filter(finite);
        self.timing = Some(RunTiming {
            seconds_per_second: outcome.step_time / outcome.time.max(self.time_step),
            pareto: false,
        });
    }
}

/// A setting that was not run.
fn left_out(&(solver, time_step, substeps): &Wish) -> Setting {
    Setting {
        solver,
        time_step,
        substeps,
        state: State::LeftOut,
        closure_error: None,
        distance: None,
        came: None,
        timing: None,
    }
}

/// Solver by solver, from long substeps to short ones; of equal substeps that of the longer step first.
fn in_order(a: &Setting, b: &Setting) -> std::cmp::Ordering {
    let place = |s: &Setting| s.solver == Solver::Impulse;
    place(a)
        .cmp(&place(b))
        .then(b.substep().total_cmp(&a.substep()))
        .then(b.time_step.total_cmp(&a.time_step))
}
