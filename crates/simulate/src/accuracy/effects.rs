//! What gravity, contact, limits, friction and damping cost, each alone and as the scene has them together.

use super::result::{Effect, EffectTiming};
use super::work::Load;
use crate::{Drive, Effects, World, WorldError, WorldOptions, cost_table, effect_names};
use kutzbach_closure::{Geometry, JointState};
use kutzbach_model::mechanism::Mechanism;

/// Steps that are measured, and fewer where a step is long: about so many seconds of them, counted in work.
const STEPS: f64 = 400.0;
const FEWEST: f64 = 10.0;
const SECONDS: f64 = 0.1;

/// No effects, five effects, and the scene.
const ROWS: f64 = 7.0;

/// Measures a step with each effect, four substeps in 1/240 s with the tree as multibodies: the best of some rounds over all
/// effects, since what else the machine does only adds. Rounds are begun until all of them would take about so many seconds,
/// counted in work; one is always made.
///
/// # Errors
/// Where no world can be made or driven.
pub(super) fn effects_of(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    effects: Effects,
    drives: &[Drive],
    (rounds, all_seconds): (usize, f64),
) -> Result<Vec<Effect>, WorldError> {
    let options = WorldOptions {
        effects,
        ..WorldOptions::default()
    };
    let load = Load::of(&World::new(mechanism, geometry, states, &options)?);
    let (length, substeps) = (options.time_step, options.substeps);
    let step = length * load.seconds_per_second(length, substeps);
    let steps = (SECONDS / step).clamp(FEWEST, STEPS);
    let rounds = rounds.min((all_seconds / (ROWS * steps * step)) as usize);
    let steps = steps as usize;
    let called_for = effect_names(&effects);
    let mut rows = cost_table(mechanism, geometry, states, &options, drives, steps)?;
    for _ in 1..rounds {
        let again = cost_table(mechanism, geometry, states, &options, drives, steps)?;
        for (row, again) in rows.iter_mut().zip(again) {
            row.step_time = row.step_time.min(again.step_time);
        }
    }
    Ok(rows
        .into_iter()
        .map(|row| Effect {
            called_for: row.effects == "scene" || called_for.contains(&row.effects),
            effects: row.effects.to_owned(),
            bodies: row.pieces.bodies,
            shapes: row.pieces.colliders,
            steps: row.steps,
            timing: EffectTiming {
                step: Some(row.step_time).filter(|time| time.is_finite()),
            },
        })
        .collect())
}
