//! The parts of the page below the counts. A part about which nothing is known is left out.

use super::alternatives::Alternatives;
use super::change_sets;
use super::folded::Folded;
use super::page::Page;
use super::style::Tint;
use super::table::{Cell, Column, Subject, Table};
use super::words::{capitalised, counted, figure, mirrored_runs, names, one_side, runs};
use crate::change_sets::ChangeSets;
use crate::schema::{Advice, CouplingRow, Cycle, Report, Warning, WarningKind};
use std::collections::BTreeSet;

/// Lists of names in a table show this many.
const NAMES_IN_CELL: usize = 12;

/// Couplings shown on a first screen, and how many of them where there are more.
const COUPLINGS: usize = 6;
const FIRST_COUPLINGS: usize = 3;

/// Loops of which equal ones have a row each on a first screen.
const LOOPS: usize = 3;

/// Says that a list goes on.
pub(super) fn more(left: usize, page: &mut Page) {
    if left > 0 {
        let text = format!("… and {left} more with `--verbose` or `--format json`");
        page.paragraph(&text, Tint::Quiet, "    ", "    ");
    }
}

/// The couplings' equations.
pub(crate) fn couplings(report: &Report, page: &mut Page) {
    if report.couplings.is_empty() {
        return;
    }
    page.heading("Couplings");
    let all = report.couplings.len();
    let verbose = page.layout().verbose;
    let shown = match verbose || all <= COUPLINGS {
        true => all,
        false => FIRST_COUPLINGS,
    };
    // The name of a `mimic` is that of its joint, which its equation begins with.
    let told = |row: &CouplingRow| {
        let joint = row.name.strip_suffix(".mimic");
        joint.is_some_and(|joint| row.text.starts_with(joint))
    };
    let named = verbose || !report.couplings.iter().all(told);
    let mut table = Table::new();
    if named {
        table = table.column("coupling", Column::Shrinking);
    }
    table = table.column("equation (rad, m)", Column::Shrinking);
    for coupling in &report.couplings[..shown] {
        let name = named.then(|| Cell::new(&coupling.name));
        let equation = Cell::new(&coupling.text);
        table.row(name.into_iter().chain([equation]).collect());
    }
    page.table(table, "couplings");
    more(all - shown, page);
}

/// One row per basic cycle.
pub(crate) fn cycles(report: &Report, page: &mut Page) {
    if report.cycles.is_empty() {
        return;
    }
    page.heading("Loops (basic cycles, D14)");
    let most = limit(page);
    let folded = match page.layout().verbose {
        true => BTreeSet::new(),
        false => Folded::of(report).joints,
    };
    let mut table = Table::new()
        .column("loop", Column::Shrinking)
        .column("through", Column::Shrinking)
        .column("smallest displacement group", Column::Shrinking)
        .column("rank", Column::Numbers)
        .column("redundant", Column::Numbers)
        .column("mobility if isolated", Column::Numbers)
        .column("joints it locks", Column::Shrinking);
    let groups = match page.layout().verbose || report.cycles.len() <= LOOPS {
        true => report.cycles.iter().map(|cycle| vec![cycle]).collect(),
        false => equal_loops(&report.cycles),
    };
    let shown = match page.layout().verbose {
        true => groups.len(),
        false => rows_of(groups.len()),
    };
    for group in &groups[..shown] {
        let [cycle, others @ ..] = group.as_slice() else {
            continue;
        };
        let locks: Vec<String> = group.iter().flat_map(|c| c.locks.clone()).collect();
        let subject = Subject::Cycle(cycle.name.clone());
        let (name, through, space) = match others {
            [] => (
                cycle.name.clone(),
                joints_of(cycle, &folded, most),
                space(cycle),
            ),
            _ => (loop_names(group), lengths(group, &folded), kind_of(cycle)),
        };
        table.row_about(
            subject,
            vec![
                Cell::new(name).tint(Tint::Strong),
                Cell::new(through),
                Cell::new(space),
                Cell::new(unsure(cycle.rank)),
                Cell::new(unsure(cycle.redundant)),
                Cell::new(unsure(cycle.mobility)),
                Cell::new(match (locks.is_empty(), others) {
                    (true, _) => "–".to_owned(),
                    (false, []) => names(&locks, most),
                    (false, _) => mirrored_runs(&locks, most),
                }),
            ],
        );
    }
    page.table(table, "loops");
    more(groups[shown..].iter().map(Vec::len).sum(), page);
}

