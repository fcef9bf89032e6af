//! What terms stand for.

use crate::decide::Answer;
use crate::entity::{Direction, Entity, Found, Line, Plane, Point};
use crate::error::GeometryError;
use crate::scalar::Scalar;

/// An entity of the world, or one that was made for this question.
#[derive(Clone, Debug)]
pub(super) enum Held<'w, S> {
    Known(&'w str, &'w Entity<S>),
    Made(Box<Entity<S>>),
}

impl<S> Held<'_, S> {
    pub(super) fn entity(&self) -> &Entity<S> {
        match self {
            Self::Known(_, entity) => entity,
            Self::Made(entity) => entity,
        }
    }

    pub(super) fn name(&self) -> Option<&str> {
        match self {
            Self::Known(name, _) => Some(name),
            Self::Made(_) => None,
        }
    }
}

/// What a term stands for.
#[derive(Clone, Debug)]
pub(super) enum Value<'w, S> {
    Entity(Held<'w, S>),
    Number(S),
    /// A place or an order, such as `above`.
    Word(&'static str),
    /// In order; nothing where there is none.
    List(Vec<Value<'w, S>>),
    /// Whether something holds.
    Truth(Answer),
}

impl<'w, S> Value<'w, S> {
    /// What was made.
    pub(super) fn made(entity: impl Into<Entity<S>>) -> Self {
        Self::Entity(Held::Made(Box::new(entity.into())))
    }

    /// What was found: a list of nothing and of several.
    pub(super) fn found(found: Found<S>) -> Self {
        let several = matches!(found, Found::Several(_) | Found::Nothing);
        let mut members: Vec<Self> = found.entities().into_iter().map(Self::made).collect();
        match (several, members.pop()) {
            (false, Some(one)) => one,
            (true, Some(last)) => {
                members.push(last);
                Self::List(members)
            }
            (_, None) => Self::List(Vec::new()),
        }
    }

    /// What it is, for messages.
    pub(super) fn sort(&self) -> String {
        match self {
            Self::Entity(held) => format!("a {}", held.entity().kind()),
            Self::Number(_) => "a number".to_owned(),
            Self::Word(word) => format!("`{word}`"),
            Self::List(members) => match members.len() {
                0 => "nothing".to_owned(),
                count => format!("a list of {count}"),
            },
            Self::Truth(_) => "an answer".to_owned(),
        }
    }
}

/// Why a call has no value.
#[derive(Clone, Debug)]
pub(super) struct NoValue(pub(super) String);

impl From<GeometryError> for NoValue {
    fn from(error: GeometryError) -> Self {
        Self(error.to_string())
    }
}

fn needed(what: &str, found: &str) -> NoValue {
    NoValue(format!("needed {what}, found {found}"))
}

/// The arguments of a call.
pub(super) struct Arguments<'a, 'w, S>(pub(super) &'a [Value<'w, S>]);

impl<'a, 'w, S> Arguments<'a, 'w, S> {
    fn at(&self, number: usize) -> Result<&'a Value<'w, S>, NoValue> {
        let missing = || needed("another argument", "none");
        self.0.get(number).ok_or_else(missing)
    }

    pub(super) fn count(&self) -> usize {
        self.0.len()
    }

    pub(super) fn is_number(&self, at: usize) -> bool {
        matches!(self.0.get(at), Some(Value::Number(_)))
    }

    pub(super) fn entity(&self, at: usize) -> Result<&'a Entity<S>, NoValue> {
        match self.at(at)? {
            Value::Entity(held) => Ok(held.entity()),
            other => Err(needed("one entity", &other.sort())),
        }
    }

    pub(super) fn number(&self, at: usize) -> Result<&'a S, NoValue> {
        match self.at(at)? {
            Value::Number(number) => Ok(number),
            other => Err(needed("a number", &other.sort())),
        }
    }

    pub(super) fn point(&self, at: usize) -> Result<&'a Point<S>, NoValue> {
        match self.at(at)? {
            Value::Entity(held) => match held.entity() {
                Entity::Point(point) => Ok(point),
                other => Err(needed("a point", &format!("a {}", other.kind()))),
            },
            other => Err(needed("a point", &other.sort())),
        }
    }

    pub(super) fn points(&self, at: usize) -> Result<Vec<&'a Point<S>>, NoValue> {
        let members = match self.at(at)? {
            Value::List(members) => members.as_slice(),
            one => std::slice::from_ref(one),
        };
        let all = Arguments(members);
        (0..members.len()).map(|number| all.point(number)).collect()
    }
}

impl<S: Scalar> Arguments<'_, '_, S> {
    /// A direction, or that of a line.
    pub(super) fn direction(&self, at: usize) -> Result<Direction<S>, NoValue> {
        match self.entity(at)? {
            Entity::Direction(direction) => Ok(direction.clone()),
            Entity::Vector(vector) => Ok(Direction::new(vector.0.clone())?),
            Entity::Line(line) => Ok(line.direction().clone()),
            other => Err(needed("a direction", &format!("a {}", other.kind()))),
        }
    }

    pub(super) fn line(&self, at: usize) -> Result<Line<S>, NoValue> {
        match self.entity(at)? {
            Entity::Line(line) => Ok(line.clone()),
            Entity::Segment(segment) => Ok(segment.line()),
            other => Err(needed("a line", &format!("a {}", other.kind()))),
        }
    }

    pub(super) fn plane(&self, at: usize) -> Result<Plane<S>, NoValue> {
        match self.entity(at)? {
            Entity::Plane(plane) => Ok(plane.clone()),
            Entity::Face(face) => Ok(face.plane().clone()),
            Entity::Circle(circle) => Ok(circle.plane().clone()),
            other => Err(needed("a plane", &format!("a {}", other.kind()))),
        }
    }
}
