//! An analysis that is asked for less says the same as far as it goes, on every reference mechanism.
use crate::support;

use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, Depth, analyse};
use support::{assert_none, in_parallel, zoo};

fn differences(name: &str, mechanism: &Mechanism) -> Vec<String> {
    let at = |depth| {
        let options = AnalysisOptions {
            depth,
            ..AnalysisOptions::default()
        };
        analyse(mechanism, &options).unwrap()
    };
    let everything = at(Depth::Everything);
    let mut different = Vec::new();
    let mut compare = |what: &str, one: String, other: String| {
        if one != other {
            different.push(format!(
                "{name}: {what} is {one}, and {other} at full depth"
            ));
        }
    };
    let verdict = |a: &Analysis| {
        let m = &a.mobility;
        format!(
            "{:?}",
            (
                m.verdict,
                m.bounds,
                m.pose,
                m.kind,
                m.class,
                m.nominal.clone()
            )
        )
    };
    let branches = |a: &Analysis| {
        let all = a.branches.iter().flatten();
        let all: Vec<_> = all.map(|b| (&b.name, b.dimension, &b.roles)).collect();
        format!("{all:?}")
    };
    for depth in [Depth::Rank, Depth::Verdict, Depth::Motions] {
        let analysis = at(depth);
        compare(
            "home",
            format!("{:?}", analysis.home),
            format!("{:?}", everything.home),
        );
        if depth >= Depth::Verdict {
            compare("verdict", verdict(&analysis), verdict(&everything));
        }
        if depth == Depth::Motions {
            compare("branches", branches(&analysis), branches(&everything));
        }
        // Nothing that was not asked for.
        if analysis.generic.is_some() || !analysis.advice.is_empty() || !analysis.cycles.is_empty()
        {
            compare("detail", "there".to_owned(), "asked for".to_owned());
        }
    }
    different
}

#[test]
fn less_depth_says_the_same_as_far_as_it_goes() {
    let all = support::sample(zoo(), 3);
    let different = in_parallel(&all, |(name, mechanism)| differences(name, mechanism));
    assert_none(&different.concat());
}
