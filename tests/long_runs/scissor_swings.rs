//! A scissor under gravity.

use crate::claims::SWING;
use crate::record::{Run, order};
use crate::runs::{SOLVERS, Subject};
use crate::scissor::Scissor;
use crate::{broken, kept, page, the_record_begins_like_that};
use kutzbach::simulate::Solver;

#[test]
fn both_solvers_begin_as_the_record_does() {
    for solver in SOLVERS {
        the_record_begins_like_that(Subject::Scissor, solver, 8);
    }
}

#[test]
fn held_by_impulses_a_long_swing_keeps_its_bounds() {
    let kept = kept();
    let run = kept.long(Subject::Scissor, Solver::Impulse).unwrap();
    assert_eq!(broken(run), []);
    assert_eq!(run.calm(), run.windows());
}

/// Reduced coordinates gain energy without end: the one bound that does not hold, and the only one of them.
#[test]
fn in_reduced_coordinates_the_energy_does_not_stay() {
    let kept = kept();
    let run = kept.long(Subject::Scissor, Solver::Multibody).unwrap();
    let broken = broken(run);
    let names: Vec<&str> = broken.iter().map(|claim| claim.what).collect();
    assert_eq!(
        names,
        ["energy, change as a share of the swing's height"],
        "{broken:?}"
    );
    // For a minute it is kept.
    let seconds = run.spans() / run.windows() as f64 * run.calm() as f64;
    assert!(seconds >= 60.0 && broken[0].found > SWING, "{seconds}");
}

#[test]
fn the_level_falls_at_order_two() {
    let kept = kept();
    for solver in SOLVERS {
        let order = order(&kept.ladder(Subject::Scissor, solver), page::first_closure).unwrap();
        assert!((1.8..=2.2).contains(&order), "{solver:?}: {order}");
    }
}

/// What reduced coordinates gain in a second is half as much with half the substep: the integrator is of first order. This is
/// a drift of the engine and not of the mechanism.
#[test]
fn the_gain_falls_at_order_one() {
    let kept = kept();
    let ladder = kept.ladder(Subject::Scissor, Solver::Multibody);
    assert!(
        ladder
            .iter()
            .all(|run| run.own_rate() > 0.0 && run.calm() > 5)
    );
    let found = order(&ladder, Run::own_rate).unwrap();
    assert!((0.9..=1.1).contains(&found), "{found}");
}

/// Impulses lose a little, a fiftieth of that and less.
#[test]
fn impulses_lose_a_little() {
    let kept = kept();
    let solvers = [Solver::Impulse, Solver::Multibody];
    let [impulses, reduced] = solvers.map(|solver| kept.ladder(Subject::Scissor, solver));
    for (loses, gains) in impulses.iter().zip(&reduced) {
        let (lost, gained) = (-loses.own_rate(), gains.own_rate());
        assert!(lost > 0.0 && lost < gained / 50.0, "{lost:e}, {gained:e}");
    }
    let found = order(&impulses, Run::own_rate).unwrap();
    assert!((1.0..=2.0).contains(&found), "{found}");
}

#[test]
fn the_swing_has_a_height() {
    let scissor = Scissor::new(Solver::Multibody).unwrap();
    assert!(scissor.height > 0.0, "{}", scissor.height);
}
