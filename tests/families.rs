//! Families that come, as a small number vanishes, to a mechanism or a pose that moves otherwise: along each the verdict is
//! right, then perhaps open, then right again at the limit. And chains that grow.
//!
//! What is true of each member is stated and argued in `kutzbach::families`. The members are written with exact numbers, so
//! that an offset of 1e-14 is meant: calling it a zero is a mistake and not a matter of precision.

#[allow(dead_code)]
#[path = "../examples/families_figure/figure.rs"]
mod figure;
use crate::support;

use figure::{MOST_LOOPS, Member, Place, cases, families_of, look, render};
use kutzbach::families::{Outcome, continuous_families};
use std::sync::OnceLock;
use support::{assert_none, folder, in_parallel};

/// Members whose verdict stays open, by the exponents of their offsets. No other may, and whichever no longer does is to be
/// struck off.
const UNDECIDED: [(&str, &[u32]); 2] = [
    ("spoiled_parallelogram", &[14]),
    ("double_planar", &[10, 11, 12, 13, 14]),
];

fn members() -> &'static [Member] {
    static MEMBERS: OnceLock<Vec<Member>> = OnceLock::new();
    MEMBERS.get_or_init(|| in_parallel(&cases().unwrap(), |case| look(case).unwrap()))
}

/// Lines of the members of a list, and of those with an outcome.
fn listed(list: &[(&str, &[u32])]) -> Vec<String> {
    let each = |(family, exponents): &(&str, &[u32])| -> Vec<String> {
        let line = |e: &u32| format!("{family} {:?}", Place::Offset(*e));
        exponents.iter().map(line).collect()
    };
    list.iter().flat_map(each).collect()
}

fn found(word: &str) -> Vec<String> {
    let with = members().iter().filter(|m| m.outcome.word() == word);
    with.map(|m| format!("{} {:?}", m.family, m.place))
        .collect()
}

#[test]
fn no_verdict_is_wrong() {
    let mut told = Vec::new();
    for member in members() {
        if let Outcome::Wrong(reasons) = &member.outcome {
            let line = format!("{} {:?}", member.family, member.place);
            told.push(format!("{line}: {}", reasons.join("; ")));
        }
    }
    assert_none(&told);
}

#[test]
fn what_stays_open_is_known_and_has_a_reason() {
    assert_eq!(found("undecided"), listed(&UNDECIDED));
    for member in members() {
        let open = member.outcome == Outcome::Undecided;
        let reasons = member.why.iter().filter(|reason| !reason.is_empty());
        assert!(
            !open || reasons.count() > 0,
            "{} {:?} is left open without a word",
            member.family,
            member.place
        );
    }
}

#[test]
fn every_family_is_decided_at_its_limit_and_far_from_it() {
    for family in continuous_families() {
        for place in [
            Place::Limit,
            Place::Offset(1),
            Place::Offset(2),
            Place::Offset(3),
        ] {
            let mut of = members().iter().filter(|m| m.family == family.name);
            let member = of.find(|m| m.place == place).unwrap();
            assert_eq!(member.outcome, Outcome::Right, "{} {place:?}", family.name);
        }
    }
}

#[test]
fn chains_and_rows_are_decided_at_every_length() {
    for family in ["bennett_chain", "bennett_row"] {
        let of = members().iter().filter(|m| m.family == family);
        let right = of.filter(|m| m.outcome == Outcome::Right).count();
        assert_eq!(right, MOST_LOOPS, "{family}");
    }
}

/// The figure in the repository is the one drawn now: the same words, and numbers (pixels) that are the same but for the
/// rounding of other machines.
#[test]
fn the_figure_in_the_documentation_shows_what_is_found_now() {
    let path = folder("docs/src/images/families.svg");
    let committed = std::fs::read_to_string(path).unwrap();
    let split = |text: &str| -> Vec<String> {
        let between = |c: char| !(c.is_ascii_alphanumeric() || c == '.' || c == '-');
        text.split(between).map(str::to_owned).collect()
    };
    let drawn = render(members());
    let [before, now] = [split(&committed), split(&drawn)];
    let same = |a: &String, b: &String| {
        a == b || numbers(a, b).is_some_and(|(a, b)| (a - b).abs() <= 0.25)
    };
    let other = before.iter().zip(&now).find(|(a, b)| !same(a, b));
    assert!(
        before.len() == now.len() && other.is_none(),
        "{other:?}; to draw it anew: cargo run --example families_figure"
    );
    assert_eq!(
        families_of(members()).len(),
        drawn.matches("class=\"title\"").count()
    );
}

/// Two numbers, perhaps after the same letter of a path.
fn numbers(a: &str, b: &str) -> Option<(f64, f64)> {
    let letter = |text: &str| text.chars().next().filter(char::is_ascii_alphabetic);
    let number = |text: &str| {
        text.trim_start_matches(|c: char| c.is_ascii_alphabetic())
            .parse()
    };
    (letter(a) == letter(b))
        .then(|| Some((number(a).ok()?, number(b).ok()?)))
        .flatten()
}

/// The table beside the figure counts the same.
#[test]
fn the_table_in_the_documentation_counts_what_is_found_now() {
    let page = std::fs::read_to_string(folder("docs/src/families.md")).unwrap();
    for family in families_of(members()) {
        let title = family.replace('_', " ").replace("bennett", "Bennett");
        let mut rows = page
            .lines()
            .map(|row| row.split('|').map(str::trim).collect::<Vec<_>>());
        let row = rows
            .find(|cells| cells.get(1) == Some(&title.as_str()))
            .unwrap_or_else(|| panic!("no row for {family}"));
        let counts = ["right", "undecided", "wrong"].map(|word| {
            let of = members().iter().filter(|m| m.family == family);
            of.filter(|m| m.outcome.word() == word).count().to_string()
        });
        assert_eq!(row[row.len() - 4..row.len() - 1], counts, "{family}");
    }
}
