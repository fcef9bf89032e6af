//! The independent equations at a pose, chosen and factored.
//!
//! The loop equations of most mechanisms depend on one another, and near a branch they do so only up to the distance from
//! it: six equations of rank three for Bennett's loop, of rank four a little beside. What is known is the rank *on* the
//! branch, so that as many equations are chosen, the most independent ones, and the others are left to hold by themselves:
//! the chosen ones cut out a manifold of the branch's own dimension that contains the branch, hence nothing else.
//!
//! Choosing is Householder QR with column pivoting of the transposed Jacobian, stopped at the known rank (Businger & Golub
//! 1965; Golub & Van Loan 2013, section 5.4.2). Its orthogonal factor splits the unknowns: the first columns span the rows
//! of the chosen equations, where steps of least length lie, the last one the tangent of the curve.
//!
//! Cost: 2 n² m for n unknowns and m equations.

use super::vectors::dot;
use kutzbach_math::interruption;

/// A workspace for equations of up to a fixed number of unknowns, stored row by row.
#[derive(Clone, Debug)]
pub(super) struct DenseRows {
    unknowns: usize,
    rank: usize,
    /// Equations; reduced in place.
    pub rows: Vec<f64>,
    /// Equations in the order in which they were chosen.
    order: Vec<usize>,
    /// Diagonal of R, and factors of the reflections.
    diagonal: Vec<f64>,
    factors: Vec<f64>,
    squares: Vec<f64>,
    /// Equations chosen beforehand, in this order.
    fixed: Option<Vec<usize>>,
    /// The unit vector that no chosen equation sees.
    pub tangent: Vec<f64>,
}

impl DenseRows {
    /// For `equations` of which all but one direction is determined.
    pub fn new(unknowns: usize, equations: usize) -> Self {
        Self {
            unknowns,
            rank: unknowns.saturating_sub(1),
            rows: vec![0.0; unknowns * equations],
            order: (0..equations).collect(),
            diagonal: vec![0.0; unknowns],
            factors: vec![0.0; unknowns],
            squares: vec![0.0; equations],
            fixed: None,
            tangent: vec![0.0; unknowns],
        }
    }

    /// The equations chosen by the last factorization.
    pub fn chosen(&self) -> &[usize] {
        &self.order[..self.rank.min(self.order.len())]
    }

    /// Chooses these equations from now on, or the most independent ones each time.
    pub fn fix(&mut self, chosen: Option<Vec<usize>>) {
        self.fixed = chosen;
    }

    /// Factors what stands in `rows`. False where fewer equations are independent than should be, or the work is asked to end.
    pub fn factor(&mut self) -> bool {
        let n = self.unknowns;
        let m = self.order.len();
        if m < self.rank || interruption::asked() {
            return false;
        }
        for (index, slot) in self.order.iter_mut().enumerate() {
            *slot = index;
        }
        if let Some(fixed) = &self.fixed {
            for (place, &equation) in fixed.iter().enumerate() {
                if let Some(at) = self.order.iter().position(|e| *e == equation) {
                    self.order.swap(place, at);
                }
            }
        }
        for (square, row) in self.squares.iter_mut().zip(self.rows.chunks_exact(n)) {
            *square = dot(row, row);
        }
        let mut sound = true;
        for k in 0..self.rank {
            if self.fixed.is_none() {
                let mut best = k;
                for candidate in k + 1..m {
                    if self.squares[self.order[candidate]] > self.squares[self.order[best]] {
                        best = candidate;
                    }
                }
                self.order.swap(k, best);
            }
            let pivot = self.order[k] * n;
            let tail = &self.rows[pivot + k..pivot + n];
            let length = dot(tail, tail).sqrt();
            if !(length > 0.0) {
                self.diagonal[k] = 0.0;
                self.factors[k] = 0.0;
                sound = false;
                continue;
            }
            let first = tail[0];
            let signed = if first < 0.0 { -length } else { length };
            self.rows[pivot + k] = first + signed;
            self.diagonal[k] = -signed;
            self.factors[k] = 1.0 / (length * (length + first.abs()));
            let last = if self.fixed.is_some() { self.rank } else { m };
            for j in k + 1..last {
                let other = self.order[j] * n;
                let (vector, target) = if pivot < other {
                    let (low, high) = self.rows.split_at_mut(other);
                    (&low[pivot + k..pivot + n], &mut high[k..n])
                } else {
                    let (low, high) = self.rows.split_at_mut(pivot);
                    (&high[k..n], &mut low[other + k..other + n])
                };
                let along = self.factors[k] * dot(vector, target);
                if along != 0.0 {
                    for (t, v) in target.iter_mut().zip(vector) {
                        *t -= along * v;
                    }
                }
                // The remainder's square, anew where most of it went: digits lost by subtraction would misguide the choice.
                let gone = target[0] * target[0];
                let square = &mut self.squares[self.order[j]];
                *square -= gone;
                if *square < 0.1 * gone {
                    *square = dot(&target[1..], &target[1..]);
                }
            }
        }
        self.tangent.fill(0.0);
        if let Some(last) = self.tangent.last_mut() {
            *last = 1.0;
        }
        let mut tangent = std::mem::take(&mut self.tangent);
        self.rotate(&mut tangent);
        self.tangent = tangent;
        sound
    }

