//! Kernel, cokernel and pseudo-inverse of a Jacobian, from one singular value decomposition.

use faer::Mat;
use kutzbach_math::matrix::{MatrixError, SparseMatrix};

/// Largest matrix decomposed densely.
pub(super) const LARGEST_SIDE: usize = 600;

/// Two rows of the kernel this close in length are called equally long; see [`canonical`].
const EQUALLY_LONG: f64 = 1e-6;

/// Kernel, left kernel and pseudo-inverse of a matrix of given rank.
pub(crate) struct Splitting {
    /// An orthonormal basis of the kernel.
    pub kernel: Vec<Vec<f64>>,
    /// An orthonormal basis of the left kernel.
    pub left: Vec<Vec<f64>>,
    /// Largest singular value; zero for rank zero.
    pub largest: f64,
    /// (left vector, right vector, singular value) of the kept ones.
    kept: Vec<(Vec<f64>, Vec<f64>, f64)>,
}

impl Splitting {
    /// Decomposes a matrix; the rank must not exceed either side.
    ///
    /// The check that the factors reproduce the matrix is the one of [`kutzbach_math::matrix`]: a few roundings per entry.
    pub(crate) fn of(matrix: &SparseMatrix<f64>, rank: usize) -> Result<Self, MatrixError> {
        let (rows, columns) = (matrix.rows(), matrix.columns());
        let failure = |reason| MatrixError::Decomposition {
            rows,
            columns,
            reason,
        };
        if rank > rows.min(columns) {
            return Err(failure("the rank exceeds the shape"));
        }
        if rank == 0 {
            let unit = |size: usize| -> Vec<Vec<f64>> {
                let entry = |i: usize, j: usize| f64::from(u8::from(i == j));
                (0..size)
                    .map(|i| (0..size).map(|j| entry(i, j)).collect())
                    .collect()
            };
            return Ok(Self {
                kernel: unit(columns),
                left: unit(rows),
                largest: 0.0,
                kept: Vec::new(),
            });
        }
        matrix.largest_entry()?;
        let mut dense = Mat::<f64>::zeros(rows, columns);
        for (row, column, value) in matrix.triplets() {
            dense[(row, column)] = *value;
        }
        let svd = dense
            .svd()
            .map_err(|_| failure("the singular value decomposition did not converge"))?;
        let (u, s, v) = (svd.U(), svd.S().column_vector(), svd.V());
        let bound = 1e-14 * (rows.max(columns) as f64 + 10.0) * s[0];
        let image = &dense * v;
        for j in 0..columns {
            for i in 0..rows {
                let expected = if j < s.nrows() { u[(i, j)] * s[j] } else { 0.0 };
                if !((image[(i, j)] - expected).abs() <= bound) {
                    return Err(failure("the factors do not reproduce the matrix"));
                }
            }
        }
        let left_vector = |j: usize| -> Vec<f64> { (0..rows).map(|i| u[(i, j)]).collect() };
        let right_vector = |j: usize| -> Vec<f64> { (0..columns).map(|i| v[(i, j)]).collect() };
        Ok(Self {
            kernel: canonical((rank..columns).map(right_vector).collect()),
            left: canonical((rank..rows).map(left_vector).collect()),
            largest: s[0],
            kept: (0..rank)
                .map(|j| (left_vector(j), right_vector(j), s[j]))
                .collect(),
        })
    }

    /// Shrinks the kernel to what is across some orthonormal vectors in it.
    pub(crate) fn leave_out(&mut self, directions: &[Vec<f64>]) {
        if directions.is_empty() {
            return;
        }
        let wanted = self.kernel.len().saturating_sub(directions.len());
        // Every vector of the kernel without its share along the directions and those taken already; the longest first.
        let mut across: Vec<Vec<f64>> = Vec::with_capacity(wanted);
        while across.len() < wanted {
            let longest = self
                .kernel
                .iter()
                .map(|vector| {
                    let mut rest = vector.clone();
                    for _ in 0..2 {
                        for taken in directions.iter().chain(&across) {
                            let along = dot(taken, &rest);
                            rest.iter_mut()
                                .zip(taken)
                                .for_each(|(r, t)| *r -= along * t);
                        }
                    }
                    rest
                })
                .max_by(|a, b| dot(a, a).total_cmp(&dot(b, b)));
            let Some(mut vector) = longest else { break };
            let length = dot(&vector, &vector).sqrt();
            vector.iter_mut().for_each(|x| *x /= length);
            across.push(vector);
        }
        self.kernel = canonical(across);
    }

