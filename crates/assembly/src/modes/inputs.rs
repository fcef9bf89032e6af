//! Which joints to hold where nobody says so.

use super::half_turn::HalfTurn;
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

/// Turning joints that are held at an angle without an algebraic cosine, and the angle near it.
pub(super) fn held_near(
    mechanism: &Mechanism,
    held: &[(JointId, Number)],
) -> Vec<(JointId, HalfTurn)> {
    let turns = |joint: JointId| mechanism.joint(joint).kind == JointKind::Revolute;
    held.iter()
        .filter(|(joint, _)| turns(*joint))
        .filter_map(|(joint, value)| Some((*joint, HalfTurn::near(value)?)))
        .collect()
}

/// Where joints are held, with the angles that stand for others.
pub(super) fn replaced(
    held: &[(JointId, Number)],
    near: &[(JointId, HalfTurn)],
) -> Vec<(JointId, Number)> {
    let value = |(joint, asked): &(JointId, Number)| {
        let near = near.iter().find(|(other, _)| other == joint);
        let angle = near.and_then(|(_, half)| half.angle());
        (*joint, angle.unwrap_or_else(|| asked.clone()))
    };
    held.iter().map(value).collect()
}
