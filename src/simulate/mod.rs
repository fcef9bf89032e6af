//! A mechanism as a world of a physics engine.
mod build;
mod convert;
mod coupling;
mod effects;
mod elementary;
mod error;
mod forest;
mod inertia;
mod measure;
mod motor;
mod options;
mod solids;
mod units;
mod velocities;
pub mod verification;
mod world;

pub use error::WorldError;
pub use options::{Drive, Effects, Energy, JointGap, Note, Pieces, Solver, WorldOptions};
pub use world::World;
