//! Which setting reaches a wanted error soonest.

use super::result::Setting;
use crate::Solver;
use serde::{Deserialize, Serialize};

/// The answer to a wanted error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// The error wanted (characteristic lengths, rad): neither a gap of a joint nor the distance from the prediction is larger.
    pub wanted: f64,
    /// Whether a setting reaches it.
    pub reached: bool,
    /// The least error of all settings that were run; absent where none arrived.
    pub best_error: Option<f64>,
    /// The setting with the least error.
    pub best: Option<Chosen>,
    /// The cheapest setting that reaches it.
    pub timing: Option<ChoiceTiming>,
}

/// A setting.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chosen {
    /// How trees are held.
    pub solver: Solver,
    /// Length of a step (s).
    pub time_step: f64,
    /// Substeps of a step.
    pub substeps: usize,
}

impl Chosen {
    fn of(setting: &Setting) -> Self {
        Self {
            solver: setting.solver,
            time_step: setting.time_step,
            substeps: setting.substeps,
        }
    }
}

/// The cheapest setting, which is one of several by its time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChoiceTiming {
    /// Which.
    pub setting: Chosen,
    /// Its error.
    pub error: f64,
    /// Seconds on the clock for a simulated second.
    pub seconds_per_second: f64,
}

/// The setting of least time among those that reach an error.
#[must_use]
pub fn choose(rows: &[Setting], wanted: f64) -> Choice {
    let known = || rows.iter().filter_map(|row| Some((row, row.error()?)));
    let best = known().min_by(|a, b| a.1.total_cmp(&b.1));
    let soonest = known()
        .filter(|(_, error)| *error <= wanted)
        .filter_map(|(row, error)| Some((row, error, row.seconds()?)))
        .min_by(|a, b| a.2.total_cmp(&b.2));
    Choice {
        wanted,
        reached: best.is_some_and(|(_, error)| error <= wanted),
        best_error: best.map(|(_, error)| error),
        best: best.map(|(row, _)| Chosen::of(row)),
        timing: soonest.map(|(row, error, seconds_per_second)| ChoiceTiming {
            setting: Chosen::of(row),
            error,
            seconds_per_second,
        }),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::result::{RunTiming, State};
    use super::*;

    fn row(substeps: usize, error: f64, seconds: f64, state: State) -> Setting {
        Setting {
            solver: Solver::Multibody,
            time_step: 0.01,
            substeps,
            state,
            closure_error: Some(error),
            distance: Some(0.5 * error),
            came: Some(1.0),
            timing: Some(RunTiming {
                seconds_per_second: seconds,
                pareto: false,
            }),
        }
    }

    #[test]
    fn the_cheapest_that_is_good_enough_is_taken() {
        let rows = [
            row(1, 1e-3, 0.1, State::Arrived),
            row(4, 1e-5, 0.5, State::Arrived),
            row(16, 1e-6, 0.4, State::Arrived),
            row(64, 1e-9, 0.01, State::Stalled),
        ];
        let choice = choose(&rows, 1e-4);
        assert!(choice.reached);
        assert_eq!(choice.timing.unwrap().setting.substeps, 16);
        let choice = choose(&rows, 1e-8);
        assert!(!choice.reached && choice.timing.is_none());
        assert_eq!(choice.best_error, Some(1e-6));
        assert_eq!(choice.best.unwrap().substeps, 16);
        let choice = choose(&[], 1.0);
        assert!(!choice.reached && choice.best.is_none());
    }

    #[test]
    fn the_distance_from_the_prediction_counts() {
        let mut far = row(1, 1e-9, 0.1, State::Arrived);
        far.distance = Some(1e-2);
        assert!(!choose(&[far], 1e-6).reached);
    }
}
