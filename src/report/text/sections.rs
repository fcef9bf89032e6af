//! The parts of the page below the counts. A part about which nothing is known is left out.

use super::page::Page;
use super::style::Tint;
use super::table::{Cell, Column, Subject, Table};
use super::words::{counted, figure, names};
use crate::mobility::Verdict;
use crate::report::schema::{Branch, Cycle, JointRow, Report};
use std::collections::BTreeMap;

/// Lists of names in a table show this many.
const NAMES_IN_CELL: usize = 12;

/// How the loops close.
pub(in crate::report) fn assembly(report: &Report, page: &mut Page) {
    let assembly = &report.assembly;
    if report.mobility.verdict == Verdict::Unassembled || assembly.closed == Some(false) {
        if assembly.gaps.is_empty() {
            return;
        }
        page.heading("Open loops");
        let mut table = Table::new()
            .column("loop", Column::Shrinking)
            .column("gap (m)", Column::Numbers)
            .column("angle (°)", Column::Numbers);
        for gap in &assembly.gaps {
            let subject = Subject::Cycle(gap.cycle.clone());
            table.row_about(
                subject,
                vec![
                    Cell::new(&gap.cycle),
                    Cell::new(figure(gap.left_position)).tint(Tint::Bad),
                    Cell::new(figure(gap.left_angle.to_degrees())),
                ],
            );
        }
        page.table(table, "loops");
        return;
    }
    let Some(moved) = assembly.moved.filter(|moved| *moved > 0.0) else {
        return;
    };
    page.heading("Assembly");
    let worst = assembly
        .gaps
        .iter()
        .max_by(|a, b| a.position.total_cmp(&b.position));
    let mut text = match worst {
        Some(gap) => format!(
            "As the file draws it, loop `{}` is open by {} m and {}°.",
            gap.cycle,
            figure(gap.position),
            figure(gap.angle.to_degrees())
        ),
        None => "The file's pose does not satisfy its couplings.".to_owned(),
    };
    text.push_str(&format!(
        " It was assembled by moving joints by up to {} m",
        figure(moved)
    ));
    if let Some(residual) = assembly.residual {
        text.push_str(&format!("; {} of a loop's size is left", figure(residual)));
    }
    text.push_str(". Everything here holds at the assembled pose.");
    page.paragraph(&text, Tint::Plain, "  ", "  ");
}

/// One row per joint; with its range, where ranges are known.
pub(in crate::report) fn joints(
    report: &Report,
    ranges: &BTreeMap<String, String>,
    page: &mut Page,
) {
    if report.joints.is_empty() {
        return;
    }
    page.heading("Joints");
    let roles = report.joints.iter().any(|joint| joint.locked.is_some());
    let wrenches = report
        .joints
        .iter()
        .any(|joint| joint.redundant_wrenches.is_some_and(|n| n > 0));
    let mut table = Table::new()
        .column("joint", Column::Shrinking)
        .column("type", Column::Words)
        .column("between", Column::Shrinking)
        .column("freedom", Column::Numbers);
    // Roles are those on the branches where there are any, and those at the pose otherwise.
    let branches = report.branches.as_deref().unwrap_or_default();
    if roles {
        let title = if branches.is_empty() {
            "here"
        } else {
            "in motion"
        };
        table = table.column(title, Column::Shrinking);
    }
    // A velocity that is not known to lead anywhere is no motion.
    let moves = match report.mobility.verdict {
        Verdict::Mobile => "moves",
        _ => "gives way",
    };
    if !ranges.is_empty() {
        table = table.column("range", Column::Shrinking);
    }
    if wrenches {
        table = table.column("undetermined", Column::Numbers);
    }
    table = table.column("", Column::Words);
    for joint in &report.joints {
        let mut row = vec![
            Cell::new(&joint.name).tint(Tint::Strong),
            Cell::new(format!("{} {}", joint.class, joint.kind.replace('_', " "))),
            Cell::new(format!("{} – {}", joint.links[0], joint.links[1])),
            Cell::new(joint.freedom.to_string()),
        ];
        if roles {
            row.push(role(joint, branches, moves));
        }
        if !ranges.is_empty() {
            row.push(Cell::new(
                ranges.get(&joint.name).map_or("–", String::as_str),
            ));
        }
        if wrenches {
            row.push(match joint.redundant_wrenches {
                Some(0) => Cell::new("·").tint(Tint::Quiet),
                Some(n) => Cell::new(n.to_string()),
                None => Cell::new("?").tint(Tint::Doubtful),
            });
        }
        row.push(
            Cell::new(if joint.closes_loop {
                "closes a loop"
            } else {
                ""
            })
            .tint(Tint::Quiet),
        );
        table.row_about(Subject::Joint(joint.name.clone()), row);
    }
    page.table(table, "joints");
    if wrenches {
        page.paragraph(
            "undetermined: directions of a joint's reaction that equilibrium alone does not fix, because constraints \
             repeat one another",
            Tint::Quiet,
            "  ",
            "  ",
        );
    }
}

