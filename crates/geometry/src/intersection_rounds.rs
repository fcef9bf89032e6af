//! What circles, cylinders, cones and spheres have in common with each other.
//!
//! Surfaces about one axis meet in circles about it, and two spheres always have one; parallel cylinders meet in lines. Others meet in curves that are no
//! entities: there it is an error, unless they are apart or only touch.

use crate::curved::{Circle, Cone, Cylinder, Sphere};
use crate::decide::Decider;
use crate::distance::of_lines;
use crate::entity::{Direction, Entity, Found, Line, Point};
use crate::error::GeometryError;
use crate::intersection_round::{across, of_line, of_plane, roots};
use crate::join::{feet_of_lines, on_line};
use crate::projection_round::nearest;
use crate::round::{coincide_round, on_axis, on_round, one_axis, point_to_cone};
use crate::scalar::Scalar;
use crate::triple::{along, cross, dot, minus, plus, quotient, root, scaled, square};
use std::cmp::Ordering;

/// Of two round ones; none for other pairs. What is one surface is found whole.
pub(crate) fn of_rounds<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<Found<S>>, GeometryError> {
    if coincide_round(a, b).is_some_and(|same| decider.counts(same)) {
        return Ok(match a {
            Entity::Circle(x) => Some(Found::Circle(x.clone())),
            Entity::Cylinder(x) => Some(Found::Cylinder(x.clone())),
            Entity::Cone(x) => Some(Found::Cone(x.clone())),
            Entity::Sphere(x) => Some(Found::Sphere(x.clone())),
            _ => None,
        });
    }
    Ok(Some(match (a, b) {
        (Entity::Circle(circle), round) | (round, Entity::Circle(circle)) => {
            return with_circle(circle, round, decider);
        }
        (Entity::Sphere(x), Entity::Sphere(y)) => of_spheres(x, y, decider)?,
        (Entity::Sphere(s), Entity::Cylinder(c)) | (Entity::Cylinder(c), Entity::Sphere(s)) => {
            sphere_with_cylinder(s, c, decider)?
        }
        (Entity::Sphere(s), Entity::Cone(c)) | (Entity::Cone(c), Entity::Sphere(s)) => {
            sphere_with_cone(s, c, decider)?
        }
        (Entity::Cylinder(x), Entity::Cylinder(y)) => of_cylinders(x, y, decider)?,
        (Entity::Cylinder(c), Entity::Cone(k)) | (Entity::Cone(k), Entity::Cylinder(c)) => {
            cylinder_with_cone(c, k, decider)?
        }
        (Entity::Cone(x), Entity::Cone(y)) => of_cones(x, y, decider)?,
        _ => return Ok(None),
    }))
}

fn no_entity<T>(needed: &'static str, found: &'static str) -> Result<T, GeometryError> {
    Err(GeometryError::Degenerate { needed, found })
}

