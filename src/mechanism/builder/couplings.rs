//! Couplings: from names to linear equations between joint variables.

use super::checks::{check_finite, check_one_freedom};
use super::names::Names;
use super::placements::placed_by;
use crate::mechanism::{
    Coupling, CouplingOrigin, CouplingTerm, Entity, Joint, JointId, JointKind, Link, LinkId,
    MechanismError, Placement,
};
use crate::number::Number;
use std::collections::{BTreeMap, BTreeSet};

/// A coupling as its maker describes it.
#[derive(Clone, Debug)]
pub(super) struct CouplingSpec {
    pub(super) name: String,
    pub(super) relation: Relation,
}

/// What a coupling relates.
#[derive(Clone, Debug)]
pub(super) enum Relation {
    /// Rates of two links.
    Ratio {
        predecessor: String,
        successor: String,
        ratio: Number,
    },
    /// Variables of two joints.
    Mimic {
        follower: String,
        leader: String,
        multiplier: Number,
        offset: Number,
    },
}

/// The tree in which couplings are resolved.
pub(super) struct Resolver<'a> {
    links: &'a [Link],
    joints: &'a [Joint],
    /// Number of links between a link and the root, by link index.
    depth: Vec<usize>,
}

impl<'a> Resolver<'a> {
    /// `order` is the placement order of the links.
    pub(super) fn new(links: &'a [Link], joints: &'a [Joint], order: &[LinkId]) -> Self {
        let mut depth = vec![0; links.len()];
        for &link in order {
            if let Some(parent) = placed_by(&links[link.0], joints) {
                depth[link.0] = depth[parent.0] + 1;
            }
        }
        Self {
            links,
            joints,
            depth,
        }
    }

    /// Resolves all couplings, in their order.
    pub(super) fn resolve(
        &self,
        specs: Vec<CouplingSpec>,
        names: &mut Names,
    ) -> Result<Vec<Coupling>, MechanismError> {
        let mut couplings = Vec::with_capacity(specs.len());
        for CouplingSpec { name, relation } in specs {
            let entity = match &relation {
                Relation::Ratio { .. } => Entity::Coupling(name.clone()),
                Relation::Mimic { follower, .. } => Entity::Joint(follower.clone()),
            };
            names.add_coupling(&name, &entity)?;
            couplings.push(match relation {
                Relation::Ratio {
                    predecessor,
                    successor,
                    ratio,
                } => {
                    check_finite(&entity, "ratio", &ratio)?;
                    let predecessor = names.link(&entity, &predecessor)?;
                    let successor = names.link(&entity, &successor)?;
                    Coupling {
                        name,
                        terms: self.ratio_terms(&entity, predecessor, successor, &ratio)?,
                        offset: Number::zero(),
                        origin: CouplingOrigin::Ratio {
                            predecessor,
                            successor,
                            ratio,
                        },
                    }
                }
                Relation::Mimic {
                    follower,
                    leader,
                    multiplier,
                    offset,
                } => {
                    check_finite(&entity, "multiplier", &multiplier)?;
                    check_finite(&entity, "offset", &offset)?;
                    let follower = self.mimic_joint(&entity, &follower, names)?;
                    let leader = self.mimic_joint(&entity, &leader, names)?;
                    if follower == leader {
                        return Err(MechanismError::new(entity, "the joint mimics itself"));
                    }
                    Coupling {
                        name,
                        terms: mimic_terms(follower, leader, &multiplier),
                        offset: offset.clone(),
                        origin: CouplingOrigin::Mimic {
                            follower,
                            leader,
                            multiplier,
                            offset,
                        },
                    }
                }
            });
        }
        self.check_mimic_circles(&couplings)?;
        Ok(couplings)
    }

    fn mimic_joint(
        &self,
        entity: &Entity,
        name: &str,
        names: &Names,
    ) -> Result<JointId, MechanismError> {
        let id = names.joint(entity, name, || {
            format!("mimic names joint `{name}`, which does not exist")
        })?;
        check_one_freedom(entity, &self.joints[id.0]).map(|()| id)
    }

