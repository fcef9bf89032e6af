//! From a mechanism to the engine's bodies and joints.

use super::WorldError;
use super::convert::computable;
use super::coupling;
use super::effects;
use super::elementary::{Elementary, Handle, TakenApart, axes};
use super::forest::{Branch, Forest, weld_chord_screws};
use super::inertia::{self, Mass};
use super::options::{Masses, Note, Pieces, Solver, WorldOptions};
use super::units::Units;
use kutzbach_closure::{
    Geometry, JointState, PlacedScrew, Rigid, Uncertainty, characteristic_length, spanning_poses,
};
use kutzbach_model::mechanism::Mechanism;
use rapier3d_f64::prelude::{
    GenericJoint, ImpulseJointHandle, JointAxesMask, MultibodyDofCoupling, MultibodyIndex,
    MultibodyJointHandle, PhysicsWorld, Pose, RigidBodyBuilder, RigidBodyHandle,
    SpringCoefficients,
};

/// What was built: handles into the engine, and what has to be remembered.
#[derive(Debug, Default)]
pub(super) struct Built {
    /// The engine's body of every link and intermediate body.
    pub bodies: Vec<RigidBodyHandle>,
    /// `link_from_body`: a body's origin is its centre of mass.
    pub offsets: Vec<Rigid<f64>>,
    /// `None` for the ground.
    pub masses: Vec<Option<Mass>>,
    /// By joint and freedom.
    pub handles: Vec<Vec<Handle>>,
    /// The idle spin that a joint has beside its freedoms.
    pub spins: Vec<Option<Handle>>,
    pub pieces: Pieces,
    pub notes: Vec<Note>,
    pub not_simulated: Vec<String>,
    pub hooks: effects::ApartHooks,
    /// By elementary joint.
    pub held: Vec<Option<Held>>,
    /// The joints as they are held.
    pub elementary: Vec<Elementary>,
    ground: usize,
    /// For every intermediate body, a link that it connects.
    near: Vec<usize>,
}

/// How an elementary joint came to be held.
#[derive(Clone, Copy, Debug)]
pub(super) enum Held {
    /// By reduced coordinates; its coordinates count backwards where the second body is the parent.
    Multibody {
        handle: MultibodyJointHandle,
        backwards: bool,
    },
    /// By impulses.
    Impulse(ImpulseJointHandle),
}

impl Built {
    /// The joint's two frames in the engine's bodies.
    pub fn frames(&self, units: &Units, bodies: [usize; 2], frames: &[Rigid<f64>; 2]) -> [Pose; 2] {
        [0, 1].map(|i| {
            let body_from_link = self.offsets[bodies[i]].inverse();
            units.pose(&body_from_link.compose(&frames[i]))
        })
    }

    /// A link by which to name a body.
    pub fn link_near(&self, body: usize, links: usize) -> usize {
        match body.checked_sub(links) {
            Some(intermediate) => self.near.get(intermediate).copied().unwrap_or(0),
            None => body,
        }
    }

    /// Index of the ground.
    pub fn ground(&self) -> usize {
        self.ground
    }

    /// Every multibody of the engine, in the order of their first bodies.
    pub fn multibodies(&self, physics: &PhysicsWorld) -> Vec<MultibodyIndex> {
        let joints = &physics.multibody_joints;
        physics
            .bodies
            .iter()
            .filter_map(|(body, _)| joints.rigid_body_link(body))
            .filter(|link| link.id == 0)
            .map(|link| link.multibody)
            .collect()
    }

    pub fn step(&self, physics: &mut PhysicsWorld) {
        physics.step_with_events(&self.hooks, &());
    }

    pub fn note(&mut self, about: &str, text: impl Into<String>) {
        self.notes.push(Note {
            about: about.to_owned(),
            text: text.into(),
        });
    }
}

/// Natural frequency of the critically damped springs that hold impulse joints (Hz). Of an error, a substep h leaves the
/// share 1/(1 + ω h/2), and of a push the square of that. At 1e3 Hz the share matters: the closure error falls only in
/// proportion to the substep. From 1e6 Hz on it falls with the square, but a push still moves a locked axis by 2e-5 of what
/// it does to a free one at 30 µs; at 1e9 Hz by 1e-11. Stiffer springs change nothing that can be measured
/// (`docs/src/simulation.md`).
const SPRING_FREQUENCY: f64 = 1e9;

