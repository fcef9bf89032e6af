//! Families of mechanisms that come close to trouble, on logarithmic ladders: how far verdicts hold, and that they never
//! turn wrong on the way.
//!
//! Every member is built with exact numbers (but for those of `digits`, which are about rounded ones), and what is true of it
//! is derived where it is built. An answer is *right* if a verdict was given and all that was decided is true, *undecided* if
//! no verdict was given and nothing decided is false, and *wrong* otherwise. How far a family is decided is a fact of the
//! program: the table of it is written by this suite into `docs/src/stability.md` and compared with what is found:
//!
//! ```text
//! KUTZBACH_UPDATE=1 cargo test --test it stability::
//! ```
//!
//! Cost is counted, never timed: bits of the arithmetic and steps of the assembly.
mod bifurcations;
mod couplings;
mod digits;
mod drawn;
mod far;
mod ladder;
mod lengths;
mod offsets;
mod screws;
mod sizes;
mod slides;
use crate::support;
mod table;
mod turns;
mod twists;

use kutzbach::families::Outcome;
use kutzbach::mobility::{LADDER, Verdict};
use ladder::{Climbed, Ladder, Seen, climb};
use std::sync::OnceLock;
use support::{assert_none, folder};

fn families() -> &'static [Climbed] {
    static FAMILIES: OnceLock<Vec<Climbed>> = OnceLock::new();
    FAMILIES.get_or_init(|| {
        let all: [fn() -> Vec<Ladder>; 11] = [
            offsets::ladders,
            twists::ladders,
            lengths::ladders,
            slides::ladders,
            screws::ladders,
            bifurcations::ladders,
            turns::ladders,
            far::ladders,
            couplings::ladders,
            digits::ladders,
            sizes::ladders,
        ];
        let ladders: Vec<Ladder> = all.iter().flat_map(|ladders| ladders()).collect();
        climb(&ladders)
    })
}

/// Fails with what a check says of any member, by family and place.
fn check(wrong: impl Fn(&Climbed, &Seen) -> Option<String>) {
    let mut told = Vec::new();
    for family in families() {
        for seen in &family.seen {
            if let Some(what) = wrong(family, seen) {
                told.push(format!("{} at {}: {what}", family.name, seen.label));
            }
        }
    }
    assert_none(&told);
}

#[test]
fn no_answer_is_wrong() {
    check(|_, seen| match &seen.outcome {
        Outcome::Wrong(reasons) => Some(reasons.join("; ")),
        _ => None,
    });
}

#[test]
fn what_stays_open_has_a_reason() {
    check(|_, seen| {
        let silent = seen.why.as_deref().is_none_or(str::is_empty);
        (seen.verdict == Verdict::Undecided && silent).then(|| "open without a word".to_owned())
    });
}

/// Six decades to either side, or six decimals: so far everything is decided. (Two parts in a million that spoil a mechanism
/// show from nine decimals on.)
#[test]
fn six_decades_are_decided() {
    check(|family, seen| {
        let decades = seen.decades.unwrap_or(0.0);
        let asked = match family.name {
            "written_spoiled_bennett" => decades <= -9.0,
            name if name.starts_with("written_") => decades <= -6.0,
            _ => decades.abs() <= 6.0,
        };
        (asked && seen.outcome != Outcome::Right)
            .then(|| format!("{}: {:?}", seen.outcome.word(), seen.why))
    });
}

/// A rank that an answer rests on stands clear of its tolerance.
#[test]
fn decided_ranks_have_a_margin() {
    check(|_, seen| {
        let decided = seen.outcome == Outcome::Right && seen.ranked;
        (decided && !(seen.margin() >= 0.0)).then(|| format!("margin {:.1}", seen.margin()))
    });
}

/// Margins shrink smoothly: the smallest singular value kept follows the power of the parameter that was derived, without a
/// jump, through all changes of precision, as far as ranks are decided.
#[test]
fn singular_values_follow_their_laws() {
    let mut told = Vec::new();
    for family in families() {
        let Some(law) = family.law else { continue };
        let followed = |s: &&Seen| s.outcome == Outcome::Right && s.ranked;
        let deviations: Vec<(f64, &Seen)> = family
            .seen
            .iter()
            .filter(followed)
            .filter_map(|s| Some((s.decades.filter(|d| d.abs() <= law.up_to)?, s)))
            .map(|(decades, s)| (s.kept.log10() - (law.decades)(decades), s))
            .collect();
        assert!(deviations.len() >= 4, "{} has no rungs", family.name);
        let allowed = law.within.log10();
        let bounds = deviations.iter().map(|(d, _)| *d);
        let (low, high) = bounds.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), d| {
            (low.min(d), high.max(d))
        });
        let middle = if law.at_least {
            deviations[0].0
        } else {
            0.5 * (low + high)
        };
        for (deviation, seen) in deviations {
            let off = deviation - middle;
            if off < -allowed || (off > allowed && !law.at_least) {
                told.push(format!(
                    "{} at {}: {:.2e} was kept, {off:.2} decades from the law",
                    family.name, seen.label, seen.kept
                ));
            }
        }
    }
    assert_none(&told);
}

