//! The joints: on a first screen those that need a word, and in one line those that simply move.

use super::escape::columns;
use super::folded::Folded;
use super::page::Page;
use super::sections::more;
use super::style::Tint;
use super::table::{Cell, Column, Subject, Table};
use super::words::{counted, mirrored_runs};
use crate::schema::{Branch, JointRow, Report};
use kutzbach_mobility::Verdict;
use std::collections::{BTreeMap, BTreeSet};

/// Up to so many joints are shown as rows, whatever they do.
const ROWS: usize = 12;

/// With more, so many of a kind are told in a line.
const ALIKE: usize = 2;

/// Rows of a first screen.
const MOST_ROWS: usize = 16;

/// And where nothing is known of any joint.
const UNKNOWN_ROWS: usize = 8;

/// Joints, or runs of them, named in a line.
const NAMED: usize = 6;

/// One row per joint, with its range where ranges are known. A first screen leaves out what is only fixed, and says of joints
/// that move without anything more to say how many they are; a page leaves out what is only fixed.
pub(crate) fn joints(
    report: &Report,
    ranges: &BTreeMap<String, String>,
    on_page: bool,
    page: &mut Page,
) {
    if report.joints.is_empty() {
        return;
    }
    page.heading("Joints");
    let verbose = page.layout().verbose;
    let folded = match verbose && !on_page {
        true => Folded::default(),
        false => Folded::of(report),
    };
    let mut rows: Vec<&JointRow> = report.joints.iter().collect();
    rows.retain(|joint| !folded.joints.contains(joint.name.as_str()));
    let summed_up = match verbose {
        true => Vec::new(),
        false => summed_up(report, &mut rows),
    };
    let all = rows.len();
    if !verbose {
        let unknown = rows.iter().all(|joint| joint.locked.is_none());
        rows.truncate(match unknown && rows.len() > MOST_ROWS {
            true => UNKNOWN_ROWS,
            false => MOST_ROWS,
        });
    }
    if !rows.is_empty() {
        joint_table(report, &rows, ranges, page);
    }
    more(all - rows.len(), page);
    for line in summed_up {
        page.paragraph(&line, Tint::Plain, "  ", "    ");
    }
    if !folded.joints.is_empty() {
        let many = counted(folded.joints.len(), "fixed joint");
        let how = match on_page {
            true => String::new(),
            false => ": `--verbose` lists them".to_owned(),
        };
        let text = format!("{many} of the tree left out with the links they carry{how}");
        page.paragraph(&text, Tint::Quiet, "  ", "    ");
    }
}