/// Sweeps of the solver over all constraints in a substep. One sweep leaves a loop's rows fighting each other, and a drive
/// that starts with a jolt late by a radian; eight cost a tenth more time with multibodies, half as much again with
/// impulses, where assembling the rows costs most, and bring the closure error close to what the substep alone leaves.
const SWEEPS: usize = 8;

/// Every world of this module is made here.
pub(super) fn build(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    options: &WorldOptions,
    masses: Masses,
) -> Result<(PhysicsWorld, Units, Built), WorldError> {
    options.check()?;
    let (poses, length) = placed(mechanism, geometry, states)?;
    let mut built = Built::default();
    built.masses = match masses {
        Masses::Stated => inertia::of_links(mechanism, geometry, length, &mut built.notes),
        Masses::Alike => inertia::alike(mechanism, geometry, length),
    };
    let mut apart = TakenApart::new(mechanism, geometry, states, &poses);
    let names = body_names(mechanism, &apart);
    let joint_names = elementary_names(mechanism, &apart.joints);
    let mut forest = Forest::grow(
        mechanism.ground().0,
        &names,
        mechanism.links().len(),
        &apart.joints,
        &joint_names,
        |joint| {
            geometry
                .couplings
                .iter()
                .any(|coupling| coupling.joints().any(|of| of == joint))
        },
    )?;
    weld_chord_screws(&mut apart, &mut forest, &poses);
    built.handles = std::mem::take(&mut apart.handles);
    built.spins = std::mem::take(&mut apart.spins);

    let units = Units {
        length,
        mass: typical_mass(&built.masses),
    };
    let mut physics = PhysicsWorld::new();
    parameters(&mut physics, options, &units);
    let mut builder = Builder {
        mechanism,
        options,
        units,
        apart,
        poses,
        physics,
        built,
    };
    builder.bodies();
    builder.hold(&forest)?;
    coupling::add(
        mechanism,
        geometry,
        states,
        &builder.apart,
        &units,
        &mut builder.built,
        &mut builder.physics,
    );
    let Builder {
        apart,
        mut physics,
        mut built,
        ..
    } = builder;
    effects::add(
        mechanism,
        states,
        options,
        &apart,
        &units,
        &mut built,
        &mut physics,
    );
    built.pieces.bodies = physics.bodies.len();
    built.pieces.impulse_joints += held_by_impulses(&built);
    built.elementary = apart.joints;
    built.ground = mechanism.ground().0;
    Ok((physics, units, built))
}

/// `world_from_link` of every link at a pose, and the characteristic length there (m).
///
/// # Errors
/// [`WorldError`] for a wrong number of states and for numbers that cannot be computed with.
pub(super) fn placed(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
) -> Result<(Vec<Rigid<f64>>, f64), WorldError> {
    let joints = mechanism.joints();
    if states.len() != joints.len() {
        return Err(WorldError::States {
            wanted: joints.len(),
            given: states.len(),
        });
    }
    check_joints(mechanism, geometry, states)?;
    let (poses, _) = spanning_poses(mechanism, geometry, states);
    for (link, pose) in mechanism.links().iter().zip(&poses) {
        if !computable(pose) {
            return Err(WorldError::NotFinite {
                what: "the pose",
                name: link.name.clone(),
            });
        }
    }
    let length = size_of(mechanism, geometry, states, &poses);
    Ok((poses, length))
}

fn held_by_impulses(built: &Built) -> usize {
    let held = built.held.iter().flatten();
    held.filter(|held| matches!(held, Held::Impulse(_))).count()
}

fn check_joints(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
) -> Result<(), WorldError> {
    for (index, (joint, state)) in mechanism.joints().iter().zip(states).enumerate() {
        let displacement = &geometry.displacements[index];
        let sound = geometry.sides[index].iter().all(computable)
            && state.values.len() == joint.freedom()
            && state.values.iter().all(|x| x.abs() < 1e100)
            && computable(&displacement.displacement(state))
            && displacement.axis().iter().all(|x| x.is_finite())
            && displacement.second_axis().iter().all(|x| x.is_finite());
        if !sound {
            return Err(WorldError::NotFinite {
                what: "the start pose",
                name: joint.name.clone(),
            });
        }
    }
    Ok(())
}

