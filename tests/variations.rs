//! Mechanisms whose answers follow from those of others: relatives of the reference mechanisms in other dimensions, and
//! the reference mechanisms themselves put together, taken apart and added to.
//!
//! An answer that contradicts what is known fails. An answer that stays open is counted, and the short list of those is
//! part of the test, so that it can only change on purpose.

use crate::support;

use kutzbach::mechanism::{JointKind, Mechanism};
use kutzbach::mobility::{Analysis, AnalysisOptions, PoseKind, Verdict, analyse};
use kutzbach::number::Number;
use std::sync::OnceLock;
use support::combine;
use support::drawn::{self, Drawn, Known};
use support::rewrite::Draft;
use support::{analysis, assert_none, in_parallel, sample, zoo};

/// What an answer lacks, and what in it is wrong.
#[derive(Default)]
struct Outcome {
    open: bool,
    wrong: Vec<String>,
}

fn dimensions(analysis: &Analysis) -> Option<Vec<usize>> {
    let mut dimensions: Vec<usize> = analysis
        .branches
        .as_ref()?
        .iter()
        .map(|branch| branch.dimension)
        .collect();
    dimensions.sort_unstable_by(|a, b| b.cmp(a));
    Some(dimensions)
}

fn compared(name: &str, mechanism: &Mechanism, known: &Known) -> Outcome {
    compared_with(name, &analysis(mechanism), known)
}

fn compared_with(name: &str, analysis: &Analysis, known: &Known) -> Outcome {
    let mut outcome = Outcome::default();
    let mut compare = |what: &str, found: Option<String>, expected: String| match found {
        None => outcome.open = true,
        Some(found) if found == expected => {}
        Some(found) => outcome
            .wrong
            .push(format!("{name}: {what} is {found}, expected {expected}")),
    };
    let home = analysis.home.as_ref();
    let word = |regular: bool| if regular { "regular" } else { "singular" }.to_owned();
    compare(
        "the count",
        Some(analysis.kutzbach.to_string()),
        known.kutzbach.to_string(),
    );
    compare(
        "instantaneous",
        home.and_then(|h| h.instantaneous).map(|n| n.to_string()),
        known.instantaneous.to_string(),
    );
    compare(
        "finite",
        analysis.mobility.finite().map(|n| n.to_string()),
        known.finite.to_string(),
    );
    compare(
        "the pose",
        analysis.mobility.pose.map(|p| word(p == PoseKind::Regular)),
        word(known.regular),
    );
    if let Some(kind) = &known.kind
        && let Some(found) = analysis.mobility.kind
    {
        compare("kind", Some(found.word().to_owned()), kind.clone());
    }
    if let Some(branches) = known.branches {
        let found = analysis.branches.as_ref().map(|b| b.len().to_string());
        compare("branches", found, branches.to_string());
    }
    if let Some(expected) = &known.dimensions {
        let found = dimensions(analysis).map(|d| format!("{d:?}"));
        compare("dimensions", found, format!("{expected:?}"));
    }
    let (low, high) = analysis.mobility.bounds;
    if low.is_some_and(|low| low > known.finite)
        || high.is_some_and(|high| high < known.finite)
        || analysis.mobility.verdict == Verdict::Unassembled
    {
        outcome.wrong.push(format!(
            "{name}: finite between {low:?} and {high:?}, expected {}",
            known.finite
        ));
    }
    outcome
}

/// Fails on wrong answers, and where the open ones are not those expected.
fn assert_answers(outcomes: Vec<(String, Outcome)>, expected_open: &[&str]) {
    let mut wrong = Vec::new();
    let mut open = Vec::new();
    for (name, outcome) in outcomes {
        if outcome.open {
            open.push(name);
        }
        wrong.extend(outcome.wrong);
    }
    assert_none(&wrong);
    assert_eq!(open, expected_open, "answers that stay open");
}

/// A reference mechanism with its own answer, which `tests/zoo.rs` compares with what is known.
struct Base {
    name: String,
    draft: Draft,
    known: Known,
}

/// The reference mechanisms, analysed once for all tests.
fn bases() -> &'static [Base] {
    static BASES: OnceLock<Vec<Base>> = OnceLock::new();
    BASES.get_or_init(analysed)
}

fn analysed() -> Vec<Base> {
    in_parallel(&sample(zoo(), 3), |(name, mechanism)| {
        let analysis = analysis(mechanism);
        Base {
            name: name.clone(),
            draft: Draft::of(mechanism),
            known: Known {
                finite: analysis.mobility.finite().unwrap(),
                instantaneous: analysis.home.as_ref().unwrap().instantaneous.unwrap(),
                kutzbach: analysis.kutzbach,
                regular: analysis.mobility.pose == Some(PoseKind::Regular),
                kind: None,
                branches: None,
                dimensions: dimensions(&analysis),
            },
        }
    })
}

/// The known answer with `more` freedoms on every branch. A rigid mechanism has no branch, and with a freedom added one.
fn more_free(known: &Known, more: usize, count: i64) -> Known {
    let dimensions = known.dimensions.as_ref().map(|dimensions| {
        if dimensions.is_empty() {
            vec![more; usize::from(more > 0)]
        } else {
            dimensions.iter().map(|d| d + more).collect()
        }
    });
    Known {
        finite: known.finite + more,
        instantaneous: known.instantaneous + more,
        kutzbach: known.kutzbach + count,
        regular: known.regular,
        kind: None,
        branches: None,
        dimensions,
    }
}

/// A change of a mechanism: the new one, freedoms added, and what is added to the count. `None` where it does not apply.
type Change = fn(&Base) -> Option<(Draft, usize, i64)>;