    /// `Σ(ancestor → successor) − ratio Σ(ancestor → predecessor) = 0` along the file's tree, from the nearest common
    /// ancestor of the two links.
    fn ratio_terms(
        &self,
        entity: &Entity,
        predecessor: LinkId,
        successor: LinkId,
        ratio: &Number,
    ) -> Result<Vec<CouplingTerm>, MechanismError> {
        let [predecessor_path, successor_path] = self.paths_to_ancestor([predecessor, successor]);
        let mut terms = Vec::new();
        for (path, factor) in [(successor_path, Number::one()), (predecessor_path, -ratio)] {
            for link in path {
                match &self.links[link.0].placement {
                    Placement::World => {}
                    Placement::Joint(id) => {
                        let joint = &self.joints[id.0];
                        if joint.kind == JointKind::Fixed {
                            continue;
                        }
                        check_one_freedom(entity, joint)?;
                        if !factor.is_zero() {
                            terms.push(CouplingTerm {
                                joint: *id,
                                factor: factor.clone(),
                            });
                        }
                    }
                    Placement::Floating { name, .. } => {
                        return Err(MechanismError::new(
                            entity.clone(),
                            format!(
                                "its path through the tree crosses floating joint `{name}`, which has no rate"
                            ),
                        ));
                    }
                }
            }
        }
        if terms.is_empty() {
            return Err(MechanismError::new(
                entity.clone(),
                format!(
                    "no joint moves between `{}` and `{}`, so their rates cannot be coupled",
                    self.links[predecessor.0].name, self.links[successor.0].name
                ),
            ));
        }
        Ok(terms)
    }

    /// The links from each of two links up to, not including, their nearest common ancestor. Costs what it returns.
    fn paths_to_ancestor(&self, mut ends: [LinkId; 2]) -> [Vec<LinkId>; 2] {
        let mut paths = [Vec::new(), Vec::new()];
        while ends[0] != ends[1] {
            let deeper = usize::from(self.depth[ends[1].0] > self.depth[ends[0].0]);
            let link = ends[deeper];
            paths[deeper].push(link);
            match placed_by(&self.links[link.0], self.joints) {
                Some(parent) => ends[deeper] = parent,
                // There is one root, so the walks meet there at the latest.
                None => break,
            }
        }
        paths
    }

    /// A joint that follows itself through others would be told twice what it does.
    fn check_mimic_circles(&self, couplings: &[Coupling]) -> Result<(), MechanismError> {
        let leaders: BTreeMap<JointId, JointId> = couplings
            .iter()
            .filter_map(|coupling| match coupling.origin {
                CouplingOrigin::Mimic {
                    follower, leader, ..
                } => Some((follower, leader)),
                CouplingOrigin::Ratio { .. } => None,
            })
            .collect();
        let mut settled: BTreeSet<JointId> = BTreeSet::new();
        for &start in leaders.keys() {
            let mut walk = Vec::new();
            let mut joint = start;
            while let Some(&leader) = leaders.get(&joint) {
                if !settled.insert(joint) {
                    break;
                }
                walk.push(joint);
                joint = leader;
            }
            // A walk that ends on itself has found a circle; the joints before it only lead there.
            if let Some(first) = walk.iter().position(|visited| *visited == joint) {
                let names: Vec<&str> = walk[first..]
                    .iter()
                    .map(|id| self.joints[id.0].name.as_str())
                    .collect();
                return Err(MechanismError::new(
                    Entity::Joint(self.joints[joint.0].name.clone()),
                    format!("mimic runs in a circle: {}", names.join(" -> ")),
                ));
            }
        }
        Ok(())
    }
}

/// `follower − multiplier × leader`.
fn mimic_terms(follower: JointId, leader: JointId, multiplier: &Number) -> Vec<CouplingTerm> {
    let mut terms = vec![CouplingTerm {
        joint: follower,
        factor: Number::one(),
    }];
    if !multiplier.is_zero() {
        terms.push(CouplingTerm {
            joint: leader,
            factor: -multiplier,
        });
    }
    terms
}
