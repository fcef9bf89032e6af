//! Every configuration put to the test, whatever found it: whether its poses close all joints, and whether these are within their limits.
//!
//! Solvers solve some of the equations and conclude the others. Poses can simply be multiplied.

use super::place::Pose;
use super::{Configuration, LeftOut, Modes, Why};
use crate::placed::{Gap, Slack};
use kutzbach_closure::{Arithmetic, Geometry, nearest_turn};
use kutzbach_math::space::{length, subtract};
use kutzbach_model::mechanism::{JointId, JointKind, Mechanism};

/// What poses in doubles may leave open: angles (rad), and lengths in parts of the mechanism's size. Points of solutions are enclosed to
/// some 1e-14 of their distance; of points a thousandth of the size apart a body's far end makes 1e-11 of that.
const CLOSED: f64 = 1e-9;

/// How much more than the digits leave open at a joint poses may leave: they solve as many equations as there are unknowns with these digits,
/// and the others follow from them with a factor, the condition of the former.
const CONDITION: f64 = 100.0;

/// A mechanism, and what its joints may leave open.
pub(super) struct Test<'a> {
    mechanism: &'a Mechanism,
    geometry: Geometry<f64>,
    size: f64,
    share: f64,
}

impl<'a> Test<'a> {
    /// Of a mechanism whose numbers are known so far.
    pub(super) fn new(mechanism: &'a Mechanism, slack: &Slack) -> Self {
        let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
        let size = geometry.size_of(0..mechanism.joints().len());
        Self {
            mechanism,
            geometry,
            size: if size > 0.0 { size } else { 1.0 },
            share: CLOSED + CONDITION * slack.share,
        }
    }

    /// Leaves out what does not close, with a word about it.
    pub(super) fn leave_open_ones_out(&self, modes: &mut Modes) {
        self.leave_out(modes, |c| self.open(&c.poses));
    }

    /// Leaves out what is beyond a limit, with a word about it.
    pub(super) fn leave_those_beyond_limits_out(&self, modes: &mut Modes) {
        self.leave_out(modes, |c| self.beyond_limit(&c.poses));
    }

    fn leave_out(&self, modes: &mut Modes, why: impl Fn(&Configuration) -> Option<Why>) {
        let all = std::mem::take(&mut modes.configurations);
        for configuration in all {
            match why(&configuration) {
                None => modes.configurations.push(configuration),
                Some(why) => modes.left_out.push(LeftOut { configuration, why }),
            }
        }
    }

    /// The joint that is most open, if one is.
    fn open(&self, poses: &[Option<Pose>]) -> Option<Why> {
        let parts = |gap: &Gap| gap.radians.max(gap.metres / self.size);
        let joints = 0..self.mechanism.joints().len();
        let gaps = joints.filter_map(|joint| Some((joint, self.gap(joint, poses)?)));
        let (joint, gap) = gaps.max_by(|a, b| parts(&a.1).total_cmp(&parts(&b.1)))?;
        let open = !(parts(&gap) <= self.share);
        open.then_some(Why::Open {
            joint: JointId(joint),
            gap,
        })
    }

    /// The first joint that is beyond its limits, wherever it starts to count turns.
    fn beyond_limit(&self, poses: &[Option<Pose>]) -> Option<Why> {
        let joints = self.mechanism.joints().iter().enumerate();
        joints
            .filter_map(|(joint, described)| {
                let (lower, upper) = described.bounds()?;
                let turns = described.kind == JointKind::Revolute;
                if turns && (lower.is_infinite() || upper.is_infinite()) {
                    return None;
                }
                let state = self.geometry.displacements[joint].fit(&self.between(joint, poses)?);
                let value = nearest_turn(described, *state.values.first()?);
                let by = (value - upper).max(lower - value);
                let slack = self.share * if turns { 1.0 } else { self.size };
                (by > slack).then_some(Why::Limit {
                    joint: JointId(joint),
                    value,
                })
            })
            .next()
    }

    /// `predecessor_side_from_successor_side`; `None` where a link has no definite pose.
    fn between(&self, joint: usize, poses: &[Option<Pose>]) -> Option<Pose> {
        let [a, b] = self.sides(joint);
        let [near, far] = &self.geometry.sides[joint];
        let (a, b) = (poses[a].as_ref()?, poses[b].as_ref()?);
        Some(a.compose(near).inverse().compose(&b.compose(far)))
    }

    fn sides(&self, joint: usize) -> [usize; 2] {
        let joint = &self.mechanism.joints()[joint];
        [joint.predecessor.link.0, joint.successor.link.0]
    }

    /// By how much a joint is open: the displacement that it allows and that comes nearest, against the one that there is.
    fn gap(&self, joint: usize, poses: &[Option<Pose>]) -> Option<Gap> {
        let Some(between) = self.between(joint, poses) else {
            return self.gap_at_rod(joint, poses);
        };
        let displacement = &self.geometry.displacements[joint];
        let nearest = displacement.displacement(&displacement.fit(&between));
        let way = subtract(&between.translation, &nearest.translation);
        let turn = nearest.inverse().compose(&between).rotation_vector();
        Some(Gap {
            metres: length(&way),
            radians: length(&turn),
        })
    }

    /// Of a rod that spins between two balls: by how much these are not as far apart as the rod is long.
    fn gap_at_rod(&self, joint: usize, poses: &[Option<Pose>]) -> Option<Gap> {
        let rod = self
            .sides(joint)
            .into_iter()
            .find(|&link| poses[link].is_none())?;
        // Where its ends are in it, and in the world.
        let ends = (0..self.mechanism.joints().len())
            .filter(|&j| self.sides(j).contains(&rod))
            .map(|j| {
                let own = usize::from(self.sides(j)[1] == rod);
                let at = |side: usize| &self.geometry.sides[j][side].translation;
                let other = poses[self.sides(j)[1 - own]].as_ref()?;
                let ball = self.mechanism.joints()[j].kind == JointKind::Spherical;
                ball.then(|| [*at(own), other.apply(at(1 - own))])
            });
        let ends: Vec<[[f64; 3]; 2]> = ends.collect::<Option<_>>()?;
        let [one, other] = ends.as_slice() else {
            return None;
        };
        let [own, there] = [0, 1].map(|i| length(&subtract(&one[i], &other[i])));
        Some(Gap {
            metres: (own - there).abs(),
            radians: 0.0,
        })
    }
}
