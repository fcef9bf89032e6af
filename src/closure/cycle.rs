//! One cycle of the constraint graph, walked joint by joint.
//!
//! The walk starts in the frame of the cycle's first link, so nothing depends on where the mechanism stands in the world,
//! nor on how far the cycle is from the ground: a chain of ten thousand loops keeps the digits of a single one.

use super::displacement::JointState;
use super::geometry::{Geometry, Uncertainty};
use super::rigid::{self, PlacedScrew, Rigid, Vector};
use crate::matrix::Real;

/// A cycle as the closure module sees it: joints in order, and whether each is passed from predecessor to successor.
pub type Walk = [(usize, bool)];

/// The screws of one joint of a cycle, in the frame of the cycle's first link.
#[derive(Clone, Debug)]
pub struct WalkedJoint<R> {
    /// Index of the joint.
    pub joint: usize,
    /// Whether the walk passes from predecessor to successor; the screws count negative otherwise.
    pub forward: bool,
    /// One screw per variable.
    pub screws: Vec<PlacedScrew<R>>,
    /// The predecessor's joint frame.
    pub frame: Rigid<R>,
}

/// What a walk around a cycle finds.
#[derive(Clone, Debug)]
pub struct WalkedCycle<R> {
    /// The joints in order.
    pub joints: Vec<WalkedJoint<R>>,
    /// What is left after going round: identity when the cycle closes.
    pub closure: Rigid<R>,
    /// A point near the cycle's axes (m, in the frame of its first link): the least-squares point of the axes.
    pub centre: [f64; 3],
    /// The cycle's own length scale (m): RMS distance of its axes to the centre; see [`characteristic_length`].
    pub length: f64,
    /// Largest coordinate met (m): rounding errors of positions are proportional to it.
    pub reach: f64,
    /// Largest distance of a joint from the centre (m): a wrong angle at one joint moves the others by up to that much.
    pub extent: f64,
    /// What the stated precision leaves open of the cycle's joints together.
    pub uncertainty: Uncertainty,
}

impl<R: Real> WalkedCycle<R> {
    /// Walks around a cycle at given joint states.
    pub fn walk(geometry: &Geometry<R>, states: &[JointState<R>], cycle: &Walk) -> Self {
        let mut pose = Rigid::identity(&geometry.one);
        let mut joints = Vec::with_capacity(cycle.len());
        let mut reach = 0.0f64;
        let far = |p: &Vector<R>| p.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        for &(joint, forward) in cycle {
            let [predecessor, successor] = &geometry.sides[joint];
            let displacement = geometry.displacements[joint].displacement(&states[joint]);
            reach = reach
                .max(far(&predecessor.translation))
                .max(far(&successor.translation));
            let joint_frame = if forward {
                let frame = pose.compose(predecessor);
                pose = frame.compose(&displacement).compose(&successor.inverse());
                frame
            } else {
                let frame = pose.compose(successor).compose(&displacement.inverse());
                pose = frame.compose(&predecessor.inverse());
                frame
            };
            reach = reach.max(far(&joint_frame.translation));
            let screws = geometry.displacements[joint]
                .screws(&states[joint])
                .iter()
                .map(|screw| screw.moved(&joint_frame))
                .collect();
            joints.push(WalkedJoint {
                joint,
                forward,
                screws,
                frame: joint_frame,
            });
        }
        let uncertainty = Uncertainty::total(
            cycle
                .iter()
                .map(|(joint, _)| &geometry.uncertainties[*joint]),
        );
        let (centre, length) = characteristic_length(
            joints.iter().flat_map(|j| &j.screws),
            reach.max(geometry.size),
            geometry.least_length(),
            &uncertainty,
        );
        let extent = joints
            .iter()
            .map(|joint| {
                let point = joint.frame.translation.clone().map(|x| x.to_f64());
                rigid::length(&rigid::subtract(&point, &centre))
            })
            .fold(0.0, f64::max);
        Self {
            joints,
            closure: pose,
            centre,
            length,
            reach,
            extent,
            uncertainty,
        }
    }

    /// The six closure equations' value, about the centre: rotation vector (rad), then displacement of the centre in
    /// units of the cycle's length.
    pub fn residual(&self) -> [R; 6] {
        let like = &self.closure.translation[0];
        let centre = self.centre.map(|x| like.constant(x));
        let inverse = like.one_like() / like.constant(self.length);
        let rotation = self.closure.rotation_vector();
        let moved = self.closure.apply(&centre);
        let [a, b, c] = rotation;
        let [x, y, z] = [0, 1, 2].map(|i| (moved[i].clone() - centre[i].clone()) * inverse.clone());
        [a, b, c, x, y, z]
    }