fn check_change(change: Change, expected_open: &[&str]) {
    let outcomes = in_parallel(bases(), |base| {
        let outcome = change(base).map_or_else(Outcome::default, |(draft, more, count)| {
            let known = more_free(&base.known, more, count);
            compared(&base.name, &draft.build(), &known)
        });
        (base.name.clone(), outcome)
    });
    assert_answers(outcomes, expected_open);
}

/// The last link of a mechanism; it mostly moves.
fn last_link(draft: &Draft) -> String {
    draft.links.last().unwrap().clone()
}

#[test]
fn cutting_links_and_welding_them_changes_nothing() {
    check_change(
        |base| Some((combine::with_links_cut(base.draft.clone()), 0, 0)),
        &[],
    );
}

#[test]
fn joints_taken_apart_into_hinges_and_slides_change_nothing() {
    check_change(
        |base| combine::with_simple_joints(base.draft.clone()).map(|draft| (draft, 0, 0)),
        &[],
    );
}

fn product(first: &Known, second: &Known) -> Known {
    // A rigid mechanism is a point: one factor of dimension zero, which makes no branch by itself.
    let or_point = |known: &Known| {
        let dimensions = known.dimensions.clone()?;
        Some(if dimensions.is_empty() {
            vec![0]
        } else {
            dimensions
        })
    };
    let dimensions = or_point(first).zip(or_point(second)).map(|(a, b)| {
        let mut all: Vec<usize> = a
            .iter()
            .flat_map(|x| b.iter().map(move |y| x + y))
            .collect();
        all.sort_unstable_by(|x, y| y.cmp(x));
        all.retain(|&d| d > 0);
        all
    });
    Known {
        finite: first.finite + second.finite,
        instantaneous: first.instantaneous + second.instantaneous,
        kutzbach: first.kutzbach + second.kutzbach,
        regular: first.regular && second.regular,
        kind: None,
        branches: None,
        dimensions,
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn relatives_of_the_reference_mechanisms() {
        let drawn: Vec<Drawn> = drawn::read(include_str!("variations/families.txt"));
        assert!(drawn.len() >= 160, "found {}", drawn.len());
        let outcomes = in_parallel(&drawn, |drawn| {
            let outcome = compared(&drawn.name, &drawn.mechanism(), &drawn.known);
            (drawn.name.clone(), outcome)
        });
        assert_answers(outcomes, &[]);
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_second_hinge_on_the_same_line_changes_nothing() {
        check_change(
            |base| {
                let draft = combine::with_double_hinges(base.draft.clone());
                let added = draft.joints.len() - base.draft.joints.len();
                Some((draft, 0, -5 * added as i64))
            },
            &[],
        );
    }

    /// One joint a little way along the motion, the others following to where they close: a regular pose goes over into regular
    /// poses of the same freedom. The numbers of the pose are no exact ones.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn another_pose_of_the_same_branch_has_the_same_freedom() {
        let bases = bases();
        let outcomes = in_parallel(bases, |base| {
            let mechanism = base.draft.build();
            let home = analysis(&mechanism);
            let driver = mechanism
                .joints()
                .iter()
                .zip(&home.roles)
                .find(|(joint, role)| {
                    joint.kind == JointKind::Revolute
                        && !joint.closes_loop
                        && role.locked == Some(false)
                });
            let Some((driver, _)) = driver.filter(|_| base.known.regular) else {
                return (base.name.clone(), Outcome::default());
            };
            // A joint may stand at the end of its range: then it goes the other way only.
            let there = ["0.0512345678901", "-0.0512345678901"].map(|value| {
                let mut draft = base.draft.clone();
                draft.hold_at("moved", &driver.name, Number::decimal(value).unwrap());
                let options = AnalysisOptions {
                    configuration: Some("moved".to_owned()),
                    ..AnalysisOptions::default()
                };
                analyse(&draft.build(), &options).unwrap()
            });
            let assembled = there.iter().find(|there| there.assembly.closed);
            let known = more_free(&base.known, 0, 0);
            let outcome = compared_with(&base.name, assembled.unwrap_or(&there[0]), &known);
            (base.name.clone(), outcome)
        });
        assert_answers(outcomes, &[]);
    }

    /// Two mechanisms that share one link: freedoms add, and every branch of one goes with every branch of the other.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn two_mechanisms_on_one_link_multiply_their_branches() {
        let bases = bases();
        let pairs: Vec<(&Base, &Base, bool)> = (0..bases.len())
            .map(|first| {
                let second = (first * 37 + 11) % bases.len();
                (&bases[first], &bases[second], first % 2 == 0)
            })
            .collect();
        let outcomes = in_parallel(&pairs, |(first, second, side_by_side)| {
            let carrier = if *side_by_side {
                first.draft.ground.clone()
            } else {
                last_link(&first.draft)
            };
            let draft = combine::mounted(first.draft.clone(), &carrier, second.draft.clone());
            let name = format!("{} and {}", first.name, second.name);
            let outcome = compared(&name, &draft.build(), &product(&first.known, &second.known));
            (name, outcome)
        });
        assert_answers(outcomes, &[]);
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_pendulum_adds_one_freedom() {
        check_change(
            |base| {
                let carrier = last_link(&base.draft);
                let draft = combine::with_pendulum(base.draft.clone(), &carrier);
                Some((draft, 1, 1))
            },
            &[],
        );
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_rod_between_two_balls_in_one_link_spins() {
        check_change(
            |base| {
                let carrier = last_link(&base.draft);
                let draft = combine::with_idle_rod(base.draft.clone(), &carrier);
                Some((draft, 1, 0))
            },
            &[],
        );
    }
}
