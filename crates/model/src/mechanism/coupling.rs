//! Linear relations between joint variables: gears, belts, mimic joints.

use super::model::{JointId, LinkId};
use kutzbach_math::number::Number;

/// One joint's share in a coupling.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingTerm {
    /// A joint of one freedom.
    pub joint: JointId,
    /// The factor of its variable.
    pub factor: Number,
}

/// What is taken for granted of a ratio whose file names no carrier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Assumption {
    /// More than two joints move between the two links, so that others could bear the wheels.
    SeenFrom {
        /// The nearest common link, from which rates are taken to be seen.
        link: LinkId,
        /// The link that bears the one which moves by several joints.
        other: Option<LinkId>,
    },
    /// Some axes point in opposite directions; rates are taken to count in the same one.
    SameDirection,
}

/// What the file wrote.
#[derive(Clone, Debug, PartialEq)]
pub enum CouplingOrigin {
    /// `<coupling>`: successor rate = ratio times predecessor rate, each seen from the carrier. Of links that turn about parallel axes, or
    /// slide along such, both count in the same direction; of others each about the axis of the joint that bears it.
    Ratio {
        /// The driving link.
        predecessor: LinkId,
        /// The driven link.
        successor: LinkId,
        /// Successor rate per predecessor rate.
        ratio: Number,
        /// The link from which both rates are seen; `None`: the nearest common link in the tree.
        carrier: Option<LinkId>,
        /// What may have been meant otherwise; nothing where the carrier is named.
        assumed: Vec<Assumption>,
    },
    /// `<mimic>`: follower = multiplier × leader + offset.
    Mimic {
        /// The joint that carries the `<mimic>` element.
        follower: JointId,
        /// The joint it names.
        leader: JointId,
        /// Multiplier.
        multiplier: Number,
        /// Offset (rad or m).
        offset: Number,
    },
    /// `<coupling>` with `<term>`s: the sum of joint variables with these coefficients is the offset.
    Linear,
}

/// One linear equation `Σ factor · variable = offset` between joint variables; it counts as one constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// Unique among joints and couplings.
    pub name: String,
    /// Left side; no joint appears twice.
    pub terms: Vec<CouplingTerm>,
    /// Right side (rad or m).
    pub offset: Number,
    /// What the file wrote.
    pub origin: CouplingOrigin,
}
