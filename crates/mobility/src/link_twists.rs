//! How every link moves along each tangent of a branch at one of its poses.

use super::branch::BranchPose;
use super::tangent_space::{Limits, TangentSpace};
use kutzbach_closure::Structure;
use kutzbach_closure::{Geometry, Rigid, spanning_poses};
use kutzbach_math::group::Twist;
use kutzbach_model::mechanism::Mechanism;
use nalgebra::{Matrix3, Vector3};

/// The twists of all links.
///
/// They are taken about the centroid of the joints, not about the world's origin, so that a mechanism far from the origin
/// loses no digits. One pass over the spanning tree: linear in links × tangents.
#[derive(Clone, Debug)]
pub(super) struct LinkTwists {
    /// The tangents the twists belong to.
    pub tangents: TangentSpace,
    /// Limits for singular values of twists, rotations in radians and translations in lengths of the mechanism.
    pub limits: Limits,
    /// RMS distance of the joints from their centroid (m).
    pub length: f64,
    /// The centroid, in the world (m).
    centre: Vector3<f64>,
    /// `world_from_link` of every link.
    poses: Vec<Rigid<f64>>,
    /// Of every link along every tangent: world directions, velocity of the point at the centre.
    twists: Vec<Vec<Twist>>,
    /// The link that a link's connected piece is placed by.
    pieces: Vec<usize>,
}

impl LinkTwists {
    /// `None` where numbers leave their range or the pose belongs to another mechanism.
    pub fn at(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        structure: &Structure,
        pose: &BranchPose,
    ) -> Option<Self> {
        if pose.states.len() != mechanism.joints().len() {
            return None;
        }
        let tangents = TangentSpace::at(mechanism, geometry, structure, pose)?;
        let (poses, in_tree) = spanning_poses(mechanism, geometry, &pose.states);
        let (centre, length, farthest) = extent(mechanism, geometry, &poses);
        if !length.is_finite() || !centre.iter().all(|x| x.is_finite()) {
            return None;
        }
        let limits = Limits::new(
            tangents.limits.error * (1.0 + farthest / length),
            tangents.basis.first().map_or(1, Vec::len),
        );
        let mut found = Self {
            limits,
            length,
            centre,
            twists: vec![Vec::new(); poses.len()],
            pieces: vec![usize::MAX; poses.len()],
            poses,
            tangents,
        };
        found.walk(mechanism, geometry, pose, &in_tree);
        let finite = found.twists.iter().flatten().all(Twist::is_finite);
        finite.then_some(found)
    }

    fn walk(
        &mut self,
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        pose: &BranchPose,
        in_tree: &[bool],
    ) {
        let joints = mechanism.joints();
        let mut incident = vec![Vec::new(); self.poses.len()];
        for (index, joint) in joints.iter().enumerate().filter(|(i, _)| in_tree[*i]) {
            incident[joint.predecessor.link.0].push(index);
            incident[joint.successor.link.0].push(index);
        }
        let count = self.tangents.basis.len();
        let starts = std::iter::once(mechanism.ground().0).chain(0..self.poses.len());
        for start in starts {
            if self.pieces[start] != usize::MAX {
                continue;
            }
            self.pieces[start] = start;
            self.twists[start] = vec![Twist::zero(); count];
            let mut stack = vec![start];
            while let Some(link) = stack.pop() {
                for &index in &incident[link] {
                    let joint = &joints[index];
                    let forward = joint.predecessor.link.0 == link;
                    let other = if forward {
                        joint.successor.link.0
                    } else {
                        joint.predecessor.link.0
                    };
                    if self.pieces[other] != usize::MAX {
                        continue;
                    }
                    let screws = self.screws(mechanism, geometry, pose, index);
                    let sign = if forward { 1.0 } else { -1.0 };
                    self.twists[other] = (0..count)
                        .map(|vector| {
                            let variables = self.tangents.variables(index);
                            screws.iter().zip(variables).fold(
                                self.twists[link][vector],
                                |sum, (screw, variable)| {
                                    sum + *screw * (sign * self.tangents.rate(vector, variable))
                                },
                            )
                        })
                        .collect();
                    self.pieces[other] = start;
                    stack.push(other);
                }
            }
        }
    }

