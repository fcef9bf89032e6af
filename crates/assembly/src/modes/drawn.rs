//! The drawn configuration among all, and what the mobility analysis knows of it.

use super::place::Drawn;
use super::{Complete, Configuration, Modes, inputs, place};
use kutzbach_model::mechanism::Mechanism;

/// Part of a mechanism's size that two poses of one configuration may differ: the drawn one is closed in doubles.
const SAME: f64 = 1e-6;
/// The same for singular ones, since an error of e in the equations moves a double solution by √e, and for unproven ones, which
/// may be those of rounded numbers.
const SAME_SINGULAR: f64 = 1e-3;
/// The same where numbers are rounded: the drawn pose closes within the digits and solutions solve the equations as they are written, so that
/// the two differ by what the digits leave open times the condition of the equations, of which nothing is known but that the pose is where a
/// draughtsman saw it close. Two configurations nearer to each other than this are told apart by which is nearer.
const SAME_ROUNDED: f64 = 1e-2;

/// Says of an answer what is known of the drawn configuration. An answer that is not complete lists it where it closes, with
/// the freedoms that the mobility analysis leaves it: whether something moves elsewhere does not tell whether it does here.
pub(super) fn tell(
    modes: &mut Modes,
    fixed: &Mechanism,
    drawn: Option<&Drawn>,
    share: f64,
    in_time: bool,
) {
    mark(modes, drawn, share);
    let Complete::Unknown(_) = modes.complete else {
        return;
    };
    // The analysis counts no effort.
    let (proposed, finite) = match in_time {
        true => inputs::freedoms_left(fixed),
        false => (Vec::new(), None),
    };
    list(modes, drawn, finite);
    if finite.is_some_and(|freedom| freedom > 0) {
        modes.moves = modes.moves.max(finite);
        modes.proposed = proposed;
    }
}

/// Lists the drawn configuration where the search did not.
fn list(modes: &mut Modes, drawn: Option<&Drawn>, finite: Option<usize>) {
    let Some(drawn) = drawn else { return };
    if let Some(found) = modes.configurations.iter_mut().find(|c| c.drawn) {
        found.finite = found.finite.or(finite);
        return;
    }
    modes.configurations.push(Configuration {
        joints: Vec::new(),
        poses: drawn.poses.iter().cloned().map(Some).collect(),
        multiplicity: None,
        proven: false,
        finite,
        drawn: true,
    });
}

/// Marks the configuration that is drawn. Where the drawn pose closes and is none of those that are said to be all, they are
/// not.
fn mark(modes: &mut Modes, drawn: Option<&Drawn>, share: f64) {
    let Some(drawn) = drawn else { return };
    let apart = |configuration: &Configuration| {
        configuration
            .poses
            .iter()
            .zip(&drawn.poses)
            .filter_map(|(pose, other)| Some(place::apart(pose.as_ref()?, other, drawn.size)))
            .fold(0.0, f64::max)
    };
    let nearest = modes
        .configurations
        .iter_mut()
        .map(|c| (apart(c), c))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((distance, configuration)) = nearest {
        let singular = configuration.multiplicity.is_some_and(|times| times > 1);
        let same = match singular || !configuration.proven {
            _ if share > 0.0 => SAME_ROUNDED.max(share),
            true => SAME_SINGULAR,
            false => SAME,
        };
        if distance <= same {
            configuration.drawn = true;
            return;
        }
    }
    if modes.complete == Complete::Proven && modes.moves.is_none_or(|freedom| freedom == 0) {
        modes.complete = Complete::Unknown(
            "the drawn pose closes within rounding and is none of the configurations found"
                .to_owned(),
        );
        modes.contradiction = None;
        modes.moves = None;
    }
}
