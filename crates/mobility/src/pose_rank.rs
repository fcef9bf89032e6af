//! The instantaneous freedom of a part at a pose: a rank, with its margin, in as many digits as it takes.
//!
//! Three readings of the same numbers:
//!
//! 1. *Within the stated precision.* Entries are uncertain by what the file's decimals leave open; singular values below
//!    that are zeros that were rounded. This is the answer wherever a clear gap separates them from the rest.
//! 2. *As written.* The numbers taken literally, uncertain by rounding only. It differs from the first for a mechanism
//!    whose special geometry was rounded, and then both are reported.
//! 3. Where double precision decides neither, the geometry is evaluated again from the file's own digits with 106, 212
//!    and more bits: true zeros fall with the arithmetic, small values stay. So it is where exact numbers have many digits
//!    and double precision sees a zero, which they may have been chosen to miss: with three times as many bits as they have.
//!
//! # Poses that were assembled
//! A pose drawn closed is exact. One that was found by iteration closes to some residual ρ only, and how far that is from
//! a closed pose depends on the rank itself: with a smallest kept singular value σ, all relative to the largest, the
//! Newton step is at most ρ/σ, screws turn by no more than twice that (a screw's derivative is a bracket with another),
//! and σ is certain to be no rounding of zero if it exceeds that by far: σ² ≫ ρ. Where it does not, the pose may be close
//! to a singular one, from which an iteration stays away by √ρ. So the rank of an assembled pose must come out the same
//! with an accuracy of √ρ; otherwise more digits decide, in which ρ is smaller.
//!
//! A pose that is drawn closed within the stated precision, but not beyond, is moved by closing it exactly. What it was
//! meant to be is then as open as the way it moved.

use super::hidden::bits_for_ratios;
use super::more_digits::MoreDigits;
use super::rounded::{OtherRank, if_rounded};
use super::tree_bound::most_by_joints;
use faer::Mat;
use kutzbach_closure::{CycleJacobian, Geometry, JointState, Part, entry_accuracy, jacobian};
use kutzbach_math::matrix::{
    CLEARANCE, DENSE_COLUMNS, MatrixError, Method, RankDecision, Real, SparseMatrix, decide,
};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, Mechanism};
use std::cell::Cell;
use std::collections::BTreeSet;

/// The bits tried in turn after double precision.
pub const LADDER: [u32; 4] = [106, 212, 424, 848];

/// A part of more unknowns is not ranked in many digits, which would take minutes: it stays undecided.
const LADDER_UNKNOWNS: usize = 2000;

/// A stated precision that makes the Jacobian uncertain by more than this separates nothing: a kept singular value would
/// have to be ten times as large. Unless even so the rank is clear, the numbers are taken literally, which the report says.
const COARSEST_STATED: f64 = 0.05;

/// The stated precision bounds a Jacobian's uncertainty to first order. At 5 %, the coarsest that is used, the second order
/// is a twentieth of that; half as much again leaves room for it and for the estimate in the bound itself.
pub(super) const BEYOND_FIRST_ORDER: f64 = 1.5;

/// Parts of at most so many unknowns are ranked in more digits though double precision is content with them, where their
/// numbers call for it.
const CHECKED_UNKNOWNS: usize = 400;

/// A singular value smaller than this share of what stated digits leave open is not rounding: ratios that multiply make such values.
const FAR_BELOW_ROUNDING: f64 = 1e-6;

/// Rounding leaves a zero at some per cent of its bound at most. What exceeds that share is looked at with more digits.
const SUSPICIOUS: f64 = 0.05;

/// Numbers of more bits than this (8 decimals) can hold offsets that double precision takes for rounding.
pub(super) const TALL: usize = 27;

/// Whether a number of a part was computed from decimals: then any offset may be meant by it, or none by its last digits.
pub(super) fn is_computed(mechanism: &Mechanism, part: &Part) -> bool {
    numbers(mechanism, part).any(|x| x.stated().is_none() && x.coarsest_input().is_some())
}

