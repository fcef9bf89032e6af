//! Every setting of a simulation: solver, length of a step, substeps.
//!
//! What the physics engine calls solver iterations are substeps here: eight sweeps over all constraints in each, and the
//! constraints linearised anew. The motion simulated is the one that the verification drives
//! ([`crate::simulate::verification`]); a structure, which has none, is simulated under its scene only.

use super::pareto::pareto_front;
use super::result::{Driven, RunTiming, Scene, Setting, Simulation, State};
use super::work::seconds_per_second;
use crate::closure::{Geometry, JointState};
use crate::mechanism::Mechanism;
use crate::simulate::verification::{DrivenMotion, Moment, Observer, Passage, VerificationError};
use crate::simulate::{
    Drive, Effects, SceneOptions, Solver, World, WorldError, WorldOptions, effect_names, run_scene,
};
use std::ops::ControlFlow;

/// Which settings are tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// How trees are held.
    pub solvers: Vec<Solver>,
    /// Lengths of a step (s).
    pub time_steps: Vec<f64>,
    /// Substeps of a step.
    pub substeps: Vec<usize>,
    /// A setting is left out where it would take about so many seconds or more. They are counted in work, so that the same
    /// settings are left out on every machine.
    pub work: f64,
    /// And where all that were run before it have taken about so many.
    pub all_work: f64,
    /// Longest way that the drive goes, in seconds at a pace of a radian per second for the fastest joint.
    pub longest: f64,
    /// Simulated seconds of the scene.
    pub scene: f64,
}

impl Grid {
    /// Both solvers, steps of 1/60, 1/240 and 1/1000 s with 1, 4, 16 and 64 substeps; a setting of more than about four
    /// seconds is left out.
    #[must_use]
    pub fn full() -> Self {
        Self {
            solvers: vec![Solver::Multibody, Solver::Impulse],
            time_steps: vec![1.0 / 60.0, 1.0 / 240.0, 1.0 / 1000.0],
            substeps: vec![1, 4, 16, 64],
            work: 4.0,
            all_work: 25.0,
            longest: 10.0,
            scene: 1.0,
        }
    }

    /// For a first impression: steps of 1/60 s and 1/240 s, and settings of about a second.
    #[must_use]
    pub fn quick() -> Self {
        Self {
            time_steps: vec![1.0 / 60.0, 1.0 / 240.0],
            work: 1.0,
            all_work: 6.0,
            scene: 0.5,
            ..Self::full()
        }
    }

    fn settings(&self) -> Vec<Wish> {
        let mut all = Vec::new();
        for &solver in &self.solvers {
            for &time_step in &self.time_steps {
                all.extend(self.substeps.iter().map(|&n| (solver, time_step, n)));
            }
        }
        all
    }
}

/// Asked between moments how far everything has come, from 0 to 1; a break ends it.
pub(super) type Watch<'w> = dyn FnMut(f64, &str) -> ControlFlow<()> + 'w;

/// Goes over a grid and keeps account of the work.
struct Account<'g, 'w, 'v> {
    grid: &'g Grid,
    /// An error for which a setting is looked for between those of the grid.
    wanted: Option<f64>,
    /// Work of all that was run.
    spent: f64,
    watch: &'v mut Watch<'w>,
}

/// A setting: solver, length of a step (s), substeps.
type Wish = (Solver, f64, usize);

/// What became of a setting; `None` where it was broken off.
type Run<'r> = dyn FnMut(&WorldOptions, &mut Watched<'_, '_>) -> Option<Setting> + 'r;

/// Settings looked for between those of the grid take this share of the whole, for a progress bar.
const REFINED: f64 = 0.2;

impl<'g, 'w, 'v> Account<'g, 'w, 'v> {
    fn new(grid: &'g Grid, wanted: Option<f64>, watch: &'v mut Watch<'w>) -> Self {
        Self {
            grid,
            wanted,
            spent: 0.0,
            watch,
        }
    }

