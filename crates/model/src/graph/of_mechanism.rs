//! The constraint graph of a mechanism.

use super::constraint_graph::{ConstraintGraph, EdgeSpec, ExtraRelation, NodeSpec};
use crate::mechanism::Mechanism;

impl ConstraintGraph {
    /// The spatial constraint graph of a mechanism: links as nodes, joints as edges, couplings as extra relations; node
    /// and edge indices are link and joint indices.
    #[must_use]
    pub fn of(mechanism: &Mechanism) -> Self {
        let nodes = mechanism
            .links()
            .iter()
            .map(|link| NodeSpec {
                name: link.name.clone(),
            })
            .collect();
        let edges = mechanism
            .joints()
            .iter()
            .map(|joint| EdgeSpec {
                name: joint.name.clone(),
                ends: [joint.predecessor.link.0, joint.successor.link.0],
                freedom: joint.freedom(),
                class: joint.kind.class().to_owned(),
            })
            .collect();
        let couplings = mechanism
            .couplings()
            .iter()
            .map(|coupling| ExtraRelation {
                name: coupling.name.clone(),
                edges: coupling.terms.iter().map(|term| term.joint.0).collect(),
            })
            .collect();
        Self::new(mechanism.ground().0, nodes, edges, couplings)
    }
}
