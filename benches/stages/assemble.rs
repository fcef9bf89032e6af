//! Numbers to frames, frames to the closure equations, and closing them.

use super::cases::{ALL, Standing};
use divan::{Bencher, black_box};
use kutzbach::closure::{Arithmetic, Geometry};

#[divan::bench(args = ALL, max_time = 2)]
fn geometry(bencher: Bencher, case: &str) {
    let standing = Standing::new(case);
    bencher
        .bench_local(|| Geometry::new(black_box(&standing.mechanism), None, &Arithmetic::double()));
}

#[divan::bench(args = ALL, max_time = 2)]
fn assemble(bencher: Bencher, case: &str) {
    let standing = Standing::new(case);
    bencher.bench_local(|| {
        kutzbach::closure::assemble(
            black_box(&standing.mechanism),
            &standing.geometry,
            &standing.structure.parts,
            &standing.held,
        )
        .map(|assembly| assembly.closed)
    });
}

#[divan::bench(args = ALL, max_time = 2)]
fn jacobian(bencher: Bencher, case: &str) {
    let standing = Standing::new(case);
    bencher.bench_local(|| {
        for part in &standing.structure.parts {
            black_box(
                kutzbach::closure::jacobian(
                    black_box(&standing.mechanism),
                    &standing.geometry,
                    &standing.assembly.states,
                    part,
                )
                .expect("the part is the mechanism's own"),
            );
        }
    });
}