    /// The column of one variable in the cycle's six rows: the screw about the centre, lengths in units of the cycle's
    /// own, negative where the joint is passed backward.
    pub fn column(&self, joint: &WalkedJoint<R>, screw: &PlacedScrew<R>) -> [R; 6] {
        let like = &self.closure.translation[0];
        let centre = self.centre.map(|x| like.constant(x));
        let inverse = like.one_like() / like.constant(self.length);
        let (angular, linear) = screw.about(&centre);
        let [x, y, z] = linear.map(|v| v * inverse.clone());
        let [a, b, c] = angular;
        let column = [a, b, c, x, y, z];
        if joint.forward {
            column
        } else {
            column.map(|v| -v)
        }
    }
}

/// The least-squares point of a set of axes and the RMS distance of the axes to it (m).
///
/// The point minimises `Σ |(I − u uᵀ)(c − p)|²`. Where that leaves a direction open (all axes parallel) it stays at the
/// mean of the axis points along that direction. Where no length is left because all axes meet in a point, as far as
/// rounding and stated precision let that be seen, the size of the set of axis points serves, then the RMS pitch, then
/// `reach`, the largest coordinate met (m); finally 1 m. What is not above `least` (m) is no length but rounding.
pub fn characteristic_length<'a, R: Real + 'a>(
    screws: impl Iterator<Item = &'a PlacedScrew<R>>,
    reach: f64,
    least: f64,
    uncertainty: &Uncertainty,
) -> ([f64; 3], f64) {
    use nalgebra::{Matrix3, Vector3};
    // All lengths below are in units of the reach, so that squares stay in the range of numbers.
    let unit = if reach > least && reach.is_finite() {
        reach
    } else {
        1.0
    };
    let axes: Vec<(Vector3<f64>, Vector3<f64>, f64)> = screws
        .filter_map(|screw| {
            let u = Vector3::from(screw.angular.clone().map(|x| x.to_f64()));
            let p = Vector3::from(screw.point.clone().map(|x| x.to_f64() / unit));
            let l = Vector3::from(screw.linear.clone().map(|x| x.to_f64() / unit));
            (u.norm() > 0.5 && p.iter().all(|x| x.is_finite()))
                .then(|| (u.normalize(), p, l.norm()))
        })
        .collect();
    if axes.is_empty() {
        // Translations only: the rank has no length in it, and any positive one will do.
        return ([0.0; 3], unit);
    }
    let count = axes.len() as f64;
    let mean = axes.iter().map(|(_, p, _)| p).sum::<Vector3<f64>>() / count;
    let mut normal = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for (u, p, _) in &axes {
        let across = Matrix3::identity() - u * u.transpose();
        normal += across;
        right += across * (p - mean);
    }
    // Directions the axes leave open have an eigenvalue of zero; 1e-6 of the count is far above rounding and far below
    // what two axes that differ visibly in direction contribute, and a small shift of the centre does no harm.
    let damped = normal + Matrix3::identity() * (1e-6 * count);
    let centre = damped
        .try_inverse()
        .map_or(mean, |inverse| mean + inverse * right);
    let rms = |distances: &mut dyn Iterator<Item = f64>| {
        (distances.map(|d| d * d).sum::<f64>() / count).sqrt()
    };
    let size = axes
        .iter()
        .map(|(_, p, _)| (p - centre).norm())
        .fold(0.0, f64::max);
    let spread = rms(&mut axes.iter().map(|(u, p, _)| (p - centre).cross(u).norm()));
    let pitch = rms(&mut axes.iter().map(|(_, _, pitch)| *pitch));
    // What is not far above an error of the axes' places is no length of the mechanism. The damping moves the centre by
    // up to a millionth of the size; rounding moves points by 1e-16 of the reach; numbers as they are stated move axes
    // by about their uncertainty together, of which four times is hardly ever exceeded.
    let places = (4.0 * uncertainty.lengths).max(least) / unit;
    let tilts = 4.0 * uncertainty.angles * size;
    let length = [
        (spread, (1e-3 * size).max(places + tilts)),
        (size, places),
        (pitch, places),
        (1.0, 0.0),
    ]
    .into_iter()
    .find(|(length, least)| *length > *least && *length > 1e-9 && length.is_finite())
    .map_or(1.0, |(length, _)| length);
    ((centre * unit).into(), length * unit)
}
