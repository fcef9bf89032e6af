//! `<loop_joint>`, by which several tools close loops.
//!
//! - `<loop_joint name type><link1 link xyz rpy/><link2 link xyz rpy/></loop_joint>`: Isaac Sim's importer (`UrdfParser.cpp`), and Drake
//!   before 2016, which adds an `<axis>`. A frame on each side. Some writers call both sides `link1`, and some leave the type out where
//!   there is an axis.
//! - `<loop_joint name type><parent link/><parent_origin xyz/><child link/><child_origin xyz/><axis xyz frame="parent"/></loop_joint>`: an
//!   exporter of Fusion 360. It writes one point in both links, and the axis in the parent link, all at the pose that the file draws; how
//!   the joint's frame is turned in the child follows from that pose. Without `frame` both sides are frames, as those of a `<constraint>`.

use super::WarningKind;
use super::element::Element;
use super::error::{Fault, Outcome};
use super::names::Named;
use super::reader::Reader;
use super::unread::{OF_JOINTS, Parts};
use super::values::no_other_turn;
use super::words::quoted;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Frame, JointBuilder, JointKind, Mechanism};
use std::ops::Range;

/// What may stand inside `<loop_joint>`; what moves it is nothing else.
const LOOP_JOINT: Parts<'_> = Parts {
    known: &[
        "axis",
        "axis2",
        "limit",
        "dynamics",
        "parent",
        "child",
        "parent_origin",
        "child_origin",
    ],
    often: &["link1", "link2"],
    bearing: &BEARING,
};

const BEARING: [&str; 15] = [
    "parent",
    "child",
    "parent_origin",
    "child_origin",
    "predecessor",
    "successor",
    "origin",
    "axis",
    "axis2",
    "screw",
    "distance",
    "limit",
    "mimic",
    "joint",
    "loop",
];

/// What may stand inside a side of it: nothing, since its attributes say all.
const SIDE: Parts<'_> = Parts {
    known: &[],
    often: &[],
    bearing: &OF_JOINTS,
};

/// One point written in both links: the same to this part of its distance, as rounding cannot move it farther in a file of two digits.
const SAME_POINT: f64 = 0.01;

/// A point that is written in a joint's successor too, where it follows from the pose that the file draws.
pub(super) struct SecondPoint<'a> {
    joint: &'a str,
    point: [Number; 3],
    place: Range<usize>,
}

/// The links and frames of both sides.
type Sides<'a> = [(&'a str, Frame); 2];

impl<'a> Reader<'a> {
    pub(super) fn read_loop_joint(&mut self, joint: Element<'a>) -> Outcome<()> {
        let name = self.directory.add(Named::Joint, joint)?;
        let kind = self.loop_joint_kind(joint, name)?;
        let parts = self.parts_of(joint, &LOOP_JOINT)?;
        let part = |name: &str| parts.iter().copied().find(|part| part.name() == name);
        let sides = match (part("parent"), part("child")) {
            (None, None) => self.numbered_sides(joint, &parts)?,
            (Some(parent), Some(child)) if part("link1").or(part("link2")).is_none() => [
                self.named_side(parent, part("parent_origin"))?,
                self.named_side(child, part("child_origin"))?,
            ],
            _ => return Err(needs_sides(joint, name)),
        };
        let [(first, first_frame), (second, second_frame)] = sides;
        self.join(name, [first, second]);
        let point = second_frame.position.clone();
        let turned = [&first_frame, &second_frame].map(is_turned);
        let mut builder = JointBuilder::closing(name, kind, first, second)
            .origin(first_frame.clone())
            .successor_origin(second_frame);
        let (mut axis, mut axis2) = (None, None);
        for part in &parts {
            match part.name() {
                "axis" if kind.uses_axis() => axis = Some(self.loop_axis(*part)?),
                "axis2" if kind.uses_second_axis() => axis2 = Some(self.direction(*part)?),
                "limit" | "dynamics" | "axis" | "axis2" => self.skip(*part),
                _ => {}
            }
        }
        self.note_axes((joint.start(), name), kind, [axis.as_ref(), axis2.as_ref()])
            .map_err(|why| joint.fault(format!("loop {}: {why}", quoted(name))))?;
        builder = axis.into_iter().fold(builder, JointBuilder::axis);
        builder = axis2.into_iter().fold(builder, JointBuilder::axis2);
        if let Some(frame) = part("axis").and_then(|axis| axis.attribute("frame")) {
            if frame.value != "parent" || turned != [false; 2] || kind.uses_second_axis() {
                return Err(frame
                    .fault("of an axis in another frame than the joint's, one in the parent is read, and with origins that are not turned")
                    .help("write it as a <loop>"));
            }
            builder = builder.at_home(first, first_frame, false);
            self.second_points
                .extend(part("child_origin").map(|origin| SecondPoint {
                    joint: name,
                    point,
                    place: origin.range(),
                }));
        }
        self.add_closing(name, kind, builder);
        Ok(())
    }

