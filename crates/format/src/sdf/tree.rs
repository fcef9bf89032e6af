//! What places the links and what is held: a spanning tree of the joints from the ground on, and links that float where the joints do not
//! lead from parent to child.

use super::joints::Made;
use super::{Body, Sdf, pose};
use crate::WarningKind;
use crate::error::Outcome;
use crate::names::unused;
use crate::words::listed;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Dynamics, Frame, JointBuilder, JointKind, Limit};
use std::collections::VecDeque;

/// Which links are joined to one another, however: a forest of links, the world behind the last one.
struct Joined(Vec<usize>);

impl Joined {
    fn root(&mut self, mut at: usize) -> usize {
        while self.0[at] != at {
            self.0[at] = self.0[self.0[at]];
            at = self.0[at];
        }
        at
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a] = b;
    }

    fn are_joined(&mut self, a: usize, b: usize) -> bool {
        self.root(a) == self.root(b)
    }
}

/// The tree under construction: links by their index, the world behind the last one.
struct Tree {
    /// The root's link, which is the ground.
    root: usize,
    placed: Vec<bool>,
    /// Joints that place their child.
    places: Vec<bool>,
    /// The joints whose parent a link is, in file order.
    below: Vec<Vec<usize>>,
    queue: VecDeque<usize>,
}

impl<'a> Sdf<'a> {
    /// Gives the builder the links and the joints.
    pub(super) fn assemble(&mut self) -> Outcome<()> {
        let world = self.links.len();
        if world == 0 {
            return Ok(());
        }
        let mut joined = self.joined();
        let held = self.held(&mut joined)?;
        let statics: Vec<usize> = (0..world).filter(|link| self.is_static(*link)).collect();
        let of_world = |made: &Made| made.sides.contains(&None);
        let needs_world = !statics.is_empty() || self.made.iter().any(of_world);
        let root = match held[..] {
            [only] if !needs_world => only,
            _ => world,
        };
        if root == world {
            self.world = unused(&self.world, |name| self.link_names.contains_key(name));
            self.builder.link(&self.world);
            self.builder.ground(&self.world);
        }
        for link in 0..world {
            let solids = self.solids(link);
            let name = self.name_of(Some(link)).to_owned();
            self.builder
                .detailed_link(&name, solids.inertial, solids.collisions, solids.visuals);
        }
        let mut tree = self.tree(root);
        for link in statics.into_iter().chain(held.clone()) {
            if link != root {
                self.hold(link)?;
                tree.place(link);
            }
        }
        tree.grow(&self.made, world);
        self.float_others(&mut tree, &mut joined)?;
        if root == world && !held.is_empty() {
            let names: Vec<&str> = held.iter().map(|link| self.name_of(Some(*link))).collect();
            let message = format!(
                "no joint holds {} in the world: it is held there, as the root link of URDF is",
                listed(&names)
            );
            let at = held.first().and_then(|link| self.links.get(*link));
            let at = at.map_or(0, |link| link.element.start());
            self.warn(at, WarningKind::Guessed, message);
        }
        for (index, made) in std::mem::take(&mut self.made).into_iter().enumerate() {
            let places = tree.places.get(index).copied().unwrap_or(false);
            let joint = self.joint(&made, places)?;
            self.builder.joint(joint);
            self.made.push(made);
        }
        Ok(())
    }

    fn joined(&self) -> Joined {
        let world = self.links.len();
        let mut joined = Joined((0..=world).collect());
        for made in &self.made {
            let [a, b] = made.sides.map(|body| body.unwrap_or(world));
            joined.join(a, b);
        }
        for link in (0..world).filter(|link| self.is_static(*link)) {
            joined.join(link, world);
        }
        joined
    }

    /// The canonical links of models that nothing joins to the world, nor to a model before them.
    fn held(&self, joined: &mut Joined) -> Outcome<Vec<usize>> {
        let world = self.links.len();
        let mut of_model: Vec<Vec<usize>> = vec![Vec::new(); self.scopes.len()];
        for (index, link) in self.links.iter().enumerate() {
            let top = self.scopes.get(link.scope).map_or(0, |scope| scope.top);
            if let Some(links) = of_model.get_mut(top) {
                links.push(index);
            }
        }
        let mut held = Vec::new();
        for (scope, links) in of_model.iter().enumerate() {
            let Some(first) = links.first() else {
                continue;
            };
            if links.iter().any(|link| joined.are_joined(*link, world)) {
                continue;
            }
            let named = self.scopes.get(scope).and_then(|scope| scope.canonical);
            let link = match (self.canonical(scope).transpose()?, named) {
                (Some(thing), Some(name)) => self.body_of(thing, name)?,
                _ => None,
            };
            let link = link.unwrap_or(*first);
            joined.join(link, world);
            held.push(link);
        }
        Ok(held)
    }

    fn tree(&self, root: usize) -> Tree {
        let world = self.links.len();
        let mut tree = Tree {
            root,
            placed: vec![false; world + 1],
            places: vec![false; self.made.len()],
            below: vec![Vec::new(); world + 1],
            queue: VecDeque::new(),
        };
        for (index, made) in self.made.iter().enumerate() {
            // What need not be closed as drawn places nothing.
            if made.at[0] == made.at[1]
                && let Some(below) = tree.below.get_mut(made.sides[0].unwrap_or(world))
            {
                below.push(index);
            }
        }
        // Where the world is not needed it has no link to be placed.
        tree.placed[world] = true;
        tree.place(root);
        tree
    }

