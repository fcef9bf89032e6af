//! How far round things are from each other, and spheres and cylinders from segments.

use crate::boundary::line_to_segment;
use crate::curved::Cylinder;
use crate::decide::Decider;
use crate::distance::{of_lines, to_line, to_segment};
use crate::entity::{Entity, Found, Line, Segment};
use crate::error::GeometryError;
use crate::intersection_rounds::of_rounds;
use crate::round::{beyond, from_axis, one_axis, place_to_cone, point_to_cone};
use crate::scalar::Scalar;
use crate::triple::{cross, length, minus, root};
use std::cmp::Ordering;

/// The distance of two of sphere and cylinder, and of a segment from either; of a sphere from a circle and a cone; of circles, cylinders and cones from
/// each other where they are parallel or have one axis, as [`of_parallel`] says; none for other pairs.
pub(crate) fn clearance<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<S>, GeometryError> {
    Ok(Some(match (a, b) {
        (Entity::Sphere(x), Entity::Sphere(y)) => {
            let away = length(&minus(&x.centre().0, &y.centre().0))?;
            nested(&away, x.radius(), y.radius(), decider)
        }
        (Entity::Sphere(s), Entity::Cylinder(c)) | (Entity::Cylinder(c), Entity::Sphere(s)) => {
            let axis = c.axis();
            let away = to_line(
                &s.centre().0,
                &axis.point().0,
                axis.direction().components(),
            )?;
            outside(&away, &c.radius().plus(s.radius()), decider)
                .or_else(|| outside(c.radius(), &away.plus(s.radius()), decider))
                .unwrap_or_else(|| S::whole(0))
        }
        (Entity::Cylinder(x), Entity::Cylinder(y)) => of_cylinders(x, y, decider)?,
        (Entity::Segment(s), Entity::Sphere(ball)) | (Entity::Sphere(ball), Entity::Segment(s)) => {
            let centre = &ball.centre().0;
            let near = to_segment(centre, s, decider)?;
            let ends = [s.from(), s.to()].map(|end| length(&minus(&end.0, centre)));
            beside(&near, ends, ball.radius(), decider)?
        }
        (Entity::Segment(s), Entity::Cylinder(c)) | (Entity::Cylinder(c), Entity::Segment(s)) => {
            let near = segment_to_axis(s, c, decider)?;
            let (point, direction) = (&c.axis().point().0, c.axis().direction().components());
            let ends = [s.from(), s.to()].map(|end| to_line(&end.0, point, direction));
            beside(&near, ends, c.radius(), decider)?
        }
        (Entity::Sphere(s), Entity::Circle(c)) | (Entity::Circle(c), Entity::Sphere(s)) => {
            let (away, along) = from_axis(&s.centre().0, &c.axis())?;
            // The nearest and the farthest point of the circle from the centre.
            let [near, far] = [away.minus(c.radius()), away.plus(c.radius())]
                .map(|across| root(&across.squared().plus(&along.squared())));
            let far = far?;
            outside(&near?, s.radius(), decider)
                .or_else(|| outside(s.radius(), &far, decider))
                .unwrap_or_else(|| S::whole(0))
        }
        (Entity::Sphere(s), Entity::Cone(c)) | (Entity::Cone(c), Entity::Sphere(s)) => {
            // A cone does not end: where its nearest point is inside of a ball, others are outside.
            let away = point_to_cone(s.centre(), c, decider)?;
            beyond(&away, s.radius(), decider)
        }
        _ => return of_parallel(a, b, decider),
    }))
}

