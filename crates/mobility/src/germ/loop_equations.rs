//! The closure equations of a part as power series in a few variables.
//!
//! At a closed pose the product of displacements around a cycle is a product of exponentials of the joints'
//! *instantaneous* screws: a factor that is advanced by F ← F exp(Σ ξᵢ xᵢ) stands before everything behind it, so that
//! the exponential can be carried to the front, where its generators are the screws of the pose. A joint passed
//! backward contributes its factors in reverse, with negative screws. Variables of one factor (the three of a ball, the
//! first two of a distance joint) share one exponential; all others have one each.
//!
//! A cycle's six equations are the antisymmetric part of the rotation and the displacement of the cycle's centre in units
//! of its length. Near the identity they vanish with the twist of the closure only, so that the germ is the same. Couplings
//! follow below: their rows, and what they have beyond first order. Variables are those of the matrix with unit columns.

use crate::PartRank;
use kutzbach_math::group::{DisplacementSeries, Monomials, Series, Twist};
use kutzbach_math::matrix::{MatrixError, SparseMatrix, SplitMix64};
use kutzbach_model::mechanism::{JointKind, Mechanism};
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Variables that share one exponential, with their screws about the centre of the cycle.
struct Factor {
    columns: Vec<usize>,
    screws: Vec<Twist>,
}

/// The equations of a part.
pub(super) struct LoopEquations {
    cycles: Vec<Vec<Factor>>,
    /// Rows of the couplings: (column, entry).
    couplings: Vec<Vec<(usize, f64)>>,
    /// What each has beyond first order: column, and the factors of the square of its variable, its cube, and so on.
    higher: Vec<Vec<(usize, Vec<f64>)>>,
    /// Radians or metres per unit of each variable.
    units: Vec<f64>,
}

/// How many variables of a joint share an exponential, factor by factor.
pub(super) fn factor_sizes(kind: JointKind) -> &'static [usize] {
    match kind {
        JointKind::Fixed => &[],
        JointKind::Revolute | JointKind::Prismatic | JointKind::Screw => &[1],
        JointKind::Cylindrical | JointKind::Universal | JointKind::PlanarTranslation => &[1, 1],
        JointKind::Planar | JointKind::Translational | JointKind::TranslatingScrew => &[1, 1, 1],
        JointKind::Schoenflies | JointKind::LineOnPlane => &[1, 1, 1, 1],
        JointKind::Spherical => &[3],
        JointKind::PointOnLine => &[3, 1],
        JointKind::PointOnPlane => &[3, 1, 1],
        JointKind::Distance => &[2, 3],
    }
}

impl LoopEquations {
    /// The equations at the pose the rank was decided at.
    pub(super) fn new(mechanism: &Mechanism, rank: &PartRank) -> Self {
        let jacobian = &rank.jacobian;
        let mut first_column = BTreeMap::new();
        let mut units = Vec::with_capacity(jacobian.variables.len());
        for (column, (joint, _)) in jacobian.variables.iter().enumerate() {
            first_column.entry(*joint).or_insert(column);
            // A variable that moves no cycle keeps its own unit.
            let scale = Some(rank.column_scales[column]).filter(|s| *s > 0.0);
            units.push(jacobian.unit(mechanism, column) / scale.unwrap_or(1.0));
        }
        let cycles = jacobian.walks.iter().map(|walk| {
            let mut factors = Vec::new();
            for joint in &walk.joints {
                let Some(&first) = first_column.get(&joint.joint) else {
                    continue;
                };
                let sign = if joint.forward { 1.0 } else { -1.0 };
                let mut own = Vec::new();
                let mut next = 0;
                for &size in factor_sizes(mechanism.joints()[joint.joint].kind) {
                    let variables = next..next + size;
                    next += size;
                    let screws = variables.clone().map(|variable| {
                        let (angular, linear) = joint.screws[variable].about(&walk.centre);
                        let twist =
                            Twist::new(Vector3::from(angular), Vector3::from(linear) / walk.length);
                        twist * (sign * units[first + variable])
                    });
                    own.push(Factor {
                        screws: screws.collect(),
                        columns: variables.map(|variable| first + variable).collect(),
                    });
                }
                if !joint.forward {
                    own.reverse();
                }
                factors.append(&mut own);
            }
            factors
        });
        let cycles: Vec<Vec<Factor>> = cycles.collect();
        let couplings = (6 * cycles.len()..rank.matrix.rows())
            .map(|row| rank.matrix.row(row).to_vec())
            .collect();
        let higher = jacobian.coupling_higher.iter().map(|row| {
            let shares = row.iter().filter_map(|(joint, factors)| {
                let &column = first_column.get(joint)?;
                let powers = (2..).zip(factors);
                let own = powers.map(|(power, factor)| factor * units[column].powi(power));
                Some((column, own.collect()))
            });
            shares.collect()
        });
        Self {
            cycles,
            couplings,
            higher: higher.collect(),
            units,
        }
    }

