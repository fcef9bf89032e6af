//! Rigid displacements: the group SE(3), its Lie algebra, and its subgroups.
//!
//! Everything a mechanism can do is a product of displacements, and most of what can be said about it
//! without solving an equation is said by the *subgroups* they live in: the links of a planar linkage never
//! leave G, those of a Hooke joint never leave S. This module supplies both halves.
//!
//! * [`Pose`], [`Twist`], [`Wrench`]: elements of SE(3), se(3) and its dual, with exponential, logarithm,
//!   adjoint action, bracket and pairing. One convention throughout: twists are (ω; v) in one frame with v
//!   taken at its origin, wrenches are (f; m).
//! * [`Series`], [`DisplacementSeries`]: truncated power series in several variables, and displacements as
//!   such series, so that the closure of a loop is known to any order at a pose from its joint screws alone.
//! * [`ScrewSystem`], [`Subalgebra`]: linear spaces of twists, their sums, intersections and closure under
//!   the bracket, with the margin of each rank decision taken on the way.
//! * [`DisplacementSubgroup`]: the twelve classes of connected subgroups (Hervé 1978), read off from a
//!   subalgebra by invariants, each with its geometry.
//!
//! What the results must satisfy:
//!
//! * **Invariance.** A class, a dimension or an intersection must not depend on where the origin is, how the
//!   world is turned, or whether lengths are metres or millimetres. No metric on se(3) is invariant under
//!   all of these, so one is chosen and carried along: a [`Gauge`] (centre, length, tolerance) that moves
//!   with the mechanism.
//! * **Derived tolerances.** A tolerance starts as the accuracy of the geometry and is propagated through
//!   each operation to the next as an angle between subspaces; see [`ScrewSystem`].
//! * **No tables.** Intersections and products of subgroups are linear algebra. The published tables serve as
//!   tests.
//!
//! Cost: every subgroup operation is a handful of singular value decompositions of matrices with six
//! rows; a displacement series of m variables and degree K costs C(2m+K, K) small matrix products per joint.

mod axis;
mod class;
mod classify;
mod decomposition;
mod displacement_series;
mod gauge;
mod kind;
mod monomials;
mod pose;
mod series;
mod span;
mod subalgebra;
mod system;
mod twist;
mod words;

#[cfg(test)]
mod herve_tables;

pub use axis::{Axis, normalised_direction};
pub use class::DisplacementSubgroup;
pub use classify::{Classification, classify};
pub use decomposition::Margin;
pub use displacement_series::DisplacementSeries;
pub use gauge::Gauge;
pub use kind::SubgroupKind;
pub use monomials::Monomials;
pub use pose::Pose;
pub use series::Series;
pub use span::{SpanDescription, describe_span};
pub use subalgebra::{Subalgebra, product_is_subgroup};
pub use system::ScrewSystem;
pub use twist::{Twist, Wrench};
pub use words::coordinates;

/// What can go wrong in this module. None of these arises from well-formed, finite geometry.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GroupError {
    /// A coordinate is infinite or not a number.
    #[error("a twist has a coordinate that is not a finite number: {0:?}")]
    NotFinite(Twist),
    /// The length scale, tolerance or centre of a [`Gauge`] is unusable.
    #[error(
        "a length scale must be positive and finite, a tolerance in [0, 0.1), a centre finite; found length {length}, tolerance {tolerance}"
    )]
    BadGauge {
        /// The length found (m).
        length: f64,
        /// The tolerance found.
        tolerance: f64,
    },
    /// A power series with this shape would be too large to multiply.
    #[error("a power series in {variables} variables up to degree {degree} is too large")]
    SeriesTooLarge {
        /// Number of variables asked for.
        variables: usize,
        /// Truncation degree asked for.
        degree: usize,
    },
    /// The wrong number of coordinates for a displacement of a subgroup.
    #[error("class {class} takes {needed} coordinates, found {found}")]
    WrongCoordinateCount {
        /// Short name of the class.
        class: &'static str,
        /// Its dimension.
        needed: usize,
        /// The number of coordinates found.
        found: usize,
    },
    /// The singular value decomposition did not converge.
    #[error("the singular value decomposition of a {rows}×{columns} matrix did not converge")]
    NoConvergence {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
    },
}
