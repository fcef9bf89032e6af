//! One driven turn, simulated and traced: the closure error falls as the book says, and the book's figures are those of the
//! program as it is now. No seconds are asserted.
#[path = "../examples/work_precision/figure.rs"]
mod figure;
#[allow(dead_code)] // the example takes the times
#[path = "../examples/work_precision/measure.rs"]
mod measure;
#[path = "../examples/work_precision/page.rs"]
mod page;
#[path = "../examples/work_precision/record.rs"]
mod record;
use crate::support;

use kutzbach::simulate::verification::{largest_gap, order_between};
use kutzbach::simulate::{Drive, Solver};
use measure::{POSES, Ready, SOLVERS, STEP_RATE, STEPS, SUBJECTS, SUBSTEPS, Shown};
use record::Record;
use std::f64::consts::TAU;
use std::fs;
use std::sync::OnceLock;
use support::{folder, in_parallel};

/// The coarse settings, which are quick.
const COARSE: [usize; 3] = [2, 4, 8];

/// Every mechanism with every solver at every coarse setting: indices, and what the turn shows.
fn fresh() -> &'static [(usize, usize, usize, Shown)] {
    static FRESH: OnceLock<Vec<(usize, usize, usize, Shown)>> = OnceLock::new();
    FRESH.get_or_init(|| {
        let mut settings = Vec::new();
        for subject in 0..SUBJECTS.len() {
            for solver in 0..SOLVERS.len() {
                settings.extend(COARSE.map(|substeps| (subject, solver, substeps)));
            }
        }
        in_parallel(&settings, |&(subject, solver, substeps)| {
            let ready = Ready::new(SUBJECTS[subject]).unwrap();
            let shown = ready.simulate(SOLVERS[solver].0, substeps).unwrap();
            (subject, solver, substeps, shown)
        })
    })
}

