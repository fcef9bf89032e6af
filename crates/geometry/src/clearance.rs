//! How far spheres and cylinders are from each other and from segments.

use crate::boundary::line_to_segment;
use crate::curved::Cylinder;
use crate::decide::Decider;
use crate::distance::{of_lines, to_line, to_segment};
use crate::entity::{Entity, Segment};
use crate::error::GeometryError;
use crate::scalar::Scalar;
use crate::triple::{cross, length, minus, root};
use std::cmp::Ordering;

/// The distance of two of sphere and cylinder, and of a segment from either; none for other pairs.
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
        _ => return Ok(None),
    }))
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
