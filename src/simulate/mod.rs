//! A mechanism as a world of a physics engine.
mod build;
mod convert;
mod effects;
mod elementary;
mod error;
mod forest;
mod inertia;
mod options;
mod solids;
mod units;
mod world;

pub use error::WorldError;
pub use options::{Drive, Effects, Energy, JointGap, Note, Pieces, Solver, WorldOptions};
pub use world::World;
