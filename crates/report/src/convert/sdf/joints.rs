//! Joints: where they stand, their axes, limits and friction.

use super::super::parts::{Motion, Part, names, parts};
use super::super::place::{Place, Triple, is_identity, rounded, texts, triple, values};
use super::{Sdf, WORLD, holding, line, six};
use kutzbach_closure::Rigid;
use kutzbach_format::escaped;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, Joint, JointId, JointKind, LinkId};

/// No limit: what SDF's older versions take for none, and newer ones too.
const ENDLESS: &str = "1e16";

/// Axes are at right angles up to this cosine: some thousand roundings.
const RIGHT_ANGLE: f64 = 1e-12;

/// The type of a screw.
const SCREW: &str = "screw";

/// A joint of the file.
struct Written {
    name: String,
    word: &'static str,
    /// Parent and child.
    sides: [String; 2],
    /// Where it stands, and in which frame that is told.
    at: (String, Place),
    axes: Vec<Triple>,
    /// Of a screw, metres per turn, right-handed.
    lead: Option<Number>,
    /// The joint here whose variable it is, where that is one of one freedom.
    variable: Option<JointId>,
}

impl Sdf<'_> {
    /// Writes a joint, from the predecessor or, backwards, from the successor; where the link behind it is, and in which frame.
    pub(super) fn joined(&mut self, id: JointId, forward: bool) -> (String, Place) {
        let mechanism = self.mechanism;
        let joint = mechanism.joint(id);
        if joint.freedom() != 1 && joint.dynamics.is_some() {
            self.not_said
                .push(format!("damping and friction of `{}`", joint.name));
        }
        let kind = match self.held.contains(&id) {
            true => JointKind::Fixed,
            false => joint.kind,
        };
        let displacement = &self.geometry.displacements[id.0];
        let standing = displacement.displacement(&self.pose.states[id.0]);
        let standing = (!is_identity(&standing)).then_some(standing);
        let driven = mechanism.actuated().contains(&id);
        match self.simple(joint, kind, standing.as_ref(), forward) {
            Some((word, axes)) => {
                let found = self.alone(id, (word, axes), standing.as_ref(), forward);
                if driven && joint.freedom() == 1 {
                    let name = self.joints[id.0].clone();
                    self.motor(&name);
                } else if driven {
                    self.not_said.push(format!("the motor of `{}`", joint.name));
                }
                found
            }
            None => self.chain(id, standing.as_ref(), forward, driven),
        }
    }

    /// The type of a joint that SDF has a word for, and its axes in the joint's frame on the side that comes first. That frame is
    /// turned as the other side's is, but for what the joint has turned.
    fn simple(
        &self,
        joint: &Joint,
        kind: JointKind,
        standing: Option<&Rigid<f64>>,
        forward: bool,
    ) -> Option<(&'static str, Vec<Triple>)> {
        let along = match forward {
            true => joint.axis.0.clone(),
            false => negative(&joint.axis.0),
        };
        Some(match kind {
            JointKind::Fixed => ("fixed", Vec::new()),
            JointKind::Revolute if joint.bounds().is_none() => ("continuous", vec![along]),
            JointKind::Revolute => ("revolute", vec![along]),
            JointKind::Prismatic => ("prismatic", vec![along]),
            JointKind::Screw => (SCREW, vec![along]),
            JointKind::Spherical => ("ball", Vec::new()),
            JointKind::Universal => {
                let (first, second) = (&joint.axis.0, &joint.axis2.0);
                let axes = match (standing, forward) {
                    (None, true) => [first.clone(), second.clone()],
                    (Some(pose), true) => [first.clone(), triple(pose.rotate(&values(second)))],
                    (None, false) => [negative(second), negative(first)],
                    (Some(pose), false) => {
                        let first = triple(pose.rotate_back(&values(first)));
                        [negative(second), negative(&first)]
                    }
                };
                let word = match is_right_angle(&axes) {
                    true => "universal",
                    false => "revolute2",
                };
                (word, axes.to_vec())
            }
            _ => return None,
        })
    }

    /// A joint as one.
    fn alone(
        &mut self,
        id: JointId,
        (word, axes): (&'static str, Vec<Triple>),
        standing: Option<&Rigid<f64>>,
        forward: bool,
    ) -> (String, Place) {
        let mechanism = self.mechanism;
        let joint = mechanism.joint(id);
        let [first, second] = ends(joint, forward);
        let name = self.joints[id.0].clone();
        let written = Written {
            name: name.clone(),
            word,
            sides: [first.0, second.0].map(|link| self.body(link).to_owned()),
            at: (
                self.frame_of(first.0).to_owned(),
                Place::Stated(first.1.clone()),
            ),
            axes,
            lead: joint.lead.clone().filter(|_| word == SCREW),
            variable: (joint.freedom() == 1).then_some(id),
        };
        self.write(&written);
        // Behind the joint comes what it has moved, and then the other link.
        let moved = match (standing, forward) {
            (None, _) => here(),
            (Some(pose), true) => Place::Computed(pose.clone()),
            (Some(pose), false) => Place::Computed(pose.inverse()),
        };
        let back = Place::Stated(second.1.clone()).inverse();
        (name, moved.then(back))
    }

    /// A joint as several in series, with small links between them, all of which stand where the joint's frame on the successor is.
    fn chain(
        &mut self,
        id: JointId,
        standing: Option<&Rigid<f64>>,
        forward: bool,
        driven: bool,
    ) -> (String, Place) {
        let mechanism = self.mechanism;
        let joint = mechanism.joint(id);
        let [first, second] = ends(joint, forward);
        let own = parts(joint, standing);
        let threaded = own.iter().any(|part| part.of_screw);
        let mut pieces: Vec<Part> = own.into_iter().filter(|part| !part.of_screw).collect();
        if !forward {
            pieces = pieces.iter().rev().map(Part::reversed).collect();
        }
        let moved = standing.cloned().map_or_else(here, Place::Computed);
        let start = Place::Stated(joint.predecessor.frame.clone()).then(moved);
        let (mut place, end) = match forward {
            true => (start, Place::Stated(second.1.clone()).inverse()),
            false => (Place::Stated(first.1.clone()), start.inverse()),
        };
        let mut frame = self.frame_of(first.0).to_owned();
        let mut body = self.body(first.0).to_owned();
        let names = self.names_of(id, &pieces);
        for (index, (part, name)) in pieces.iter().zip(names).enumerate() {
            let last = index + 1 == pieces.len();
            let to = match last {
                true => self.body(second.0).to_owned(),
                false => {
                    let link = self.unused(&format!("{name}_link"));
                    self.small_link(&link, &frame, &place);
                    link
                }
            };
            let (word, axes) = word_of(part, threaded);
            let point = Place::Stated(Frame::at(part.point.clone()));
            if driven {
                self.motor_of(joint, part, &name);
            }
            let written = Written {
                name,
                word,
                sides: [body, to.clone()],
                at: (frame.clone(), place.clone().then(point)),
                axes,
                lead: joint.lead.clone().filter(|_| word == SCREW),
                variable: None,
            };
            self.write(&written);
            if !last {
                frame.clone_from(&to);
                place = here();
            }
            body = to;
        }
        (frame, place.then(end))
    }

    /// Names for the joints in series.
    fn names_of(&mut self, id: JointId, pieces: &[Part]) -> Vec<String> {
        let own = self.joints[id.0].clone();
        let wanted = names(&own, pieces).into_iter();
        let name = |name: String| match name == own {
            true => name,
            false => self.unused(&name),
        };
        wanted.map(name).collect()
    }

    fn motor_of(&mut self, joint: &Joint, part: &Part, name: &str) {
        if part.motion == Motion::Ball {
            self.not_said.push(format!(
                "the motor of `{}`, which turns about a point",
                joint.name
            ));
        } else {
            self.motor(name);
        }
    }

    /// Fixes a link to the world where it is drawn.
    pub(super) fn fixed_to_world(&mut self, name: &str, link: LinkId) {
        let (name, link) = (escaped(name), escaped(self.body(link)).into_owned());
        let lines = [
            format!("<joint name=\"{name}\" type=\"fixed\">"),
            format!("  <parent>{WORLD}</parent>"),
            format!("  <child>{link}</child>"),
            "</joint>".to_owned(),
        ];
        for one in lines {
            line(&mut self.between, 2, &one);
        }
    }

    fn write(&mut self, joint: &Written) {
        let [name, parent, child, frame] =
            [&joint.name, &joint.sides[0], &joint.sides[1], &joint.at.0].map(|name| escaped(name));
        let mut lines = vec![
            format!("<joint name=\"{name}\" type=\"{}\">", joint.word),
            format!(
                "  <pose relative_to=\"{frame}\">{}</pose>",
                six(&joint.at.1)
            ),
            format!("  <parent>{parent}</parent>"),
            format!("  <child>{child}</child>"),
        ];
        for (element, axis) in ["axis", "axis2"].into_iter().zip(&joint.axes) {
            lines.push(format!("  <{element}>"));
            lines.push(format!("    <xyz>{}</xyz>", texts(axis)));
            lines.extend(self.limits(joint.variable));
            lines.push(format!("  </{element}>"));
        }
        if let Some(lead) = &joint.lead {
            lines.push(format!("  {}", holding("screw_thread_pitch", lead)));
        }
        lines.push("</joint>".to_owned());
        for one in &lines {
            line(&mut self.between, 2, one);
        }
    }

    /// What an axis holds besides its direction.
    fn limits(&self, variable: Option<JointId>) -> Vec<String> {
        let joint = variable.map(|id| self.mechanism.joint(id));
        let limit = joint.and_then(|joint| joint.limit.as_ref());
        let value = variable.map_or(0.0, |id| self.value(id));
        let bound = |element: &str, bound: Option<&Number>, sign: &str| match bound {
            None => format!("<{element}>{sign}{ENDLESS}</{element}>"),
            Some(bound) if value == 0.0 => holding(element, bound),
            Some(bound) => holding(element, &rounded(bound.value() - value)),
        };
        let mut lines = vec![
            "    <limit>".to_owned(),
            format!(
                "      {}",
                bound("lower", limit.and_then(|limit| limit.lower.as_ref()), "-")
            ),
            format!(
                "      {}",
                bound("upper", limit.and_then(|limit| limit.upper.as_ref()), "")
            ),
        ];
        let stated = |element: &str, number: Option<&Number>| {
            number.map(|number| format!("      {}", holding(element, number)))
        };
        lines.extend(limit.and_then(|limit| stated("effort", limit.effort.as_ref())));
        lines.extend(limit.and_then(|limit| stated("velocity", limit.velocity.as_ref())));
        lines.push("    </limit>".to_owned());
        if let Some(dynamics) = joint.and_then(|joint| joint.dynamics.as_ref()) {
            lines.push("    <dynamics>".to_owned());
            lines.extend(stated("damping", dynamics.damping.as_ref()));
            lines.extend(stated("friction", dynamics.friction.as_ref()));
            lines.push("    </dynamics>".to_owned());
        }
        if let Some(found) = variable.and_then(|id| self.followers.get(&id)) {
            let leader = escaped(&self.joints[found.leader.0]).into_owned();
            lines.push(format!("    <mimic joint=\"{leader}\" axis=\"axis\">"));
            for (element, number) in [
                ("multiplier", &found.multiplier),
                ("offset", &found.offset),
                ("reference", &Number::zero()),
            ] {
                lines.push(format!("      {}", holding(element, number)));
            }
            lines.push("    </mimic>".to_owned());
        }
        lines
    }
}

