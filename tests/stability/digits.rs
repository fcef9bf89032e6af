//! The same mechanisms written with 3 to 60 decimals.

use super::ladder::{Known, Ladder, Rung, regular};
use super::support::rewrite::Draft;
use super::support::{decimal, zoo_mechanism};

/// Decimals written.
const DECIMALS: [i32; 17] = [3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 15, 16, 20, 30, 40, 50, 60];

/// Mechanisms of `tests/zoo`, drawn with 60 decimals.
///
/// The first three move because of equations between irrational numbers. What was meant does so at every number of digits,
/// and a number that is stated with `d` decimals stands for all numbers that round to it (D13), so that the mechanism meant
/// is among those that the file allows: one freedom, regular. (Taken literally they are rigid; that is a note, not the
/// verdict.)
///
/// The last is a Bennett linkage with one corner 1e-6 m off, so that opposite sides are no longer equal by 7e-7 m and 3e-7 m.
/// Some thirty numbers of eight decimals, 5e-9 off each and all to the same end, cannot make up for that: every mechanism
/// that the file allows is rigid. With fewer decimals it might not be, so that it is not asked.
pub fn ladders() -> Vec<Ladder> {
    let each = [
        ("bennett_generic", "written_bennett", 1),
        ("goldberg_6r", "written_goldberg", 1),
        ("bricard_threefold_60", "written_bricard", 1),
        ("bennett_perturbed_1e-6", "written_spoiled_bennett", 0),
    ];
    let ladder = |(file, name, freedom): (&str, &'static str, usize)| {
        let drawn = zoo_mechanism(file);
        let fewest = if freedom == 0 { 8 } else { 3 };
        let rung = |decimals: i32| {
            let mechanism = Draft::of(&drawn)
                .each_number(&|n| decimal::rounded(n, decimals))
                .build();
            Rung {
                label: decimals.to_string(),
                ..Rung::at(-decimals, mechanism, rounded(freedom))
            }
        };
        // Of as many digits as programs print, its millionth of a metre is taken for their noise.
        let noise = |d: i32| freedom == 0 && (9..=17).contains(&d);
        let written = DECIMALS.into_iter().filter(|d| *d >= fewest && !noise(*d));
        Ladder {
            name,
            parameter: "decimals written",
            law: None,
            rungs: written.map(rung).collect(),
        }
    };
    each.into_iter().map(ladder).collect()
}

fn rounded(freedom: usize) -> Known {
    match regular(freedom) {
        Known::Moves(truth) => Known::IsMeant(truth),
        other => other,
    }
}