    /// The kind that the file names; a revolute joint where it names none and gives an axis.
    fn loop_joint_kind(&mut self, joint: Element<'a>, name: &str) -> Outcome<JointKind> {
        if joint.attribute("type").is_some() {
            return self.closing_kind(joint);
        }
        if !joint.elements().any(|part| part.name() == "axis") {
            return joint
                .required("type")
                .map(|_| JointKind::Revolute)
                .map_err(|fault| {
                    fault.help(
                        "type=\"revolute\" with an <axis xyz=\"...\"/>, or type=\"spherical\"",
                    )
                });
        }
        let message = format!(
            "loop {} has an <axis> and no type: it is read as revolute",
            quoted(name)
        );
        self.warn_of(joint.start(), WarningKind::Guessed, message);
        Ok(JointKind::Revolute)
    }

    fn numbered_sides(&mut self, joint: Element<'a>, parts: &[Element<'a>]) -> Outcome<Sides<'a>> {
        let sides: Vec<Element<'a>> = parts
            .iter()
            .copied()
            .filter(|part| matches!(part.name(), "link1" | "link2"))
            .collect();
        match sides.as_slice() {
            [first, second] => Ok([self.loop_side(*first)?, self.loop_side(*second)?]),
            _ => Err(needs_sides(joint, joint.required("name")?.value)),
        }
    }

    fn loop_side(&mut self, side: Element<'a>) -> Outcome<(&'a str, Frame)> {
        no_other_turn(side)?;
        self.attributes_of(side, &["link", "xyz", "rpy", "quat_xyzw"], true)?;
        self.parts_of(side, &SIDE)?;
        let link = self.directory.refer(Named::Link, side, "link")?;
        if let Some(rpy) = side.attribute("rpy") {
            self.note_angles(rpy);
        }
        Ok((link, self.frame_of(side)?))
    }

    fn named_side(
        &mut self,
        side: Element<'a>,
        origin: Option<Element<'a>>,
    ) -> Outcome<(&'a str, Frame)> {
        self.leaf_of(side, &["link"], true)?;
        let link = self.directory.refer(Named::Link, side, "link")?;
        let frame = match origin {
            Some(origin) => self.joint_origin(origin)?,
            None => Frame::identity(),
        };
        Ok((link, frame))
    }

    /// `<axis xyz frame/>`.
    fn loop_axis(&mut self, axis: Element<'a>) -> Outcome<Direction> {
        self.leaf_of(axis, &["xyz", "frame"], true)?;
        self.direction_of(axis)
    }

    /// A fault for each joint whose two points are not one at the pose that the file draws.
    pub(super) fn points_apart(&self, mechanism: &Mechanism) -> Vec<Fault> {
        let apart = self.second_points.iter().filter(|second| {
            let Some(joint) = mechanism.joint_named(second.joint) else {
                return false;
            };
            let found = &mechanism.joint(joint).successor.frame.position;
            let size = |point: &[Number; 3]| norm(point.each_ref().map(Number::value));
            let between = [0, 1, 2].map(|k| found[k].value() - second.point[k].value());
            norm(between) > SAME_POINT * size(found).max(size(&second.point))
        });
        apart
            .map(|second| {
                let message = format!(
                    "the two points of loop {} are apart at the pose that the file draws",
                    quoted(second.joint)
                );
                Fault::new(second.place.clone(), message)
                    .help("write it as a <loop> with a frame on each side")
            })
            .collect()
    }
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}

fn is_turned(frame: &Frame) -> bool {
    !frame.roll_pitch_yaw.iter().all(Number::is_zero)
}

fn needs_sides(joint: Element<'_>, name: &str) -> Fault {
    joint
        .fault(format!("loop {} needs two sides", quoted(name)))
        .help("<link1 link xyz rpy/> and <link2 link xyz rpy/>, or <parent link/>, <parent_origin/>, <child link/> and <child_origin/>")
}
