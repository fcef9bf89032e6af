//! The validated model.

use super::configuration::Configuration;
use super::constants::Recognised;
use super::coupling::Coupling;
use super::joint::Joint;
use super::link::Link;
use super::precision::Precision;
use super::precision_by_block::Precisions;
use super::scene::{Expectation, Scene};
use std::collections::BTreeMap;

/// Index of a link in [`Mechanism::links`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LinkId(pub usize);

/// Index of a joint in [`Mechanism::joints`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct JointId(pub usize);

/// A valid mechanism. See the [module](super) for what valid means.
#[derive(Clone, Debug)]
pub struct Mechanism {
    pub(super) name: String,
    pub(super) ground: LinkId,
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<Joint>,
    pub(super) couplings: Vec<Coupling>,
    pub(super) configurations: Vec<Configuration>,
    pub(super) actuated: Vec<JointId>,
    pub(super) scene: Option<Scene>,
    pub(super) expectation: Option<Expectation>,
    pub(super) placement_order: Vec<LinkId>,
    pub(super) precisions: Precisions,
    pub(super) recognised: Recognised,
    pub(super) link_by_name: BTreeMap<String, LinkId>,
    pub(super) joint_by_name: BTreeMap<String, JointId>,
}

impl Mechanism {
    /// The mechanism's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The link that is held fixed.
    #[must_use]
    pub fn ground(&self) -> LinkId {
        self.ground
    }

    /// All links, in file order.
    #[must_use]
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// All joints, tree joints and loops, in file order. A `floating` joint is none of them.
    #[must_use]
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// One link.
    #[must_use]
    pub fn link(&self, id: LinkId) -> &Link {
        &self.links[id.0]
    }

    /// One joint.
    #[must_use]
    pub fn joint(&self, id: JointId) -> &Joint {
        &self.joints[id.0]
    }

    /// All couplings, `mimic` included.
    #[must_use]
    pub fn couplings(&self) -> &[Coupling] {
        &self.couplings
    }

    /// Named poses.
    #[must_use]
    pub fn configurations(&self) -> &[Configuration] {
        &self.configurations
    }

    /// A named pose.
    #[must_use]
    pub fn configuration(&self, name: &str) -> Option<&Configuration> {
        self.configurations.iter().find(|c| c.name == name)
    }

    /// The joints that the file says a motor drives, in file order, each once and none without freedom; empty where the
    /// file says nothing of motors.
    #[must_use]
    pub fn actuated(&self) -> &[JointId] {
        &self.actuated
    }

    /// The mechanism with one configuration more, or with that of the same name replaced. There have to be as many values
    /// for each joint as it has freedoms.
    #[must_use]
    pub fn with_configuration(&self, added: Configuration) -> Self {
        let mut other = self.clone();
        match other
            .configurations
            .iter_mut()
            .find(|c| c.name == added.name)
        {
            Some(configuration) => *configuration = added,
            None => other.configurations.push(added),
        }
        other
    }

    /// The mechanism without the configuration of that name.
    #[must_use]
    pub fn without_configuration(&self, name: &str) -> Self {
        let mut other = self.clone();
        other.configurations.retain(|c| c.name != name);
        other
    }

    /// For every joint with limits, a value well within them (rad, m): the middle, or where there is but one limit, the
    /// value nearest to zero.
    #[must_use]
    pub fn middle_of_limits(&self) -> Vec<(JointId, f64)> {
        let middle = |joint: &Joint| {
            let (lower, upper) = joint.bounds()?;
            let middle = 0.5 * lower + 0.5 * upper;
            Some(match middle.is_finite() {
                true => middle,
                false => 0.0f64.max(lower).min(upper),
            })
        };
        let joints = self.joints.iter().enumerate();
        joints
            .filter_map(|(index, joint)| Some((JointId(index), middle(joint)?)))
            .collect()
    }

    /// Physical effects for a simulation.
    #[must_use]
    pub fn scene(&self) -> Option<&Scene> {
        self.scene.as_ref()
    }

    /// What is known of the answer.
    #[must_use]
    pub fn expectation(&self) -> Option<&Expectation> {
        self.expectation.as_ref()
    }

    /// Links ordered so that each comes after the link its home pose refers to.
    #[must_use]
    pub fn placement_order(&self) -> &[LinkId] {
        &self.placement_order
    }

    /// The link of that name.
    #[must_use]
    pub fn link_named(&self, name: &str) -> Option<LinkId> {
        self.link_by_name.get(name).copied()
    }

    /// The joint of that name.
    #[must_use]
    pub fn joint_named(&self, name: &str) -> Option<JointId> {
        self.joint_by_name.get(name).copied()
    }

    /// How precisely the geometry of all loops together is stated: exact where that of every independent sub-mechanism is. No
    /// number is judged by it; see [`Mechanism::precision_of`].
    #[must_use]
    pub fn precision(&self) -> &Precision {
        self.precisions.together()
    }

    /// How precisely the geometry of a joint's independent sub-mechanism is stated. The numbers of a joint in no loop bear on
    /// nothing: they count as exact.
    #[must_use]
    pub fn precision_of(&self, joint: JointId) -> &Precision {
        self.precisions.of_joint(joint.0)
    }

    /// Which independent sub-mechanism a joint belongs to, that is which biconnected block of the constraint graph, counted over
    /// those with loops by the names of their joints; `None` for joints in no loop.
    #[must_use]
    pub fn sub_mechanism(&self, joint: JointId) -> Option<usize> {
        self.precisions.block(joint.0)
    }

    /// Whether the numbers of all these joints' sub-mechanisms are exact.
    #[must_use]
    pub fn is_exact<'a>(&self, joints: impl IntoIterator<Item = &'a usize>) -> bool {
        let exact = |joint: &usize| self.precisions.of_joint(*joint).is_exact();
        joints.into_iter().all(exact)
    }

    /// Reads anew what the digits state.
    pub(super) fn read_digits(mut self) -> Self {
        self.precisions = Precisions::of(&self);
        self
    }

    /// The sum of all joint freedoms.
    #[must_use]
    pub fn freedom(&self) -> usize {
        self.joints.iter().map(Joint::freedom).sum()
    }

    /// Index of the first variable of every joint in the vector of all joint variables; one entry more than joints.
    #[must_use]
    pub fn variable_offsets(&self) -> Vec<usize> {
        let mut offsets = Vec::with_capacity(self.joints.len() + 1);
        let mut next = 0;
        offsets.push(0);
        for joint in &self.joints {
            next += joint.freedom();
            offsets.push(next);
        }
        offsets
    }
}
