//! Mechanisms in the words of other programs.
//!
//! | module | what it knows |
//! |---|---|
//! | `place` | numbers, directions and frames as text |
//! | `parts` | a joint as turns, slides and balls one after another |
//! | `tree` | the bodies from the ground outward |
//! | `gaps` | what closes loops: whether it is closed as drawn, and where it is |
//! | `follow` | couplings of two joints as one that follows the other |
//! | `mjcf`, `closures`, `body`, `couplings` | MuJoCo's format: bodies; what closes loops; masses and shapes; what couples joints |
//! | `sdf` | Gazebo's format: links as drawn, and joints between any two of them |
//! | `urdf` | URDF without any word of ours |
//! | `pinocchio` | a Python program that makes Pinocchio's models of the tree and of the loops |
//! | `relax` | the mechanism without redundant constraints |
//! | `meant` | numbers that were worked out from rounded ones |
//!
//! What a format cannot say is told, never left out in silence.

mod body;
mod closures;
mod couplings;
mod follow;
mod gaps;
mod meant;
mod mjcf;
mod parts;
mod pinocchio;
mod place;
mod relax;
mod sdf;
mod tree;
mod urdf;

pub use meant::{InFull, in_full};
pub use mjcf::to_mjcf;
pub use pinocchio::to_pinocchio;
pub use relax::{Relaxed, relaxed};
pub use sdf::{NotClosed, to_sdf};
pub use urdf::to_urdf;

/// A mechanism in another format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Converted {
    /// The file.
    pub text: String,
    /// What of the mechanism the file does not say, or says otherwise, each in a line.
    pub not_said: Vec<String>,
}

/// How MJCF closes a loop by a hinge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hinges {
    /// By two points of its axis: six equations, of which five are independent.
    #[default]
    TwoPoints,
    /// By a body that turns about the axis in one link and is welded to the other: six equations for one variable more, all independent.
    Body,
}
