//! A mechanism as a world of a physics engine.
//!
//! The engine (rapier, in double precision) knows nothing of closure equations: it has free bodies, impulses, and reduced
//! coordinates along trees. What it makes a mechanism do is therefore evidence that shares no code with the analysis. A
//! [`World`] has to let every joint move as its kind allows and in no other way, hold every loop, start at any closed pose,
//! and contain exactly the effects that were asked for; what the engine cannot do is said in [`World::notes`] and
//! [`World::not_simulated`], and numbers that run away are an error, not a picture.
//!
//! The way from a mechanism to a world:
//!
//! | file | does |
//! |---|---|
//! | `elementary` | takes joints apart into what the engine can hold; every freedom keeps a handle to drive it by |
//! | `forest` | decides which joints hold the tree and which close loops |
//! | `inertia`, `solids` | mass properties: stated, of shapes, of rods between joints |
//! | `units` | the engine's numbers are in units of the mechanism's own length and mass |
//! | `build`, `coupling` | the engine's bodies, joints and couplings |
//! | `effects`, `motor` | limits, friction, damping, contact; drives |
//! | `world`, `velocities`, `measure` | stepping, setting in motion, reading off |
//! | `scene_run`, `trajectory` | running a scene for a while, and how far its motion is off |
//! | `smooth` | Runge-Kutta steps for scenes without impacts and dry friction |
//! | `cost` | what each effect costs |
//! | [`verification`] | what all that says about a prediction |
//!
//! # Accuracy
//! A step is divided into substeps; in each, constraints are linearised anew and swept eight times. A loop's closure error
//! falls with the square of step over substeps: what a linearised constraint overlooks in a substep is quadratic in the
//! substep's motion, and the next substep corrects nearly all of it. It falls so without levelling off only if the springs
//! that stand for impulse joints are stiff enough, and for a loop that can move: one that cannot is pulled open until the
//! drive's largest force is balanced. The measured tables are in the book's chapter on simulation.
//!
//! # Cost
//! A step is linear in bodies and joints, but for multibodies: each factors a dense mass matrix in every substep, cubic in
//! its freedoms. Subtrees of the ground are separate multibodies for that reason. Without contact there are no shapes, and
//! the search for touching pairs has nothing to do.
//!
//! Source of the method: Macklin et al. 2019, *Small steps in physics simulation* (substeps instead of iterations);
//! Featherstone 2008, *Rigid body dynamics algorithms* (reduced coordinates).

pub mod accuracy;
mod build;
mod convert;
mod cost;
mod coupling;
mod effects;
mod elementary;
mod error;
mod forest;
mod inertia;
mod measure;
mod motor;
mod options;
mod scene_run;
#[cfg(feature = "logs")]
mod simulation_log;
mod smooth;
mod solids;
mod trail;
mod trajectory;
mod units;
mod velocities;
pub mod verification;
mod world;

pub use cost::{CostRow, cost_table};
pub use error::WorldError;
pub use measure::joint_gaps;
pub use options::{Drive, Effects, Energy, JointGap, Masses, Note, Pieces, Solver, WorldOptions};
pub use scene_run::{
    IdleEffect, LONGEST_STEP, RUNGE_KUTTA_STEP, SceneOptions, SceneRun, effect_names, idle_effects,
    run_scene, scene_drives,
};
#[cfg(feature = "logs")]
pub use simulation_log::SimulationLog;
pub use smooth::{Integrator, SERVING, Serving};
pub use trajectory::{Refinement, StepRow, Trajectory, TrajectoryError, run_scene_estimated};
pub use world::World;
