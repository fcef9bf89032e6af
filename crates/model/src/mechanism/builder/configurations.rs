//! Named poses: from joint names to joints, one value per freedom.

use super::checks::check_all_finite;
use super::names::Names;
use crate::mechanism::{Configuration, Entity, Joint, MechanismError};
use kutzbach_math::number::Number;
use std::collections::BTreeSet;

/// A configuration as its maker describes it.
#[derive(Clone, Debug)]
pub(super) struct ConfigurationSpec {
    pub(super) name: String,
    /// Values that joints keep.
    pub(super) positions: Vec<(String, Vec<Number>)>,
    /// Values that joints only begin at.
    pub(super) starts: Vec<(String, Vec<Number>)>,
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
    let mut positions = Vec::with_capacity(spec.positions.len() + spec.starts.len());
    let mut free = BTreeSet::new();
    let held = spec.positions.into_iter().map(|position| (position, false));
    let begun = spec.starts.into_iter().map(|position| (position, true));
    for ((joint, values), begins) in held.chain(begun) {
        let id = names.joint(entity, &joint, || {
            format!("there is no joint named `{joint}`")
        })?;
        if !placed.insert(id) {
            return fault(format!("joint `{joint}` has two positions"));
        }
        let freedom = joints[id.0].freedom();
        if values.len() != freedom {
            return fault(format!(
                "joint `{joint}` needs one value for each degree of freedom, {freedom} in all, found {}",
                values.len()
            ));
        }
        check_all_finite(entity, "position", &values)?;
        positions.push((id, values));
        if begins {
            free.insert(id);
        }
    }
    Ok(Configuration {
        name: spec.name,
        positions,
        free,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::MechanismBuilder;
    use super::super::samples::{chain, fault, help, hinges, number};
    use crate::mechanism::{JointId, JointKind};

    fn posed(mut builder: MechanismBuilder, positions: &[(&str, &[&str])]) -> MechanismBuilder {
        let positions = positions
            .iter()
            .map(|(joint, values)| {
                let values = values.iter().map(|text| number(text)).collect();
                ((*joint).to_owned(), values)
            })
            .collect();
        builder.configuration("open", positions);
        builder
    }

    #[test]
    fn a_pose_gives_every_named_joint_one_value_per_freedom() {
        let mixed = || chain(JointKind::Planar, JointKind::Fixed);
        let pose: [(&str, &[&str]); 2] = [("bc", &[]), ("ab", &["1", "2", "3"])];
        let mechanism = posed(mixed(), &pose).build().unwrap();
        let open = mechanism.configuration("open").unwrap();
        assert_eq!(open.positions[0], (JointId(1), vec![]));
        assert_eq!(
            open.positions[1],
            (JointId(0), ["1", "2", "3"].map(number).to_vec())
        );
        assert_eq!(
            fault(posed(mixed(), &[("ab", &["1", "2"])])),
            "configuration `open`: joint `ab` needs one value for each degree of freedom, 3 in all, found 2"
        );
        assert_eq!(
            fault(posed(mixed(), &[("bc", &["1"])])),
            "configuration `open`: joint `bc` needs one value for each degree of freedom, 0 in all, found 1"
        );
    }

    #[test]
    fn what_a_joint_begins_at_it_need_not_keep() {
        let of = |joint: &str| vec![(joint.to_owned(), vec![number("0.5")])];
        let mut builder = hinges();
        builder.configuration_with_starts("open", of("bc"), of("ab"));
        let mechanism = builder.build().unwrap();
        let open = mechanism.configuration("open").unwrap();
        let joints: Vec<JointId> = open.positions.iter().map(|(joint, _)| *joint).collect();
        assert_eq!(joints, [JointId(1), JointId(0)]);
        assert_eq!(open.held().collect::<Vec<_>>(), [JointId(1)]);
        assert!(
            mechanism
                .without_configuration("open")
                .configurations()
                .is_empty()
        );
        let mut twice = hinges();
        twice.configuration_with_starts("open", of("ab"), of("ab"));
        assert_eq!(
            fault(twice),
            "configuration `open`: joint `ab` has two positions"
        );
    }

    #[test]
    fn what_a_pose_cannot_say() {
        let wrong = posed(hinges(), &[("AB", &["1"])]);
        assert_eq!(
            fault(wrong.clone()),
            "configuration `open`: there is no joint named `AB`"
        );
        assert_eq!(
            help(wrong),
            "names are compared letter by letter, capitals included"
        );
        assert_eq!(
            fault(posed(hinges(), &[("ab", &["1"]), ("ab", &["1"])])),
            "configuration `open`: joint `ab` has two positions"
        );
        assert_eq!(
            fault(posed(hinges(), &[("ab", &["1e101"])])),
            "configuration `open`: position is 1e101, beyond the largest number accepted, 1e100"
        );
        assert_eq!(
            fault(posed(posed(hinges(), &[]), &[])),
            "configuration `open`: two configurations have this name"
        );
    }
}
