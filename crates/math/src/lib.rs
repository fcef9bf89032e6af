//! Exact and floating numbers, rank decisions with margins, rigid motions: no word of mechanisms.
//!
//! - [`number`]: exact numbers beside their floating-point values, with the precision a file states;
//! - [`matrix`]: rank decisions with margins: dense, sparse, in many digits, over a prime field;
//! - [`group`]: SE(3), twists, power series; the displacement subgroups;
//! - [`space`]: vectors and rigid displacements in any arithmetic;
//! - [`interruption`]: work that is asked from outside to end before it is done.

pub mod group;
pub mod interruption;
pub mod matrix;
pub mod number;
pub mod space;
