//! URDF as every program reads it: a tree of hinges, sliders and fixed joints.
//!
//! Other joints are several of these in series, with links without mass between them. What closes loops cannot be said: only the open
//! tree is written, and that is told.

use super::Converted;
use super::mjcf::unused;
use super::parts::{Motion, Part, names, parts, pitch};
use super::place::{Place, is_identity, rigid};
use super::tree::drawn;
use kutzbach_closure::{Arithmetic, Geometry, Rigid};
use kutzbach_format::{Numbers, WriteOptions, escaped, write_with};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Coupling, Direction, Frame, Joint, JointBuilder, JointId, JointKind, LinkId, Mechanism,
    MechanismBuilder, MechanismError, Placement,
};
use std::collections::{BTreeMap, BTreeSet};

struct Urdf<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    builder: MechanismBuilder,
    links: BTreeSet<String>,
    joints: BTreeSet<String>,
    /// The joint that a coupling of a joint speaks of.
    variables: BTreeMap<usize, String>,
    /// Which joint every follower follows.
    followers: BTreeMap<String, String>,
    not_said: Vec<String>,
}

/// A mechanism as plain URDF.
///
/// # Errors
/// Where what comes of it is no mechanism, which would be a fault of this program.
pub fn to_urdf(mechanism: &Mechanism) -> Result<Converted, MechanismError> {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let names = mechanism.joints().iter().map(|joint| joint.name.clone());
    let mut urdf = Urdf {
        mechanism,
        geometry: &geometry,
        builder: MechanismBuilder::new(mechanism.name()),
        links: BTreeSet::new(),
        joints: names.collect(),
        variables: BTreeMap::new(),
        followers: BTreeMap::new(),
        not_said: Vec::new(),
    };
    urdf.links();
    for (index, joint) in mechanism.joints().iter().enumerate() {
        match joint.closes_loop {
            true => urdf.not_said.push(format!(
                "{} joint `{}` between `{}` and `{}`, which closes a loop",
                joint.kind,
                joint.name,
                mechanism.link(joint.predecessor.link).name,
                mechanism.link(joint.successor.link).name
            )),
            false => urdf.tree_joint(JointId(index), joint),
        }
    }
    urdf.couplings();
    urdf.motors();
    urdf.beside();
    let Urdf {
        builder, not_said, ..
    } = urdf;
    let tree = builder.build()?;
    let options = WriteOptions {
        numbers: Numbers::Decimals,
        ..WriteOptions::default()
    };
    let text = with_comment(&write_with(&tree, &options), &not_said);
    Ok(Converted { text, not_said })
}

