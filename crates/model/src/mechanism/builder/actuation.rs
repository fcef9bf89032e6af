//! Which joints have a motor.

use super::names::Names;
use crate::mechanism::{Entity, Joint, JointId, MechanismError};
use std::collections::BTreeSet;

/// The actuated joints in file order, each once.
pub(super) fn resolve_actuated(
    named: Vec<String>,
    joints: &[Joint],
    names: &Names,
) -> Result<Vec<JointId>, MechanismError> {
    let mut actuated = BTreeSet::new();
    for name in named {
        let entity = Entity::Mechanism;
        let id = names.joint(&entity, &name, || {
            format!("a motor drives joint `{name}`, which does not exist")
        })?;
        if joints[id.0].freedom() == 0 {
            let problem = "a motor drives this joint, which has no freedom";
            return Err(MechanismError::new(Entity::Joint(name), problem));
        }
        actuated.insert(id);
    }
    Ok(actuated.into_iter().collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::{fault, help, hinges};
    use super::super::{JointBuilder, MechanismBuilder};
    use crate::mechanism::{JointId, JointKind};

    fn driven(names: &[&str]) -> MechanismBuilder {
        let mut builder = hinges();
        for name in names {
            builder.actuate(name);
        }
        builder
    }

    #[test]
    fn actuated_joints_are_told_once_and_in_file_order() {
        let mechanism = driven(&["bc", "ab", "bc"]).build().unwrap();
        assert_eq!(mechanism.actuated(), [JointId(0), JointId(1)]);
        assert!(driven(&[]).build().unwrap().actuated().is_empty());
    }

    #[test]
    fn a_motor_needs_a_joint_that_moves() {
        assert_eq!(
            fault(driven(&["bd"])),
            "the mechanism: a motor drives joint `bd`, which does not exist"
        );
        assert_eq!(help(driven(&["bd"])), "did you mean `bc`?");
        let mut welded = driven(&["weld"]);
        welded.link("d");
        welded.joint(JointBuilder::tree("weld", JointKind::Fixed, "c", "d"));
        assert_eq!(
            fault(welded),
            "joint `weld`: a motor drives this joint, which has no freedom"
        );
    }
}
