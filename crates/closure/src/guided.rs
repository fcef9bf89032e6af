//! Closing in many digits what is closed in double precision.

use super::displacement::JointState;
use super::section::{Closing, Section};
use kutzbach_math::matrix::{MatrixError, Real};

/// A correction that does not make the equations smaller by this factor does not follow its guide.
const FOLLOWS: f64 = 1e-3;

impl<R: Real> Section<'_, R> {
    /// [`Section::close_within_rounding`] from `states` that differ by rounding of doubles from those at which `guide`, the
    /// same part in double precision, is closed. Directions come from its derivative there, so that nothing but the equations
    /// themselves is evaluated in many digits; where that does not lead on, all of it is.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub fn close_guided(
        &self,
        states: &mut [JointState<R>],
        (guide, near): (&Section<'_, f64>, &[JointState<f64>]),
        held: &[Vec<f64>],
        limit: usize,
    ) -> Result<Closing, MatrixError> {
        let mut here = self.equations(states)?;
        let mut closing = self.before_closing(&here);
        let rounding = closing.rounding;
        if closing.residual <= rounding {
            return Ok(closing);
        }
        let derivative = guide
            .equations(near)?
            .linearised(guide.geometry, guide.part)?;
        while closing.residual > rounding && closing.steps < limit {
            let step = guide.step(&derivative, &here.residual, closing.residual, held)?;
            let unit = self.geometry.one.constant(closing.residual);
            let z: Vec<R> = step
                .iter()
                .map(|x| self.geometry.one.constant(*x) * unit.clone())
                .collect();
            self.advance(states, &z);
            here = self.equations(states)?;
            let reached = here.largest();
            let follows = reached <= FOLLOWS * closing.residual || reached <= rounding;
            closing.steps += 1;
            closing.last_step = 0.0.norm(&step) * closing.residual;
            closing.way += closing.last_step;
            closing.residual = reached;
            if !follows {
                let rest = self.close_within_rounding(states, held, limit)?;
                return Ok(Closing {
                    way: closing.way + rest.way,
                    steps: closing.steps + rest.steps,
                    ..rest
                });
            }
        }
        Ok(closing)
    }
}
