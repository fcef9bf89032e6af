//! Joints that stand in the tree and again inside `<gazebo>`, by one name and between the same links.
//!
//! They are one joint where they say the same, and are read once. Gazebo itself has no room for two joints of one name, so that where
//! they differ nobody knows which one is meant: a fault. Both are compared at the pose that the file draws, seen from the parent: axes
//! may be opposed, a hinge may stand anywhere along its axis, and a slider anywhere.

use super::element::Element;
use super::error::Fault;
use super::reader::Reader;
use super::words::quoted;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Joint, JointBuilder, JointKind, Side};
use std::ops::Range;

/// What is printed with six decimals, as most programs do, is the same to this many radians and metres.
const SIX_DECIMALS: f64 = 1e-6;

/// A joint inside `<gazebo>` that the tree has already.
pub(super) struct Restated<'a> {
    name: &'a str,
    /// What it is called while both are compared.
    other: String,
    place: Range<usize>,
    builder: JointBuilder,
}

impl<'a> Reader<'a> {
    /// Keeps a joint of the tree that stands inside `<gazebo>` too, until both can be compared.
    pub(super) fn restate(&mut self, element: Element<'a>, other: String, builder: JointBuilder) {
        let name = element.attribute("name").map_or("", |name| name.value);
        self.restated.push(Restated {
            name,
            other,
            place: element.range(),
            builder,
        });
    }

    /// A fault for each joint that is written twice and differently.
    pub(super) fn restated_otherwise(&self) -> Vec<Fault> {
        if self.restated.is_empty() {
            return Vec::new();
        }
        let mut both = self.builder.clone();
        for restated in &self.restated {
            both.joint(restated.builder.clone());
        }
        // What else is wrong is told when the mechanism itself is built.
        let Ok(mechanism) = both.build() else {
            return Vec::new();
        };
        let joint = |name: &str| mechanism.joint_named(name).map(|id| mechanism.joint(id));
        let differing = self.restated.iter().filter_map(|restated| {
            let (tree, other) = (joint(restated.name)?, joint(&restated.other)?);
            let what = difference(tree, other)?;
            let message = format!(
                "joint {} stands in the tree and inside <gazebo> with another {what}",
                quoted(restated.name)
            );
            Some(Fault::new(restated.place.clone(), message).help(
                "remove one of the two, or name the one inside <gazebo> otherwise if it closes a loop",
            ))
        });
        differing.collect()
    }
}

/// What two joints between the same links differ in.
fn difference(tree: &Joint, other: &Joint) -> Option<&'static str> {
    let turned_round = tree.predecessor.link != other.predecessor.link;
    let (first, second) = match turned_round {
        false => (&other.predecessor, &other.successor),
        true => (&other.successor, &other.predecessor),
    };
    let axis = turned(&tree.predecessor, &tree.axis);
    if tree.kind.uses_axis() && !parallel(axis, turned(first, &other.axis)) {
        return Some("axis");
    }
    let axis2 = turned(&tree.successor, &tree.axis2);
    if tree.kind.uses_second_axis() && !parallel(axis2, turned(second, &other.axis2)) {
        return Some("second axis");
    }
    let [a, b] =
        [&tree.predecessor, first].map(|side| side.frame.position.each_ref().map(Number::value));
    let between = [0, 1, 2].map(|k| a[k] - b[k]);
    let apart = match tree.kind {
        JointKind::Prismatic | JointKind::Fixed => 0.0,
        JointKind::Revolute | JointKind::Screw => norm(cross(between, axis)),
        _ => norm(between),
    };
    (apart > SIX_DECIMALS).then_some("place")
}

/// A direction of a joint's frame as a unit vector of the link.
fn turned(side: &Side, Direction(direction): &Direction) -> [f64; 3] {
    let [roll, pitch, yaw] = side.frame.roll_pitch_yaw.each_ref().map(Number::value);
    let [x, y, z] = direction.each_ref().map(Number::value);
    let about = |angle: f64, a: f64, b: f64| {
        let (sine, cosine) = angle.sin_cos();
        (cosine * a - sine * b, sine * a + cosine * b)
    };
    let (y, z) = about(roll, y, z);
    let (z, x) = about(pitch, z, x);
    let (x, y) = about(yaw, x, y);
    let size = norm([x, y, z]);
    [x / size, y / size, z / size]
}

fn parallel(a: [f64; 3], b: [f64; 3]) -> bool {
    norm(cross(a, b)) <= SIX_DECIMALS
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}
