//! Twists (instantaneous screws) and wrenches in world coordinates.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use nalgebra::{Vector3, Vector6};

/// An element of se(3): the velocity state of a rigid body.
///
/// Six coordinates in the order (ω; v). `angular` is the angular velocity (1/s, or 1 where the twist is a
/// joint screw per radian); `linear` is the velocity of the body point that passes through the origin of
/// the frame (m/s, or m per radian; for a prismatic joint per metre, so 1). Ball (1900), Hunt (1978).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Angular part ω.
    pub angular: Vector3<f64>,
    /// Linear part v: the velocity at the origin of the frame.
    pub linear: Vector3<f64>,
}

impl Twist {
    /// A twist from its two parts.
    pub fn new(angular: Vector3<f64>, linear: Vector3<f64>) -> Self {
        Self { angular, linear }
    }

    /// The twist of a body at rest.
    pub fn zero() -> Self {
        Self::new(Vector3::zeros(), Vector3::zeros())
    }

    /// Unit rotation about the line through `point` (m) along `direction`: (u; p × u).
    ///
    /// `direction` is normalised; a zero direction gives the zero twist.
    pub fn revolute(direction: Vector3<f64>, point: Vector3<f64>) -> Self {
        Self::helical(direction, point, 0.0)
    }

    /// Unit translation along `direction`: (0; u). A zero direction gives the zero twist.
    pub fn prismatic(direction: Vector3<f64>) -> Self {
        Self::new(Vector3::zeros(), unit_or_zero(direction))
    }

    /// Unit screw about the line through `point` (m) along `direction`, advancing `pitch` metres per
    /// radian, right-handed positive: (u; p × u + h u). A zero direction gives the zero twist.
    pub fn helical(direction: Vector3<f64>, point: Vector3<f64>, pitch: f64) -> Self {
        let u = unit_or_zero(direction);
        Self::new(u, point.cross(&u) + u * pitch)
    }

    /// The Lie bracket [self, other] = (ω₁ × ω₂ ; ω₁ × v₂ + v₁ × ω₂).
    ///
    /// It is the rate at which `other` changes when it is carried along by `self`.
    pub fn bracket(&self, other: &Self) -> Self {
        Self::new(
            self.angular.cross(&other.angular),
            self.angular.cross(&other.linear) + self.linear.cross(&other.angular),
        )
    }

    /// Velocity of the body point now at `point` (m): v + ω × p.
    pub fn velocity_at(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.linear + self.angular.cross(point)
    }

    /// Pitch (m per radian) ω·v / ω·ω; `None` where ω is zero (a pure translation has infinite pitch).
    pub fn pitch(&self) -> Option<f64> {
        let w2 = self.angular.norm_squared();
        (w2 > 0.0).then(|| self.angular.dot(&self.linear) / w2)
    }

    /// The point (m) of the screw axis nearest the origin, ω × v / ω·ω; `None` where ω is zero.
    pub fn axis_point(&self) -> Option<Vector3<f64>> {
        let w2 = self.angular.norm_squared();
        (w2 > 0.0).then(|| self.angular.cross(&self.linear) / w2)
    }

    /// True where all six coordinates are finite numbers.
    pub fn is_finite(&self) -> bool {
        self.angular
            .iter()
            .chain(self.linear.iter())
            .all(|x| x.is_finite())
    }

    /// Coordinates (ω; v).
    pub fn to_vector(self) -> Vector6<f64> {
        self.into()
    }
}

fn unit_or_zero(direction: Vector3<f64>) -> Vector3<f64> {
    // Dividing by the largest entry first keeps the square root away from overflow and underflow.
    let largest = direction.amax();
    if largest > 0.0 {
        (direction / largest).normalize()
    } else {
        Vector3::zeros()
    }
}

impl From<Vector6<f64>> for Twist {
    fn from(x: Vector6<f64>) -> Self {
        Self::new(
            Vector3::new(x[0], x[1], x[2]),
            Vector3::new(x[3], x[4], x[5]),
        )
    }
}

impl From<Twist> for Vector6<f64> {
    fn from(t: Twist) -> Self {
        let (w, v) = (t.angular, t.linear);
        Vector6::new(w.x, w.y, w.z, v.x, v.y, v.z)
    }
}

impl Add for Twist {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.angular + other.angular, self.linear + other.linear)
    }
}

impl AddAssign for Twist {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Twist {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.angular - other.angular, self.linear - other.linear)
    }
}

