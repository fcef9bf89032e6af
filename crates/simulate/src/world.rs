//! The world itself: stepping, drives, and what can be measured of it.

use super::WorldError;
use super::build::Built;
use super::convert::vector;
use super::elementary::Handle;
use super::motor::{Gain, Motor, motor_joint};
use super::options::{Drive, Masses, Note, Pieces, WorldOptions};
use super::units::Units;
use kutzbach_closure::{Geometry, JointDisplacement, JointState, Rigid};
use kutzbach_model::mechanism::Mechanism;
use rapier3d_f64::prelude::{
    GenericJoint, ImpulseJointHandle, PhysicsWorld, Pose, RigidBodyHandle, Vector as Vec3,
};
use std::collections::BTreeMap;

/// A mechanism as a world of the physics engine.
pub struct World {
    pub(super) options: WorldOptions,
    pub(super) physics: PhysicsWorld,
    pub(super) units: Units,
    pub(super) names: Vec<String>,
    pub(super) joint_names: Vec<String>,
    pub(super) ends: Vec<[usize; 2]>,
    pub(super) sides: Vec<[Rigid<f64>; 2]>,
    pub(super) displacements: Vec<JointDisplacement<f64>>,
    pub(super) start: Vec<JointState<f64>>,
    pub(super) limits: Vec<Option<[f64; 2]>>,
    pub(super) built: Built,
    steps: u64,
    drives: BTreeMap<(usize, usize), ImpulseJointHandle>,
    /// Idle spins held still while a freedom of their joint is driven.
    spins: BTreeMap<usize, ImpulseJointHandle>,
    pushed: Vec<RigidBodyHandle>,
}

impl World {
    /// Builds a world in which every joint stands as given: one state per joint, in the mechanism's order, usually those of
    /// a closed pose. Where a loop does not close, its joint starts open by the gap and the solver pulls it together.
    ///
    /// # Errors
    /// [`WorldError`] for options that cannot be stepped with, a wrong number of states, or numbers that are not finite.
    pub fn new(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        states: &[JointState<f64>],
        options: &WorldOptions,
    ) -> Result<Self, WorldError> {
        Self::with_masses(mechanism, geometry, states, options, Masses::Stated)
    }

