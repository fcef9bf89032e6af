//! Poses: rigid displacements with their exponential, logarithm and adjoint action.

use std::ops::Mul;

use nalgebra::{Matrix3, Matrix4, Matrix6, Vector3};

use super::twist::{Twist, Wrench};

/// An element of SE(3): x ↦ R x + t.
///
/// A value named `a_from_b` maps coordinates in frame b to coordinates in frame a; products chain as
/// `a_from_c = a_from_b * b_from_c`. The rotation is kept as a 3×3 matrix (orthogonal, determinant 1),
/// the translation in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Rotation part R.
    pub rotation: Matrix3<f64>,
    /// Translation part t (m).
    pub translation: Vector3<f64>,
}

impl Default for Pose {
    fn default() -> Self {
        Self::identity()
    }
}

impl Pose {
    /// A pose from its parts. `rotation` is taken as it is: the caller answers for its orthogonality
    /// (see [`Pose::orthogonality_defect`]).
    pub fn new(rotation: Matrix3<f64>, translation: Vector3<f64>) -> Self {
        Self {
            rotation,
            translation,
        }
    }

    /// The pose that moves nothing.
    pub fn identity() -> Self {
        Self::new(Matrix3::identity(), Vector3::zeros())
    }

    /// Pure translation by `translation` (m).
    pub fn translation(translation: Vector3<f64>) -> Self {
        Self::new(Matrix3::identity(), translation)
    }

    /// Rotation by `angle` (rad) about the line through the origin along `direction`, which need not be
    /// a unit vector. A zero direction gives the identity.
    pub fn rotation_about(direction: Vector3<f64>, angle: f64) -> Self {
        Self::exp(&(Twist::revolute(direction, Vector3::zeros()) * angle))
    }

    /// Rotation by roll, pitch, yaw (rad) about the *fixed* axes x, y, z in this order, as in URDF:
    /// R = R_z(yaw) R_y(pitch) R_x(roll). Translation zero.
    pub fn from_roll_pitch_yaw(roll: f64, pitch: f64, yaw: f64) -> Self {
        let ((sr, cr), (sp, cp), (sy, cy)) = (roll.sin_cos(), pitch.sin_cos(), yaw.sin_cos());
        Self::new(
            Matrix3::new(
                cy * cp,
                cy * sp * sr - sy * cr,
                cy * sp * cr + sy * sr,
                sy * cp,
                sy * sp * sr + cy * cr,
                sy * sp * cr - cy * sr,
                -sp,
                cp * sr,
                cp * cr,
            ),
            Vector3::zeros(),
        )
    }

    /// The inverse displacement. Exact as far as the rotation is orthogonal.
    pub fn inverse(&self) -> Self {
        let transposed = self.rotation.transpose();
        Self::new(transposed, -(transposed * self.translation))
    }

    /// Coordinates of a point (m) in the left-hand frame.
    pub fn transform_point(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * point + self.translation
    }

    /// Coordinates of a free vector in the left-hand frame.
    pub fn transform_direction(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * direction
    }

    /// Adjoint action: the twist with b-coordinates `twist` in a-coordinates, (Rω ; Rv + t × Rω).
    pub fn transform_twist(&self, twist: &Twist) -> Twist {
        let angular = self.rotation * twist.angular;
        Twist::new(
            angular,
            self.rotation * twist.linear + self.translation.cross(&angular),
        )
    }

    /// Coadjoint action on wrenches, (Rf ; Rm + t × Rf); it leaves [`Wrench::power`] unchanged.
    pub fn transform_wrench(&self, wrench: &Wrench) -> Wrench {
        let force = self.rotation * wrench.force;
        Wrench::new(
            force,
            self.rotation * wrench.moment + self.translation.cross(&force),
        )
    }

