//! Joints relaxed by a step: a revolute joint that may slide too, a slider that may turn.

use super::pose_rank::PartRank;
use kutzbach_closure::{
    Geometry, JointDisplacement, JointState, Part, PlacedScrew, Vector, across, linearised,
};
use kutzbach_math::matrix::{MatrixError, decide, decide_by_qr};
use kutzbach_model::mechanism::JointKind;

/// Above this many unknowns a sparse factorisation verifies sooner than singular values do.
const DENSE_UNKNOWNS: usize = 40;

/// A way to relax a joint: the kind it becomes and the screws it gains, in its own frame.
pub(super) struct Relaxation {
    pub to: JointKind,
    pub axis: Vector<f64>,
    gained: Vec<(Vector<f64>, Vector<f64>)>,
    /// The gained screw is a rotation about a direction still to be chosen, perpendicular to the axis.
    pub second_axis_open: bool,
}

impl Relaxation {
    /// The second axes to choose from, two that a person can place; the axis itself, which is not used, where none is open.
    pub fn second_axes(&self) -> Vec<Vector<f64>> {
        if self.second_axis_open {
            let (first, second) = across(&self.axis);
            vec![first, second]
        } else {
            vec![self.axis]
        }
    }

    /// The screws it gains, in the joint's frame on the predecessor.
    pub fn screws(&self, second_axis: &Vector<f64>) -> Vec<(Vector<f64>, Vector<f64>)> {
        if self.second_axis_open {
            vec![(*second_axis, [0.0; 3])]
        } else {
            self.gained.clone()
        }
    }
}

/// What a joint may become in small steps, each of which a designer knows how to build. No step gains more than two freedoms.
pub(super) fn relaxations(
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
            let third = kutzbach_closure::cross_product(&axis, &second.angular);
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

/// What a joint may become beyond [`relaxations`], where those do not reach far enough: the contacts of a ball in a slot or on a
/// plane, and of a line on a plane. Each contains all that the joint does now. (kind, axis, second axis), both directions as the
/// joint stands, in the frame on the predecessor.
pub(super) fn contacts(
    kind: JointKind,
    displacement: &JointDisplacement<f64>,
    state: &JointState<f64>,
) -> Vec<(JointKind, Vector<f64>, Vector<f64>)> {
    let axis = *displacement.axis();
    let frame = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let [along, first, second] = if axis == [0.0; 3] {
        frame
    } else {
        let (first, second) = across(&axis);
        [axis, first, second]
    };
    let with = |to, second_axes: &[Vector<f64>]| -> Vec<_> {
        second_axes
            .iter()
            .map(|second| (to, along, *second))
            .collect()
    };
    let ball_in_slot = |slots: &[Vector<f64>]| with(JointKind::PointOnLine, slots);
    let ball_on_plane = |normals: &[Vector<f64>]| with(JointKind::PointOnPlane, normals);
    let across_axis = [first, second];
    match kind {
        JointKind::Revolute => [
            with(JointKind::Planar, &[along]),
            with(JointKind::LineOnPlane, &across_axis),
            ball_in_slot(&[along, first, second]),
            ball_on_plane(&[along, first, second]),
        ]
        .concat(),
        JointKind::Universal | JointKind::Spherical => {
            let all = [along, first, second];
            [ball_in_slot(&all), ball_on_plane(&all)].concat()
        }
        JointKind::Prismatic => {
            let planes = across_axis.iter().flat_map(|normal| {
                [JointKind::PlanarTranslation, JointKind::Planar].map(|to| (to, *normal, along))
            });
            let balls = [ball_in_slot(&[along]), ball_on_plane(&across_axis)].concat();
            planes.chain(balls).collect()
        }
        JointKind::Cylindrical => [
            ball_in_slot(&[along]),
            with(JointKind::LineOnPlane, &across_axis),
            ball_on_plane(&across_axis),
        ]
        .concat(),
        JointKind::Screw => [ball_in_slot(&[along]), ball_on_plane(&across_axis)].concat(),
        JointKind::PlanarTranslation | JointKind::Planar => ball_on_plane(&[along]),
        JointKind::LineOnPlane | JointKind::PointOnLine => {
            let there = displacement.displacement(state);
            let second_axis = there.rotate(displacement.second_axis());
            if kind == JointKind::LineOnPlane {
                ball_on_plane(&[second_axis])
            } else {
                let (first, second) = across(&second_axis);
                ball_on_plane(&[first, second])
            }
        }
        _ => Vec::new(),
    }
}

/// A joint of another kind standing where the joint stands. The second axis is in the predecessor's frame.
pub(super) fn standing_there(
    joint: &JointDisplacement<f64>,
    state: &JointState<f64>,
    (to, axis, second_axis): (JointKind, &Vector<f64>, &Vector<f64>),
) -> Relaxed {
    let reached = joint.displacement(state);
    let axis2 = reached.rotate_back(second_axis);
    let displacement = JointDisplacement::new(to, axis, &axis2, &0.0, &0.0);
    let state = displacement.fit(&reached);
    Relaxed {
        displacement,
        state,
    }
}

impl Relaxation {
    /// The relaxed joint standing where the joint stands. The second axis is in the predecessor's frame.
    pub fn apply(
        &self,
        joint: &JointDisplacement<f64>,
        state: &JointState<f64>,
        second_axis: &Vector<f64>,
    ) -> Relaxed {
        standing_there(joint, state, (self.to, &self.axis, second_axis))
    }
}

/// A relaxed joint and where it stands.
#[derive(Clone)]
pub(super) struct Relaxed {
    pub displacement: JointDisplacement<f64>,
    state: JointState<f64>,
}

impl Relaxed {
    /// One screw for each of its freedoms, where it stands, in the joint's frame on the predecessor.
    pub fn screws(&self) -> Vec<PlacedScrew<f64>> {
        self.displacement.screws(&self.state)
    }

    /// Exchanges this with what a joint is.
    fn exchange(
        &mut self,
        joint: usize,
        geometry: &mut Geometry<f64>,
        states: &mut [JointState<f64>],
    ) {
        std::mem::swap(&mut geometry.displacements[joint], &mut self.displacement);
        std::mem::swap(&mut states[joint], &mut self.state);
    }
}

/// Whether with these in the place of their joints, each of which is named once, the rank rises by as much as is freed: the
/// mobility stays. Geometry and states are as they were afterwards.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn mobility_stays(
    changes: &mut [(usize, Relaxed)],
    geometry: &mut Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    rank: &PartRank,
    freed: usize,
) -> Result<bool, MatrixError> {
    let Some(freedom) = rank.instantaneous else {
        return Ok(false);
    };
    for (joint, relaxed) in &mut *changes {
        relaxed.exchange(*joint, geometry, states);
    }
    let changed = linearised(geometry, states, part);
    for (joint, relaxed) in changes {
        relaxed.exchange(*joint, geometry, states);
    }
    let mut matrix = changed?.matrix;
    matrix.scale_columns();
    let accuracy = rank.decision.accuracy.max(rank.accuracy);
    let decision = if matrix.columns() > DENSE_UNKNOWNS {
        decide_by_qr(&matrix, accuracy)?.0
    } else {
        decide(&matrix, accuracy)?
    };
    Ok(decision.rank == Some(rank.unknowns() - freedom + freed))
}
