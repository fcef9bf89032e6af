//! Mechanisms drawn in the world: every joint where it stands at home, all link frames parallel to the world.

use crate::mechanism::{
    Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder, MechanismError,
};
use crate::number::Number;
use std::collections::BTreeMap;

/// Three coordinates, exact: a point in metres or a direction of any length.
pub(super) type Triple = [Number; 3];

/// A hinge between two links.
pub(super) struct Hinge {
    /// Its name.
    pub name: String,
    /// The links it joins.
    pub links: [String; 2],
    /// A point of its axis, which becomes the joint's origin.
    pub at: Triple,
    /// The direction of its axis.
    pub along: Triple,
    /// Where the second link has the point, if that is elsewhere: such a hinge is drawn open.
    pub second_at: Option<Triple>,
}

impl Hinge {
    /// A hinge whose two sides coincide at home.
    pub fn new(name: &str, first: &str, second: &str, at: Triple, along: Triple) -> Self {
        Self {
            name: name.to_owned(),
            links: [first.to_owned(), second.to_owned()],
            at,
            along,
            second_at: None,
        }
    }
}

/// Builds a mechanism from its hinges. The first hinge's first link is the ground; a hinge to a link not met before carries
/// that link, and one between two links met before closes a loop. A link's frame is at the hinge that carries it.
///
/// # Errors
/// What [`MechanismBuilder::build`] finds wrong.
pub(super) fn hinged(name: &str, hinges: &[Hinge]) -> Result<Mechanism, MechanismError> {
    let mut builder = MechanismBuilder::new(name);
    let mut origins: BTreeMap<&str, Triple> = BTreeMap::new();
    for hinge in hinges {
        let [first, second] = &hinge.links;
        if origins.is_empty() {
            builder.link(first);
            origins.insert(first, std::array::from_fn(|_| Number::zero()));
        }
        let base = origins.get(first.as_str()).cloned();
        let base = base.unwrap_or_else(|| std::array::from_fn(|_| Number::zero()));
        let here = Frame::at(minus(&hinge.at, &base));
        let along = Direction(hinge.along.clone());
        let joint = match origins.get(second.as_str()) {
            Some(origin) => {
                let there = hinge.second_at.as_ref().unwrap_or(&hinge.at);
                JointBuilder::closing(&hinge.name, JointKind::Revolute, first, second)
                    .successor_origin(Frame::at(minus(there, origin)))
            }
            None => {
                builder.link(second);
                origins.insert(second, hinge.at.clone());
                JointBuilder::tree(&hinge.name, JointKind::Revolute, first, second)
            }
        };
        builder.joint(joint.origin(here).axis(along));
    }
    builder.build()
}

pub(super) fn integers(x: i64, y: i64, z: i64) -> Triple {
    [x, y, z].map(Number::integer)
}

pub(super) fn plus(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|i| &a[i] + &b[i])
}

pub(super) fn minus(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|i| &a[i] - &b[i])
}

pub(super) fn times(factor: &Number, a: &Triple) -> Triple {
    std::array::from_fn(|i| factor * &a[i])
}

pub(super) fn dot(a: &Triple, b: &Triple) -> Number {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

pub(super) fn cross(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &(&a[j] * &b[k]) - &(&a[k] * &b[j])
    })
}

/// `a / b` for a `b` that is known not to vanish.
pub(super) fn over(a: &Number, b: &Number) -> Number {
    a.checked_div(b).unwrap_or_else(|_| Number::zero())
}

/// Cosine and sine of `2 atan(t)`, rational where `t` is.
pub(super) fn circle_point(t: &Number) -> (Number, Number) {
    let square = t * t;
    let below = &Number::one() + &square;
    let cosine = over(&(&Number::one() - &square), &below);
    let sine = over(&(&Number::integer(2) * t), &below);
    (cosine, sine)
}
