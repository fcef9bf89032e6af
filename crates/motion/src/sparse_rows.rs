//! The independent equations of a large part: chosen once at a pose of the branch, factored sparsely at every pose.

use kutzbach_math::matrix::{Factorization, MatrixError, Real, Refactoring, SparseMatrix, factor};

/// Equations are told from combinations of others by remainders above these, relative to the largest entry: at a pose of
/// the branch, closed to rounding, true dependence leaves about 1e-13; the others are tried where fewer equations than
/// known are found.
const TOLERANCES: [f64; 5] = [1e-9, 1e-11, 1e-7, 1e-5, 1e-12];

/// Sweeps of inverse iteration.
const SWEEPS: usize = 6;

/// Sweeps at most that make a tangent: each leaves εκ² of what is off, for a condition κ, so that two or three do.
const TANGENT_SWEEPS: usize = 8;

/// The chosen equations of a large part.
#[derive(Clone, Debug)]
pub(super) struct SparseRows {
    unknowns: usize,
    equations: usize,
    /// Position of every equation among the chosen ones.
    position: Vec<Option<usize>>,
    chosen: Vec<usize>,
    /// Chosen equations as columns, and their factor.
    columns: Option<(SparseMatrix<f64>, Factorization<f64>)>,
    refactoring: Refactoring<f64>,
    /// The unit vector that no chosen equation sees.
    pub tangent: Vec<f64>,
}

fn normalise(x: &mut [f64]) -> bool {
    let length = 0.0.norm(x);
    if !(length > 0.0) || !length.is_finite() {
        return false;
    }
    x.iter_mut().for_each(|v| *v /= length);
    true
}

impl SparseRows {
    pub fn new(unknowns: usize, equations: usize) -> Self {
        let mut random = kutzbach_math::matrix::SplitMix64::new(1);
        Self {
            unknowns,
            equations,
            position: vec![None; equations],
            chosen: Vec::new(),
            columns: None,
            refactoring: Refactoring::default(),
            tangent: (0..unknowns).map(|_| random.symmetric()).collect(),
        }
    }

    pub fn chosen(&self) -> &[usize] {
        &self.chosen
    }

