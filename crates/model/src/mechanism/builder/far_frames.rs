//! Joints that are closed at home between links far from one another in the tree, without a walk along it for each.

use super::home_frames::HomeFrame;
use super::placements::placed_by;
use crate::mechanism::{Frame, FrameTree, Joint, Link, LinkId, Placement};

/// The home poses of links, each in the one that it is placed by.
pub(super) struct FarFrames(FrameTree);

impl FarFrames {
    /// The links of a mechanism; `None` where no two of them are far from one another, or a pose is not finite.
    pub(super) fn new(links: &[Link], joints: &[Joint]) -> Option<Self> {
        let parent = |link| placed_by(link, joints).map(|parent| parent.0);
        let parents = links.iter().map(parent).collect();
        let mut tree = FrameTree::new(parents).ok()?;
        if !tree.has_long_ways() {
            return None;
        }
        let frames: Option<Vec<Frame>> = links.iter().map(|link| in_parent(link, joints)).collect();
        tree.set_frames(frames?, |chain| Frame::between(&[], chain));
        Some(Self(tree))
    }

    /// A joint's frame seen from both sides; `None` where a walk from each is short, or something is not finite.
    pub(super) fn frames(
        &self,
        anchor: LinkId,
        spec: &HomeFrame,
        sides: [LinkId; 2],
    ) -> Option<[Frame; 2]> {
        let root = LinkId(self.0.root(anchor.0)?);
        let is_long = |to: LinkId| sides.iter().any(|side| self.0.is_long(side.0, to.0));
        if !(is_long(anchor) || spec.parallel_to_root && is_long(root)) {
            return None;
        }
        let seen = |from: LinkId, to: LinkId, last: &[&Frame]| {
            let [up, mut down] = self.0.way(from.0, to.0)?;
            down.extend(last);
            Frame::between(&up, &down)
        };
        let side = |link: LinkId| match spec.parallel_to_root {
            // What is given in a side's own frame stays as it was written.
            false if link == anchor => Some(spec.frame.clone()),
            false => seen(link, anchor, &[&spec.frame]),
            true => Some(Frame {
                roll_pitch_yaw: seen(link, root, &[])?.roll_pitch_yaw,
                ..seen(link, anchor, &[&spec.frame])?
            }),
        };
        Some([side(sides[0])?, side(sides[1])?])
    }
}

/// The pose of a link at home, seen from the link it is placed by.
fn in_parent(link: &Link, joints: &[Joint]) -> Option<Frame> {
    match &link.placement {
        Placement::World => Some(Frame::identity()),
        Placement::Floating { origin, .. } => Some(origin.clone()),
        Placement::Joint(joint) => {
            let joint = &joints[joint.0];
            let (before, behind) = (&joint.predecessor.frame, &joint.successor.frame);
            match behind.is_identity() {
                true => Some(before.clone()),
                false => Frame::between(&[], &[before, &Frame::between(&[behind], &[])?]),
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::links;
    use crate::mechanism::{Direction, Frame, JointBuilder, JointKind, Mechanism};
    use kutzbach_math::number::Number;

    /// A chain of hinges, each a metre from the one before and turned by a quarter, and a loop that is closed at home from its end to its
    /// root.
    fn ring(joints: usize, parallel_to_root: bool) -> Mechanism {
        let names: Vec<String> = (0..=joints).map(|i| format!("l{i}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let mut builder = links(&names);
        let mut origin = Frame::at_point([1.0, 0.0, 0.0]).unwrap();
        origin.roll_pitch_yaw[2] = &Number::pi() * &Number::decimal("0.5").unwrap();
        let z = Direction::of([0.0, 0.0, 1.0]).unwrap();
        for (i, pair) in names.windows(2).enumerate() {
            let hinge = JointBuilder::tree(&format!("j{i}"), JointKind::Revolute, pair[0], pair[1]);
            builder.joint(hinge.origin(origin.clone()).axis(z.clone()));
        }
        let place = Frame::at_point([0.0, 0.0, 2.0]).unwrap();
        let closing = JointBuilder::closing("loop", JointKind::Revolute, "l0", names[joints]);
        builder.joint(
            closing
                .at_home(names[joints], place, parallel_to_root)
                .axis(z),
        );
        builder.build().unwrap()
    }

    /// Four quarter turns are a square: what is far along the chain is where what is near is. Ways of 64 frames are walked, of 65 not.
    #[test]
    fn a_long_way_leads_to_where_a_short_one_does() {
        for parallel_to_root in [false, true] {
            for rest in 0..4 {
                let ways = [4, 64, 400].map(|n| ring(n + rest, parallel_to_root));
                let frames = |mechanism: &Mechanism| {
                    let joint = mechanism.joint(mechanism.joint_named("loop").unwrap());
                    [
                        joint.predecessor.frame.clone(),
                        joint.successor.frame.clone(),
                    ]
                };
                let [short, longer @ ..] = ways.each_ref().map(frames);
                for (a, b) in longer.iter().flat_map(|long| short.iter().zip(long)) {
                    let numbers = |frame: &Frame| {
                        let all = frame.position.iter().chain(&frame.roll_pitch_yaw);
                        all.map(Number::value).collect::<Vec<f64>>()
                    };
                    let pairs = numbers(a).into_iter().zip(numbers(b));
                    for (one, other) in pairs {
                        assert!((one - other).abs() < 1e-12, "{a:?} {b:?}");
                    }
                }
            }
        }
    }
}
