//! What two entities are to each other: yes, no, or within the digits.

use crate::boundary::{Face, classify_in_solid, clip_segment, in_face, same_points};
use crate::decide::{Answer, Decider, Sign, zero_vector};
use crate::entity::{Entity, Found, Line, Plane, Segment, no_pair};
use crate::error::GeometryError;
use crate::planar::Place;
use crate::round::{coincide_round, in_round, on_round};
use crate::scalar::Scalar;
use crate::triple::{cross, dot, minus};

/// What an entity says about directions.
pub(crate) enum Bearing<'a, S> {
    /// It runs along this.
    Along(&'a [S; 3]),
    /// It lies across this.
    Across(&'a [S; 3]),
}

/// The direction of a direction, line or segment or of an axis, the normal of a plane, a face or a circle.
pub(crate) fn bearing<S: Scalar>(entity: &Entity<S>) -> Option<Bearing<'_, S>> {
    match entity {
        Entity::Direction(d) => Some(Bearing::Along(d.components())),
        Entity::Line(l) => Some(Bearing::Along(l.direction().components())),
        Entity::Segment(s) => Some(Bearing::Along(s.direction().components())),
        Entity::Plane(p) => Some(Bearing::Across(p.normal().components())),
        Entity::Face(f) => Some(Bearing::Across(f.plane().normal().components())),
        Entity::Circle(c) => Some(Bearing::Across(c.plane().normal().components())),
        Entity::Cylinder(c) => Some(Bearing::Along(c.axis().direction().components())),
        Entity::Cone(c) => Some(Bearing::Along(c.axis().direction().components())),
        Entity::Vector(_) | Entity::Point(_) | Entity::Boundary(_) | Entity::Sphere(_) => None,
    }
}

/// A point and the direction of a line or a segment.
pub(crate) fn straight<S: Scalar>(entity: &Entity<S>) -> Option<(&[S; 3], &[S; 3])> {
    match entity {
        Entity::Line(l) => Some((&l.point().0, l.direction().components())),
        Entity::Segment(s) => Some((&s.from().0, s.direction().components())),
        _ => None,
    }
}

fn on_line<S: Scalar>(point: &[S; 3], line: (&[S; 3], &[S; 3])) -> Answer {
    zero_vector(&cross(&minus(point, line.0), line.1))
}

fn in_plane<S: Scalar>(point: &[S; 3], plane: &Plane<S>) -> Answer {
    Answer::zero(plane.height(point).sign())
}

fn along_plane<S: Scalar>(direction: &[S; 3], plane: &Plane<S>) -> Answer {
    Answer::zero(dot(direction, plane.normal().components()).sign())
}

fn one_line<S: Scalar>(a: (&[S; 3], &[S; 3]), b: (&[S; 3], &[S; 3])) -> Answer {
    zero_vector(&cross(a.1, b.1)).and(on_line(b.0, a))
}

fn same<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> Answer {
    zero_vector(&minus(a, b))
}

fn one_plane<S: Scalar>(a: &Plane<S>, b: &Plane<S>) -> Answer {
    let normals = cross(a.normal().components(), b.normal().components());
    zero_vector(&normals).and(in_plane(&b.point().0, a))
}

fn on_segment<S: Scalar>(point: &[S; 3], segment: &Segment<S>) -> Answer {
    let direction = segment.direction().components();
    let after = dot(&minus(point, &segment.from().0), direction);
    let before = dot(&minus(&segment.to().0, point), direction);
    on_line(point, (&segment.from().0, direction))
        .and(Answer::not_negative(after.sign()))
        .and(Answer::not_negative(before.sign()))
}

