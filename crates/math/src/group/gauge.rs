//! The choice of centre, length and tolerance without which se(3) has no lengths and angles.

use nalgebra::{Vector3, Vector6};

use super::GroupError;
use super::decomposition::{Decomposition, Margin, ROUNDING};
use super::twist::Twist;

/// Centre, length and accuracy by which twists are compared.
///
/// A twist (ω; v) is measured as the six pure numbers (ω; v_c/L), where v_c = v + ω × c is the velocity at
/// the centre c. Its Euclidean norm is the metric used for every rank decision. There is no metric on
/// se(3) that is the same from every centre and in every unit (Žefran, Kumar, Croke 1999), so the centre and
/// the length are taken from the mechanism and move with it: then no decision depends on the origin, the
/// orientation or the unit of length of the world.
///
/// `tolerance` is the accuracy of the geometry: directions are right within `tolerance` radians, points and
/// pitches within `tolerance`·`length`. Zero means as exact as f64 can hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gauge {
    centre: Vector3<f64>,
    length: f64,
    tolerance: f64,
}

impl Gauge {
    /// A gauge with a given centre (m, world), characteristic length (m) and accuracy.
    ///
    /// # Errors
    /// [`GroupError::BadGauge`] unless the length is positive and finite, the centre finite, and the
    /// tolerance in [0, 0.1): an accuracy of a tenth of the mechanism decides nothing.
    pub fn new(centre: Vector3<f64>, length: f64, tolerance: f64) -> Result<Self, GroupError> {
        let usable = length.is_finite()
            && length > 0.0
            && (0.0..0.1).contains(&tolerance)
            && centre.iter().all(|x| x.is_finite());
        if usable {
            Ok(Self {
                centre,
                length,
                tolerance,
            })
        } else {
            Err(GroupError::BadGauge { length, tolerance })
        }
    }

    /// The gauge of a set of points (m, world), such as the joint positions of a mechanism: their centroid
    /// and their RMS distance from it. Where that distance is within `tolerance`·`fallback_length` (one
    /// joint, or all in one place), `fallback_length` (m) serves instead.
    ///
    /// # Errors
    /// As for [`Gauge::new`].
    pub fn from_points(
        points: &[Vector3<f64>],
        fallback_length: f64,
        tolerance: f64,
    ) -> Result<Self, GroupError> {
        let count = points.len().max(1) as f64;
        let centre = points.iter().sum::<Vector3<f64>>() / count;
        let squares = points.iter().map(|p| (p - centre).norm_squared());
        let spread = (squares.sum::<f64>() / count).sqrt();
        let farthest = points.iter().map(|p| p.norm()).fold(0.0, f64::max);
        Self::with_spread(centre, spread, farthest, fallback_length, tolerance)
    }

    /// The gauge of a set of twists: the point nearest to all their axes in the least-squares sense, and
    /// the RMS distance of the axes from it (`fallback_length`, m, where they all meet in a point or there
    /// are none).
    ///
    /// Where all axes are parallel within the tolerance, the point may slide along them; it is then
    /// placed beside the world's origin. Axes parallel only within `tolerance` tell slightly different
    /// stories at different heights, so a caller that knows where the joints are should prefer
    /// [`Gauge::from_points`] or [`Gauge::new`].
    ///
    /// # Errors
    /// As for [`Gauge::new`]; [`GroupError::NotFinite`]; [`GroupError::NoConvergence`].
    pub fn from_axes(
        twists: &[Twist],
        fallback_length: f64,
        tolerance: f64,
    ) -> Result<Self, GroupError> {
        let mut axes = Vec::new();
        for twist in twists {
            if !twist.is_finite() {
                return Err(GroupError::NotFinite(*twist));
            }
            if let Some(point) = twist.axis_point() {
                axes.push((point, twist.angular.normalize()));
            }
        }
        let count = axes.len().max(1) as f64;
        let seed = axes.iter().map(|(p, _)| p).sum::<Vector3<f64>>() / count;
        // Minimise Σ |u × (seed + x − p)|² over x: stack the three rows of each [u]×. Directions wrong
        // by τ shift a singular value of the stack by at most τ √n, which is the cut.
        let stacked = Decomposition::of(3 * axes.len(), 3, false, |row, column| {
            axes[row / 3].1.cross_matrix()[(row % 3, column)]
        })?;
        let offsets: Vec<_> = axes.iter().map(|(p, u)| u.cross(&(p - seed))).collect();
        let cut = count.sqrt() * tolerance + ROUNDING * stacked.norm();
        let (rank, _) = Margin::decide(&stacked.values, cut);
        let mut centre = seed;
        for k in 0..rank {
            let offset_entries = offsets.iter().flat_map(|o| o.iter()).enumerate();
            let along: f64 = offset_entries
                .map(|(row, o)| o * stacked.left(row, k))
                .sum();
            let direction = Vector3::from_fn(|i, _| stacked.right(i, k));
            centre += direction * (along / stacked.values[k]);
        }
        let squares = axes
            .iter()
            .map(|(p, u)| u.cross(&(p - centre)).norm_squared());
        let spread = (squares.sum::<f64>() / count).sqrt();
        let farthest = axes
            .iter()
            .map(|(p, _)| p.norm())
            .fold(centre.norm(), f64::max);
        Self::with_spread(centre, spread, farthest, fallback_length, tolerance)
    }

