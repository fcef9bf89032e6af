//! Numbers that a reader worked out from rounded ones, as they are written.
//!
//! A pose that was multiplied has no digits that say how well it is known. Written with few of them it is known to a unit of its last place, and the numbers
//! beside it to theirs; written with all digits of a double it counts as exact, and what moves within the digits of the literals behind it binds. So where
//! the verdict hangs on such digits, the numbers written are those of the nearest mechanism that moves so, in full.

use crate::text::words::metres;
use kutzbach_closure::Assembly;
use kutzbach_math::number::Number;
use kutzbach_mobility::{AnalysisOptions, Depth, Verdict, analyse_to_follow};
use kutzbach_model::mechanism::{JointId, Mechanism, Placement};

/// A mechanism to be written, and what is to be told of its numbers.
#[derive(Clone, Debug)]
pub struct InFull {
    /// The mechanism: the one given, or that meant by its rounded numbers.
    pub mechanism: Mechanism,
    /// How its loops close; `None` where there was no analysis.
    pub assembly: Option<Assembly>,
    /// What was changed, or what the file will not say, in a sentence.
    pub note: Option<String>,
}

/// A mechanism of which a file written in full says what is said of it.
///
/// One without loops, of literals alone, or of exact numbers is as it was, without an analysis. Otherwise this costs an analysis with these
/// options, of [`Depth::Verdict`]. One that cannot be analysed is as it was, which is noted.
#[must_use]
pub fn in_full(mechanism: &Mechanism, options: &AnalysisOptions) -> InFull {
    let as_it_is = |assembly: Option<Assembly>, note: Option<String>| InFull {
        mechanism: mechanism.clone(),
        assembly,
        note,
    };
    if !hangs_on_literals(mechanism) {
        return as_it_is(None, None);
    }
    let options = AnalysisOptions {
        depth: Depth::Verdict,
        ..options.clone()
    };
    let found = match analyse_to_follow(mechanism, &options) {
        Ok(found) => found,
        Err(error) => {
            let note = format!(
                "poses that were worked out from rounded numbers are written in full, and whether the file moves as the one read is not known: {error}"
            );
            return as_it_is(None, Some(note));
        }
    };
    if let Some(changed) = found.changed {
        let note = format!(
            "poses that were worked out from rounded numbers are written in full: as the nearest dimensions that move, up to {} from those read",
            metres(changed)
        );
        return InFull {
            mechanism: found.mechanism,
            assembly: Some(found.analysis.assembly),
            note: Some(note),
        };
    }
    let mobility = &found.analysis.mobility;
    // Without a distance no such dimensions were found.
    let nominal = mobility.nominal.as_ref();
    let may_bind = nominal.is_some_and(|own| own.within_digits || own.distance.is_none());
    let is_open = mobility.verdict == Verdict::Undecided || may_bind;
    let note = is_open.then(|| {
        "poses that were worked out from rounded numbers are written in full, as if they were exact: what moves within the digits of these may bind"
            .to_owned()
    });
    as_it_is(Some(found.analysis.assembly), note)
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
