//! Numbers, counted things and lists of names, as a person writes them.

use std::collections::BTreeSet;

/// A long list of names in natural order: runs that count up are written by their ends, `arm_1 … arm_7`.
#[must_use]
pub fn runs(list: &[String], most: usize) -> String {
    let each: Vec<Sides> = list.iter().cloned().map(|name| (name, 1)).collect();
    runs_of(&each, most)
}

/// The same with mirror images told together: `left/right_knee`.
#[must_use]
pub fn mirrored_runs(list: &[String], most: usize) -> String {
    runs_of(&mirrored(list), most)
}

/// A name, and of how many things it is the name: two for `left/right_knee`.
type Sides = (String, usize);

/// How files tell a left side from a right one.
const SIDES: [[&str; 2]; 5] = [
    ["left", "right"],
    ["Left", "Right"],
    ["LEFT", "RIGHT"],
    ["l", "r"],
    ["L", "R"],
];

/// The names, those that differ only in their side as one, at the place of the first.
fn mirrored(list: &[String]) -> Vec<Sides> {
    let known: BTreeSet<&str> = list.iter().map(String::as_str).collect();
    let mut told: BTreeSet<String> = BTreeSet::new();
    let mut all = Vec::new();
    for name in list {
        if told.contains(name) {
            continue;
        }
        let image = images(name).find(|(other, _)| {
            known.contains(other.as_str()) && other != name && !told.contains(other)
        });
        match image {
            Some((other, both)) => {
                told.insert(other);
                all.push((both, 2));
            }
            None => all.push((name.clone(), 1)),
        }
        told.insert(name.clone());
    }
    all
}

/// The names on the other side that a name may have, each with the name of both: one word of it is changed at a time.
fn images(name: &str) -> impl Iterator<Item = (String, String)> {
    let words: Vec<&str> = name
        .split_inclusive(|c: char| !c.is_alphanumeric())
        .collect();
    let mut found = Vec::new();
    for (index, word) in words.iter().enumerate() {
        let bare = word.trim_end_matches(|c: char| !c.is_alphanumeric());
        let end = &word[bare.len()..];
        for [left, right] in SIDES {
            let other = match bare {
                it if it == left => right,
                it if it == right => left,
                _ => continue,
            };
            let with = |text: &str| {
                let (before, after) = (words[..index].concat(), words[index + 1..].concat());
                format!("{before}{text}{end}{after}")
            };
            found.push((with(other), with(&format!("{left}/{right}"))));
        }
    }
    found.into_iter()
}

/// A text with every word that tells a side from the other as if it were the left one: equal for mirror images.
#[must_use]
pub fn one_side(text: &str) -> String {
    let parts = text.split_inclusive(|c: char| !c.is_alphanumeric());
    let left = |part: &str| {
        let bare = part.trim_end_matches(|c: char| !c.is_alphanumeric());
        let side = SIDES.iter().find(|[_, right]| *right == bare);
        side.map(|[left, _]| format!("{left}{}", &part[bare.len()..]))
    };
    parts
        .map(|part| left(part).unwrap_or_else(|| part.to_owned()))
        .collect()
}

fn runs_of(list: &[Sides], most: usize) -> String {
    let mut told: Vec<String> = Vec::new();
    let mut left = list;
    while !left.is_empty() && told.len() < most {
        let steps = left.windows(2).take_while(|w| counts_up(&w[0].0, &w[1].0));
        let length = match steps.count() + 1 {
            // Two names are as short as a run of them.
            2 => 1,
            length => length,
        };
        told.push(match length {
            1 => left[0].0.clone(),
            _ => format!("{} … {}", left[0].0, left[length - 1].0),
        });
        left = &left[length..];
    }
    if !left.is_empty() {
        let more: usize = left.iter().map(|(_, things)| things).sum();
        told.push(format!("{more} more"));
    }
    let all = told.len();
    names(&told, all)
}

