//! Settings between those of the grid, for an error that is wanted.

use super::grid::Wish;
use crate::Solver;
use crate::accuracy::result::Setting;

/// At most so many settings are looked for between those of the grid.
pub(super) const BETWEEN: usize = 4;

/// Substeps found by the order two of the integration are taken this much finer, since the order is not quite two.
const SAFETY: f64 = 1.15;

/// Substeps that no setting exceeds.
const MOST_SUBSTEPS: f64 = 4096.0;

/// Numbers of substeps, between those of the rows or beyond, that should just reach an error: the closure error falls with
/// their square. Those of least work.
pub(super) fn settings_between(
    rows: &[Setting],
    wanted: f64,
    cost: &dyn Fn(Solver, f64, usize) -> f64,
) -> Vec<Wish> {
    let mut found: Vec<Wish> = Vec::new();
    let mut ladders: Vec<(Solver, f64)> = rows.iter().map(|r| (r.solver, r.time_step)).collect();
    ladders.sort_by(|a, b| a.1.total_cmp(&b.1).then((a.0 as u8).cmp(&(b.0 as u8))));
    ladders.dedup();
    for (solver, time_step) in ladders {
        let mut known: Vec<(usize, f64)> = rows
            .iter()
            .filter(|row| row.solver == solver && row.time_step == time_step)
            .filter_map(|row| Some((row.substeps, row.error()?)))
            .collect();
        known.sort_by_key(|(substeps, _)| *substeps);
        let enough = known.iter().find(|(_, error)| *error <= wanted);
        let short = known
            .iter()
            .rfind(|(n, error)| *error > wanted && enough.is_none_or(|(most, _)| n < most));
        let Some((n, error)) = short else { continue };
        let fitting = (SAFETY * *n as f64 * (error / wanted).sqrt()).ceil();
        let most = enough.map_or(MOST_SUBSTEPS, |(most, _)| *most as f64 - 1.0);
        if fitting <= most {
            found.push((solver, time_step, fitting as usize));
        }
    }
    let work = |wish: &Wish| cost(wish.0, wish.1, wish.2);
    found.sort_by(|a, b| work(a).total_cmp(&work(b)));
    found.truncate(BETWEEN);
    found
}
