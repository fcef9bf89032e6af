//! Planar constructions: constraint graphs of two freedoms a vertex, and what ruler and compass can do with them.
//!
//! A vertex is a point or a line of the plane, an edge a constraint that takes one freedom. Such a graph is *well-constrained*
//! where a count over all its subgraphs is right, and *constructive* where it falls apart into triangles: then every solution is
//! found by intersecting two circles, a circle and a line, or two lines, one after the other.
//!
//! | module | what it knows |
//! |---|---|
//! | [`graph`] | constraint graphs and their deficit |
//! | [`pebbles`] | what is over- and under-constrained, and why |
//! | [`counted`] | the same of sketches with many lines, whose directions count too |
//! | [`analysis`] | three ways to find out whether a graph is constructive: reduction, decomposition, s-tree |
//! | [`sketch`] | points, lines, and what holds between them |
//! | [`relation`] | what holds between three elements or more, and by unknown values |
//! | [`named`] | sketches as files have them, with circles |
//! | [`construction`] | every solution, step by step |
//! | [`together`] | what circles and lines do not construct, solved at once |
//! | [`planar`] | planar mechanisms as sketches |
//! | [`redundancy`] | whether a constraint too many agrees with the others |
//! | [`words`], [`cluster_words`], [`picture`], [`tree_picture`] | the answers as text, data, graph and pictures |
//! | [`samples`] | graphs by name, by Henneberg moves, and all small ones |
//!
//! Sources: Laman (1970); Owen (1991); Jacobs and Hendrickson (1997); Soto i Riera, *Constructive Geometric Constraint Solving*
//! (2002).

pub mod analysis;
pub mod cluster_words;
pub mod construction;
pub mod counted;
pub mod graph;
pub mod named;
pub mod pebbles;
pub mod picture;
pub mod planar;
pub mod redundancy;
pub mod relation;
pub mod samples;
mod senses;
pub mod sketch;
pub mod together;
pub mod tree_picture;
pub mod words;