/// Of a circle and something round: what that has in common with the plane of the circle, and this with the circle.
fn with_circle<S: Scalar>(
    circle: &Circle<S>,
    round: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<Found<S>>, GeometryError> {
    let Some(in_plane) = of_plane(circle.plane(), round, decider)? else {
        return Ok(None);
    };
    let own: Entity<S> = circle.clone().into();
    let mut parts = Vec::new();
    for part in in_plane.parts() {
        match part {
            Found::Circle(other) => {
                if coincide_round(&own, &other.clone().into()).is_some_and(|a| decider.counts(a)) {
                    return Ok(Some(Found::Circle(circle.clone())));
                }
                parts.extend(of_coplanar(circle, other, decider)?);
            }
            Found::Line(line) => {
                if let Some(found) = of_line(line, &own, decider)? {
                    parts.extend(found.parts().iter().cloned());
                }
            }
            Found::Point(point) if on_round(point, &own).is_some_and(|on| decider.counts(on)) => {
                parts.push(Found::Point(point.clone()));
            }
            _ => {}
        }
    }
    Ok(Some(Found::of(parts)))
}

/// Of two spheres, or two circles in one plane, with their centres `offset` apart (not zero): what the foot of what they have in common is along the
/// offset, as a share of twice its square, and the square of how far they reach beside it, times four squares of the offset. That is below zero
/// where they are apart, or one is in the other.
fn radical<S: Scalar>(offset: &[S; 3], first: &S, second: &S) -> (S, S) {
    let apart = square(offset);
    let (own, other) = (first.squared(), second.squared());
    let share = apart.plus(&own).minus(&other);
    let four = S::whole(4).times(&apart).times(&own);
    let reach = four.minus(&share.squared());
    (share, reach)
}

/// The points that two circles have in common whose centres, in one plane across an axis, are `centre` and an offset from it.
fn crossings<S: Scalar>(
    (centre, offset, axis): (&[S; 3], &[S; 3], &[S; 3]),
    (first, second): (&S, &S),
    decider: &mut Decider,
) -> Result<Vec<[S; 3]>, GeometryError> {
    if decider.vanishes(offset) {
        // About one centre, and not one circle.
        return Ok(Vec::new());
    }
    let (share, reach) = radical(offset, first, second);
    let twice = S::whole(2).times(&square(offset));
    let foot = along(centre, offset, &share, &twice)?;
    Ok(match decider.order(&reach) {
        Ordering::Less => Vec::new(),
        Ordering::Equal => vec![foot],
        Ordering::Greater => {
            let beside = cross(axis, offset);
            let scale = twice.squared().times(&square(axis));
            let way = root(&quotient(&reach, &scale)?)?;
            [way.clone(), way.negated()]
                .iter()
                .map(|way| plus(&foot, &scaled(&beside, way)))
                .collect()
        }
    })
}

fn of_coplanar<S: Scalar>(
    a: &Circle<S>,
    b: &Circle<S>,
    decider: &mut Decider,
) -> Result<Vec<Found<S>>, GeometryError> {
    let offset = minus(&b.centre().0, &a.centre().0);
    let frame = (&a.centre().0, &offset, a.plane().normal().components());
    let points = crossings(frame, (a.radius(), b.radius()), decider)?;
    let found = points.into_iter().map(|point| Found::Point(Point(point)));
    Ok(found.collect())
}

fn of_spheres<S: Scalar>(
    a: &Sphere<S>,
    b: &Sphere<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let offset = minus(&b.centre().0, &a.centre().0);
    if decider.vanishes(&offset) {
        return Ok(Found::Nothing);
    }
    let (share, reach) = radical(&offset, a.radius(), b.radius());
    let twice = S::whole(2).times(&square(&offset));
    let foot = Point(along(&a.centre().0, &offset, &share, &twice)?);
    Ok(match decider.order(&reach) {
        Ordering::Less => Found::Nothing,
        Ordering::Equal => Found::Point(foot),
        Ordering::Greater => {
            let radius = root(&quotient(&reach, &twice.plus(&twice))?)?;
            across(foot, &Direction::new(offset)?, radius)?
        }
    })
}

fn of_cylinders<S: Scalar>(
    a: &Cylinder<S>,
    b: &Cylinder<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (axis, direction) = (a.axis(), a.axis().direction());
    let first = (&axis.point().0, direction.components());
    let second = (&b.axis().point().0, b.axis().direction().components());
    if decider.vanishes(&cross(first.1, second.1)) {
        let foot = on_line(second.0, axis)?;
        let offset = minus(second.0, &foot);
        let points = crossings((&foot, &offset, first.1), (a.radius(), b.radius()), decider)?;
        let line = |point| Found::Line(Line::new(Point(point), direction.clone()));
        return Ok(Found::of(points.into_iter().map(line).collect()));
    }
    let away = of_lines(first, second, decider)?;
    let reach = a.radius().plus(b.radius());
    match decider.order(&away.minus(&reach)) {
        Ordering::Greater => Ok(Found::Nothing),
        Ordering::Equal => {
            let feet = feet_of_lines(axis, b.axis(), decider)?;
            let across = minus(&feet.second.0, &feet.first.0);
            let point = along(&feet.first.0, &across, a.radius(), &reach)?;
            Ok(Found::Point(Point(point)))
        }
        Ordering::Less
            if decider.is_zero(&away) && decider.is_zero(&a.radius().minus(b.radius())) =>
        {
            no_entity(
                "cylinders that are parallel, touch or are apart",
                "two of one radius whose axes meet, which have two ellipses in common",
            )
        }
        Ordering::Less => no_entity(
            "cylinders that are parallel, touch or are apart",
            "two that cross, which meet in a curve of degree four",
        ),
    }
}

fn sphere_with_cylinder<S: Scalar>(
    sphere: &Sphere<S>,
    cylinder: &Cylinder<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (axis, direction) = (cylinder.axis(), cylinder.axis().direction());
    let (centre, own) = (sphere.centre(), sphere.radius());
    if decider.counts(on_axis(centre, axis)) {
        let left = own.squared().minus(&cylinder.radius().squared());
        let circle = |at: [S; 3]| across(Point(at), direction, cylinder.radius().clone());
        return Ok(match decider.order(&left) {
            Ordering::Less => Found::Nothing,
            Ordering::Equal => circle(centre.0.clone())?,
            Ordering::Greater => {
                let d = direction.components();
                let way = root(&quotient(&left, &square(d))?)?;
                let up = circle(plus(&centre.0, &scaled(d, &way)))?;
                let down = circle(minus(&centre.0, &scaled(d, &way)))?;
                Found::Several(vec![up, down])
            }
        });
    }
    let arm = minus(&centre.0, &on_line(&centre.0, axis)?);
    let away = root(&square(&arm))?;
    let outside = decider.order(&away.minus(&cylinder.radius().plus(own)));
    let inside = decider.order(&cylinder.radius().minus(&away.plus(own)));
    match (outside, inside) {
        (Ordering::Greater, _) | (_, Ordering::Greater) => Ok(Found::Nothing),
        (Ordering::Equal, _) | (_, Ordering::Equal) => {
            touched(centre, &cylinder.clone().into(), decider)
        }
        _ => no_entity(
            "a sphere about a point of the axis of a cylinder, or one that touches it or is apart",
            "one beside the axis, which meets it in a curve of degree four",
        ),
    }
}

/// Where a sphere about a point touches a surface: the point of it that is nearest.
fn touched<S: Scalar>(
    centre: &Point<S>,
    surface: &Entity<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let point = nearest(centre, surface, decider)?;
    Ok(point.map_or(Found::Nothing, Found::Point))
}

fn sphere_with_cone<S: Scalar>(
    sphere: &Sphere<S>,
    cone: &Cone<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let centre = sphere.centre();
    if !decider.counts(on_axis(centre, cone.axis())) {
        let away = point_to_cone(centre, cone, decider)?;
        return match decider.order(&away.minus(sphere.radius())) {
            Ordering::Greater => Ok(Found::Nothing),
            Ordering::Equal => touched(centre, &cone.clone().into(), decider),
            Ordering::Less => no_entity(
                "a sphere about a point of the axis of a cone, or one that touches it or is apart",
                "one beside the axis, which meets it in a curve of degree four",
            ),
        };
    }
    let height = height_on(cone, centre)?;
    let one = S::whole(1);
    let steep = one.plus(&cone.tangent().squared());
    let rest = height.squared().minus(&sphere.radius().squared());
    let mut parts = Vec::new();
    for at in roots(&steep, &height.negated(), &rest, decider)? {
        parts.extend(ring(cone, &at, decider)?);
    }
    Ok(Found::of(parts))
}

/// How far a point is along the axis of a cone from its apex.
fn height_on<S: Scalar>(cone: &Cone<S>, point: &Point<S>) -> Result<S, GeometryError> {
    let direction = cone.axis().direction().components();
    let along = dot(&minus(&point.0, &cone.apex().0), direction);
    quotient(&along, &root(&square(direction))?)
}

/// The circle of a cone at a height along its axis: its apex at zero, nothing below.
fn ring<S: Scalar>(
    cone: &Cone<S>,
    height: &S,
    decider: &mut Decider,
) -> Result<Option<Found<S>>, GeometryError> {
    let direction = cone.axis().direction();
    Ok(match decider.order(height) {
        Ordering::Less => None,
        Ordering::Equal => Some(Found::Point(cone.apex().clone())),
        Ordering::Greater => {
            let size = root(&square(direction.components()))?;
            let centre = along(&cone.apex().0, direction.components(), height, &size)?;
            let radius = height.times(cone.tangent());
            Some(across(Point(centre), direction, radius)?)
        }
    })
}

fn cylinder_with_cone<S: Scalar>(
    cylinder: &Cylinder<S>,
    cone: &Cone<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    if !decider.counts(one_axis(cylinder.axis(), cone.axis())) {
        return no_entity(
            "a cylinder and a cone about one axis",
            "two about different ones, which meet in a curve of degree four or not at all",
        );
    }
    let height = quotient(cylinder.radius(), cone.tangent())?;
    Ok(ring(cone, &height, decider)?.unwrap_or(Found::Nothing))
}

fn of_cones<S: Scalar>(
    a: &Cone<S>,
    b: &Cone<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    if !decider.counts(one_axis(a.axis(), b.axis())) {
        return no_entity(
            "two cones about one axis",
            "two about different ones, which meet in a curve of degree four or not at all",
        );
    }
    let apart = height_on(a, b.apex())?;
    let (d, e) = (a.axis().direction(), b.axis().direction());
    let (own, other) = (a.tangent(), b.tangent());
    let opposed = decider.order(&dot(d.components(), e.components())) == Ordering::Less;
    // Where both are as wide, the second with its sense along the axis of the first.
    let closing = match opposed {
        true => own.plus(other),
        false => other.minus(own),
    };
    if decider.is_zero(&closing) {
        return Ok(Found::Nothing);
    }
    let height = quotient(&apart.times(other), &closing)?;
    let above = match opposed {
        true => apart.minus(&height),
        false => height.minus(&apart),
    };
    if decider.order(&above) == Ordering::Less {
        return Ok(Found::Nothing);
    }
    Ok(ring(a, &height, decider)?.unwrap_or(Found::Nothing))
}
