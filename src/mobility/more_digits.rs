//! A part's Jacobian in as many digits as asked for, from the file's own numbers.

use super::pose_rank::Pose;
use crate::closure::{Arithmetic, Geometry, JointState, Part, entry_accuracy, jacobian, refine};
use crate::matrix::{Big, MatrixError, Real, SparseMatrix};
use std::collections::BTreeMap;

/// The mechanism evaluated in many digits, once for every number of bits however many parts need it.
#[derive(Debug, Default)]
pub struct MoreDigits(BTreeMap<u32, (Geometry<Big>, Vec<JointState<Big>>)>);

/// A part's Jacobian with unit columns.
pub(super) struct FinerMatrix {
    pub matrix: SparseMatrix<Big>,
    /// Relative uncertainty by rounding in this arithmetic.
    pub rounding: f64,
    /// What is left of the cycles (rad, cycle lengths).
    pub residual: f64,
}

impl MoreDigits {
    /// Nothing evaluated yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The mechanism in these bits, with a part's joints at their states and polished; `moved` says that they are not the
    /// drawn ones.
    pub(super) fn polished(
        &mut self,
        pose: &Pose<'_>,
        part: &Part,
        moved: bool,
        bits: u32,
    ) -> Result<(&Geometry<Big>, &[JointState<Big>]), MatrixError> {
        let (geometry, states) = self.0.entry(bits).or_insert_with(|| {
            let geometry =
                Geometry::new(pose.mechanism, pose.configuration, &Arithmetic::bits(bits));
            let states = geometry.states.clone();
            (geometry, states)
        });
        if moved {
            for &joint in &part.joints {
                states[joint] = geometry.displacements[joint]
                    .adopt(&pose.geometry.displacements[joint], &pose.states[joint]);
            }
        }
        refine(pose.mechanism, geometry, states, part, pose.held)?;
        Ok((geometry, states))
    }

    /// The Jacobian of a part at its states, polished in these bits; `moved` says that they are not the drawn ones.
    pub(super) fn matrix(
        &mut self,
        pose: &Pose<'_>,
        part: &Part,
        moved: bool,
        bits: u32,
    ) -> Result<FinerMatrix, MatrixError> {
        let (geometry, states) = self.polished(pose, part, moved, bits)?;
        let there = jacobian(pose.mechanism, geometry, states, part)?;
        let (_, rounding) = entry_accuracy(pose.mechanism, &there);
        let left: Vec<f64> = there.residual.iter().map(Real::to_f64).collect();
        let mut matrix = there.matrix;
        matrix.scale_columns();
        Ok(FinerMatrix {
            matrix,
            rounding,
            residual: 0.0.norm(&left),
        })
    }
}
