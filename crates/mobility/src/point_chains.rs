//! Rigid bodies of several links, and balls and universal joints that are written as hinges in series.
//!
//! A robot file splits one body into links that fixed joints hold together, and writes a ball as two or three hinges whose
//! axes meet in a point, with small links between them that stand for nothing. Neither is a link whose motion anybody asks
//! for. Here links are put together to [`Bodies`], and such hinges to a [`PointChain`].
//!
//! # When hinges are one joint
//! Two axes of one body keep their places in it, so that whether they cross, and where, is the same at every pose; and
//! a crossing point keeps its place on each axis. Hinges in series therefore have one common point at every pose if
//! neighbouring axes cross at the same place of the axis they share. That is tested within what the file's digits leave open.
//!
//! Links of a spherical linkage have crossing axes too, and drive shafts. A body counts as an intermediate link only if it
//! has no third joint, no coupling and no motor, if its joints' frames lie in the common point or it is massless in a file that
//! states masses, and if the chain has no more than a ball's three freedoms and joins two different bodies.
//!
//! Cost: near-linear in links and joints.

use kutzbach_closure::Structure;
use kutzbach_closure::{Geometry, Rigid, least_length};
use kutzbach_model::mechanism::{JointKind, Mechanism, Placement};
use nalgebra::{Matrix3, Vector3};
use std::collections::VecDeque;

/// Axes at less than this angle (rad) are taken for parallel: where they cross says little.
const LEAST_ANGLE: f64 = 1e-3;

/// Uncertainties of a file are standard ones; this many of them are still the same place.
const DEVIATIONS: f64 = 10.0;

/// A body this much lighter than the heaviest one has no mass: converters give frames a nanogram.
const MASSLESS: f64 = 1e-6;

/// Links put together where joints without freedom hold them.
pub(super) struct Bodies {
    /// Body of every link.
    pub of: Vec<usize>,
    /// Links of every body, by index.
    pub links: Vec<Vec<usize>>,
    /// Joints with freedom that lead from a body to another one, with that other body.
    pub joints: Vec<Vec<(usize, usize)>>,
    /// `body_from_link` of every link.
    placed: Vec<Rigid<f64>>,
    /// Mass of every body (kg), 0 where none is stated.
    pub mass: Vec<f64>,
}

/// Links with the heaviest first; of equally heavy ones those that no fixed joint carries, since such a link is often a mere
/// frame, and of these the first by name.
pub(super) fn heaviest_first(
    mechanism: &Mechanism,
    structure: &Structure,
    mut links: Vec<usize>,
) -> Vec<usize> {
    let mass = |link: usize| {
        let inertial = mechanism.links()[link].inertial.as_ref();
        inertial.map_or(0.0, |inertial| inertial.mass.value())
    };
    let carried = |link: usize| {
        let mut joints = structure.graph.incident(link).iter();
        joints.any(|incidence| {
            let joint = &mechanism.joints()[incidence.edge];
            joint.freedom() == 0 && joint.successor.link.0 == link
        })
    };
    let rank = |link: usize| (carried(link), structure.graph.node_rank(link));
    links.sort_by(|&a, &b| {
        mass(b)
            .total_cmp(&mass(a))
            .then_with(|| rank(a).cmp(&rank(b)))
    });
    links
}

