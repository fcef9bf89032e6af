//! Joints: their kinds, sides, axes and limits.

use super::names::Thing;
use super::{AXES_IN_MODEL, Body, Sdf, only};
use crate::WarningKind;
use crate::axis_limits::{CROSSED, of_axis};
use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::gazebo::{kind_of, lead_of, needed};
use crate::unread::truth;
use crate::values::exactly;
use crate::words::{cut, quoted};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Dynamics, JointKind, Limit};

/// A `<joint>` of the file.
pub(super) struct Listed<'a> {
    pub(super) element: Element<'a>,
    /// The model that it stands in.
    pub(super) scope: usize,
    /// Its frame in the graph of poses.
    pub(super) node: usize,
    /// What it is called here.
    pub(super) name: String,
    /// What it became; `None` where nothing came of it, as between links of a static model.
    pub(super) kind: Option<JointKind>,
}

/// A joint as it is read.
pub(super) struct Made {
    pub(super) name: String,
    pub(super) kind: JointKind,
    pub(super) sides: [Body; 2],
    /// The joint's frame as each side has it: one frame, but for constraints that need not be closed as drawn.
    pub(super) at: [usize; 2],
    /// The frame that its axes are given in.
    pub(super) turned_as: Option<usize>,
    pub(super) axis: Option<Direction>,
    pub(super) axis2: Option<Direction>,
    pub(super) lead: Option<Number>,
    pub(super) distance: Option<Number>,
    pub(super) limit: Limit,
    pub(super) dynamics: Dynamics,
}

impl Made {
    /// A joint that is closed as it is drawn, in a frame.
    pub(super) fn new(name: String, kind: JointKind, sides: [Body; 2], node: usize) -> Self {
        Self {
            name,
            kind,
            sides,
            at: [node; 2],
            turned_as: None,
            axis: None,
            axis2: None,
            lead: None,
            distance: None,
            limit: Limit::default(),
            dynamics: Dynamics::default(),
        }
    }
}

/// A joint that follows another one: multiplier · (leader − reference) + offset.
pub(super) struct Mimic<'a> {
    pub(super) element: Element<'a>,
    pub(super) scope: usize,
    pub(super) follower: usize,
    pub(super) leader: Attribute<'a>,
    pub(super) multiplier: Number,
    pub(super) offset: Number,
}

/// What bears on how a joint moves.
const OF_JOINT: [&str; 8] = [
    "parent",
    "child",
    "pose",
    "axis",
    "axis2",
    "screw_thread_pitch",
    "thread_pitch",
    "mimic",
];

/// What else stands in a joint.
const STANDARD: [&str; 5] = [
    "physics",
    "sensor",
    "gearbox_ratio",
    "gearbox_reference_body",
    "damping",
];

/// What bears on an axis, and what else stands in it.
const OF_AXIS: [&str; 4] = ["xyz", "use_parent_model_frame", "mimic", "limit"];
const BESIDE_AXIS: [&str; 2] = ["dynamics", "initial_position"];

/// A parent's frame that is farther from the joint than this (m) is another place.
const ELSEWHERE: f64 = 1e-6;

impl<'a> Sdf<'a> {
    /// Reads a joint of the file.
    pub(super) fn read_joint(&mut self, index: usize) -> Outcome<()> {
        let Some(listed) = self.joints.get(index) else {
            return Ok(());
        };
        let (joint, scope, node) = (listed.element, listed.scope, listed.node);
        let name = listed.name.clone();
        let word = joint.required("type")?;
        self.check_parts(joint)?;
        let sides = self.sides(index)?;
        if self.stands_still(sides) {
            let what = "<joint> between links that are all held".to_owned();
            self.unread.text(joint.start(), what);
            return Ok(());
        }
        if word.value == "gearbox" {
            return self.read_gearbox(index, sides);
        }
        let of_drake = joint.written_name() == "drake:joint";
        let kind = match word.value {
            "planar" if of_drake => Some(JointKind::Planar),
            "piston" => Some(JointKind::Cylindrical),
            word => kind_of(word),
        };
        let Some(kind) = kind else {
            let message = format!("a joint of the type {} is not read", quoted(word.value));
            return Err(word.fault(message).help("revolute, continuous, prismatic, screw, ball, universal, revolute2, gearbox, fixed and piston are"));
        };
        let mut made = Made::new(name, kind, sides, node);
        if kind == JointKind::Fixed && sides[1].is_none() {
            // Old files hold a link by the world as its child, which places no link.
            made.sides.reverse();
        }
        let [axis, axis2] = [only(joint, "axis")?, only(joint, "axis2")?];
        if kind.uses_axis() {
            self.read_axes(joint, scope, [axis, axis2], &mut made)?;
        }
        if kind.uses_lead() {
            made.lead = Some(self.lead(joint)?);
        }
        if kind.freedom() == 1 {
            let (limit, dynamics) = self.limits(axis)?;
            (made.limit, made.dynamics) = (limit, dynamics);
        } else {
            self.skip_limits(&[axis, axis2]);
        }
        if let Some(listed) = self.joints.get_mut(index) {
            listed.kind = Some(kind);
        }
        self.note_mimics(index, joint, [axis, axis2])?;
        self.note_other_place(index)?;
        self.made.push(made);
        Ok(())
    }

