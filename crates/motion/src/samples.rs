//! Solvers of small mechanisms, for the tests of this module.

use super::node::{Node, node_at};
use super::solver::Solver;
use super::system::LoopSystem;
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_mobility::Structure;
use kutzbach_model::mechanism::Mechanism;
use std::sync::Arc;

/// The equations of the only part of a mechanism, with its pose at home.
pub fn system(mechanism: &Mechanism) -> (Arc<LoopSystem>, super::SystemPose) {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let structure = Structure::new(mechanism);
    assert_eq!(structure.parts.len(), 1);
    let part = &structure.parts[0];
    let system = LoopSystem::new(mechanism, &geometry, &geometry.states, part).unwrap();
    let pose = system.pose(&geometry.states);
    (Arc::new(system), pose)
}

/// A solver that holds nothing, and home as a node, its first unknown growing.
pub fn at_home(mechanism: &Mechanism) -> (Solver, Node) {
    let (system, pose) = system(mechanism);
    let mut toward = vec![0.0; system.unknowns()];
    toward[0] = 1.0;
    let mut solver = Solver::new(system, &pose, Vec::new(), 0, 1e-12).unwrap();
    let node = node_at(&mut solver, pose, &toward, 0.0).unwrap();
    (solver, node)
}
