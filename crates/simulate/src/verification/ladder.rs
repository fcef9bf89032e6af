//! What a ladder of ever finer simulations says about a predicted motion.
//!
//! A simulation that moves proves nothing: its joints are held by forces that give way a little, and a loop that does not
//! fit by a thousandth turns all the same. What tells is how the closure error behaves when the substeps get finer. The
//! integration is of second order: where the loops do close along the motion, all of the error is the integrator's, and
//! falls as the square of the substep. Where they do not, what falls is that share only, and the geometric defect stays:
//!
//! `error(n) = defect + c n⁻²`.
//!
//! Two neighbouring rungs give the defect by Richardson's extrapolation (Richardson 1911, *Phil. Trans. R. Soc. A* 210,
//! section 1), and three give the order, which has to be seen before the extrapolation is believed.

use serde::Serialize;

/// The order at which the closure error of a true motion falls.
pub const EXPECTED_ORDER: f64 = 2.0;

/// An order over two rungs from here on counts as the expected one. With `error(n) = defect + c n⁻²` the errors at n and 4 n
/// are then in a ratio of at most 4^-1.25 = 0.177, which leaves the defect at most (0.177 − 0.0625)/0.9375 = 0.12 of the
/// coarser error, 0.7 of the finer: what is left is mostly the integrator's.
pub const LEAST_ORDER: f64 = 1.25;

/// Below this order over three refinements the error has levelled off: together they leave a third of it or more, where a motion that is
/// true leaves a sixty-fourth. Single steps do not tell: the solver's own noise makes an error rise here and fall there.
pub const LEVEL_ORDER: f64 = 0.5;

/// Over two refinements it has where they leave seven eighths of it or more; a true motion leaves a sixteenth.
const FLAT_ORDER: f64 = 0.1;

/// Errors below this are rounding and the solver's own residual: no order is asked of them (parts of the characteristic
/// length; a turn of 10⁴ substeps adds up 10⁴ roundings of 1e-16, and the sums of the solver lose about as much again).
pub const ROUNDING: f64 = 1e-9;

/// A motion is confirmed only down to errors of this size: what a loop misses by less than this cannot be told from
/// a loop that closes. Smaller than any play a joint has.
pub const FINE_ENOUGH: f64 = 3e-5;

/// A simulation is near the predicted motion where it is not farther off than so many closure errors: joints that give way
/// by some let links in a row stray by more.
pub(crate) const NEAR: f64 = 10.0;

/// Errors that are below this at three rungs running confirm without an order: motions that the integrator follows
/// exactly, such as turns about one point, have no error to fall but the solver's noise. A defect of this size is not
/// excluded then, and the finding says so.
pub const SMALL_THROUGHOUT: f64 = 1e-5;

/// One simulation of the ladder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rung {
    /// Substeps per step.
    pub substeps: usize,
    /// Largest gap of any joint on the way: the distance in characteristic lengths, or the angle in rad.
    pub closure_error: f64,
    /// Largest distance from the predicted motion on the way, same units.
    pub distance: f64,
    /// How much of the way the drive was to go was gone.
    pub progress: f64,
    /// Order at which the closure error fell since the rung before; `None` on the first, and between errors that are
    /// rounding.
    pub order: Option<f64>,
    /// Seconds on the clock that this simulation took.
    #[serde(skip)]
    pub wall_time: f64,
}

/// What a verification came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// The simulation shows what was predicted, and gets closer to it the finer it is.
    Confirmed,
    /// The simulation shows that the prediction fails.
    Contradicted,
    /// Neither can be said from these rungs.
    Inconclusive,
}

impl Outcome {
    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Contradicted => "contradicted",
            Self::Inconclusive => "inconclusive",
        }
    }
}

/// An outcome and the sentence that gives the reason.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The outcome.
    pub outcome: Outcome,
    /// Why, in one sentence.
    pub why: String,
}

impl Finding {
    pub(super) fn new(outcome: Outcome, why: impl Into<String>) -> Self {
        Self {
            outcome,
            why: why.into(),
        }
    }
}

