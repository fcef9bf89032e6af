//! Setting a world in motion without a jolt.

use super::WorldError;
use super::convert::vector;
use super::world::World;
use kutzbach_closure::{JointState, Rigid, cross_product};
use nalgebra::{DMatrix, DVector, Vector6};
use rapier3d_f64::prelude::{Multibody, Vector as Vec3};
use std::collections::VecDeque;

impl World {
    /// Gives every joint its rates (rad/s, m/s), in the order of its variables, as a tangent of the configuration space
    /// does. Links are reached from the ground along a tree; a joint that closes a loop has to agree with it, or the
    /// solver makes it agree in the first step. The ground keeps still.
    ///
    /// # Errors
    /// [`WorldError::Command`] where numbers are missing or not finite.
    pub fn set_rates(&mut self, rates: &[Vec<f64>]) -> Result<(), WorldError> {
        let sound = rates.len() == self.displacements.len()
            && rates.iter().zip(&self.displacements).all(|(rates, joint)| {
                rates.len() == joint.freedom() && rates.iter().all(|x| x.abs() < 1e30)
            });
        if !sound {
            return Err(WorldError::Command(
                "every joint needs a finite rate for each of its freedoms".to_owned(),
            ));
        }
        let states = self.states(&self.start);
        self.set_link_twists(&self.twists_of(rates, &states))
    }

    fn twists_of(&self, rates: &[Vec<f64>], states: &[JointState<f64>]) -> Vec<[f64; 6]> {
        let poses = self.link_poses();
        let relative: Vec<[f64; 6]> = (0..self.ends.len())
            .map(|joint| {
                let frame = poses[self.ends[joint][0]].compose(&self.sides[joint][0]);
                let screws = self.displacements[joint].screws(&states[joint]);
                let mut sum = [0.0; 6];
                for (screw, rate) in screws.iter().zip(&rates[joint]) {
                    let (angular, linear) = screw.moved(&frame).about(&[0.0; 3]);
                    for i in 0..3 {
                        sum[i] += rate * angular[i];
                        sum[3 + i] += rate * linear[i];
                    }
                }
                sum
            })
            .collect();
        let mut incident = vec![Vec::new(); self.names.len()];
        for (joint, [a, b]) in self.ends.iter().enumerate() {
            incident[*a].push((joint, *b, 1.0));
            incident[*b].push((joint, *a, -1.0));
        }
        let mut twists: Vec<Option<[f64; 6]>> = vec![None; self.names.len()];
        for root in std::iter::once(self.built.ground()).chain(0..self.names.len()) {
            if twists[root].is_some() {
                continue;
            }
            twists[root] = Some([0.0; 6]);
            let mut waiting = VecDeque::from([root]);
            while let Some(link) = waiting.pop_front() {
                let here = twists[link].unwrap_or_default();
                for &(joint, other, sign) in &incident[link] {
                    if twists[other].is_none() {
                        twists[other] =
                            Some([0, 1, 2, 3, 4, 5].map(|i| here[i] + sign * relative[joint][i]));
                        waiting.push_back(other);
                    }
                }
            }
        }
        twists.into_iter().map(Option::unwrap_or_default).collect()
    }

    /// Gives every link a twist: angular velocity (rad/s), then the velocity of its point at the world's origin (m/s), world
    /// frame. The ground's is not used. What the joints of the tree do not allow is left out where reduced coordinates
    /// hold them; intermediate bodies follow their two links.
    ///
    /// # Errors
    /// [`WorldError::Command`] where links are missing or numbers are not finite.
    pub fn set_link_twists(&mut self, twists: &[[f64; 6]]) -> Result<(), WorldError> {
        let finite = twists.iter().flatten().all(|x| x.abs() < 1e30);
        if twists.len() != self.names.len() || !finite {
            return Err(WorldError::Command(format!(
                "each of the {} links needs a finite twist",
                self.names.len()
            )));
        }
        // In the engine's units: angular, then linear of the point at the world's origin.
        let mut all: Vec<[f64; 6]> = twists
            .iter()
            .enumerate()
            .map(|(link, twist)| {
                if link == self.built.ground() {
                    return [0.0; 6];
                }
                let l = self.units.length;
                [0, 1, 2, 3, 4, 5].map(|i| if i < 3 { twist[i] } else { twist[i] / l })
            })
            .collect();
        for body in self.names.len()..self.built.bodies.len() {
            all.push(self.follow(body, &all));
        }
        for (body, twist) in all.iter().enumerate() {
            if body == self.built.ground() {
                continue;
            }
            let (angular, linear) = split(twist);
            let handle = self.built.bodies[body];
            if let Some(body) = self.physics.bodies.get_mut(handle) {
                let at_centre = linear + angular.cross(body.translation());
                body.set_angvel(angular, true);
                body.set_linvel(at_centre, true);
            }
        }
        self.set_coordinates();
        Ok(())
    }

