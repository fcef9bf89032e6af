//! What geometry is about. An entity that exists is valid.

use crate::boundary::{Boundary, Face};
use crate::curved::{Circle, Cone, Cylinder, Sphere};
use crate::decide::{Answer, zero_vector};
use crate::error::GeometryError;
use crate::scalar::Scalar;
use crate::triple::{cross, dot, minus, negated};
use std::fmt;

/// Three components; it may be zero.
#[derive(Clone, Debug)]
pub struct Vector<S>(pub [S; 3]);

/// A place in space.
#[derive(Clone, Debug)]
pub struct Point<S>(pub [S; 3]);

/// A direction with its sense: a vector of any length that is certainly not zero. Kept without roots, hence not scaled to
/// length 1.
#[derive(Clone, Debug)]
pub struct Direction<S> {
    components: [S; 3],
}

/// A straight line without limits. Its direction has no say in what it is.
#[derive(Clone, Debug)]
pub struct Line<S> {
    point: Point<S>,
    direction: Direction<S>,
}

/// A plane without limits. Its normal says which side is above.
#[derive(Clone, Debug)]
pub struct Plane<S> {
    point: Point<S>,
    normal: Direction<S>,
}

/// A part of a straight line between two points, which belong to it.
#[derive(Clone, Debug)]
pub struct Segment<S> {
    from: Point<S>,
    to: Point<S>,
    direction: Direction<S>,
}

impl<S: Scalar> Direction<S> {
    /// The direction of a vector.
    ///
    /// # Errors
    /// Of the zero vector, and of one that may be zero within its digits.
    pub fn new(components: [S; 3]) -> Result<Self, GeometryError> {
        Self::for_entity(components, "a direction that is not the zero vector")
    }

    /// With what the entity that is made of it needs.
    pub(crate) fn for_entity(
        components: [S; 3],
        needed: &'static str,
    ) -> Result<Self, GeometryError> {
        let found = match zero_vector(&components) {
            Answer::No => return Ok(Self { components }),
            Answer::Yes => "the vector 0",
            Answer::WithinDigits => "a vector that may be 0 within its digits",
            Answer::Indistinguishable => "a vector that no digits tell from 0",
        };
        Err(GeometryError::Degenerate { needed, found })
    }

    /// The vector that it was made from.
    #[must_use]
    pub fn components(&self) -> &[S; 3] {
        &self.components
    }

    /// The opposite direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            components: negated(&self.components),
        }
    }

    /// Two vectors perpendicular to it and to each other that make a right-handed frame with it, of any lengths.
    pub(crate) fn across(&self) -> [[S; 3]; 2] {
        let certain = |x: &S| Answer::zero(x.sign()).is_no();
        let pivot = self.components.iter().position(certain).unwrap_or(0);
        // The next axis is not along the direction, which has a component along this one.
        let unit = |axis: usize| S::whole(i32::from(axis == (pivot + 1) % 3));
        let first = cross(&self.components, &[unit(0), unit(1), unit(2)]);
        let second = cross(&self.components, &first);
        [first, second]
    }
}

impl<S: Scalar> Line<S> {
    /// The line through a point along a direction.
    #[must_use]
    pub fn new(point: Point<S>, direction: Direction<S>) -> Self {
        Self { point, direction }
    }

    /// The line through two points.
    ///
    /// # Errors
    /// Where the points are equal, or may be within their digits.
    pub fn through(from: Point<S>, to: &Point<S>) -> Result<Self, GeometryError> {
        let needed = "two different points for a line";
        let direction = Direction::for_entity(minus(&to.0, &from.0), needed)?;
        Ok(Self::new(from, direction))
    }

    /// A point of it.
    #[must_use]
    pub fn point(&self) -> &Point<S> {
        &self.point
    }

    /// Its direction, in one of its two senses.
    #[must_use]
    pub fn direction(&self) -> &Direction<S> {
        &self.direction
    }
}

