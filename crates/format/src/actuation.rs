//! Which joints have a motor: `<transmission>`, `<ros2_control>` and `<mujoco><actuator>`.
//!
//! None of the three says how a joint can move, so nothing in them is an error; a motor on a joint that does not exist, or
//! that cannot move, is told as not read.
//!
//! - `<transmission>` (ROS wiki, urdf/XML/Transmission): `<joint name>`, of which there may be several; the older mechanism
//!   controllers of the PR2 also name `<rollJoint>`, `<flexJoint>` and the gripper's `<gap_joint>`. What they call
//!   `<passive_joint>` has no motor.
//! - `<ros2_control>` (ros2_control documentation, *Hardware components*): a `<joint name>` with a `<command_interface>`.
//!   A joint with state interfaces alone is only measured.
//! - `<mujoco><actuator>` (MuJoCo XML reference, *actuator*): any element with `joint` or `jointinparent`.

use super::element::Element;
use super::gazebo::IN_GAZEBO;
use super::kept::KeptMotors;
use super::reader::Reader;
use super::words::{cut, quoted};

/// Elements of a `<transmission>` that name a driven joint.
const DRIVEN: [&str; 6] = [
    "joint",
    "joint1",
    "joint2",
    "rollJoint",
    "flexJoint",
    "gap_joint",
];

/// The elements at the top of a file that may speak of motors.
pub(super) const ACTUATION: [&str; 3] = ["transmission", "ros2_control", "mujoco"];

/// A motor by the name of its joint.
pub(super) struct Motor<'a> {
    element: Element<'a>,
    joint: &'a str,
}

impl<'a> Reader<'a> {
    /// Notes the motors of an element; which joints there are is known only at the end.
    pub(super) fn read_actuation(&mut self, element: Element<'a>) {
        let known = self.motors.len();
        match element.name() {
            "transmission" => {
                for part in element.elements() {
                    if DRIVEN.contains(&part.name()) {
                        self.note_motor(part, "name");
                    }
                }
            }
            "ros2_control" => {
                for part in element.elements().filter(|part| part.name() == "joint") {
                    let commanded =
                        |inner: Element<'_>| inner.written_name() == "command_interface";
                    if part.elements().any(commanded) {
                        self.note_motor(part, "name");
                    }
                }
            }
            _ => {
                for part in element.elements() {
                    match part.name() {
                        "actuator" => {
                            for motor in part.elements() {
                                self.note_motor(motor, "joint");
                                self.note_motor(motor, "jointinparent");
                            }
                        }
                        // Told when all of it has been looked at.
                        "equality" => {}
                        _ => {
                            let name = cut(part.written_name());
                            self.skip_because(part, format!("<{name}> inside <mujoco>"));
                        }
                    }
                }
            }
        }
        if self.motors.len() == known && element.name() != "mujoco" {
            self.skip(element);
        }
        let named = self.motors[known..].iter();
        let joints = named.map(|motor| motor.joint.to_owned()).collect();
        let text = match element.name() {
            // The rest of it is not about motors, or has become loops.
            "mujoco" => {
                let actuators = element.elements().filter(|part| part.name() == "actuator");
                let inside: String = actuators.map(|part| part.written()).collect();
                format!("<mujoco>{inside}</mujoco>")
            }
            _ => element.written().to_owned(),
        };
        self.kept_motors.extend(KeptMotors::of(text, joints));
    }

    fn note_motor(&mut self, element: Element<'a>, attribute: &str) {
        if let Some(joint) = element.attribute(attribute) {
            self.motors.push(Motor {
                element,
                joint: joint.value,
            });
        }
    }

    /// Tells the builder of the motors whose joints can move.
    pub(super) fn resolve_motors(&mut self) {
        for motor in std::mem::take(&mut self.motors) {
            // The PR2's gripper motor moves a joint that stands inside `<gazebo>` under the name of a fixed one.
            let renamed = format!("{}{IN_GAZEBO}", motor.joint);
            let found = [renamed.as_str(), motor.joint]
                .into_iter()
                .find_map(|name| Some((name, *self.in_gazebo.get(name)?)))
                .or_else(|| Some((motor.joint, self.kinds.get(motor.joint)?.freedom())));
            match found {
                Some((_, 0)) => self.skip_motor(&motor, "cannot move"),
                Some((name, _)) => {
                    self.builder.actuate(name);
                }
                None => self.skip_motor(&motor, "does not exist"),
            }
        }
    }

    fn skip_motor(&mut self, motor: &Motor<'a>, why: &str) {
        let name = cut(motor.element.written_name());
        let joint = quoted(motor.joint);
        self.skip_because(motor.element, format!("<{name}>: the joint {joint} {why}"));
    }
}
