//! A scissor under gravity.

use super::claims::SWING;
use super::record::{Run, order};
use super::runs::{SOLVERS, Subject};
use super::scissor::{GRAVITY, SLOPE, Scissor};
use super::{broken, kept, page, the_record_begins_like_that};
use kutzbach::simulate::Solver;

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

/// With balls of 1 kg at all joints the moments of mass along rail and gravity's other axis are 26 cos a and 78 sin a (kg m), a
/// being the angle between bars and rail: the scissor falls like a pendulum in a, from atan(3/4) to as far beyond its rest.
#[test]
fn the_swing_is_as_high_as_masses_and_slope_make_it() {
    let scissor = Scissor::new(Solver::Multibody).unwrap();
    let (along, down) = (26.0 * SLOPE.sin(), 78.0 * SLOPE.cos());
    let rest = down.atan2(along);
    let start = 0.75f64.atan();
    let height = GRAVITY * along.hypot(down) * (1.0 - (rest - start).cos());
    assert!(
        (scissor.height / height - 1.0).abs() < 1e-2,
        "{} {height}",
        scissor.height
    );
    let end = (2.0 * rest - start).to_degrees();
    assert!((71.5..72.5).contains(&end), "{end}");
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn both_solvers_begin_as_the_record_does() {
        for solver in SOLVERS {
            the_record_begins_like_that(Subject::Scissor, solver, 8);
        }
    }
}
