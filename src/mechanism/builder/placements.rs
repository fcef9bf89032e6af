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