fn role(joint: &JointRow, branches: &[Branch], moves: &str) -> Cell {
    let rests: Vec<&str> = branches
        .iter()
        .filter(|branch| branch.locked.contains(&joint.name))
        .map(|branch| branch.name.as_str())
        .collect();
    match (joint.freedom, joint.locked) {
        (0, _) => Cell::new("rigid").tint(Tint::Quiet),
        (_, None) => Cell::new("?").tint(Tint::Doubtful),
        (_, Some(true)) => Cell::new("locked").tint(Tint::Notable),
        (_, Some(false)) if !rests.is_empty() => {
            Cell::new(format!("locked on {}", rests.join(", "))).tint(Tint::Notable)
        }
        (_, Some(false)) if joint.locked_parts.is_empty() => Cell::new(moves),
        (_, Some(false)) => {
            let parts: Vec<&str> = joint
                .locked_parts
                .iter()
                .map(|part| {
                    part.strip_prefix(joint.name.as_str())
                        .and_then(|rest| rest.strip_prefix('.'))
                        .unwrap_or(part)
                })
                .collect();
            Cell::new(format!("{moves}; {} locked", parts.join(", "))).tint(Tint::Notable)
        }
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
    for coupling in &report.couplings {
        table.row(vec![Cell::new(&coupling.name), Cell::new(&coupling.text)]);
    }
    page.table(table, "couplings");
}

/// One row per basic cycle.
pub(in crate::report) fn cycles(report: &Report, page: &mut Page) {
    if report.cycles.is_empty() {
        return;
    }
    page.heading("Loops (basic cycles)");
    let most = limit(page);
    let mut table = Table::new()
        .column("loop", Column::Shrinking)
        .column("through", Column::Shrinking)
        .column("displacements", Column::Shrinking)
        .column("rank", Column::Numbers)
        .column("redundant", Column::Numbers)
        .column("freedom alone", Column::Numbers)
        .column("locks alone", Column::Shrinking);
    for cycle in &report.cycles {
        let subject = Subject::Cycle(cycle.name.clone());
        table.row_about(
            subject,
            vec![
                Cell::new(&cycle.name).tint(Tint::Strong),
                Cell::new(joints_of(cycle, most)),
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
}

fn joints_of(cycle: &Cycle, most: usize) -> String {
    if cycle.joints.len() <= most {
        cycle.joints.join(" ")
    } else {
        format!(
            "{} … ({})",
            cycle.joints[..most].join(" "),
            counted(cycle.joints.len(), "joint")
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
    let shown = if page.layout().verbose {
        report.advice.len()
    } else {
        report.advice.len().min(ADVICE)
    };
    for advice in &report.advice[..shown] {
        let text = format!(
            "{} (redundant: {} → {})",
            advice.text.trim_end_matches('.'),
            advice.redundant_before,
            advice.redundant_after
        );
        page.item(&text, Tint::Plain);
    }
    let left = report.advice.len() - shown;
    if left > 0 {
        let text = format!("… and {left} more: `--verbose` or `--format json` shows all");
        page.paragraph(&text, Tint::Quiet, "    ", "    ");
    }
}

/// Pieces of advice and warnings shown on a first screen.
const ADVICE: usize = 8;

/// What to beware of.
pub(in crate::report) fn warnings(report: &Report, page: &mut Page) {
    if report.warnings.is_empty() {
        return;
    }
    page.heading("Warnings");
    let shown = if page.layout().verbose {
        report.warnings.len()
    } else {
        report.warnings.len().min(ADVICE)
    };
    for warning in &report.warnings[..shown] {
        page.item(warning, Tint::Doubtful);
    }
    let left = report.warnings.len() - shown;
    if left > 0 {
        let text = format!("… and {left} more: `--verbose` or `--format json` shows all");
        page.paragraph(&text, Tint::Quiet, "    ", "    ");
    }
}

/// What only a verbose page shows, and times where they were asked for.
pub(in crate::report) fn details(report: &Report, page: &mut Page) {
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
