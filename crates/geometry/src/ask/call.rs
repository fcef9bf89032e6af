//! The functions of the language.

use super::make;
use super::value::{Arguments, NoValue, Value};
use crate::angle::{angle_between, signed_angle_between};
use crate::boundary::{
    FacePlace, classify_by_face, classify_in_face, classify_in_solid, concave, convex,
};
use crate::decide::{Answer, Certainty, Outcome};
use crate::distance::distance;
use crate::entity::{Entity, Point};
use crate::error::GeometryError;
use crate::hull::space_hull;
use crate::intersection::intersection;
use crate::join::{join_perpend, perpend};
use crate::logical::{coincide, colinear, contained, coplanar, parallel, perpendicular};
use crate::planar::{Place, Side, calculate_normal, classify, planar_hull, sort_angular};
use crate::projection::projection;
use crate::round::{classify_by_round, coaxial, compare_radii, concentric, radius_difference};
use crate::scalar::Scalar;
use std::cmp::Ordering;

/// A function as it is called.
pub(super) struct Function {
    pub(super) name: &'static str,
    /// The fewest arguments.
    pub(super) least: usize,
    /// The most arguments.
    pub(super) most: usize,
    /// How it is written.
    pub(super) form: &'static str,
}

const fn function(name: &'static str, least: usize, most: usize, form: &'static str) -> Function {
    Function {
        name,
        least,
        most,
        form,
    }
}

/// All functions: logical ones, constructions, parts, makers of entities, and two about the world.
pub(super) const FUNCTIONS: &[Function] = &[
    function("coincide", 2, 2, "coincide(a, b)"),
    function("colinear", 2, 2, "colinear(a, b)"),
    function("coplanar", 2, 2, "coplanar(a, b)"),
    function("contained", 2, 2, "contained(part, whole)"),
    function("parallel", 2, 2, "parallel(a, b)"),
    function("perpendicular", 2, 2, "perpendicular(a, b)"),
    function("convex", 2, 2, "convex(face, face)"),
    function("concave", 2, 2, "concave(face, face)"),
    function("coaxial", 2, 2, "coaxial(a, b)"),
    function("concentric", 2, 2, "concentric(a, b)"),
    function("distance", 2, 2, "distance(a, b)"),
    function("angle", 2, 2, "angle(a, b)"),
    function("angle_between", 2, 2, "angle_between(a, b)"),
    function(
        "signed_angle_between",
        3,
        3,
        "signed_angle_between(a, b, direction)",
    ),
    function("intersection", 2, 2, "intersection(a, b)"),
    function("projection", 2, 3, "projection(a, on, direction)"),
    function("join_perpend", 2, 2, "join_perpend(a, b)"),
    function("perpend", 2, 2, "perpend(a, b)"),
    function("classify", 2, 2, "classify(a, beside)"),
    function(
        "sort_angular",
        3,
        3,
        "sort_angular([a, b], centre, direction)",
    ),
    function("planar_hull", 2, 2, "planar_hull([a, b], direction)"),
    function("space_hull", 1, 1, "space_hull([a, b])"),
    function("calculate_normal", 1, 1, "calculate_normal([a, b, c])"),
    function("compare_radii", 2, 2, "compare_radii(a, b)"),
    function("radius_difference", 2, 2, "radius_difference(a, b)"),
    function("axis", 1, 1, "axis(round)"),
    function("centre", 1, 1, "centre(round)"),
    function("radius", 1, 1, "radius(round)"),
    function("normal", 1, 1, "normal(flat)"),
    function("plane_of", 1, 1, "plane_of(face)"),
    function("line_of", 1, 1, "line_of(segment)"),
    function("ends", 1, 1, "ends(segment)"),
    function("corners", 1, 1, "corners(face)"),
    function("point", 3, 3, "point(x, y, z)"),
    function("vector", 3, 3, "vector(x, y, z)"),
    function("direction", 1, 3, "direction(x, y, z) or direction(line)"),
    function("line", 2, 2, "line(point, direction) or line(point, point)"),
    function(
        "plane",
        2,
        3,
        "plane(point, direction) or plane(point, point, point)",
    ),
    function("segment", 2, 2, "segment(point, point)"),
    function(
        "face",
        1,
        usize::MAX,
        "face([corner, corner, corner], [hole])",
    ),
    function("circle", 3, 3, "circle(centre, direction, radius)"),
    function(
        "cylinder",
        2,
        3,
        "cylinder(line, radius) or cylinder(point, direction, radius)",
    ),
    function("cone", 3, 3, "cone(apex, direction, tangent)"),
    function("sphere", 2, 2, "sphere(centre, radius)"),
    function("moved", 2, 2, "moved(entity, vector)"),
    function("turned", 4, 4, "turned(entity, line, cosine, sine)"),
    function("is", 2, 2, "is(a, kind)"),
    function("part", 2, 2, "part(a, whole)"),
];

