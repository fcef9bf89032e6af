//! From a mechanism to text.
//!
//! The text reads back as the same mechanism: same names and order, same numbers with the same stated precision, unless decimals are asked
//! for. What the dialect cannot say is what the reader never makes: control characters in names (written as U+FFFD), limits on joints
//! of more than one freedom, and a tree joint whose frame differs from its child's.

use super::kept::{Kept, Owner};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Coupling, CouplingOrigin, Direction, Frame, Geometry, Joint, JointId, JointKind, Link,
    Mechanism, Placement, Precision, Scene, Shape,
};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Display;

/// What a file with loops says of other programs.
pub(super) const LOOPS_ARE_LOST: &str = " Other programs do not read <loop> and <coupling>: without a word they load the open tree, whose joints all move by themselves. ";

/// How a mechanism is written.
#[derive(Clone, Copy, Debug, Default)]
pub struct WriteOptions<'a> {
    /// What the file that the mechanism was read from says beside it.
    pub kept: Option<&'a Kept>,
    /// How exact numbers are written.
    pub numbers: Numbers,
}

/// How exact numbers are written; decimals that were read stay as they were read in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Numbers {
    /// As expressions (`${1/5}`), which states that they are exact.
    #[default]
    Expressions,
    /// As decimals where these say the same: of at most three places, in a file whose decimals are all exact, with them as without.
    Short,
    /// As decimals, for programs that read no expressions: rounded to double precision where they have no shorter end.
    Decimals,
}

/// A mechanism as a file that [`read`](super::read) reads back, exact numbers as expressions.
///
/// Names defined in the original file are gone; their values stand where they were used. A mechanism that plain URDF can
/// say is written as plain URDF, as long as its numbers are decimals.
#[must_use]
pub fn write(mechanism: &Mechanism) -> String {
    write_with(mechanism, &WriteOptions::default())
}

/// A mechanism as a file, numbers as wanted, with what its file says beside it. Otherwise as [`write`](fn@write).
#[must_use]
pub fn write_with(mechanism: &Mechanism, options: &WriteOptions<'_>) -> String {
    let text = |numbers| written(mechanism, options.kept, numbers);
    if options.numbers != Numbers::Short {
        return text(options.numbers);
    }
    let (exact, short) = (text(Numbers::Expressions), text(Numbers::Short));
    match exact_digits(&exact) {
        said @ Some(_) if exact_digits(&short) == said => short,
        _ => exact,
    }
}

/// Where all decimals of a text are exact, what reading says of their digits, joint by joint. Beside rounded numbers a decimal is a
/// rounded one.
fn exact_digits(text: &str) -> Option<Vec<bool>> {
    let mechanism = super::read(text, "", &[]).ok()?.mechanism;
    let mut joints = (0..mechanism.joints().len()).map(JointId);
    joints.try_fold(Vec::new(), |mut said, joint| {
        let precision = mechanism.precision_of(joint);
        said.push(precision.may_be_rounded_to(Precision::EXACT_DECIMALS));
        precision.is_exact().then_some(said)
    })
}

fn written(mechanism: &Mechanism, kept: Option<&Kept>, numbers: Numbers) -> String {
    let mut writer = Writer {
        text: String::new(),
        kept,
        style: Style(numbers),
    };
    writer.line(0, "<?xml version=\"1.0\"?>");
    writer.comments(0, kept.map_or(&[], |kept| &kept.head));
    let ratio = |coupling: &Coupling| !matches!(coupling.origin, CouplingOrigin::Mimic { .. });
    if mechanism.joints().iter().any(|joint| joint.closes_loop)
        || mechanism.couplings().iter().any(ratio)
    {
        writer.comments(0, &[LOOPS_ARE_LOST.to_owned()]);
    }
    writer.line(0, &format!("<robot{}>", pair("name", mechanism.name())));
    let root = mechanism.placement_order().first();
    if root.is_some_and(|root| *root != mechanism.ground()) {
        let name = &mechanism.link(mechanism.ground()).name;
        writer.line(1, &format!("<ground{}/>", pair("link", name)));
    }
    for link in mechanism.links() {
        writer.link(link);
    }
    let mimics: BTreeMap<usize, &Coupling> = mechanism
        .couplings()
        .iter()
        .filter_map(|coupling| match coupling.origin {
            CouplingOrigin::Mimic { follower, .. } => Some((follower.0, coupling)),
            CouplingOrigin::Ratio { .. } | CouplingOrigin::Sum => None,
        })
        .collect();
    for (index, joint) in mechanism.joints().iter().enumerate() {
        writer.joint(mechanism, joint, mimics.get(&index).copied());
    }
    writer.floating(mechanism);
    writer.couplings(mechanism);
    writer.actuation(mechanism);
    writer.configurations(mechanism);
    if let Some(scene) = mechanism.scene() {
        writer.scene(mechanism, scene);
    }
    writer.expectation(mechanism);
    writer.line(0, "</robot>");
    writer.text
}

