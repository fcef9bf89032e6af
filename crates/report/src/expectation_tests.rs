#![allow(clippy::unwrap_used)]

use super::*;
use crate::Branch;
use crate::samples::{joint, mobile, rigid, unassembled, undecided};

fn expect() -> Expectation {
    Expectation::default()
}

fn regular(locked: &[&str]) -> Expectation {
    Expectation {
        pose: Some("regular".to_owned()),
        locked: Some(locked.iter().map(|n| (*n).to_owned()).collect()),
        ..expect()
    }
}

fn wrong(report: &Report, expectation: &Expectation) -> Vec<&'static str> {
    compare(report, expectation)
        .wrong
        .into_iter()
        .map(|d| d.what)
        .collect()
}

#[test]
fn nothing_stated_is_nothing_compared() {
    assert_eq!(compare(&mobile(), &expect()), Comparison::default());
}

#[test]
fn stated_fields_are_compared() {
    let expectation = Expectation {
        finite: Some(1),
        instantaneous: Some(1),
        redundant: Some(3),
        kutzbach: Some(-2),
        pose: Some("regular".to_owned()),
        branches: Some(1),
        branch_dimensions: Some(vec![1]),
        idle: Some(Vec::new()),
        locked: Some(Vec::new()),
        kind: None,
    };
    let comparison = compare(&mobile(), &expectation);
    assert!(comparison.wrong.is_empty(), "{:?}", comparison.wrong);
    assert!(comparison.open.is_empty());
    assert_eq!(comparison.right.len(), 9);

    let expectation = Expectation {
        finite: Some(2),
        instantaneous: Some(2),
        redundant: Some(4),
        kutzbach: Some(1),
        pose: Some("singular".to_owned()),
        kind: Some("cusp".to_owned()),
        branches: Some(2),
        branch_dimensions: Some(vec![2, 1]),
        idle: Some(vec!["B2".to_owned()]),
        locked: Some(vec!["J1".to_owned()]),
    };
    assert_eq!(compare(&mobile(), &expectation).wrong.len(), 10);
}

#[test]
fn undecided_fields_are_open_unless_excluded() {
    let all = Expectation {
        finite: Some(1),
        pose: Some("singular".to_owned()),
        kind: Some("shaky".to_owned()),
        branches: Some(1),
        branch_dimensions: Some(vec![1]),
        idle: Some(vec!["B1".to_owned()]),
        ..expect()
    };
    let comparison = compare(&undecided(), &all);
    assert!(comparison.wrong.is_empty(), "{:?}", comparison.wrong);
    assert_eq!(comparison.open.len(), 6);

    let excluded = Expectation {
        finite: Some(2),
        ..expect()
    };
    let comparison = compare(&undecided(), &excluded);
    assert_eq!(comparison.wrong[0].found, "at most 1");
    let mut report = undecided();
    report.mobility.bounds = [Some(1), None];
    let excluded = Expectation {
        finite: Some(0),
        ..expect()
    };
    assert_eq!(compare(&report, &excluded).wrong[0].found, "at least 1");
    report.home.instantaneous = None;
    report.home.candidates = [1, 2];
    for (expected, outcome) in [(0, 1), (1, 0), (2, 0), (3, 1)] {
        let expectation = Expectation {
            instantaneous: Some(expected),
            ..expect()
        };
        assert_eq!(compare(&report, &expectation).wrong.len(), outcome);
    }
    report.home.redundant = None;
    for (expected, outcome) in [(2, 1), (3, 0), (4, 0), (5, 1), (-9, 1)] {
        let expectation = Expectation {
            redundant: Some(expected),
            ..expect()
        };
        assert_eq!(compare(&report, &expectation).wrong.len(), outcome);
    }
}

#[test]
fn a_mechanism_that_does_not_assemble_meets_no_expectation_of_a_pose() {
    let expectation = Expectation {
        finite: Some(1),
        instantaneous: Some(1),
        kutzbach: Some(-2),
        branches: Some(1),
        ..expect()
    };
    assert_eq!(
        wrong(&unassembled(), &expectation),
        ["instantaneous", "finite", "branches"]
    );
}

#[test]
fn whole_joints_are_compared_as_a_set() {
    let mut report = mobile();
    report.joints[2].locked = Some(true);
    assert_eq!(wrong(&report, &regular(&["J3"])), [""; 0]);
    assert_eq!(wrong(&report, &regular(&[])), ["locked"]);
    assert_eq!(wrong(&report, &regular(&["J3", "J4"])), ["locked"]);
    let found = compare(&report, &regular(&["J4"])).wrong.remove(0).found;
    assert_eq!(found, "J3");
}

