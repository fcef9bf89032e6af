#![allow(clippy::unwrap_used)]

use super::*;
use crate::samples::{mobile, revolute};
use crate::text::{Layout, render};

/// An arm of `n` links on the ground `L0`, with a motion for each on two branches.
fn arm(n: usize) -> Report {
    let mut report = mobile();
    let motion = report.motions[0].clone();
    let branch = report.branches.as_ref().unwrap()[0].clone();
    report.joints = (1..=n)
        .map(|i| {
            let links = [format!("L{}", i - 1), format!("L{i}")];
            revolute(&format!("J{i}"), [&links[0], &links[1]], false)
        })
        .collect();
    report.motions = ["A", "B"]
        .iter()
        .flat_map(|name| {
            let motion = motion.clone();
            (1..=n).map(move |i| Motion {
                branch: (*name).to_owned(),
                link: format!("L{i}"),
                relative_to: "L0".to_owned(),
                ..motion.clone()
            })
        })
        .collect();
    let second = crate::Branch {
        name: "B".to_owned(),
        ..branch.clone()
    };
    report.branches = Some(vec![branch, second]);
    report
}

fn section<'a>(page: &'a str, title: &str) -> &'a str {
    let (_, rest) = page.split_once(title).unwrap();
    rest.split("\n\n").next().unwrap()
}

#[test]
fn a_first_screen_shows_the_far_end_first() {
    let page = render(&arm(20), Layout::default());
    let motions = section(&page, "Motion, seen from L0");
    // Twelve motions, those of both branches in one row.
    let rows: Vec<&str> = motions.lines().skip(1).collect();
    assert_eq!(rows.len(), 7, "{motions}");
    assert!(
        rows[0].contains("L20") && rows[0].contains("A, B"),
        "{motions}"
    );
    assert!(
        rows[1].contains("L19") && rows[5].contains("L15"),
        "{motions}"
    );
    assert!(
        rows[6].contains("28 more") && rows[6].contains("all 40"),
        "{motions}"
    );
}

#[test]
fn the_end_of_a_side_chain_comes_before_links_farther_away() {
    let mut report = arm(20);
    report.joints.push(revolute("side", ["L1", "hand"], false));
    let hand = Motion {
        link: "hand".to_owned(),
        ..report.motions[0].clone()
    };
    report.motions.push(hand);
    let all: Vec<&Motion> = report.motions.iter().collect();
    let links: Vec<&str> = foremost(&report, all)
        .iter()
        .map(|m| m.link.as_str())
        .collect();
    assert_eq!(links[..4], ["L20", "L20", "hand", "L19"]);
}

#[test]
fn everything_is_shown_where_it_is_asked_for() {
    let layout = Layout {
        verbose: true,
        ..Layout::default()
    };
    let page = render(&arm(20), layout);
    assert_eq!(
        section(&page, "Motion (D19), seen from L0").lines().count(),
        42
    );
    let short = render(&arm(6), Layout::default());
    assert!(!section(&short, "Motion, seen from L0").contains("more"));
}

#[test]
fn one_branch_needs_no_column() {
    let page = render(&mobile(), Layout::default());
    assert!(!section(&page, "Motion, seen from B0").contains("branch"));
}

#[test]
fn pairs_asked_for_have_a_table_of_their_own() {
    let mut report = arm(20);
    report.motions[3].asked = true;
    let page = render(&report, Layout::default());
    let asked = section(&page, "Relative motions asked for");
    assert!(
        asked.contains("L4") && asked.lines().count() == 2,
        "{asked}"
    );
    assert!(section(&page, "\nMotion, seen from L0").contains("all 39"));
}

#[test]
fn half_branches_are_those_of_curves() {
    let mut report = arm(2);
    let layout = Layout {
        verbose: true,
        ..Layout::default()
    };
    let page = render(&report, layout);
    assert!(section(&page, "Motion branches through this pose (D8)").contains("half-branches"));
    for branch in report.branches.as_mut().unwrap() {
        branch.half_branches = None;
        branch.dimension = 2;
    }
    let page = render(&report, layout);
    assert!(!page.contains("half-branches"));
}

#[test]
fn joints_locked_on_some_branches_say_on_which() {
    let mut report = arm(3);
    report.branches.as_mut().unwrap()[1].locked = vec!["J2".to_owned()];
    let page = render(&report, Layout::default());
    let joints = section(&page, "\nJoints");
    assert!(
        joints.contains("in motion") && joints.contains("locked on B"),
        "{joints}"
    );
}

#[test]
fn every_engine_says_its_bounds() {
    let found = |bounds| Evidence {
        block: "J1".to_owned(),
        engine: "chart".to_owned(),
        scope: "a neighbourhood".to_owned(),
        bounds,
        text: "radius 0.1.".to_owned(),
    };
    for (bounds, text) in [
        ([Some(1), Some(1)], "finite mobility 1. radius 0.1"),
        ([Some(0), Some(2)], "finite mobility at most 2."),
        ([Some(1), Some(2)], "finite mobility 1 to 2."),
        ([Some(1), None], "finite mobility at least 1."),
        ([Some(0), None], "no bound."),
    ] {
        let sentence = finding(&found(bounds), false);
        assert!(
            sentence.starts_with("chart (a neighbourhood): ") && sentence.contains(text),
            "{sentence}"
        );
    }
    assert!(finding(&found([None, None]), true).starts_with("sub-mechanism `J1`, chart"));
    let mut report = mobile();
    assert!(!render(&report, Layout::default()).contains("Evidence"));
    report.evidence = Some(vec![found([Some(1), Some(1)])]);
    assert!(render(&report, Layout::default()).contains("Evidence\n  • chart"));
}
