//! The problems of Sitharam, Peters and Zhou, and what proofs may not claim.

use super::*;
use crate::placed::Placed;
use crate::samples;
use kutzbach_algebra::Limits;

fn solved(name: &str) -> (ReducedSystem, RealSolutions) {
    let placed = Placed::of(&samples::own(name)).unwrap();
    let system = ReducedSystem::new(&placed).unwrap();
    let budget = Budget::new(Limits {
        work: Some(1_000_000),
        ..Limits::default()
    });
    let found = real_solutions(&system, &budget);
    (system, found)
}

/// Problem, weight of the tree, number of solutions.
const KNOWN: [(&str, usize, usize); 6] = [
    ("tetra_ii", 3, 4),
    ("tetra_iii", 3, 10),
    ("tetra_20_10_4", 3, 6),
    ("tetra_6_7_8", 3, 8),
    ("quad_16_17_18_19", 4, 8),
    ("pent", 4, 8),
];

#[test]
fn all_solutions_are_found_and_proven() {
    for (name, weight, count) in KNOWN {
        let (system, found) = solved(name);
        assert_eq!(system.tree.weight, weight, "{name}");
        assert_eq!(system.freedom(), weight, "{name}");
        assert_eq!(found.roots.len(), count, "{name}");
        assert!(found.is_complete(), "{name}");
    }
}

#[test]
fn solutions_satisfy_equations_and_relations() {
    for (name, ..) in KNOWN {
        let (system, found) = solved(name);
        for root in &found.roots {
            for closure in &system.closures {
                let left = system.value(&closure.polynomial, &root.unknowns);
                assert!(left.abs() < 1e-8, "{name}: {left}");
            }
            for turn in &system.unknowns {
                let left = system.value(&turn.relation(&system.field), &root.unknowns);
                assert!(left.abs() < 1e-12, "{name}: {left}");
            }
        }
    }
}

#[test]
fn a_double_solution_is_left_open_and_not_claimed() {
    let (_, found) = solved("tetra_i");
    assert!(found.roots.is_empty() && !found.is_complete() && !found.crowded);
    assert!(!found.open.is_empty());
    // All of it is around one place.
    for place in &found.open {
        let far = place.iter().zip(&found.open[0]).map(|(a, b)| (a - b).abs());
        assert!(far.fold(0.0, f64::max) < 1e-3);
    }
}

#[test]
fn a_curve_is_left_open_in_many_boxes() {
    let (_, found) = solved("quad");
    assert!(!found.is_complete() && found.crowded);
}

#[test]
fn bars_that_are_too_long_leave_nothing_and_that_is_proven() {
    let text = std::fs::read_to_string(
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../mechanisms/tetra_iii.urdf"),
    )
    .unwrap();
    let text = text.replace("${sqrt(10)}", "6");
    let mechanism = kutzbach_format::read(&text, "long.urdf", &[])
        .unwrap()
        .mechanism;
    let system = ReducedSystem::new(&Placed::of(&mechanism).unwrap()).unwrap();
    let found = real_solutions(&system, &Budget::unlimited());
    assert!(found.roots.is_empty() && found.is_complete());
}

#[test]
fn a_budget_that_ends_claims_nothing() {
    let placed = Placed::of(&samples::own("pent")).unwrap();
    let system = ReducedSystem::new(&placed).unwrap();
    let budget = Budget::new(Limits {
        work: Some(1_000),
        ..Limits::default()
    });
    let found = real_solutions(&system, &budget);
    assert!(!found.is_complete() && found.stopped.is_some() && !found.open.is_empty());
}

/// An answer holds for coefficients a little off, and is given up where these might make solutions meet.
#[test]
fn simple_solutions_stay_when_coefficients_change_a_little() {
    let (system, found) = solved("tetra_iii");
    let budget = Budget::unlimited();
    let within = real_solutions_within(&system, 1e-6, &budget);
    assert!(within.is_complete());
    assert_eq!(within.roots.len(), found.roots.len());
    for (one, other) in found.roots.iter().zip(&within.roots) {
        let pairs = one.unknowns.iter().zip(&other.unknowns);
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-9));
    }
    let coarse = real_solutions_within(&system, 1e-2, &budget);
    assert!(!coarse.is_complete());
}
