//! Singular poses: power series, and the branches that they show.

use super::jobs::{self, GERMS};
use divan::Bencher;

#[divan::bench(args = GERMS, max_time = 2)]
fn series(bencher: Bencher, case: &str) {
    bencher.bench_local(jobs::germ_series(case));
}

#[divan::bench(args = GERMS, max_time = 2)]
fn branches(bencher: Bencher, case: &str) {
    bencher.bench_local(jobs::germ_branches(case));
}
