//! The validated model.

use super::configuration::Configuration;
use super::coupling::Coupling;
use super::frame::{Direction, Frame};
use super::joint::Joint;
use super::link::{Link, Placement};
use super::scene::{Expectation, Scene};
use crate::number::Number;
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
    pub(super) scene: Option<Scene>,
    pub(super) expectation: Option<Expectation>,
    pub(super) placement_order: Vec<LinkId>,
    pub(super) precision: Precision,
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

    /// How precisely the geometry is stated.
    #[must_use]
    pub fn precision(&self) -> &Precision {
        &self.precision
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

/// How precisely a file states its geometry.
///
/// A rounded number differs from the number meant by up to half a unit of its last place. Writers round in two manners,
/// to a fixed number of decimals or to a fixed number of significant digits, and both strip trailing zeros. With `D` the
/// most decimals and `S` the most significant digits found in the geometry, a literal `x` with `d` decimals is uncertain by
///
/// ```text
/// u(x) = ½ min(10⁻ᵈ, max(10⁻ᴰ, 10⁻ˢ 10ᵉ)),   10ᵉ⁻¹ ≤ |x| < 10ᵉ
/// ```
///
/// which is right for both manners: the first term wherever no zeros were stripped, the second where they were. Expressions
/// are exact. A file whose numbers all have at most [`Precision::EXACT_DECIMALS`] decimals holds numbers that a designer
/// chose, not rounded ones, and is taken as exact too.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Precision {
    /// Most decimals of any literal in the geometry; `None` where there is no literal.
    pub decimals: Option<i32>,
    /// Most significant digits of any literal in the geometry.
    pub significant: u32,
}

impl Precision {
    /// Up to this many decimals in the whole file, literals are exact.
    pub const EXACT_DECIMALS: i32 = 2;

    /// Whether every number of the geometry is exact.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.decimals.is_none_or(|d| d <= Self::EXACT_DECIMALS)
    }

    /// How far a number of this file may be from the number meant; zero for exact ones.
    #[must_use]
    pub fn uncertainty(&self, number: &Number) -> f64 {
        let (Some(stated), Some(most), false) = (number.stated(), self.decimals, self.is_exact())
        else {
            return 0.0;
        };
        let value = number.value().abs();
        let by_digits = if value > 0.0 {
            let exponent = value.log10().floor() + 1.0;
            10f64.powf(exponent - f64::from(self.significant))
        } else {
            0.0
        };
        let own = 10f64.powi(-stated.decimals);
        0.5 * own.min(10f64.powi(-most).max(by_digits))
    }

    /// The precision of a mechanism's links and joints.
    pub(super) fn of(links: &[Link], joints: &[Joint]) -> Self {
        let mut precision = Self::default();
        let mut read = |number: &Number| {
            if let Some(stated) = number.stated() {
                let most = precision.decimals.unwrap_or(stated.decimals);
                precision.decimals = Some(most.max(stated.decimals));
                precision.significant = precision.significant.max(stated.significant);
            }
        };
        let mut read_frame = |frame: &Frame| {
            frame
                .position
                .iter()
                .chain(&frame.roll_pitch_yaw)
                .for_each(&mut read);
        };
        for link in links {
            if let Placement::Floating { origin, .. } = &link.placement {
                read_frame(origin);
            }
        }
        for joint in joints {
            read_frame(&joint.predecessor.frame);
            read_frame(&joint.successor.frame);
        }
        for joint in joints {
            let Direction(axis) = &joint.axis;
            let Direction(axis2) = &joint.axis2;
            axis.iter().chain(axis2).for_each(&mut read);
            joint.lead.iter().chain(&joint.distance).for_each(&mut read);
        }
        precision
    }
}
