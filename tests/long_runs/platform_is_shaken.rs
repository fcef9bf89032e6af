//! A Stewart platform, shaken.

use super::record::{Run, order};
use super::runs::{SOLVERS, Subject};
use super::{broken, kept, page, the_record_begins_like_that};

/// The short ones, ten periods, have their start in a tenth of them: they are there for their order.
#[test]
fn the_long_runs_keep_their_bounds() {
    let kept = kept();
    for solver in SOLVERS {
        let run = kept.long(Subject::Stewart, solver).unwrap();
        assert_eq!(broken(run), [], "{solver:?}");
    }
}

#[test]
fn the_level_falls_at_order_two() {
    let kept = kept();
    for solver in SOLVERS {
        let order = order(&kept.ladder(Subject::Stewart, solver), page::first_closure).unwrap();
        assert!((1.8..=2.4).contains(&order), "{solver:?}: {order}");
    }
}

/// A motor keeps a velocity and no length: told velocities alone, legs creep, by as much in every period, and half as much
/// with half the substep. Corrected they do not: what they are off in the last period they were off in the first.
#[test]
fn legs_creep_unless_they_are_corrected() {
    let kept = kept();
    for solver in SOLVERS {
        let creeping = kept.ladder(Subject::StewartUncorrected, solver);
        let order = order(&creeping, Run::own_rate).unwrap();
        assert!((0.8..=1.2).contains(&order), "{solver:?}: {order}");
        for (free, held) in creeping.iter().zip(kept.ladder(Subject::Stewart, solver)) {
            assert_eq!(free.substeps, held.substeps);
            assert!(
                held.own_rate().abs() < 1e-4 * free.own_rate().abs(),
                "{solver:?}"
            );
        }
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn both_solvers_begin_as_the_record_does() {
        for solver in SOLVERS {
            the_record_begins_like_that(Subject::Stewart, solver, 3);
        }
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn velocities_alone_begin_as_the_record_does() {
        for solver in SOLVERS {
            the_record_begins_like_that(Subject::StewartUncorrected, solver, 2);
        }
    }
}