struct Writer<'a> {
    text: String,
    kept: Option<&'a Kept>,
    style: Style,
}

impl Writer<'_> {
    fn line(&mut self, depth: usize, line: &str) {
        for _ in 0..depth {
            self.text.push_str("  ");
        }
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn comments(&mut self, depth: usize, comments: &[String]) {
        for comment in comments {
            self.line(depth, &format!("<!--{comment}-->"));
        }
    }

    fn comments_of(&mut self, owner: Owner, name: &str) {
        if let Some(kept) = self.kept {
            self.comments(1, kept.before(owner, name));
        }
    }

    fn link(&mut self, link: &Link) {
        self.comments_of(Owner::Link, &link.name);
        let style = self.style;
        let name = pair("name", &link.name);
        if link.inertial.is_none() && link.collisions.is_empty() && link.visuals.is_empty() {
            return self.line(1, &format!("<link{name}/>"));
        }
        self.line(1, &format!("<link{name}>"));
        if let Some(inertial) = &link.inertial {
            self.line(2, "<inertial>");
            self.origin(3, &inertial.origin);
            self.line(
                3,
                &format!("<mass{}/>", pair("value", &style.number(&inertial.mass))),
            );
            let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
            let components: String = names
                .iter()
                .zip(&inertial.inertia)
                .map(|(name, component)| pair(name, &style.number(component)))
                .collect();
            self.line(3, &format!("<inertia{components}/>"));
            self.line(2, "</inertial>");
        }
        for shape in &link.visuals {
            self.shape("visual", shape);
        }
        for shape in &link.collisions {
            self.shape("collision", shape);
        }
        self.line(1, "</link>");
    }

    fn shape(&mut self, element: &str, shape: &Shape) {
        let style = self.style;
        let name = shape.name.as_ref().map(|name| pair("name", name));
        self.line(2, &format!("<{element}{}>", name.unwrap_or_default()));
        self.origin(3, &shape.origin);
        let solid = match &shape.geometry {
            Geometry::Box(size) => format!("<box{}/>", pair("size", &style.numbers(size))),
            Geometry::Cylinder { radius, length } => style.round("cylinder", radius, length),
            Geometry::Capsule { radius, length } => style.round("capsule", radius, length),
            Geometry::Sphere(radius) => {
                format!("<sphere{}/>", pair("radius", &style.number(radius)))
            }
            Geometry::Mesh { filename, scale } => {
                let scale = scale
                    .as_ref()
                    .map(|scale| pair("scale", &style.numbers(scale)));
                let filename = pair("filename", filename);
                format!("<mesh{filename}{}/>", scale.unwrap_or_default())
            }
        };
        self.line(3, &format!("<geometry>{solid}</geometry>"));
        self.line(2, &format!("</{element}>"));
    }

    fn joint(&mut self, mechanism: &Mechanism, joint: &Joint, mimic: Option<&Coupling>) {
        self.comments_of(Owner::Joint, &joint.name);
        let style = self.style;
        let element = if joint.closes_loop { "loop" } else { "joint" };
        let independent = joint
            .independent
            .map(|independent| pair("independent", &independent.to_string()));
        self.line(
            1,
            &format!(
                "<{element}{}{}{}>",
                pair("name", &joint.name),
                pair("type", self.type_word(joint)),
                independent.unwrap_or_default()
            ),
        );
        let predecessor = &mechanism.link(joint.predecessor.link).name;
        let successor = &mechanism.link(joint.successor.link).name;
        if joint.closes_loop {
            self.side("predecessor", predecessor, &joint.predecessor.frame);
            self.side("successor", successor, &joint.successor.frame);
        } else {
            self.line(2, &format!("<parent{}/>", pair("link", predecessor)));
            self.side("child", successor, &joint.successor.frame);
            self.origin(2, &joint.predecessor.frame);
        }
        if joint.kind.uses_axis() {
            self.direction("axis", &joint.axis);
        }
        if joint.kind.uses_second_axis() {
            self.direction("axis2", &joint.axis2);
        }
        if let Some(lead) = &joint.lead {
            self.line(2, &format!("<screw{}/>", pair("lead", &style.number(lead))));
        }
        if let Some(distance) = &joint.distance {
            self.line(
                2,
                &format!("<distance{}/>", pair("value", &style.number(distance))),
            );
        }
        if let Some(limit) = joint.limit.as_ref().filter(|_| joint.freedom() == 1) {
            // One bound left out beside the other would be read as 0.
            let bound = |name, bound: Option<&Number>, other: Option<&Number>, endless| match bound
            {
                None if other.is_some() => pair(name, endless),
                _ => style.optional(name, bound),
            };
            let (lower, upper) = (limit.lower.as_ref(), limit.upper.as_ref());
            let attributes = bound("lower", lower, upper, "-1e308")
                + &bound("upper", upper, lower, "1e308")
                + &style.optional("effort", limit.effort.as_ref())
                + &style.optional("velocity", limit.velocity.as_ref());
            self.line(2, &format!("<limit{attributes}/>"));
        }
        if let Some(dynamics) = &joint.dynamics {
            let attributes = style.optional("damping", dynamics.damping.as_ref())
                + &style.optional("friction", dynamics.friction.as_ref());
            self.line(2, &format!("<dynamics{attributes}/>"));
        }
        if let Some(CouplingOrigin::Mimic {
            leader,
            multiplier,
            offset,
            ..
        }) = mimic.map(|coupling| &coupling.origin)
        {
            let leader = pair("joint", &mechanism.joint(*leader).name);
            let multiplier = pair("multiplier", &style.number(multiplier));
            let offset = pair("offset", &style.number(offset));
            self.line(2, &format!("<mimic{leader}{multiplier}{offset}/>"));
        }
        self.line(1, &format!("</{element}>"));
    }

    fn side(&mut self, element: &str, link: &str, frame: &Frame) {
        let style = self.style;
        let link = pair("link", link);
        match style.frame_attributes(frame) {
            None => self.line(2, &format!("<{element}{link}/>")),
            Some(frame) => self.line(2, &format!("<{element}{link}><origin{frame}/></{element}>")),
        }
    }

    /// `revolute` without a range is `continuous`, which plain URDF readers need to leave it free; but where a file has a word for it, it
    /// keeps that.
    fn type_word(&self, joint: &Joint) -> &'static str {
        let has_range = joint
            .limit
            .as_ref()
            .is_some_and(|limit| limit.lower.is_some() || limit.upper.is_some());
        let read = self.kept.and_then(|kept| kept.type_of(&joint.name));
        match joint.kind {
            JointKind::Revolute if !has_range => read.unwrap_or("continuous"),
            kind => kind.word(),
        }
    }

    fn floating(&mut self, mechanism: &Mechanism) {
        for link in mechanism.links() {
            if let Placement::Floating {
                name,
                parent,
                origin,
            } = &link.placement
            {
                self.line(
                    1,
                    &format!("<joint{} type=\"floating\">", pair("name", name)),
                );
                self.line(
                    2,
                    &format!("<parent{}/>", pair("link", &mechanism.link(*parent).name)),
                );
                self.line(2, &format!("<child{}/>", pair("link", &link.name)));
                self.origin(2, origin);
                self.line(1, "</joint>");
            }
        }
    }

    fn couplings(&mut self, mechanism: &Mechanism) {
        let style = self.style;
        for coupling in mechanism.couplings() {
            if let CouplingOrigin::Ratio {
                predecessor,
                successor,
                ratio,
                carrier,
                ..
            } = &coupling.origin
            {
                self.line(1, &format!("<coupling{}>", pair("name", &coupling.name)));
                let ends = [("predecessor", predecessor), ("successor", successor)];
                let carrier = carrier.iter().map(|link| ("carrier", link));
                for (element, link) in ends.into_iter().chain(carrier) {
                    self.line(
                        2,
                        &format!("<{element}{}/>", pair("link", &mechanism.link(*link).name)),
                    );
                }
                self.line(
                    2,
                    &format!("<ratio{}/>", pair("value", &style.number(ratio))),
                );
                self.line(1, "</coupling>");
            } else if coupling.origin == CouplingOrigin::Sum {
                let offset = match coupling.offset.is_zero() {
                    true => String::new(),
                    false => pair("offset", &style.number(&coupling.offset)),
                };
                let name = pair("name", &coupling.name);
                self.line(1, &format!("<coupling{name}{offset}>"));
                for term in &coupling.terms {
                    let joint = pair("joint", &mechanism.joint(term.joint).name);
                    for (power, factor) in (1..).zip(term.factors()) {
                        if factor.is_zero() {
                            continue;
                        }
                        let coefficient = pair("coefficient", &style.number(factor));
                        let power = match power {
                            1 => String::new(),
                            power => pair("power", &power.to_string()),
                        };
                        self.line(2, &format!("<term{joint}{coefficient}{power}/>"));
                    }
                }
                self.line(1, "</coupling>");
            }
        }
    }

    fn actuation(&mut self, mechanism: &Mechanism) {
        let driven = mechanism.actuated().iter();
        let mut driven: Vec<&str> = driven
            .map(|joint| mechanism.joint(*joint).name.as_str())
            .collect();
        for motors in self.kept.map_or(&[][..], |kept| &kept.motors) {
            let drives = |joint: &&str| motors.joints.iter().any(|own| own == joint);
            if driven.iter().any(&drives) {
                self.line(1, &motors.text);
                driven.retain(|joint| !drives(joint));
            }
        }
        for joint in driven {
            let name = pair("name", &format!("{joint}_transmission"));
            let joint = pair("name", joint);
            self.line(
                1,
                &format!("<transmission{name}><joint{joint}/></transmission>"),
            );
        }
    }

    fn configurations(&mut self, mechanism: &Mechanism) {
        let style = self.style;
        for configuration in mechanism.configurations() {
            self.line(
                1,
                &format!("<configuration{}>", pair("name", &configuration.name)),
            );
            for (joint, values) in &configuration.positions {
                // A joint without freedoms has no position to write.
                if !values.is_empty() {
                    let word = match configuration.free.contains(joint) {
                        true => "start",
                        false => "value",
                    };
                    let joint = pair("joint", &mechanism.joint(*joint).name);
                    let values = pair(word, &style.numbers(values));
                    self.line(2, &format!("<position{joint}{values}/>"));
                }
            }
            self.line(1, "</configuration>");
        }
    }

    fn scene(&mut self, mechanism: &Mechanism, scene: &Scene) {
        let style = self.style;
        self.line(1, "<scene>");
        if let Some(gravity) = &scene.gravity {
            self.line(
                2,
                &format!("<gravity{}/>", pair("xyz", &style.numbers(gravity))),
            );
        }
        if scene.contact {
            let restitution = style.optional("restitution", scene.restitution.as_ref());
            self.line(2, &format!("<contact{restitution}/>"));
        }
        for (effect, wanted) in [
            ("<limits/>", scene.limits),
            ("<friction/>", scene.friction),
            ("<damping/>", scene.damping),
        ] {
            if wanted {
                self.line(2, effect);
            }
        }
        for drive in &scene.drives {
            let joint = pair("joint", &mechanism.joint(drive.joint).name);
            let velocity = pair("velocity", &style.number(&drive.velocity));
            let torque = style.optional("torque", drive.torque.as_ref());
            self.line(2, &format!("<drive{joint}{velocity}{torque}/>"));
        }
        self.line(1, "</scene>");
    }

    fn expectation(&mut self, mechanism: &Mechanism) {
        fn told<T: Display>(name: &str, value: Option<T>) -> String {
            value
                .map(|value| pair(name, &value.to_string()))
                .unwrap_or_default()
        }
        let Some(expected) = mechanism.expectation() else {
            return;
        };
        let dimensions = expected.branch_dimensions.as_ref().map(|dimensions| {
            let words: Vec<String> = dimensions.iter().map(ToString::to_string).collect();
            words.join(" ")
        });
        let attributes = told("finite", expected.finite)
            + &told("instantaneous", expected.instantaneous)
            + &told("redundant", expected.redundant)
            + &told("kutzbach", expected.kutzbach)
            + &told("pose", expected.pose.as_ref())
            + &told("kind", expected.kind.as_ref())
            + &told(
                "locked",
                expected.locked.as_ref().map(|words| words.join(" ")),
            )
            + &told("idle", expected.idle.as_ref().map(|words| words.join(" ")))
            + &told("branches", expected.branches)
            + &told("branch_dimensions", dimensions);
        self.line(1, &format!("<expect{attributes}/>"));
    }

    fn origin(&mut self, depth: usize, frame: &Frame) {
        let style = self.style;
        if let Some(attributes) = style.frame_attributes(frame) {
            self.line(depth, &format!("<origin{attributes}/>"));
        }
    }

    fn direction(&mut self, element: &str, direction: &Direction) {
        let style = self.style;
        let left_out =
            *direction == Direction::x() && direction.0.iter().all(|n| n.stated().is_none());
        if !left_out {
            self.line(
                2,
                &format!("<{element}{}/>", pair("xyz", &style.numbers(&direction.0))),
            );
        }
    }
}

