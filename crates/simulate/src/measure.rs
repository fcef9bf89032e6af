//! What can be measured of a world.

use super::options::{Energy, JointGap};
use super::world::World;
use kutzbach_closure::{Geometry, JointDisplacement, JointState, Rigid};
use kutzbach_model::mechanism::{FreedomPart, JointKind, Mechanism};

impl World {
    /// How every joint stands: its displacement fitted into its set. Angles about fixed axes are continued from `before`
    /// over whole turns; balls are given by the shortest rotation.
    #[must_use]
    pub fn states(&self, before: &[JointState<f64>]) -> Vec<JointState<f64>> {
        let poses = self.link_poses();
        let joints = self.displacements.iter().enumerate();
        joints
            .map(|(joint, displacement)| {
                stands(
                    displacement,
                    &self.relative(&poses, joint),
                    before.get(joint),
                )
            })
            .collect()
    }

    /// For every joint, how far its two frames are from what it allows.
    #[must_use]
    pub fn gaps(&self) -> Vec<JointGap> {
        let poses = self.link_poses();
        let joints = self.displacements.iter().enumerate();
        joints
            .map(|(joint, displacement)| gap_of(displacement, &self.relative(&poses, joint)))
            .collect()
    }

    fn relative(&self, poses: &[Rigid<f64>], joint: usize) -> Rigid<f64> {
        let [p, s] = [0, 1].map(|i| poses[self.ends[joint][i]].compose(&self.sides[joint][i]));
        p.inverse().compose(&s)
    }

    /// Kinetic and potential energy of all links and intermediate bodies but the ground.
    #[must_use]
    pub fn energy(&self) -> Energy {
        let mut energy = Energy::default();
        let gravity = self.physics.gravity;
        for (body, mass) in self.built.masses.iter().enumerate() {
            let Some(mass) = mass else { continue };
            let (linear, angular) = self.body_velocity(body);
            let pose = self.body_pose(body);
            let local = pose.rotation.inverse() * angular;
            let spin = nalgebra::Vector3::new(local.x, local.y, local.z);
            energy.kinetic += 0.5
                * (mass.mass / self.units.mass * linear.length_squared()
                    + (spin.transpose() * (mass.inertia / self.units.moment()) * spin)[0]);
            energy.potential -= mass.mass / self.units.mass * gravity.dot(pose.translation);
        }
        energy.kinetic *= self.units.moment();
        energy.potential *= self.units.moment();
        energy
    }

    /// Number of pairs of shapes that touch.
    #[must_use]
    pub fn contacts(&self) -> usize {
        let pairs = self.physics.narrow_phase.contact_pairs();
        pairs.filter(|pair| pair.has_any_active_contact()).count()
    }

    /// [`Self::limit_violations_of`] where the world stands now, angles taken within half a turn of the start pose.
    #[must_use]
    pub fn limit_violations(&self) -> Vec<(usize, f64)> {
        self.limit_violations_of(&self.states(&self.start))
    }

    /// By how much every joint with a `<limit>` is beyond it (m, rad) in given states; zero within. Measured whether limits
    /// are simulated or not; joints without a limit are left out.
    #[must_use]
    pub fn limit_violations_of(&self, states: &[JointState<f64>]) -> Vec<(usize, f64)> {
        beyond(self.limits.iter().copied(), states)
    }
}

fn beyond(
    limits: impl Iterator<Item = Option<[f64; 2]>>,
    states: &[JointState<f64>],
) -> Vec<(usize, f64)> {
    let joints = limits.zip(states).enumerate();
    joints
        .filter_map(|(joint, (limit, state))| {
            let [lower, upper] = limit?;
            let value = *state.values.first()?;
            Some((joint, (lower - value).max(value - upper).max(0.0)))
        })
        .collect()
}

/// [`World::limit_violations_of`] without a world.
pub(super) fn limit_violations(
    mechanism: &Mechanism,
    states: &[JointState<f64>],
) -> Vec<(usize, f64)> {
    let joints = mechanism.joints().iter();
    beyond(
        joints.map(|joint| joint.bounds().map(<[f64; 2]>::from)),
        states,
    )
}

/// [`World::states`] of links in given poses (`world_from_link`, by link index).
pub(super) fn joint_states(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    links: &[Rigid<f64>],
    before: &[JointState<f64>],
) -> Vec<JointState<f64>> {
    let joints = geometry.displacements.iter().enumerate();
    joints
        .map(|(joint, displacement)| {
            let relative = relative(mechanism, geometry, links, joint);
            stands(displacement, &relative, before.get(joint))
        })
        .collect()
}

fn stands(
    displacement: &JointDisplacement<f64>,
    relative: &Rigid<f64>,
    before: Option<&JointState<f64>>,
) -> JointState<f64> {
    let fitted = displacement.fit(relative);
    match before {
        Some(before) => continued(displacement, &fitted, before),
        None => fitted,
    }
}

/// The successor's joint frame seen from the predecessor's.
fn relative(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    links: &[Rigid<f64>],
    joint: usize,
) -> Rigid<f64> {
    let (of, sides) = (&mechanism.joints()[joint], &geometry.sides[joint]);
    let ends = [of.predecessor.link.0, of.successor.link.0];
    let [p, s] = [0, 1].map(|i| links[ends[i]].compose(&sides[i]));
    p.inverse().compose(&s)
}

/// For every joint, how far its two frames are from what it allows where the links are in given poses (`world_from_link`, by
/// link index): the yardstick of [`World::gaps`], for poses that come from elsewhere.
#[must_use]
pub fn joint_gaps(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    links: &[Rigid<f64>],
) -> Vec<JointGap> {
    let joints = geometry.displacements.iter().enumerate();
    joints
        .map(|(joint, displacement)| {
            gap_of(displacement, &relative(mechanism, geometry, links, joint))
        })
        .collect()
}

/// How far a joint's displacement is from the nearest that it allows.
fn gap_of(displacement: &JointDisplacement<f64>, relative: &Rigid<f64>) -> JointGap {
    let nearest = displacement.displacement(&displacement.fit(relative));
    let off = nearest.inverse().compose(relative);
    JointGap {
        position: norm(&off.translation),
        angle: norm(&off.rotation_vector()),
    }
}

fn norm(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A fitted state with its angles about fixed axes brought within half a turn of those before.
fn continued(
    displacement: &JointDisplacement<f64>,
    fitted: &JointState<f64>,
    before: &JointState<f64>,
) -> JointState<f64> {
    use JointKind as K;
    match displacement.kind() {
        K::Revolute
        | K::Cylindrical
        | K::Universal
        | K::Planar
        | K::Schoenflies
        | K::LineOnPlane => {}
        _ => return fitted.clone(),
    }
    let parts = displacement.kind().freedoms();
    let pairs = fitted.values.iter().zip(&before.values).zip(parts);
    let values: Vec<f64> = pairs
        .map(|((&now, &then), part)| {
            let turns = ((then - now) / std::f64::consts::TAU).round();
            if *part == FreedomPart::Rotation && turns.is_finite() {
                now + turns * std::f64::consts::TAU
            } else {
                now
            }
        })
        .collect();
    if values == fitted.values {
        return fitted.clone();
    }
    displacement.at(&values)
}