/// The characteristic length of the mechanism at the start (m).
fn size_of(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    poses: &[Rigid<f64>],
) -> f64 {
    let screws: Vec<PlacedScrew<f64>> = mechanism
        .joints()
        .iter()
        .enumerate()
        .flat_map(|(index, joint)| {
            let frame = poses[joint.predecessor.link.0].compose(&geometry.sides[index][0]);
            let screws = geometry.displacements[index].screws(&states[index]);
            screws.into_iter().map(move |screw| screw.moved(&frame))
        })
        .collect();
    let moving = (0..mechanism.joints().len()).filter(|&j| mechanism.joints()[j].freedom() > 0);
    let (_, length) = characteristic_length(
        screws.iter(),
        geometry.size_of(moving),
        || geometry.arms.iter().copied().fold(0.0, f64::max),
        &Uncertainty::default(),
    );
    if length > 1e-50 && length < 1e50 {
        length
    } else {
        1.0
    }
}

/// The geometric mean of all masses (kg).
fn typical_mass(masses: &[Option<Mass>]) -> f64 {
    let logarithms: Vec<f64> = masses.iter().flatten().map(|m| m.mass.ln()).collect();
    if logarithms.is_empty() {
        return 1.0;
    }
    (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp()
}

fn body_names(mechanism: &Mechanism, apart: &TakenApart) -> Vec<String> {
    let links = mechanism.links().iter().map(|link| link.name.clone());
    let intermediates = apart
        .intermediates
        .iter()
        .map(|body| mechanism.joints()[body.joint].name.clone());
    links.chain(intermediates).collect()
}

/// Joints held by two are told apart by a number behind a character that no name begins with.
fn elementary_names(mechanism: &Mechanism, joints: &[Elementary]) -> Vec<String> {
    let mut names: Vec<String> = Vec::with_capacity(joints.len());
    for (index, joint) in joints.iter().enumerate() {
        let again = index > 0 && joints[index - 1].joint == joint.joint;
        let half = if again { "\u{1}2" } else { "" };
        names.push(format!("{}{half}", mechanism.joints()[joint.joint].name));
    }
    names
}

fn parameters(physics: &mut PhysicsWorld, options: &WorldOptions, units: &Units) {
    let parameters = &mut physics.integration_parameters;
    parameters.dt = options.time_step;
    parameters.num_solver_iterations = options.substeps;
    parameters.num_internal_pgs_iterations = SWEEPS;
    parameters.length_unit = 1.0;
    // No cap on speed: nothing here may depend on the step in hidden ways.
    parameters.normalized_max_linear_velocity = f64::MAX;
    let gravity = options.effects.gravity.unwrap_or_default();
    physics.gravity = super::convert::vector(&gravity) / units.length;
}

struct Builder<'a> {
    mechanism: &'a Mechanism,
    options: &'a WorldOptions,
    units: Units,
    apart: TakenApart,
    poses: Vec<Rigid<f64>>,
    physics: PhysicsWorld,
    built: Built,
}