/// The words that functions give, for comparisons.
pub(super) const WORDS: [&str; 14] = [
    "above", "in", "below", "crossing", "touching", "inside", "border", "outside", "apart",
    "piercing", "within", "less", "equal", "greater",
];

/// A value and how certain its case is.
pub(super) type Valued<'w, S> = Result<(Value<'w, S>, Certainty), NoValue>;

type Logical<S> = fn(&Entity<S>, &Entity<S>) -> Result<Answer, GeometryError>;

fn logical<S: Scalar>(name: &str) -> Option<Logical<S>> {
    let function: Logical<S> = match name {
        "coincide" => coincide,
        "colinear" => colinear,
        "coplanar" => coplanar,
        "contained" => contained,
        "parallel" => parallel,
        "perpendicular" => perpendicular,
        "convex" => convex,
        "concave" => concave,
        "coaxial" => coaxial,
        "concentric" => concentric,
        _ => return None,
    };
    Some(function)
}

/// The value of a call; `is` and `part` are answered by who knows the world.
pub(super) fn call<'w, S: Scalar>(name: &str, values: &[Value<'w, S>]) -> Valued<'w, S> {
    let arguments = Arguments(values);
    if let Some(function) = logical::<S>(name) {
        let answer = function(arguments.entity(0)?, arguments.entity(1)?)?;
        return proven(Value::Truth(answer));
    }
    match name {
        "distance"
        | "angle"
        | "angle_between"
        | "signed_angle_between"
        | "compare_radii"
        | "radius_difference" => measure(name, &arguments),
        "intersection" | "projection" | "perpend" => found(name, &arguments),
        "join_perpend" => {
            let feet = join_perpend(arguments.entity(0)?, arguments.entity(1)?)?;
            let ends = vec![
                Value::made(feet.value.first),
                Value::made(feet.value.second),
            ];
            Ok((Value::List(ends), feet.certainty))
        }
        "classify" => beside(&arguments),
        "sort_angular" | "planar_hull" | "space_hull" | "calculate_normal" => {
            of_points(name, &arguments)
        }
        _ => make::call(name, &arguments),
    }
}