/// All numbers of a part's geometry.
fn numbers<'a>(mechanism: &'a Mechanism, part: &'a Part) -> impl Iterator<Item = &'a Number> {
    let joints = part.joints.iter().flat_map(|&joint| {
        let joint = &mechanism.joints()[joint];
        let sides = [&joint.predecessor.frame, &joint.successor.frame];
        sides
            .into_iter()
            .flat_map(|frame| frame.position.iter().chain(&frame.roll_pitch_yaw))
            .chain(&joint.axis.0)
            .chain(&joint.axis2.0)
            .chain(&joint.lead)
            .chain(&joint.distance)
    });
    let couplings = part.couplings.iter().flat_map(|&coupling| {
        let coupling = &mechanism.couplings()[coupling];
        let factors = coupling.terms.iter().map(|term| &term.factor);
        factors.chain([&coupling.offset])
    });
    joints.chain(couplings)
}

/// Doubles below this share of the largest are likely to be rounding: 2^−40.
const ROUNDED: f64 = 9.1e-13;

/// Bits of the longest number that a part's geometry holds (see [`Number::height`]), or those
/// between its largest and its smallest number, if they are more than [`TALL`]: what is written as 1 m beside 1e16 m is meant. Whole
/// numbers count for that, and those that have a height; others that no decimal is in down to 2^−40 of the largest, since what is smaller is
/// likely to be the rounding of a double.
pub(super) fn height(mechanism: &Mechanism, part: &Part) -> usize {
    let mut longest = 0;
    // Sizes of numbers that are meant, and of those that are unless they are very small.
    let (mut meant, mut others) = (Vec::new(), Vec::new());
    for number in numbers(mechanism, part) {
        let bits = number.height();
        longest = longest.max(bits);
        let stated = number.stated().is_some();
        let whole = || !stated && number.rational().is_some_and(|x| x.is_int());
        let size = number.value().abs();
        if size > 0.0 && (bits > 0 || whole()) {
            meant.push(size);
        } else if size > 0.0 && number.coarsest_input().is_none() {
            others.push(size);
        }
    }
    let largest = |sizes: &[f64]| sizes.iter().copied().fold(0.0, f64::max);
    let most = largest(&meant).max(largest(&others));
    let likely = others.iter().filter(|size| **size >= ROUNDED * most);
    let least = meant
        .iter()
        .chain(likely)
        .copied()
        .fold(f64::INFINITY, f64::min);
    let spread = if most > least {
        (most.log2() - least.log2()).ceil() as usize
    } else {
        0
    };
    // Doubles hold less beside one another without loss.
    if spread > TALL {
        longest.max(spread)
    } else {
        longest
    }
}

/// [`height`], the values that a configuration gives the part's joints included.
pub(super) fn height_at(pose: &Pose<'_>, part: &Part) -> usize {
    let values = pose.configuration.iter().flat_map(|c| &c.positions);
    values
        .filter(|(joint, _)| part.joints.contains(&joint.0))
        .flat_map(|(_, values)| values.iter().map(kutzbach_math::number::Number::height))
        .fold(height(pose.mechanism, part), usize::max)
}

/// The rank of a part at a pose.
#[derive(Clone, Debug)]
pub struct PartRank {
    /// The decision that the answer rests on, about the Jacobian with unit columns.
    pub decision: RankDecision,
    /// Freedom when the numbers are taken literally, where that differs or is the only reading decided.
    pub as_written: Option<usize>,
    /// The instantaneous freedom, or `None` where even the last rung leaves it open.
    pub instantaneous: Option<usize>,
    /// Smallest and largest instantaneous freedom that remain possible within the stated precision.
    pub candidates: (usize, usize),
    /// Whether the stated precision was too coarse to be used, so that the numbers were taken literally.
    pub taken_literally: bool,
    /// Relative uncertainty of the Jacobian by the file's stated precision; zero where the numbers are exact.
    pub stated: f64,
    /// Relative uncertainty of the Jacobian in double precision, whatever its cause: that of everything computed from it.
    pub accuracy: f64,
    /// What speaks against the rank though its margins are clear; then [`Self::note`] says it.
    pub doubt: Option<Doubt>,
    /// Bits of the arithmetic that decided.
    pub bits: u32,
    /// Why the answer is not plain, in one sentence.
    pub note: Option<String>,
    /// The Jacobian in double precision, columns of unit length, for everything that needs vectors.
    pub matrix: SparseMatrix<f64>,
    /// Norms by which the columns were divided.
    pub column_scales: Vec<f64>,
    /// The linearised equations the matrix was made from.
    pub jacobian: CycleJacobian<f64>,
}

