//! Rows of a sweep, and the same members as files by themselves; a run is of one member.

use super::cases::FAMILIES;
use super::jobs::{file, row};
use divan::Bencher;
use kutzbach::mobility::Depth;

#[divan::bench(args = FAMILIES, max_time = 4)]
fn rank_of_a_row(bencher: Bencher, case: &str) {
    bencher.bench_local(row(case, Depth::Rank));
}

#[divan::bench(args = FAMILIES, max_time = 4)]
fn rank_of_a_file(bencher: Bencher, case: &str) {
    bencher.bench_local(file(case, Depth::Rank));
}

#[divan::bench(args = FAMILIES, max_time = 4)]
fn verdict_of_a_row(bencher: Bencher, case: &str) {
    bencher.bench_local(row(case, Depth::Verdict));
}

#[divan::bench(args = FAMILIES, max_time = 4)]
fn verdict_of_a_file(bencher: Bencher, case: &str) {
    bencher.bench_local(file(case, Depth::Verdict));
}
