//! Rank-revealing QR of sparse matrices by dense fronts.
//!
//! # The rule and why it is right
//! The plan of [`super::ordering`] brings every row that still contains a pivot column of a front
//! into that front. Inside it Householder reflections with column pivoting eliminate the pivot
//! columns. When the largest remaining pivot column is no longer than the tolerance, all remaining
//! ones are *dropped*: no row is used up for them and they leave for good (Heath 1982, §3).
//!
//! No column has to be deferred. Let Q be the product of all reflections so far and K the columns
//! kept as pivots so far. Rows are used up exactly one per kept column, so QᵀA restricted to K is
//! \[T; 0\] with T square, triangular, nonsingular. All unfinished rows that contain a pivot column c
//! of this front are in this front. If c has only zeros there, then Qᵀc = \[t; 0\], hence
//! c = Σ K (T⁻¹t): it depends on the kept columns, and no later reflection touches it, as its
//! entries in unfinished rows are zero. So in exact arithmetic the kept columns are a basis of the
//! column space: rank = number of kept columns.
//!
//! With rounding, setting the remainder of each dropped column to zero changes A by E with
//! ‖E‖_F = √(Σ remainder²), as Q is orthogonal and each column is dropped once. A + E has rank
//! exactly k, so σ_{k+1}(A) ≤ ‖E‖_F: [`Factorization::backward_error`]. The other half, that σ_k is
//! *not* small, cannot be read off the pivots (Kahan 1966: all pivots moderate, σ_k tiny); it is
//! checked by [`super::estimate`].
//!
//! Cost: Σ (rows · pivots · columns) over the fronts; linear for chains. Memory: the rows of R.

use super::error::{MatrixError, check_tolerance};
use super::multifrontal::{Dense, Kernel, Triangle, eliminate, prepare};
use super::ordering::EliminationPlan;
use super::real::Real;
use super::sparse::SparseMatrix;

/// R of a rank-revealing QR factorization and what was dropped on the way.
#[derive(Clone, Debug)]
pub struct Factorization<R> {
    /// The triangular factor.
    pub triangle: Triangle<R>,
    smallest_kept: f64,
    largest_dropped: f64,
    backward_error: f64,
    /// The factor belongs to the matrix times 2^−exponent; the lengths above are unscaled.
    pub exponent: i32,
}

impl<R: Real> Factorization<R> {
    /// Number of kept columns.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.triangle.rank()
    }

    /// The dropped columns in the order in which they were dropped; columns without entries last.
    ///
    /// They are the free unknowns of A x = 0: see [`Factorization::null_vectors`].
    #[must_use]
    pub fn dropped_columns(&self) -> &[usize] {
        self.triangle.dropped()
    }

    /// Smallest |pivot| kept; infinite if none was. Not less than the smallest singular value of
    /// the kept columns, and possibly much more.
    #[must_use]
    pub fn smallest_kept(&self) -> f64 {
        self.smallest_kept
    }

    /// Longest remainder of a dropped column; zero if none was dropped.
    #[must_use]
    pub fn largest_dropped(&self) -> f64 {
        self.largest_dropped
    }

    /// √(Σ remainder²): upper bound of σ_{k+1}, up to rounding.
    #[must_use]
    pub fn backward_error(&self) -> f64 {
        self.backward_error
    }

    /// Number of stored entries of R, the measure of fill.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.triangle.stored()
    }

    /// Null vectors with given values on the dropped columns.
    ///
    /// Each element of `free` holds one value per column of [`Factorization::dropped_columns`], in
    /// that order; the kept components follow as −R₁₁⁻¹ R₁₂ · free. Vectors have one component per
    /// column and are not normalised; ‖A x‖ ≤ `backward_error` · ‖x‖ up to rounding. The unit
    /// vectors as `free` give a full basis.
    ///
    /// # Errors
    /// [`MatrixError::Length`] where a list of free values has the wrong length.
    pub fn null_vectors(&self, free: &[Vec<R>]) -> Result<Vec<Vec<R>>, MatrixError> {
        self.triangle.null_vectors(free)
    }

    /// `count` null vectors with independent uniform values in [−1, 1) on the dropped columns.
    ///
    /// A component that is zero in one of them is zero in all null vectors, but for a choice of
    /// measure zero. The same seed gives the same vectors.
    #[must_use]
    pub fn random_null_vectors(&self, count: usize, seed: u64) -> Vec<Vec<R>> {
        let zero = self.triangle.zero();
        self.triangle
            .random_null_vectors(count, seed, |random| zero.constant(random.symmetric()))
    }
}

/// Factors a matrix; pivot columns whose remainder is not longer than `tolerance` (absolute, in
/// the units of the entries) are dropped.
///
/// Any shape is accepted, also without rows or columns. The result does not depend on row blocks
/// except for rounding and time.
///
/// # Errors
/// [`MatrixError::NotFinite`] for entries that are not finite doubles,
/// [`MatrixError::Tolerance`] for a tolerance that is negative or not finite.
pub fn factor<R: Real>(
    matrix: &SparseMatrix<R>,
    tolerance: f64,
) -> Result<Factorization<R>, MatrixError> {
    factor_as_planned(matrix, &prepare(matrix), tolerance)
}

/// Factors matrices of one pattern one after another: the order of elimination is found once, and anew only for entries at new
/// places.
#[derive(Clone, Debug, Default)]
pub struct Refactoring<R> {
    before: Option<(SparseMatrix<R>, EliminationPlan)>,
}

