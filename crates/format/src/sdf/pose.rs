//! The graph of poses: every link, model, joint and frame is given in another one.

use super::Sdf;
use super::models::Fallback;
use super::names::Thing;
use crate::ReadOptions;
use crate::element::{Attribute, Element};
use crate::error::{Fault, Outcome};
use crate::frames::{is_turned, radians_of, sum};
use crate::gazebo::needed;
use crate::gazebo_links::poses_in_a_circle;
use crate::quaternion::roll_pitch_yaw;
use crate::unread::truth;
use crate::values::exactly;
use crate::words::quoted;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, FrameTree, MechanismBuilder, Placement};
use std::ops::Range;

/// The node of the world.
pub(super) const WORLD: usize = 0;

struct Node {
    /// The node that the frame is given in; the world's own.
    parent: usize,
    frame: Frame,
    range: Range<usize>,
}

/// Frames by their index, each given in another one, and the tree that they make once all are known.
pub(super) struct Graph(Vec<Node>, FrameTree);

impl Graph {
    /// The world alone.
    pub(super) fn new(range: Range<usize>) -> Self {
        let world = Node {
            parent: WORLD,
            frame: Frame::identity(),
            range,
        };
        Self(vec![world], FrameTree::default())
    }

    /// A new node, which coincides with its parent for now.
    pub(super) fn add(&mut self, parent: usize, range: Range<usize>) -> usize {
        self.0.push(Node {
            parent,
            frame: Frame::identity(),
            range,
        });
        self.0.len() - 1
    }

    /// Says where a node is.
    pub(super) fn place(&mut self, node: usize, parent: usize, frame: Frame) {
        if let Some(node) = self.0.get_mut(node) {
            node.parent = parent;
            node.frame = frame;
        }
    }

    /// The tree that the nodes make; where they run in a circle, the nodes of that, each given in the next.
    fn settle(&mut self) -> Result<(), Vec<usize>> {
        let nodes = self.0.iter().enumerate();
        let parents = nodes.map(|(index, node)| (index != WORLD).then_some(node.parent));
        self.1 = FrameTree::new(parents.collect())?;
        Ok(())
    }

    /// Takes the frames for final: from now on nodes can be [seen](Self::seen_from) from one another.
    fn finish(&mut self) {
        let frames = self.0.iter().map(|node| node.frame.clone()).collect();
        let chain = |frames: &[&Frame]| between(Vec::new(), frames.to_vec());
        self.1.set_frames(frames, chain);
    }

    /// Reads decimals as the constants that they are: a frame that is turned by `1.5708` is turned by a right angle before poses are
    /// multiplied, which leaves no digits to see that by.
    fn read_constants(&mut self, precision: Option<f64>) {
        let mut builder = MechanismBuilder::new("poses");
        for node in 0..self.0.len() {
            builder.link(&node.to_string());
        }
        for (index, node) in self.0.iter().enumerate().skip(1) {
            let (parent, own) = (node.parent.to_string(), index.to_string());
            builder.floating(&format!("to {own}"), &parent, &own, node.frame.clone());
        }
        // What cannot be built is told where the mechanism itself is.
        let Ok(mechanism) = builder.build() else {
            return;
        };
        let mechanism = mechanism.with_constants_known_to(precision);
        for (node, link) in self.0.iter_mut().zip(mechanism.links()) {
            if let Placement::Floating { origin, .. } = &link.placement {
                node.frame = origin.clone();
            }
        }
    }

    /// The frames from one node down to another one below it; `None` where it is not below.
    fn chain(&self, from: usize, to: usize) -> Option<Vec<&Frame>> {
        let (mut frames, mut at) = (Vec::new(), to);
        while at != from {
            if at == WORLD {
                return None;
            }
            let node = self.0.get(at)?;
            frames.push(&node.frame);
            at = node.parent;
        }
        frames.reverse();
        Some(frames)
    }

    /// A node seen from another one; `None` where that is not finite. What was added since the end is walked to what was there.
    pub(super) fn seen_from(&self, from: usize, to: usize) -> Option<Frame> {
        let mut added = [Vec::new(), Vec::new()];
        let mut ends = [from, to];
        for (frames, end) in added.iter_mut().zip(&mut ends) {
            while *end >= self.1.len() && *end != WORLD {
                let node = self.0.get(*end)?;
                frames.push(&node.frame);
                *end = node.parent;
            }
        }
        let [mut up, mut down] = self.1.way(ends[0], ends[1])?;
        let [of_from, of_to] = added;
        up.extend(of_from.into_iter().rev());
        down.extend(of_to.into_iter().rev());
        between(up, down)
    }
}

/// The end of one chain of frames seen from the end of another one. Numbers to which nothing is added keep their digits.
fn between(mut up: Vec<&Frame>, mut down: Vec<&Frame>) -> Option<Frame> {
    up.retain(|frame| !frame.is_identity());
    down.retain(|frame| !frame.is_identity());
    let (last, others) = match down.split_last() {
        Some((last, others)) => (Some(*last), others),
        None => (None, &down[..]),
    };
    let straight = |frames: &[&Frame]| !frames.iter().any(|frame| is_turned(frame));
    if !(straight(&up) && straight(others)) {
        return Frame::between(&up, &down);
    }
    let mut found = last.cloned().unwrap_or_else(Frame::identity);
    let mut add = |frame: &Frame, forth: bool| {
        for (total, share) in found.position.iter_mut().zip(&frame.position) {
            let share = if forth { share.clone() } else { -share };
            *total = sum(total, &share);
        }
    };
    others.iter().for_each(|frame| add(frame, true));
    up.iter().for_each(|frame| add(frame, false));
    Some(found)
}

