//! How far joints go, in words.

use super::style::Units;
use super::words::figure;
use crate::schema::{JointRange, Report};
use std::collections::BTreeMap;

/// By name of the joint, its range on every branch that is a curve.
pub(super) fn texts(report: &Report, units: Units) -> BTreeMap<String, String> {
    let several = report.branches.as_ref().is_some_and(|b| b.len() > 1);
    let with_ranges = report.joints.iter().filter(|row| !row.ranges.is_empty());
    with_ranges
        .map(|row| {
            let mut told: Vec<(String, Vec<&str>)> = Vec::new();
            for range in &row.ranges {
                let text = one(range, units);
                match told.iter_mut().find(|(known, _)| *known == text) {
                    Some((_, branches)) => branches.push(&range.branch),
                    None => told.push((text, vec![&range.branch])),
                }
            }
            // The same on every branch is said once.
            let alike = told.len() == 1;
            let parts: Vec<String> = told
                .into_iter()
                .map(|(text, branches)| match several && !alike {
                    true => format!("{}: {text}", branches.join(", ")),
                    false => text,
                })
                .collect();
            (row.name.clone(), parts.join("; "))
        })
        .collect()
}

/// `full turn`, `-12.5 … 44.6°`, `trans -3 … 12 mm`.
fn one(range: &JointRange, units: Units) -> String {
    let part = match &range.part {
        Some(part) => format!("{part} "),
        None => String::new(),
    };
    let at_least = if range.at_least { "at least " } else { "" };
    if range.turns != 0 {
        let turns = match range.turns.abs() {
            1 => "full turn".to_owned(),
            n => format!("{n} full turns"),
        };
        return format!("{part}{at_least}{turns}");
    }
    let (factor, unit) = match (range.angle, units) {
        (true, Units::Drawing) => (180.0 / std::f64::consts::PI, "°"),
        (true, Units::Si) => (1.0, " rad"),
        (false, Units::Drawing) => (1e3, " mm"),
        (false, Units::Si) => (1.0, " m"),
    };
    // What is nothing beside the other end is none.
    let largest = range.min.abs().max(range.max.abs());
    let shown = |value: f64| match value.abs() <= 1e-9 * largest {
        true => "0".to_owned(),
        false => figure(factor * value),
    };
    format!(
        "{part}{at_least}{} … {}{unit}",
        shown(range.min),
        shown(range.max)
    )
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::samples::mobile;

    fn range(branch: &str, min: f64, max: f64, turns: i64) -> JointRange {
        JointRange {
            branch: branch.to_owned(),
            part: None,
            min,
            max,
            turns,
            angle: true,
            at_least: false,
        }
    }

    #[test]
    fn ranges_come_in_the_units_of_a_drawing_or_of_the_file() {
        let swing = range("A", -0.5, 1.0, 0);
        assert_eq!(one(&swing, Units::Drawing), "-28.6 … 57.3°");
        assert_eq!(one(&swing, Units::Si), "-0.5 … 1 rad");
        let slide = JointRange {
            part: Some("trans".to_owned()),
            angle: false,
            at_least: true,
            ..range("A", 1e-17, 0.25, 0)
        };
        assert_eq!(one(&slide, Units::Drawing), "trans at least 0 … 250 mm");
        assert_eq!(one(&slide, Units::Si), "trans at least 0 … 0.25 m");
        assert_eq!(one(&range("A", 0.0, 7.0, -1), Units::Si), "full turn");
        assert_eq!(one(&range("A", 0.0, 13.0, 2), Units::Si), "2 full turns");
    }

    #[test]
    fn branches_are_named_where_they_differ() {
        let mut report = mobile();
        let mut second = report.branches.as_ref().unwrap()[0].clone();
        second.name = "B".to_owned();
        report.branches.as_mut().unwrap().push(second);
        report.joints[0].ranges = vec![range("A", 0.0, 1.0, 0), range("B", 0.0, 1.0, 0)];
        report.joints[1].ranges = vec![range("A", 0.0, 1.0, 0), range("B", 0.0, 2.0, 0)];
        let texts = texts(&report, Units::Si);
        assert_eq!(texts["J1"], "0 … 1 rad");
        assert_eq!(texts["J2"], "A: 0 … 1 rad; B: 0 … 2 rad");
        assert_eq!(texts.len(), 2);
    }
}
