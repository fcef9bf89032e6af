//! The same question asked twice: cycle equations in the joints' rates, and absolute coordinates with one twist per link.
//!
//! The two share the joint screws and nothing else: no cycles, no tree, no signs. Their kernels have the same dimension at
//! every closed pose, whatever the rank. (A joint whose own screws are dependent, a universal joint with parallel axes,
//! would have more rates than the link has velocities; no mechanism here is drawn like that.)

use crate::support;

use kutzbach::closure::{
    Arithmetic, Geometry, Part, entry_accuracy, jacobian, positional_jacobian, refine,
};
use kutzbach::families::{miura_sheet, scissor_lift};
use kutzbach::matrix::{Real, SparseMatrix, decide};
use kutzbach::mechanism::Mechanism;
use std::collections::BTreeSet;
use support::{analysis, assert_none, in_parallel, own_mechanisms, zoo, zoo_mechanism};

/// The nullities of the matrices by the cycles and by the links.
///
/// The columns by the cycles are scaled to one, which a screw allows. Those by the links are not: where nothing hinders a
/// link's turning a column holds rounding only, and scaled it would count.
fn nullities<R: Real>(
    by_cycles: &SparseMatrix<R>,
    by_links: &SparseMatrix<R>,
    accuracy: f64,
) -> [Option<usize>; 2] {
    let mut by_cycles = by_cycles.clone();
    by_cycles.scale_columns();
    [&by_cycles, by_links].map(|matrix| decide(matrix, accuracy).unwrap().nullity())
}

/// Number of unknowns of the second formulation: six per link but one in each connected piece.
fn velocities(mechanism: &Mechanism, part: &Part) -> usize {
    let mut piece: Vec<usize> = (0..mechanism.links().len()).collect();
    let mut links = BTreeSet::new();
    let mut merged = 0;
    for &joint in &part.joints {
        let joint = &mechanism.joints()[joint];
        let ends = [joint.predecessor.link.0, joint.successor.link.0];
        links.extend(ends);
        let [a, b] = ends.map(|end| piece[end]);
        if a != b {
            merged += 1;
            piece.iter_mut().filter(|p| **p == b).for_each(|p| *p = a);
        }
    }
    let pieces = links.len() - merged;
    6 * (links.len() - pieces)
}

fn disagreements(name: &str, mechanism: &Mechanism) -> Vec<String> {
    let analysis = analysis(mechanism);
    if !analysis.assembly.closed {
        return Vec::new();
    }
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let states = &analysis.assembly.states;
    let mut wrong = Vec::new();
    for (part, rank) in analysis.structure.parts.iter().zip(&analysis.parts) {
        let cycles = jacobian(mechanism, &geometry, states, part).unwrap();
        let links = positional_jacobian(mechanism, &geometry, states, part).unwrap();
        assert_eq!(links.columns(), velocities(mechanism, part));
        let (_, rounding) = entry_accuracy(&cycles);
        // Where the stated precision is too coarse to be of use, the analysis takes the numbers as they are.
        let found = nullities(&cycles.matrix, &links, rank.open_by_digits() + rounding);
        if found[0].is_none() || found[0] != found[1] {
            wrong.push(format!(
                "{name}: {found:?} by cycles and by links ({} and {} unknowns)",
                cycles.matrix.columns(),
                links.columns()
            ));
        }
    }
    wrong
}

fn assert_agreement(mechanisms: &[(String, Mechanism)]) {
    let wrong = in_parallel(mechanisms, |(name, mechanism)| {
        disagreements(name, mechanism)
    });
    assert_none(&wrong.concat());
}

#[test]
fn reference_mechanisms() {
    assert_agreement(&zoo());
}

#[test]
fn families_of_many_loops() {
    assert_agreement(&[
        ("scissor lift".to_owned(), scissor_lift(50).unwrap()),
        ("Miura sheet".to_owned(), miura_sheet(8, 8).unwrap()),
    ]);
}

/// With 106 bits, from the files' own digits: joints of many kinds, one loop and many, regular poses and singular ones.
#[test]
fn twice_the_digits() {
    const BITS: u32 = 106;
    let names = [
        "bennett_generic",
        "bennett_perturbed_1e-6",
        "bricard_threefold_60_bifurcation",
        "delassus_hhhp",
        "double_watt_cusp",
        "kokotsakis_translational_flexible",
        "oldham_rccr",
        "rps3_tripod",
        "ruiz_cartesian_table",
        "sarrus_6r_flat",
        "stewart_6SPS",
        "upu3_tsai",
    ];
    let wrong = in_parallel(&names, |name| {
        let mechanism = zoo_mechanism(name);
        let expected = analysis(&mechanism);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::bits(BITS));
        let mut states = geometry.states.clone();
        let mut wrong = Vec::new();
        for (part, rank) in expected.structure.parts.iter().zip(&expected.parts) {
            let held = BTreeSet::new();
            let residual = refine(&mechanism, &geometry, &mut states, part, &held).unwrap();
            let cycles = jacobian(&mechanism, &geometry, &states, part).unwrap();
            let links = positional_jacobian(&mechanism, &geometry, &states, part).unwrap();
            let (_, rounding) = entry_accuracy(&cycles);
            if !(rounding < 1e-26 && residual < 1e-26) {
                wrong.push(format!("{name}: closed to {residual:.0e} only"));
            }
            let found = nullities(&cycles.matrix, &links, rounding + residual);
            if found != [rank.instantaneous; 2] {
                wrong.push(format!(
                    "{name}: {found:?} by cycles and by links, {:?} in double precision",
                    rank.instantaneous
                ));
            }
        }
        wrong
    });
    assert_none(&wrong.concat());
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn own_files() {
        assert_agreement(&support::sample(own_mechanisms(), 3));
    }
}
