//! The predicted motion, driven in every setting.

use super::account::{Account, Outcome};
use super::grid::Grid;
use super::watch::Watch;
use crate::accuracy::result::{Driven, Simulation, State};
use crate::accuracy::work::work_of;
use crate::verification::{APART, DrivenMotion, Size, VerificationError};
use kutzbach_closure::Geometry;
use kutzbach_model::mechanism::Mechanism;

/// Where the drive came this far, it has arrived.
const ARRIVED: f64 = 0.999;

/// Simulates a driven motion with every setting; also whether it was broken off.
///
/// # Errors
/// Where no world can be made.
pub(in crate::accuracy) fn driven_rows(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    (motion, size): (&DrivenMotion<'_>, &Size),
    branch: &str,
    (grid, wanted): (&Grid, Option<f64>),
    watch: &mut Watch<'_>,
) -> Result<(Simulation, bool), VerificationError> {
    let cost = work_of(mechanism, geometry, motion.start())?;
    let seconds = motion.duration();
    let mut account = Account::new(grid, wanted, watch);
    let (rows, stopped) = account.rows(
        &|solver, step, n| {
            let looks = motion.moments().min((seconds / step) as usize);
            seconds * cost(solver, step, n) + size.looks(looks as f64)
        },
        &mut |options, watched| {
            let run = motion.run(options, watched)?;
            let whole = run.closure_error < APART && run.distance.is_finite();
            Ok::<_, VerificationError>((!run.stopped).then_some(Outcome {
                state: match whole {
                    false => State::CameApart,
                    true if run.progress >= ARRIVED => State::Arrived,
                    true => State::Stalled,
                },
                closure_error: run.closure_error,
                distance: Some(run.distance),
                came: Some(run.progress),
                step_time: run.step_time,
                time: run.time,
            }))
        },
    )?;
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
