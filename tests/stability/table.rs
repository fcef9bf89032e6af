//! The table of break points, as the page shows it.

use super::ladder::{Climbed, Seen};
use kutzbach::families::Outcome;

/// The marks between which the table stands in `docs/src/stability.md`.
pub const MARKS: [&str; 2] = ["<!-- stability: begin -->", "<!-- stability: end -->"];

/// The table, a row for every family.
pub fn table(families: &[Climbed]) -> String {
    let mut lines = vec![
        "| family | what changes | right | undecided | kept | margin | bits |".to_owned(),
        "|---|---|---|---|---|---|---|".to_owned(),
    ];
    lines.extend(families.iter().map(row));
    lines.join("\n")
}

fn row(family: &Climbed) -> String {
    let with = |outcome: &dyn Fn(&Outcome) -> bool| {
        let flags: Vec<bool> = family.seen.iter().map(|s| outcome(&s.outcome)).collect();
        runs(&family.seen, &flags)
    };
    let undecided = with(&|outcome| *outcome == Outcome::Undecided);
    let reason = family
        .seen
        .iter()
        .find(|seen| seen.outcome == Outcome::Undecided)
        .map_or(String::new(), |seen| format!(" ({})", reason(seen)));
    let right = || {
        let decided = |s: &&Seen| s.outcome == Outcome::Right && s.ranked;
        family.seen.iter().filter(decided)
    };
    let least = right().map(|s| s.kept).reduce(f64::min);
    let thinnest = right().map(Seen::margin).reduce(f64::min);
    format!(
        "| {} | {} | {} | {undecided}{reason} | {} | {} | {} |",
        title(family.name),
        family.parameter,
        with(&|outcome| *outcome == Outcome::Right),
        least.map_or(String::new(), |kept| format!("{kept:.0e}")),
        thinnest.map_or(String::new(), |margin| format!("{margin:.1}")),
        bits(&family.seen),
    )
}

/// The name of a family for people.
fn title(name: &str) -> String {
    let mut title = name.replace('_', " ");
    for inventor in ["Bennett", "Goldberg", "Bricard", "Miura"] {
        title = title.replace(&inventor.to_lowercase(), inventor);
    }
    title
}

/// The labels of the rungs with a flag, neighbours drawn together: `1e-1 … 1e-8, 0`.
fn runs(seen: &[Seen], flags: &[bool]) -> String {
    let mut found: Vec<(usize, usize)> = Vec::new();
    for index in (0..flags.len()).filter(|&i| flags[i]) {
        match found.last_mut() {
            Some((_, last)) if *last + 1 == index => *last = index,
            _ => found.push((index, index)),
        }
    }
    let told = found.iter().map(|&(first, last)| {
        let (first, last) = (&seen[first].label, &seen[last].label);
        if first == last {
            first.clone()
        } else {
            format!("{first} … {last}")
        }
    });
    told.collect::<Vec<_>>().join(", ")
}

/// Why a member is left open, in a few words.
fn reason(seen: &Seen) -> String {
    let why = seen.why.as_deref().unwrap_or("no reason told");
    let short = [
        ("the margin is too thin", "chart too small"),
        ("the loops stay open", "not closed to the last digit"),
        ("which branches pass", "branches not settled"),
        ("could have another rank", "digits left out"),
        ("leave the rank at this pose open", "digits left out"),
    ];
    let known = short.iter().find(|(part, _)| why.contains(part));
    known.map_or(why, |(_, short)| short).replace('|', "/")
}

/// The most bits any engine used, rung by rung, repetitions counted: `53 ×8, 106`.
fn bits(seen: &[Seen]) -> String {
    let mut found: Vec<(u32, usize)> = Vec::new();
    for bits in seen.iter().map(|s| s.bits) {
        match found.last_mut() {
            Some((last, count)) if *last == bits => *count += 1,
            _ => found.push((bits, 1)),
        }
    }
    let told = found.iter().map(|(bits, count)| match count {
        1 => bits.to_string(),
        count => format!("{bits} ×{count}"),
    });
    told.collect::<Vec<_>>().join(", ")
}

/// The rows of two tables that differ, by family.
pub fn differences(before: &str, now: &str) -> Vec<String> {
    let family = |row: &str| row.split('|').nth(1).unwrap_or("").trim().to_owned();
    let old: Vec<&str> = before.lines().collect();
    let changed = now.lines().filter(|row| !old.contains(row));
    let told = changed.map(|row| {
        let was = old.iter().find(|other| family(other) == family(row));
        format!("{}: {row}\n    before: {}", family(row), was.unwrap_or(&""))
    });
    told.collect()
}
