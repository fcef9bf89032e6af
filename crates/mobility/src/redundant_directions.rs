//! Where redundant constraints act: by joint and direction.
//!
//! A constraint of a joint is redundant where a self-stress loads it ([`SelfStresses`]). Of all loaded directions as many are
//! independent as there are redundant constraints: to release those, all at once, removes every redundancy and adds no
//! mobility. Which are picked is a choice; the order of the joints decides.

use super::pose_rank::PartRank;
use super::redundancy::SelfStresses;
use super::row_space::RowSpace;
use kutzbach_closure::{JointDisplacement, Vector, across};

/// A component of a joint's reaction.
#[derive(Clone, Debug, PartialEq)]
pub struct ReactionDirection {
    /// Whether it is a moment about the direction; otherwise a force along it.
    pub moment: bool,
    /// Unit vector in the joint's frame on the predecessor.
    pub direction: Vector<f64>,
}

/// What statics leaves open of a joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointDirections {
    /// Independent components of its reaction that are indeterminate.
    pub indeterminate: Vec<ReactionDirection>,
    /// Those of them that belong to the set of independent redundant constraints of the whole mechanism.
    pub redundant: Vec<ReactionDirection>,
}

/// The directions of a part's joints, in the order given.
pub(super) fn redundant_directions<'a>(
    joints: impl IntoIterator<Item = (usize, &'a JointDisplacement<f64>)>,
    rank: &PartRank,
    stresses: &SelfStresses,
) -> Vec<(usize, JointDirections)> {
    let mut redundant = RowSpace::new(stresses.threshold());
    let of_joint = |(joint, displacement): (usize, &JointDisplacement<f64>)| {
        let mut own = RowSpace::new(stresses.threshold());
        let mut found = JointDirections::default();
        for direction in directions(displacement) {
            let zero = [0.0; 3];
            let screw = match direction.moment {
                true => (direction.direction, zero),
                false => (zero, direction.direction),
            };
            let loads = stresses.loads(rank, joint, &[screw]);
            let row: Vec<f64> = loads.row(0).iter().copied().collect();
            if redundant.add(&row) {
                found.redundant.push(direction.clone());
            }
            if own.add(&row) {
                found.indeterminate.push(direction);
            }
        }
        (joint, found)
    };
    joints.into_iter().map(of_joint).collect()
}

/// Forces along, then moments about the joint's axis and two directions across it; the axes of its frame where it has none.
fn directions(displacement: &JointDisplacement<f64>) -> Vec<ReactionDirection> {
    let axis = *displacement.axis();
    let frame = if axis == [0.0; 3] {
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    } else {
        let (first, second) = across(&axis);
        [axis, first, second]
    };
    let of = |moment| frame.map(|direction| ReactionDirection { moment, direction });
    of(false).into_iter().chain(of(true)).collect()
}
