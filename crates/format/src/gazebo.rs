//! Joints inside `<gazebo>`: what URDF's tree has no room for, written in SDFormat.
//!
//! Gazebo turns URDF into SDFormat and copies what stands inside `<gazebo>` into it, so that a `<joint>` there becomes a
//! joint of the model like any other. It is the usual way to close a loop in plain URDF (gazebo_tutorials,
//! `kinematic_loop`). SDFormat's specification (sdformat.org/spec, `<joint>`) says of it:
//!
//! - `<pose>` is the joint's frame in the child link, unless `relative_to` names another frame; the parent's side follows
//!   from where the links are in the file. So the joint is closed at home by construction.
//! - `<axis><xyz>` is given in the joint's frame, unless `expressed_in` names another one, or `use_parent_model_frame`
//!   (how versions up to 1.4 always meant it) says that it is the model's. The model's frame is the root link's at home.
//! - `<screw_thread_pitch>` is in metres per revolution, right-handed; the older `<thread_pitch>` in radians per metre,
//!   left-handed. Where both stand the first counts, where none does it is one metre, right-handed, as libsdformat has it.
//! - `revolute2` turns about `<axis>` in the parent and then about `<axis2>` in the child, through one point: a universal
//!   joint whose axes need not be at right angles.
//! - A `<link>` stands where its `<pose>` in the model's frame says.
//! - `world` as parent or child is the ground.
//!
//! Gazebo before SDFormat wrote `<joint:hinge>` and its kin with `<body1>`, `<body2>`, an `<anchor>` body, an
//! `<anchorOffset>` in it, and an `<axis>` in the model's frame. The PR2's gripper is published like that.
//!
//! The plugin `DetachableJoint` holds two links as they are drawn (`detachable`).

use super::WarningKind;
use super::assumed::{ONE_AXIS, are_parallel};
use super::axis_limits::of_axis;
use super::detachable::is_detachable;
use super::element::{Attribute, Element};
use super::error::Outcome;
use super::frames::radians_of;
use super::names::Named;
use super::reader::{Dialect, Reader};
use super::unread::{Parts, truth};
use super::words::{cut, quoted};
use super::world::WORLD;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Dynamics, Frame, JointBuilder, JointKind, Limit};

/// SDFormat's word for the frame of the model, which is that of the root link.
pub(super) const MODEL: &str = "__model__";

/// Added to a name that a joint of the tree has already.
pub(super) const IN_GAZEBO: &str = "_in_gazebo";

/// What may stand inside a `<joint>` of SDFormat.
const SDF_JOINT: Parts<'_> = Parts {
    known: &[
        "parent",
        "child",
        "pose",
        "axis",
        "axis2",
        "screw_thread_pitch",
        "thread_pitch",
        "physics",
        "sensor",
        "gearbox_ratio",
        "gearbox_reference_body",
    ],
    often: &[],
    bearing: &[
        "parent",
        "child",
        "pose",
        "axis",
        "axis2",
        "screw_thread_pitch",
        "thread_pitch",
        "origin",
        "mimic",
        "screw",
        "predecessor",
        "successor",
    ],
};

/// What may stand inside an `<axis>` of SDFormat.
const SDF_AXIS: Parts<'_> = Parts {
    known: &[
        "xyz",
        "use_parent_model_frame",
        "mimic",
        "limit",
        "dynamics",
        "initial_position",
    ],
    often: &[],
    bearing: &["xyz", "use_parent_model_frame", "mimic", "origin", "axis"],
};

/// What may stand inside a `<mimic>` of SDFormat.
const SDF_MIMIC: Parts<'_> = Parts {
    known: &["multiplier", "offset", "reference"],
    often: &[],
    bearing: &["multiplier", "offset", "reference"],
};

/// Where a joint is, as SDFormat gives it.
pub(super) struct Place<'a> {
    pub(super) link: &'a str,
    pub(super) frame: Frame,
    parallel_to_root: bool,
}

/// What a joint inside `<gazebo>` is called.
struct Late {
    name: String,
    /// Whether the tree has it already.
    restates: bool,
}

