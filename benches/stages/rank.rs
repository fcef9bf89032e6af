//! Rank decisions.

use super::cases::{ALL, ONE_LOOP, Standing};
use divan::{Bencher, black_box};
use kutzbach::closure::{Arithmetic, Geometry, positional_jacobian};
use kutzbach::matrix::decide;
use kutzbach::mobility::{Pose, Trial, generic_count, rank_part};

/// The freedom at the pose by `geometry`.
fn freedom(standing: &Standing, geometry: &Geometry<f64>) -> Option<usize> {
    let pose = Pose {
        mechanism: &standing.mechanism,
        configuration: None,
        held: &standing.held,
        geometry,
        states: &standing.assembly.states,
        as_drawn: standing.assembly.steps == 0,
        trial: Trial::default(),
    };
    standing
        .structure
        .parts
        .iter()
        .map(|part| {
            rank_part(&pose, part)
                .expect("coordinates are in range")
                .instantaneous
        })
        .sum()
}

/// The whole question of a one-loop mechanism: numbers to frames, Jacobian, rank with its margin.
#[divan::bench(args = ONE_LOOP)]
fn one_loop(bencher: Bencher, case: &str) {
    let standing = Standing::new(case);
    bencher.bench_local(|| {
        let geometry = Geometry::new(black_box(&standing.mechanism), None, &Arithmetic::double());
        freedom(&standing, &geometry)
    });
}

/// Jacobian and rank with its margin.
#[divan::bench(args = ALL, max_time = 2)]
fn at_pose(bencher: Bencher, case: &str) {
    let standing = Standing::new(case);
    bencher.bench_local(|| freedom(black_box(&standing), &standing.geometry));
}

/// The same in absolute coordinates, one twist per link.
#[divan::bench(args = ALL, max_time = 2)]
fn positional(bencher: Bencher, case: &str) {
    let standing = Standing::new(case);
    bencher.bench_local(|| {
        for part in &standing.structure.parts {
            let mut matrix = positional_jacobian(
                black_box(&standing.mechanism),
                &standing.geometry,
                &standing.assembly.states,
                part,
            )
            .expect("the part is the mechanism's own");
            matrix.scale_columns();
            black_box(decide(&matrix, 0.0).expect("coordinates are in range"));
        }
    });
}

/// The rank at random geometry, over a prime field.
#[divan::bench(args = ALL, max_time = 2)]
fn at_random_geometry(bencher: Bencher, case: &str) {
    let standing = Standing::new(case);
    bencher.bench_local(|| generic_count(black_box(&standing.mechanism), &standing.structure));
}