    /// Runs every setting that there is room for; also whether that was broken off. `cost`: the work of a setting.
    fn rows(
        &mut self,
        cost: &dyn Fn(Solver, f64, usize) -> f64,
        run: &mut Run<'_>,
    ) -> (Vec<Setting>, bool) {
        let share = if self.wanted.is_some() {
            1.0 - REFINED
        } else {
            1.0
        };
        let settings = self.grid.settings();
        let (mut rows, mut stopped) = self.all(&settings, (0.0, share), cost, run);
        if let Some(wanted) = self.wanted
            && !stopped
        {
            let between = settings_between(&rows, wanted, cost);
            let (more, broken) = self.all(&between, (share, REFINED), cost, run);
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
        (rows, stopped)
    }

    fn all(
        &mut self,
        settings: &[Wish],
        (from, share): (f64, f64),
        cost: &dyn Fn(Solver, f64, usize) -> f64,
        run: &mut Run<'_>,
    ) -> (Vec<Setting>, bool) {
        // The cheapest settings come first, whatever their place in the table.
        let mut order: Vec<usize> = (0..settings.len()).collect();
        let work = |i: usize| cost(settings[i].0, settings[i].1, settings[i].2);
        order.sort_by(|&a, &b| work(a).total_cmp(&work(b)).then(a.cmp(&b)));
        let before = self.spent;
        order.retain(|&i| {
            let room = work(i) <= self.grid.work && self.spent + work(i) <= self.grid.all_work;
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
            match run(&options, &mut watched) {
                Some(setting) => rows[i] = setting,
                None => {
                    rows[i].state = State::BrokenOff;
                    stopped = true;
                }
            }
            done += work(i);
        }
        (rows, stopped)
    }
}

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

/// At most so many settings are looked for between those of the grid.
const BETWEEN: usize = 4;

/// Substeps found by the order two of the integration are taken this much finer, since the order is not quite two.
const SAFETY: f64 = 1.15;

/// Substeps that no setting exceeds.
const MOST_SUBSTEPS: f64 = 4096.0;

/// Numbers of substeps, between those of the rows or beyond, that should just reach an error: the closure error falls with
/// their square. Those of least work.
fn settings_between(
    rows: &[Setting],
    wanted: f64,
    cost: &dyn Fn(Solver, f64, usize) -> f64,
) -> Vec<Wish> {
    let mut found: Vec<Wish> = Vec::new();
    let mut ladders: Vec<(Solver, f64)> = rows.iter().map(|r| (r.solver, r.time_step)).collect();
    ladders.sort_by(|a, b| a.1.total_cmp(&b.1).then((a.0 as u8).cmp(&(b.0 as u8))));
    ladders.dedup();
    for (solver, time_step) in ladders {
        let mut known: Vec<(usize, f64)> = rows
            .iter()
            .filter(|row| row.solver == solver && row.time_step == time_step)
            .filter_map(|row| Some((row.substeps, row.error()?)))
            .collect();
        known.sort_by_key(|(substeps, _)| *substeps);
        let enough = known.iter().find(|(_, error)| *error <= wanted);
        let short = known
            .iter()
            .rfind(|(n, error)| *error > wanted && enough.is_none_or(|(most, _)| n < most));
        let Some((n, error)) = short else { continue };
        let fitting = (SAFETY * *n as f64 * (error / wanted).sqrt()).ceil();
        let most = enough.map_or(MOST_SUBSTEPS, |(most, _)| *most as f64 - 1.0);
        if fitting <= most {
            found.push((solver, time_step, fitting as usize));
        }
    }
    let work = |wish: &Wish| cost(wish.0, wish.1, wish.2);
    found.sort_by(|a, b| work(a).total_cmp(&work(b)));
    found.truncate(BETWEEN);
    found
}

/// Hands the progress of one run on as that of all.
pub(super) struct Watched<'v, 'w> {
    watch: &'v mut Watch<'w>,
    from: f64,
    share: f64,
}

impl Observer for Watched<'_, '_> {
    fn begin(&mut self, passage: &Passage) -> ControlFlow<()> {
        (self.watch)(self.from, &passage.title)
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        let done = self.from + self.share * moment.done.clamp(0.0, 1.0);
        (self.watch)(done, "")
    }
}

/// Where the drive came this far, it has arrived.
const ARRIVED: f64 = 0.999;

/// Simulates a driven motion with every setting; also whether it was broken off.
///
/// # Errors
/// Where no world can be made.
pub(super) fn driven_rows(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    motion: &DrivenMotion<'_>,
    branch: &str,
    (grid, wanted): (&Grid, Option<f64>),
    watch: &mut Watch<'_>,
) -> Result<(Simulation, bool), VerificationError> {
    let (cost, mut failed) = (cost_of(mechanism, geometry, motion.start())?, None);
    let seconds = motion.duration();
    let mut account = Account::new(grid, wanted, watch);
    let (rows, stopped) = account.rows(
        &|solver, step, n| seconds * cost(solver, step, n),
        &mut |options, watched| match motion.run(options, watched) {
            Ok(run) if run.stopped => None,
            Ok(run) => {
                let finite = |x: f64| Some(x).filter(|x| x.is_finite());
                Some(Setting {
                    solver: options.solver,
                    time_step: options.time_step,
                    substeps: options.substeps,
                    state: if !run.closure_error.is_finite() || !run.distance.is_finite() {
                        State::CameApart
                    } else if run.progress >= ARRIVED {
                        State::Arrived
                    } else {
                        State::Stalled
                    },
                    closure_error: finite(run.closure_error),
                    distance: finite(run.distance),
                    came: finite(run.progress),
                    timing: Some(RunTiming {
                        seconds_per_second: run.step_time / run.time.max(options.time_step),
                        pareto: false,
                    }),
                })
            }
            Err(error) => {
                failed = Some(error);
                None
            }
        },
    );
    if let Some(error) = failed {
        return Err(error);
    }
    let simulation = Simulation {
        why_not: None,
        driven: Some(Driven {
            branch: branch.to_owned(),
            variable: motion.driven().name.clone(),
            from: motion.from(),
            to: motion.to(),
            ends: motion.ends().to_owned(),
            seconds,
        }),
        rows,
    };
    Ok((simulation, stopped))
}

/// Runs the scene with every setting; also whether it was broken off.
///
/// # Errors
/// Where no world can be made or driven.
pub(super) fn scene_rows(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    (effects, drives): (Effects, &[Drive]),
    (grid, wanted): (&Grid, Option<f64>),
    watch: &mut Watch<'_>,
) -> Result<(Scene, bool), WorldError> {
    let cost = cost_of(mechanism, geometry, states)?;
    let mut failed = None;
    let mut account = Account::new(grid, wanted, watch);
    let (rows, stopped) = account.rows(
        &|solver, step, n| grid.scene * cost(solver, step, n),
        &mut |options, watched| {
            let scene = SceneOptions {
                world: WorldOptions {
                    effects,
                    ..*options
                },
                drives: drives.to_vec(),
                duration: grid.scene,
            };
            let mut stopped = Stopped {
                inner: watched,
                stopped: false,
            };
            match run_scene(mechanism, geometry, states, &scene, &mut stopped) {
                Ok(_) if stopped.stopped => None,
                Ok(run) => Some(Setting {
                    solver: options.solver,
                    time_step: options.time_step,
                    substeps: options.substeps,
                    state: if run.ended_early.is_some() || !run.closure_error.is_finite() {
                        State::CameApart
                    } else {
                        State::Arrived
                    },
                    closure_error: Some(run.closure_error).filter(|x| x.is_finite()),
                    distance: None,
                    came: None,
                    timing: Some(RunTiming {
                        seconds_per_second: run.step_time / run.time.max(options.time_step),
                        pareto: false,
                    }),
                }),
                Err(error) => {
                    failed = Some(error);
                    None
                }
            }
        },
    );
    if let Some(error) = failed {
        return Err(error);
    }
    let scene = Scene {
        effects: effect_names(&effects)
            .into_iter()
            .map(str::to_owned)
            .collect(),
        seconds: grid.scene,
        rows,
    };
    Ok((scene, stopped))
}

/// Remembers that a run was broken off.
struct Stopped<'s, 'v, 'w> {
    inner: &'s mut Watched<'v, 'w>,
    stopped: bool,
}

impl Observer for Stopped<'_, '_, '_> {
    fn begin(&mut self, passage: &Passage) -> ControlFlow<()> {
        let flow = self.inner.begin(passage);
        self.stopped |= flow.is_break();
        flow
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        let flow = self.inner.moment(moment);
        self.stopped |= flow.is_break();
        flow
    }
}

