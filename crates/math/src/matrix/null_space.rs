//! Bases and random samples of null spaces.
//!
//! A right null vector x has A x = 0: a motion of the joints to first order. Null vectors of the
//! transpose are the self-stresses. What these functions return was multiplied with the matrix
//! again, and the largest ‖A x‖ is reported.
//!
//! A small null space is returned whole and orthonormal. A large one would be a dense matrix of
//! columns × nullity; a few random members answer most questions about it (which components vanish
//! in all, how a generic motion looks) at a few solves each.

use super::error::MatrixError;
use super::estimate::orthonormalise;
use super::frontal::{Factorization, factor_as_planned};
use super::multifrontal::prepare;
use super::rank::RankDecision;
use super::real::Real;
use super::sparse::SparseMatrix;
use super::svd;
use super::{DENSE_COLUMNS, DENSE_ROWS};

/// Vectors of a null space, each of unit length with one component per column of the matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct NullVectors<R> {
    /// Number of components of each vector.
    pub length: usize,
    /// The vectors.
    pub vectors: Vec<Vec<R>>,
    /// True if they are an orthonormal basis, false if they are random members.
    pub complete: bool,
    /// Dimension of the null space, whether all of it is here or not.
    pub nullity: usize,
    /// Largest ‖A x‖ over the vectors relative to the largest singular value; zero for no vectors.
    pub residual: f64,
}

impl NullVectors<f64> {
    /// The vectors as the columns of a matrix, `length` × number of vectors.
    #[must_use]
    pub fn to_matrix(&self) -> nalgebra::DMatrix<f64> {
        nalgebra::DMatrix::from_fn(self.length, self.vectors.len(), |row, column| {
            self.vectors[column][row]
        })
    }
}

/// An orthonormal basis of the right null space, `columns − rank` vectors.
///
/// `decision` is that of the same matrix; if it is undecided, [`RankDecision::assuming`] chooses.
/// Time and memory grow with the square of the nullity: see [`null_vectors`] for large ones. For the
/// left null space pass the transpose and [`RankDecision::transposed`].
///
/// # Errors
/// [`MatrixError::Length`] if the decision belongs to another shape; [`MatrixError::Decomposition`]
/// if the rank is undecided, or the pivots do not separate at the given rank.
pub fn null_basis<R: Real>(
    matrix: &SparseMatrix<R>,
    decision: &RankDecision,
) -> Result<NullVectors<R>, MatrixError> {
    null_vectors(matrix, decision, usize::MAX, 0)
}

/// The orthonormal basis if the nullity is at most `limit`, else `limit` random null vectors.
///
/// The same `seed` gives the same vectors.
///
/// # Errors
/// As [`null_basis`].
pub fn null_vectors<R: Real>(
    matrix: &SparseMatrix<R>,
    decision: &RankDecision,
    limit: usize,
    seed: u64,
) -> Result<NullVectors<R>, MatrixError> {
    let rank = checked_rank(matrix, decision)?;
    let nullity = matrix.columns() - rank;
    let dense = matrix.zero().bits() == 53
        && matrix.columns() <= DENSE_COLUMNS
        && matrix.rows() <= DENSE_ROWS;
    if nullity <= limit && nullity > 0 && rank > 0 && dense {
        let scale = matrix.largest_entry()?;
        if let Some(vectors) = svd::null_basis(matrix, scale, rank) {
            let lift = |vector: Vec<f64>| -> Vec<R> {
                vector.iter().map(|&x| matrix.zero().constant(x)).collect()
            };
            let vectors = vectors.into_iter().map(lift).collect();
            return finish(matrix, decision, nullity, vectors, true);
        }
    }
    let plan = prepare(matrix);
    for tolerance in separating_tolerances(decision) {
        let factorization = factor_as_planned(matrix, &plan, tolerance)?;
        if factorization.rank() == rank {
            return null_vectors_by_qr(matrix, decision, &factorization, limit, seed);
        }
    }
    Err(failure(matrix, NOT_SEPARATED))
}

/// [`null_vectors`] from a factorization at hand, such as the one of
/// [`super::rank::decide_by_qr`].
///
/// # Errors
/// As [`null_basis`]; also [`MatrixError::Decomposition`] if the factorization has another rank
/// than the decision.
pub fn null_vectors_by_qr<R: Real>(
    matrix: &SparseMatrix<R>,
    decision: &RankDecision,
    factorization: &Factorization<R>,
    limit: usize,
    seed: u64,
) -> Result<NullVectors<R>, MatrixError> {
    let rank = checked_rank(matrix, decision)?;
    if factorization.rank() != rank {
        return Err(failure(matrix, NOT_SEPARATED));
    }
    let nullity = matrix.columns() - rank;
    let zero = matrix.zero();
    let complete = nullity <= limit;
    let mut vectors = if complete {
        let free: Vec<Vec<R>> = (0..nullity)
            .map(|i| {
                let mut unit = vec![zero.clone(); nullity];
                unit[i] = zero.one_like();
                unit
            })
            .collect();
        factorization.null_vectors(&free)?
    } else {
        factorization.random_null_vectors(limit, seed)
    };
    let sound = if complete {
        orthonormalise(zero, &mut vectors)
    } else {
        vectors
            .iter_mut()
            .all(|vector| orthonormalise(zero, std::slice::from_mut(vector)))
    };
    if !sound {
        return Err(failure(
            matrix,
            "back substitution left the range of numbers",
        ));
    }
    finish(matrix, decision, nullity, vectors, complete)
}

