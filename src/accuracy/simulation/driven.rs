//! The predicted motion, driven in every setting.

use super::account::Account;
use super::grid::Grid;
use super::watch::Watch;
use crate::accuracy::result::{Driven, RunTiming, Setting, Simulation, State};
use crate::accuracy::work::work_of;
use crate::closure::Geometry;
use crate::mechanism::Mechanism;
use crate::simulate::verification::{DrivenMotion, VerificationError};

/// Where the drive came this far, it has arrived.
const ARRIVED: f64 = 0.999;

/// Simulates a driven motion with every setting; also whether it was broken off.
///
/// # Errors
/// Where no world can be made.
pub(in crate::accuracy) fn driven_rows(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    motion: &DrivenMotion<'_>,
    branch: &str,
    (grid, wanted): (&Grid, Option<f64>),
    watch: &mut Watch<'_>,
) -> Result<(Simulation, bool), VerificationError> {
    let (cost, mut failed) = (work_of(mechanism, geometry, motion.start())?, None);
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
