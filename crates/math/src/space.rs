//! Rigid displacements and screws in any arithmetic.
//!
//! [`crate::group`] computes in double precision with nalgebra; here the same few formulas are written over
//! [`Real`], because a doubtful rank is decided from geometry evaluated in many digits.

mod quaternion;

use crate::matrix::Real;

/// Three components.
pub type Vector<R> = [R; 3];

/// The three values of `entry`, written out: `map` on an array is a call that compilers leave standing in inner loops.
#[inline(always)]
pub fn three<T>(entry: impl Fn(usize) -> T) -> [T; 3] {
    [entry(0), entry(1), entry(2)]
}

/// Σ aᵢ bᵢ.
#[inline]
pub fn dot<R: Real>(a: &Vector<R>, b: &Vector<R>) -> R {
    R::dot_of_three(a, b)
}

/// a × b.
#[inline]
pub fn cross<R: Real>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    let part = |i: usize, j: usize| a[i].clone() * b[j].clone() - a[j].clone() * b[i].clone();
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// a + b.
#[inline]
pub fn add<R: Real>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    three(|i| a[i].clone() + b[i].clone())
}

/// a − b.
#[inline]
pub fn subtract<R: Real>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    three(|i| a[i].clone() - b[i].clone())
}

/// s a.
#[inline]
pub fn scale<R: Real>(a: &Vector<R>, s: &R) -> Vector<R> {
    three(|i| a[i].clone() * s.clone())
}

/// Euclidean length, also of vectors whose squares leave the range of doubles.
#[inline]
pub fn length<R: Real>(a: &Vector<R>) -> R {
    a[0].norm(a)
}

/// a / |a|; not finite for the zero vector.
pub fn unit<R: Real>(a: &Vector<R>) -> Vector<R> {
    // Dividing by the largest component first keeps squares of tiny or huge directions in range.
    let largest = a
        .iter()
        .map(Real::abs)
        .fold(a[0].zero_like(), |m, x| if x > m { x } else { m });
    let a = three(|i| a[i].clone() / largest.clone());
    let length = length(&a);
    a.map(|x| x / length.clone())
}

/// Two unit vectors that make a right-handed frame with a unit vector: `(e1, e2)` with `axis × e1 = e2`.
pub fn perpendicular<R: Real>(axis: &Vector<R>) -> (Vector<R>, Vector<R>) {
    let zero = axis[0].zero_like();
    let mut smallest = 0;
    for i in 1..3 {
        if axis[i].abs() < axis[smallest].abs() {
            smallest = i;
        }
    }
    let mut helper = [zero.clone(), zero.clone(), zero];
    helper[smallest] = axis[0].one_like();
    let first = unit(&cross(axis, &helper));
    let second = cross(axis, &first);
    (first, second)
}

/// A rigid displacement, or the pose of frame b in frame a (`a_from_b`): `p_a = rotation p_b + translation`.
#[derive(Clone, Debug)]
pub struct Rigid<R> {
    /// Rotation matrix by rows.
    pub rotation: [[R; 3]; 3],
    /// Metres.
    pub translation: Vector<R>,
}

impl<R: Real> Rigid<R> {
    /// The displacement that moves nothing, in the arithmetic of `like`.
    pub fn identity(like: &R) -> Self {
        let (zero, one) = (like.zero_like(), like.one_like());
        let row = |i: usize| three(|j| if i == j { one.clone() } else { zero.clone() });
        Self {
            rotation: [row(0), row(1), row(2)],
            translation: three(|_| zero.clone()),
        }
    }

    /// A translation.
    pub fn translation(offset: Vector<R>) -> Self {
        let mut displacement = Self::identity(&offset[0]);
        displacement.translation = offset;
        displacement
    }

