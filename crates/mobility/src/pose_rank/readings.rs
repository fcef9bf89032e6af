//! The readings of a part's numbers, one after another: within the stated precision, as written, in more digits, as rounded otherwise.

use super::{
    BEYOND_FIRST_ORDER, Doubt, KnownKernel, LADDER, PartRank, Pose, RankNote, Reading, TALL,
    height_at, known_to,
};
use crate::hidden::bits_for_ratios;
use crate::more_digits::MoreDigits;
use crate::rounded::{OtherRank, if_rounded};
use crate::tree_bound::most_by_joints;
use faer::Mat;
use kutzbach_closure::{CycleJacobian, Part, residual};
use kutzbach_math::matrix::{
    CLEARANCE, DENSE_COLUMNS, MatrixError, Method, RankDecision, Ranks, Real, SparseMatrix, decide,
};

/// A part of more unknowns is not ranked in many digits, which would take minutes: it stays undecided.
const LADDER_UNKNOWNS: usize = 2000;

/// Parts of at most so many unknowns are ranked in more digits though double precision is content with them, where their
/// numbers call for it.
const CHECKED_UNKNOWNS: usize = 400;

/// A singular value smaller than this share of what stated digits leave open is not rounding: ratios that multiply make such values.
const FAR_BELOW_ROUNDING: f64 = 1e-6;

/// Rounding leaves a zero at some per cent of its bound at most. What exceeds that share is looked at with more digits.
const SUSPICIOUS: f64 = 0.05;

/// What is known of a part's rank so far.
pub(super) struct Readings<'a> {
    pose: &'a Pose<'a>,
    part: &'a Part,
    double: CycleJacobian<f64>,
    /// The Jacobian in doubles, columns of unit length, and what they were divided by.
    matrix: SparseMatrix<f64>,
    column_scales: Vec<f64>,
    standing: Standing,
    /// What the stated precision leaves open; zero where the numbers are exact, or too coarse.
    stated: f64,
    /// What rounding and the pose leave open.
    rounding: f64,
    /// What is left open where the pose may be near a singular one.
    poorer: f64,
    /// Where the numbers are too coarse: the ranks possible within their stated precision.
    coarse: Option<(usize, usize)>,
    /// Within the stated precision, and as written.
    nominal: RankDecision,
    written: RankDecision,
    /// Whether the first reading leaves some freedom that full rank would not.
    deficient: bool,
    /// Bits of the arithmetic.
    bits: u32,
    other: Option<OtherRank>,
    /// What is left of the closure in as many digits as the numbers have.
    stays_open: Option<f64>,
}

impl<'a> Readings<'a> {
    /// Within the stated precision and as written, in double precision.
    pub fn in_doubles(
        pose: &'a Pose<'a>,
        part: &'a Part,
        double: CycleJacobian<f64>,
    ) -> Result<Self, MatrixError> {
        let (mut stated, rounding_alone, coarse) = known_to(&double);
        let standing = Standing::of(pose, part, &double, stated + rounding_alone)?;
        let rounding = rounding_alone + standing.residual;
        let mut matrix = double.matrix.clone();
        let column_scales = matrix.scale_columns();
        // An assembled pose: see the text of the module above. What no step of the joints can mend is a misfit of dimensions, and says
        // nothing of how far the pose is from a closed one.
        let poorer = match standing.moved {
            true if standing.residual > rounding_alone => {
                let mendable = share_in_range(&matrix, &double.residual)?;
                (rounding_alone + mendable.unwrap_or(standing.residual)).sqrt()
            }
            true => rounding.sqrt(),
            false => 0.0,
        };
        let shift = 2.0 * standing.shift;
        let ranks = Ranks::of(&matrix)?;
        let nominal = decide_twice(&ranks, stated + rounding + shift, poorer)?;
        let mut nominal = full_within(nominal, stated, rounding + poorer + shift);
        let coarse = (coarse && nominal.rank.is_none()).then_some(nominal.candidates);
        if coarse.is_some() {
            // Numbers so coarse that they would leave every rank open were chosen, not rounded.
            stated = 0.0;
            nominal = decide_twice(&ranks, rounding, poorer)?;
        }
        let written = if stated > 0.0 {
            decide_twice(&ranks, rounding, poorer)?
        } else {
            nominal.clone()
        };
        let side = matrix.columns().min(matrix.rows());
        Ok(Self {
            pose,
            part,
            double,
            matrix,
            column_scales,
            standing,
            stated,
            rounding,
            poorer,
            coarse,
            deficient: nominal.rank.is_none_or(|rank| rank < side),
            nominal,
            written,
            bits: 53,
            other: None,
            stays_open: None,
        })
    }

