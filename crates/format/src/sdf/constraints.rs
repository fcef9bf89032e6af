//! What constrains and is no joint that moves: gearboxes, followers, plugins, and Drake's constraints.

use super::joints::{Made, Mimic};
use super::models::Extra;
use super::names::Thing;
use super::{Body, Sdf, only};
use crate::WarningKind;
use crate::detachable::{HELD_ALREADY, NO_SUCH_LINK, is_detachable, told};
use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::gazebo::needed;
use crate::values::exactly;
use crate::words::{cut, quoted};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Frame, JointKind};
use std::collections::BTreeMap;

/// A gearbox: what its child turns about `axis2` seen from the reference body is −ratio times what its parent turns about `axis`.
pub(super) struct Gear<'a> {
    element: Element<'a>,
    name: String,
    /// Parent and child, with their axes and the frames that these are given in.
    sides: [(Body, Direction, usize); 2],
    reference: Body,
    ratio: Number,
}

/// Axes are parallel up to this sine of their angle.
const PARALLEL: f64 = 0.01;

/// Parts of the names of plugins: of joints that follow, and of motors.
const FOLLOWING: [&str; 3] = ["mimic_joint", "mimic-joint", "MimicJoint"];
const DRIVING: [&str; 8] = [
    "ApplyJointForce",
    "JointPositionController",
    "JointController",
    "JointTrajectoryController",
    "apply-joint-force",
    "joint-position-controller",
    "joint-controller",
    "joint-trajectory-controller",
];

/// Springs and one-sided limits, which leave the motion as it is.
const SPRINGS: [&str; 3] = [
    "drake:tendon_constraint",
    "drake:linear_bushing_rpy",
    "drake:linear_spring_damper",
];