    /// (left vector, right vector, singular value) of what the matrix reaches.
    pub(crate) fn reached(&self) -> impl Iterator<Item = (&[f64], &[f64], f64)> {
        self.kept.iter().map(|(u, v, s)| (&u[..], &v[..], *s))
    }

    /// The rank.
    pub(super) fn rank(&self) -> usize {
        self.kept.len()
    }

    /// Replaces the bases of the two kernels by the projections of another matrix's bases on them: where the matrices are
    /// close, these are as good as orthonormal, and comparable vector by vector.
    pub(super) fn align_with(&mut self, other: &Self) {
        let project = |basis: &[Vec<f64>], wanted: &[Vec<f64>]| -> Vec<Vec<f64>> {
            let one = |vector: &Vec<f64>| {
                let mut sum = vec![0.0; vector.len()];
                for b in basis {
                    let along = dot(b, vector);
                    sum.iter_mut().zip(b).for_each(|(s, b)| *s += along * b);
                }
                sum
            };
            wanted.iter().map(one).collect()
        };
        self.kernel = project(&self.kernel, &other.kernel);
        self.left = project(&self.left, &other.left);
    }

    /// The shortest least-squares solution: J⁺ times the right side.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let columns = self.kept.first().map_or(self.kernel.len(), |k| k.1.len());
        let mut solution = vec![0.0; columns];
        for (u, v, value) in &self.kept {
            let along = dot(u, right) / value;
            for (x, v) in solution.iter_mut().zip(v) {
                *x += along * v;
            }
        }
        solution
    }
}

/// Another orthonormal basis of the same space, one that depends on the space only and not on the decomposition.
///
/// The space's projection of the unit vector that lies closest to it comes first, then the same in what is left. Of unit
/// vectors that are equally close up to a millionth the one with the lowest number is taken, so that rounding does not
/// choose among those that symmetry makes equal.
fn canonical(basis: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let dimension = basis.len();
    let size = basis.first().map_or(0, Vec::len);
    // Row i: coordinates of the projection of unit vector i.
    let mut rows: Vec<Vec<f64>> = (0..size)
        .map(|i| basis.iter().map(|b| b[i]).collect())
        .collect();
    let original = rows.clone();
    let mut chosen: Vec<Vec<f64>> = Vec::with_capacity(dimension);
    for _ in 0..dimension {
        let lengths: Vec<f64> = rows.iter().map(|r| dot(r, r).sqrt()).collect();
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let Some(pivot) = lengths
            .iter()
            .position(|l| *l > 0.0 && *l >= longest * (1.0 - EQUALLY_LONG))
        else {
            return basis;
        };
        let mut direction: Vec<f64> = rows[pivot].iter().map(|x| x / lengths[pivot]).collect();
        // Once more against those before, for what the subtraction below left.
        for before in &chosen {
            let along = dot(before, &direction);
            direction
                .iter_mut()
                .zip(before)
                .for_each(|(x, b)| *x -= along * b);
        }
        let norm = dot(&direction, &direction).sqrt();
        direction.iter_mut().for_each(|x| *x /= norm);
        for row in &mut rows {
            let along = dot(row, &direction);
            row.iter_mut()
                .zip(&direction)
                .for_each(|(x, d)| *x -= along * d);
        }
        chosen.push(direction);
    }
    chosen
        .iter()
        .map(|direction| original.iter().map(|row| dot(row, direction)).collect())
        .collect()
}

/// The sum of products.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