    /// Radians or metres per unit of each variable.
    pub(super) fn units(&self) -> &[f64] {
        &self.units
    }

    /// Number of coordinates of all screws, and entries of all couplings.
    pub(super) fn entry_count(&self) -> usize {
        let screws = self.cycles.iter().flatten().map(|f| 6 * f.columns.len());
        screws.chain(self.couplings.iter().map(Vec::len)).sum()
    }

    /// The most exponentials in a cycle.
    pub(super) fn longest_cycle(&self) -> usize {
        self.cycles.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// The linear part: the Jacobian with unit columns.
    pub(super) fn matrix(&self) -> Result<SparseMatrix<f64>, MatrixError> {
        let mut triplets = Vec::new();
        for (cycle, factors) in self.cycles.iter().enumerate() {
            for factor in factors {
                for (column, screw) in factor.columns.iter().zip(&factor.screws) {
                    let screw = screw.to_vector();
                    triplets.extend((0..6).map(|row| (6 * cycle + row, *column, screw[row])));
                }
            }
        }
        let first = 6 * self.cycles.len();
        for (coupling, row) in self.couplings.iter().enumerate() {
            triplets.extend(
                row.iter()
                    .map(|(column, entry)| (first + coupling, *column, *entry)),
            );
        }
        SparseMatrix::from_triplets(
            first + self.couplings.len(),
            self.units.len(),
            0.0,
            triplets,
        )
    }

    /// The same with every entry changed by a random number up to `amplitude` in size.
    pub(super) fn changed(&self, amplitude: f64, random: &mut SplitMix64) -> Self {
        let mut change = |x: f64| x + amplitude * random.symmetric();
        let mut changed = Self {
            cycles: Vec::with_capacity(self.cycles.len()),
            couplings: self.couplings.clone(),
            higher: self.higher.clone(),
            units: self.units.clone(),
        };
        for factors in &self.cycles {
            let factors = factors.iter().map(|factor| Factor {
                columns: factor.columns.clone(),
                screws: factor
                    .screws
                    .iter()
                    .map(|screw| Twist::from(screw.to_vector().map(&mut change)))
                    .collect(),
            });
            changed.cycles.push(factors.collect());
        }
        for (_, entry) in changed.couplings.iter_mut().flatten() {
            *entry = change(*entry);
        }
        for (_, factors) in changed.higher.iter_mut().flatten() {
            factors.iter_mut().for_each(|x| *x = change(*x));
        }
        changed
    }

    /// Every row as a power series, where each variable is one without constant term. Coefficients of the variables beyond
    /// the degree of `monomials` are left out, missing ones count as zero.
    pub(super) fn evaluate(
        &self,
        monomials: &Arc<Monomials>,
        variables: &[Vec<f64>],
    ) -> Vec<Series> {
        let series: Vec<Series> = variables
            .iter()
            .map(|coefficients| {
                let mut coefficients = coefficients.clone();
                coefficients.resize(monomials.count(), 0.0);
                Series::from_coefficients(monomials, coefficients)
            })
            .collect();
        let still: Vec<bool> = series
            .iter()
            .map(|s| s.coefficients().iter().all(|c| *c == 0.0))
            .collect();
        let mut rows = Vec::with_capacity(6 * self.cycles.len() + self.couplings.len());
        for cycle in &self.cycles {
            let mut product: Option<DisplacementSeries> = None;
            for factor in cycle {
                if factor.columns.iter().all(|c| still[*c]) {
                    continue;
                }
                let exponential = factor.exponential(monomials, &series);
                product = Some(match product {
                    None => exponential,
                    Some(before) => &before * &exponential,
                });
            }
            let closure = product.unwrap_or_else(|| DisplacementSeries::identity(monomials));
            rows.extend(closure.closure_residual());
        }
        for (coupling, higher) in self.couplings.iter().zip(&self.higher) {
            let mut row = Series::zero(monomials);
            for (column, entry) in coupling {
                row.add_scaled(*entry, &series[*column]);
            }
            for (column, factors) in higher {
                let mut power = series[*column].clone();
                for factor in factors {
                    power = &power * &series[*column];
                    row.add_scaled(*factor, &power);
                }
            }
            rows.push(row);
        }
        rows
    }
}

impl Factor {
    fn exponential(&self, monomials: &Arc<Monomials>, series: &[Series]) -> DisplacementSeries {
        if let ([column], [screw]) = (&self.columns[..], &self.screws[..]) {
            return DisplacementSeries::exp(screw, &series[*column]);
        }
        let mut exponent = [0; 6].map(|_| Series::zero(monomials));
        for (column, screw) in self.columns.iter().zip(&self.screws) {
            let screw = screw.to_vector();
            for (coordinate, factor) in exponent.iter_mut().zip(screw.iter()) {
                coordinate.add_scaled(*factor, &series[*column]);
            }
        }
        let [a, b, c, x, y, z] = exponent;
        DisplacementSeries::exp_twist(&[a, b, c], &[x, y, z])
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_closure::JointDisplacement;
    use kutzbach_math::group::Pose;

    #[test]
    fn every_joint_is_a_product_of_exponentials_of_its_screws() {
        // From a random state, the displacement reached by `advance` and the product of exponentials of the screws of the
        // state, one per factor.
        let mut random = SplitMix64::new(5);
        for kind in JointKind::ALL {
            let joint =
                JointDisplacement::new(kind, &[0.5, -1.0, 0.25], &[0.25, 0.75, 1.0], &0.15, &0.7);
            let mut draw =
                || -> Vec<f64> { (0..kind.freedom()).map(|_| random.symmetric()).collect() };
            let (start, step) = (draw(), draw());
            let mut state = joint.at(&start);
            let pose = |state: &kutzbach_closure::JointState<f64>| {
                let d = joint.displacement(state);
                Pose::new(
                    nalgebra::Matrix3::from_fn(|i, j| d.rotation[i][j]),
                    Vector3::from(d.translation),
                )
            };
            let before = pose(&state);
            let screws = joint.screws(&state);
            assert_eq!(factor_sizes(kind).iter().sum::<usize>(), kind.freedom());
            let mut product = Pose::identity();
            let mut next = 0;
            for &size in factor_sizes(kind) {
                let mut exponent = Twist::zero();
                for i in next..next + size {
                    let (angular, linear) = screws[i].about(&[0.0; 3]);
                    exponent += Twist::new(angular.into(), linear.into()) * step[i];
                }
                next += size;
                product = product * Pose::exp(&exponent);
            }
            joint.advance(&mut state, &step);
            let apart = pose(&state).to_homogeneous() - (product * before).to_homogeneous();
            assert!(apart.norm() < 1e-14, "{kind}: {}", apart.norm());
        }
    }
}
