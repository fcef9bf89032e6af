//! Which names there are, and what they stand for.

use super::did_you_mean::did_you_mean;
use crate::mechanism::{Entity, JointId, Link, LinkId, MechanismError};
use std::collections::{BTreeMap, BTreeSet};

/// The names of links, and those of joints, loops and couplings, which share one set.
#[derive(Debug)]
pub(super) struct Names {
    pub(super) links: BTreeMap<String, LinkId>,
    pub(super) joints: BTreeMap<String, JointId>,
    /// Of joints, floating joints and couplings.
    taken: BTreeSet<String>,
}

impl Names {
    /// The names of the links, each once.
    pub(super) fn of_links(links: &[Link]) -> Result<Self, MechanismError> {
        let mut by_name = BTreeMap::new();
        for (index, link) in links.iter().enumerate() {
            let problem = if link.name.is_empty() {
                "a link needs a name"
            } else if by_name.insert(link.name.clone(), LinkId(index)).is_some() {
                "two links have this name"
            } else {
                continue;
            };
            return Err(MechanismError::new(
                Entity::Link(link.name.clone()),
                problem,
            ));
        }
        Ok(Self {
            links: by_name,
            joints: BTreeMap::new(),
            taken: BTreeSet::new(),
        })
    }

    /// Takes the name of a joint.
    pub(super) fn add_joint(&mut self, name: &str, id: JointId) -> Result<(), MechanismError> {
        self.add_floating(name)?;
        self.joints.insert(name.to_owned(), id);
        Ok(())
    }

    /// Takes the name of a floating joint, which places a link but is no joint to refer to.
    pub(super) fn add_floating(&mut self, name: &str) -> Result<(), MechanismError> {
        let entity = || Entity::Joint(name.to_owned());
        self.add(name, entity, "a joint needs a name", || {
            "two joints have this name".to_owned()
        })
    }

    /// Takes the name of a coupling; a fault is about `entity`, since a `mimic` is named by its joint.
    pub(super) fn add_coupling(
        &mut self,
        name: &str,
        entity: &Entity,
    ) -> Result<(), MechanismError> {
        let entity = || entity.clone();
        self.add(name, entity, "a coupling needs a name", || {
            format!("the name `{name}` is taken already")
        })
    }

    fn add(
        &mut self,
        name: &str,
        entity: impl Fn() -> Entity,
        nameless: &str,
        taken: impl Fn() -> String,
    ) -> Result<(), MechanismError> {
        if name.is_empty() {
            return Err(MechanismError::new(entity(), nameless));
        }
        if self.taken.insert(name.to_owned()) {
            return Ok(());
        }
        Err(MechanismError::new(entity(), taken())
            .help("joints, loops and couplings share one set of names; rename one of them"))
    }

    /// The link that `entity` refers to.
    pub(super) fn link(&self, entity: &Entity, name: &str) -> Result<LinkId, MechanismError> {
        self.links.get(name).copied().ok_or_else(|| {
            MechanismError::new(entity.clone(), format!("there is no link named `{name}`"))
                .help(did_you_mean(name, self.links.keys()))
        })
    }

    /// The joint that `entity` refers to; `problem` says how, where there is none.
    pub(super) fn joint(
        &self,
        entity: &Entity,
        name: &str,
        problem: impl FnOnce() -> String,
    ) -> Result<JointId, MechanismError> {
        self.joints.get(name).copied().ok_or_else(|| {
            MechanismError::new(entity.clone(), problem())
                .help(did_you_mean(name, self.joints.keys()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{error_of, fault, help, hinge, hinges, links};
    use crate::mechanism::{Entity, Frame};
    use kutzbach_math::number::Number;

    const SHARED: &str = "joints, loops and couplings share one set of names; rename one of them";

    #[test]
    fn a_link_needs_a_name_of_its_own() {
        assert_eq!(fault(links(&["a", ""])), "link ``: a link needs a name");
        assert_eq!(
            fault(links(&["a", "b", "a"])),
            "link `a`: two links have this name"
        );
    }

    #[test]
    fn a_joint_needs_a_name_of_its_own() {
        let mut twice = hinges();
        twice.joint(hinge("ab", "a", "c"));
        assert_eq!(
            fault(twice.clone()),
            "joint `ab`: two joints have this name"
        );
        assert_eq!(help(twice), SHARED);

        let mut nameless = hinges();
        nameless.joint(hinge("", "a", "c"));
        assert_eq!(fault(nameless), "joint ``: a joint needs a name");
    }

    #[test]
    fn floating_joints_share_the_names_of_joints() {
        let mut builder = hinges();
        builder.link("d");
        let nameless = {
            let mut builder = builder.clone();
            builder.floating("", "a", "d", Frame::identity());
            builder
        };
        assert_eq!(fault(nameless), "joint ``: a joint needs a name");
        builder.floating("bc", "a", "d", Frame::identity());
        assert_eq!(fault(builder), "joint `bc`: two joints have this name");
    }

    #[test]
    fn couplings_share_the_names_of_joints() {
        for name in ["ab", "placed", "ab.mimic"] {
            let mut builder = hinges();
            builder.link("d");
            builder.floating("placed", "a", "d", Frame::identity());
            builder.mimic("ab", "bc", Number::one(), Number::zero());
            builder.coupling(name, "b", "c", Number::one());
            let error = error_of(builder);
            assert_eq!(error.entity, Entity::Coupling(name.to_owned()));
            assert_eq!(error.problem, format!("the name `{name}` is taken already"));
            assert_eq!(error.help.as_deref(), Some(SHARED));
        }
        let mut nameless = hinges();
        nameless.coupling("", "b", "c", Number::one());
        assert_eq!(fault(nameless), "coupling ``: a coupling needs a name");
    }

    #[test]
    fn a_second_mimic_of_a_joint_is_about_that_joint() {
        let mut builder = hinges();
        builder.mimic("ab", "bc", Number::one(), Number::zero());
        builder.mimic("ab", "bc", Number::integer(2), Number::zero());
        assert_eq!(
            fault(builder),
            "joint `ab`: the name `ab.mimic` is taken already"
        );
    }

    #[test]
    fn an_unknown_link_is_told_with_the_nearest_known_one() {
        let mut builder = links(&["ground", "crank"]);
        builder.joint(hinge("A", "ground", "crnk"));
        assert_eq!(
            fault(builder.clone()),
            "joint `A`: there is no link named `crnk`"
        );
        assert_eq!(help(builder), "did you mean `crank`?");

        let mut builder = links(&["ground", "crank"]);
        builder.joint(hinge("A", "earth", "crank"));
        assert_eq!(
            help(builder),
            "names are compared letter by letter, capitals included"
        );
    }

    #[test]
    fn links_may_be_named_before_they_are_added_and_like_joints() {
        let mut builder = links(&["a"]);
        builder.joint(hinge("b", "a", "b"));
        builder.link("b");
        let mechanism = builder.build();
        let found = mechanism.map(|m| (m.link_named("b").is_some(), m.joint_named("b").is_some()));
        assert_eq!(found, Ok((true, true)));
    }
}
