//! The setting that a wanted error calls for.

use crate::cli::accuracy::watched;
use kutzbach::accuracy::{AccuracyOptions, Choice, Chosen, Grid, measure_settings};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::Analysis;
use kutzbach::simulate::verification::VerificationOptions;

/// Settings are tried that take about so many seconds at most, and all of them about so many: what comes after is to begin
/// soon.
const EACH: f64 = 3.0;
const ALL: f64 = 15.0;

/// Rungs of the ladder that begins with the setting: three decide where the order shows at once.
const RUNGS: usize = 5;

/// More substeps than this no ladder has.
const MOST_SUBSTEPS: usize = 65_536;

/// Tries settings, with the solvers of the options, and says which reaches the error soonest.
///
/// # Errors
/// Why none was tried, in words.
pub fn chosen(
    mechanism: &Mechanism,
    analysis: &Analysis,
    options: &VerificationOptions,
    wanted: f64,
) -> Result<Choice, String> {
    let wishes = AccuracyOptions {
        configuration: options.configuration.clone(),
        branch: options.branch.clone(),
        drive: options.drive.clone(),
        grid: Grid {
            solvers: options.solvers.clone(),
            work: EACH,
            all_work: ALL,
            longest: options.longest,
            ..Grid::full()
        },
        ..AccuracyOptions::default()
    };
    let (_, choice) = watched("trying settings", |watch| {
        measure_settings(mechanism, analysis, &wishes, wanted, watch)
    })?
    .map_err(|error| error.to_string())?;
    choice.ok_or_else(|| "interrupted before a setting was found".to_owned())
}

/// The setting to use: the one that serves, or the best there is.
pub fn of(choice: &Choice) -> Option<Chosen> {
    choice.timing.map(|found| found.setting).or(choice.best)
}

/// Lets a verification begin with the setting: its solver first, its substeps as the lowest rung.
pub fn begin_with(setting: Chosen, options: &mut VerificationOptions) {
    options.time_step = setting.time_step;
    options.ladder = (0..RUNGS)
        .map(|rung| setting.substeps << rung)
        .filter(|substeps| *substeps <= MOST_SUBSTEPS)
        .collect();
    options
        .solvers
        .sort_by_key(|solver| *solver != setting.solver);
}
