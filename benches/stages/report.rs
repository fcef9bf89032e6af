//! From an analysed mechanism to a page or to JSON.

use super::cases::{ALL, mechanism};
use divan::{Bencher, black_box};
use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Input, Options, Report, report_on};

fn report(case: &str) -> Report {
    let mechanism = mechanism(case);
    let input = Input {
        mechanism: &mechanism,
        file: case,
        format: "urdf",
        warnings: &[],
        skipped: &[],
    };
    report_on(&input, &Options::default()).expect("the home pose exists")
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
