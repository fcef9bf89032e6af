//! URDF as every program reads it: a tree of hinges, sliders and fixed joints.
//!
//! Other joints are several of these in series, with links without mass between them. What closes loops cannot be said: only the open
//! tree is written, and that is told.

use super::Converted;
use super::follow::Followers;
use super::mjcf::unused;
use super::parts::{Motion, Part, names, parts, pitch};
use super::place::{Place, is_identity, rounded};
use super::tree::drawn;
use kutzbach_closure::{Arithmetic, Geometry, Rigid};
use kutzbach_format::{Numbers, WriteOptions, escaped, write_with};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Coupling, Direction, Dynamics, Frame, Joint, JointBuilder, JointId, JointKind, Limit, LinkId,
    Mechanism, MechanismBuilder, MechanismError, Placement,
};
use std::collections::{BTreeMap, BTreeSet};

/// Who reads the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reader {
    /// Every program.
    Any,
    /// Pinocchio, with its constraints and couplings beside the tree: limits are complete, and no joint follows another one.
    Pinocchio,
}

/// No limit, effort or rate, for readers that want one.
const ENDLESS: i64 = 10_000_000_000;

/// The open tree under construction.
pub(super) struct Tree<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) geometry: &'a Geometry<f64>,
    reader: Reader,
    pub(super) builder: MechanismBuilder,
    links: BTreeSet<String>,
    joints: BTreeSet<String>,
    /// The joint that a coupling of a joint speaks of.
    pub(super) variables: BTreeMap<JointId, String>,
    /// The slide and the turn of every screw, and how far the one goes for a radian of the other (m/rad), where no `<mimic>` says it.
    pub(super) threads: Vec<(String, String, Number)>,
    /// Joints that urdfdom refuses.
    refused: Vec<String>,
    pub(super) not_said: Vec<String>,
}

/// A joint that becomes several in series.
pub(super) struct Chain {
    pub(super) id: JointId,
    /// The links at its ends.
    pub(super) ends: [String; 2],
    /// Where it stands when all variables are zero; `None` where its two frames coincide.
    pub(super) standing: Option<Rigid<f64>>,
    /// Where the link at its end is, from the joint's frame on that side.
    pub(super) end: Rigid<f64>,
    /// The value of its variable there (rad, m), from which its limits count.
    pub(super) value: f64,
}

/// A mechanism as plain URDF.
///
/// # Errors
/// Where what comes of it is no mechanism, which would be a fault of this program.
pub fn to_urdf(mechanism: &Mechanism) -> Result<Converted, MechanismError> {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let mut tree = Tree::new(mechanism, &geometry, Reader::Any);
    for joint in mechanism.joints().iter().filter(|joint| joint.closes_loop) {
        tree.not_said.push(format!(
            "{} joint `{}` between `{}` and `{}`, which closes a loop",
            joint.kind,
            joint.name,
            mechanism.link(joint.predecessor.link).name,
            mechanism.link(joint.successor.link).name
        ));
    }
    tree.couplings();
    tree.motors();
    tree.beside();
    if !tree.refused.is_empty() {
        tree.not_said.push(format!(
            "an effort and a rate of {}, which the mechanism does not state: urdfdom refuses a <limit> without them, and a slide without <limit>",
            tree.refused.join(", ")
        ));
    }
    let Tree {
        builder, not_said, ..
    } = tree;
    let text = with_comment(&written(builder)?, &not_said);
    Ok(Converted { text, not_said })
}

/// A tree as text that every program reads.
///
/// # Errors
/// Where it is no mechanism.
pub(super) fn written(builder: MechanismBuilder) -> Result<String, MechanismError> {
    let options = WriteOptions {
        numbers: Numbers::Decimals,
        ..WriteOptions::default()
    };
    Ok(write_with(&builder.build()?, &options))
}

impl<'a> Tree<'a> {
    /// All links and tree joints of a mechanism.
    pub(super) fn new(
        mechanism: &'a Mechanism,
        geometry: &'a Geometry<f64>,
        reader: Reader,
    ) -> Self {
        let names = mechanism.joints().iter().map(|joint| joint.name.clone());
        let mut tree = Self {
            mechanism,
            geometry,
            reader,
            builder: MechanismBuilder::new(mechanism.name()),
            links: BTreeSet::new(),
            joints: names.collect(),
            variables: BTreeMap::new(),
            threads: Vec::new(),
            refused: Vec::new(),
            not_said: Vec::new(),
        };
        tree.add_links();
        for (index, joint) in mechanism.joints().iter().enumerate() {
            if !joint.closes_loop {
                tree.tree_joint(JointId(index), joint);
            }
        }
        tree
    }