    fn with_spread(
        centre: Vector3<f64>,
        spread: f64,
        farthest: f64,
        fallback_length: f64,
        tolerance: f64,
    ) -> Result<Self, GroupError> {
        // Coordinates as large as `farthest` carry that much rounding.
        let noise = (tolerance * fallback_length).max(ROUNDING * farthest);
        let length = if spread > noise {
            spread
        } else {
            fallback_length
        };
        Self::new(centre, length, tolerance)
    }

    /// The centre (m, world).
    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    /// The characteristic length (m).
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The accuracy of the geometry, a pure number.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The same centre and length with another accuracy.
    ///
    /// # Errors
    /// As for [`Gauge::new`].
    pub fn with_tolerance(&self, tolerance: f64) -> Result<Self, GroupError> {
        Self::new(self.centre, self.length, tolerance)
    }

    /// Pure-number coordinates (ω; v_c/L) of a world twist.
    pub fn measure(&self, twist: &Twist) -> Vector6<f64> {
        Twist::new(twist.angular, twist.velocity_at(&self.centre) / self.length).into()
    }

    /// The world twist with these pure-number coordinates; inverse of [`Gauge::measure`].
    pub fn twist(&self, coordinates: &Vector6<f64>) -> Twist {
        let t = Twist::from(*coordinates);
        Twist::new(
            t.angular,
            t.linear * self.length - t.angular.cross(&self.centre),
        )
    }

    /// Bound on the error of the unit vector along `measure(twist)`.
    ///
    /// Take a screw of unit direction at distance ρ from the centre with pitch h (both in units of L). Turning
    /// the direction by τ changes (u; p × u + h u) by at most τ (1; ρ + h); moving the point and changing
    /// the pitch by τ adds at most √2 τ to the lower half. Relative to the norm √(1 + ρ² + h²) this is largest
    /// at √(ρ² + h²) = 0.78, where it is 2.14 τ. Forming v and moving it to the centre rounds by a few ε
    /// of |v| + |ω||c|. The zero twist has no direction: the bound is then irrelevant.
    pub(super) fn direction_error(&self, twist: &Twist, norm: f64) -> f64 {
        let moved = twist.linear.norm() + twist.angular.norm() * self.centre.norm();
        2.14 * self.tolerance + 8.0 * f64::EPSILON * (1.0 + moved / (self.length * norm))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn concurrent_axes_are_centred_on_their_point() {
        let o = Vector3::new(100.0, -20.0, 3.0);
        let twists: Vec<_> = [Vector3::x(), Vector3::y(), Vector3::new(1.0, 1.0, 1.0)]
            .into_iter()
            .map(|u| Twist::revolute(u, o))
            .collect();
        let gauge = Gauge::from_axes(&twists, 0.25, 1e-9).unwrap();
        assert!((gauge.centre() - o).norm() < 1e-12);
        assert_eq!(gauge.length(), 0.25);
    }

    #[test]
    fn two_skew_axes_are_centred_between_them() {
        let twists = [
            Twist::revolute(Vector3::x(), Vector3::new(7.0, 1.0, 0.0)),
            Twist::helical(Vector3::y(), Vector3::new(3.0, 5.0, 4.0), 9.0),
            Twist::prismatic(Vector3::z()),
        ];
        let gauge = Gauge::from_axes(&twists, 1.0, 1e-9).unwrap();
        assert!((gauge.centre() - Vector3::new(3.0, 1.0, 2.0)).norm() < 1e-13);
        assert!((gauge.length() - 2.0).abs() < 1e-13);
    }

    #[test]
    fn parallel_axes_leave_the_height_at_the_origin() {
        let twists = [0.0, 2.0].map(|x| Twist::revolute(Vector3::z(), Vector3::new(x, 1.0, 50.0)));
        let gauge = Gauge::from_axes(&twists, 1.0, 1e-9).unwrap();
        assert!((gauge.centre() - Vector3::new(1.0, 1.0, 0.0)).norm() < 1e-14);
        assert!((gauge.length() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn bad_input_is_refused() {
        assert!(Gauge::new(Vector3::zeros(), 0.0, 1e-9).is_err());
        assert!(Gauge::new(Vector3::zeros(), f64::NAN, 1e-9).is_err());
        assert!(Gauge::new(Vector3::zeros(), 1.0, 0.5).is_err());
        assert!(Gauge::new(Vector3::zeros(), 1.0, f64::NAN).is_err());
        let broken = Twist::prismatic(Vector3::x()) * f64::INFINITY;
        assert!(Gauge::from_axes(&[broken], 1.0, 1e-9).is_err());
        assert!(Gauge::from_points(&[], 1.0, 1e-9).is_ok());
    }

    #[test]
    fn measuring_and_building_twists_are_inverse() {
        let gauge = Gauge::new(Vector3::new(1.0, 2.0, 3.0), 0.1, 0.0).unwrap();
        let twist = Twist::new(Vector3::new(0.1, 0.2, 0.3), Vector3::new(-1.0, 0.4, 0.9));
        let back = gauge.twist(&gauge.measure(&twist));
        assert!((back - twist).to_vector().norm() < 1e-15);
    }
}
