//! Lengths of very different size, and everything large or small alike.

use super::drawn::{built, integers, isogram, power_of_ten, rectangle};
use super::ladder::{Ladder, Law, Rung, regular};
use super::offsets::DEEP;
use kutzbach::mechanism::Mechanism;
use kutzbach::number::Number;

/// Exponents to either side of 1.
pub const BOTH_SIDES: [i32; 21] = [
    -40, -20, -16, -12, -10, -8, -6, -4, -2, -1, 0, 1, 2, 4, 6, 8, 10, 12, 16, 20, 40,
];

/// A Bennett linkage of sides `√5 ratio` m and about 2 m.
///
/// A skew isogram for every ratio but zero: see [`super::twists`] for why it is regular with one freedom. Two and two of its
/// hinges come to lie on one another as the ratio vanishes.
fn bennett(ratio: &Number) -> Mechanism {
    let a = integers(1, 0, 0);
    let b = [Number::one(), ratio.clone(), &Number::integer(2) * ratio];
    built("bennett_length_ratio", &isogram(&a, &b, &integers(0, 0, 0)))
}

/// The Bennett linkage of sides √5 m and 3 m with all coordinates multiplied by a factor: the same in another unit.
fn scaled(factor: &Number) -> Mechanism {
    let mut hinges = isogram(&integers(1, 0, 0), &integers(1, 1, 2), &integers(0, 0, 0));
    for hinge in &mut hinges {
        hinge.at = std::array::from_fn(|i| &hinge.at[i] * factor);
    }
    built("all_lengths", &hinges)
}

pub fn ladders() -> Vec<Ladder> {
    let both = |build: fn(&Number) -> Mechanism| {
        let rung = |e| Rung::at(e, build(&power_of_ten(e)), regular(1));
        BOTH_SIDES.into_iter().map(rung).collect::<Vec<_>>()
    };
    // A rectangle is no flat parallelogram, whatever its sides: one freedom, regular. Measured in its longer side, the
    // hinges come as close to a line as the ratio says.
    let four_bar = Ladder {
        name: "four_bar_length_ratio",
        parameter: "ground and coupler over crank and rocker",
        law: Some(Law::new(4.0, |decades| -decades.abs())),
        rungs: both(|ratio| built("four_bar_length_ratio", &rectangle(ratio))),
    };
    let bennett = Ladder {
        name: "bennett_length_ratio",
        parameter: "one pair of sides over the other",
        law: Some(Law::new(4.0, |decades| decades)),
        rungs: DEEP
            .into_iter()
            .map(|exponent| {
                let exponent = -(exponent as i32);
                Rung::at(exponent, bennett(&power_of_ten(exponent)), regular(1))
            })
            .collect(),
    };
    // No unit of length is special, but that nothing below 1e-13 m counts as the length of a loop.
    let scaled = Ladder {
        name: "all_lengths",
        parameter: "unit of length (m)",
        law: Some(Law::new(1.3, |_| 0.0)),
        rungs: both(scaled),
    };
    vec![four_bar, bennett, scaled]
}
