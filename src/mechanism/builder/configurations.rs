//! Named poses: from joint names to joints, one value per freedom.

use super::checks::check_all_finite;
use super::names::Names;
use crate::mechanism::{Configuration, Entity, Joint, MechanismError};
use crate::number::Number;
use std::collections::BTreeSet;

/// A configuration as its maker describes it.
#[derive(Clone, Debug)]
pub(super) struct ConfigurationSpec {
    pub(super) name: String,
    pub(super) positions: Vec<(String, Vec<Number>)>,
}

/// Resolves all configurations, in their order.
pub(super) fn resolve_configurations(
    specs: Vec<ConfigurationSpec>,
    joints: &[Joint],
    names: &Names,
) -> Result<Vec<Configuration>, MechanismError> {
    let mut used = BTreeSet::new();
    specs
        .into_iter()
        .map(|spec| {
            let entity = Entity::Configuration(spec.name.clone());
            if !used.insert(spec.name.clone()) {
                return Err(MechanismError::new(
                    entity,
                    "two configurations have this name",
                ));
            }
            resolve(spec, &entity, joints, names)
        })
        .collect()
}

fn resolve(
    spec: ConfigurationSpec,
    entity: &Entity,
    joints: &[Joint],
    names: &Names,
) -> Result<Configuration, MechanismError> {
    let fault = |problem: String| Err(MechanismError::new(entity.clone(), problem));
    let mut placed = BTreeSet::new();
    let mut positions = Vec::with_capacity(spec.positions.len());
    for (joint, values) in spec.positions {
        let id = names.joint(entity, &joint, || {
            format!("there is no joint named `{joint}`")
        })?;
        if !placed.insert(id) {
            return fault(format!("joint `{joint}` has two positions"));
        }
        let freedom = joints[id.0].freedom();
        if values.len() != freedom {
            return fault(format!(
                "joint `{joint}` has {freedom} freedoms but {} values",
                values.len()
            ));
        }
        check_all_finite(entity, "position", &values)?;
        positions.push((id, values));
    }
    Ok(Configuration {
        name: spec.name,
        positions,
    })
}