/// The work of a simulated second with each setting.
fn cost_of(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
) -> Result<impl Fn(Solver, f64, usize) -> f64, WorldError> {
    let pieces = |solver| -> Result<_, WorldError> {
        let options = WorldOptions {
            solver,
            ..WorldOptions::default()
        };
        Ok(World::new(mechanism, geometry, states, &options)?.pieces())
    };
    let (tree, impulses) = (pieces(Solver::Multibody)?, pieces(Solver::Impulse)?);
    Ok(move |solver, time_step, substeps| {
        let pieces = match solver {
            Solver::Multibody => &tree,
            Solver::Impulse => &impulses,
        };
        seconds_per_second(solver, pieces, time_step, substeps)
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// What a method of order two does, at a cost of a substep each.
    fn pretend(options: &WorldOptions) -> Setting {
        let substep = options.time_step / options.substeps as f64;
        Setting {
            state: State::Arrived,
            closure_error: Some(substep.powi(2)),
            distance: Some(0.0),
            timing: Some(RunTiming {
                seconds_per_second: 1e-6 / substep,
                pareto: false,
            }),
            ..left_out(&(options.solver, options.time_step, options.substeps))
        }
    }

    fn rows(grid: &Grid, wanted: Option<f64>) -> (Vec<Setting>, bool) {
        let mut quiet = |_: f64, _: &str| ControlFlow::Continue(());
        let mut account = Account::new(grid, wanted, &mut quiet);
        account.rows(
            &|_, step, n| 1e-6 * n as f64 / step,
            &mut |options, watched| {
                assert!(watched.from + watched.share <= 1.0 + 1e-12);
                Some(pretend(options))
            },
        )
    }

    #[test]
    fn settings_go_from_long_substeps_to_short_ones() {
        let (rows, stopped) = rows(&Grid::full(), None);
        assert_eq!((rows.len(), stopped), (24, false));
        for pair in rows.windows(2) {
            assert!(pair[0].solver != pair[1].solver || pair[0].substep() >= pair[1].substep());
        }
        assert!(rows.iter().any(|row| row.timing.unwrap().pareto));
    }

    #[test]
    fn what_is_too_much_work_is_left_out_and_said() {
        let grid = Grid {
            work: 0.005,
            all_work: 0.01,
            ..Grid::full()
        };
        let (rows, _) = rows(&grid, None);
        let (left, run): (Vec<&Setting>, Vec<&Setting>) =
            rows.iter().partition(|row| row.state == State::LeftOut);
        assert!(!left.is_empty() && !run.is_empty());
        assert!(
            left.iter()
                .all(|row| row.timing.is_none() && row.error().is_none())
        );
        let work: f64 = run.iter().map(|row| 1e-6 / row.substep()).sum();
        assert!(work <= 0.01);
    }

    #[test]
    fn a_setting_between_just_reaches_what_is_wanted() {
        let wanted = 1e-8;
        let (rows, _) = rows(&Grid::full(), Some(wanted));
        assert!(rows.len() > 24 && rows.len() <= 24 + BETWEEN);
        let cheapest = |rows: &mut dyn Iterator<Item = &Setting>| -> f64 {
            rows.filter(|row| row.error().unwrap() <= wanted)
                .map(|row| row.seconds().unwrap())
                .fold(f64::INFINITY, f64::min)
        };
        let grid = Grid::full().substeps;
        let all = cheapest(&mut rows.iter());
        let of_grid = cheapest(&mut rows.iter().filter(|row| grid.contains(&row.substeps)));
        assert!(all < 0.8 * of_grid, "{all} {of_grid}");
    }

    #[test]
    fn a_break_ends_it_and_is_said() {
        let grid = Grid::full();
        let mut quiet = |_: f64, _: &str| ControlFlow::Continue(());
        let mut account = Account::new(&grid, None, &mut quiet);
        let mut left = 3;
        let (rows, stopped) = account.rows(&|_, _, _| 1e-3, &mut |options, _| {
            left -= 1;
            (left > 0).then(|| pretend(options))
        });
        assert!(stopped);
        let broken = rows.iter().filter(|row| row.state == State::BrokenOff);
        assert_eq!(broken.count(), 22);
    }
}
