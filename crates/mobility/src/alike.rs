//! Parts that are copies or mirror images of one another get the same answer, or none.
//!
//! The two legs of a robot have the same joints and, up to rounding, the same singular values: a reflection turns a twist's
//! coordinates into others of the same lengths. Where a small singular value lies near what counts as rounding, it can be
//! kept in one leg and dropped in the other, and one would be told to be locked while the other moves. Nothing in the file
//! means that: so both are open then.

use super::pose_rank::{Doubt, PartRank, RankNote};
use super::rounded::LARGEST;
use kutzbach_closure::Part;
use kutzbach_math::matrix::{DENSE_COLUMNS, MatrixError, relative_singular_values};
use kutzbach_model::mechanism::{JointKind, Mechanism};

/// Rounding at six decimals moves the singular values of an ordinary robot by no more (of the largest).
const NOISE: f64 = 1e-5;

/// What mirror images have in common, apart from their singular values.
type Shape = (Vec<JointKind>, Vec<usize>, usize, usize);

fn shape(mechanism: &Mechanism, part: &Part, rank: &PartRank) -> Shape {
    let mut kinds: Vec<JointKind> = part
        .joints
        .iter()
        .map(|j| mechanism.joints()[*j].kind)
        .collect();
    kinds.sort_unstable();
    let mut cycles: Vec<usize> = part.cycles.iter().map(Vec::len).collect();
    cycles.sort_unstable();
    (kinds, cycles, part.couplings.len(), rank.unknowns())
}

/// Opens the ranks of parts of one shape and, within noise, the same singular values, where they were decided differently
/// and what decides may be rounding in both.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn treat_alike(
    mechanism: &Mechanism,
    parts: &[Part],
    ranks: &mut [PartRank],
) -> Result<(), MatrixError> {
    let small = |rank: &PartRank| rank.unknowns() > 0 && rank.unknowns() <= DENSE_COLUMNS;
    // Exact numbers that differ differ truly.
    let rounded = |rank: &PartRank| rank.open_by_digits() > 0.0;
    for first in 0..parts.len() {
        for second in first + 1..parts.len() {
            let (one, other) = (&ranks[first], &ranks[second]);
            if answer(one) == answer(other)
                || !(small(one) && small(other) && rounded(one) && rounded(other))
                || shape(mechanism, &parts[first], one) != shape(mechanism, &parts[second], other)
                || !same_values(one, other)?
            {
                continue;
            }
            let least = one.candidates.0.min(other.candidates.0);
            let most = one.candidates.1.max(other.candidates.1);
            for index in [first, second] {
                open(&mut ranks[index], (least, most));
            }
        }
    }
    Ok(())
}

fn answer(rank: &PartRank) -> (Option<usize>, (usize, usize)) {
    (rank.instantaneous, rank.candidates)
}

fn same_values(one: &PartRank, other: &PartRank) -> Result<bool, MatrixError> {
    let stated = one.open_by_digits().max(other.open_by_digits());
    let (noise, zero) = (NOISE.max(stated), LARGEST.max(stated));
    // Values from here on count as zero in one of the two, or may.
    let most = one.candidates.1.max(other.candidates.1);
    let deciding = one.unknowns().saturating_sub(most);
    let (Some(one), Some(other)) = (
        relative_singular_values(&one.matrix)?,
        relative_singular_values(&other.matrix)?,
    ) else {
        return Ok(false);
    };
    let alike = one.iter().zip(&other).all(|(a, b)| (a - b).abs() <= noise);
    let may_be_zero = |values: &[f64]| values.iter().skip(deciding).all(|x| *x <= zero);
    Ok(one.len() == other.len() && alike && may_be_zero(&one) && may_be_zero(&other))
}

fn open(rank: &mut PartRank, candidates: (usize, usize)) {
    rank.instantaneous = None;
    rank.doubt = Some(Doubt::Unlike);
    rank.candidates = candidates;
    rank.note = Some(RankNote::Unlike {
        possible: candidates,
    });
}
