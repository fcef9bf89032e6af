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
    /// Both solvers, steps of 1/60, 1/240 and 1/1000 s with 1, 4, 16 and 64 substeps; a setting of more than about ten
    /// seconds is left out.
    #[must_use]
    pub fn full() -> Self {
        Self {
            solvers: vec![Solver::Multibody, Solver::Impulse],
            time_steps: vec![1.0 / 60.0, 1.0 / 240.0, 1.0 / 1000.0],
            substeps: vec![1, 4, 16, 64],
            work: 10.0,
            all_work: 60.0,
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

    /// The settings: solver by solver, from long substeps to short ones; of two with equal substeps that of the longer step
    /// first.
    fn settings(&self) -> Vec<(Solver, f64, usize)> {
        let mut all = Vec::new();
        for &solver in &self.solvers {
            let mut of_solver: Vec<(Solver, f64, usize)> = Vec::new();
            for &time_step in &self.time_steps {
                of_solver.extend(self.substeps.iter().map(|&n| (solver, time_step, n)));
            }
            let length = |s: &(Solver, f64, usize)| s.1 / s.2 as f64;
            of_solver.sort_by(|a, b| length(b).total_cmp(&length(a)).then(b.1.total_cmp(&a.1)));
            all.extend(of_solver);
        }
        all
    }
}

/// Asked between moments how far everything has come, from 0 to 1; a break ends it.
pub(super) type Watch<'w> = dyn FnMut(f64, &str) -> ControlFlow<()> + 'w;

/// Goes over a grid and keeps account of the work.
struct Account<'g, 'w, 'v> {
    grid: &'g Grid,
    /// Work done, and all that will be.
    done: f64,
    total: f64,
    watch: &'v mut Watch<'w>,
}

impl Account<'_, '_, '_> {
    /// Runs every setting that there is room for. `cost`: its work; `run`: what became of it.
    fn rows(
        &mut self,
        cost: &dyn Fn(Solver, f64, usize) -> f64,
        run: &mut dyn FnMut(&WorldOptions, &mut Watched<'_, '_>) -> Option<Setting>,
    ) -> (Vec<Setting>, bool) {
        let settings = self.grid.settings();
        // The cheapest settings come first in the queue, whatever their place in the table.
        let mut order: Vec<usize> = (0..settings.len()).collect();
        let work = |i: usize| cost(settings[i].0, settings[i].1, settings[i].2);
        order.sort_by(|&a, &b| work(a).total_cmp(&work(b)).then(a.cmp(&b)));
        let mut spent = 0.0;
        let affordable: Vec<bool> = order
            .iter()
            .map(|&i| {
                let affordable = work(i) <= self.grid.work && spent + work(i) <= self.grid.all_work;
                if affordable {
                    spent += work(i);
                }
                affordable
            })
            .collect();
        self.total = spent.max(1e-12);
        self.done = 0.0;
        let mut rows: Vec<Setting> = settings
            .iter()
            .map(|&(solver, time_step, substeps)| Setting {
                solver,
                time_step,
                substeps,
                state: State::LeftOut,
                closure_error: None,
                distance: None,
                came: None,
                timing: None,
            })
            .collect();
        let mut stopped = false;
        for (&i, affordable) in order.iter().zip(affordable) {
            if !affordable {
                continue;
            }
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
                from: self.done / self.total,
                share: work(i) / self.total,
            };
            match run(&options, &mut watched) {
                Some(setting) => rows[i] = setting,
                None => {
                    rows[i].state = State::BrokenOff;
                    stopped = true;
                }
            }
            self.done += work(i);
        }
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
    grid: &Grid,
    watch: &mut Watch<'_>,
) -> Result<(Simulation, bool), VerificationError> {
    let (cost, mut failed) = (cost_of(mechanism, geometry, motion.start())?, None);
    let seconds = motion.duration();
    let mut account = Account {
        grid,
        done: 0.0,
        total: 1.0,
        watch,
    };
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
    grid: &Grid,
    watch: &mut Watch<'_>,
) -> Result<(Scene, bool), WorldError> {
    let cost = cost_of(mechanism, geometry, states)?;
    let mut failed = None;
    let mut account = Account {
        grid,
        done: 0.0,
        total: 1.0,
        watch,
    };
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
mod tests {
    use super::*;

    #[test]
    fn settings_go_from_long_substeps_to_short_ones() {
        let settings = Grid::full().settings();
        assert_eq!(settings.len(), 24);
        for pair in settings.windows(2) {
            let length = |s: &(Solver, f64, usize)| s.1 / s.2 as f64;
            assert!(pair[0].0 != pair[1].0 || length(&pair[0]) >= length(&pair[1]));
        }
    }
}
