//! Files that the program writes are read again, and give what was said of them.

use crate::support;

use kutzbach::format::{read, write};
use kutzbach::mechanism::{Mechanism, Placement};
use kutzbach::mobility::{Analysis, AnalysisOptions, Depth, Verdict, analyse};
use kutzbach::report::{ASSEMBLED, assembled_file};
use support::{at_least, in_parallel, own_mechanisms, sample, zoo};

fn analysed(mechanism: &Mechanism, at: Option<&str>) -> Analysis {
    let options = AnalysisOptions {
        configuration: at.map(str::to_owned),
        depth: Depth::Motions,
        ..AnalysisOptions::default()
    };
    analyse(mechanism, &options).unwrap()
}

/// What is said of a mechanism, to be the same of the file.
fn facts(analysis: &Analysis) -> (Verdict, Option<usize>, Option<usize>, Option<i64>) {
    let home = analysis.home.as_ref();
    (
        analysis.mobility.verdict,
        analysis.mobility.finite(),
        home.and_then(|home| home.instantaneous),
        home.and_then(|home| home.redundant),
    )
}

fn drawn(one_in: u64) -> Vec<(String, Mechanism)> {
    sample(own_mechanisms().into_iter().chain(zoo()), one_in)
}

#[test]
fn what_was_assembled_has_the_mobility_that_was_told() {
    let told = in_parallel(&drawn(5), |(name, mechanism)| {
        let before = analysed(mechanism, None);
        let Some(file) = assembled_file(mechanism, &before.assembly, &Default::default()) else {
            return (Vec::new(), 0);
        };
        let again = match read(&file, name, &[]) {
            Ok(reading) => reading.mechanism,
            Err(error) => return (vec![format!("{name}: {error}")], 1),
        };
        let after = analysed(&again, Some(ASSEMBLED));
        let mut wrong = Vec::new();
        if !after.assembly.closed {
            wrong.push(format!("{name}: the pose written does not close"));
        }
        if facts(&before) != facts(&after) {
            let [before, after] = [&before, &after].map(facts);
            wrong.push(format!("{name}: {before:?}, read again {after:?}"));
        }
        (wrong, 1)
    });
    let count: usize = told.iter().map(|(_, count)| count).sum();
    assert!(count >= at_least(200), "{count}");
    support::assert_none(
        &told
            .into_iter()
            .flat_map(|(wrong, _)| wrong)
            .collect::<Vec<_>>(),
    );
}

#[test]
fn what_is_written_back_has_the_mobility_that_was_told() {
    let told = in_parallel(&drawn(7), |(name, mechanism)| {
        let again = match read(&write(mechanism), name, &[]) {
            Ok(reading) => reading.mechanism,
            Err(error) => return Some(format!("{name}: {error}")),
        };
        let [before, after] = [mechanism, &again].map(|one| facts(&analysed(one, None)));
        (before != after).then(|| format!("{name}: {before:?}, read again {after:?}"))
    });
    support::assert_none(&told.into_iter().flatten().collect::<Vec<_>>());
}
#[test]
fn the_nearest_mechanism_is_one_that_moves_as_told() {
    use support::exported::exported;
    let floats = |mechanism: &Mechanism| {
        let mut links = mechanism.links().iter();
        links.any(|link| matches!(link.placement, Placement::Floating { .. }))
    };
    let drawn: Vec<_> = drawn(14)
        .into_iter()
        .filter(|(_, one)| !floats(one))
        .collect();
    let told = in_parallel(&drawn, |(name, mechanism)| {
        let rounded = exported(mechanism, 3, 2);
        let nearest = analysed(&rounded, None).nearest?;
        let again = match read(&write(&nearest.mechanism), name, &[]) {
            Ok(reading) => reading.mechanism,
            Err(error) => return Some(Some(format!("{name}: {error}"))),
        };
        let after = facts(&analysed(&again, None));
        Some((after.0 != Verdict::Mobile).then(|| format!("{name}: {after:?}")))
    });
    let told: Vec<Option<String>> = told.into_iter().flatten().collect();
    assert!(told.len() >= at_least(20), "{}", told.len());
    support::assert_none(&told.into_iter().flatten().collect::<Vec<_>>());
}