/// log(coarse / fine) / log(n_fine / n_coarse).
#[must_use]
pub fn order_between(coarse: (usize, f64), fine: (usize, f64)) -> Option<f64> {
    let (n, error) = coarse;
    let (more, less) = fine;
    let meaningful = more > n && error > ROUNDING && less > 0.0;
    meaningful.then(|| (error / less).ln() / (more as f64 / n as f64).ln())
}

/// The part of the error that does not go away with finer substeps, by extrapolation at the expected order.
#[must_use]
pub fn defect(coarse: (usize, f64), fine: (usize, f64)) -> f64 {
    let ratio = (fine.0 as f64 / coarse.0 as f64).powf(EXPECTED_ORDER);
    ((ratio * fine.1 - coarse.1) / (ratio - 1.0)).max(0.0)
}

/// What is said of a run that has no error but a small one: rounding is below 1e-12 of the characteristic length.
fn reached_the_end(last: &Rung) -> String {
    const TO_ROUNDING: f64 = 1e-12;
    let error = last.closure_error.max(last.distance);
    let how_well = match error <= TO_ROUNDING {
        true => "to rounding".to_owned(),
        false => format!("with an error of {error:.0e} of the characteristic length"),
    };
    format!("the simulated mechanism reached the end of the predicted motion, {how_well}")
}

/// Where the drive has to have come to count as having gone its way.
pub const ARRIVED: f64 = 0.9;

/// A drive that has not come this far has not turned anything.
const STALLED: f64 = 0.5;

/// Distances that differ by less than this share are the same: an error of any order falls by more from one rung to the next.
const SAME: f64 = 0.05;

/// Errors that grow past this (rad, characteristic lengths) are a simulation that came apart, and say nothing.
pub(crate) const APART: f64 = 0.3;

/// Judges the rungs so far, coarse to fine; `None` where another rung may still decide.
#[must_use]
pub fn judge_motion(rungs: &[Rung]) -> Option<Finding> {
    let [.., before, last] = rungs else {
        // One rung decides only where there is no error at all: no loop is held by force.
        let last = rungs.last()?;
        return (last.closure_error <= ROUNDING
            && last.distance <= ROUNDING
            && last.progress >= ARRIVED)
            .then(|| Finding::new(Outcome::Confirmed, reached_the_end(last)));
    };
    if !(last.closure_error < APART) {
        return None;
    }
    // A drive that comes farther the finer the substeps are is held up by the solver, not by the loops.
    let stalls = last.progress < STALLED && last.progress <= before.progress.max(0.01);
    if stalls && last.closure_error < FINE_ENOUGH {
        return Some(Finding::new(
            Outcome::Contradicted,
            format!(
                "the drive stalls after {:.0} % of its way with the loops closed to {:.1e}",
                100.0 * last.progress,
                last.closure_error
            ),
        ));
    }
    let rounded = last.closure_error <= ROUNDING && before.closure_error <= ROUNDING;
    let order = match rungs {
        [.., first, _, last] => order_between(
            (first.substeps, first.closure_error),
            (last.substeps, last.closure_error),
        ),
        _ => None,
    };
    let small = rungs.len() >= 3
        && rungs[rungs.len() - 3..]
            .iter()
            .all(|rung| rung.closure_error <= SMALL_THROUGHOUT && rung.progress >= ARRIVED);
    let falls = rounded || order.is_some_and(|o| o >= LEAST_ORDER);
    let holds = (falls && last.closure_error <= FINE_ENOUGH) || small;
    if holds && last.progress >= ARRIVED && keeps_near(rungs) {
        let why = if !falls {
            let most = rungs.iter().rev().take(3).map(|r| r.closure_error);
            format!(
                "the loops stay closed to {:.1e} of the characteristic length at every number of \
                 substeps, and the simulated mechanism stays within {:.1e} of the predicted motion; \
                 a defect smaller than that would not show",
                most.fold(0.0, f64::max),
                last.distance
            )
        } else if rounded {
            reached_the_end(last)
        } else {
            format!(
                "the closure error falls with the power {:.1} of the substeps, to {:.1e} of the \
                 characteristic length, and the simulated mechanism stays within {:.1e} of the \
                 predicted motion",
                order.unwrap_or_default(),
                last.closure_error,
                last.distance
            )
        };
        return Some(Finding::new(Outcome::Confirmed, why));
    }
    if let Some(distance) = stays_off(rungs) {
        return Some(Finding::new(
            Outcome::Inconclusive,
            format!(
                "the joints stay closed to {ROUNDING:.0e}, yet the simulated mechanism is {distance:.1e} off the predicted motion \
                 at every number of substeps: finer ones change nothing"
            ),
        ));
    }
    let levels = levels_off(rungs, |rung| rung.closure_error);
    if levels && last.closure_error > FINE_ENOUGH {
        let left = defect(
            (before.substeps, before.closure_error),
            (last.substeps, last.closure_error),
        );
        return Some(Finding::new(
            Outcome::Contradicted,
            format!(
                "the closure error levels off at {:.1e} of the characteristic length (extrapolated: \
                 {left:.1e}): it turns because the simulated joints give way, not because the loops close",
                last.closure_error
            ),
        ));
    }
    let elsewhere = last.progress >= ARRIVED && levels_off(rungs, |rung| rung.distance);
    if (levels || elsewhere) && falls_off(last) {
        return Some(Finding::new(
            Outcome::Contradicted,
            format!(
                "the loops close to {:.1e}, yet the simulated mechanism is {:.1e} off the predicted motion",
                last.closure_error, last.distance
            ),
        ));
    }
    None
}

