//! The parts of the pages that are written by the program: a table of all mechanisms, and for each its figure and two short
//! tables.

use super::record::{Record, Row};
use super::subjects::Result;
use kutzbach::accuracy::{Accuracy, Choice, Claim, Setting, choose};
use kutzbach::report::accuracy::figure;
use kutzbach::report::text::words::duration;
use std::fmt::Write;

/// Errors for which the page says what reaches them soonest.
pub const WANTED: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-8];

/// Ways that the page shows; the figure has all of them.
const SHOWN: [(&str, &str); 11] = [
    ("count", ""),
    ("rank", "53 bits"),
    ("rank", "106 bits"),
    ("subgroups", ""),
    ("chart test", "53 bits"),
    ("chart test", "106 bits"),
    ("chart test", "212 bits"),
    ("germ", "to order 4"),
    ("exact algebra", ""),
    (VERDICT, ""),
    (WHOLE_REPORT, ""),
];

/// All engines together, asked for no more than the name says.
const VERDICT: &str = "verdict";
const WHOLE_REPORT: &str = "whole report";

/// Name of the part that has all mechanisms.
const SUMMARY: &str = "summary";

fn begin(name: &str) -> String {
    format!("<!-- accuracy {name}: begin -->")
}

fn end(name: &str) -> String {
    format!("<!-- accuracy {name}: end -->")
}

/// The figure of a mechanism, seen from the package.
#[must_use]
pub fn figure_file(name: &str) -> String {
    format!("docs/src/images/accuracy_{name}.svg")
}

/// The figure of a mechanism.
#[must_use]
pub fn figure_of(row: &Row) -> String {
    figure(&row.accuracy)
        .titled(format!("{}: what accuracy costs", row.title))
        .document()
}

/// A page of the book with measured parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Page {
    /// All mechanisms in one table, and what a digit costs.
    Short,
    /// Each with its figure and tables.
    ByMechanism,
}

/// All of them.
pub const PAGES: [Page; 2] = [Page::Short, Page::ByMechanism];

impl Page {
    /// Its file, seen from the package.
    #[must_use]
    pub fn file(self) -> &'static str {
        match self {
            Self::Short => "docs/src/accuracy.md",
            Self::ByMechanism => "docs/src/accuracy_by_mechanism.md",
        }
    }

    /// The page with its measured parts replaced.
    ///
    /// # Errors
    /// Where the page lacks a marker.
    pub fn replaced(self, page: &str, record: &Record) -> Result<String> {
        let mut page = page.to_owned();
        for (name, text) in self.parts(record) {
            let lacks = |marker: &str| format!("the page has no line `{marker}`");
            let (begin, end) = (begin(&name), end(&name));
            let (before, rest) = page.split_once(&begin).ok_or_else(|| lacks(&begin))?;
            let (_, after) = rest.split_once(&end).ok_or_else(|| lacks(&end))?;
            page = format!("{before}{begin}\n\n{text}\n{end}{after}");
        }
        Ok(page)
    }

    /// What is measured, as Markdown: by the name of its markers.
    #[must_use]
    pub fn parts(self, record: &Record) -> Vec<(String, String)> {
        let rows = record.mechanisms.iter();
        match self {
            Self::Short => vec![(SUMMARY.to_owned(), summary(record))],
            Self::ByMechanism => rows.map(|row| (row.name.clone(), one(row))).collect(),
        }
    }
}

fn say(text: &mut String, line: &str) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "{line}");
}

/// The settings that the choice is made of: those of the motion, or of the scene where there is none.
fn settings(accuracy: &Accuracy) -> &[Setting] {
    match &accuracy.scene {
        Some(scene) if accuracy.simulation.rows.is_empty() => &scene.rows,
        _ => &accuracy.simulation.rows,
    }
}

/// The cheapest of the ways that decide by themselves.
fn cheapest_way(accuracy: &Accuracy) -> String {
    let decides = accuracy
        .analysis
        .iter()
        .filter(|way| way.claim == Claim::Decides)
        .filter(|way| ![VERDICT, WHOLE_REPORT].contains(&way.name.as_str()))
        .min_by(|a, b| a.timing.seconds.total_cmp(&b.timing.seconds));
    decides.map_or("none alone".to_owned(), |way| {
        format!(
            "{}, {}",
            named(&way.name, &way.precision),
            duration(way.timing.seconds)
        )
    })
}

