//! The part of the page that is written by the program.

use super::claims::claims;
use super::record::{Record, Run, drift_share, growth, largest, order};
use super::runs::{SOLVERS, Subject};
use super::watch::Result;
use std::fmt::Write;

/// Between these lines the page is replaced.
pub const BEGIN: &str = "<!-- measured: begin -->";
/// See [`BEGIN`].
pub const END: &str = "<!-- measured: end -->";

/// Those that are held to their traced motion.
const HELD: [Subject; 3] = [Subject::Bennett, Subject::Scissor, Subject::Stewart];

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
        "Measured on {} on {}. Gaps and distances in characteristic lengths or rad, whichever is larger.\n\n",
        record.date, record.machine
    );
    gaps(&mut text, record);
    energies(&mut text, record);
    drifts(&mut text, record);
    text
}

fn say(text: &mut String, line: String) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "{line}");
}

/// The long runs, in the order of the tables.
pub fn long_runs(record: &Record) -> Vec<&Run> {
    let all = HELD
        .into_iter()
        .flat_map(|subject| SOLVERS.map(|solver| record.long(subject, solver)));
    all.flatten().collect()
}

fn name(run: &Run) -> String {
    format!("{}, {}", run.subject.title(), run.solver)
}

/// Closure error and distance from the trace.
fn gaps(text: &mut String, record: &Record) {
    say(
        text,
        "| run | substeps | steps | closure error, first tenth | last tenth | drift | distance from the trace, first tenth | last tenth | drift |".to_owned(),
    );
    say(text, "|---|---|---|---|---|---|---|---|---|".to_owned());
    for run in long_runs(record) {
        let mut line = format!(
            "| {} | {} | {} |",
            name(run),
            run.substeps,
            thousands(run.steps)
        );
        for list in [&run.seen.closure, &run.seen.distance] {
            let first = largest(&list[..list.len() / 10]);
            let _ = write!(
                line,
                " {first:.3e} | {:.3e} | {} |",
                first * growth(list),
                share(drift_share(list))
            );
        }
        say(text, line);
    }
    let mut all = 0;
    let mut broken = Vec::new();
    for run in long_runs(record) {
        let claims = claims(run);
        all += claims.len();
        let failed = claims.into_iter().filter(|claim| !claim.holds());
        broken.extend(failed.map(|claim| {
            format!(
                "{}: {}, is {:.2} and may be {}",
                name(run),
                claim.what,
                claim.found,
                claim.allowed
            )
        }));
    }
    let kept = all - broken.len();
    let failed = match broken.as_slice() {
        [] => "; none fails".to_owned(),
        some => format!("; not kept: {}", some.join("; ")),
    };
    for line in [
        String::new(),
        "*Drift* is that of the straight line that fits all windows best, over the whole run, as a share of the mean.".to_owned(),
        format!("Of the {all} bounds that these runs are held to, {kept} are kept{failed}."),
        String::new(),
    ] {
        say(text, line);
    }
}

/// Energies and drives.
fn energies(text: &mut String, record: &Record) {
    say(
        text,
        "| run | substeps | energy less that of the trace, first window | last window | change of its mean | farthest behind, first window | last window |".to_owned(),
    );
    say(text, "|---|---|---|---|---|---|---|".to_owned());
    for run in long_runs(record) {
        let seen = &run.seen;
        let last = run.windows() - 1;
        let range = |i: usize| {
            format!(
                "{} … {}",
                signed(seen.energy_least[i]),
                signed(seen.energy_most[i])
            )
        };
        let behind = |i: usize| match run.subject {
            Subject::Scissor => "—".to_owned(),
            _ => format!("{:.1e}", seen.behind[i].abs()),
        };
        say(
            text,
            format!(
                "| {} | {} | {} | {} | {} | {} | {} |",
                name(run),
                run.substeps,
                range(0),
                range(last),
                signed(seen.energy_mean[last] - seen.energy_mean[0]),
                behind(0),
                behind(last)
            ),
        );
    }
    say(text, String::new());
}

/// What drifts, and at which order.
fn drifts(text: &mut String, record: &Record) {
    say(
        text,
        "| what drifts | solver | drift by substeps | order |".to_owned(),
    );
    say(text, "|---|---|---|---|".to_owned());
    for (subject, what) in [
        (
            Subject::Scissor,
            "the scissor's energy, share of the swing's height per second, until it has changed by a tenth",
        ),
        (Subject::Bennett, "the crank, rad per turn"),
        (
            Subject::Stewart,
            "a leg with its length corrected, characteristic lengths per period",
        ),
        (
            Subject::StewartUncorrected,
            "a leg told velocities alone, characteristic lengths per period",
        ),
    ] {
        for solver in SOLVERS {
            let ladder = record.ladder(subject, solver);
            let rows: Vec<String> = ladder
                .iter()
                .map(|run| format!("{}: {}", run.substeps, scientific(run.own_rate())))
                .collect();
            // What is rounding has no order.
            let rounding = ladder.iter().all(|run| run.own_rate().abs() < 1e-9);
            let order = match order(&ladder, Run::own_rate) {
                Some(order) if !rounding => format!("{order:.2}"),
                _ => "rounding".to_owned(),
            };
            say(
                text,
                format!(
                    "| {what} | {} | {} | {order} |",
                    solver.word(),
                    rows.join(", ")
                ),
            );
        }
    }
    say(text, String::new());
    say(
        text,
        "| closure error of the first window | solver | by substeps | order |".to_owned(),
    );
    say(text, "|---|---|---|---|".to_owned());
    for subject in HELD {
        for solver in SOLVERS {
            let ladder = record.ladder(subject, solver);
            let rows: Vec<String> = ladder
                .iter()
                .map(|run| format!("{}: {:.2e}", run.substeps, first_closure(run)))
                .collect();
            let order =
                order(&ladder, first_closure).map_or_else(String::new, |o| format!("{o:.2}"));
            say(
                text,
                format!(
                    "| {} | {} | {} | {order} |",
                    subject.title(),
                    solver.word(),
                    rows.join(", ")
                ),
            );
        }
    }
}

/// The closure error of the first window.
pub fn first_closure(run: &Run) -> f64 {
    run.seen.closure[0]
}

/// In per cent; what is less than a thousandth of one is nothing.
fn share(x: f64) -> String {
    let percent = 100.0 * x;
    if percent.abs() < 1e-3 {
        "0".to_owned()
    } else {
        format!("{} %", sign(format!("{percent:+.3}")))
    }
}

/// In per cent, with its sign.
fn signed(x: f64) -> String {
    let percent = 100.0 * x;
    if percent.abs() < 5e-4 {
        "0".to_owned()
    } else {
        format!("{} %", sign(format!("{percent:+.3}")))
    }
}

fn scientific(x: f64) -> String {
    sign(format!("{x:+.2e}"))
}

/// A minus sign that does not break from its number, for people; that of an exponent stays as it is.
fn sign(number: String) -> String {
    match number.strip_prefix('-') {
        Some(rest) => format!("−{rest}"),
        None => number,
    }
}

/// With commas.
fn thousands(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}
