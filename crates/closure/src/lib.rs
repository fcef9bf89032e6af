//! The equations of the cycles.
//!
//! The loops close when, once around every basic cycle of the graph, the product of the joint displacements is the
//! identity. This module evaluates that product and its derivative in any arithmetic, and moves the
//! joints until the cycles close:
//!
//! - [`Geometry`] evaluates a mechanism's exact numbers into frames, joint by joint;
//! - [`WalkedCycle`] goes around one cycle: residual, screws, the cycle's own centre and length;
//! - [`jacobian`] stacks the cycles to the matrix whose kernel is the instantaneous motion (Müller 2018);
//! - [`positional_jacobian`] is the same question asked in absolute coordinates, one twist per link;
//! - [`assemble`] closes the cycles from the file pose by damped least squares.
//!
//! Cost: everything but [`assemble`] is linear in the total length of the cycles.

mod assembly;
mod coordinates;
mod coupling_equation;
mod cycle;
mod displacement;
mod equations;
mod geometry;
mod guided;
mod jacobian;
mod joint_numbers;
mod part_names;
mod positional;
#[doc(hidden)]
#[allow(clippy::unwrap_used)]
pub mod samples;
mod section;
mod structure;

pub use assembly::{
    Assembly, AssemblyOptions, JointPlace, JointPoses, LoopGap, Obstacle, OutsideLimit, ProvenOpen,
    Reversal, Solved, Solver, assemble, assemble_with, coupled_joints, follow, nearest_turn,
    refine, spanning_poses,
};
pub use coupling_equation::{CouplingEquation, CouplingShare};
pub use cycle::{Walk, WalkedCycle, WalkedJoint, characteristic_length};
pub use displacement::Factor;
pub use displacement::{JointDisplacement, JointState};
pub use geometry::{Arithmetic, Geometry, Uncertainty, least_length};
pub use jacobian::stated_by;
pub use jacobian::{CycleJacobian, Part, entry_accuracy, jacobian, residual, rounding_of};
pub use jacobian::{linearised, variable_unit};
pub use joint_numbers::JointNumbers;
pub use kutzbach_math::space::{
    PlacedScrew, Rigid, Vector, cross as cross_product, perpendicular as across,
};
pub use part_names::{owners, with_owners};
pub use positional::positional_jacobian;
pub use section::{Closing, Metric, Section};
pub use structure::{Structure, constraint_graph};
