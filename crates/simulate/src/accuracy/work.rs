//! How much work a simulation is, counted before it is run.
//!
//! What is left out must not depend on the machine, so that it is decided by a model of the work and not by a clock. In a
//! substep every joint held by impulses is swept over some times; where trees are held by reduced coordinates, as those of
//! coupled joints always are, each sweep of a
//! joint that closes a loop reaches through the tree, and the tree's mass matrix is summed up link by link. The factors were
//! fitted to measured times (one core of a machine of 2024; four-bar, Bricard, Delta, Stewart, Miura, scissors; chains, trees
//! and robots of 10 to 90 links). The model is right to a factor of three, which is enough to tell seconds from hours.

use crate::{Solver, World, WorldError, WorldOptions};
use kutzbach_closure::{Geometry, JointState};
use kutzbach_model::mechanism::Mechanism;

/// Seconds of a substep: for every joint held by impulses; for every one of a tree; for each pair of the two; and for a tree's
/// links times its coordinates, and times their square.
const IMPULSE_JOINT: f64 = 0.9e-6;
const TREE_JOINT: f64 = 0.5e-6;
const REACH: f64 = 0.6e-6;
const MATRIX: [f64; 2] = [0.3e-6, 2.5e-9];

/// Seconds of a step beside its substeps: for every body.
const BODY: f64 = 0.4e-6;

/// What of a world takes time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Load {
    /// Rigid bodies.
    pub bodies: usize,
    /// Joints held by impulses.
    pub impulse_joints: usize,
    /// Joints held by reduced coordinates.
    pub tree_joints: usize,
    /// Links times coordinates, and times their square, summed over the trees held by reduced coordinates.
    pub matrices: [usize; 2],
}

impl Load {
    /// That of a world.
    pub fn of(world: &World) -> Self {
        let pieces = world.pieces();
        Self {
            bodies: pieces.bodies,
            impulse_joints: pieces.impulse_joints,
            tree_joints: pieces.multibody_joints,
            matrices: world.matrix_work(),
        }
    }

    /// About how many seconds a simulated second takes.
    pub fn seconds_per_second(&self, time_step: f64, substeps: usize) -> f64 {
        let [impulses, tree] = [self.impulse_joints, self.tree_joints].map(|n| n as f64);
        let [linear, square] = self.matrices.map(|work| work as f64);
        let substep = IMPULSE_JOINT * impulses
            + TREE_JOINT * tree
            + REACH * impulses * tree
            + MATRIX[0] * linear
            + MATRIX[1] * square;
        (BODY * self.bodies as f64 + substeps as f64 * substep) / time_step
    }
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
    let load = |solver| -> Result<_, WorldError> {
        let options = WorldOptions {
            solver,
            ..WorldOptions::default()
        };
        let world = World::new(mechanism, geometry, states, &options)?;
        Ok(Load::of(&world))
    };
    let (tree, impulses) = (load(Solver::Multibody)?, load(Solver::Impulse)?);
    Ok(move |solver, time_step, substeps| {
        let load = match solver {
            Solver::Multibody => &tree,
            Solver::Impulse => &impulses,
        };
        load.seconds_per_second(time_step, substeps)
    })
}

/// About how many seconds of work a simulated second takes in one setting.
///
/// # Errors
/// Where no world can be made.
pub(crate) fn work_of_setting(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    options: &WorldOptions,
) -> Result<f64, WorldError> {
    let world = World::new(mechanism, geometry, states, options)?;
    Ok(Load::of(&world).seconds_per_second(options.time_step, options.substeps))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Measured (one core, not busy): microseconds of a substep. Those of chains, trees of five limbs and a robot with two
    /// grippers are of a slower machine, and divided by the 2.3 that the Delta took longer there.
    #[test]
    fn the_model_is_right_to_a_factor_of_three() {
        let load = |bodies, impulse_joints, tree_joints, matrices| Load {
            bodies,
            impulse_joints,
            tree_joints,
            matrices,
        };
        for (load, measured) in [
            (load(6, 1, 3, [8, 14]), 3.6),
            (load(4, 4, 0, [0, 0]), 4.0),
            (load(14, 5, 10, [106, 892]), 40.0),
            (load(11, 15, 0, [0, 0]), 10.0),
            (load(26, 5, 19, [162, 1_908]), 60.0),
            (load(20, 24, 0, [0, 0]), 23.0),
            (load(12, 4, 9, [74, 578]), 35.0),
            (load(12, 0, 10, [110, 1_100]), 34.0),
            (load(22, 0, 20, [420, 8_400]), 149.0),
            (load(42, 0, 40, [1_640, 65_600]), 640.0),
            (load(46, 0, 40, [360, 2_880]), 82.0),
            (load(92, 11, 91, [4_508, 220_892]), 2_530.0),
        ] {
            let (step, substeps) = (0.01, 64);
            let seconds = load.seconds_per_second(step, substeps);
            let ratio = 1e6 * seconds * step / substeps as f64 / measured;
            assert!((1.0 / 3.0..3.0).contains(&ratio), "{load:?}: {ratio}");
        }
    }

    #[test]
    fn coupled_joints_cost_as_a_tree_with_either_solver() {
        let text: String = (1..=20)
            .map(|i| {
                let follows = match i % 2 {
                    0 => format!(r#"<mimic joint="j{}"/>"#, i - 1),
                    _ => String::new(),
                };
                let parent = i - 1;
                format!(
                    r#"<link name="l{i}"/><joint name="j{i}" type="continuous"><parent link="l{parent}"/><child link="l{i}"/>
                    <origin xyz="0.1 0 0"/><axis xyz="0 0 1"/>{follows}</joint>"#
                )
            })
            .collect();
        let text = format!(r#"<robot name="row"><link name="l0"/>{text}</robot>"#);
        let read = kutzbach_format::read_bytes(text.as_bytes(), "row.urdf", &[]).unwrap();
        let geometry = Geometry::new(
            &read.mechanism,
            None,
            &kutzbach_closure::Arithmetic::double(),
        );
        let analysis = kutzbach_mobility::analyse(&read.mechanism, &Default::default()).unwrap();
        let states = &analysis.assembly.states;
        let cost = work_of(&read.mechanism, &geometry, states).unwrap();
        let of = |solver| cost(solver, 0.01, 16);
        assert!(of(Solver::Impulse) > 0.5 * of(Solver::Multibody));
    }
}
