//! Planar loops that balls close.
//!
//! Where the hinges and slides of a part generate the planar motions G, and lead by themselves from each of its links to every other,
//! the displacement between any two of its links is a product of planar ones, at every pose. A ball between two such links then turns
//! about the normal only and asks for what a hinge along the normal would ask: its centres stay in one plane because all motion
//! does. So the part has the configurations of the one with hinges for balls, whose equations are 3 for each cycle; if the freedom says
//! that these are independent, together with those of the couplings, the configurations are a manifold.

use super::placing::place;
use super::{clear, words};
use crate::PartRank;
use kutzbach_closure::{Geometry, JointState, Part};
use kutzbach_math::group::{GroupError, Margin, Subalgebra, SubgroupKind};
use kutzbach_model::mechanism::{JointKind, Mechanism};
use std::collections::BTreeMap;

/// Why a planar part that balls close has the freedom of its rank, with the margin; `None` where it is none, or where that does not say it.
///
/// # Errors
/// [`GroupError`] where screws are not finite.
pub fn closed_by_balls(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    part: &Part,
    rank: &PartRank,
    accuracy: f64,
) -> Result<Option<(String, Margin)>, GroupError> {
    let Some(freedom) = rank.instantaneous else {
        return Ok(None);
    };
    let is_ball = |joint: usize| mechanism.joints()[joint].kind == JointKind::Spherical;
    let balls = part.joints.iter().filter(|&&joint| is_ball(joint)).count();
    // A ball has two freedoms more than a hinge.
    let variables = rank.unknowns() - 2 * balls;
    let equations = 3 * part.cycles.len() + part.couplings.len();
    if balls == 0 || variables.checked_sub(equations) != Some(freedom) {
        return Ok(None);
    }
    if !hold_together(mechanism, part, is_ball) {
        return Ok(None);
    }
    let placed = place(mechanism, geometry, states, part, rank, accuracy)?;
    let joints = part.joints.iter().zip(&placed.screws);
    let twists: Vec<_> = joints
        .filter(|(joint, _)| !is_ball(**joint))
        .flat_map(|(_, screws)| screws.iter().copied())
        .collect();
    let algebra = Subalgebra::generated_by(&twists, &placed.gauge)?;
    let group = algebra.subgroup()?;
    let planar = group.is_some_and(|group| group.kind() == SubgroupKind::Planar);
    if !planar || !clear(algebra.margin()) {
        return Ok(None);
    }
    Ok(Some((
        words::closed_by_balls(part, balls),
        algebra.margin(),
    )))
}

/// Whether all links of a part hang together by its joints other than balls.
fn hold_together(mechanism: &Mechanism, part: &Part, is_ball: impl Fn(usize) -> bool) -> bool {
    let mut of: BTreeMap<usize, usize> = BTreeMap::new();
    let ends = |joint: usize| {
        let joint = &mechanism.joints()[joint];
        [joint.predecessor.link.0, joint.successor.link.0]
    };
    for link in part.joints.iter().flat_map(|&joint| ends(joint)) {
        of.insert(link, link);
    }
    for &joint in part.joints.iter().filter(|&&joint| !is_ball(joint)) {
        let [a, b] = ends(joint).map(|link| of[&link]);
        of.values_mut()
            .filter(|group| **group == b)
            .for_each(|group| *group = a);
    }
    let mut groups = of.values();
    let first = groups.next();
    groups.all(|group| Some(group) == first)
}
