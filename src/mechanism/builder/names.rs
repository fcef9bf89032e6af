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
