//! Null vectors of small dense matrices by Householder reflections with pivoting.
//!
//! The rows of A, longest first, are reflected onto the first coordinates one by one (QR of the transpose with column pivoting).
//! After k rows the last coordinates of what is left of the others are their components across those k: the reflections take the last
//! unit vectors to an orthonormal basis of all vectors x with ‖A x‖ ≤ ‖what is left‖_F. Cost: some 2 m n k, a tenth of that of singular
//! vectors.

use super::sparse::SparseMatrix;

/// An orthonormal basis of the null space for a given rank, each vector as long as a row, and a bound of ‖A x‖ over it;
/// `None` where a row of no length would have to be reflected.
pub(super) fn null_basis(matrix: &SparseMatrix<f64>, rank: usize) -> Option<(Vec<Vec<f64>>, f64)> {
    let columns = matrix.columns();
    let mut rows = vec![vec![0.0; columns]; matrix.rows()];
    for (row, column, value) in matrix.triplets() {
        rows[row][column] = *value;
    }
    let mut mirrors: Vec<Vec<f64>> = Vec::with_capacity(rank);
    for done in 0..rank {
        let square = |row: &Vec<f64>| row[done..].iter().map(|x| x * x).sum::<f64>();
        let longest =
            (done..rows.len()).max_by(|a, b| square(&rows[*a]).total_cmp(&square(&rows[*b])))?;
        rows.swap(done, longest);
        let mirror = mirror(&rows[done][done..])?;
        for row in &mut rows[done + 1..] {
            reflect(&mirror, &mut row[done..]);
        }
        mirrors.push(mirror);
    }
    let left = rows[rank..].iter().flat_map(|row| &row[rank..]);
    let left = left.map(|x| x * x).sum::<f64>().sqrt();
    let basis = (rank..columns).map(|unit| {
        let mut vector = vec![0.0; columns];
        vector[unit] = 1.0;
        for (at, mirror) in mirrors.iter().enumerate().rev() {
            reflect(mirror, &mut vector[at..]);
        }
        vector
    });
    Some((basis.collect(), left))
}

/// The unit normal of the mirror that takes a vector onto the first axis.
fn mirror(vector: &[f64]) -> Option<Vec<f64>> {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut normal = vector.to_vec();
    // Away from zero, so that nothing cancels.
    *normal.first_mut()? += length.copysign(vector[0]);
    let size = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    (size > 0.0 && size.is_finite()).then(|| {
        normal.iter_mut().for_each(|x| *x /= size);
        normal
    })
}

fn reflect(normal: &[f64], vector: &mut [f64]) {
    let along = 2.0 * normal.iter().zip(&*vector).map(|(n, x)| n * x).sum::<f64>();
    for (x, n) in vector.iter_mut().zip(normal) {
        *x -= along * n;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::random::SplitMix64;
    use super::*;

    /// A product of two random factors, of the rank of their common side.
    fn of_rank(rows: usize, columns: usize, rank: usize) -> SparseMatrix<f64> {
        let mut random = SplitMix64::new(7);
        let mut factor = |count: usize| (0..count).map(|_| random.symmetric()).collect::<Vec<_>>();
        let (left, right) = (factor(rows * rank), factor(rank * columns));
        let entry = |i: usize, j: usize| {
            (0..rank)
                .map(|k| left[i * rank + k] * right[k * columns + j])
                .sum()
        };
        let entries = (0..rows * columns).map(|at| {
            (
                at / columns,
                at % columns,
                entry(at / columns, at % columns),
            )
        });
        SparseMatrix::from_triplets(rows, columns, 0.0, entries).unwrap()
    }

    #[test]
    fn bases_are_orthonormal_and_null() {
        for (rows, columns, rank) in [(4, 7, 3), (9, 5, 4), (6, 6, 6), (12, 20, 9), (3, 3, 0)] {
            let matrix = of_rank(rows, columns, rank);
            let (basis, left) = null_basis(&matrix, rank).unwrap();
            assert_eq!(basis.len(), columns - rank);
            assert!(left < 1e-14, "{rows} {columns} {rank}: {left}");
            for (i, one) in basis.iter().enumerate() {
                for (j, other) in basis.iter().enumerate() {
                    let dot: f64 = one.iter().zip(other).map(|(x, y)| x * y).sum();
                    assert!((dot - f64::from(u8::from(i == j))).abs() < 1e-14);
                }
                let image = matrix.multiply(one).unwrap();
                assert!(image.iter().all(|x| x.abs() < 1e-14));
            }
        }
    }

    #[test]
    fn what_is_left_bounds_the_image() {
        // Taken for rank 1, of which it is not: the second row is 1e-3 off the first.
        let entries = [(0, 0, 1.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 1.001)];
        let matrix = SparseMatrix::from_triplets(2, 2, 0.0, entries.into_iter()).unwrap();
        let (basis, left) = null_basis(&matrix, 1).unwrap();
        let image = matrix.multiply(&basis[0]).unwrap();
        let length = image.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!(
            length <= left * (1.0 + 1e-9) && left < 1e-3,
            "{length} {left}"
        );
    }
}
