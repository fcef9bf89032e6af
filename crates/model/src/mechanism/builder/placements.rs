//! Where the links are at home: the tree that tree joints and floating joints make.

use super::checks::check_frame;
use super::names::Names;
use crate::mechanism::{Entity, Frame, Joint, JointId, Link, LinkId, MechanismError, Placement};
use std::collections::VecDeque;

/// A floating joint as its maker describes it.
#[derive(Clone, Debug)]
pub(super) struct FloatingSpec {
    pub(super) name: String,
    pub(super) parent: String,
    pub(super) child: String,
    /// `parent_from_child` at home.
    pub(super) origin: Frame,
}

/// How each link is placed, while joints are being read; by link index.
#[derive(Debug)]
pub(super) struct Placements(Vec<Option<Placement>>);

impl Placements {
    /// Nothing is placed yet.
    pub(super) fn new(links: usize) -> Self {
        Self(vec![None; links])
    }

    /// Places a link by a joint; `false` where it is placed already, so that the joint closes a loop.
    pub(super) fn place_by_joint(&mut self, child: LinkId, joint: JointId) -> bool {
        let placement = &mut self.0[child.0];
        let free = placement.is_none();
        if free {
            *placement = Some(Placement::Joint(joint));
        }
        free
    }

    /// Places a link by a floating joint.
    pub(super) fn place_by_floating(
        &mut self,
        spec: FloatingSpec,
        names: &mut Names,
    ) -> Result<(), MechanismError> {
        names.add_floating(&spec.name)?;
        let entity = Entity::Joint(spec.name.clone());
        let parent = names.link(&entity, &spec.parent)?;
        let child = names.link(&entity, &spec.child)?;
        if parent == child {
            return Err(MechanismError::new(
                entity,
                "parent and child are the same link",
            ));
        }
        if self.0[child.0].is_some() {
            return Err(MechanismError::new(
                entity,
                format!("link `{}` is placed by another joint already", spec.child),
            )
            .help("a floating joint only places its child at home; remove one of the two"));
        }
        check_frame(&entity, &spec.origin)?;
        self.0[child.0] = Some(Placement::Floating {
            name: spec.name,
            parent,
            origin: spec.origin,
        });
        Ok(())
    }

    /// Gives every link its placement and returns an order, the root first, in which every link follows the one it is
    /// placed by.
    pub(super) fn settle(
        self,
        links: &mut [Link],
        joints: &[Joint],
    ) -> Result<Vec<LinkId>, MechanismError> {
        for (link, placement) in links.iter_mut().zip(self.0) {
            link.placement = placement.unwrap_or(Placement::World);
        }
        let mut children: Vec<Vec<LinkId>> = vec![Vec::new(); links.len()];
        let mut roots = Vec::new();
        for (index, link) in links.iter().enumerate() {
            match placed_by(link, joints) {
                None => roots.push(LinkId(index)),
                Some(parent) => children[parent.0].push(LinkId(index)),
            }
        }
        let fault = |link: &Link, problem: String, help: &str| {
            Err(MechanismError::new(Entity::Link(link.name.clone()), problem).help(help))
        };
        const CIRCLE: &str = "write the joint that closes the circle as a <loop>";
        let root = match roots.as_slice() {
            [root] => *root,
            [] => {
                return fault(
                    &links[0],
                    "every link is the child of another: the tree joints run in a circle and nothing is at the root"
                        .to_owned(),
                    CIRCLE,
                );
            }
            [root, second, ..] => {
                return fault(
                    &links[second.0],
                    format!(
                        "nothing connects it to `{}`: no joint has it as its child, so its home pose is unknown",
                        links[root.0].name
                    ),
                    "add a <joint> with this link as <child>; type=\"floating\" places it without constraining it",
                );
            }
        };
        let mut order = Vec::with_capacity(links.len());
        let mut reached = vec![false; links.len()];
        let mut queue = VecDeque::from([root]);
        while let Some(link) = queue.pop_front() {
            order.push(link);
            reached[link.0] = true;
            queue.extend(&children[link.0]);
        }
        match reached.iter().position(|reached| !reached) {
            None => Ok(order),
            Some(lost) => fault(
                &links[lost],
                format!(
                    "it is not connected to the root `{}`: its tree joints run in a circle",
                    links[root.0].name
                ),
                CIRCLE,
            ),
        }
    }
}

