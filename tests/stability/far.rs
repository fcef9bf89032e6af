//! Mechanisms drawn far from the origins of their frames, and loops drawn open.

use super::drawn::{Triple, built, drawn, integers, isogram, power_of_ten, ratio, rectangle};
use super::ladder::{Known, Ladder, Law, Rung, regular};
use super::offsets::DEEP;
use kutzbach::number::Number;

/// How far the frames are from the joints: powers of ten of a metre.
pub const FAR: [i32; 13] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 15, 20];

/// The Bennett linkage of sides √5 m and 3 m: one freedom (see [`super::twists`]); with one hinge turned by a thousandth of
/// a radian about a side: rigid (argued at `kutzbach::families::spoiled_bennett`). Every link's frame lies far from its
/// joints, each in another direction, as does the ground's; where a frame lies changes nothing.
///
/// What is less than a billionth of the largest coordinate met does not count as the length of a loop, so that singular
/// values are in another unit from 1e9 m on.
pub fn ladders() -> Vec<Ladder> {
    let far = |name, extra: Triple, known: Known| {
        let rung = |exponent| {
            let a = integers(1, 0, 0);
            let hinges = isogram(&a, &integers(1, 1, 2), &extra);
            let away = power_of_ten(exponent);
            let mechanism = drawn(name, &hinges, &away).build().unwrap();
            Rung::at(exponent, mechanism, known)
        };
        Ladder {
            name,
            parameter: "frames away from the joints by (m)",
            law: Some(Law::new(1.1, |_| 0.0).up_to(8.5)),
            rungs: FAR.into_iter().map(rung).collect(),
        }
    };
    // The hinge in A is across the sides to B and D: (4, −4, 2)·1. Turned about A D = (−2, −1, 2) it gains a multiple of
    // (−2, −1, 2) × (4, −4, 2) = (6, 12, 12).
    let turned = [6, 12, 12].map(|x| &Number::integer(x) * &ratio(1, 3000));
    vec![
        far("far_bennett", integers(0, 0, 0), regular(1)),
        far("far_spoiled_bennett", turned, regular(0)),
        open_loop(),
    ]
}

/// A rectangle of four hinges along z drawn open along z: its links can turn about z and move across it, never along it, so
/// that no pose closes, however small the gap.
fn open_loop() -> Ladder {
    let rung = |exponent: u32| {
        let exponent = -(exponent as i32);
        let [a, b, d, c] = rectangle(&Number::integer(2));
        let c = c.second_at([Number::integer(2), Number::one(), power_of_ten(exponent)]);
        Rung::at(
            exponent,
            built("open_loop", &[a, b, d, c]),
            Known::NeverCloses,
        )
    };
    Ladder {
        name: "open_loop",
        parameter: "gap that no motion closes (m)",
        law: None,
        rungs: DEEP.into_iter().map(rung).collect(),
    }
}
