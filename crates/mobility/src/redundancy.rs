//! Which joints' constraints repeat what others say, and which single joint could be relaxed.
//!
//! A self-stress λ in ker Jᵀ loads joint j with the wrench `W_j = Σ_l ± λ_l`, reciprocal to the joint's own screws. Over a
//! basis of self-stresses the rank of `W_j` is the number of reaction directions of the joint that no measurement of the
//! motion determines (Wojtyra 2005). Freeing a screw T in the joint removes one redundancy, and adds no freedom, exactly
//! when `Tᵀ W_j ≠ 0`: the new column is then independent of the old ones.

use super::hidden::null_vectors_in_doubles;
use super::pose_rank::PartRank;
use kutzbach_closure::{Part, PlacedScrew, Vector, WalkedJoint};
use kutzbach_math::matrix::{MatrixError, NullVectors};
use nalgebra::DMatrix;
use std::collections::BTreeMap;

/// Above this many self-stresses random ones stand for a basis: the rank of a joint's six-row wrench matrix is at most
/// six, and this many random combinations reach it with probability one, to spare.
const SELF_STRESSES: usize = 24;

/// A joint that is in so many equations couples them all with one another: the factor of the transposed equations holds half the
/// square of this number at least, 256 megabytes, and is not made.
const MOST_COUPLED: usize = 8000;

/// The self-stresses of a part.
pub struct SelfStresses {
    vectors: NullVectors<f64>,
    /// Length below which a row of loads is taken for zero.
    threshold: f64,
    /// Where each joint is met: (cycle, position in the cycle's walk).
    met: BTreeMap<usize, Vec<(usize, usize)>>,
}

impl SelfStresses {
    /// Computes the self-stresses of a part whose rank is settled; `None` where it is not, or where a joint is in too many cycles.
    ///
    /// # Errors
    /// [`MatrixError`] where the null vectors cannot be computed.
    pub fn new(part: &Part, rank: &PartRank) -> Result<Option<Self>, MatrixError> {
        Self::up_to(part, rank, SELF_STRESSES)
    }

