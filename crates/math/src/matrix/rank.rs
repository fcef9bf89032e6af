//! How many columns of a matrix are independent, and how sure that is.
//!
//! # The rule
//! With singular values σ₁ ≥ σ₂ ≥ …, all relative to σ₁, rank k is accepted only if three things
//! hold together: the kept values stand clear of the tolerance τ (σ_k ≥ 10 τ), the others are below
//! it (σ_{k+1} ≤ τ), and a gap separates them (σ_k ≥ 1000 σ_{k+1}). Otherwise the rank is undecided
//! and two candidates are named; more digits may separate them.
//!
//! # The tolerance
//! Singular values move by no more than the 2-norm of a change of the matrix (Weyl). Two changes
//! are known. The caller's `accuracy` a states ‖ΔA‖_F ≤ a σ₁: if each of n columns of unit length
//! is known to within ε then ‖ΔA‖_F ≤ ε √n while σ₁ ≥ √(n / min(m, n)), so a = ε √min(m, n) is
//! safe. Rounding in the decomposition itself is bounded by a modest multiple of max(m, n) u σ₁ with
//! u the unit roundoff (Higham 2002, §19.3, for each reflection; LAPACK Users' Guide 1999, §4.9).
//! [`ROUNDINGS`] covers that multiple together with the operations that computed each entry, a screw
//! coordinate being some ten products and sums away from the data. So
//! τ = max([`ROUNDINGS`] · u · max(m, n), a).
//!
//! In a sparse elimination a column meets few of the rows. There max(m, n) is replaced, if that is
//! less, by the number of rows that the reflections applied to any one column have in total. A
//! tolerance that is too tight can only leave a rank undecided (a rounding error is then kept and
//! found to be small); one that is too loose would take small singular values for zero.

use super::error::{MatrixError, check_tolerance};
use super::estimate::{
    largest_singular_value, smallest_kept_singular_values, smallest_singular_values,
};
use super::frontal::{Factorization, factor_as_planned};
use super::multifrontal::{longest_passage, prepare};
use super::real::Real;
use super::sparse::SparseMatrix;
use super::svd;
use super::{DENSE_COLUMNS, DENSE_ROWS};

/// Roundings allowed for per entry, in units of roundoff; see the module's text.
pub const ROUNDINGS: f64 = 16.0;

/// Kept values must exceed the tolerance by this factor.
pub const CLEARANCE: f64 = 10.0;

/// Smallest ratio of the last kept to the first dropped value.
const SMALLEST_GAP: f64 = 1e3;

/// Many digits: the largest smaller side for which Jacobi rotations are affordable.
const JACOBI_SIDE: usize = 12;

/// Which decomposition a decision rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// All singular values, by dense bidiagonalisation (doubles).
    Svd,
    /// All singular values, by one-sided Jacobi rotations (any precision).
    Jacobi,
    /// Pivots of a sparse QR; the smallest kept singular value by inverse iteration.
    SparseQr,
}

/// A rank with its margins, or two candidates.
#[derive(Clone, Debug, PartialEq)]
pub struct RankDecision {
    /// Number of rows of the matrix.
    pub rows: usize,
    /// Number of columns of the matrix.
    pub columns: usize,
    /// The rank; `None` if the margins do not allow a decision.
    pub rank: Option<usize>,
    /// Smallest and largest rank that remain possible; equal where the rank is decided.
    pub candidates: (usize, usize),
    /// Smallest singular value above the tolerance (for [`Method::SparseQr`]: of the kept columns),
    /// relative to the largest; zero for rank 0.
    pub kept: f64,
    /// The next singular value (for [`Method::SparseQr`]: an upper bound of it), relative to the
    /// largest; zero where there is none.
    pub dropped: f64,
    /// `kept / dropped`; infinite where nothing was dropped or the dropped value is exactly zero.
    pub gap: f64,
    /// τ, relative to the largest singular value.
    pub tolerance: f64,
    /// The accuracy of the entries as the caller gave it, but not below that of rounding each.
    pub accuracy: f64,
    /// The largest singular value, absolute; an estimate for [`Method::SparseQr`]. Cut off at the
    /// largest double.
    pub largest: f64,
    /// The decomposition used.
    pub method: Method,
    /// Bits of the arithmetic used.
    pub bits: u32,
}