impl Neg for Twist {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.angular, -self.linear)
    }
}

impl Mul<f64> for Twist {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.angular * factor, self.linear * factor)
    }
}

impl Mul<Twist> for f64 {
    type Output = Twist;
    fn mul(self, twist: Twist) -> Twist {
        twist * self
    }
}

/// An element of the dual of se(3): a force system reduced to the origin.
///
/// Six coordinates in the order (f; m): `force` in N, `moment` about the frame's origin in N·m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Resultant force f.
    pub force: Vector3<f64>,
    /// Moment m about the origin of the frame.
    pub moment: Vector3<f64>,
}

impl Wrench {
    /// A wrench from its two parts.
    pub fn new(force: Vector3<f64>, moment: Vector3<f64>) -> Self {
        Self { force, moment }
    }

    /// A force `force` acting along a line through `point` (m): (f; p × f).
    pub fn force_at(force: Vector3<f64>, point: Vector3<f64>) -> Self {
        Self::new(force, point.cross(&force))
    }

    /// A pure couple (0; m).
    pub fn couple(moment: Vector3<f64>) -> Self {
        Self::new(Vector3::zeros(), moment)
    }

    /// The pairing f·v + m·ω: the power (W) of this wrench on a body moving with `twist`.
    ///
    /// Zero means reciprocal: the wrench does no work on that motion (Ball 1900).
    pub fn power(&self, twist: &Twist) -> f64 {
        self.force.dot(&twist.linear) + self.moment.dot(&twist.angular)
    }
}

impl From<Vector6<f64>> for Wrench {
    fn from(x: Vector6<f64>) -> Self {
        Self::new(
            Vector3::new(x[0], x[1], x[2]),
            Vector3::new(x[3], x[4], x[5]),
        )
    }
}

impl From<Wrench> for Vector6<f64> {
    fn from(w: Wrench) -> Self {
        let (f, m) = (w.force, w.moment);
        Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn helical_twist_has_the_stated_axis_and_pitch() {
        let t = Twist::helical(
            Vector3::new(0.0, 0.0, 3.0),
            Vector3::new(1.0, 2.0, 5.0),
            0.25,
        );
        assert_eq!(t.angular, Vector3::z());
        assert!((t.pitch().unwrap() - 0.25).abs() < 1e-15);
        assert!((t.axis_point().unwrap() - Vector3::new(1.0, 2.0, 0.0)).norm() < 1e-15);
        assert!(
            (t.velocity_at(&Vector3::new(1.0, 2.0, -7.0)) - Vector3::z() * 0.25).norm() < 1e-15
        );
    }

    #[test]
    fn huge_and_tiny_directions_are_normalised() {
        for scale in [1e-300, 1e-200, 1.0, 1e200] {
            let t = Twist::prismatic(Vector3::new(3.0, 0.0, 4.0) * scale);
            assert!((t.linear - Vector3::new(0.6, 0.0, 0.8)).norm() < 1e-15);
        }
        assert_eq!(Twist::prismatic(Vector3::zeros()), Twist::zero());
    }

    #[test]
    fn bracket_is_antisymmetric_and_satisfies_jacobi() {
        let a = Twist::new(Vector3::new(0.3, -1.0, 0.4), Vector3::new(2.0, 0.1, -0.7));
        let b = Twist::new(Vector3::new(-0.6, 0.2, 1.4), Vector3::new(0.5, 1.1, 0.3));
        let c = Twist::new(Vector3::new(0.9, 0.8, -0.1), Vector3::new(-1.2, 0.4, 0.6));
        assert_eq!(a.bracket(&b), -b.bracket(&a));
        let jacobi =
            a.bracket(&b.bracket(&c)) + b.bracket(&c.bracket(&a)) + c.bracket(&a.bracket(&b));
        assert!(jacobi.to_vector().norm() < 1e-14);
    }

    #[test]
    fn force_through_an_axis_does_no_work_on_rotation_about_it() {
        let p = Vector3::new(1.0, -2.0, 0.5);
        let hinge = Twist::revolute(Vector3::new(1.0, 1.0, 0.0), p);
        let through = Wrench::force_at(Vector3::new(0.3, 0.7, -2.0), p);
        assert!(through.power(&hinge).abs() < 1e-14);
        let beside = Wrench::force_at(Vector3::z(), p + Vector3::new(1.0, -1.0, 0.0));
        assert!(beside.power(&hinge).abs() > 1.0);
    }
}
