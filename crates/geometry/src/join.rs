//! Common perpendiculars, and what is perpendicular to two entities.

use crate::decide::{Decider, Outcome};
use crate::entity::{Direction, Entity, Found, Line, Plane, Point, no_pair};
use crate::error::GeometryError;
use crate::scalar::Scalar;
use crate::triple::{along, cross, dot, minus, square};

/// The ends of a common perpendicular.
#[derive(Clone, Debug)]
pub struct Feet<S> {
    /// On the first entity.
    pub first: Point<S>,
    /// On the second entity.
    pub second: Point<S>,
    /// Whether it is one of many: of parallel lines, the one from the point that the first was made from.
    pub one_of_many: bool,
}

/// The two points, one on each, whose join is perpendicular to both: of a point and a line, a point and a plane, two lines.
/// Where they meet, both are one point.
///
/// # Errors
/// For other pairs, and beyond the range of numbers.
pub fn join_perpend<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
) -> Result<Outcome<Feet<S>>, GeometryError> {
    let mut decider = Decider::default();
    let feet = |first: [S; 3], second: [S; 3]| Feet {
        first: Point(first),
        second: Point(second),
        one_of_many: false,
    };
    let found = match (a, b) {
        (Entity::Point(p), Entity::Line(_) | Entity::Plane(_)) => {
            feet(p.0.clone(), foot(&p.0, a, b)?)
        }
        (Entity::Line(_) | Entity::Plane(_), Entity::Point(p)) => {
            feet(foot(&p.0, b, a)?, p.0.clone())
        }
        (Entity::Line(x), Entity::Line(y)) => feet_of_lines(x, y, &mut decider)?,
        _ => return Err(no_pair("join_perpend", a, b)),
    };
    Ok(decider.outcome(found))
}

/// The ends of the common perpendicular of two lines.
pub(crate) fn feet_of_lines<S: Scalar>(
    a: &Line<S>,
    b: &Line<S>,
    decider: &mut Decider,
) -> Result<Feet<S>, GeometryError> {
    let (p, d) = (&a.point().0, a.direction().components());
    let (q, e) = (&b.point().0, b.direction().components());
    let common = cross(d, e);
    if decider.vanishes(&common) {
        return Ok(Feet {
            first: a.point().clone(),
            second: Point(on_line(p, b)?),
            one_of_many: true,
        });
    }
    let offset = minus(q, p);
    let size = square(&common);
    let first = along(p, d, &dot(&cross(&offset, e), &common), &size)?;
    let second = along(q, e, &dot(&cross(&offset, d), &common), &size)?;
    Ok(Feet {
        first: Point(first),
        second: Point(second),
        one_of_many: false,
    })
}

/// The foot of a point on a line or a plane.
fn foot<S: Scalar>(
    point: &[S; 3],
    own: &Entity<S>,
    on: &Entity<S>,
) -> Result<[S; 3], GeometryError> {
    match on {
        Entity::Line(line) => on_line(point, line),
        Entity::Plane(plane) => on_plane(point, plane),
        _ => Err(no_pair("join_perpend", own, on)),
    }
}

/// The foot of a point on a line.
pub(crate) fn on_line<S: Scalar>(point: &[S; 3], line: &Line<S>) -> Result<[S; 3], GeometryError> {
    let direction = line.direction().components();
    let way = dot(&minus(point, &line.point().0), direction);
    along(&line.point().0, direction, &way, &square(direction))
}

/// The foot of a point on a plane.
pub(crate) fn on_plane<S: Scalar>(
    point: &[S; 3],
    plane: &Plane<S>,
) -> Result<[S; 3], GeometryError> {
    let normal = plane.normal().components();
    let down = plane.height(point).negated();
    along(point, normal, &down, &square(normal))
}

/// What is perpendicular to both, or through one and perpendicular to the other:
/// - of two lines the direction of their common perpendicular; of parallel ones that from the first to the second; nothing
///   where they coincide;
/// - of a line and a plane the plane that contains the line and is perpendicular to the plane; nothing where the line is
///   perpendicular to the plane itself;
/// - of a point and a line the plane through the point perpendicular to the line;
/// - of a point and a plane the line through the point perpendicular to the plane.
///
/// # Errors
/// For other pairs.
pub fn perpend<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
) -> Result<Outcome<Found<S>>, GeometryError> {
    let mut decider = Decider::default();
    let found = match (a, b) {
        (Entity::Point(p), Entity::Line(l)) | (Entity::Line(l), Entity::Point(p)) => {
            Found::Plane(Plane::new(p.clone(), l.direction().clone()))
        }
        (Entity::Point(p), Entity::Plane(plane)) | (Entity::Plane(plane), Entity::Point(p)) => {
            Found::Line(Line::new(p.clone(), plane.normal().clone()))
        }
        (Entity::Line(x), Entity::Line(y)) => of_lines(x, y, &mut decider)?,
        (Entity::Line(l), Entity::Plane(p)) | (Entity::Plane(p), Entity::Line(l)) => {
            let normal = cross(l.direction().components(), p.normal().components());
            match decider.vanishes(&normal) {
                true => Found::Nothing,
                false => Found::Plane(Plane::new(l.point().clone(), Direction::new(normal)?)),
            }
        }
        _ => return Err(no_pair("perpend", a, b)),
    };
    Ok(decider.outcome(found))
}

fn of_lines<S: Scalar>(
    a: &Line<S>,
    b: &Line<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let direction = a.direction().components();
    let common = cross(direction, b.direction().components());
    if !decider.vanishes(&common) {
        return Ok(Found::Direction(Direction::new(common)?));
    }
    // d × ((q − p) × d) is the offset across d, times the square of d.
    let across = cross(&minus(&b.point().0, &a.point().0), direction);
    if decider.vanishes(&across) {
        return Ok(Found::Nothing);
    }
    let towards = cross(direction, &across);
    Ok(match decider.vanishes(&towards) {
        true => Found::Nothing,
        false => Found::Direction(Direction::new(towards)?),
    })
}
