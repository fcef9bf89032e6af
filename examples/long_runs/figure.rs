//! The figures: closure errors of the long runs, and the energy of the swing.

use super::record::Record;
use super::runs::{SOLVERS, Subject};
use kutzbach::report::picture::plot::{Axis, Plot, Scale, Series};
use kutzbach::simulate::Solver;

fn word(solver: Solver) -> &'static str {
    match solver {
        Solver::Multibody => "reduced coordinates",
        Solver::Impulse => "impulses",
    }
}

/// All figures, by the names of their files.
#[must_use]
pub fn figures(record: &Record) -> Vec<(&'static str, String)> {
    vec![
        ("long_runs_closure", closure(record)),
        ("long_runs_energy", energy(record)),
    ]
}

/// Closure error over the share of the run that is done.
fn closure(record: &Record) -> String {
    let mut series = Vec::new();
    for subject in [Subject::Bennett, Subject::Scissor, Subject::Stewart] {
        for solver in SOLVERS {
            let Some(run) = record.long(subject, solver) else {
                continue;
            };
            let count = run.windows() as f64;
            let values = run.seen.closure.iter().enumerate();
            series.push(Series::line(
                format!("{}, {}", subject.short(), word(solver)),
                "",
                series.len(),
                values.map(|(index, gap)| (100.0 * (index as f64 + 0.5) / count, *gap)),
            ));
        }
    }
    let all = series.iter().flat_map(|s| s.values.iter().map(|v| v.y));
    let y = Axis::around("largest gap (characteristic lengths, rad)", Scale::Log, all);
    let x = Axis::new(
        "how much of the run is done (%)",
        Scale::Linear,
        [0.0, 100.0],
    );
    let mut plot = Plot::new(
        "How far joints come open in each hundredth of a long run",
        x,
        y,
    );
    plot.series = series;
    plot.size = [760.0, 420.0];
    plot.document()
}

/// The scissor's energy over time.
fn energy(record: &Record) -> String {
    let mut series = Vec::new();
    let mut end = 0.0f64;
    for solver in SOLVERS {
        for run in record.ladder(Subject::Scissor, solver) {
            let each = run.spans() / run.windows() as f64;
            end = end.max(run.spans());
            let values = run.seen.energy_mean.iter().enumerate();
            series.push(Series::line(
                format!("{}, {} substeps", word(solver), run.substeps),
                "%",
                series.len(),
                values.map(|(index, e)| ((index as f64 + 0.5) * each, 100.0 * e)),
            ));
        }
    }
    let all = series.iter().flat_map(|s| s.values.iter().map(|v| v.y));
    let y = Axis::around(
        "energy gained (% of the swing's height)",
        Scale::Linear,
        all,
    );
    let x = Axis::new("time (s)", Scale::Linear, [0.0, end]);
    let mut plot = Plot::new("A scissor that swings without drive or damping", x, y);
    plot.series = series;
    plot.size = [760.0, 420.0];
    plot.document()
}