    /// The same with masses of one's choice.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_masses(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        states: &[JointState<f64>],
        options: &WorldOptions,
        masses: Masses,
    ) -> Result<Self, WorldError> {
        let (physics, units, built) =
            super::build::build(mechanism, geometry, states, options, masses)?;
        let joints = mechanism.joints();
        Ok(Self {
            options: *options,
            physics,
            units,
            names: mechanism.links().iter().map(|l| l.name.clone()).collect(),
            joint_names: joints.iter().map(|joint| joint.name.clone()).collect(),
            ends: joints
                .iter()
                .map(|joint| [joint.predecessor.link.0, joint.successor.link.0])
                .collect(),
            sides: geometry.sides.clone(),
            displacements: geometry.displacements.clone(),
            start: states.to_vec(),
            limits: joints
                .iter()
                .map(|joint| joint.bounds().map(<[f64; 2]>::from))
                .collect(),
            built,
            steps: 0,
            drives: BTreeMap::new(),
            spins: BTreeMap::new(),
            pushed: Vec::new(),
        })
    }

    /// The options it was built with.
    #[must_use]
    pub fn options(&self) -> &WorldOptions {
        &self.options
    }

    /// Drives one freedom of a joint at a rate, or changes how it is driven.
    ///
    /// A ball's freedoms are turns about the axes of its successor's joint frame; translations go along axes fixed in the
    /// predecessor, except those of `point_on_line` and `point_on_plane`, which are fixed in the successor.
    ///
    /// # Errors
    /// [`WorldError::Command`] for a joint or freedom that does not exist, a velocity that is not finite, or a largest
    /// force that is negative or not a number.
    pub fn drive(&mut self, drive: Drive) -> Result<(), WorldError> {
        let handle = self.handle(drive.joint, drive.freedom)?;
        let name = &self.joint_names[drive.joint];
        if !(drive.velocity.abs() < 1e30) {
            return Err(WorldError::Command(format!(
                "joint `{name}` cannot be driven at {}: a rate has to be a finite number",
                drive.velocity
            )));
        }
        if !(drive.largest_force >= 0.0) {
            return Err(WorldError::Command(format!(
                "joint `{name}` cannot be driven with a largest force of {}: it has to be zero or more",
                drive.largest_force
            )));
        }
        let motor = motor_joint(
            &self.built,
            &self.units,
            &handle,
            Motor {
                velocity: drive.velocity,
                gain: Gain::Stiff {
                    largest: drive.largest_force,
                },
            },
        );
        let key = (drive.joint, drive.freedom);
        if let Some(existing) = self.drives.get(&key)
            && let Some(joint) = self.physics.impulse_joints.get_mut(*existing, true)
        {
            joint.data = motor;
            return Ok(());
        }
        let inserted = self.insert(&handle, motor);
        self.drives.insert(key, inserted);
        if let Some(spin) = self.built.spins[drive.joint].clone()
            && !self.spins.contains_key(&drive.joint)
        {
            let still = Motor {
                velocity: 0.0,
                gain: Gain::Stiff {
                    largest: f64::INFINITY,
                },
            };
            let motor = motor_joint(&self.built, &self.units, &spin, still);
            let inserted = self.insert(&spin, motor);
            self.spins.insert(drive.joint, inserted);
        }
        Ok(())
    }

    fn insert(&mut self, handle: &Handle, motor: GenericJoint) -> ImpulseJointHandle {
        let [a, b] = handle.bodies.map(|body| self.built.bodies[body]);
        self.physics.impulse_joints.insert(a, b, motor, true)
    }

    /// Lets go of a driven freedom; nothing happens where it is not driven.
    pub fn release(&mut self, joint: usize, freedom: usize) {
        if let Some(handle) = self.drives.remove(&(joint, freedom)) {
            self.physics.impulse_joints.remove(handle, true);
        }
        let driven = self.drives.keys().any(|(driven, _)| *driven == joint);
        if !driven && let Some(spin) = self.spins.remove(&joint) {
            self.physics.impulse_joints.remove(spin, true);
        }
    }

    fn handle(&self, joint: usize, freedom: usize) -> Result<Handle, WorldError> {
        let handles = self.built.handles.get(joint).ok_or_else(|| {
            WorldError::Command(format!(
                "there is no joint number {joint} among {}",
                self.built.handles.len()
            ))
        })?;
        handles.get(freedom).cloned().ok_or_else(|| {
            WorldError::Command(format!(
                "joint `{}` has no degree of freedom with number {freedom}",
                self.joint_names[joint]
            ))
        })
    }

    /// One step of [`WorldOptions::time_step`].
    ///
    /// # Errors
    /// [`WorldError::Diverged`] if a number of any body is not finite afterwards.
    pub fn step(&mut self) -> Result<(), WorldError> {
        self.built.step(&mut self.physics);
        self.steps += 1;
        for body in self.pushed.drain(..) {
            if let Some(body) = self.physics.bodies.get_mut(body) {
                body.reset_forces(false);
                body.reset_torques(false);
            }
        }
        self.check()
    }

    fn check(&self) -> Result<(), WorldError> {
        let sound = self.physics.quarantine().is_empty()
            && (0..self.built.bodies.len()).all(|body| self.is_sound(body));
        if sound {
            return Ok(());
        }
        let quarantined = self.physics.quarantine().bodies();
        let lost = (0..self.built.bodies.len())
            .find(|&body| quarantined.contains(&self.built.bodies[body]) || !self.is_sound(body));
        // An intermediate body is named after a link that it connects.
        let link = lost.map_or(0, |body| self.built.link_near(body, self.names.len()));
        Err(WorldError::Diverged {
            link: self.names[link].clone(),
            time: self.time(),
        })
    }

    fn is_sound(&self, body: usize) -> bool {
        let pose = self.body_pose(body);
        let (linear, angular) = self.body_velocity(body);
        let far = |v: &Vec3| !(v.abs().max_element() < 1e30);
        pose.is_finite() && !far(&pose.translation) && !far(&linear) && !far(&angular)
    }

    /// Steps taken, times the step (s).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.options.time_step
    }

    pub(super) fn body_pose(&self, body: usize) -> Pose {
        self.physics
            .bodies
            .get(self.built.bodies[body])
            .map_or(Pose::IDENTITY, |b| *b.position())
    }

    /// Velocity of the centre of mass and angular velocity, in the engine's units. The engine leaves the velocities of
    /// multibody links one substep behind; they are computed from the coordinates' rates here.
    pub(super) fn body_velocity(&self, body: usize) -> (Vec3, Vec3) {
        let handle = self.built.bodies[body];
        let joints = &self.physics.multibody_joints;
        if let Some(id) = joints.rigid_body_link(handle)
            && let Some(multibody) = joints.get_multibody(id.multibody)
            && multibody.body_jacobian(id.id).ncols() == multibody.ndofs()
        {
            let rates = multibody.generalized_velocity();
            let twist = multibody.body_jacobian(id.id) * rates;
            return (
                Vec3::new(twist[0], twist[1], twist[2]),
                Vec3::new(twist[3], twist[4], twist[5]),
            );
        }
        self.physics
            .bodies
            .get(handle)
            .map_or((Vec3::ZERO, Vec3::ZERO), |b| (b.linvel(), b.angvel()))
    }

    /// `world_from_link` of every link.
    #[must_use]
    pub fn link_poses(&self) -> Vec<Rigid<f64>> {
        (0..self.names.len())
            .map(|link| {
                let body = self.units.rigid(&self.body_pose(link));
                body.compose(&self.built.offsets[link].inverse())
            })
            .collect()
    }

    /// The twist of every link in the world frame: angular velocity (rad/s), then the velocity of the link's point at the
    /// world's origin (m/s).
    #[must_use]
    pub fn link_twists(&self) -> Vec<[f64; 6]> {
        (0..self.names.len())
            .map(|link| {
                let (linear, angular) = self.body_velocity(link);
                let at_origin =
                    (linear - angular.cross(self.body_pose(link).translation)) * self.units.length;
                let [w, v] = [angular, at_origin].map(|x| x.to_array());
                [w[0], w[1], w[2], v[0], v[1], v[2]]
            })
            .collect()
    }

    /// Pushes a link during the next step: a wrench (force in N; moment about the world's origin in N m), world frame.
    ///
    /// # Errors
    /// [`WorldError::Command`] for a link that does not exist or a wrench that is not finite.
    pub fn push(&mut self, link: usize, wrench: [f64; 6]) -> Result<(), WorldError> {
        if link >= self.names.len() || !wrench.iter().all(|x| x.abs() < 1e60) {
            return Err(WorldError::Command(format!(
                "link number {link} of {} cannot be pushed with {wrench:?}",
                self.names.len()
            )));
        }
        let [f, m] = [0, 3].map(|i| [wrench[i], wrench[i + 1], wrench[i + 2]]);
        let force = vector(&f) / self.units.effort(0);
        let about_origin = vector(&m) / self.units.effort(3);
        let handle = self.built.bodies[link];
        if let Some(body) = self.physics.bodies.get_mut(handle) {
            body.add_force(force, true);
            body.add_torque(about_origin - body.translation().cross(force), true);
            self.pushed.push(handle);
        }
        Ok(())
    }

    /// What the world consists of.
    #[must_use]
    pub fn pieces(&self) -> Pieces {
        Pieces {
            colliders: self.physics.colliders.len(),
            motors: self.drives.len(),
            ..self.built.pieces
        }
    }

    /// Work of the engine's mass matrices, in units of links × coordinates and of links × coordinates²: it makes one for every
    /// tree that is held by reduced coordinates, and sums it up link by link.
    pub(crate) fn matrix_work(&self) -> [usize; 2] {
        let joints = &self.physics.multibody_joints;
        let trees = self.built.multibodies(&self.physics).into_iter();
        trees
            .filter_map(|index| joints.get_multibody(index))
            .map(|tree| (tree.num_links() * tree.ndofs(), tree.ndofs()))
            .fold([0, 0], |[first, second], (work, coordinates)| {
                [first + work, second + work * coordinates]
            })
    }

    /// Why no simulation speaks of the mechanism: there is something that the engine cannot hold.
    pub(crate) fn another_mechanism(&self) -> Option<String> {
        let missing = self.not_simulated();
        (!missing.is_empty()).then(|| {
            format!(
                "the engine cannot hold {}: what it would simulate is another mechanism",
                missing.join(", ")
            )
        })
    }

    /// What was derived, approximated or left out.
    #[must_use]
    pub fn notes(&self) -> &[Note] {
        &self.built.notes
    }

    /// Constraints of the mechanism that the engine cannot hold and this world therefore lacks, by name.
    #[must_use]
    pub fn not_simulated(&self) -> &[String] {
        &self.built.not_simulated
    }
}