    /// The 6×6 matrix of [`Pose::transform_twist`] in coordinates (ω; v).
    pub fn adjoint(&self) -> Matrix6<f64> {
        let mut ad = Matrix6::zeros();
        ad.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.rotation);
        ad.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.rotation);
        ad.fixed_view_mut::<3, 3>(3, 0)
            .copy_from(&(self.translation.cross_matrix() * self.rotation));
        ad
    }

    /// Homogeneous 4×4 matrix.
    pub fn to_homogeneous(&self) -> Matrix4<f64> {
        let mut m = Matrix4::identity();
        m.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.rotation);
        m.fixed_view_mut::<3, 1>(0, 3).copy_from(&self.translation);
        m
    }

    /// Frobenius norm of RᵀR − I: how far products of many poses have drifted from a rotation.
    pub fn orthogonality_defect(&self) -> f64 {
        (self.rotation.transpose() * self.rotation - Matrix3::identity()).norm()
    }

    /// The displacement reached by moving with the constant `twist` for one unit of time.
    ///
    /// With W = \[ω\]×, θ = |ω|: R = I + a W + b W², t = (I + b W + c W²) v, where
    /// a = sin θ/θ, b = (1 − cos θ)/θ², c = (θ − sin θ)/θ³ (Murray, Li, Sastry 1994, §2.3.2). The three
    /// quotients are entire functions of θ²; near zero their power series are summed instead, so that
    /// no digit is lost there.
    pub fn exp(twist: &Twist) -> Self {
        let w = twist.angular;
        let theta2 = w.norm_squared();
        let (a, b, c) = exponential_coefficients(theta2);
        let cross = w.cross_matrix();
        let cross2 = cross * cross;
        let rotation = Matrix3::identity() + cross * a + cross2 * b;
        let wxv = w.cross(&twist.linear);
        let translation = twist.linear + wxv * b + w.cross(&wxv) * c;
        Self::new(rotation, translation)
    }

    /// The shortest twist whose [`Pose::exp`] is this displacement; its angle θ = |ω| lies in [0, π].
    ///
    /// The rotation is read off as a unit quaternion from whichever of its four components is largest
    /// (Shepperd 1978), and θ = 2 atan2(|vector|, |scalar|): both are well conditioned for every angle, at
    /// and near π included, where formulas by the trace or by R − Rᵀ break down. The linear part is
    /// V⁻¹ t with V⁻¹ = I − W/2 + d W², d = (1 − (θ/2) cot(θ/2))/θ².
    ///
    /// At θ = π exactly two twists serve (ω and −ω); the one whose first nonzero component is positive is
    /// returned. Next to π the sign follows the rotation, and rounding can decide it. The rotation is
    /// assumed orthogonal to rounding; a defect δ changes the result by about δ.
    pub fn log(&self) -> Twist {
        let (scalar, vector) = quaternion(&self.rotation);
        let sine = vector.norm();
        let theta = 2.0 * sine.atan2(scalar);
        // θ/sin(θ/2) tends to 2 at zero; the quotient is exact to rounding for every sine above the
        // range where its square underflows.
        let angular = if sine > 1e-150 {
            vector * (theta / sine)
        } else {
            vector * 2.0
        };
        let d = inverse_coefficient(theta);
        let t = self.translation;
        let wxt = angular.cross(&t);
        Twist::new(angular, t - wxt * 0.5 + angular.cross(&wxt) * d)
    }
}

impl Mul for Pose {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(
            self.rotation * other.rotation,
            self.rotation * other.translation + self.translation,
        )
    }
}

/// sin θ/θ, (1 − cos θ)/θ², (θ − sin θ)/θ³ as functions of θ².
fn exponential_coefficients(theta2: f64) -> (f64, f64, f64) {
    if theta2 > 1.0 {
        let theta = theta2.sqrt();
        let (sin, half_sin) = (theta.sin(), (0.5 * theta).sin());
        return (
            sin / theta,
            2.0 * half_sin * half_sin / theta2,
            (theta - sin) / (theta2 * theta),
        );
    }
    // Σ (−θ²)ᵏ/(2k+j)! for j = 1, 2, 3. With θ ≤ 1 the tenth term is below 1/21! < 2e-20.
    let mut sums = [0.0; 3];
    for (j, sum) in sums.iter_mut().enumerate() {
        let mut term = 1.0;
        for i in 2..=j + 1 {
            term /= i as f64;
        }
        for k in 0..10 {
            *sum += term;
            let n = (2 * k + j + 1) as f64;
            term *= -theta2 / ((n + 1.0) * (n + 2.0));
        }
    }
    (sums[0], sums[1], sums[2])
}