impl PartRank {
    /// Number of unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.matrix.columns()
    }

    /// Number of equations.
    #[must_use]
    pub fn equations(&self) -> usize {
        self.matrix.rows()
    }

    /// The decision with its rank set to the one the answer uses, for null vectors.
    #[must_use]
    pub fn settled(&self) -> Option<RankDecision> {
        let freedom = self.instantaneous?;
        // Margins of the double-precision matrix: its null vectors are computed in double precision.
        Some(RankDecision {
            accuracy: self.decision.accuracy.max(self.accuracy),
            ..self.decision.assuming(self.matrix.columns() - freedom)
        })
    }
}

/// What speaks against a rank whose margins are clear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// It is another if the coordinates, though printed with the digits of doubles, are rounded: at this power of ten (m, rad)
    /// or more coarsely.
    Rounded(f64),
    /// A copy or mirror image of the part has another.
    Unlike,
}

/// What the ladder needs to evaluate a part again.
pub struct Pose<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its pose in the file.
    pub configuration: Option<&'a Configuration>,
    /// Joints that keep their configured values.
    pub held: &'a BTreeSet<usize>,
    /// Geometry in double precision.
    pub geometry: &'a Geometry<f64>,
    /// Assembled states.
    pub states: &'a [JointState<f64>],
    /// Whether assembly left the file pose untouched.
    pub as_drawn: bool,
    /// For what is tried on the states.
    pub trial: Trial,
}

/// A copy of the states of a pose on which parts are moved, made once for all of them.
#[derive(Default)]
pub struct Trial(Cell<Vec<JointState<f64>>>);

impl Pose<'_> {
    /// Calls `moved` with a copy of the states in which the joints of one part may be moved. They are put back after.
    pub(super) fn try_on<T>(
        &self,
        part: &Part,
        moved: impl FnOnce(&mut [JointState<f64>]) -> T,
    ) -> T {
        let mut states = self.trial.0.take();
        if states.is_empty() {
            states = self.states.to_vec();
        }
        let found = moved(&mut states);
        for &joint in &part.joints {
            states[joint] = self.states[joint].clone();
        }
        self.trial.0.set(states);
        found
    }
}

/// How a part's pose came about.
struct Standing {
    /// Whether assembly moved a joint of the part.
    moved: bool,
    /// What is left of the cycles (rad, cycle lengths), if more than a drawn pose's own rounding.
    residual: f64,
    /// How far joints moved (rad, part lengths) from a drawn pose that closes within the stated precision.
    shift: f64,
}

impl Standing {
    fn of(
        pose: &Pose<'_>,
        part: &Part,
        here: &CycleJacobian<f64>,
        closing: f64,
    ) -> Result<Self, MatrixError> {
        let mut standing = Self {
            moved: false,
            residual: 0.0,
            shift: 0.0,
        };
        if pose.as_drawn {
            return Ok(standing);
        }
        let ways: Vec<f64> = here
            .variables
            .iter()
            .enumerate()
            .map(|(column, &(joint, variable))| {
                let way = pose.states[joint].values[variable]
                    - pose.geometry.states[joint].values[variable];
                way / here.unit(pose.mechanism, column)
            })
            .collect();
        // A pose that is closed only because a coarser tolerance was asked for stands beside a closed one, as a moved one does.
        let open = here.residual.iter().any(|r| r.abs() > closing);
        standing.moved = open || ways.iter().any(|way| *way != 0.0);
        if standing.moved {
            standing.residual = 0.0.norm(&here.residual);
            let drawn = jacobian(pose.mechanism, pose.geometry, &pose.geometry.states, part)?;
            if drawn.residual.iter().all(|r| r.abs() <= closing) {
                standing.shift = 0.0.norm(&ways);
            }
        }
        Ok(standing)
    }
}

