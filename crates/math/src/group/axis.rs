//! Lines and directions in a form that depends on nothing but themselves.

use nalgebra::Vector3;

/// A line in space, in a form that depends on the line only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The point of the line nearest the world's origin (m).
    pub point: Vector3<f64>,
    /// Unit direction, signed as by [`normalised_direction`].
    pub direction: Vector3<f64>,
}

impl Axis {
    /// The line through `point` (m) along `direction`; `None` where the direction is zero or not finite.
    pub fn through(point: Vector3<f64>, direction: Vector3<f64>) -> Option<Self> {
        let direction = normalised_direction(direction)?;
        Some(Self {
            point: point - direction * direction.dot(&point),
            direction,
        })
    }
}

/// The unit vector along `direction`, with the sign that makes its first component positive that is not
/// negligible (above 10⁻⁹, so that rounding in a zero component decides nothing). `None` where the direction is
/// zero or not finite.
pub fn normalised_direction(direction: Vector3<f64>) -> Option<Vector3<f64>> {
    let largest = direction.amax();
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let unit = (direction / largest).normalize();
    let first = unit.iter().find(|x| x.abs() > 1e-9)?;
    // Adding zero turns −0 into 0.
    Some((unit * first.signum()).map(|x| x + 0.0))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn directions_get_one_sign() {
        let d = normalised_direction(Vector3::new(1e-12, -2.0, 0.0)).unwrap();
        assert!((d - Vector3::y()).norm() < 1e-11);
        assert_eq!(normalised_direction(Vector3::zeros()), None);
        assert_eq!(normalised_direction(Vector3::new(f64::NAN, 1.0, 0.0)), None);
    }

    #[test]
    fn one_line_has_one_form() {
        let (p, d) = (Vector3::new(1.0, -2.0, 0.5), Vector3::new(-3.0, 4.0, 12.0));
        let axis = Axis::through(p, d).unwrap();
        let same = Axis::through(p + d * 5.0, d * -0.1).unwrap();
        assert!((axis.point - same.point).norm() < 1e-13);
        assert_eq!(axis.direction, same.direction);
        assert!(axis.point.dot(&axis.direction).abs() < 1e-15);
        assert_eq!(Axis::through(p, Vector3::zeros()), None);
    }
}
