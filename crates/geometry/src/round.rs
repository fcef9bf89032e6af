//! What circles, cylinders, cones and spheres are to each other and to points, lines and planes.

use crate::curved::{Circle, Cone, Cylinder};
use crate::decide::{Answer, Decider, Outcome, zero_vector};
use crate::entity::{Entity, Line, Plane, Point, no_pair};
use crate::error::GeometryError;
use crate::planar::Place;
use crate::scalar::Scalar;
use crate::triple::{cross, dot, length, minus, quotient, root, square};
use std::cmp::Ordering;

/// The axis of a line, a circle, a cylinder or a cone.
fn axis<S: Scalar>(entity: &Entity<S>) -> Option<Line<S>> {
    match entity {
        Entity::Line(line) => Some(line.clone()),
        Entity::Circle(circle) => Some(circle.axis()),
        Entity::Cylinder(cylinder) => Some(cylinder.axis().clone()),
        Entity::Cone(cone) => Some(cone.axis().clone()),
        _ => None,
    }
}

fn centre<S: Scalar>(entity: &Entity<S>) -> Option<&Point<S>> {
    match entity {
        Entity::Point(point) => Some(point),
        Entity::Circle(circle) => Some(circle.centre()),
        Entity::Sphere(sphere) => Some(sphere.centre()),
        _ => None,
    }
}

fn radius<S: Scalar>(entity: &Entity<S>) -> Option<&S> {
    match entity {
        Entity::Circle(circle) => Some(circle.radius()),
        Entity::Cylinder(cylinder) => Some(cylinder.radius()),
        Entity::Sphere(sphere) => Some(sphere.radius()),
        _ => None,
    }
}

/// Whether a point is on an axis.
pub(crate) fn on_axis<S: Scalar>(point: &Point<S>, axis: &Line<S>) -> Answer {
    let offset = minus(&point.0, &axis.point().0);
    zero_vector(&cross(&offset, axis.direction().components()))
}

/// Whether two axes are one.
pub(crate) fn one_axis<S: Scalar>(a: &Line<S>, b: &Line<S>) -> Answer {
    let turned = cross(a.direction().components(), b.direction().components());
    zero_vector(&turned).and(on_axis(b.point(), a))
}

fn equal<S: Scalar>(a: &S, b: &S) -> Answer {
    Answer::zero(a.minus(b).sign())
}

fn same<S: Scalar>(a: &Point<S>, b: &Point<S>) -> Answer {
    zero_vector(&minus(&a.0, &b.0))
}

/// Whether two of line, circle, cylinder and cone have one axis, that of a circle being the line through its centre across its
/// plane; of a sphere and one of these, whether its centre is on the axis.
///
/// # Errors
/// For other pairs; two spheres always have a common axis.
pub fn coaxial<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    match (axis(a), axis(b), a, b) {
        (Some(x), Some(y), _, _) => Ok(one_axis(&x, &y)),
        (Some(line), None, _, Entity::Sphere(sphere))
        | (None, Some(line), Entity::Sphere(sphere), _) => Ok(on_axis(sphere.centre(), &line)),
        _ => Err(no_pair("coaxial", a, b)),
    }
}

/// Whether two of point, circle and sphere, not both points, have one centre.
///
/// # Errors
/// For other pairs.
pub fn concentric<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    match (centre(a), centre(b)) {
        (Some(x), Some(y)) if radius(a).is_some() || radius(b).is_some() => Ok(same(x, y)),
        _ => Err(no_pair("concentric", a, b)),
    }
}

/// By how much the radius of the first is greater than that of the second; of circles, cylinders and spheres. Around a pin it
/// is the clearance of a hole.
///
/// # Errors
/// For other pairs.
pub fn radius_difference<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<S, GeometryError> {
    match (radius(a), radius(b)) {
        (Some(x), Some(y)) => Ok(x.minus(y)),
        _ => Err(no_pair("radius_difference", a, b)),
    }
}

/// Which radius is greater; of circles, cylinders and spheres.
///
/// # Errors
/// For other pairs.
pub fn compare_radii<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
) -> Result<Outcome<Ordering>, GeometryError> {
    let difference = radius_difference(a, b).map_err(|_| no_pair("compare_radii", a, b))?;
    let mut decider = Decider::default();
    let order = decider.order(&difference);
    Ok(decider.outcome(order))
}

