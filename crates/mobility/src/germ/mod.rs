//! The germ of the configuration space of a part at its pose.
//!
//! # The problem
//! The Jacobian says how a part can move to first order. Where its rows are dependent that is more than how it can move:
//! the dependent equations have terms of higher order, and these decide between a manifold, several branches, a cusp and
//! an isolated pose. With n joint variables there are too many of these terms; but only δ = dim ker J combinations of the
//! variables are free to first order, and all others are functions of them (Lyapunov–Schmidt reduction; the formal version
//! is Kuranishi's). What is left are s equations κ(y) = 0 in δ variables, starting at degree two, whose zeros are, as
//! an analytic germ, the configuration space at the pose.
//!
//! # What a result must satisfy
//! - It stands for the mechanism and not for how it is written: lengths are measured in cycle lengths and joint
//!   variables in units in which each moves its cycles equally far.
//! - Every coefficient comes with an estimate of its largest error, by rounding and by the stated precision of the file. An equation
//!   counts only as far as it exceeds that, and [`Germ::margin`] says how clearly each one did.
//! - What holds only up to the computed degree is called so. Equations that vanish to every computed degree prove nothing;
//!   a definite quadratic form ([`prestress_certificate`]) or an isolated zero ([`complex_dimension`]) does.
//!
//! # The way through
//! [`loop_equations`]: the closure equations as power series. [`splitting`]: kernel, left kernel and pseudo-inverse.
//! [`reduction`]: the germ. [`effective`], [`ideal`]: independent equations, by order. [`noise`]: what is known of each coefficient.
//! [`second_order`], [`min_norm_point`]: definite combinations of the quadratic forms. [`definite`]: definite germs of higher order. [`dual_space`], [`slices`]: complex dimension.
//!
//! # Cost
//! One loop with δ = 2 to degree 4: some hundred microseconds. In general C(2δ+K, K) products of displacements per joint
//! and degree, and one dense singular value decomposition of the Jacobian.

mod arrangement;
mod critical;
mod definite;
mod dual_space;
mod effective;
mod ideal;
mod loop_equations;
mod min_norm_point;
mod noise;
mod reduction;
mod second_order;
mod slices;
pub(crate) mod splitting;

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;

pub use arrangement::linear_arrangement;
pub use critical::is_irreducible_hypersurface;
pub use definite::{inertia, isolated_by_leading_terms, quadratic_form, signature};
pub use dual_space::{ComplexDimension, complex_dimension};
pub use reduction::Germ;
pub use second_order::{PrestressCertificate, prestress_across, prestress_certificate};
