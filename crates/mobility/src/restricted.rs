//! A part without some of what holds it: couplings, or a link between two joints.

use super::pose_rank::PartRank;
use kutzbach_closure::Part;
use kutzbach_math::matrix::{SparseMatrix, decide};
use std::collections::BTreeSet;

/// What is left out of a part.
#[derive(Clone, Debug, Default)]
pub(crate) struct LeftOut {
    /// Couplings, by their places in the part.
    pub couplings: BTreeSet<usize>,
    /// Joints, all of whose cycles are left out too.
    pub joints: BTreeSet<usize>,
}

/// Equations of a cycle.
const CYCLE: usize = 6;

/// The part that is left, with its rank at the same pose, as accurate as the part's; `None` where a margin does not tell, or where
/// what is left is none: joints lie in more than one cycle, so that the other cycles would be other ones. Of the jacobian only
/// variables and walks are those of the part left.
pub(crate) fn without(part: &Part, rank: &PartRank, out: &LeftOut) -> Option<(Part, PartRank)> {
    let passes =
        |cycle: &Vec<(usize, bool)>| cycle.iter().any(|(joint, _)| out.joints.contains(joint));
    let gone: BTreeSet<usize> = (0..part.cycles.len())
        .filter(|&cycle| passes(&part.cycles[cycle]))
        .collect();
    if rank.jacobian.walks.len() != part.cycles.len() || gone.len() > out.joints.len().min(1) {
        return None;
    }
    let first_coupling = CYCLE * part.cycles.len();
    let row_is_kept = |row: usize| match row.checked_sub(first_coupling) {
        Some(coupling) => !out.couplings.contains(&coupling),
        None => !gone.contains(&(row / CYCLE)),
    };
    let column_is_kept = |column: usize| !out.joints.contains(&rank.jacobian.variables[column].0);
    let rows = renumbered(rank.equations(), row_is_kept);
    let columns = renumbered(rank.unknowns(), column_is_kept);
    let entries = rank.matrix.triplets();
    let entries =
        entries.filter_map(|(row, column, entry)| Some((rows[row]?, columns[column]?, *entry)));
    let count = |kept: &[Option<usize>]| kept.iter().flatten().count();
    let entries: Vec<_> = entries.collect();
    let (height, width) = (count(&rows), count(&columns));
    let matrix = SparseMatrix::from_triplets(height, width, 0.0, entries).ok()?;
    let decision = decide(&matrix, rank.decision.accuracy.max(rank.accuracy)).ok()?;
    let freedom = decision.nullity()?;
    let mut left = rank.clone();
    left.decision = decision;
    left.instantaneous = Some(freedom);
    left.candidates = (freedom, freedom);
    left.as_written = None;
    left.matrix = matrix;
    left.column_scales = kept(&rank.column_scales, &columns);
    left.jacobian.variables = kept(&rank.jacobian.variables, &columns);
    let mut cycle = 0..;
    left.jacobian
        .walks
        .retain(|_| cycle.next().is_some_and(|cycle| !gone.contains(&cycle)));
    let mut smaller = part.clone();
    smaller.joints.retain(|joint| !out.joints.contains(joint));
    smaller.cycles.retain(|cycle| !passes(cycle));
    let mut place = 0..;
    smaller.couplings.retain(|_| {
        place
            .next()
            .is_some_and(|place| !out.couplings.contains(&place))
    });
    Some((smaller, left))
}

/// New numbers of what is kept.
fn renumbered(count: usize, is_kept: impl Fn(usize) -> bool) -> Vec<Option<usize>> {
    let mut next = 0..;
    (0..count)
        .map(|old| is_kept(old).then(|| next.next()).flatten())
        .collect()
}

fn kept<T: Clone>(all: &[T], numbers: &[Option<usize>]) -> Vec<T> {
    let pairs = all.iter().zip(numbers).filter(|(_, new)| new.is_some());
    pairs.map(|(one, _)| one.clone()).collect()
}
