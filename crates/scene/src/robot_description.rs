//! A mechanism as URDF with primitive shapes, for viewers that read `/robot_description`.
//!
//! URDF can say a tree only: loops are named in a comment, and what plain URDF has no joint type for is `floating`, which
//! leaves its pose to `/tf`. Links bear the names of their frames in the log.

use super::names::{Stream, frame_id, readable};
use super::shapes::{Drawing, Primitive, Shape};
use super::vectors::roll_pitch_yaw;
use kutzbach_closure::{Geometry, Rigid};
use kutzbach_model::mechanism::{JointKind, LinkId, Mechanism, Placement};
use std::fmt::Write;

/// Range of a slider whose file states none, in units of the mechanism's extent: URDF demands one.
const UNLIMITED: f64 = 1e3;

/// Writes the URDF of one stream. Cost: linear in links and shapes.
#[must_use]
pub fn robot_description(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    drawing: &Drawing,
    stream: Stream,
) -> String {
    let mut text = String::from("<?xml version=\"1.0\"?>\n");
    let name = format!("{} ({})", readable(mechanism.name()), stream.word());
    line(
        &mut text,
        0,
        &format!("<robot name=\"{}\">", escaped(&name)),
    );
    for joint in mechanism.joints().iter().filter(|joint| joint.closes_loop) {
        let comment = format!(
            "closes a loop, which URDF cannot say: {} ({}) between {} and {}",
            joint.name,
            joint.kind.word(),
            mechanism.link(joint.predecessor.link).name,
            mechanism.link(joint.successor.link).name
        );
        // Two hyphens would end the comment.
        let comment = escaped(&readable(&comment)).replace('-', "\u{2010}");
        line(&mut text, 1, &format!("<!-- {comment} -->"));
    }
    line(&mut text, 1, &format!("<link name=\"{}\"/>", stream.word()));
    let mut by_link: Vec<Vec<&Shape>> = vec![Vec::new(); mechanism.links().len()];
    for shape in &drawing.shapes {
        by_link[shape.link].push(shape);
    }
    for (link, shapes) in mechanism.links().iter().zip(by_link) {
        let id = escaped(&frame_id(stream, &link.name));
        line(&mut text, 1, &format!("<link name=\"{id}\">"));
        for shape in shapes {
            visual(&mut text, shape);
        }
        line(&mut text, 1, "</link>");
    }
    for &link in mechanism.placement_order() {
        joint(&mut text, mechanism, geometry, drawing, stream, link);
    }
    line(&mut text, 0, "</robot>");
    text
}

fn line(text: &mut String, depth: usize, line: &str) {
    text.extend(std::iter::repeat_n("  ", depth));
    text.push_str(line);
    text.push('\n');
}

fn visual(text: &mut String, shape: &Shape) {
    let mut pose = shape.pose.clone();
    let solid = match shape.primitive {
        Primitive::Box { size } => format!("<box size=\"{}\"/>", numbers(size)),
        Primitive::Sphere { radius } => format!("<sphere radius=\"{radius}\"/>"),
        Primitive::Cylinder { radius, length } => {
            format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>")
        }
        Primitive::Arrow { radius, length } => {
            // Without a head, and from its own origin on.
            pose = pose.compose(&Rigid::translation([0.0, 0.0, 0.5 * length]));
            format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>")
        }
    };
    let c = shape.colour;
    let rgba = format!("{} {} {} {}", c.red, c.green, c.blue, c.opacity);
    // One material per colour.
    let material =
        [c.red, c.green, c.blue, c.opacity].map(|x| format!("{:02x}", (x * 255.0) as u8));
    line(text, 2, "<visual>");
    line(text, 3, &origin(&pose));
    line(text, 3, &format!("<geometry>{solid}</geometry>"));
    line(
        text,
        3,
        &format!(
            "<material name=\"{}\"><color rgba=\"{rgba}\"/></material>",
            material.concat()
        ),
    );
    line(text, 2, "</visual>");
}