/// Whether two names differ in one number only, which is greater by one in the second.
fn counts_up(one: &str, next: &str) -> bool {
    let digits = |c: &char| c.is_ascii_digit();
    let common = one
        .char_indices()
        .zip(next.chars())
        .find(|((_, a), b)| a != b)
        .map_or(one.len().min(next.len()), |((at, _), _)| at);
    // Back to where the number begins in which they differ.
    let begin = one.get(..common).map_or(0, |same| {
        same.len() - same.chars().rev().take_while(digits).count()
    });
    let number = |name: &str| {
        let tail = name.get(begin..)?;
        let length = tail.chars().take_while(digits).count();
        let value: u64 = tail.get(..length)?.parse().ok()?;
        Some((value, tail.get(length..)?.to_owned()))
    };
    match (number(one), number(next)) {
        (Some((a, rest)), Some((b, other))) => a.checked_add(1) == Some(b) && rest == other,
        _ => false,
    }
}

/// `1 joint`, `2 joints`; the plural is formed with `s`.
#[must_use]
pub fn counted(count: usize, thing: &str) -> String {
    if count == 1 {
        format!("1 {thing}")
    } else {
        format!("{count} {thing}s")
    }
}

/// `1 degree of freedom`, `2 degrees of freedom`.
#[must_use]
pub fn degrees(count: usize) -> String {
    match count {
        1 => "1 degree of freedom".to_owned(),
        n => format!("{n} degrees of freedom"),
    }
}

/// A clause as a sentence of its own: a capital, and one full stop.
#[must_use]
pub fn capitalised(clause: &str) -> String {
    let mut letters = clause.chars();
    let first: String = letters
        .next()
        .into_iter()
        .flat_map(char::to_uppercase)
        .collect();
    format!("{first}{}.", letters.as_str().trim_end_matches('.'))
}

/// A measured number with three significant digits: `0.3`, `12.5`, `2.5e-13`. Powers of ten from 0.001 to 10,000 are
/// written out.
#[must_use]
pub fn figure(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.2e}");
    let (mantissa, exponent) = scientific
        .split_once('e')
        .unwrap_or((scientific.as_str(), "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-3..4).contains(&exponent) {
        let decimals = usize::try_from(2 - exponent).unwrap_or(0);
        trimmed(&format!("{value:.decimals$}"))
    } else {
        format!("{}e{exponent}", trimmed(mantissa))
    }
}

/// Angles below this (rad) are what rounding of double precision leaves of none: a thousand times the last bit of 2π.
const NO_ANGLE: f64 = 1e-12;

/// An angle (rad) in degrees, without its unit; nothing but rounding is 0.
#[must_use]
pub fn in_degrees(angle: f64) -> String {
    match angle.abs() < NO_ANGLE {
        true => figure(0.0),
        false => figure(angle.to_degrees()),
    }
}

/// How many times, where beyond a thousand times nobody counts.
#[must_use]
pub fn times(factor: f64) -> String {
    match factor > 1000.0 {
        true => "more than 1000 times".to_owned(),
        false => format!("{} times", figure(factor)),
    }
}

/// A length in the unit that fits, from nanometres to metres: `9.6 µm`, `1.2 mm`.
#[must_use]
pub fn metres(value: f64) -> String {
    let units = [
        (1.0, "m"),
        (1e-3, "mm"),
        (1e-6, "µm"),
        (1e-9, "nm"),
        (1e-12, "pm"),
    ];
    // Rounded to three digits, 0.9996 mm is 1 mm.
    let unit = units
        .into_iter()
        .find(|(size, _)| value.abs() >= 0.9995 * size);
    match unit {
        Some((size, name)) => format!("{} {name}", figure(value / size)),
        None => format!("{} m", figure(value)),
    }
}

fn trimmed(digits: &str) -> String {
    if digits.contains('.') {
        digits
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned()
    } else {
        digits.to_owned()
    }
}

/// A time on the clock, in two or three digits and the unit that fits: `3.1 µs`, `12 ms`, `1.4 s`.
#[must_use]
pub fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if !s.is_finite() => return "–".to_owned(),
        s if s < 0.9995e-6 => (s * 1e9, "ns"),
        s if s < 0.9995e-3 => (s * 1e6, "µs"),
        s if s < 0.9995 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    if value < 9.95 {
        format!("{value:.1} {unit}")
    } else {
        format!("{value:.0} {unit}")
    }
}

