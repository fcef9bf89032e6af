//! Whether a pose is regular.

use super::jobs::{self, CHARTS};
use divan::Bencher;

/// Kernel and chart test, the rank being known.
#[divan::bench(args = CHARTS, max_time = 2)]
fn test(bencher: Bencher, case: &str) {
    bencher.bench_local(jobs::chart(case));
}
