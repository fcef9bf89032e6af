//! What two entities have in common.

use crate::boundary;
use crate::decide::{Decider, Outcome};
use crate::entity::{Direction, Entity, Found, Line, Plane, Point, Segment, no_pair};
use crate::error::GeometryError;
use crate::intersection_round::with_round;
use crate::intersection_rounds::of_rounds;
use crate::scalar::Scalar;
use crate::triple::{along, cross, dot, minus, square};
use std::cmp::Ordering;

/// The points that belong to both: nothing, a point, a line, a segment or a plane; with a face a set of segments and points,
/// or the face itself in its own plane; with what is round a set of points or lines, or a circle.
///
/// Of line, segment and plane each with each, with a face, and with circle, cylinder, cone and sphere, but not of two segments; of circle, cylinder,
/// cone and sphere each with each. Two measured lines never certainly meet: where they
/// may within their digits, the point is on the first one, and the certainty says so.
///
/// # Errors
/// For other pairs, and beyond the range of numbers; for a line along the side of a cone, of which half is common, for a plane that cuts an
/// ellipse or another conic that is no circle, and for surfaces that meet in a curve that is neither a circle nor a line.
pub fn intersection<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
) -> Result<Outcome<Found<S>>, GeometryError> {
    let mut decider = Decider::default();
    let found = match (a, b) {
        (Entity::Line(x), Entity::Line(y)) => of_lines(x, y, &mut decider)?,
        (Entity::Line(l), Entity::Plane(p)) | (Entity::Plane(p), Entity::Line(l)) => {
            with_plane(l, p, &mut decider)?
        }
        (Entity::Plane(x), Entity::Plane(y)) => of_planes(x, y, &mut decider)?,
        (Entity::Segment(s), Entity::Plane(p)) | (Entity::Plane(p), Entity::Segment(s)) => {
            segment_with_plane(s, p, &mut decider)?
        }
        (Entity::Segment(s), Entity::Line(l)) | (Entity::Line(l), Entity::Segment(s)) => {
            segment_with_line(s, l, &mut decider)?
        }
        (Entity::Line(l), Entity::Face(f)) | (Entity::Face(f), Entity::Line(l)) => {
            boundary::of_line(l, f, &mut decider)?
        }
        (Entity::Segment(s), Entity::Face(f)) | (Entity::Face(f), Entity::Segment(s)) => {
            boundary::of_segment(s, f, &mut decider)?
        }
        (Entity::Plane(p), Entity::Face(f)) | (Entity::Face(f), Entity::Plane(p)) => {
            boundary::of_plane(p, f, &mut decider)?
        }
        _ => {
            let found = match with_round(a, b, &mut decider)? {
                None => of_rounds(a, b, &mut decider)?,
                found => found,
            };
            found.ok_or_else(|| no_pair("intersection", a, b))?
        }
    };
    Ok(decider.outcome(found))
}

/// Of lines: where they meet, on the first.
pub(crate) fn of_lines<S: Scalar>(
    a: &Line<S>,
    b: &Line<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (d, e) = (a.direction().components(), b.direction().components());
    let offset = minus(&b.point().0, &a.point().0);
    let common = cross(d, e);
    if decider.vanishes(&common) {
        return Ok(match decider.vanishes(&cross(&offset, d)) {
            true => Found::Line(a.clone()),
            false => Found::Nothing,
        });
    }
    if !decider.is_zero(&dot(&offset, &common)) {
        return Ok(Found::Nothing);
    }
    let way = dot(&cross(&offset, e), &common);
    let point = along(&a.point().0, d, &way, &square(&common))?;
    Ok(Found::Point(Point(point)))
}

/// Of a line and a plane.
pub(crate) fn with_plane<S: Scalar>(
    line: &Line<S>,
    plane: &Plane<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let direction = line.direction().components();
    let rise = dot(direction, plane.normal().components());
    let height = plane.height(&line.point().0);
    if decider.is_zero(&rise) {
        return Ok(match decider.is_zero(&height) {
            true => Found::Line(line.clone()),
            false => Found::Nothing,
        });
    }
    let point = along(&line.point().0, direction, &height.negated(), &rise)?;
    Ok(Found::Point(Point(point)))
}

/// Of two planes.
pub(crate) fn of_planes<S: Scalar>(
    a: &Plane<S>,
    b: &Plane<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (m, n) = (a.normal().components(), b.normal().components());
    let edge = cross(m, n);
    let height = b.height(&a.point().0);
    if decider.vanishes(&edge) {
        return Ok(match decider.is_zero(&height) {
            true => Found::Plane(a.clone()),
            false => Found::Nothing,
        });
    }
    // In the first plane, across the edge, uphill for the second: it climbs by the square of the edge.
    let uphill = cross(&edge, m);
    let point = along(&a.point().0, &uphill, &height.negated(), &square(&edge))?;
    Ok(Found::Line(Line::new(Point(point), Direction::new(edge)?)))
}

fn segment_with_plane<S: Scalar>(
    segment: &Segment<S>,
    plane: &Plane<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let from = plane.height(&segment.from().0);
    let to = plane.height(&segment.to().0);
    Ok(match (decider.order(&from), decider.order(&to)) {
        (Ordering::Equal, Ordering::Equal) => Found::Segment(segment.clone()),
        (Ordering::Equal, _) => Found::Point(segment.from().clone()),
        (_, Ordering::Equal) => Found::Point(segment.to().clone()),
        (x, y) if x == y => Found::Nothing,
        _ => {
            let direction = segment.direction().components();
            let whole = from.minus(&to);
            let point = along(&segment.from().0, direction, &from, &whole)?;
            Found::Point(Point(point))
        }
    })
}

fn segment_with_line<S: Scalar>(
    segment: &Segment<S>,
    line: &Line<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    Ok(match of_lines(&segment.line(), line, decider)? {
        Found::Line(_) => Found::Segment(segment.clone()),
        Found::Point(point) => {
            let direction = segment.direction().components();
            let after = dot(&minus(&point.0, &segment.from().0), direction);
            let before = dot(&minus(&segment.to().0, &point.0), direction);
            let outside =
                decider.order(&after) == Ordering::Less || decider.order(&before) == Ordering::Less;
            match outside {
                true => Found::Nothing,
                false => Found::Point(point),
            }
        }
        _ => Found::Nothing,
    })
}