/// `a`, `a and b`, `a, b and c`; above `most` names, `a, b and 12 more`.
#[must_use]
pub fn names(list: &[String], most: usize) -> String {
    let shown = if list.len() > most { most } else { list.len() };
    let more = list.len() - shown;
    let (last, first) = match (&list[..shown], more) {
        ([], 0) => return "none".to_owned(),
        (all, 0) => (all[shown - 1].clone(), &all[..shown - 1]),
        (all, more) => (format!("{more} more"), all),
    };
    if first.is_empty() {
        last
    } else {
        format!("{} and {last}", first.join(", "))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn names_that_count_up_are_written_by_their_ends() {
        let list = |names: &[&str]| names.iter().map(|n| (*n).to_owned()).collect::<Vec<_>>();
        let arm = list(&["arm_1_joint", "arm_2_joint", "arm_3_joint", "head"]);
        assert_eq!(runs(&arm, 9), "arm_1_joint … arm_3_joint and head");
        let two = list(&["j9", "j10", "k", "l"]);
        assert_eq!(runs(&two, 3), "j9, j10, k and 1 more");
        assert_eq!(runs(&list(&["j8", "j9", "j10"]), 9), "j8 … j10");
        assert_eq!(runs(&list(&["ä1", "ä2", "ä3"]), 9), "ä1 … ä3");
        assert!(!counts_up("a1b1", "a2b2") && !counts_up("a", "a1") && !counts_up("", ""));
    }

    #[test]
    fn mirror_images_are_told_together() {
        let told = |names: &[&str], most| {
            let list: Vec<String> = names.iter().map(|n| (*n).to_owned()).collect();
            mirrored_runs(&list, most)
        };
        let legs = ["left_hip", "left_knee", "right_hip", "right_knee"];
        assert_eq!(told(&legs, 9), "left/right_hip and left/right_knee");
        assert_eq!(told(&legs, 1), "left/right_hip and 2 more");
        assert_eq!(
            told(
                &[
                    "arm-l-1", "arm-l-2", "arm-l-3", "arm-r-1", "arm-r-2", "arm-r-3"
                ],
                9
            ),
            "arm-l/r-1 … arm-l/r-3"
        );
        assert_eq!(
            one_side("`r_grip`: right, r."),
            one_side("`l_grip`: left, l.")
        );
        // Neither part of a word nor a name without its image.
        let others = ["cleft", "cright", "left", "left_ä"];
        assert_eq!(told(&others, 9), "cleft, cright, left and left_ä");
        assert_eq!(told(&["left_right", "right_right"], 9), "left/right_right");
    }

    #[test]
    fn figures_have_three_digits() {
        for (value, text) in [
            (0.3, "0.3"),
            (-12.46, "-12.5"),
            (999.6, "1000"),
            (2.5e-13, "2.5e-13"),
            (0.001_234, "0.00123"),
            (123_456.0, "1.23e5"),
            (0.0, "0"),
            (1.0, "1"),
            (9999.0, "1e4"),
        ] {
            assert_eq!(figure(value), text);
        }
    }

    #[test]
    fn lengths_come_in_the_unit_that_fits() {
        for (value, text) in [
            (0.0, "0 m"),
            (1.25, "1.25 m"),
            (-0.012, "-12 mm"),
            (9.6e-6, "9.6 µm"),
            (0.000_999_6, "1 mm"),
            (2e-9, "2 nm"),
            (3.5e-14, "3.5e-14 m"),
        ] {
            assert_eq!(metres(value), text);
        }
    }

    #[test]
    fn long_lists_are_abridged() {
        let list: Vec<String> = ["a", "b", "c"].iter().map(|n| (*n).to_owned()).collect();
        assert_eq!(names(&list, 3), "a, b and c");
        assert_eq!(names(&list, 2), "a, b and 1 more");
        assert_eq!(names(&list[..1], 2), "a");
        assert_eq!(names(&[], 2), "none");
    }
}