/// The share of a residual in the range of the equations (rad, cycle lengths): what the joints could mend to first order. `None` of
/// matrices that are not decomposed.
fn share_in_range(
    matrix: &SparseMatrix<f64>,
    residual: &[f64],
) -> Result<Option<f64>, MatrixError> {
    if matrix.columns() > DENSE_COLUMNS {
        return Ok(None);
    }
    let mut dense = Mat::<f64>::zeros(matrix.rows(), matrix.columns());
    for (row, column, entry) in matrix.triplets() {
        dense[(row, column)] += entry;
    }
    let Ok(svd) = dense.thin_svd() else {
        return Ok(None);
    };
    let u = svd.U();
    let along = |j: usize| -> f64 { (0..u.nrows()).map(|i| u[(i, j)] * residual[i]).sum() };
    Ok(Some(
        (0..u.ncols()).map(|j| along(j).powi(2)).sum::<f64>().sqrt(),
    ))
}

/// Decides a rank that has to come out the same with the poorer of two accuracies.
fn decide_twice<R: Real>(
    matrix: &SparseMatrix<R>,
    accuracy: f64,
    poorer: f64,
) -> Result<RankDecision, MatrixError> {
    let mut decision = decide(matrix, accuracy)?;
    if poorer > accuracy && decision.rank.is_some() {
        let second = decide(matrix, poorer)?;
        if second.rank != decision.rank {
            decision.rank = None;
            decision.candidates.0 = decision.candidates.0.min(second.candidates.0);
            decision.candidates.1 = decision.candidates.1.max(second.candidates.1);
        }
    }
    Ok(decision)
}

/// The decision within the stated precision, where full rank is provable: singular values move by no more than the norm of
/// the perturbation (Weyl), so that a smallest one above it cannot be a rounded zero, and no gap has to separate it from
/// anything. `other` is what else the entries are uncertain by, of which there is only an estimate.
fn full_within(decision: RankDecision, stated: f64, other: f64) -> RankDecision {
    let side = decision.rows.min(decision.columns);
    let all_kept = decision.candidates.1 == side && decision.dropped == 0.0;
    let bound = BEYOND_FIRST_ORDER * stated + CLEARANCE * other;
    let proved = stated > 0.0 && all_kept && decision.kept > bound;
    if decision.rank.is_some() || decision.method != Method::Svd || !proved {
        return decision;
    }
    RankDecision {
        rank: Some(side),
        candidates: (side, side),
        ..decision
    }
}

/// Decides the rank of one part. Parts that double precision leaves open are evaluated anew each time; see [`MoreDigits`]
/// for ranking many.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn rank_part(pose: &Pose<'_>, part: &Part) -> Result<PartRank, MatrixError> {
    rank_part_with(pose, &mut MoreDigits::new(), part, None)
}

/// The accuracy of a part's Jacobian: (stated precision, rounding), and whether the first is too coarse to be of use.
pub(super) fn known_to(jacobian: &CycleJacobian<f64>) -> (f64, f64, bool) {
    let (stated, rounding) = entry_accuracy(jacobian);
    (stated, rounding, stated > COARSEST_STATED)
}

/// The rank of the numbers as written, in as many digits as their ratios ask for; `None` where doubles suffice. What rounding leaves
/// of a zero is about as large as rounding is, or nothing: a value far below it comes from the mechanism.
fn in_digits_of_ratios(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    moved: bool,
) -> Result<Option<RankDecision>, MatrixError> {
    let Some(needed) = bits_for_ratios(pose.mechanism, pose.geometry, part) else {
        return Ok(None);
    };
    let rung = LADDER.into_iter().find(|bits| *bits as usize >= needed);
    let finer = more.matrix(pose, part, moved, rung.unwrap_or(LADDER[LADDER.len() - 1]))?;
    decide(&finer.matrix, finer.rounding + finer.residual).map(Some)
}

