//! A mechanism with some joints held.

use super::exact_pose::ExactPose;
use super::joint::Joint;
use super::kind::JointKind;
use super::model::{JointId, Mechanism};
use kutzbach_math::number::Number;
use thiserror::Error;

/// Why a joint cannot be held.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum HoldError {
    /// Only joints that turn or slide, and others where they are drawn.
    #[error("joint `{joint}` is {kind}; only revolute and prismatic joints can be held at a value")]
    Kind {
        /// The joint.
        joint: String,
        /// Its kind.
        kind: &'static str,
    },
    /// The frame at the value cannot be written.
    #[error("joint `{joint}`: its frame at this value cannot be written")]
    Value {
        /// The joint.
        joint: String,
    },
}

impl Mechanism {
    /// The mechanism with joints that are held at values (rad, m): fixed joints in their places. What is drawn moves with the
    /// tree's joints.
    ///
    /// # Errors
    /// [`HoldError`] for other joints than revolute and prismatic ones, and for frames that cannot be written.
    pub fn with_joints_held(&self, held: &[(JointId, Number)]) -> Result<Self, HoldError> {
        let mut result = self.clone();
        for (id, value) in held {
            hold(&mut result.joints[id.0], value)?;
        }
        Ok(result)
    }

    /// The mechanism with joints of any kind fixed as they are drawn: where all their variables are zero. A distance joint, whose
    /// two points are apart, would be drawn together and is left as it is.
    #[must_use]
    pub fn with_joints_fixed_as_drawn(&self, fixed: &[JointId]) -> Self {
        let mut result = self.clone();
        for id in fixed {
            let joint = &mut result.joints[id.0];
            if joint.kind != JointKind::Distance {
                joint.kind = JointKind::Fixed;
                joint.limit = None;
            }
        }
        result
    }
}

fn hold(joint: &mut Joint, value: &Number) -> Result<(), HoldError> {
    let failed = |_| HoldError::Value {
        joint: joint.name.clone(),
    };
    let displacement = match joint.kind {
        JointKind::Revolute | JointKind::Prismatic if value.is_zero() => None,
        JointKind::Revolute | JointKind::Prismatic => {
            let axis = &joint.axis.0;
            let square = axis.iter().fold(Number::zero(), |sum, x| &sum + &(x * x));
            let length = square.sqrt().map_err(failed)?;
            let mut unit = axis.clone();
            for x in &mut unit {
                *x = x.checked_div(&length).map_err(failed)?;
            }
            Some(match joint.kind {
                JointKind::Revolute => ExactPose::turn(&unit, value),
                _ => ExactPose {
                    translation: unit.map(|x| &x * value),
                    ..ExactPose::identity()
                },
            })
        }
        other => {
            return Err(HoldError::Kind {
                joint: joint.name.clone(),
                kind: other.word(),
            });
        }
    };
    if let Some(displacement) = displacement {
        let pose = ExactPose::of(&joint.predecessor.frame).then(&displacement);
        joint.predecessor.frame = pose.frame().map_err(failed)?;
    }
    joint.kind = JointKind::Fixed;
    joint.limit = None;
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::{JointBuilder, MechanismBuilder};
    use super::*;

    #[test]
    fn joints_of_any_kind_are_fixed_where_they_are_drawn() {
        let mut builder = MechanismBuilder::new("arm");
        builder.link("ground").link("arm").link("rod").link("end");
        let reach = JointBuilder::tree("reach", JointKind::Distance, "arm", "rod");
        builder
            .joint(JointBuilder::tree(
                "ball",
                JointKind::Spherical,
                "ground",
                "arm",
            ))
            .joint(reach.distance(Number::integer(2)))
            .joint(JointBuilder::tree("pin", JointKind::Revolute, "rod", "end"));
        let mechanism = builder.build().unwrap();
        let named = |name| mechanism.joint_named(name).unwrap();
        let fixed = mechanism.with_joints_fixed_as_drawn(&[named("ball"), named("reach")]);
        let kinds: Vec<JointKind> = fixed.joints().iter().map(|joint| joint.kind).collect();
        let expected = [JointKind::Fixed, JointKind::Distance, JointKind::Revolute];
        assert_eq!(kinds, expected);
    }
}
