//! The branches of the whole mechanism: one branch of every part, and everything else free.

use super::branch::{Branch, BranchPose};
use super::branch_facts::branch_facts;
use super::part_mobility::{PartBranch, PartFinding};
use super::structure::Structure;
use crate::closure::{Geometry, JointState};
use crate::matrix::SplitMix64;
use crate::mechanism::Mechanism;

/// More combinations than this are not listed one by one.
const MOST_BRANCHES: usize = 256;

/// Tangents are kept as full vectors as long as they need no more than this many numbers.
const MOST_NUMBERS: usize = 20_000_000;

/// Free joints are turned by up to this much (rad or m) between poses, so that no pose of theirs is special.
const FREE_WAY: f64 = 0.4;

/// The branches through the pose, with what moves along each; `None` where some part is open, or where there are too many
/// to list. A mechanism without any finite freedom has none.
#[must_use]
pub(super) fn whole_branches(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    states: &[JointState<f64>],
    kutzbach: i64,
    findings: &[PartFinding],
) -> Option<Vec<Branch>> {
    let free: usize = structure
        .free_joints
        .iter()
        .map(|&j| mechanism.joints()[j].freedom())
        .sum();
    let base = free + 6 * structure.loose_pieces;
    let mut choices: Vec<Vec<Option<&PartBranch>>> = vec![Vec::new()];
    for finding in findings {
        let branches = finding.branches.as_ref()?;
        // A part that cannot move stays where it is.
        let own: Vec<Option<&PartBranch>> = if branches.is_empty() {
            vec![None]
        } else {
            branches.iter().map(Some).collect()
        };
        if choices.len() * own.len() > MOST_BRANCHES {
            return None;
        }
        choices = choices
            .iter()
            .flat_map(|chosen| {
                own.iter().map(move |branch| {
                    let mut chosen = chosen.clone();
                    chosen.push(*branch);
                    chosen
                })
            })
            .collect();
    }
    let mut branches: Vec<Branch> = choices
        .iter()
        .filter_map(|chosen| {
            let dimension = base
                + chosen
                    .iter()
                    .flatten()
                    .map(|branch| branch.dimension)
                    .sum::<usize>();
            if dimension == 0 {
                return None;
            }
            let instantaneous = chosen
                .iter()
                .zip(findings)
                .map(|(branch, finding)| match branch {
                    Some(branch) => branch.poses.first().and_then(|p| p.instantaneous),
                    None => Some(finding.at_rest),
                })
                .sum::<Option<usize>>()
                .map(|i| i + base);
            let poses = whole_poses(mechanism, geometry, structure, states, chosen, base);
            let facts = branch_facts(mechanism, geometry, structure, &poses);
            Some(Branch {
                name: String::new(),
                dimension,
                instantaneous,
                redundant: instantaneous.map(|i| i as i64 - kutzbach),
                half_branches: (dimension == 1).then_some(2),
                roles: facts.roles,
                idle: facts.idle,
                motions: facts.motions,
                poses,
            })
        })
        .collect();
    let order = |branch: &Branch| {
        let locked: Vec<String> = mechanism
            .joints()
            .iter()
            .zip(&branch.roles)
            .filter(|(_, role)| role.locked == Some(true))
            .map(|(joint, _)| joint.name.clone())
            .collect();
        let mut locked = locked;
        locked.sort();
        (std::cmp::Reverse(branch.dimension), locked)
    };
    branches.sort_by_cached_key(order);
    for (index, branch) in branches.iter_mut().enumerate() {
        branch.name = letters(index);
    }
    Some(branches)
}

/// A, B, …, Z, AA, AB, …
fn letters(index: usize) -> String {
    let letter = char::from(b'A' + (index % 26) as u8);
    match index / 26 {
        0 => letter.to_string(),
        more => format!("{}{letter}", letters(more - 1)),
    }
}

fn whole_poses(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    states: &[JointState<f64>],
    chosen: &[Option<&PartBranch>],
    base: usize,
) -> Vec<BranchPose> {
    let mut first_variable = Vec::with_capacity(mechanism.joints().len());
    let mut variables = 0;
    for joint in mechanism.joints() {
        first_variable.push(variables);
        variables += joint.freedom();
    }
    let tangents: usize = base
        + chosen
            .iter()
            .flatten()
            .filter_map(|b| b.poses.first())
            .map(|p| p.tangents.len())
            .sum::<usize>();
    if tangents.saturating_mul(variables) > MOST_NUMBERS {
        return Vec::new();
    }
    // As many poses as the part that was followed least, but two at least where free joints make every pose generic.
    let count = chosen
        .iter()
        .flatten()
        .map(|b| b.poses.len())
        .max()
        .unwrap_or(3);
    (0..count)
        .map(|index| {
            let mut pose = BranchPose {
                states: states.to_vec(),
                tangents: Vec::new(),
            };
            for (branch, part) in chosen.iter().zip(&structure.parts) {
                let Some(own) = branch
                    .filter(|b| !b.poses.is_empty())
                    .map(|b| &b.poses[index % b.poses.len()])
                else {
                    continue;
                };
                for (&joint, state) in part.joints.iter().zip(&own.states) {
                    pose.states[joint] = state.clone();
                }
                for tangent in &own.tangents {
                    let mut whole = vec![0.0; variables];
                    let mut next = tangent.iter();
                    for &joint in &part.joints {
                        let first = first_variable[joint];
                        for slot in &mut whole[first..first + mechanism.joints()[joint].freedom()] {
                            *slot = next.next().copied().unwrap_or(0.0);
                        }
                    }
                    pose.tangents.push(whole);
                }
            }
            for &joint in &structure.free_joints {
                let mut random = SplitMix64::named(&mechanism.joints()[joint].name);
                let freedom = mechanism.joints()[joint].freedom();
                let way: Vec<f64> = (0..freedom * (index + 1))
                    .map(|_| FREE_WAY * random.symmetric())
                    .collect();
                let displacement = &geometry.displacements[joint];
                displacement.advance(&mut pose.states[joint], &way[freedom * index..]);
                for variable in 0..freedom {
                    let mut whole = vec![0.0; variables];
                    whole[first_variable[joint] + variable] = 1.0;
                    pose.tangents.push(whole);
                }
            }
            pose
        })
        .collect()
}