impl<'a> Sdf<'a> {
    /// Keeps a gearbox until all joints are known.
    pub(super) fn read_gearbox(&mut self, index: usize, sides: [Body; 2]) -> Outcome<()> {
        let Some(listed) = self.joints.get(index) else {
            return Ok(());
        };
        let (joint, scope, node) = (listed.element, listed.scope, listed.node);
        let name = listed.name.clone();
        let part = |what: &str| -> Outcome<Element<'a>> {
            only(joint, what)?
                .ok_or_else(|| joint.fault(format!("gearbox {} needs <{what}>", quoted(&name))))
        };
        let body = needed(part("gearbox_reference_body")?)?;
        let reference = self.body_of(self.look_up(scope, body)?, body)?;
        let ratio = match only(joint, "gearbox_ratio")? {
            Some(ratio) => {
                let [ratio] = exactly(needed(ratio)?)?;
                ratio
            }
            None => Number::one(),
        };
        let [parent, child] = sides;
        let (first, in_first) = self.axis(part("axis")?, scope, node)?;
        let (second, in_second) = self.axis(part("axis2")?, scope, node)?;
        self.gears.push(Gear {
            element: joint,
            name,
            sides: [(parent, first, in_first), (child, second, in_second)],
            reference,
            ratio,
        });
        Ok(())
    }

    /// Couples joints, when all of them are known.
    pub(super) fn couple(&mut self) -> Outcome<()> {
        for mimic in std::mem::take(&mut self.mimics) {
            self.follow(mimic)?;
        }
        let gears = std::mem::take(&mut self.gears);
        if gears.is_empty() {
            return Ok(());
        }
        let mut hinges: BTreeMap<[Body; 2], usize> = BTreeMap::new();
        for (index, made) in self.made.iter().enumerate() {
            if made.kind == JointKind::Revolute {
                hinges.entry(ordered(made.sides)).or_insert(index);
            }
        }
        for gear in &gears {
            match self.terms(gear, &hinges) {
                Some(terms) => {
                    self.builder
                        .linear_coupling(&gear.name, terms, Number::zero());
                }
                None => {
                    let message = format!(
                        "gearbox {} is not read, and it constrains: no hinges about its axes bear its two links on its reference body",
                        quoted(&gear.name)
                    );
                    self.warn(gear.element.start(), WarningKind::MayJoin, message);
                }
            }
        }
        Ok(())
    }

    /// The sum that a gearbox holds at zero: the child's turn and the ratio times the parent's.
    fn terms(
        &self,
        gear: &Gear<'a>,
        hinges: &BTreeMap<[Body; 2], usize>,
    ) -> Option<Vec<(String, Number)>> {
        let mut terms = Vec::new();
        let factors = [gear.ratio.clone(), Number::one()];
        for ((body, axis, node), factor) in gear.sides.iter().zip(factors) {
            let hinge = hinges.get(&ordered([gear.reference, *body]))?;
            let made = self.made.get(*hinge)?;
            let own = self.in_world(made.turned_as?, made.axis.as_ref()?)?;
            let asked = self.in_world(*node, axis)?;
            let along = parallel(own, asked)?;
            // The hinge counts the turn of its own child.
            let forth = made.sides[1] == *body;
            let same = (along > 0.0) == forth;
            terms.push((made.name.clone(), if same { factor } else { -factor }));
        }
        terms.reverse();
        Some(terms)
    }

    /// A direction of a frame as it points at home.
    fn in_world(&self, node: usize, direction: &Direction) -> Option<[f64; 3]> {
        let frame = self.graph.seen_from(super::pose::WORLD, node)?;
        Some(turned(&frame, direction))
    }

    fn follow(&mut self, mimic: Mimic<'a>) -> Outcome<()> {
        let leader = self.joint_named(mimic.scope, mimic.leader)?;
        let mut names = Vec::new();
        for index in [mimic.follower, leader] {
            let Some(listed) = self.joints.get(index) else {
                return Ok(());
            };
            match listed.kind {
                Some(kind) if kind.freedom() == 1 => names.push(listed.name.clone()),
                Some(kind) => {
                    return Err(mimic.element.fault(format!(
                        "joint {} is {} with {} degrees of freedom and cannot be coupled",
                        quoted(&listed.name),
                        kind.word(),
                        kind.freedom()
                    )));
                }
                None => {
                    let what = "<mimic> of a joint that is none or stands still".to_owned();
                    self.unread.text(mimic.element.start(), what);
                    return Ok(());
                }
            }
        }
        if let [follower, leader] = &names[..] {
            self.builder
                .mimic(follower, leader, mimic.multiplier, mimic.offset);
        }
        Ok(())
    }

    /// Plugins, and constraints of Drake's.
    pub(super) fn read_extras(&mut self) -> Outcome<()> {
        for extra in std::mem::take(&mut self.extras) {
            match extra.element.name() {
                "plugin" => self.plugin(extra)?,
                _ => self.of_drake(extra)?,
            }
        }
        Ok(())
    }

    fn plugin(&mut self, extra: Extra<'a>) -> Outcome<()> {
        let plugin = extra.element;
        let words = ["name", "filename"].map(|word| plugin.attribute(word).map_or("", |w| w.value));
        let is = |known: &[&str]| {
            let has = |word: &str| known.iter().any(|part| word.contains(part));
            words.iter().any(|word| has(word))
        };
        let [leader, follower] = ["joint", "mimicJoint"].map(|name| inner(plugin, name));
        if is_detachable(plugin) {
            return self.detachable(extra);
        }
        if let (true, Some(leader), Some(follower)) = (is(&FOLLOWING), leader, follower) {
            let number = |name: &str, default: Number| -> Outcome<Number> {
                let Some(value) = inner(plugin, name) else {
                    return Ok(default);
                };
                let [number] = exactly(value)?;
                Ok(number)
            };
            let mimic = Mimic {
                element: plugin,
                scope: extra.scope,
                follower: self.joint_named(extra.scope, follower)?,
                leader,
                multiplier: number("multiplier", Number::one())?,
                offset: number("offset", Number::zero())?,
            };
            self.mimics.push(mimic);
            return Ok(());
        }
        let mut drives = false;
        if is(&DRIVING) {
            let named = plugin.elements().filter(|part| part.name() == "joint_name");
            for name in named.filter_map(|part| part.value()) {
                drives |= self.drive(extra.scope, name);
            }
        }
        if !drives {
            let [name, file] = words;
            let word = if file.is_empty() { name } else { file };
            self.unread
                .text(plugin.start(), format!("<plugin> {}", cut(word)));
        }
        Ok(())
    }

    /// Notes the motor of a joint; `false` where there is nothing that it could move.
    fn drive(&mut self, scope: usize, name: Attribute<'a>) -> bool {
        let Ok(joint) = self.joint_named(scope, name) else {
            return false;
        };
        match self.joints.get(joint) {
            Some(listed) if listed.kind.is_some_and(|kind| kind.freedom() == 1) => {
                self.builder.actuate(&listed.name);
                true
            }
            _ => false,
        }
    }

    /// A joint that can be let go holds what it joins until then, as it is drawn.
    fn detachable(&mut self, extra: Extra<'a>) -> Outcome<()> {
        let (plugin, scope) = (extra.element, extra.scope);
        let [parent, model, child] =
            ["parent_link", "child_model", "child_link"].map(|name| inner(plugin, name));
        let found = |scope: usize, name: Option<Attribute<'a>>| {
            let name = name?;
            Some((self.find(scope, name.value.trim())?, name))
        };
        let first = found(scope, parent);
        let inside = found(scope, model).or_else(|| found(0, model));
        let second = match inside {
            Some((Thing::Model(inside), _)) => found(inside, child),
            _ => None,
        };
        let (Some((one, one_name)), Some((other, other_name))) = (first, second) else {
            self.unread.text(plugin.start(), NO_SUCH_LINK.to_owned());
            return Ok(());
        };
        let sides = [
            self.body_of(one, one_name)?,
            self.body_of(other, other_name)?,
        ];
        if sides[0] == sides[1] || self.stands_still(sides) {
            self.unread.text(plugin.start(), HELD_ALREADY.to_owned());
            return Ok(());
        }
        let [parent, child] = [one_name, other_name].map(|name| name.value.trim());
        let name = self.name_made(&format!("{parent}_{child}_detachable"), plugin.range());
        let kind = WarningKind::ReadAs {
            joint: name.clone(),
            element: "joint".to_owned(),
        };
        self.warn(plugin.start(), kind, told([parent, child]));
        let node = self.node_of(other);
        self.made
            .push(Made::new(name, JointKind::Fixed, sides, node));
        Ok(())
    }

    /// Drake's constraints between points or frames of two links, which need not be closed as drawn.
    fn of_drake(&mut self, extra: Extra<'a>) -> Outcome<()> {
        let element = extra.element;
        let written = element.written_name();
        if SPRINGS.contains(&written) {
            let what =
                format!("<{written}>, a spring or a one-sided limit, which leaves the motion free");
            self.unread.text(element.start(), what);
            return Ok(());
        }
        let (kind, names) = match written {
            "drake:ball_constraint" => (
                JointKind::Spherical,
                [("body_A", "p_AP"), ("body_B", "p_BQ")],
            ),
            "drake:distance_constraint" => (
                JointKind::Distance,
                [("body_A", "p_AP"), ("body_B", "p_BQ")],
            ),
            "drake:weld_constraint" => (JointKind::Fixed, [("parent", ""), ("child", "")]),
            _ if written.contains("constraint") => {
                return Err(element
                    .fault(format!("<{}> constrains, and it is not read", cut(written)))
                    .help("write it as a <joint>"));
            }
            _ => {
                self.unread.element(element);
                return Ok(());
            }
        };
        if let Ok(stiffness) = said(element, "stiffness")
            && exactly::<1>(stiffness).is_ok()
        {
            let what = format!("<{written}> with a finite stiffness, a spring");
            self.unread.text(element.start(), what);
            return Ok(());
        }
        let (mut sides, mut at) = ([None; 2], [super::pose::WORLD; 2]);
        for (index, (body, point)) in names.into_iter().enumerate() {
            let name = said(element, body)?;
            let thing = self.look_up(extra.scope, name)?;
            sides[index] = self.body_of(thing, name)?;
            at[index] = self.node_of(thing);
            if !point.is_empty() {
                let node = self.graph.add(at[index], element.range());
                let point = Frame::at(exactly(said(element, point)?)?);
                self.graph.place(node, at[index], point);
                at[index] = node;
            }
        }
        if sides[0] == sides[1] || self.stands_still(sides) {
            let what = format!("<{written}> between links that are held");
            self.unread.text(element.start(), what);
            return Ok(());
        }
        let name = self.name_made(element.name(), element.range());
        let mut made = Made::new(name, kind, sides, at[0]);
        made.at = at;
        if kind == JointKind::Distance {
            let [distance] = exactly(said(element, "distance")?)?;
            made.distance = Some(distance);
        }
        self.made.push(made);
        Ok(())
    }
}

