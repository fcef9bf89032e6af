//! What double precision does not see of a part, however regular it looks: ratios that multiply from stage to stage, and motions
//! that begin with a power of another.
//!
//! A train of four worm gears of 1 : 100000 turns its last shaft by 1e-20 of the first one's turn: a weld there leaves a singular value
//! of that size, and a rate of that size is no rest. A four-bar at dead centre turns its output by the square of its input: eight of
//! them in a row by its power 256.

use super::pose_rank::PartRank;
use kutzbach_closure::{Geometry, Part};
use kutzbach_math::matrix::{MatrixError, NullVectors, RankDecision, SparseMatrix, null_vectors};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{JointKind, Mechanism};
use std::collections::BTreeSet;

/// Bits of ratios that leave double precision enough to separate a singular value from rounding.
const RATIO_IN_DOUBLE: usize = 30;

/// Bits of a loop's ratio of arms that are usual, and do not multiply.
const USUAL_ARMS: f64 = 1.0;

/// Of so many loops with a joint at rest double precision sees every contact a radian away; each one more squares what is left over.
const LOOPS_IN_DOUBLE: usize = 3;

/// Places closer than this share of their distances from a frame's origin are one.
const SAME_PLACE: f64 = 1e-13;

/// A joint whose share of a unit kernel vector is smaller is at rest.
const AT_REST: f64 = 1e-6;

/// Bits in which the smallest ratio of a part's ends stands clear of rounding; `None` where doubles suffice. Ratios are those of couplings'
/// factors, and of the longest to the shortest arm of each loop.
pub(super) fn bits_for_ratios(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    part: &Part,
) -> Option<usize> {
    let couplings = part.couplings.iter().map(|&coupling| {
        let terms = &mechanism.couplings()[coupling].terms;
        bits_between(
            terms
                .iter()
                .flat_map(|term| term.factors().map(Number::value)),
        )
    });
    let loops = part
        .cycles
        .iter()
        .map(|cycle| (bits_between(arms(mechanism, geometry, cycle)) - USUAL_ARMS).max(0.0));
    let bits = couplings.chain(loops).sum::<f64>() as usize;
    (bits > RATIO_IN_DOUBLE).then_some(bits + 53)
}

/// Of the largest to the smallest of some numbers, zeros left out.
fn bits_between(numbers: impl Iterator<Item = f64>) -> f64 {
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for size in numbers.map(f64::abs).filter(|x| *x > 0.0 && x.is_finite()) {
        least = least.min(size);
        most = most.max(size);
    }
    if most > 0.0 {
        (most / least).log2()
    } else {
        0.0
    }
}

/// Distances between the joints that follow each other on a loop (m), across links that fixed joints make one body.
fn arms(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    cycle: &[(usize, bool)],
) -> impl Iterator<Item = f64> {
    let fixed = |joint: usize| mechanism.joints()[joint].kind == JointKind::Fixed;
    let moving = move |&(_, &(joint, _)): &(usize, &(usize, bool))| !fixed(joint);
    let length = cycle.len();
    cycle
        .iter()
        .enumerate()
        .filter(moving)
        .map(move |(place, before)| {
            // In the link behind the joint, and from there in that behind each fixed one.
            let mut from = geometry.sides[before.0][usize::from(before.1)].translation;
            for after in cycle.iter().cycle().skip(place + 1).take(length) {
                let coming = &geometry.sides[after.0][usize::from(!after.1)];
                if fixed(after.0) {
                    let leaving = &geometry.sides[after.0][usize::from(after.1)];
                    from = leaving.apply(&coming.inverse().apply(&from));
                    continue;
                }
                let squared = |v: &mut dyn Iterator<Item = f64>| v.map(|x| x * x).sum::<f64>();
                let coming = &coming.translation;
                let apart = squared(&mut from.iter().zip(coming).map(|(a, b)| a - b)).sqrt();
                let size = squared(&mut from.iter().chain(coming).copied()).sqrt();
                // On the way across fixed joints equal places come to differ by rounding.
                return if apart > SAME_PLACE * size {
                    apart
                } else {
                    0.0
                };
            }
            0.0
        })
}

/// Null vectors in double precision at a rank that more digits may have decided; `None` where doubles do not separate it.
pub(super) fn null_vectors_in_doubles(
    matrix: &SparseMatrix<f64>,
    decision: &RankDecision,
    limit: usize,
    seed: u64,
) -> Result<Option<NullVectors<f64>>, MatrixError> {
    match null_vectors(matrix, decision, limit, seed) {
        Err(MatrixError::Decomposition { .. }) => Ok(None),
        found => found.map(Some),
    }
}

/// How often what the kernel does not show may be squared on the way, beyond what doubles follow: loops in which a joint is at rest,
/// though it may move to higher order, and couplings, in which first orders may cancel.
pub(super) fn squarings(
    mechanism: &Mechanism,
    part: &Part,
    rank: &PartRank,
    kernel: &NullVectors<f64>,
) -> usize {
    let moving: BTreeSet<usize> = rank
        .jacobian
        .variables
        .iter()
        .enumerate()
        .filter(|(row, _)| kernel.vectors.iter().any(|v| v[*row].abs() > AT_REST))
        .map(|(_, (joint, _))| *joint)
        .collect();
    let rests = |joint: &usize| mechanism.joints()[*joint].freedom() > 0 && !moving.contains(joint);
    let resting = |cycle: &&Vec<(usize, bool)>| cycle.iter().any(|(joint, _)| rests(joint));
    let loops = part.cycles.iter().filter(resting).count();
    (loops + part.couplings.len()).saturating_sub(LOOPS_IN_DOUBLE)
}