impl RankDecision {
    /// Dimension of the right null space, if decided.
    #[must_use]
    pub fn nullity(&self) -> Option<usize> {
        self.rank.map(|rank| self.columns - rank)
    }

    /// Dimension of the left null space, if decided.
    #[must_use]
    pub fn left_nullity(&self) -> Option<usize> {
        self.rank.map(|rank| self.rows - rank)
    }

    /// The same margins with the rank set to one of the candidates, for work that has to go on.
    ///
    /// A rank outside the shape is reduced to what the shape allows.
    #[must_use]
    pub fn assuming(&self, rank: usize) -> Self {
        let rank = rank.min(self.rows).min(self.columns);
        Self {
            rank: Some(rank),
            ..self.clone()
        }
    }

    /// The decision for the transposed matrix, which has the same singular values.
    #[must_use]
    pub fn transposed(&self) -> Self {
        Self {
            rows: self.columns,
            columns: self.rows,
            ..self.clone()
        }
    }
}

/// Decides the rank of a matrix whose entries are uncertain by `accuracy`: ‖ΔA‖_F ≤ accuracy · σ₁.
///
/// Doubles up to 300 columns and 1500 rows: singular values. Larger ones, and many digits beyond a
/// side of 12: sparse QR of the matrix or its transpose, the one with fewer columns first, as fewer
/// dropped columns leave clearer margins; the other is asked where the first leaves doubt. Scale
/// columns to unit length first ([`SparseMatrix::scale_columns`]) if
/// their lengths mean nothing; the rank is decided relative to the largest singular value of the
/// matrix as given. A matrix without nonzero entries has rank 0, decided.
///
/// # Errors
/// [`MatrixError::NotFinite`], [`MatrixError::Tolerance`]; [`MatrixError::Decomposition`] if no
/// method converges, which has not been observed.
pub fn decide<R: Real>(
    matrix: &SparseMatrix<R>,
    accuracy: f64,
) -> Result<RankDecision, MatrixError> {
    if is_small(matrix) {
        return decide_by_singular_values(matrix, accuracy);
    }
    let upright =
        |matrix| -> Result<RankDecision, MatrixError> { Ok(decide_by_qr(matrix, accuracy)?.0) };
    let lying = |matrix: &SparseMatrix<R>| -> Result<RankDecision, MatrixError> {
        let (decision, _) = decide_by_qr(&matrix.transpose(), accuracy)?;
        Ok(decision.transposed())
    };
    let tall = matrix.rows() >= matrix.columns();
    let first = if tall {
        upright(matrix)?
    } else {
        lying(matrix)?
    };
    if first.rank.is_some() {
        return Ok(first);
    }
    let second = if tall {
        lying(matrix)?
    } else {
        upright(matrix)?
    };
    Ok(if second.rank.is_some() { second } else { first })
}

/// Whether all singular values are found in little time.
fn is_small<R: Real>(matrix: &SparseMatrix<R>) -> bool {
    let doubles = matrix.zero().bits() == 53;
    matrix.rows().min(matrix.columns()) <= JACOBI_SIDE
        || (doubles && matrix.columns() <= DENSE_COLUMNS && matrix.rows() <= DENSE_ROWS)
}

/// The decisions of [`decide`] for several accuracies: of a small matrix at the cost of one.
///
/// # Errors
/// As [`decide`].
pub fn decide_each<R: Real>(
    matrix: &SparseMatrix<R>,
    accuracies: &[f64],
) -> Result<Vec<RankDecision>, MatrixError> {
    let ranks = Ranks::of(matrix)?;
    accuracies.iter().map(|&a| ranks.decide(a)).collect()
}

/// A matrix whose rank is decided for one accuracy after another, as [`decide`] does: of a small one at the cost of one decision.
#[derive(Debug)]
pub struct Ranks<'m, R> {
    matrix: &'m SparseMatrix<R>,
    /// Of a small matrix.
    values: Option<RelativeValues>,
}