/// d(θ) = (1 − (θ/2) cot(θ/2))/θ² for θ in [0, π].
fn inverse_coefficient(theta: f64) -> f64 {
    if theta > 1.0 {
        let half = 0.5 * theta;
        return (1.0 - half * half.cos() / half.sin()) / (theta * theta);
    }
    // d = Σ_{k≥1} |B_2k| θ^(2k−2)/(2k)!, with Bernoulli numbers B_2k; the terms shrink by about
    // (θ/2π)² ≤ 1/39 each, so ten of them leave less than 1e-16 of the first.
    const BERNOULLI: [f64; 10] = [
        1.0 / 6.0,
        1.0 / 30.0,
        1.0 / 42.0,
        1.0 / 30.0,
        5.0 / 66.0,
        691.0 / 2730.0,
        7.0 / 6.0,
        3617.0 / 510.0,
        43867.0 / 798.0,
        174611.0 / 330.0,
    ];
    let (mut sum, mut power) = (0.0, 0.5);
    for (k, bernoulli) in BERNOULLI.iter().enumerate() {
        sum += bernoulli * power;
        let n = (2 * k + 2) as f64;
        power *= theta * theta / ((n + 1.0) * (n + 2.0));
    }
    sum
}

/// Unit quaternion (scalar ≥ 0, vector) of a rotation matrix; see [`Pose::log`].
fn quaternion(r: &Matrix3<f64>) -> (f64, Vector3<f64>) {
    let trace = r.trace();
    let candidates = [trace, r[(0, 0)], r[(1, 1)], r[(2, 2)]];
    let mut best = 0;
    for i in 1..4 {
        if candidates[i] > candidates[best] {
            best = i;
        }
    }
    let mut q = if best == 0 {
        [
            1.0 + trace,
            r[(2, 1)] - r[(1, 2)],
            r[(0, 2)] - r[(2, 0)],
            r[(1, 0)] - r[(0, 1)],
        ]
    } else {
        let i = best - 1;
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let mut q = [0.0; 4];
        q[0] = r[(k, j)] - r[(j, k)];
        q[i + 1] = 1.0 + r[(i, i)] - r[(j, j)] - r[(k, k)];
        q[j + 1] = r[(i, j)] + r[(j, i)];
        q[k + 1] = r[(i, k)] + r[(k, i)];
        q
    };
    let first = q.iter().copied().find(|x| *x != 0.0).unwrap_or(1.0);
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    let factor = first.signum() / norm;
    q.iter_mut().for_each(|x| *x *= factor);
    (q[0], Vector3::new(q[1], q[2], q[3]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn distance(a: &Pose, b: &Pose) -> f64 {
        (a.to_homogeneous() - b.to_homogeneous()).norm()
    }

    fn vector(range: f64) -> impl Strategy<Value = Vector3<f64>> {
        [-range..range, -range..range, -range..range].prop_map(Vector3::from)
    }

    fn unit() -> impl Strategy<Value = Vector3<f64>> {
        vector(1.0)
            .prop_filter("long enough", |v| v.norm() > 0.1)
            .prop_map(|v| v.normalize())
    }

    #[test]
    fn roll_pitch_yaw_turns_about_fixed_axes() {
        let (r, p, y) = (0.3, -0.8, 2.1);
        let expected = Pose::rotation_about(Vector3::z(), y)
            * Pose::rotation_about(Vector3::y(), p)
            * Pose::rotation_about(Vector3::x(), r);
        assert!(distance(&Pose::from_roll_pitch_yaw(r, p, y), &expected) < 1e-15);
    }

    #[test]
    fn exp_of_a_screw_turns_and_advances() {
        let screw = Twist::helical(Vector3::z(), Vector3::new(1.0, 0.0, 0.0), 0.5);
        let pose = Pose::exp(&(screw * (PI / 2.0)));
        let moved = pose.transform_point(&Vector3::new(2.0, 0.0, 0.0));
        assert!((moved - Vector3::new(1.0, 1.0, PI / 4.0)).norm() < 1e-15);
    }

    #[test]
    fn coefficients_agree_across_the_switch_to_series() {
        let below = exponential_coefficients(1.0);
        let above = exponential_coefficients(1.0 + f64::EPSILON);
        assert!((below.0 - above.0).abs() < 1e-15);
        assert!((below.1 - above.1).abs() < 1e-15);
        assert!((below.2 - above.2).abs() < 1e-15);
        let d = inverse_coefficient(1.0) - inverse_coefficient(1.0 + f64::EPSILON);
        assert!(d.abs() < 1e-15);
    }

    #[test]
    fn log_at_half_turns_about_every_kind_of_axis() {
        for direction in [
            Vector3::x(),
            Vector3::y(),
            Vector3::z(),
            Vector3::new(1.0, 1.0, 0.0),
            Vector3::new(-1.0, 2.0, 3.0),
            Vector3::new(0.0, 1.0, -1e-9),
        ] {
            let screw = Twist::helical(direction, Vector3::new(0.4, -0.3, 0.9), 0.2) * PI;
            let back = Pose::exp(&screw).log();
            assert!(distance(&Pose::exp(&back), &Pose::exp(&screw)) < 1e-14);
            assert!((back.angular.norm() - PI).abs() < 1e-15);
            let same = (back - screw).to_vector().norm();
            let opposite = (back.angular + screw.angular).norm();
            assert!(same < 1e-13 || opposite < 1e-13);
        }
        // An exact half turn has no rounding to decide the sign: the documented rule does.
        let exact = Pose::new(
            Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, -1.0)),
            Vector3::zeros(),
        );
        assert_eq!(exact.log().angular, Vector3::y() * PI);
    }

    #[test]
    fn log_keeps_all_digits_of_tiny_turns() {
        let tiny = Twist::new(
            Vector3::new(1e-12, -3e-12, 2e-12),
            Vector3::new(1e-12, 5e-13, 0.0),
        );
        let back = Pose::exp(&tiny).log();
        assert!((back - tiny).to_vector().norm() < 1e-26);
        assert_eq!(Pose::identity().log(), Twist::zero());
    }

    #[test]
    fn adjoint_matrix_and_function_agree_and_wrench_power_is_invariant() {
        let pose = Pose::exp(&Twist::new(
            Vector3::new(0.4, 1.3, -0.2),
            Vector3::new(3.0, -1.0, 0.5),
        ));
        let twist = Twist::new(Vector3::new(0.1, 0.7, 0.2), Vector3::new(-0.3, 0.8, 2.0));
        let by_matrix = pose.adjoint() * twist.to_vector();
        let moved = pose.transform_twist(&twist);
        assert!((by_matrix - moved.to_vector()).norm() < 1e-14);
        let wrench = Wrench::new(Vector3::new(1.0, 2.0, -3.0), Vector3::new(0.5, 0.1, 0.7));
        let difference = pose.transform_wrench(&wrench).power(&moved) - wrench.power(&twist);
        assert!(difference.abs() < 1e-13);
    }

    proptest! {
        #[test]
        fn log_inverts_exp(u in unit(), v in vector(5.0), exponent in -12.0..0.0_f64, from_pi: bool) {
            // Angles crowd towards 0 or towards π.
            let small = PI * 10.0_f64.powf(exponent);
            let angle = if from_pi { PI - small } else { small };
            let twist = Twist::new(u * angle, v);
            let pose = Pose::exp(&twist);
            prop_assert!(pose.orthogonality_defect() < 1e-14);
            let back = pose.log();
            prop_assert!(distance(&Pose::exp(&back), &pose) < 1e-13);
            if PI - angle > 1e-9 {
                prop_assert!((back - twist).to_vector().norm() < 1e-13);
            }
        }

        #[test]
        fn adjoint_is_a_homomorphism_and_respects_brackets(
            a in vector(2.0), b in vector(2.0), c in vector(2.0), d in vector(2.0),
        ) {
            let (p, q) = (Pose::exp(&Twist::new(a, b)), Pose::exp(&Twist::new(c, d)));
            let product = (p * q).adjoint();
            prop_assert!((product - p.adjoint() * q.adjoint()).norm() < 1e-12);
            let (s, t) = (Twist::new(a, c), Twist::new(d, b));
            let moved = p.transform_twist(&s).bracket(&p.transform_twist(&t));
            prop_assert!((moved - p.transform_twist(&s.bracket(&t))).to_vector().norm() < 1e-11);
            prop_assert!(distance(&(p * p.inverse()), &Pose::identity()) < 1e-13);
        }
    }
}
