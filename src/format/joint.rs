//! `<joint>` and `<loop>`: the same kinds of joint, placed by their child or closing a loop.

use super::element::{Attribute, Element};
use super::error::Outcome;
use super::names::Named;
use super::reader::{Dialect, Reader, SKIPPED};
use super::words::{did_you_mean, quoted};
use crate::mechanism::{Dynamics, Frame, JointBuilder, JointKind, Limit};
use crate::number::Number;

/// What may stand inside `<joint>`.
const JOINT: [&str; 11] = [
    "parent",
    "child",
    "origin",
    "axis",
    "axis2",
    "screw",
    "distance",
    "limit",
    "dynamics",
    "joint_properties",
    "mimic",
];

/// What may stand inside `<loop>`.
const LOOP: [&str; 10] = [
    "predecessor",
    "successor",
    "axis",
    "axis2",
    "screw",
    "distance",
    "limit",
    "dynamics",
    "joint_properties",
    "mimic",
];

/// Elements that say nothing about how a joint moves: those skipped everywhere, and what steers a robot's controller.
const SKIPPED_HERE: [&str; 5] = [
    SKIPPED[0],
    SKIPPED[1],
    SKIPPED[2],
    "safety_controller",
    "calibration",
];

/// A joint type as the file names it.
#[derive(Clone, Copy)]
struct Type<'a> {
    word: &'a str,
    /// `None` for `floating`, which constrains nothing.
    kind: Option<JointKind>,
}

impl<'a> Reader<'a> {
    /// `<joint name type>` of the file's tree.
    pub(super) fn read_joint(&mut self, joint: Element<'a>) -> Outcome<()> {
        self.note_foreign_attributes(joint, &["name", "type", "independent"])?;
        let name = self.directory.add(Named::Joint, joint)?;
        let joint_type = self.joint_type(joint)?;
        let parts = self.parts(joint, &JOINT, &[], &SKIPPED_HERE)?;
        let (mut parent, mut child, mut origin) = (None, None, Frame::identity());
        let mut body = Vec::with_capacity(parts.len());
        for part in parts {
            match part.name() {
                "parent" => parent = Some(self.link_of(part)?),
                "child" => child = Some((part, self.side(part)?)),
                "origin" => origin = self.origin(part)?,
                _ => body.push(part),
            }
        }
        let needs = |what: &str| {
            joint.fault(format!(
                "joint {} needs <{what} link=\"...\"/>",
                quoted(name)
            ))
        };
        let parent = parent.ok_or_else(|| needs("parent"))?;
        let (child_element, (child, child_frame)) = child.ok_or_else(|| needs("child"))?;
        let own_frame = !child_frame.is_identity();
        if own_frame {
            self.uses(Dialect::Own);
        }
        let Some(kind) = joint_type.kind else {
            if own_frame {
                return Err(child_element.fault(
                    "a floating joint is placed by its <origin> alone; its child has no frame for it",
                ));
            }
            return self.read_floating(joint, name, parent, child, origin, &body);
        };
        match self.placed_by.get(child) {
            Some(first) => {
                let message = format!(
                    "joint {} closes a loop: link {} is the child of joint {} already",
                    quoted(name),
                    quoted(child),
                    quoted(first)
                );
                self.warn(joint.start(), message);
            }
            None => {
                self.placed_by.insert(child, name);
            }
        }
        let builder = JointBuilder::tree(name, kind, parent, child)
            .origin(origin)
            .successor_origin(child_frame);
        self.read_body(joint, name, joint_type, kind, builder, &body)
    }

    /// `<loop name type>` with a frame on each side.
    pub(super) fn read_loop(&mut self, element: Element<'a>) -> Outcome<()> {
        self.uses(Dialect::UrdfPlus);
        self.note_foreign_attributes(element, &["name", "type", "independent"])?;
        let name = self.directory.add(Named::Joint, element)?;
        let joint_type = self.joint_type(element)?;
        let Some(kind) = joint_type.kind else {
            return Err(element
                .required("type")?
                .fault("a floating joint constrains nothing, so it closes no loop")
                .help("remove the loop"));
        };
        let parts = self.parts(element, &LOOP, &[], &SKIPPED_HERE)?;
        let (mut predecessor, mut successor) = (None, None);
        let mut body = Vec::with_capacity(parts.len());
        for part in parts {
            match part.name() {
                "predecessor" => predecessor = Some(self.side(part)?),
                "successor" => successor = Some(self.side(part)?),
                _ => body.push(part),
            }
        }
        let needs = |what: &str| {
            element
                .fault(format!("loop {} needs <{what} link=\"...\">", quoted(name)))
                .help(format!(
                    "<{what} link=\"...\"><origin xyz=\"...\" rpy=\"...\"/></{what}>"
                ))
        };
        let (predecessor, predecessor_frame) = predecessor.ok_or_else(|| needs("predecessor"))?;
        let (successor, successor_frame) = successor.ok_or_else(|| needs("successor"))?;
        let builder = JointBuilder::closing(name, kind, predecessor, successor)
            .origin(predecessor_frame)
            .successor_origin(successor_frame);
        self.read_body(element, name, joint_type, kind, builder, &body)
    }

