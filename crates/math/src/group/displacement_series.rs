//! Power series of displacements: the position of a link as a function of the joint variables.

use std::ops::Mul;
use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};

use super::monomials::Monomials;
use super::pose::Pose;
use super::series::{Series, assert_alike, values_of_monomials};
use super::twist::Twist;

/// A truncated power series with values in SE(3): (Σ R_α y^α, Σ t_α y^α).
///
/// It satisfies R Rᵀ = I up to the truncation degree K, not beyond. Products cost at most
/// C(2m+K, K) products of displacements. Combining series of different shapes panics, as for [`Series`].
#[derive(Clone, Debug, PartialEq)]
pub struct DisplacementSeries {
    monomials: Arc<Monomials>,
    rotation: Vec<Matrix3<f64>>,
    translation: Vec<Vector3<f64>>,
}

impl DisplacementSeries {
    /// The same displacement everywhere.
    pub fn constant(monomials: &Arc<Monomials>, pose: &Pose) -> Self {
        let mut rotation = vec![Matrix3::zeros(); monomials.count()];
        let mut translation = vec![Vector3::zeros(); monomials.count()];
        rotation[0] = pose.rotation;
        translation[0] = pose.translation;
        Self {
            monomials: Arc::clone(monomials),
            rotation,
            translation,
        }
    }

    /// No displacement anywhere.
    pub fn identity(monomials: &Arc<Monomials>) -> Self {
        Self::constant(monomials, &Pose::identity())
    }

    /// E(y) = exp(ξ q(y)) for a screw ξ fixed in the world and a joint variable q(y).
    ///
    /// Applying the Euler operator Σ yᵢ∂ᵢ to E gives (Σ yᵢ∂ᵢ q) ξ E, and on a homogeneous part of degree k
    /// that operator is multiplication by k; hence k E_k = Σ_{j=1..k} j q_j ξ E_{k−j}, starting from
    /// E_0 = exp(ξ q_0). In one variable this is the recurrence for a motion along a curve.
    pub fn exp(screw: &Twist, variable: &Series) -> Self {
        let monomials = variable.monomials();
        let q = variable.coefficients();
        let mut e = Self::constant(monomials, &Pose::exp(&(*screw * q[0])));
        let cross = screw.angular.cross_matrix();
        for degree in 0..=monomials.degree() {
            for a in monomials.of_degree(degree) {
                if degree > 0 {
                    e.rotation[a] /= degree as f64;
                    e.translation[a] /= degree as f64;
                }
                // ξ E_a: the last row of a homogeneous matrix is constant, so v enters once only.
                let rotated = cross * e.rotation[a];
                let mut moved = screw.angular.cross(&e.translation[a]);
                if a == 0 {
                    moved += screw.linear;
                }
                for (b, &slot) in monomials.products_with(a).iter().enumerate().skip(1) {
                    if q[b] != 0.0 {
                        let weight = monomials.degree_of(b) as f64 * q[b];
                        e.rotation[slot as usize] += rotated * weight;
                        e.translation[slot as usize] += moved * weight;
                    }
                }
            }
        }
        e
    }