impl<S: Scalar> Plane<S> {
    /// The plane through a point across a normal.
    #[must_use]
    pub fn new(point: Point<S>, normal: Direction<S>) -> Self {
        Self { point, normal }
    }

    /// The plane through three points; seen from above they follow each other counterclockwise.
    ///
    /// # Errors
    /// Where the points are on one line, or may be within their digits.
    pub fn through(a: Point<S>, b: &Point<S>, c: &Point<S>) -> Result<Self, GeometryError> {
        let needed = "three points that are not on one line for a plane";
        let normal = cross(&minus(&b.0, &a.0), &minus(&c.0, &a.0));
        Ok(Self::new(a, Direction::for_entity(normal, needed)?))
    }

    /// A point of it.
    #[must_use]
    pub fn point(&self) -> &Point<S> {
        &self.point
    }

    /// Its normal.
    #[must_use]
    pub fn normal(&self) -> &Direction<S> {
        &self.normal
    }

    /// The height of a point above the plane, times the length of the normal.
    pub(crate) fn height(&self, point: &[S; 3]) -> S {
        let offset = minus(point, &self.point.0);
        dot(&offset, &self.normal.components)
    }
}

impl<S: Scalar> Segment<S> {
    /// The segment between two points.
    ///
    /// # Errors
    /// Where the points are equal, or may be within their digits.
    pub fn new(from: Point<S>, to: Point<S>) -> Result<Self, GeometryError> {
        let needed = "two different points for a segment";
        let direction = Direction::for_entity(minus(&to.0, &from.0), needed)?;
        Ok(Self {
            from,
            to,
            direction,
        })
    }

    /// Where it begins.
    #[must_use]
    pub fn from(&self) -> &Point<S> {
        &self.from
    }

    /// Where it ends.
    #[must_use]
    pub fn to(&self) -> &Point<S> {
        &self.to
    }

    /// From its beginning to its end.
    #[must_use]
    pub fn direction(&self) -> &Direction<S> {
        &self.direction
    }

    /// The line that it is a part of.
    #[must_use]
    pub fn line(&self) -> Line<S> {
        Line::new(self.from.clone(), self.direction.clone())
    }
}

/// What an entity is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A [`Vector`].
    Vector,
    /// A [`Direction`].
    Direction,
    /// A [`Point`].
    Point,
    /// A [`Line`].
    Line,
    /// A [`Plane`].
    Plane,
    /// A [`Segment`].
    Segment,
    /// A [`Face`].
    Face,
    /// A [`Boundary`].
    Boundary,
    /// A [`Circle`].
    Circle,
    /// A [`Cylinder`].
    Cylinder,
    /// A [`Cone`].
    Cone,
    /// A [`Sphere`].
    Sphere,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Vector => "vector",
            Self::Direction => "direction",
            Self::Point => "point",
            Self::Line => "line",
            Self::Plane => "plane",
            Self::Segment => "segment",
            Self::Face => "face",
            Self::Boundary => "boundary",
            Self::Circle => "circle",
            Self::Cylinder => "cylinder",
            Self::Cone => "cone",
            Self::Sphere => "sphere",
        })
    }
}

/// Any entity.
#[derive(Clone, Debug)]
pub enum Entity<S> {
    /// A vector.
    Vector(Vector<S>),
    /// A direction.
    Direction(Direction<S>),
    /// A point.
    Point(Point<S>),
    /// A straight line.
    Line(Line<S>),
    /// A plane.
    Plane(Plane<S>),
    /// A segment.
    Segment(Segment<S>),
    /// A flat face.
    Face(Face<S>),
    /// The boundary of a solid, or an open one.
    Boundary(Boundary<S>),
    /// A circle.
    Circle(Circle<S>),
    /// A cylinder.
    Cylinder(Cylinder<S>),
    /// One half of a cone.
    Cone(Cone<S>),
    /// A sphere.
    Sphere(Sphere<S>),
}