/// How numbers are written.
#[derive(Clone, Copy)]
struct Style(Numbers);

impl Style {
    /// A number so that it reads back with the same value: literals as they were read, exact ones as the style says.
    fn number(self, number: &Number) -> String {
        if number.literal_text().is_some() {
            return number.source();
        }
        match self.0 {
            Numbers::Expressions => number.source(),
            Numbers::Short => {
                let places = Precision::EXACT_DECIMALS.unsigned_abs();
                number
                    .decimal_text(places)
                    .unwrap_or_else(|| number.source())
            }
            Numbers::Decimals => {
                let short = number.decimal_text(DOUBLE_PLACES);
                short.unwrap_or_else(|| format!("{:?}", number.value()))
            }
        }
    }

    fn numbers(self, values: &[Number]) -> String {
        let words: Vec<String> = values.iter().map(|value| self.number(value)).collect();
        words.join(" ")
    }

    fn optional(self, name: &str, value: Option<&Number>) -> String {
        value
            .map(|value| pair(name, &self.number(value)))
            .unwrap_or_default()
    }

    fn round(self, element: &str, radius: &Number, length: &Number) -> String {
        let radius = pair("radius", &self.number(radius));
        let length = pair("length", &self.number(length));
        format!("<{element}{radius}{length}/>")
    }