fn named(name: &str, precision: &str) -> String {
    if precision.is_empty() {
        name.to_owned()
    } else {
        format!("{name}, {precision}")
    }
}

fn chosen(choice: &Choice) -> String {
    choice.timing.map_or("—".to_owned(), |found| {
        format!(
            "{} ({})",
            duration(found.seconds_per_second),
            setting(&found.setting)
        )
    })
}

fn setting(setting: &kutzbach::accuracy::Chosen) -> String {
    format!(
        "{}, 1/{:.0} s ÷ {}",
        setting.solver.word(),
        1.0 / setting.time_step,
        setting.substeps
    )
}

fn summary(record: &Record) -> String {
    let mut text = format!(
        "Measured on {} on {}, one thread, release build; times of analyses are medians of up to seven runs, those of simulations \
         are of one run.\n\n",
        record.date, record.machine
    );
    say(
        &mut text,
        "| | finite freedom | verdict | whole report | cheapest way that decides alone | traced to 1e-14 | simulated within 1e-4 | within 1e-6 |",
    );
    say(&mut text, "|---|---|---|---|---|---|---|---|");
    for row in &record.mechanisms {
        let accuracy = &row.accuracy;
        let waited = |name: &str| {
            let way = accuracy.analysis.iter().find(|way| way.name == name);
            way.map_or("—".to_owned(), |way| duration(way.timing.seconds))
        };
        let finest = accuracy.motion.rows.last();
        let within = |error: f64| chosen(&choose(settings(accuracy), error));
        say(
            &mut text,
            &format!(
                "| {} | {} | {} | {} | {} | {} | {} | {} |",
                row.title,
                accuracy.finite.map_or("open".to_owned(), |f| f.to_string()),
                waited(VERDICT),
                waited(WHOLE_REPORT),
                cheapest_way(accuracy),
                finest.map_or("—".to_owned(), |row| {
                    format!("{} poses/s", thousands(row.timing.poses_per_second))
                }),
                within(1e-4),
                within(1e-6),
            ),
        );
    }
    text + &price(record)
}

/// What an error of 1e-4 costs, and each further digit: over all mechanisms that have both.
fn price(record: &Record) -> String {
    let paid = |row: &Row, wanted: f64| {
        let found = choose(settings(&row.accuracy), wanted).timing?;
        Some((found.error, found.seconds_per_second))
    };
    let mut seconds = Vec::new();
    let mut factors = Vec::new();
    for row in &record.mechanisms {
        let (Some(coarse), Some(fine)) = (paid(row, 1e-4), paid(row, 1e-6)) else {
            continue;
        };
        seconds.push(coarse.1);
        factors.push((fine.1 / coarse.1).powf(1.0 / (coarse.0 / fine.0).log10()));
    }
    let ends = |numbers: &mut Vec<f64>| {
        numbers.sort_by(f64::total_cmp);
        Some((*numbers.first()?, *numbers.last()?))
    };
    match (ends(&mut seconds), ends(&mut factors)) {
        (Some((least, most)), Some((cheapest, dearest))) => format!(
            "\n**A ten-thousandth of a machine's length costs from {} to {} for a second of motion in the physics engine, each further digit \
             {cheapest:.1} to {dearest:.1} times as much.**\n",
            duration(least),
            duration(most)
        ),
        _ => String::new(),
    }
}