/// The two links of a hinge, whichever is which.
fn ordered([a, b]: [Body; 2]) -> [Body; 2] {
    if a <= b { [a, b] } else { [b, a] }
}

/// The text in an element inside another one.
fn inner<'a>(element: Element<'a>, name: &str) -> Option<Attribute<'a>> {
    element.elements().find(|part| part.name() == name)?.value()
}

/// What a part of one of Drake's constraints says: `<drake:ball_constraint_p_AP>` or `<drake:p_AP>`, as text or as an attribute.
fn said<'a>(constraint: Element<'a>, what: &str) -> Outcome<Attribute<'a>> {
    let long = format!("{}_{what}", constraint.name());
    let part = constraint
        .elements()
        .find(|part| part.name() == what || part.name() == long);
    let value = part.and_then(|part| {
        part.value()
            .or_else(|| part.attribute("name"))
            .or_else(|| part.attribute("value"))
    });
    value.ok_or_else(|| {
        let written = cut(constraint.written_name());
        constraint.fault(format!("<{written}> needs <drake:{long}>"))
    })
}

/// A direction turned as a frame is: `R = Rz(yaw) Ry(pitch) Rx(roll)`.
fn turned(frame: &Frame, direction: &Direction) -> [f64; 3] {
    let [roll, pitch, yaw] = frame.roll_pitch_yaw.each_ref().map(Number::value);
    let [x, y, z] = direction.0.each_ref().map(Number::value);
    let (y, z) = (
        y * roll.cos() - z * roll.sin(),
        y * roll.sin() + z * roll.cos(),
    );
    let (x, z) = (
        x * pitch.cos() + z * pitch.sin(),
        z * pitch.cos() - x * pitch.sin(),
    );
    [
        x * yaw.cos() - y * yaw.sin(),
        x * yaw.sin() + y * yaw.cos(),
        z,
    ]
}

/// The cosine between two directions that are parallel.
fn parallel(a: [f64; 3], b: [f64; 3]) -> Option<f64> {
    let dot = |a: &[f64; 3], b: &[f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cosine = dot(&a, &b) / (dot(&a, &a) * dot(&b, &b)).sqrt();
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    (sine <= PARALLEL).then_some(cosine)
}
