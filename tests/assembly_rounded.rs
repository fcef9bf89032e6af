//! Configurations of rounded numbers: whatever is proven of these holds of the exact ones that were rounded.

use crate::support;

use kutzbach::algebra::Limits;
use kutzbach::assembly::modes::{Complete, Configuration, Modes, Question, assembly_modes};
use kutzbach::mechanism::{JointId, Mechanism};
use kutzbach::number::Number;
use support::rewrite::Draft;
use support::{assert_none, in_parallel, zoo};

/// Time for each answer (s).
const TIME: f64 = 5.0;

fn answer(mechanism: &Mechanism, held: Option<Vec<(JointId, Number)>>) -> Modes {
    let question = Question {
        held,
        limits: Limits::seconds(TIME),
    };
    assembly_modes(mechanism, &question).unwrap()
}

/// Every number rounded to some decimals; whole ones get zeros.
fn rounded(mechanism: &Mechanism, decimals: usize) -> Mechanism {
    let round = |n: &Number| Number::decimal(&format!("{:.decimals$}", n.value())).unwrap();
    Draft::of(mechanism).each_number(&round).build()
}

/// How far two configurations are apart: the largest difference of a joint's value (rad, or parts of a size).
fn apart(one: &Configuration, other: &Configuration, size: f64) -> f64 {
    let pairs = one.joints.iter().zip(&other.joints);
    let differences = pairs.filter_map(|((_, a), (_, b))| Some((a.as_ref()?, b.as_ref()?)));
    let far = differences.flat_map(|(a, b)| {
        let each = a.iter().zip(b);
        each.map(|(x, y)| {
            let turn = (x - y).sin().hypot(1.0 - (x - y).cos());
            turn.min((x - y).abs() / size)
        })
        .collect::<Vec<_>>()
    });
    far.fold(0.0, f64::max)
}

/// What is wrong with the answer to the rounded mechanism; and whether it is complete.
fn compare(
    name: &str,
    exact: &Modes,
    mechanism: &Mechanism,
    decimals: usize,
) -> (bool, Vec<String>) {
    let other = rounded(mechanism, decimals);
    let found = answer(&other, Some(exact.held.clone()));
    if found.complete != Complete::Proven {
        return (false, Vec::new());
    }
    let mut wrong = Vec::new();
    for configuration in &exact.configurations {
        let all = found.configurations.iter();
        let nearest = all
            .map(|c| apart(configuration, c, 1.0))
            .fold(f64::INFINITY, f64::min);
        if nearest > 0.1 {
            wrong.push(format!(
                "{name}, {decimals} decimals: one is lost, {nearest} from the next"
            ));
        }
    }
    if found.configurations.len() > exact.configurations.len() {
        let (more, than) = (found.configurations.len(), exact.configurations.len());
        wrong.push(format!(
            "{name}, {decimals} decimals: {more} instead of {than}"
        ));
    }
    (true, wrong)
}

mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn proofs_for_rounded_numbers_hold_of_exact_ones() {
        let all: Vec<(String, Mechanism)> = support::sample(zoo(), 6);
        let found = in_parallel(&all, |(name, mechanism)| {
            let exact = answer(mechanism, None);
            let proven = exact.complete == Complete::Proven && !exact.configurations.is_empty();
            if !proven || exact.in_all.is_some() || exact.held.iter().any(|(_, at)| !at.is_zero()) {
                return (0, 0, Vec::new());
            }
            let each = [4, 6, 9].map(|decimals| compare(name, &exact, mechanism, decimals));
            let complete = each.iter().filter(|(complete, _)| *complete).count();
            (
                3,
                complete,
                each.into_iter().flat_map(|(_, wrong)| wrong).collect(),
            )
        });
        let asked: usize = found.iter().map(|f| f.0).sum();
        let complete: usize = found.iter().map(|f| f.1).sum();
        let wrong: Vec<String> = found.into_iter().flat_map(|f| f.2).collect();
        println!("{complete} of {asked} complete");
        assert_none(&wrong);
        assert!(
            asked >= support::at_least(60) && 3 * complete >= asked,
            "{complete} of {asked}"
        );
    }
}
