//! Joints: their kinds, sides, axes and limits.

use super::names::Thing;
use super::{AXES_IN_MODEL, Body, Sdf, only};
use crate::WarningKind;
use crate::assumed::{ONE_AXIS, are_parallel};
use crate::axis_limits::of_axis;
use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::gazebo::{NO_PITCH, kind_of, lead_of, needed, world_is_child};
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

/// What bears on an axis, on its limits and its friction.
const OF_AXIS: [&str; 5] = [
    "xyz",
    "use_parent_model_frame",
    "mimic",
    "limit",
    "dynamics",
];
const OF_LIMIT: [&str; 4] = ["lower", "upper", "effort", "velocity"];
const OF_DYNAMICS: [&str; 2] = ["damping", "friction"];

/// What else stands in them: how stiff the ends of a range are, and springs.
const BESIDE_AXIS: [&str; 6] = [
    "initial_position",
    "stiffness",
    "dissipation",
    "acceleration",
    "spring_reference",
    "spring_stiffness",
];

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
        if sides[1].is_none() {
            let (kind, message) = world_is_child(joint);
            self.warn(joint.start(), kind, message);
        }
        // In any capitals, as libsdformat reads it.
        let typed = word.value.trim().to_lowercase();
        if typed == "gearbox" {
            return self.read_gearbox(index, sides);
        }
        let of_drake = joint.written_name() == "drake:joint";
        let kind = match &typed[..] {
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
            (made.limit, made.dynamics) = self.limits(axis, &typed)?;
        } else {
            self.skip_limits(kind, [axis, axis2])?;
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
            self.check_axis(part, "axis", &OF_AXIS)?;
            for inner in part.elements() {
                match inner.name() {
                    "limit" => self.check_axis(inner, "limit", &OF_LIMIT)?,
                    "dynamics" => self.check_axis(inner, "dynamics", &OF_DYNAMICS)?,
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// The same in an axis, or in a part of it. A spring without stiffness is none, and bears on nothing.
    fn check_axis(&mut self, element: Element<'a>, word: &str, known: &[&str]) -> Outcome<()> {
        let number = |name: &str| {
            let part = element.elements().find(|part| part.name() == name)?;
            part.value()?.value.trim().parse::<f64>().ok()
        };
        let no_spring = number("spring_stiffness") == Some(0.0);
        for part in element.elements() {
            match part.name() {
                name if known.contains(&name) => {}
                name if name.starts_with("spring_") && no_spring => {}
                name if BESIDE_AXIS.contains(&name) => self.unread.standard(part),
                _ => self.unknown(part, word, known)?,
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
            if are_parallel(&direction, &second) {
                let at = axis2.unwrap_or(joint);
                let message = format!("joint {}: {ONE_AXIS}", quoted(&made.name));
                return Err(at.fault(message).help(
                    "a joint of the type `revolute` about one of them moves the child alike",
                ));
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
        match only(joint, "thread_pitch")? {
            Some(pitch) => {
                let value = needed(pitch)?;
                let [pitch] = exactly(value)?;
                lead_of(&pitch)
                    .ok_or_else(|| value.fault("a thread needs a pitch that is not zero"))
            }
            None => {
                self.warn(joint.start(), WarningKind::Guessed, NO_PITCH.to_owned());
                Ok(Number::one())
            }
        }
    }

    /// The range and the friction of an axis.
    fn limits(&mut self, axis: Option<Element<'a>>, word: &str) -> Outcome<(Limit, Dynamics)> {
        let read = of_axis(axis, word, bound)?;
        if let Some(why) = read.no_limit {
            let at = axis.map_or(0, |axis| axis.start());
            self.warn(at, WarningKind::NoLimit, why.to_owned());
        }
        Ok((read.limit, read.dynamics))
    }

    /// Tells of what axes of joints with several freedoms, or none, say of ranges and friction: it is not read. Bounds that are none say
    /// nothing.
    fn skip_limits(&mut self, kind: JointKind, axes: [Option<Element<'a>>; 2]) -> Outcome<()> {
        for axis in axes.into_iter().flatten() {
            let read = of_axis(Some(axis), "", bound)?;
            if read.is_bounded() && kind.freedom() > 0 {
                let message = format!(
                    "the range of one axis of a {kind} joint is not read: the joint moves without limits here"
                );
                self.warn(axis.start(), WarningKind::NoLimit, message);
            } else if read.is_bounded() {
                let what = format!("<limit> of a {kind} joint");
                self.unread.text(axis.start(), what);
            }
            if read.dynamics != Dynamics::default() {
                let part = axis.elements().find(|part| part.name() == "dynamics");
                part.into_iter().for_each(|part| self.unread.standard(part));
            }
        }
        Ok(())
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