    /// The sign of the determinant of the chosen equations, in the order in which they were chosen, with a tangent as the
    /// last row. It means something between poses only for equations chosen beforehand.
    pub fn orientation(&self, tangent: &[f64]) -> f64 {
        let turned = self.diagonal[..self.rank]
            .iter()
            .filter(|d| **d < 0.0)
            .count()
            % 2
            == 1;
        let along = dot(&self.tangent, tangent).signum();
        if turned { -along } else { along }
    }

    /// x ← Q x.
    fn rotate(&self, x: &mut [f64]) {
        let n = self.unknowns;
        for k in (0..self.rank).rev() {
            let start = self.order[k] * n;
            let vector = &self.rows[start + k..start + n];
            let along = self.factors[k] * dot(vector, &x[k..]);
            if along != 0.0 {
                for (t, v) in x[k..].iter_mut().zip(vector) {
                    *t -= along * v;
                }
            }
        }
    }

    /// The shortest `x` with (chosen rows) x = right; `right` by equation. Not finite where a pivot vanished.
    pub fn solve(&self, right: &[f64], x: &mut [f64]) {
        let n = self.unknowns;
        x.fill(0.0);
        for j in 0..self.rank {
            let equation = self.order[j];
            let row = &self.rows[equation * n..equation * n + j];
            x[j] = (right[equation] - dot(row, &x[..j])) / self.diagonal[j];
        }
        self.rotate(x);
    }

    /// The least singular value of the chosen equations, from above: inverse iteration on R Rᵀ. Zero where one vanished.
    pub fn least_singular_value(&self) -> f64 {
        let r = self.rank;
        if r == 0 {
            return f64::INFINITY;
        }
        let n = self.unknowns;
        let entry = |row: usize, column: usize| {
            if row == column {
                self.diagonal[row]
            } else {
                self.rows[self.order[column] * n + row]
            }
        };
        // R is upper triangular: (Rᵀ R)⁻¹ = R⁻¹ R⁻ᵀ.
        let mut y: Vec<f64> = (0..r).map(|i| 1.0 + 0.1 * (i % 7) as f64).collect();
        let mut least = f64::INFINITY;
        for _ in 0..4 {
            let length = dot(&y, &y).sqrt();
            y.iter_mut().for_each(|v| *v /= length);
            for j in 0..r {
                let known: f64 = (0..j).map(|k| entry(k, j) * y[k]).sum();
                y[j] = (y[j] - known) / entry(j, j);
            }
            let grown = dot(&y, &y).sqrt();
            if !grown.is_finite() {
                return 0.0;
            }
            least = 1.0 / grown;
            for j in (0..r).rev() {
                let known: f64 = (j + 1..r).map(|k| entry(j, k) * y[k]).sum();
                y[j] = (y[j] - known) / entry(j, j);
            }
            if !y.iter().all(|v| v.is_finite()) {
                return 0.0;
            }
        }
        least
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_math::matrix::SplitMix64;

    fn random_rows(unknowns: usize, equations: usize, rank: usize, seed: u64) -> Vec<f64> {
        let mut random = SplitMix64::new(seed);
        let basis: Vec<f64> = (0..rank * unknowns).map(|_| random.symmetric()).collect();
        let mut rows = Vec::new();
        for _ in 0..equations {
            let mix: Vec<f64> = (0..rank).map(|_| random.symmetric()).collect();
            for c in 0..unknowns {
                rows.push((0..rank).map(|k| mix[k] * basis[k * unknowns + c]).sum());
            }
        }
        rows
    }

    #[test]
    fn redundant_equations_are_left_out_and_hold_all_the_same() {
        for (unknowns, equations) in [(4, 6), (7, 6), (20, 40), (1, 0), (1, 3), (2, 1)] {
            let rows = random_rows(unknowns, equations, unknowns - 1, 7);
            let mut dense = DenseRows::new(unknowns, equations);
            dense.rows.copy_from_slice(&rows);
            assert!(dense.factor());
            let seen = |x: &[f64]| -> Vec<f64> {
                rows.chunks_exact(unknowns).map(|row| dot(row, x)).collect()
            };
            assert!((dot(&dense.tangent, &dense.tangent) - 1.0).abs() < 1e-14);
            assert!(seen(&dense.tangent).iter().all(|x| x.abs() < 1e-12));
            let wanted: Vec<f64> = (0..unknowns).map(|i| (i as f64).sin()).collect();
            let right = seen(&wanted);
            let mut x = vec![0.0; unknowns];
            dense.solve(&right, &mut x);
            let left = seen(&x);
            assert!(left.iter().zip(&right).all(|(a, b)| (a - b).abs() < 1e-11));
            assert!(dot(&x, &dense.tangent).abs() < 1e-11, "of least length");
        }
    }

    #[test]
    fn the_margin_is_the_least_singular_value() {
        let mut dense = DenseRows::new(3, 3);
        dense
            .rows
            .copy_from_slice(&[0.0, 2.0, 0.0, 1e-3, 0.0, 0.0, 0.0, 2.0, 1e-9]);
        assert!(dense.factor());
        assert!((dense.least_singular_value() - 1e-3).abs() < 1e-12);
        dense.rows.copy_from_slice(&[0.0; 9]);
        assert!(!dense.factor());
        assert_eq!(dense.least_singular_value(), 0.0);
    }
}
