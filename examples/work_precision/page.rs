//! The part of the page that is written by the program: tables, and the sentences that have numbers in them.

use super::measure::{POSES, Result, SOLVERS, STEPS, SUBJECTS, SUBSTEPS};
use super::record::{Record, Simulation};
use std::fmt::Write;

/// Between these lines the page is replaced.
pub const BEGIN: &str = "<!-- measured: begin -->";
/// See [`BEGIN`].
pub const END: &str = "<!-- measured: end -->";

/// Closure errors for which the page says what reaches them soonest.
pub const WANTED: [f64; 5] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// The page with its measured part replaced.
///
/// # Errors
/// Where the page lacks one of the two markers.
pub fn replaced(page: &str, record: &Record) -> Result<String> {
    let lacks = |marker: &str| format!("the page has no line `{marker}`");
    let (before, rest) = page.split_once(BEGIN).ok_or_else(|| lacks(BEGIN))?;
    let (_, after) = rest.split_once(END).ok_or_else(|| lacks(END))?;
    Ok(format!(
        "{before}{BEGIN}\n\n{}\n{END}{after}",
        measured(record)
    ))
}

/// Everything measured, as Markdown.
#[must_use]
pub fn measured(record: &Record) -> String {
    let mut text = format!(
        "Measured on {} on {}, one thread, release build; wall times are the best of {} rounds.\n\n",
        record.date, record.machine, record.rounds
    );
    for subject in SUBJECTS {
        table(&mut text, record, subject.name);
    }
    advice(&mut text, record);
    compared(&mut text, record);
    text
}

fn say(text: &mut String, line: String) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "{line}");
}

/// One mechanism: a row for every number of substeps, and one for every trace.
fn table(text: &mut String, record: &Record, mechanism: &str) {
    let mut head = format!("| {} |", capitalised(mechanism));
    let mut rule = "|---|".to_owned();
    for (_, solver) in SOLVERS {
        let _ = write!(head, " {solver}: closure error | order | distance | time |");
        rule.push_str("---|---|---|---|");
    }
    say(text, head);
    say(text, rule);
    for substeps in SUBSTEPS {
        let plural = if substeps == 1 { "" } else { "s" };
        let mut line = format!("| {substeps} substep{plural} |");
        for (_, solver) in SOLVERS {
            let mut rows = record.ladder(mechanism, solver);
            match rows.find(|row| row.substeps == substeps) {
                Some(row) => {
                    let order = record
                        .order(row)
                        .map_or_else(String::new, |order| format!("{order:.2}"));
                    let _ = write!(
                        line,
                        " {:.1e} | {order} | {:.1e} | {} |",
                        row.closure_error,
                        row.distance,
                        duration(row.wall_time)
                    );
                }
                None => line.push_str(" | | | |"),
            }
        }
        say(text, line);
    }
    for trace in record.traces_of(mechanism) {
        say(
            text,
            format!(
                "| trace, {} poses | {:.1e} | | | {} | | | | |",
                trace.poses,
                trace.closure_error,
                duration(trace.wall_time)
            ),
        );
    }
    say(text, String::new());
}

/// What reaches a closure error soonest.
fn advice(text: &mut String, record: &Record) {
    let mut head = "| closure error at most |".to_owned();
    let mut rule = "|---|".to_owned();
    let columns = || {
        SUBJECTS
            .iter()
            .flat_map(|subject| SOLVERS.map(|(_, solver)| (subject.name, solver)))
    };
    for (mechanism, solver) in columns() {
        let _ = write!(head, " {mechanism}, {solver} |");
        rule.push_str("---|");
    }
    say(text, head);
    say(text, rule);
    for wanted in WANTED {
        let mut line = format!("| {wanted:e} |");
        for (mechanism, solver) in columns() {
            let reaches = |row: &&Simulation| row.closure_error <= wanted;
            let cell = match record.ladder(mechanism, solver).find(reaches) {
                Some(row) => format!("{}: {}", row.substeps, duration(row.wall_time)),
                None => "—".to_owned(),
            };
            let _ = write!(line, " {cell} |");
        }
        say(text, line);
    }
    say(text, String::new());
}

/// The trace next to the simulation that reaches 1e-6 soonest.
fn compared(text: &mut String, record: &Record) {
    for subject in SUBJECTS {
        let (Some(simulation), Some(few), Some(many)) = (
            record.soonest(subject.name, 1e-6),
            record.traces_of(subject.name).find(|t| t.poses == POSES[0]),
            record.traces_of(subject.name).find(|t| t.poses == STEPS),
        ) else {
            continue;
        };
        let lines = [
            format!(
                "**{}**: the simulation that comes below 1e-6 soonest ({}, {} substeps) takes {}; with substeps cut to fit",
                capitalised(subject.name),
                simulation.solver,
                simulation.substeps,
                duration(simulation.wall_time)
            ),
            format!(
                "and steps for nothing it would be about {}. The trace of the turn closes to {:.0e}. It takes {} for {} poses, {:.1} times",
                duration(record.least_time(subject.name, 1e-6)),
                few.closure_error.max(many.closure_error),
                duration(few.wall_time),
                few.poses,
                simulation.wall_time / few.wall_time
            ),
            format!(
                "less than that simulation, and {} for {} poses, one for every step, {:.1} times less. Once the curve is",
                duration(many.wall_time),
                many.poses,
                simulation.wall_time / many.wall_time
            ),
            format!(
                "known, it gives {} poses per second.",
                thousands(many.poses_per_second)
            ),
            String::new(),
        ];
        for line in lines {
            say(text, line);
        }
    }
    // The last paragraph has a line of its own already.
    text.truncate(text.trim_end().len());
    text.push('\n');
}

fn duration(seconds: f64) -> String {
    if seconds < 0.00995 {
        format!("{:.1} ms", seconds * 1e3)
    } else if seconds < 0.9995 {
        format!("{:.0} ms", seconds * 1e3)
    } else {
        format!("{seconds:.2} s")
    }
}

/// Rounded to thousands, with commas.
fn thousands(x: f64) -> String {
    let number = (x / 1e3).round() as u64;
    if number >= 1000 {
        format!("{},{:03},000", number / 1000, number % 1000)
    } else {
        format!("{number},000")
    }
}

/// For the beginning of a sentence.
fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