    /// [`Self::new`] with a basis, however many there are. Its memory grows with the square of their number.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn all(part: &Part, rank: &PartRank) -> Result<Option<Self>, MatrixError> {
        Self::up_to(part, rank, usize::MAX)
    }

    fn up_to(part: &Part, rank: &PartRank, most: usize) -> Result<Option<Self>, MatrixError> {
        let Some(decision) = rank.settled() else {
            return Ok(None);
        };
        let transposed = rank.matrix.transpose();
        if (0..transposed.rows()).any(|row| transposed.row(row).len() > MOST_COUPLED) {
            return Ok(None);
        }
        let decided = decision.transposed();
        let Some(vectors) = null_vectors_in_doubles(&transposed, &decided, most, 2)? else {
            return Ok(None);
        };
        let kept = decision.kept.max(f64::MIN_POSITIVE);
        // A null vector of unit length is off by up to the accuracy of the matrix over the smallest kept singular value,
        // and a joint's share of it is of the order of 1/√rows. In a large part the smallest singular value belongs to a
        // slow wave through all of it, which bounds the error far too high; a tenth of a share is the most that is asked.
        let share = 1.0 / (rank.equations().max(1) as f64).sqrt();
        let error = 10.0 * (vectors.residual + decision.accuracy) / kept;
        let threshold = share * error.clamp(1e-9, 0.1);
        let mut met: BTreeMap<usize, Vec<(usize, usize)>> =
            part.joints.iter().map(|j| (*j, Vec::new())).collect();
        for (cycle, walk) in rank.jacobian.walks.iter().enumerate() {
            for (position, joint) in walk.joints.iter().enumerate() {
                met.entry(joint.joint).or_default().push((cycle, position));
            }
        }
        Ok(Some(Self {
            vectors,
            threshold,
            met,
        }))
    }

    /// How many there are in a basis: the redundant constraints of the part.
    #[must_use]
    pub fn count(&self) -> usize {
        self.vectors.nullity
    }

    /// Length below which a row of loads is taken for zero.
    #[must_use]
    pub fn threshold(&self) -> f64 {
        self.threshold
    }

    /// What the self-stresses do to a screw in a joint: one number per self-stress, `Σ_l ± ⟨λ_l, T⟩`.
    fn load(
        &self,
        rank: &PartRank,
        joint: usize,
        screw: &dyn Fn(&WalkedJoint<f64>) -> PlacedScrew<f64>,
    ) -> Vec<f64> {
        let mut loads = vec![0.0; self.vectors.vectors.len()];
        for &(cycle, position) in self.met.get(&joint).into_iter().flatten() {
            let walk = &rank.jacobian.walks[cycle];
            let walked = &walk.joints[position];
            let column = walk.column(walked, &screw(walked));
            for (load, stress) in loads.iter_mut().zip(&self.vectors.vectors) {
                *load += (0..6)
                    .map(|row| stress[6 * cycle + row] * column[row])
                    .sum::<f64>();
            }
        }
        loads
    }

    /// The loads of several screws given in the joint's own frame, one row each: (angular; linear in units of the part's
    /// length).
    pub fn loads(
        &self,
        rank: &PartRank,
        joint: usize,
        screws: &[(Vector<f64>, Vector<f64>)],
    ) -> DMatrix<f64> {
        let length = rank.jacobian.length;
        let placed: Vec<_> = screws
            .iter()
            .map(|(angular, linear)| PlacedScrew {
                angular: *angular,
                point: [0.0; 3],
                linear: linear.map(|x| x * length),
            })
            .collect();
        let rows = self.loads_of(rank, joint, &placed);
        DMatrix::from_fn(screws.len(), self.vectors.vectors.len(), |i, j| rows[i][j])
    }

    /// [`Self::loads`] of screws in metres, one row each.
    pub fn loads_of(
        &self,
        rank: &PartRank,
        joint: usize,
        screws: &[PlacedScrew<f64>],
    ) -> Vec<Vec<f64>> {
        screws
            .iter()
            .map(|screw| self.load(rank, joint, &|walked| screw.clone().moved(&walked.frame)))
            .collect()
    }

    /// The lengths of the columns that screws in a joint add to the Jacobian, the screws as for [`Self::loads_of`].
    pub fn column_lengths(
        &self,
        rank: &PartRank,
        joint: usize,
        screws: &[PlacedScrew<f64>],
    ) -> Vec<f64> {
        let met = self.met.get(&joint).map_or(&[][..], Vec::as_slice);
        let square = |screw: &PlacedScrew<f64>, &(cycle, position): &(usize, usize)| {
            let walk = &rank.jacobian.walks[cycle];
            let walked = &walk.joints[position];
            let column = walk.column(walked, &screw.clone().moved(&walked.frame));
            column.iter().map(|x| x * x).sum::<f64>()
        };
        let length = |screw| met.iter().map(|met| square(screw, met)).sum::<f64>().sqrt();
        screws.iter().map(length).collect()
    }

    /// The number of indeterminate reaction directions of a joint: the rank of its wrench matrix.
    pub fn indeterminate_wrenches(&self, rank: &PartRank, joint: usize) -> usize {
        let unit = |i: usize| {
            let mut v = [0.0; 3];
            v[i] = 1.0;
            v
        };
        let basis: Vec<_> = (0..3)
            .map(|i| (unit(i), [0.0; 3]))
            .chain((0..3).map(|i| ([0.0; 3], unit(i))))
            .collect();
        self.rank(&self.loads(rank, joint, &basis))
    }

    /// Number of independent rows of a load matrix, against the accuracy of the self-stresses.
    pub fn rank(&self, loads: &DMatrix<f64>) -> usize {
        if loads.ncols() == 0 || loads.nrows() == 0 {
            return 0;
        }
        independent_rows(loads, self.threshold)
    }
}

