//! Shadows of points on round things, and of circles on planes.

use crate::curved::{Circle, Cone};
use crate::decide::Decider;
use crate::entity::{Direction, Entity, Found, Line, Plane, Point, Segment};
use crate::error::GeometryError;
use crate::intersection_round::of_line;
use crate::join::{on_line, on_plane};
use crate::round::from_axis;
use crate::scalar::Scalar;
use crate::triple::{along, cross, dot, minus, plus, quotient, root, scaled, square};
use std::cmp::Ordering;

/// Of a point on a circle, a cylinder, a cone or a sphere: the nearest point, or all that are met along the light, to either side; none for other pairs.
pub(crate) fn on_what_is_round<S: Scalar>(
    point: &Point<S>,
    round: &Entity<S>,
    light: Option<&Direction<S>>,
    decider: &mut Decider,
) -> Result<Option<Found<S>>, GeometryError> {
    match light {
        Some(light) => of_line(&Line::new(point.clone(), light.clone()), round, decider),
        None => Ok(nearest(point, round, decider)?.map(Found::Point)),
    }
}

/// The point of something round that is nearest to a point; none where that is not round.
///
/// # Errors
/// Where a whole circle or sphere is as near.
pub(crate) fn nearest<S: Scalar>(
    point: &Point<S>,
    round: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<Point<S>>, GeometryError> {
    let (middle, radius) = match round {
        Entity::Sphere(sphere) => (sphere.centre().0.clone(), sphere.radius()),
        Entity::Cylinder(cylinder) => (on_line(&point.0, cylinder.axis())?, cylinder.radius()),
        Entity::Circle(circle) => {
            let flat = on_plane(&point.0, circle.plane())?;
            return from_middle(&circle.centre().0, &flat, circle.radius(), decider).map(Some);
        }
        Entity::Cone(cone) => return nearest_on_cone(point, cone, decider).map(Some),
        _ => return Ok(None),
    };
    from_middle(&middle, &point.0, radius, decider).map(Some)
}

/// The point in the direction of another from a middle, as far as a radius.
fn from_middle<S: Scalar>(
    middle: &[S; 3],
    point: &[S; 3],
    radius: &S,
    decider: &mut Decider,
) -> Result<Point<S>, GeometryError> {
    let arm = minus(point, middle);
    if decider.vanishes(&arm) {
        return Err(all_as_near());
    }
    Ok(Point(along(middle, &arm, radius, &root(&square(&arm))?)?))
}

fn all_as_near() -> GeometryError {
    GeometryError::Degenerate {
        needed: "a point off the axis or centre of what it is projected on",
        found: "one on it, to which a whole circle or sphere is as near",
    }
}

fn nearest_on_cone<S: Scalar>(
    point: &Point<S>,
    cone: &Cone<S>,
    decider: &mut Decider,
) -> Result<Point<S>, GeometryError> {
    let (away, height) = from_axis(&point.0, cone.axis())?;
    let tangent = cone.tangent();
    // In the half plane of the axis and the point the side is a ray from the apex.
    let way = height.plus(&away.times(tangent));
    if decider.order(&way) != Ordering::Greater {
        return Ok(cone.apex().clone());
    }
    let arm = minus(&point.0, &on_line(&point.0, cone.axis())?);
    if decider.vanishes(&arm) {
        return Err(all_as_near());
    }
    let up = quotient(&way, &tangent.squared().plus(&S::whole(1)))?;
    let direction = cone.axis().direction().components();
    let centre = along(&cone.apex().0, direction, &up, &root(&square(direction))?)?;
    Ok(Point(along(
        &centre,
        &arm,
        &up.times(tangent),
        &root(&square(&arm))?,
    )?))
}

/// Of a circle on a plane: a circle where they are parallel, and a segment where they are at right angles and the light falls straight.
pub(crate) fn circle_on_plane<S: Scalar>(
    circle: &Circle<S>,
    plane: &Plane<S>,
    centre: Point<S>,
    is_straight: bool,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (own, normal) = (
        circle.plane().normal().components(),
        plane.normal().components(),
    );
    let edge = cross(own, normal);
    if decider.vanishes(&edge) {
        let (direction, radius) = (plane.normal().clone(), circle.radius().clone());
        return Ok(Found::Circle(Circle::new(centre, direction, radius)?));
    }
    if !is_straight || !decider.is_zero(&dot(own, normal)) {
        return Err(GeometryError::Degenerate {
            needed: "a circle parallel to the plane, or at right angles to it in straight light",
            found: "one askew, whose shadow is an ellipse",
        });
    }
    let arm = scaled(&edge, &quotient(circle.radius(), &root(&square(&edge))?)?);
    let (from, to) = (minus(&centre.0, &arm), plus(&centre.0, &arm));
    Ok(Found::Segment(Segment::new(Point(from), Point(to))?))
}
