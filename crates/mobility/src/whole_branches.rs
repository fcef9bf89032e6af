//! The branches of the whole mechanism: one branch of every part, and everything else free.

use super::branch::{Branch, BranchPose, Tangent};
use super::branch_facts::facts_seen;
use super::claim::PartBranch;
use super::judge::PartFinding;
use super::relative_motion::link_twists;
use super::vocabulary::PoseKind;
use kutzbach_closure::Structure;
use kutzbach_closure::{Geometry, JointState};
use kutzbach_math::matrix::SplitMix64;
use kutzbach_model::mechanism::Mechanism;
use std::sync::Arc;

/// More combinations than this are not listed one by one.
const MOST_BRANCHES: usize = 256;

/// Tangents are kept as long as they need no more than this many numbers.
const MOST_NUMBERS: usize = 20_000_000;

/// Free joints are turned by up to this much (rad or m) from the pose, each time anew, so that no pose of theirs is special.
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
        let branches = finding.branches()?;
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
                    Some(branch) => branch.poses.first().and_then(|p| p.instantaneous).or(
                        // Near a regular pose all poses are regular.
                        (finding.pose() == Some(PoseKind::Regular)).then_some(branch.dimension),
                    ),
                    None => Some(finding.at_rest()),
                })
                .sum::<Option<usize>>()
                .map(|i| i + base);
            let poses = whole_poses(mechanism, geometry, structure, states, chosen);
            let seen = link_twists(mechanism, geometry, structure, &poses);
            let facts = facts_seen(mechanism, geometry, structure, (&poses, &seen));
            Some(Branch {
                name: String::new(),
                dimension,
                instantaneous,
                redundant: instantaneous.map(|i| i as i64 - kutzbach),
                half_branches: (dimension == 1).then_some(2),
                roles: facts.roles,
                idle: facts.idle,
                nearly_idle: facts.nearly_idle,
                motions: facts.motions,
                poses,
                seen: Arc::new(seen),
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
) -> Vec<BranchPose> {
    let first_variable = mechanism.variable_offsets();
    let variables = mechanism.freedom();
    let numbers = chosen.iter().flatten().filter_map(|b| b.poses.first());
    let numbers = numbers.flat_map(|pose| &pose.tangents).map(Vec::len);
    if numbers.fold(0, usize::saturating_add) > MOST_NUMBERS {
        return Vec::new();
    }
    // As many as the part has that was followed farthest; the others repeat theirs. Free joints alone are drawn three times.
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
                    let own = part
                        .joints
                        .iter()
                        .flat_map(|&joint| first_variable[joint]..first_variable[joint + 1]);
                    let rates = own.zip(tangent.iter().copied());
                    pose.tangents.push(Tangent::new(variables, rates));
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
                    let alone = [(first_variable[joint] + variable, 1.0)];
                    pose.tangents.push(Tangent::new(variables, alone));
                }
            }
            pose
        })
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{Analysis, AnalysisOptions, Bounds, Says, analyse, kutzbach_count};
    use kutzbach_closure::samples::{
        CRANK_ROCKER, Written, add_ring, flat_parallelogram, four_bar, planar, ring,
    };
    use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind, MechanismBuilder};

    const FLAT: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [2.0, 0.0]];

    fn analysed(mechanism: &Mechanism) -> Analysis {
        analyse(mechanism, &AnalysisOptions::default()).unwrap()
    }

    /// Rings side by side on the ground, `ring_0`, `ring_1`, …
    fn rings(points: &[&[[f64; 2]]]) -> MechanismBuilder {
        let mut builder = MechanismBuilder::new("rings");
        builder.link("ground");
        for (i, points) in points.iter().enumerate() {
            let name = format!("ring_{i}");
            add_ring(
                &mut builder,
                &name,
                "ground",
                &planar(points),
                [0.0; 3],
                Written::Exactly,
            );
        }
        builder
    }

    /// What the function makes of other findings about the same mechanism.
    fn branches_of(
        mechanism: &Mechanism,
        analysis: &Analysis,
        findings: &[PartFinding],
    ) -> Option<Vec<Branch>> {
        whole_branches(
            mechanism,
            &Geometry::new(mechanism, None, &kutzbach_closure::Arithmetic::double()),
            &analysis.structure,
            &analysis.assembly.states,
            analysis.kutzbach,
            findings,
        )
    }

    #[test]
    fn two_pairs_of_branches_make_four() {
        let mechanism = rings(&[&FLAT, &FLAT]).build().unwrap();
        let analysis = analysed(&mechanism);
        let branches = analysis.branches.unwrap();
        let names: Vec<&str> = branches.iter().map(|b| b.name.as_str()).collect();
        assert_eq!(names, ["A", "B", "C", "D"]);
        let value = |pose: &BranchPose, name: &str| {
            pose.states[mechanism.joint_named(name).unwrap().0].values[0]
        };
        let mut seen = std::collections::BTreeSet::new();
        for branch in &branches {
            assert_eq!((branch.dimension, branch.half_branches), (2, None));
            assert_eq!(branch.instantaneous, Some(2));
            assert_eq!(branch.redundant, Some(2 - kutzbach_count(&mechanism)));
            assert_eq!(branch.poses.len(), 3);
            for pose in &branch.poses {
                assert_eq!(pose.tangents.len(), 2);
                // Each tangent moves one ring only.
                for tangent in &pose.tangents {
                    assert_eq!(tangent.variables(), 8);
                    // Every joint has one variable.
                    let moving: Vec<bool> = tangent
                        .entries()
                        .iter()
                        .map(|(joint, _)| mechanism.joints()[*joint].name.starts_with("ring_0"))
                        .collect();
                    assert!(!moving.is_empty() && moving.iter().all(|m| *m == moving[0]));
                }
            }
            // Which of the two couplers turn tells the four apart.
            let turns = ["ring_0", "ring_1"].map(|ring| {
                let pose = &branch.poses[0];
                let (a, b) = (
                    value(pose, &format!("{ring}_a")),
                    value(pose, &format!("{ring}_b")),
                );
                (a + b).abs() > 1e-6
            });
            assert!(seen.insert(turns), "twice the same: {turns:?}");
        }
    }

    #[test]
    fn free_joints_and_loose_bodies_add_to_every_branch() {
        let mut builder = rings(&[&FLAT]);
        builder.link("arm").link("stone");
        builder.joint(JointBuilder::tree(
            "pin",
            JointKind::Revolute,
            "ground",
            "arm",
        ));
        builder.floating("drop", "ground", "stone", Frame::identity());
        let mechanism = builder.build().unwrap();
        let branches = analysed(&mechanism).branches.unwrap();
        assert_eq!(branches.len(), 2);
        let pin = mechanism.joint_named("pin").unwrap().0;
        for branch in &branches {
            assert_eq!(branch.dimension, 1 + 1 + 6);
            assert_eq!(branch.instantaneous, Some(8));
            // No pose of the free joint is special, nor the same twice.
            let values: Vec<f64> = branch
                .poses
                .iter()
                .map(|p| p.states[pin].values[0])
                .collect();
            assert!(values.iter().all(|v| *v != 0.0 && v.abs() <= FREE_WAY));
            assert!(values.windows(2).all(|v| v[0] != v[1]), "{values:?}");
            assert_eq!(branch.roles[pin].locked, Some(false));
        }
    }

    #[test]
    fn a_part_that_cannot_move_stays_where_it_is() {
        let triangle = &CRANK_ROCKER[..3];
        let mechanism = rings(&[triangle, &CRANK_ROCKER]).build().unwrap();
        let branches = analysed(&mechanism).branches.unwrap();
        assert_eq!(branches.len(), 1);
        let only = &branches[0];
        assert_eq!((only.name.as_str(), only.dimension), ("A", 1));
        assert_eq!(only.half_branches, Some(2));
        for pose in &only.poses {
            for (joint, state) in mechanism.joints().iter().zip(&pose.states) {
                assert_eq!(state.values[0] == 0.0, joint.name.starts_with("ring_0"));
            }
        }
        // A line of three, which only turns to first order, adds that to the instantaneous freedom.
        let shaky = [[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]];
        let mechanism = rings(&[&shaky, &CRANK_ROCKER]).build().unwrap();
        let branches = analysed(&mechanism).branches.unwrap();
        assert_eq!(
            (branches[0].dimension, branches[0].instantaneous),
            (1, Some(2))
        );
    }

    #[test]
    fn without_finite_freedom_there_is_no_branch() {
        for points in [&CRANK_ROCKER[..3], &[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]] {
            let branches = analysed(&rings(&[points]).build().unwrap()).branches;
            assert!(branches.unwrap().is_empty());
        }
    }

    #[test]
    fn an_open_part_leaves_all_branches_open() {
        let mechanism = rings(&[&FLAT, &CRANK_ROCKER]).build().unwrap();
        let analysis = analysed(&mechanism);
        let mut findings = analysis.findings.clone();
        assert_eq!(
            branches_of(&mechanism, &analysis, &findings).unwrap().len(),
            2
        );
        findings[1].amend(|claim| claim.says = Says::Open(String::new()));
        assert!(branches_of(&mechanism, &analysis, &findings).is_none());
    }

    #[test]
    fn too_many_combinations_are_not_listed() {
        let flat = analysed(&flat_parallelogram()).findings[0].clone();
        let plain = analysed(&four_bar()).findings[0].clone();
        let mechanism = ring(&planar(&CRANK_ROCKER), [0.0; 3], Written::Exactly);
        let analysis = analysed(&mechanism);
        // 2⁸ = 256 are listed, 2⁹ are not, whatever comes between; poses are those of the one ring there is.
        let listed = |pairs: usize| {
            let mut findings = vec![plain.clone()];
            findings.extend(vec![flat.clone(); pairs]);
            branches_of(&mechanism, &analysis, &findings).map(|b| b.len())
        };
        assert_eq!(
            (listed(0), listed(8), listed(9)),
            (Some(1), Some(256), None)
        );
    }

    #[test]
    fn names_run_on_after_the_last_letter() {
        let named: Vec<String> = [0, 1, 25, 26, 27, 51, 52, 701, 702].map(letters).to_vec();
        assert_eq!(named, ["A", "B", "Z", "AA", "AB", "AZ", "BA", "ZZ", "AAA"]);
    }

    #[test]
    fn larger_branches_come_first() {
        // One part has branches of dimension 1 and, by decree, 2.
        let mechanism = ring(&planar(&FLAT), [0.0; 3], Written::Exactly);
        let analysis = analysed(&mechanism);
        let mut findings = analysis.findings.clone();
        let mut claims = findings[0].claims().iter();
        let mut claim = claims.rfind(|c| c.answer().is_some()).unwrap().clone();
        claim.finite = Bounds::exactly(2);
        if let Says::Decides(answer) = &mut claim.says {
            answer.branches.as_mut().unwrap()[1].dimension = 2;
        }
        findings[0].read_anew(claim);
        let branches = branches_of(&mechanism, &analysis, &findings).unwrap();
        let seen: Vec<(&str, usize)> = branches
            .iter()
            .map(|b| (b.name.as_str(), b.dimension))
            .collect();
        assert_eq!(seen, [("A", 2), ("B", 1)]);
    }

    #[test]
    fn the_order_in_the_file_changes_no_name() {
        // A flat kite: about one pair of joints one half turns, and others are locked.
        let kite = [[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [1.0, 0.0]];
        let locked = |first: &str, second: &str| {
            let mut builder = MechanismBuilder::new("two");
            builder.link("ground");
            for name in [first, second] {
                add_ring(
                    &mut builder,
                    name,
                    "ground",
                    &planar(&kite),
                    [0.0; 3],
                    Written::Exactly,
                );
            }
            let mechanism = builder.build().unwrap();
            let branches = analysed(&mechanism).branches.unwrap();
            branches
                .iter()
                .map(|branch| {
                    let mut locked: Vec<String> = mechanism
                        .joints()
                        .iter()
                        .zip(&branch.roles)
                        .filter(|(_, role)| role.locked == Some(true))
                        .map(|(joint, _)| joint.name.clone())
                        .collect();
                    locked.sort();
                    (branch.name.clone(), locked)
                })
                .collect::<Vec<_>>()
        };
        let found = locked("p", "q");
        assert_eq!(found.len(), 4);
        assert_eq!(found, locked("q", "p"));
    }
}
