//! Repair advice: which single joint, relaxed how, removes redundant constraints without adding freedom.

use super::pose_rank::PartRank;
use super::redundancy::SelfStresses;
use crate::closure::{Geometry, JointDisplacement, JointState, Part, Vector, jacobian};
use crate::matrix::{MatrixError, decide};
use crate::mechanism::{JointKind, Mechanism};

/// One piece of advice.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// Index of the joint to relax.
    pub joint: usize,
    /// The kind it would become.
    pub to: JointKind,
    /// The second axis it would need, in the joint frame, for R → U.
    pub second_axis: Option<Vector<f64>>,
    /// Redundant constraints of the whole mechanism before.
    pub redundant_before: i64,
    /// Redundant constraints after.
    pub redundant_after: i64,
}

/// Parts with more unknowns than this get the advice of their first joints only, each still verified.
const THOROUGH_UNKNOWNS: usize = 300;
const ADVICE_OF_LARGE_PARTS: usize = 3;

/// Advice for one part, verified: every candidate's Jacobian is built anew with the relaxed joint, and its rank decided.
/// `redundant` is the mechanism's total. Ordered by how many redundancies go, then by joint.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn advice_for_part(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    part: &Part,
    rank: &PartRank,
    stresses: &SelfStresses,
    redundant: i64,
) -> Result<Vec<Advice>, MatrixError> {
    let mut advice = Vec::new();
    let coupled: std::collections::BTreeSet<usize> = part
        .couplings
        .iter()
        .flat_map(|&c| {
            mechanism.couplings()[c]
                .terms
                .iter()
                .map(|term| term.joint.0)
        })
        .collect();
    let large = rank.unknowns() > THOROUGH_UNKNOWNS;
    for &joint in &part.joints {
        if large && advice.len() >= ADVICE_OF_LARGE_PARTS {
            break;
        }
        // A coupling speaks of a joint's one variable; relaxing such a joint would change what the coupling means.
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
            if !verified(
                mechanism,
                geometry,
                states,
                part,
                rank,
                joint,
                &relaxation,
                &second_axis,
                freed,
            )? {
                continue;
            }
            advice.push(Advice {
                joint,
                to: relaxation.to,
                second_axis: relaxation.second_axis_open.then_some(second_axis),
                redundant_before: redundant,
                redundant_after: redundant - freed as i64,
            });
        }
    }
    advice.sort_by_key(|a| (a.redundant_after, a.joint));
    Ok(advice)
}

/// A way to relax a joint: the kind it becomes and the screws it gains, in its own frame.
struct Relaxation {
    to: JointKind,
    axis: Vector<f64>,
    gained: Vec<(Vector<f64>, Vector<f64>)>,
    /// The gained screw is a rotation about a direction still to be chosen, perpendicular to the axis.
    second_axis_open: bool,
}

impl Relaxation {
    fn screws(&self, second_axis: &Vector<f64>) -> Vec<(Vector<f64>, Vector<f64>)> {
        if self.second_axis_open {
            vec![(*second_axis, [0.0; 3])]
        } else {
            self.gained.clone()
        }
    }
}

