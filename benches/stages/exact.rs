//! Polynomials over the rationals, and what they prove.

use super::jobs::{self, EXACTS};
use divan::Bencher;

#[divan::bench(args = EXACTS, max_time = 2)]
fn equations(bencher: Bencher, case: &str) {
    bencher.bench_local(jobs::exact_equations(case));
}

#[divan::bench(args = EXACTS, max_time = 4)]
fn answer(bencher: Bencher, case: &str) {
    bencher.bench_local(jobs::exact_answers(case));
}
