//! Screw systems: linear spaces of twists, with rank decisions that carry their margin.

use nalgebra::Vector6;

use super::GroupError;
use super::decomposition::{Decomposition, Margin, ROUNDING};
use super::gauge::Gauge;
use super::twist::Twist;

/// A linear subspace of se(3) (Hunt 1978; Gibson and Hunt 1990), not necessarily closed under the bracket.
///
/// It is held as an orthonormal basis in the metric of a [`Gauge`], together with two numbers:
///
/// * its *uncertainty* δ, a bound on the sine of the angle between this space and the one that exact
///   geometry would give;
/// * its [`Margin`], the worst over all rank decisions that led to it.
///
/// Tolerances follow from perturbation bounds, one operation after another. A matrix of n unit columns, each
/// wrong by e_j, has singular values wrong by at most τ = √Σe_j² (Weyl), so those above τ are
/// certainly nonzero. The space spanned by the singular vectors kept is then wrong by at most
/// τ/(σ_k − τ), where σ_k is the smallest value kept (Wedin 1972); that is the δ of the result and the e of
/// the next operation. Columns enter with the error derived at [`Gauge`]. All bounds are worst cases.
#[derive(Clone, Debug)]
pub struct ScrewSystem {
    pub(super) gauge: Gauge,
    /// Orthonormal, in the coordinates of [`Gauge::measure`].
    pub(super) basis: Vec<Vector6<f64>>,
    pub(super) uncertainty: f64,
    pub(super) margin: Margin,
}

/// Residuals whose norm, which bounds every singular value, is below this share of the tolerance are zero without a look at
/// their directions. What is kept stands ten tolerances above zero in a clear margin, which then is a thousand times as much.
const NEGLIGIBLE: f64 = 0.01;

impl ScrewSystem {
    /// The space of no motion.
    pub fn empty(gauge: &Gauge) -> Self {
        Self {
            gauge: *gauge,
            basis: Vec::new(),
            uncertainty: 0.0,
            margin: Margin::CERTAIN,
        }
    }

    /// All of se(3).
    pub fn full(gauge: &Gauge) -> Self {
        let unit = |i| Vector6::from_fn(|row, _| if row == i { 1.0 } else { 0.0 });
        Self {
            basis: (0..6).map(unit).collect(),
            ..Self::empty(gauge)
        }
    }

    /// The space spanned by world twists. The length of each twist is irrelevant; zero twists are skipped.
    ///
    /// # Errors
    /// [`GroupError::NotFinite`], [`GroupError::NoConvergence`].
    pub fn span(twists: &[Twist], gauge: &Gauge) -> Result<Self, GroupError> {
        let mut columns = Vec::with_capacity(twists.len());
        let mut squared_error = 0.0;
        for twist in twists {
            // Dividing by the largest coordinate first keeps squares within range.
            let largest = twist.to_vector().amax();
            if !twist.is_finite() {
                return Err(GroupError::NotFinite(*twist));
            }
            if largest == 0.0 {
                continue;
            }
            let twist = twist_over(twist, largest);
            let column = gauge.measure(&twist);
            let norm = column.norm();
            if norm == 0.0 {
                continue;
            }
            columns.push(column / norm);
            squared_error += gauge.direction_error(&twist, norm).powi(2);
        }
        let empty = Self::empty(gauge);
        empty.spanned(&columns, squared_error.sqrt(), Margin::CERTAIN)
    }

    /// The space spanned by measured columns whose matrix is wrong by at most `error` in norm.
    fn spanned(
        &self,
        columns: &[Vector6<f64>],
        error: f64,
        margin: Margin,
    ) -> Result<Self, GroupError> {
        let decomposition = Decomposition::of_columns(columns)?;
        let tolerance = error + ROUNDING * decomposition.norm();
        let (rank, decision) = Margin::decide(&decomposition.values, tolerance);
        let uncertainty = match rank {
            0 => 0.0,
            _ => perturbed_angle(tolerance, decomposition.values[rank - 1]),
        };
        Ok(Self {
            gauge: self.gauge,
            basis: (0..rank).map(|k| decomposition.left6(k)).collect(),
            uncertainty,
            margin: margin.and(decision),
        })
    }

    /// Dimension of the space.
    pub fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// The gauge in which the basis is orthonormal.
    pub fn gauge(&self) -> &Gauge {
        &self.gauge
    }

    /// A basis of world twists, orthonormal in the metric of [`ScrewSystem::gauge`].
    pub fn basis(&self) -> Vec<Twist> {
        self.basis.iter().map(|b| self.gauge.twist(b)).collect()
    }

