//! The scene and its drives: from joint names to joints of one rate.

use super::checks::{check_all_finite, check_finite, check_one_freedom, check_share};
use super::names::Names;
use crate::mechanism::{Drive, Entity, Joint, MechanismError, Scene};
use kutzbach_math::number::Number;

/// A drive as its maker describes it.
#[derive(Clone, Debug)]
pub(super) struct DriveSpec {
    pub(super) joint: String,
    pub(super) velocity: Number,
    pub(super) torque: Option<Number>,
}

/// The scene with its drives; drives alone make a scene without any other effect.
pub(super) fn resolve_scene(
    scene: Option<Scene>,
    drives: Vec<DriveSpec>,
    joints: &[Joint],
    names: &Names,
) -> Result<Option<Scene>, MechanismError> {
    if scene.is_none() && drives.is_empty() {
        return Ok(None);
    }
    let mut scene = scene.unwrap_or_default();
    let entity = Entity::Scene;
    check_all_finite(&entity, "gravity", scene.gravity.iter().flatten())?;
    check_share(&entity, "restitution", scene.restitution.as_ref())?;
    for DriveSpec {
        joint: name,
        velocity,
        torque,
    } in drives
    {
        let joint = names.joint(&entity, &name, || {
            format!("the drive names joint `{name}`, which does not exist")
        })?;
        check_one_freedom(&entity, &joints[joint.0])?;
        check_finite(&entity, "velocity", &velocity)?;
        check_all_finite(&entity, "torque", &torque)?;
        scene.drives.push(Drive {
            joint,
            velocity,
            torque,
        });
    }
    Ok(Some(scene))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::{chain, fault, help, hinges, number};
    use super::*;
    use crate::mechanism::{JointId, JointKind};

    #[test]
    fn drives_are_added_to_the_scene_in_their_order() {
        let mut builder = hinges();
        builder.drive("bc", number("2"), None);
        builder.drive("ab", number("-1"), Some(number("3")));
        let alone = builder.clone().build().unwrap();
        let joints = |scene: &Scene| scene.drives.iter().map(|d| d.joint).collect::<Vec<_>>();
        let scene = alone.scene().unwrap();
        assert_eq!(joints(scene), [JointId(1), JointId(0)]);
        assert_eq!((scene.gravity.clone(), scene.contact), (None, false));

        builder.scene(Scene {
            contact: true,
            ..Scene::default()
        });
        let both = builder.build().unwrap();
        assert!(both.scene().unwrap().contact);
        assert_eq!(joints(both.scene().unwrap()), joints(scene));

        assert!(hinges().build().unwrap().scene().is_none());
    }

    #[test]
    fn what_cannot_be_driven() {
        let driven = |joint: &str, velocity: &str, torque: &str| {
            let mut builder = chain(JointKind::Revolute, JointKind::Cylindrical);
            builder.drive(joint, number(velocity), Some(number(torque)));
            builder
        };
        assert_eq!(
            fault(driven("ax", "1", "1")),
            "the scene: the drive names joint `ax`, which does not exist"
        );
        assert_eq!(help(driven("ax", "1", "1")), "did you mean `ab`?");
        assert_eq!(
            fault(driven("bc", "1", "1")),
            "the scene: joint `bc` is cylindrical with 2 degrees of freedom; only a joint with one has a single rate"
        );
        assert!(fault(driven("ab", "1e101", "1")).contains("velocity is 1e101"));
        assert!(fault(driven("ab", "1", "1e101")).contains("torque is 1e101"));
        let mut heavy = hinges();
        heavy.scene(Scene {
            gravity: Some(["0", "0", "-1e101"].map(number)),
            ..Scene::default()
        });
        assert!(fault(heavy).starts_with("the scene: gravity is -1e101"));
        for (share, said) in [
            (
                "1.5",
                Some("the scene: restitution is 1.5, not from 0 to 1"),
            ),
            ("1", None),
        ] {
            let mut bouncing = hinges();
            bouncing.scene(Scene {
                restitution: Some(number(share)),
                ..Scene::default()
            });
            let built = bouncing.build().map_err(|error| error.to_string());
            assert_eq!(built.err().as_deref(), said);
        }
    }
}
