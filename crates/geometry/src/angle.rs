//! Angles, from sines and cosines that share a factor.

use crate::decide::{Decider, Outcome};
use crate::entity::{Direction, Entity, no_pair};
use crate::error::GeometryError;
use crate::logical::{Bearing, bearing};
use crate::scalar::Scalar;
use crate::triple::{cross, dot, length, square};
use std::cmp::Ordering;

/// Two angles in radians.
#[derive(Clone, Debug)]
pub struct Angles<S> {
    /// From the first to the second.
    pub angle: S,
    /// From the first to the second reversed.
    pub supplement: S,
}

fn arctangent<S: Scalar>(sine: &S, cosine: &S) -> Result<S, GeometryError> {
    S::arctangent(sine, cosine).ok_or(GeometryError::OutOfRange {
        needed: "a sine and a cosine that are not both zero",
    })
}

/// The angle between two of direction, line, segment, plane and face, and its supplement to half a turn.
///
/// Between two directions in [0, π]. Lines, segments, planes and faces have no sense here: between two of them, and from a line to
/// the plane that it pierces, the lesser of both angles, in [0, π/2].
///
/// # Errors
/// For vectors and points, and beyond the range of numbers.
pub fn angle_between<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Angles<S>, GeometryError> {
    let directed = matches!((a, b), (Entity::Direction(_), Entity::Direction(_)));
    let angle = match (bearing(a), bearing(b)) {
        (Some(Bearing::Along(u)), Some(Bearing::Along(v)))
        | (Some(Bearing::Across(u)), Some(Bearing::Across(v))) => {
            let cosine = dot(u, v);
            let cosine = if directed { cosine } else { cosine.magnitude() };
            arctangent(&length(&cross(u, v))?, &cosine)?
        }
        (Some(Bearing::Along(u)), Some(Bearing::Across(v)))
        | (Some(Bearing::Across(u)), Some(Bearing::Along(v))) => {
            arctangent(&dot(u, v).magnitude(), &length(&cross(u, v))?)?
        }
        _ => return Err(no_pair("angle_between", a, b)),
    };
    let supplement = S::half_turn().minus(&angle);
    Ok(Angles { angle, supplement })
}

/// The angle in (−π, π] that turns the first direction about an axis into the half plane (bounded by the axis) of the
/// second; of planes and faces, their normals. Counterclockwise seen against the axis is positive. Beside it the angle to
/// the second reversed.
///
/// # Errors
/// For other pairs, and where a direction is along the axis, or may be within its digits.
pub fn signed_angle_between<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
    about: &Direction<S>,
) -> Result<Outcome<Angles<S>>, GeometryError> {
    let directed = matches!((a, b), (Entity::Direction(_), Entity::Direction(_)));
    let (u, v) = match (bearing(a), bearing(b)) {
        (Some(Bearing::Along(u)), Some(Bearing::Along(v))) if directed => (u, v),
        (Some(Bearing::Across(u)), Some(Bearing::Across(v))) => (u, v),
        _ => return Err(no_pair("signed_angle_between", a, b)),
    };
    let axis = about.components();
    let needed = "directions that are not along the axis of the angle";
    Direction::for_entity(cross(u, axis), needed)?;
    Direction::for_entity(cross(v, axis), needed)?;
    // Of what is left of both across the axis, times the square of the axis' length.
    let along = dot(u, axis).times(&dot(v, axis));
    let cosine = dot(u, v).times(&square(axis)).minus(&along);
    let sine = dot(axis, &cross(u, v)).times(&length(axis)?);
    let angle = arctangent(&sine, &cosine)?;
    let mut decider = Decider::default();
    let supplement = match decider.order(&sine) {
        Ordering::Greater => angle.minus(&S::half_turn()),
        Ordering::Less => angle.plus(&S::half_turn()),
        Ordering::Equal if decider.order(&cosine) == Ordering::Less => angle.minus(&S::half_turn()),
        Ordering::Equal => angle.plus(&S::half_turn()),
    };
    Ok(decider.outcome(Angles { angle, supplement }))
}
