//! How far every joint goes along the motions shown.

use super::stage::Stage;
use crate::text::words::figure;
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{EndReason, Range};
use std::collections::BTreeMap;

/// By name of the joint: its range on every branch that is a curve. Where a branch has more freedoms, ranges depend on what
/// is held, and nothing is said.
pub(super) fn ranges(mechanism: &Mechanism, stage: &Stage) -> BTreeMap<String, String> {
    let played = &stage.repertoire.played;
    let several = played.iter().any(|p| p.branch != 0);
    let mut ranges: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for played in played.iter().filter(|p| p.motion.dimension == 1) {
        // How far a motion without end was followed is no range.
        let mut ends = played.motion.ends.iter();
        let endless = ends.any(|end| end.reason == EndReason::GoesOn);
        for range in played.motion.ranges.iter().filter(|range| range.moves) {
            let joint = &mechanism.joints()[range.variable.joint];
            let part = range
                .variable
                .name
                .strip_prefix(joint.name.as_str())
                .map_or("", |part| part.trim_start_matches('.'));
            let mut text = String::new();
            if several {
                text.push_str(&format!("{}: ", played.motion.branch));
            }
            if !part.is_empty() {
                text.push_str(&format!("{part} "));
            }
            text.push_str(if endless { "at least " } else { "" });
            text.push_str(&one(range, mechanism));
            ranges.entry(joint.name.clone()).or_default().push(text);
        }
    }
    ranges
        .into_iter()
        .map(|(name, texts)| (name, texts.join("; ")))
        .collect()
}

fn one(range: &Range, mechanism: &Mechanism) -> String {
    if range.turns != 0 {
        return match range.turns.abs() {
            1 => "turns fully".to_owned(),
            n => format!("turns fully, {n} times"),
        };
    }
    let angle = range.variable.unit(mechanism) == "rad";
    let (shown, unit) = if angle {
        (f64::to_degrees as fn(f64) -> f64, "°")
    } else {
        ((|x| x) as fn(f64) -> f64, " m")
    };
    format!(
        "{} … {}{unit}",
        figure(shown(range.min)),
        figure(shown(range.max))
    )
}
