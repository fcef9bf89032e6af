//! The closure equations as polynomials over the rationals, and what Groebner bases prove about them.
//!
//! Numbers tell what happens at a pose; polynomials speak of the whole configuration space: its dimension, its pieces, the
//! variables that nothing moves, the equation that contradicts the others.
//!
//! - [`Polynomial`] is a sparse polynomial with rational coefficients;
//! - [`groebner_basis`] computes a [`GroebnerBasis`] in a [`MonomialOrder`], within a [`Budget`].
//!
//! Everything that costs much takes a [`Budget`] and ends with an answer or a [`Stop`] that says why there is none.

mod engine;
mod polynomial;
mod system;

pub use engine::{Budget, Certificate, GroebnerBasis, Limits, MonomialOrder, Stop, groebner_basis};
pub use polynomial::{Polynomial, Rational};
pub use system::{
    CycleEquations, Equation, Formulation, HomePose, Meaning, ModularSystem, Origin, PolynomialSystem,
    Relaxation, SystemError, SystemOptions, Variable, polynomial_system,
};
