//! Poses that are known from elsewhere, where the drawn pose and its neighbours lead to no closing.

use super::super::displacement::JointState;
use super::super::geometry::relative;
use super::super::jacobian::Part;
use super::ProvenOpen;
use super::descent::{Effort, Kept, PartOutcome, Task, descend};
use super::limits;
use super::nearest::{distance, settle, unwind};
use super::search::Merit;
use kutzbach_math::matrix::MatrixError;
use kutzbach_math::space::Rigid;

/// Where some joints of a part stand, by joint index: `predecessor_frame -> successor_frame` (m).
pub type JointPoses = Vec<(usize, Rigid<f64>)>;

/// What is known of the poses at which a part closes.
#[derive(Clone, Debug)]
pub enum Solved {
    /// Nothing.
    Unknown,
    /// There is none.
    Never(ProvenOpen),
    /// These are all, each to double precision: of joints enough to place the links of the part. There may be none.
    All(Vec<JointPoses>),
    /// There are these, and more.
    Some(Vec<JointPoses>),
}

/// Who knows the poses at which a part closes, given where its joints stand. What is held is not heeded: nobody is asked about parts with
/// held joints.
pub type Solver<'a> = dyn Fn(&Part, &[JointState<f64>]) -> Solved + 'a;

/// Nobody.
pub(super) fn nobody(_: &Part, _: &[JointState<f64>]) -> Solved {
    Solved::Unknown
}

/// Closes a part at the best of the poses known: one within the joint limits goes first, then the one nearest to the reference. Where these
/// are not all, the pose goes on to the nearest one from there; where they are, what closes beside one does so within rounding only. The
/// states end there; where none closes, they are as they were.
pub(super) fn closed_at(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    reference: &[JointState<f64>],
    known: &Solved,
    work: &mut f64,
) -> Result<Option<PartOutcome>, MatrixError> {
    let (poses, all) = match known {
        Solved::All(poses) => (poses, true),
        Solved::Some(poses) => (poses, false),
        Solved::Unknown | Solved::Never(_) => return Ok(None),
    };
    let begun = Kept::of(task.part, states);
    let mut best: Option<(Merit, Kept<f64>, PartOutcome)> = None;
    for pose in poses {
        begun.put_back(states);
        if !put(task, states, pose) {
            continue;
        }
        unwind(task, reference, states);
        let outcome = descend(task, states, Effort::SHORT)?;
        if !outcome.closed() {
            continue;
        }
        let settled = match all {
            true => outcome,
            false => settle(task, reference, states, outcome, work)?,
        };
        let merit = Merit {
            outside: limits::excess(task, states),
            moves_driven: false,
            distance: distance(task, reference, states, &settled),
        };
        if best.as_ref().is_none_or(|(least, ..)| merit < *least) {
            best = Some((merit, Kept::of(task.part, states), settled));
        }
    }
    Ok(match best {
        Some((_, pose, outcome)) => {
            pose.put_back(states);
            // The joints have moved, if only from where they are drawn.
            let steps = outcome.steps.max(1);
            Some(PartOutcome { steps, ..outcome })
        }
        None => {
            begun.put_back(states);
            None
        }
    })
}

/// Puts the joints of a part where a pose has them: those that it names, and all others between the links that these place.
/// `false` where that leaves a link without a place.
fn put(task: &Task<'_>, states: &mut [JointState<f64>], pose: &JointPoses) -> bool {
    let joints = task.mechanism.joints();
    let geometry = task.geometry;
    for (joint, at) in pose {
        states[*joint] = geometry.displacements[*joint].fit(at);
    }
    let ends = |joint: usize| {
        let joint = &joints[joint];
        [joint.predecessor.link.0, joint.successor.link.0]
    };
    let Some(&first) = task.part.joints.first() else {
        return false;
    };
    let mut links = geometry.home.clone();
    let mut placed = vec![false; links.len()];
    placed[ends(first)[0]] = true;
    loop {
        let mut grown = false;
        for (joint, at) in pose {
            let [a, b] = ends(*joint);
            if placed[a] == placed[b] {
                continue;
            }
            let [near, far] = &geometry.sides[*joint];
            let across = near.compose(at).compose(&far.inverse());
            if placed[a] {
                links[b] = links[a].compose(&across);
            } else {
                links[a] = links[b].compose(&across.inverse());
            }
            (placed[a], placed[b], grown) = (true, true, true);
        }
        if !grown {
            break;
        }
    }
    for &joint in &task.part.joints {
        if pose.iter().any(|(named, _)| *named == joint) {
            continue;
        }
        if !ends(joint).iter().all(|&link| placed[link]) {
            return false;
        }
        let between = relative(&links, &joints[joint], &geometry.sides[joint]);
        states[joint] = geometry.displacements[joint].fit(&between);
    }
    true
}
