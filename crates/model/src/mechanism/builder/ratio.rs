//! A ratio of two links' rates as an equation between joint variables.

use super::checks::check_one_freedom;
use super::placements::placed_by;
use crate::mechanism::{
    CouplingTerm, Entity, Joint, JointKind, Link, LinkId, MechanismError, Placement,
};
use kutzbach_math::number::Number;

/// The tree of home poses, to walk up in.
pub(super) struct LinkTree<'a> {
    links: &'a [Link],
    joints: &'a [Joint],
    /// Number of links between a link and the root, by link index.
    depth: Vec<usize>,
}

impl<'a> LinkTree<'a> {
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

    /// `Σ(ancestor → successor) − ratio Σ(ancestor → predecessor) = 0` along the file's tree, from the nearest common
    /// ancestor of the two links.
    pub(super) fn ratio_terms(
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
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::{chain, fault, help, hinges, number, terms};
    use super::super::{JointBuilder, MechanismBuilder};
    use super::*;
    use crate::mechanism::Frame;

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
            "coupling `gears`: joint `bc` is spherical with 3 degrees of freedom; only a joint with one has a single rate"
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
}