    fn joint_type(&mut self, joint: Element<'a>) -> Outcome<Type<'a>> {
        const URDF: [&str; 6] = [
            "revolute",
            "continuous",
            "prismatic",
            "fixed",
            "floating",
            "planar",
        ];
        const SYNONYMS: [&str; 5] = [
            "continuous",
            "line_on_line",
            "plane_on_plane",
            "point_on_point",
            "floating",
        ];
        let attribute = joint.required("type")?;
        let word = attribute.value;
        if !URDF.contains(&word) {
            self.uses(Dialect::Own);
        }
        let kind = JointKind::from_word(word);
        if kind.is_none() && word != "floating" {
            let known = JointKind::ALL.map(JointKind::word);
            return Err(attribute
                .fault(format!("there is no joint type {}", quoted(word)))
                .help(format!(
                    "the types are {} and {}",
                    known.join(", "),
                    SYNONYMS.join(", ")
                ))
                .maybe_help(did_you_mean(
                    word,
                    known.into_iter().chain(SYNONYMS),
                    ("`", "`"),
                )));
        }
        Ok(Type { word, kind })
    }

    /// `<parent link/>`.
    fn link_of(&mut self, element: Element<'a>) -> Outcome<&'a str> {
        self.leaf(element, &["link"])?;
        self.directory.refer(Named::Link, element, "link")
    }

    /// `<predecessor link>`, `<successor link>` or `<child link>` with an optional `<origin>` inside: the joint's frame there.
    fn side(&mut self, element: Element<'a>) -> Outcome<(&'a str, Frame)> {
        self.note_foreign_attributes(element, &["link"])?;
        let link = self.directory.refer(Named::Link, element, "link")?;
        let frame = match self.parts(element, &["origin"], &[], &[])?.first() {
            Some(origin) => self.origin(*origin)?,
            None => Frame::identity(),
        };
        Ok((link, frame))
    }

    fn read_floating(
        &mut self,
        joint: Element<'a>,
        name: &str,
        parent: &str,
        child: &str,
        origin: Frame,
        body: &[Element<'a>],
    ) -> Outcome<()> {
        for part in body {
            match part.name() {
                // Exporters write these for every joint.
                "axis" | "limit" | "dynamics" | "joint_properties" => {
                    self.ignore(*part, "floating");
                }
                other => {
                    return Err(part.fault(format!(
                        "a floating joint only places its child, so it has no <{other}>"
                    )));
                }
            }
        }
        if joint.attribute("independent").is_some() {
            self.warn(
                joint.start(),
                "`independent` means nothing for a floating joint and is ignored",
            );
        }
        self.builder.floating(name, parent, child, origin);
        Ok(())
    }

    /// Everything that `<joint>` and `<loop>` share.
    fn read_body(
        &mut self,
        joint: Element<'a>,
        name: &'a str,
        joint_type: Type<'a>,
        kind: JointKind,
        mut builder: JointBuilder,
        body: &[Element<'a>],
    ) -> Outcome<()> {
        if let Some(attribute) = joint.attribute("independent") {
            self.uses(Dialect::UrdfPlus);
            builder = builder.independent(truth(attribute)?);
        }
        let word = joint_type.word;
        let mut mimic = None;
        let (mut has_lead, mut has_dynamics) = (false, false);
        for &part in body {
            match part.name() {
                "axis" if kind.uses_axis() => builder = builder.axis(self.direction(part)?),
                // Exporters of plain URDF write an axis for every joint.
                "axis" if matches!(kind, JointKind::Fixed | JointKind::Spherical) => {
                    self.leaf(part, &["xyz"])?;
                    if let Some(xyz) = part.attribute("xyz") {
                        self.numbers::<3>(xyz)?;
                    }
                    self.ignore(part, word);
                }
                "axis" => {
                    return Err(useless(part, word).maybe_help(kind.uses_second_axis().then(
                        || format!("a {word} joint has its direction in <axis2 xyz=\"...\"/>"),
                    )));
                }
                "axis2" if kind.uses_second_axis() => {
                    builder = builder.axis2(self.direction(part)?)
                }
                "screw" if kind.uses_lead() => {
                    self.leaf(part, &["lead"])?;
                    builder = builder.lead(self.number(part.required("lead")?)?);
                    has_lead = true;
                }
                "distance" if kind == JointKind::Distance => {
                    self.leaf(part, &["value"])?;
                    builder = builder.distance(self.number(part.required("value")?)?);
                }
                "axis2" | "screw" | "distance" => return Err(useless(part, word)),
                "limit" if kind.freedom() == 1 => {
                    builder = builder.limit(self.read_limit(part, word)?);
                }
                "limit" => self.ignore(part, word),
                "dynamics" | "joint_properties" => {
                    if has_dynamics {
                        return Err(part.fault("the joint's friction and damping are given twice"));
                    }
                    has_dynamics = true;
                    if part.name() == "joint_properties" {
                        self.warn(
                            part.start(),
                            "<joint_properties> is the old name of <dynamics> and read as such",
                        );
                    }
                    builder = builder.dynamics(self.read_dynamics(part)?);
                }
                _ => mimic = Some(self.read_mimic(part)?),
            }
        }
        if kind.uses_lead() && !has_lead {
            return Err(joint
                .fault(format!(
                    "joint {} is a {word} joint and needs its lead",
                    quoted(name)
                ))
                .help("<screw lead=\"metres per turn\"/>"));
        }
        self.builder.joint(builder);
        if let Some((leader, multiplier, offset)) = mimic {
            self.builder.mimic(name, leader, multiplier, offset);
        }
        Ok(())
    }

    /// `<limit lower upper effort velocity/>`, each optional.
    fn read_limit(&mut self, limit: Element<'a>, word: &str) -> Outcome<Limit> {
        const RATES: [&str; 3] = ["acceleration", "deceleration", "jerk"];
        self.leaf(
            limit,
            &[
                "lower", "upper", "effort", "velocity", RATES[0], RATES[1], RATES[2],
            ],
        )?;
        if RATES.iter().any(|rate| limit.attribute(rate).is_some()) {
            self.warn(
                limit.start(),
                "limits of acceleration and jerk are not read",
            );
        }
        let mut read = Limit {
            lower: self.optional_number(limit, "lower")?,
            upper: self.optional_number(limit, "upper")?,
            effort: self.optional_number(limit, "effort")?,
            velocity: self.optional_number(limit, "velocity")?,
        };
        if word == "continuous" && (read.lower.is_some() || read.upper.is_some()) {
            self.warn(
                limit.start(),
                "a continuous joint turns without end: `lower` and `upper` are ignored",
            );
            (read.lower, read.upper) = (None, None);
        }
        if let (Some(lower), Some(upper)) = (&read.lower, &read.upper)
            && lower.value() > upper.value()
        {
            return Err(limit.fault(format!(
                "the lower limit {} is above the upper limit {}",
                lower.value(),
                upper.value()
            )));
        }
        Ok(read)
    }

    fn read_dynamics(&mut self, dynamics: Element<'a>) -> Outcome<Dynamics> {
        self.leaf(dynamics, &["damping", "friction"])?;
        Ok(Dynamics {
            damping: self.optional_number(dynamics, "damping")?,
            friction: self.optional_number(dynamics, "friction")?,
        })
    }

    fn read_mimic(&mut self, mimic: Element<'a>) -> Outcome<(&'a str, Number, Number)> {
        self.leaf(mimic, &["joint", "multiplier", "offset"])?;
        let leader = self.directory.refer(Named::Joint, mimic, "joint")?;
        let multiplier = self.optional_number(mimic, "multiplier")?;
        let offset = self.optional_number(mimic, "offset")?;
        Ok((
            leader,
            multiplier.unwrap_or_else(Number::one),
            offset.unwrap_or_else(Number::zero),
        ))
    }

    /// Skips a part that says nothing for this type of joint, with a warning.
    fn ignore(&mut self, part: Element<'a>, word: &str) {
        self.warn(
            part.start(),
            format!(
                "<{}> means nothing for a {word} joint and is ignored",
                part.name()
            ),
        );
        self.skip(part);
    }
}

fn useless(part: Element<'_>, word: &str) -> super::error::Fault {
    part.fault(format!("a {word} joint has no <{}>", part.name()))
        .help("remove it, or change the joint's type")
}

/// `true` or `false`, also `1` and `0` as XML Schema allows.
fn truth(attribute: Attribute<'_>) -> Outcome<bool> {
    match attribute.value {
        "true" | "1" => Ok(true),
        "false" | "0" => Ok(false),
        other => Err(attribute.fault(format!("needed true or false, found {}", quoted(other)))),
    }
}