/// The joint that holds a link in the tree.
fn joint(
    text: &mut String,
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    drawing: &Drawing,
    stream: Stream,
    link: LinkId,
) {
    let child = frame_id(stream, &mechanism.link(link).name);
    let parent_frame = |parent: LinkId| frame_id(stream, &mechanism.link(parent).name);
    let relative = |parent: LinkId| {
        geometry.home[parent.0]
            .inverse()
            .compose(&geometry.home[link.0])
    };
    let (name, word, parent, pose, rest) = match &mechanism.link(link).placement {
        Placement::World => (
            stream.word().to_owned(),
            "fixed",
            stream.word().to_owned(),
            geometry.home[link.0].clone(),
            String::new(),
        ),
        Placement::Floating { name, parent, .. } => (
            readable(name).into_owned(),
            "floating",
            parent_frame(*parent),
            relative(*parent),
            String::new(),
        ),
        Placement::Joint(id) => {
            let joint = mechanism.joint(*id);
            let parent = joint.predecessor.link;
            let sides = &geometry.sides[id.0];
            let name = readable(&joint.name).into_owned();
            // URDF has the child's own frame in the joint.
            let plain = joint.successor.frame.position.iter().all(|x| x.is_zero())
                && joint
                    .successor
                    .frame
                    .roll_pitch_yaw
                    .iter()
                    .all(|x| x.is_zero());
            let word = plain_type(joint.kind, has_range(joint)).filter(|_| plain);
            match word {
                Some(word) => {
                    let axis = numbers(*geometry.displacements[id.0].axis());
                    let mut rest = String::new();
                    if word != "fixed" {
                        let _ = write!(rest, "<axis xyz=\"{axis}\"/>");
                    }
                    if matches!(word, "revolute" | "prismatic") {
                        let far = UNLIMITED * drawing.extent;
                        let limit = joint.limit.as_ref();
                        let value = |number: Option<&kutzbach_math::number::Number>, other: f64| {
                            number.map_or(other, kutzbach_math::number::Number::value)
                        };
                        let _ = write!(
                            rest,
                            "<limit lower=\"{}\" upper=\"{}\" effort=\"{}\" velocity=\"{}\"/>",
                            value(limit.and_then(|l| l.lower.as_ref()), -far),
                            value(limit.and_then(|l| l.upper.as_ref()), far),
                            value(limit.and_then(|l| l.effort.as_ref()), 0.0),
                            value(limit.and_then(|l| l.velocity.as_ref()), 0.0),
                        );
                    }
                    (name, word, parent_frame(parent), sides[0].clone(), rest)
                }
                None => (
                    name,
                    "floating",
                    parent_frame(parent),
                    relative(parent),
                    String::new(),
                ),
            }
        }
    };
    line(
        text,
        1,
        &format!("<joint name=\"{}\" type=\"{word}\">", escaped(&name)),
    );
    line(text, 2, &origin(&pose));
    line(text, 2, &format!("<parent link=\"{}\"/>", escaped(&parent)));
    line(text, 2, &format!("<child link=\"{}\"/>", escaped(&child)));
    if !rest.is_empty() {
        line(text, 2, &rest);
    }
    line(text, 1, "</joint>");
}

fn has_range(joint: &kutzbach_model::mechanism::Joint) -> bool {
    let limit = joint.limit.as_ref();
    limit.is_some_and(|limit| limit.lower.is_some() && limit.upper.is_some())
}

/// URDF's own word for a kind, if it has one.
fn plain_type(kind: JointKind, has_range: bool) -> Option<&'static str> {
    match kind {
        JointKind::Fixed => Some("fixed"),
        JointKind::Revolute if has_range => Some("revolute"),
        JointKind::Revolute => Some("continuous"),
        JointKind::Prismatic => Some("prismatic"),
        _ => None,
    }
}

fn origin(pose: &Rigid<f64>) -> String {
    let xyz = numbers(pose.translation);
    let rpy = numbers(roll_pitch_yaw(&pose.rotation));
    format!("<origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>")
}

fn numbers(values: [f64; 3]) -> String {
    let [x, y, z] = values.map(|x| x + 0.0);
    format!("{x} {y} {z}")
}

fn escaped(value: &str) -> String {
    let mut text = String::with_capacity(value.len());
    for character in value.chars() {
        match character {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            other => text.push(other),
        }
    }
    text
}

/// A `std_msgs/msg/String` in CDR, little endian: encapsulation header, length with the closing zero, bytes, zero.
///
/// `None` for four gibibytes and more.
#[must_use]
pub fn cdr_string(text: &str) -> Option<Vec<u8>> {
    let length = u32::try_from(text.len()).ok()?.checked_add(1)?;
    let mut bytes = Vec::with_capacity(text.len() + 9);
    bytes.extend([0, 1, 0, 0]);
    bytes.extend(length.to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes.push(0);
    Some(bytes)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn strings_in_cdr() {
        assert_eq!(
            cdr_string("ab").unwrap(),
            [0, 1, 0, 0, 3, 0, 0, 0, b'a', b'b', 0]
        );
    }
}
