//! What each effect costs.

use super::options::{Drive, Effects, Pieces, WorldOptions};
use super::{World, WorldError};
use kutzbach_closure::{Geometry, JointState};
use kutzbach_model::mechanism::Mechanism;
use serde::Serialize;
use std::time::Instant;

/// Measured cost of one set of effects.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CostRow {
    /// `none`, the name of one effect, or `scene`.
    pub effects: &'static str,
    /// What the world consisted of.
    pub pieces: Pieces,
    /// Steps taken; fewer than asked for where the motion left the range of numbers.
    pub steps: usize,
    /// Wall time of one step (s); NaN if no step was taken.
    pub step_time: f64,
    /// Steps per second of wall time.
    pub steps_per_second: f64,
}

/// Gravity where the options name none (m/s²).
const EARTH: [f64; 3] = [0.0, 0.0, -9.81];

/// Measures steps with no effects, with each effect alone, and with all that the options name. Each row is a world of its
/// own, started and driven alike; building it is not counted, nor is a tenth of the steps before, in which the engine
/// reserves its memory.
///
/// # Errors
/// Those of [`World::new`] and [`World::drive`].
pub fn cost_table(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    options: &WorldOptions,
    drives: &[Drive],
    steps: usize,
) -> Result<Vec<CostRow>, WorldError> {
    let none = Effects::default();
    let rows = [
        ("none", none),
        (
            "gravity",
            Effects {
                gravity: options.effects.gravity.or(Some(EARTH)),
                ..none
            },
        ),
        (
            "contact",
            Effects {
                contact: true,
                ..none
            },
        ),
        (
            "limits",
            Effects {
                limits: true,
                ..none
            },
        ),
        (
            "friction",
            Effects {
                friction: true,
                ..none
            },
        ),
        (
            "damping",
            Effects {
                damping: true,
                ..none
            },
        ),
        ("scene", options.effects),
    ];
    rows.into_iter()
        .map(|(name, effects)| {
            let options = WorldOptions {
                effects,
                ..*options
            };
            let mut world = World::new(mechanism, geometry, states, &options)?;
            for drive in drives {
                world.drive(*drive)?;
            }
            Ok(measured(name, &mut world, steps))
        })
        .collect()
}

fn measured(effects: &'static str, world: &mut World, steps: usize) -> CostRow {
    let warm = (0..steps / 10).all(|_| world.step().is_ok());
    let start = Instant::now();
    let mut taken = 0;
    while warm && taken < steps && world.step().is_ok() {
        taken += 1;
    }
    let step_time = start.elapsed().as_secs_f64() / taken as f64;
    CostRow {
        effects,
        pieces: world.pieces(),
        steps: taken,
        step_time: if taken > 0 { step_time } else { f64::NAN },
        steps_per_second: if taken > 0 { 1.0 / step_time } else { f64::NAN },
    }
}
