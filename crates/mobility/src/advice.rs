//! Repair advice: which single joint, relaxed how, removes redundant constraints without adding freedom.

use super::pose_rank::PartRank;
use super::redundancy::SelfStresses;
use super::relaxation::{Relaxation, mobility_stays, relaxations};
use kutzbach_closure::{Geometry, JointState, Part, Vector};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::{JointKind, Mechanism};
use std::collections::BTreeSet;

/// One piece of advice.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// Index of the joint to relax.
    pub joint: usize,
    /// The kind it would become.
    pub to: JointKind,
    /// The second axis it would need for R → U, in the successor's joint frame, as a file writes `axis2`.
    pub second_axis: Option<Vector<f64>>,
    /// Redundant constraints of the whole mechanism before.
    pub redundant_before: i64,
    /// Redundant constraints after.
    pub redundant_after: i64,
}

/// Parts with more unknowns than this get the advice of their first joints only, each still verified.
const THOROUGH_UNKNOWNS: usize = 120;
const ADVICE_OF_LARGE_PARTS: usize = 3;
/// Every verification decides the rank of the whole part.
const VERIFICATIONS_OF_LARGE_PARTS: usize = 12;

/// Advice for one part, verified: every candidate's Jacobian is built anew with the relaxed joint, and its rank decided.
/// `redundant` is the mechanism's total. Ordered by how many redundancies go, then by joint. Geometry and states are
/// changed joint by joint and are as they were afterwards.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn advice_for_part(
    mechanism: &Mechanism,
    geometry: &mut Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    rank: &PartRank,
    stresses: &SelfStresses,
    redundant: i64,
) -> Result<Vec<Advice>, MatrixError> {
    let mut advice = Vec::new();
    let mut verifications = 0;
    let coupled = coupled_joints(mechanism, part);
    let large = rank.unknowns() > THOROUGH_UNKNOWNS;
    for &joint in &part.joints {
        if large
            && (advice.len() >= ADVICE_OF_LARGE_PARTS
                || verifications >= VERIFICATIONS_OF_LARGE_PARTS)
        {
            break;
        }
        if coupled.contains(&joint) {
            continue;
        }
        for relaxation in relaxations(
            mechanism.joints()[joint].kind,
            &geometry.displacements[joint],
            &states[joint],
        ) {
            let Some(second_axis) = pick_second_axis(&relaxation, rank, stresses, joint) else {
                continue;
            };
            let screws = relaxation.screws(&second_axis);
            let freed = screws.len();
            if stresses.rank(&stresses.loads(rank, joint, &screws)) < freed {
                continue;
            }
            let relaxed =
                relaxation.apply(&geometry.displacements[joint], &states[joint], &second_axis);
            let axis2 = *relaxed.displacement.second_axis();
            verifications += 1;
            let mut changes = [(joint, relaxed)];
            if !mobility_stays(&mut changes, geometry, states, part, rank, freed)? {
                continue;
            }
            advice.push(Advice {
                joint,
                to: relaxation.to,
                second_axis: relaxation.second_axis_open.then_some(axis2),
                redundant_before: redundant,
                redundant_after: redundant - freed as i64,
            });
        }
    }
    advice.sort_by_key(|a| (a.redundant_after, a.joint));
    Ok(advice)
}

/// Joints in a coupling of the part. A coupling speaks of a joint's one variable: relaxing such a joint would change what the
/// coupling means.
pub(super) fn coupled_joints(mechanism: &Mechanism, part: &Part) -> BTreeSet<usize> {
    let terms = part
        .couplings
        .iter()
        .flat_map(|&coupling| &mechanism.couplings()[coupling].terms);
    terms.map(|term| term.joint.0).collect()
}

