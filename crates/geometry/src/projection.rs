//! Shadows: of points, lines and segments on lines and planes.

use crate::boundary::{Face, Ratio, clip_line, clip_segment};
use crate::decide::{Decider, Outcome};
use crate::entity::{Direction, Entity, Found, Line, Plane, Point, Segment, no_pair};
use crate::error::GeometryError;
use crate::intersection::{of_lines, with_plane};
use crate::join::{on_line, on_plane};
use crate::planar::Place;
use crate::projection_round::{circle_on_plane, on_what_is_round};
use crate::scalar::Scalar;
use crate::triple::{cross, minus};

/// The shadow of the first on the second, along a direction; perpendicular where none is given.
///
/// Of a point on a line, a plane or a face, of a line or a segment on a plane or a face: a line whose direction is that of the
/// light has a point for a shadow. On a face it is what of the shadow on its plane belongs to the face: a set of
/// segments and points. Nothing where the direction runs along the plane, and where a point's ray misses the line.
///
/// Of a point on a circle, a cylinder, a cone or a sphere: the nearest point of it, or all points that the line of the light meets, to either side. Of a
/// circle on a plane parallel to its own a circle, at right angles to it, in perpendicular light, a segment.
///
/// # Errors
/// For other pairs, and beyond the range of numbers; for a point on the axis or centre of what is round, to which a whole circle is as near; for a
/// circle whose shadow is an ellipse.
pub fn projection<S: Scalar>(
    a: &Entity<S>,
    on: &Entity<S>,
    light: Option<&Direction<S>>,
) -> Result<Outcome<Found<S>>, GeometryError> {
    let mut decider = Decider::default();
    let found = match (a, on) {
        (Entity::Point(p), Entity::Line(line)) => match light {
            None => Found::Point(Point(on_line(&p.0, line)?)),
            Some(light) => point_along(p, light, line, &mut decider)?,
        },
        (Entity::Point(p), Entity::Plane(plane)) => {
            match shadow(&p.0, plane, light, &mut decider)? {
                Some(point) => Found::Point(Point(point)),
                None => Found::Nothing,
            }
        }
        (Entity::Line(line), Entity::Plane(plane)) => of_line(line, plane, light, &mut decider)?,
        (Entity::Segment(segment), Entity::Plane(plane)) => {
            of_segment(segment, plane, light, &mut decider)?
        }
        (Entity::Point(p), Entity::Face(face)) => {
            match shadow(&p.0, face.plane(), light, &mut decider)? {
                Some(point) => on_face(Found::Point(Point(point)), face, &mut decider)?,
                None => Found::Nothing,
            }
        }
        (Entity::Line(line), Entity::Face(face)) => {
            let whole = of_line(line, face.plane(), light, &mut decider)?;
            on_face(whole, face, &mut decider)?
        }
        (Entity::Segment(segment), Entity::Face(face)) => {
            let whole = of_segment(segment, face.plane(), light, &mut decider)?;
            on_face(whole, face, &mut decider)?
        }
        (Entity::Circle(circle), Entity::Plane(plane)) => {
            match shadow(&circle.centre().0, plane, light, &mut decider)? {
                Some(centre) => {
                    let is_straight = light.is_none();
                    circle_on_plane(circle, plane, Point(centre), is_straight, &mut decider)?
                }
                None => Found::Nothing,
            }
        }
        (Entity::Point(p), round) => {
            let found = on_what_is_round(p, round, light, &mut decider)?;
            found.ok_or_else(|| no_pair("projection", a, on))?
        }
        _ => return Err(no_pair("projection", a, on)),
    };
    Ok(decider.outcome(found))
}

/// What of a shadow on the plane of a face belongs to the face.
fn on_face<S: Scalar>(
    shadow: Found<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    Ok(match shadow {
        Found::Point(point) => match face.place(&Ratio::of(&point.0), decider) {
            Place::Outside => Found::Nothing,
            Place::Inside | Place::OnBorder => Found::Point(point),
        },
        Found::Line(line) => clip_line(&line, face, decider)?,
        Found::Segment(segment) => clip_segment(&segment, face, decider)?,
        other => other,
    })
}

fn point_along<S: Scalar>(
    point: &Point<S>,
    light: &Direction<S>,
    line: &Line<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let ray = Line::new(point.clone(), light.clone());
    Ok(match of_lines(line, &ray, decider)? {
        Found::Point(found) => Found::Point(found),
        // Along the line itself there is no one point.
        _ => Found::Nothing,
    })
}

/// The shadow of a point on a plane.
fn shadow<S: Scalar>(
    point: &[S; 3],
    plane: &Plane<S>,
    light: Option<&Direction<S>>,
    decider: &mut Decider,
) -> Result<Option<[S; 3]>, GeometryError> {
    let Some(light) = light else {
        return Ok(Some(on_plane(point, plane)?));
    };
    let ray = Line::new(Point(point.clone()), light.clone());
    Ok(match with_plane(&ray, plane, decider)? {
        Found::Point(found) => Some(found.0),
        _ => None,
    })
}

fn of_line<S: Scalar>(
    line: &Line<S>,
    plane: &Plane<S>,
    light: Option<&Direction<S>>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let Some(point) = shadow(&line.point().0, plane, light, decider)? else {
        return Ok(Found::Nothing);
    };
    let direction = line.direction().components();
    let normal = plane.normal().components();
    let light = light.unwrap_or(plane.normal()).components();
    // The plane of light through the line meets the plane along this.
    let shade = cross(&cross(direction, light), normal);
    if decider.vanishes(&cross(direction, light)) || decider.vanishes(&shade) {
        return Ok(Found::Point(Point(point)));
    }
    Ok(Found::Line(Line::new(Point(point), Direction::new(shade)?)))
}

fn of_segment<S: Scalar>(
    segment: &Segment<S>,
    plane: &Plane<S>,
    light: Option<&Direction<S>>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let from = shadow(&segment.from().0, plane, light, decider)?;
    let to = shadow(&segment.to().0, plane, light, decider)?;
    let (Some(from), Some(to)) = (from, to) else {
        return Ok(Found::Nothing);
    };
    let direction = segment.direction().components();
    let light = light.unwrap_or(plane.normal()).components();
    if decider.vanishes(&cross(direction, light)) || decider.vanishes(&minus(&to, &from)) {
        return Ok(Found::Point(Point(from)));
    }
    Ok(Found::Segment(Segment::new(Point(from), Point(to))?))
}
