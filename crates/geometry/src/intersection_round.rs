//! What lines, segments and planes have in common with circles, cylinders, cones and spheres.
//!
//! Along a line the depth in a round surface is a polynomial of degree two; its roots are where the line meets the surface.

use crate::curved::{Circle, Cone, Cylinder, Sphere};
use crate::decide::Decider;
use crate::entity::{Direction, Entity, Found, Line, Plane, Point, Segment};
use crate::error::GeometryError;
use crate::intersection::{of_planes, with_plane};
use crate::round::on_round;
use crate::scalar::Scalar;
use crate::triple::{along, cross, dot, minus, plus, quotient, root, scaled, square};
use std::cmp::Ordering;

/// Where a straight line meets something round.
enum Met<S> {
    /// All along.
    Everywhere,
    /// All along that half which is on the side of the cone.
    Side,
    /// At these multiples of its direction from its point.
    At(Vec<S>),
}

/// Of a line, a segment or a plane and something round; none for other pairs.
pub(crate) fn with_round<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<Found<S>>, GeometryError> {
    match (a, b) {
        (Entity::Line(line), round) | (round, Entity::Line(line)) => of_line(line, round, decider),
        (Entity::Segment(segment), round) | (round, Entity::Segment(segment)) => {
            of_segment(segment, round, decider)
        }
        (Entity::Plane(plane), round) | (round, Entity::Plane(plane)) => {
            of_plane(plane, round, decider)
        }
        _ => Ok(None),
    }
}

