//! How far two entities are from each other.

use crate::boundary::{
    between_faces, between_segments, line_to_face, line_to_segment, plane_to_face, plane_to_points,
    point_to_face, segment_to_face,
};
use crate::clearance::clearance;
use crate::decide::{Decider, Outcome};
use crate::entity::{Entity, Plane, Segment, no_pair};
use crate::error::GeometryError;
use crate::round::distance_round;
use crate::scalar::Scalar;
use crate::triple::{cross, dot, length, minus, quotient, root, square};
use std::cmp::Ordering;

/// The least distance of points of the two, never below zero.
///
/// Of point, line, segment and plane each with each, and of each of them and a face with a face; of point and plane with
/// circle, cylinder, cone and sphere, of a line and a segment with cylinder and sphere, of cylinder and sphere each with each, of a sphere with circle and
/// cone, and of circles, cylinders and cones where these are parallel or have one axis, all of which are empty:
/// a point inside is away from them. What meets has distance 0; whether lines or planes do is a choice, of which [`Outcome::certainty`] tells the
/// ground.
///
/// # Errors
/// For other pairs, and beyond the range of numbers.
pub fn distance<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Outcome<S>, GeometryError> {
    let mut decider = Decider::default();
    let found = match (a, b) {
        (Entity::Point(p), Entity::Point(q)) => length(&minus(&p.0, &q.0))?,
        (Entity::Point(p), Entity::Line(l)) | (Entity::Line(l), Entity::Point(p)) => {
            to_line(&p.0, &l.point().0, l.direction().components())?
        }
        (Entity::Point(p), Entity::Segment(s)) | (Entity::Segment(s), Entity::Point(p)) => {
            to_segment(&p.0, s, &mut decider)?
        }
        (Entity::Point(p), Entity::Plane(plane)) | (Entity::Plane(plane), Entity::Point(p)) => {
            to_plane(&p.0, plane)?
        }
        (Entity::Line(x), Entity::Line(y)) => {
            let first = (&x.point().0, x.direction().components());
            of_lines(
                first,
                (&y.point().0, y.direction().components()),
                &mut decider,
            )?
        }
        (Entity::Line(l), Entity::Plane(plane)) | (Entity::Plane(plane), Entity::Line(l)) => {
            let rise = dot(l.direction().components(), plane.normal().components());
            match decider.is_zero(&rise) {
                true => to_plane(&l.point().0, plane)?,
                false => S::whole(0),
            }
        }
        (Entity::Plane(x), Entity::Plane(y)) => {
            let edge = cross(x.normal().components(), y.normal().components());
            match decider.vanishes(&edge) {
                true => to_plane(&y.point().0, x)?,
                false => S::whole(0),
            }
        }
        (Entity::Face(_) | Entity::Segment(_), _) | (_, Entity::Face(_) | Entity::Segment(_)) => {
            match bounded(a, b, &mut decider)? {
                Some(square) => root(&square)?,
                None => {
                    let found = clearance(a, b, &mut decider)?;
                    found.ok_or_else(|| no_pair("distance", a, b))?
                }
            }
        }
        _ => {
            let found = match distance_round(a, b, &mut decider)? {
                None => clearance(a, b, &mut decider)?,
                found => found,
            };
            found.ok_or_else(|| no_pair("distance", a, b))?
        }
    };
    Ok(decider.outcome(found))
}

/// The square of the distance of pairs with a segment or a face, but for a point beside a segment; none where a pair has no
/// distance.
fn bounded<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<S>, GeometryError> {
    let ends = |s: &Segment<S>| [s.from().clone(), s.to().clone()];
    let found = match (a, b) {
        (Entity::Segment(s), Entity::Segment(t)) => {
            between_segments((&s.from().0, &s.to().0), (&t.from().0, &t.to().0), decider)?
        }
        (Entity::Segment(s), Entity::Line(l)) | (Entity::Line(l), Entity::Segment(s)) => {
            line_to_segment(l, &s.from().0, &s.to().0, decider)?
        }
        (Entity::Segment(s), Entity::Plane(p)) | (Entity::Plane(p), Entity::Segment(s)) => {
            plane_to_points(p, ends(s).iter(), decider)?
        }
        (Entity::Face(f), Entity::Point(p)) | (Entity::Point(p), Entity::Face(f)) => {
            point_to_face(&p.0, f, decider)?
        }
        (Entity::Face(f), Entity::Line(l)) | (Entity::Line(l), Entity::Face(f)) => {
            line_to_face(l, f, decider)?
        }
        (Entity::Face(f), Entity::Segment(s)) | (Entity::Segment(s), Entity::Face(f)) => {
            segment_to_face(s, f, decider)?
        }
        (Entity::Face(f), Entity::Plane(p)) | (Entity::Plane(p), Entity::Face(f)) => {
            plane_to_face(p, f, decider)?
        }
        (Entity::Face(f), Entity::Face(g)) => between_faces(f, g, decider)?,
        _ => return Ok(None),
    };
    Ok(Some(found))
}

/// From the line through `base` along `direction`.
pub(crate) fn to_line<S: Scalar>(
    point: &[S; 3],
    base: &[S; 3],
    direction: &[S; 3],
) -> Result<S, GeometryError> {
    let across = square(&cross(&minus(point, base), direction));
    root(&quotient(&across, &square(direction))?)
}

fn to_plane<S: Scalar>(point: &[S; 3], plane: &Plane<S>) -> Result<S, GeometryError> {
    let squared = quotient(
        &plane.height(point).squared(),
        &square(plane.normal().components()),
    )?;
    root(&squared)
}

/// From the nearer end where the foot is outside.
pub(crate) fn to_segment<S: Scalar>(
    point: &[S; 3],
    segment: &Segment<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let (from, to) = (&segment.from().0, &segment.to().0);
    let direction = segment.direction().components();
    if decider.order(&dot(&minus(point, from), direction)) == Ordering::Less {
        return length(&minus(point, from));
    }
    if decider.order(&dot(&minus(to, point), direction)) == Ordering::Less {
        return length(&minus(point, to));
    }
    to_line(point, from, direction)
}

/// Of two lines, each a point and a direction.
pub(crate) fn of_lines<S: Scalar>(
    a: (&[S; 3], &[S; 3]),
    b: (&[S; 3], &[S; 3]),
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let common = cross(a.1, b.1);
    if decider.vanishes(&common) {
        return to_line(b.0, a.0, a.1);
    }
    let between = dot(&minus(b.0, a.0), &common);
    root(&quotient(&between.squared(), &square(&common))?)
}