impl<'a> Reader<'a> {
    /// Keeps the joints of a `<gazebo>` until all links are known; the rest of it is not read.
    pub(super) fn read_gazebo(&mut self, gazebo: Element<'a>) -> Outcome<()> {
        let mut only_joints = true;
        for part in gazebo.elements() {
            let old_joint = part.written_name().starts_with("joint:");
            let sdf_joint = part.written_name() == "joint" && part.elements().next().is_some();
            if old_joint || sdf_joint || is_detachable(part) {
                self.late.push(part);
                continue;
            }
            if part.written_name() == "link" && part.attribute("name").is_some() {
                self.read_sdf_link(part)?;
                continue;
            }
            only_joints = false;
            self.check_for_joints(part)?;
        }
        if !only_joints || gazebo.elements().next().is_none() {
            self.skip(gazebo);
        }
        Ok(())
    }

    /// Reads the joints that had to wait.
    pub(super) fn read_late_joints(&mut self) -> Vec<super::error::Fault> {
        let mut faults = Vec::new();
        self.tree_root = self.root_link();
        faults.extend(self.place_sdf_links().err());
        for joint in std::mem::take(&mut self.late) {
            let read = match joint.written_name() {
                "joint" => self.read_sdf_joint(joint),
                "plugin" => self.read_detachable(joint),
                _ => self.read_old_joint(joint),
            };
            faults.extend(read.err());
        }
        faults
    }

    fn read_sdf_joint(&mut self, joint: Element<'a>) -> Outcome<()> {
        let word = joint.required("type")?;
        let Some(kind) = kind_of(word.value) else {
            return Err(word
                .fault(format!("a joint of the type {} inside <gazebo> is not read", quoted(word.value)))
                .help("revolute, continuous, prismatic, screw, ball, universal, revolute2 and fixed are; a <loop> or <coupling> may say the same"));
        };
        let mut place = None;
        let (mut parent, mut child) = (None, None);
        let (mut axis, mut axis2) = (None, None);
        let (mut lead, mut old_lead) = (None, None);
        for part in self.parts_of(joint, &SDF_JOINT)? {
            match part.name() {
                "parent" => parent = Some(self.sdf_link(part)?),
                "child" => child = Some(self.sdf_link(part)?),
                "pose" => place = Some(part),
                "axis" => axis = Some(part),
                "axis2" => axis2 = Some(part),
                "screw_thread_pitch" => lead = Some(self.number(needed(part)?)?),
                "thread_pitch" => old_lead = Some(self.lead_of_thread(part)?),
                _ => self.skip(part),
            }
        }
        let needs = |what: &str| joint.fault(format!("a joint inside <gazebo> needs <{what}>"));
        let parent = parent.ok_or_else(|| needs("parent"))?;
        let child = child.ok_or_else(|| needs("child"))?;
        let Some(late) = self.name_of_late(joint, kind, [parent, child])? else {
            return Ok(());
        };
        // One that the tree has already may leave its axes to that.
        let says_all = axis.is_some() || !kind.uses_axis();
        if late.restates && !says_all {
            return Ok(());
        }
        if self.is_world(child) {
            let (kind, message) = world_is_child(joint);
            self.warn_of(joint.start(), kind, message);
        }
        let name = late.name.clone();
        let mut place = self.sdf_place(place, child)?;
        let mut builder = JointBuilder::closing(&name, kind, parent, child);
        let mut first = None;
        if kind.uses_axis() {
            let (direction, in_model) = self.sdf_axis(axis.ok_or_else(|| needs("axis"))?)?;
            builder = builder.axis(direction.clone());
            first = Some(direction);
            place.parallel_to_root = in_model;
            let (limit, dynamics) = self.sdf_limits(axis, word.value)?;
            if kind.freedom() == 1 && limit != Limit::default() {
                builder = builder.limit(limit);
            }
            if dynamics != Dynamics::default() {
                builder = builder.dynamics(dynamics);
            }
            self.read_sdf_mimic(&late, kind, axis)?;
        }
        if kind.uses_second_axis() {
            let part = axis2.ok_or_else(|| needs("axis2"))?;
            let (direction, in_model) = self.sdf_axis(part)?;
            if in_model != place.parallel_to_root {
                return Err(part.fault("both axes of a joint must be given in the same frame"));
            }
            if first.is_some_and(|first| are_parallel(&first, &direction)) {
                return Err(part.fault(format!("joint {}: {ONE_AXIS}", quoted(&name))));
            }
            builder = builder.axis2(direction);
        }
        if kind.uses_lead() {
            let lead = lead.or(old_lead).unwrap_or_else(|| {
                self.warn_of(joint.start(), WarningKind::Guessed, NO_PITCH);
                Number::one()
            });
            builder = builder.lead(lead);
        }
        self.add_late(late, joint, kind, builder, &place);
        Ok(())
    }