    /// Chooses equations at a pose of the branch. False where no tolerance tells as many apart as should be.
    ///
    /// # Errors
    /// [`MatrixError`] for entries that are not finite.
    pub fn choose(
        &mut self,
        entries: impl Iterator<Item = (usize, usize, f64)>,
    ) -> Result<bool, MatrixError> {
        let turned: Vec<(usize, usize, f64)> = entries.map(|(r, c, v)| (c, r, v)).collect();
        let matrix = SparseMatrix::from_triplets(self.unknowns, self.equations, 0.0, turned)?;
        let scale = matrix.largest_entry()?.max(f64::MIN_POSITIVE);
        for tolerance in TOLERANCES {
            let found = factor(&matrix, tolerance * scale)?;
            if found.rank() + 1 == self.unknowns {
                self.chosen = found.triangle.kept().collect();
                self.chosen.sort_unstable();
                self.position = vec![None; self.equations];
                for (place, &equation) in self.chosen.iter().enumerate() {
                    self.position[equation] = Some(place);
                }
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Factors the chosen equations at a pose and finds their tangent, starting from the last one. False where they are
    /// not independent there.
    ///
    /// # Errors
    /// [`MatrixError`] for entries that are not finite.
    pub fn factor(
        &mut self,
        entries: impl Iterator<Item = (usize, usize, f64)>,
    ) -> Result<bool, MatrixError> {
        let kept: Vec<(usize, usize, f64)> = entries
            .filter_map(|(row, column, value)| Some((column, self.position[row]?, value)))
            .collect();
        let matrix = SparseMatrix::from_triplets(self.unknowns, self.chosen.len(), 0.0, kept)?;
        let found = self.refactoring.factor(&matrix, 0.0)?;
        let sound = found.rank() == self.chosen.len();
        self.columns = Some((matrix, found));
        if !sound {
            return Ok(false);
        }
        let mut tangent = std::mem::take(&mut self.tangent);
        let before = tangent.clone();
        for _ in 0..TANGENT_SWEEPS {
            let across = self.shortest(&self.seen(&tangent));
            tangent.iter_mut().zip(&across).for_each(|(t, a)| *t -= a);
            if !normalise(&mut tangent) {
                self.tangent = before;
                return Ok(false);
            }
            if 0.0.norm(&across) <= f64::EPSILON {
                break;
            }
        }
        self.tangent = tangent;
        Ok(true)
    }

    fn seen(&self, x: &[f64]) -> Vec<f64> {
        self.columns
            .as_ref()
            .and_then(|(matrix, _)| matrix.multiply_transposed(x).ok())
            .unwrap_or_default()
    }

    /// The shortest x that the chosen equations see as `right` (by place), by the seminormal equations, which square the condition
    /// (Björck 1996, section 6.6.5): what is left is corrected by those who look at what it does.
    fn shortest(&self, right: &[f64]) -> Vec<f64> {
        let Some((matrix, factorization)) = &self.columns else {
            return vec![0.0; self.unknowns];
        };
        let mut left = right.to_vec();
        factorization.triangle.forward_substitute(&mut left);
        factorization.triangle.back_substitute(&mut left);
        let found = matrix.multiply(&left);
        found.unwrap_or_else(|_| vec![f64::NAN; self.unknowns])
    }

    /// As [`super::rows::DenseRows::solve`], as rough as [`Self::shortest`] or corrected once.
    pub fn solve(&self, right: &[f64], x: &mut [f64], corrected: bool) {
        let own: Vec<f64> = self.chosen.iter().map(|e| right[*e]).collect();
        x.copy_from_slice(&self.shortest(&own));
        if corrected {
            let seen = self.seen(x);
            let left: Vec<f64> = own.iter().zip(&seen).map(|(r, s)| r - s).collect();
            let more = self.shortest(&left);
            x.iter_mut().zip(&more).for_each(|(x, m)| *x += m);
        }
    }

    /// As [`super::rows::DenseRows::least_singular_value`].
    pub fn least_singular_value(&self) -> f64 {
        let Some((_, factorization)) = &self.columns else {
            return 0.0;
        };
        let mut y: Vec<f64> = (0..self.chosen.len())
            .map(|i| 1.0 + 0.1 * (i % 7) as f64)
            .collect();
        let mut least = 0.0;
        for _ in 0..SWEEPS {
            if !normalise(&mut y) {
                return 0.0;
            }
            factorization.triangle.forward_substitute(&mut y);
            least = 1.0 / 0.0.norm(&y);
            factorization.triangle.back_substitute(&mut y);
        }
        if least.is_finite() { least } else { 0.0 }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::rows::DenseRows;
    use crate::samples::system;
    use crate::system::Evaluation;
    use kutzbach_mobility::families::scissor_lift;

    #[test]
    fn sparse_rows_say_what_dense_rows_say() {
        for stages in [1, 4, 12] {
            let (system, pose) = system(&scissor_lift(stages).unwrap());
            let (n, m) = (system.unknowns(), system.equations());
            let mut evaluation = Evaluation::default();
            system.evaluate(&pose, &mut evaluation);
            let mut dense = DenseRows::new(n, m);
            system.fill_dense(&evaluation, &mut dense.rows);
            let rows = dense.rows.clone();
            assert!(dense.factor());
            let mut sparse = SparseRows::new(n, m);
            assert!(sparse.choose(system.triplets(&evaluation)).unwrap());
            assert!(sparse.factor(system.triplets(&evaluation)).unwrap());
            assert_eq!(sparse.chosen().len(), n - 1);
            let along: f64 = sparse
                .tangent
                .iter()
                .zip(&dense.tangent)
                .map(|(a, b)| a * b)
                .sum();
            assert!((along.abs() - 1.0).abs() < 1e-12, "{stages}: {along}");
            // Right sides that agree with all equations have one shortest solution, whichever are chosen.
            let wanted: Vec<f64> = (0..n).map(|i| (i as f64 + 0.5).sin()).collect();
            let right: Vec<f64> = rows
                .chunks_exact(n)
                .map(|row| row.iter().zip(&wanted).map(|(a, b)| a * b).sum())
                .collect();
            let (mut one, mut two) = (vec![0.0; n], vec![0.0; n]);
            dense.solve(&right, &mut one);
            sparse.solve(&right, &mut two, true);
            for (a, b) in one.iter().zip(&two) {
                assert!((a - b).abs() < 1e-9, "{stages}: {a} {b}");
            }
            let (p, q) = (dense.least_singular_value(), sparse.least_singular_value());
            assert!(p > 0.0 && q > 0.0);
        }
    }
}