/// Takes out the rows of joints of which nothing more is to be said, where they are many: those that move outside loops and
/// couplings, those that couplings alone tie, and, if that does not make the table short, those in loops, and those that
/// rest.
fn summed_up(report: &Report, rows: &mut Vec<&JointRow>) -> Vec<String> {
    let in_loops: BTreeSet<&str> = report
        .cycles
        .iter()
        .flat_map(|cycle| cycle.joints.iter().map(String::as_str))
        .collect();
    let branches = report.branches.as_deref().unwrap_or_default();
    let moving = |joint: &JointRow| {
        let rests = branches.iter().any(|b| b.locked.contains(&joint.name));
        joint.freedom > 0 && joint.locked == Some(false) && joint.locked_parts.is_empty() && !rests
    };
    let loaded = |joint: &JointRow| joint.redundant_wrenches.unwrap_or(0);
    let plain = |joint: &JointRow| moving(joint) && loaded(joint) == 0 && !joint.closes_loop;
    let moves = match report.mobility.verdict {
        Verdict::Mobile => "move",
        _ => "have infinitesimal motions",
    };
    let mut lines = Vec::new();
    let mut take =
        |rows: &mut Vec<&JointRow>, wanted: &dyn Fn(&JointRow) -> bool, why: &str, least: usize| {
            let taken: Vec<String> = rows
                .iter()
                .filter(|joint| wanted(joint))
                .map(|joint| joint.name.clone())
                .collect();
            if taken.len() > least {
                rows.retain(|joint| !wanted(joint));
                let many = counted(taken.len(), "joint");
                lines.push(format!("{many} {why}: {}", mirrored_runs(&taken, NAMED)));
            }
        };
    // At a pose without known branches that holds for an instant only.
    let rest = match branches.is_empty() {
        true => "are locked here",
        false => "are locked",
    };
    let many = |rows: usize| if rows > ROWS { ALIKE } else { ROWS };
    let least = many(rows.len());
    let in_loop = |joint: &JointRow| in_loops.contains(joint.name.as_str());
    take(
        rows,
        &|joint| plain(joint) && joint.block.is_none(),
        "move, in no loop and no coupling",
        least,
    );
    take(
        rows,
        &|joint| plain(joint) && joint.block.is_some() && !in_loop(joint),
        &format!("{moves}, tied by couplings alone"),
        least,
    );
    let least = many(rows.len());
    if least == ALIKE {
        // Those whose reactions are as indeterminate as each other go together.
        let loads: BTreeSet<_> = report.joints.iter().map(loaded).collect();
        for load in loads {
            let same = |joint: &JointRow| loaded(joint) == load;
            let indeterminate = match load {
                0 => String::new(),
                1 => " (1 indeterminate reaction component each)".to_owned(),
                n => format!(" ({n} indeterminate reaction components each)"),
            };
            take(
                rows,
                &|joint| moving(joint) && in_loop(joint) && same(joint) && !joint.closes_loop,
                &format!("in loops {moves}{indeterminate}"),
                1,
            );
            take(
                rows,
                &|joint| (moving(joint) || joint.freedom == 0) && joint.closes_loop && same(joint),
                &format!("close loops{indeterminate}"),
                1,
            );
            take(
                rows,
                &|joint| joint.freedom > 0 && joint.locked == Some(true) && same(joint),
                &format!("{rest}{indeterminate}"),
                least,
            );
            // Where nothing is known of any joint, the table says so.
            if report.joints.iter().any(|joint| joint.locked.is_some()) {
                take(
                    rows,
                    &|joint| joint.freedom > 0 && joint.locked.is_none() && same(joint),
                    &format!("are undecided: they may move or not{indeterminate}"),
                    least,
                );
            }
        }
    }
    lines
}

/// What a joint does that is not locked at the pose. A velocity that is not known to lead anywhere is no motion; what is known is
/// known of each sub-mechanism, and a joint in none moves by itself.
fn moves(report: &Report, joint: &JointRow) -> &'static str {
    let blocks = &report.home.blocks;
    let own = joint.block.as_ref();
    let block = own.and_then(|label| blocks.iter().find(|block| block.label == *label));
    let mobile = match (own, block.and_then(|block| block.finite)) {
        (None, _) if !in_a_loop(report, &joint.name) => true,
        (_, Some(finite)) => finite > 0,
        (_, None) => report.mobility.verdict == Verdict::Mobile,
    };
    if mobile {
        "moves"
    } else {
        "infinitesimal motion"
    }
}

fn in_a_loop(report: &Report, joint: &str) -> bool {
    let mut loops = report.cycles.iter();
    loops.any(|cycle| cycle.joints.iter().any(|own| own == joint))
}

