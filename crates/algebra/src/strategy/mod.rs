//! Three ways from the equations of a mechanism to their Groebner basis, side by side.
//!
//! Ruiz (1994, chapter 5) splits the equations along the basic cycles of the constraint graph:
//!
//! - [`brute_force`] gives all equations to the engine at once;
//! - [`divide_and_conquer`] first computes the basis of every cycle by itself, then that of all these bases together. Both
//!   generate the same ideal, so the reduced basis at the end is the same;
//! - [`incremental_instancing`] puts what a cycle determines into the equations of the next ones. Where a cycle leaves a
//!   choice, every choice is carried on as a case of its own; nothing is dropped (the printed algorithm picks one root).
//!
//! [`relation_by_relation`] is the management of constraints of section 3.2.2: relations are added one by one, and each
//! is accepted, redundant or inconsistent.

mod blocks;
mod cases;
mod divide;
mod group;
mod relations;

pub use cases::{Case, Incremental, Instance, Learned, incremental_instancing};
pub(super) use divide::brute_force_noting;
pub use divide::{Divided, Step, brute_force, divide_and_conquer};
pub use group::{Group, Problem};
pub(super) use group::{Local, basis_by_parts};
pub use relations::{
    Bodies, Relation, RelationFinding, RelationVerdict, Relations, relation_by_relation,
};
