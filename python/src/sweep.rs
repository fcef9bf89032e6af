//! Many variants, on all processors.

use crate::asked::{self, Analyse, Vary};
use crate::failure::Failure;
use crate::reading::Subject;
use crate::watched::{STACK, watched};
use kutzbach::interruption::Interruption;
use kutzbach::mobility::AnalysisOptions;
use kutzbach::sweep::{Family, Form, MeasuredFile, Over, Plan, Sample, Shard, SweepError, Table};
use pyo3::prelude::*;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

/// A sweep, or a share of one.
#[pyclass(frozen, module = "kutzbach._kutzbach")]
pub struct Sweep(Arc<Planned>);

/// What is asked, and how answers are written.
struct Planned {
    family: Family,
    shard: Shard,
    lines: Table,
    csv: Table,
}

/// A row: its place, and its line in either form.
type Line = (u64, String, String);

fn wrong(error: SweepError) -> Failure {
    Failure::plain(error.message, error.help)
}

/// Plans a sweep.
///
/// # Errors
/// Ranges, samples and shares that are written otherwise; a measure that the file does not have.
pub fn planned(subject: &Subject, asked: &str) -> Result<Sweep, Failure> {
    let asked: Vary = asked::parsed(asked)?;
    let over = asked.over.iter().map(|own| Over::read(own));
    let over = over.collect::<Result<Vec<_>, _>>().map_err(wrong)?;
    let sample = asked.sample.as_deref().map(Sample::read).transpose();
    let shard = asked.shard.as_deref().map(Shard::read).transpose();
    let shard = shard.map_err(wrong)?.unwrap_or_default();
    let plan = Plan::new(over, sample.map_err(wrong)?).map_err(wrong)?;
    let depth = Analyse {
        depth: asked.depth.or_else(|| Some("verdict".to_owned())),
        ..Analyse::default()
    }
    .depth()?;
    let source = &subject.source;
    let file = MeasuredFile {
        bytes: source.bytes.clone(),
        file: source.file.clone(),
        base: source.base.clone(),
        options: source.options.clone(),
    };
    let options = AnalysisOptions {
        configuration: asked::named(asked.configuration),
        depth,
        closure_tolerance: asked.closure_tolerance,
        ..AnalysisOptions::default()
    };
    let family = Family::new(file, plan, options)?;
    Ok(Sweep(Arc::new(Planned {
        lines: Table::new(&family, shard, Form::JsonLines),
        csv: Table::new(&family, shard, Form::Csv),
        family,
        shard,
    })))
}

impl Planned {
    /// Rows from one place of the share on; fewer where it is interrupted.
    fn rows(&self, start: u64, count: u64, interruption: &Interruption) -> Vec<Line> {
        let all = self.shard.count(self.family.plan().count());
        let end = start.saturating_add(count).min(all);
        let next = AtomicU64::new(start);
        let members = self.family.members();
        let work = || {
            let mut own = Vec::new();
            loop {
                let place = next.fetch_add(1, Ordering::Relaxed);
                if place >= end {
                    break;
                }
                // A variant under way has no row where it is interrupted.
                let row = interruption.during(|| members.row(self.shard.index(place)));
                let Ok(Some(row)) = row else {
                    break;
                };
                own.push((place, self.lines.line(&row), self.csv.line(&row)));
            }
            own
        };
        let processors = thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let mut rows: Vec<Line> = thread::scope(|scope| {
            // This thread is one of them; fewer do the same work.
            let others: Vec<_> = (1..processors)
                .filter_map(|_| {
                    thread::Builder::new()
                        .stack_size(STACK)
                        .spawn_scoped(scope, work)
                        .ok()
                })
                .collect();
            let mut rows = work();
            for other in others {
                match other.join() {
                    Ok(own) => rows.extend(own),
                    Err(fault) => resume_unwind(fault),
                }
            }
            rows
        });
        rows.sort_by_key(|(place, _, _)| *place);
        rows
    }
}

#[pymethods]
impl Sweep {
    /// How many rows there are.
    fn count(&self) -> u64 {
        let Planned { family, shard, .. } = &*self.0;
        shard.count(family.plan().count())
    }

    /// Names of the measures that vary.
    fn measures(&self) -> Vec<String> {
        let names = self.0.family.plan().names();
        names.map(str::to_owned).collect()
    }

    /// What stands before the rows: in CSV, or as JSON lines.
    #[pyo3(signature = (csv))]
    fn head(&self, csv: bool) -> String {
        match csv {
            true => self.0.csv.head(),
            false => self.0.lines.head(),
        }
    }

    /// So many rows from a place on, as JSON lines and as CSV.
    #[pyo3(signature = (start, count))]
    fn rows(&self, py: Python<'_>, start: u64, count: u64) -> PyResult<(String, String)> {
        let planned = Arc::clone(&self.0);
        watched(py, move |interruption| {
            let mut text = (String::new(), String::new());
            for (_, line, csv) in planned.rows(start, count, interruption) {
                text.0.push_str(&line);
                text.1.push_str(&csv);
            }
            Ok(text)
        })
    }
}