fn role(joint: &JointRow, branches: &[Branch], moves: &str) -> Cell {
    let rests: Vec<&str> = branches
        .iter()
        .filter(|branch| branch.locked.contains(&joint.name))
        .map(|branch| branch.name.as_str())
        .collect();
    match (joint.freedom, joint.locked) {
        (0, _) => Cell::new("fixed").tint(Tint::Quiet),
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

fn joint_table(
    report: &Report,
    rows: &[&JointRow],
    ranges: &BTreeMap<String, String>,
    page: &mut Page,
) {
    let chords = chords(report);
    let roles = rows.iter().any(|joint| joint.locked.is_some());
    let wrenches = rows
        .iter()
        .any(|joint| joint.redundant_wrenches.is_some_and(|n| n > 0));
    // Two names cut short tell less than one that is whole.
    let between = page.layout().verbose || fits(rows, page.layout().width);
    let verbose = page.layout().verbose;
    let mut table = Table::new()
        .column("joint", Column::Shrinking)
        .column("type", Column::Words);
    if between {
        table = table.column("links", Column::Shrinking);
    }
    if verbose {
        table = table.column("DOF", Column::Numbers);
    }
    // Roles are those on the branches where there are any, and those at the pose otherwise.
    let branches = report.branches.as_deref().unwrap_or_default();
    let followed = !ranges.is_empty();
    if roles || followed {
        let title = match (followed, branches.is_empty()) {
            (true, _) => "range",
            (false, true) => "at this pose",
            (false, false) => "in motion",
        };
        table = table.column(title, Column::Shrinking);
    }
    if wrenches {
        table = table.column("indeterminate reactions", Column::Words);
    }
    if verbose {
        table = table.column("", Column::Words);
    }
    for joint in rows {
        let mut row = vec![
            Cell::new(&joint.name).tint(Tint::Strong),
            Cell::new(joint.kind.replace('_', " ")),
        ];
        if between {
            row.push(Cell::new(format!(
                "{} – {}",
                joint.links[0], joint.links[1]
            )));
        }
        if verbose {
            row.push(Cell::new(joint.freedom.to_string()));
        }
        if roles || followed {
            row.push(match ranges.get(&joint.name) {
                Some(range) => Cell::new(with_locked(range, joint, branches)),
                None => role(joint, branches, moves(report, joint)),
            });
        }
        if wrenches {
            row.push(indeterminate(joint));
        }
        if verbose {
            let closes = chords.contains(joint.name.as_str());
            let note = if closes { "closes a loop" } else { "" };
            row.push(Cell::new(note).tint(Tint::Quiet));
        }
        table.row_about(Subject::Joint(joint.name.clone()), row);
    }
    page.table(table, "joints");
    if wrenches && verbose {
        let text = "indeterminate: components of the reaction, of all that the joint has, that statics alone does not determine \
                    (D5), because constraints are redundant";
        page.paragraph(text, Tint::Quiet, "  ", "  ");
    }
}

/// `3 of 5`: reaction components, of those that the joint has.
fn indeterminate(joint: &JointRow) -> Cell {
    match joint.redundant_wrenches {
        Some(0) => Cell::new("·").tint(Tint::Quiet),
        Some(n) => Cell::new(format!("{n} of {}", 6_usize.saturating_sub(joint.freedom))),
        None => Cell::new("?").tint(Tint::Doubtful),
    }
}

/// A range, and the branches on which the joint is locked.
fn with_locked(range: &str, joint: &JointRow, branches: &[Branch]) -> String {
    let locked: Vec<&str> = branches
        .iter()
        .filter(|branch| branch.locked.contains(&joint.name))
        .map(|branch| branch.name.as_str())
        .collect();
    match locked.as_slice() {
        [] => range.to_owned(),
        on => format!("{range}; locked on {}", on.join(", ")),
    }
}

/// Columns that the other cells of a row need beside the names of its joint and its links.
const BESIDES_NAMES: usize = 56;

/// Whether a page has room for the names of the joints and of the links between which they are.
fn fits(rows: &[&JointRow], page: usize) -> bool {
    let names = |row: &&JointRow| {
        let links: usize = row.links.iter().map(|link| columns(link)).sum();
        columns(&row.name).max(links)
    };
    let widest = rows.iter().map(names).max().unwrap_or(0);
    // Names are cut a little before links are left out.
    widest + BESIDES_NAMES <= page
}

/// Joints outside the spanning tree, which close the loops; what the file says where the tree is not known.
fn chords(report: &Report) -> BTreeSet<&str> {
    let links = report.tree.iter().flat_map(|tree| &tree.links);
    let tree: BTreeSet<&str> = links.map(|link| link.joint.as_str()).collect();
    let known = tree.len() + report.size.loops == report.joints.len();
    let closes = |joint: &&JointRow| match known {
        true => !tree.contains(joint.name.as_str()),
        false => joint.closes_loop,
    };
    let all = report.joints.iter().filter(closes);
    all.map(|joint| joint.name.as_str()).collect()
}
