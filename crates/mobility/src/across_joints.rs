//! Links that one joint joins, directly or through what moves with them as one body.
//!
//! Such links move relative to one another as the joint lets them, in any file: a hinge on the ground is a rotation about its
//! own axis, whatever the digits of the loops it is in. Bodies are links that fixed and locked joints hold together.

use super::link_twists::{LinkTwists, parts};
use super::relative_motion::tidied;
use super::roles::JointRole;
use kutzbach_closure::Geometry;
use kutzbach_math::group::{Axis, DisplacementSubgroup, normalised_direction};
use kutzbach_model::mechanism::{JointKind, Mechanism};
use nalgebra::Vector3;
use petgraph::unionfind::UnionFind;
use std::collections::BTreeMap;

/// What holds two links together.
pub(super) enum Between {
    /// More than one joint, or no joint at all.
    Nothing,
    /// They are one body.
    Rigid,
    /// This joint; of several the one of least freedom.
    Joint(usize),
}

/// The joints between bodies.
pub(super) struct AcrossJoints<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    roles: &'a [JointRole],
    at: &'a LinkTwists,
    body: Vec<usize>,
    joints: BTreeMap<(usize, usize), usize>,
}

impl<'a> AcrossJoints<'a> {
    /// The joints of a branch on which they have these roles, with one of its poses.
    pub fn new(
        mechanism: &'a Mechanism,
        geometry: &'a Geometry<f64>,
        roles: &'a [JointRole],
        at: &'a LinkTwists,
    ) -> Self {
        let ends = |joint: usize| {
            let joint = &mechanism.joints()[joint];
            (joint.predecessor.link.0, joint.successor.link.0)
        };
        let mut bodies = UnionFind::<usize>::new(mechanism.links().len());
        for (index, joint) in mechanism.joints().iter().enumerate() {
            if joint.freedom() == 0 || roles[index].locked == Some(true) {
                let (a, b) = ends(index);
                bodies.union(a, b);
            }
        }
        let body = bodies.into_labeling();
        let mut joints: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for index in 0..mechanism.joints().len() {
            let (a, b) = ends(index);
            let (a, b) = (body[a].min(body[b]), body[a].max(body[b]));
            if a == b {
                continue;
            }
            let rank = |joint: usize| {
                let joint = &mechanism.joints()[joint];
                (joint.freedom(), joint.name.as_str())
            };
            let known = joints.entry((a, b)).or_insert(index);
            if rank(index) < rank(*known) {
                *known = index;
            }
        }
        Self {
            mechanism,
            geometry,
            roles,
            at,
            body,
            joints,
        }
    }

    /// What holds two links together.
    pub fn between(&self, a: usize, b: usize) -> Between {
        let (a, b) = (self.body[a], self.body[b]);
        if a == b {
            return Between::Rigid;
        }
        self.joints
            .get(&(a.min(b), a.max(b)))
            .map_or(Between::Nothing, |joint| Between::Joint(*joint))
    }

    /// Whether a joint certainly moves along the branch.
    pub fn moves(&self, joint: usize) -> bool {
        let role = &self.roles[joint];
        role.locked == Some(false) && role.locked_parts.is_empty()
    }

    /// The subgroup that a joint allows, in the frame of a link of one of its bodies; `None` where what it allows is none.
    pub fn subgroup(&self, joint: usize, seen_from: usize) -> Option<DisplacementSubgroup> {
        use DisplacementSubgroup as G;
        let of = &self.mechanism.joints()[joint];
        let states = self.geometry.displacements[joint].at(&vec![0.0; of.freedom()]);
        let screws = self.geometry.displacements[joint].screws(&states);
        let screw = screws.first()?;
        let (rotation, translation) = self.placed(joint, seen_from);
        let turned = |v: &[f64; 3]| rotation * Vector3::from(*v);
        let point = turned(&screw.point) + translation;
        let along = match turned(&screw.angular) {
            turn if turn.norm() > 0.5 => turn,
            _ => turned(&screw.linear),
        };
        let axis = || Axis::through(point, along);
        let found = match of.kind {
            JointKind::Revolute => G::Rotation { axis: axis()? },
            JointKind::Prismatic => G::Translation {
                direction: normalised_direction(along)?,
            },
            JointKind::Screw => G::Helical {
                axis: axis()?,
                pitch: turned(&screw.linear).dot(&along) / along.norm_squared(),
            },
            JointKind::Cylindrical => G::Cylindrical { axis: axis()? },
            JointKind::Spherical => G::Spherical { centre: point },
            JointKind::Translational => return Some(G::SpatialTranslation),
            _ => return None,
        };
        Some(tidied(found, 1e-12, self.at.length))
    }

    /// Rotation and translation from the joint's frame to that of a link of one of its bodies.
    fn placed(&self, joint: usize, link: usize) -> (nalgebra::Matrix3<f64>, Vector3<f64>) {
        let of = &self.mechanism.joints()[joint];
        let sides = &self.geometry.sides[joint];
        // What the joint leaves in place has the same coordinates on both sides.
        let (near, side) = match () {
            () if of.predecessor.link.0 == link => return parts(&sides[0]),
            () if of.successor.link.0 == link => return parts(&sides[1]),
            () if self.body[of.predecessor.link.0] == self.body[link] => {
                (of.predecessor.link.0, &sides[0])
            }
            () => (of.successor.link.0, &sides[1]),
        };
        let (near_turn, near_at) = self.at.link_pose(near);
        let (turn, at) = self.at.link_pose(link);
        let (side_turn, side_at) = parts(side);
        let back = turn.transpose();
        (
            back * near_turn * side_turn,
            back * (near_turn * side_at + near_at - at),
        )
    }
}
