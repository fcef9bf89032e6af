//! Simulated motion beside predicted motion: steps of a world, one driven turn of a crank, traced poses, and a whole
//! verification.
//!
//! ```text
//! cargo bench -p kutzbach-benches --bench simulation             # everything, about a minute
//! cargo bench -p kutzbach-benches --bench simulation -- turn     # names that contain `turn`
//! ```
//!
//! How far the loops come open meanwhile is measured by `cargo run --release --example work_precision`, which shares the
//! mechanisms, drives and steps with this.

#[allow(dead_code)] // the example uses the rest
#[path = "../../examples/work_precision/measure.rs"]
mod measure;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use kutzbach::simulate::Solver;
use kutzbach::simulate::verification::{Unobserved, VerificationOptions, verify};
use measure::{Ready, SOLVERS, STEPS, SUBJECTS, Subject};
use std::fmt;

fn main() {
    divan::main();
}

/// A mechanism, how its tree is held, and its substeps.
#[derive(Clone, Copy)]
struct Case {
    subject: Subject,
    solver: (Solver, &'static str),
    substeps: usize,
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, solver) = (self.subject.name, self.solver.1);
        write!(f, "{name}, {solver}, {} substeps", self.substeps)
    }
}

fn cases(substeps: [usize; 3]) -> Vec<Case> {
    let mut cases = Vec::new();
    for subject in SUBJECTS {
        for solver in SOLVERS {
            cases.extend(substeps.map(|substeps| Case {
                subject,
                solver,
                substeps,
            }));
        }
    }
    cases
}

fn subject(name: &str) -> Ready {
    let known = SUBJECTS.into_iter().find(|subject| subject.name == name);
    Ready::new(known.expect("it is one of those measured")).expect("the file is sound")
}

/// One step of 1/240 s in the middle of the motion.
#[divan::bench(args = cases([1, 4, 16]), max_time = 1)]
fn step(bencher: Bencher, case: &Case) {
    let ready = Ready::new(case.subject).expect("the file is sound");
    let mut world = ready
        .world(case.solver.0, case.substeps)
        .expect("the options are in range");
    bencher
        .counter(ItemsCount::new(case.substeps))
        .bench_local(|| world.step().expect("it does not run away"));
}

/// The steps of one driven turn.
#[divan::bench(args = cases([4, 16, 64]), sample_count = 5)]
fn turn(bencher: Bencher, case: &Case) {
    let ready = Ready::new(case.subject).expect("the file is sound");
    bencher.counter(ItemsCount::new(STEPS)).bench_local(|| {
        ready
            .simulation_time(black_box(case.solver.0), case.substeps)
            .expect("it does not run away")
    });
}

/// Poses of all links along one traced turn, the curve being known.
#[divan::bench(args = ["four-bar", "Bennett"])]
fn poses(bencher: Bencher, name: &str) {
    let ready = subject(name);
    let mut curve = ready.curve().expect("it moves");
    bencher.counter(ItemsCount::new(STEPS)).bench_local(|| {
        ready
            .each_pose(black_box(&mut curve), STEPS, |links, _| {
                black_box(links);
            })
            .expect("the crank goes round");
    });
}

/// The same from the mechanism as read: mobility, curve, poses.
#[divan::bench(args = ["four-bar", "Bennett"])]
fn whole_trace(bencher: Bencher, name: &str) {
    let ready = subject(name);
    bencher
        .counter(ItemsCount::new(STEPS))
        .bench_local(|| ready.trace_time(STEPS).expect("the crank goes round"));
}

/// Putting the prediction to the test: ladders of substeps up to the rung that decides, and the count of freedoms.
#[divan::bench(args = ["four-bar", "Bennett"], sample_count = 5)]
fn verification(bencher: Bencher, name: &str) {
    let ready = subject(name);
    let options = VerificationOptions::default();
    bencher.bench_local(|| {
        verify(
            black_box(&ready.mechanism),
            &ready.geometry,
            &ready.analysis,
            &options,
            &mut Unobserved,
        )
        .expect("a world can be made of it")
    });
}
