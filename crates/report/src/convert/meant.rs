//! Numbers that a reader worked out from rounded ones, as they are written.
//!
//! A pose that was multiplied has no digits that say how well it is known. Written with few of them it is known to a unit of its last place, and the numbers
//! beside it to theirs; written with all digits of a double it counts as exact, and what moves within the digits of the literals behind it binds. So where
//! the verdict hangs on such digits, the numbers written are those of the nearest mechanism that moves so, in full.

use crate::text::words::metres;
use kutzbach_math::number::Number;
use kutzbach_mobility::{AnalysisError, AnalysisOptions, Depth, Verdict, analyse_to_follow};
use kutzbach_model::mechanism::{JointId, Mechanism, Placement};

/// A mechanism to be written, and what is to be told of its numbers.
#[derive(Clone, Debug)]
pub struct InFull {
    /// The mechanism: the one given, or that meant by its rounded numbers.
    pub mechanism: Mechanism,
    /// What was changed, or what the file will not say, in a sentence.
    pub note: Option<String>,
}

/// A mechanism of which a file written in full says what is said of it.
///
/// One without loops, of literals alone, or of exact numbers is as it was, without an analysis. Otherwise this costs an analysis of [`Depth::Verdict`].
///
/// # Errors
/// As [`analyse_to_follow`].
pub fn in_full(mechanism: &Mechanism) -> Result<InFull, AnalysisError> {
    let as_it_is = |note: Option<&str>| InFull {
        mechanism: mechanism.clone(),
        note: note.map(str::to_owned),
    };
    if !hangs_on_literals(mechanism) {
        return Ok(as_it_is(None));
    }
    let options = AnalysisOptions {
        depth: Depth::Verdict,
        ..AnalysisOptions::default()
    };
    let found = analyse_to_follow(mechanism, &options)?;
    if let Some(changed) = found.changed {
        let note = format!(
            "poses that were worked out from rounded numbers are written in full: as the nearest dimensions that move, up to {} from those read",
            metres(changed)
        );
        return Ok(InFull {
            mechanism: found.mechanism,
            note: Some(note),
        });
    }
    let mobility = &found.analysis.mobility;
    // Without a distance no such dimensions were found.
    let nominal = mobility.nominal.as_ref();
    let may_bind = nominal.is_some_and(|own| own.within_digits || own.distance.is_none());
    let is_open = mobility.verdict == Verdict::Undecided || may_bind;
    Ok(as_it_is(is_open.then_some(
        "poses that were worked out from rounded numbers are written in full, as if they were exact: what moves within the digits of these may bind",
    )))
}

/// Whether numbers of joints in loops are rounded, and some are worked out from others.
fn hangs_on_literals(mechanism: &Mechanism) -> bool {
    let is_rounded = |index: usize| !mechanism.precision_of(JointId(index)).is_exact();
    if !(0..mechanism.joints().len()).any(is_rounded) {
        return false;
    }
    let worked_out = |number: &Number| !number.inputs().is_empty();
    let joints = mechanism.joints().iter();
    let mut of_joints = joints.flat_map(|joint| joint.numbers().into_iter().flatten());
    let links = mechanism.links().iter();
    let mut of_links = links.flat_map(|link| match &link.placement {
        Placement::Floating { origin, .. } => [&origin.position[..], &origin.roll_pitch_yaw[..]],
        Placement::World | Placement::Joint(_) => [&[][..]; 2],
    });
    of_joints.any(worked_out) || of_links.any(|numbers| numbers.iter().any(worked_out))
}
