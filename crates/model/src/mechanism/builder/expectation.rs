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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::{chain, fault};
    use super::*;
    use crate::mechanism::JointKind;

    fn locked(name: &str) -> Expectation {
        Expectation {
            locked: Some(vec![name.to_owned()]),
            ..Expectation::default()
        }
    }

    #[test]
    fn names_are_joints_parts_and_links() {
        // A ball and a sleeve whose name has a dot.
        let sample = || {
            let mut builder = chain(JointKind::Spherical, JointKind::Revolute);
            builder.link("d");
            let sleeve = super::super::JointBuilder::tree("c.d", JointKind::Cylindrical, "c", "d");
            builder.joint(sleeve);
            builder
        };
        for name in [
            "all",
            "ab",
            "ab.rot",
            "ab.rot1",
            "ab.rot3",
            "bc",
            "bc.rot",
            "c.d",
            "c.d.rot",
            "c.d.trans",
        ] {
            let mut builder = sample();
            builder.expect(locked(name));
            assert!(builder.build().is_ok(), "{name}");
        }
        for name in [
            "",
            "none",
            "ab.rot0",
            "ab.rot4",
            "ab.trans",
            "bc.rot1",
            "c",
            "c.d.screw",
            ".rot",
        ] {
            let mut builder = sample();
            builder.expect(locked(name));
            assert_eq!(
                fault(builder),
                format!(
                    "the expectation: locked names `{name}`, which is neither a joint nor a part of one"
                )
            );
        }
        for (idle, known) in [("a", true), ("ab", false)] {
            let mut builder = sample();
            builder.expect(Expectation {
                idle: Some(vec![idle.to_owned()]),
                ..Expectation::default()
            });
            match builder.build() {
                Ok(_) => assert!(known, "{idle}"),
                Err(error) => assert_eq!(
                    (error.to_string(), known),
                    (
                        format!("the expectation: idle names `{idle}`, which is not a link"),
                        false
                    )
                ),
            }
        }
    }

    #[test]
    fn a_pose_is_one_of_two_words() {
        for (pose, known) in [("regular", true), ("singular", true), ("Regular", false)] {
            let mut builder = chain(JointKind::Revolute, JointKind::Revolute);
            builder.expect(Expectation {
                pose: Some(pose.to_owned()),
                ..Expectation::default()
            });
            if known {
                let mechanism = builder.build().unwrap();
                assert_eq!(mechanism.expectation().unwrap().pose.as_deref(), Some(pose));
            } else {
                assert_eq!(
                    fault(builder),
                    "the expectation: pose is `regular` or `singular`, not `Regular`"
                );
            }
        }
    }
}
