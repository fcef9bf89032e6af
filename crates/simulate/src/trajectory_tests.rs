//! Orders and errors of made-up differences.

use super::*;

/// Differences of runs of a scene that impacts interrupt, as they were seen: the last order is chance.
#[test]
fn an_order_after_one_that_was_none_is_not_credited() {
    let row = StepRow {
        time_step: 0.1,
        error: None,
        order: None,
        energy_change: 0.0,
        energy_error: None,
        closure_error: 0.0,
        step_time: 0.0,
    };
    let mut rows = vec![row; 5];
    let apart = [2.5e-3, 1.22e-3, 1.77e-3, 2.98e-4].map(|worst| TrajectoryError {
        worst,
        end: worst,
        speed: worst,
    });
    estimate(&mut rows, &apart, orders(Integrator::Engine));
    assert_eq!(rows[4].error, None);
    // One that falls as a method of first order does is.
    let apart = [4e-3, 2e-3, 1e-3].map(|worst| TrajectoryError {
        worst,
        end: worst,
        speed: worst,
    });
    let mut rows = rows[..4].to_vec();
    estimate(&mut rows, &apart, orders(Integrator::Engine));
    assert!((rows[3].error.unwrap().worst - 1e-3).abs() < 1e-12);
}

#[test]
fn an_order_that_was_not_seen_is_not_credited_where_an_error_is_wanted() {
    let row = StepRow {
        time_step: 0.1,
        error: None,
        order: None,
        energy_change: 0.0,
        energy_error: None,
        closure_error: 0.0,
        step_time: 0.0,
    };
    let off = |wanted: Option<f64>| {
        let mut trajectory = Trajectory::begun(wanted);
        trajectory.rows = vec![row.clone(), row.clone()];
        let apart = TrajectoryError {
            worst: 1e-3,
            end: 1e-3,
            speed: 1e-3,
        };
        trajectory.estimate(&[apart], Integrator::RungeKutta);
        trajectory.rows[0].error.unwrap().worst
    };
    assert!((off(Some(1e-3)) - 2e-3).abs() < 1e-15);
    assert!((off(None) - 1e-3 * 32.0 / 31.0).abs() < 1e-15);
}
