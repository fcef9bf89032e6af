//! Couplings: a joint that follows another one, a gearbox between two hinges on one link, a joint that is held.

use super::super::follow::Followers;
use super::super::place::{Triple, rounded, settled, texts};
use super::{Sdf, allowed, holding, line};
use kutzbach_format::escaped;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Coupling, CouplingOrigin, JointId, JointKind, LinkId};

/// A gearbox: of two links that turn on a third one, how far the second turns and `ratio` times how far the first does add up to zero.
pub(super) struct Gear {
    name: String,
    /// Parent and child: the link, the hinge that bears it, and the axis about which it turns, in the hinge's frame.
    sides: [(LinkId, JointId, Triple); 2],
    reference: LinkId,
    ratio: Number,
}

impl Sdf<'_> {
    /// Finds words for all couplings.
    pub(super) fn couplings(&mut self) {
        let mechanism = self.mechanism;
        let mut followers = Followers::default();
        for coupling in mechanism.couplings() {
            let offset = self.offset(coupling);
            let said = match coupling.terms.as_slice() {
                _ if !coupling.is_linear() => false,
                [only] => self.hold(coupling, only.joint, &offset),
                [_, _] => {
                    self.gear(coupling, &offset, false)
                        || self.follow(coupling, &offset, &mut followers)
                        || self.gear(coupling, &offset, true)
                }
                _ => false,
            };
            if !said {
                self.not_said.push(format!(
                    "coupling `{}`: SDF lets a joint follow one other, and no more",
                    coupling.name
                ));
            }
        }
    }

    /// What the sum of the joint variables is that count from the pose drawn in the file.
    fn offset(&self, coupling: &Coupling) -> Number {
        let mut shift = 0.0;
        for term in &coupling.terms {
            shift += term.factor.value() * self.value(term.joint);
        }
        match shift == 0.0 {
            true => coupling.offset.clone(),
            false => rounded(settled(coupling.offset.value() - shift)),
        }
    }

    /// A joint that is held where it is drawn is a fixed one, if nothing else is said of it.
    fn hold(&mut self, coupling: &Coupling, joint: JointId, offset: &Number) -> bool {
        let mechanism = self.mechanism;
        let speaks = |other: &&Coupling| other.terms.iter().any(|term| term.joint == joint);
        let spoken_of = mechanism.couplings().iter().filter(speaks).count();
        if !offset.is_zero() || spoken_of != 1 || mechanism.actuated().contains(&joint) {
            return false;
        }
        self.held.insert(joint);
        self.not_said.push(format!(
            "that `{}` moves but for coupling `{}`, which holds it: it is written as a fixed joint",
            mechanism.joint(joint).name,
            coupling.name
        ));
        true
    }

    fn follow(&mut self, coupling: &Coupling, offset: &Number, followers: &mut Followers) -> bool {
        let found = followers.take(&coupling.terms, offset);
        let Some(found) = found else {
            return false;
        };
        self.followers.insert(found.follower, found);
        true
    }

    /// A gearbox, where a coupling is one; of what the file says as a joint that follows, and of links on the world itself, only `anyhow`.
    fn gear(&mut self, coupling: &Coupling, offset: &Number, anyhow: bool) -> bool {
        let Some(mut gear) = self.gear_of(coupling).filter(|_| offset.is_zero()) else {
            return false;
        };
        let on_world = self.is_world && gear.reference == self.mechanism.ground();
        let is_mimic = matches!(coupling.origin, CouplingOrigin::Mimic { .. });
        if !anyhow && (on_world || is_mimic) {
            return false;
        }
        gear.name = self.unused(&gear.name);
        self.gears.push(gear);
        true
    }

    /// Two hinges between one link and two others, each the only one between its links.
    fn gear_of(&self, coupling: &Coupling) -> Option<Gear> {
        let mechanism = self.mechanism;
        let [first, second] = coupling.terms.as_slice() else {
            return None;
        };
        let links = |id: JointId| {
            let joint = mechanism.joint(id);
            [joint.predecessor.link, joint.successor.link]
        };
        let bears = |id: JointId| {
            let [a, b] = links(id);
            let between = |joint: &JointId| {
                let ends = links(*joint);
                mechanism.joint(*joint).kind == JointKind::Revolute
                    && ends.contains(&a)
                    && ends.contains(&b)
            };
            let all = (0..mechanism.joints().len()).map(JointId);
            mechanism.joint(id).kind == JointKind::Revolute && all.filter(between).count() == 1
        };
        if !(bears(first.joint) && bears(second.joint)) {
            return None;
        }
        let others = links(second.joint);
        let reference = links(first.joint)
            .into_iter()
            .find(|link| others.contains(link))?;
        let side = |id: JointId| {
            let joint = mechanism.joint(id);
            let axis = &joint.axis.0;
            match joint.predecessor.link == reference {
                true => (joint.successor.link, id, axis.clone()),
                false => (joint.predecessor.link, id, axis.each_ref().map(|x| -x)),
            }
        };
        let (mut parent, mut child) = (first, second);
        // The world is nobody's child.
        if self.is_world && side(child.joint).0 == mechanism.ground() {
            std::mem::swap(&mut parent, &mut child);
        }
        Some(Gear {
            name: allowed(&coupling.name),
            sides: [side(parent.joint), side(child.joint)],
            reference,
            ratio: parent.factor.checked_div(&child.factor).ok()?,
        })
    }

    /// Writes the gearboxes.
    pub(super) fn gearboxes(&mut self) {
        for gear in std::mem::take(&mut self.gears) {
            let [parent, child] = &gear.sides;
            let name = |link: LinkId| escaped(self.body(link)).into_owned();
            let mut lines = vec![
                format!("<joint name=\"{}\" type=\"gearbox\">", escaped(&gear.name)),
                format!("  <parent>{}</parent>", name(parent.0)),
                format!("  <child>{}</child>", name(child.0)),
                format!(
                    "  <gearbox_reference_body>{}</gearbox_reference_body>",
                    name(gear.reference)
                ),
                format!("  {}", holding("gearbox_ratio", &gear.ratio)),
            ];
            for (element, (_, hinge, axis)) in ["axis", "axis2"].into_iter().zip(&gear.sides) {
                let hinge = escaped(&self.joints[hinge.0]).into_owned();
                lines.push(format!(
                    "  <{element}><xyz expressed_in=\"{hinge}\">{}</xyz></{element}>",
                    texts(axis)
                ));
            }
            lines.push("</joint>".to_owned());
            for one in &lines {
                line(&mut self.between, 2, one);
            }
        }
    }
}
