//! Every setting of a simulation: solver, length of a step, substeps.
//!
//! What the physics engine calls solver iterations are substeps here: eight sweeps over all constraints in each, and the
//! constraints linearised anew. The motion simulated is the one that the verification drives
//! ([`crate::verification`]); a structure, which has none, is simulated under its scene only.
//!
//! | file | holds |
//! |---|---|
//! | `grid` | which settings are tried |
//! | `between` | those between, for an error that is wanted |
//! | `account` | one after the other, while there is room for their work |
//! | `driven`, `scene` | what is run in each: the predicted motion, the file's scene |
//! | `watch` | how far all of it has come |

mod account;
mod between;
mod driven;
mod grid;
mod scene;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
mod watch;

pub(super) use driven::driven_rows;
pub use grid::Grid;
pub(super) use scene::scene_rows;
pub(super) use watch::Watch;