impl<'m, R: Real> Ranks<'m, R> {
    /// Those of a matrix.
    ///
    /// # Errors
    /// As [`decide`].
    pub fn of(matrix: &'m SparseMatrix<R>) -> Result<Self, MatrixError> {
        let values = is_small(matrix).then(|| RelativeValues::of(matrix));
        let values = values.transpose()?;
        Ok(Self { matrix, values })
    }

    /// The rank of entries that are uncertain by `accuracy`.
    ///
    /// # Errors
    /// As [`decide`].
    pub fn decide(&self, accuracy: f64) -> Result<RankDecision, MatrixError> {
        match &self.values {
            Some(values) => values.decide(self.matrix, accuracy),
            None => decide(self.matrix, accuracy),
        }
    }
}

/// [`decide`] by singular values whatever the size.
///
/// # Errors
/// As [`decide`].
pub fn decide_by_singular_values<R: Real>(
    matrix: &SparseMatrix<R>,
    accuracy: f64,
) -> Result<RankDecision, MatrixError> {
    RelativeValues::of(matrix)?.decide(matrix, accuracy)
}

/// All singular values of a matrix.
#[derive(Debug)]
struct RelativeValues {
    /// The largest, absolute, cut off at the largest double.
    largest: f64,
    /// In falling order, the first 1; none of a matrix of zeros.
    values: Vec<f64>,
    method: Method,
}

impl RelativeValues {
    fn of<R: Real>(matrix: &SparseMatrix<R>) -> Result<Self, MatrixError> {
        let scale = matrix.largest_entry()?;
        let (method, values) = if scale == 0.0 {
            (Method::Svd, Vec::new())
        } else {
            all_singular_values(matrix, scale)?
        };
        let first = values.first().copied().unwrap_or(0.0);
        Ok(Self {
            largest: (first * scale).min(f64::MAX),
            values: values.iter().map(|value| value / first).collect(),
            method,
        })
    }

    fn decide<R: Real>(
        &self,
        matrix: &SparseMatrix<R>,
        accuracy: f64,
    ) -> Result<RankDecision, MatrixError> {
        let (mut decision, scale) = undecided(matrix, accuracy)?;
        if scale != 0.0 {
            decision.method = self.method;
            decision.largest = self.largest;
            decision.settle(&self.values);
        }
        Ok(decision)
    }
}

/// All singular values of the matrix divided by its largest entry, and what found them.
fn all_singular_values<R: Real>(
    matrix: &SparseMatrix<R>,
    scale: f64,
) -> Result<(Method, Vec<f64>), MatrixError> {
    if matrix.zero().bits() == 53
        && let Some(values) = svd::singular_values(matrix, scale)
    {
        return Ok((Method::Svd, values));
    }
    let values = svd::jacobi_values(matrix, scale).ok_or(MatrixError::Decomposition {
        rows: matrix.rows(),
        columns: matrix.columns(),
        reason: "the rotations did not converge",
    })?;
    Ok((Method::Jacobi, values))
}

/// All singular values in double precision, relative to the largest, in falling order: as many as the shorter side is long.
/// `None` for a matrix of zeros, or where the decomposition does not converge. Cost: cubic.
///
/// # Errors
/// [`MatrixError`] for entries that are not finite.
pub fn relative_singular_values(
    matrix: &SparseMatrix<f64>,
) -> Result<Option<Vec<f64>>, MatrixError> {
    let scale = matrix.largest_entry()?;
    if scale == 0.0 {
        return Ok(None);
    }
    let values = svd::singular_values(matrix, scale);
    Ok(values.map(|values| {
        let first = values.first().copied().unwrap_or(1.0);
        values.iter().map(|value| value / first).collect()
    }))
}

