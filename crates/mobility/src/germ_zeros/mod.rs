//! The real zero set of a polynomial map germ at the origin.
//!
//! The problem: given κ: R^δ → R^s with κ(0) = 0, known up to a degree K and with coefficients known to some accuracy, say
//! which irreducible real pieces of {κ = 0} pass through the origin: of which dimension, in which directions, along which
//! half-branches; or that the origin is an isolated real zero. A configuration space near a singular pose is such a set
//! after the joint rates that the linear equations determine have been eliminated.
//!
//! What a result must satisfy:
//!
//! * **Invariance.** Linear changes of the variables, other bases of the space of equations, scaling of either: the answer
//!   stays. Terms beyond the order that decides do not change it either.
//! * **Through the origin.** A zero on a small sphere counts only if it can be followed to a sphere that is many times
//!   smaller, and the equations vanish along the way to within noise or faster than the first degree that was cut off.
//! * **Real.** Dimensions are those of the real set: x² + y² = 0 is a point.
//! * **Doubt is said.** Numbers of classes that differ between radii, half-branches without partner, orders that do not
//!   settle are reported in [`GermZeros::thin`].
//!
//! The way: zeros are sought on the sphere |y| = ε, in two variables by bracketing all roots of polynomials, otherwise by damped
//! Gauss–Newton from many starts; each is followed inwards; the local dimension is the number of coordinates that can be
//! prescribed nearby. Points of dimension 1 are half-branches and are paired by analytic continuation through the origin,
//! those of higher dimension are grouped by walking within the set.
//!
//! This is a numerical answer: starts can miss a small class (that is why at least twice as many are made as were needed to
//! find the last one), and branches closer than the noise are one.
//!
//! Cost: about a millisecond in the plane; hundreds of starts of some tens of evaluations each otherwise.

mod answer;
mod correct;
mod deflate;
mod local;
mod pairing;
mod plane;
mod search;
mod sheets;
mod small;
mod system;
mod track;

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;

pub use answer::germ_zeros;

/// How hard to search.
#[derive(Clone, Debug, PartialEq)]
pub struct GermZeroOptions {
    /// Seed of the random directions.
    pub seed: u64,
    /// Starts made in any case where there are three variables or more.
    pub fewest_starts: usize,
    /// Starts after which the search ends without having settled.
    pub most_starts: usize,
    /// Radius up to which the variables are meaningful; the spheres searched have at most a fifth of it.
    pub largest_radius: f64,
    /// No sphere is larger than this, whatever the equations would allow.
    pub outermost: f64,
    /// Work after which the search ends without having settled: about so many multiplications.
    pub work: u64,
}

impl Default for GermZeroOptions {
    fn default() -> Self {
        Self {
            seed: 1,
            fewest_starts: 100,
            most_starts: 3000,
            largest_radius: 1.0,
            outermost: f64::INFINITY,
            work: u64::MAX,
        }
    }
}

/// The real zero set of a germ near the origin.
#[derive(Clone, Debug)]
pub struct GermZeros {
    /// The irreducible pieces through the origin, as far as they can be told apart; by falling dimension, then in
    /// order of discovery.
    pub branches: Vec<GermBranch>,
    /// How fast the equations grow away from the origin, where no branch passes through it.
    pub isolation: Option<Isolation>,
    /// Searches started.
    pub starts: usize,
    /// Seed of the random directions.
    pub seed: u64,
    /// Radii of the spheres used, outermost first, in the units of the variables.
    pub radii: Vec<f64>,
    /// Why the answer should not be trusted, if there is a reason.
    pub thin: Option<String>,
    /// The work done.
    pub work: u64,
    /// Whether other zeros were found on smaller spheres: the germ shows inside of them only.
    pub varies: bool,
}

/// A lower bound of the equations near an isolated zero: |κ(y)| ≥ factor·|y|^order on the spheres tried, each equation taken
/// in units of its leading form at the radius where higher degrees begin to outweigh it.
#[derive(Clone, Debug, PartialEq)]
pub struct Isolation {
    /// Smallest |κ(y)|/|y|^order found on the spheres.
    pub factor: f64,
    /// Order of growth in the direction where it is slowest, fitted over the radii.
    pub order: f64,
}

/// One irreducible piece of the zero set.
#[derive(Clone, Debug)]
pub struct GermBranch {
    /// Its real dimension.
    pub dimension: usize,
    /// The ways out of the origin along a branch of dimension 1: two, or one where the partner was not found (`thin` says
    /// so). For a branch of higher dimension: half-lines of dimension 1 that continue it analytically, such as the handle of
    /// Whitney's umbrella; mostly none.
    pub half_branches: Vec<HalfBranch>,
    /// Points of the branch at the outermost radius, as far away from the other branches as was found.
    pub points: Vec<Vec<f64>>,
    /// Unit directions from the origin in the limit of small radius: for dimension 1 of both half-branches, otherwise a sample.
    pub tangents: Vec<Vec<f64>>,
    /// For dimension 1 the exponent m in y(t) = t^m·z(t): 1 for a smooth curve, 2 for a cusp. `None` otherwise.
    pub ramification: Option<usize>,
    /// Whether the Jacobian of the equations has rank δ − dimension at generic points. If not, the equations vanish
    /// twice there: more instantaneous freedom than finite freedom everywhere on the branch.
    pub reduced: bool,
    /// `None`: the equations vanish along the branch to within noise. Otherwise the order with which they vanish, beyond the
    /// truncation: the branch is then established to that order only.
    pub vanishing_order: Option<f64>,
    /// How many starts ended on it.
    pub hits: usize,
}

/// One way out of the origin.
#[derive(Clone, Debug)]
pub struct HalfBranch {
    /// Its point at the outermost radius.
    pub point: Vec<f64>,
    /// Its unit direction in the limit of small radius.
    pub tangent: Vec<f64>,
    /// Points on it at all radii, outermost first.
    pub path: Vec<Vec<f64>>,
}
