//! What rounded numbers leave of a proof.
//!
//! A proof holds for the numbers as written. Simple solutions of as many equations as unknowns stay when these move a little, and so
//! does their number. Solutions that count several times, and those of more equations than unknowns, need not: the mechanism
//! meant, whose numbers differ from those written by what was rounded, may close in more ways, or in fewer.

use super::{Complete, Modes};
use kutzbach_model::mechanism::Mechanism;

/// Withdraws the proof of an answer to rounded numbers that other digits may change. `square`: all configurations are known to
/// be simple solutions of as many equations as unknowns. `never_closes`: the usual assembly has shown, with the digits in mind,
/// that nothing closes.
pub(super) fn doubt(modes: &mut Modes, mechanism: &Mechanism, square: bool, never_closes: bool) {
    if mechanism.precision().is_exact() || modes.complete != Complete::Proven {
        return;
    }
    let singular = |times: usize| times > 1;
    let why = if modes.configurations.is_empty() {
        if never_closes {
            return;
        }
        "nothing closes as they are written"
    } else if modes
        .configurations
        .iter()
        .any(|c| c.multiplicity.is_some_and(singular))
    {
        "a configuration counts several times"
    } else if square {
        return;
    } else {
        "there are more equations than unknowns, or configurations hardly apart"
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
