//! A mechanism with a joint of another kind.

use super::frame::Direction;
use super::kind::JointKind;
use super::model::{JointId, Mechanism};

impl Mechanism {
    /// The mechanism with a joint that has become another kind, in the same place; directions that are not given stay. What was said
    /// of the joint's variables is dropped where it has no meaning any more: limits and drives where there is not one freedom, its
    /// values in configurations, and what was expected of the mechanism.
    ///
    /// For kinds that contain what the joint was: a hinge that becomes a ball. A joint that couplings speak of has to keep one freedom, a
    /// kind with a lead needs the joint's own.
    #[must_use]
    pub fn with_joint_kind(
        &self,
        id: JointId,
        kind: JointKind,
        axis: Option<Direction>,
        axis2: Option<Direction>,
    ) -> Self {
        let mut result = self.clone();
        let Some(joint) = result.joints.get_mut(id.0) else {
            return result;
        };
        joint.kind = kind;
        joint.axis = axis.unwrap_or_else(|| joint.axis.clone());
        joint.axis2 = axis2.unwrap_or_else(|| joint.axis2.clone());
        joint.lead = joint.lead.take().filter(|_| kind.uses_lead());
        joint.distance = joint
            .distance
            .take()
            .filter(|_| kind == JointKind::Distance);
        let one = kind.freedom() == 1;
        joint.limit = joint.limit.take().filter(|_| one);
        for configuration in &mut result.configurations {
            configuration.positions.retain(|(joint, _)| *joint != id);
            configuration.free.remove(&id);
        }
        if let Some(scene) = &mut result.scene {
            scene.drives.retain(|drive| drive.joint != id || one);
        }
        result
            .actuated
            .retain(|joint| *joint != id || kind.freedom() > 0);
        result.expectation = None;
        result.read_digits()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::{JointBuilder, MechanismBuilder};
    use super::*;

    #[test]
    fn a_hinge_becomes_a_ball() {
        let mut builder = MechanismBuilder::new("bar");
        builder.link("ground").link("bar");
        builder.joint(JointBuilder::tree(
            "pin",
            JointKind::Revolute,
            "ground",
            "bar",
        ));
        let mechanism = builder.build().unwrap();
        let pin = mechanism.joint_named("pin").unwrap();
        let other = mechanism.with_joint_kind(pin, JointKind::Spherical, None, None);
        assert_eq!(mechanism.freedom(), 1);
        assert_eq!(other.freedom(), 3);
    }
}
