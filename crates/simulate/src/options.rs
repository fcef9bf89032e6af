//! What a caller chooses: solver, effects, steps, drives; and what is counted and noted of a world.

use super::WorldError;
use kutzbach_model::mechanism::Mechanism;
use serde::{Deserialize, Serialize};

/// How the joints of the spanning tree are held. Joints that close a loop are impulse joints either way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Solver {
    /// By reduced coordinates: a joint of the tree cannot open.
    #[default]
    Multibody,
    /// By impulses between free bodies, like the loops.
    Impulse,
}

impl Solver {
    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Multibody => "multibody",
            Self::Impulse => "impulse",
        }
    }
}

/// The physical effects of a world beside its joints and drives. Each adds its own pieces and nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Effects {
    /// Gravitational acceleration in the world frame (m/s²).
    pub gravity: Option<[f64; 3]>,
    /// Contact between the collision shapes of links that no joint connects.
    pub contact: bool,
    /// How fast what touches parts again, as a share of the speed of approach (Newton's coefficient of restitution, from 0 to 1).
    pub restitution: f64,
    /// Joint limits, from `<limit>`.
    pub limits: bool,
    /// Dry friction in joints, from `<dynamics friction>`.
    pub friction: bool,
    /// Viscous damping in joints, from `<dynamics damping>`.
    pub damping: bool,
}

impl Effects {
    /// The effects that the mechanism's `<scene>` calls for; none without a scene.
    #[must_use]
    pub fn of_scene(mechanism: &Mechanism) -> Self {
        let Some(scene) = mechanism.scene() else {
            return Self::default();
        };
        Self {
            gravity: scene
                .gravity
                .as_ref()
                .map(|g| [0, 1, 2].map(|i| g[i].value())),
            contact: scene.contact,
            restitution: scene
                .restitution
                .as_ref()
                .map_or(0.0, |share| share.value()),
            limits: scene.limits,
            friction: scene.friction,
            damping: scene.damping,
        }
    }
}

/// How a world is built and stepped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldOptions {
    /// How the tree is held.
    pub solver: Solver,
    /// The effects beside joints and drives.
    pub effects: Effects,
    /// Length of a step (s).
    pub time_step: f64,
    /// Substeps of a step: positions move on and constraints are linearised anew in each.
    pub substeps: usize,
}

impl Default for WorldOptions {
    /// The multibody solver, no effects, 1/240 s in four substeps.
    fn default() -> Self {
        Self {
            solver: Solver::default(),
            effects: Effects::default(),
            time_step: 1.0 / 240.0,
            substeps: 4,
        }
    }
}

/// More substeps than this are refused: a step would take longer than anyone waits.
const MOST_SUBSTEPS: usize = 1 << 20;

/// Steps that are refused as too short or too long (s): the engine divides by the square of a substep.
const STEPS: std::ops::RangeInclusive<f64> = 1e-12..=1e6;

impl WorldOptions {
    /// Whether a world can be stepped like this at all.
    ///
    /// # Errors
    /// [`WorldError::Options`] where the time step is not between 1e-12 s and 1e6 s, the substeps are none or more than
    /// 2^20, gravity is not finite, or the coefficient of restitution is not between 0 and 1.
    pub fn check(&self) -> Result<(), WorldError> {
        let refuse = |what: String| Err(WorldError::Options(what));
        if !STEPS.contains(&self.time_step) {
            return refuse(format!(
                "the time step must be between {:e} s and {:e} s, but is {:e} s",
                STEPS.start(),
                STEPS.end(),
                self.time_step
            ));
        }
        if self.substeps == 0 || self.substeps > MOST_SUBSTEPS {
            return refuse(format!(
                "a step needs 1 to {MOST_SUBSTEPS} substeps, but {} were asked for",
                self.substeps
            ));
        }
        if let Some(gravity) = self.effects.gravity
            && !gravity.iter().all(|g| g.is_finite())
        {
            return refuse(format!("gravity must be finite, but is {gravity:?}"));
        }
        let restitution = self.effects.restitution;
        if !(0.0..=1.0).contains(&restitution) {
            return refuse(format!(
                "the coefficient of restitution must be between 0 and 1, but is {restitution}"
            ));
        }
        Ok(())
    }
}

/// Where links get their masses and moments of inertia from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Masses {
    /// The file's, or derived from shapes or joints where it states none to compute with.
    #[default]
    Stated,
    /// The same for every link. How a mechanism can move does not depend on masses, but the solver's sweeps converge slowly,
    /// or to something else, where they lie decades apart, as in a robot with a body and finger tips.
    Alike,
}

/// A velocity motor on one freedom of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Index of the joint in the mechanism.
    pub joint: usize,
    /// Which of its freedoms, in the order of the joint's variables.
    pub freedom: usize,
    /// Wanted rate (rad/s, m/s).
    pub velocity: f64,
    /// Largest torque or force (N m, N); may be infinite.
    pub largest_force: f64,
}

/// How many pieces of each sort a world consists of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Pieces {
    /// Rigid bodies: links, intermediate bodies, and fixed bodies that stand for the ground.
    pub bodies: usize,
    /// Small bodies between the two halves of a joint that is held by two simpler ones.
    pub intermediate_bodies: usize,
    /// Shapes that can touch.
    pub colliders: usize,
    /// Joints held by impulses.
    pub impulse_joints: usize,
    /// Joints held by reduced coordinates.
    pub multibody_joints: usize,
    /// Couplings between two coordinates of a multibody, those of screws included.
    pub couplings: usize,
    /// Driven freedoms.
    pub motors: usize,
    /// Freedoms with limits.
    pub limits: usize,
    /// Freedoms with dry friction.
    pub frictions: usize,
    /// Freedoms with viscous damping.
    pub dampings: usize,
}

/// What a reader of the results has to know of how the world was made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Note {
    /// The link, joint or coupling it is about.
    pub about: String,
    /// What was done, or left out.
    pub text: String,
}

/// Kinetic and potential energy (J).
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Energy {
    /// ½ Σ (m v² + ωᵀ I ω) over all bodies that move.
    pub kinetic: f64,
    /// −Σ m g·c over all bodies that move, zero at the world's origin; zero without gravity.
    pub potential: f64,
}

impl Energy {
    /// The sum.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential
    }
}

/// How far a joint's two frames are from the displacements that the joint allows.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct JointGap {
    /// Distance between the origins (m).
    pub position: f64,
    /// Angle between the orientations (rad).
    pub angle: f64,
}
