//! Groebner bases within limits. The only place that names the crate which computes them.

mod basis;
mod budget;
mod certificate;
mod f4;
mod linear;
mod modular;
mod monomials;
mod order;
mod pairs;
mod symbolic;
mod terms;
mod trace;

pub use basis::{GroebnerBasis, groebner_basis};
pub use budget::{Budget, Limits, Progress, Stop};
pub use certificate::Certificate;
pub use order::MonomialOrder;