/// Loops of which the table says the same but for their joints, in the order of first mention.
fn equal_loops(cycles: &[Cycle]) -> Vec<Vec<&Cycle>> {
    let facts = |c: &Cycle| {
        let counts = (c.rank, c.redundant, c.mobility, c.locks.len());
        (c.space.clone(), c.dimension, counts)
    };
    let mut groups: Vec<Vec<&Cycle>> = Vec::new();
    for cycle in cycles {
        match groups.iter_mut().find(|g| facts(g[0]) == facts(cycle)) {
            Some(group) => group.push(cycle),
            None => groups.push(vec![cycle]),
        }
    }
    groups
}

/// `C1 … C4 and C7`.
fn loop_names(group: &[&Cycle]) -> String {
    let all: Vec<String> = group.iter().map(|cycle| cycle.name.clone()).collect();
    runs(&all, 3)
}

/// `5 to 7 joints each`.
fn lengths(group: &[&Cycle], folded: &BTreeSet<&str>) -> String {
    let length = |cycle: &&Cycle| {
        let joints = cycle.joints.iter();
        joints.filter(|j| !folded.contains(j.as_str())).count()
    };
    let least = group.iter().map(length).min().unwrap_or(0);
    let most = group.iter().map(length).max().unwrap_or(0);
    match least == most {
        true => format!("{} each", counted(most, "joint")),
        false => format!("{least} to {most} joints each"),
    }
}