/// [`rank_part`], sharing what is evaluated in many digits with other parts. `known` are the part's equations at the pose,
/// where somebody has evaluated them before.
pub(super) fn rank_part_with(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    known: Option<CycleJacobian<f64>>,
) -> Result<PartRank, MatrixError> {
    let double = match known {
        Some(known) => known,
        None => jacobian(pose.mechanism, pose.geometry, pose.states, part)?,
    };
    let (mut stated, rounding, mut coarse) = known_to(&double);
    let standing = Standing::of(pose, part, &double, stated + rounding)?;
    let rounding_alone = rounding;
    let rounding = rounding + standing.residual;
    let mut matrix = double.matrix.clone();
    let column_scales = matrix.scale_columns();
    let columns = matrix.columns();
    // An assembled pose: see the module's text. What no step of the joints can mend is a misfit of dimensions, and says nothing of how far
    // the pose is from a closed one.
    let poorer = match standing.moved {
        true if standing.residual > rounding_alone => {
            let mendable = share_in_range(&matrix, &double.residual)?;
            (rounding_alone + mendable.unwrap_or(standing.residual)).sqrt()
        }
        true => rounding.sqrt(),
        false => 0.0,
    };
    let nominal = decide_twice(&matrix, stated + rounding + 2.0 * standing.shift, poorer)?;
    let mut nominal = full_within(nominal, stated, rounding + poorer + 2.0 * standing.shift);
    coarse &= nominal.rank.is_none();
    let mut possible = None;
    if coarse {
        possible = Some(nominal.candidates);
        // Numbers so coarse that they would leave every rank open were chosen, not rounded.
        stated = 0.0;
        nominal = decide_twice(&matrix, rounding, poorer)?;
    }
    let mut written = if stated > 0.0 {
        decide_twice(&matrix, rounding, poorer)?
    } else {
        nominal.clone()
    };
    let mut bits = 53;
    // Exact numbers can do better than call a singular value rounding that is far above what rounding usually leaves.
    // (Of a sparse factorisation only bounds are known, which say nothing of the kind.) What numbers of many digits leave
    // may be meant, however small it is: then the arithmetic has to be finer than they are.
    let mut suspicious = false;
    let mut finest_needed = 0;
    let mut stays_open = None;
    let deficient = nominal
        .rank
        .is_none_or(|rank| rank < columns.min(matrix.rows()));
    if stated == 0.0 && deficient && columns <= CHECKED_UNKNOWNS {
        let tall = height_at(pose, part);
        if tall > TALL {
            suspicious = true;
            finest_needed = 3 * tall;
        }
        if let Some(needed) = bits_for_ratios(pose.mechanism, pose.geometry, part) {
            suspicious = true;
            finest_needed = finest_needed.max(needed);
        }
    }
    suspicious |= stated == 0.0
        && !standing.moved
        && nominal.method == Method::Svd
        && nominal.dropped > SUSPICIOUS * nominal.accuracy;
    for rung in LADDER {
        let decided = nominal.rank.is_some() || written.rank.is_some();
        if (decided && !suspicious) || columns > LADDER_UNKNOWNS {
            break;
        }
        if (rung as usize) < finest_needed.min(LADDER[LADDER.len() - 1] as usize) {
            continue;
        }
        suspicious = false;
        let finer = more.matrix(pose, part, standing.moved, rung)?;
        bits = rung;
        // Here the poorer accuracy alone: what a singular pose leaves of a zero is below it.
        let accuracy = finer.rounding
            + if standing.moved {
                finer.residual.sqrt()
            } else {
                finer.residual
            };
        written = decide(&finer.matrix, accuracy)?;
        nominal = if stated > accuracy {
            decide(&finer.matrix, stated + accuracy + 2.0 * standing.shift)?
        } else {
            written.clone()
        };
        if finer.residual > 1e3 * finer.rounding {
            // The numbers as written do not close any better, so that more digits are of no use.
            if finest_needed > 0 {
                // And they were meant: no pose is closed here to their last digit, and what the rank is at one nearby is open.
                stays_open = Some(finer.residual);
                for decision in [&mut written, &mut nominal] {
                    decision.rank = None;
                    decision.candidates.1 = columns.min(matrix.rows());
                }
                break;
            }
            if written.rank.is_none() {
                break;
            }
        }
    }
    // What sixteen digits of a program leave as written may still be rounding.
    let mut other = None;
    if stated > 0.0 && nominal.rank == written.rank {
        other = if_rounded(pose.mechanism, &double, &matrix, &written)?;
    }
    if let (Some(OtherRank { rank, .. }), Some(literal)) = (other, written.rank) {
        nominal.rank = None;
        nominal.candidates = (rank, literal);
    }
    if stated > 0.0 && deficient && columns <= CHECKED_UNKNOWNS {
        let seen = in_digits_of_ratios(pose, more, part, standing.moved)?;
        if let Some(closer) = seen.filter(|c| c.kept < FAR_BELOW_ROUNDING * stated)
            && let Some(literal) = closer.rank.filter(|r| written.rank.is_none_or(|w| w < *r))
        {
            if let Some(rank) = nominal.rank.take() {
                nominal.candidates = (rank, literal);
            }
            written = closer;
        }
    }
    let freedom = |rank: usize| columns - rank;
    let (least, most) = possible.unwrap_or(nominal.candidates);
    let literal = written.rank.map(freedom);
    let mut candidates = (freedom(most), freedom(least));
    if let Some(literal) = literal {
        candidates = (candidates.0.min(literal), candidates.1.max(literal));
    }
    // Whatever the numbers are.
    candidates.1 = candidates.1.min(most_by_joints(pose.mechanism, part));
    let (instantaneous, decision, note) = match (nominal.rank.map(freedom), literal) {
        (Some(answer), Some(literal)) if literal != answer => {
            let note = format!(
                "taken literally, the numbers leave {literal} instead of {answer}: the smallest singular values, up to \
                 {:.1e} of the largest, are below what the stated precision leaves open ({:.1e})",
                nominal.dropped, nominal.tolerance
            );
            (Some(answer), nominal, Some(note))
        }
        (Some(answer), _) if coarse && candidates.0 < candidates.1 => {
            let note = format!(
                "{answer} as written, but the numbers are too coarse to decide: within their stated precision anything \
                 from {} to {} is possible",
                candidates.0, candidates.1
            );
            (Some(answer), nominal, Some(note))
        }
        (Some(answer), _) => (Some(answer), nominal, None),
        (None, Some(literal)) if let Some(other) = other => {
            let note = format!(
                "{literal} as written, or {} if the coordinates are rounded at {:e} (m, rad) or more coarsely: singular values up to \
                 {:.1e} of the largest stand alone, a factor of {:.0e} below the others, and the file's digits are those that \
                 programs print, which does not say how well they are known; `--precision` states it",
                freedom(other.rank),
                other.rounded_at,
                other.largest,
                other.gap,
            );
            (Some(literal), written, Some(note))
        }
        (None, Some(literal)) => {
            let note = format!(
                "the numbers taken literally leave {literal}; within their stated precision anything from {} to {} is \
                 possible (smallest singular value {:.1e} of the largest, uncertainty {:.1e}): more digits would decide",
                candidates.0, candidates.1, written.kept, nominal.tolerance
            );
            (Some(literal), written, Some(note))
        }
        (None, None) if stays_open.is_some() => {
            let note = format!(
                "in as many digits as the numbers have, the loops stay open by {:.1e}: the pose drawn is not closed, and at a \
                 closed one nearby the rank may be another",
                stays_open.unwrap_or(0.0)
            );
            (None, nominal, Some(note))
        }
        (None, None) => {
            let note = format!(
                "undecided between {} and {}: singular values {:.1e} and {:.1e} of the largest are not separated from \
                 the uncertainty {:.1e}, with {} bits",
                candidates.0,
                candidates.1,
                nominal.kept,
                nominal.dropped,
                nominal.tolerance.max(poorer),
                nominal.bits
            );
            (None, nominal, Some(note))
        }
    };
    Ok(PartRank {
        as_written: literal,
        instantaneous,
        candidates,
        taken_literally: coarse,
        stated,
        accuracy: rounding.max(poorer).max(f64::EPSILON),
        doubt: other.map(|other| Doubt::Rounded(other.rounded_at)),
        bits,
        note,
        matrix,
        column_scales,
        jacobian: double,
        decision,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