/// Whether two of the same kind are one; none for other pairs.
pub(crate) fn coincide_round<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Option<Answer> {
    Some(match (a, b) {
        (Entity::Circle(x), Entity::Circle(y)) => {
            let normals = cross(
                x.plane().normal().components(),
                y.plane().normal().components(),
            );
            zero_vector(&normals)
                .and(same(x.centre(), y.centre()))
                .and(equal(x.radius(), y.radius()))
        }
        (Entity::Cylinder(x), Entity::Cylinder(y)) => {
            one_axis(x.axis(), y.axis()).and(equal(x.radius(), y.radius()))
        }
        (Entity::Cone(x), Entity::Cone(y)) => {
            let (d, e) = (x.axis().direction(), y.axis().direction());
            let sense = dot(d.components(), e.components());
            one_axis(x.axis(), y.axis())
                .and(same(x.apex(), y.apex()))
                .and(Answer::positive(sense.sign()))
                .and(equal(x.tangent(), y.tangent()))
        }
        (Entity::Sphere(x), Entity::Sphere(y)) => {
            same(x.centre(), y.centre()).and(equal(x.radius(), y.radius()))
        }
        _ => return None,
    })
}

/// What says on which side of a surface a point is: a number above zero inside of it, zero on it, below zero outside.
fn depth<S: Scalar>(point: &Point<S>, entity: &Entity<S>) -> Option<S> {
    match entity {
        Entity::Sphere(sphere) => {
            let away = square(&minus(&point.0, &sphere.centre().0));
            Some(sphere.radius().squared().minus(&away))
        }
        Entity::Cylinder(cylinder) => {
            let direction = cylinder.axis().direction().components();
            let offset = minus(&point.0, &cylinder.axis().point().0);
            let away = square(&cross(&offset, direction));
            let limit = cylinder.radius().squared().times(&square(direction));
            Some(limit.minus(&away))
        }
        Entity::Cone(cone) => {
            let direction = cone.axis().direction().components();
            let offset = minus(&point.0, &cone.apex().0);
            let away = square(&cross(&offset, direction));
            let along = dot(&offset, direction);
            let limit = along.squared().times(&cone.tangent().squared());
            Some(limit.minus(&away))
        }
        _ => None,
    }
}

/// Whether a point is on a circle, a cylinder, a cone or a sphere; none for other pairs.
pub(crate) fn on_round<S: Scalar>(point: &Point<S>, entity: &Entity<S>) -> Option<Answer> {
    match entity {
        Entity::Circle(circle) => {
            let offset = minus(&point.0, &circle.centre().0);
            let level = dot(&offset, circle.plane().normal().components());
            let away = square(&offset).minus(&circle.radius().squared());
            Some(Answer::zero(level.sign()).and(Answer::zero(away.sign())))
        }
        Entity::Cone(cone) => {
            let offset = minus(&point.0, &cone.apex().0);
            let along = dot(&offset, cone.axis().direction().components());
            let own = Answer::zero(depth(point, entity)?.sign());
            Some(own.and(Answer::not_negative(along.sign())))
        }
        _ => depth(point, entity).map(|depth| Answer::zero(depth.sign())),
    }
}

/// Whether a line is on a cylinder, a segment on a cylinder or a cone, a circle on a cylinder, a cone or a sphere; none for other pairs.
pub(crate) fn in_round<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Option<Answer> {
    let along = |direction: &[S; 3], axis: &Line<S>| {
        zero_vector(&cross(direction, axis.direction().components()))
    };
    Some(match (a, b) {
        (Entity::Line(line), Entity::Cylinder(cylinder)) => {
            along(line.direction().components(), cylinder.axis()).and(on_round(line.point(), b)?)
        }
        (Entity::Segment(segment), Entity::Cylinder(cylinder)) => {
            along(segment.direction().components(), cylinder.axis())
                .and(on_round(segment.from(), b)?)
                .and(on_round(segment.to(), b)?)
        }
        (Entity::Segment(segment), Entity::Cone(cone)) => {
            let ends = [segment.from(), segment.to()];
            let [from, to] = ends.map(|end| minus(&end.0, &cone.apex().0));
            // On a surface that is curved across only, what is straight runs through the apex.
            zero_vector(&cross(&from, &to))
                .and(on_round(segment.from(), b)?)
                .and(on_round(segment.to(), b)?)
        }
        (Entity::Circle(circle), Entity::Cylinder(cylinder)) => {
            one_axis(cylinder.axis(), &circle.axis()).and(equal(circle.radius(), cylinder.radius()))
        }
        (Entity::Circle(circle), Entity::Cone(cone)) => {
            let direction = cone.axis().direction().components();
            let offset = minus(&circle.centre().0, &cone.apex().0);
            let height = dot(&offset, direction);
            let limit = cone.tangent().squared().times(&height.squared());
            let own = circle.radius().squared().times(&square(direction));
            one_axis(cone.axis(), &circle.axis())
                .and(equal(&own, &limit))
                .and(Answer::positive(height.sign()))
        }
        (Entity::Circle(circle), Entity::Sphere(sphere)) => {
            let away = square(&minus(&circle.centre().0, &sphere.centre().0));
            let own = away.plus(&circle.radius().squared());
            on_axis(sphere.centre(), &circle.axis()).and(equal(&own, &sphere.radius().squared()))
        }
        _ => return None,
    })
}