    /// Rotation by the angle of given cosine and sine about a unit axis through the origin (Rodrigues).
    pub fn rotation(axis: &Vector<R>, cosine: &R, sine: &R) -> Self {
        let one = cosine.one_like();
        let versine = one - cosine.clone();
        let mut displacement = Self::identity(cosine);
        for i in 0..3 {
            for j in 0..3 {
                let mut entry = axis[i].clone() * axis[j].clone() * versine.clone();
                if i == j {
                    entry = entry + cosine.clone();
                }
                displacement.rotation[i][j] = entry;
            }
        }
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            let part = axis[k].clone() * sine.clone();
            displacement.rotation[i][j] = displacement.rotation[i][j].clone() - part.clone();
            displacement.rotation[j][i] = displacement.rotation[j][i].clone() + part;
        }
        displacement
    }

    /// The displacement after a unit of time along a constant twist (angular; linear), by the closed form of the
    /// exponential (Murray, Li & Sastry 1994, section 2.3.3), with 1 − cos θ formed from half the angle, so that no digits
    /// cancel. Up to a rotation of 1e-8 rad the exponential series is summed instead: the closed form divides by the angle,
    /// whose square may be outside the range of numbers.
    pub fn exponential(angular: &Vector<R>, linear: &Vector<R>) -> Self {
        let like = &angular[0];
        let angle = length(angular);
        if !(angle.to_f64() > 1e-8) {
            return Self::exponential_series(angular, linear, angle.to_f64());
        }
        let axis = angular.clone().map(|x| x / angle.clone());
        let (sine, cosine) = angle.sin_cos();
        let mut displacement = Self::rotation(&axis, &cosine, &sine);
        // ∫ R(s) ds applied to `linear`.
        let along = scale(&axis, &dot(&axis, linear));
        let across = subtract(linear, &along);
        let turned = cross(&axis, linear);
        let two = like.constant(2.0);
        let half_sine = (angle.clone() / two.clone()).sin_cos().0;
        let a = sine / angle.clone();
        let b = two * half_sine.clone() * half_sine / angle;
        displacement.translation = add(&along, &add(&scale(&across, &a), &scale(&turned, &b)));
        displacement
    }

    /// exp for rotations up to 1e-8 rad: `R = I + a [w] + b [w]²` and `t = v + b w × v + c w × (w × v)`, with a, b and c the series
    /// of `sin θ/θ`, `(1 − cos θ)/θ²` and `(θ − sin θ)/θ³` in `−θ²`. Every term is at most 1e-16 = 2^-53 of the one before, and as
    /// many bits smaller as the angle has zeros twice, so that a term for each such gain and one more leave less than a rounding.
    fn exponential_series(angular: &Vector<R>, linear: &Vector<R>, angle: f64) -> Self {
        let like = &angular[0];
        // Zero, also where the angle is below the range of doubles, gives as many bits as there may be.
        let gained = ((-2.0 * angle.log2()).min(2000.0) as usize).max(50);
        let terms = 2 + like.bits() as usize / gained;
        let square = -dot(angular, angular);
        let sum = |first: usize| {
            // Horner's scheme for Σ squareᵏ first!/(2k + first)!.
            let mut sum = like.one_like();
            for k in (1..terms).rev() {
                let below = ((2 * k + first) * (2 * k + first - 1)) as f64;
                sum = like.one_like() + square.clone() * sum / like.constant(below);
            }
            sum
        };
        let a = sum(1);
        let b = sum(2) / like.constant(2.0);
        let [x, y, z] = angular.clone();
        let cross_matrix = [
            [like.zero_like(), -z.clone(), y.clone()],
            [z, like.zero_like(), -x.clone()],
            [-y, x, like.zero_like()],
        ];
        // [w]² = w wᵀ − θ² I.
        let rotation = three(|i| {
            three(|j| {
                let mut twice = angular[i].clone() * angular[j].clone();
                if i == j {
                    twice = twice + square.clone();
                }
                let mut entry = a.clone() * cross_matrix[i][j].clone() + b.clone() * twice;
                if i == j {
                    entry = entry + like.one_like();
                }
                entry
            })
        });
        let translation = if linear.iter().all(R::is_zero) {
            linear.clone()
        } else {
            let c = sum(3) / like.constant(6.0);
            let once = cross(angular, linear);
            let twice = cross(angular, &once);
            add(linear, &add(&scale(&once, &b), &scale(&twice, &c)))
        };
        Self {
            rotation,
            translation,
        }
    }

    /// Rotates a free vector.
    #[inline]
    pub fn rotate(&self, v: &Vector<R>) -> Vector<R> {
        three(|i| dot(&self.rotation[i], v))
    }

    /// Rotates a free vector back.
    #[inline]
    pub fn rotate_back(&self, v: &Vector<R>) -> Vector<R> {
        three(|j| {
            (0..3).fold(v[0].zero_like(), |sum, i| {
                sum + self.rotation[i][j].clone() * v[i].clone()
            })
        })
    }

    /// Maps a point.
    #[inline]
    pub fn apply(&self, p: &Vector<R>) -> Vector<R> {
        add(&self.rotate(p), &self.translation)
    }

    /// `self * other`: `a_from_b * b_from_c = a_from_c`.
    #[must_use]
    #[inline]
    pub fn compose(&self, other: &Self) -> Self {
        let columns = three(|j| {
            let column = three(|i| other.rotation[i][j].clone());
            self.rotate(&column)
        });
        Self {
            rotation: three(|i| three(|j| columns[j][i].clone())),
            translation: self.apply(&other.translation),
        }
    }

    /// The vector rotated; a zero vector, as turns and slides have one each, as it is.
    pub fn rotate_unless_zero(&self, v: &Vector<R>) -> Vector<R> {
        if v.iter().all(R::is_zero) {
            v.clone()
        } else {
            self.rotate(v)
        }
    }

    /// The inverse displacement.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let back = self.rotate_back(&self.translation).map(|x| -x);
        Self {
            rotation: three(|i| three(|j| self.rotation[j][i].clone())),
            translation: back,
        }
    }

    /// Rotation vector (axis × angle, angle in [0, π]), accurate near zero.
    ///
    /// At a half turn the sign of the axis is arbitrary and chosen with its largest component positive.
    pub fn rotation_vector(&self) -> Vector<R> {
        let r = &self.rotation;
        let like = &r[0][0];
        let half = like.constant(0.5);
        let sine_axis = [
            (r[2][1].clone() - r[1][2].clone()) * half.clone(),
            (r[0][2].clone() - r[2][0].clone()) * half.clone(),
            (r[1][0].clone() - r[0][1].clone()) * half.clone(),
        ];
        let sine = length(&sine_axis);
        let trace = r[0][0].clone() + r[1][1].clone() + r[2][2].clone();
        let cosine = (trace - like.one_like()) * half.clone();
        let angle = sine.atan2(&cosine);
        if cosine.to_f64() > -0.9 {
            if sine.to_f64() < 1e-150 {
                return sine_axis;
            }
            let factor = angle / sine;
            return scale(&sine_axis, &factor);
        }
        // Near a half turn the antisymmetric part vanishes; the axis is the largest column of R + Rᵀ − 2 cos I.
        let column = |j: usize| {
            three(|i| {
                let mut entry = (r[i][j].clone() + r[j][i].clone()) * half.clone();
                if i == j {
                    entry = entry - cosine.clone();
                }
                entry
            })
        };
        let mut best = 0;
        for j in 1..3 {
            if r[j][j] > r[best][best] {
                best = j;
            }
        }
        let mut axis = unit(&column(best));
        if dot(&axis, &sine_axis) < like.zero_like() {
            axis = axis.map(|x| -x);
        }
        scale(&axis, &angle)
    }
}