    /// `<joint:hinge name>` and its kin.
    fn read_old_joint(&mut self, joint: Element<'a>) -> Outcome<()> {
        let kind = match joint.name() {
            "hinge" => JointKind::Revolute,
            "slider" => JointKind::Prismatic,
            "ball" => JointKind::Spherical,
            _ => {
                let name = cut(joint.written_name());
                return Err(joint
                    .fault(format!("<{name}> is not read, and it joins two links"))
                    .help("<joint:hinge>, <joint:slider> and <joint:ball> are; a <loop> may say the same"));
            }
        };
        let part = |name: &str| {
            let found = joint.elements().find(|part| part.name() == name);
            found.ok_or_else(|| joint.fault(format!("<{}> needs <{name}>", joint.written_name())))
        };
        let parent = self.sdf_link(part("body1")?)?;
        let child = self.sdf_link(part("body2")?)?;
        let Some(late) = self.name_of_late(joint, kind, [parent, child])? else {
            return Ok(());
        };
        let mut frame = Frame::identity();
        if let Ok(offset) = part("anchorOffset") {
            frame.position = self.numbers(needed(offset)?)?;
        }
        let place = Place {
            link: self.sdf_link(part("anchor")?)?,
            frame,
            parallel_to_root: true,
        };
        let mut builder = JointBuilder::closing(&late.name, kind, parent, child);
        if kind.uses_axis() {
            builder = builder.axis(self.sdf_direction(part("axis")?)?);
        }
        self.add_late(late, joint, kind, builder, &place);
        Ok(())
    }

