//! How the links of a cycle move relative to one another when the cycle is taken alone, over all its poses.
//!
//! A cylindrical joint in a cycle may be left with its slide, a plate between two chains with a translation along a line.
//! For links next to one another, and for others that few joints lie between, the smallest displacement subgroup is found
//! that holds their relative displacement: on all solutions of the cycle, or on those pieces of its solutions that the
//! drawn pose lies on. It is worth saying where it is smaller than what either of the two chains between the links would
//! allow by itself.

use super::clusters::joined;
use super::pieces::Pieces;
use super::subgroup::{Held, smallest_subgroup};
use crate::strategy::Local;
use crate::system::{CycleEquations, Unavailable};
use crate::{Budget, GroebnerBasis, Polynomial, PolynomialSystem, Stop};
use kutzbach_math::group::{DisplacementSubgroup, Gauge, Subalgebra, Twist};
use kutzbach_model::mechanism::{JointId, LinkId, Mechanism};
use nalgebra::Vector3;

/// Most joints between two links that are looked at.
const LONGEST_PATH: usize = 4;

/// A proven statement on two links of a cycle: their relative displacements since the drawn pose lie in a subgroup.
#[derive(Clone, Debug)]
pub struct ProvenMotion {
    /// The link whose motion it is.
    pub link: LinkId,
    /// The link it is seen from.
    pub relative_to: LinkId,
    /// The joints of the cycle that join the two directly: one, both of a cycle of two joints, or none.
    pub joints: Vec<JointId>,
    /// The smallest subgroup that was found, in world coordinates with `relative_to` where it is drawn.
    pub subgroup: DisplacementSubgroup,
    /// Whether its direction is that of the axis of the one joint between the links.
    pub along_the_joint: bool,
    /// Where it holds.
    pub scope: Scope,
}

/// Where a statement on a cycle holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// On all solutions of the cycle, complex ones included.
    Everywhere,
    /// On all pieces of its solutions that the drawn pose lies on.
    PiecesOfHome,
}

/// Whether all that was asked about a cycle's motions was settled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Settled {
    /// Every pair of links was looked at, on all solutions and on the pieces of the drawn pose.
    Yes,
    /// The budget ended; what is said holds.
    Stopped(Stop),
    /// What holds on all solutions was looked at; the pieces took too long, so that more may hold near the drawn pose.
    WithoutPieces,
    /// Nothing was looked at: the drawn pose is no exact solution, so that there is nothing to count from.
    NoHome,
    /// Some pair of links was left out: a joint that is written without variables of its own, or long polynomials.
    InPart,
}

/// What the motions of a cycle's links are known to be.
pub(super) struct Motions {
    pub(super) motions: Vec<ProvenMotion>,
    pub(super) settled: Settled,
}

/// Two links and the ways between them.
struct Pair {
    /// From the first, the second is seen.
    links: [LinkId; 2],
    /// The chains between them, the shortest one first, each from the first link to the second.
    chains: Vec<Vec<(JointId, bool)>>,
}

/// A part of a mechanism whose motions are asked for: a cycle, or all of it.
pub(super) struct Part<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) system: &'a PolynomialSystem,
    /// The ring of its equations.
    pub(super) local: &'a Local,
    pub(super) pieces: &'a Pieces,
    /// Links that it is known to hold together; of these only one is spoken of.
    pub(super) rigid: &'a [Vec<LinkId>],
    pub(super) budget: &'a Budget,
}

