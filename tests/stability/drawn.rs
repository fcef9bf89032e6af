//! Mechanisms drawn in the world with exact numbers: every joint where it stands at home, all link frames parallel.

use kutzbach::mechanism::{Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder};
use kutzbach::number::Number;
use std::collections::BTreeMap;

/// Three coordinates: a point in metres or a direction of any length.
pub type Triple = [Number; 3];

/// A joint as it stands at home.
pub struct Place {
    pub name: &'static str,
    pub kind: JointKind,
    links: [&'static str; 2],
    pub at: Triple,
    pub along: Triple,
    /// Where the second link has the point, if that is elsewhere: such a joint is drawn open.
    second_at: Option<Triple>,
    pub lead: Option<Number>,
    /// Roll of the second link's frame, in a joint that closes a loop.
    second_roll: Option<Number>,
}

impl Place {
    pub fn new(
        name: &'static str,
        kind: JointKind,
        links: [&'static str; 2],
        at: Triple,
        along: Triple,
    ) -> Self {
        Self {
            name,
            kind,
            links,
            at,
            along,
            second_at: None,
            lead: None,
            second_roll: None,
        }
    }

    pub fn hinge(name: &'static str, links: [&'static str; 2], at: Triple, along: Triple) -> Self {
        Self::new(name, JointKind::Revolute, links, at, along)
    }

    pub fn second_at(mut self, point: Triple) -> Self {
        self.second_at = Some(point);
        self
    }

    /// Metres per turn.
    pub fn lead(mut self, lead: Number) -> Self {
        self.lead = Some(lead);
        self
    }

    pub fn second_roll(mut self, angle: Number) -> Self {
        self.second_roll = Some(angle);
        self
    }
}

/// A builder that holds joints and the links they join. The first joint's first link is the ground; a joint to a link not
/// met before carries that link, and one between two links met before closes a loop.
///
/// A link's frame is at the joint that carries it, or `away` metres from there: every link's in another direction.
pub fn drawn(name: &str, places: &[Place], away: &Number) -> MechanismBuilder {
    let mut builder = MechanismBuilder::new(name);
    let mut origins: BTreeMap<&str, Triple> = BTreeMap::new();
    let moved = |point: &Triple, index: usize| -> Triple {
        let sign = Number::integer(if index.is_multiple_of(2) { 1 } else { -1 });
        std::array::from_fn(|i| {
            if i == index % 3 {
                &point[i] + &(&sign * away)
            } else {
                point[i].clone()
            }
        })
    };
    for place in places {
        let [first, second] = place.links;
        if origins.is_empty() {
            builder.link(first);
            origins.insert(first, moved(&integers(0, 0, 0), 0));
        }
        let here = Frame::at(minus(&place.at, &origins[first]));
        let mut joint = match origins.get(second) {
            Some(origin) => {
                let there = place.second_at.as_ref().unwrap_or(&place.at);
                let mut frame = Frame::at(minus(there, origin));
                if let Some(roll) = &place.second_roll {
                    frame.roll_pitch_yaw[0] = roll.clone();
                }
                JointBuilder::closing(place.name, place.kind, first, second).successor_origin(frame)
            }
            None => {
                builder.link(second);
                let origin = moved(&place.at, origins.len());
                let frame = Frame::at(minus(&place.at, &origin));
                origins.insert(second, origin);
                JointBuilder::tree(place.name, place.kind, first, second).successor_origin(frame)
            }
        };
        joint = joint.origin(here);
        if place.kind.uses_axis() {
            joint = joint.axis(Direction(place.along.clone()));
        }
        if let Some(lead) = &place.lead {
            joint = joint.lead(lead.clone());
        }
        builder.joint(joint);
    }
    builder
}

/// The mechanism of joints whose links have their frames where they are carried.
pub fn built(name: &str, places: &[Place]) -> Mechanism {
    drawn(name, places, &Number::zero()).build().unwrap()
}

/// Four hinges along z: ground A D, crank A B, coupler B C, rocker D C.
pub fn four_bar([a, b, c, d]: [Triple; 4]) -> [Place; 4] {
    let up = || integers(0, 0, 1);
    [
        Place::hinge("A", ["ground", "crank"], a, up()),
        Place::hinge("B", ["crank", "coupler"], b, up()),
        Place::hinge("D", ["ground", "rocker"], d, up()),
        Place::hinge("C", ["coupler", "rocker"], c, up()),
    ]
}

/// A rectangular parallelogram: crank of 1 m upright, ground of the length given.
pub fn rectangle(ground: &Number) -> [Place; 4] {
    let zero = Number::zero;
    four_bar([
        integers(0, 0, 0),
        integers(0, 1, 0),
        [ground.clone(), Number::one(), zero()],
        [ground.clone(), zero(), zero()],
    ])
}

/// The hinges of a skew isogram: corners A, B and their images C, D under the half turn about z, each hinge across the two
/// sides that meet in it. `extra` is added to the direction of the hinge in A.
pub fn isogram(a: &Triple, b: &Triple, extra: &Triple) -> [Place; 4] {
    let turned = |[x, y, z]: &Triple| [-x, -y, z.clone()];
    let corners = [a.clone(), b.clone(), turned(a), turned(b)];
    let along = |i: usize| {
        let (here, next, before) = (&corners[i], &corners[(i + 1) % 4], &corners[(i + 3) % 4]);
        cross(&minus(next, here), &minus(before, here))
    };
    let [at_a, at_b, at_c, at_d] = corners.clone();
    [
        Place::hinge("a", ["side_da", "side_ab"], at_a, plus(&along(0), extra)),
        Place::hinge("b", ["side_ab", "side_bc"], at_b, along(1)),
        Place::hinge("d", ["side_da", "side_cd"], at_d, along(3)),
        Place::hinge("c", ["side_bc", "side_cd"], at_c, along(2)),
    ]
}

pub fn integers(x: i64, y: i64, z: i64) -> Triple {
    [x, y, z].map(Number::integer)
}

pub fn ratio(numerator: i64, denominator: i64) -> Number {
    Number::ratio(numerator, denominator).unwrap()
}

/// `10^exponent`, exactly.
pub fn power_of_ten(exponent: i32) -> Number {
    Number::integer(10).power(exponent).unwrap()
}

/// Cosine and sine of `2 atan(t)`.
pub fn circle_point(t: &Number) -> (Number, Number) {
    let square = t * t;
    let below = &Number::one() + &square;
    let cosine = (&Number::one() - &square).checked_div(&below).unwrap();
    let sine = (&Number::integer(2) * t).checked_div(&below).unwrap();
    (cosine, sine)
}

fn plus(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|i| &a[i] + &b[i])
}

fn minus(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|i| &a[i] - &b[i])
}

fn cross(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &(&a[j] * &b[k]) - &(&a[k] * &b[j])
    })
}