    /// Bound on the sine of the angle between this space and the exact one.
    pub fn uncertainty(&self) -> f64 {
        self.uncertainty
    }

    /// Worst margin of the rank decisions behind this space.
    pub fn margin(&self) -> Margin {
        self.margin
    }

    /// Sine of the angle between a twist and this space; 0 for the zero twist.
    pub fn distance(&self, twist: &Twist) -> f64 {
        let largest = twist.to_vector().amax();
        if largest == 0.0 {
            return 0.0;
        }
        let column = self.gauge.measure(&twist_over(twist, largest));
        let norm = column.norm();
        if norm == 0.0 {
            0.0
        } else {
            self.residual(&(column / norm)).norm()
        }
    }

    /// True where a twist lies in this space, within the uncertainty of both.
    pub fn contains(&self, twist: &Twist) -> bool {
        let largest = twist.to_vector().amax();
        if largest == 0.0 {
            return true;
        }
        let scaled = twist_over(twist, largest);
        let norm = self.gauge.measure(&scaled).norm();
        let own = self.gauge.direction_error(&scaled, norm);
        self.distance(twist) <= own + self.uncertainty + ROUNDING
    }

    /// True where every twist of this space lies in `other`, within the uncertainty of both.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn is_within(&self, other: &Self) -> Result<bool, GroupError> {
        Ok(self.intersection(other)?.dimension() == self.dimension())
    }

    /// True where the two are the same space, within the uncertainty of both.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn same_as(&self, other: &Self) -> Result<bool, GroupError> {
        Ok(self.dimension() == other.dimension() && self.is_within(other)?)
    }

    /// The sum of two spaces: everything either of them, or both together, can do instantaneously.
    /// The result is in the gauge of `self`.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn sum(&self, other: &Self) -> Result<Self, GroupError> {
        let other = other.in_gauge(&self.gauge)?;
        let columns: Vec<_> = self.basis.iter().chain(&other.basis).copied().collect();
        // The two bases perturb disjoint sets of columns: norms add in squares.
        let error = self.uncertainty.hypot(other.uncertainty);
        self.spanned(&columns, error, self.margin.and(other.margin))
    }

    /// The intersection of two spaces: what both allow. The result is in the gauge of `self`.
    ///
    /// The sines of the principal angles are the singular values of (I − P_A) B, with B an orthonormal basis
    /// of the smaller space (Björck and Golub 1973: cosines would lose half of the digits). Both
    /// uncertainties shift them by at most δ_A + δ_B.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn intersection(&self, other: &Self) -> Result<Self, GroupError> {
        let other = other.in_gauge(&self.gauge)?;
        let (large, small) = if self.dimension() >= other.dimension() {
            (self, &other)
        } else {
            (&other, self)
        };
        let residuals: Vec<_> = small.basis.iter().map(|b| large.residual(b)).collect();
        let decomposition = Decomposition::of_columns(&residuals)?;
        let inherited = self.uncertainty + other.uncertainty;
        let tolerance = inherited + ROUNDING;
        let (outside, decision) = Margin::decide(&decomposition.values, tolerance);
        let basis: Vec<_> = (outside..small.dimension())
            .map(|k| decomposition.combine(&small.basis, k))
            .collect();
        let uncertainty = if basis.is_empty() {
            0.0
        } else if outside == 0 {
            small.uncertainty
        } else {
            small.uncertainty + perturbed_angle(tolerance, decomposition.values[outside - 1])
        };
        Ok(Self {
            gauge: self.gauge,
            basis,
            uncertainty: uncertainty.min(1.0),
            margin: self.margin.and(other.margin).and(decision),
        })
    }

    /// The same space measured by another gauge.
    ///
    /// Changing the length from L to L' stretches one half of the coordinates by L/L'; moving the centre by s
    /// shears them by s/L'. Angles grow by at most the condition number of the map, bounded by
    /// max(L/L', L'/L)·(1 + s/L')², and so does the uncertainty.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn in_gauge(&self, gauge: &Gauge) -> Result<Self, GroupError> {
        let (from, to) = (&self.gauge, gauge);
        if from.centre() == to.centre() && from.length() == to.length() {
            let mut same = self.clone();
            same.gauge = *gauge;
            return Ok(same);
        }
        let columns: Vec<_> = self.basis().iter().map(|t| to.measure(t)).collect();
        let orthonormal = Decomposition::of_columns(&columns)?;
        let ratio = from.length() / to.length();
        let shear = 1.0 + (from.centre() - to.centre()).norm() / to.length();
        let condition = ratio.max(1.0 / ratio) * shear * shear;
        let far = (from.centre().norm() + to.centre().norm()) / to.length().min(from.length());
        let rounding = 8.0 * f64::EPSILON * (1.0 + far);
        Ok(Self {
            gauge: *gauge,
            basis: (0..columns.len()).map(|k| orthonormal.left6(k)).collect(),
            uncertainty: ((self.uncertainty + rounding) * condition).min(1.0),
            margin: self.margin,
        })
    }

    /// What closing under the bracket would add: the part of all brackets of basis twists outside this
    /// space, decomposed, with its tolerance.
    ///
    /// For unit twists |[A, B]| ≤ √(4/3): with angles α, β of A and B against the pure rotations the square
    /// is at most (cos α cos β)² + sin²(α + β). Basis twists wrong by δ therefore change a bracket by at
    /// most 2·1.155 δ, and projecting on a space wrong by δ leaves 1.155 δ more: 3.47 δ for each bracket.
    pub(super) fn brackets_outside(&self) -> Result<(Decomposition, f64), GroupError> {
        let mut residuals = Vec::new();
        for (i, a) in self.basis.iter().enumerate() {
            for b in &self.basis[i + 1..] {
                let bracket = Twist::from(*a).bracket(&Twist::from(*b));
                residuals.push(self.residual(&bracket.into()));
            }
        }
        let pairs = residuals.len() as f64;
        let tolerance = (3.47 * self.uncertainty + ROUNDING) * pairs.sqrt();
        let squares: f64 = residuals.iter().map(|r| r.norm_squared()).sum();
        let outside = if squares.sqrt() <= NEGLIGIBLE * tolerance {
            Decomposition::bounded_by(squares.sqrt())
        } else {
            Decomposition::of_columns(&residuals)?
        };
        Ok((outside, tolerance))
    }

    /// Whether the bracket of any two twists of this space stays in it, and how clearly.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn is_closed(&self) -> Result<(bool, Margin), GroupError> {
        let (outside, tolerance) = self.brackets_outside()?;
        // One bracket outside is enough: only the largest singular value decides.
        let largest = outside.values.get(..1).unwrap_or(&[]);
        let (rank, decision) = Margin::decide(largest, tolerance);
        Ok((rank == 0, self.margin.and(decision)))
    }

    /// This space extended by the first `count` left singular vectors of bracket residuals.
    pub(super) fn extended(&self, by: &Decomposition, count: usize, tolerance: f64) -> Self {
        let (_, decision) = Margin::decide(&by.values, tolerance);
        let mut larger = self.clone();
        larger.basis.extend((0..count).map(|k| by.left6(k)));
        larger.margin = larger.margin.and(decision);
        if count > 0 {
            let added = perturbed_angle(tolerance, by.values[count - 1]);
            larger.uncertainty = larger.uncertainty.hypot(added).min(1.0);
        }
        larger
    }

    /// Part of a measured vector orthogonal to this space; projected twice, because once leaves rounding
    /// of the size of the vector rather than of the result.
    pub(super) fn residual(&self, vector: &Vector6<f64>) -> Vector6<f64> {
        let mut rest = *vector;
        for _ in 0..2 {
            for b in &self.basis {
                rest -= b * b.dot(&rest);
            }
        }
        rest
    }
}

