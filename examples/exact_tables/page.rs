//! The part of the page that is written by the program.

use super::measure::Result;
use super::record::{Cost, Figures, Record, Scene, Table};
use std::fmt::Write;

/// Between these lines the page is replaced.
pub const BEGIN: &str = "<!-- measured: begin -->";
/// See [`BEGIN`].
pub const END: &str = "<!-- measured: end -->";

const WAYS: [&str; 3] = ["all at once", "divide and conquer", "instancing"];

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
    let later = record.tables_date.as_ref();
    let later = later.map_or(String::new(), |date| {
        format!(" (the tables of the source on {date})")
    });
    let mut text = format!(
        "Measured on {}{later} on {}, one thread, optimised build. *v*, *e* and *b* are the numbers of variables, of equations and of \
         polynomials of the basis; the source counts trivial equations and its bases are lexicographic. Ours are given in \
         degrevlex, with the lexicographic size in parentheses where it differs.\n\n",
        record.date, record.machine
    );
    for table in &record.tables {
        published(&mut text, table);
    }
    say(&mut text, "### Larger mechanisms, three ways\n");
    for scene in &record.scenes {
        family(&mut text, scene);
    }
    say(&mut text, "### Loops of hinges\n");
    say(
        &mut text,
        "| loop | dimension | degree | basis | time of the basis |",
    );
    say(&mut text, "|---|---|---|---|---|");
    for one in &record.loops {
        say(
            &mut text,
            &format!(
                "| {} | {} | {} | {} | {} |",
                one.name,
                one.dimension.map_or("none".to_owned(), |d| d.to_string()),
                one.degree.map_or("–".to_owned(), |d| d.to_string()),
                one.basis,
                time(one.seconds)
            ),
        );
    }
    text
}

fn say(text: &mut String, line: &str) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "{line}");
}

/// A table of the source.
fn published(text: &mut String, table: &Table) {
    say(
        text,
        &format!("### Table {}: {}\n", table.number, table.title),
    );
    say(
        text,
        "| example | variables | way | equations of | 1994: v | e | b | time | now: v | e | b | time |",
    );
    say(text, "|---|---|---|---|---|---|---|---|---|---|---|---|");
    for row in &table.rows {
        let theirs = cells(row.published.as_ref(), |s| format!("{s} s"), "did not end");
        let ours = cells(row.ours.as_ref(), time, "limit");
        say(
            text,
            &format!(
                "| {} | {} | {} | {} | {theirs} | {ours} |",
                row.example, row.variables, row.way, row.what
            ),
        );
    }
    say(text, "");
}

fn cells(figures: Option<&Figures>, time: impl Fn(f64) -> String, endless: &str) -> String {
    let Some(figures) = figures else {
        return "– | – | – | –".to_owned();
    };
    let basis = match (figures.basis, figures.lexicographic) {
        (Some(basis), Some(lex)) if lex != basis => format!("{basis} ({lex})"),
        (Some(basis), _) => basis.to_string(),
        (None, _) => "–".to_owned(),
    };
    let seconds = figures.seconds.map_or(endless.to_owned(), time);
    let cases = match figures.cases {
        1 => String::new(),
        n => format!(" in {n} cases"),
    };
    format!(
        "{} | {} | {basis} | {seconds}{cases}",
        figures.variables, figures.equations
    )
}

/// A time with two digits.
fn time(seconds: f64) -> String {
    let two = |x: f64| {
        let places = (1 - x.log10().floor() as i32).max(0) as usize;
        format!("{x:.places$}")
    };
    match seconds {
        s if s < 1e-3 => format!("{} µs", two(s * 1e6)),
        s if s < 1.0 => format!("{} ms", two(s * 1e3)),
        s => format!("{} s", two(s)),
    }
}

fn family(text: &mut String, scene: &Scene) {
    say(
        text,
        &format!("**{}**: {}.\n", capitalised(&scene.name), scene.about),
    );
    say(
        text,
        &format!("| N | v | e | dimension | {} | cases |", WAYS.join(" | ")),
    );
    say(text, "|---|---|---|---|---|---|---|---|");
    for size in &scene.sizes {
        let fastest = size
            .ways
            .iter()
            .flatten()
            .map(|c| c.seconds)
            .fold(f64::INFINITY, f64::min);
        let cell = |cost: &Option<Cost>| match cost {
            None => "limit".to_owned(),
            Some(cost) if cost.seconds == fastest => format!("**{}**", time(cost.seconds)),
            Some(cost) => time(cost.seconds),
        };
        let ways: Vec<String> = size.ways.iter().map(cell).collect();
        say(
            text,
            &format!(
                "| {} | {} | {} | {} | {} | {} |",
                size.n,
                size.variables,
                size.equations,
                size.dimension.map_or("–".to_owned(), |d| d.to_string()),
                ways.join(" | "),
                size.cases.map_or("–".to_owned(), |c| c.to_string())
            ),
        );
    }
    say(text, "");
    say(text, &crossover(scene));
    say(text, "");
}

/// From which size on a way is quicker than all equations at once.
fn crossover(scene: &Scene) -> String {
    let said: Vec<String> = (1..3)
        .map(|way| {
            let quicker = |n: usize| {
                let [brute, other] = [0, way].map(|w| scene.sizes[n].ways[w].map(|c| c.seconds));
                match (brute, other) {
                    (_, None) => false,
                    (None, Some(_)) => true,
                    (Some(brute), Some(other)) => other < brute,
                }
            };
            let first = (0..scene.sizes.len()).find(|&k| (k..scene.sizes.len()).all(quicker));
            match first {
                Some(0) => format!("{} wins at every size", WAYS[way]),
                Some(k) => format!("{} wins from N = {} on", WAYS[way], scene.sizes[k].n),
                None => format!("{} does not win for good at these sizes", WAYS[way]),
            }
        })
        .collect();
    format!("Against all equations at once: {}.", said.join("; "))
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