impl Part<'_> {
    /// What the links of a cycle can do relative to one another, where it is less than each of the two chains between
    /// them allows.
    pub(super) fn motions_in(&self, cycle: &CycleEquations) -> Motions {
        self.motions(pairs_in(self.mechanism, cycle), &[])
    }

    /// What every joint of the whole mechanism is left with, and every link relative to the ground, where it is less than
    /// the joints between them allow and than is `known` already.
    pub(super) fn motions_of_all(&self, known: &[ProvenMotion]) -> Motions {
        self.motions(pairs_of_all(self.mechanism, self.system), known)
    }

    /// The pairs whose motion is worth saying. A budget that ends leaves what was found, see [`Motions::settled`].
    fn motions(&self, pairs: Vec<Pair>, known: &[ProvenMotion]) -> Motions {
        let mut found = Motions {
            motions: Vec::new(),
            settled: match self.pieces.are_complete() {
                true => Settled::Yes,
                false => Settled::WithoutPieces,
            },
        };
        // Links that are held together, by what is known and what is found, in the names of their first.
        let mut bodies: Vec<Vec<LinkId>> = self.rigid.to_vec();
        let mut told: Vec<[LinkId; 2]> = Vec::new();
        for pair in pairs {
            let body = |link: LinkId| {
                let body = bodies.iter().find(|body| body.contains(&link));
                body.and_then(|body| body.first().copied()).unwrap_or(link)
            };
            let ends = |links: [LinkId; 2]| {
                let [a, b] = links.map(body);
                [a.min(b), a.max(b)]
            };
            let these = ends(pair.links);
            if these[0] == these[1] || told.contains(&these) {
                continue;
            }
            let of_chains = pair
                .chains
                .iter()
                .map(|chain| freedom(self.mechanism, self.system, chain));
            let said = known
                .iter()
                .filter(|motion| ends([motion.link, motion.relative_to]) == these)
                .map(|motion| motion.subgroup.dimension());
            let allowed = of_chains.chain(said).min().unwrap_or(6);
            match self.motion(&pair) {
                Ok(Some(motion)) => {
                    if motion.subgroup.dimension() < allowed {
                        told.push(these);
                        if motion.subgroup == DisplacementSubgroup::Identity {
                            bodies.push(pair.links.to_vec());
                            bodies = joined(bodies);
                        }
                        found.motions.push(motion);
                    }
                }
                Ok(None) => {}
                Err(Missing::Stopped(stop)) => {
                    found.settled = Settled::Stopped(stop);
                    return found;
                }
                Err(Missing::Unavailable(Unavailable::Home)) => {
                    found.settled = Settled::NoHome;
                    return found;
                }
                Err(Missing::Unavailable(_)) => found.settled = Settled::InPart,
            }
        }
        found
    }

    /// The smallest subgroup of one pair, on the pieces of the drawn pose, and whether it is that of all solutions;
    /// `None` where nothing smaller than all displacements was found.
    fn motion(&self, pair: &Pair) -> Result<Option<ProvenMotion>, Missing> {
        self.budget.check()?;
        let (mechanism, system) = (self.mechanism, self.system);
        let mut unavailable = Unavailable::Joint;
        let mut displacement = None;
        for chain in &pair.chains {
            match system.relative_displacement(chain, &self.local.variables) {
                Ok(found) => {
                    displacement = Some(found);
                    break;
                }
                Err(why) => unavailable = why,
            }
        }
        let Some(displacement) = displacement else {
            return Err(Missing::Unavailable(unavailable));
        };
        let on = |bases: &[&GroebnerBasis]| -> Result<Held, Stop> {
            let reduce = |polynomial: &Polynomial| {
                bases
                    .iter()
                    .map(|basis| basis.normal_form_within(polynomial, self.budget))
                    .collect()
            };
            smallest_subgroup(&displacement, &reduce)
        };
        let all = self.pieces.all();
        let of_home = self.pieces.of_home();
        let held = on(&of_home)?;
        if held.subgroup == DisplacementSubgroup::General {
            return Ok(None);
        }
        let everywhere = of_home.len() == all.len() || {
            // What holds on all solutions holds on some of them: of the same class it is the same.
            on(&all)?.subgroup.kind() == held.subgroup.kind()
        };
        // The ground, or else the link that comes first in the file, is the one that motion is seen from.
        let [a, b] = pair.links;
        let ground = mechanism.ground();
        let (relative_to, link) = if b == ground || (a != ground && b < a) {
            (b, a)
        } else {
            (a, b)
        };
        let joints: Vec<JointId> = pair
            .chains
            .iter()
            .filter(|chain| chain.len() == 1)
            .map(|chain| chain[0].0)
            .collect();
        let along_the_joint = match (joints.as_slice(), &held.direction) {
            ([joint], Some(direction)) => system
                .axis_at_home(*joint)
                .is_some_and(|axis| system.are_parallel(&axis, direction)),
            _ => false,
        };
        Ok(Some(ProvenMotion {
            link,
            relative_to,
            joints,
            subgroup: held.subgroup,
            along_the_joint,
            scope: match everywhere {
                true => Scope::Everywhere,
                false => Scope::PiecesOfHome,
            },
        }))
    }
}

