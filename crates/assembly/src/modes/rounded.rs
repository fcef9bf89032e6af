//! What rounded numbers leave of a proof.
//!
//! A proof holds for the numbers as written. Simple solutions of as many equations as unknowns stay when these move a little, and so
//! does their number, which is asked by a second search for all coefficients within what rounding left out. Solutions that count
//! several times, and those of more equations than unknowns, need not stay: the mechanism meant may close in more ways, or in fewer.

use super::{Complete, Modes, Way};
use crate::placed::{Gap, Slack};
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_model::mechanism::{JointId, Mechanism};
use std::collections::BTreeMap;

/// The share of a coefficient by which rounding may have moved it: what is unknown of all lengths of an independent sub-mechanism, in
/// parts of its size, and of all angles; of that sub-mechanism of which it is most. To first order, and without the levers of
/// points close together; the search for it takes every coefficient to be off by that share of the largest, and all in the worst
/// direction. Then the same in metres.
fn slack_of(mechanism: &Mechanism) -> Slack {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let mut open: BTreeMap<usize, (f64, f64, f64)> = BTreeMap::new();
    for (joint, uncertainty) in geometry.uncertainties.iter().enumerate() {
        let Some(block) = mechanism.sub_mechanism(JointId(joint)) else {
            continue;
        };
        let (lengths, angles, size) = open.entry(block).or_default();
        *lengths += uncertainty.lengths;
        // Some angles are read as others within their digits.
        *angles += 2.0 * uncertainty.angles;
        *size = match geometry.arms[joint] > 0.0 {
            true => geometry.arms[joint],
            false => size.max(geometry.size_of([joint])),
        };
    }
    let mut slack = Slack::default();
    for (lengths, angles, size) in open.into_values() {
        let size = if size > 0.0 { size } else { 1.0 };
        let share = lengths / size + angles;
        slack.share = slack.share.max(share);
        slack.metres = slack.metres.max(share * size);
    }
    slack
}

/// What the digits leave open: nothing where the numbers are exact.
pub(super) fn slack(mechanism: &Mechanism) -> Slack {
    match mechanism.precision().is_exact() {
        true => Slack::default(),
        false => slack_of(mechanism),
    }
}

/// What a gap has to be more than, in what rounding may have made of it, to be no work of rounding.
const CLEARLY: f64 = 10.0;

/// Whether a gap within one body is more than rounding can have made: along the body an unknown angle moves a point by no more than
/// the number of joints times the mechanism's size, to first order.
pub(super) fn is_beyond(mechanism: &Mechanism, gap: &Gap) -> bool {
    let slack = slack_of(mechanism);
    let metres = slack.metres * mechanism.joints().len() as f64;
    gap.radians > CLEARLY * slack.share || gap.metres > CLEARLY * metres
}

/// Withdraws the proof of an answer to rounded numbers that other digits may change. `stays`: it is known to be the same with
/// these. `never_closes`: the usual assembly has shown, with the digits in mind, that nothing closes.
pub(super) fn doubt(modes: &mut Modes, mechanism: &Mechanism, stays: bool, never_closes: bool) {
    let exact = mechanism.precision().is_exact();
    if exact || stays || modes.complete != Complete::Proven {
        return;
    }
    let singular = |times: usize| times > 1;
    let mut multiplicities = modes.configurations.iter().map(|c| c.multiplicity);
    let why = if modes.configurations.is_empty() {
        if never_closes {
            return;
        }
        match modes.contradiction.take() {
            Some(excluded) => format!("{excluded} as they are written"),
            None => "nothing closes as they are written".to_owned(),
        }
    } else if modes.way == Way::Nothing {
        "a joint between two sides of one body closes as they are written".to_owned()
    } else if matches!(modes.way, Way::Construction { .. }) {
        "circles and lines meet as they are written".to_owned()
    } else if multiplicities.any(|times| times.is_some_and(singular)) {
        "a configuration counts several times".to_owned()
    } else {
        "there are more equations than unknowns, or a configuration is too nearly singular for these digits".to_owned()
    };
    modes.complete = Complete::Unknown(format!(
        "the numbers are rounded, and with the digits that are not written there may be more configurations or fewer: {why}"
    ));
    modes.moves = None;
    for configuration in &mut modes.configurations {
        configuration.proven = false;
        configuration.finite = None;
    }
}
