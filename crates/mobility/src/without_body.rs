//! What stands still though a body is taken away.
//!
//! A drawer runs between two rails, and each rail is pinned to the wall by two hinges: the rails are as good as one body. A disc
//! that slides between two hubs is another matter, if the hubs turn as soon as the disc is gone. The basic cycles of the part
//! that do not pass the body are what is left of its equations. They may be fewer than all that hold without it, and couplings
//! are left out, so that a joint may stand still and not be said to; what is said to stand still does, to first order.
//!
//! Cost: a rank of the part.

use super::point_chains::Bodies;
use super::pose_rank::known_to;
use super::roles::{NULL_VECTORS, Resting};
use kutzbach_closure::{Geometry, JointState, Part, jacobian};
use kutzbach_math::matrix::{Real, decide, null_vectors};
use kutzbach_model::mechanism::Mechanism;
use std::collections::BTreeSet;

/// The joints of a part that the loops without some joints keep from moving at a pose; `None` where no loop is left, or a
/// margin is thin.
pub(super) fn standing_without(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    part: &Part,
    gone: &[usize],
) -> Option<BTreeSet<usize>> {
    let cycles: Vec<Vec<(usize, bool)>> = part
        .cycles
        .iter()
        .filter(|cycle| cycle.iter().all(|(joint, _)| !gone.contains(joint)))
        .cloned()
        .collect();
    let looped: BTreeSet<usize> = cycles.iter().flatten().map(|(joint, _)| *joint).collect();
    let joints = part.joints.iter().copied();
    let left = Part {
        joints: joints.filter(|joint| looped.contains(joint)).collect(),
        cycles,
        couplings: Vec::new(),
    };
    if left.cycles.is_empty() {
        return None;
    }
    let equations = jacobian(mechanism, geometry, states, &left).ok()?;
    let (stated, rounding, coarse) = known_to(&equations);
    let open = 0.0.norm(&equations.residual);
    let accuracy = rounding + open + if coarse { 0.0 } else { stated };
    let mut matrix = equations.matrix;
    matrix.scale_columns();
    let decision = decide(&matrix, accuracy).ok()?;
    decision.rank?;
    let null = null_vectors(&matrix, &decision, NULL_VECTORS, 3).ok()?;
    let Resting { zero, .. } = Resting::columns(&null, &decision)?;
    let mut first = 0;
    let still = left.joints.into_iter().filter(|&joint| {
        let columns = first..first + mechanism.joints()[joint].freedom();
        first = columns.end;
        zero[columns].iter().all(|zero| *zero)
    });
    Some(still.collect())
}

impl Bodies {
    /// Whether joints that stand still lead from each of some bodies to all others of them.
    pub(super) fn joined(&self, bodies: &BTreeSet<usize>, still: &BTreeSet<usize>) -> bool {
        let Some(&start) = bodies.first() else {
            return true;
        };
        let mut reached = BTreeSet::from([start]);
        let mut stack = vec![start];
        while let Some(body) = stack.pop() {
            for (joint, other) in &self.joints[body] {
                if still.contains(joint) && reached.insert(*other) {
                    stack.push(*other);
                }
            }
        }
        bodies.is_subset(&reached)
    }
}