    /// E(y) = exp(X(y)) for a twist X = (ω(y); v(y)) whose coordinates are power series that vanish at y = 0, as where
    /// several variables of one joint share an exponential.
    ///
    /// With s = ω·ω: R = I + f \[ω\]× + g \[ω\]×², t = (I + g \[ω\]× + h \[ω\]×²) v, where f, g, h = Σ (−s)ⁿ/(2n+1)!,
    /// …/(2n+2)!, …/(2n+3)! (Rodrigues); all products are of scalar series. Panics if a coordinate has a constant
    /// term or another shape.
    pub fn exp_twist(angular: &[Series; 3], linear: &[Series; 3]) -> Self {
        let monomials = angular[0].monomials();
        let constants = angular.iter().chain(linear).map(|x| x.coefficients()[0]);
        assert!(
            constants.into_iter().all(|c| c == 0.0),
            "the exponent must vanish at the origin"
        );
        let dot = |a: &[Series; 3], b: &[Series; 3]| {
            let [x, y, z] = [0, 1, 2].map(|i| &a[i] * &b[i]);
            &(&x + &y) + &z
        };
        let cross = |a: &[Series; 3], b: &[Series; 3]| {
            [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &(&a[i] * &b[j]) - &(&a[j] * &b[i]))
        };
        let negative_square = -&dot(angular, angular);
        // Horner's rule; s starts at degree two.
        let series_from = |first: usize| {
            let mut factorial: f64 = (2..=first).map(|i| i as f64).product();
            let mut coefficients = vec![1.0 / factorial];
            for n in 1..=monomials.degree() / 2 {
                factorial *= ((first + 2 * n) * (first + 2 * n - 1)) as f64;
                coefficients.push(1.0 / factorial);
            }
            let mut sum = Series::zero(monomials);
            for c in coefficients.into_iter().rev() {
                sum = &sum * &negative_square;
                sum.coefficients_mut()[0] += c;
            }
            sum
        };
        let (f, g, h) = (series_from(1), series_from(2), series_from(3));
        let turn: [Series; 3] = [0, 1, 2].map(|i| &f * &angular[i]);
        let bent: [Series; 3] = [0, 1, 2].map(|i| &g * &angular[i]);
        let along = dot(angular, linear);
        let across = cross(angular, linear);
        let moved: [Series; 3] = [0, 1, 2].map(|i| {
            // [ω]×² v = ω (ω·v) − s v.
            let twice = &(&angular[i] * &along) + &(&negative_square * &linear[i]);
            &(&linear[i] + &(&g * &across[i])) + &(&h * &twice)
        });
        let squares = [0, 1, 2].map(|i| [0, 1, 2].map(|j| &bent[i] * &angular[j]));
        let sink = &g * &negative_square;
        let mut e = Self::identity(monomials);
        for index in 0..monomials.count() {
            let c = |series: &Series| series.coefficients()[index];
            let mut r = Matrix3::from_fn(|i, j| c(&squares[i][j]));
            for i in 0..3 {
                r[(i, i)] += c(&sink);
            }
            e.rotation[index] += r + Vector3::from_fn(|i, _| c(&turn[i])).cross_matrix();
            e.translation[index] = Vector3::from_fn(|i, _| c(&moved[i]));
        }
        e
    }

    /// The product exp(ξ₁ q₁(y)) exp(ξ₂ q₂(y)) … along a chain or loop, in the order given.
    ///
    /// A loop that is closed at y = 0, written with the screws of that pose, gives the closure map: it is
    /// the identity at y = 0, and its derivatives are brackets of the screws.
    pub fn along_chain<'a>(
        monomials: &Arc<Monomials>,
        joints: impl IntoIterator<Item = (&'a Twist, &'a Series)>,
    ) -> Self {
        joints
            .into_iter()
            .fold(Self::identity(monomials), |chain, (screw, variable)| {
                &chain * &Self::exp(screw, variable)
            })
    }

    /// The numbering of the coefficients.
    pub fn monomials(&self) -> &Arc<Monomials> {
        &self.monomials
    }

    /// Coefficient (R_α, t_α) of monomial `index`; only the one of the constant is a displacement.
    pub fn coefficient(&self, index: usize) -> (&Matrix3<f64>, &Vector3<f64>) {
        (&self.rotation[index], &self.translation[index])
    }

    /// Value at a point; a displacement up to terms of degree K + 1.
    pub fn evaluate(&self, point: &[f64]) -> Pose {
        let mut pose = Pose::new(Matrix3::zeros(), Vector3::zeros());
        let values = values_of_monomials(&self.monomials, point);
        for (index, y) in values.into_iter().enumerate() {
            pose.rotation += self.rotation[index] * y;
            pose.translation += self.translation[index] * y;
        }
        pose
    }

    /// The inverse displacement, (Rᵀ, −Rᵀ t).
    pub fn inverse(&self) -> Self {
        let mut inverse = self.clone();
        inverse.rotation.iter_mut().for_each(|r| r.transpose_mut());
        inverse
            .translation
            .iter_mut()
            .for_each(|t| *t = Vector3::zeros());
        for a in 0..self.monomials.count() {
            let slots = self.monomials.products_with(a);
            for (&slot, t) in slots.iter().zip(&self.translation) {
                inverse.translation[slot as usize] -= inverse.rotation[a] * t;
            }
        }
        inverse
    }

    /// Six scalar series in the order (ω; v) that vanish exactly where a displacement near the identity
    /// is the identity: the axial vector of (R − Rᵀ)/2 and the translation.
    ///
    /// The axial vector is sin θ times the axis; for angles below π it vanishes only with the
    /// rotation, so nothing of the local ideal of the closure equations is lost.
    pub fn closure_residual(&self) -> [Series; 6] {
        let entry = |row: usize, column: usize| {
            let half = |r: &Matrix3<f64>| 0.5 * (r[(row, column)] - r[(column, row)]);
            self.scalar(self.rotation.iter().map(half))
        };
        let shift = |row: usize| self.scalar(self.translation.iter().map(|t| t[row]));
        [
            entry(2, 1),
            entry(0, 2),
            entry(1, 0),
            shift(0),
            shift(1),
            shift(2),
        ]
    }

    fn scalar(&self, coefficients: impl Iterator<Item = f64>) -> Series {
        Series::from_coefficients(&self.monomials, coefficients.collect())
    }
}

