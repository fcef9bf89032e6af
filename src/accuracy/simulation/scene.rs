//! The file's scene, run in every setting.

use super::account::Account;
use super::grid::Grid;
use super::watch::{Stopped, Watch};
use crate::accuracy::result::{RunTiming, Scene, Setting, State};
use crate::accuracy::work::work_of;
use crate::closure::{Geometry, JointState};
use crate::mechanism::Mechanism;
use crate::simulate::{
    Drive, Effects, SceneOptions, WorldError, WorldOptions, effect_names, run_scene,
};

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