/// What a `<pose>` says.
pub(super) struct Pose<'a> {
    pub(super) frame: Frame,
    pub(super) relative_to: Option<Attribute<'a>>,
}

/// The pose of an element; without one it is where it would be anyway.
pub(super) fn pose_of<'a>(element: Element<'a>) -> Outcome<Pose<'a>> {
    let mut pose = Pose {
        frame: Frame::identity(),
        relative_to: None,
    };
    let Some(part) = super::only(element, "pose")? else {
        return Ok(pose);
    };
    let reference = part
        .attribute("relative_to")
        .or_else(|| part.attribute("frame"));
    pose.relative_to = reference.filter(|name| !name.value.trim().is_empty());
    if part.stray_text().is_none() {
        return Ok(pose);
    }
    let value = needed(part)?;
    let in_degrees = part.attribute("degrees").map(truth).transpose()?;
    let format = part.attribute("rotation_format");
    match format.map_or("euler_rpy", |format| format.value) {
        "quat_xyzw" => {
            let [x, y, z, a, b, c, d]: [Number; 7] = exactly(value)?;
            pose.frame.position = [x, y, z];
            pose.frame.roll_pitch_yaw = roll_pitch_yaw(&[a, b, c, d])
                .ok_or_else(|| value.fault("the zero quaternion is no rotation"))?;
        }
        "euler_rpy" => {
            let [x, y, z, roll, pitch, yaw]: [Number; 6] = exactly(value)?;
            pose.frame.position = [x, y, z];
            let angles = [roll, pitch, yaw];
            pose.frame.roll_pitch_yaw = match in_degrees {
                Some(true) => angles.each_ref().map(radians_of),
                _ => angles,
            };
        }
        other => {
            let message = format!("there is no format of rotations {}", quoted(other));
            let at = format.map_or_else(|| part.range(), |format| format.range());
            return Err(Fault::new(at, message).help("`euler_rpy` or `quat_xyzw`"));
        }
    }
    Ok(pose)
}

impl<'a> Sdf<'a> {
    /// Finds where everything is.
    pub(super) fn place(&mut self, options: &ReadOptions) -> Outcome<()> {
        for pending in std::mem::take(&mut self.pending) {
            let pose = pose_of(pending.element)?;
            let named = match pose.relative_to {
                Some(name) => self
                    .reference(pending.scope, name)
                    .map_err(|fault| match pending.element.name() {
                        "model" => fault.help(
                            "a model is placed in what stands beside it, not in what it holds",
                        ),
                        _ => fault,
                    })?,
                None => None,
            };
            let parent = match (named, pending.fallback) {
                (Some(thing), _) => thing,
                (None, Fallback::Model) => self.model(pending.scope),
                (None, Fallback::Attached(frame)) => self.attached_to(frame)?,
                (None, Fallback::Child(joint)) => self.side(joint, "child")?.0,
            };
            let parent = self.node_of(parent);
            self.graph.place(pending.node, parent, pose.frame);
        }
        if let Err(circle) = self.graph.settle() {
            return Err(self.circle_of_poses(&circle));
        }
        if !options.literal {
            self.graph.read_constants(options.precision);
        }
        self.place_by_frames()?;
        self.graph.finish();
        Ok(())
    }

    fn circle_of_poses(&self, circle: &[usize]) -> Fault {
        let things = self.things();
        let named = circle.iter().filter_map(|node| things.get(node));
        let names: Vec<&str> = named.map(|thing| self.called(*thing)).collect();
        let first = circle.first().and_then(|node| self.graph.0.get(*node));
        let range = first.map_or(0..0, |node| node.range.clone());
        poses_in_a_circle(range, &names)
    }

    /// What a pose is given in. The attribute was called `frame` in versions 1.5 and 1.6, where programs did not heed it: there a name that
    /// nothing has says nothing.
    pub(super) fn reference(
        &mut self,
        scope: usize,
        name: Attribute<'a>,
    ) -> Outcome<Option<Thing>> {
        let found = self.find(scope, name.value.trim());
        if found.is_none() && self.version < (1, 7) {
            let what = "`frame` of <pose> that names nothing".to_owned();
            self.unread.text(name.range().start, what);
            return Ok(None);
        }
        self.look_up(scope, name).map(Some)
    }

    /// `placement_frame`: the model's pose is that of one of its frames. Inner models first, since a frame may be in one.
    fn place_by_frames(&mut self) -> Outcome<()> {
        for scope in (0..self.scopes.len()).rev() {
            let (node, name) = match self.scopes.get(scope) {
                Some(model) => (model.node, model.placement),
                None => continue,
            };
            let Some(name) = name else { continue };
            let at = self.node_of(self.look_up(scope, name)?);
            let back = self
                .graph
                .chain(node, at)
                .map(|down| between(down, Vec::new()));
            let Some(back) = back else {
                return Err(name.fault(format!("{} is no frame of this model", quoted(name.value))));
            };
            let back = back.ok_or_else(|| name.fault("its place is not finite"))?;
            let outer = self.graph.0.get(node).map_or(WORLD, |node| node.parent);
            self.graph.place(node, outer, back);
        }
        Ok(())
    }
}
