//! The scene and its drives: from joint names to joints of one rate.

use super::checks::{check_all_finite, check_finite, check_one_freedom};
use super::names::Names;
use crate::mechanism::{Drive, Entity, Joint, MechanismError, Scene};
use crate::number::Number;

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
