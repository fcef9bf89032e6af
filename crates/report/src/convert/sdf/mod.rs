//! SDF, Gazebo's format: links as they are drawn, and joints between any two of them.
//!
//! The joints are a graph, and each is told once, where it is drawn: a loop is a joint like any other, and what it leaves free is zero
//! at the pose drawn. So the file is written at the pose where the loops are closed, which is the one drawn here wherever that is one,
//! and limits count from there. A tree joint stands in the link before it, and the link behind it stands in the joint, so that numbers
//! stay as they were read; axes are in the joint's frame.
//!
//! | file | what it knows |
//! |---|---|
//! | `joints` | joints, and those that SDF has no word for as several with small links between them |
//! | `couplings` | followers, gearboxes, joints that a coupling holds |
//! | `links` | masses and shapes |

mod couplings;
mod joints;
mod links;

use super::Converted;
use super::follow::Follower;
use super::gaps::{Pose, closed};
use super::mjcf::unused;
use super::place::{Place, settled, text, texts};
use super::tree::{Joined, Step, steps};
use couplings::Gear;
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_format::escaped;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{JointId, LinkId, Mechanism};
use std::collections::{BTreeMap, BTreeSet};

/// The first version with followers in `<axis>`, and with threads in metres per turn.
const VERSION: &str = "1.11";

/// SDF's name of what does not move.
const WORLD: &str = "world";

/// The frame of the model, which is that of the world.
const MODEL: &str = "__model__";

/// Why a mechanism is not written in SDF: that draws every joint closed, and no pose is known at which all loops are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("SDF draws every joint closed, and no pose is known at which all loops are")]
pub struct NotClosed;

struct Sdf<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    /// The pose that is drawn in the file.
    pose: Pose,
    /// Names of links and joints, which share one space.
    names: BTreeSet<String>,
    /// Whether the ground is the world itself, and not a link that is fixed to it.
    is_world: bool,
    bodies: Vec<String>,
    joints: Vec<String>,
    /// Joints that a coupling holds where they are drawn.
    held: BTreeSet<JointId>,
    followers: BTreeMap<JointId, Follower>,
    gears: Vec<Gear>,
    motors: Vec<String>,
    not_said: Vec<String>,
    without_mass: usize,
    lost_shapes: usize,
    /// The elements of links and of joints.
    links: String,
    between: String,
}

/// A mechanism as SDF.
///
/// # Errors
/// [`NotClosed`].
pub fn to_sdf(mechanism: &Mechanism) -> Result<Converted, NotClosed> {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let pose = closed(mechanism, &geometry).ok_or(NotClosed)?;
    let mut sdf = Sdf {
        mechanism,
        geometry: &geometry,
        pose,
        names: BTreeSet::new(),
        is_world: is_world(mechanism),
        bodies: Vec::new(),
        joints: Vec::new(),
        held: BTreeSet::new(),
        followers: BTreeMap::new(),
        gears: Vec::new(),
        motors: Vec::new(),
        not_said: Vec::new(),
        without_mass: 0,
        lost_shapes: 0,
        links: String::new(),
        between: String::new(),
    };
    if sdf.pose.moved {
        sdf.not_said.push(
            "the pose drawn, where loops are open: the file draws the closed one, from which limits and couplings count"
                .to_owned(),
        );
    }
    sdf.give_names();
    sdf.couplings();
    sdf.tree(&steps(mechanism, &geometry));
    sdf.closing();
    sdf.gearboxes();
    sdf.beside();
    Ok(sdf.file())
}

/// Whether the ground can be SDF's world: it is called so, nothing is drawn in it, and something is joined to it.
fn is_world(mechanism: &Mechanism) -> bool {
    let ground = mechanism.ground();
    let link = mechanism.link(ground);
    let is_bare = link.inertial.is_none() && link.visuals.is_empty() && link.collisions.is_empty();
    let mut joints = mechanism.joints().iter();
    link.name == WORLD
        && is_bare
        && joints.any(|joint| [joint.predecessor.link, joint.successor.link].contains(&ground))
}

/// A line of XML.
fn line(into: &mut String, depth: usize, line: &str) {
    for _ in 0..depth {
        into.push_str("  ");
    }
    into.push_str(line);
    into.push('\n');
}

/// Six numbers of a `<pose>`.
fn six(place: &Place) -> String {
    let frame = place.frame();
    format!(
        "{} {}",
        texts(&frame.position),
        texts(&frame.roll_pitch_yaw)
    )
}

/// A name as SDF takes it: `::` separates the names of models, and some names are its own.
fn allowed(name: &str) -> String {
    let name = name.trim().replace("::", "_");
    match name.as_str() {
        "" => "unnamed".to_owned(),
        WORLD => "world_link".to_owned(),
        own if own.starts_with("__") && own.ends_with("__") => format!("{own}1"),
        _ => name,
    }
}

