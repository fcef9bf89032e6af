//! Which joints to hold where nobody says so.

use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_math::number::Number;
use kutzbach_mobility::{AnalysisOptions, Depth, actuation, analyse};
use kutzbach_model::mechanism::{JointId, JointKind, Mechanism};

/// Joint and index of the freedom, of freedoms that together hold a mechanism as drawn; and how many there are.
fn freedoms(mechanism: &Mechanism) -> (Vec<(usize, usize)>, Option<usize>) {
    let options = AnalysisOptions {
        depth: Depth::Motions,
        ..AnalysisOptions::default()
    };
    let Ok(analysis) = analyse(mechanism, &options) else {
        return (Vec::new(), None);
    };
    let finite = analysis.mobility.finite();
    let Some(branch) = analysis.branches.as_ref().and_then(|all| all.first()) else {
        return (Vec::new(), finite);
    };
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let found = actuation(mechanism, &geometry, &analysis.structure, branch, None, &[]);
    let proposed = found.map(|found| found.proposed).unwrap_or_default();
    (
        proposed.iter().map(|f| (f.joint, f.variable)).collect(),
        finite,
    )
}

/// The joints that hold a mechanism where it is drawn, as far as they turn or slide; and its finite freedoms there.
pub(super) fn proposed(mechanism: &Mechanism) -> (Vec<(JointId, Number)>, Option<usize>) {
    let holds = |joint: usize| {
        matches!(
            mechanism.joints()[joint].kind,
            JointKind::Revolute | JointKind::Prismatic
        )
    };
    let (all, finite) = freedoms(mechanism);
    let held = all.into_iter().filter(|(joint, _)| holds(*joint));
    (
        held.map(|(joint, _)| (JointId(joint), Number::zero()))
            .collect(),
        finite,
    )
}

/// Names of the freedoms that would have to be held as well, and how many freedoms are left where the mechanism is drawn;
/// `None` where that is not decided.
pub(super) fn freedoms_left(mechanism: &Mechanism) -> (Vec<String>, Option<usize>) {
    let name = |(joint, variable): (usize, usize)| mechanism.joints()[joint].freedom_name(variable);
    let (proposed, finite) = freedoms(mechanism);
    (proposed.into_iter().map(name).collect(), finite)
}
