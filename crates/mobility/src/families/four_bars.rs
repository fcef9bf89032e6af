//! Planar four-bars close to, and at, the poses where they are special.
//!
//! ```text
//!        B---------C        crank A B, coupler B C, rocker D C, ground A D;
//!       /         /         all hinges along z
//!      A---------D
//! ```

use super::drawn::{Hinge, Triple, circle_point, hinged, integers, over};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Mechanism, MechanismError};

/// Hinges A, B, D and C of a four-bar; C as the rocker has it may be elsewhere.
fn four_bar(
    name: &str,
    corners: [Triple; 4],
    rocker_c: Option<Triple>,
) -> Result<Mechanism, MechanismError> {
    let [a, b, c, d] = corners;
    let hinge = |name: &str, first: &str, second: &str, at: Triple| {
        Hinge::new(name, first, second, at, integers(0, 0, 1))
    };
    let mut closing = hinge("C", "coupler", "rocker", c);
    closing.second_at = rocker_c;
    let hinges = [
        hinge("A", "ground", "crank", a),
        hinge("B", "crank", "coupler", b),
        hinge("D", "ground", "rocker", d),
        closing,
    ];
    hinged(name, &hinges)
}

fn half(x: &Number) -> Number {
    over(x, &Number::integer(2))
}

fn point(x: Number, y: Number) -> Triple {
    [x, y, Number::zero()]
}

/// A parallelogram of sides 2 m and 1 m whose crank is turned by `2 atan(epsilon / 2)`, about `epsilon` rad, out of the flat
/// pose.
///
/// One freedom and a regular pose for every `epsilon` between 0 and 2. At 0 it is flat: two instantaneous freedoms, one
/// finite one, and two branches (parallelogram and antiparallelogram) that cross there. (The closure equations of a planar
/// four-bar depend on one another only where its four hinges lie in a line.)
///
/// # Errors
/// None in practice.
pub fn flattening_parallelogram(epsilon: &Number) -> Result<Mechanism, MechanismError> {
    let (x, y) = circle_point(&half(epsilon));
    let corners = [
        integers(0, 0, 0),
        point(x.clone(), y.clone()),
        point(&x + &Number::integer(2), y),
        integers(2, 0, 0),
    ];
    four_bar("flattening_parallelogram", corners, None)
}

/// The flat parallelogram of sides 2 m and 1 m with coupler and rocker longer by `epsilon` metres, drawn flat.
///
/// The longest and the shortest side together equal the two others, whatever `epsilon` is: two instantaneous freedoms, one
/// finite one. With the angles β of the coupler and γ of the rocker, closing to second order asks for
/// `e (1 + e) γ² − 2 (1 + e)(2 + e) β γ + (2 + e)(3 + e) β² = 0`, of discriminant `8 (1 + e)(2 + e) > 0`: two branches that
/// cross. Of a parallelogram (`epsilon` = 0) they are two motions; of any other one they are parts of the same.
///
/// # Errors
/// None in practice.
pub fn flat_change_point(epsilon: &Number) -> Result<Mechanism, MechanismError> {
    let corners = [
        integers(0, 0, 0),
        integers(1, 0, 0),
        point(&Number::integer(3) + epsilon, Number::zero()),
        integers(2, 0, 0),
    ];
    four_bar("flat_change_point", corners, None)
}

/// The flat parallelogram of sides 2 m and 1 m with the coupler alone longer by `epsilon` metres. As drawn it is open at one
/// hinge by `epsilon`; the nearest pose where it closes is about `√epsilon` rad from flat.
///
/// One freedom, and no singular pose at all for `epsilon` between 0 and 2: no choice of signs makes `±1 ±(2 + e) ±1 ±2`
/// vanish, so that the hinges never lie in a line. At `epsilon` = 0 it is the flat parallelogram.
///
/// # Errors
/// None in practice.
pub fn spoiled_parallelogram(epsilon: &Number) -> Result<Mechanism, MechanismError> {
    let corners = [
        integers(0, 0, 0),
        integers(1, 0, 0),
        point(&Number::integer(3) + epsilon, Number::zero()),
        integers(2, 0, 0),
    ];
    four_bar("spoiled_parallelogram", corners, Some(integers(3, 0, 0)))
}

