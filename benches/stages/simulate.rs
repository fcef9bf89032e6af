//! Worlds of rigid bodies: building one, and stepping it.

use super::jobs::{self, SIMULATIONS};
use divan::Bencher;

#[divan::bench(args = SIMULATIONS, max_time = 2)]
fn build(bencher: Bencher, case: &str) {
    bencher.bench_local(jobs::built_world(case));
}

/// One step of a world that goes on. A scissor lift of a hundred stages is one tree of two hundred freedoms, whose dense mass
/// matrix is factored in each of four substeps.
#[divan::bench(args = SIMULATIONS, max_time = 2)]
fn step(bencher: Bencher, case: &str) {
    bencher.bench_local(jobs::stepped(case));
}
