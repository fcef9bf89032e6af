//! Whether a motion shows itself: a rod that spins about the line through its balls moves nothing that a person could point at.

use super::curve::Curve;
use kutzbach_closure::{Geometry, Rigid};
use kutzbach_mobility::Branch;
use kutzbach_model::mechanism::{JointKind, Mechanism};

/// Poses along a curve that are compared with its first.
const LOOKED_AT: usize = 16;

/// A pose differs from here on (rad, lengths of the part): poses are closed to rounding, of which a shaky pose is off by the root.
const DIFFERENT: f64 = 1e-6;

/// The links that do not show their motion on a branch: rods and legs that spin idle, and those that only balls hold, as far as their balls stay.
pub(super) struct Hidden {
    idle: Vec<bool>,
    /// For links that two balls or more hold and nothing else: the balls' centres (m, the link's frame).
    balls: Vec<Option<Vec<[f64; 3]>>>,
}

impl Hidden {
    pub fn new(mechanism: &Mechanism, geometry: &Geometry<f64>, branch: &Branch) -> Self {
        let links = mechanism.links().len();
        let mut idle = vec![false; links];
        for entry in branch.idle.iter().filter(|entry| entry.rod) {
            for &link in std::iter::once(&entry.link).chain(&entry.with) {
                idle[link] = true;
            }
        }
        let mut balls = vec![Some(Vec::new()); links];
        for (joint, sides) in mechanism.joints().iter().zip(&geometry.sides) {
            for (end, side) in [&joint.predecessor, &joint.successor].iter().zip(sides) {
                match (joint.kind, &mut balls[end.link.0]) {
                    (JointKind::Spherical | JointKind::Distance, Some(known)) => {
                        known.push(side.translation);
                    }
                    (_, known) => *known = None,
                }
            }
        }
        for known in &mut balls {
            *known = known.take().filter(|centres| centres.len() > 1);
        }
        Self { idle, balls }
    }

    /// Whether a link is seen to have moved between two poses of it.
    fn is_seen(&self, link: usize, from: &Rigid<f64>, to: &Rigid<f64>, length: f64) -> bool {
        let apart = |a: &[f64; 3], b: &[f64; 3]| {
            let off = [0, 1, 2].map(|i| a[i] - b[i]);
            off.iter().map(|x| x * x).sum::<f64>().sqrt() > DIFFERENT * length
        };
        match &self.balls[link] {
            Some(centres) => centres
                .iter()
                .any(|centre| apart(&from.apply(centre), &to.apply(centre))),
            None => {
                let turn = from.inverse().compose(to).rotation_vector();
                let turned = turn.iter().map(|x| x * x).sum::<f64>().sqrt() > DIFFERENT;
                turned || apart(&from.translation, &to.translation)
            }
        }
    }

    /// Whether something is seen to move along a curve.
    pub fn is_shown(&self, curve: &Curve) -> bool {
        let length = curve.length_unit();
        let mut poses = curve
            .nodes
            .iter()
            .step_by(1 + curve.nodes.len() / LOOKED_AT)
            .map(|node| curve.link_poses(&node.pose));
        let Some(first) = poses.next() else {
            return false;
        };
        poses.any(|there| {
            let mut links = first.iter().zip(&there).enumerate();
            links.any(|(link, (from, to))| !self.idle[link] && self.is_seen(link, from, to, length))
        })
    }

    /// Whether a joint has a side on a rod that spins idle.
    pub fn touches(&self, mechanism: &Mechanism, joint: usize) -> bool {
        let joint = &mechanism.joints()[joint];
        [&joint.predecessor, &joint.successor]
            .iter()
            .any(|end| self.idle[end.link.0])
    }
}