    /// The name of a joint that had to wait; `None` where it only holds the robot's root, which is held anyway.
    fn name_of_late(
        &mut self,
        joint: Element<'a>,
        kind: JointKind,
        sides: [&'a str; 2],
    ) -> Outcome<Option<Late>> {
        let new = |name: String| Late {
            name,
            restates: false,
        };
        let name = joint.required("name")?.value;
        let [parent, child] = sides;
        if let Some(known) = self.sides_of.get(name)
            && ordered(*known) == ordered(sides)
        {
            if let Some(other) = self.kinds.get(name)
                && *other != kind
            {
                return Err(joint.fault(format!(
                    "joint {} is {} in the tree and {} inside <gazebo>",
                    quoted(name),
                    other.word(),
                    kind.word()
                )));
            }
            let message = format!(
                "joint {} stands in the tree and inside <gazebo>; it is read once",
                quoted(name)
            );
            let again = WarningKind::SaidTwice {
                joint: name.to_owned(),
            };
            self.warn_of(joint.start(), again, message);
            return Ok(Some(Late {
                name: format!("{name}{IN_GAZEBO}"),
                restates: true,
            }));
        }
        if kind == JointKind::Fixed && self.is_world(parent) && self.tree_root == Some(child) {
            self.root_is_held = true;
            let message = format!(
                "joint {} holds the root link in the world, as is done here anyway",
                quoted(name)
            );
            let again = WarningKind::SaidTwice {
                joint: name.to_owned(),
            };
            self.warn_of(joint.start(), again, message);
            return Ok(None);
        }
        if let Some(other) = self.joined.get(&ordered(sides)).copied() {
            let message = format!(
                "joint {} inside <gazebo> joins the same two links as joint {}",
                quoted(name),
                quoted(other)
            );
            let same = WarningKind::SameLinks {
                joint: name.to_owned(),
                other: other.to_owned(),
            };
            self.warn_of(joint.start(), same, message);
        }
        self.joined.entry(ordered(sides)).or_insert(name);
        self.joins_world |= self.is_world(parent) || self.is_world(child);
        if !self.directory.has_joint_or_coupling(name) {
            let name = self.directory.add(Named::Joint, joint)?;
            return Ok(Some(new(name.to_owned())));
        }
        let other = format!("{name}{IN_GAZEBO}");
        if self.directory.has_joint_or_coupling(&other) || self.in_gazebo.contains_key(&other) {
            return self.directory.add(Named::Joint, joint).map(|_| None);
        }
        // A name stands for one coordinate. The PR2's `gripper_joint` measures the gap of the gripper to a frame without
        // mass in the tree, and to the finger itself inside `<gazebo>`.
        let one_value = kind.freedom() == 1
            && self.kinds.get(name).is_some_and(|kind| kind.freedom() == 1)
            && self
                .sides_of
                .get(name)
                .is_some_and(|[tree, _]| *tree == parent)
            && !self.followers.contains_key(name);
        let same = if one_value {
            self.builder
                .mimic(name, &other, Number::one(), Number::zero());
            ", and both have one value"
        } else {
            ""
        };
        let message = format!(
            "joint {} inside <gazebo> has the name of another joint; it is called {} here{same}",
            quoted(name),
            quoted(&other)
        );
        let renamed = WarningKind::Renamed {
            joint: name.to_owned(),
            called: other.clone(),
        };
        self.warn_of(joint.start(), renamed, message);
        Ok(Some(new(other)))
    }

    fn add_late(
        &mut self,
        late: Late,
        joint: Element<'a>,
        kind: JointKind,
        builder: JointBuilder,
        place: &Place<'a>,
    ) {
        let link = match place.link {
            MODEL => self.tree_root.unwrap_or_default(),
            link => link,
        };
        let builder = builder.at_home(link, place.frame.clone(), place.parallel_to_root);
        if late.restates {
            self.restate(joint, late.name, builder);
            return;
        }
        self.uses(Dialect::UrdfPlus);
        self.first_in_gazebo.get_or_insert(joint.start());
        self.in_gazebo.insert(late.name, kind.freedom());
        self.builder.joint(builder);
    }

    /// Says what a reader that knows the tree alone would find.
    pub(super) fn note_tree(&mut self) {
        let Some(at) = self.first_in_gazebo else {
            return;
        };
        const LOOSE: usize = 6;
        let joints: usize = self.kinds.values().map(|kind| kind.freedom()).sum();
        let free = joints + LOOSE * self.floating.len();
        let tied = self.followers.len() - self.followers_in_gazebo;
        let count = self.in_gazebo.len();
        let are = if count == 1 { "is" } else { "are" };
        let message = match self.other_closures {
            false => format!(
                "{} inside <gazebo> and {} read; without what stands there the file is a tree with {}",
                counted_joints(count),
                are,
                freedoms(free.saturating_sub(tied))
            ),
            true => format!("{} inside <gazebo> and {are} read", counted_joints(count)),
        };
        self.warn_of(at, WarningKind::InGazebo { joints: count }, message);
    }

    /// A link by name, the last part of a scoped one. The world becomes a link of its own, in which the root is placed.
    fn sdf_link(&mut self, element: Element<'a>) -> Outcome<&'a str> {
        let given = match element.value() {
            Some(value) => value,
            None => element.required("link")?,
        };
        let mut value = given;
        value.value = given.value.trim();
        if !self.directory.has(Named::Link, value.value)
            && let Some((_, last)) = value.value.rsplit_once("::")
        {
            value.value = last;
        }
        if self.is_world(value.value) {
            return Ok(WORLD);
        }
        self.directory.refer_by(Named::Link, value)
    }

    /// Whether this is SDFormat's `world`, and no link of the file is called that.
    fn is_world(&self, link: &str) -> bool {
        link == WORLD && !self.directory.has(Named::Link, WORLD)
    }

    pub(super) fn sdf_place(
        &mut self,
        pose: Option<Element<'a>>,
        child: &'a str,
    ) -> Outcome<Place<'a>> {
        let mut place = Place {
            link: child,
            frame: Frame::identity(),
            parallel_to_root: false,
        };
        let Some(pose) = pose else {
            return Ok(place);
        };
        if let Some(format) = pose.attribute("rotation_format")
            && format.value != "euler_rpy"
        {
            return Err(format.fault("rotations are read as roll, pitch and yaw only"));
        }
        let in_degrees = pose.attribute("degrees").map(truth).transpose()?;
        let reference = pose
            .attribute("relative_to")
            .or_else(|| pose.attribute("frame"));
        match reference {
            Some(reference) if reference.value == MODEL => place.link = MODEL,
            Some(reference) if !reference.value.is_empty() => {
                place.link = self.directory.refer_by(Named::Link, reference)?;
            }
            _ => {}
        }
        if pose.stray_text().is_some() {
            let value = needed(pose)?;
            let [x, y, z, mut roll, mut pitch, mut yaw] = self.numbers::<6>(value)?;
            if in_degrees == Some(true) {
                [roll, pitch, yaw] = [&roll, &pitch, &yaw].map(radians_of);
            }
            place.frame.position = [x, y, z];
            place.frame.roll_pitch_yaw = [roll, pitch, yaw];
        }
        Ok(place)
    }

    /// `<mimic joint><multiplier/><offset/><reference/></mimic>` of an axis, since SDFormat 1.11: the joint's value is
    /// multiplier · (leader − reference) + offset.
    fn read_sdf_mimic(
        &mut self,
        late: &Late,
        kind: JointKind,
        axis: Option<Element<'a>>,
    ) -> Outcome<()> {
        let mut parts = axis.into_iter().flat_map(|axis| axis.elements());
        let Some(mimic) = parts.find(|part| part.name() == "mimic") else {
            return Ok(());
        };
        let other_axis = mimic.attribute("axis").filter(|word| word.value != "axis");
        if late.restates {
            return Err(mimic
                .fault("the tree has this joint already, and says there what it follows")
                .help("write <mimic> in the tree"));
        }
        if kind.freedom() != 1 || other_axis.is_some() {
            return Err(mimic
                .fault("only a joint of one axis that follows another one is read")
                .help("a <coupling> may say the same"));
        }
        let Some(leader) = self.leader_of(mimic, &late.name)? else {
            return Ok(());
        };
        let (mut multiplier, mut offset, mut reference) =
            (Number::one(), Number::zero(), Number::zero());
        for part in self.parts_of(mimic, &SDF_MIMIC)? {
            let number = self.number(needed(part)?)?;
            match part.name() {
                "multiplier" => multiplier = number,
                "offset" => offset = number,
                _ => reference = number,
            }
        }
        let offset = &offset - &(&multiplier * &reference);
        self.builder.mimic(&late.name, leader, multiplier, offset);
        Ok(())
    }

    /// An axis, and whether it is given in the model's frame.
    fn sdf_axis(&mut self, axis: Element<'a>) -> Outcome<(Direction, bool)> {
        if let Some(xyz) = axis.attribute("xyz") {
            return Err(xyz
                .fault("inside <gazebo> an axis is written as SDFormat does")
                .help(format!("<axis><xyz>{}</xyz></axis>", cut(xyz.value))));
        }
        let parts = self.parts_of(axis, &SDF_AXIS)?;
        let find = |name: &str| parts.iter().copied().find(|part| part.name() == name);
        let flag = find("use_parent_model_frame").and_then(|flag| flag.value());
        let mut in_model = flag.map(truth).transpose()?.unwrap_or(false);
        let Some(xyz) = find("xyz") else {
            // The specification's default.
            let z = [Number::zero(), Number::zero(), Number::one()];
            return Ok((Direction(z), in_model));
        };
        match xyz.attribute("expressed_in") {
            Some(frame) if frame.value == MODEL => in_model = true,
            Some(frame) if !frame.value.is_empty() => {
                return Err(frame
                    .fault(format!(
                        "an axis expressed in {} is not read",
                        quoted(frame.value)
                    ))
                    .help("in the joint's own frame and in `__model__` it is"));
            }
            _ => {}
        }
        Ok((self.sdf_direction(xyz)?, in_model))
    }

    fn sdf_direction(&mut self, element: Element<'a>) -> Outcome<Direction> {
        let value = needed(element)?;
        let direction = Direction(self.numbers(value)?);
        if direction.is_zero() {
            return Err(value.fault("the zero vector names no direction"));
        }
        Ok(direction)
    }

    /// The range and the friction of an `<axis>`. What is no number bounds nothing.
    fn sdf_limits(&mut self, axis: Option<Element<'a>>, word: &str) -> Outcome<(Limit, Dynamics)> {
        let read = of_axis(axis, word, |part| {
            Ok(part.value().and_then(|value| self.number(value).ok()))
        })?;
        if let Some(why) = read.no_limit {
            let at = axis.map_or(0, |axis| axis.start());
            self.warn_of(at, WarningKind::NoLimit, why);
        }
        Ok((read.limit, read.dynamics))
    }

    /// Metres per turn, right-handed, from radians per metre, left-handed.
    fn lead_of_thread(&mut self, element: Element<'a>) -> Outcome<Number> {
        let value = needed(element)?;
        let pitch = self.number(value)?;
        lead_of(&pitch).ok_or_else(|| value.fault("a thread needs a pitch that is not zero"))
    }
}

fn counted_joints(count: usize) -> String {
    match count {
        1 => "1 joint stands".to_owned(),
        _ => format!("{count} joints stand"),
    }
}

fn freedoms(count: usize) -> String {
    match count {
        1 => "1 degree of freedom".to_owned(),
        _ => format!("{count} degrees of freedom"),
    }
}

/// The kind of joint that a word of SDFormat stands for.
pub(super) fn kind_of(word: &str) -> Option<JointKind> {
    Some(match word {
        "revolute" | "continuous" => JointKind::Revolute,
        "prismatic" => JointKind::Prismatic,
        "screw" => JointKind::Screw,
        "ball" => JointKind::Spherical,
        "universal" | "revolute2" => JointKind::Universal,
        "fixed" => JointKind::Fixed,
        _ => return None,
    })
}

/// What is told of a joint that has the world below it.
pub(super) fn world_is_child(joint: Element<'_>) -> (WarningKind, String) {
    let name = joint.attribute("name").map_or("", |name| name.value);
    let kind = WarningKind::ReadersDiffer {
        what: "child".to_owned(),
    };
    let message = format!(
        "joint {}: the world is its child, for which libsdformat refuses a file; it is read as the joint between the two",
        quoted(name)
    );
    (kind, message)
}

/// What is told of a screw without a pitch, whose lead is one metre per turn. `sdf::Joint` of libsdformat has that default in metres per
/// revolution, right-handed, whatever the version of the file (its 13th version on); before, and in Gazebo Classic, it was the default of
/// `<thread_pitch>`, one radian per metre, left-handed.
pub(super) const NO_PITCH: &str = "a screw joint without a pitch advances 1 m per turn, right-handed, as in libsdformat; Gazebo Classic took 1 rad/m, left-handed";

/// Metres per turn, right-handed, from radians per metre, left-handed; `None` of zero.
pub(super) fn lead_of(pitch: &Number) -> Option<Number> {
    let turn = &Number::integer(-2) * &Number::pi();
    turn.checked_div(pitch).ok()
}

/// The two links of a joint, whichever is which.
pub(super) fn ordered([a, b]: [&str; 2]) -> [&str; 2] {
    if a <= b { [a, b] } else { [b, a] }
}

/// The text in an element that has to have one.
pub(super) fn needed(element: Element<'_>) -> Outcome<Attribute<'_>> {
    element.value().ok_or_else(|| {
        let message = format!(
            "<{}> needs a value and nothing else inside",
            element.written_name()
        );
        element.fault(message)
    })
}