    /// The twist of an intermediate body that agrees best with the links on both sides of it, by least squares over the
    /// locked axes of its two joints; a tiny weight on the twist itself settles what they leave open, such as a rod's spin.
    fn follow(&self, body: usize, twists: &[[f64; 6]]) -> [f64; 6] {
        let mut normal = DMatrix::<f64>::zeros(6, 6);
        let mut right = DVector::<f64>::zeros(6);
        for joint in &self.built.elementary {
            let Some(mine) = joint.bodies.iter().position(|&b| b == body) else {
                continue;
            };
            let other = &twists[joint.bodies[1 - mine].min(twists.len() - 1)];
            let frame = self.joint_frame(joint.bodies[0], &joint.frames[0]);
            let point = self
                .joint_frame(joint.bodies[1], &joint.frames[1])
                .translation;
            for axis in (0..6).filter(|axis| joint.free >> axis & 1 == 0) {
                let direction = [0, 1, 2].map(|i| frame.rotation[i][axis % 3]);
                let row = if axis < 3 {
                    let moment = cross_product(&point, &direction);
                    [
                        moment[0],
                        moment[1],
                        moment[2],
                        direction[0],
                        direction[1],
                        direction[2],
                    ]
                } else {
                    [direction[0], direction[1], direction[2], 0.0, 0.0, 0.0]
                };
                let row = Vector6::from(row);
                let wanted = row.dot(&Vector6::from(*other));
                for i in 0..6 {
                    right[i] += row[i] * wanted;
                    for j in 0..6 {
                        normal[(i, j)] += row[i] * row[j];
                    }
                }
            }
        }
        let weight = 1e-12 * normal.trace().max(1.0);
        for i in 0..6 {
            normal[(i, i)] += weight;
        }
        match normal.cholesky() {
            Some(factor) => {
                let twist = factor.solve(&right);
                [0, 1, 2, 3, 4, 5].map(|i| twist[i])
            }
            None => [0.0; 6],
        }
    }

    /// A joint frame in the world, in the engine's units.
    fn joint_frame(&self, body: usize, frame: &Rigid<f64>) -> Rigid<f64> {
        let offset = self.built.offsets[body].inverse().compose(frame);
        let mut placed = self.units.rigid(&self.body_pose(body)).compose(&offset);
        placed.translation = placed.translation.map(|x| x / self.units.length);
        placed
    }

    /// Takes the bodies' velocities over into the coordinates of the multibodies.
    fn set_coordinates(&mut self) {
        let indices = self.built.multibodies(&self.physics);
        let physics = &mut self.physics;
        for index in indices {
            let Some(multibody) = physics.multibody_joints.get_multibody_mut(index) else {
                continue;
            };
            let velocities: Vec<(Vec3, Vec3, Vec3)> = multibody
                .links()
                .map(|link| {
                    let body = physics.bodies.get(link.rigid_body_handle());
                    body.map_or(Default::default(), |b| {
                        (b.angvel(), b.linvel(), b.translation())
                    })
                })
                .collect();
            let rates = rates_of(multibody, &velocities);
            for (at, rate) in rates {
                if let Some(slot) = multibody.generalized_velocity_mut().get_mut(at) {
                    *slot = rate;
                }
            }
        }
    }
}

/// Rate of every coordinate, by position; velocities are (angular, of the centre, centre).
fn rates_of(multibody: &Multibody, velocities: &[(Vec3, Vec3, Vec3)]) -> Vec<(usize, f64)> {
    let mut rates = Vec::new();
    for (id, link) in multibody.links().enumerate() {
        let data = &link.joint().data;
        let (angular, linear, centre) = velocities[id];
        let (turning, moving, basis) = match link.parent_id() {
            None => (angular, linear, rapier3d_f64::prelude::Rotation::IDENTITY),
            Some(parent) => {
                let (w, v, c) = velocities[parent];
                let point = *link.local_to_world() * data.local_frame2.translation;
                let of_child = linear + angular.cross(point - centre);
                let of_parent = v + w.cross(point - c);
                let parent_pose = multibody.link(parent).map(|p| p.local_to_world().rotation);
                let basis = parent_pose.unwrap_or_default() * data.local_frame1.rotation;
                (angular - w, of_child - of_parent, basis)
            }
        };
        let back = basis.inverse();
        let local = [(back * moving).to_array(), (back * turning).to_array()].concat();
        let free = (0..6).filter(|axis| data.locked_axes.bits() >> axis & 1 == 0);
        for (position, axis) in free.enumerate() {
            rates.push((link.assembly_id() + position, local[axis]));
        }
    }
    rates
}

fn split(twist: &[f64; 6]) -> (Vec3, Vec3) {
    let [w, v] = [0, 3].map(|i| vector(&[twist[i], twist[i + 1], twist[i + 2]]));
    (w, v)
}