impl Builder<'_> {
    fn bodies(&mut self) {
        for intermediate in &self.apart.intermediates {
            let neighbours = intermediate
                .links
                .map(|link| self.built.masses[link].as_ref());
            let mass = inertia::intermediate(neighbours, intermediate.length);
            self.built.masses.push(Some(mass));
            let [a, b] = intermediate.links;
            let moving = if self.built.masses[a].is_some() { a } else { b };
            self.built.near.push(moving);
        }
        self.built.pieces.intermediate_bodies = self.apart.intermediates.len();
        for intermediate in &self.apart.intermediates {
            let joint = &self.mechanism.joints()[intermediate.joint];
            self.built.notes.push(Note {
                about: joint.name.clone(),
                text: format!(
                    "held by two simpler joints and an intermediate body of {} of the lighter link's mass and least moment of inertia",
                    inertia::INTERMEDIATE_RATIO
                ),
            });
        }
        let intermediate_poses = self.apart.intermediates.iter().map(|body| &body.pose);
        for (pose, mass) in self
            .poses
            .iter()
            .chain(intermediate_poses)
            .zip(&self.built.masses)
        {
            let offset = inertia::offset(mass.as_ref());
            let placed = self.units.pose(&pose.compose(&offset));
            let body = match mass {
                Some(mass) => moving(placed, mass, &self.units),
                None => RigidBodyBuilder::fixed().pose(placed),
            };
            self.built.bodies.push(self.physics.bodies.insert(body));
            self.built.offsets.push(offset);
        }
    }

    fn hold(&mut self, forest: &Forest) -> Result<(), WorldError> {
        self.built.held = vec![None; self.apart.joints.len()];
        let coupled = !self.mechanism.couplings().is_empty();
        let reduced = self.options.solver == Solver::Multibody || coupled;
        if coupled && self.options.solver == Solver::Impulse {
            self.built.note(
                self.mechanism.name(),
                "the tree is held by reduced coordinates, as couplings need them",
            );
        }
        for branch in &forest.branches {
            if reduced || self.apart.joints[branch.joint].pitch.is_some() {
                self.reduce(branch, coupled)?;
            } else {
                self.pull(branch.joint);
            }
        }
        for &chord in &forest.chords {
            self.pull(chord);
        }
        for multibody in self.built.multibodies(&self.physics) {
            if let Some(body) = self.physics.multibody_joints.get_multibody_mut(multibody) {
                // The root's own freedoms are settled here, before rates are set or damping is cleared.
                body.forward_kinematics(&self.physics.bodies, true);
                // The engine damps turns by default; damping is an effect of its own here.
                body.damping_mut().fill(0.0);
            }
        }
        Ok(())
    }

    /// The body that a joint's parent side is fixed to. Every subtree of the ground gets a fixed body of its own, so that
    /// it becomes a multibody of its own: the engine factors a dense mass matrix for each.
    fn parent_body(&mut self, parent: usize, shared: bool) -> RigidBodyHandle {
        let handle = self.built.bodies[parent];
        if self.built.masses[parent].is_some() || shared {
            return handle;
        }
        let placed = self.units.pose(&self.poses[parent]);
        self.physics
            .bodies
            .insert(RigidBodyBuilder::fixed().pose(placed))
    }

    fn reduce(&mut self, branch: &Branch, shared: bool) -> Result<(), WorldError> {
        let joint = self.apart.joints[branch.joint].clone();
        let backwards = joint.bodies[0] != branch.parent;
        let [a, b] = self.built.frames(&self.units, joint.bodies, &joint.frames);
        let (near, far) = if backwards { (b, a) } else { (a, b) };
        let data = generic(joint.free, near, far);
        let parent = self.parent_body(branch.parent, shared);
        let child = self.built.bodies[branch.child];
        let handle = self
            .physics
            .multibody_joints
            .insert(parent, child, data, true)
            .ok_or_else(|| {
                WorldError::Refused(self.mechanism.joints()[joint.joint].name.clone())
            })?;
        self.built.pieces.multibody_joints += 1;
        self.built.held[branch.joint] = Some(Held::Multibody { handle, backwards });
        if let Some(pitch) = joint.pitch {
            self.tie_travel(handle, &joint, pitch / self.units.length);
        }
        Ok(())
    }

    /// Travel along x = pitch × turn about x; the same seen from either side.
    fn tie_travel(&mut self, handle: MultibodyJointHandle, joint: &Elementary, pitch: f64) {
        if let Some((multibody, link)) = self.physics.multibody_joints.get_mut(handle) {
            let turn = (joint.free & axes::TRANSLATIONS).count_ones() as usize;
            multibody.add_dof_coupling(MultibodyDofCoupling {
                link1: link,
                dof1: turn,
                axis1: 3,
                link2: link,
                dof2: 0,
                axis2: 0,
                coeff: pitch,
                offset: 0.0,
            });
            self.built.pieces.couplings += 1;
        }
    }

    /// Holds a joint by impulses.
    fn pull(&mut self, index: usize) {
        let joint = &self.apart.joints[index];
        let [near, far] = self.built.frames(&self.units, joint.bodies, &joint.frames);
        let mut data = generic(joint.free, near, far);
        let _ = data.set_softness(SpringCoefficients::new(SPRING_FREQUENCY, 1.0));
        let [a, b] = joint.bodies.map(|body| self.built.bodies[body]);
        let handle = self.physics.impulse_joints.insert(a, b, data, true);
        self.built.held[index] = Some(Held::Impulse(handle));
    }
}

fn moving(placed: Pose, mass: &Mass, units: &Units) -> RigidBodyBuilder {
    let own = Mass {
        mass: mass.mass / units.mass,
        centre: [0.0; 3],
        inertia: mass.inertia / units.moment(),
    };
    RigidBodyBuilder::dynamic()
        .pose(placed)
        .additional_mass_properties(own.properties())
        .can_sleep(false)
        .allow_fast_rotation(true)
}

fn generic(free: u8, near: Pose, far: Pose) -> GenericJoint {
    let locked = JointAxesMask::from_bits_truncate(!free & 0b11_1111);
    let mut joint = GenericJoint::new(locked);
    joint.set_local_frame1(near).set_local_frame2(far);
    joint
}
