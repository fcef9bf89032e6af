//! Whether a loop would close if one of its two frames were turned by half a turn.
//!
//! Sides that face each other's backs are a common slip: an axis that points the other way, a frame turned over by an
//! export. It is told only where it has been tried.

use super::super::displacement::JointDisplacement;
use super::super::geometry::{Geometry, relative};
use super::super::jacobian::Part;
use super::LoopGap;
use super::closing::{Trying, close};
use super::descent::Task;
use kutzbach_math::matrix::MatrixError;
use kutzbach_math::space::{Rigid, Vector, dot, perpendicular};
use kutzbach_model::mechanism::Mechanism;
use std::collections::BTreeSet;

/// Gaps of at least this angle (rad) are looked at.
const TURNED_OVER: f64 = 3.0;

/// Loops looked at, and starts made for each.
const LOOPS: usize = 4;
const STARTS: usize = 16;

/// A loop that closes, with all that moves together with it, once a frame is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reversal {
    /// The joint that closes the loop.
    pub joint: usize,
    /// The direction about which its successor's frame is to be turned by 180°, in that frame.
    pub about: [f64; 3],
}

/// Tries to turn the frames of loops that are open by about half a turn.
pub(super) fn reversal(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    parts: &[Part],
    held: &BTreeSet<usize>,
    gaps: &[LoopGap],
    tolerance: Option<f64>,
    work: &mut f64,
) -> Result<Option<Reversal>, MatrixError> {
    let suspects = gaps
        .iter()
        .filter(|gap| gap.angle.max(gap.left_angle) > TURNED_OVER)
        .take(LOOPS);
    for gap in suspects {
        let joint = gap.joint;
        let Some(part) = parts.iter().find(|part| part.joints.contains(&joint)) else {
            continue;
        };
        for about in half_turns(&geometry.displacements[joint]) {
            if !(*work > 0.0) {
                return Ok(None);
            }
            let mut turned = geometry.clone();
            let half_turn = Rigid::rotation(&about, &-1.0, &0.0);
            turned.sides[joint][1] = turned.sides[joint][1].compose(&half_turn);
            if !held.contains(&joint) {
                let wanted = relative(
                    &turned.home,
                    &mechanism.joints()[joint],
                    &turned.sides[joint],
                );
                turned.states[joint] = turned.displacements[joint].fit(&wanted);
            }
            let mut states = turned.states.clone();
            let task = Task {
                mechanism,
                geometry: &turned,
                part,
                held,
                tolerance,
            };
            let reference = turned.states.clone();
            if close(&task, &mut states, &reference, Trying::starts(STARTS), work)?
                .outcome
                .closed()
            {
                return Ok(Some(Reversal { joint, about }));
            }
        }
    }
    Ok(None)
}

/// Half turns that make a difference to a joint: about the coordinate axes, as far as they are across its own.
fn half_turns(joint: &JointDisplacement<f64>) -> Vec<Vector<f64>> {
    let base = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let kind = joint.kind();
    if !kind.uses_axis() {
        return base.to_vec();
    }
    let axis = joint.axis();
    let across: Vec<Vector<f64>> = base
        .into_iter()
        .filter(|direction| dot(direction, axis).abs() < 1e-9)
        .collect();
    match across.len() {
        0 => vec![perpendicular(axis).0],
        _ => across,
    }
}
