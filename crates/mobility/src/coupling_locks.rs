//! Blocks that couplings and loops hold fast only together.
//!
//! Files of robots state the couplings of a gripper beside its loops, so that programs without loops can move it too. Where the
//! two agree, the couplings are redundant; where they do not, no velocity satisfies both, and the block is rigid. Then the
//! freedom that the loops alone leave says so. It holds at the pose, to first order, as every rank does.

use super::pose_rank::PartRank;
use kutzbach_closure::Part;
use kutzbach_math::matrix::{SparseMatrix, decide};
use std::collections::BTreeSet;

/// The instantaneous freedom that a part has without its couplings, where with them it has none though the loops leave some;
/// `None` where that is not so, or where a margin does not tell. Cost: one rank of the part.
#[must_use]
pub fn freedom_locked_by_couplings(part: &Part, rank: &PartRank) -> Option<usize> {
    if rank.instantaneous != Some(0) || part.couplings.is_empty() || part.cycles.is_empty() {
        return None;
    }
    // The equations of the couplings are the last ones.
    let rows = rank.matrix.rows().checked_sub(part.couplings.len())?;
    let freedom = nullity(rank, |row, _, entry| (row < rows).then_some(entry))?;
    (freedom > 0).then_some(freedom)
}

/// A coupling of a block that is locked, without which it would move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LockingCoupling {
    /// Its index among the mechanism's couplings.
    pub coupling: usize,
    /// The instantaneous freedom that is left without it.
    pub freedom: usize,
    /// Whether as much is left where its ratio or multiplier has the other sign: then the others agree with that.
    pub other_sign: bool,
}

/// The couplings that lock a part of which [`freedom_locked_by_couplings`] says that couplings and loops do it together: each is left
/// out by itself. Cost: two ranks of the part a coupling.
#[must_use]
pub fn locking_couplings(part: &Part, rank: &PartRank) -> Vec<LockingCoupling> {
    let Some(rows) = rank.matrix.rows().checked_sub(part.couplings.len()) else {
        return Vec::new();
    };
    let of_one = |(number, &coupling): (usize, &usize)| {
        let own = rows + number;
        let freedom = nullity(rank, |row, _, entry| (row != own).then_some(entry))?;
        // Of two terms one is turned over.
        let mut terms = rank.matrix.row(own).iter();
        let turned = match (terms.next(), terms.next(), terms.next()) {
            (Some((column, _)), Some(_), None) => Some(*column),
            _ => None,
        };
        let with_other = turned.and_then(|turned| {
            nullity(rank, |row, column, entry| {
                Some(if row == own && column == turned {
                    -entry
                } else {
                    entry
                })
            })
        });
        (freedom > 0).then_some(LockingCoupling {
            coupling,
            freedom,
            other_sign: with_other == Some(freedom),
        })
    };
    part.couplings
        .iter()
        .enumerate()
        .filter_map(of_one)
        .collect()
}

/// The instantaneous freedom of a part without some of its couplings, by their places in it; `None` where a margin does not tell.
pub(super) fn freedom_without(
    part: &Part,
    rank: &PartRank,
    left_out: &BTreeSet<usize>,
) -> Option<usize> {
    let rows = rank.matrix.rows().checked_sub(part.couplings.len())?;
    let kept = |row: usize| {
        row.checked_sub(rows)
            .is_none_or(|place| !left_out.contains(&place))
    };
    nullity(rank, |row, _, entry| kept(row).then_some(entry))
}

/// The nullity of a part's matrix with some entries changed or left out; `None` where a margin does not tell.
fn nullity(rank: &PartRank, changed: impl Fn(usize, usize, f64) -> Option<f64>) -> Option<usize> {
    let entries = rank.matrix.triplets();
    let kept: Vec<(usize, usize, f64)> = entries
        .filter_map(|(row, column, entry)| Some((row, column, changed(row, column, *entry)?)))
        .collect();
    let (rows, columns) = (rank.matrix.rows(), rank.matrix.columns());
    let matrix = SparseMatrix::from_triplets(rows, columns, 0.0, kept).ok()?;
    let accuracy = rank.decision.accuracy.max(rank.accuracy);
    decide(&matrix, accuracy).ok()?.nullity()
}
