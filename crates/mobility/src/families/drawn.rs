//! Mechanisms drawn in the world: every joint where it stands at home, all link frames parallel to the world.

use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder, MechanismError,
};
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
pub(super) mod tests {
    use super::*;
    use kutzbach_model::mechanism::Joint;

    /// Where the links' frames are, as [`hinged`] places them: all parallel.
    fn origins(mechanism: &Mechanism) -> BTreeMap<usize, Triple> {
        let mut origins = BTreeMap::from([(
            mechanism.ground().0,
            std::array::from_fn(|_| Number::zero()),
        )]);
        for joint in mechanism.joints().iter().filter(|j| !j.closes_loop) {
            let base = origins[&joint.predecessor.link.0].clone();
            let here = plus(&base, &joint.predecessor.frame.position);
            origins.insert(joint.successor.link.0, here);
        }
        origins
    }

    /// The two points of a joint at home, as its two links have it.
    fn points(mechanism: &Mechanism, joint: &Joint) -> [Triple; 2] {
        let origins = origins(mechanism);
        [&joint.predecessor, &joint.successor]
            .map(|side| plus(&origins[&side.link.0], &side.frame.position))
    }

    /// By how much every closing hinge is open at home.
    pub fn gaps(mechanism: &Mechanism) -> Vec<Triple> {
        let closing = mechanism.joints().iter().filter(|j| j.closes_loop);
        closing
            .map(|joint| {
                let [first, second] = points(mechanism, joint);
                minus(&second, &first)
            })
            .collect()
    }

    /// The square of the distance between two hinges, as the link that has both of them measures it; of a hinge drawn open
    /// and one on neither of its links, as its first link has it.
    pub fn side_squared(mechanism: &Mechanism, first: &str, second: &str) -> Number {
        let [a, b] = [first, second].map(|name| {
            let joint = mechanism.joint(mechanism.joint_named(name).unwrap());
            let links = [joint.predecessor.link.0, joint.successor.link.0];
            (links, points(mechanism, joint))
        });
        let on = |own: &[usize; 2], other: &[usize; 2]| {
            own.iter()
                .position(|link| other.contains(link))
                .unwrap_or(0)
        };
        let side = minus(&b.1[on(&b.0, &a.0)], &a.1[on(&a.0, &b.0)]);
        dot(&side, &side)
    }

    #[test]
    fn hinges_stand_where_they_are_drawn() {
        let hinge = |name: &str, first: &str, second: &str, x: i64, y: i64| {
            let up = integers(0, 0, 1);
            Hinge::new(name, first, second, integers(x, y, 0), up)
        };
        let mut closing = hinge("c", "two", "three", 3, 3);
        closing.second_at = Some(integers(3, 3, 1));
        let hinges = [
            hinge("a", "one", "two", 1, 2),
            hinge("b", "one", "three", 5, -1),
            closing,
        ];
        let drawn = hinged("drawn", &hinges).unwrap();
        assert_eq!(drawn.link(drawn.ground()).name, "one");
        for (joint, hinge) in drawn.joints().iter().zip(&hinges) {
            let [first, second] = points(&drawn, joint);
            assert_eq!(joint.name, hinge.name);
            assert!(minus(&first, &hinge.at).iter().all(Number::is_zero));
            let there = hinge.second_at.as_ref().unwrap_or(&hinge.at);
            assert!(minus(&second, there).iter().all(Number::is_zero));
        }
        let [x, y, z] = gaps(&drawn)[0].clone().map(|n| n.value());
        assert_eq!([x, y, z], [0.0, 0.0, 1.0]);
        assert_eq!(side_squared(&drawn, "a", "b").value(), 25.0);
    }

    #[test]
    fn points_of_the_circle_are_exact() {
        let t = Number::ratio(1, 3).unwrap();
        let (x, y) = circle_point(&t);
        assert!((&(&(&x * &x) + &(&y * &y)) - &Number::one()).is_zero());
        assert_eq!((x.value(), y.value()), (0.8, 0.6));
    }
}