const NOT_SEPARATED: &str = "the pivots do not separate at the decided rank";

/// Drop tolerances (absolute) to try in turn, from the tolerance of the decision to the middle of
/// the gap between kept and dropped singular values.
///
/// Pivots and remainders are not singular values: with many dropped columns remainders can be larger
/// than σ_{k+1} and pivots smaller than σ_k by the growth of R₁₁⁻¹R₁₂, so that no one tolerance
/// always serves. The rank that comes out is compared with the decided one.
fn separating_tolerances(decision: &RankDecision) -> [f64; 4] {
    let floor = decision.dropped.max(decision.accuracy);
    let middle = (decision.kept * floor).sqrt().min(0.5 * decision.kept);
    let tolerance = decision.tolerance;
    [tolerance, middle, 10.0 * tolerance, 100.0 * tolerance].map(|t| t * decision.largest)
}

fn checked_rank<R: Real>(
    matrix: &SparseMatrix<R>,
    decision: &RankDecision,
) -> Result<usize, MatrixError> {
    for (what, expected, found) in [
        ("rows of the rank decision", matrix.rows(), decision.rows),
        (
            "columns of the rank decision",
            matrix.columns(),
            decision.columns,
        ),
    ] {
        if expected != found {
            return Err(MatrixError::Length {
                what,
                expected,
                found,
            });
        }
    }
    match decision.rank {
        Some(rank) if rank <= matrix.rows().min(matrix.columns()) => Ok(rank),
        Some(_) => Err(failure(matrix, "the rank exceeds the shape")),
        None => Err(failure(matrix, "the rank is undecided")),
    }
}

fn failure<R: Real>(matrix: &SparseMatrix<R>, reason: &'static str) -> MatrixError {
    MatrixError::Decomposition {
        rows: matrix.rows(),
        columns: matrix.columns(),
        reason,
    }
}

/// Measures the residual. The products are formed with entries of at most 1.
fn finish<R: Real>(
    matrix: &SparseMatrix<R>,
    decision: &RankDecision,
    nullity: usize,
    vectors: Vec<Vec<R>>,
    complete: bool,
) -> Result<NullVectors<R>, MatrixError> {
    let zero = matrix.zero();
    let mut residual = 0.0f64;
    for vector in &vectors {
        let image = matrix.multiply(vector)?;
        residual = residual.max(Real::to_f64(&zero.norm(&image)));
    }
    if residual > 0.0 {
        residual /= decision.largest;
    }
    Ok(NullVectors {
        length: matrix.columns(),
        vectors,
        complete,
        nullity,
        residual,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::big::Big;
    use super::super::rank::{decide, decide_by_qr};
    use super::*;

    /// [1 2 3; 2 4 6; 1 1 1]: rank 2, null vector (1, −2, 1).
    fn example() -> SparseMatrix<f64> {
        let rows = [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [1.0, 1.0, 1.0]];
        let entries = (0..9).map(|i| (i / 3, i % 3, rows[i / 3][i % 3]));
        SparseMatrix::from_triplets(3, 3, 0.0, entries).unwrap()
    }

    #[test]
    fn a_known_null_vector_by_every_route() {
        let matrix = example();
        let decision = decide(&matrix, 0.0).unwrap();
        assert_eq!(decision.nullity(), Some(1));
        let (by_qr, factorization) = decide_by_qr(&matrix, 0.0).unwrap();
        let many_digits = matrix.map(&Big::new(0.0, 106), |&x| Big::new(x, 106));
        let exact = decide(&many_digits, 0.0).unwrap();
        let big = null_basis(&many_digits, &exact).unwrap();
        assert!(big.residual < 1e-30);
        for null in [
            null_basis(&matrix, &decision).unwrap(),
            null_vectors_by_qr(&matrix, &by_qr, &factorization, 1, 0).unwrap(),
            null_vectors_by_qr(&matrix, &by_qr, &factorization, 0, 0).unwrap(),
        ] {
            assert!(null.residual < 1e-15);
            for vector in &null.vectors {
                let unit = vector[0].signum() / 6f64.sqrt();
                for (value, expected) in vector.iter().zip([unit, -2.0 * unit, unit]) {
                    assert!((value - expected).abs() < 1e-15);
                }
            }
        }
        let left = null_basis(&matrix.transpose(), &decision.transposed()).unwrap();
        assert_eq!(left.to_matrix().ncols(), 1);
        assert!((left.vectors[0][0] / left.vectors[0][1] + 2.0).abs() < 1e-14);
    }

    #[test]
    fn the_whole_space_and_nothing() {
        for (rows, columns) in [(0, 3), (3, 3), (3, 0), (0, 0), (3, 1)] {
            let zero = SparseMatrix::<f64>::from_triplets(rows, columns, 0.0, vec![]).unwrap();
            let decision = decide(&zero, 0.0).unwrap();
            assert_eq!(decision.rank, Some(0));
            let null = null_basis(&zero, &decision).unwrap();
            assert_eq!(null.vectors.len(), columns);
            assert_eq!(null.residual, 0.0);
            assert_eq!(null.to_matrix().shape(), (columns, columns));
        }
    }

    #[test]
    fn wrong_decisions_are_refused() {
        let matrix = example();
        let decision = decide(&matrix, 0.0).unwrap();
        let mut other = decision.clone();
        other.rank = None;
        assert!(null_basis(&matrix, &other).is_err());
        other.rank = Some(4);
        assert!(null_basis(&matrix, &other).is_err());
        other.columns = 5;
        assert!(null_basis(&matrix, &other).is_err());
    }
}
