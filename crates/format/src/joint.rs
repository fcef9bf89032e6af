//! `<joint>` and `<loop>`: the same kinds of joint, placed by their child or closing a loop.

use super::WarningKind;
use super::axis_limits::ENDLESS;
use super::element::Element;
use super::error::{Fault, Outcome};
use super::gazebo::ordered;
use super::hints;
use super::names::Named;
use super::reader::{Dialect, Reader};
use super::unread::{OF_JOINTS, Parts, truth};
use super::values::LARGEST;
use super::words::{did_you_mean, quoted};
use super::world::WORLD;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Dynamics, Frame, JointBuilder, JointKind, Limit};

/// What may stand inside `<joint>`.
const JOINT: [&str; 13] = [
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
    // Drake's.
    "drake:mimic",
    "drake:screw_thread_pitch",
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

/// Elements that say nothing about how a loop moves.
const SKIPPED_HERE: [&str; 5] = [
    "gazebo",
    "transmission",
    "sensor",
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

/// Attributes that would place a frame.
const PLACING: [&str; 3] = ["xyz", "rpy", "quat_xyzw"];

impl<'a> Reader<'a> {
    /// `<joint name type>` of the file's tree.
    pub(super) fn read_joint(&mut self, joint: Element<'a>) -> Outcome<()> {
        self.attributes_of(joint, &["name", "type", "independent"], true)?;
        let name = self.directory.add(Named::Joint, joint)?;
        let joint_type = self.joint_type(joint)?;
        let kinds = Parts {
            known: &JOINT,
            often: &[],
            bearing: &OF_JOINTS,
        };
        let parts = self.parts_of(joint, &kinds)?;
        let (mut parent, mut child, mut origin) = (None, None, Frame::identity());
        let mut body = Vec::with_capacity(parts.len());
        for part in parts {
            match part.name() {
                "parent" => parent = Some(self.link_of(part)?),
                "child" => child = Some((part, self.side(part)?)),
                "origin" => origin = self.joint_origin(part)?,
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
        self.join(name, [parent, child]);
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
                let mut message = format!(
                    "joint {} closes a loop: link {} is the child of joint {} already",
                    quoted(name),
                    quoted(child),
                    quoted(first)
                );
                if !own_frame {
                    message += &format!(
                        "; both hold it at its origin, as <child> has no <origin> inside that says where {} is in it",
                        quoted(name)
                    );
                }
                let kind = match own_frame {
                    true => WarningKind::ClosesLoop {
                        joint: name.to_owned(),
                        link: child.to_owned(),
                        other: (*first).to_owned(),
                    },
                    false => WarningKind::Guessed,
                };
                self.warn_of(joint.start(), kind, message);
                self.other_closures = true;
            }
            None => {
                self.placed_by.insert(child, name);
            }
        }
        if let Some(frame) = self.held_frame(name, kind, &child_frame, &body)? {
            let held = JointBuilder::tree(name, JointKind::Fixed, parent, child);
            self.builder
                .joint(held.origin(origin).successor_origin(frame));
            self.kinds.insert(name, JointKind::Fixed);
            return Ok(());
        }
        let builder = JointBuilder::tree(name, kind, parent, child)
            .origin(origin)
            .successor_origin(child_frame);
        self.read_body(joint, name, joint_type, kind, builder, &body)
    }

    /// `<loop name type>` with a frame on each side.
    pub(super) fn read_loop(&mut self, element: Element<'a>) -> Outcome<()> {
        self.uses(Dialect::UrdfPlus);
        self.other_closures = true;
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
        self.join(name, [predecessor, successor]);
        let builder = JointBuilder::closing(name, kind, predecessor, successor)
            .origin(predecessor_frame)
            .successor_origin(successor_frame);
        self.read_body(element, name, joint_type, kind, builder, &body)
    }

    /// Remembers which links a joint joins.
    pub(super) fn join(&mut self, name: &'a str, sides: [&'a str; 2]) {
        self.meets_world |= sides.contains(&WORLD);
        self.sides_of.insert(name, sides);
        self.joined.entry(ordered(sides)).or_insert(name);
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
        let kind = match joint.written_name() {
            "drake:joint" => Self::drake_kind(word),
            _ => JointKind::from_word(word),
        };
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
                ))
                .maybe_help(
                    hints::joint_type(word).map(|meant| {
                        format!("what others call {} is `{meant}` here", quoted(word))
                    }),
                ));
        }
        Ok(Type { word, kind })
    }

    /// `<parent link/>`.
    fn link_of(&mut self, element: Element<'a>) -> Outcome<&'a str> {
        self.leaf_of(element, &["link"], true)?;
        self.directory.refer(Named::Link, element, "link")
    }

    /// `<predecessor link>`, `<successor link>` or `<child link>` with an optional `<origin>` inside: the joint's frame there.
    fn side(&mut self, element: Element<'a>) -> Outcome<(&'a str, Frame)> {
        let placed = element
            .other_attributes(&["link"])
            .find(|(name, _)| PLACING.contains(name));
        // Other programs write it in <child>, and ROS skips it there.
        if let Some((name, range)) = placed.filter(|_| element.name() != "child") {
            let message = format!("`{name}` is not read in <{}>", element.written_name());
            return Err(Fault::new(range, message).help(format!("<origin {name}=\"...\"/> inside")));
        }
        self.attributes_of(element, &["link"], true)?;
        let link = self.directory.refer(Named::Link, element, "link")?;
        let kinds = Parts {
            known: &["origin"],
            often: &[],
            bearing: &OF_JOINTS,
        };
        let frame = match self.parts_of(element, &kinds)?.first() {
            Some(origin) => self.joint_origin(*origin)?,
            None => Frame::identity(),
        };
        Ok((link, frame))
    }

    fn read_floating(
        &mut self,
        joint: Element<'a>,
        name: &str,
        parent: &str,
        child: &'a str,
        origin: Frame,
        body: &[Element<'a>],
    ) -> Outcome<()> {
        for part in body {
            match part.name() {
                // Exporters write these for every joint.
                "axis" | "limit" | "dynamics" | "joint_properties" | "mimic" => {
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
            self.meaningless(joint.start(), "`independent`", "floating");
        }
        self.floating.insert(child);
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
        let of_drake = joint.written_name() == "drake:joint" && kind == JointKind::Universal;
        let mut axis = of_drake.then(Direction::x);
        let mut axis2 = of_drake.then(Self::drake_second_axis);
        let mut mimic = None;
        let (mut has_lead, mut has_dynamics) = (false, false);
        for &part in body {
            match part.name() {
                "axis" if of_drake => self.ignore(part, word),
                "axis" if kind.uses_axis() => axis = Some(self.direction(part)?),
                // Exporters of plain URDF write an axis for every joint.
                "axis" if matches!(kind, JointKind::Fixed | JointKind::Spherical) => {
                    self.ignore(part, word);
                }
                "axis" => {
                    return Err(useless(part, word).maybe_help(kind.uses_second_axis().then(
                        || format!("a {word} joint has its direction in <axis2 xyz=\"...\"/>"),
                    )));
                }
                "axis2" if kind.uses_second_axis() => axis2 = Some(self.direction(part)?),
                "screw" if kind.uses_lead() => {
                    self.leaf(part, &["lead"])?;
                    builder = builder.lead(self.number(part.required("lead")?)?);
                    has_lead = true;
                }
                "screw_thread_pitch" if kind.uses_lead() => {
                    builder = builder.lead(self.number(part.required("value")?)?);
                    has_lead = true;
                }
                "distance" if kind == JointKind::Distance => {
                    self.leaf(part, &["value"])?;
                    builder = builder.distance(self.number(part.required("value")?)?);
                }
                "axis2" | "screw" | "distance" | "screw_thread_pitch" => {
                    return Err(useless(part, word));
                }
                "limit" if kind.freedom() == 1 => {
                    let mut limit = self.read_limit(part, word)?;
                    if matches!(word, "revolute" | "prismatic") {
                        self.assume_bounds(part, name, &mut limit);
                    }
                    builder = builder.limit(limit);
                }
                "limit" => self.ignore(part, word),
                "dynamics" | "joint_properties" => {
                    if has_dynamics {
                        self.skip_because(part, "friction and damping given twice".to_owned());
                        continue;
                    }
                    has_dynamics = true;
                    if part.name() == "joint_properties" {
                        let [old, new] = ["<joint_properties>", "<dynamics>"].map(str::to_owned);
                        let message = format!("{old} is the old name of {new} and read as such");
                        self.warn_of(part.start(), WarningKind::OldName { old, new }, message);
                    }
                    match self.read_dynamics(part) {
                        Ok(dynamics) => builder = builder.dynamics(dynamics),
                        Err(fault) => self.skip_faulty(part, &fault),
                    }
                }
                "mimic" if kind.freedom() == 0 => self.ignore(part, word),
                _ => {
                    let Some(read) = self.read_mimic(part, name)? else {
                        continue;
                    };
                    if mimic.as_ref().is_some_and(|earlier| *earlier != read) {
                        return Err(part
                            .fault(format!("joint {} follows in two ways", quoted(name)))
                            .help("remove <mimic> or <drake:mimic>"));
                    }
                    mimic = Some(read);
                }
            }
        }
        self.note_axes((joint.start(), name), kind, [axis.as_ref(), axis2.as_ref()])
            .map_err(|why| joint.fault(format!("joint {}: {why}", quoted(name))))?;
        builder = axis.into_iter().fold(builder, JointBuilder::axis);
        builder = axis2.into_iter().fold(builder, JointBuilder::axis2);
        if kind.uses_lead() && !has_lead {
            return Err(joint
                .fault(format!(
                    "joint {} is a {word} joint and needs its lead",
                    quoted(name)
                ))
                .help("<screw lead=\"metres per turn\"/>"));
        }
        self.builder.joint(builder);
        self.kinds.insert(name, kind);
        if let Some(follows) = mimic {
            self.follow(name, follows);
        }
        Ok(())
    }

    /// `<limit lower upper effort velocity/>`, each optional.
    fn read_limit(&mut self, limit: Element<'a>, word: &str) -> Outcome<Limit> {
        self.leaf_of(limit, &["lower", "upper", "effort", "velocity"], true)?;
        let mut read = Limit {
            lower: self.bound(limit, "lower")?,
            upper: self.bound(limit, "upper")?,
            effort: self.rate(limit, "effort"),
            velocity: self.rate(limit, "velocity"),
        };
        if word == "continuous" && (read.lower.is_some() || read.upper.is_some()) {
            self.warn_of(limit.start(), WarningKind::NoLimit, ENDLESS);
            (read.lower, read.upper) = (None, None);
        }
        if let (Some(lower), Some(upper)) = (&read.lower, &read.upper)
            && lower.value() > upper.value()
        {
            // Bullet's convention for a joint without limits, and no other range can be meant.
            self.warn_of(
                limit.start(),
                WarningKind::NoLimit,
                "a lower limit above the upper one means no limit",
            );
            (read.lower, read.upper) = (None, None);
        }
        Ok(read)
    }

    /// A bound; numbers beyond all that are read stand for none, as `1.79769e+308` of exporters.
    fn bound(&mut self, limit: Element<'a>, name: &str) -> Outcome<Option<Number>> {
        match is_endless(limit, name) {
            true => Ok(None),
            false => self.optional_number(limit, name),
        }
    }

    fn rate(&mut self, limit: Element<'a>, name: &str) -> Option<Number> {
        match is_endless(limit, name) {
            true => None,
            false => self.number_if_readable(limit, name),
        }
    }

    fn read_dynamics(&mut self, dynamics: Element<'a>) -> Outcome<Dynamics> {
        self.leaf_of(dynamics, &["damping", "friction"], false)?;
        Ok(Dynamics {
            damping: self.optional_number(dynamics, "damping")?,
            friction: self.optional_number(dynamics, "friction")?,
        })
    }

    /// Passes over a part that says nothing for this type of joint, with a warning.
    fn ignore(&mut self, part: Element<'a>, word: &str) {
        self.meaningless(part.start(), &format!("<{}>", part.name()), word);
    }

    fn meaningless(&mut self, at: usize, what: &str, word: &str) {
        let of = format!("a {word} joint");
        let message = format!("{what} means nothing for {of} and is ignored");
        let what = what.to_owned();
        self.warn_of(at, WarningKind::Meaningless { what, of }, message);
    }
}

fn is_endless(limit: Element<'_>, name: &str) -> bool {
    limit.attribute(name).is_some_and(|text| {
        let value: Result<f64, _> = text.value.trim().parse();
        // A word such as `inf` is no number of a file.
        let digits = text.value.contains(|c: char| c.is_ascii_digit());
        digits && value.is_ok_and(|value| value.abs() > LARGEST)
    })
}

fn useless(part: Element<'_>, word: &str) -> super::error::Fault {
    part.fault(format!("a {word} joint has no <{}>", part.name()))
        .help("remove it, or change the joint's type")
}
