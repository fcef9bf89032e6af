//! Static geometric reasoning: what points, straight lines, planes, segments, faces and solids are to each other.
//!
//! # Two forms
//! Every function is written once over [`Scalar`] and has two forms by the numbers that it is given:
//! - **exact** over `kutzbach_math::number::Number`: fractions, roots, algebraic numbers. An answer is proven; where an
//!   expression has no separation bound ([`ZeroTest::Indistinguishable`](kutzbach_math::number::ZeroTest)) the answer is
//!   [`Answer::Indistinguishable`];
//! - **tolerant** over [`Measured`]: doubles, each with its uncertainty, carried along as intervals. The answer is *yes* or
//!   *no* where it is the same for all values within the digits, and [`Answer::WithinDigits`] elsewhere.
//!
//! # Logical and constructive
//! Logical functions ([`coincide`], [`colinear`], [`coplanar`], [`contained`], [`parallel`], [`perpendicular`], [`convex`],
//! [`concave`], [`coaxial`], [`concentric`]) give an [`Answer`]. Constructive ones ([`distance`], [`intersection`], ...) have to choose a case to have a result: what cannot be
//! told from zero counts as zero there, and [`Outcome::certainty`] says so. Functions take [`Entity`] values, since what
//! something is may be known only at run time; a pair of arguments for which a function has no meaning is an error.
//!
//! # Entities are valid
//! A direction is never zero, a line never goes through one point only: what is degenerate, or may be within its digits, is
//! an error when it is made. Numbers that are left open (`Number::parameter`) are taken at their values.
//!
//! # Topology
//! A [`Face`] is flat, between loops of straight edges. A [`Boundary`], made by a [`BoundaryBuilder`], says which vertices, edges,
//! loops, faces and shells are connected, of an open surface or of a solid; it need be no manifold. Results that are sets
//! ([`Found::Several`]) have points and segments as members. [`space_hull`] makes the boundary of a convex solid from points.
//!
//! # Text
//! [`read_world`] reads entities with names into a [`World`]; [`ask`] answers questions about it in a small language, in which names
//! may be free; [`features`] finds what a declaration says in the boundaries of parts.
//!
//! # Motions
//! A [`Transformation`] is a rotation and a translation; it moves every entity, and exactly so where its numbers are exact.

mod angle;
pub mod ask;
mod boundary;
mod clearance;
mod curved;
mod decide;
mod distance;
mod entity;
mod error;
pub mod features;
mod hull;
mod intersection;
mod intersection_round;
mod intersection_rounds;
mod join;
mod logical;
mod measured;
mod planar;
mod projection;
mod projection_round;
#[cfg(test)]
mod random_faces;
#[cfg(test)]
mod random_hulls;
#[cfg(test)]
mod random_motions;
#[cfg(test)]
mod random_round;
#[cfg(test)]
mod random_tests;
mod round;
mod scalar;
#[cfg(test)]
mod tests;
mod text;
mod transform;
mod triple;
mod world;

pub use angle::{Angles, angle_between, signed_angle_between};
pub use boundary::{
    Boundary, BoundaryBuilder, Edge, EdgeUse, Face, FacePlace, Shell, classify_by_face,
    classify_in_face, classify_in_solid, concave, convex,
};
pub use curved::{Circle, Cone, Cylinder, Sphere};
pub use decide::{Answer, Certainty, Outcome, Sign};
pub use distance::distance;
pub use entity::{Direction, Entity, Found, Kind, Line, Plane, Point, Segment, Vector};
pub use error::{GeometryError, Spot};
pub use hull::space_hull;
pub use intersection::intersection;
pub use join::{Feet, join_perpend, perpend};
pub use logical::{coincide, colinear, contained, coplanar, parallel, perpendicular};
pub use measured::Measured;
pub use planar::{
    Place, Side, calculate_normal, classify, classify_in_polygon, planar_hull, sort_angular,
};
pub use projection::projection;
pub use round::{classify_by_round, coaxial, compare_radii, concentric, radius_difference};
pub use scalar::Scalar;
pub use text::{Legible, Reading, TextError, read_world};
pub use transform::Transformation;
pub use world::{Id, World, WorldError};