/// Of a line and something round; none where that is not round.
pub(crate) fn of_line<S: Scalar>(
    line: &Line<S>,
    round: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<Found<S>>, GeometryError> {
    let (point, direction) = (&line.point().0, line.direction().components());
    let Some(met) = met(point, direction, round, decider)? else {
        return Ok(None);
    };
    Ok(Some(match met {
        Met::Everywhere => Found::Line(line.clone()),
        Met::Side => {
            return Err(GeometryError::Degenerate {
                needed: "a line that is not along the side of a cone, or a segment",
                found: "one along it, which has a half line in common with it",
            });
        }
        Met::At(times) => {
            let at = |time: &S| Found::Point(Point(plus(point, &scaled(direction, time))));
            Found::of(times.iter().map(at).collect())
        }
    }))
}

fn of_segment<S: Scalar>(
    segment: &Segment<S>,
    round: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<Found<S>>, GeometryError> {
    let (from, to) = (&segment.from().0, &segment.to().0);
    let direction = minus(to, from);
    let Some(met) = met(from, &direction, round, decider)? else {
        return Ok(None);
    };
    Ok(Some(match (met, round) {
        (Met::At(times), _) => {
            let mut points = Vec::new();
            for time in times {
                let rest = S::whole(1).minus(&time);
                let inside = decider.order(&time) != Ordering::Less
                    && decider.order(&rest) != Ordering::Less;
                if inside {
                    points.push(Found::Point(Point(plus(from, &scaled(&direction, &time)))));
                }
            }
            Found::of(points)
        }
        (Met::Side, Entity::Cone(cone)) => on_side(segment, cone, decider)?,
        _ => Found::Segment(segment.clone()),
    }))
}

/// The part of a segment on the line of a cone's side that is on the half which belongs to it.
fn on_side<S: Scalar>(
    segment: &Segment<S>,
    cone: &Cone<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let apex = cone.apex();
    let mut height = |end: &Point<S>| {
        let offset = minus(&end.0, &apex.0);
        decider.order(&dot(&offset, cone.axis().direction().components()))
    };
    let (from, to) = (height(segment.from()), height(segment.to()));
    Ok(match (from, to) {
        (Ordering::Less, Ordering::Less) => Found::Nothing,
        (Ordering::Less, Ordering::Equal) | (Ordering::Equal, Ordering::Less) => {
            Found::Point(apex.clone())
        }
        (Ordering::Less, _) => Found::Segment(Segment::new(apex.clone(), segment.to().clone())?),
        (_, Ordering::Less) => Found::Segment(Segment::new(segment.from().clone(), apex.clone())?),
        _ => Found::Segment(segment.clone()),
    })
}

/// Where a line meets something round; none where that is not round.
fn met<S: Scalar>(
    point: &[S; 3],
    direction: &[S; 3],
    round: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<Met<S>>, GeometryError> {
    Ok(Some(match round {
        Entity::Sphere(sphere) => {
            let from = (&sphere.centre().0, sphere.radius());
            Met::At(in_sphere(point, direction, from, decider)?)
        }
        Entity::Circle(circle) => in_circle(point, direction, circle, decider)?,
        Entity::Cylinder(cylinder) => in_cylinder(point, direction, cylinder, decider)?,
        Entity::Cone(cone) => in_cone(point, direction, cone, decider)?,
        _ => return Ok(None),
    }))
}

/// The roots of `a t² + 2 b t + c`, of which `a` was found to differ from zero; a double one once.
pub(crate) fn roots<S: Scalar>(
    a: &S,
    b: &S,
    c: &S,
    decider: &mut Decider,
) -> Result<Vec<S>, GeometryError> {
    let inner = b.squared().minus(&a.times(c));
    let back = b.negated();
    Ok(match decider.order(&inner) {
        Ordering::Less => Vec::new(),
        Ordering::Equal => vec![quotient(&back, a)?],
        Ordering::Greater => {
            let way = root(&inner)?;
            vec![
                quotient(&back.minus(&way), a)?,
                quotient(&back.plus(&way), a)?,
            ]
        }
    })
}

fn in_sphere<S: Scalar>(
    point: &[S; 3],
    direction: &[S; 3],
    (centre, radius): (&[S; 3], &S),
    decider: &mut Decider,
) -> Result<Vec<S>, GeometryError> {
    let offset = minus(point, centre);
    let beyond = square(&offset).minus(&radius.squared());
    roots(
        &square(direction),
        &dot(&offset, direction),
        &beyond,
        decider,
    )
}

fn in_circle<S: Scalar>(
    point: &[S; 3],
    direction: &[S; 3],
    circle: &Circle<S>,
    decider: &mut Decider,
) -> Result<Met<S>, GeometryError> {
    let rise = dot(direction, circle.plane().normal().components());
    let height = circle.plane().height(point);
    if decider.is_zero(&rise) {
        return Ok(Met::At(match decider.is_zero(&height) {
            true => {
                let from = (&circle.centre().0, circle.radius());
                in_sphere(point, direction, from, decider)?
            }
            false => Vec::new(),
        }));
    }
    let time = quotient(&height.negated(), &rise)?;
    let there = Point(plus(point, &scaled(direction, &time)));
    let is_on = on_round(&there, &circle.clone().into());
    Ok(Met::At(match is_on.is_some_and(|on| decider.counts(on)) {
        true => vec![time],
        false => Vec::new(),
    }))
}

fn in_cylinder<S: Scalar>(
    point: &[S; 3],
    direction: &[S; 3],
    cylinder: &Cylinder<S>,
    decider: &mut Decider,
) -> Result<Met<S>, GeometryError> {
    let axis = cylinder.axis().direction().components();
    let offset = cross(&minus(point, &cylinder.axis().point().0), axis);
    let limit = cylinder.radius().squared().times(&square(axis));
    let beyond = square(&offset).minus(&limit);
    let across = cross(direction, axis);
    if decider.vanishes(&across) {
        return Ok(match decider.is_zero(&beyond) {
            true => Met::Everywhere,
            false => Met::At(Vec::new()),
        });
    }
    let half = dot(&offset, &across);
    Ok(Met::At(roots(&square(&across), &half, &beyond, decider)?))
}

fn in_cone<S: Scalar>(
    point: &[S; 3],
    direction: &[S; 3],
    cone: &Cone<S>,
    decider: &mut Decider,
) -> Result<Met<S>, GeometryError> {
    let axis = cone.axis().direction().components();
    let offset = minus(point, &cone.apex().0);
    let (away, across) = (cross(&offset, axis), cross(direction, axis));
    let (height, rise) = (dot(&offset, axis), dot(direction, axis));
    let slope = cone.tangent().squared();
    let a = square(&across).minus(&slope.times(&rise.squared()));
    let b = dot(&away, &across).minus(&slope.times(&height.times(&rise)));
    let c = square(&away).minus(&slope.times(&height.squared()));
    let times = if !decider.is_zero(&a) {
        roots(&a, &b, &c, decider)?
    } else if !decider.is_zero(&b) {
        // As steep as the side: one of both halves is met once.
        vec![quotient(&c.negated(), &b.plus(&b))?]
    } else if decider.is_zero(&c) {
        return Ok(Met::Side);
    } else {
        Vec::new()
    };
    let mut own = Vec::new();
    for time in times {
        let there = height.plus(&rise.times(&time));
        if decider.order(&there) != Ordering::Less {
            own.push(time);
        }
    }
    Ok(Met::At(own))
}

/// Of a plane and something round; none where that is not round.
pub(crate) fn of_plane<S: Scalar>(
    plane: &Plane<S>,
    round: &Entity<S>,
    decider: &mut Decider,
) -> Result<Option<Found<S>>, GeometryError> {
    Ok(Some(match round {
        Entity::Sphere(sphere) => plane_with_sphere(plane, sphere, decider)?,
        Entity::Circle(circle) => match of_planes(plane, circle.plane(), decider)? {
            Found::Plane(_) => Found::Circle(circle.clone()),
            Found::Line(line) => return of_line(&line, round, decider),
            _ => Found::Nothing,
        },
        Entity::Cylinder(cylinder) => plane_with_cylinder(plane, cylinder, decider)?,
        Entity::Cone(cone) => plane_with_cone(plane, cone, decider)?,
        _ => return Ok(None),
    }))
}

/// The foot of a point on a plane, and the square of its distance.
fn foot<S: Scalar>(plane: &Plane<S>, point: &[S; 3]) -> Result<([S; 3], S), GeometryError> {
    let normal = plane.normal().components();
    let (height, size) = (plane.height(point), square(normal));
    let foot = along(point, normal, &height.negated(), &size)?;
    Ok((foot, quotient(&height.squared(), &size)?))
}

fn plane_with_sphere<S: Scalar>(
    plane: &Plane<S>,
    sphere: &Sphere<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (foot, away) = foot(plane, &sphere.centre().0)?;
    let left = sphere.radius().squared().minus(&away);
    Ok(match decider.order(&left) {
        Ordering::Less => Found::Nothing,
        Ordering::Equal => Found::Point(Point(foot)),
        Ordering::Greater => Found::Circle(Circle::new(
            Point(foot),
            plane.normal().clone(),
            root(&left)?,
        )?),
    })
}

fn plane_with_cylinder<S: Scalar>(
    plane: &Plane<S>,
    cylinder: &Cylinder<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (axis, direction) = (cylinder.axis(), cylinder.axis().direction());
    let (m, d) = (plane.normal().components(), direction.components());
    if decider.is_zero(&dot(m, d)) {
        let (foot, away) = foot(plane, &axis.point().0)?;
        let left = cylinder.radius().squared().minus(&away);
        let beside = cross(m, d);
        return Ok(match decider.order(&left) {
            Ordering::Less => Found::Nothing,
            Ordering::Equal => Found::Line(Line::new(Point(foot), direction.clone())),
            Ordering::Greater => {
                let way = root(&quotient(&left, &square(&beside))?)?;
                let line = |way: &S| {
                    let point = plus(&foot, &scaled(&beside, way));
                    Found::Line(Line::new(Point(point), direction.clone()))
                };
                Found::Several(vec![line(&way), line(&way.negated())])
            }
        });
    }
    match (
        decider.vanishes(&cross(m, d)),
        with_plane(axis, plane, decider)?,
    ) {
        (true, Found::Point(centre)) => across(centre, direction, cylinder.radius().clone()),
        _ => Err(GeometryError::Degenerate {
            needed: "a plane along or across the axis of a cylinder",
            found: "one askew to it, which cuts an ellipse out of it",
        }),
    }
}

fn plane_with_cone<S: Scalar>(
    plane: &Plane<S>,
    cone: &Cone<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (axis, direction) = (cone.axis(), cone.axis().direction());
    let (m, d) = (plane.normal().components(), direction.components());
    let straight = decider.vanishes(&cross(m, d));
    let Found::Point(centre) = with_plane(axis, plane, decider)? else {
        return Err(askew());
    };
    if !straight {
        return Err(askew());
    }
    let height = dot(&minus(&centre.0, &cone.apex().0), d);
    Ok(match decider.order(&height) {
        Ordering::Less => Found::Nothing,
        Ordering::Equal => Found::Point(cone.apex().clone()),
        Ordering::Greater => {
            let size = root(&square(d))?;
            let radius = quotient(&cone.tangent().times(&height), &size)?;
            across(centre, direction, radius)?
        }
    })
}

fn askew() -> GeometryError {
    GeometryError::Degenerate {
        needed: "a plane across the axis of a cone",
        found: "one askew to it, which cuts another conic out of it",
    }
}

/// The circle about an axis at a centre.
pub(crate) fn across<S: Scalar>(
    centre: Point<S>,
    axis: &Direction<S>,
    radius: S,
) -> Result<Found<S>, GeometryError> {
    Ok(Found::Circle(Circle::new(centre, axis.clone(), radius)?))
}
