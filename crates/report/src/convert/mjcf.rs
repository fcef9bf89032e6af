//! MJCF, MuJoCo's format: bodies inside bodies, the joints of each in the body that they move.
//!
//! The pose drawn is that of all joint values 0, here as there. Attributes that defaults of an including file could change are written
//! out. Angles are in radians, turned frames in roll, pitch and yaw (`eulerseq="XYZ"`) where the file says them so.

use super::body::{self, DEFAULT, OF_CLOSURE};
use super::closures::Carrier;
use super::parts::{Motion, Part, names, pitch};
use super::place::{is_straight, rigid, rounded, text, texts, triple, values};
use super::tree::{Joined, Step, parts_of, steps};
use super::{Converted, Hinges};
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_format::escaped;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Joint, JointId, LinkId, Mechanism, Shape};
use std::collections::{BTreeMap, BTreeSet};

/// MuJoCo's name of what does not move.
const WORLD: &str = "world";

/// A limit of nothing: MuJoCo's ranges have two ends.
const ENDLESS: f64 = 1e10;

pub(super) struct Mjcf<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) geometry: &'a Geometry<f64>,
    pub(super) hinges: Hinges,
    /// Largest coordinate of a joint's frame in a link (m).
    pub(super) size: f64,
    pub(super) not_said: Vec<String>,
    /// Names of joints, equalities, tendons and sites, which share one space here, and of bodies.
    names: BTreeSet<String>,
    bodies: BTreeSet<String>,
    /// The body that every link becomes.
    links: Vec<String>,
    /// The variable that a coupling of a joint speaks of.
    pub(super) variables: Vec<Option<String>>,
    /// The value at the pose drawn of the variable that couplings and limits of a joint speak of (rad, m).
    pub(super) drawn: Vec<f64>,
    pub(super) carriers: BTreeMap<LinkId, Vec<Carrier>>,
    pub(super) sites: BTreeMap<LinkId, Vec<String>>,
    pub(super) equalities: Vec<String>,
    pub(super) tendons: Vec<String>,
    motors: Vec<String>,
    without_mass: usize,
    shapes: usize,
    lost_shapes: usize,
    text: String,
}

/// A mechanism as MJCF.
#[must_use]
pub fn to_mjcf(mechanism: &Mechanism, hinges: Hinges) -> Converted {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let joints = mechanism.joints();
    let mut mjcf = Mjcf {
        mechanism,
        geometry: &geometry,
        hinges,
        size: geometry.size_of(0..joints.len()),
        not_said: Vec::new(),
        names: joints.iter().map(|joint| joint.name.clone()).collect(),
        bodies: BTreeSet::from([WORLD.to_owned()]),
        links: Vec::new(),
        variables: vec![None; joints.len()],
        drawn: vec![0.0; joints.len()],
        carriers: BTreeMap::new(),
        sites: BTreeMap::new(),
        equalities: Vec::new(),
        tendons: Vec::new(),
        motors: Vec::new(),
        without_mass: 0,
        shapes: 0,
        lost_shapes: 0,
        text: String::new(),
    };
    mjcf.name_bodies();
    mjcf.closures();
    mjcf.head();
    mjcf.tree(&steps(mechanism, &geometry));
    mjcf.couplings();
    mjcf.foot();
    mjcf.beside();
    Converted {
        text: mjcf.text,
        not_said: mjcf.not_said,
    }
}

