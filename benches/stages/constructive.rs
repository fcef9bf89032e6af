//! Planar sketches: the pebble game, the three analyses, and construction, on strips and on points tied to any two before.

use divan::{Bencher, black_box};
use kutzbach::constructive::analysis::{decompose, reduce, s_tree};
use kutzbach::constructive::construction::Construction;
use kutzbach::constructive::pebbles::PebbleGame;
use kutzbach::constructive::samples::{strip_sketch, tied_sketch};
use kutzbach::constructive::sketch::Sketch;

/// How many points, as strip and as points tied to any two before.
const CASES: [&str; 6] = [
    "strip 1000",
    "strip 10000",
    "strip 100000",
    "tied 1000",
    "tied 10000",
    "tied 100000",
];

fn sketch(case: &str) -> Sketch {
    let (kind, points) = case.split_once(' ').expect("two words");
    let points = points.parse().expect("a number");
    match kind {
        "strip" => strip_sketch(points),
        _ => tied_sketch(points),
    }
}

#[divan::bench(args = &CASES[..2], max_time = 2)]
fn pebble_game(bencher: Bencher, case: &str) {
    let sketch = sketch(case);
    bencher.bench_local(|| PebbleGame::play(black_box(sketch.graph())).freedoms());
}

#[divan::bench(args = CASES, max_time = 2)]
fn reduction(bencher: Bencher, case: &str) {
    let sketch = sketch(case);
    bencher.bench_local(|| reduce(black_box(sketch.graph())).solved);
}

#[divan::bench(args = CASES, max_time = 2)]
fn decomposition(bencher: Bencher, case: &str) {
    let sketch = sketch(case);
    bencher.bench_local(|| decompose(black_box(sketch.graph())).solved);
}

#[divan::bench(args = CASES, max_time = 2)]
fn splitting(bencher: Bencher, case: &str) {
    let sketch = sketch(case);
    bencher.bench_local(|| s_tree(black_box(sketch.graph())).solved);
}

/// From the sketch to the solution drawn, the order of construction included.
#[divan::bench(args = CASES, max_time = 2)]
fn construction(bencher: Bencher, case: &str) {
    let sketch = sketch(case);
    bencher.bench_local(|| {
        let construction = Construction::new(black_box(&sketch)).expect("constructive");
        construction.as_drawn().is_ok()
    });
}
