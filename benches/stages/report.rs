//! From an analysed mechanism to text, to JSON, and to a page that moves.

use super::cases::{ALL, mechanism};
use divan::{Bencher, black_box};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::Analysis;
use kutzbach::report::html::{Assets, Facts, Prepared};
use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Input, Options, Report, analysed_report_on};

fn analysed(case: &str) -> (Mechanism, Report, Analysis) {
    let mechanism = mechanism(case);
    let input = Input {
        mechanism: &mechanism,
        file: case,
        format: "urdf",
        warnings: &[],
        skipped: &[],
    };
    let (report, analysis) =
        analysed_report_on(&input, &Options::default()).expect("the home pose exists");
    (mechanism, report, analysis)
}

fn report(case: &str) -> Report {
    analysed(case).1
}

#[divan::bench(args = ALL, max_time = 2)]
fn text(bencher: Bencher, case: &str) {
    let report = report(case);
    bencher.bench_local(|| render(black_box(&report), Layout::default()));
}

#[divan::bench(args = ALL, max_time = 2)]
fn text_with_every_row(bencher: Bencher, case: &str) {
    let report = report(case);
    let layout = Layout {
        verbose: true,
        ..Layout::default()
    };
    bencher.bench_local(|| render(black_box(&report), layout));
}

#[divan::bench(args = ALL, max_time = 2)]
fn json(bencher: Bencher, case: &str) {
    let report = report(case);
    bencher.bench_local(|| serde_json::to_string_pretty(black_box(&report)));
}

/// Cases whose motions are traced for a page.
const SHOWN: [&str; 4] = ["bennett", "stewart", "delta", "scissor 100"];

#[divan::bench(args = SHOWN, max_time = 5)]
fn motions_for_a_page(bencher: Bencher, case: &str) {
    let (mechanism, report, analysis) = analysed(case);
    let facts = facts(&mechanism, &report, &analysis);
    bencher.bench_local(|| Prepared::new(black_box(facts), Assets::Inside));
}

#[divan::bench(args = SHOWN, max_time = 2)]
fn page(bencher: Bencher, case: &str) {
    let (mechanism, report, analysis) = analysed(case);
    let prepared = Prepared::new(facts(&mechanism, &report, &analysis), Assets::Inside);
    bencher.bench_local(|| black_box(&prepared).page());
}

fn facts<'a>(mechanism: &'a Mechanism, report: &'a Report, analysis: &'a Analysis) -> Facts<'a> {
    Facts {
        mechanism,
        report,
        analysis,
        configuration: None,
        verification: None,
        accuracy: None,
    }
}
