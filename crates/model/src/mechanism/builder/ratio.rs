//! A ratio of two links' rates as an equation between joint variables.

use super::checks::check_one_freedom;
use super::placements::placed_by;
use crate::mechanism::{
    Assumption, CouplingTerm, Entity, ExactPose, FreedomPart, Joint, JointId, JointKind, Link,
    LinkId, MechanismError, Placement,
};
use kutzbach_math::number::Number;
use kutzbach_math::space::{Rigid, Vector, cross, dot, length, unit};

/// Axes are parallel up to this angle (rad): those of directions to two decimals are off by so much, and no bevel gear has its shafts so
/// near.
const PARALLEL: f64 = 0.01;

fn are_parallel(a: &Vector<f64>, b: &Vector<f64>) -> bool {
    length(&cross(a, b)) <= PARALLEL
}

/// What a link does seen from another one.
#[derive(Clone, Debug, Default)]
struct Run {
    /// The joints on the way, the last one first, with whether their rates count.
    terms: Vec<(JointId, bool)>,
    /// What the last one does; `None` where nothing moves.
    part: Option<FreedomPart>,
    /// Its axis, seen from where the way begins.
    direction: Vector<f64>,
}

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

    /// `Σ(carrier → successor) − ratio Σ(carrier → predecessor) = 0` along the file's tree, from the carrier, or else from the nearest
    /// common link of the two; with what that takes for granted.
    ///
    /// Each sum is the rate about the axis of the last joint before the link, to which joints about opposite axes, and those passed
    /// from their child to their parent, contribute with the other sign. Where both links turn about parallel axes, or slide along
    /// such, both rates count in the same direction, however the axes point: as those of wheels on parallel shafts.
    pub(super) fn ratio_terms(
        &self,
        entity: &Entity,
        ends: [LinkId; 2],
        carrier: Option<LinkId>,
        ratio: &Number,
    ) -> Result<(Vec<CouplingTerm>, Vec<Assumption>), MechanismError> {
        let common = self.common(ends);
        let from = carrier.unwrap_or(common);
        let [predecessor, successor] = ends;
        let driven = self.run(entity, from, successor)?;
        let driving = match ratio.is_zero() {
            true => Run::default(),
            false => self.run(entity, from, predecessor)?,
        };
        if driven.terms.is_empty() && driving.terms.is_empty() {
            return Err(MechanismError::new(
                entity.clone(),
                format!(
                    "no joint moves between `{}` and `{}`, so their rates cannot be coupled",
                    self.name(predecessor),
                    self.name(successor)
                ),
            ));
        }
        for (link, run, needed) in [
            (successor, &driven, true),
            (predecessor, &driving, !ratio.is_zero()),
        ] {
            if needed && run.terms.is_empty() {
                return Err(self.at_rest(entity, ends, link, from));
            }
        }
        let same_kind = driven.part == driving.part;
        let along = dot(&driven.direction, &driving.direction);
        let opposite =
            same_kind && along < 0.0 && are_parallel(&driven.direction, &driving.direction);
        let factor = if opposite { ratio.clone() } else { -ratio };
        let mut terms: Vec<CouplingTerm> = Vec::new();
        let all = driven
            .terms
            .iter()
            .map(|(joint, sign)| (joint, sign, Number::one()));
        let others = driving.terms.iter();
        for (joint, sign, factor) in all.chain(others.map(|(j, s)| (j, s, factor.clone()))) {
            let share = if *sign { factor } else { -factor };
            match terms.iter_mut().find(|term| term.joint == *joint) {
                Some(term) => term.factor = &term.factor + &share,
                None => terms.push(CouplingTerm::linear(*joint, share)),
            }
        }
        terms.retain(|term| !term.factor.is_zero());
        let mut assumed = Vec::new();
        if carrier.is_none() {
            if self.moving_between(ends) > 2 {
                let borne = if driven.terms.len() > 1 {
                    successor
                } else {
                    predecessor
                };
                assumed.push(Assumption::SeenFrom {
                    link: common,
                    other: self.bearer(borne),
                });
            }
            let mut signs = driven.terms.iter().chain(&driving.terms);
            if opposite || signs.any(|(_, sign)| !sign) {
                assumed.push(Assumption::SameDirection);
            }
        }
        Ok((terms, assumed))
    }

    fn name(&self, link: LinkId) -> &str {
        &self.links[link.0].name
    }

    /// The joint that places a link, passing over fixed ones, and the link that bears it by that joint.
    fn bearer(&self, link: LinkId) -> Option<LinkId> {
        let mut link = link;
        while let Placement::Joint(id) = &self.links[link.0].placement {
            let joint = &self.joints[id.0];
            link = joint.predecessor.link;
            if joint.kind != JointKind::Fixed {
                return Some(link);
            }
        }
        None
    }

    /// Why a link's rate is zero whatever the others do, and what to write instead.
    fn at_rest(
        &self,
        entity: &Entity,
        ends: [LinkId; 2],
        link: LinkId,
        from: LinkId,
    ) -> MechanismError {
        let other = ends[usize::from(ends[0] == link)];
        let problem = format!(
            "the rates are those seen from `{}`, where `{}` is at rest, so that the ratio says nothing",
            self.name(from),
            self.name(link)
        );
        let between = self
            .bearer(other)
            .filter(|bearer| self.moving_between([*bearer, link]) > 0);
        let help = match between {
            Some(bearer) => format!(
                "name the link that bears both wheels, as in <carrier link=\"{}\"/>",
                self.name(bearer)
            ),
            None => "name the link that bears both wheels: <carrier link=\"...\"/>".to_owned(),
        };
        MechanismError::new(entity.clone(), problem).help(help)
    }

    /// How many joints move on the way between two links.
    fn moving_between(&self, ends: [LinkId; 2]) -> usize {
        let links = self.paths_to_ancestor(ends).concat();
        let moving = |link: &LinkId| match &self.links[link.0].placement {
            Placement::Joint(id) => self.joints[id.0].kind != JointKind::Fixed,
            _ => true,
        };
        links.iter().filter(|link| moving(link)).count()
    }

    /// What a link does seen from another one: the joints on the way with the signs of their rates, and the axis of the last one.
    fn run(&self, entity: &Entity, from: LinkId, to: LinkId) -> Result<Run, MechanismError> {
        let [up, down] = self.paths_to_ancestor([from, to]);
        // Each link with whether its joint is passed from the parent to the child.
        let up = up.into_iter().map(|link| (link, false));
        let down = down.into_iter().rev().map(|link| (link, true));
        let mut from_here = Rigid::identity(&1.0);
        let mut passed: Vec<(JointId, bool, Vector<f64>)> = Vec::new();
        for (link, downwards) in up.chain(down) {
            let id = match &self.links[link.0].placement {
                Placement::World => continue,
                Placement::Joint(id) => *id,
                Placement::Floating { name, .. } => {
                    return Err(MechanismError::new(
                        entity.clone(),
                        format!(
                            "its path through the tree crosses floating joint `{name}`, which has no rate"
                        ),
                    ));
                }
            };
            let joint = &self.joints[id.0];
            let sides = [&joint.predecessor, &joint.successor];
            let [near, far] = sides.map(|side| ExactPose::of(&side.frame).to_doubles());
            let [near, far] = if downwards { [near, far] } else { [far, near] };
            let at_joint = from_here.compose(&near);
            if joint.kind != JointKind::Fixed {
                check_one_freedom(entity, joint)?;
                let axis = joint.axis.0.each_ref().map(Number::value);
                passed.push((id, downwards, at_joint.rotate(&unit(&axis))));
            }
            from_here = at_joint.compose(&far.inverse());
        }
        let Some((last, _, direction)) = passed.last().cloned() else {
            return Ok(Run::default());
        };
        let part = self.part(last);
        let mut terms = Vec::new();
        for (id, downwards, axis) in &passed {
            let unlike = match (self.part(*id) == part, are_parallel(axis, &direction)) {
                (false, _) => "one turns and the other slides",
                (_, false) => "their axes are not parallel",
                _ => "",
            };
            if !unlike.is_empty() {
                let [one, other] = [*id, last].map(|id| self.joints[id.0].name.as_str());
                let bearer = self.bearer(to).unwrap_or(from);
                return Err(MechanismError::new(
                    entity.clone(),
                    format!(
                        "seen from `{}`, `{}` moves by joints `{one}` and `{other}`, which do not add up: {unlike}",
                        self.name(from),
                        self.name(to)
                    ),
                )
                .help(format!(
                    "name the link from which one of them is seen, as in <carrier link=\"{}\"/>",
                    self.name(bearer)
                )));
            }
            terms.push((*id, *downwards == (dot(axis, &direction) > 0.0)));
        }
        terms.reverse();
        Ok(Run {
            terms,
            part: Some(part),
            direction,
        })
    }

    /// Whether a joint turns; a screw does.
    fn part(&self, joint: JointId) -> FreedomPart {
        match self.joints[joint.0].kind.freedoms() {
            [FreedomPart::Translation] => FreedomPart::Translation,
            _ => FreedomPart::Rotation,
        }
    }

    /// The nearest link from which both of two links hang.
    fn common(&self, ends: [LinkId; 2]) -> LinkId {
        let [up, _] = self.paths_to_ancestor(ends);
        let last = up.last();
        last.and_then(|link| placed_by(&self.links[link.0], self.joints))
            .unwrap_or(ends[0])
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
    use super::super::samples::{chain, fault, help, hinge, hinges, links, number, terms};
    use super::super::{JointBuilder, MechanismBuilder};
    use super::*;
    use crate::mechanism::{CouplingOrigin, Direction, Frame, Mechanism};

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
        ] {
            let mechanism = ratio(fork(), ends, "0.5").build().unwrap();
            assert_eq!(terms(&mechanism), expected, "{ends:?}");
            assert!(mechanism.couplings()[0].offset.is_zero());
        }
    }

    /// A wheel and an arm on the ground, and a wheel on the arm.
    fn epicyclic(axes: [[i64; 3]; 3]) -> MechanismBuilder {
        let mut builder = links(&["ground", "sun", "arm", "planet"]);
        for ((name, parent, child), axis) in [
            ("s", "ground", "sun"),
            ("a", "ground", "arm"),
            ("p", "arm", "planet"),
        ]
        .into_iter()
        .zip(axes)
        {
            let axis = Direction(axis.map(Number::integer));
            builder.joint(hinge(name, parent, child).axis(axis));
        }
        builder
    }

    fn assumed(mechanism: &Mechanism) -> &[Assumption] {
        match &mechanism.couplings()[0].origin {
            CouplingOrigin::Ratio { assumed, .. } => assumed,
            _ => panic!("no ratio"),
        }
    }

    /// Willis: planet − arm = −2 (sun − arm), whatever the axes' senses; planet is s + a seen from the ground.
    #[test]
    fn rates_are_seen_from_the_carrier_and_count_in_one_direction() {
        let (up, down) = ([0, 0, 1], [0, 0, -2]);
        let on_arm = |axes: [[i64; 3]; 3]| {
            let mut builder = epicyclic(axes);
            builder.coupling_on(Some("arm"), "gears", ["sun", "planet"], number("-2"));
            builder.build().unwrap()
        };
        for (axes, expected) in [
            ([up, up, up], vec![("p", 1.0), ("s", 2.0), ("a", -2.0)]),
            ([up, up, down], vec![("p", 1.0), ("s", -2.0), ("a", 2.0)]),
            ([down, up, up], vec![("p", 1.0), ("s", -2.0), ("a", -2.0)]),
            ([up, down, up], vec![("p", 1.0), ("s", 2.0), ("a", 2.0)]),
        ] {
            let mechanism = on_arm(axes);
            assert_eq!(terms(&mechanism), expected, "{axes:?}");
            assert!(assumed(&mechanism).is_empty());
        }
        // Seen from the ground, and said to be.
        let mechanism = ratio(epicyclic([up, up, down]), ["sun", "planet"], "-2")
            .build()
            .unwrap();
        assert_eq!(terms(&mechanism), [("p", 1.0), ("a", -1.0), ("s", -2.0)]);
        let [seen, opposite] = assumed(&mechanism) else {
            panic!("{:?}", assumed(&mechanism));
        };
        let arm = mechanism.link_named("arm");
        assert!(matches!(seen, Assumption::SeenFrom { other, .. } if *other == arm));
        assert_eq!(*opposite, Assumption::SameDirection);
    }

    /// Shafts across each other: each rate is about its own axis. Where an arm carries one of them along, the rates do not add up.
    #[test]
    fn bevel_gears_count_about_their_own_axes() {
        let (up, across) = ([0, 0, 1], [-1, 0, 0]);
        let mut builder = epicyclic([up, up, across]);
        builder.coupling_on(Some("arm"), "gears", ["sun", "planet"], number("3"));
        assert_eq!(
            terms(&builder.build().unwrap()),
            [("p", 1.0), ("s", -3.0), ("a", 3.0)]
        );
        let free = ratio(epicyclic([up, up, across]), ["sun", "planet"], "3");
        assert_eq!(
            fault(free.clone()),
            "coupling `gears`: seen from `ground`, `planet` moves by joints `a` and `p`, which do not add up: their axes are not parallel"
        );
        assert!(help(free).contains("<carrier link=\"arm\"/>"));
        let mut slide = hinges();
        slide.link("d");
        slide.joint(JointBuilder::tree("cd", JointKind::Prismatic, "c", "d"));
        slide.link("e");
        slide.joint(hinge("ae", "a", "e"));
        assert!(fault(ratio(slide, ["e", "d"], "1")).ends_with("one turns and the other slides"));
    }

    /// A belt from the pulley that carries the arm: seen from that pulley it is at rest.
    #[test]
    fn a_link_that_carries_the_other_names_a_carrier() {
        let belt = ratio(fork(), ["a", "d"], "2");
        assert_eq!(
            fault(belt.clone()),
            "coupling `gears`: the rates are those seen from `a`, where `a` is at rest, so that the ratio says nothing"
        );
        assert!(help(belt).contains("<carrier link=\"b\"/>"));
        let mut builder = fork();
        builder.coupling_on(Some("b"), "gears", ["a", "d"], number("2"));
        assert_eq!(terms(&builder.build().unwrap()), [("bc", 1.0), ("ab", 2.0)]);
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
        assert!(fault(ratio(fork(), ["e", "b"], "2")).contains("at rest"));
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
        assert!(fault(ratio(ball, ["a", "b"], "1")).contains("at rest"));
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