/// The place that everything is in.
fn here() -> Place {
    Place::Stated(Frame::identity())
}

/// The links of a joint and its frames in them, the one that comes first in the file first.
fn ends(joint: &Joint, forward: bool) -> [(LinkId, &Frame); 2] {
    let [first, second] = match forward {
        true => [&joint.predecessor, &joint.successor],
        false => [&joint.successor, &joint.predecessor],
    };
    [(first.link, &first.frame), (second.link, &second.frame)]
}

fn negative(axis: &Triple) -> Triple {
    axis.each_ref().map(|x| -x)
}

fn is_right_angle([a, b]: &[Triple; 2]) -> bool {
    let (a, b) = (values(a), values(b));
    let dot = |a: &[f64; 3], b: &[f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    dot(&a, &b).abs() <= RIGHT_ANGLE * (dot(&a, &a) * dot(&b, &b)).sqrt()
}

/// The type of a part of a joint, and its axis.
fn word_of(part: &Part, threaded: bool) -> (&'static str, Vec<Triple>) {
    let word = match part.motion {
        Motion::Ball => return ("ball", Vec::new()),
        Motion::Slide => "prismatic",
        Motion::Turn if threaded => SCREW,
        Motion::Turn => "continuous",
    };
    (word, vec![part.axis.clone()])
}
