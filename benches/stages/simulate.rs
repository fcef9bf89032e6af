//! Worlds of rigid bodies: building one, and stepping it.

use super::jobs::{self, SIMULATIONS, STEPS};
use divan::Bencher;
use divan::counter::ItemsCount;

#[divan::bench(args = SIMULATIONS, max_time = 2)]
fn build(bencher: Bencher, case: &str) {
    bencher.bench_local(jobs::built_world(case));
}

/// A hundred steps, the world being built anew each time.
#[divan::bench(args = SIMULATIONS, max_time = 4)]
fn steps(bencher: Bencher, case: &str) {
    bencher
        .counter(ItemsCount::new(STEPS))
        .bench_local(jobs::simulated(case));
}