impl<R: Real> Refactoring<R> {
    /// As [`factor`], with the same result but for rounding.
    ///
    /// # Errors
    /// Those of [`factor`].
    pub fn factor(
        &mut self,
        matrix: &SparseMatrix<R>,
        tolerance: f64,
    ) -> Result<Factorization<R>, MatrixError> {
        let before = self.before.take().filter(|(m, _)| m.has_shape_of(matrix));
        let planned = match before {
            Some(planned) if planned.0.covers(matrix) => planned,
            // An entry may vanish at a pose: the order serves both patterns from here on.
            Some((pattern, _)) => {
                let both = pattern.united(matrix);
                let plan = prepare(&both);
                (both, plan)
            }
            None => (matrix.clone(), prepare(matrix)),
        };
        let found = factor_as_planned(matrix, &planned.1, tolerance);
        self.before = Some(planned);
        found
    }
}

/// [`factor`] with the plan of the same matrix at hand.
pub(crate) fn factor_as_planned<R: Real>(
    matrix: &SparseMatrix<R>,
    plan: &EliminationPlan,
    tolerance: f64,
) -> Result<Factorization<R>, MatrixError> {
    check_tolerance(tolerance)?;
    let exponent = scaling_exponent(matrix.largest_entry()?);
    let mut kernel = Householder {
        tolerance: times_power_of_two(tolerance, -exponent),
        smallest_kept: f64::INFINITY,
        largest_dropped: 0.0,
        dropped_squared: 0.0,
    };
    let triangle = if exponent == 0 {
        eliminate(matrix, plan, &mut kernel)
    } else {
        let zero = matrix.zero();
        let half = zero.constant(2f64.powi(-exponent / 2));
        let rest = zero.constant(2f64.powi(-(exponent - exponent / 2)));
        let scaled = matrix.map(zero, |value| value.clone() * half.clone() * rest.clone());
        eliminate(&scaled, plan, &mut kernel)
    };
    let unscaled = |length| times_power_of_two(length, exponent);
    Ok(Factorization {
        triangle,
        smallest_kept: unscaled(kernel.smallest_kept),
        largest_dropped: unscaled(kernel.largest_dropped),
        backward_error: unscaled(kernel.dropped_squared.sqrt()),
        exponent,
    })
}

/// Zero where squares of the entries stay in range, else the binary exponent of the largest.
fn scaling_exponent(largest: f64) -> i32 {
    if largest == 0.0 || (1e-80..=1e80).contains(&largest) {
        0
    } else {
        largest.log2() as i32
    }
}

/// `value` · 2^exponent in two steps, as 2^exponent itself may be out of range.
pub(crate) fn times_power_of_two(value: f64, exponent: i32) -> f64 {
    value * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
}

/// Householder reflections with column pivoting and dropping.
struct Householder {
    tolerance: f64,
    smallest_kept: f64,
    largest_dropped: f64,
    dropped_squared: f64,
}

impl<R: Real> Kernel<R> for Householder {
    /// Remainders are measured anew at every step: updating them by subtraction, as LAPACK does,
    /// loses the very digits that a rank decision needs.
    fn eliminate_pivots(
        &mut self,
        dense: &mut Dense<R>,
        columns: &mut [usize],
        pivots: usize,
    ) -> usize {
        for kept in 0..pivots {
            let lengths: Vec<R> = (kept..pivots)
                .map(|column| {
                    let tail = dense.tail(column, kept);
                    dense.values[0].norm(tail)
                })
                .collect();
            let mut best = 0;
            for candidate in 1..lengths.len() {
                if lengths[candidate] > lengths[best] {
                    best = candidate;
                }
            }
            let size = Real::to_f64(&lengths[best]);
            if size > self.tolerance {
                dense.swap_columns(kept, kept + best);
                columns.swap(kept, kept + best);
                reflect(dense, kept, kept, &lengths[best]);
                self.smallest_kept = self.smallest_kept.min(size);
            } else {
                for length in &lengths {
                    let size = Real::to_f64(length);
                    self.largest_dropped = self.largest_dropped.max(size);
                    self.dropped_squared += size * size;
                }
                return kept;
            }
        }
        pivots
    }

    fn eliminate_column(&mut self, dense: &mut Dense<R>, column: usize, top: usize) -> bool {
        let length = dense.values[0].norm(dense.tail(column, top));
        if length.is_zero() {
            return false;
        }
        reflect(dense, column, top, &length);
        true
    }
}

/// Makes `column` zero below row `top` by one reflection of the rows from `top` on, applied to the
/// columns after it. `length` is the length of that tail, not zero.
///
/// Householder vector with the sign that avoids cancellation (Golub and Van Loan 2013, §5.1).
fn reflect<R: Real>(dense: &mut Dense<R>, column: usize, top: usize, length: &R) {
    let rows = dense.rows;
    let zero = length.zero_like();
    let mut vector = dense.tail(column, top).to_vec();
    let first = vector[0].clone();
    let signed = if first < zero {
        -length.clone()
    } else {
        length.clone()
    };
    vector[0] = first.clone() + signed.clone();
    // Half of vᵀv is length · (length + |first|).
    let half_square = length.clone() * (length.clone() + first.abs());
    for target in dense.values[(column + 1) * rows..].chunks_exact_mut(rows) {
        let tail = &mut target[top..];
        let product = zero.dot(&vector, tail);
        if !product.is_zero() {
            (-(product / half_square.clone())).add_scaled(&vector, tail);
        }
    }
    let own = &mut dense.values[column * rows + top..(column + 1) * rows];
    own.fill(zero);
    own[0] = -signed;
}
