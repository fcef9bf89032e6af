//! The file's scene, run in every setting.

use super::account::{Account, Outcome};
use super::grid::Grid;
use super::watch::{Stopped, Watch};
use crate::accuracy::result::{Scene, State};
use crate::accuracy::work::work_of;
use crate::{
    Drive, Effects, Integrator, RUNGE_KUTTA_STEP, SceneOptions, WorldError, WorldOptions,
    effect_names, run_scene,
};
use kutzbach_closure::{Geometry, JointState};
use kutzbach_model::mechanism::Mechanism;

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