fn relaxations(
    kind: JointKind,
    displacement: &JointDisplacement<f64>,
    state: &JointState<f64>,
) -> Vec<Relaxation> {
    let axis = *displacement.axis();
    let zero = [0.0; 3];
    let base = |i: usize| {
        let mut v = zero;
        v[i] = 1.0;
        v
    };
    let (e1, e2) = if kind.uses_axis() {
        displacement.across()
    } else {
        (base(1), base(2))
    };
    let to = |to, gained: &[(Vector<f64>, Vector<f64>)]| Relaxation {
        to,
        axis,
        gained: gained.to_vec(),
        second_axis_open: false,
    };
    let universal = || Relaxation {
        to: JointKind::Universal,
        axis,
        gained: Vec::new(),
        second_axis_open: true,
    };
    match kind {
        JointKind::Revolute => vec![
            to(JointKind::Cylindrical, &[(zero, axis)]),
            universal(),
            to(JointKind::Spherical, &[(e1, zero), (e2, zero)]),
        ],
        JointKind::Prismatic => vec![
            to(JointKind::Cylindrical, &[(axis, zero)]),
            to(JointKind::Translational, &[(zero, e1), (zero, e2)]),
        ],
        JointKind::Screw => vec![to(JointKind::Cylindrical, &[(zero, axis)])],
        JointKind::PlanarTranslation => vec![
            to(JointKind::Planar, &[(axis, zero)]),
            to(JointKind::Translational, &[(zero, axis)]),
        ],
        JointKind::Universal => {
            // Where the second axis points now, seen from the predecessor.
            let screws = displacement.screws(state);
            let Some(second) = screws.get(1) else {
                return Vec::new();
            };
            let third = crate::closure::cross_product(&axis, &second.angular);
            if third.iter().all(|x| x.abs() < 1e-12) {
                return Vec::new();
            }
            vec![to(JointKind::Spherical, &[(third, zero)])]
        }
        JointKind::Planar | JointKind::TranslatingScrew => {
            vec![to(JointKind::Schoenflies, &[(zero, axis)])]
        }
        _ => vec![],
    }
}

/// The direction in which a second axis meets the largest load: the leading left direction of the loads of the two
/// rotations across the axis. For other relaxations the axis itself, which is not used.
fn pick_second_axis(
    relaxation: &Relaxation,
    rank: &PartRank,
    stresses: &SelfStresses,
    joint: usize,
) -> Option<Vector<f64>> {
    if !relaxation.second_axis_open {
        return Some(relaxation.axis);
    }
    let (e1, e2) = crate::closure::across(&relaxation.axis);
    let loads = stresses.loads(rank, joint, &[(e1, [0.0; 3]), (e2, [0.0; 3])]);
    // The largest eigenvector of a symmetric 2×2 matrix of squares, in closed form.
    let (a, b, c) = (
        loads.row(0).norm_squared(),
        loads.row(0).dot(&loads.row(1)),
        loads.row(1).norm_squared(),
    );
    if !(a + c > 0.0) {
        return None;
    }
    let angle = 0.5 * (2.0 * b).atan2(a - c);
    let direction = [0, 1, 2].map(|i| angle.cos() * e1[i] + angle.sin() * e2[i]);
    // A direction within rounding of a coordinate axis is meant to be that axis.
    Some(direction.map(|x| if x.abs() < 1e-9 { 0.0 } else { x }))
}

#[allow(clippy::too_many_arguments)] // the whole problem, once more, with one joint changed
fn verified(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    part: &Part,
    rank: &PartRank,
    joint: usize,
    relaxation: &Relaxation,
    second_axis: &Vector<f64>,
    freed: usize,
) -> Result<bool, MatrixError> {
    let Some(freedom) = rank.instantaneous else {
        return Ok(false);
    };
    let relaxed = mechanism.with_kind(joint, relaxation.to);
    let mut geometry = geometry.clone();
    let mut states = states.to_vec();
    let displacement = geometry.displacements[joint].displacement(&states[joint]);
    geometry.displacements[joint] = JointDisplacement::new(
        relaxation.to,
        &relaxation.axis,
        &geometry_second_axis(&geometry, joint, relaxation, second_axis),
        &0.0,
        &0.0,
    );
    states[joint] = geometry.displacements[joint].fit(&displacement);
    let changed = jacobian(&relaxed, &geometry, &states, part)?;
    let mut matrix = changed.matrix;
    matrix.scale_columns();
    let decision = decide(&matrix, rank.decision.accuracy)?;
    Ok(decision.rank == Some(rank.unknowns() - freedom + freed))
}

/// The second axis in the successor's frame: the joint's own where it has one, else the chosen one carried over by the
/// joint's present displacement.
fn geometry_second_axis(
    geometry: &Geometry<f64>,
    joint: usize,
    relaxation: &Relaxation,
    second_axis: &Vector<f64>,
) -> Vector<f64> {
    if relaxation.second_axis_open {
        *second_axis
    } else {
        *geometry.displacements[joint].second_axis()
    }
}