impl Bodies {
    pub fn of(mechanism: &Mechanism, geometry: &Geometry<f64>) -> Self {
        let joints = mechanism.joints();
        let count = mechanism.links().len();
        let mut fixed = vec![Vec::new(); count];
        for (index, joint) in joints.iter().enumerate().filter(|(_, j)| j.freedom() == 0) {
            let [sides0, sides1] = &geometry.sides[index];
            let (a, b) = (joint.predecessor.link.0, joint.successor.link.0);
            fixed[a].push((b, sides0.compose(&sides1.inverse())));
            fixed[b].push((a, sides1.compose(&sides0.inverse())));
        }
        let mut found = Self {
            of: vec![usize::MAX; count],
            links: Vec::new(),
            joints: Vec::new(),
            placed: vec![Rigid::identity(&1.0); count],
            mass: Vec::new(),
        };
        for start in 0..count {
            if found.of[start] != usize::MAX {
                continue;
            }
            let body = found.links.len();
            found.of[start] = body;
            let mut links = vec![start];
            let mut next = 0;
            while let Some(&link) = links.get(next) {
                next += 1;
                for (other, offset) in &fixed[link] {
                    if found.of[*other] == usize::MAX {
                        found.of[*other] = body;
                        found.placed[*other] = found.placed[link].compose(offset);
                        links.push(*other);
                    }
                }
            }
            links.sort_unstable();
            let masses = links.iter().filter_map(|&link| {
                let inertial = mechanism.links()[link].inertial.as_ref()?;
                Some(inertial.mass.value())
            });
            found.mass.push(masses.sum());
            found.links.push(links);
        }
        found.joints = vec![Vec::new(); found.links.len()];
        for (index, joint) in joints.iter().enumerate().filter(|(_, j)| j.freedom() > 0) {
            let ends =
                [joint.predecessor.link.0, joint.successor.link.0].map(|link| found.of[link]);
            if ends[0] != ends[1] {
                found.joints[ends[0]].push((index, ends[1]));
                found.joints[ends[1]].push((index, ends[0]));
            }
        }
        found
    }

    /// Joints between each body and the ground, or a link that floats; the largest number where no joint leads there.
    pub fn steps_from_ground(&self, mechanism: &Mechanism) -> Vec<usize> {
        let links = mechanism.links().iter().enumerate();
        let held = links.filter(|(index, link)| {
            *index == mechanism.ground().0 || matches!(link.placement, Placement::Floating { .. })
        });
        let mut queue: VecDeque<usize> = held.map(|(index, _)| self.of[index]).collect();
        let mut steps = vec![usize::MAX; self.links.len()];
        queue.iter().for_each(|&body| steps[body] = 0);
        while let Some(body) = queue.pop_front() {
            for &(_, other) in &self.joints[body] {
                if steps[other] == usize::MAX {
                    steps[other] = steps[body] + 1;
                    queue.push_back(other);
                }
            }
        }
        steps
    }

    fn is_massless(&self, body: usize) -> bool {
        let heaviest = self.mass.iter().fold(0.0, |m: f64, x| m.max(*x));
        heaviest > 0.0 && self.mass[body] <= MASSLESS * heaviest
    }
}

/// Rotations about one point in series, or a single joint.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Connection {
    /// Its joints.
    pub joints: Vec<usize>,
    /// Intermediate bodies.
    pub between: Vec<usize>,
    /// The bodies it joins.
    pub ends: [usize; 2],
    /// Whether it allows all rotations about a point, and nothing else.
    pub ball: bool,
}

impl Connection {
    /// A joint by itself.
    pub fn one(mechanism: &Mechanism, joint: usize, ends: [usize; 2]) -> Self {
        Self {
            joints: vec![joint],
            between: Vec::new(),
            ends,
            ball: mechanism.joints()[joint].kind == JointKind::Spherical,
        }
    }

    /// The body at the other end.
    pub fn beyond(&self, body: usize) -> usize {
        self.ends[usize::from(self.ends[0] == body)]
    }
}

/// Bodies, and what joins them once hinges through one point are put together.
pub(super) struct Connections {
    pub bodies: Bodies,
    pub all: Vec<Connection>,
    /// Indices of the connections that end at a body.
    pub at: Vec<Vec<usize>>,
    /// Whether a body is an intermediate one.
    pub intermediate: Vec<bool>,
}

