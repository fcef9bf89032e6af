//! Two planar chains whose planes become parallel.

use super::drawn::{Hinge, Triple, circle_point, hinged, integers, over};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Mechanism, MechanismError};

/// Six hinges, three along x and three along a direction `2 atan(epsilon / 2)`, about `epsilon` rad, away from it: Sarrus's
/// linkage with planes at a small angle.
///
/// Each half moves in a plane, and together they translate along the line where the planes meet: one freedom for every
/// `epsilon` between 0 and 2. At 0 the planes are parallel and it is a planar six-bar with three.
///
/// # Errors
/// None in practice.
pub fn double_planar(epsilon: &Number) -> Result<Mechanism, MechanismError> {
    let (x, y) = circle_point(&over(epsilon, &Number::integer(2)));
    let tenths = |x: i64, y: i64, z: i64| -> Triple {
        [x, y, z].map(|n| over(&Number::integer(n), &Number::integer(10)))
    };
    let first = integers(1, 0, 0);
    let second = [x, y, Number::zero()];
    let hinge = |name: &str, links: [&str; 2], at: Triple, along: &Triple| {
        Hinge::new(name, links[0], links[1], at, along.clone())
    };
    let hinges = [
        hinge("one", ["ground", "link_1"], tenths(0, 0, 0), &first),
        hinge("two", ["link_1", "link_2"], tenths(0, -10, 10), &first),
        hinge("three", ["link_2", "platform"], tenths(0, 0, 20), &first),
        hinge("six", ["ground", "link_5"], tenths(30, 5, 0), &second),
        hinge("five", ["link_5", "link_4"], tenths(40, 15, 12), &second),
        hinge("four", ["platform", "link_4"], tenths(30, 5, 20), &second),
    ];
    hinged("double_planar", &hinges)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::drawn::tests::gaps;
    use super::super::drawn::{cross, dot};
    use super::*;
    use crate::families::negative_power_of_ten;

    #[test]
    fn three_axes_are_parallel_in_either_half_and_skewed_between() {
        for (exponent, parallel) in [(Some(14), false), (None, true)] {
            let epsilon = exponent.map_or_else(Number::zero, negative_power_of_ten);
            let planes = double_planar(&epsilon).unwrap();
            assert!(gaps(&planes)[0].iter().all(Number::is_zero));
            let axis = |name: &str| {
                let joint = planes.joint(planes.joint_named(name).unwrap());
                joint.axis.0.clone()
            };
            let apart = |a: &str, b: &str| {
                let normal = cross(&axis(a), &axis(b));
                dot(&normal, &normal)
            };
            for (a, b) in [
                ("one", "two"),
                ("two", "three"),
                ("six", "five"),
                ("five", "four"),
            ] {
                assert!(apart(a, b).is_zero());
            }
            assert_eq!(apart("one", "six").is_zero(), parallel);
            // Both directions are of unit length: the root of this is the sine of the skew.
            let sine = apart("one", "six").value().sqrt();
            assert!((sine - epsilon.value()).abs() <= 1e-12 * epsilon.value());
        }
    }
}