    /// Nothing in a joint may be a slip of what bears on its motion.
    fn check_parts(&mut self, joint: Element<'a>) -> Outcome<()> {
        for part in joint.elements() {
            match part.name() {
                name if OF_JOINT.contains(&name) => {}
                name if STANDARD.contains(&name) => self.unread.standard(part),
                _ => self.unknown(part, "joint", &OF_JOINT)?,
            }
            if !matches!(part.name(), "axis" | "axis2") {
                continue;
            }
            if let Some(xyz) = part.attribute("xyz") {
                let help = format!("<axis><xyz>{}</xyz></axis>", cut(xyz.value));
                return Err(xyz.fault("the axis stands in an element").help(help));
            }
            for inner in part.elements() {
                match inner.name() {
                    name if OF_AXIS.contains(&name) => {}
                    name if BESIDE_AXIS.contains(&name) => self.unread.standard(inner),
                    _ => self.unknown(inner, "axis", &OF_AXIS)?,
                }
            }
        }
        Ok(())
    }

    /// The two links of a joint.
    fn sides(&self, index: usize) -> Outcome<[Body; 2]> {
        let mut sides = [None, None];
        let mut child = None;
        for (which, body) in ["parent", "child"].into_iter().zip(&mut sides) {
            let (thing, name) = self.side(index, which)?;
            if let Some(name) = name {
                *body = self.body_of(thing, name)?;
            }
            child = name;
        }
        match (sides, child) {
            ([a, b], Some(name)) if a == b => Err(name
                .fault("both sides of the joint are one link")
                .help("a joint connects two different links")),
            _ => Ok(sides),
        }
    }

    /// Whether both sides of a joint are the world, or links of static models.
    pub(super) fn stands_still(&self, sides: [Body; 2]) -> bool {
        sides.iter().all(|body| match body {
            None => true,
            Some(link) => self.is_static(*link),
        })
    }

    /// Whether a link is in a model that does not move.
    pub(super) fn is_static(&self, link: usize) -> bool {
        let scope = self.links.get(link).map(|link| link.scope);
        let scope = scope.and_then(|scope| self.scopes.get(scope));
        scope.is_some_and(|scope| scope.is_static)
    }

    /// Tells where the parent of a joint is a frame at another place than the joint: only its link counts.
    fn note_other_place(&mut self, index: usize) -> Outcome<()> {
        let (parent, name) = self.side(index, "parent")?;
        let (Thing::Frame(_), Some(name), Some(joint)) = (parent, name, self.joints.get(index))
        else {
            return Ok(());
        };
        let apart = self.graph.seen_from(self.node_of(parent), joint.node);
        let apart = apart.map_or(0.0, |frame| {
            let [x, y, z] = frame.position.each_ref().map(Number::value);
            x.hypot(y).hypot(z)
        });
        if apart > ELSEWHERE {
            let message = format!(
                "joint {} is drawn at another place than the frame {} that is its parent: as in SDFormat the joint is where its own pose says, and of the frame only the link counts",
                quoted(&joint.name),
                quoted(name.value.trim())
            );
            self.warn(name.range().start, WarningKind::Guessed, message);
        }
        Ok(())
    }