/// A value without a choice of cases.
pub(super) fn proven<S>(value: Value<'_, S>) -> Valued<'_, S> {
    Ok((value, Certainty::Proven))
}

fn measure<'w, S: Scalar>(name: &str, arguments: &Arguments<'_, 'w, S>) -> Valued<'w, S> {
    let (a, b) = (arguments.entity(0)?, arguments.entity(1)?);
    match name {
        "distance" => {
            let outcome = distance(a, b)?;
            Ok((Value::Number(outcome.value), outcome.certainty))
        }
        "angle" => proven(Value::Number(angle_between(a, b)?.angle)),
        "angle_between" => {
            let angles = angle_between(a, b)?;
            let both = vec![
                Value::Number(angles.angle),
                Value::Number(angles.supplement),
            ];
            proven(Value::List(both))
        }
        "signed_angle_between" => {
            let about = arguments.direction(2)?;
            let outcome = signed_angle_between(a, b, &about)?;
            let Outcome { value, certainty } = outcome;
            let both = vec![Value::Number(value.angle), Value::Number(value.supplement)];
            Ok((Value::List(both), certainty))
        }
        "compare_radii" => {
            let outcome = compare_radii(a, b)?;
            let word = match outcome.value {
                Ordering::Less => "less",
                Ordering::Equal => "equal",
                Ordering::Greater => "greater",
            };
            Ok((Value::Word(word), outcome.certainty))
        }
        _ => proven(Value::Number(radius_difference(a, b)?)),
    }
}

fn found<'w, S: Scalar>(name: &str, arguments: &Arguments<'_, 'w, S>) -> Valued<'w, S> {
    let (a, b) = (arguments.entity(0)?, arguments.entity(1)?);
    let outcome = match name {
        "intersection" => intersection(a, b)?,
        "perpend" => perpend(a, b)?,
        _ if arguments.count() == 3 => projection(a, b, Some(&arguments.direction(2)?))?,
        _ => projection(a, b, None)?,
    };
    Ok((Value::found(outcome.value), outcome.certainty))
}

/// Where the first is beside the second: a plane, a face, a solid or a round surface.
fn beside<'w, S: Scalar>(arguments: &Arguments<'_, 'w, S>) -> Valued<'w, S> {
    let (a, b) = (arguments.entity(0)?, arguments.entity(1)?);
    let place = |outcome: Outcome<Place>| {
        let word = match outcome.value {
            Place::Inside => "inside",
            Place::OnBorder => "border",
            Place::Outside => "outside",
        };
        Ok((Value::Word(word), outcome.certainty))
    };
    match (a, b) {
        (Entity::Point(point), Entity::Face(face)) => place(classify_in_face(point, face)),
        (Entity::Point(point), Entity::Boundary(solid)) => place(classify_in_solid(point, solid)?),
        (Entity::Point(point), Entity::Cylinder(_) | Entity::Cone(_) | Entity::Sphere(_)) => {
            place(classify_by_round(point, b)?)
        }
        (_, Entity::Face(_)) => {
            let outcome = classify_by_face(a, b)?;
            Ok((Value::Word(face_place(outcome.value)), outcome.certainty))
        }
        _ => {
            let outcome = classify(a, b)?;
            Ok((Value::Word(side(outcome.value)), outcome.certainty))
        }
    }
}

fn of_points<'w, S: Scalar>(name: &str, arguments: &Arguments<'_, 'w, S>) -> Valued<'w, S> {
    let points: Vec<Point<S>> = arguments.points(0)?.into_iter().cloned().collect();
    let list = |points: Vec<Point<S>>| -> Value<'w, S> {
        Value::List(points.into_iter().map(Value::made).collect())
    };
    match name {
        "sort_angular" => {
            let centre = arguments.point(1)?;
            let outcome = sort_angular(&points, centre, &arguments.direction(2)?);
            Ok((list(outcome.value), outcome.certainty))
        }
        "planar_hull" => {
            let outcome = planar_hull(&points, &arguments.direction(1)?);
            Ok((list(outcome.value), outcome.certainty))
        }
        "space_hull" => {
            let outcome = space_hull(&points)?;
            Ok((Value::found(outcome.value), outcome.certainty))
        }
        _ => {
            let outcome = calculate_normal(&points)?;
            let value = match outcome.value {
                Some(normal) => Value::made(normal),
                None => Value::List(Vec::new()),
            };
            Ok((value, outcome.certainty))
        }
    }
}

fn side(side: Side) -> &'static str {
    match side {
        Side::Above => "above",
        Side::In => "in",
        Side::Below => "below",
        Side::Crossing => "crossing",
        Side::Touching => "touching",
    }
}

fn face_place(place: FacePlace) -> &'static str {
    match place {
        FacePlace::Apart => "apart",
        FacePlace::Touching => "touching",
        FacePlace::Piercing => "piercing",
        FacePlace::Within => "within",
    }
}
