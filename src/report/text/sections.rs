//! The parts of the page below the counts. A part about which nothing is known is left out.

use super::alternatives::Alternatives;
use super::folded::Folded;
use super::page::Page;
use super::style::Tint;
use super::table::{Cell, Column, Subject, Table};
use super::words::{counted, figure, names};
use crate::report::schema::{Advice, Cycle, Report};
use std::collections::BTreeSet;

/// Lists of names in a table show this many.
const NAMES_IN_CELL: usize = 12;

/// Couplings shown on a first screen.
const COUPLINGS: usize = 8;

/// Says that a list goes on.
pub(super) fn more(left: usize, page: &mut Page) {
    if left > 0 {
        let text = format!("… and {left} more: `--verbose` or `--format json` shows all");
        page.paragraph(&text, Tint::Quiet, "    ", "    ");
    }
}

/// The couplings' equations.
pub(in crate::report) fn couplings(report: &Report, page: &mut Page) {
    if report.couplings.is_empty() {
        return;
    }
    page.heading("Couplings");
    let mut table = Table::new()
        .column("coupling", Column::Shrinking)
        .column("equation (rad, m)", Column::Shrinking);
    let all = report.couplings.len();
    let shown = match page.layout().verbose || all <= COUPLINGS {
        true => all,
        false => COUPLINGS,
    };
    for coupling in &report.couplings[..shown] {
        table.row(vec![Cell::new(&coupling.name), Cell::new(&coupling.text)]);
    }
    page.table(table, "couplings");
    more(all - shown, page);
}

/// One row per basic cycle.
pub(in crate::report) fn cycles(report: &Report, page: &mut Page) {
    if report.cycles.is_empty() {
        return;
    }
    page.heading("Loops (basic cycles)");
    let most = limit(page);
    let folded = match page.layout().verbose {
        true => BTreeSet::new(),
        false => Folded::of(report).joints,
    };
    let mut table = Table::new()
        .column("loop", Column::Shrinking)
        .column("through", Column::Shrinking)
        .column("displacements", Column::Shrinking)
        .column("rank", Column::Numbers)
        .column("redundant", Column::Numbers)
        .column("freedom alone", Column::Numbers)
        .column("locks alone", Column::Shrinking);
    let all = report.cycles.len();
    let shown = match page.layout().verbose {
        true => all,
        false => rows_of(all),
    };
    for cycle in &report.cycles[..shown] {
        let subject = Subject::Cycle(cycle.name.clone());
        table.row_about(
            subject,
            vec![
                Cell::new(&cycle.name).tint(Tint::Strong),
                Cell::new(joints_of(cycle, &folded, most)),
                Cell::new(space(cycle)),
                Cell::new(unsure(cycle.rank)),
                Cell::new(unsure(cycle.redundant)),
                Cell::new(unsure(cycle.mobility)),
                Cell::new(if cycle.locks.is_empty() {
                    "–".to_owned()
                } else {
                    names(&cycle.locks, most)
                }),
            ],
        );
    }
    page.table(table, "loops");
    more(all - shown, page);
}

/// Rows of a first screen where one or two more would not be worth the line that says so.
pub(super) fn rows_of(all: usize) -> usize {
    match all {
        0..=10 => all,
        _ => 8,
    }
}

fn joints_of(cycle: &Cycle, folded: &BTreeSet<&str>, most: usize) -> String {
    let joints: Vec<&str> = cycle
        .joints
        .iter()
        .map(String::as_str)
        .filter(|joint| !folded.contains(joint))
        .collect();
    if joints.len() <= most {
        joints.join(" ")
    } else {
        format!(
            "{} … ({})",
            joints[..most].join(" "),
            counted(joints.len(), "joint")
        )
    }
}

fn space(cycle: &Cycle) -> String {
    match (&cycle.space, cycle.space_text.as_str()) {
        (Some(short), "") => short.clone(),
        (Some(short), text) => format!("{short}: {text}"),
        (None, "") => "?".to_owned(),
        (None, text) => text.to_owned(),
    }
}

pub(super) fn unsure(count: Option<impl ToString>) -> String {
    count.map_or_else(|| "?".to_owned(), |n| n.to_string())
}

/// What to change.
pub(in crate::report) fn advice(report: &Report, page: &mut Page) {
    if report.advice.is_empty() {
        return;
    }
    page.heading("Advice");
    if page.layout().verbose || report.advice.len() <= ADVICE {
        for advice in &report.advice {
            page.item(&told(&advice.text, advice), Tint::Plain);
        }
        return;
    }
    let mut left = report.advice.len();
    for change in Alternatives::of(&report.advice).iter().take(CHANGES) {
        page.item(&told(&change.text(), change.first), Tint::Plain);
        left -= change.pieces();
    }
    more(left, page);
}

fn told(text: &str, advice: &Advice) -> String {
    format!(
        "{} (redundant: {} → {})",
        text.trim_end_matches('.'),
        advice.redundant_before,
        advice.redundant_after
    )
}

/// Changes shown on a first screen where there are more than [`ADVICE`] pieces of advice.
const CHANGES: usize = 4;

/// Pieces of advice and warnings shown on a first screen.
const ADVICE: usize = 8;

