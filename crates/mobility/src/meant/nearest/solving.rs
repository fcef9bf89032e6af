//! Gauss and Newton's steps for the dimensions, damped while the equations disagree.

use super::super::least_largest::Decomposed;
use super::{STALLED, Sample, Search, norm, states_of};
use faer::Mat;
use kutzbach_closure::JointState;
use kutzbach_math::matrix::MatrixError;

/// A search that takes more operations than this is given up.
const MOST_WORK: usize = 1_500_000_000;

/// Rounds of Gauss and Newton.
const ROUNDS: usize = 40;

/// A misfit (rad, cycle lengths) that is the rounding of doubles.
const CLOSED: f64 = 2e-14;

/// Relative damping at the first misfit.
const DAMPING: f64 = 1e-3;

/// After so many steps that did not leave less than this share of the best, they are taken back and damped so much more.
const WATCHED: usize = 3;
const HALVED: f64 = 0.5;
const STIFFENED: f64 = 30.0;

/// So much at least then, relative to the largest singular value squared, and at most.
const STIFF: f64 = 1e-13;
const STIFFEST: f64 = 1e-3;

/// A step that does half of what it promised lets the next be damped so much less.
const RELAXED: f64 = 0.1;

impl Search<'_> {
    /// Moves the dimensions to a solution; `first` is the misfit at those written. Where a few steps together leave no less than there
    /// was, they are taken back, and damped more: single ones may, as the best ways to solutions at which the equations are
    /// dependent do.
    pub(super) fn solve(
        &mut self,
        samples: &mut [Sample],
        z: &mut Vec<f64>,
        first: f64,
    ) -> Result<Option<()>, MatrixError> {
        let mut damping = DAMPING;
        let mut best = (self.open(samples), (z.clone(), states_of(samples)));
        if best.0 <= STALLED {
            return Ok(Some(()));
        }
        let mut since = 0;
        for _ in 0..ROUNDS {
            let (matrix, misfit) = self.equations(samples, z)?;
            let left = norm(&misfit);
            if left <= CLOSED {
                return Ok(Some(()));
            }
            let relative = damping * (left / first).powi(2).min(1.0);
            self.work += matrix.nrows() * matrix.ncols() * matrix.nrows().min(matrix.ncols());
            if self.work > MOST_WORK {
                return Ok(None);
            }
            let Some(decomposed) = Decomposed::of(&matrix) else {
                return Ok(None);
            };
            let damped = |s: f64, top: f64| s / (s * s + relative * top * top);
            let step = least(&decomposed, &misfit, damped);
            z.iter_mut().zip(&step).for_each(|(z, step)| *z -= step);
            let followed = self.is_near(z) && self.follow(samples, z)?;
            let now = if followed {
                self.open(samples)
            } else {
                f64::INFINITY
            };
            let before = norm(&misfit);
            let promised = before - norm(&difference(&misfit, &matrix, &step));
            if before - now > 0.5 * promised {
                damping *= RELAXED;
            }
            since = if now < HALVED * best.0 { 0 } else { since + 1 };
            if now < best.0 {
                best = (now, (z.clone(), states_of(samples)));
            }
            if !followed || since > WATCHED {
                self.restore(samples, z, &best.1)?;
                if best.0 <= STALLED {
                    return Ok(Some(()));
                }
                let share = (best.0 / first).powi(2).min(1.0);
                damping = (damping * STIFFENED).max(STIFF / share);
                since = 0;
                if damping * share > STIFFEST {
                    break;
                }
            }
        }
        self.restore(samples, z, &best.1)?;
        Ok((best.0 <= STALLED).then_some(()))
    }

    /// Takes the dimensions and poses back.
    pub(super) fn restore(
        &mut self,
        samples: &mut [Sample],
        z: &mut Vec<f64>,
        kept: &(Vec<f64>, Vec<Vec<JointState<f64>>>),
    ) -> Result<(), MatrixError> {
        z.clone_from(&kept.0);
        for (sample, states) in samples.iter_mut().zip(&kept.1) {
            sample.states.clone_from(states);
        }
        self.follow(samples, z).map(|_| ())
    }

    /// Gives the loops their changed dimensions and brings the poses onto the motion again.
    pub(super) fn follow(
        &mut self,
        samples: &mut [Sample],
        z: &[f64],
    ) -> Result<bool, MatrixError> {
        for &joint in &self.loops.part.joints {
            let numbers = self.dimensions.numbers(joint, z);
            let states = samples.iter_mut().map(|s| &mut s.states[joint]);
            self.dimensions
                .set(&mut self.geometry, joint, &numbers, states);
        }
        for sample in samples {
            let Some(here) = self.loops.settle(&self.geometry, &mut sample.states, 1.0)? else {
                return Ok(false);
            };
            sample.here = here;
        }
        Ok(true)
    }
}

/// Σ filter(σ) v uᵀ b over the singular values, a step of least length; `filter` is told the largest as well.
fn least(equations: &Decomposed<'_>, b: &[f64], filter: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let svd = &equations.svd;
    let (u, s, v) = (svd.U(), svd.S().column_vector(), svd.V());
    let mut step = vec![0.0; v.nrows()];
    if s.nrows() == 0 || s[0] == 0.0 {
        return step;
    }
    for j in 0..s.nrows() {
        let along: f64 = (0..b.len()).map(|i| u[(i, j)] * b[i]).sum();
        let length = along * filter(s[j], s[0]);
        for (i, x) in step.iter_mut().enumerate() {
            *x += length * v[(i, j)];
        }
    }
    step
}

/// b − A x.
fn difference(b: &[f64], a: &Mat<f64>, x: &[f64]) -> Vec<f64> {
    let row = |i: usize| -> f64 { x.iter().enumerate().map(|(j, x)| a[(i, j)] * x).sum() };
    b.iter().enumerate().map(|(i, b)| b - row(i)).collect()
}