    /// `xyz` and `rpy`, each left out where it is zero by default; `None` where both are.
    fn frame_attributes(self, frame: &Frame) -> Option<String> {
        let written = |name: &str, values: &[Number; 3]| {
            let left_out = values.iter().all(|n| n.is_zero() && n.stated().is_none());
            (!left_out).then(|| pair(name, &self.numbers(values)))
        };
        let xyz = written("xyz", &frame.position);
        let rpy = written("rpy", &frame.roll_pitch_yaw);
        if xyz.is_none() && rpy.is_none() {
            return None;
        }
        Some(xyz.unwrap_or_default() + &rpy.unwrap_or_default())
    }
}

/// Decimals that end within so many places are written whole: as many as a double has digits.
const DOUBLE_PLACES: u32 = 17;

/// ` name="value"`.
fn pair(name: &str, value: &str) -> String {
    format!(" {name}=\"{}\"", escaped(value))
}

/// A value as an attribute can hold it. White space other than the space would be read back as a space if not escaped.
#[must_use]
pub fn escaped(value: &str) -> Cow<'_, str> {
    let plain = |c: char| !matches!(c, '&' | '<' | '>' | '"') && is_xml(c) && !c.is_control();
    if value.chars().all(plain) {
        return Cow::Borrowed(value);
    }
    let mut text = String::with_capacity(value.len() + 16);
    for character in value.chars() {
        match character {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            '\t' | '\n' | '\r' => text.push_str(&format!("&#{};", u32::from(character))),
            c if is_xml(c) => text.push(c),
            _ => text.push('\u{fffd}'),
        }
    }
    Cow::Owned(text)
}

/// Characters that XML 1.0 allows (section 2.2).
fn is_xml(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | '\u{20}'..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..)
}
