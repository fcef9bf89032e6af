//! The bodies of a mechanism as a tree that begins at the ground, each with its place in the one before it.

use super::parts::{Motion, Part, parts};
use super::place::{Place, is_identity};
use kutzbach_closure::{Geometry, Rigid};
use kutzbach_model::mechanism::{JointId, JointKind, LinkId, Mechanism, Placement};

/// A link and how it hangs in the tree.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) link: LinkId,
    /// 1 for what hangs at the ground.
    pub(super) depth: usize,
    /// Where it is in the link before it, as drawn.
    pub(super) place: Place,
    pub(super) joined: Joined,
}

/// What a link hangs by.
#[derive(Clone, Debug)]
pub(super) enum Joined {
    /// Nothing: it floats in the world. The name of the file's joint that says so.
    Floating(String),
    /// A joint, from its predecessor or, backwards, from its successor.
    By { joint: JointId, forward: bool },
}

struct Walk<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    /// Tree joints at every link.
    around: Vec<Vec<JointId>>,
    reached: Vec<bool>,
    /// Links still to be told, the next one on top.
    open: Vec<Step>,
    steps: Vec<Step>,
}

/// All links but the ground, each after the one it hangs at and together with all that hangs at it.
pub(super) fn steps(mechanism: &Mechanism, geometry: &Geometry<f64>) -> Vec<Step> {
    let mut around = vec![Vec::new(); mechanism.links().len()];
    for (index, joint) in mechanism.joints().iter().enumerate() {
        if !joint.closes_loop {
            around[joint.predecessor.link.0].push(JointId(index));
            around[joint.successor.link.0].push(JointId(index));
        }
    }
    let ground = mechanism.ground();
    let mut walk = Walk {
        mechanism,
        geometry,
        around,
        reached: vec![false; mechanism.links().len()],
        open: Vec::new(),
        steps: Vec::new(),
    };
    walk.reached[ground.0] = true;
    walk.behind(ground, 0);
    walk.all();
    for &link in mechanism.placement_order() {
        if !walk.reached[link.0] {
            walk.reached[link.0] = true;
            let floating = walk.floating(link);
            walk.open.push(floating);
            walk.all();
        }
    }
    walk.steps
}

impl Walk<'_> {
    fn all(&mut self) {
        while let Some(step) = self.open.pop() {
            let (link, depth) = (step.link, step.depth);
            self.steps.push(step);
            self.behind(link, depth);
        }
    }

    /// Keeps what hangs at a link, the first on top.
    fn behind(&mut self, link: LinkId, depth: usize) {
        let joints = std::mem::take(&mut self.around[link.0]);
        for id in joints.into_iter().rev() {
            let joint = self.mechanism.joint(id);
            let forward = joint.predecessor.link == link;
            let next = match forward {
                true => joint.successor.link,
                false => joint.predecessor.link,
            };
            if self.reached[next.0] {
                continue;
            }
            self.reached[next.0] = true;
            let place = place(self.mechanism, self.geometry, id, forward);
            self.open.push(Step {
                link: next,
                depth: depth + 1,
                place,
                joined: Joined::By { joint: id, forward },
            });
        }
    }

    fn floating(&self, link: LinkId) -> Step {
        let ground = self.mechanism.ground();
        let from_ground = || {
            let home = &self.geometry.home;
            Place::Computed(home[ground.0].inverse().compose(&home[link.0]))
        };
        let known = self.mechanism.link(link);
        let (name, place) = match &known.placement {
            Placement::Floating {
                name,
                parent,
                origin,
            } if *parent == ground => (name.clone(), Place::Stated(origin.clone())),
            Placement::Floating { name, .. } => (name.clone(), from_ground()),
            _ => (format!("{}_free", known.name), from_ground()),
        };
        Step {
            link,
            depth: 1,
            place,
            joined: Joined::Floating(name),
        }
    }
}

/// The displacement of a tree joint as drawn; `None` where its two frames coincide, as those of all kinds but two.
pub(super) fn drawn(geometry: &Geometry<f64>, kind: JointKind, id: JointId) -> Option<Rigid<f64>> {
    if !matches!(kind, JointKind::LineOnPlane | JointKind::Distance) {
        return None;
    }
    let displacement = &geometry.displacements[id.0];
    let drawn = displacement.displacement(&displacement.home());
    (!is_identity(&drawn)).then_some(drawn)
}

/// Where the link behind a tree joint is in the one before it.
fn place(mechanism: &Mechanism, geometry: &Geometry<f64>, id: JointId, forward: bool) -> Place {
    let joint = mechanism.joint(id);
    let (first, second) = match forward {
        true => (&joint.predecessor.frame, &joint.successor.frame),
        false => (&joint.successor.frame, &joint.predecessor.frame),
    };
    let standing = drawn(geometry, joint.kind, id);
    if standing.is_none() && second.is_identity() {
        return Place::Stated(first.clone());
    }
    let [predecessor, successor] = &geometry.sides[id.0];
    let from = match &standing {
        Some(standing) => predecessor.compose(standing),
        None => predecessor.clone(),
    };
    let whole = from.compose(&successor.inverse());
    Place::Computed(match forward {
        true => whole,
        false => whole.inverse(),
    })
}

/// The parts of a tree joint in the frame of the link behind it.
pub(super) fn parts_of(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    id: JointId,
    forward: bool,
) -> Vec<Part> {
    let joint = mechanism.joint(id);
    let standing = drawn(geometry, joint.kind, id);
    let mut own = parts(joint, standing.as_ref());
    let [predecessor, successor] = &geometry.sides[id.0];
    if forward {
        return own.iter().map(|part| part.moved(successor)).collect();
    }
    let from = match &standing {
        Some(standing) => predecessor.compose(standing),
        None => predecessor.clone(),
    };
    if joint.kind == JointKind::Distance {
        turn_at_the_other_end(&mut own);
        return own.iter().map(|part| part.moved(&from)).collect();
    }
    let seen = own.iter().rev().map(|part| part.moved(&from).reversed());
    seen.collect()
}

/// Exchanges the ends of a rod: MuJoCo lets nothing turn behind a ball in one body.
fn turn_at_the_other_end(rod: &mut [Part]) {
    let (Some(first), Some(last)) = (rod.first(), rod.last()) else {
        return;
    };
    let (start, end) = (first.point.clone(), last.point.clone());
    for part in rod {
        part.point = match part.motion {
            Motion::Ball => start.clone(),
            Motion::Turn | Motion::Slide => end.clone(),
        };
    }
}
