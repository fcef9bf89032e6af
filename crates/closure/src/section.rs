//! Closing the cycles while some directions of motion are held: the step from a pose to its neighbours.
//!
//! All unknowns of a part are measured in one metric, fixed at a pose of reference: `z = w q`, with `q` in rad and m and
//! the weights `w` such that every column of the Jacobian had unit length there. A direction is a unit vector in `z`.

use super::displacement::JointState;
use super::equations::Equations;
use super::geometry::Geometry;
use super::jacobian::{CycleJacobian, Part, rounding_of};
use kutzbach_math::matrix::{LeastSquares, MatrixError, Real, SparseMatrix, held_step};
use kutzbach_model::mechanism::Mechanism;

/// The metric of a part's unknowns.
#[derive(Clone, Debug)]
pub struct Metric {
    /// One weight per unknown: per rad or per m.
    pub weights: Vec<f64>,
}

impl Metric {
    /// The metric in which the columns of a Jacobian have the unit length that dividing by `column_scales` gave them.
    /// Columns that vanish count as if they had length 1.
    #[must_use]
    pub fn of<R: Real>(
        mechanism: &Mechanism,
        jacobian: &CycleJacobian<R>,
        column_scales: &[f64],
    ) -> Self {
        let weights = column_scales
            .iter()
            .enumerate()
            .map(|(column, scale)| {
                let scale = if *scale > 0.0 { *scale } else { 1.0 };
                scale / jacobian.unit(mechanism, column)
            })
            .collect();
        Self { weights }
    }
}

/// What closing came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing {
    /// Largest equation left (rad, cycle lengths).
    pub residual: f64,
    /// Rounding in the equations at the pose reached, same units.
    pub rounding: f64,
    /// Length of the path taken while closing, in the metric.
    pub way: f64,
    /// Length of the last step, in the metric.
    pub last_step: f64,
    /// Steps taken.
    pub steps: usize,
}

/// A part whose loops are closed under constraints, in a given arithmetic.
pub struct Section<'a, R> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its geometry.
    pub geometry: &'a Geometry<R>,
    /// The part that moves.
    pub part: &'a Part,
    /// The metric of its unknowns.
    pub metric: &'a Metric,
}

/// Steps of larger parts are looked for by a sparse factorisation first.
const SPARSE_UNKNOWNS: usize = 40;

/// A step that leads away from closing is halved so often.
const SHORTENINGS: i32 = 6;

