//! The file's scene, run in every setting.

use super::account::{Account, Outcome};
use super::grid::Grid;
use super::watch::{Stopped, Watch};
use crate::accuracy::result::{RunTiming, Scene, SceneStep, State};
use crate::accuracy::work::work_of;
use crate::verification::{Moment, Observer, Passage};
use crate::{
    Drive, Effects, Integrator, LONGEST_STEP, RUNGE_KUTTA_STEP, Refinement, SceneOptions, World,
    WorldError, WorldOptions, effect_names, run_scene, run_scene_estimated,
};
use kutzbach_closure::{Geometry, JointState};
use kutzbach_model::mechanism::Mechanism;
use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;

/// Runs the scene with every setting; also whether it was broken off.
///
/// # Errors
/// Where no world can be made or driven.
pub(in crate::accuracy) fn scene_rows(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    (effects, drives): (Effects, &[Drive]),
    (grid, wanted): (&Grid, Option<f64>),
    watch: &mut Watch<'_>,
) -> Result<(Scene, bool), WorldError> {
    let cost = work_of(mechanism, geometry, states)?;
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
                integrator: Some(Integrator::Engine),
                runge_kutta_step: RUNGE_KUTTA_STEP,
            };
            let mut stopped = Stopped {
                inner: watched,
                stopped: false,
            };
            let run = run_scene(mechanism, geometry, states, &scene, &mut stopped)?;
            let whole = run.ended_early.is_none() && run.closure_error.is_finite();
            Ok::<_, WorldError>((!stopped.stopped).then_some(Outcome {
                state: if whole {
                    State::Arrived
                } else {
                    State::CameApart
                },
                closure_error: run.closure_error,
                distance: None,
                came: None,
                step_time: run.step_time,
                time: run.time,
            }))
        },
    )?;
    let options = SceneOptions {
        world: WorldOptions {
            effects,
            ..WorldOptions::default()
        },
        drives: drives.to_vec(),
        duration: grid.scene,
        integrator: None,
        runge_kutta_step: LONGEST_STEP,
    };
    let (steps, broken) = match stopped {
        true => (Vec::new(), true),
        false => steps_of((mechanism, geometry, states), &options, grid.work, watch)?,
    };
    let stopped = stopped || broken;
    let scene = Scene {
        steps,
        length: World::new(mechanism, geometry, states, &options.world)?
            .scale()
            .0,
        effects: effect_names(&effects)
            .into_iter()
            .map(str::to_owned)
            .collect(),
        seconds: grid.scene,
        rows,
    };
    Ok((scene, stopped))
}

/// Errors that halved steps are to come down to, if there is work enough: of Runge-Kutta steps, and of the engine's.
const DOWN_TO: [f64; 2] = [1e-10, 1e-6];

/// The scene in halved steps of each integrator that serves it; also whether that was broken off.
fn steps_of(
    (mechanism, geometry, states): (&Mechanism, &Geometry<f64>, &[JointState<f64>]),
    options: &SceneOptions,
    work: f64,
    watch: &mut Watch<'_>,
) -> Result<(Vec<SceneStep>, bool), WorldError> {
    let mut steps: Vec<SceneStep> = Vec::new();
    for (integrator, wanted) in [None, Some(Integrator::Engine)].into_iter().zip(DOWN_TO) {
        if integrator.is_some()
            && steps
                .iter()
                .any(|step| step.integrator == Integrator::Engine)
        {
            break;
        }
        let options = SceneOptions {
            integrator,
            ..options.clone()
        };
        let refinement = Refinement {
            wanted: Some(wanted),
            work,
        };
        let broken = Cell::new(false);
        let watch = RefCell::new(&mut *watch);
        let asked = || {
            let asked = broken.get() || (watch.borrow_mut())(1.0, "").is_break();
            broken.set(asked);
            asked
        };
        let how = (refinement, &asked as &dyn Fn() -> bool);
        let (run, trajectory) =
            run_scene_estimated(mechanism, geometry, states, &options, how, &mut Unwatched)?;
        if broken.get() {
            return Ok((steps, true));
        }
        let time = run.time.max(run.time_step);
        steps.extend(trajectory.rows.iter().map(|row| SceneStep {
            integrator: run.integrator,
            time_step: row.time_step,
            off: row.error.map(|error| error.worst),
            speeds: row.error.map(|error| error.speed),
            energy_change: row.energy_change,
            closure_error: row.closure_error,
            timing: RunTiming {
                seconds_per_second: row.step_time / time,
                pareto: false,
            },
        }));
    }
    Ok((steps, false))
}

/// Shows nothing.
struct Unwatched;

impl Observer for Unwatched {
    fn begin(&mut self, _: &Passage) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn moment(&mut self, _: &Moment<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