fn kept() -> Record {
    let path = folder("benches/record/work_precision.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn the_page() -> String {
    fs::read_to_string(folder("docs/src/work_precision.md")).unwrap()
}

/// What a substep overlooks is quadratic in its motion. Terms of third order are a few percent at these settings.
#[test]
fn the_closure_error_falls_at_order_two() {
    for pair in fresh().windows(2) {
        let [(subject, solver, n, coarse), (_, _, more, fine)] = pair else {
            continue;
        };
        if more < n {
            continue;
        }
        for (coarse, fine) in [
            (coarse.closure_error, fine.closure_error),
            (coarse.distance, fine.distance),
        ] {
            let order = order_between((*n, coarse), (*more, fine)).unwrap();
            let name = SUBJECTS[*subject].name;
            assert!(
                (1.9..=2.1).contains(&order),
                "{name}, {}, {n} to {more} substeps: {order}",
                SOLVERS[*solver].1
            );
        }
    }
}

#[test]
fn the_crank_goes_all_the_way_round_beside_the_prediction() {
    for (subject, solver, substeps, shown) in fresh() {
        let name = SUBJECTS[*subject].name;
        let what = format!("{name}, {}, {substeps}: {shown:?}", SOLVERS[*solver].1);
        let wanted = STEPS as f64 / STEP_RATE;
        assert!(wanted >= TAU && wanted - TAU < 1.0 / STEP_RATE);
        assert!((shown.turned - wanted).abs() < 1e-2, "{what}");
        assert!(shown.distance < 4.0 * shown.closure_error, "{what}");
    }
}

/// Twice as fast with twice the substeps is the same motion: the book says that the angle of a substep is what counts.
#[test]
fn the_angle_of_a_substep_is_what_counts() {
    for subject in SUBJECTS {
        let ready = Ready::new(subject).unwrap();
        for (solver, name) in SOLVERS {
            let worst = |speed: f64, substeps: usize| {
                let mut world = ready.world(solver, substeps).unwrap();
                let rates: Vec<Vec<f64>> = ready
                    .rates
                    .iter()
                    .map(|rates| rates.iter().map(|rate| speed * rate).collect())
                    .collect();
                world.set_rates(&rates).unwrap();
                let drive = Drive {
                    joint: ready.crank,
                    freedom: 0,
                    velocity: speed,
                    largest_force: f64::INFINITY,
                };
                world.drive(drive).unwrap();
                let mut worst = 0.0f64;
                for _ in 0..STEPS / speed as usize {
                    world.step().unwrap();
                    worst = worst.max(ready.closure_error(&world.link_poses()));
                }
                worst
            };
            let (slow, fast) = (worst(1.0, 2), worst(2.0, 4));
            // A fast step looks at every second place of a slow one.
            let same = (fast / slow - 1.0).abs() < 0.02;
            assert!(same, "{}, {name}: {slow:e}, {fast:e}", subject.name);
        }
    }
}

/// The loops close to rounding: 1e-12 is what a trace promises.
#[test]
fn a_trace_closes_to_rounding_at_every_pose() {
    for subject in SUBJECTS {
        let ready = Ready::new(subject).unwrap();
        for poses in POSES {
            let traced = ready.trace(poses).unwrap();
            assert!(
                traced.closure_error <= 1e-12,
                "{}: {traced:?}",
                subject.name
            );
            assert!(traced.equations <= 1e-12, "{}: {traced:?}", subject.name);
        }
    }
}

/// Traces and simulations are measured by one function; for a world it says what the world itself says.
#[test]
fn gaps_are_measured_as_the_world_measures_them() {
    for subject in SUBJECTS {
        let ready = Ready::new(subject).unwrap();
        let mut world = ready.world(Solver::Impulse, 1).unwrap();
        for _ in 0..300 {
            world.step().unwrap();
        }
        let own = largest_gap(&world.gaps(), ready.length);
        assert!(own > 1e-7);
        assert_eq!(ready.closure_error(&world.link_poses()), own);
    }
}

#[test]
fn the_record_has_every_setting_and_the_errors_found_now() {
    let record = kept();
    assert_eq!(
        record.simulations.len(),
        SUBJECTS.len() * SOLVERS.len() * SUBSTEPS.len()
    );
    assert_eq!(record.traces.len(), SUBJECTS.len() * POSES.len());
    for subject in SUBJECTS {
        for (_, solver) in SOLVERS {
            let rungs: Vec<usize> = record
                .ladder(subject.name, solver)
                .map(|row| row.substeps)
                .collect();
            assert_eq!(rungs, SUBSTEPS, "{}, {solver}", subject.name);
        }
        let traces = record.traces_of(subject.name);
        assert!(traces.map(|t| t.poses).eq(POSES), "{}", subject.name);
    }
    for (subject, solver, substeps, shown) in fresh() {
        let (name, solver) = (SUBJECTS[*subject].name, SOLVERS[*solver].1);
        let mut rows = record.ladder(name, solver);
        let row = rows.find(|row| row.substeps == *substeps).unwrap();
        for (then, now) in [
            (row.closure_error, shown.closure_error),
            (row.distance, shown.distance),
        ] {
            assert!(
                (now / then - 1.0).abs() <= 0.2,
                "{name}, {solver}, {substeps} substeps: {then:e} in the record, {now:e} now; to measure anew: see \
                 examples/work_precision"
            );
        }
    }
}

#[test]
fn the_record_s_orders_are_two_and_its_traces_closed() {
    let record = kept();
    for row in record.simulations.iter().filter(|row| row.substeps > 1) {
        let order = record.order(row).unwrap();
        assert!((1.9..=2.1).contains(&order), "{row:?}: {order}");
    }
    for trace in &record.traces {
        assert!(trace.closure_error <= 1e-12, "{trace:?}");
        assert!(trace.poses_per_second > 0.0 && trace.wall_time.is_finite());
    }
}

/// Page and figure are drawn from the record, every digit of them.
#[test]
fn the_page_and_the_figure_show_the_record() {
    let record = kept();
    let page = the_page();
    let anew = "to write them anew: cargo run --example work_precision -- --redraw";
    assert!(page::replaced(&page, &record).unwrap() == page, "{anew}");
    let svg = fs::read_to_string(folder("docs/src/images/work_precision.svg")).unwrap();
    assert!(figure::render(&record) == svg, "{anew}");
    for substeps in SUBSTEPS {
        let rows = page
            .lines()
            .filter(|row| row.starts_with(&format!("| {substeps} substep")));
        assert_eq!(rows.count(), SUBJECTS.len(), "{substeps}");
    }
}

/// What the prose around the tables says in words.
#[test]
fn the_words_of_the_page_are_true_of_the_record() {
    let record = kept();
    let ratio = |mechanism: &str| {
        let pairs = record
            .ladder(mechanism, "impulses")
            .zip(record.ladder(mechanism, "multibody"));
        pairs
            .map(|(impulses, multibody)| impulses.closure_error / multibody.closure_error)
            .collect::<Vec<f64>>()
    };
    let page = the_page();
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(page.contains("four to five times as far for the four-bar, and nearly thirty times"));
    assert!(ratio("four-bar").iter().all(|r| (4.0..5.0).contains(r)));
    assert!(ratio("Bennett").iter().all(|r| (27.0..30.0).contains(r)));
    assert!(page.contains("For a picture, 1e-4, two substeps are enough with reduced coordinates"));
    for subject in SUBJECTS {
        let reached = record
            .ladder(subject.name, "multibody")
            .filter(|row| row.closure_error <= 1e-4)
            .map(|row| row.substeps)
            .min();
        assert!(reached <= Some(2), "{}", subject.name);
        for trace in record.traces_of(subject.name) {
            let simulated = record.soonest(subject.name, 1e-6).unwrap();
            assert!(trace.closure_error <= 1e-12 && trace.wall_time < simulated.wall_time);
        }
    }
}

#[test]
fn a_page_without_its_markers_is_refused() {
    let record = kept();
    for page in ["", page::BEGIN, page::END] {
        assert!(page::replaced(page, &record).is_err());
    }
}