impl Mjcf<'_> {
    pub(super) fn line(&mut self, depth: usize, line: &str) {
        for _ in 0..depth {
            self.text.push_str("  ");
        }
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// A name that no joint, equality, tendon or site has.
    pub(super) fn unused(&mut self, wanted: &str) -> String {
        unused(&mut self.names, wanted)
    }

    /// A name that no body has.
    pub(super) fn unused_body(&mut self, wanted: &str) -> String {
        unused(&mut self.bodies, wanted)
    }

    /// The body of a link, as it is written.
    pub(super) fn body_name(&self, link: LinkId) -> String {
        let name = self.links.get(link.0).map_or(WORLD, String::as_str);
        escaped(name).into_owned()
    }

    /// The value of a joint at the pose drawn.
    pub(super) fn drawn_at(&self, joint: JointId) -> f64 {
        self.drawn.get(joint.0).copied().unwrap_or(0.0)
    }

    fn name_bodies(&mut self) {
        let mechanism = self.mechanism;
        for (index, link) in mechanism.links().iter().enumerate() {
            if LinkId(index) == mechanism.ground() {
                self.links.push(WORLD.to_owned());
                if link.name != WORLD {
                    self.not_said
                        .push(format!("the name `{}` of the ground", link.name));
                }
                continue;
            }
            let name = self.unused_body(&link.name);
            if name != link.name {
                self.not_said.push(format!(
                    "the name of link `{}`, which is called `{name}`",
                    link.name
                ));
            }
            self.links.push(name);
        }
    }

    fn head(&mut self) {
        let name = escaped(self.mechanism.name()).into_owned();
        self.line(0, &format!("<mujoco model=\"{name}\">"));
        self.line(
            1,
            "<compiler angle=\"radian\" eulerseq=\"XYZ\" autolimits=\"false\" inertiafromgeom=\"false\"/>",
        );
        let mechanism = self.mechanism;
        let scene = mechanism.scene();
        if let Some(gravity) = scene.and_then(|scene| scene.gravity.as_ref()) {
            // The world there is the ground, which may be turned here.
            let ground = &self.geometry.home[mechanism.ground().0];
            let gravity = match is_straight(ground) {
                true => gravity.clone(),
                false => triple(ground.rotate_back(&values(gravity))),
            };
            self.line(1, &format!("<option gravity=\"{}\"/>", texts(&gravity)));
        }
    }

    /// All bodies, each inside the one that it hangs at.
    fn tree(&mut self, steps: &[Step]) {
        self.line(1, "<worldbody>");
        self.inside(self.mechanism.ground(), 2);
        let mut open = 0;
        for step in steps {
            while open >= step.depth {
                self.line(open + 1, "</body>");
                open -= 1;
            }
            open = step.depth;
            let name = self.body_name(step.link);
            let place = step.place.attributes();
            self.line(open + 1, &format!("<body name=\"{name}\"{place}>"));
            let moves = match &step.joined {
                Joined::Floating(name) => {
                    let name = self.unused(name);
                    let name = escaped(&name).into_owned();
                    self.line(open + 2, &format!("<freejoint name=\"{name}\"/>"));
                    true
                }
                Joined::By { joint, forward } => self.tree_joint(*joint, *forward, open + 2),
            };
            self.mass(step.link, moves, open + 2);
            self.inside(step.link, open + 2);
        }
        while open > 0 {
            self.line(open + 1, "</body>");
            open -= 1;
        }
        self.line(1, "</worldbody>");
    }

    /// The parts of a tree joint; whether there are any.
    fn tree_joint(&mut self, id: JointId, forward: bool, depth: usize) -> bool {
        let joint = self.mechanism.joint(id);
        let parts = parts_of(self.mechanism, self.geometry, id, forward);
        let names = self.named(id, joint, &parts);
        self.joints(joint, id, (&parts[..], &names[..]), depth);
        !parts.is_empty()
    }

    /// Names for the parts of a joint, and which of them couplings mean.
    pub(super) fn named(&mut self, id: JointId, joint: &Joint, parts: &[Part]) -> Vec<String> {
        let wanted = names(&joint.name, parts);
        let mut made = Vec::with_capacity(wanted.len());
        for name in wanted {
            made.push(match name == joint.name {
                true => name,
                false => self.unused(&name),
            });
        }
        if joint.freedom() == 1 {
            let main = parts.iter().position(|part| !part.of_screw);
            let name = main.and_then(|main| made.get(main)).cloned();
            if let Some(variable) = self.variables.get_mut(id.0) {
                *variable = name;
            }
        }
        made
    }

    fn joints(
        &mut self,
        joint: &Joint,
        id: JointId,
        (parts, names): (&[Part], &[String]),
        depth: usize,
    ) {
        let single = joint.freedom() == 1;
        let driven = self.mechanism.actuated().contains(&id);
        if !single && joint.dynamics.is_some() {
            self.not_said
                .push(format!("damping and friction of `{}`", joint.name));
        }
        let mut turn = None;
        for (part, name) in parts.iter().zip(names) {
            let main = single && !part.of_screw;
            if part.motion == Motion::Turn {
                turn = Some(name.clone());
            }
            let more = match main {
                true => self.range(id, joint) + &passive(joint),
                false => " limited=\"false\"".to_owned(),
            };
            let shown = escaped(name);
            let words = part_words(part);
            self.line(depth, &format!("<joint name=\"{shown}\"{words}{more}/>"));
            if driven && !part.of_screw {
                self.motor(joint, name, part.motion);
            }
        }
        self.tie(joint, (parts, names), turn);
    }

    /// Ties the slide of a screw to its turn.
    fn tie(&mut self, joint: &Joint, (parts, names): (&[Part], &[String]), turn: Option<String>) {
        let slide = parts.iter().position(|part| part.of_screw);
        let slide = slide.and_then(|slide| names.get(slide));
        if let (Some(slide), Some(turn), Some(pitch)) = (slide, turn, pitch(joint)) {
            let name = self.unused(&format!("{}.lead", joint.name));
            let turn = turn.as_str();
            self.polynomial(&name, slide, Some(turn), &[Number::zero(), pitch]);
        }
    }

    /// The limits of a joint of one freedom, from the pose drawn.
    fn range(&mut self, id: JointId, joint: &Joint) -> String {
        let limit = joint.limit.as_ref();
        if limit.is_some_and(|limit| limit.velocity.is_some()) {
            self.not_said
                .push(format!("the largest rate of `{}`", joint.name));
        }
        let driven = self.mechanism.actuated().contains(&id);
        if limit.is_some_and(|limit| limit.effort.is_some()) && !driven {
            self.not_said.push(format!(
                "the largest effort of `{}`, which no motor drives",
                joint.name
            ));
        }
        let (Some((lower, upper)), Some(limit)) = (joint.bounds(), limit) else {
            return " limited=\"false\"".to_owned();
        };
        if !(lower < upper) {
            self.not_said.push(format!(
                "the limits of `{}`, which leave it one value",
                joint.name
            ));
            return " limited=\"false\"".to_owned();
        }
        let drawn = self.drawn_at(id);
        let end = |stated: Option<&Number>, endless: f64| match stated {
            Some(stated) if stated.value().abs() < ENDLESS && drawn == 0.0 => text(stated),
            Some(stated) if stated.value().abs() < ENDLESS => {
                text(&rounded(stated.value() - drawn))
            }
            _ => format!("{endless:?}"),
        };
        let lower = end(limit.lower.as_ref(), -ENDLESS);
        let upper = end(limit.upper.as_ref(), ENDLESS);
        format!(" limited=\"true\" range=\"{lower} {upper}\"")
    }

    fn motor(&mut self, joint: &Joint, part: &str, motion: Motion) {
        if motion == Motion::Ball {
            self.not_said.push(format!(
                "the motor of `{}`, which turns about a point",
                joint.name
            ));
            return;
        }
        let effort = joint.limit.as_ref().and_then(|limit| limit.effort.as_ref());
        let range = match effort.filter(|effort| effort.value() > 0.0) {
            Some(effort) => {
                let ends = [text(&-effort), text(effort)].join(" ");
                format!(" ctrllimited=\"true\" ctrlrange=\"{ends}\"")
            }
            None => " ctrllimited=\"false\"".to_owned(),
        };
        let part = escaped(part);
        self.motors.push(format!(
            "<motor name=\"{part}\" joint=\"{part}\" gear=\"1\"{range}/>"
        ));
    }

    fn mass(&mut self, link: LinkId, moves: bool, depth: usize) {
        let known = self.mechanism.link(link);
        let written = known.inertial.as_ref().and_then(|inertial| {
            let pose = rigid(&inertial.origin);
            body::inertial(inertial, &pose)
        });
        match written {
            Some(line) => self.line(depth, &line),
            None => {
                if known.inertial.is_some() {
                    self.not_said.push(format!(
                        "the mass of `{}`: no body has this mass and these moments of inertia",
                        known.name
                    ));
                }
                if moves {
                    self.without_mass += 1;
                    self.line(depth, DEFAULT);
                }
            }
        }
    }

    /// What is in a link besides its joints: shapes, sites, and bodies that close loops.
    fn inside(&mut self, link: LinkId, depth: usize) {
        let known = self.mechanism.link(link);
        let visuals = known.visuals.iter().map(|shape| (shape, 2));
        let all: Vec<(&Shape, usize)> = visuals
            .chain(known.collisions.iter().map(|shape| (shape, 3)))
            .collect();
        for (shape, group) in all {
            match body::shape(shape, group) {
                Some(line) => {
                    self.shapes += 1;
                    self.line(depth, &line);
                }
                None => self.lost_shapes += 1,
            }
        }
        for site in self.sites.remove(&link).unwrap_or_default() {
            self.line(depth, &site);
        }
        for carrier in self.carriers.remove(&link).unwrap_or_default() {
            let (name, place) = (&carrier.name, carrier.place.attributes());
            self.line(depth, &format!("<body name=\"{name}\"{place}>"));
            let joint = self.mechanism.joint(carrier.joint);
            let parts = (&carrier.parts[..], &carrier.names[..]);
            self.joints(joint, carrier.joint, parts, depth + 1);
            self.line(depth + 1, OF_CLOSURE);
            if let Some(site) = &carrier.site {
                self.line(depth + 1, &format!("<site name=\"{site}\"/>"));
            }
            self.line(depth, "</body>");
        }
    }

    /// Tendons, equalities and motors.
    fn foot(&mut self) {
        let sections = [
            ("tendon", std::mem::take(&mut self.tendons)),
            ("equality", std::mem::take(&mut self.equalities)),
            ("actuator", std::mem::take(&mut self.motors)),
        ];
        for (element, lines) in sections {
            if lines.is_empty() {
                continue;
            }
            self.line(1, &format!("<{element}>"));
            for line in lines {
                self.line(2, &line);
            }
            self.line(1, &format!("</{element}>"));
        }
        self.line(0, "</mujoco>");
    }

    /// What the file says beside the mechanism, and is not written.
    fn beside(&mut self) {
        let mechanism = self.mechanism;
        for configuration in mechanism.configurations() {
            self.not_said
                .push(format!("configuration `{}`", configuration.name));
        }
        if mechanism
            .scene()
            .is_some_and(|scene| !scene.drives.is_empty())
        {
            self.not_said
                .push("the rates of driven joints of the scene".to_owned());
        }
        if mechanism.expectation().is_some() {
            self.not_said
                .push("what is expected of the mechanism".to_owned());
        }
        if mechanism.link(mechanism.ground()).inertial.is_some() {
            self.not_said
                .push("the mass of the ground, which does not move".to_owned());
        }
        if self.shapes > 0 {
            self.not_said
                .push("contact: shapes are written so that they touch nothing".to_owned());
        }
        if self.lost_shapes > 0 {
            let lost = self.lost_shapes;
            self.not_said
                .push(format!("meshes, and shapes without extent: {lost}"));
        }
        if self.without_mass > 0 {
            let count = self.without_mass;
            self.not_said.push(format!(
                "the mass of moving links, where the file has none: {count} got 0.1 kg, since MuJoCo refuses bodies without"
            ));
        }
    }
}