    fn add_links(&mut self) {
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
                self.joints.insert(name.clone());
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
        let ends = [joint.predecessor.link, joint.successor.link]
            .map(|link: LinkId| mechanism.link(link).name.clone());
        let simple = matches!(
            joint.kind,
            JointKind::Fixed | JointKind::Revolute | JointKind::Prismatic
        );
        if simple && joint.successor.frame.is_identity() {
            let [parent, child] = &ends;
            let made = JointBuilder::tree(&joint.name, joint.kind, parent, child)
                .origin(joint.predecessor.frame.clone());
            if joint.kind == JointKind::Fixed {
                self.builder.joint(made);
            } else {
                let made = made.axis(joint.axis.clone());
                self.add(&joint.name, made, joint.kind, Some((joint, 0.0)));
                self.variables.insert(id, joint.name.clone());
            }
            return;
        }
        self.chain(&Chain {
            id,
            ends,
            standing: drawn(self.geometry, joint.kind, id),
            end: self.geometry.sides[id.0][1].inverse(),
            value: 0.0,
        });
    }

    /// A joint as several in series. Every link between has its frame where the joint before it has its own.
    pub(super) fn chain(&mut self, chain: &Chain) {
        let (mechanism, geometry, id) = (self.mechanism, self.geometry, chain.id);
        let joint = mechanism.joint(id);
        let parts = hinges_for_balls(parts(joint, chain.standing.as_ref()));
        let names = names(&joint.name, &parts);
        // Where the frame on the successor is, from the link that was made last.
        let mut place = match &chain.standing {
            Some(standing) => Place::Computed(geometry.sides[id.0][0].compose(standing)),
            None => Place::Stated(joint.predecessor.frame.clone()),
        };
        let [parent, child] = &chain.ends;
        let ends_here = is_identity(&chain.end);
        let mut from = parent.clone();
        let mut turn: Option<String> = None;
        if joint.freedom() != 1 && joint.dynamics.is_some() {
            self.not_said
                .push(format!("damping and friction of `{}`", joint.name));
        }
        for (index, (part, name)) in parts.iter().zip(&names).enumerate() {
            let name = match *name == joint.name {
                true => name.clone(),
                false => unused(&mut self.joints, name),
            };
            let away = !part.point.iter().all(Number::is_zero);
            let last = index + 1 == parts.len() && !away && ends_here;
            let to = match last {
                true => child.clone(),
                false => self.between(&name),
            };
            let kind = match part.motion {
                Motion::Slide => JointKind::Prismatic,
                Motion::Turn | Motion::Ball => JointKind::Revolute,
            };
            let point = Place::Stated(Frame::at(part.point.clone()));
            let back = point.inverse();
            let made = JointBuilder::tree(&name, kind, &from, &to)
                .origin(place.then(point).frame())
                .axis(Direction(part.axis.clone()));
            let main = joint.freedom() == 1 && !part.of_screw;
            self.add(&name, made, kind, main.then_some((joint, chain.value)));
            if main {
                self.variables.insert(id, name.clone());
            }
            if let (true, Some(turn)) = (part.of_screw, &turn) {
                self.tie(joint, &name, turn);
            } else if part.motion == Motion::Turn {
                turn = Some(name.clone());
            }
            place = back;
            from = to;
        }
        if from != *child {
            let name = match parts.is_empty() {
                true => joint.name.clone(),
                false => unused(&mut self.joints, &format!("{}.end", joint.name)),
            };
            let end = match ends_here {
                true => Place::Stated(Frame::identity()),
                false => Place::Computed(chain.end.clone()),
            };
            let made = JointBuilder::tree(&name, JointKind::Fixed, &from, child);
            self.builder.joint(made.origin(place.then(end).frame()));
        }
    }

    /// Adds a hinge or a slide, with the limits and the friction of a joint whose variable it is, and the value that this has where the
    /// one written is zero.
    fn add(&mut self, name: &str, made: JointBuilder, kind: JointKind, of: Option<(&Joint, f64)>) {
        let limit = of.and_then(|(joint, value)| {
            let limit = joint.limit.clone()?;
            Some(counted_from(limit, value))
        });
        let limit = match self.reader {
            Reader::Any => {
                if is_refused(limit.as_ref(), kind) {
                    self.refused.push(format!("`{name}`"));
                }
                limit
            }
            Reader::Pinocchio => complete(limit, kind),
        };
        let dynamics: Option<Dynamics> = of.and_then(|(joint, _)| joint.dynamics.clone());
        let made = limit.into_iter().fold(made, JointBuilder::limit);
        let made = dynamics.into_iter().fold(made, JointBuilder::dynamics);
        self.builder.joint(made);
    }

    /// A link without mass.
    pub(super) fn between(&mut self, joint: &str) -> String {
        let name = unused(&mut self.links, &format!("{joint}_link"));
        self.builder.link(&name);
        name
    }