/// The link that a link's home pose refers to; `None` for the root.
pub(super) fn placed_by(link: &Link, joints: &[Joint]) -> Option<LinkId> {
    match &link.placement {
        Placement::World => None,
        Placement::Joint(joint) => Some(joints[joint.0].predecessor.link),
        Placement::Floating { parent, .. } => Some(*parent),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::{far_away, fault, help, hinge, hinges, links};
    use super::*;
    use crate::mechanism::{JointBuilder, JointKind};

    #[test]
    fn a_second_tree_joint_with_the_same_child_closes_a_loop() {
        let mut builder = hinges();
        builder.joint(hinge("ac", "a", "c"));
        let mechanism = builder.build().unwrap();
        let closes: Vec<bool> = mechanism.joints().iter().map(|j| j.closes_loop).collect();
        assert_eq!(closes, [false, false, true]);
        let c = mechanism.link_named("c").unwrap();
        let bc = mechanism.joint_named("bc").unwrap();
        assert_eq!(mechanism.link(c).placement, Placement::Joint(bc));
    }

    #[test]
    fn a_circle_of_tree_joints_has_no_root() {
        let mut builder = hinges();
        builder.joint(hinge("ca", "c", "a"));
        assert_eq!(
            fault(builder.clone()),
            "link `a`: every link is the child of another: the tree joints run in a circle and nothing is at the root"
        );
        assert_eq!(
            help(builder),
            "write the joint that closes the circle as a <loop>"
        );

        // The same circle with the last joint as a loop is a triangle.
        let mut builder = hinges();
        builder.joint(JointBuilder::closing("ca", JointKind::Revolute, "c", "a"));
        assert!(builder.build().unwrap().joints()[2].closes_loop);
    }

    #[test]
    fn a_circle_beside_the_root() {
        // a (root)    b -> c -> b
        let mut builder = links(&["a", "b", "c"]);
        builder.joint(hinge("bc", "b", "c"));
        builder.joint(hinge("cb", "c", "b"));
        assert_eq!(
            fault(builder.clone()),
            "link `b`: it is not connected to the root `a`: its tree joints run in a circle"
        );
        assert_eq!(
            help(builder),
            "write the joint that closes the circle as a <loop>"
        );
    }

    #[test]
    fn a_link_that_nothing_places_is_told() {
        let mut builder = hinges();
        builder.link("d");
        let told = "link `d`: nothing connects it to `a`: no joint has it as its child, so its home pose is unknown";
        assert_eq!(fault(builder.clone()), told);
        // A loop constrains it, but says nothing about where it is.
        builder.joint(JointBuilder::closing("cd", JointKind::Revolute, "c", "d"));
        assert_eq!(fault(builder), told);
    }

    #[test]
    fn a_floating_joint_places_without_being_a_joint() {
        let mut builder = links(&["a", "b"]);
        builder.floating("free", "a", "b", Frame::identity());
        let mechanism = builder.build().unwrap();
        assert!(mechanism.joints().is_empty());
        assert!(mechanism.joint_named("free").is_none());
        let b = mechanism.link_named("b").unwrap();
        assert_eq!(
            mechanism.link(b).placement,
            Placement::Floating {
                name: "free".to_owned(),
                parent: LinkId(0),
                origin: Frame::identity()
            }
        );
    }

    #[test]
    fn what_a_floating_joint_cannot_do() {
        let with = |parent: &str, child: &str, origin: Frame| {
            let mut builder = hinges();
            builder.link("d");
            builder.floating("free", parent, child, origin);
            builder
        };
        for (builder, told) in [
            (
                with("d", "d", Frame::identity()),
                "parent and child are the same link",
            ),
            (
                with("a", "c", Frame::identity()),
                "link `c` is placed by another joint already",
            ),
            (
                with("a", "e", Frame::identity()),
                "there is no link named `e`",
            ),
            (
                with("a", "d", far_away()),
                "origin is 1e200, beyond the largest number accepted, 1e100",
            ),
        ] {
            assert_eq!(fault(builder), format!("joint `free`: {told}"));
        }
        assert_eq!(
            help(with("a", "c", Frame::identity())),
            "a floating joint only places its child at home; remove one of the two"
        );
    }

    #[test]
    fn a_link_placed_by_a_floating_joint_may_close_loops() {
        let mut builder = links(&["a", "b"]);
        builder.floating("free", "a", "b", Frame::identity());
        builder.joint(JointBuilder::closing("ab", JointKind::Spherical, "a", "b"));
        assert_eq!(builder.build().unwrap().freedom(), 3);
    }
}
