//! How much work a simulation is, counted before it is run.
//!
//! What is left out must not depend on the machine, so that it is decided by a model of the work and not by a clock. In a
//! substep every joint held by impulses is swept over some times; where trees are held by reduced coordinates, each sweep of a
//! joint that closes a loop reaches through the tree, and the tree's mass matrix is factored. The factors were fitted to
//! measured times (one core of a machine of 2024; four-bar, Bricard, Delta, Stewart, Miura, scissors). The model is right to
//! a factor of two or three, which is enough to tell seconds from hours.

use crate::{Pieces, Solver, World, WorldError, WorldOptions};
use kutzbach_closure::{Geometry, JointState};
use kutzbach_model::mechanism::Mechanism;

/// Seconds of a substep: for every joint held by impulses; for every one of a tree; for each pair of the two; and for the cube
/// of a tree's joints.
const IMPULSE_JOINT: f64 = 0.9e-6;
const TREE_JOINT: f64 = 0.5e-6;
const REACH: f64 = 0.8e-6;
const FACTORED: f64 = 1.2e-10;

/// Seconds of a step beside its substeps: for every body.
const BODY: f64 = 0.4e-6;

/// About how many seconds a simulated second takes.
pub(super) fn seconds_per_second(
    solver: Solver,
    pieces: &Pieces,
    time_step: f64,
    substeps: usize,
) -> f64 {
    let impulses = pieces.impulse_joints as f64;
    let substep = match solver {
        Solver::Impulse => IMPULSE_JOINT * impulses,
        Solver::Multibody => {
            let tree = pieces.multibody_joints as f64;
            TREE_JOINT * tree + REACH * impulses * tree + FACTORED * tree.powi(3)
        }
    };
    (BODY * pieces.bodies as f64 + substeps as f64 * substep) / time_step
}

/// The work of a simulated second with each setting.
///
/// # Errors
/// Where no world can be made.
pub(super) fn work_of(
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

    /// Measured (one core, not busy): microseconds of a substep.
    #[test]
    fn the_model_is_right_to_a_factor_of_three() {
        let pieces = |bodies, impulse_joints, multibody_joints| Pieces {
            bodies,
            impulse_joints,
            multibody_joints,
            ..Pieces::default()
        };
        for (solver, pieces, measured) in [
            (Solver::Multibody, pieces(6, 1, 3), 3.6),
            (Solver::Impulse, pieces(4, 4, 0), 4.0),
            (Solver::Multibody, pieces(14, 5, 10), 40.0),
            (Solver::Impulse, pieces(11, 15, 0), 10.0),
            (Solver::Multibody, pieces(26, 5, 19), 60.0),
            (Solver::Impulse, pieces(20, 24, 0), 23.0),
            (Solver::Multibody, pieces(12, 4, 9), 35.0),
        ] {
            let (step, substeps) = (0.01, 64);
            let seconds = seconds_per_second(solver, &pieces, step, substeps);
            let ratio = 1e6 * seconds * step / substeps as f64 / measured;
            assert!((1.0 / 3.0..3.0).contains(&ratio), "{pieces:?}: {ratio}");
        }
    }
}
