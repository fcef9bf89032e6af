//! What is known of a mechanism at one pose.

use super::advice::Advice;
use super::branch::Branch;
use super::claim::Claim;
use super::coupling_locks::LockingCoupling;
use super::cycles::CycleFacts;
use super::exact_constraint::{ChangeSets, NoChangeSet};
use super::generic::GenericCount;
use super::intended::Meant;
use super::judge::PartFinding;
use super::kutzbach::kutzbach_count;
use super::pose_rank::PartRank;
use super::redundant_directions::JointDirections;
use super::roles::JointRole;
use super::superfluous::Superfluous;
use super::verdict::{Mobility, unassembled};
use kutzbach_closure::{Assembly, Geometry, Structure};
use kutzbach_model::mechanism::Mechanism;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The instantaneous picture of the whole mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct HomeFreedom {
    /// Dimension of the kernel of the closure equations; `None` where some part is undecided.
    pub instantaneous: Option<usize>,
    /// Smallest and largest value that remain possible.
    pub candidates: (usize, usize),
    /// The value for the numbers taken literally, where some part's differs.
    pub as_written: Option<usize>,
    /// Dependent constraint equations: instantaneous − Kutzbach.
    pub redundant: Option<i64>,
}

/// The analysis of a mechanism at a pose. What its [`Depth`](crate::Depth) leaves out is empty or `None`, as said field by field.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Topology. Clones share it, and so do mechanisms that differ in numbers only ([`analyse_within`](crate::analyse_within)).
    pub structure: Arc<Structure>,
    /// Kutzbach's count.
    pub kutzbach: i64,
    /// The count at random geometry; `None` unless [`Depth::Everything`](crate::Depth::Everything) is asked for.
    pub generic: Option<GenericCount>,
    /// How the mechanism closes.
    pub assembly: Assembly,
    /// The mechanism in double precision where it was analysed, before assembly: the one meant, if there is one ([`Analysis::of`]). Clones
    /// share it.
    pub geometry: Arc<Geometry<f64>>,
    /// The rank of every part, in the order of [`Structure::parts`]; empty if it does not assemble.
    pub parts: Vec<PartRank>,
    /// The instantaneous freedom; `None` if the mechanism does not assemble: an open pose is never ranked.
    pub home: Option<HomeFreedom>,
    /// Roles of all joints, by joint index; nothing known of any unless [`Depth::Everything`](crate::Depth::Everything) is asked for.
    pub roles: Vec<JointRole>,
    /// Indeterminate reaction directions of all joints, by joint index; `None` where the rank is open.
    pub redundant_wrenches: Vec<Option<usize>>,
    /// Facts of the cycles shown; none unless [`Depth::Everything`](crate::Depth::Everything) is asked for.
    pub cycles: Vec<CycleFacts>,
    /// Repair advice, best first; none unless [`Depth::Everything`](crate::Depth::Everything) is asked for.
    pub advice: Vec<Advice>,
    /// Couplings and links that can be left out, each by itself, of parts in a regular pose; none unless [`Depth::Everything`](crate::Depth::Everything) is asked
    /// for.
    pub superfluous: Vec<Superfluous>,
    /// Couplings that agree with the loops at the pose and not beyond, with the finite freedom of their part without them, by part; as far
    /// as subgroups prove it, and none unless [`Depth::Everything`](crate::Depth::Everything) is asked for.
    pub contradicting: BTreeMap<usize, Vec<LockingCoupling>>,
    /// Sets of joints to relax after which no constraint is redundant and the finite mobility is what it was: an entry for each
    /// part with redundant constraints, of which one set each is to be taken; or why there are none.
    pub change_sets: Result<Vec<ChangeSets>, NoChangeSet>,
    /// Where redundant constraints act, by joint index; empty for joints without any, and unless [`Depth::Everything`](crate::Depth::Everything) is
    /// asked for.
    pub directions: Vec<JointDirections>,
    /// What the engines found of every part, in the order of [`Structure::parts`]; none at [`Depth::Rank`](crate::Depth::Rank).
    pub findings: Vec<PartFinding>,
    /// The branches through the pose; `None` while not decided, where there are too many to list, or below
    /// [`Depth::Motions`](crate::Depth::Motions).
    pub branches: Option<Vec<Branch>>,
    /// The verdict.
    pub mobility: Mobility,
    /// The mechanism that rounded numbers mean, where everything here is said of it instead of the file's own numbers.
    pub meant: Option<Box<Meant>>,
    /// The mechanism nearest to rounded numbers that closes along a motion, where the verdict hangs on how they were rounded and one
    /// was found: within their digits or not.
    pub nearest: Option<Box<Meant>>,
}

impl Analysis {
    /// Before anything is known of the pose.
    pub(super) fn unranked(
        mechanism: &Mechanism,
        structure: Arc<Structure>,
        generic: Option<GenericCount>,
        assembly: Assembly,
        geometry: Arc<Geometry<f64>>,
    ) -> Self {
        let joints = mechanism.joints().len();
        Self {
            mobility: unassembled(&assembly),
            structure,
            kutzbach: kutzbach_count(mechanism),
            generic,
            assembly,
            geometry,
            parts: Vec::new(),
            home: None,
            roles: vec![JointRole::default(); joints],
            redundant_wrenches: vec![None; joints],
            cycles: Vec::new(),
            advice: Vec::new(),
            superfluous: Vec::new(),
            contradicting: BTreeMap::new(),
            change_sets: Err(NoChangeSet::Undecided),
            directions: vec![JointDirections::default(); joints],
            findings: Vec::new(),
            branches: None,
            meant: None,
            nearest: None,
        }
    }

    /// What every engine claims, with the index of the part: part by part, in the order asked.
    pub fn claims(&self) -> impl Iterator<Item = (usize, &Claim)> {
        let parts = self.findings.iter().enumerate();
        parts.flat_map(|(index, found)| found.claims().iter().map(move |claim| (index, claim)))
    }

    /// The mechanism that everything here is said of: the one meant, or the one given.
    #[must_use]
    pub fn of<'a>(&'a self, given: &'a Mechanism) -> &'a Mechanism {
        self.meant.as_ref().map_or(given, |meant| &meant.mechanism)
    }
}
