//! The branches through the pose, how links move on them, and what the engines found.

use super::cite;
use super::folded::Folded;
use super::page::Page;
use super::sections::{limit, more, unsure};
use super::style::Tint;
use super::table::{Cell, Column, Subject, Table};
use super::words::{counted, mirrored_runs, names};
use crate::natural::natural_order;
use crate::schema::{Branch, Evidence, Idle, Motion, Report};
use kutzbach_mobility::PoseKind;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Motions shown on a first screen.
const MOTIONS: usize = 12;

/// The branches through the pose.
pub(crate) fn branches(report: &Report, page: &mut Page) {
    let Some(branches) = report.branches.as_ref().filter(|b| !b.is_empty()) else {
        return;
    };
    if !page.layout().verbose && says_nothing_more(report, branches) {
        return;
    }
    page.heading(&format!(
        "Motion branches through this pose ({})",
        cite::BRANCH
    ));
    let most = limit(page);
    let halves = page.layout().verbose && branches.iter().any(|b| b.half_branches.is_some());
    let mut table = Table::new()
        .column("branch", Column::Shrinking)
        .column("DOF", Column::Numbers)
        .column("instantaneous", Column::Numbers)
        .column("redundant", Column::Numbers);
    if halves {
        table = table.column("half-branches", Column::Numbers);
    }
    table = table
        .column("locked joints", Column::Shrinking)
        .column("idle links", Column::Shrinking);
    for branch in branches {
        let idle: Vec<String> = branch.idle.iter().map(idle_link).collect();
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

/// What the table of branches would say besides, where it is left out: what rests, and what is idle.
pub(super) fn idle_and_locked(report: &Report, page: &mut Page) {
    let branches = report.branches.as_deref().unwrap_or_default();
    let [only] = branches else { return };
    if page.layout().verbose || !says_nothing_more(report, branches) {
        return;
    }
    if !only.idle.is_empty() {
        // Of links that are idle alike the number says enough.
        let alike = only.idle.iter().all(|idle| idle.freedom == 1);
        let idle: Vec<String> = match alike {
            true => {
                let links = only.idle.iter().filter_map(|idle| idle.links.first());
                let links: Vec<String> = links.cloned().collect();
                vec![format!("{}, 1 each", listed(&links))]
            }
            false => only.idle.iter().map(idle_link).collect(),
        };
        let text = format!(
            "Idle degrees of freedom ({}): {}.",
            cite::IDLE,
            names(&idle, NAMED)
        );
        page.paragraph(&text, Tint::Plain, "", "");
    }
    if !only.locked.is_empty() {
        let text = format!("Locked along the whole motion: {}.", listed(&only.locked));
        page.paragraph(&text, Tint::Notable, "", "");
    }
}

/// `rod (1)`: what moves along with a rod stands for nothing of its own.
fn idle_link(idle: &Idle) -> String {
    let name = idle.links.first().map_or("", String::as_str);
    format!("{name} ({})", idle.freedom)
}

/// Whether the only branch repeats what stands above it.
fn says_nothing_more(report: &Report, branches: &[Branch]) -> bool {
    // A curve leaves a regular pose both ways.
    report.home.pose == Some(PoseKind::Regular)
        && matches!(branches, [only] if matches!(only.half_branches, None | Some(2))
            && Some(only.dimension) == report.mobility.finite
            && only.instantaneous == report.home.instantaneous
            && only.redundant == report.home.redundant)
}

/// How links move relative to one another: the pairs that were asked for, then the rest, which a first screen shows the
/// most interesting rows of.
pub(crate) fn motions(report: &Report, on_page: bool, page: &mut Page) {
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
    let verbose = page.layout().verbose;
    if verbose && !on_page {
        page.heading(&title(&others));
        motion_table(&others, several, page);
        return;
    }
    let folded = Folded::of(report);
    let all = others.len();
    let mut shown = others;
    shown.retain(|motion| !folded.links.contains(motion.link.as_str()));
    if !verbose && shown.len() > MOTIONS && !several {
        by_kind(&shown, page);
        return;
    }
    if shown.is_empty() {
        return;
    }
    page.heading(&title(&shown));
    let told = shown.len();
    if !verbose && told > MOTIONS {
        shown = foremost(report, shown);
    }
    motion_table(&shown, several, page);
    if shown.len() < told {
        let text = format!(
            "… and {} more: `--verbose` or `--format json` shows all {all}, `--between A B` any pair",
            told - shown.len()
        );
        page.paragraph(&text, Tint::Quiet, "  ", "  ");
    }
}

/// Kinds of motions told on a first screen.
const KINDS: usize = 8;

/// Links, or runs of them, named in a line.
const NAMED: usize = 3;

/// Degrees of freedom, the most first, class, and the link it is seen from.
type Kind<'a> = (Reverse<Option<usize>>, &'a str, &'a str);

/// The motions of many links: of each kind, in a line, which links move so.
fn by_kind(motions: &[&Motion], page: &mut Page) {
    let mut kinds: BTreeMap<Kind<'_>, Vec<String>> = BTreeMap::new();
    for motion in motions {
        let kind = (
            Reverse(motion.freedom),
            motion.class.as_str(),
            motion.relative_to.as_str(),
        );
        kinds.entry(kind).or_default().push(motion.link.clone());
    }
    let roots: BTreeSet<&str> = kinds.keys().map(|(_, _, root)| *root).collect();
    let one = roots.len() == 1;
    page.heading(&title(motions));
    for ((Reverse(freedom), class, root), links) in kinds.iter().take(KINDS) {
        let from = match one {
            true => String::new(),
            false => format!(", seen from {root}"),
        };
        let line = format!(
            "{}{from}: {}",
            how(*freedom, class, links.len()),
            listed(links)
        );
        page.paragraph(&line, Tint::Plain, "  ", "    ");
    }
    more(kinds.values().skip(KINDS).map(Vec::len).sum(), page);
}

/// `4 links with 2 DOF each (2 rotations)`.
fn how(freedom: Option<usize>, class: &str, links: usize) -> String {
    let many = counted(links, "link");
    let each = if links == 1 { "" } else { " each" };
    match freedom {
        None => format!("{many}, not decided"),
        Some(0) => format!("{many} at rest"),
        Some(6) => format!("{many} with all 6 DOF"),
        Some(n) => format!("{many} with {n} DOF{each} ({})", kind_of_motion(class)),
    }
}

/// A class of motions in words: `planar motion` for `G`, `1 rotation, 2 translations` for `1R 2T`.
fn kind_of_motion(class: &str) -> String {
    let known = match class {
        "R" => "rotation about a fixed axis",
        "T" => "translation along a line",
        "H" => "screw motion about a fixed axis",
        "T2" => "translation in a plane",
        "C" => "cylindrical motion",
        "T3" => "translation in every direction",
        "G" => "planar motion",
        "S" => "rotation about a fixed point",
        "Y" => "screw motion and translation in a plane",
        "X" => "Schoenflies motion",
        _ => "",
    };
    if !known.is_empty() {
        return known.to_owned();
    }
    let word = |part: &str| {
        let (number, thing) = part.split_at_checked(part.len().checked_sub(1)?)?;
        let number: usize = number.parse().ok()?;
        match thing {
            "R" => Some(counted(number, "rotation")),
            "T" => Some(counted(number, "translation")),
            _ => None,
        }
    };
    let words: Option<Vec<String>> = class.split(' ').map(word).collect();
    match words {
        Some(words) => words.join(", "),
        None => class.to_owned(),
    }
}

/// `Motion, seen from base`, where that is one link.
fn title(motions: &[&Motion]) -> String {
    let roots: BTreeSet<&str> = motions.iter().map(|m| m.relative_to.as_str()).collect();
    match (roots.len(), roots.first()) {
        (1, Some(root)) => format!("Motion ({}), seen from {root}", cite::MOTION),
        _ => format!("Motion ({})", cite::MOTION),
    }
}

fn listed(links: &[String]) -> String {
    let mut sorted = links.to_vec();
    sorted.sort_by(|a, b| natural_order(a, b));
    mirrored_runs(&sorted, NAMED)
}

fn motion_table(motions: &[&Motion], several: bool, page: &mut Page) {
    let verbose = page.layout().verbose;
    let roots: BTreeSet<&str> = motions.iter().map(|m| m.relative_to.as_str()).collect();
    let seen_from = verbose || roots.len() > 1 || motions.iter().any(|m| m.asked);
    let mut table = Table::new();
    table = table.column("link", Column::Shrinking);
    if several {
        table = table.column("branch", Column::Words);
    }
    if seen_from {
        table = table.column("seen from", Column::Shrinking);
    }
    table = table
        .column("DOF", Column::Numbers)
        .column("motion", Column::Shrinking);
    if verbose {
        table = table.column("class", Column::Words);
    }
    for (motion, branches) in on_branches(motions, verbose) {
        let mut cells = Vec::new();
        cells.push(Cell::new(&motion.link).tint(Tint::Strong));
        if several {
            cells.push(Cell::new(branches.join(", ")));
        }
        if seen_from {
            cells.push(Cell::new(&motion.relative_to));
        }
        cells.push(Cell::new(unsure(motion.freedom)));
        cells.push(Cell::new(how_it_moves(motion, verbose)));
        if verbose {
            cells.push(Cell::new(&motion.class));
        }
        table.row_about(Subject::Link(motion.link.clone()), cells);
    }
    page.table(table, "motions");
}

/// The rows with the branches they hold on: on a first screen what is the same on several is said once.
fn on_branches<'a>(motions: &[&'a Motion], verbose: bool) -> Vec<(&'a Motion, Vec<&'a str>)> {
    let mut rows: Vec<(&Motion, Vec<&str>)> = Vec::new();
    for &motion in motions {
        let same = |(row, _): &&mut (&Motion, Vec<&str>)| {
            !verbose
                && row.link == motion.link
                && row.relative_to == motion.relative_to
                && row.freedom == motion.freedom
                && row.text == motion.text
                && row.joint == motion.joint
        };
        match rows.iter_mut().find(same) {
            Some((_, branches)) => branches.push(&motion.branch),
            None => rows.push((motion, vec![&motion.branch])),
        }
    }
    rows
}

/// `rotates about hinge_1`, and where that is where everything is asked for; otherwise what the analysis says in words.
fn how_it_moves(motion: &Motion, verbose: bool) -> String {
    let verb = match motion.class.as_str() {
        "R" => "rotates about",
        "T" => "translates along",
        "H" => "screws along",
        _ => return motion.text.clone(),
    };
    match (&motion.joint, verbose) {
        (Some(joint), false) => format!("{verb} {joint}"),
        (Some(joint), true) => format!("{verb} {joint}: {}", motion.text),
        (None, _) => motion.text.clone(),
    }
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
pub(crate) fn evidence(report: &Report, page: &mut Page) {
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
        format!("sub-mechanism `{}`, ", found.block)
    } else {
        String::new()
    };
    let bounds = match found.bounds {
        [Some(least), Some(most)] if least == most => format!("finite mobility {least}"),
        [None | Some(0), Some(most)] => format!("finite mobility at most {most}"),
        [Some(least), Some(most)] => format!("finite mobility {least} to {most}"),
        [Some(least), None] if least > 0 => format!("finite mobility at least {least}"),
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
