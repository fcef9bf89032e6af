//! Solutions found already, from which others begin.

use kutzbach_math::matrix::{Extended, Real, Ring};

/// Solutions across the kernel at the places of a triangular grid.
#[derive(Debug, Default)]
pub(crate) struct Grid {
    /// Of every row that is complete, the differences at its first place, by their order.
    rows: Vec<Vec<Vec<Extended>>>,
    /// Solutions of the row that is not.
    row: Vec<Vec<Extended>>,
}

impl Grid {
    /// The places from here on are of the next row.
    pub(super) fn next_row(&mut self) {
        if self.row.is_empty() {
            return;
        }
        let mut row = std::mem::take(&mut self.row);
        for order in 1..row.len() {
            for place in (order..row.len()).rev() {
                let (before, rest) = row.split_at_mut(place);
                let pairs = rest[0].iter_mut().zip(&before[place - 1]);
                pairs.for_each(|(x, y)| *x = x.clone() - y.clone());
            }
        }
        self.rows.push(row);
    }

    pub(super) fn push(&mut self, solution: Vec<Extended>) {
        self.row.push(solution);
    }

    /// The value at the next place (i, j) if the difference of order (i, j) is none: off by what is of order i + j.
    pub(super) fn extrapolated(&self, unknowns: usize, one: &Extended) -> Vec<Extended> {
        let order = self.row.len();
        // The difference of order i of this row, from those of the rows before; then the value, from the row and that difference.
        let differences = self.rows.iter().map(|row| row.get(order));
        let mut next = sum_with_binomials(differences, unknowns, one);
        let along = sum_with_binomials(self.row.iter().map(Some), unknowns, one);
        next.iter_mut()
            .zip(along)
            .for_each(|(x, y)| *x = x.clone() + y);
        next
    }
}

/// The next of n values whose n-th difference is none: Σ −(−1)^(n−k) C(n, k) xₖ. What is missing counts as zero.
fn sum_with_binomials<'a>(
    values: impl DoubleEndedIterator<Item = Option<&'a Vec<Extended>>> + ExactSizeIterator,
    unknowns: usize,
    one: &Extended,
) -> Vec<Extended> {
    let mut next = vec![one.zero_like(); unknowns];
    let count = values.len();
    let mut weight = 1.0;
    for (back, value) in values.rev().enumerate() {
        // (−1)^back C(count, back + 1).
        weight *= (count - back) as f64 / (back + 1) as f64;
        let sign = if back % 2 == 0 { weight } else { -weight };
        if let Some(value) = value {
            one.constant(sign).add_scaled(value, &mut next);
        }
    }
    next
}

/// Solutions across the kernel at places of a line, by their parameters.
#[derive(Debug, Default)]
pub(crate) struct Line(Vec<(Extended, Vec<Extended>)>);

impl Line {
    /// So many solutions, the last ones, are interpolated.
    const POINTS: usize = 5;

    pub(super) fn push(&mut self, parameter: Extended, solution: Vec<Extended>) {
        self.0.push((parameter, solution));
    }

    /// The polynomial through the last solutions, at a parameter (Lagrange).
    pub(super) fn interpolated(&self, unknowns: usize, at: &Extended) -> Vec<Extended> {
        let mut solution = vec![at.zero_like(); unknowns];
        let last = &self.0[self.0.len().saturating_sub(Self::POINTS)..];
        for (index, (own, known)) in last.iter().enumerate() {
            let mut weight = at.one_like();
            for (other, (parameter, _)) in last.iter().enumerate() {
                if other != index {
                    let [up, down] = [at, own].map(|x| x.clone() - parameter.clone());
                    weight = weight * up / down;
                }
            }
            weight.add_scaled(known, &mut solution);
        }
        solution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_highest_difference_is_missing() {
        let one = Extended::new(1.0, 400);
        let step = super::super::power_of_two(&one, -40);
        // 1 / (1 + x − 2 y), whose difference of order (i, j) is about (i + j)! 2^j h^(i + j).
        let value = |i: usize, j: usize| {
            let at = |k: usize| one.constant(k as f64) * step.clone();
            vec![one.clone() / (one.clone() + at(i) - one.constant(2.0) * at(j))]
        };
        let mut grid = Grid::default();
        for j in 0..5usize {
            grid.next_row();
            for i in 0..5 - j {
                let found = grid.extrapolated(1, &one);
                let known = value(i, j);
                let off = (found[0].clone() - known[0].clone()).abs().to_f64();
                let order = (i + j) as i32;
                assert!(off < 1e4 * 2f64.powi(-40 * order), "{i} {j} {off:e}");
                assert!(off > 0.1 * 2f64.powi(-40 * order), "{i} {j} {off:e}");
                grid.push(known);
            }
        }
    }
}
