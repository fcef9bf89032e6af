//! Measuring every setting, errors and times.

use super::measure::{POSES, Ready, Result, SOLVERS, SUBJECTS, SUBSTEPS};
use super::record::{Record, Simulation, Trace};
use std::time::Instant;

/// Wall times are the best of so many rounds over all settings: what else the machine does only adds to them.
pub const ROUNDS: usize = 9;

/// In a round, what takes less than this (s) is run again until it is over.
const SHORT: f64 = 0.05;

/// Measures every setting: the errors once, the times in rounds over all settings, so that a slow minute of the machine
/// does not fall on one of them alone. `tell` is called before each round.
pub fn measure(date: &str, machine: &str, mut tell: impl FnMut(&str)) -> Result<Record> {
    tell("errors");
    let all = SUBJECTS
        .into_iter()
        .map(Ready::new)
        .collect::<Result<Vec<Ready>>>()?;
    let mut record = errors(&all)?;
    record.date = date.to_owned();
    record.machine = machine.to_owned();
    for round in 1..=ROUNDS {
        tell(&format!("times, round {round} of {ROUNDS}"));
        times(&mut record, &all)?;
    }
    Ok(record)
}

/// All rows without times.
fn errors(all: &[Ready]) -> Result<Record> {
    let mut record = Record {
        date: String::new(),
        machine: String::new(),
        rounds: ROUNDS,
        simulations: Vec::new(),
        traces: Vec::new(),
    };
    for ready in all {
        for (solver, solver_name) in SOLVERS {
            for substeps in SUBSTEPS {
                let shown = ready.simulate(solver, substeps)?;
                record.simulations.push(Simulation {
                    mechanism: ready.subject.name.to_owned(),
                    solver: solver_name.to_owned(),
                    substeps,
                    closure_error: digits(shown.closure_error),
                    distance: digits(shown.distance),
                    turned: digits(shown.turned),
                    wall_time: f64::INFINITY,
                });
            }
        }
        for poses in POSES {
            let traced = ready.trace(poses)?;
            record.traces.push(Trace {
                mechanism: ready.subject.name.to_owned(),
                poses,
                closure_error: digits(traced.closure_error),
                equations: digits(traced.equations),
                wall_time: f64::INFINITY,
                poses_per_second: 0.0,
            });
        }
    }
    Ok(record)
}

/// Times every setting once more; the best times stay.
fn times(record: &mut Record, all: &[Ready]) -> Result<()> {
    let of = |name: &str| -> Result<&Ready> {
        let ready = all.iter().find(|ready| ready.subject.name == name);
        Ok(ready.ok_or("a row of no mechanism")?)
    };
    for row in &mut record.simulations {
        let ready = of(&row.mechanism)?;
        let solver = SOLVERS.into_iter().find(|(_, name)| *name == row.solver);
        let (solver, _) = solver.ok_or("a row of no solver")?;
        again_and_again(|| {
            let time = ready.simulation_time(solver, row.substeps)?;
            row.wall_time = row.wall_time.min(digits(time));
            Ok(())
        })?;
    }
    for row in &mut record.traces {
        let ready = of(&row.mechanism)?;
        again_and_again(|| {
            let time = ready.trace_time(row.poses)?;
            row.wall_time = row.wall_time.min(digits(time.whole));
            let speed = row.poses as f64 / time.poses;
            row.poses_per_second = row.poses_per_second.max(digits(speed));
            Ok(())
        })?;
    }
    Ok(())
}

/// Four digits: more are noise, in times at least.
fn digits(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// Runs once, and again while little time has gone.
fn again_and_again(mut run: impl FnMut() -> Result<()>) -> Result<()> {
    let begun = Instant::now();
    loop {
        run()?;
        if begun.elapsed().as_secs_f64() >= SHORT {
            return Ok(());
        }
    }
}
