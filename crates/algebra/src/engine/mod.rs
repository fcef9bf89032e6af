//! Groebner bases within limits. The only place that names the crate which computes them.

mod basis;
mod budget;
mod certificate;
mod dimension;
mod f4;
mod fraction_free;
mod hilbert;
mod ideal;
mod linear;
mod local;
mod minimal_polynomial;
mod modular;
mod monomials;
mod order;
mod pairs;
mod parts;
mod symbolic;
mod terms;
#[cfg(test)]
mod testing;
mod trace;

pub(super) use basis::groebner_basis_noting;
pub use basis::{GroebnerBasis, groebner_basis};
pub use budget::{Budget, Limits, MEMORY, Progress, Stop, entries_in};
pub use certificate::Certificate;
pub use hilbert::HilbertSeries;
pub use ideal::{
    eliminate, quotient, radical_contains, radical_of_basis_contains, saturate, saturate_basis,
};
pub use local::{
    LocalRing, ResidueTerms, local_dimension, local_dimension_is_at_most, local_dimension_modulo,
};
pub use modular::count_solutions;
pub use order::MonomialOrder;