/// Where a point is beside a cylinder, a cone or a sphere: inside is where the axis or the centre is.
///
/// # Errors
/// For other entities.
pub fn classify_by_round<S: Scalar>(
    point: &Point<S>,
    entity: &Entity<S>,
) -> Result<Outcome<Place>, GeometryError> {
    let depth = depth(point, entity)
        .ok_or_else(|| no_pair("classify_by_round", &point.clone().into(), entity))?;
    let mut decider = Decider::default();
    if let Entity::Cone(cone) = entity {
        let offset = minus(&point.0, &cone.apex().0);
        let along = dot(&offset, cone.axis().direction().components());
        // Behind the apex is the other half, which does not belong to it.
        if decider.order(&along) == Ordering::Less {
            return Ok(decider.outcome(Place::Outside));
        }
    }
    let place = match decider.order(&depth) {
        Ordering::Greater => Place::Inside,
        Ordering::Equal => Place::OnBorder,
        Ordering::Less => Place::Outside,
    };
    Ok(decider.outcome(place))
}

/// The distance of a point, a line or a plane from a circle, a cylinder, a cone or a sphere; none for pairs without one, a
/// line and a circle or a cone among them.
pub(crate) fn distance_round<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<S>, GeometryError> {
    Ok(Some(match (a, b) {
        (Entity::Point(p), Entity::Sphere(s)) | (Entity::Sphere(s), Entity::Point(p)) => {
            let away = length(&minus(&p.0, &s.centre().0))?;
            away.minus(s.radius()).magnitude()
        }
        (Entity::Point(p), Entity::Cylinder(c)) | (Entity::Cylinder(c), Entity::Point(p)) => {
            let (away, _) = from_axis(&p.0, c.axis())?;
            away.minus(c.radius()).magnitude()
        }
        (Entity::Point(p), Entity::Circle(c)) | (Entity::Circle(c), Entity::Point(p)) => {
            let (away, along) = from_axis(&p.0, &c.axis())?;
            root(&away.minus(c.radius()).squared().plus(&along.squared()))?
        }
        (Entity::Point(p), Entity::Cone(c)) | (Entity::Cone(c), Entity::Point(p)) => {
            point_to_cone(p, c, decider)?
        }
        (Entity::Line(l), Entity::Sphere(s)) | (Entity::Sphere(s), Entity::Line(l)) => {
            let (away, _) = from_axis(&s.centre().0, l)?;
            beyond(&away, s.radius(), decider)
        }
        (Entity::Line(l), Entity::Cylinder(c)) | (Entity::Cylinder(c), Entity::Line(l)) => {
            line_to_cylinder(l, c, decider)?
        }
        (Entity::Plane(p), Entity::Sphere(s)) | (Entity::Sphere(s), Entity::Plane(p)) => {
            beyond(&height(p, s.centre())?.magnitude(), s.radius(), decider)
        }
        (Entity::Plane(p), Entity::Cylinder(c)) | (Entity::Cylinder(c), Entity::Plane(p)) => {
            let normal = p.normal().components();
            match decider.is_zero(&dot(normal, c.axis().direction().components())) {
                true => {
                    let away = height(p, c.axis().point())?.magnitude();
                    beyond(&away, c.radius(), decider)
                }
                false => S::whole(0),
            }
        }
        (Entity::Plane(p), Entity::Circle(c)) | (Entity::Circle(c), Entity::Plane(p)) => {
            plane_to_circle(p, c, decider)?
        }
        (Entity::Plane(p), Entity::Cone(c)) | (Entity::Cone(c), Entity::Plane(p)) => {
            plane_to_cone(p, c, decider)?
        }
        _ => return Ok(None),
    }))
}