/// Wedin's bound τ/(σ − τ) on the sine of the angle between singular spaces, at most 1.
fn perturbed_angle(tolerance: f64, smallest_kept: f64) -> f64 {
    (tolerance / (smallest_kept - tolerance)).clamp(0.0, 1.0)
}

fn twist_over(twist: &Twist, divisor: f64) -> Twist {
    // Division, not multiplication by the inverse: 1/divisor overflows for subnormal divisors.
    Twist::new(twist.angular / divisor, twist.linear / divisor)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use proptest::prelude::*;

    fn gauge() -> Gauge {
        Gauge::new(Vector3::new(0.2, 0.1, -0.4), 0.5, 1e-9).unwrap()
    }

    #[test]
    fn the_length_of_a_twist_is_irrelevant() {
        let hinge = Twist::revolute(Vector3::x(), Vector3::new(0.0, 1.0, 0.0));
        let slide = Twist::prismatic(Vector3::y());
        for (a, b) in [(1e-200, 1e200), (1e12, -1e-12), (5e-324, 1.0)] {
            let twists = [hinge * a, slide * b, Twist::zero(), hinge + slide];
            let system = ScrewSystem::span(&twists, &gauge()).unwrap();
            assert_eq!(system.dimension(), 2);
            assert!(system.margin().is_clear());
            assert!(system.contains(&(hinge - slide * 2.0)));
            assert!(system.contains(&Twist::zero()));
            assert!(!system.contains(&Twist::prismatic(Vector3::z())));
        }
    }

    #[test]
    fn infinite_twists_are_refused() {
        let bad = Twist::new(Vector3::x(), Vector3::new(0.0, f64::NAN, 0.0));
        let error = ScrewSystem::span(&[bad], &gauge()).unwrap_err();
        assert!(matches!(error, GroupError::NotFinite(_)));
    }

    #[test]
    fn empty_and_full_spaces_are_neutral() {
        let some = ScrewSystem::span(&[Twist::prismatic(Vector3::z())], &gauge()).unwrap();
        let (none, all) = (ScrewSystem::empty(&gauge()), ScrewSystem::full(&gauge()));
        assert!(some.sum(&none).unwrap().same_as(&some).unwrap());
        assert!(some.intersection(&all).unwrap().same_as(&some).unwrap());
        assert_eq!(some.intersection(&none).unwrap().dimension(), 0);
        assert_eq!(some.sum(&all).unwrap().dimension(), 6);
        assert!(none.is_closed().unwrap().0 && all.is_closed().unwrap().0);
        assert!(none.is_within(&some).unwrap() && !some.is_within(&none).unwrap());
    }

    #[test]
    fn spaces_in_different_gauges_can_be_compared() {
        let other = Gauge::new(Vector3::new(3.0, -2.0, 1.0), 2.0, 1e-9).unwrap();
        let twists = [
            Twist::helical(Vector3::x(), Vector3::z(), 0.4),
            Twist::revolute(Vector3::y(), Vector3::new(1.0, 0.0, 2.0)),
            Twist::prismatic(Vector3::new(1.0, 1.0, 1.0)),
        ];
        let here = ScrewSystem::span(&twists, &gauge()).unwrap();
        let there = ScrewSystem::span(&twists, &other).unwrap();
        assert!(here.same_as(&there).unwrap() && there.same_as(&here).unwrap());
        let common = here
            .intersection(&ScrewSystem::span(&twists[1..2], &other).unwrap())
            .unwrap();
        assert_eq!(common.dimension(), 1);
        assert!(common.contains(&twists[1]));
    }

    #[test]
    fn uncertainty_grows_as_the_twists_become_alike() {
        let pair = |d: f64| {
            let p = Vector3::new(d, 0.0, 0.0);
            let twists = [Vector3::zeros(), p].map(|p| Twist::revolute(Vector3::z(), p));
            ScrewSystem::span(&twists, &gauge()).unwrap()
        };
        let (far, near) = (pair(0.5), pair(5e-4));
        assert!(near.uncertainty() > 500.0 * far.uncertainty());
        assert!(near.margin().kept < far.margin().kept / 500.0);
        assert_eq!(pair(1e-12).dimension(), 1);
    }

    fn twist() -> impl Strategy<Value = Twist> {
        proptest::collection::vec(-1.0..1.0_f64, 6)
            .prop_map(|x| Twist::from(Vector6::from_row_slice(&x)))
    }

    proptest! {
        #[test]
        fn dimension_formula_and_inclusions(
            common in proptest::collection::vec(twist(), 0..3),
            a in proptest::collection::vec(twist(), 0..3),
            b in proptest::collection::vec(twist(), 0..3),
        ) {
            let span = |more: &[Twist]| {
                let all: Vec<_> = common.iter().chain(more).copied().collect();
                ScrewSystem::span(&all, &gauge()).unwrap()
            };
            let (first, second) = (span(&a), span(&b));
            let (meet, sum) = (first.intersection(&second).unwrap(), first.sum(&second).unwrap());
            prop_assume!(meet.margin().and(sum.margin()).is_clear());
            prop_assert_eq!(
                meet.dimension() + sum.dimension(),
                first.dimension() + second.dimension()
            );
            prop_assert!(meet.is_within(&first).unwrap() && meet.is_within(&second).unwrap());
            prop_assert!(first.is_within(&sum).unwrap() && second.is_within(&sum).unwrap());
            for shared in &common {
                prop_assert!(meet.contains(shared));
            }
        }
    }
}