impl Connections {
    pub fn of(mechanism: &Mechanism, geometry: &Geometry<f64>, structure: &Structure) -> Self {
        let bodies = Bodies::of(mechanism, geometry);
        let crossings = Crossings::of(mechanism, geometry, structure, &bodies);
        let mut found = Self {
            at: vec![Vec::new(); bodies.links.len()],
            intermediate: vec![false; bodies.links.len()],
            all: Vec::new(),
            bodies,
        };
        let mut seen = vec![false; found.bodies.links.len()];
        let mut taken = vec![false; mechanism.joints().len()];
        for start in 0..seen.len() {
            if seen[start] || crossings.at[start].is_none() {
                continue;
            }
            let Some(chain) = crossings.chain(mechanism, &found.bodies, start, &mut seen) else {
                continue;
            };
            chain.joints.iter().for_each(|&joint| taken[joint] = true);
            chain
                .between
                .iter()
                .for_each(|&body| found.intermediate[body] = true);
            found.all.push(chain);
        }
        for (index, joint) in mechanism.joints().iter().enumerate() {
            let ends = [joint.predecessor.link.0, joint.successor.link.0]
                .map(|link| found.bodies.of[link]);
            if !taken[index] && joint.freedom() > 0 && ends[0] != ends[1] {
                found.all.push(Connection::one(mechanism, index, ends));
            }
        }
        for (index, connection) in found.all.iter().enumerate() {
            for end in connection.ends {
                found.at[end].push(index);
            }
        }
        found
    }
}

/// Where the two joints of a body cross: the place on each joint's axis, counted from its frame's origin (m).
struct Crossings {
    at: Vec<Option<[(usize, f64); 2]>>,
    /// What two places on one axis may differ by (m), by joint.
    within: Vec<f64>,
}

impl Crossings {
    fn of(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        structure: &Structure,
        bodies: &Bodies,
    ) -> Self {
        let within: Vec<f64> = geometry
            .uncertainties
            .iter()
            .enumerate()
            .map(|(joint, open)| {
                let least = least_length(geometry.size_of([joint]).max(geometry.arms[joint]));
                least + DEVIATIONS * (open.lengths + open.angles * geometry.arms[joint])
            })
            .collect();
        let mut part_of = vec![None; mechanism.joints().len()];
        for (index, part) in structure.parts.iter().enumerate() {
            for (joint, _) in part.cycles.iter().flatten() {
                part_of[*joint] = Some(index);
            }
        }
        for coupling in mechanism.couplings() {
            coupling
                .terms
                .iter()
                .for_each(|t| part_of[t.joint.0] = None);
        }
        // A joint with a motor is one by itself.
        mechanism
            .actuated()
            .iter()
            .for_each(|joint| part_of[joint.0] = None);
        let ground = bodies.of[mechanism.ground().0];
        let at = bodies
            .joints
            .iter()
            .enumerate()
            .map(|(body, joints)| {
                let &[(first, _), (second, _)] = joints.as_slice() else {
                    return None;
                };
                if body == ground || part_of[first].is_none() || part_of[first] != part_of[second] {
                    return None;
                }
                let sides = [first, second].map(|j| Line::of(mechanism, geometry, bodies, body, j));
                let [Some(one), Some(other)] = sides else {
                    return None;
                };
                let places = one.crossing(&other, within[first] + within[second])?;
                let central = places
                    .iter()
                    .zip([first, second])
                    .all(|(s, j)| s.abs() <= within[j]);
                (central || bodies.is_massless(body))
                    .then_some([(first, places[0]), (second, places[1])])
            })
            .collect();
        Self { at, within }
    }

