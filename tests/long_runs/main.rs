//! Long runs: a driven Bennett linkage for a million steps, a scissor that swings under gravity, a Stewart platform that is
//! shaken. What they are held to, and why by so much, is in `examples/long_runs/claims.rs`.
//!
//! The record holds the runs at full length. Here the million steps are made again, and of every other long run the first
//! windows, which have to be the record's; the claims are then made of the record. That a claim can fail is shown by mechanisms
//! and drives for which it should.
mod crank_turns;
mod page_shows_the_record;
mod platform_is_shaken;
mod scissor_swings;

#[path = "../../examples/long_runs/claims.rs"]
mod claims;
#[path = "../../examples/long_runs/crank.rs"]
mod crank;
#[path = "../../examples/long_runs/figure.rs"]
mod figure;
#[path = "../../examples/long_runs/page.rs"]
mod page;
#[path = "../../examples/long_runs/record.rs"]
mod record;
#[allow(dead_code)] // the example makes all runs
#[path = "../../examples/long_runs/runs.rs"]
mod runs;
#[path = "../../examples/long_runs/scissor.rs"]
mod scissor;
#[path = "../../examples/long_runs/stewart.rs"]
mod stewart;
use crate::support;
#[path = "../../examples/long_runs/traced.rs"]
mod traced;
#[path = "../../examples/long_runs/watch.rs"]
mod watch;

use claims::{Claim, claims};
use kutzbach::simulate::Solver;
use record::{Record, Run};
use runs::{Setting, Subject};
use std::fs;
use support::folder;

fn kept() -> Record {
    let path = folder("benches/record/long_runs.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// The setting of the longest run of a subject with a solver.
fn setting(subject: Subject, solver: Solver) -> Setting {
    let mut settings = runs::settings().into_iter();
    let found = settings.find(|s| s.subject == subject && s.solver == solver);
    found.unwrap()
}

/// Makes the first windows of a long run, which have to be those of the record: the same input gives the same bits.
fn the_record_begins_like_that(subject: Subject, solver: Solver, windows: usize) -> Run {
    let setting = setting(subject, solver);
    let fresh = Run::new(&setting, &setting.seen(windows).unwrap());
    let kept = kept();
    let run = kept.long(subject, solver).unwrap();
    assert_eq!(
        (run.substeps, run.steps, run.windows()),
        (setting.substeps, setting.steps, setting.windows)
    );
    for (what, then, now) in [
        ("closure error", &run.seen.closure, &fresh.seen.closure),
        ("distance", &run.seen.distance, &fresh.seen.distance),
        ("energy", &run.seen.energy_mean, &fresh.seen.energy_mean),
    ] {
        let size = now.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        for (index, (then, now)) in then.iter().zip(now).enumerate() {
            assert!(
                (then - now).abs() <= 1e-3 * size,
                "{subject:?}, {solver:?}, {what}, window {index}: {then:e} in the record, {now:e} now; to measure anew: see \
                 examples/long_runs"
            );
        }
    }
    fresh
}

/// The claims that do not hold.
fn broken(run: &Run) -> Vec<Claim> {
    claims(run).into_iter().filter(|c| !c.holds()).collect()
}
