//! What a page looks like. The snapshots are read by people: a change in one is a change of what an engineer sees.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::samples;
use crate::{Nominal, Stage, Timing, Verdict};

fn page(report: &crate::Report) -> String {
    render(report, Layout::default())
}

#[test]
fn mobile() {
    insta::assert_snapshot!(page(&samples::mobile()));
}

#[test]
fn mobile_verbose_with_times() {
    let mut report = samples::mobile();
    report.timing = Some(Timing {
        total_ms: 1.25,
        stages: vec![Stage {
            name: "rank".to_owned(),
            ms: 0.0625,
        }],
    });
    let layout = Layout {
        verbose: true,
        ..Layout::default()
    };
    insta::assert_snapshot!(render(&report, layout));
}

#[test]
fn rigid() {
    insta::assert_snapshot!(page(&samples::rigid()));
}

#[test]
fn undecided() {
    insta::assert_snapshot!(page(&samples::undecided()));
}

#[test]
fn unassembled() {
    insta::assert_snapshot!(page(&samples::unassembled()));
}

#[test]
fn large() {
    insta::assert_snapshot!(page(&samples::large()));
}

#[test]
fn hostile() {
    let page = page(&samples::hostile());
    assert!(!page.chars().any(|c| c.is_control() && c != '\n'));
    assert!(!page.contains('\u{202e}'));
    insta::assert_snapshot!(page);
}

#[test]
fn the_verdict_stands_first() {
    for (report, start) in [
        (samples::mobile(), "Mobile: 1 degree of freedom"),
        (samples::rigid(), "Rigid, but infinitesimally mobile"),
        (
            samples::undecided(),
            "Undecided: 0 to 1 degrees of freedom; 1 at this pose.",
        ),
        (samples::unassembled(), "No closing found"),
    ] {
        assert!(page(&report).starts_with(start), "{start}");
    }
}

#[test]
fn rounded_numbers_are_named_as_the_reason() {
    let mut report = samples::rigid();
    report.home.instantaneous = Some(0);
    report.mobility.verdict = Verdict::Rigid;
    report.mobility.nominal = Some(Nominal {
        finite: 1,
        tolerance: 3e-7,
        distance: None,
        known_to: None,
        within_digits: true,
        noise: false,
        changes: Vec::new(),
        relations: Vec::new(),
    });
    let page = page(&report);
    assert!(
        page.starts_with(
            "Rigid: 0 degrees of freedom, and no infinitesimal motion.\nAs written its loops miss by up to 300 nm along"
        ),
        "{page}"
    );
}

#[test]
fn no_line_is_wider_than_the_page_and_colour_adds_nothing_else() {
    for report in [
        samples::mobile(),
        samples::rigid(),
        samples::hostile(),
        samples::large(),
        samples::unassembled(),
    ] {
        for width in [72, 80, 100, 160] {
            let layout = Layout {
                width,
                ..Layout::default()
            };
            let plain = render(&report, layout);
            for line in plain.lines() {
                assert!(columns(line) <= width, "{width}: {line}");
                assert_eq!(line, line.trim_end());
            }
            let colored = render(
                &report,
                Layout {
                    color: true,
                    ..layout
                },
            );
            assert!(colored.contains("\u{1b}["));
            assert_eq!(without_colour(&colored), plain);
        }
    }
}

fn without_colour(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(start) = rest.find("\u{1b}[") {
        plain.push_str(&rest[..start]);
        let end = rest[start..].find('m').unwrap();
        rest = &rest[start + end + 1..];
    }
    plain + rest
}

#[test]
fn a_report_survives_json() {
    for report in [
        samples::mobile(),
        samples::rigid(),
        samples::undecided(),
        samples::unassembled(),
        samples::hostile(),
    ] {
        let json = serde_json::to_string(&report).unwrap();
        assert!(json.starts_with("{\"schema\":\"kutzbach-report-2\",\"mechanism\":"));
        let back: crate::Report = serde_json::from_str(&json).unwrap();
        assert_eq!(page(&back), page(&report));
        assert_eq!(back, report);
    }
}