/// The kind of its displacements, without the axis or plane, which differs from loop to loop.
fn kind_of(cycle: &Cycle) -> String {
    let text = space(cycle);
    let end = [" normal to ", " along ", " about ", " through "]
        .iter()
        .filter_map(|word| text.find(word))
        .min();
    text[..end.unwrap_or(text.len())].to_owned()
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

/// What is redundant, by direction, and what to change.
pub(crate) fn advice(report: &Report, page: &mut Page) {
    let verbose = page.layout().verbose;
    let sets = report.change_sets.as_ref();
    if report.advice.is_empty() && sets.is_none() {
        return;
    }
    page.heading("To remove redundant constraints, adding no mobility");
    if let Some(directions) = change_sets::independent(report, verbose) {
        let text = format!("redundant: {directions}");
        page.paragraph(&text, Tint::Plain, "  ", "    ");
    }
    let told_whole = sets.is_some_and(|sets| whole_sets(sets, page));
    if verbose {
        for advice in &report.advice {
            page.item(&told(&advice.text, advice), Tint::Plain);
        }
        return;
    }
    // Where sets remove everything, single changes that do less are left to a verbose page; a joint to remove is not.
    let all = Alternatives::of(&report.advice);
    let single = all.iter().filter(|change| !told_whole || change.removes());
    let mut left = report.advice.len();
    for change in single.take(CHANGES) {
        page.item(&told(&change.text(), change.first), Tint::Plain);
        left -= change.pieces();
    }
    if !told_whole {
        more(left, page);
    }
}

/// Sets of changes that remove every redundancy; whether there are any.
fn whole_sets(sets: &ChangeSets, page: &mut Page) -> bool {
    let verbose = page.layout().verbose;
    if let Some(obstacle) = &sets.obstacle {
        page.paragraph(obstacle, Tint::Quiet, "  ", "    ");
    }
    let parts = sets.parts.len();
    let (most_parts, most_lines) = match (verbose, parts) {
        (true, _) => (parts, usize::MAX),
        (false, 1) => (1, SETS),
        (false, _) => (SETS, 1),
    };
    for part in sets.parts.iter().take(most_parts) {
        let removed = match parts {
            1 => format!("{} → 0", part.redundant),
            _ => format!(
                "removes {}",
                counted(part.redundant, "redundant constraint")
            ),
        };
        let least = match (part.least, part.sets.first().map_or(0, Vec::len)) {
            (true, 2..) if verbose => "; fewest changes",
            (true, _) => "",
            (false, _) => "; fewer may do",
        };
        for (index, (text, _)) in change_sets::lines(part).iter().take(most_lines).enumerate() {
            let text = match index {
                0 => format!("{text} ({removed}{least})"),
                _ => format!("or {text}"),
            };
            page.item(&text, Tint::Plain);
        }
    }
    if parts > most_parts {
        let others = counted(parts - most_parts, "more independent sub-mechanism");
        let text = format!("… and likewise in {others}: `--verbose`");
        page.paragraph(&text, Tint::Quiet, "    ", "    ");
    }
    parts > 0
}

/// Lines on a first screen: for the only part, or of as many parts.
const SETS: usize = 2;

fn told(text: &str, advice: &Advice) -> String {
    format!(
        "{} (redundant: {} → {})",
        text.trim_end_matches('.'),
        advice.redundant_before,
        advice.redundant_after
    )
}

/// Changes shown on a first screen.
const CHANGES: usize = 4;

/// Pieces of advice and warnings shown on a first screen.
const ADVICE: usize = 8;

/// What is wrong with the pose.
pub(crate) fn pose(report: &Report, page: &mut Page) {
    let all = report.warnings.iter();
    let told: Vec<&Warning> = all.filter(|w| w.kind.is_told_first()).collect();
    // A block's name has no capital.
    let of_block = |text: &str| {
        told.iter()
            .any(|w| w.kind == WarningKind::LockedTogether && w.text == text)
    };
    let texts: Vec<String> = match page.layout().verbose {
        true => told.iter().map(ToString::to_string).collect(),
        false => repeated_once(&told),
    };
    for text in texts {
        let sentence = match of_block(&text) {
            true => format!("{text}."),
            false => capitalised(&text),
        };
        page.paragraph(&sentence, Tint::Doubtful, "", "");
    }
}

/// What to beware of besides the pose; on a first screen without what the answer says already, and without what in the file
/// has no meaning, which counts as not read.
pub(crate) fn other_warnings(report: &Report, page: &mut Page) {
    let verbose = page.layout().verbose;
    let floats = report.freedoms.as_ref().is_some_and(|f| f.floating > 0);
    let told = |kind: WarningKind| match kind {
        WarningKind::Meaningless | WarningKind::OldName => !verbose,
        WarningKind::LooseLinks => floats && !verbose,
        kind => kind.is_told_first(),
    };
    let others: Vec<Warning> = report
        .warnings
        .iter()
        .filter(|warning| !told(warning.kind))
        .cloned()
        .map(|warning| match verbose {
            true => warning,
            false => Warning {
                text: without_folders(&warning.text),
                ..warning
            },
        })
        .collect();
    list(&others, page);
}

/// `15 × <axis> of a fixed joint`, or `6 × <joint_properties> for <dynamics>`.
fn short(warning: &Warning, kind: WarningKind, between: &str) -> Option<String> {
    let [one, other] = &warning.names[..] else {
        return None;
    };
    let times = match warning.place.map_or(1, |place| place.count) {
        1 => String::new(),
        many => format!("{many} × "),
    };
    (warning.kind == kind).then(|| format!("{times}{one} {between} {other}"))
}

/// A warning whose ` (at /a/long/way/to/file.xacro:3:1)` names the file alone.
fn without_folders(warning: &str) -> String {
    const AT: &str = " (at ";
    let Some((before, rest)) = warning.split_once(AT) else {
        return warning.to_owned();
    };
    let end = rest.find(')').unwrap_or(rest.len());
    let file = rest[..end].rsplit(['/', '\\']).next().unwrap_or("");
    format!("{before}{AT}{file}{}", &rest[end..])
}

fn list(warnings: &[Warning], page: &mut Page) {
    if warnings.is_empty() {
        return;
    }
    page.heading("Warnings");
    let all: Vec<&Warning> = warnings.iter().collect();
    let warnings: Vec<String> = match page.layout().verbose {
        true => all.iter().map(ToString::to_string).collect(),
        false => repeated_once(&all),
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

/// Warnings that differ only in the place they speak of, or in the side of the machine, once, with the number of places: `14 × …, first in line 35`.
fn repeated_once(warnings: &[&Warning]) -> Vec<String> {
    let placed: Vec<(String, String)> = warnings.iter().map(|warning| warning.placed()).collect();
    let mut counted: Vec<(&str, &str, usize)> = Vec::new();
    let mut mirrored: BTreeSet<String> = BTreeSet::new();
    for (place, text) in &placed {
        let sides = one_side(text);
        match counted
            .iter_mut()
            .find(|(_, known, _)| one_side(known) == sides)
        {
            Some((_, known, count)) => {
                if *known != text.as_str() {
                    mirrored.insert((*known).to_owned());
                }
                *count += 1;
            }
            None => counted.push((place.as_str(), text.as_str(), 1)),
        }
    }
    counted
        .into_iter()
        .map(|(place, text, count)| match (count, place) {
            (1, "") => text.to_owned(),
            (1, place) => format!("{place}: {text}"),
            (many, place) => {
                let images = mirrored.contains(text).then_some("left and right alike");
                let first = (!place.is_empty()).then(|| format!("first in {place}"));
                let notes: Vec<&str> = images.into_iter().chain(first.as_deref()).collect();
                match notes.as_slice() {
                    [] => format!("{many} × {text}"),
                    notes => format!("{many} × {text} ({})", notes.join(", ")),
                }
            }
        })
        .collect()
}

/// What of the file was not read, in one line; a verbose page lists it with places.
fn unread(report: &Report, page: &mut Page) {
    const KINDS: usize = 6;
    let of_skipped = |line: &String| {
        let what = match line.split_once(": ") {
            Some((place, what)) if place.starts_with("line ") => what,
            _ => line,
        };
        let what = what.split(" (first at ").next().unwrap_or(what);
        let what = what.split(" (at ").next().unwrap_or(what);
        what.to_owned()
    };
    let all = || report.warnings.iter();
    let ignored = all().filter_map(|w| short(w, WarningKind::Meaningless, "of"));
    let mut kinds: Vec<String> = report
        .skipped
        .iter()
        .map(of_skipped)
        .chain(ignored)
        .collect();
    let old = all().filter_map(|w| short(w, WarningKind::OldName, "for"));
    let old: Vec<String> = old.collect();
    if kinds.is_empty() && old.is_empty() {
        return;
    }
    let left = kinds.len().saturating_sub(KINDS);
    if left > 0 {
        kinds.truncate(KINDS);
        kinds.push(format!("and {}", counted(left, "more kind")));
    }
    let told = [("Not read: ", kinds), ("Old names read: ", old)];
    let told: Vec<String> = told
        .into_iter()
        .filter(|(_, list)| !list.is_empty())
        .map(|(title, list)| format!("{title}{}", list.join(", ")))
        .collect();
    let text = format!("{} (`--verbose` says where).", told.join(". "));
    page.gap();
    page.paragraph(&text, Tint::Quiet, "", "");
}

/// What only a verbose page shows, and times where they were asked for.
pub(crate) fn details(report: &Report, page: &mut Page) {
    if !page.layout().verbose {
        unread(report, page);
    }
    if page.layout().verbose {
        blocks(report, page);
        rank_details(report, page);
        if !report.skipped.is_empty() {
            page.heading("Not read, because it does not affect the motion");
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
                .column("parent", Column::Shrinking)
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
    page.heading("Independent sub-mechanisms");
    let mut table = Table::new()
        .column("sub-mechanism", Column::Shrinking)
        .column("joints", Column::Numbers)
        .column("variables", Column::Numbers)
        .column("rank", Column::Numbers)
        .column("at this pose", Column::Numbers)
        .column("finite", Column::Numbers);
    for block in &report.home.blocks {
        table.row(vec![
            Cell::new(&block.name),
            Cell::new(block.joints.to_string()),
            Cell::new(block.unknowns.to_string()),
            Cell::new(unsure(block.rank)),
            Cell::new(unsure(block.instantaneous)),
            Cell::new(unsure(block.finite)),
        ]);
    }
    page.table(table, "sub-mechanisms");
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::schema::WarningPlace;

    #[test]
    fn notes_on_the_file_are_told_in_short() {
        let of = |names: [&str; 2], kind: WarningKind, count: usize| Warning {
            place: Some(WarningPlace {
                line: 156,
                column: 1,
                count,
            }),
            names: names.map(str::to_owned).to_vec(),
            ..Warning::new(kind, "text")
        };
        let [kind, old] = [WarningKind::Meaningless, WarningKind::OldName];
        let axis = |count| short(&of(["<axis>", "a fixed joint"], kind, count), kind, "of");
        assert_eq!(axis(15).unwrap(), "15 × <axis> of a fixed joint");
        assert_eq!(axis(1).unwrap(), "<axis> of a fixed joint");
        let renamed = of(["<joint_properties>", "<dynamics>"], old, 6);
        assert_eq!(
            short(&renamed, old, "for").unwrap(),
            "6 × <joint_properties> for <dynamics>"
        );
        assert_eq!(short(&renamed, kind, "of"), None);
        assert_eq!(
            renamed.to_string(),
            "text (6 times, first at line 156, column 1)"
        );
        let at = "line 4, column 3: 15 joints (at /a/b/torso.xacro:23:7) (3 times)";
        assert_eq!(
            without_folders(at),
            "line 4, column 3: 15 joints (at torso.xacro:23:7) (3 times)"
        );
    }

    #[test]
    fn warnings_of_both_sides_are_told_once() {
        let at = |line, text| Warning {
            place: Some(WarningPlace {
                line,
                column: 2,
                count: 1,
            }),
            ..Warning::new(WarningKind::Said, text)
        };
        let warnings = [
            at(1, "joint `r_grip` twice"),
            at(5, "joint `l_grip` twice"),
            Warning::new(WarningKind::Said, "other"),
        ];
        assert_eq!(
            repeated_once(&warnings.iter().collect::<Vec<_>>()),
            [
                "2 × joint `r_grip` twice (left and right alike, first in line 1, column 2)",
                "other"
            ]
        );
    }

    #[test]
    fn equal_loops_share_a_row() {
        let cycle = |name: &str, joints: usize, locks: &[&str]| Cycle {
            name: name.to_owned(),
            joints: (0..joints).map(|j| format!("{name}_{j}")).collect(),
            space: Some("G".to_owned()),
            space_text: format!("planar motion normal to {name}"),
            dimension: Some(3),
            rank: Some(3),
            redundant: Some(3),
            mobility: Some(1),
            locks: locks.iter().map(|l| (*l).to_owned()).collect(),
        };
        let cycles = [
            cycle("C1", 4, &[]),
            cycle("C2", 5, &[]),
            cycle("C3", 4, &["a"]),
            cycle("C4", 4, &[]),
        ];
        let groups = equal_loops(&cycles);
        assert_eq!(groups.len(), 2);
        assert_eq!(loop_names(&groups[0]), "C1, C2 and C4");
        assert_eq!(lengths(&groups[0], &BTreeSet::new()), "4 to 5 joints each");
        assert_eq!(lengths(&groups[1], &BTreeSet::new()), "4 joints each");
        assert_eq!(kind_of(groups[0][0]), "G: planar motion");
    }
}
