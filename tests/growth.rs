//! How the work of a report grows with the size of a mechanism: in proportion, for every shape that a long or wide one has.
//!
//! Work is counted, not timed: instructions, as callgrind counts them, are the same on every run and every load of the machine.

use crate::support;

use kutzbach::families::{
    bennett_row, comb, gear_train, hinge_ring, layer_tower, limb_grid, miura_sheet, parallelograms,
    scissor_lift, serial_chain, star,
};
use kutzbach::mechanism::Mechanism;
use support::{assert_none, in_parallel, instructions, written};

/// Work may grow with this power of the size: an ordering of fronts, a sort or a tree map adds a logarithm to what is linear.
const STEEPEST: f64 = 1.3;

/// Every shape by name, with the smallest of its sizes: the others are twice and four times as large. Small ones may cost more than
/// larger ones, since more is asked of them (exact algebra, poses nearby): the larger pair tells how it goes on, and both are printed.
type Shape = (&'static str, fn(usize) -> Mechanism, usize);

const SHAPES: [Shape; 11] = [
    ("serial chain", |n| serial_chain(n).unwrap(), 75),
    ("star", |n| star(n).unwrap(), 100),
    ("comb", |n| comb(n).unwrap(), 75),
    ("gear train", |n| gear_train(n).unwrap(), 400),
    ("parallelograms", |n| parallelograms(n).unwrap(), 20),
    ("Bennett row", |n| bennett_row(n).unwrap(), 60),
    ("scissor lift", |n| scissor_lift(n).unwrap(), 100),
    ("Miura strip", |n| miura_sheet(4, n).unwrap(), 15),
    ("ring of hinges", |n| hinge_ring(n).unwrap(), 200),
    // Of side² bodies, nearly: sides of 5, 7 and 10.
    ("grid of limbs", |n| limb_grid(n.isqrt()).unwrap(), 25),
    ("tower of layers", |n| layer_tower(n).unwrap(), 9),
];

/// Shapes that are known to cost more, with what they may cost at most: roles are looked at closer by an iterative solver, whose
/// iterations grow with the size. One that does no longer is to be taken off this list.
const KNOWN: [(&str, f64); 2] = [("grid of limbs", 2.2), ("tower of layers", 2.2)];

#[test]
#[ignore = "needs valgrind, which counts instructions: run in CI by a step of its own"]
fn reports_cost_as_much_as_mechanisms_are_large() {
    let lines = in_parallel(&SHAPES, |(name, of_size, smallest)| {
        let sizes = [1, 2, 4].map(|times| times * smallest);
        let counts = sizes.map(|size| instructions(&of_size(size)));
        let exponents = [0, 1].map(|i| (counts[i + 1] as f64 / counts[i] as f64).log2());
        let line = format!(
            "{name}: {:?} million instructions at {sizes:?}, exponents {:.2} and {:.2}",
            counts.map(|count| count / 1_000_000),
            exponents[0],
            exponents[1]
        );
        println!("{line}");
        let known = KNOWN.iter().find(|(of, _)| of == name);
        let most = known.map_or(STEEPEST, |(_, most)| *most);
        (exponents[1] > most || known.is_some() && exponents[1] <= STEEPEST).then_some(line)
    });
    assert_none(&lines.into_iter().flatten().collect::<Vec<_>>());
}

/// What a machine without valgrind can tell: with work that grew as the fourth power, or the square of a dense basis, these would take
/// hours.
#[test]
fn large_mechanisms_are_reported_on() {
    for mechanism in [
        serial_chain(3000),
        comb(3000),
        star(3000),
        parallelograms(500),
    ] {
        let mechanism = mechanism.unwrap();
        let mut report = crate::support::program();
        let output = report
            .arg("report")
            .arg(written(&mechanism))
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", mechanism.name());
    }
}
