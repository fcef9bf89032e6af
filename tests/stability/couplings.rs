//! Gears of very different sizes.

use super::drawn::{Place, drawn, integers, power_of_ten};
use super::ladder::{Ladder, Law, Rung, regular};
use super::lengths::BOTH_SIDES;
use kutzbach::mechanism::Mechanism;
use kutzbach::number::Number;

/// Three wheels on parallel shafts, geared a : b : c = 1 : r : r², and c to a once more, by `last` r².
///
/// Three linear equations b = r a, c = r b, c = last r² a. With `last` = 1 the third follows from the others: one freedom.
/// With any other it leaves a = 0: rigid. Linear equations have no singular pose.
fn wheels(name: &str, ratio: &Number, last: i64) -> Mechanism {
    let wheel = |name, link, x: i64| {
        let links = ["ground", link];
        Place::hinge(name, links, integers(x, 0, 0), integers(0, 0, 1))
    };
    let places = [wheel("A", "a", 0), wheel("B", "b", 1), wheel("C", "c", 2)];
    let mut builder = drawn(name, &places, &Number::zero());
    builder.coupling("ab", "a", "b", ratio.clone());
    builder.coupling("bc", "b", "c", ratio.clone());
    let closing = &(ratio * ratio) * &Number::integer(last);
    builder.coupling("ac", "a", "c", closing);
    builder.build().unwrap()
}

/// A planar five-bar with feet (0, 0) and (4, 0), knees (−1, 2) and (5, 2), top (2, 4), its two cranks geared.
///
/// Knees and top are not in line, so that the top is a smooth function of the two cranks' angles, which are coordinates of
/// all poses nearby. A linear relation between two coordinates leaves a line: one freedom, regular.
fn five_bar(ratio: &Number) -> Mechanism {
    let up = || integers(0, 0, 1);
    let places = [
        Place::hinge("A", ["ground", "left"], integers(0, 0, 0), up()),
        Place::hinge("B", ["left", "left_rod"], integers(-1, 2, 0), up()),
        Place::hinge("E", ["ground", "right"], integers(4, 0, 0), up()),
        Place::hinge("D", ["right", "right_rod"], integers(5, 2, 0), up()),
        Place::hinge("C", ["left_rod", "right_rod"], integers(2, 4, 0), up()),
    ];
    let mut builder = drawn("geared_five_bar", &places, &Number::zero());
    builder.coupling("gears", "left", "right", ratio.clone());
    builder.build().unwrap()
}

pub fn ladders() -> Vec<Ladder> {
    let ladder = |name, law: fn(f64) -> f64, freedom, build: &dyn Fn(&Number) -> Mechanism| {
        let rung = |e| Rung::at(e, build(&power_of_ten(e)), regular(freedom));
        Ladder {
            name,
            parameter: "gear ratio",
            law: Some(Law::new(4.0, law)),
            rungs: BOTH_SIDES.into_iter().map(rung).collect(),
        }
    };
    vec![
        ladder("gear_ring", |_| 0.0, 1, &|r| wheels("gear_ring", r, 1)),
        // With columns of unit length the determinant is about 1/r for large r, and r for small ones.
        ladder("locked_gear_ring", |d| -d.abs(), 0, &|r| {
            wheels("locked_gear_ring", r, 2)
        }),
        ladder("geared_five_bar", |_| 0.0, 1, &five_bar),
    ]
}