impl Mul for &DisplacementSeries {
    type Output = DisplacementSeries;
    fn mul(self, other: Self) -> DisplacementSeries {
        assert_alike(&self.monomials, &other.monomials);
        let count = self.monomials.count();
        let mut product = DisplacementSeries {
            monomials: Arc::clone(&self.monomials),
            rotation: vec![Matrix3::zeros(); count],
            translation: self.translation.clone(),
        };
        let zero = Matrix3::zeros();
        // A joint that stands still, or moves with few of the variables, leaves most coefficients zero.
        let moving: Vec<bool> = (0..count)
            .map(|b| other.rotation[b] != zero || other.translation[b] != Vector3::zeros())
            .collect();
        for a in 0..count {
            let left = &self.rotation[a];
            if *left == zero {
                continue;
            }
            for (b, &slot) in self.monomials.products_with(a).iter().enumerate() {
                if moving[b] {
                    product.rotation[slot as usize] += left * other.rotation[b];
                    product.translation[slot as usize] += left * other.translation[b];
                }
            }
        }
        product
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn screws() -> Vec<Twist> {
        vec![
            Twist::revolute(Vector3::new(0.2, 1.0, -0.4), Vector3::new(1.0, 0.0, 0.3)),
            Twist::prismatic(Vector3::new(1.0, 1.0, 0.5)),
            Twist::helical(Vector3::z(), Vector3::new(0.0, -0.6, 2.0), 0.3),
            Twist::revolute(Vector3::new(-1.0, 0.1, 0.7), Vector3::new(0.5, 0.5, 0.5)),
        ]
    }

    fn exact(screws: &[Twist], q: &[f64]) -> Pose {
        let each = screws.iter().zip(q);
        each.fold(Pose::identity(), |p, (s, q)| p * Pose::exp(&(*s * *q)))
    }

    fn distance(a: &Pose, b: &Pose) -> f64 {
        (a.to_homogeneous() - b.to_homogeneous()).norm()
    }

    #[test]
    fn truncation_error_has_the_right_order() {
        // Halving the step divides the error of a series of degree K by 2^(K+1).
        for (degree, step) in [(2, 1e-2), (4, 0.1), (8, 0.3)] {
            let m = Monomials::new(2, degree).unwrap();
            let s = screws();
            let directions = [[1.0, 0.2], [-0.4, 0.7], [0.3, 0.3], [0.9, -0.8]];
            let q: Vec<_> = directions.iter().map(|d| Series::linear(&m, d)).collect();
            let chain = DisplacementSeries::along_chain(&m, s.iter().zip(&q));
            let error = |h: f64| {
                let y = [h, -0.7 * h];
                let joints: Vec<_> = q.iter().map(|q| q.evaluate(&y)).collect();
                distance(&chain.evaluate(&y), &exact(&s, &joints))
            };
            let ratio = (error(step) / error(step / 2.0)).log2();
            assert!(
                (ratio - (degree as f64 + 1.0)).abs() < 0.3,
                "degree {degree}: observed order {ratio}"
            );
        }
    }

    #[test]
    fn exponential_of_a_nonlinear_variable_with_a_constant() {
        let m = Monomials::new(2, 7).unwrap();
        let y = Series::linear(&m, &[1.0, -0.5]);
        let q = &(&Series::constant(&m, 0.8) + &y) + &(&y * &y).scaled(0.7);
        for screw in screws() {
            let e = DisplacementSeries::exp(&screw, &q);
            let at = [0.02, -0.03];
            let expected = Pose::exp(&(screw * q.evaluate(&at)));
            assert!(distance(&e.evaluate(&at), &expected) < 1e-10);
        }
    }

    #[test]
    fn one_variable_agrees_with_the_taylor_series_of_the_exponential() {
        // exp(ξ t) = Σ ξᵏ tᵏ/k! with 4×4 matrices.
        let m = Monomials::new(1, 8).unwrap();
        let t = Series::linear(&m, &[1.0]);
        for screw in screws() {
            let e = DisplacementSeries::exp(&screw, &t);
            let mut generator = nalgebra::Matrix4::zeros();
            generator
                .fixed_view_mut::<3, 3>(0, 0)
                .copy_from(&screw.angular.cross_matrix());
            generator
                .fixed_view_mut::<3, 1>(0, 3)
                .copy_from(&screw.linear);
            let mut power = nalgebra::Matrix4::identity();
            for k in 0..=8 {
                let (r, t) = e.coefficient(k);
                assert!((power.fixed_view::<3, 3>(0, 0) - r).norm() < 1e-15);
                assert!((power.fixed_view::<3, 1>(0, 3) - t).norm() < 1e-15);
                power = power * generator / (k as f64 + 1.0);
            }
        }
    }

    #[test]
    fn first_derivatives_of_screws_are_brackets() {
        // Carrying S_j by exp(S_i q_i): the derivative at zero is [S_i, S_j]; twice, [S_i, [S_i, S_j]].
        let m = Monomials::new(1, 3).unwrap();
        let q = Series::linear(&m, &[1.0]);
        let s = screws();
        for i in &s {
            for j in &s {
                let e = DisplacementSeries::exp(i, &q);
                // E ξ_j E⁻¹ read off from the derivative of E exp(ξ_j p) E⁻¹ by p, to first order in p:
                let p = 1e-6;
                let mid = DisplacementSeries::constant(&m, &Pose::exp(&(*j * p)));
                let conjugate = &(&e * &mid) * &e.inverse();
                let residual = conjugate.closure_residual();
                let once = i.bracket(j);
                for (degree, expected) in [(0, *j), (1, once), (2, i.bracket(&once) * 0.5)] {
                    for (row, value) in expected.to_vector().iter().enumerate() {
                        let c = residual[row].coefficients()[degree] / p;
                        assert!((c - value).abs() < 1e-5, "degree {degree}, row {row}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_shared_exponential_is_not_a_product() {
        let m = Monomials::new(2, 6).unwrap();
        let forms: [[f64; 2]; 6] = [
            [0.3, -0.2],
            [0.1, 0.4],
            [-0.5, 0.2],
            [0.7, 0.1],
            [-0.1, 0.6],
            [0.2, -0.3],
        ];
        let q = forms.map(|f| Series::linear(&m, &f));
        let [a, b, c, x, y, z] = q.clone();
        let e = DisplacementSeries::exp_twist(&[a, b, c], &[x, y, z]);
        let error = |size: f64| {
            let point = [size, -0.7 * size];
            let value = q.each_ref().map(|q| q.evaluate(&point));
            distance(
                &e.evaluate(&point),
                &Pose::exp(&Twist::from(nalgebra::Vector6::from(value))),
            )
        };
        assert!(error(0.5) < 1e-6);
        let order = (error(1.0) / error(0.5)).log2();
        assert!((order - 7.0).abs() < 0.5, "{order}");
        // With one variable it is the exponential of a screw.
        let screw = screws()[2];
        let q = Series::linear(&m, &[0.8, 0.3]);
        let v = screw.to_vector();
        let e = DisplacementSeries::exp_twist(
            &[0, 1, 2].map(|i| q.scaled(v[i])),
            &[3, 4, 5].map(|i| q.scaled(v[i])),
        );
        let expected = DisplacementSeries::exp(&screw, &q);
        for index in 0..m.count() {
            let ((r, t), (r1, t1)) = (e.coefficient(index), expected.coefficient(index));
            assert!((r - r1).norm() + (t - t1).norm() < 1e-14);
        }
    }

    #[test]
    fn second_order_closure_is_the_sum_of_brackets() {
        // In f = Π exp(S_j y_j): the coefficient of y_i y_j (i < j) of the translation part is that of
        // S_i S_j; antisymmetrised against the swapped order it is [S_i, S_j].
        let m = Monomials::new(2, 2).unwrap();
        let (a, b) = (screws()[0], screws()[3]);
        let (x, y) = (
            Series::linear(&m, &[1.0, 0.0]),
            Series::linear(&m, &[0.0, 1.0]),
        );
        let forth = DisplacementSeries::along_chain(&m, [(&a, &x), (&b, &y)]).closure_residual();
        let back = DisplacementSeries::along_chain(&m, [(&b, &y), (&a, &x)]).closure_residual();
        let slot = m.index_of(&[1, 1]).unwrap();
        let bracket = a.bracket(&b).to_vector();
        for row in 0..6 {
            let difference = forth[row].coefficients()[slot] - back[row].coefficients()[slot];
            assert!((difference - bracket[row]).abs() < 1e-15);
        }
    }

    #[test]
    fn finite_differences_agree_to_third_order() {
        let m = Monomials::new(2, 3).unwrap();
        let s = screws();
        let forms = [[1.0, 0.0], [0.3, 0.5], [0.0, 1.0], [-0.2, 0.8]];
        let q: Vec<_> = forms.iter().map(|f| Series::linear(&m, f)).collect();
        let series = DisplacementSeries::along_chain(&m, s.iter().zip(&q));
        let f = |x: f64, y: f64| {
            let joints: Vec<_> = q.iter().map(|q| q.evaluate(&[x, y])).collect();
            exact(&s, &joints).to_homogeneous()
        };
        let h = 1e-3;
        // ∂³/∂x²∂y by central differences; the coefficient of x²y is half of it. Error h² ~ 1e-6 and
        // rounding 1e-16/h³ ~ 1e-7.
        let second_in_x = |y: f64| f(h, y) - f(0.0, y) * 2.0 + f(-h, y);
        let third = (second_in_x(h) - second_in_x(-h)) / (2.0 * h * h * h);
        let (r, t) = series.coefficient(m.index_of(&[2, 1]).unwrap());
        assert!((third.fixed_view::<3, 3>(0, 0) * 0.5 - r).norm() < 1e-5);
        assert!((third.fixed_view::<3, 1>(0, 3) * 0.5 - t).norm() < 1e-5);
    }

    #[test]
    fn planar_four_bar_stays_in_its_plane_to_every_order() {
        let m = Monomials::new(4, 4).unwrap();
        let pins = [[0.0, 0.0], [1.0, 2.0], [4.0, 1.5], [3.0, 0.0]];
        let s: Vec<_> = pins
            .iter()
            .map(|p| Twist::revolute(Vector3::z(), Vector3::new(p[0], p[1], 0.0)))
            .collect();
        let mut forms = [[0.0; 4]; 4];
        (0..4).for_each(|i| forms[i][i] = 1.0);
        let q: Vec<_> = forms.iter().map(|f| Series::linear(&m, f)).collect();
        let residual = DisplacementSeries::along_chain(&m, s.iter().zip(&q)).closure_residual();
        for row in [0, 1, 5] {
            assert!(residual[row].coefficients().iter().all(|c| c.abs() < 1e-14));
        }
        assert!(residual[3].size_of_degree(2) > 0.1);
    }

    proptest! {
        #[test]
        fn inverse_and_orthogonality_hold_in_every_kept_coefficient(
            values in proptest::collection::vec(-1.0..1.0_f64, 8),
        ) {
            let m = Monomials::new(2, 5).unwrap();
            let s = screws();
            let q: Vec<_> = values.chunks(2).map(|c| Series::linear(&m, c)).collect();
            let e = DisplacementSeries::along_chain(&m, s.iter().zip(&q));
            let unity = &e * &e.inverse();
            let one = DisplacementSeries::identity(&m);
            for index in 0..m.count() {
                let ((r, t), (r1, t1)) = (unity.coefficient(index), one.coefficient(index));
                prop_assert!((r - r1).norm() < 1e-11 && (t - t1).norm() < 1e-11);
            }
        }
    }
}
