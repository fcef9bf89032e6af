//! A part's Jacobian in as many digits as asked for, from the file's own numbers.

use super::pose_rank::Pose;
use kutzbach_closure::{Arithmetic, Geometry, JointState, Part, entry_accuracy, jacobian, refine};
use kutzbach_math::matrix::{Extended, MatrixError, Real, SparseMatrix};
use std::collections::BTreeMap;

/// The mechanism evaluated in many digits, once for every number of bits however many parts need it.
#[derive(Debug, Default)]
pub struct MoreDigits(BTreeMap<u32, (Geometry<Extended>, Vec<JointState<Extended>>)>);

/// A part's Jacobian with unit columns.
pub(super) struct FinerMatrix {
    pub matrix: SparseMatrix<Extended>,
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
    ) -> Result<(&Geometry<Extended>, &[JointState<Extended>]), MatrixError> {
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
        let (_, rounding) = entry_accuracy(&there);
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::part_samples::Posed;
    use super::*;
    use crate::Structure;
    use crate::pose_rank::Trial;
    use kutzbach_closure::samples::{
        CRANK_ROCKER, Written, add_ring, flat_parallelogram, four_bar, planar, ring,
    };
    use kutzbach_math::matrix::decide;
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::MechanismBuilder;
    use std::collections::BTreeSet;

    #[test]
    fn every_rung_is_finer_by_its_bits() {
        let posed = Posed::new(flat_parallelogram());
        let mut more = MoreDigits::new();
        for bits in [106, 212, 424] {
            let finer = more
                .matrix(&posed.pose(), posed.part(), false, bits)
                .unwrap();
            let roundoff = 0.5f64.powi(bits as i32);
            assert!(
                finer.rounding < 1e4 * roundoff && finer.rounding > roundoff,
                "{bits}"
            );
            assert_eq!(finer.residual, 0.0, "{bits}: drawn closed");
            let decision = decide(&finer.matrix, finer.rounding).unwrap();
            assert_eq!((decision.rank, decision.bits), (Some(2), bits));
            // Its entries are those of the double-precision matrix.
            let double = posed.rank().matrix;
            for (fine, coarse) in finer.matrix.triplets().zip(double.triplets()) {
                assert_eq!((fine.0, fine.1), (coarse.0, coarse.1));
                assert!((fine.2.to_f64() - coarse.2).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn an_assembled_pose_is_polished_to_the_last_bits() {
        let gap = [0.5, -0.25, 0.0];
        let posed = Posed::new(ring(&planar(&CRANK_ROCKER), gap, Written::Exactly));
        assert!(posed.assembly.steps > 0);
        let mut more = MoreDigits::new();
        let finer = more.matrix(&posed.pose(), posed.part(), true, 106).unwrap();
        assert!(
            finer.residual < 64.0 * 0.5f64.powi(106),
            "{:e}",
            finer.residual
        );
        let (_, states) = more
            .polished(&posed.pose(), posed.part(), true, 106)
            .unwrap();
        for (fine, coarse) in states.iter().zip(&posed.assembly.states) {
            assert!((fine.values[0].to_f64() - coarse.values[0]).abs() < 1e-12);
        }
    }

    #[test]
    fn a_mechanism_is_evaluated_once_for_each_number_of_bits() {
        let mut builder = MechanismBuilder::new("two");
        builder.link("ground");
        for name in ["p", "q"] {
            add_ring(
                &mut builder,
                name,
                "ground",
                &planar(&CRANK_ROCKER),
                [0.0; 3],
                Written::Exactly,
            );
        }
        let posed = Posed::new(builder.build().unwrap());
        let mut more = MoreDigits::new();
        for part in &posed.structure.parts {
            for bits in [106, 106, 212] {
                more.matrix(&posed.pose(), part, false, bits).unwrap();
            }
        }
        assert_eq!(more.0.keys().copied().collect::<Vec<_>>(), [106, 212]);
    }

    #[test]
    fn held_joints_keep_their_values() {
        let mut builder = MechanismBuilder::new("held");
        builder.link("ground");
        add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        let value = Number::from_f64(0.5).unwrap();
        builder.configuration("turned", vec![("r_a".to_owned(), vec![value])]);
        let mechanism = builder.build().unwrap();
        let configuration = mechanism.configuration("turned");
        let held = BTreeSet::from([mechanism.joint_named("r_a").unwrap().0]);
        let geometry = Geometry::new(&mechanism, configuration, &Arithmetic::double());
        let structure = Structure::new(&mechanism);
        let assembly =
            kutzbach_closure::assemble(&mechanism, &geometry, &structure.parts, &held).unwrap();
        assert!(assembly.closed);
        let pose = Pose {
            mechanism: &mechanism,
            configuration,
            held: &held,
            geometry: &geometry,
            states: &assembly.states,
            as_drawn: false,
            trial: Trial::default(),
        };
        let mut more = MoreDigits::new();
        let (_, states) = more
            .polished(&pose, &structure.parts[0], true, 106)
            .unwrap();
        let joint = mechanism.joint_named("r_a").unwrap().0;
        // To the last bit.
        let value = &states[joint].values[0];
        let off = value.clone() - value.constant(0.5);
        assert_eq!(off.to_f64(), 0.0);
        let finer = more.matrix(&pose, &structure.parts[0], true, 106).unwrap();
        assert!(
            finer.residual < 64.0 * 0.5f64.powi(106),
            "{:e}",
            finer.residual
        );
    }

    #[test]
    fn numbers_that_do_not_close_stay_open_in_all_digits() {
        // Closed to double precision, and across the plane of its hinges open beyond.
        let posed = Posed::new(ring(
            &planar(&CRANK_ROCKER),
            [0.0, 0.0, 1e-20],
            Written::Exactly,
        ));
        assert!(posed.pose().as_drawn);
        let mut more = MoreDigits::new();
        let finer = more
            .matrix(&posed.pose(), posed.part(), false, 212)
            .unwrap();
        assert!(
            finer.residual > 1e-21 && finer.residual < 1e-19,
            "{:e}",
            finer.residual
        );
        let closed = Posed::new(four_bar());
        let mut more = MoreDigits::new();
        let finer = more
            .matrix(&closed.pose(), closed.part(), false, 212)
            .unwrap();
        assert_eq!(finer.residual, 0.0);
    }
}