    /// Ties the slide of a screw to its turn.
    fn tie(&mut self, joint: &Joint, slide: &str, turn: &str) {
        let Some(pitch) = pitch(joint) else {
            return;
        };
        match self.reader {
            Reader::Any => {
                self.builder.mimic(slide, turn, pitch, Number::zero());
            }
            Reader::Pinocchio => {
                self.threads
                    .push((slide.to_owned(), turn.to_owned(), pitch));
            }
        }
    }

    fn couplings(&mut self) {
        let mechanism = self.mechanism;
        let mut followers = Followers::default();
        for coupling in mechanism.couplings() {
            if self.couple(coupling, &mut followers).is_none() {
                self.not_said.push(format!(
                    "coupling `{}`: <mimic> ties one joint of the tree to one other",
                    coupling.name
                ));
            }
        }
    }

    fn couple(&mut self, coupling: &Coupling, followers: &mut Followers) -> Option<()> {
        let said = |joint: &JointId| self.variables.contains_key(joint);
        if !coupling.terms.iter().all(|term| said(&term.joint)) {
            return None;
        }
        let found = followers.take(&coupling.terms, &coupling.offset)?;
        let follower = self.variables.get(&found.follower)?;
        let leader = self.variables.get(&found.leader)?;
        self.builder
            .mimic(follower, leader, found.multiplier, found.offset);
        Some(())
    }

    fn motors(&mut self) {
        let mechanism = self.mechanism;
        for id in mechanism.actuated() {
            let name = &mechanism.joint(*id).name;
            match self.variables.get(id) {
                Some(joint) => {
                    self.builder.actuate(joint);
                }
                None => self.not_said.push(format!("the motor of `{name}`")),
            }
        }
    }

    /// What the file says beside the mechanism, and is not written.
    pub(super) fn beside(&mut self) {
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

/// Whether urdfdom, and what is built on it, refuses a joint: it wants an effort and a rate in every `<limit>`, and a `<limit>` in every
/// slide.
fn is_refused(limit: Option<&Limit>, kind: JointKind) -> bool {
    match limit {
        Some(limit) => limit.effort.is_none() || limit.velocity.is_none(),
        None => kind == JointKind::Prismatic,
    }
}

/// Limits of a variable that is zero where the joint's own has a value.
fn counted_from(mut limit: Limit, value: f64) -> Limit {
    if value != 0.0 {
        for bound in [&mut limit.lower, &mut limit.upper].into_iter().flatten() {
            *bound = rounded(bound.value() - value);
        }
    }
    limit
}

/// Limits as urdfdom wants them: all four numbers of a hinge with bounds and of a slide, effort and rate of what turns without end.
fn complete(limit: Option<Limit>, kind: JointKind) -> Option<Limit> {
    let endless = |sign: i64| Some(Number::integer(sign * ENDLESS));
    let mut limit = match (limit, kind) {
        (Some(limit), _) => limit,
        (None, JointKind::Prismatic) => Limit::default(),
        (None, _) => return None,
    };
    if kind == JointKind::Prismatic || limit.lower.is_some() || limit.upper.is_some() {
        limit.lower = limit.lower.or_else(|| endless(-1));
        limit.upper = limit.upper.or_else(|| endless(1));
    }
    limit.effort = limit.effort.or_else(|| endless(1));
    limit.velocity = limit.velocity.or_else(|| endless(1));
    Some(limit)
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
        comment += &format!("  {};\n", harmless(&escaped(one)));
    }
    format!("{first}\n{comment}-->\n{rest}")
}

/// A text for a comment, which has no two dashes in a row.
fn harmless(text: &str) -> String {
    let mut spaced = String::with_capacity(text.len());
    for character in text.chars() {
        if character == '-' && spaced.ends_with('-') {
            spaced.push(' ');
        }
        spaced.push(character);
    }
    spaced
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_has_no_two_dashes_in_a_row() {
        assert_eq!(harmless("a---b--"), "a- - -b- -");
    }

    #[test]
    fn limits_are_complete_where_they_are_wanted() {
        let slide = complete(None, JointKind::Prismatic).unwrap();
        assert_eq!(slide.lower.unwrap().value(), -1e10);
        assert!(complete(None, JointKind::Revolute).is_none());
        let effort = Limit {
            effort: Some(Number::one()),
            ..Limit::default()
        };
        let turn = complete(Some(effort), JointKind::Revolute).unwrap();
        assert!(turn.lower.is_none() && turn.velocity.is_some());
        let bound = Limit {
            lower: Some(Number::one()),
            ..Limit::default()
        };
        let shifted = counted_from(bound, 0.25);
        assert_eq!(shifted.lower.unwrap().value(), 0.75);
    }
}