/// Row-pivoted orthogonalisation; rows shorter than `threshold` after reduction count as dependent. At most six rows.
fn independent_rows(loads: &DMatrix<f64>, threshold: f64) -> usize {
    let mut rows: Vec<Vec<f64>> = loads
        .row_iter()
        .map(|row| row.iter().copied().collect())
        .collect();
    let norm = |row: &Vec<f64>| row.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut rank = 0;
    while let Some(best) =
        (0..rows.len()).max_by(|a, b| norm(&rows[*a]).total_cmp(&norm(&rows[*b])))
    {
        let size = norm(&rows[best]);
        if size <= threshold {
            break;
        }
        rank += 1;
        let pivot: Vec<f64> = rows.swap_remove(best).iter().map(|x| x / size).collect();
        for row in &mut rows {
            for _ in 0..2 {
                let along: f64 = row.iter().zip(&pivot).map(|(x, p)| x * p).sum();
                for (x, p) in row.iter_mut().zip(&pivot) {
                    *x -= along * p;
                }
            }
        }
    }
    rank
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{Analysis, AnalysisOptions, analyse};
    use kutzbach_closure::samples::{
        CRANK_ROCKER, Place, Written, add_ring, four_bar, planar, ring, sarrus,
    };
    use kutzbach_model::mechanism::{JointBuilder, JointKind, Mechanism, MechanismBuilder};

    fn analysed(mechanism: &Mechanism) -> Analysis {
        analyse(mechanism, &AnalysisOptions::default()).unwrap()
    }

    #[test]
    fn a_planar_four_bar_is_loaded_in_three_directions_everywhere() {
        let analysis = analysed(&four_bar());
        assert_eq!(analysis.redundant_wrenches, [Some(3); 4]);
        assert_eq!(analysed(&sarrus()).redundant_wrenches, [Some(1); 6]);
    }

    #[test]
    fn bridges_and_independent_loops_carry_nothing() {
        let mut builder = MechanismBuilder::new("hand");
        builder.link("ground");
        add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        builder.link("hand");
        builder.joint(JointBuilder::tree(
            "wrist",
            JointKind::Revolute,
            "r2",
            "hand",
        ));
        let mechanism = builder.build().unwrap();
        let wrist = mechanism.joint_named("wrist").unwrap().0;
        let found = analysed(&mechanism).redundant_wrenches;
        assert_eq!(found[wrist], Some(0));
        assert_eq!(found[0], Some(3));
        // R C C C: nothing redundant.
        let places: Vec<Place> = vec![
            (JointKind::Revolute, [0.0; 3], [0.0, 0.25, 1.0]),
            (JointKind::Cylindrical, [1.0, 0.25, 0.0], [0.5, 0.0, 1.0]),
            (JointKind::Cylindrical, [1.0, 1.5, 0.5], [0.0, 1.0, 0.5]),
            (JointKind::Cylindrical, [0.25, 1.0, -0.5], [1.0, -0.5, 0.25]),
        ];
        let analysis = analysed(&ring(&places, [0.0; 3], Written::Exactly));
        assert_eq!(analysis.home.unwrap().redundant, Some(0));
        assert_eq!(analysis.redundant_wrenches, [Some(0); 4]);
    }

    #[test]
    fn loads_are_reciprocal_to_the_joint_and_felt_across_it() {
        let analysis = analysed(&four_bar());
        let (part, rank) = (&analysis.structure.parts[0], &analysis.parts[0]);
        let stresses = SelfStresses::new(part, rank).unwrap().unwrap();
        let none = [0.0; 3];
        for joint in 0..4 {
            let own = stresses.loads(rank, joint, &[([0.0, 0.0, 1.0], none)]);
            assert!(
                own.norm() < 1e-14,
                "a hinge carries nothing about its own axis"
            );
            assert_eq!(stresses.rank(&own), 0);
            let sliding = stresses.loads(rank, joint, &[(none, [0.0, 0.0, 1.0])]);
            assert_eq!(stresses.rank(&sliding), 1);
            let in_plane = stresses.loads(
                rank,
                joint,
                &[(none, [1.0, 0.0, 0.0]), (none, [0.0, 1.0, 0.0])],
            );
            assert_eq!(
                stresses.rank(&in_plane),
                0,
                "forces in the plane are determined"
            );
        }
    }

    #[test]
    fn open_ranks_have_no_self_stresses() {
        let analysis = analysed(&four_bar());
        let mut rank = analysis.parts[0].clone();
        rank.instantaneous = None;
        assert!(
            SelfStresses::new(&analysis.structure.parts[0], &rank)
                .unwrap()
                .is_none()
        );
    }

    #[test]
    fn independent_rows_are_counted_against_the_threshold() {
        let loads = DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 0.0, 1.0, 1e-7, 0.0, 0.0, 0.0, 0.5]);
        assert_eq!(independent_rows(&loads, 1e-9), 3);
        assert_eq!(independent_rows(&loads, 1e-6), 2);
        assert_eq!(independent_rows(&DMatrix::zeros(6, 2), 0.0), 0);
    }
}