/// Whether the simulation keeps to the prediction. Where the loops hold a pose by their curvature only, near singular
/// poses, a pose is off by the root of the closure error: the distance then falls at half the order.
fn keeps_near(rungs: &[Rung]) -> bool {
    let [.., first, _, last] = rungs else {
        return rungs.last().is_some_and(|r| r.distance <= FINE_ENOUGH);
    };
    let falls = order_between(
        (first.substeps, first.distance),
        (last.substeps, last.distance),
    )
    .is_none_or(|order| order >= 0.5 * LEAST_ORDER);
    last.distance <= FINE_ENOUGH.max(NEAR * last.closure_error)
        || falls && last.distance <= 2.0 * last.closure_error.sqrt()
}

/// The distance of three rungs that joints hold together to rounding, where it is the same at all of them: then it does not
/// come from the substeps.
fn stays_off(rungs: &[Rung]) -> Option<f64> {
    let [.., first, second, last] = rungs else {
        return None;
    };
    let rounded = |rung: &Rung| rung.closure_error <= ROUNDING && rung.distance > FINE_ENOUGH;
    let same = |rung: &Rung| (rung.distance - last.distance).abs() <= SAME * last.distance;
    let all = [first, second, last];
    all.iter()
        .all(|rung| rounded(rung) && same(rung))
        .then_some(last.distance)
}

/// Whether an error has stopped falling: over the last two or three refinements, and at the last one it does not fall as that of a true motion.
fn levels_off(rungs: &[Rung], error: fn(&Rung) -> f64) -> bool {
    let [.., early, before, last] = rungs else {
        return false;
    };
    let order = |coarse: &Rung, fine: &Rung| {
        order_between(
            (coarse.substeps, error(coarse)),
            (fine.substeps, error(fine)),
        )
    };
    let below = |coarse: &Rung, most: f64| order(coarse, last).is_some_and(|order| order < most);
    let level = match rungs {
        [.., first, _, _, _] => below(first, LEVEL_ORDER),
        _ => false,
    };
    below(before, LEAST_ORDER) && (level || below(early, FLAT_ORDER))
}

fn falls_off(rung: &Rung) -> bool {
    rung.distance > 100.0 * rung.closure_error.max(FINE_ENOUGH)
}