    /// Bits below which the numbers' own digits are not seen, and whether anything asks for more than doubles.
    ///
    /// Exact numbers can do better than call a singular value rounding that is far above what rounding usually leaves. (Of a sparse
    /// factorisation only bounds are known, which say nothing of the kind.) What numbers of many digits leave may be meant, however
    /// small it is: then the arithmetic has to be finer than they are.
    fn suspicion(&self) -> (usize, bool) {
        let exact = self.stated == 0.0;
        let mut needed = 0;
        let mut suspicious = exact
            && !self.standing.moved
            && self.nominal.method == Method::Svd
            && self.nominal.dropped > SUSPICIOUS * self.nominal.accuracy;
        if exact && self.deficient && self.matrix.columns() <= CHECKED_UNKNOWNS {
            let tall = height_at(self.pose, self.part);
            if tall > TALL {
                suspicious = true;
                needed = 3 * tall;
            }
            if let Some(bits) = bits_for_ratios(self.pose.mechanism, self.pose.geometry, self.part)
            {
                suspicious = true;
                needed = needed.max(bits);
            }
        }
        (needed, suspicious)
    }

    /// Again with more and more digits, where doubles do not decide or leave something suspicious.
    pub fn in_more_digits(&mut self, more: &mut MoreDigits) -> Result<(), MatrixError> {
        let (needed, mut suspicious) = self.suspicion();
        let (columns, rows) = (self.matrix.columns(), self.matrix.rows());
        for rung in LADDER {
            let decided = self.nominal.rank.is_some() || self.written.rank.is_some();
            if (decided && !suspicious) || columns > LADDER_UNKNOWNS {
                break;
            }
            if (rung as usize) < needed.min(LADDER[LADDER.len() - 1] as usize) {
                continue;
            }
            suspicious = false;
            let finer = more.matrix(self.pose, self.part, self.standing.moved, rung)?;
            self.bits = rung;
            // Here the poorer accuracy alone: what a singular pose leaves of a zero is below it.
            let accuracy = finer.rounding
                + if self.standing.moved {
                    finer.residual.sqrt()
                } else {
                    finer.residual
                };
            self.written = decide(&finer.matrix, accuracy)?;
            self.nominal = if self.stated > accuracy {
                let shift = 2.0 * self.standing.shift;
                decide(&finer.matrix, self.stated + accuracy + shift)?
            } else {
                self.written.clone()
            };
            // The numbers as written do not close any better: more digits are of no use.
            let open = finer.residual > 1e3 * finer.rounding;
            if open && needed > 0 {
                // And they were meant: no pose is closed here to their last digit, and what the rank is at one nearby is open.
                self.stays_open = Some(finer.residual);
                for decision in [&mut self.written, &mut self.nominal] {
                    decision.rank = None;
                    decision.candidates.1 = columns.min(rows);
                }
                break;
            }
            if open && self.written.rank.is_none() {
                break;
            }
        }
        Ok(())
    }

    /// What sixteen digits of a program leave as written may still be rounding.
    pub fn if_rounded_otherwise(&mut self) -> Result<(), MatrixError> {
        if self.stated > 0.0 && self.nominal.rank == self.written.rank {
            let mechanism = self.pose.mechanism;
            self.other = if_rounded(mechanism, &self.double, &self.matrix, &self.written)?;
        }
        if let (Some(OtherRank { rank, .. }), Some(literal)) = (self.other, self.written.rank) {
            self.nominal.rank = None;
            self.nominal.candidates = (rank, literal);
        }
        Ok(())
    }

