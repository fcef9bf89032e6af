//! Links that are idle along a branch: one link inside a loop moves while all others stand still.
//!
//! The rod between two balls spins, a sleeve slides on the shaft of its two cylindrical joints, a disc between parallel
//! grooves shifts. Such a freedom enlarges the mobility and says nothing about what the mechanism is for.
//!
//! A tangent moves one link only if all joints without a side in that link stand still. In an orthonormal basis of the
//! tangent space the joints of the link alone then make up the whole length of the vector: singular values of their rows
//! equal to one. The pieces into which the other links fall without the link are rigid along it, so that it remains to
//! ask of the link's neighbours whether they stand still too; one that hangs on the link only is carried along.
//!
//! Cost: linear in the mechanism for links of few joints, times the square of the freedoms of a link's joints.

use super::branch::{BranchPose, IdleLink};
use super::link_twists::LinkTwists;
use super::one_sided::{OneSided, dot};
use super::relative_motion::link_twists;
use super::structure::Structure;
use crate::closure::Geometry;
use crate::mechanism::Mechanism;

/// A vector is looked at more closely if at most a tenth of its length is outside the link's own joints.
const NEARLY_ALL: f64 = 0.99;

/// Links of loops that can move alone at all of the poses, with the smallest freedom they have there, by link index.
///
/// A link counts as inside a loop if at least two of its joints are in cycles of one part, and these lead to at least two
/// other links: between two links alone the motion of one is what the mechanism is for. Links that hang on bridges, and the
/// ground, are never idle. Where margins are thin a link is not called idle.
#[must_use]
pub fn idle_links(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
) -> Vec<IdleLink> {
    let seen = link_twists(mechanism, geometry, structure, poses);
    idle_seen(mechanism, structure, &seen)
}

pub(super) fn idle_seen(
    mechanism: &Mechanism,
    structure: &Structure,
    seen: &[LinkTwists],
) -> Vec<IdleLink> {
    if seen.is_empty() {
        return Vec::new();
    }
    let mut part_of_joint = vec![None; mechanism.joints().len()];
    for (index, part) in structure.parts.iter().enumerate() {
        for (joint, _) in part.cycles.iter().flatten() {
            part_of_joint[*joint] = Some(index);
        }
    }
    let mut incident = vec![Vec::new(); mechanism.links().len()];
    for (index, joint) in mechanism.joints().iter().enumerate() {
        let (a, b) = (joint.predecessor.link.0, joint.successor.link.0);
        incident[a].push((index, b));
        if a != b {
            incident[b].push((index, a));
        }
    }
    let mut idle = Vec::new();
    for (link, joints) in incident.iter().enumerate() {
        let mut parts: Vec<usize> = joints
            .iter()
            .filter_map(|(j, _)| part_of_joint[*j])
            .collect();
        parts.sort_unstable();
        let in_a_loop = parts.windows(2).any(|pair| pair[0] == pair[1]);
        let mut others: Vec<usize> = joints
            .iter()
            .filter(|(j, _)| part_of_joint[*j].is_some())
            .map(|(_, other)| *other)
            .collect();
        others.sort_unstable();
        others.dedup();
        if link == mechanism.ground().0 || !in_a_loop || others.len() < 2 {
            continue;
        }
        let mut freedom = usize::MAX;
        for there in seen {
            freedom = freedom.min(idle_freedom(there, link, joints).unwrap_or(0));
            if freedom == 0 {
                break;
            }
        }
        if freedom > 0 {
            idle.push(IdleLink { link, freedom });
        }
    }
    idle
}

/// Dimension of the space of tangents that move this link alone; `None` where a margin is thin. `joints` are those with a
/// side in the link, each with the link on the other side.
fn idle_freedom(there: &LinkTwists, link: usize, joints: &[(usize, usize)]) -> Option<usize> {
    let basis = &there.tangents.basis;
    let own: Vec<usize> = joints
        .iter()
        .flat_map(|(joint, _)| there.tangents.variables(*joint))
        .collect();
    let rows = own
        .iter()
        .map(|&variable| basis.iter().map(|vector| vector[variable]).collect());
    let found = OneSided::of(rows.collect())?;
    // Combinations of the tangents that hardly move any other joint.
    let candidates: Vec<Vec<f64>> = found
        .vectors
        .iter()
        .zip(&found.values)
        .take_while(|(_, value)| **value > NEARLY_ALL)
        .map(|(vector, value)| vector.iter().map(|x| x / value).collect())
        .collect();
    if candidates.is_empty() {
        return Some(0);
    }
    let variables = basis.first().map_or(0, Vec::len);
    let mut is_own = vec![false; variables];
    own.iter().for_each(|&variable| is_own[variable] = true);
    let others_move: Vec<Vec<f64>> = candidates
        .iter()
        .map(|candidate| {
            let mut moves: Vec<f64> = (0..variables)
                .filter(|variable| !is_own[*variable])
                .map(|variable| {
                    let row: Vec<f64> = basis.iter().map(|vector| vector[variable]).collect();
                    dot(&row, candidate)
                })
                .collect();
            for (_, neighbour) in joints {
                moves.extend(there.along(*neighbour, candidate));
            }
            moves
        })
        .collect();
    let outside = OneSided::of(others_move)?;
    let moving = there.limits.rank(&outside.values)?;
    // What is left moves nothing else; some of it may not even move the link, where a joint's own screws are dependent.
    let alone = outside.combinations[moving..].iter().map(|combination| {
        let mut sum = vec![0.0; basis.len()];
        for (candidate, weight) in candidates.iter().zip(combination) {
            sum.iter_mut()
                .zip(candidate)
                .for_each(|(s, x)| *s += weight * x);
        }
        there.along(link, &sum).to_vec()
    });
    let own_motion = OneSided::of(alone.collect())?;
    there.limits.rank(&own_motion.values)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::branch_samples::Sample;
    use super::*;

    fn idle(sample: &Sample) -> Vec<(&str, usize)> {
        idle_links(
            &sample.mechanism,
            &sample.geometry,
            &sample.structure,
            &sample.poses,
        )
        .iter()
        .map(|idle| {
            let link = &sample.mechanism.links()[idle.link];
            (link.name.as_str(), idle.freedom)
        })
        .collect()
    }

    #[test]
    fn rods_spin_and_sleeves_slide() {
        assert_eq!(idle(&Sample::rod()), [("r1", 1)]);
        assert_eq!(idle(&Sample::sleeve()), [("r1", 2)]);
    }

    #[test]
    fn links_that_move_others_are_not_idle() {
        assert!(idle(&Sample::parallelogram()).is_empty());
    }

    #[test]
    fn the_poorest_pose_counts() {
        let mut sample = Sample::sleeve();
        sample.poses[1].tangents.pop();
        assert_eq!(idle(&sample), [("r1", 1)]);
        sample.poses[0].tangents.clear();
        assert!(idle(&sample).is_empty());
        sample.poses.clear();
        assert!(idle(&sample).is_empty());
    }
}