impl<R: Real> Section<'_, R> {
    /// Moves the part's joints by `z`.
    pub fn advance(&self, states: &mut [JointState<R>], z: &[R]) {
        let one = &self.geometry.one;
        let mut column = 0;
        for &joint in &self.part.joints {
            let displacement = &self.geometry.displacements[joint];
            let freedom = displacement.freedom();
            let values: Vec<R> = (column..column + freedom)
                .map(|c| z[c].clone() / one.constant(self.metric.weights[c]))
                .collect();
            displacement.advance(&mut states[joint], &values);
            column += freedom;
        }
    }

    /// [`Self::advance`] by doubles.
    pub fn advance_by(&self, states: &mut [JointState<R>], z: &[f64]) {
        let z: Vec<R> = z.iter().map(|x| self.geometry.one.constant(*x)).collect();
        self.advance(states, &z);
    }

    /// By which [`Self::advance_by`] leads from one pose of the part to another.
    #[must_use]
    pub fn way_between(&self, from: &[JointState<R>], to: &[JointState<R>]) -> Vec<f64> {
        self.part
            .joints
            .iter()
            .flat_map(|&j| self.geometry.displacements[j].increments(&from[j], &to[j]))
            .zip(&self.metric.weights)
            .map(|(increment, weight)| increment.to_f64() * weight)
            .collect()
    }

    /// Newton steps of least length that close the cycles and do not move along the `held` directions (orthonormal in the
    /// metric). Stops where the equations hold to the last digits, where the largest of them does not get smaller, or after `limit`
    /// steps. Where the equations cannot be met the pose is one nearby where no step makes the largest one smaller.
    ///
    /// Held directions are those of every single step. Turns of a ball do not commute, so that the sum of several steps may
    /// lead along such a direction by what is of higher order. Where equations depend on one another at closed poses only,
    /// nothing but holding the kernel keeps steps from leading far along it.
    ///
    /// The residual is exact to the arithmetic; directions are solved in double precision.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub fn close(
        &self,
        states: &mut [JointState<R>],
        held: &[Vec<f64>],
        limit: usize,
    ) -> Result<Closing, MatrixError> {
        let floor = 8.0 * self.geometry.one.unit_roundoff();
        self.close_down_to(|_| floor, states, held, limit)
    }

    /// [`Self::close`] for whoever only asks whether that is possible: stops where the equations hold as well as rounding
    /// lets anybody tell ([`Closing::rounding`]). Their last digits would take some more steps.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub fn close_within_rounding(
        &self,
        states: &mut [JointState<R>],
        held: &[Vec<f64>],
        limit: usize,
    ) -> Result<Closing, MatrixError> {
        self.close_down_to(|rounding| rounding, states, held, limit)
    }

    /// `floor`: what is small enough, if rounding is as it is.
    fn close_down_to(
        &self,
        floor: impl Fn(f64) -> f64,
        states: &mut [JointState<R>],
        held: &[Vec<f64>],
        limit: usize,
    ) -> Result<Closing, MatrixError> {
        let mut here = self.equations(states)?;
        let mut closing = self.before_closing(&here);
        let rounding = closing.rounding;
        let floor = floor(rounding);
        let mut kept = Vec::new();
        while closing.steps < limit && closing.residual > floor {
            let linear = here.linearised(self.geometry, self.part)?;
            let step = self.step(&linear, &linear.residual, closing.residual, held)?;
            let mut length = 0.0.norm(&step) * closing.residual;
            if !length.is_finite() {
                break;
            }
            // Beyond a radian or so the linearisation says nothing.
            let shorten = if length > 0.5 { 0.5 / length } else { 1.0 };
            length *= shorten;
            kept.clear();
            kept.extend(self.part.joints.iter().map(|&j| states[j].clone()));
            // Where the equations are nearly singular a step may be far too long. Sections that hold directions are asked how
            // much is left over, and end there all the sooner.
            let shortenings = if held.is_empty() && closing.residual > 1e3 * rounding {
                SHORTENINGS
            } else {
                1
            };
            let mut there = None;
            for halving in 0..shortenings {
                let part = closing.residual * shorten * 0.5f64.powi(halving);
                let factor = self.geometry.one.constant(part);
                let z: Vec<R> = step
                    .iter()
                    .map(|x| self.geometry.one.constant(*x) * factor.clone())
                    .collect();
                self.advance(states, &z);
                let found = self.equations(states)?;
                let reached = found.largest();
                if reached < closing.residual {
                    there = Some((found, reached));
                    length *= 0.5f64.powi(halving);
                    break;
                }
                for (&joint, state) in self.part.joints.iter().zip(&kept) {
                    states[joint] = state.clone();
                }
            }
            closing.steps += 1;
            let Some((there, reached)) = there else { break };
            let stalled = reached > 0.999 * closing.residual;
            closing.way += length;
            closing.last_step = length;
            closing.residual = reached;
            here = there;
            if stalled {
                break;
            }
        }
        Ok(closing)
    }

    /// What closing has come to before its first step.
    pub(super) fn before_closing(&self, here: &Equations<R>) -> Closing {
        Closing {
            residual: here.largest(),
            rounding: rounding_of(&here.walks, self.geometry.one.unit_roundoff()),
            way: 0.0,
            last_step: 0.0,
            steps: 0,
        }
    }

    pub(super) fn equations(&self, states: &[JointState<R>]) -> Result<Equations<R>, MatrixError> {
        Equations::at(self.mechanism, self.geometry, states, self.part)
    }

    /// The least step that closes to first order and does not move along the held directions, in units of `largest`, the
    /// largest of the equations. Their values may be known to more digits than the derivative.
    pub(super) fn step<Q: Real>(
        &self,
        derivative: &CycleJacobian<R>,
        values: &[Q],
        largest: f64,
        held: &[Vec<f64>],
    ) -> Result<Vec<f64>, MatrixError> {
        let right = values
            .iter()
            .map(|value| -(value.clone() / value.constant(largest)).to_f64())
            .collect();
        let mut step = self.across(derivative, right, held)?;
        for direction in held {
            let along: f64 = direction.iter().zip(&step).map(|(a, b)| a * b).sum();
            step.iter_mut()
                .zip(direction)
                .for_each(|(x, d)| *x -= along * d);
        }
        Ok(step)
    }

    /// The least-squares problem of [`Self::step`]: exactly across the held directions only up to rounding.
    fn across(
        &self,
        here: &CycleJacobian<R>,
        mut right: Vec<f64>,
        held: &[Vec<f64>],
    ) -> Result<Vec<f64>, MatrixError> {
        if here.matrix.columns() > SPARSE_UNKNOWNS {
            let blocks = (0..here.matrix.block_count()).map(|b| here.matrix.block_rows(b).start);
            let matrix = self
                .bordered(here, &[])?
                .with_row_blocks(blocks.collect())?;
            if let Some(step) = held_step(&matrix, &right, held)? {
                return Ok(step);
            }
        }
        let matrix = self.bordered(here, held)?;
        right.extend(held.iter().map(|_| 0.0));
        LeastSquares::damped(&matrix, &right, 1e-24, None)
    }

    /// The Jacobian in the metric, in double precision, with the held directions as further rows.
    fn bordered(
        &self,
        here: &CycleJacobian<R>,
        held: &[Vec<f64>],
    ) -> Result<SparseMatrix<f64>, MatrixError> {
        let rows = here.matrix.rows();
        let columns = here.matrix.columns();
        let factors: Vec<f64> = (0..columns)
            .map(|c| 1.0 / (self.metric.weights[c] * here.unit(self.mechanism, c)))
            .collect();
        let mut triplets: Vec<(usize, usize, f64)> = here
            .matrix
            .triplets()
            .map(|(row, column, value)| (row, column, value.to_f64() * factors[column]))
            .collect();
        for (index, direction) in held.iter().enumerate() {
            triplets.extend(
                direction
                    .iter()
                    .enumerate()
                    .map(|(column, x)| (rows + index, column, *x)),
            );
        }
        SparseMatrix::from_triplets(rows + held.len(), columns, 0.0, triplets)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