    /// The chain that a body is in, all of whose intermediate bodies are marked as seen; `None` where it is no joint.
    fn chain(
        &self,
        mechanism: &Mechanism,
        bodies: &Bodies,
        start: usize,
        seen: &mut [bool],
    ) -> Option<Connection> {
        seen[start] = true;
        let mut between = vec![start];
        let mut joints = Vec::new();
        let mut ends = [start; 2];
        let mut closed = false;
        for (end, &(first, place)) in ends.iter_mut().zip(self.at[start].as_ref()?) {
            let (mut body, mut joint, mut place) = (start, first, place);
            while !joints.contains(&joint) {
                joints.push(joint);
                let next = bodies.joints[body]
                    .iter()
                    .find(|(j, _)| *j == joint)
                    .map(|(_, other)| *other)?;
                *end = next;
                let Some(sides) = &self.at[next] else { break };
                let same = |(j, s): &(usize, f64)| {
                    *j == joint && (s - place).abs() <= 2.0 * self.within[joint]
                };
                if !sides.iter().any(same) {
                    break;
                }
                let Some(&(onward, there)) = sides.iter().find(|(j, _)| *j != joint) else {
                    break;
                };
                if between.contains(&next) {
                    closed = true;
                    break;
                }
                seen[next] = true;
                between.push(next);
                (body, joint, place) = (next, onward, there);
            }
        }
        let freedom: usize = joints
            .iter()
            .map(|&j| mechanism.joints()[j].freedom())
            .sum();
        (!closed && ends[0] != ends[1] && freedom <= 3).then_some(Connection {
            joints,
            between,
            ends,
            ball: freedom == 3,
        })
    }
}

/// The axis or the point of a joint, in the frame of one of its bodies.
struct Line {
    origin: Vector3<f64>,
    /// `None` for a point, about which every axis turns.
    direction: Option<Vector3<f64>>,
}

impl Line {
    /// `None` for joints that are no rotations about a point.
    fn of(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        bodies: &Bodies,
        body: usize,
        joint: usize,
    ) -> Option<Self> {
        let kind = mechanism.joints()[joint].kind;
        let ends = &mechanism.joints()[joint];
        let side = usize::from(bodies.of[ends.predecessor.link.0] != body);
        let link = [ends.predecessor.link.0, ends.successor.link.0][side];
        let frame = bodies.placed[link].compose(&geometry.sides[joint][side]);
        let rotation = Matrix3::from_fn(|i, j| frame.rotation[i][j]);
        let direction = match kind {
            JointKind::Revolute => {
                let axis: Vector3<f64> = (*geometry.displacements[joint].axis()).into();
                Some(rotation * axis)
            }
            JointKind::Universal | JointKind::Spherical => None,
            _ => return None,
        };
        Some(Self {
            origin: frame.translation.into(),
            direction,
        })
    }