/// How far a point is from an axis, and along it from the point that it was made from.
pub(crate) fn from_axis<S: Scalar>(
    point: &[S; 3],
    axis: &Line<S>,
) -> Result<(S, S), GeometryError> {
    let direction = axis.direction().components();
    let offset = minus(point, &axis.point().0);
    let size = length(direction)?;
    let away = quotient(&length(&cross(&offset, direction))?, &size)?;
    Ok((away, quotient(&dot(&offset, direction), &size)?))
}

/// The height of a point above a plane, below it negative.
fn height<S: Scalar>(plane: &Plane<S>, point: &Point<S>) -> Result<S, GeometryError> {
    let size = length(plane.normal().components())?;
    quotient(&plane.height(&point.0), &size)
}

/// What is left of a distance beyond a radius; zero within it.
pub(crate) fn beyond<S: Scalar>(away: &S, radius: &S, decider: &mut Decider) -> S {
    let rest = away.minus(radius);
    match decider.order(&rest) {
        Ordering::Greater => rest,
        _ => S::whole(0),
    }
}

fn line_to_cylinder<S: Scalar>(
    line: &Line<S>,
    cylinder: &Cylinder<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let axis = cylinder.axis();
    let common = cross(line.direction().components(), axis.direction().components());
    if decider.vanishes(&common) {
        let (away, _) = from_axis(&line.point().0, axis)?;
        return Ok(away.minus(cylinder.radius()).magnitude());
    }
    let offset = dot(&minus(&line.point().0, &axis.point().0), &common);
    let away = quotient(&offset.magnitude(), &length(&common)?)?;
    Ok(beyond(&away, cylinder.radius(), decider))
}

fn plane_to_circle<S: Scalar>(
    plane: &Plane<S>,
    circle: &Circle<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let (m, n) = (
        plane.normal().components(),
        circle.plane().normal().components(),
    );
    // The circle reaches up and down by its radius times the sine of the angle between both planes.
    let sine = quotient(&length(&cross(m, n))?, &length(m)?.times(&length(n)?))?;
    let reach = circle.radius().times(&sine);
    let away = height(plane, circle.centre())?.magnitude();
    Ok(beyond(&away, &reach, decider))
}

/// The distance of a point from a cone.
pub(crate) fn point_to_cone<S: Scalar>(
    point: &Point<S>,
    cone: &Cone<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let from_axis = from_axis(&point.0, cone.axis())?;
    place_to_cone(&from_axis, cone.tangent(), decider)
}

/// The same of a place so far from the axis, and so far along it from the apex.
pub(crate) fn place_to_cone<S: Scalar>(
    (away, along): &(S, S),
    tangent: &S,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    // In the half plane of the axis and the point the side is a ray from the apex.
    let way = along.plus(&away.times(tangent));
    if decider.order(&way) == Ordering::Less {
        return root(&away.squared().plus(&along.squared()));
    }
    let across = away.minus(&along.times(tangent)).magnitude();
    let size = root(&tangent.squared().plus(&S::whole(1)))?;
    quotient(&across, &size)
}

fn plane_to_cone<S: Scalar>(
    plane: &Plane<S>,
    cone: &Cone<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let (m, d) = (
        plane.normal().components(),
        cone.axis().direction().components(),
    );
    let apex = height(plane, cone.apex())?;
    // The rises of the sides of the cone are between these two.
    let rise = dot(m, d);
    let spread = length(&cross(m, d))?.times(cone.tangent());
    // Above the plane the side that sinks most meets it, below it the one that climbs most; one that runs along it does not.
    let meets = match decider.order(&apex) {
        Ordering::Equal => true,
        Ordering::Greater => decider.order(&rise.minus(&spread)) == Ordering::Less,
        Ordering::Less => decider.order(&rise.plus(&spread)) == Ordering::Greater,
    };
    if meets {
        return Ok(S::whole(0));
    }
    Ok(apex.magnitude())
}
