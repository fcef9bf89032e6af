//! How far the mechanism meant is from the numbers written.

use super::dimensions::turns;
use super::parts::{PartMeant, WITHIN};
use crate::intended::Change;
use crate::verdict::Nominal;

/// The mechanism meant, as the verdict tells it.
pub(super) fn nominal(parts: &[&PartMeant], finite: usize) -> Nominal {
    let misfit = |part: &&PartMeant| {
        let open = part.nearest.as_ref().map_or(0.0, |nearest| nearest.misfit);
        open * part.length
    };
    let distance = |part: &&PartMeant| {
        let (far, turn) = farthest(&part.changes);
        far.max(turn * part.length)
    };
    Nominal {
        finite,
        tolerance: parts.iter().map(misfit).fold(0.0, f64::max),
        distance: Some(parts.iter().map(distance).fold(0.0, f64::max)),
        known_to: None,
        within_digits: parts.iter().all(|part| part.units() <= WITHIN),
        noise: false,
        changes: sorted(parts.iter().flat_map(|part| part.changes.clone()).collect()),
        kept: parts.iter().flat_map(|part| part.kept.clone()).collect(),
    }
}

/// Largest change of a length (m), and of an angle or a direction (rad).
fn farthest(changes: &[Change]) -> (f64, f64) {
    let largest = |turning: bool| {
        changes
            .iter()
            .filter(|change| turns(change.place) == turning)
            .map(|change| (change.to - change.from).abs())
            .fold(0.0, f64::max)
    };
    (largest(false), largest(true))
}

/// Changes that are none left out, the largest first.
pub(super) fn sorted(mut changes: Vec<Change>) -> Vec<Change> {
    changes.retain(|change| change.to != change.from);
    changes.sort_by(|a, b| b.units().total_cmp(&a.units()));
    changes
}
