//! Couplings and links without which everything moves as before, and couplings that contradict the loops beyond first order.
//!
//! At a regular pose the finite freedom is the instantaneous one. Without a coupling, or a link, a part moves at least as before, and at most
//! as its rank then leaves; where that is the same number the coupling or link is superfluous, not at this pose only. A link that
//! two joints hold is taken away by letting go of one of them: it then dangles on the other, whose freedoms are its own.

use super::coupling_locks::{LockingCoupling, freedom_without};
use super::pose_rank::PartRank;
use super::redundancy::SelfStresses;
use super::restricted::{LeftOut, without};
use super::subgroup::subgroup_finding;
use kutzbach_closure::{Geometry, JointState, Part, Structure};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::Mechanism;
use std::collections::BTreeSet;

/// Something that can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Spare {
    /// A coupling, by its index.
    Coupling(usize),
    /// A link with its two joints, by its index.
    Link(usize),
}

/// A coupling or link that can be left out of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Superfluous {
    /// What it is.
    pub what: Spare,
    /// Redundant constraints that go with it.
    pub redundant: usize,
    /// The freedom of the part without it: what the part has where it is superfluous, more where it contradicts the loops.
    pub freedom: usize,
}

/// Parts of more unknowns are not asked: each coupling takes a rank of the part.
const MOST_UNKNOWNS: usize = 200;

/// What of a part in a regular pose can be left out, each by itself.
pub(super) fn superfluous(
    mechanism: &Mechanism,
    part: &Part,
    rank: &PartRank,
    stresses: &SelfStresses,
) -> Vec<Superfluous> {
    let Some(freedom) = rank.instantaneous.filter(|freedom| *freedom > 0) else {
        return Vec::new();
    };
    if rank.unknowns() > MOST_UNKNOWNS {
        return Vec::new();
    }
    let repeats =
        |place: &usize| freedom_without(part, rank, &BTreeSet::from([*place])) == Some(freedom);
    let couplings = (0..part.couplings.len())
        .filter(repeats)
        .map(|place| Superfluous {
            what: Spare::Coupling(part.couplings[place]),
            redundant: 1,
            freedom,
        });
    let links = bars(mechanism, part)
        .into_iter()
        .filter_map(|(link, joints)| {
            let own: usize = joints
                .iter()
                .map(|&joint| mechanism.joints()[joint].freedom())
                .sum();
            let redundant = 6usize.checked_sub(own).filter(|n| *n > 0)?;
            let held = stresses.indeterminate_wrenches(rank, joints[0]);
            (held == redundant).then_some(Superfluous {
                what: Spare::Link(link),
                redundant,
                freedom,
            })
        });
    couplings.chain(links).collect()
}

/// Links with exactly two joints, both of the part and in no coupling, one of which holds each end; with these joints.
fn bars(mechanism: &Mechanism, part: &Part) -> Vec<(usize, [usize; 2])> {
    let coupled = super::advice::coupled_joints(mechanism, part);
    let mut at = vec![Vec::new(); mechanism.links().len()];
    for (index, joint) in mechanism.joints().iter().enumerate() {
        for link in [joint.predecessor.link, joint.successor.link] {
            at[link.0].push(index);
        }
    }
    let bar = |(link, joints): (usize, Vec<usize>)| {
        let joints: [usize; 2] = joints.try_into().ok()?;
        let of_part = joints.iter().all(|joint| {
            part.joints.contains(joint)
                && !coupled.contains(joint)
                && mechanism.joints()[*joint].freedom() > 0
        });
        (of_part && link != mechanism.ground().0).then_some((link, joints))
    };
    at.into_iter().enumerate().filter_map(bar).collect()
}

/// Couplings of a part that agree with its loops at the pose, to first order, and not beyond: without one of them subgroups prove that it
/// moves with more freedoms than the `finite` it has.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn contradicting(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    structure: &Structure,
    (part, rank): (&Part, &PartRank),
    finite: usize,
) -> Result<Vec<LockingCoupling>, MatrixError> {
    let mut found = Vec::new();
    if part.couplings.is_empty() || part.cycles.is_empty() || rank.unknowns() > MOST_UNKNOWNS {
        return Ok(found);
    }
    for (place, &coupling) in part.couplings.iter().enumerate() {
        let out = LeftOut {
            couplings: BTreeSet::from([place]),
            ..LeftOut::default()
        };
        let Some((smaller, left)) = without(part, rank, &out) else {
            continue;
        };
        let moves = subgroup_finding(mechanism, geometry, states, structure, &smaller, &left)?;
        if let Some(freedom) = moves.finite.filter(|freedom| *freedom > finite) {
            found.push(LockingCoupling {
                coupling,
                freedom,
                other_sign: false,
            });
        }
    }
    Ok(found)
}

/// What is left of a part without what is superfluous.
pub(super) struct Rest {
    pub part: Part,
    pub rank: PartRank,
    /// Whether a link was left out, and not couplings alone.
    pub without_link: bool,
}

/// What is left of a part without couplings that repeat others or its loops, as many as can be left out together, and without one
/// link that is superfluous then; `None` where nothing is superfluous. The pose is to be regular.
pub(super) fn without_spares(mechanism: &Mechanism, part: &Part, rank: &PartRank) -> Option<Rest> {
    let rest = |without_link: bool| {
        move |(part, rank): (Part, PartRank)| Rest {
            part,
            rank,
            without_link,
        }
    };
    let freedom = rank.instantaneous.filter(|freedom| *freedom > 0)?;
    if rank.unknowns() > MOST_UNKNOWNS {
        return None;
    }
    let mut out = LeftOut::default();
    for place in 0..part.couplings.len() {
        out.couplings.insert(place);
        if freedom_without(part, rank, &out.couplings) != Some(freedom) {
            out.couplings.remove(&place);
        }
    }
    let left = (!out.couplings.is_empty())
        .then(|| without(part, rank, &out))
        .flatten();
    let (smaller, its_rank) = left
        .as_ref()
        .map_or((part, rank), |(part, rank)| (part, rank));
    for (_, joints) in bars(mechanism, smaller) {
        let out = LeftOut {
            joints: joints.into_iter().collect(),
            ..LeftOut::default()
        };
        let fewer = |rest: &PartRank| rest.equations() + 6 == its_rank.equations();
        let found = without(smaller, its_rank, &out)
            .filter(|(_, rest)| rest.instantaneous == Some(freedom) && fewer(rest));
        if found.is_some() {
            return found.map(rest(true));
        }
    }
    left.map(rest(false))
}