    /// The numbers as written, in as many digits as their ratios ask for. What rounding leaves of a zero is about as large as rounding
    /// is, or nothing: a value far below it comes from the mechanism. Not where it is said how well all numbers are known, as of those
    /// that were computed: below that their digits mean nothing.
    pub fn by_ratios(&mut self, more: &mut MoreDigits) -> Result<(), MatrixError> {
        let (pose, part) = (self.pose, self.part);
        let said = pose.mechanism.precision().by_hand().is_some();
        let asked = self.stated > 0.0 && self.deficient && !said;
        if !(asked && self.matrix.columns() <= CHECKED_UNKNOWNS) {
            return Ok(());
        }
        let Some(needed) = bits_for_ratios(pose.mechanism, pose.geometry, part) else {
            return Ok(());
        };
        let rung = LADDER.into_iter().find(|bits| *bits as usize >= needed);
        let rung = rung.unwrap_or(LADDER[LADDER.len() - 1]);
        let finer = more.matrix(pose, part, self.standing.moved, rung)?;
        let closer = decide(&finer.matrix, finer.rounding + finer.residual)?;
        let more_than_written = |rank: &usize| self.written.rank.is_none_or(|w| w < *rank);
        if closer.kept < FAR_BELOW_ROUNDING * self.stated
            && let Some(literal) = closer.rank.filter(more_than_written)
        {
            if let Some(rank) = self.nominal.rank.take() {
                self.nominal.candidates = (rank, literal);
            }
            self.written = closer;
        }
        Ok(())
    }

    /// Least and most freedom possible within the stated precision.
    fn candidates(&self) -> (usize, usize) {
        let columns = self.matrix.columns();
        let (least, most) = self.coarse.unwrap_or(self.nominal.candidates);
        let mut candidates = (columns - most, columns - least);
        if let Some(rank) = self.written.rank {
            let literal = columns - rank;
            candidates = (candidates.0.min(literal), candidates.1.max(literal));
        }
        // Whatever the numbers are.
        let most = most_by_joints(self.pose.mechanism, self.part);
        (candidates.0, candidates.1.min(most))
    }

    /// Why the answer is not plain.
    fn note(&self, possible: (usize, usize)) -> Option<RankNote> {
        let freedom = |rank: usize| self.matrix.columns() - rank;
        let literal = self.written.rank.map(freedom);
        Some(match (self.nominal.rank.map(freedom), literal) {
            (Some(answer), Some(literal)) if literal != answer => RankNote::WithinDigits {
                answer,
                literal,
                dropped: self.nominal.dropped,
                tolerance: self.nominal.tolerance,
            },
            (Some(answer), _) if self.coarse.is_some() && possible.0 < possible.1 => {
                RankNote::TooCoarse { answer, possible }
            }
            (Some(_), _) => return None,
            (None, Some(literal)) => match self.other {
                Some(other) => RankNote::RoundedOtherwise {
                    literal,
                    other: freedom(other.rank),
                    rounded_at: other.rounded_at,
                    largest: other.largest,
                    gap: other.gap,
                },
                None => RankNote::LiteralOnly {
                    literal,
                    possible,
                    kept: self.written.kept,
                    tolerance: self.nominal.tolerance,
                },
            },
            (None, None) => match self.stays_open {
                Some(residual) => RankNote::StaysOpen { residual },
                None => RankNote::Undecided {
                    possible,
                    values: (self.nominal.kept, self.nominal.dropped),
                    uncertainty: self.nominal.tolerance.max(self.poorer),
                    bits: self.nominal.bits,
                },
            },
        })
    }

    /// The answer: within the stated precision where that decides, else as written.
    pub fn concluded(self) -> PartRank {
        let columns = self.matrix.columns();
        let candidates = self.candidates();
        let note = self.note(candidates);
        let as_written = self.written.rank.map(|rank| columns - rank);
        let literal = self.nominal.rank.is_none() && self.written.rank.is_some();
        let decision = if literal { self.written } else { self.nominal };
        PartRank {
            as_written,
            instantaneous: decision.rank.map(|rank| columns - rank),
            candidates,
            reading: match self.coarse {
                Some(_) => Reading::Literal,
                None => Reading::within(self.stated),
            },
            accuracy: self.rounding.max(self.poorer).max(f64::EPSILON),
            doubt: self.other.map(|other| Doubt::Rounded(other.rounded_at)),
            bits: self.bits,
            note,
            matrix: self.matrix,
            column_scales: self.column_scales,
            jacobian: self.double,
            kernel: KnownKernel::default(),
            decision,
        }
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
            let drawn = residual(pose.mechanism, pose.geometry, &pose.geometry.states, part)?;
            if drawn.iter().all(|r| r.abs() <= closing) {
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
pub(super) fn decide_twice<R: Real>(
    ranks: &Ranks<'_, R>,
    accuracy: f64,
    poorer: f64,
) -> Result<RankDecision, MatrixError> {
    let mut decision = ranks.decide(accuracy)?;
    if poorer > accuracy && decision.rank.is_some() {
        let second = ranks.decide(poorer)?;
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
