//! Values as text.

use super::value::Value;
use crate::decide::Answer;
use crate::entity::{Entity, Kind};
use crate::text::Legible;

/// A value as it is told.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// For a person.
    pub text: String,
    /// What it is, where it is an entity.
    pub kind: Option<Kind>,
    /// The nearest double, where it is a number.
    pub number: Option<f64>,
    /// The members, where it is a list.
    pub members: Vec<Shown>,
}

impl Shown {
    /// A value; entities of the world by their names.
    pub(super) fn of<S: Legible>(value: &Value<'_, S>) -> Self {
        let plain = |text: String| Self {
            text,
            kind: None,
            number: None,
            members: Vec::new(),
        };
        match value {
            Value::Entity(held) => {
                let entity = held.entity();
                let text = held.name().map(str::to_owned);
                Self {
                    kind: Some(entity.kind()),
                    ..plain(text.unwrap_or_else(|| entity_text(entity)))
                }
            }
            Value::Number(number) => Self {
                number: Some(number.double()),
                ..plain(number_text(number))
            },
            Value::Word(word) => plain((*word).to_owned()),
            Value::Truth(answer) => plain(answer_text(*answer).to_owned()),
            Value::List(members) => {
                let members: Vec<Self> = members.iter().map(Self::of).collect();
                let texts: Vec<&str> = members.iter().map(|m| m.text.as_str()).collect();
                let text = match texts.is_empty() {
                    true => "nothing".to_owned(),
                    false => format!("[{}]", texts.join(", ")),
                };
                Self {
                    members,
                    ..plain(text)
                }
            }
        }
    }
}

/// Exact, and about what it is where that is no decimal.
fn number_text<S: Legible>(number: &S) -> String {
    let text = number.to_text();
    match text.starts_with("${") {
        true => format!(
            "{text}, about {}",
            crate::text::double_text(number.double())
        ),
        false => text,
    }
}

/// The word of an answer.
pub(super) fn answer_text(answer: Answer) -> &'static str {
    match answer {
        Answer::Yes => "yes",
        Answer::No => "no",
        Answer::WithinDigits => "within the digits",
        Answer::Indistinguishable => "not told from it by any digits",
    }
}

fn triple<S: Legible>(numbers: &[S; 3]) -> String {
    let [x, y, z] = numbers;
    format!("{}, {}, {}", x.to_text(), y.to_text(), z.to_text())
}

/// An entity by the call that makes one like it, where that is short.
pub(super) fn entity_text<S: Legible>(entity: &Entity<S>) -> String {
    let point = |at: &[S; 3]| format!("point({})", triple(at));
    let direction = |along: &[S; 3]| format!("direction({})", triple(along));
    match entity {
        Entity::Vector(vector) => format!("vector({})", triple(&vector.0)),
        Entity::Direction(own) => direction(own.components()),
        Entity::Point(own) => point(&own.0),
        Entity::Line(line) => {
            let along = direction(line.direction().components());
            format!("line({}, {along})", point(&line.point().0))
        }
        Entity::Plane(plane) => {
            let normal = direction(plane.normal().components());
            format!("plane({}, {normal})", point(&plane.point().0))
        }
        Entity::Segment(segment) => {
            let (from, to) = (point(&segment.from().0), point(&segment.to().0));
            format!("segment({from}, {to})")
        }
        Entity::Face(face) => {
            let corners: Vec<String> = face
                .loops()
                .iter()
                .map(|ring| list(ring.iter(), &point))
                .collect();
            format!("face({})", corners.join(", "))
        }
        Entity::Boundary(boundary) => format!(
            "a {} of {} faces, {} edges and {} vertices",
            if boundary.is_solid() {
                "solid"
            } else {
                "surface"
            },
            boundary.faces().len(),
            boundary.edges().len(),
            boundary.vertices().len()
        ),
        Entity::Circle(circle) => {
            let normal = direction(circle.plane().normal().components());
            let centre = point(&circle.centre().0);
            format!("circle({centre}, {normal}, {})", circle.radius().to_text())
        }
        Entity::Cylinder(cylinder) => {
            let along = direction(cylinder.axis().direction().components());
            let base = point(&cylinder.axis().point().0);
            format!("cylinder({base}, {along}, {})", cylinder.radius().to_text())
        }
        Entity::Cone(cone) => {
            let along = direction(cone.axis().direction().components());
            let apex = point(&cone.apex().0);
            format!("cone({apex}, {along}, {})", cone.tangent().to_text())
        }
        Entity::Sphere(sphere) => {
            let centre = point(&sphere.centre().0);
            format!("sphere({centre}, {})", sphere.radius().to_text())
        }
    }
}

/// Longer loops are told by their number of corners.
const MOST_CORNERS: usize = 8;

fn list<'a, S: 'a>(
    points: impl ExactSizeIterator<Item = &'a crate::entity::Point<S>>,
    shown: &dyn Fn(&[S; 3]) -> String,
) -> String {
    let count = points.len();
    if count > MOST_CORNERS {
        return format!("[{count} corners]");
    }
    let texts: Vec<String> = points.map(|corner| shown(&corner.0)).collect();
    format!("[{}]", texts.join(", "))
}
