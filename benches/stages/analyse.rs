//! From a mechanism to everything the engines say about it.

use super::cases::{ALL, mechanism};
use divan::{Bencher, black_box};
use kutzbach::mobility::AnalysisOptions;

#[divan::bench(args = ALL, max_time = 4)]
fn analyse(bencher: Bencher, case: &str) {
    let mechanism = mechanism(case);
    let options = AnalysisOptions::default();
    bencher.bench_local(|| {
        kutzbach::mobility::analyse(black_box(&mechanism), &options).map(|a| a.kutzbach)
    });
}