impl Sdf<'_> {
    /// A name that no link and no joint has.
    fn unused(&mut self, wanted: &str) -> String {
        unused(&mut self.names, wanted)
    }

    fn give_names(&mut self) {
        let mechanism = self.mechanism;
        for (index, link) in mechanism.links().iter().enumerate() {
            if self.is_world && LinkId(index) == mechanism.ground() {
                self.bodies.push(WORLD.to_owned());
                continue;
            }
            let name = self.unused(&allowed(&link.name));
            self.note_name("link", &link.name, &name);
            self.bodies.push(name);
        }
        for joint in mechanism.joints() {
            let wanted = allowed(&joint.name);
            let wanted = match self.names.contains(&wanted) {
                true => format!("{wanted}_joint"),
                false => wanted,
            };
            let name = self.unused(&wanted);
            self.note_name("joint", &joint.name, &name);
            self.joints.push(name);
        }
    }

    fn note_name(&mut self, what: &str, here: &str, there: &str) {
        if here != there {
            self.not_said.push(format!(
                "the name of {what} `{here}`, which is called `{there}`"
            ));
        }
    }

    /// What `<parent>` and `<child>` call a link.
    fn body(&self, link: LinkId) -> &str {
        self.bodies.get(link.0).map_or(WORLD, String::as_str)
    }

    /// What `relative_to` calls a link's frame.
    fn frame_of(&self, link: LinkId) -> &str {
        match self.is_world && link == self.mechanism.ground() {
            true => MODEL,
            false => self.body(link),
        }
    }

    /// The value of a joint of one freedom at the pose drawn in the file (rad, m).
    fn value(&self, joint: JointId) -> f64 {
        let state = self.pose.states.get(joint.0);
        let value = state.and_then(|state| state.values.first());
        value.map_or(0.0, |value| settled(*value))
    }

    /// All links, with the joints that place them.
    fn tree(&mut self, steps: &[Step]) {
        let ground = self.mechanism.ground();
        if !self.is_world {
            self.link(ground, None);
            let wanted = format!("{}_held", self.body(ground));
            let name = self.unused(&wanted);
            self.fixed_to_world(&name, ground);
        }
        for step in steps {
            let (relative_to, place) = match &step.joined {
                Joined::Floating(_) => (self.frame_of(ground).to_owned(), self.floating(step)),
                Joined::By { joint, forward } => self.joined(*joint, *forward),
            };
            self.link(step.link, Some((relative_to.as_str(), &place)));
        }
    }

    fn floating(&self, step: &Step) -> Place {
        if !self.pose.moved {
            return step.place.clone();
        }
        let links = &self.pose.links;
        let ground = &links[self.mechanism.ground().0];
        Place::Computed(ground.inverse().compose(&links[step.link.0]))
    }

    /// Joints that close loops.
    fn closing(&mut self) {
        let mechanism = self.mechanism;
        let closing = mechanism.joints().iter().enumerate();
        for (index, joint) in closing.filter(|(_, joint)| joint.closes_loop) {
            // The world is nobody's child.
            let backward = self.is_world && joint.successor.link == mechanism.ground();
            let _ = self.joined(JointId(index), !backward);
        }
    }

    /// A motor of a joint of the file.
    fn motor(&mut self, joint: &str) {
        let joint = escaped(joint);
        self.motors.push(format!(
            "<plugin filename=\"gz-sim-apply-joint-force-system\" name=\"gz::sim::systems::ApplyJointForce\"><joint_name>{joint}</joint_name></plugin>"
        ));
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
        if self.lost_shapes > 0 {
            let lost = self.lost_shapes;
            self.not_said.push(format!("shapes without extent: {lost}"));
        }
        if self.without_mass > 0 {
            let count = self.without_mass;
            self.not_said.push(format!(
                "the mass of links, where the file has none: {count} got 0.1 kg, since a link without one weighs 1 kg in SDF"
            ));
        }
    }

    fn file(self) -> Converted {
        let mut file = String::from("<?xml version=\"1.0\"?>\n");
        line(&mut file, 0, &format!("<sdf version=\"{VERSION}\">"));
        let name = allowed(self.mechanism.name());
        line(
            &mut file,
            1,
            &format!("<model name=\"{}\">", escaped(&name)),
        );
        file.push_str(&self.links);
        file.push_str(&self.between);
        for motor in &self.motors {
            line(&mut file, 2, motor);
        }
        line(&mut file, 1, "</model>");
        line(&mut file, 0, "</sdf>");
        Converted {
            text: file,
            not_said: self.not_said,
        }
    }
}

/// An element that holds a number.
fn holding(element: &str, number: &Number) -> String {
    format!("<{element}>{}</{element}>", text(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_sdf_keeps_for_itself_are_changed() {
        for (name, expected) in [
            ("arm", "arm"),
            ("left::arm", "left_arm"),
            ("world", "world_link"),
            ("__model__", "__model__1"),
            (" ", "unnamed"),
        ] {
            assert_eq!(allowed(name), expected);
        }
    }
}
