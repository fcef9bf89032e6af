//! Which joints to hold where nobody says so.

use super::half_turn::HalfTurn;
use kutzbach_math::number::Number;
use kutzbach_mobility::{AnalysisOptions, Depth, Freedom, analyse};
use kutzbach_model::mechanism::{JointId, JointKind, Mechanism};
use kutzbach_motion::inputs;

/// What is held where nobody says it.
#[derive(Default)]
pub(super) struct Proposed {
    /// The inputs that turn or slide, and hold the mechanism where it is drawn.
    pub held: Vec<(JointId, Number)>,
    /// Names of the other inputs, which no number holds.
    pub not_held: Vec<String>,
    /// Its finite freedoms there; `None` where that is not decided.
    pub finite: Option<usize>,
}

/// The inputs of a mechanism as drawn, which are those that its report names; and how many finite freedoms it has.
fn freedoms(mechanism: &Mechanism) -> (Vec<Freedom>, Option<usize>) {
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
    let found = inputs(analysis.of(mechanism), &analysis, branch, None, Vec::new());
    (found.driven(), finite)
}

/// The joints that hold a mechanism where it is drawn.
pub(super) fn proposed(mechanism: &Mechanism) -> Proposed {
    let (all, finite) = freedoms(mechanism);
    let mut proposed = Proposed {
        finite,
        ..Proposed::default()
    };
    for input in all {
        let joint = &mechanism.joints()[input.joint];
        match joint.kind {
            JointKind::Revolute | JointKind::Prismatic => {
                proposed.held.push((JointId(input.joint), Number::zero()));
            }
            _ => proposed.not_held.push(joint.freedom_name(input.variable)),
        }
    }
    proposed
}

/// Names of the freedoms that would have to be held as well, and how many freedoms are left where the mechanism is drawn;
/// `None` where that is not decided.
pub(super) fn freedoms_left(mechanism: &Mechanism) -> (Vec<String>, Option<usize>) {
    let name = |input: &Freedom| mechanism.joints()[input.joint].freedom_name(input.variable);
    let (inputs, finite) = freedoms(mechanism);
    (inputs.iter().map(name).collect(), finite)
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
