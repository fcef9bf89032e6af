//! `<mujoco>` inside URDF: the equality that closes a loop by a ball, and the one that holds a joint.
//!
//! MuJoCo itself reads only its compiler's settings there; what exporters write besides says what they mean.
//!
//! `<equality><connect body1 body2 anchor/></equality>` (MuJoCo XML reference, *equality/connect*): a point, given in the first body,
//! is held to where it is in the second one at the pose that the file draws; without a second body to where it is in the world, which
//! is the root link here. So the loop is closed at home by construction.
//!
//! `<equality><joint joint1 polycoef/></equality>` (*equality/joint*) without a second joint holds the first one at a constant, the first
//! coefficient, from the pose that the file draws: it is read as fixed there.

use super::WarningKind;
use super::element::Element;
use super::error::{Fault, Outcome};
use super::gazebo::ordered;
use super::names::Named;
use super::reader::{Dialect, Reader};
use super::words::{cut, quoted};
use super::world::WORLD;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Frame, JointBuilder, JointKind};
use std::collections::HashMap;

/// The equalities of all `<mujoco>` of a file.
fn equalities<'a>(root: Element<'a>) -> impl Iterator<Item = Element<'a>> {
    let inside = |name: &'static str| {
        move |e: Element<'a>| e.elements().filter(move |part| part.name() == name)
    };
    let robots = inside("mujoco")(root);
    robots
        .flat_map(inside("equality"))
        .flat_map(|equality| equality.elements())
}

fn is_active(equality: Element<'_>) -> bool {
    let active = equality.attribute("active");
    active.is_none_or(|word| word.value != "false")
}

/// The joint's frame in its child when the joint, whose axis is one of the frame's, stands at a value: turned or shifted back by it.
fn turned_back(kind: JointKind, axis: &Direction, value: &Number) -> Option<Frame> {
    let along: Vec<usize> = (0..3).filter(|&i| !axis.0[i].is_zero()).collect();
    let [along] = along[..] else {
        return None;
    };
    let back = match axis.0[along].value() > 0.0 {
        true => -value.clone(),
        false => value.clone(),
    };
    let mut frame = Frame::identity();
    match kind {
        JointKind::Revolute => frame.roll_pitch_yaw[along] = back,
        _ => frame.position[along] = back,
    }
    Some(frame)
}

impl<'a> Reader<'a> {
    /// Keeps the loops of a `<mujoco>` until all links are known.
    pub(super) fn read_mujoco(&mut self, mujoco: Element<'a>) {
        let equalities = mujoco.elements().filter(|part| part.name() == "equality");
        for part in equalities.flat_map(|equality| equality.elements()) {
            let has = |name: &str| part.attribute(name).is_some();
            if part.name() != "connect" || !has("body1") || !has("anchor") {
                continue;
            }
            self.taken.insert(part.start());
            if part
                .attribute("active")
                .is_some_and(|word| word.value == "false")
            {
                self.skip_because(part, "<connect> that is not active".to_owned());
            } else {
                self.connects.push(part);
            }
        }
    }

    /// The joints that equalities hold, and the elements that say so.
    pub(super) fn held_joints(root: Element<'a>) -> HashMap<&'a str, Element<'a>> {
        let mut held = HashMap::new();
        for part in equalities(root) {
            let held_one = part.attribute("joint1").filter(|_| part.name() == "joint");
            if let Some(joint) = held_one.filter(|_| part.attribute("joint2").is_none())
                && is_active(part)
            {
                held.insert(joint.value, part);
            }
        }
        held
    }

    /// The frame in the child of a joint that is held, for a fixed joint in its place; `None` where it is not held, or at a place that no
    /// such frame says exactly.
    pub(super) fn held_frame(
        &mut self,
        name: &'a str,
        kind: JointKind,
        own: &Frame,
        body: &[Element<'a>],
    ) -> Outcome<Option<Frame>> {
        let Some(&element) = self.held.get(name) else {
            return Ok(None);
        };
        let moves = matches!(kind, JointKind::Revolute | JointKind::Prismatic);
        if !moves || body.iter().any(|part| part.name() == "mimic") {
            return Ok(None);
        }
        let value = match element.attribute("polycoef") {
            Some(terms) => self.number_list(terms)?.swap_remove(0),
            None => Number::zero(),
        };
        let axis = body.iter().find(|part| part.name() == "axis");
        let axis = match axis {
            Some(axis) => self.direction_of(*axis)?,
            None => Direction::x(),
        };
        let frame = match (value.is_zero(), own.is_identity()) {
            (true, _) => Some(own.clone()),
            (false, true) => turned_back(kind, &axis, &value),
            (false, false) => None,
        };
        if frame.is_some() {
            self.taken.insert(element.start());
            let message = format!(
                "joint {} is held at {} by <equality>: it is read as fixed",
                quoted(name),
                value.value()
            );
            let kind = WarningKind::ReadAs {
                joint: name.to_owned(),
                element: "joint".to_owned(),
            };
            self.warn_of(element.start(), kind, message);
            self.uses(Dialect::Own);
        }
        Ok(frame)
    }

    /// Tells of equalities that were not read, before everything else: each of them constrains.
    pub(super) fn note_equalities(&mut self) {
        for element in self.root.elements().filter(|e| e.name() == "mujoco") {
            for equality in element.elements().filter(|e| e.name() == "equality") {
                self.taken.insert(equality.start());
                for part in equality.elements() {
                    if !self.taken.insert(part.start()) {
                        continue;
                    }
                    let name = cut(part.written_name());
                    if !is_active(part) {
                        self.skip_because(part, format!("<{name}> that is not active"));
                        continue;
                    }
                    let message = format!(
                        "<{name}> inside <equality> is not read: it constrains the motion, and the answer is not about that"
                    );
                    self.warn_of(part.start(), WarningKind::MayJoin, message);
                }
            }
        }
    }

    /// Reads the loops that had to wait.
    pub(super) fn read_connects(&mut self) -> Vec<Fault> {
        let connects = std::mem::take(&mut self.connects);
        connects
            .into_iter()
            .filter_map(|connect| self.read_connect(connect).err())
            .collect()
    }

    fn read_connect(&mut self, connect: Element<'a>) -> Outcome<()> {
        let anchor = self.numbers(connect.required("anchor")?)?;
        let first = self.directory.refer(Named::Link, connect, "body1")?;
        let in_world = match connect.attribute("body2") {
            None => true,
            Some(body) => body.value == WORLD && !self.directory.has(Named::Link, WORLD),
        };
        let second = match self.tree_root.filter(|_| in_world) {
            Some(root) => root,
            None => self.directory.refer(Named::Link, connect, "body2")?,
        };
        let given = connect.attribute("name").map(|name| name.value);
        let name = match given.filter(|name| !self.directory.has_joint_or_coupling(name)) {
            Some(_) => self.directory.add(Named::Joint, connect)?.to_owned(),
            None => self.name_unnamed("connect"),
        };
        self.joined
            .entry(ordered([first, second]))
            .or_insert("connect");
        self.uses(Dialect::Own);
        self.other_closures = true;
        self.builder.joint(
            JointBuilder::closing(&name, JointKind::Spherical, first, second).at_home(
                first,
                Frame::at(anchor),
                false,
            ),
        );
        Ok(())
    }
}