    /// Fixes a link to the world.
    fn hold(&mut self, link: usize) -> Outcome<()> {
        let frame = self.seen(pose::WORLD, self.node_of_body(Some(link)), link)?;
        let child = self.name_of(Some(link)).to_owned();
        let range = self
            .links
            .get(link)
            .map_or(0..0, |link| link.element.range());
        let name = self.name_made(&format!("{child}_held"), range);
        let world = self.name_of(None).to_owned();
        let joint = JointBuilder::tree(&name, JointKind::Fixed, &world, &child);
        self.builder.joint(joint.origin(frame));
        Ok(())
    }

    /// Lets links float that no joint places from parent to child, those first that are nobody's child.
    fn float_others(&mut self, tree: &mut Tree, joined: &mut Joined) -> Outcome<()> {
        let world = self.links.len();
        let mut is_child = vec![false; world + 1];
        for made in &self.made {
            is_child[made.sides[1].unwrap_or(world)] |= made.at[0] == made.at[1];
        }
        let mut loose = Vec::new();
        let (children, others): (Vec<usize>, Vec<usize>) =
            (0..world).partition(|link| is_child[*link]);
        for link in others.into_iter().chain(children) {
            if tree.placed[link] {
                continue;
            }
            self.float(link, tree.root)?;
            if !joined.are_joined(link, world) {
                joined.join(link, world);
                loose.push(link);
            }
            tree.place(link);
            tree.grow(&self.made, world);
        }
        loose.sort_unstable();
        let Some(first) = loose.first().and_then(|link| self.links.get(*link)) else {
            return Ok(());
        };
        let at = first.element.start();
        let names: Vec<&str> = loose.iter().map(|link| self.name_of(Some(*link))).collect();
        let message = format!("no joint leads to {}: it floats", listed(&names));
        self.warn(at, WarningKind::Guessed, message);
        Ok(())
    }

    fn float(&mut self, link: usize, root: usize) -> Outcome<()> {
        let from = (root < self.links.len()).then_some(root);
        let (parent, child) = (self.node_of_body(from), self.node_of_body(Some(link)));
        let frame = self.seen(parent, child, link)?;
        let (parent, child) = (self.name_of(from), self.name_of(Some(link)));
        let (parent, child) = (parent.to_owned(), child.to_owned());
        let range = self
            .links
            .get(link)
            .map_or(0..0, |link| link.element.range());
        let name = self.name_made(&format!("{child}_floating"), range);
        self.builder.floating(&name, &parent, &child, frame);
        Ok(())
    }

    fn joint(&self, made: &Made, places: bool) -> Outcome<JointBuilder> {
        let [parent, child] = made.sides.map(|body| self.name_of(body));
        let mut joint = match places {
            true => JointBuilder::tree(&made.name, made.kind, parent, child),
            false => JointBuilder::closing(&made.name, made.kind, parent, child),
        };
        joint = joint
            .origin(self.side_of(made, 0)?)
            .successor_origin(self.side_of(made, 1)?);
        let axes = |axis: &Option<Direction>| axis.clone().into_iter();
        joint = axes(&made.axis).fold(joint, JointBuilder::axis);
        joint = axes(&made.axis2).fold(joint, JointBuilder::axis2);
        joint = made
            .lead
            .clone()
            .into_iter()
            .fold(joint, JointBuilder::lead);
        let distance: Option<Number> = made.distance.clone();
        joint = distance.into_iter().fold(joint, JointBuilder::distance);
        if made.limit != Limit::default() {
            joint = joint.limit(made.limit.clone());
        }
        if made.dynamics != Dynamics::default() {
            joint = joint.dynamics(made.dynamics.clone());
        }
        Ok(joint)
    }

    /// The joint's frame in one of its links: where it is drawn, and turned as its axes are given, so that these stay as they are written.
    fn side_of(&self, made: &Made, side: usize) -> Outcome<Frame> {
        let body = made.sides[side];
        let from = self.node_of_body(body);
        let of_link = body.unwrap_or(usize::MAX);
        let mut frame = self.seen(from, made.at[side], of_link)?;
        if let Some(node) = made.turned_as.filter(|node| *node != made.at[side]) {
            frame.roll_pitch_yaw = self.seen(from, node, of_link)?.roll_pitch_yaw;
        }
        Ok(frame)
    }

    fn seen(&self, from: usize, to: usize, of_link: usize) -> Outcome<Frame> {
        let place = || self.links.get(of_link).or(self.links.first());
        self.graph.seen_from(from, to).ok_or_else(|| {
            let range = place().map_or(0..0, |link| link.element.range());
            let message = "its place, or that of a joint in it, is not finite";
            crate::error::Fault::new(range, message)
        })
    }

    fn node_of_body(&self, body: Body) -> usize {
        let link = body.and_then(|link| self.links.get(link));
        link.map_or(pose::WORLD, |link| link.node)
    }

    fn name_of(&self, body: Body) -> &str {
        let link = body.and_then(|link| self.links.get(link));
        link.map_or(&self.world, |link| &link.name)
    }
}

impl Tree {
    fn place(&mut self, link: usize) {
        if let Some(placed) = self.placed.get_mut(link) {
            *placed = true;
            self.queue.push_back(link);
        }
    }

    /// Places what joints lead to from the links that are placed.
    fn grow(&mut self, made: &[Made], world: usize) {
        while let Some(link) = self.queue.pop_front() {
            let below = self.below.get_mut(link).map(std::mem::take);
            for index in below.into_iter().flatten() {
                let child = made.get(index).and_then(|made| made.sides[1]);
                let child = child.unwrap_or(world);
                if self.placed.get(child) == Some(&false) {
                    self.places[index] = true;
                    self.place(child);
                }
            }
        }
    }
}