/// What to beware of.
pub(in crate::report) fn warnings(report: &Report, page: &mut Page) {
    if report.warnings.is_empty() {
        return;
    }
    page.heading("Warnings");
    let warnings = match page.layout().verbose {
        true => report.warnings.clone(),
        false => repeated_once(&report.warnings),
    };
    let shown = match page.layout().verbose {
        true => warnings.len(),
        false => warnings.len().min(ADVICE),
    };
    for warning in &warnings[..shown] {
        page.item(warning, Tint::Doubtful);
    }
    more(warnings.len() - shown, page);
}

/// Warnings that differ only in the place they speak of, once, with the number of places: `14 × …, first in line 35`.
fn repeated_once(warnings: &[String]) -> Vec<String> {
    let mut counted: Vec<(&str, &str, usize)> = Vec::new();
    for warning in warnings {
        // As `line 35, column 5: …`.
        let (place, text) = match warning.split_once(": ") {
            Some((place, text)) if place.starts_with("line ") => (place, text),
            _ => ("", warning.as_str()),
        };
        match counted.iter_mut().find(|(_, known, _)| *known == text) {
            Some((_, _, count)) => *count += 1,
            None => counted.push((place, text, 1)),
        }
    }
    counted
        .into_iter()
        .map(|(place, text, count)| match (count, place) {
            (1, "") => text.to_owned(),
            (1, place) => format!("{place}: {text}"),
            (many, "") => format!("{many} × {text}"),
            (many, place) => format!("{many} × {text} (first in {place})"),
        })
        .collect()
}

/// What of the file was not read, in one line; a verbose page lists it with places.
fn unread(report: &Report, page: &mut Page) {
    const KINDS: usize = 12;
    if report.skipped.is_empty() {
        return;
    }
    let short = |line: &String| {
        let (_, what) = line
            .split_once(": ")
            .filter(|(place, _)| place.starts_with("line "))
            .unwrap_or(("", line));
        let what = what.split(" (first at ").next().unwrap_or(what);
        what.to_owned()
    };
    let mut kinds: Vec<String> = report.skipped.iter().take(KINDS).map(short).collect();
    let left = report.skipped.len().saturating_sub(KINDS);
    if left > 0 {
        kinds.push(format!("and {left} more kinds"));
    }
    let text = format!("Not read: {} (`--verbose` says where).", kinds.join(", "));
    page.paragraph(&text, Tint::Quiet, "  ", "  ");
}

/// What only a verbose page shows, and times where they were asked for.
pub(in crate::report) fn details(report: &Report, page: &mut Page) {
    if !page.layout().verbose {
        unread(report, page);
    }
    if page.layout().verbose {
        blocks(report, page);
        rank_details(report, page);
        if !report.skipped.is_empty() {
            page.heading("Not read, because it says nothing about motion");
            for skipped in &report.skipped {
                page.item(skipped, Tint::Quiet);
            }
        }
        if let Some(tree) = &report.tree {
            page.heading("Spanning tree");
            let text = format!(
                "Rooted at `{}`, {} deep.",
                tree.root,
                counted(tree.depth, "joint")
            );
            page.paragraph(&text, Tint::Plain, "  ", "  ");
            let mut table = Table::new()
                .column("link", Column::Shrinking)
                .column("hangs on", Column::Shrinking)
                .column("by joint", Column::Shrinking)
                .column("depth", Column::Numbers);
            for link in &tree.links {
                table.row(vec![
                    Cell::new(&link.link),
                    Cell::new(&link.parent),
                    Cell::new(&link.joint),
                    Cell::new(link.depth.to_string()),
                ]);
            }
            page.table(table, "links");
        }
    }
    if let Some(timing) = &report.timing {
        page.heading("Time");
        let mut table = Table::new()
            .column("stage", Column::Words)
            .column("ms", Column::Numbers);
        for stage in &timing.stages {
            table.row(vec![
                Cell::new(&stage.name),
                Cell::new(format!("{:.3}", stage.ms)),
            ]);
        }
        table.row(vec![
            Cell::new("all").tint(Tint::Strong),
            Cell::new(format!("{:.3}", timing.total_ms)),
        ]);
        page.table(table, "stages");
    }
}

fn blocks(report: &Report, page: &mut Page) {
    if report.home.blocks.is_empty() {
        return;
    }
    page.heading("Blocks analysed apart");
    let mut table = Table::new()
        .column("block", Column::Shrinking)
        .column("joints", Column::Numbers)
        .column("variables", Column::Numbers)
        .column("rank", Column::Numbers)
        .column("freedom", Column::Numbers);
    for block in &report.home.blocks {
        table.row(vec![
            Cell::new(&block.name),
            Cell::new(block.joints.to_string()),
            Cell::new(block.unknowns.to_string()),
            Cell::new(unsure(block.rank)),
            Cell::new(unsure(block.instantaneous)),
        ]);
    }
    page.table(table, "blocks");
}

fn rank_details(report: &Report, page: &mut Page) {
    let home = &report.home;
    if home.method.is_empty() {
        return;
    }
    page.heading("Rank");
    let mut text = format!("Found by {}", home.method);
    if let Some(bits) = home.bits {
        text.push_str(&format!(" with {bits} bits"));
    }
    if let Some(accuracy) = home.accuracy {
        text.push_str(&format!("; equations known to {}", figure(accuracy)));
    }
    if let Some(gap) = home.gap {
        text.push_str(&format!("; gap {}", figure(gap)));
    }
    text.push('.');
    page.paragraph(&text, Tint::Plain, "  ", "  ");
}

/// How many names a cell shows.
pub(super) fn limit(page: &Page) -> usize {
    if page.layout().verbose {
        usize::MAX
    } else {
        NAMES_IN_CELL
    }
}