/// The pairs of links of a cycle that are looked at: neighbours in the order of the walk, then those further apart.
fn pairs_in(mechanism: &Mechanism, cycle: &CycleEquations) -> Vec<Pair> {
    let count = cycle.joints.len();
    let first_link = |step: usize| {
        let (joint, forward) = cycle.joints[step];
        let joint = mechanism.joint(joint);
        let side = if forward {
            &joint.predecessor
        } else {
            &joint.successor
        };
        side.link
    };
    let mut pairs = Vec::new();
    for length in 1..=LONGEST_PATH.min(count / 2) {
        for start in 0..count {
            // Links opposite to one another have been met from the other end.
            if 2 * length == count && start >= length {
                continue;
            }
            let end = (start + length) % count;
            let there = (0..length).map(|i| cycle.joints[(start + i) % count]);
            let back = (length..count)
                .rev()
                .map(|i| cycle.joints[(start + i) % count])
                .map(|(joint, forward)| (joint, !forward));
            pairs.push(Pair {
                links: [first_link(start), first_link(end)],
                chains: vec![there.collect(), back.collect()],
            });
        }
    }
    pairs
}

/// The pairs of links of a whole mechanism that are looked at: the ends of every joint that is written in variables, then
/// the ground and every link that few joints lie between.
fn pairs_of_all(mechanism: &Mechanism, system: &PolynomialSystem) -> Vec<Pair> {
    let joints: Vec<JointId> = (0..system.joint_variables.len())
        .map(JointId)
        .filter(|joint| !system.joint_variables[joint.0].is_empty())
        .collect();
    let ends = |joint: JointId| {
        let joint = mechanism.joint(joint);
        [joint.predecessor.link, joint.successor.link]
    };
    let in_cycle = |joint: &JointId| {
        let mut cycles = system.cycles.iter();
        cycles.any(|cycle| cycle.joints.iter().any(|(j, _)| j == joint))
    };
    let mut pairs: Vec<Pair> = joints
        .iter()
        .filter(|joint| in_cycle(joint))
        .map(|&joint| Pair {
            links: ends(joint),
            chains: vec![vec![(joint, true)]],
        })
        .collect();
    let ground = mechanism.ground();
    let mut reached: Vec<(LinkId, Vec<(JointId, bool)>)> = vec![(ground, Vec::new())];
    let mut next = 0;
    while let Some((link, chain)) = reached.get(next).cloned() {
        next += 1;
        if chain.len() == LONGEST_PATH {
            continue;
        }
        for &joint in joints.iter().filter(|joint| in_cycle(joint)) {
            let [a, b] = ends(joint);
            for (from, to, forward) in [(a, b, true), (b, a, false)] {
                if from == link && reached.iter().all(|(known, _)| *known != to) {
                    let mut further = chain.clone();
                    further.push((joint, forward));
                    reached.push((to, further));
                }
            }
        }
    }
    let far = reached.into_iter().filter(|(_, chain)| chain.len() > 1);
    pairs.extend(far.map(|(link, chain)| Pair {
        links: [ground, link],
        chains: vec![chain],
    }));
    pairs
}

/// Why there is no statement.
enum Missing {
    Stopped(Stop),
    Unavailable(Unavailable),
}

impl From<Stop> for Missing {
    fn from(stop: Stop) -> Self {
        Self::Stopped(stop)
    }
}

/// The dimension of the subgroup that a chain's joints generate, from their screws at the drawn pose; 6 where that is not
/// known. It only decides what is worth saying.
fn freedom(mechanism: &Mechanism, system: &PolynomialSystem, chain: &[(JointId, bool)]) -> usize {
    let mut twists = Vec::new();
    for (joint, _) in chain {
        let Some(screws) = system.screws_at_home(mechanism, *joint) else {
            return 6;
        };
        twists.extend(screws.into_iter().map(|s| Twist {
            angular: Vector3::new(s[0], s[1], s[2]),
            linear: Vector3::new(s[3], s[4], s[5]),
        }));
    }
    // The numbers are exact but for rounding; a length of one metre where all axes meet only scales translations.
    let generated = Gauge::from_axes(&twists, 1.0, 1e-9)
        .and_then(|gauge| Subalgebra::generated_by(&twists, &gauge));
    generated.map_or(6, |algebra| algebra.dimension())
}
