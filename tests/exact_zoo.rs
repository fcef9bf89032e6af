//! Every reference mechanism and every file of our own is asked exactly, within a second: it ends with an answer or with a
//! reason, and no answer contradicts what is known.

use crate::support;

use kutzbach::algebra::{Budget, ExactOptions, Formulation, Limits, SystemOptions, exact_answer};
use kutzbach::graph::ConstraintGraph;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::AnalysisOptions;
use kutzbach::mobility::analyse;
use serde_json::Value;
use std::fs;
use support::{assert_none, folder, in_parallel, own_mechanisms, zoo};

const SECONDS: f64 = 1.0;

/// How a question ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// Everything asked was answered.
    Answered,
    /// Some of it was, before time was over.
    Partly,
    /// There are no exact equations, and the reason is given.
    Refused,
}

/// What is wrong about the answer, and how it ended. `finite` is the mobility at the pose drawn, where it is known.
fn asked(
    name: &str,
    mechanism: &Mechanism,
    form: Formulation,
    finite: Option<usize>,
) -> (Vec<String>, End) {
    let options = ExactOptions {
        system: SystemOptions {
            formulation: form,
            ..SystemOptions::default()
        },
        ..ExactOptions::default()
    };
    let mut wrong = Vec::new();
    let answer = match exact_answer(mechanism, &options, &Budget::new(Limits::seconds(SECONDS))) {
        Ok(answer) => answer,
        Err(reason) => {
            if reason.to_string().is_empty() {
                wrong.push(format!("{name}: refused without a reason"));
            }
            return (wrong, End::Refused);
        }
    };
    let end = match answer.stopped {
        Some(_) => End::Partly,
        None => End::Answered,
    };
    if end == End::Answered && answer.dimension.is_none() {
        wrong.push(format!("{name}: neither an answer nor a reason"));
    }
    if let (Some(at_home), Some(dimension)) = (answer.dimension_at_home(), answer.dimension)
        && dimension < Some(at_home)
    {
        wrong.push(format!(
            "{name}: {at_home} at the pose, {dimension:?} in all"
        ));
    }
    // Real motions are among the complex ones. Decimals taken literally are another mechanism, and links that hang on
    // nothing have no variables in the forms that are used here.
    let graph = ConstraintGraph::of(mechanism);
    let loose = 6 * (graph.components().len() - 1);
    if let (Some(at_home), Some(finite)) = (answer.dimension_at_home(), finite)
        && at_home + loose < finite
        && !answer.system.rounded_numbers
    {
        wrong.push(format!(
            "{name}: complex dimension {at_home}, mobility {finite}"
        ));
    }
    if answer.system.home.exact().is_some() && answer.dimension == Some(None) {
        wrong.push(format!(
            "{name}: the drawn pose solves equations without a solution"
        ));
    }
    (wrong, end)
}

fn check(questions: &[(String, Mechanism, Formulation, Option<usize>)], least: usize) {
    let found = in_parallel(questions, |(name, mechanism, form, finite)| {
        asked(name, mechanism, *form, *finite)
    });
    let count = |wanted: End| found.iter().filter(|(_, end)| *end == wanted).count();
    println!(
        "{} answered, {} in part, {} refused",
        count(End::Answered),
        count(End::Partly),
        count(End::Refused)
    );
    assert_eq!(count(End::Refused), 0);
    assert!(count(End::Answered) >= support::at_least(least));
    let wrong: Vec<String> = found.into_iter().flat_map(|(wrong, _)| wrong).collect();
    assert_none(&wrong);
}

/// Too long for every commit.
mod corpus {
    use super::*;

    /// The mobility is compared with what the numeric engines say.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn our_own_files() {
        let questions: Vec<_> = support::sample(own_mechanisms(), 3)
            .into_iter()
            .map(|(name, mechanism)| {
                let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
                let finite = analysis.mobility.finite();
                (name, mechanism, Formulation::Canonical, finite)
            })
            .collect();
        check(&questions, 30);
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn the_zoo() {
        let text = fs::read_to_string(folder("tests/zoo/expected.json")).unwrap();
        let expected: Value = serde_json::from_str(&text).unwrap();
        let questions: Vec<_> = support::sample(zoo(), 3)
            .into_iter()
            .map(|(name, mechanism)| {
                let finite = expected[&name]["finite"].as_u64().map(|f| f as usize);
                (name, mechanism, Formulation::Tree, finite)
            })
            .collect();
        check(&questions, 30);
    }
}
