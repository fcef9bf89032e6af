//! Groebner bases within limits. The only place that names the crate which computes them.

mod basis;
mod budget;
mod modular;
mod order;
mod residue;

pub use basis::{Certificate, GroebnerBasis, groebner_basis};
pub use budget::{Budget, Limits, Stop};
pub use order::MonomialOrder;
