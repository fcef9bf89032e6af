//! Parts of entities, and new entities.

use super::call::{Valued, proven};
use super::value::{Arguments, NoValue, Value};
use crate::boundary::Face;
use crate::curved::{Circle, Cone, Cylinder, Sphere};
use crate::entity::{Direction, Entity, Line, Plane, Point, Segment, Vector};
use crate::scalar::Scalar;
use crate::transform::Transformation;

/// The value of a call that takes a part of an entity, makes one, or moves one.
pub(super) fn call<'w, S: Scalar>(name: &str, arguments: &Arguments<'_, 'w, S>) -> Valued<'w, S> {
    match name {
        "axis" | "centre" | "radius" | "normal" | "plane_of" | "line_of" | "ends" | "corners" => {
            part(name, arguments)
        }
        "moved" | "turned" => moved(name, arguments),
        "circle" | "cylinder" | "cone" | "sphere" => round(name, arguments),
        _ => flat(name, arguments),
    }
}

fn without(part: &str, entity: &str) -> NoValue {
    NoValue(format!("needed an entity with {part}, found a {entity}"))
}

fn part<'w, S: Scalar>(name: &str, arguments: &Arguments<'_, 'w, S>) -> Valued<'w, S> {
    let entity = arguments.entity(0)?;
    let points = |points: Vec<Point<S>>| -> Value<'w, S> {
        Value::List(points.into_iter().map(Value::made).collect())
    };
    proven(match (name, entity) {
        ("axis", Entity::Circle(circle)) => Value::made(circle.axis()),
        ("axis", Entity::Cylinder(cylinder)) => Value::made(cylinder.axis().clone()),
        ("axis", Entity::Cone(cone)) => Value::made(cone.axis().clone()),
        ("centre", Entity::Circle(circle)) => Value::made(circle.centre().clone()),
        ("centre", Entity::Sphere(sphere)) => Value::made(sphere.centre().clone()),
        ("centre", Entity::Cone(cone)) => Value::made(cone.apex().clone()),
        ("radius", Entity::Circle(circle)) => Value::Number(circle.radius().clone()),
        ("radius", Entity::Cylinder(cylinder)) => Value::Number(cylinder.radius().clone()),
        ("radius", Entity::Sphere(sphere)) => Value::Number(sphere.radius().clone()),
        ("normal", _) => Value::made(arguments.plane(0)?.normal().clone()),
        ("plane_of", _) => Value::made(arguments.plane(0)?),
        ("line_of", _) => Value::made(arguments.line(0)?),
        ("ends", Entity::Segment(s)) => points(vec![s.from().clone(), s.to().clone()]),
        ("corners", Entity::Face(face)) => points(face.corners().cloned().collect()),
        ("corners", Entity::Boundary(boundary)) => points(boundary.vertices().to_vec()),
        _ => return Err(without(name, &entity.kind().to_string())),
    })
}

fn moved<'w, S: Scalar>(name: &str, arguments: &Arguments<'_, 'w, S>) -> Valued<'w, S> {
    let entity = arguments.entity(0)?;
    let motion = match (name, arguments.entity(1)?) {
        ("moved", Entity::Vector(by)) => Transformation::translation(by),
        ("moved", other) => {
            return Err(NoValue(format!(
                "needed a vector, found a {}",
                other.kind()
            )));
        }
        _ => Transformation::about(
            &arguments.line(1)?,
            arguments.number(2)?,
            arguments.number(3)?,
        )?,
    };
    Ok((Value::made(motion.entity(entity)?), motion.certainty()))
}

fn triple<S: Scalar>(arguments: &Arguments<'_, '_, S>) -> Result<[S; 3], NoValue> {
    Ok([
        arguments.number(0)?.clone(),
        arguments.number(1)?.clone(),
        arguments.number(2)?.clone(),
    ])
}

fn flat<'w, S: Scalar>(name: &str, arguments: &Arguments<'_, 'w, S>) -> Valued<'w, S> {
    let point = |at: usize| arguments.point(at).cloned();
    proven(match name {
        "point" => Value::made(Point(triple(arguments)?)),
        "vector" => Value::made(Vector(triple(arguments)?)),
        "direction" if arguments.count() == 3 => Value::made(Direction::new(triple(arguments)?)?),
        "direction" => Value::made(arguments.direction(0)?),
        "line" => match arguments.entity(1)? {
            Entity::Point(second) => Value::made(Line::through(point(0)?, second)?),
            _ => Value::made(Line::new(point(0)?, arguments.direction(1)?)),
        },
        "plane" if arguments.count() == 3 => {
            Value::made(Plane::through(point(0)?, &point(1)?, &point(2)?)?)
        }
        "plane" => Value::made(Plane::new(point(0)?, arguments.direction(1)?)),
        "segment" => Value::made(Segment::new(point(0)?, point(1)?)?),
        "face" => {
            let mut loops = Vec::with_capacity(arguments.count());
            for at in 0..arguments.count() {
                loops.push(arguments.points(at)?.into_iter().cloned().collect());
            }
            let face = Face::new(loops)?;
            let certainty = face.certainty();
            return Ok((Value::made(face), certainty));
        }
        _ => return Err(NoValue(format!("needed a function, found `{name}`"))),
    })
}

fn round<'w, S: Scalar>(name: &str, arguments: &Arguments<'_, 'w, S>) -> Valued<'w, S> {
    let point = |at: usize| arguments.point(at).cloned();
    let number = |at: usize| arguments.number(at).cloned();
    proven(match name {
        "circle" => Value::made(Circle::new(point(0)?, arguments.direction(1)?, number(2)?)?),
        "cylinder" if arguments.is_number(1) && arguments.count() == 2 => {
            Value::made(Cylinder::new(arguments.line(0)?, number(1)?)?)
        }
        "cylinder" if arguments.count() == 2 => {
            return Err(NoValue(
                "needed a radius after the line, found none".to_owned(),
            ));
        }
        "cylinder" => {
            let axis = Line::new(point(0)?, arguments.direction(1)?);
            Value::made(Cylinder::new(axis, number(2)?)?)
        }
        "cone" => Value::made(Cone::new(point(0)?, arguments.direction(1)?, number(2)?)?),
        _ => Value::made(Sphere::new(point(0)?, number(1)?)?),
    })
}
