//! Chains and ladders of up to ten thousand loops.

use super::ladder::{Ladder, Law, Rung, regular};
use kutzbach::families::{bennett_chain, bennett_row, miura_sheet, scissor_lift};
use kutzbach::mechanism::Mechanism;

/// What is true of the members is told at the functions in `kutzbach::families`. The lift, a ladder whose loops all move
/// together, goes to ten thousand loops, the sheet to a thousand. The numbers of a Bennett chain, of which every loop is the
/// image of the one before, grow with its length, so that it ends at thirty; a row of Bennett loops has a freedom for every
/// loop, and a basis of as many motions of all joints: it ends at a hundred.
///
/// Loops that move together are like cells of a string or a sheet: the motion that violates the equations least is the wave
/// as long as the whole, so that the smallest singular value kept falls like one over the number of loops in a row. Loops that share no
/// joint do not change one another's.
pub fn ladders() -> Vec<Ladder> {
    let ladder = |name,
                  law: fn(f64) -> f64,
                  sizes: &[usize],
                  build: &dyn Fn(usize) -> Mechanism,
                  freedom: &dyn Fn(usize) -> usize| {
        let rung = |&size: &usize| Rung {
            label: size.to_string(),
            decades: Some((size as f64).log10()),
            mechanism: build(size),
            configuration: None,
            known: regular(freedom(size)),
        };
        Ladder {
            name,
            parameter: "loops",
            law: Some(Law::new(2.0, law)),
            rungs: sizes.iter().map(rung).collect(),
        }
    };
    vec![
        // A lift has one loop more than stages.
        ladder(
            "scissor_lift",
            |decades| -decades,
            &[2, 10, 30, 100, 1_000, 10_000],
            &|loops| scissor_lift(loops - 1).unwrap(),
            &|_| 1,
        ),
        ladder(
            "bennett_row",
            |_| 0.0,
            &[1, 3, 10, 30, 100],
            &|loops| bennett_row(loops).unwrap(),
            &|loops| loops,
        ),
        ladder(
            "bennett_chain",
            |decades| -decades,
            &[1, 3, 10, 30],
            &|loops| bennett_chain(loops).unwrap(),
            &|_| 1,
        ),
        // As many inner vertices, in a square sheet.
        ladder(
            "miura_sheet",
            |decades| -0.5 * decades,
            &[1, 9, 25, 100, 961],
            &|loops| {
                let side = loops.isqrt() + 1;
                miura_sheet(side, side).unwrap()
            },
            &|_| 1,
        ),
    ]
}