impl<S> Entity<S> {
    /// What it is.
    #[must_use]
    pub const fn kind(&self) -> Kind {
        match self {
            Self::Vector(_) => Kind::Vector,
            Self::Direction(_) => Kind::Direction,
            Self::Point(_) => Kind::Point,
            Self::Line(_) => Kind::Line,
            Self::Plane(_) => Kind::Plane,
            Self::Segment(_) => Kind::Segment,
            Self::Face(_) => Kind::Face,
            Self::Boundary(_) => Kind::Boundary,
            Self::Circle(_) => Kind::Circle,
            Self::Cylinder(_) => Kind::Cylinder,
            Self::Cone(_) => Kind::Cone,
            Self::Sphere(_) => Kind::Sphere,
        }
    }
}

/// The error of a function that has no meaning for a pair.
pub(crate) fn no_pair<S>(function: &'static str, a: &Entity<S>, b: &Entity<S>) -> GeometryError {
    GeometryError::NoSuchPair {
        function,
        first: a.kind(),
        second: b.kind(),
    }
}

/// What a construction found: which kind of entity it is may be known only at run time.
#[derive(Clone, Debug)]
pub enum Found<S> {
    /// There is nothing.
    Nothing,
    /// A point.
    Point(Point<S>),
    /// A direction.
    Direction(Direction<S>),
    /// A line.
    Line(Line<S>),
    /// A plane.
    Plane(Plane<S>),
    /// A segment.
    Segment(Segment<S>),
    /// A face.
    Face(Face<S>),
    /// A boundary.
    Boundary(Boundary<S>),
    /// A circle.
    Circle(Circle<S>),
    /// A cylinder.
    Cylinder(Cylinder<S>),
    /// A cone.
    Cone(Cone<S>),
    /// A sphere.
    Sphere(Sphere<S>),
    /// Two or more of these, none of which has others inside.
    Several(Vec<Found<S>>),
}

impl<S> Found<S> {
    /// What parts there are: none of them nothing, one by itself.
    pub(crate) fn of(mut parts: Vec<Self>) -> Self {
        match (parts.pop(), parts.is_empty()) {
            (None, _) => Self::Nothing,
            (Some(one), true) => one,
            (Some(last), false) => {
                parts.push(last);
                Self::Several(parts)
            }
        }
    }

    /// The parts: none of nothing, all of several, otherwise what it is.
    #[must_use]
    pub fn parts(&self) -> &[Self] {
        match self {
            Self::Nothing => &[],
            Self::Several(parts) => parts,
            one => std::slice::from_ref(one),
        }
    }

    /// All entities, for other questions.
    #[must_use]
    pub fn entities(self) -> Vec<Entity<S>> {
        match self {
            Self::Several(parts) => parts.into_iter().filter_map(Self::entity).collect(),
            one => one.entity().into_iter().collect(),
        }
    }

    /// The entity, for another question; none of several, which [`Found::entities`] gives.
    #[must_use]
    pub fn entity(self) -> Option<Entity<S>> {
        match self {
            Self::Nothing | Self::Several(_) => None,
            Self::Point(x) => Some(Entity::Point(x)),
            Self::Direction(x) => Some(Entity::Direction(x)),
            Self::Line(x) => Some(Entity::Line(x)),
            Self::Plane(x) => Some(Entity::Plane(x)),
            Self::Segment(x) => Some(Entity::Segment(x)),
            Self::Face(x) => Some(Entity::Face(x)),
            Self::Boundary(x) => Some(Entity::Boundary(x)),
            Self::Circle(x) => Some(Entity::Circle(x)),
            Self::Cylinder(x) => Some(Entity::Cylinder(x)),
            Self::Cone(x) => Some(Entity::Cone(x)),
            Self::Sphere(x) => Some(Entity::Sphere(x)),
        }
    }
}

macro_rules! entity_from {
    ($($kind:ident),*) => {
        $(impl<S> From<$kind<S>> for Entity<S> {
            fn from(x: $kind<S>) -> Self {
                Self::$kind(x)
            }
        })*
    };
}

entity_from!(
    Vector, Direction, Point, Line, Plane, Segment, Face, Boundary, Circle, Cylinder, Cone, Sphere
);
