//! Known mechanisms as every writer prints them.

use super::printing::{WRITERS, What, Writer};
use crate::support::rewrite::Draft;
use crate::support::{analysis, assert_none, in_parallel, sample, zoo, zoo_mechanism};
use kutzbach::matrix::SplitMix64;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::PoseKind;
use kutzbach::number::Number;

/// Mechanisms that other writers than exact ones turn into others: Bennett's loop with one length a millionth off is rigid, and to
/// fewer digits, or but for the noise of printed numbers, it is Bennett's loop.
const ANOTHER_TO_WRITERS: [&str; 1] = ["bennett_perturbed_1e-6"];

/// A mechanism as a writer prints it, read again.
fn printed(mechanism: &Mechanism, writer: &Writer, seed: u64) -> Mechanism {
    let mut random = SplitMix64::new(seed);
    let mut draft = Draft::of(mechanism);
    draft.poses.clear();
    let written = draft.each_number_of_a_kind(&mut |kind, number| {
        let what = [What::Length, What::Angle, What::Direction][kind];
        Number::decimal(&writer.number(what, number.value(), false, &mut random)).unwrap()
    });
    let text = kutzbach::format::write(&written.build());
    kutzbach::format::read(&text, "printed.urdf", &[])
        .unwrap()
        .mechanism
}

/// Numbers that are off by a billionth close six hinges at other poses only, where these hold fast: as drawn they miss by no more.
#[test]
fn noise_leads_to_no_pose_elsewhere() {
    let names = [
        "bricard_line_symmetric",
        "goldberg_6r",
        "waldron_double_bennett_6r",
    ];
    let writers = WRITERS
        .iter()
        .filter(|writer| writer.name.starts_with("noise"));
    let cases: Vec<_> = writers
        .flat_map(|writer| names.map(|name| (writer, name)))
        .collect();
    let wrong = in_parallel(&cases, |(writer, name)| {
        let said = analysis(&printed(&zoo_mechanism(name), writer, 1)).mobility;
        let told = format!("{name}, {}: {:?}", writer.name, said.verdict);
        (said.finite() != Some(1)).then_some(told)
    });
    let wrong: Vec<String> = wrong.into_iter().flatten().collect();
    assert_none(&wrong);
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn known_mechanisms_are_what_they_were() {
        let known = zoo().into_iter().filter_map(|(name, mechanism)| {
            let mobility = analysis(&mechanism).mobility;
            let regular = mobility.pose == Some(PoseKind::Regular)
                && !ANOTHER_TO_WRITERS.contains(&&name[..]);
            Some((name, mobility.finite().filter(|_| regular)?, mechanism))
        });
        let known: Vec<_> = known.collect();
        let cases = WRITERS
            .iter()
            .filter(|writer| writer.closing.is_none())
            .flat_map(|writer| known.iter().map(move |of| (writer, of)));
        let outcomes = in_parallel(&sample(cases, 36), |(writer, (name, finite, mechanism))| {
            let said = analysis(&printed(mechanism, writer, 1)).mobility.finite();
            (writer.name, name, *finite, said)
        });
        let told = |right: fn(Option<usize>, usize) -> bool| -> Vec<String> {
            let those = outcomes
                .iter()
                .filter(|(.., finite, said)| !right(*said, *finite));
            those
                .map(|(writer, name, finite, said)| {
                    format!("{name}, {writer}: {said:?} instead of {finite}")
                })
                .collect()
        };
        assert_none(&told(|said, finite| said.is_none_or(|said| said == finite)));
        let open = told(|said, _| said.is_some());
        println!("{} of {} are open: {open:#?}", open.len(), outcomes.len());
        assert!(20 * open.len() <= outcomes.len());
    }
}
