//! How much work a simulation is, counted before it is run.
//!
//! What is left out must not depend on the machine, so that it is decided by a model of the work and not by a clock. The model
//! was fitted to measured times (release build, one core of a machine of 2024, four-bar to a scissor lift of 100 stages): a
//! substep sweeps over all joints held by impulses, and factors the mass matrix of each tree held by reduced coordinates. It
//! is right to a factor of about three, which is enough to tell seconds from hours.

use crate::simulate::{Pieces, Solver};

/// Seconds of a substep: for every joint held by impulses, for every one of a tree, and for the cube of a tree's joints.
const IMPULSE_JOINT: f64 = 1.0e-6;
const TREE_JOINT: f64 = 0.8e-6;
const FACTORED: f64 = 1.2e-10;

/// Seconds of a step beside its substeps: for every body.
const BODY: f64 = 0.4e-6;

/// About how many seconds a simulated second takes. `trees`: how many trees share the joints held by reduced coordinates.
pub(super) fn seconds_per_second(
    solver: Solver,
    pieces: &Pieces,
    time_step: f64,
    substeps: usize,
) -> f64 {
    let joints = pieces.impulse_joints as f64;
    let tree = match solver {
        Solver::Multibody => pieces.multibody_joints as f64,
        Solver::Impulse => 0.0,
    };
    let substep = IMPULSE_JOINT * joints + TREE_JOINT * tree + FACTORED * tree.powi(3);
    (BODY * pieces.bodies as f64 + substeps as f64 * substep) / time_step
}