/// A second axis across the first that the self-stresses load: of the two directions across it that the joint frame
/// suggests, the first, unless the second is loaded clearly more. The larger load of the two is at least 1/√2 of the
/// largest in any direction, so that little is lost by naming a direction that a person can place. For other relaxations
/// the axis itself, which is not used; `None` where neither is loaded.
fn pick_second_axis(
    relaxation: &Relaxation,
    rank: &PartRank,
    stresses: &SelfStresses,
    joint: usize,
) -> Option<Vector<f64>> {
    if !relaxation.second_axis_open {
        return Some(relaxation.axis);
    }
    let (e1, e2) = kutzbach_closure::across(&relaxation.axis);
    let loads = stresses.loads(rank, joint, &[(e1, [0.0; 3]), (e2, [0.0; 3])]);
    let (first, second) = (loads.row(0).norm(), loads.row(1).norm());
    if !(first + second > 0.0) {
        return None;
    }
    // A third more is no matter of rounding.
    Some(if second > 4.0 / 3.0 * first { e2 } else { e1 })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{Analysis, AnalysisOptions, analyse};
    use kutzbach_closure::samples::{
        CRANK_ROCKER, Written, add_ring, flat_parallelogram, four_bar, planar, ring, sarrus,
    };
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::MechanismBuilder;

    fn analysed(mechanism: &Mechanism) -> Analysis {
        analyse(mechanism, &AnalysisOptions::default()).unwrap()
    }

    #[test]
    fn counts_are_those_of_the_mechanism_so_changed() {
        // Every piece of advice is carried out on the drawing and counted anew.
        let before = analysed(&four_bar());
        assert_eq!(
            before.advice.len(),
            12,
            "C, U and S for each of four hinges"
        );
        for advice in &before.advice {
            let mut places = planar(&CRANK_ROCKER);
            places[advice.joint].0 = advice.to;
            let Some(second) = advice.second_axis else {
                let after = analysed(&ring(&places, [0.0; 3], Written::Exactly))
                    .home
                    .unwrap();
                assert_eq!(after.redundant, Some(advice.redundant_after), "{advice:?}");
                assert_eq!(after.instantaneous, Some(1));
                continue;
            };
            assert!((second[2]).abs() < 1e-12, "across the hinge");
        }
        let best = &before.advice[0];
        assert_eq!(
            (best.to, best.redundant_before, best.redundant_after),
            (JointKind::Spherical, 3, 1)
        );
    }

    #[test]
    fn what_would_add_a_freedom_is_not_advised() {
        // The one redundancy of a Sarrus linkage is a couple: sliding hinges do not help.
        let advice = analysed(&sarrus()).advice;
        assert!(!advice.is_empty());
        for one in &advice {
            assert_eq!((one.redundant_before, one.redundant_after), (1, 0));
            assert_ne!(
                one.to,
                JointKind::Spherical,
                "two at once would add one freedom"
            );
        }
        // Nothing is redundant, nothing is advised.
        let mut places = planar(&CRANK_ROCKER);
        places[1].0 = JointKind::Cylindrical;
        places[2].0 = JointKind::Spherical;
        assert!(
            analysed(&ring(&places, [0.0; 3], Written::Exactly))
                .advice
                .is_empty()
        );
    }

    #[test]
    fn second_axes_hold_where_the_joint_stands() {
        // At a pose with turned joints the axis in the successor is not that in the predecessor.
        let mut builder = MechanismBuilder::new("turned");
        builder.link("ground");
        add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        let turn = Number::from_f64(0.75).unwrap();
        builder.configuration("turned", vec![("r_a".to_owned(), vec![turn])]);
        let mechanism = builder.build().unwrap();
        let options = AnalysisOptions {
            configuration: Some("turned".to_owned()),
            ..AnalysisOptions::default()
        };
        let analysis = analyse(&mechanism, &options).unwrap();
        let advice = analysis
            .advice
            .iter()
            .find(|a| a.joint == 0 && a.second_axis.is_some());
        let [x, y, z] = advice.unwrap().second_axis.unwrap();
        let (s, c) = 0.75f64.sin_cos();
        // Seen from the predecessor it is one of the directions across the hinge that the joint frame suggests.
        let seen = [c * x - s * y, s * x + c * y];
        assert!(
            seen.iter().any(|x| (x.abs() - 1.0).abs() < 1e-12),
            "{seen:?}"
        );
        assert!(z.abs() < 1e-12);
    }

    #[test]
    fn geometry_and_states_are_put_back() {
        let mechanism = four_bar();
        let analysis = analysed(&mechanism);
        let mut geometry = Geometry::new(&mechanism, None, &kutzbach_closure::Arithmetic::double());
        let mut states = geometry.states.clone();
        let (part, rank) = (&analysis.structure.parts[0], &analysis.parts[0]);
        let stresses = SelfStresses::new(part, rank).unwrap().unwrap();
        let advice = advice_for_part(
            &mechanism,
            &mut geometry,
            &mut states,
            part,
            rank,
            &stresses,
            3,
        )
        .unwrap();
        assert_eq!(advice.len(), 12);
        assert!(
            geometry
                .displacements
                .iter()
                .all(|d| d.kind() == JointKind::Revolute)
        );
        assert!(states.iter().all(|state| state.values == [0.0]));
    }

    #[test]
    fn coupled_joints_are_left_as_they_are() {
        let mut builder = MechanismBuilder::new("geared");
        builder.link("ground");
        add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        builder.mimic("r_b", "r_a", Number::integer(2), Number::zero());
        let advice = analysed(&builder.build().unwrap()).advice;
        assert!(
            !advice.is_empty() && advice.iter().all(|a| a.joint >= 2),
            "{advice:?}"
        );
    }

    #[test]
    fn the_best_comes_first_at_singular_poses_too() {
        let advice = analysed(&flat_parallelogram()).advice;
        assert!(!advice.is_empty());
        assert!(advice.is_sorted_by_key(|a| a.redundant_after));
    }
}
