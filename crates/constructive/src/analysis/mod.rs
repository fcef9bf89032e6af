//! Three ways to find out whether a graph is constructive, and how it is constructed.
//!
//! # The theorem
//! Of a well-constrained graph it is the same whether it can be reduced, decomposed, or taken apart into triangles along
//! separating pairs (Soto i Riera 2002); none of the three finds a way through a graph that is not well-constrained, since what
//! each puts together again is well-constrained. Tests compare them; nothing here relies on that.
//!
//! - [`reduce`]: edges are clusters at first; three that share three vertices pairwise become one. This is the order of
//!   construction, [`Merge`] by [`Merge`].
//! - [`decompose`]: the same rule backwards, from all vertices.
//! - [`s_tree`]: Owen's algorithm, reformulated: split at a pair of vertices, and one of the two sides gets an edge for what the
//!   other does to the pair.
//!
//! A solution has V − 2 merges, splits, or triangles, whichever way.

mod blocks;
mod decomposition;
mod local;
mod peeling;
mod reduction;
mod s_tree;
mod separation;

pub use decomposition::{Decomposition, Part, SetDecomposition, decompose};
pub use reduction::{Merge, Reduction, reduce};
pub use s_tree::{LeafKind, Node, STree, Tie, s_tree};

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