#[test]
fn parts_are_compared_only_where_named() {
    let mut report = mobile();
    let mut sleeve = joint("J2", "C", "cylindrical", 2);
    sleeve.locked_parts = vec!["J2.rot".to_owned()];
    report.joints[1] = sleeve;
    assert_eq!(wrong(&report, &regular(&["J2.rot"])), [""; 0]);
    assert_eq!(wrong(&report, &regular(&[])), [""; 0]);
    assert_eq!(wrong(&report, &regular(&["J2.trans"])), ["locked"]);
    assert_eq!(wrong(&report, &regular(&["J2"])), ["locked"]);
    report.joints[1].locked = Some(true);
    assert_eq!(wrong(&report, &regular(&["J2.rot"])), ["locked"]);
    assert_eq!(wrong(&report, &regular(&["J2.rot", "J2.trans"])), [""; 0]);
}

#[test]
fn a_group_name_means_all_of_its_freedoms() {
    let mut report = mobile();
    let mut ball = joint("J2", "T·S", "point_on_line", 4);
    ball.locked_parts = vec!["J2.rot1".to_owned(), "J2.rot2".to_owned()];
    report.joints[1] = ball;
    assert_eq!(wrong(&report, &regular(&["J2.rot2"])), [""; 0]);
    assert_eq!(wrong(&report, &regular(&["J2.rot"])), ["locked"]);
    report.joints[1].locked_parts.push("J2.rot3".to_owned());
    assert_eq!(wrong(&report, &regular(&["J2.rot"])), [""; 0]);
}

#[test]
fn joint_names_may_hold_dots() {
    let mut report = mobile();
    report.joints[0].name = "arm.rot".to_owned();
    report.joints[0].locked = Some(true);
    assert_eq!(wrong(&report, &regular(&["arm.rot"])), [""; 0]);
}

#[test]
fn all_means_every_joint_that_has_a_freedom() {
    let mut report = mobile();
    report.joints.push(joint("weld", "E", "fixed", 0));
    for joint in &mut report.joints[..4] {
        joint.locked = Some(true);
    }
    report.joints[4].locked = None;
    assert_eq!(wrong(&report, &regular(&["all"])), [""; 0]);
    report.joints[0].locked = Some(false);
    assert_eq!(
        compare(&report, &regular(&["all"])).wrong[0].found,
        "all but J1"
    );
}

#[test]
fn locked_says_something_only_at_regular_poses_and_of_moving_mechanisms() {
    let mut report = rigid();
    assert_eq!(compare(&report, &regular(&["J1"])).right, [""; 0]);
    report.home.pose = Some(PoseKind::Regular);
    let mut expectation = regular(&[]);
    expectation.finite = Some(0);
    for joint in &mut report.joints {
        joint.locked = Some(true);
    }
    assert_eq!(compare(&report, &expectation).right, ["finite", "pose"]);
    report.home.pose = None;
    expectation = regular(&["J1", "J2", "J3"]);
    assert_eq!(compare(&report, &expectation).right, ["locked"]);
    expectation.pose = None;
    assert_eq!(compare(&report, &expectation).open, ["locked"]);
}

#[test]
fn idle_links_of_all_branches_are_compared() {
    let mut report = mobile();
    let idle = |link: &str| crate::Idle {
        links: vec![link.to_owned()],
        freedom: 1,
        rod: false,
    };
    let first = report.branches.as_ref().unwrap()[0].clone();
    report.branches = Some(vec![
        Branch {
            idle: vec![idle("B2")],
            ..first.clone()
        },
        Branch {
            idle: vec![idle("B1")],
            ..first
        },
    ]);
    let mut expectation = expect();
    expectation.idle = Some(vec!["B1".to_owned(), "B2".to_owned()]);
    assert_eq!(wrong(&report, &expectation), [""; 0]);
    expectation.idle = Some(vec!["B1".to_owned()]);
    assert_eq!(wrong(&report, &expectation), ["idle"]);
}

#[test]
fn dimensions_of_branches_are_a_set() {
    let mut report = mobile();
    let first = report.branches.as_ref().unwrap()[0].clone();
    let second = Branch {
        dimension: 2,
        ..first.clone()
    };
    let expecting = |dimensions: &[usize]| Expectation {
        branch_dimensions: Some(dimensions.to_vec()),
        ..expect()
    };
    report.branches = Some(vec![first.clone(), first.clone()]);
    assert_eq!(wrong(&report, &expecting(&[1])), [""; 0]);
    assert_eq!(wrong(&report, &expecting(&[1, 1])), [""; 0]);
    assert_eq!(wrong(&report, &expecting(&[2, 1])), ["branch_dimensions"]);
    report.branches = Some(vec![second, first.clone(), first]);
    assert_eq!(wrong(&report, &expecting(&[1, 2])), [""; 0]);
    let found = compare(&report, &expecting(&[1])).wrong.remove(0).found;
    assert_eq!(found, "1, 2");
    report.branches = Some(Vec::new());
    assert_eq!(wrong(&report, &expecting(&[])), [""; 0]);
}
