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

/// What the file wrote.
#[derive(Clone, Debug, PartialEq)]
pub enum CouplingOrigin {
    /// `<coupling>`: successor rate = ratio times predecessor rate, each summed from the nearest common ancestor.
    Ratio {
        /// The driving link.
        predecessor: LinkId,
        /// The driven link.
        successor: LinkId,
        /// Successor rate per predecessor rate.
        ratio: Number,
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