/// The same vectors, the same direction and sense, the same points; lines and planes as sets, whatever point and direction
/// they were made from; segments with their ends in either order.
///
/// # Errors
/// For entities of two kinds.
pub fn coincide<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    match (a, b) {
        (Entity::Vector(x), Entity::Vector(y)) => Ok(same(&x.0, &y.0)),
        (Entity::Point(x), Entity::Point(y)) => Ok(same(&x.0, &y.0)),
        (Entity::Direction(x), Entity::Direction(y)) => {
            let (x, y) = (x.components(), y.components());
            let sense = match dot(x, y).sign() {
                Sign::Zero => Answer::No,
                other => Answer::not_negative(other),
            };
            Ok(zero_vector(&cross(x, y)).and(sense))
        }
        (Entity::Line(_), Entity::Line(_)) => colinear(a, b),
        (Entity::Plane(x), Entity::Plane(y)) => Ok(one_plane(x, y)),
        (Entity::Segment(x), Entity::Segment(y)) => {
            let forth = same(&x.from().0, &y.from().0).and(same(&x.to().0, &y.to().0));
            let back = same(&x.from().0, &y.to().0).and(same(&x.to().0, &y.from().0));
            Ok(forth.or(back))
        }
        (Entity::Face(x), Entity::Face(y)) => {
            let plane = one_plane(x.plane(), y.plane());
            Ok(match plane.is_no() {
                true => Answer::No,
                false => plane.and(same_points(x, y)),
            })
        }
        _ => coincide_round(a, b).ok_or_else(|| no_pair("coincide", a, b)),
    }
}

/// Whether one line contains both: points, lines, segments, at least one of which is no point.
///
/// # Errors
/// For other pairs.
pub fn colinear<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    match (straight(a), straight(b), a, b) {
        (Some(x), Some(y), _, _) => Ok(one_line(x, y)),
        (Some(line), None, _, Entity::Point(p)) | (None, Some(line), Entity::Point(p), _) => {
            Ok(on_line(&p.0, line))
        }
        _ => Err(no_pair("colinear", a, b)),
    }
}

/// Whether one plane contains both: lines and segments among themselves, and anything with a plane, or with a face or a circle, which
/// stand for their planes.
///
/// # Errors
/// For vectors and directions, and for a point with what is no plane, which are always in one.
pub fn coplanar<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    let (of_a, of_b) = (plane_of_face(a), plane_of_face(b));
    let (own_a, own_b) = (of_a.as_ref().unwrap_or(a), of_b.as_ref().unwrap_or(b));
    in_one_plane(own_a, own_b).map_err(|_| no_pair("coplanar", a, b))
}

fn plane_of_face<S: Scalar>(entity: &Entity<S>) -> Option<Entity<S>> {
    match entity {
        Entity::Face(face) => Some(face.plane().clone().into()),
        Entity::Circle(circle) => Some(circle.plane().clone().into()),
        _ => None,
    }
}

fn in_one_plane<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    if let (Some((p, d)), Some((q, e))) = (straight(a), straight(b)) {
        return Ok(Answer::zero(dot(&minus(q, p), &cross(d, e)).sign()));
    }
    match (a, b) {
        (Entity::Plane(x), Entity::Plane(y)) => Ok(one_plane(x, y)),
        (Entity::Plane(_), _) => contained(b, a),
        (_, Entity::Plane(_)) => contained(a, b),
        _ => Err(no_pair("coplanar", a, b)),
    }
}

