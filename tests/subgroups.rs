//! Displacement subgroups on the reference mechanisms: what they decide is right, and what they have to decide they do.

#![allow(clippy::unwrap_used)]

mod support;

use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{MobilityClass, SubgroupFinding, subgroup_finding};
use serde_json::Value;
use std::collections::BTreeMap;
use support::{analysis, assert_none, folder, in_parallel, zoo};

/// The findings of all parts, and the freedom of what is in no part.
fn findings(mechanism: &Mechanism) -> (Vec<SubgroupFinding>, usize) {
    let analysis = analysis(mechanism);
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let structure = &analysis.structure;
    let found = structure
        .parts
        .iter()
        .zip(&analysis.parts)
        .map(|(part, rank)| {
            subgroup_finding(
                mechanism,
                &geometry,
                &analysis.assembly.states,
                structure,
                part,
                rank,
            )
            .unwrap()
        })
        .collect();
    let free: usize = structure
        .free_joints
        .iter()
        .map(|&joint| mechanism.joints()[joint].freedom())
        .sum();
    (found, free + 6 * structure.loose_pieces)
}

#[test]
fn table() {
    let zoo = zoo();
    let text = std::fs::read_to_string(folder("tests/zoo/expected.json")).unwrap();
    let expected: Value = serde_json::from_str(&text).unwrap();
    let rows = in_parallel(&zoo, |(name, mechanism)| {
        let (found, free) = findings(mechanism);
        let finite: Option<usize> = found.iter().map(|f| f.finite).sum::<Option<usize>>();
        let lower: usize = found.iter().map(|f| f.lower).sum();
        let known: usize = expected[name]["finite"].as_u64().unwrap() as usize;
        let pose = expected[name]["pose"].as_str().unwrap();
        let wrong =
            finite.is_some_and(|f| f + free != known || pose == "singular") || lower + free > known;
        let class: Vec<_> = found.iter().map(|f| f.class.map(|c| c.word())).collect();
        format!(
            "{}{name}: {finite:?} lower {lower} +{free} known {known} {pose} {class:?} margin {:.1e}\n      {}\n      {:?}",
            if wrong { "WRONG " } else { "" },
            found.iter().map(|f| f.margin).fold(f64::INFINITY, f64::min),
            found
                .iter()
                .map(|f| f.text.clone())
                .collect::<Vec<_>>()
                .join(" | "),
            found
                .iter()
                .flat_map(|f| f.steps.clone())
                .collect::<Vec<_>>(),
        )
    });
    println!("{}", rows.join("\n"));
}

#[test]
fn timing() {
    for (name, mechanism) in zoo() {
        let analysis = analysis(&mechanism);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let start = std::time::Instant::now();
        let n = 20;
        for _ in 0..n {
            for (part, rank) in analysis.structure.parts.iter().zip(&analysis.parts) {
                subgroup_finding(
                    &mechanism,
                    &geometry,
                    &analysis.assembly.states,
                    &analysis.structure,
                    part,
                    rank,
                )
                .unwrap();
            }
        }
        println!(
            "{:9.1} us {name} {} joints",
            start.elapsed().as_secs_f64() * 1e6 / n as f64,
            mechanism.joints().len()
        );
    }
}
