//! Text to mechanism and back.

use super::cases::{ALL, mechanism, text};
use divan::{Bencher, black_box, counter::BytesCount};

#[divan::bench(args = ALL, max_time = 2)]
fn read(bencher: Bencher, case: &str) {
    let text = text(case);
    bencher
        .counter(BytesCount::of_str(&text))
        .bench_local(|| kutzbach::format::read(black_box(&text), case, &[]).map(|r| r.format));
}

#[divan::bench(args = ALL, max_time = 2)]
fn write(bencher: Bencher, case: &str) {
    let mechanism = mechanism(case);
    bencher.bench_local(|| kutzbach::format::write(black_box(&mechanism)));
}