    /// Unit twists of a joint's variables about the centre: the successor's motion relative to the predecessor.
    fn screws(
        &self,
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        pose: &BranchPose,
        joint: usize,
    ) -> Vec<Twist> {
        let predecessor = mechanism.joints()[joint].predecessor.link.0;
        let frame = self.poses[predecessor].compose(&geometry.sides[joint][0]);
        geometry.displacements[joint]
            .screws(&pose.states[joint])
            .iter()
            .map(|screw| {
                let (angular, linear) = screw.moved(&frame).about(&self.centre.into());
                Twist::new(angular.into(), linear.into())
            })
            .collect()
    }

    /// Whether a chain of joints leads from one link to the other.
    pub fn connected(&self, a: usize, b: usize) -> bool {
        self.pieces[a] == self.pieces[b]
    }

    /// The centre in the frame of a link (m).
    pub fn centre_in(&self, link: usize) -> Vector3<f64> {
        let (rotation, translation) = parts(&self.poses[link]);
        rotation.transpose() * (self.centre - translation)
    }

    /// Twists of a link relative to another along every tangent, in the other's directions, velocities taken at `point` of
    /// the other's frame.
    pub fn relative(&self, link: usize, to: usize, point: &Vector3<f64>) -> Vec<Twist> {
        let (rotation, translation) = parts(&self.poses[to]);
        let shift = rotation * point + translation - self.centre;
        let back = rotation.transpose();
        self.twists[link]
            .iter()
            .zip(&self.twists[to])
            .map(|(own, other)| {
                let twist = *own - *other;
                Twist::new(back * twist.angular, back * twist.velocity_at(&shift))
            })
            .collect()
    }

    /// Coordinates (rad, lengths of the mechanism) of a link's twist along a combination of the tangents.
    pub fn along(&self, link: usize, combination: &[f64]) -> [f64; 6] {
        let sum = self.twists[link]
            .iter()
            .zip(combination)
            .fold(Twist::zero(), |sum, (twist, weight)| sum + *twist * *weight);
        coordinates(&sum, self.length)
    }
}

/// A twist as six numbers of like size.
pub(super) fn coordinates(twist: &Twist, length: f64) -> [f64; 6] {
    let (w, v) = (twist.angular, twist.linear / length);
    [w.x, w.y, w.z, v.x, v.y, v.z]
}

fn parts(pose: &Rigid<f64>) -> (Matrix3<f64>, Vector3<f64>) {
    let rotation = Matrix3::from_fn(|i, j| pose.rotation[i][j]);
    (rotation, pose.translation.into())
}

/// Centroid of the joints, their RMS distance from it, and the largest one (m). Where all joints are in one place any
/// length will do.
fn extent(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    poses: &[Rigid<f64>],
) -> (Vector3<f64>, f64, f64) {
    let points: Vec<Vector3<f64>> = mechanism
        .joints()
        .iter()
        .zip(&geometry.sides)
        .map(|(joint, sides)| {
            let link = joint.predecessor.link.0;
            poses[link].apply(&sides[0].translation).into()
        })
        .collect();
    let count = points.len().max(1) as f64;
    let centre = points.iter().sum::<Vector3<f64>>() / count;
    let distances: Vec<f64> = points.iter().map(|point| (point - centre).norm()).collect();
    let spread = (distances.iter().map(|d| d * d).sum::<f64>() / count).sqrt();
    let farthest = distances.iter().fold(0.0, |m: f64, d| m.max(*d));
    let least = geometry.least_length();
    let length = if spread > least {
        spread
    } else if geometry.size > least {
        geometry.size
    } else {
        1.0
    };
    (centre, length, farthest)
}
