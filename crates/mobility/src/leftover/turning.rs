//! Steps by which equations are solved across the kernel, near the pose.
//!
//! With singular vectors and values that are doubles, `L J C = S (I + D)`, where D is rounding. At the place y of the kernel that has become
//! `S (I + D + Σ yₖ Bₖ)` but for terms of second order, `Bₖ = S⁻¹ L D²F(bₖ, C)`. Steps by `(I − D − Σ yₖ Bₖ) S⁻¹` gain nearly twice the
//! digits that steps by `S⁻¹` gain. D and B are known to so many of their own digits only, which costs some of these and nothing else.

use super::equations::Equations;
use super::power_of_two;
use crate::germ::splitting::Splitting;
use kutzbach_math::matrix::{Extended, Real, Ring};

/// Second differences are taken at this distance and at twice that: 2^−10, where what both together leave out is about as large as what
/// rounding leaves, 2^−36.
const STEP: f64 = 1.0 / 1024.0;

/// How the Jacobian differs from its singular values, in the coordinates of its singular vectors.
pub(super) struct Turning {
    /// At the pose: rows of `D`.
    rounding: Vec<Vec<f64>>,
    /// For every vector of the kernel: rows of `Bₖ`.
    changes: Vec<Vec<Vec<f64>>>,
}

/// The same at one place.
pub(super) struct TurnedTo(Vec<Vec<f64>>);

impl Turning {
    /// About the pose of some equations, whose Jacobian is split; `doubles` are the same equations in double precision.
    pub fn of(
        splitting: &Splitting,
        equations: &Equations<'_, Extended>,
        doubles: &Equations<'_, f64>,
        one: &Extended,
    ) -> Self {
        let reached: Vec<(&[f64], &[f64], f64)> = splitting.reached().collect();
        let in_rows = |columns: Vec<Vec<f64>>| -> Vec<Vec<f64>> {
            let row = |(index, (.., size)): (usize, &(_, _, f64))| {
                columns.iter().map(|column| column[index] / size).collect()
            };
            reached.iter().enumerate().map(row).collect()
        };
        let rounding = |column: usize| -> Vec<f64> {
            let image = derivative(equations, reached[column].1, one);
            let entry = |(row, (left, _, size)): (usize, &(&[f64], _, f64))| {
                let left: Vec<Extended> = left.iter().map(|x| one.constant(*x)).collect();
                let known = if row == column { *size } else { 0.0 };
                (one.dot(&left, &image) - one.constant(known)).to_f64()
            };
            reached.iter().enumerate().map(entry).collect()
        };
        let change = |along: &Vec<f64>| {
            let column = |(_, across, _): &(_, &[f64], _)| -> Vec<f64> {
                let second = second_derivative(doubles, along, across);
                let lefts = reached.iter();
                lefts.map(|(left, ..)| 0.0.dot(left, &second)).collect()
            };
            in_rows(reached.iter().map(column).collect())
        };
        Self {
            rounding: in_rows((0..reached.len()).map(rounding).collect()),
            changes: splitting.kernel.iter().map(change).collect(),
        }
    }

    /// At a place of the kernel.
    pub fn to(&self, y: &[Extended]) -> TurnedTo {
        let mut sum = self.rounding.clone();
        for (rows, y) in self.changes.iter().zip(y) {
            let y = y.to_f64();
            for (sum, row) in sum.iter_mut().zip(rows) {
                y.add_scaled(row, sum);
            }
        }
        TurnedTo(sum)
    }
}

impl TurnedTo {
    /// Steps of so many coordinates as they are.
    #[cfg(test)]
    pub fn not_at_all(size: usize) -> Self {
        Self(vec![vec![0.0; size]; size])
    }

    /// The coordinates of a step `S⁻¹ x`, corrected for the place.
    pub fn corrected(&self, mut step: Vec<Extended>) -> Vec<Extended> {
        // The correction is so small that its leading digits do; relative to the largest one, since doubles have no range for them.
        let sizes = step.iter().map(Real::abs);
        let Some(largest) = sizes.reduce(|most, x| if x > most { x } else { most }) else {
            return step;
        };
        if largest.is_zero() {
            return step;
        }
        let shares: Vec<f64> = step
            .iter()
            .map(|x| (x.clone() / largest.clone()).to_f64())
            .collect();
        for (x, row) in step.iter_mut().zip(&self.0) {
            let change = 0.0.dot(row, &shares);
            *x = x.clone() - largest.constant(change) * largest.clone();
        }
        step
    }
}

/// The derivative of the equations along a direction, to half of all digits.
fn derivative(
    equations: &Equations<'_, Extended>,
    direction: &[f64],
    one: &Extended,
) -> Vec<Extended> {
    let half = i64::from(one.bits()) / 2;
    let (step, inverse) = (power_of_two(one, -half), power_of_two(one, half));
    let scale = |x: &f64| one.constant(*x) * step.clone();
    let at: Vec<Extended> = direction.iter().map(scale).collect();
    let values = equations.residual(&at).into_iter();
    values.map(|value| value * inverse.clone()).collect()
}

/// The second derivative of the equations along two directions.
fn second_derivative(equations: &Equations<'_, f64>, along: &[f64], across: &[f64]) -> Vec<f64> {
    let difference = |step: f64| -> Vec<f64> {
        let at = |a: f64, b: f64| -> Vec<f64> {
            let pairs = along.iter().zip(across);
            let place: Vec<f64> = pairs.map(|(x, y)| step * (a * x + b * y)).collect();
            equations.residual(&place)
        };
        let [a, b, c, d] = [at(1.0, 1.0), at(1.0, -1.0), at(-1.0, 1.0), at(-1.0, -1.0)];
        (0..a.len())
            .map(|row| (a[row] - b[row] - c[row] + d[row]) / (4.0 * step * step))
            .collect()
    };
    let near = difference(STEP).into_iter();
    near.zip(difference(2.0 * STEP))
        .map(|(near, far)| (4.0 * near - far) / 3.0)
        .collect()
}
