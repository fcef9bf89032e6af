//! Settings of a method of order two, without any simulation.

use super::account::{Account, Outcome};
use super::between::BETWEEN;
use super::grid::Grid;
use crate::WorldOptions;
use crate::accuracy::result::{Setting, State};
use std::convert::Infallible;
use std::ops::ControlFlow;

/// What a method of order two does, at a cost of a substep each.
fn pretend(options: &WorldOptions) -> Outcome {
    let substep = options.time_step / options.substeps as f64;
    Outcome {
        state: State::Arrived,
        closure_error: substep.powi(2),
        distance: Some(0.0),
        came: None,
        step_time: 1e-6 / substep,
        time: 1.0,
    }
}

fn rows(grid: &Grid, wanted: Option<f64>) -> (Vec<Setting>, bool) {
    let mut quiet = |_: f64, _: &str| ControlFlow::Continue(());
    let mut account = Account::new(grid, wanted, &mut quiet);
    account
        .rows::<Infallible>(
            &|_, step, n| 1e-6 * n as f64 / step,
            &mut |options, watched| {
                assert!(watched.from + watched.share <= 1.0 + 1e-12);
                Ok(Some(pretend(options)))
            },
        )
        .unwrap()
}

#[test]
fn settings_go_from_long_substeps_to_short_ones() {
    let (rows, stopped) = rows(&Grid::full(), None);
    assert_eq!((rows.len(), stopped), (24, false));
    for pair in rows.windows(2) {
        assert!(pair[0].solver != pair[1].solver || pair[0].substep() >= pair[1].substep());
    }
    assert!(rows.iter().any(|row| row.timing.unwrap().pareto));
}

#[test]
fn what_is_too_much_work_is_left_out_and_said() {
    let grid = Grid {
        work: 0.005,
        all_work: 0.01,
        ..Grid::full()
    };
    let (rows, _) = rows(&grid, None);
    let (left, run): (Vec<&Setting>, Vec<&Setting>) =
        rows.iter().partition(|row| row.state == State::LeftOut);
    assert!(!left.is_empty() && !run.is_empty());
    assert!(
        left.iter()
            .all(|row| row.timing.is_none() && row.error().is_none())
    );
    let work: f64 = run.iter().map(|row| 1e-6 / row.substep()).sum();
    assert!(work <= 0.01);
}

#[test]
fn a_setting_between_just_reaches_what_is_wanted() {
    let wanted = 1e-8;
    let (rows, _) = rows(&Grid::full(), Some(wanted));
    assert!(rows.len() > 24 && rows.len() <= 24 + BETWEEN);
    let cheapest = |rows: &mut dyn Iterator<Item = &Setting>| -> f64 {
        rows.filter(|row| row.error().unwrap() <= wanted)
            .map(|row| row.seconds().unwrap())
            .fold(f64::INFINITY, f64::min)
    };
    let grid = Grid::full().substeps;
    let all = cheapest(&mut rows.iter());
    let of_grid = cheapest(&mut rows.iter().filter(|row| grid.contains(&row.substeps)));
    assert!(all < 0.8 * of_grid, "{all} {of_grid}");
}

#[test]
fn a_break_ends_it_and_is_said() {
    let grid = Grid::full();
    let mut quiet = |_: f64, _: &str| ControlFlow::Continue(());
    let mut account = Account::new(&grid, None, &mut quiet);
    let mut left = 3;
    let (rows, stopped) = account
        .rows::<Infallible>(&|_, _, _| 1e-3, &mut |options, _| {
            left -= 1;
            Ok((left > 0).then(|| pretend(options)))
        })
        .unwrap();
    assert!(stopped);
    let broken = rows.iter().filter(|row| row.state == State::BrokenOff);
    assert_eq!(broken.count(), 22);
}

#[test]
fn an_error_ends_it() {
    let grid = Grid::full();
    let mut quiet = |_: f64, _: &str| ControlFlow::Continue(());
    let mut runs = 0;
    let ended = Account::new(&grid, None, &mut quiet).rows(&|_, _, _| 1e-3, &mut |options, _| {
        runs += 1;
        if runs < 3 {
            Ok(Some(pretend(options)))
        } else {
            Err("no world")
        }
    });
    assert_eq!((ended.err(), runs), (Some("no world"), 3));
}

#[test]
fn errors_that_are_no_numbers_are_left_out() {
    let grid = Grid::full();
    let mut quiet = |_: f64, _: &str| ControlFlow::Continue(());
    let (rows, _) = Account::new(&grid, None, &mut quiet)
        .rows::<Infallible>(&|_, _, _| 1e-3, &mut |options, _| {
            Ok(Some(Outcome {
                state: State::CameApart,
                closure_error: f64::INFINITY,
                distance: Some(f64::NAN),
                ..pretend(options)
            }))
        })
        .unwrap();
    for row in &rows {
        assert_eq!((row.closure_error, row.distance), (None, None));
        assert!(row.timing.is_some() && row.error().is_none());
    }
}