/// With equally many bits the tolerance stays where it is, so that the margin is lost as evenly as the singular value falls.
/// (Frames far away, loops in large numbers and rounded digits change what the equations are known to.)
#[test]
fn tolerances_do_not_jump() {
    for family in families().iter().filter(|f| f.law.is_some()) {
        if family.name.starts_with("far_") || family.parameter == "loops" {
            continue;
        }
        if family.name == "screw_against_slide" {
            continue; // Its only length is its pitch.
        }
        for pair in family.seen.windows(2) {
            let [a, b] = [&pair[0], &pair[1]];
            let decided = [a, b].iter().all(|s| s.outcome == Outcome::Right);
            let ratio = (a.tolerance / b.tolerance).ln().abs();
            assert!(
                !decided || a.rank_bits != b.rank_bits || ratio < 4f64.ln() || a.steps > 0,
                "{} at {}: tolerance {:.1e} after {:.1e}",
                family.name,
                b.label,
                b.tolerance,
                a.tolerance
            );
        }
    }
}

/// Frames at a distance of 10^k lengths cost k digits, and no more than a factor of three beside.
#[test]
fn distance_costs_its_own_digits() {
    for family in families().iter().filter(|f| f.name.starts_with("far_")) {
        let near = &family.seen[0];
        for seen in &family.seen {
            let lost = (seen.tolerance / near.tolerance).log10();
            assert!(
                lost <= seen.decades.unwrap() + 3f64.log10(),
                "{} at {}: {lost:.1} digits",
                family.name,
                seen.label
            );
        }
    }
}

/// One decimal more is a tolerance ten times smaller, until rounding takes over; and whatever moves within its decimals only is
/// called nominal, as nothing else is.
#[test]
fn decimals_are_worth_their_tolerance() {
    for family in families() {
        let written = family.name.starts_with("written_");
        for pair in family.seen.windows(2).filter(|_| written) {
            let [a, b] = [&pair[0], &pair[1]];
            let [before, after] = [a, b].map(|s| s.decades.unwrap());
            if !(-12.0..=-6.0).contains(&before)
                || after < -12.0
                || a.outcome != Outcome::Right
                || a.excluded
            {
                continue;
            }
            let gained = (a.tolerance / b.tolerance).log10();
            // Half a decade more or less where angles or directions take over from lengths.
            assert!(
                (gained - (before - after)).abs() < 0.6,
                "{} at {}: {gained:.2} decades",
                family.name,
                b.label
            );
        }
        for seen in &family.seen {
            let decimals = seen.decades.map_or(0.0, |d| -d);
            let mobile = seen.verdict == Verdict::Mobile;
            assert!(
                !seen.nominal || (written && mobile),
                "{} at {} is called nominal",
                family.name,
                seen.label
            );
            assert!(
                // What the twelfth decimal leaves open is nothing to any reader.
                !(written && mobile && decimals < 12.0) || seen.nominal,
                "{} at {} is not called nominal",
                family.name,
                seen.label
            );
        }
    }
}

/// No member costs more than the last rung of the ladder of precisions, or than power series of degree 24 whose coefficients have 48
/// bits and those of the smallest number for every degree; and assembling takes no more steps than all starts together may: 200
/// each of the pose drawn, seven beside it and 256 others.
#[test]
fn work_is_bounded() {
    check(|_, seen| {
        let smallest = seen.decades.unwrap_or(0.0).abs() * 10f64.log2() + 8.0;
        let of_series = (48.0 + smallest) * (24.0 + 4.0) + 64.0;
        let known = seen.bits == 53 || LADDER.contains(&seen.bits);
        let bounded = known || f64::from(seen.bits) <= of_series;
        (!bounded || seen.steps > 200 * (8 + 256))
            .then(|| format!("{} bits, {} steps", seen.bits, seen.steps))
    });
}

/// Members that double precision decides are not evaluated in more digits.
#[test]
fn more_digits_are_used_where_they_are_needed() {
    check(|family, seen| {
        let tame = seen.decades.is_some_and(|d| d.abs() <= 1.0) && seen.steps == 0;
        let tame = tame && !family.name.ends_with("_turned");
        (tame && seen.rank_bits > 106).then(|| format!("{} bits", seen.rank_bits))
    });
}

#[test]
fn the_table_in_the_documentation_shows_what_is_found_now() {
    let path = folder("docs/src/stability.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let [begin, end] = table::MARKS;
    let (head, rest) = page.split_once(begin).expect("the page has a place for it");
    let (between, tail) = rest.split_once(end).expect("the place has an end");
    let now = table::table(families());
    if std::env::var_os("KUTZBACH_UPDATE").is_some() {
        std::fs::write(&path, format!("{head}{begin}\n\n{now}\n\n{end}{tail}")).unwrap();
        return;
    }
    let told = table::differences(between.trim(), &now);
    assert!(
        told.is_empty() && between.trim() == now,
        "{}\nto write it anew: KUTZBACH_UPDATE=1 cargo test --test it stability::",
        told.join("\n")
    );
}