/// A crank-rocker of crank 1 m, coupler 11 m, rocker 13 m and ground 5 m, with its crank turned by `2 atan(epsilon / 2)`,
/// about `epsilon` rad, past the pose where it lies in line with the coupler and the rocker turns back.
///
/// A dead centre of the rocker is a regular pose: one freedom, finite and instantaneous, for every `epsilon` from 0 to 2.
/// Only the rocker's velocity vanishes with `epsilon`.
///
/// # Errors
/// None in practice.
pub fn near_dead_centre(epsilon: &Number) -> Result<Mechanism, MechanismError> {
    let (x, y) = circle_point(&half(epsilon));
    // C is the meeting of two circles: on the foot at `along` times B D, `across` times that length beside it.
    let (dx, dy) = (-&x, &Number::integer(5) - &y);
    let square = &Number::integer(26) - &(&Number::integer(10) * &y);
    let along = half(&(&Number::one() - &over(&Number::integer(48), &square)));
    let rest = &over(&Number::integer(121), &square) - &(&along * &along);
    let across = rest.sqrt().unwrap_or_else(|_| Number::zero());
    let c = point(
        &(&x + &(&along * &dx)) + &(&across * &dy),
        &(&y + &(&along * &dy)) - &(&across * &dx),
    );
    let corners = [integers(0, 0, 0), point(x, y), c, integers(0, 5, 0)];
    four_bar("near_dead_centre", corners, None)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::drawn::tests::{gaps, side_squared};
    use super::*;
    use crate::families::negative_power_of_ten;

    fn is(found: &Number, expected: &Number) -> bool {
        (found - expected).is_zero()
    }

    /// Squares of crank, coupler, rocker and ground.
    fn sides(bars: &Mechanism) -> [Number; 4] {
        [("A", "B"), ("B", "C"), ("D", "C"), ("A", "D")].map(|(a, b)| side_squared(bars, a, b))
    }

    #[test]
    fn sides_are_exactly_those_that_are_told() {
        for exponent in [1, 3, 14] {
            let epsilon = negative_power_of_ten(exponent);
            let longer = |length: i64| &Number::integer(length) + &epsilon;
            let [one, two] = [1, 2].map(Number::integer);
            for (bars, expected) in [
                (
                    flattening_parallelogram(&epsilon),
                    [one.clone(), two.clone(), one.clone(), two.clone()],
                ),
                (
                    flat_change_point(&epsilon),
                    [one.clone(), longer(2), longer(1), two.clone()],
                ),
                (
                    near_dead_centre(&epsilon),
                    [1, 11, 13, 5].map(Number::integer),
                ),
            ] {
                let bars = bars.unwrap();
                for (found, expected) in sides(&bars).iter().zip(&expected) {
                    assert!(is(found, &(expected * expected)), "{}", bars.name());
                }
                assert!(gaps(&bars)[0].iter().all(Number::is_zero));
            }
        }
    }

    #[test]
    fn a_coupler_too_long_leaves_a_gap_of_its_own_size() {
        let epsilon = negative_power_of_ten(14);
        let bars = spoiled_parallelogram(&epsilon).unwrap();
        let [x, y, z] = &gaps(&bars)[0];
        assert!(is(&x.abs(), &epsilon) && y.is_zero() && z.is_zero());
    }

    #[test]
    fn at_its_dead_centre_crank_and_coupler_are_in_line() {
        let bars = near_dead_centre(&Number::zero()).unwrap();
        assert!(is(&side_squared(&bars, "A", "C"), &Number::integer(144)));
        let past = near_dead_centre(&negative_power_of_ten(14)).unwrap();
        assert!(!is(&side_squared(&past, "A", "C"), &Number::integer(144)));
    }
}
