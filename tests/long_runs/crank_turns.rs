//! Bennett's linkage, driven.

use super::claims::EVEN;
use super::crank::{Crank, STEPS_OF_A_TURN};
use super::record::{Run, growth, order};
use super::runs::{SOLVERS, Setting, Subject};
use super::watch::watch;
use super::{broken, kept, page, setting, the_record_begins_like_that};
use kutzbach::families::negative_power_of_ten;
use kutzbach::number::Number;
use kutzbach::simulate::Solver;

/// Turns of a run that should break a claim.
const TURNS: usize = 10;

fn run_of(crank: &Crank, solver: Solver, substeps: usize) -> Run {
    let setting = Setting {
        substeps,
        steps: TURNS * STEPS_OF_A_TURN,
        windows: TURNS,
        ..setting(Subject::Bennett, solver)
    };
    Run::new(
        &setting,
        &watch(crank, substeps, setting.steps, TURNS).unwrap(),
    )
}

#[test]
fn the_record_keeps_its_bounds() {
    let kept = kept();
    for solver in SOLVERS {
        for run in kept.ladder(Subject::Bennett, solver) {
            assert_eq!(broken(run), [], "{solver:?}, {} substeps", run.substeps);
        }
    }
}

/// What a substep overlooks is quadratic in its motion, as long as the loop fits.
#[test]
fn the_level_falls_at_order_two() {
    let kept = kept();
    for solver in SOLVERS {
        let order = order(&kept.ladder(Subject::Bennett, solver), page::first_closure).unwrap();
        assert!((1.9..=2.1).contains(&order), "{solver:?}: {order}");
    }
}

/// A crank that gets faster by a hundredth in each turn opens the loop more and more: the bounds on growth are broken.
#[test]
fn a_growing_closure_error_is_found_out() {
    for solver in SOLVERS {
        let crank = Crank::bennett(solver).unwrap().speeding_up(0.01);
        let run = run_of(&crank, solver, 1);
        let growth = growth(&run.seen.closure);
        // The square of the rate: 1.09² in the last of ten turns.
        assert!(growth > 1.1 && growth < 1.3, "{solver:?}: {growth}");
        let broken = broken(&run);
        let names: Vec<&str> = broken.iter().map(|claim| claim.what).collect();
        assert!(names.contains(&"closure error, last tenth over first tenth"));
        assert!(names.contains(&"closure error, drift as a share of its mean"));
        assert!(
            broken
                .iter()
                .all(|claim| claim.found > claim.allowed && claim.found > EVEN)
        );
    }
}

/// Held by impulses the crank gives way: it loses as much in every turn, by the square of the substep.
#[test]
fn impulses_let_the_crank_lag() {
    let kept = kept();
    let ladder = kept.ladder(Subject::Bennett, Solver::Impulse);
    assert!(ladder.iter().all(|run| run.own_rate() < 0.0));
    let order = order(&ladder, Run::own_rate).unwrap();
    assert!((1.5..=2.5).contains(&order), "{order}");
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_million_steps_end_as_they_began() {
        let setting = setting(Subject::Bennett, Solver::Multibody);
        assert_eq!((setting.steps, setting.substeps), (1_000_000, 1));
        let run = the_record_begins_like_that(Subject::Bennett, Solver::Multibody, setting.windows);
        assert_eq!(broken(&run), []);
    }

    /// A linkage with a twist off by a thousandth comes open by what it is off: its closure error is as even as that of one that
    /// fits, but many times as large, and substeps do not help.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_spoiled_linkage_is_found_out() {
        for solver in SOLVERS {
            let level = |epsilon: &Number| {
                let crank = Crank::spoiled(epsilon, solver).unwrap();
                let runs = [1, 4].map(|substeps| run_of(&crank, solver, substeps));
                let order = order(&[&runs[0], &runs[1]], page::first_closure).unwrap();
                (page::first_closure(&runs[1]), order)
            };
            let (whole, falls) = level(&Number::zero());
            let (spoiled, stays) = level(&negative_power_of_ten(3));
            assert!((1.9..=2.1).contains(&falls), "{solver:?}: {falls}");
            assert!(stays < 1.0, "{solver:?}: {stays}");
            assert!(spoiled > 5.0 * whole, "{solver:?}: {spoiled:e}, {whole:e}");
        }
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn impulses_begin_as_the_record_does() {
        the_record_begins_like_that(Subject::Bennett, Solver::Impulse, 10);
    }
}