/// The sentence for a ladder that ended without a decision.
#[must_use]
pub fn undecided(rungs: &[Rung]) -> Finding {
    let why = match rungs.last() {
        None => "nothing was simulated".to_owned(),
        Some(last) if !(last.closure_error < APART) => format!(
            "the simulation came apart at {} substeps: closure error {:.1e}",
            last.substeps, last.closure_error
        ),
        Some(last) if last.progress < ARRIVED => format!(
            "the drive came {:.0} % of its way; closure error {:.1e} at {} substeps",
            100.0 * last.progress,
            last.closure_error,
            last.substeps
        ),
        Some(last) => format!(
            "the closure error is {:.1e} at {} substeps{}; finer substeps may decide",
            last.closure_error,
            last.substeps,
            last.order.map_or(String::new(), |o| format!(
                " and fell with the power {o:.1}"
            )),
        ),
    };
    Finding::new(Outcome::Inconclusive, why)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Rungs with the given errors at 4, 8, 16, … substeps.
    fn rungs(errors: &[f64]) -> Vec<Rung> {
        let mut rungs: Vec<Rung> = Vec::new();
        for (index, &closure_error) in errors.iter().enumerate() {
            let substeps = 4 << index;
            let order = rungs.last().and_then(|before: &Rung| {
                order_between(
                    (before.substeps, before.closure_error),
                    (substeps, closure_error),
                )
            });
            rungs.push(Rung {
                substeps,
                closure_error,
                distance: closure_error,
                progress: 1.0,
                order,
                wall_time: 0.0,
            });
        }
        rungs
    }

    #[test]
    fn a_distance_that_finer_substeps_leave_ends_the_ladder() {
        let off = |distances: &[f64]| {
            let mut all = rungs(&vec![1e-14; distances.len()]);
            for (rung, distance) in all.iter_mut().zip(distances) {
                rung.distance = *distance;
            }
            judge_motion(&all).map(|finding| finding.outcome)
        };
        assert_eq!(off(&[2.3e-2, 2.31e-2]), None);
        assert_eq!(
            off(&[2.3e-2, 2.31e-2, 2.29e-2]),
            Some(Outcome::Inconclusive)
        );
        assert_eq!(off(&[2.3e-2, 1.2e-2, 6e-3]), None);
        assert_eq!(off(&[1e-6, 1e-6, 1e-6]), Some(Outcome::Confirmed));
    }

    #[test]
    fn only_what_is_rounding_is_called_so() {
        let why = |distance: f64| {
            let mut all = rungs(&[1e-14; 3]);
            all.iter_mut().for_each(|rung| rung.distance = distance);
            judge_motion(&all).unwrap().why
        };
        assert!(why(3e-13).ends_with("to rounding"));
        assert!(why(2e-5).ends_with("with an error of 2e-5 of the characteristic length"));
    }

    fn outcome(errors: &[f64]) -> Option<Outcome> {
        judge_motion(&rungs(errors)).map(|f| f.outcome)
    }

    fn with_defect(defect: f64, rungs: i32) -> Vec<f64> {
        (0..rungs)
            .map(|i| defect + 1e-3 * 0.25f64.powi(i))
            .collect()
    }

    #[test]
    fn an_error_of_second_order_confirms_once_it_is_small() {
        assert_eq!(outcome(&with_defect(0.0, 2)), None);
        assert_eq!(outcome(&with_defect(0.0, 3)), None, "still too large");
        assert_eq!(outcome(&with_defect(0.0, 4)), Some(Outcome::Confirmed));
    }

    #[test]
    fn a_defect_is_never_confirmed_and_in_the_end_contradicted() {
        for defect in [1e-2, 1e-3, 1e-4] {
            let found: Vec<_> = (1..=9).map(|n| outcome(&with_defect(defect, n))).collect();
            assert!(!found.contains(&Some(Outcome::Confirmed)), "{defect}");
            assert_eq!(found[8], Some(Outcome::Contradicted), "{defect}");
        }
    }

    #[test]
    fn an_error_that_wanders_has_levelled_off() {
        // Bricard's loop off by 1e-3 and by 1e-2, held by impulses.
        let small = [2.6e-2, 6.4e-3, 1.3e-3, 2.9e-4, 1.75e-4, 2.4e-4, 1.35e-4];
        let large = [2.5e-2, 5.7e-3, 3.4e-3, 2.3e-3, 2.5e-3, 2.6e-3, 1.3e-3];
        for errors in [small, large] {
            assert_eq!(outcome(&errors), Some(Outcome::Contradicted));
        }
        let flat = [2e-2, 5e-3, 1.2e-3, 3e-4, 2.3e-4, 2.3e-4];
        assert_eq!(outcome(&flat[..5]), None);
        assert_eq!(
            outcome(&[2e-2, 5e-3, 1e-3, 2.3e-4, 2.31e-4, 2.3e-4]),
            Some(Outcome::Contradicted)
        );
        // One refinement in which noise hides that it falls.
        assert_eq!(outcome(&[1e-2, 2.5e-3, 2.4e-3, 2e-4]), None);
    }

    #[test]
    fn a_motion_that_closes_and_stays_elsewhere_is_not_the_predicted_one() {
        let mut off = rungs(&with_defect(0.0, 5));
        for (rung, distance) in off.iter_mut().zip([0.021, 0.0202, 0.02, 0.02, 0.02]) {
            rung.distance = distance;
        }
        assert_eq!(judge_motion(&off).unwrap().outcome, Outcome::Contradicted);
        off.iter_mut().for_each(|rung| rung.progress = 0.7);
        assert_eq!(judge_motion(&off), None);
    }

    #[test]
    fn errors_that_are_nothing_but_noise_confirm_down_to_their_size() {
        assert_eq!(outcome(&[2e-6, 6e-6]), None);
        let found = judge_motion(&rungs(&[2e-6, 6e-6, 1e-6])).unwrap();
        assert_eq!(found.outcome, Outcome::Confirmed);
        assert!(found.why.contains("closed to 6.0e-6") && found.why.contains("would not show"));
        assert_eq!(outcome(&[2e-5, 6e-5, 1e-5]), None);
    }

    #[test]
    fn the_defect_is_extrapolated() {
        let errors = with_defect(1e-4, 3);
        let found = defect((8, errors[1]), (16, errors[2]));
        assert!((found - 1e-4).abs() < 1e-12);
        assert_eq!(defect((8, 4.0), (16, 1.0)), 0.0);
    }

    #[test]
    fn first_order_is_not_enough() {
        // Below 1e-5 three times running they would do without any order.
        let errors: Vec<f64> = (0..9).map(|i| 1e-3 * 0.5f64.powi(i)).collect();
        assert!(errors[6] > SMALL_THROUGHOUT && errors[6] < FINE_ENOUGH);
        assert_eq!(outcome(&errors), None);
    }

    #[test]
    fn a_drive_that_stalls_with_the_loops_closed_contradicts() {
        let mut stuck = rungs(&[1e-6, 1e-6]);
        stuck.iter_mut().for_each(|r| r.progress = 0.01);
        assert_eq!(judge_motion(&stuck).unwrap().outcome, Outcome::Contradicted);
        // Half way is neither.
        stuck.iter_mut().for_each(|r| r.progress = 0.7);
        assert_eq!(judge_motion(&stuck), None);
    }

    #[test]
    fn closed_loops_off_the_predicted_motion_are_not_confirmed() {
        let mut off = rungs(&with_defect(0.0, 5));
        for (index, rung) in off.iter_mut().enumerate() {
            rung.distance = 0.2 * 0.5f64.powi(index as i32);
        }
        assert_eq!(judge_motion(&off), None);
        let last = undecided(&off);
        assert_eq!(last.outcome, Outcome::Inconclusive);
    }

    #[test]
    fn what_came_apart_says_nothing() {
        assert_eq!(outcome(&[1.0, 2.0, f64::NAN]), None);
        assert!(
            undecided(&rungs(&[1.0, f64::NAN]))
                .why
                .contains("came apart")
        );
    }

    #[test]
    fn a_tree_has_no_error_and_needs_no_ladder() {
        assert_eq!(outcome(&[0.0]), Some(Outcome::Confirmed));
        assert_eq!(outcome(&[1e-15, 1e-15]), Some(Outcome::Confirmed));
    }
}