/// Whether the first is a part of the second: points, lines and segments in lines, segments and planes; points and segments
/// in faces, faces and circles in planes, points in solids; points on circles, cylinders, cones and spheres, lines on cylinders, segments on cylinders
/// and cones, circles on cylinders, cones and spheres. Borders belong to what they bound.
///
/// # Errors
/// For other pairs, for a line in a segment, a face or a cone and for what is straight in a circle or a sphere, which it never is, and for a boundary that
/// is not one of a solid.
pub fn contained<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    match (a, b) {
        (Entity::Point(p), Entity::Plane(plane)) => Ok(in_plane(&p.0, plane)),
        (Entity::Point(p), Entity::Segment(s)) => Ok(on_segment(&p.0, s)),
        (Entity::Segment(x), Entity::Segment(y)) => {
            Ok(on_segment(&x.from().0, y).and(on_segment(&x.to().0, y)))
        }
        (Entity::Segment(s), Entity::Plane(plane)) => {
            Ok(in_plane(&s.from().0, plane).and(in_plane(&s.to().0, plane)))
        }
        (Entity::Line(line), Entity::Plane(plane)) => Ok(line_in_plane(line, plane)),
        (Entity::Point(p), Entity::Face(face)) => Ok(in_face(p, face)),
        (Entity::Segment(s), Entity::Face(face)) => segment_in_face(s, face),
        (Entity::Face(face), Entity::Plane(plane)) => Ok(face
            .corners()
            .map(|corner| in_plane(&corner.0, plane))
            .fold(Answer::Yes, Answer::and)),
        (Entity::Point(p), Entity::Boundary(solid)) => {
            let found = classify_in_solid(p, solid)?;
            Ok(found.certainty.answer(found.value != Place::Outside))
        }
        (Entity::Point(_) | Entity::Line(_) | Entity::Segment(_), Entity::Line(_)) => {
            colinear(a, b).map_err(|_| no_pair("contained", a, b))
        }
        (Entity::Point(p), _) => on_round(p, b).ok_or_else(|| no_pair("contained", a, b)),
        (Entity::Circle(circle), Entity::Plane(plane)) => Ok(one_plane(circle.plane(), plane)),
        _ => in_round(a, b).ok_or_else(|| no_pair("contained", a, b)),
    }
}

fn line_in_plane<S: Scalar>(line: &Line<S>, plane: &Plane<S>) -> Answer {
    along_plane(line.direction().components(), plane).and(in_plane(&line.point().0, plane))
}

/// Whether a segment is one part of what the face cuts out of it, from end to end.
fn segment_in_face<S: Scalar>(
    segment: &Segment<S>,
    face: &Face<S>,
) -> Result<Answer, GeometryError> {
    let (from, to) = (&segment.from().0, &segment.to().0);
    let level = in_plane(from, face.plane()).and(in_plane(to, face.plane()));
    if level.is_no() {
        return Ok(Answer::No);
    }
    let mut decider = Decider::default();
    let found = clip_segment(segment, face, &mut decider)?;
    let certainty = decider.certainty();
    Ok(match found {
        Found::Segment(part) => {
            let ends = same(&part.from().0, from).and(same(&part.to().0, to));
            level.and(certainty.answer(true)).and(ends)
        }
        _ => level.and(certainty.answer(false)),
    })
}

/// Whether two of direction, line, segment, axis (of a cylinder or a cone), plane, face and circle are parallel; what coincides is.
///
/// # Errors
/// For vectors, which may be zero, for points, spheres and boundaries.
pub fn parallel<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    match (bearing(a), bearing(b)) {
        (Some(Bearing::Along(u)), Some(Bearing::Along(v)))
        | (Some(Bearing::Across(u)), Some(Bearing::Across(v))) => Ok(zero_vector(&cross(u, v))),
        (Some(Bearing::Along(u)), Some(Bearing::Across(v)))
        | (Some(Bearing::Across(u)), Some(Bearing::Along(v))) => Ok(Answer::zero(dot(u, v).sign())),
        _ => Err(no_pair("parallel", a, b)),
    }
}

/// Whether two of direction, line, segment, axis (of a cylinder or a cone), plane, face and circle are at a right angle; lines need not meet for it.
///
/// # Errors
/// For vectors, which may be zero, for points, spheres and boundaries.
pub fn perpendicular<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    match (bearing(a), bearing(b)) {
        (Some(Bearing::Along(u)), Some(Bearing::Along(v)))
        | (Some(Bearing::Across(u)), Some(Bearing::Across(v))) => {
            Ok(Answer::zero(dot(u, v).sign()))
        }
        (Some(Bearing::Along(u)), Some(Bearing::Across(v)))
        | (Some(Bearing::Across(u)), Some(Bearing::Along(v))) => Ok(zero_vector(&cross(u, v))),
        _ => Err(no_pair("perpendicular", a, b)),
    }
}
