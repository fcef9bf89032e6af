//! Known mechanisms as every writer prints them.

use super::printing::{WRITERS, What, Writer};
use crate::support::rewrite::Draft;
use crate::support::{analysis, in_parallel, sample, zoo};
use kutzbach::matrix::SplitMix64;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::PoseKind;
use kutzbach::number::Number;
use std::collections::BTreeMap;

/// Of a hundred files of a writer so many may be left open.
const OPEN: usize = 15;

/// A mechanism as a writer prints it, read again.
fn printed(mechanism: &Mechanism, writer: &Writer, seed: u64) -> Mechanism {
    let mut random = SplitMix64::new(seed);
    let mut draft = Draft::of(mechanism);
    draft.poses.clear();
    let written = draft.each_number_of_a_kind(&mut |kind, number| {
        let what = [What::Length, What::Angle, What::Direction][kind];
        Number::decimal(&writer.number(what, number.value(), &mut random)).unwrap()
    });
    let text = kutzbach::format::write(&written.build());
    kutzbach::format::read(&text, "printed.urdf", &[])
        .unwrap()
        .mechanism
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn known_mechanisms_are_what_they_were() {
        let known = zoo().into_iter().filter_map(|(name, mechanism)| {
            let mobility = analysis(&mechanism).mobility;
            let regular = mobility.pose == Some(PoseKind::Regular);
            Some((name, mobility.finite().filter(|_| regular)?, mechanism))
        });
        let known: Vec<_> = known.collect();
        let cases = WRITERS
            .iter()
            .flat_map(|writer| known.iter().map(move |of| (writer, of)));
        let outcomes = in_parallel(&sample(cases, 12), |(writer, (name, finite, mechanism))| {
            let said = analysis(&printed(mechanism, writer, 1)).mobility.finite();
            (writer.name, name, *finite, said)
        });
        let mut table: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
        let mut wrong = Vec::new();
        for (writer, name, finite, said) in outcomes {
            let row = table.entry(writer).or_default();
            row[0] += usize::from(said.is_none());
            row[1] += 1;
            if said.is_none_or(|said| said != finite) {
                println!("{name}, {writer}: {said:?} instead of {finite}");
            }
            if said.is_some_and(|said| said != finite) {
                wrong.push(format!("{name}, {writer}: {said:?} instead of {finite}"));
            }
        }
        println!("writer: open, of\n{table:#?}");
        crate::support::assert_none(&wrong);
        for (writer, [open, of]) in table {
            assert!(
                100 * open <= OPEN * of.max(20),
                "{writer}: {open} of {of} are open"
            );
        }
    }
}
