//! Blocks that couplings and loops hold fast only together.
//!
//! Files of robots state the couplings of a gripper beside its loops, so that programs without loops can move it too. Where the
//! two agree, the couplings are redundant; where they do not, no velocity satisfies both, and the block is rigid. Then the
//! freedom that the loops alone leave says so. It holds at the pose, to first order, as every rank does.

use super::pose_rank::PartRank;
use kutzbach_closure::Part;
use kutzbach_math::matrix::{SparseMatrix, decide};

/// The instantaneous freedom that a part has without its couplings, where with them it has none though the loops leave some;
/// `None` where that is not so, or where a margin does not tell. Cost: one rank of the part.
#[must_use]
pub fn freedom_locked_by_couplings(part: &Part, rank: &PartRank) -> Option<usize> {
    if rank.instantaneous != Some(0) || part.couplings.is_empty() || part.cycles.is_empty() {
        return None;
    }
    // The equations of the couplings are the last ones.
    let rows = rank.matrix.rows().checked_sub(part.couplings.len())?;
    let entries = rank.matrix.triplets();
    let of_loops: Vec<(usize, usize, f64)> = entries
        .filter(|(row, _, _)| *row < rows)
        .map(|(row, column, entry)| (row, column, *entry))
        .collect();
    let matrix = SparseMatrix::from_triplets(rows, rank.matrix.columns(), 0.0, of_loops).ok()?;
    let accuracy = rank.decision.accuracy.max(rank.accuracy);
    let freedom = decide(&matrix, accuracy).ok()?.nullity()?;
    (freedom > 0).then_some(freedom)
}
