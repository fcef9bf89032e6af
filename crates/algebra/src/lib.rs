//! The closure equations as polynomials over the rationals, and what Groebner bases prove about them.
//!
//! Numbers tell what happens at a pose; polynomials speak of the whole configuration space: its dimension, its pieces, the
//! variables that nothing moves, the equation that contradicts the others.
//!
//! - [`Polynomial`] is a sparse polynomial with rational coefficients;
//! - [`groebner_basis`] computes a [`GroebnerBasis`] in a [`MonomialOrder`], within a [`Budget`].
//!
//! Everything that costs much takes a [`Budget`] and ends with an answer or a [`Stop`] that says why there is none.

mod answer;
mod components;
mod engine;
mod factor;
mod over_field;
mod polynomial;
mod strategy;
mod system;
mod univariate;
mod without_loops;
mod written;
mod zero_dimensional;

pub use answer::{
    BlockAnswer, BlockFinding, ByBlocks, ClosingSet, Closings, Condition, CycleAnswer,
    DesignConditions, ExactAnswer, ExactOptions, Exception, Exceptions, Family, FixedVariable,
    Method, Ordered, Piece, ProvenMotion, Scope, Settled, Solutions, accepted_at_home,
    assembly_conditions, closings, exact_answer, exact_by_blocks, motion_conditions, relations_of,
};
pub use components::{
    AlgebraicNumber, Component, Decomposition, Hints, Incomplete, Irreducible, RealPoints,
    components,
};
pub use engine::{
    Budget, Certificate, GroebnerBasis, HilbertSeries, Limits, LocalRing, MEMORY, MonomialOrder,
    Progress, ResidueTerms, Stop, count_solutions, eliminate, entries_in, groebner_basis,
    local_dimension, local_dimension_is_at_most, local_dimension_modulo, quotient,
    radical_contains, saturate,
};
pub use factor::{Factorization, UnivariateFactors, factor};
pub use over_field::{FieldPolynomial, OverRationals, RealSet};
pub use polynomial::{Polynomial, Rational};
pub use strategy::{
    Bodies, Case, Divided, Group, Incremental, Instance, Learned, Problem, Relation,
    RelationFinding, RelationVerdict, Relations, Step, brute_force, divide_and_conquer,
    incremental_instancing, relation_by_relation,
};
pub use system::{
    CycleEquations, Equation, FieldElement, FieldGenerator, Formulation, HomePose, Meaning,
    ModularSystem, NumberField, Origin, PolynomialSystem, Reach, Relaxation, SystemError,
    SystemOptions, Variable, polynomial_system,
};
pub use univariate::{RealRoot, Univariate};
pub use without_loops::{WithoutLoops, without_loops};
pub use written::{Reader, written_for};
pub use zero_dimensional::{FinitePoints, RealSolution, Representation, TraceForm};