/// A screw with its own base point, so that its moment about any centre is formed by one small difference.
#[derive(Clone, Debug)]
pub struct PlacedScrew<R> {
    /// Angular part; a unit vector, or zero for a translation.
    pub angular: Vector<R>,
    /// A point of the axis (any point for a translation).
    pub point: Vector<R>,
    /// Velocity of that point: pitch times angular part, or the direction of a translation.
    pub linear: Vector<R>,
}

impl<R: Real> PlacedScrew<R> {
    /// The twist (angular; linear velocity of the point of the body at `centre`).
    pub fn about(&self, centre: &Vector<R>) -> (Vector<R>, Vector<R>) {
        let arm = subtract(&self.point, centre);
        (
            self.angular.clone(),
            add(&cross(&arm, &self.angular), &self.linear),
        )
    }

    /// The same screw in another frame.
    #[must_use]
    pub fn moved(&self, displacement: &Rigid<R>) -> Self {
        Self {
            angular: displacement.rotate_unless_zero(&self.angular),
            point: displacement.apply(&self.point),
            linear: displacement.rotate_unless_zero(&self.linear),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::matrix::Big;
    use proptest::prelude::*;

    fn close(a: &Rigid<f64>, b: &Rigid<f64>, bound: f64) -> bool {
        let rows = a.rotation.iter().flatten().zip(b.rotation.iter().flatten());
        let places = a.translation.iter().zip(&b.translation);
        rows.chain(places).all(|(x, y)| (x - y).abs() <= bound)
    }

    fn big(v: Vector<f64>, bits: u32) -> Vector<Big> {
        v.map(|x| Big::new(x, bits))
    }

    /// exp by its power series, in many digits; good for small twists.
    fn by_series(angular: Vector<f64>, linear: Vector<f64>) -> Rigid<Big> {
        Rigid::exponential_series(&big(angular, 600), &big(linear, 600), 1e-8)
    }

    #[test]
    fn a_quarter_turn_of_a_screw_is_known() {
        // About z with a pitch of 1/π m/rad: a quarter turn climbs half a metre.
        let angle = std::f64::consts::FRAC_PI_2;
        let moved = Rigid::exponential(&[0.0, 0.0, angle], &[0.0, 0.0, 0.5]);
        let p = moved.apply(&[1.0, 0.0, 0.0]);
        for (x, y) in p.iter().zip([0.0, 1.0, 0.5]) {
            assert!((x - y).abs() < 1e-15);
        }
        // Turning while pushed along x: the end point of a quarter of a circle of radius 1.
        let moved = Rigid::exponential(&[0.0, 0.0, angle], &[angle, 0.0, 0.0]);
        for (x, y) in moved.translation.iter().zip([1.0, 1.0, 0.0]) {
            assert!((x - y).abs() < 1e-15);
        }
    }

    #[test]
    fn small_twists_agree_with_the_series_to_the_last_digits() {
        // On both sides of where the closed form takes over from the series.
        for size in [1e-200, 1e-12, 0.99e-8, 1.01e-8, 3e-8, 1e-6, 1e-4] {
            let angular = [0.3 * size, -0.5 * size, 0.81 * size];
            let linear = [0.7, 0.2, -0.4];
            let exact = by_series(angular, linear);
            let found = Rigid::exponential(&angular, &linear);
            for (x, y) in found.translation.iter().zip(&exact.translation) {
                assert!((x - y.to_f64()).abs() < 4e-16, "{size:e}: {x} {y:?}");
            }
            for i in 0..3 {
                for j in 0..3 {
                    let off = found.rotation[i][j] - exact.rotation[i][j].to_f64();
                    assert!(off.abs() < 4e-16, "{size:e}");
                }
            }
            // The turn itself keeps its relative accuracy.
            let turn = found.rotation_vector();
            assert!((length(&turn) / length(&angular) - 1.0).abs() < 1e-7 + 1e-16 / size.max(1e-9));
        }
    }

    #[test]
    fn rotation_vectors_near_zero_and_near_a_half_turn() {
        let axis = unit(&[1.0, -2.0, 0.5]);
        for angle in [
            0.0,
            1e-300,
            1e-160,
            1e-9,
            0.1,
            2.6,
            2.7,
            3.1,
            std::f64::consts::PI - 1e-6,
            std::f64::consts::PI - 1e-9,
        ] {
            let wanted = scale(&axis, &angle);
            let found = Rigid::exponential(&wanted, &[0.0; 3]).rotation_vector();
            let off = length(&subtract(&found, &wanted));
            assert!(off <= 4e-15 * angle.max(1e-300), "{angle}: {off:e}");
        }
        // Exactly at a half turn the axis has two signs; its largest component is positive.
        for axis in [[0.0, -1.0, 0.0], [0.6, 0.0, -0.8], [-0.6, 0.64, 0.48]] {
            let half = Rigid::rotation(&axis, &-1.0, &0.0).rotation_vector();
            let largest = half
                .iter()
                .copied()
                .fold(0.0f64, |m, x| if x.abs() > m.abs() { x } else { m });
            assert!(largest > 0.0);
            assert!((length(&half) - std::f64::consts::PI).abs() < 1e-15);
            assert!(length(&cross(&half, &axis)) < 1e-15);
        }
    }

    #[test]
    fn many_digits_are_kept() {
        let bits = 212;
        let angular = big([0.7, -1.1, 2.2], bits);
        let linear = big([3.0, 0.5, -0.25], bits);
        let forth = Rigid::exponential(&angular, &linear);
        let back = Rigid::exponential(&angular.clone().map(|x| -x), &linear.map(|x| -x));
        let off = forth.compose(&back);
        // exp(ξ) exp(−ξ) = 1: both the turn and the way keep 200 bits.
        assert!(length(&off.translation).to_f64() < 2f64.powi(-200));
        assert!(length(&off.rotation_vector()).to_f64() < 2f64.powi(-200));
        let found = forth.rotation_vector();
        assert!(length(&subtract(&found, &angular)).to_f64() < 2f64.powi(-200));
        let double = Rigid::exponential(&[0.7, -1.1, 2.2], &[3.0, 0.5, -0.25]);
        for (x, y) in double.translation.iter().zip(&forth.translation) {
            assert!((x - y.to_f64()).abs() < 1e-14);
        }
    }

    #[test]
    fn directions_and_lengths_of_any_size() {
        for size in [1e-310, 1e-200, 1.0, 1e200] {
            let v = [3.0 * size, 0.0, -4.0 * size];
            assert!((length(&v) / size - 5.0).abs() < 1e-12);
            assert!(length(&subtract(&unit(&v), &[0.6, 0.0, -0.8])) < 1e-12);
        }
        assert!(unit(&[0.0; 3]).iter().all(|x: &f64| x.is_nan()));
    }

    #[test]
    fn a_screw_moves_with_its_frame() {
        let screw = PlacedScrew {
            angular: [0.0, 0.0, 1.0],
            point: [1.0, 0.0, 0.0],
            linear: [0.0, 0.0, 0.5],
        };
        // The body's point at the origin moves by ω × (0 − p) + h ω.
        assert_eq!(screw.about(&[0.0; 3]).1, [0.0, -1.0, 0.5]);
        let moved = screw.moved(&Rigid::translation([0.0, 2.0, 0.0]));
        assert_eq!(moved.point, [1.0, 2.0, 0.0]);
        assert_eq!(moved.about(&[1.0, 2.0, 0.0]).1, [0.0, 0.0, 0.5]);
    }

    proptest! {
        #[test]
        fn frames_across_an_axis_are_right_handed(v in prop::array::uniform3(-1.0..1.0f64)) {
            prop_assume!(length(&v) > 1e-3);
            let axis = unit(&v);
            let (e1, e2) = perpendicular(&axis);
            prop_assert!(dot(&e1, &axis).abs() < 1e-15 && dot(&e2, &axis).abs() < 1e-15);
            prop_assert!((length(&e1) - 1.0).abs() < 1e-15);
            prop_assert!(length(&subtract(&cross(&axis, &e1), &e2)) < 1e-15);
        }

        #[test]
        fn inverse_undoes(
            angular in prop::array::uniform3(-3.0..3.0f64),
            linear in prop::array::uniform3(-3.0..3.0f64),
            point in prop::array::uniform3(-3.0..3.0f64),
        ) {
            let moved = Rigid::exponential(&angular, &linear);
            let identity = Rigid::identity(&0.0);
            prop_assert!(close(&moved.compose(&moved.inverse()), &identity, 1e-13));
            let there_and_back = moved.inverse().apply(&moved.apply(&point));
            prop_assert!(length(&subtract(&there_and_back, &point)) < 1e-13);
            prop_assert!(length(&subtract(&moved.rotate_back(&moved.rotate(&point)), &point)) < 1e-14);
        }

        #[test]
        fn steps_along_one_screw_add_up(
            angular in prop::array::uniform3(-1.0..1.0f64),
            linear in prop::array::uniform3(-1.0..1.0f64),
            s in -1.0..1.0f64,
            t in -1.0..1.0f64,
        ) {
            let go = |x: f64| Rigid::exponential(&scale(&angular, &x), &scale(&linear, &x));
            prop_assert!(close(&go(s).compose(&go(t)), &go(s + t), 1e-14));
        }
    }
}