/// The distance of a circle from a circle or a cylinder with a parallel axis, of a circle or a cone from a cone about the same axis, and of a cylinder from a
/// cone with a parallel one, which it always meets; none for other pairs.
fn of_parallel<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<S>, GeometryError> {
    let parallel = |x: &Line<S>, y: &Line<S>, decider: &mut Decider| {
        let (d, e) = (x.direction().components(), y.direction().components());
        decider.vanishes(&cross(d, e))
    };
    Ok(match (a, b) {
        (Entity::Circle(x), Entity::Circle(y)) if parallel(&x.axis(), &y.axis(), decider) => {
            let (away, along) = from_axis(&y.centre().0, &x.axis())?;
            let flat = nested(&away, x.radius(), y.radius(), decider);
            Some(root(&flat.squared().plus(&along.squared()))?)
        }
        (Entity::Circle(x), Entity::Cylinder(y)) | (Entity::Cylinder(y), Entity::Circle(x))
            if parallel(&x.axis(), y.axis(), decider) =>
        {
            let (away, _) = from_axis(&x.centre().0, y.axis())?;
            Some(nested(&away, x.radius(), y.radius(), decider))
        }
        (Entity::Circle(x), Entity::Cone(y)) | (Entity::Cone(y), Entity::Circle(x))
            if decider.counts(one_axis(&x.axis(), y.axis())) =>
        {
            let (_, along) = from_axis(&x.centre().0, y.axis())?;
            Some(place_to_cone(
                &(x.radius().clone(), along),
                y.tangent(),
                decider,
            )?)
        }
        (Entity::Cylinder(x), Entity::Cone(y)) | (Entity::Cone(y), Entity::Cylinder(x))
            if parallel(x.axis(), y.axis(), decider) =>
        {
            Some(S::whole(0))
        }
        (Entity::Cone(x), Entity::Cone(y)) if decider.counts(one_axis(x.axis(), y.axis())) => {
            match of_rounds(a, b, decider)? {
                // Two rays of one half plane that do not meet are nearest at the end of one.
                Some(Found::Nothing) => {
                    let first = point_to_cone(x.apex(), y, decider)?;
                    Some(first.least(&point_to_cone(y.apex(), x, decider)?))
                }
                _ => Some(S::whole(0)),
            }
        }
        _ => None,
    })
}

/// By how much one number is above another, where it is.
fn outside<S: Scalar>(more: &S, less: &S, decider: &mut Decider) -> Option<S> {
    let rest = more.minus(less);
    (decider.order(&rest) == Ordering::Greater).then_some(rest)
}

/// The distance of two spheres, or of two circles in one plane, whose centres are `away` from each other: outside of each other, one in the
/// other, or meeting.
fn nested<S: Scalar>(away: &S, first: &S, second: &S, decider: &mut Decider) -> S {
    outside(away, &first.plus(second), decider)
        .or_else(|| outside(first, &away.plus(second), decider))
        .or_else(|| outside(second, &away.plus(first), decider))
        .unwrap_or_else(|| S::whole(0))
}

fn of_cylinders<S: Scalar>(
    a: &Cylinder<S>,
    b: &Cylinder<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let first = (&a.axis().point().0, a.axis().direction().components());
    let second = (&b.axis().point().0, b.axis().direction().components());
    let away = of_lines(first, second, decider)?;
    if decider.vanishes(&cross(first.1, second.1)) {
        return Ok(nested(&away, a.radius(), b.radius(), decider));
    }
    // Neither ends, so that one that crosses the other goes through its surface, however thin.
    let reach = a.radius().plus(b.radius());
    Ok(outside(&away, &reach, decider).unwrap_or_else(|| S::whole(0)))
}

fn segment_to_axis<S: Scalar>(
    segment: &Segment<S>,
    cylinder: &Cylinder<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let (from, to) = (&segment.from().0, &segment.to().0);
    root(&line_to_segment(cylinder.axis(), from, to, decider)?)
}

/// The distance from a round surface of what is `near` its middle at least and as far as one of its ends at most.
fn beside<S: Scalar>(
    near: &S,
    ends: [Result<S, GeometryError>; 2],
    radius: &S,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let [from, to] = ends;
    let (from, to) = (from?, to?);
    if let Some(rest) = outside(near, radius, decider) {
        return Ok(rest);
    }
    // Inside all along where both ends are.
    let inside = (
        outside(radius, &from, decider),
        outside(radius, &to, decider),
    );
    Ok(match inside {
        (Some(first), Some(second)) => first.least(&second),
        _ => S::whole(0),
    })
}
