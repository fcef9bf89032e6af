//! The one loop whose motion is known better than its subgroup: the parallelogram.

use kutzbach_math::group::{Gauge, Twist};
use nalgebra::Vector3;

/// How far a vector must exceed the error it is compared with to be one.
const VISIBLE: f64 = 1e3;

/// Recognises two cranks, each of two hinges, all four axes parallel, that have the same vector from the first axis to the
/// second. The coupler then can be translated along a circle; see the module's text for when that is all it does. Returned are two
/// translations that span its plane.
///
/// Axes are known within the gauge's tolerance, in direction and in units of its length in place. A crank is the
/// difference of two places, two cranks differ by four; seen from the centre, a tilted axis passes its point off by
/// at most the tilt times the distance.
pub fn plane_of_translation(
    one: [Twist; 2],
    other: [Twist; 2],
    gauge: &Gauge,
) -> Option<[Twist; 2]> {
    let normal = one[0].angular.normalize();
    let mut far = 0.0f64;
    let mut places = [[Vector3::zeros(); 2]; 2];
    for (places, hinges) in places.iter_mut().zip([one, other]) {
        for (place, hinge) in places.iter_mut().zip(hinges) {
            let (point, pitch) = (hinge.axis_point()?, hinge.pitch()?);
            let along = hinge.angular.normalize();
            if along.cross(&normal).norm() > 2.0 * gauge.tolerance()
                || pitch.abs() > gauge.tolerance() * gauge.length()
            {
                return None;
            }
            let from_centre = point - gauge.centre();
            let across = from_centre - normal * from_centre.dot(&normal);
            far = far.max(from_centre.norm());
            *place = across;
        }
    }
    let cranks = places.map(|[a, b]| b - a);
    let error = 4.0 * gauge.tolerance() * (gauge.length() + far);
    if (cranks[0] - cranks[1]).norm() > error || cranks[0].norm() < VISIBLE * error {
        return None;
    }
    Some([
        Twist::prismatic(normal.cross(&cranks[0])),
        Twist::prismatic(cranks[0]),
    ])
}
