//! Joints where nobody puts a motor, and the rams that are there to be driven.

use super::point_chains::Bodies;
use kutzbach_model::mechanism::{CouplingOrigin, FreedomPart, JointKind, Mechanism};
use std::collections::BTreeSet;

/// Joints that carry a `mimic`: another one is driven.
pub(super) fn followers_of_mimics(mechanism: &Mechanism) -> BTreeSet<usize> {
    let origins = mechanism
        .couplings()
        .iter()
        .map(|coupling| &coupling.origin);
    let follower = |origin: &CouplingOrigin| match origin {
        CouplingOrigin::Mimic { follower, .. } => Some(follower.0),
        CouplingOrigin::Ratio { .. } | CouplingOrigin::Sum => None,
    };
    origins.filter_map(follower).collect()
}

/// Cylinders with their rods: two bodies that slide on each other, each held by one more joint, which turns.
#[derive(Default)]
pub(super) struct Rams {
    /// The sliding joints.
    pub sliders: BTreeSet<usize>,
    /// The joints at their ends.
    pub ends: BTreeSet<usize>,
}

impl Rams {
    pub fn of(mechanism: &Mechanism, bodies: &Bodies) -> Self {
        let joints = mechanism.joints();
        let ground = bodies.of[mechanism.ground().0];
        let mut rams = Self::default();
        let sliders = joints.iter().enumerate();
        for (slider, joint) in sliders.filter(|(_, joint)| joint.kind == JointKind::Prismatic) {
            let sides = [joint.predecessor.link.0, joint.successor.link.0];
            let end = |link: usize| {
                let body = bodies.of[link];
                let [(one, _), (other, _)] = bodies.joints[body].as_slice() else {
                    return None;
                };
                let end = if *one == slider { *other } else { *one };
                let turns = |part: &FreedomPart| *part == FreedomPart::Rotation;
                let holds = body != ground && joints[end].kind.freedoms().iter().all(turns);
                holds.then_some(end)
            };
            if let [Some(rear), Some(front)] = sides.map(end) {
                rams.sliders.insert(slider);
                rams.ends.extend([rear, front]);
            }
        }
        rams
    }
}