/// [`decide`] by sparse QR whatever the size; also returns the factorization, for null vectors.
///
/// # Errors
/// As [`decide`].
pub fn decide_by_qr<R: Real>(
    matrix: &SparseMatrix<R>,
    accuracy: f64,
) -> Result<(RankDecision, Factorization<R>), MatrixError> {
    let (mut decision, _) = undecided(matrix, accuracy)?;
    decision.method = Method::SparseQr;
    decision.largest = largest_singular_value(matrix)?;
    let plan = prepare(matrix);
    let passage = longest_passage(matrix, &plan).min(matrix.rows().max(matrix.columns()).max(1));
    let rounding = ROUNDINGS * matrix.zero().unit_roundoff() * passage as f64;
    decision.tolerance = accuracy.max(rounding);
    let factorization = factor_as_planned(matrix, &plan, decision.tolerance * decision.largest)?;
    if factorization.rank() == 0 && decision.largest > 0.0 {
        // Only where the accuracy is no better than the matrix itself.
        decision.conclude(0, 1);
    } else if factorization.rank() > 0 {
        let estimates = smallest_kept_singular_values(&factorization, 2);
        decision.settle_by_bounds(&factorization, &estimates);
        if decision.rank.is_none() {
            let estimates = smallest_singular_values(&factorization, 2)?;
            decision.settle_by_bounds(&factorization, &estimates);
        }
    }
    Ok((decision, factorization))
}

/// The decision for a zero matrix of this shape, with tolerance filled in, and the largest entry.
fn undecided<R: Real>(
    matrix: &SparseMatrix<R>,
    accuracy: f64,
) -> Result<(RankDecision, f64), MatrixError> {
    check_tolerance(accuracy)?;
    let scale = matrix.largest_entry()?;
    let roundoff = matrix.zero().unit_roundoff();
    let rounding = ROUNDINGS * roundoff;
    let longer_side = matrix.rows().max(matrix.columns()).max(1);
    let decision = RankDecision {
        rows: matrix.rows(),
        columns: matrix.columns(),
        rank: Some(0),
        candidates: (0, 0),
        kept: 0.0,
        dropped: 0.0,
        gap: f64::INFINITY,
        tolerance: accuracy.max(rounding * longer_side as f64),
        accuracy: accuracy.max(rounding),
        largest: 0.0,
        method: Method::Svd,
        bits: matrix.zero().bits(),
    };
    Ok((decision, scale))
}

impl RankDecision {
    /// Applies the rule to singular values relative to the largest, in falling order, the first 1.
    fn settle(&mut self, values: &[f64]) {
        let count = |bound: f64| values.iter().filter(|&&value| value > bound).count();
        // σ₁ itself always counts, however coarse the tolerance.
        let rank = count(self.tolerance).max(1);
        let clear = values
            .iter()
            .filter(|&&value| value >= CLEARANCE * self.tolerance)
            .count()
            .max(1);
        self.set_margins(values[rank - 1], values.get(rank).copied().unwrap_or(0.0));
        let near = count(values[clear - 1] / SMALLEST_GAP);
        let most = rank.max(near);
        self.conclude(clear, most);
    }

    /// Applies the rule to what a QR gives: rank, a bound of the dropped singular values, and
    /// estimates of the smallest kept ones, smallest first.
    fn settle_by_bounds<R: Real>(&mut self, factorization: &Factorization<R>, estimates: &[f64]) {
        let rank = factorization.rank();
        let relative: Vec<f64> = estimates.iter().map(|x| x / self.largest).collect();
        let dropped = factorization.backward_error() / self.largest;
        self.set_margins(relative.first().copied().unwrap_or(1.0), dropped);
        let clear = CLEARANCE * self.tolerance;
        let doubtful = relative.iter().filter(|&&value| value < clear).count();
        // What was dropped must be separated from the smallest value that stands clear.
        let least_clear = relative.iter().copied().find(|&value| value >= clear);
        let least_clear = least_clear.unwrap_or(clear);
        let separated = dropped <= self.tolerance && least_clear >= SMALLEST_GAP * dropped;
        let most = if separated {
            rank
        } else {
            (rank + 1).min(self.rows).min(self.columns)
        };
        self.conclude(rank - doubtful, most);
    }

    fn set_margins(&mut self, kept: f64, dropped: f64) {
        self.kept = kept;
        self.dropped = dropped;
        self.gap = if dropped == 0.0 {
            f64::INFINITY
        } else {
            kept / dropped
        };
    }

    fn conclude(&mut self, least: usize, most: usize) {
        // Not even σ₁ stands clear of so poor an accuracy.
        let least = if CLEARANCE * self.tolerance > 1.0 {
            0
        } else {
            least
        };
        self.candidates = (least, most);
        self.rank = (least == most).then_some(most);
    }
}