    /// Where two lines cross, on each from its origin; `None` where they miss each other by more than `within`, or where
    /// they are nearly parallel.
    fn crossing(&self, other: &Self, within: f64) -> Option<[f64; 2]> {
        let between = other.origin - self.origin;
        let places = match (self.direction, other.direction) {
            (None, None) => [0.0; 2],
            (Some(u), None) => [u.dot(&between), 0.0],
            (None, Some(v)) => [0.0, -v.dot(&between)],
            (Some(u), Some(v)) => {
                let sine = u.cross(&v).norm();
                if !(sine > LEAST_ANGLE) {
                    return None;
                }
                let across = u.cross(&v) / (sine * sine);
                [
                    between.cross(&v).dot(&across),
                    between.cross(&u).dot(&across),
                ]
            }
        };
        let point = |line: &Self, place: f64| {
            line.origin + line.direction.map_or_else(Vector3::zeros, |d| d * place)
        };
        let miss = (point(self, places[0]) - point(other, places[1])).norm();
        (miss <= within).then_some(places)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_closure::Arithmetic;
    use kutzbach_format::read;

    /// ```text
    /// base ── j0 ── l1 ── j1 ── … ── jn ── base     each joint at `offset` in the link before it, turning about `axis`
    /// ```
    fn ring(joints: &[(&str, &str)], extra: &str) -> (Mechanism, Connections) {
        let count = joints.len();
        let mut text = String::from(r#"<robot name="ring"><link name="l0"/>"#);
        for (index, (offset, axis)) in joints.iter().enumerate() {
            if index + 1 < count {
                text += &format!(
                    r#"<link name="l{n}"/><joint name="j{index}" type="revolute"><parent link="l{index}"/><child link="l{n}"/>
                    <origin xyz="{offset}"/><axis xyz="{axis}"/></joint>"#,
                    n = index + 1
                );
            } else {
                text += &format!(
                    r#"<loop name="j{index}" type="revolute"><predecessor link="l{index}"><origin xyz="{offset}"/></predecessor>
                    <successor link="l0"><origin xyz="9 9 9"/></successor><axis xyz="{axis}"/></loop>"#
                );
            }
        }
        let text = text + extra + "</robot>";
        let mechanism = read(&text, "ring.urdf", &[]).unwrap().mechanism;
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let structure = Structure::new(&mechanism);
        let found = Connections::of(&mechanism, &geometry, &structure);
        (mechanism, found)
    }

    fn between(joints: &[(&str, &str)], extra: &str) -> Vec<String> {
        let (mechanism, found) = ring(joints, extra);
        (0..mechanism.links().len())
            .filter(|&link| found.intermediate[found.bodies.of[link]])
            .map(|link| mechanism.links()[link].name.clone())
            .collect()
    }

    const X: &str = "1 0 0";
    const Y: &str = "0 1 0";
    const Z: &str = "0 0 1";
    const HERE: &str = "0 0 0";

    #[test]
    fn three_hinges_through_a_point_are_a_ball() {
        let (_, found) = ring(&[(X, X), (HERE, Y), (HERE, Z), (X, Z), (Y, Y)], "");
        let ball = found.all.iter().find(|c| c.joints.len() > 1).unwrap();
        assert!(ball.ball && ball.between.len() == 2, "{ball:?}");
        assert_eq!(found.all.len(), 3);
    }

    #[test]
    fn two_are_a_universal_joint_unless_they_miss_each_other() {
        assert_eq!(between(&[(X, X), (HERE, Y), (X, Z), (Y, Z)], ""), ["l1"]);
        assert!(between(&[(X, X), ("0 0 0.1", Y), (X, Z), (Y, Z)], "").is_empty());
        // Nor are two parallel hinges, or one hinge twice.
        assert!(between(&[(X, X), (HERE, X), (X, Z), (Y, Z)], "").is_empty());
    }

    #[test]
    fn axes_that_cross_away_from_their_frames_are_links() {
        // The drive shaft of a Hooke joint, borne one metre from the cross.
        assert!(between(&[(X, X), (X, Y), (X, Z), (Y, Z)], "").is_empty());
    }

    #[test]
    fn links_of_a_spherical_linkage_are_links() {
        assert!(between(&[(X, X), (HERE, Y), (HERE, Z), (HERE, "1 1 1")], "").is_empty());
    }

    #[test]
    fn couplings_motors_and_further_joints_make_a_link_count() {
        let gimbal = [(X, X), (HERE, Y), (X, Z), (Y, Z)];
        for extra in [
            r#"<transmission name="t"><joint name="j0"/></transmission>"#,
            r#"<link name="tool"/><joint name="wrist" type="revolute"><parent link="l1"/><child link="tool"/></joint>"#,
            r#"<coupling name="c"><predecessor link="l1"/><successor link="l3"/><ratio value="2"/><carrier link="l2"/></coupling>"#,
        ] {
            assert!(between(&gimbal, extra).is_empty(), "{extra}");
        }
        let fixed = r#"<link name="plate"/><joint name="screw" type="fixed"><parent link="l1"/><child link="plate"/></joint>"#;
        assert_eq!(between(&gimbal, fixed), ["l1", "plate"]);
    }

    #[test]
    fn links_that_are_fixed_together_are_one_body() {
        let (mechanism, found) = ring(
            &[(X, X), (HERE, Y), (X, Z)],
            r#"<link name="a"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
            <link name="b"/>
            <joint name="p" type="fixed"><parent link="l1"/><child link="a"/><origin xyz="1 2 3" rpy="0 0 1.5"/></joint>
            <joint name="q" type="fixed"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/></joint>"#,
        );
        let body = |name: &str| found.bodies.of[mechanism.link_named(name).unwrap().0];
        assert_eq!((body("a"), body("b")), (body("l1"), body("l1")));
        assert_eq!(found.bodies.links.len(), 3);
        assert_eq!(found.bodies.mass[body("b")], 2.0);
    }
}