/// `type`, `axis` and `pos` of a part.
fn part_words(part: &Part) -> String {
    let word = match part.motion {
        Motion::Turn => "hinge",
        Motion::Slide => "slide",
        Motion::Ball => "ball",
    };
    let axis = match part.motion {
        Motion::Ball => String::new(),
        _ => format!(" axis=\"{}\"", texts(&part.axis)),
    };
    let away = part.motion != Motion::Slide && !part.point.iter().all(Number::is_zero);
    let place = match away {
        true => texts(&part.point),
        false => "0 0 0".to_owned(),
    };
    format!(" type=\"{word}\" pos=\"{place}\"{axis}")
}

/// Damping and dry friction of a joint of one freedom.
fn passive(joint: &Joint) -> String {
    let Some(dynamics) = &joint.dynamics else {
        return String::new();
    };
    let said = |name: &str, value: Option<&Number>| match value {
        Some(value) if !value.is_zero() => format!(" {name}=\"{}\"", text(value)),
        _ => String::new(),
    };
    said("damping", dynamics.damping.as_ref()) + &said("frictionloss", dynamics.friction.as_ref())
}

/// A name that is not taken, which then is.
pub(super) fn unused(taken: &mut BTreeSet<String>, wanted: &str) -> String {
    let mut name = wanted.to_owned();
    let mut number = 2;
    while !taken.insert(name.clone()) {
        name = format!("{wanted}_{number}");
        number += 1;
    }
    name
}
