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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::{chain, fault, help, hinge, hinges, links, number};
    use super::super::{JointBuilder, MechanismBuilder};
    use super::*;
    use crate::mechanism::{Frame, Mechanism};

    /// The equation of the first coupling by joint names.
    fn terms(mechanism: &Mechanism) -> Vec<(&str, f64)> {
        mechanism.couplings()[0]
            .terms
            .iter()
            .map(|term| {
                let joint = mechanism.joint(term.joint);
                (joint.name.as_str(), term.factor.value())
            })
            .collect()
    }

    fn ratio(mut builder: MechanismBuilder, ends: [&str; 2], ratio: &str) -> MechanismBuilder {
        builder.coupling("gears", ends[0], ends[1], number(ratio));
        builder
    }

    /// ```text
    /// a --ab-- b --bc-- c --cd(fixed)-- d
    ///          b --be-- e
    /// ```
    fn fork() -> MechanismBuilder {
        let mut builder = hinges();
        builder.link("d").link("e");
        builder.joint(JointBuilder::tree("cd", JointKind::Fixed, "c", "d"));
        builder.joint(JointBuilder::tree("be", JointKind::Prismatic, "b", "e"));
        builder
    }

    #[test]
    fn a_ratio_is_summed_from_the_nearest_common_ancestor() {
        for (ends, expected) in [
            // The arm's own joint `ab` moves both and does not enter.
            (["d", "e"], vec![("be", 1.0), ("bc", -0.5)]),
            (["e", "d"], vec![("bc", 1.0), ("be", -0.5)]),
            (["a", "d"], vec![("bc", 1.0), ("ab", 1.0)]),
            (["d", "a"], vec![("bc", -0.5), ("ab", -0.5)]),
            (["e", "b"], vec![("be", -0.5)]),
        ] {
            let mechanism = ratio(fork(), ends, "0.5").build().unwrap();
            assert_eq!(terms(&mechanism), expected, "{ends:?}");
            assert!(mechanism.couplings()[0].offset.is_zero());
        }
    }

    #[test]
    fn a_ratio_of_zero_holds_the_driven_link_alone() {
        let mechanism = ratio(fork(), ["d", "e"], "0").build().unwrap();
        assert_eq!(terms(&mechanism), [("be", 1.0)]);
    }

    #[test]
    fn a_ratio_needs_something_that_moves() {
        for ends in [["c", "d"], ["b", "b"]] {
            assert_eq!(
                fault(ratio(fork(), ends, "2")),
                format!(
                    "coupling `gears`: no joint moves between `{}` and `{}`, so their rates cannot be coupled",
                    ends[0], ends[1]
                )
            );
        }
        assert!(fault(ratio(fork(), ["d", "a"], "0")).contains("no joint moves"));
    }

    #[test]
    fn a_ratio_cannot_cross_a_joint_without_one_rate() {
        let mut builder = fork();
        builder.link("f");
        builder.floating("free", "e", "f", Frame::identity());
        assert_eq!(
            fault(ratio(builder, ["a", "f"], "1")),
            "coupling `gears`: its path through the tree crosses floating joint `free`, which has no rate"
        );
        let ball = chain(JointKind::Revolute, JointKind::Spherical);
        assert_eq!(
            fault(ratio(ball.clone(), ["a", "c"], "1")),
            "coupling `gears`: joint `bc` is spherical with 3 freedoms; only a joint of one freedom has a single rate"
        );
        assert!(ratio(ball, ["a", "b"], "1").build().is_ok());
    }

    #[test]
    fn a_ratio_speaks_of_links_and_is_a_number() {
        assert_eq!(
            fault(ratio(hinges(), ["a", "ab"], "1")),
            "coupling `gears`: there is no link named `ab`"
        );
        assert_eq!(help(ratio(hinges(), ["a", "ab"], "1")), "did you mean `a`?");
        assert!(fault(ratio(hinges(), ["a", "b"], "1e101")).contains("ratio is 1e101"));
    }

    #[test]
    fn a_mimic_is_one_equation_named_after_its_follower() {
        let mut builder = hinges();
        builder.mimic("bc", "ab", number("-2"), number("0.25"));
        let mechanism = builder.build().unwrap();
        assert_eq!(mechanism.couplings()[0].name, "bc.mimic");
        assert_eq!(mechanism.couplings()[0].offset, number("0.25"));
        assert_eq!(terms(&mechanism), [("bc", 1.0), ("ab", 2.0)]);

        let mut builder = hinges();
        builder.mimic("bc", "ab", number("0"), number("0.25"));
        assert_eq!(terms(&builder.build().unwrap()), [("bc", 1.0)]);
    }

    #[test]
    fn what_cannot_be_mimicked() {
        let mimic = |mut builder: MechanismBuilder, follower: &str, leader: &str| {
            builder.mimic(follower, leader, Number::one(), Number::zero());
            builder
        };
        let ball = || chain(JointKind::Revolute, JointKind::Spherical);
        let told = "joint `bc` is spherical with 3 freedoms; only a joint of one freedom has a single rate";
        assert_eq!(
            fault(mimic(ball(), "ab", "bc")),
            format!("joint `ab`: {told}")
        );
        assert_eq!(
            fault(mimic(ball(), "bc", "ab")),
            format!("joint `bc`: {told}")
        );
        let fixed = chain(JointKind::Revolute, JointKind::Fixed);
        assert!(fault(mimic(fixed, "ab", "bc")).contains("fixed with 0 freedoms"));
        assert_eq!(
            fault(mimic(hinges(), "ab", "cb")),
            "joint `ab`: mimic names joint `cb`, which does not exist"
        );
        assert_eq!(
            help(mimic(hinges(), "ab", "cb")),
            "did you mean `ab`?",
            "one letter off `ab`, two off `bc`"
        );
        assert_eq!(
            fault(mimic(hinges(), "ab", "ab")),
            "joint `ab`: the joint mimics itself"
        );
        for (multiplier, offset, what) in [("1e101", "0", "multiplier"), ("1", "1e101", "offset")] {
            let mut builder = hinges();
            builder.mimic("ab", "bc", number(multiplier), number(offset));
            assert!(fault(builder).contains(&format!("{what} is 1e101")));
        }
    }

    /// Hinges `j0`, `j1`, ... from one ground, each following another by index.
    fn followers(leaders: &[usize]) -> MechanismBuilder {
        let mut builder = links(&["ground"]);
        for (index, leader) in leaders.iter().enumerate() {
            let (joint, link) = (format!("j{index}"), format!("l{index}"));
            builder.link(&link);
            builder.joint(hinge(&joint, "ground", &link));
            if *leader != index {
                builder.mimic(&joint, &format!("j{leader}"), Number::one(), Number::zero());
            }
        }
        builder
    }

    #[test]
    fn mimics_may_form_trees_but_no_circle() {
        // j3 -> j2 -> j0 <- j1: whoever leads in the end is free.
        assert!(followers(&[0, 0, 0, 2]).build().is_ok());
        assert_eq!(
            fault(followers(&[1, 0])),
            "joint `j0`: mimic runs in a circle: j0 -> j1"
        );
        assert_eq!(
            fault(followers(&[0, 2, 3, 1, 0])),
            "joint `j1`: mimic runs in a circle: j1 -> j2 -> j3"
        );
        // j0 and j1 lead into the circle but are not on it.
        assert_eq!(
            fault(followers(&[1, 2, 3, 2])),
            "joint `j2`: mimic runs in a circle: j2 -> j3"
        );
    }
}