fn one(row: &Row) -> String {
    let accuracy = &row.accuracy;
    let mut text = format!(
        "![{}: error over the time for a second of motion, and the time of every way to know how it moves](images/accuracy_{}.svg)\n\n",
        row.title, row.name
    );
    analysis(&mut text, accuracy);
    motion(&mut text, accuracy);
    simulation(&mut text, accuracy);
    scene(&mut text, accuracy);
    effects(&mut text, accuracy);
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

fn analysis(text: &mut String, accuracy: &Accuracy) {
    say(text, "| method | result | verdict | margin | time |");
    say(text, "|---|---|---|---|---|");
    for (name, precision) in SHOWN {
        let way = accuracy
            .analysis
            .iter()
            .find(|way| way.name == name && (precision.is_empty() || way.precision == precision));
        let Some(way) = way else { continue };
        say(
            text,
            &format!(
                "| {} | {} | {} | {} | {} |",
                named(name, precision),
                way.says,
                way.claim.word(),
                way.decades
                    .map_or(String::new(), |d| format!("{d:.0} decades")),
                if way.timing.runs > 0 {
                    duration(way.timing.seconds)
                } else {
                    "not asked".to_owned()
                }
            ),
        );
    }
    say(text, "");
}

fn motion(text: &mut String, accuracy: &Accuracy) {
    let motion = &accuracy.motion;
    if let Some(still) = &motion.still {
        say(text, &format!("Tracing: {still}.\n"));
        return;
    }
    let (Some(coarse), Some(fine)) = (motion.rows.first(), motion.rows.last()) else {
        return;
    };
    say(
        text,
        &format!(
            "Tracing: the curve takes {}; then {} poses per second at a tolerance of {:.0e}, which come out within {:.1e}, and {} at \
             {:.0e}, within {:.1e}.\n",
            duration(motion.timing.seconds),
            thousands(coarse.timing.poses_per_second),
            coarse.tolerance,
            coarse.error(),
            thousands(fine.timing.poses_per_second),
            fine.tolerance,
            fine.error()
        ),
    );
}

fn simulation(text: &mut String, accuracy: &Accuracy) {
    if let Some(why) = &accuracy.simulation.why_not {
        say(text, &format!("Simulating: {why}.\n"));
    }
    let rows = settings(accuracy);
    if rows.is_empty() {
        return;
    }
    say(
        text,
        "| error at most | cheapest setting | its error | time for a simulated second |",
    );
    say(text, "|---|---|---|---|");
    for wanted in WANTED {
        let choice = choose(rows, wanted);
        let cells = choice
            .timing
            .map_or(["—".to_owned(), String::new(), String::new()], |f| {
                [
                    setting(&f.setting),
                    format!("{:.1e}", f.error),
                    duration(f.seconds_per_second),
                ]
            });
        say(text, &format!("| {wanted:.0e} | {} |", cells.join(" | ")));
    }
    say(text, "");
    let left = rows.iter().filter(|row| row.timing.is_none()).count();
    if left > 0 {
        say(
            text,
            &format!(
                "{left} of {} settings were left out, for more work than about four seconds each.\n",
                rows.len()
            ),
        );
    }
}

/// The scene, where there is one besides the motion.
fn scene(text: &mut String, accuracy: &Accuracy) {
    let Some(scene) = accuracy
        .scene
        .as_ref()
        .filter(|_| !accuracy.simulation.rows.is_empty())
    else {
        return;
    };
    let cells: Vec<String> = WANTED
        .into_iter()
        .filter_map(|wanted| {
            let found = choose(&scene.rows, wanted).timing?;
            let time = duration(found.seconds_per_second);
            Some(format!(
                "within {wanted:.0e} {} in {time}",
                setting(&found.setting)
            ))
        })
        .collect();
    say(
        text,
        &format!(
            "Under its scene ({}), loops stay closed {}.\n",
            if scene.effects.is_empty() {
                "drives only".to_owned()
            } else {
                scene.effects.join(", ")
            },
            if cells.is_empty() {
                "within 1e-3 at no setting".to_owned()
            } else {
                cells.join("; ")
            }
        ),
    );
}

fn effects(text: &mut String, accuracy: &Accuracy) {
    let called: Vec<_> = accuracy
        .effects
        .iter()
        .filter(|row| row.called_for)
        .collect();
    let Some(without) = accuracy.effects.first().and_then(|row| row.timing.step) else {
        return;
    };
    if called.len() < 2 {
        return;
    }
    say(text, "| effect | a step takes | times that without |");
    say(text, "|---|---|---|");
    for row in accuracy.effects.iter().take(1).chain(called) {
        let step = row.timing.step;
        say(
            text,
            &format!(
                "| {} | {} | {} |",
                row.effects,
                step.map_or("—".to_owned(), duration),
                step.map_or(String::new(), |s| format!("{:.2}", s / without))
            ),
        );
    }
    say(text, "");
}

/// Rounded to three digits, with commas.
fn thousands(x: f64) -> String {
    let power = 10f64.powf((x.max(1.0).log10().floor() - 2.0).max(0.0));
    let digits = ((x / power).round() * power).round().to_string();
    let mut shown = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            shown.push(',');
        }
        shown.push(digit);
    }
    shown
}