    fn read_axes(
        &mut self,
        joint: Element<'a>,
        scope: usize,
        [axis, axis2]: [Option<Element<'a>>; 2],
        made: &mut Made,
    ) -> Outcome<()> {
        let [node, _] = made.at;
        let needs = |what: &str| {
            let message = format!("joint {} needs <{what}>", quoted(&made.name));
            joint
                .fault(message)
                .help(format!("<{what}><xyz>0 0 1</xyz></{what}>"))
        };
        // Drake's joints have their axes by their type.
        let of_drake = joint.written_name() == "drake:joint";
        let (direction, turned_as) = match axis {
            Some(axis) => self.axis(axis, scope, node)?,
            None if of_drake && made.kind == JointKind::Universal => (Direction::x(), node),
            None if of_drake && made.kind == JointKind::Planar => (unit(2), node),
            None => return Err(needs("axis")),
        };
        if made.kind.uses_second_axis() {
            let (second, other) = match axis2 {
                Some(axis2) => self.axis(axis2, scope, node)?,
                None if of_drake => (unit(1), node),
                None => return Err(needs("axis2")),
            };
            if other != turned_as {
                let at = axis2.unwrap_or(joint);
                return Err(at.fault("both axes of a joint must be given in the same frame"));
            }
            made.axis2 = Some(second);
        }
        made.axis = Some(direction);
        made.turned_as = Some(turned_as);
        Ok(())
    }

    /// The direction of an axis, and the frame that it is given in.
    pub(super) fn axis(
        &self,
        axis: Element<'a>,
        scope: usize,
        joint: usize,
    ) -> Outcome<(Direction, usize)> {
        let model = self.node_of(self.model(scope));
        let mut node = match self.version <= AXES_IN_MODEL {
            true => model,
            false => joint,
        };
        let flag = only(axis, "use_parent_model_frame")?.and_then(|flag| flag.value());
        if flag.map(truth).transpose()? == Some(true) {
            node = model;
        }
        let Some(xyz) = only(axis, "xyz")? else {
            // The specification's default.
            return Ok((unit(2), node));
        };
        let named = xyz.attribute("expressed_in");
        if let Some(named) = named.filter(|name| !name.value.trim().is_empty()) {
            node = self.node_of(self.look_up(scope, named)?);
        }
        let value = needed(xyz)?;
        let direction = Direction(exactly(value)?);
        match direction.is_zero() {
            true => Err(value.fault("the zero vector names no direction")),
            false => Ok((direction, node)),
        }
    }

    /// Metres per turn, right-handed.
    fn lead(&mut self, joint: Element<'a>) -> Outcome<Number> {
        if let Some(pitch) = only(joint, "screw_thread_pitch")? {
            let said = pitch.value().or_else(|| pitch.attribute("value"));
            let [lead] = exactly(match said {
                Some(said) => said,
                None => needed(pitch)?,
            })?;
            return Ok(lead);
        }
        let zero = "a thread needs a pitch that is not zero";
        match only(joint, "thread_pitch")? {
            Some(pitch) => {
                let value = needed(pitch)?;
                let [pitch] = exactly(value)?;
                lead_of(&pitch).ok_or_else(|| value.fault(zero))
            }
            None => {
                let message = "a screw joint without a pitch has a <thread_pitch> of 1 rad/m, left-handed, as in SDFormat";
                self.warn(joint.start(), WarningKind::Guessed, message.to_owned());
                lead_of(&Number::one()).ok_or_else(|| joint.fault(zero))
            }
        }
    }

    /// The range and the friction of an axis.
    fn limits(&mut self, axis: Option<Element<'a>>) -> Outcome<(Limit, Dynamics)> {
        let read = of_axis(axis, bound)?;
        if read.is_crossed {
            let at = axis.map_or(0, |axis| axis.start());
            self.warn(at, WarningKind::NoLimit, CROSSED.to_owned());
        }
        Ok((read.limit, read.dynamics))
    }

    /// Notes limits of joints that turn about two axes, which are not read.
    fn skip_limits(&mut self, axes: &[Option<Element<'a>>]) {
        for axis in axes.iter().flatten() {
            if let Some(limit) = axis.elements().find(|part| part.name() == "limit") {
                let what = "<limit> of a joint that has not one axis".to_owned();
                self.unread.text(limit.start(), what);
            }
        }
    }

    /// What a joint follows: `<mimic>` of its axis, or Drake's beside it.
    fn note_mimics(
        &mut self,
        index: usize,
        joint: Element<'a>,
        axes: [Option<Element<'a>>; 2],
    ) -> Outcome<()> {
        let [axis, axis2] = axes;
        if let Some(second) = axis2
            && let Some(mimic) = only(second, "mimic")?
        {
            return Err(mimic.fault("only a joint of one axis that follows another one is read"));
        }
        let of_axis = match axis {
            Some(axis) => only(axis, "mimic")?,
            None => None,
        };
        for mimic in of_axis.into_iter().chain(only(joint, "mimic")?) {
            let other = mimic.attribute("axis");
            if other.is_some_and(|word| word.value != "axis") {
                return Err(mimic.fault("only a joint of one axis can be followed"));
            }
            let leader = mimic.required("joint")?;
            let number = |name: &str| -> Outcome<Option<Number>> {
                let part = only(mimic, name)?.and_then(|part| part.value());
                match part.or_else(|| mimic.attribute(name)) {
                    Some(value) => {
                        let [number] = exactly(value)?;
                        Ok(Some(number))
                    }
                    None => Ok(None),
                }
            };
            let multiplier = number("multiplier")?.unwrap_or_else(Number::one);
            let offset = number("offset")?.unwrap_or_else(Number::zero);
            let reference = number("reference")?.unwrap_or_else(Number::zero);
            let offset = match reference.is_zero() {
                true => offset,
                false => &offset - &(&multiplier * &reference),
            };
            let scope = self.joints.get(index).map_or(0, |joint| joint.scope);
            self.mimics.push(Mimic {
                element: mimic,
                scope,
                follower: index,
                leader,
                multiplier,
                offset,
            });
        }
        Ok(())
    }
}

/// The direction of an axis of the frame.
fn unit(axis: usize) -> Direction {
    let component = |i: usize| match i == axis {
        true => Number::one(),
        false => Number::zero(),
    };
    Direction([0, 1, 2].map(component))
}

/// A bound, or a force; `None` where that is `inf`.
fn bound(element: Element<'_>) -> Outcome<Option<Number>> {
    let Some(value) = element.value() else {
        return Ok(None);
    };
    let double: Option<f64> = value.value.trim().parse().ok();
    if double.is_some_and(|double| double.is_nan() || double.abs() > 1e15) {
        return Ok(None);
    }
    let [number] = exactly(value)?;
    Ok(Some(number))
}