impl Urdf<'_> {
    fn links(&mut self) {
        let mechanism = self.mechanism;
        for link in mechanism.links() {
            self.links.insert(link.name.clone());
            self.builder.detailed_link(
                &link.name,
                link.inertial.clone(),
                link.collisions.clone(),
                link.visuals.clone(),
            );
        }
        for link in mechanism.links() {
            if let Placement::Floating {
                name,
                parent,
                origin,
            } = &link.placement
            {
                let parent = &mechanism.link(*parent).name;
                self.builder
                    .floating(name, parent, &link.name, origin.clone());
            }
        }
        let root = mechanism.placement_order().first();
        if root.is_some_and(|root| *root != mechanism.ground()) {
            let ground = &mechanism.link(mechanism.ground()).name;
            self.not_said
                .push(format!("that link `{ground}` is held, and not the root"));
        }
    }

    fn tree_joint(&mut self, id: JointId, joint: &Joint) {
        let mechanism = self.mechanism;
        let [parent, child] = [joint.predecessor.link, joint.successor.link]
            .map(|link: LinkId| mechanism.link(link).name.as_str());
        let simple = matches!(
            joint.kind,
            JointKind::Fixed | JointKind::Revolute | JointKind::Prismatic
        );
        if simple && joint.successor.frame.is_identity() {
            let made = JointBuilder::tree(&joint.name, joint.kind, parent, child)
                .origin(joint.predecessor.frame.clone());
            let made = match joint.kind {
                JointKind::Fixed => made,
                _ => made.axis(joint.axis.clone()),
            };
            self.builder.joint(with_limits(made, joint));
            if joint.kind != JointKind::Fixed {
                self.variables.insert(id.0, joint.name.clone());
            }
            return;
        }
        self.chain(id, joint, [parent, child]);
    }

    /// A joint as several in series. Every link between has its frame where the joint before it has its own.
    fn chain(&mut self, id: JointId, joint: &Joint, [parent, child]: [&str; 2]) {
        let geometry = self.geometry;
        let standing = drawn(geometry, joint.kind, id);
        let parts = hinges_for_balls(parts(joint, standing.as_ref()));
        let names = names(&joint.name, &parts);
        let [predecessor, successor] = &geometry.sides[id.0];
        let start = match &standing {
            Some(standing) => predecessor.compose(standing),
            None => predecessor.clone(),
        };
        // Where the frame on the successor is, from the link that was made last.
        let mut place = match &standing {
            Some(_) => Place::Computed(start),
            None => Place::Stated(joint.predecessor.frame.clone()),
        };
        let end = successor.inverse();
        let mut from = parent.to_owned();
        let mut turn: Option<String> = None;
        for (index, (part, name)) in parts.iter().zip(&names).enumerate() {
            let name = match *name == joint.name {
                true => name.clone(),
                false => unused(&mut self.joints, name),
            };
            let point = part.point.each_ref().map(Number::value);
            let away = point.iter().any(|x| *x != 0.0);
            let last = index + 1 == parts.len() && !away && is_identity(&end);
            let to = match last {
                true => child.to_owned(),
                false => self.between(&name),
            };
            let kind = match part.motion {
                Motion::Slide => JointKind::Prismatic,
                Motion::Turn | Motion::Ball => JointKind::Revolute,
            };
            let origin = match away {
                true => Place::Computed(rigid(&place.frame()).compose(&Rigid::translation(point))),
                false => place,
            };
            let made = JointBuilder::tree(&name, kind, &from, &to)
                .origin(origin.frame())
                .axis(Direction(part.axis.clone()));
            let main = joint.freedom() == 1 && !part.of_screw;
            self.builder.joint(match main {
                true => with_limits(made, joint),
                false => made,
            });
            if main {
                self.variables.insert(id.0, name.clone());
            }
            if let (true, Some(turn)) = (part.of_screw, &turn) {
                self.tie(joint, &name, turn);
            } else if part.motion == Motion::Turn {
                turn = Some(name.clone());
            }
            place = match away {
                true => Place::Computed(Rigid::translation(point.map(|x| -x))),
                false => Place::Stated(Frame::identity()),
            };
            from = to;
        }
        if from != child {
            let name = match parts.is_empty() {
                true => joint.name.clone(),
                false => unused(&mut self.joints, &format!("{}.end", joint.name)),
            };
            let origin = Place::Computed(rigid(&place.frame()).compose(&end));
            let made = JointBuilder::tree(&name, JointKind::Fixed, &from, child);
            self.builder.joint(made.origin(origin.frame()));
        }
    }

    /// A link without mass.
    fn between(&mut self, joint: &str) -> String {
        let name = unused(&mut self.links, &format!("{joint}_link"));
        self.builder.link(&name);
        name
    }

    /// Ties the slide of a screw to its turn.
    fn tie(&mut self, joint: &Joint, slide: &str, turn: &str) {
        if let Some(pitch) = pitch(joint) {
            self.followers.insert(slide.to_owned(), turn.to_owned());
            self.builder.mimic(slide, turn, pitch, Number::zero());
        }
    }

    fn couplings(&mut self) {
        let mechanism = self.mechanism;
        for coupling in mechanism.couplings() {
            if self.couple(coupling).is_none() {
                self.not_said.push(format!(
                    "coupling `{}`: <mimic> ties one joint of the tree to one other",
                    coupling.name
                ));
            }
        }
    }

    fn couple(&mut self, coupling: &Coupling) -> Option<()> {
        let [first, second] = &coupling.terms[..] else {
            return None;
        };
        if !coupling.is_linear() {
            return None;
        }
        let follower = self.variables.get(&first.joint.0)?.clone();
        let leader = self.variables.get(&second.joint.0)?.clone();
        // No joint follows two others or, by way of others, itself.
        let mut at = Some(&leader);
        while let Some(joint) = at {
            if *joint == follower {
                return None;
            }
            at = self.followers.get(joint);
        }
        if self.followers.contains_key(&follower) {
            return None;
        }
        let ratio = (-&second.factor).checked_div(&first.factor).ok()?;
        let offset = coupling.offset.checked_div(&first.factor).ok()?;
        self.builder.mimic(&follower, &leader, ratio, offset);
        self.followers.insert(follower, leader);
        Some(())
    }

    fn motors(&mut self) {
        let mechanism = self.mechanism;
        for id in mechanism.actuated() {
            let name = &mechanism.joint(*id).name;
            match self.variables.get(&id.0) {
                Some(joint) => {
                    self.builder.actuate(joint);
                }
                None => self.not_said.push(format!("the motor of `{name}`")),
            }
        }
    }

    /// What the file says beside the mechanism, and is not written.
    fn beside(&mut self) {
        let mechanism = self.mechanism;
        for configuration in mechanism.configurations() {
            self.not_said
                .push(format!("configuration `{}`", configuration.name));
        }
        if mechanism.scene().is_some() {
            self.not_said.push("the scene of a simulation".to_owned());
        }
        if mechanism.expectation().is_some() {
            self.not_said
                .push("what is expected of the mechanism".to_owned());
        }
    }
}

/// Limits, damping and friction of a joint of one freedom.
fn with_limits(made: JointBuilder, joint: &Joint) -> JointBuilder {
    let limit = joint.limit.clone().into_iter();
    let made = limit.fold(made, JointBuilder::limit);
    let dynamics = joint.dynamics.clone().into_iter();
    dynamics.fold(made, JointBuilder::dynamics)
}

/// Every ball as three hinges across one another.
fn hinges_for_balls(parts: Vec<Part>) -> Vec<Part> {
    let mut all = Vec::with_capacity(parts.len());
    for part in parts {
        if part.motion != Motion::Ball {
            all.push(part);
            continue;
        }
        for axis in [Direction::x(), y(), z()] {
            all.push(Part {
                motion: Motion::Turn,
                axis: axis.0,
                ..part.clone()
            });
        }
    }
    all
}

fn y() -> Direction {
    Direction([Number::zero(), Number::one(), Number::zero()])
}

fn z() -> Direction {
    Direction([Number::zero(), Number::zero(), Number::one()])
}

/// The text with a comment behind its first line on what it does not say.
fn with_comment(file: &str, not_said: &[String]) -> String {
    let (Some((first, rest)), false) = (file.split_once('\n'), not_said.is_empty()) else {
        return file.to_owned();
    };
    let mut comment = String::from("<!-- Not said here:\n");
    for one in not_said {
        // A comment has no two dashes in a row.
        let harmless = escaped(one).replace("--", "- -");
        comment += &format!("  {harmless};\n");
    }
    format!("{first}\n{comment}-->\n{rest}")
}
