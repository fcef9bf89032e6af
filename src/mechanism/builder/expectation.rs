//! What is expected of a mechanism must speak of joints and links that it has.

use super::names::Names;
use crate::mechanism::{Entity, Expectation, Joint, MechanismError};

/// The words and names of an expectation; whether it comes true is for the analysis to say.
pub(super) fn check_expectation(
    expectation: &Expectation,
    joints: &[Joint],
    names: &Names,
) -> Result<(), MechanismError> {
    let fail = |problem: String| Err(MechanismError::new(Entity::Expectation, problem));
    if let Some(pose) = &expectation.pose
        && !["regular", "singular"].contains(&pose.as_str())
    {
        return fail(format!("pose is `regular` or `singular`, not `{pose}`"));
    }
    for locked in expectation.locked.iter().flatten() {
        let known = locked == "all"
            || names.joints.contains_key(locked)
            || names_a_part(locked, joints, names);
        if !known {
            return fail(format!(
                "locked names `{locked}`, which is neither a joint nor a part of one"
            ));
        }
    }
    for idle in expectation.idle.iter().flatten() {
        if !names.links.contains_key(idle) {
            return fail(format!("idle names `{idle}`, which is not a link"));
        }
    }
    Ok(())
}

/// Whether this is `joint.rot`, which holds for one rotation of a joint and for several, or one of several as in
/// `joint.rot2`. The joint's own name may have dots, the part has none.
fn names_a_part(text: &str, joints: &[Joint], names: &Names) -> bool {
    let Some((joint, part)) = text.rsplit_once('.') else {
        return false;
    };
    let Some(id) = names.joints.get(joint) else {
        return false;
    };
    let joint = &joints[id.0];
    joint
        .kind
        .freedoms()
        .iter()
        .enumerate()
        .any(|(index, freedom)| freedom.suffix() == part || joint.freedom_name(index) == text)
}
