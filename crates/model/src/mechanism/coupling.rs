//! Relations between joint variables: gears, belts, mimic joints, cams.

use super::model::{JointId, LinkId};
use kutzbach_math::number::Number;

/// One joint's share in a coupling.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingTerm {
    /// A joint of one freedom.
    pub joint: JointId,
    /// The factor of its variable.
    pub factor: Number,
    /// The factors of its variable's square, cube and so on, the last of them not zero; empty where the coupling is linear in it.
    pub higher: Vec<Number>,
}

/// The highest power of a joint variable that a coupling may have.
pub const HIGHEST_POWER: u32 = 4;

impl CouplingTerm {
    /// A joint's share that is linear in its variable.
    #[must_use]
    pub fn linear(joint: JointId, factor: Number) -> Self {
        Self {
            joint,
            factor,
            higher: Vec::new(),
        }
    }

    /// All factors, that of the variable itself first.
    pub fn factors(&self) -> impl Iterator<Item = &Number> {
        std::iter::once(&self.factor).chain(&self.higher)
    }
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
    /// `<coupling>` with `<term>`s: the sum of joint variables, or their powers, with these coefficients is the offset.
    Sum,
}

/// One equation `Σ factor · variable = offset` between joint variables; it counts as one constraint. A term may hold higher powers of
/// its variable beside.
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

impl Coupling {
    /// Whether no joint's variable has a power above the first.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.terms.iter().all(|term| term.higher.is_empty())
    }
}
