//! The branches through the pose, how links move on them, and what the engines found.

use super::cite;
use super::page::Page;
use super::sections::{limit, unsure};
use super::style::Tint;
use super::table::{Cell, Column, Subject, Table};
use super::words::names;
use crate::report::natural::natural_order;
use crate::report::schema::{Evidence, Motion, Report};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Motions shown on a first screen.
const MOTIONS: usize = 12;

/// The branches through the pose.
pub(in crate::report) fn branches(report: &Report, page: &mut Page) {
    let Some(branches) = report.branches.as_ref().filter(|b| !b.is_empty()) else {
        return;
    };
    page.heading(&format!("Branches through this pose ({})", cite::BRANCH));
    let most = limit(page);
    let halves = branches.iter().any(|b| b.half_branches.is_some());
    let mut table = Table::new()
        .column("branch", Column::Shrinking)
        .column("freedom", Column::Numbers)
        .column("instantaneous", Column::Numbers)
        .column("redundant", Column::Numbers);
    if halves {
        table = table.column("half-branches", Column::Numbers);
    }
    table = table
        .column("locked joints", Column::Shrinking)
        .column("idle links", Column::Shrinking);
    for branch in branches {
        let idle: Vec<String> = branch
            .idle
            .iter()
            .map(|idle| format!("{} ({})", idle.links.join(" with "), idle.freedom))
            .collect();
        let mut cells = vec![
            Cell::new(&branch.name).tint(Tint::Strong),
            Cell::new(branch.dimension.to_string()),
            Cell::new(unsure(branch.instantaneous)),
            Cell::new(unsure(branch.redundant)),
        ];
        if halves {
            // Only a curve has two ends.
            cells.push(Cell::new(
                branch
                    .half_branches
                    .map_or_else(|| "–".to_owned(), |n| n.to_string()),
            ));
        }
        cells.push(Cell::new(names(&branch.locked, most)));
        cells.push(Cell::new(names(&idle, most)));
        table.row(cells);
    }
    page.table(table, "branches");
}

/// How links move relative to one another: the pairs that were asked for, then the rest, which a first screen shows the
/// most interesting rows of.
pub(in crate::report) fn motions(report: &Report, page: &mut Page) {
    let (asked, others): (Vec<&Motion>, Vec<&Motion>) =
        report.motions.iter().partition(|motion| motion.asked);
    let several = report.branches.as_ref().is_some_and(|b| b.len() > 1);
    if !asked.is_empty() {
        page.heading(&format!("Relative motions asked for ({})", cite::MOTION));
        motion_table(&asked, several, page);
    }
    if others.is_empty() {
        return;
    }
    page.heading(&format!("Motions ({})", cite::MOTION));
    let all = others.len();
    let shown = if page.layout().verbose || all <= MOTIONS {
        others
    } else {
        foremost(report, others)
    };
    motion_table(&shown, several, page);
    if shown.len() < all {
        let text = format!(
            "… and {} more: `--verbose` or `--format json` shows all {all}, `--between A B` any pair",
            all - shown.len()
        );
        page.paragraph(&text, Tint::Quiet, "  ", "  ");
    }
}

fn motion_table(motions: &[&Motion], several: bool, page: &mut Page) {
    let mut table = Table::new();
    if several {
        table = table.column("branch", Column::Words);
    }
    table = table
        .column("link", Column::Shrinking)
        .column("seen from", Column::Shrinking)
        .column("freedom", Column::Numbers)
        .column("moves by", Column::Shrinking);
    for motion in motions {
        let mut cells = Vec::new();
        if several {
            cells.push(Cell::new(&motion.branch));
        }
        cells.extend([
            Cell::new(&motion.link).tint(Tint::Strong),
            Cell::new(&motion.relative_to),
            Cell::new(motion.freedom.to_string()),
            Cell::new(format!("{}: {}", motion.class, motion.text)),
        ]);
        table.row_about(Subject::Link(motion.link.clone()), cells);
    }
    page.table(table, "motions");
}

/// The rows for a first screen: ends of open chains first, since tools are held there, then the links with most joints
/// between them and the link they are seen from. Rows of one link stay together.
fn foremost<'a>(report: &Report, mut motions: Vec<&'a Motion>) -> Vec<&'a Motion> {
    let mut neighbours: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for joint in &report.joints {
        let [a, b] = joint.links.each_ref().map(String::as_str);
        neighbours.entry(a).or_default().push(b);
        neighbours.entry(b).or_default().push(a);
    }
    let mut distance: BTreeMap<&str, usize> = BTreeMap::new();
    let roots: BTreeSet<&str> = motions.iter().map(|m| m.relative_to.as_str()).collect();
    let mut queue: VecDeque<(&str, usize)> = roots.into_iter().map(|root| (root, 0)).collect();
    while let Some((link, away)) = queue.pop_front() {
        if distance.contains_key(link) {
            continue;
        }
        distance.insert(link, away);
        for next in neighbours.get(link).into_iter().flatten() {
            queue.push_back((next, away + 1));
        }
    }
    let interest = |motion: &Motion| {
        let link = motion.link.as_str();
        let inner = neighbours.get(link).map_or(0, Vec::len) > 1;
        let away = distance.get(link).copied().unwrap_or(usize::MAX);
        (inner, Reverse(away))
    };
    motions.sort_by(|a, b| {
        interest(a)
            .cmp(&interest(b))
            .then_with(|| natural_order(&a.link, &b.link))
    });
    motions.truncate(MOTIONS);
    motions
}

/// What every engine found, where it was asked for.
pub(in crate::report) fn evidence(report: &Report, page: &mut Page) {
    let Some(evidence) = &report.evidence else {
        return;
    };
    page.heading(&format!("Evidence ({})", cite::EVIDENCE));
    if evidence.is_empty() {
        let text = "No engine was asked: nothing here needs one.";
        page.paragraph(text, Tint::Plain, "  ", "  ");
        return;
    }
    let several = evidence.iter().any(|e| e.block != evidence[0].block);
    for found in evidence {
        page.item(&finding(found, several), Tint::Plain);
    }
}

fn finding(found: &Evidence, several: bool) -> String {
    let block = if several {
        format!("block `{}`, ", found.block)
    } else {
        String::new()
    };
    let bounds = match found.bounds {
        [Some(least), Some(most)] if least == most => format!("finite freedom {least}"),
        [None | Some(0), Some(most)] => format!("finite freedom at most {most}"),
        [Some(least), Some(most)] => format!("finite freedom between {least} and {most}"),
        [Some(least), None] if least > 0 => format!("finite freedom at least {least}"),
        [_, None] => "no bound".to_owned(),
    };
    format!(
        "{block}{} ({}): {bounds}. {}",
        found.engine,
        found.scope,
        found.text.trim_end_matches('.')
    )
}

#[cfg(test)]
#[path = "branches_tests.rs"]
mod tests;
