//! The one loop whose motion is known better than its subgroup: the parallelogram.

use super::chain::Piece;
use kutzbach_math::group::{Gauge, GroupError, ScrewSystem, Subalgebra, Twist};
use nalgebra::Vector3;

/// How far a vector must exceed the error it is compared with to be one.
const VISIBLE: f64 = 1e3;

/// What a parallelogram does.
pub struct Circular {
    /// The direction in which the coupler is translated at the pose.
    pub span: ScrewSystem,
    /// The translations of its plane.
    pub algebra: Subalgebra,
}

/// Recognises two cranks, each of two hinges, all four axes parallel, that have the same vector from the first axis to the
/// second. The coupler then can be translated along a circle; see the module's text for when that is all it does.
///
/// Axes are known within the gauge's tolerance, in direction and in units of its length in place. A crank is the
/// difference of two places, two cranks differ by four; seen from the centre, a tilted axis passes its point off by
/// at most the tilt times the distance.
pub fn circular(
    first: &[Piece],
    second: &[Piece],
    gauge: &Gauge,
) -> Result<Option<Circular>, GroupError> {
    match (hinges(first), hinges(second)) {
        (Some(one), Some(other)) => of_cranks(one, other, gauge),
        _ => Ok(None),
    }
}

/// [`circular`] of two cranks, each given by the screws of its hinges.
pub fn of_cranks(
    one: [Twist; 2],
    other: [Twist; 2],
    gauge: &Gauge,
) -> Result<Option<Circular>, GroupError> {
    let normal = one[0].angular.normalize();
    let mut far = 0.0f64;
    let mut places = [[Vector3::zeros(); 2]; 2];
    for (places, hinges) in places.iter_mut().zip([one, other]) {
        for (place, hinge) in places.iter_mut().zip(hinges) {
            let (Some(point), Some(pitch)) = (hinge.axis_point(), hinge.pitch()) else {
                return Ok(None);
            };
            let along = hinge.angular.normalize();
            if along.cross(&normal).norm() > 2.0 * gauge.tolerance()
                || pitch.abs() > gauge.tolerance() * gauge.length()
            {
                return Ok(None);
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
        return Ok(None);
    }
    let along = Twist::prismatic(normal.cross(&cranks[0]));
    let outward = Twist::prismatic(cranks[0]);
    Ok(Some(Circular {
        span: ScrewSystem::span(&[along], gauge)?,
        algebra: Subalgebra::generated_by(&[along, outward], gauge)?,
    }))
}

/// The two screws of a chain of two, if both turn.
fn hinges(pieces: &[Piece]) -> Option<[Twist; 2]> {
    let [
        Piece::Factor { twists: first, .. },
        Piece::Factor { twists: second, .. },
    ] = pieces
    else {
        return None;
    };
    let ([first], [second]) = (&first[..], &second[..]) else {
        return None;
    };
    [first, second]
        .iter()
        .all(|twist| twist.angular.norm() > 0.5)
        .then_some([*first, *second])
}
