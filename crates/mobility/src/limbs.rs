//! Which part of a mechanism's freedom is in which limb.
//!
//! Seen from a body that is held, what hangs on it by separate joints moves independently: legs on a pelvis, arms on a torso.
//! From the ground inwards the first body on which two such limbs hang is the base; the joints on the way to it are the trunk.
//! The tangent space of a branch is the direct sum of those of trunk and limbs, so that their freedoms add up to the branch's.
//!
//! Cost: linear in the mechanism, and (variables of a limb)² × d for its rank.

use super::branch::Branch;
use super::one_sided::OneSided;
use super::point_chains::{Bodies, Connections, heaviest_first};
use super::tangent_space::TangentSpace;
use kutzbach_closure::Geometry;
use kutzbach_closure::Structure;
use kutzbach_model::mechanism::{Mechanism, Placement};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// What hangs on the base by itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limb {
    /// The link that it is called by. That at its end, of the body that moves most freely; of several, of the heaviest, or the
    /// farthest from the base. Where it branches that at its start, since no one end stands for all.
    pub end: usize,
    /// Whether it branches, as a torso with two arms does.
    pub branches: bool,
    /// Its freedoms along the branch, idle ones included.
    pub freedom: usize,
    /// Its idle freedoms.
    pub idle: usize,
}

/// A mechanism taken apart at its base.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limbs {
    /// The link that the limbs hang on.
    pub base: usize,
    /// Freedoms of the joints between the ground and the base.
    pub trunk: usize,
    /// At least two, by name of their ends.
    pub limbs: Vec<Limb>,
}

/// A limb of more variables is not ranked by itself.
const MOST_VARIABLES: usize = 1000;

/// What hangs on a body is a branch if it moves by so many freedoms more than that: an arm or a head, not a finger or a wheel.
const OF_A_BRANCH: usize = 2;

/// So many bodies of a limb are asked whether it branches there, the first from the base, which bounds the work.
const MOST_FORKS: usize = 32;

/// The limbs of a mechanism, with their freedoms along a branch; `None` where there are no two of them, or where a margin does
/// not tell.
#[must_use]
pub fn limbs(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    branch: &Branch,
) -> Option<Limbs> {
    let Connections {
        bodies,
        intermediate,
        ..
    } = Connections::of(mechanism, geometry, structure);
    let (base, trunk, pieces) = taken_apart(mechanism, &bodies)?;
    let pose = branch.poses.first()?;
    let tangents = TangentSpace::at(mechanism, geometry, structure, pose)?;
    // The rank of some rows is the sum of those of sets that have no vector in common.
    let freedoms = |joints: &BTreeSet<usize>| -> Option<usize> {
        let mut sets: BTreeMap<usize, Vec<Vec<f64>>> = BTreeMap::new();
        for variable in joints.iter().flat_map(|&joint| tangents.variables(joint)) {
            let row = tangents.row(variable);
            if let Some(&set) = row.vectors.first() {
                sets.entry(set).or_default().push(row.values().collect());
            }
        }
        let ranks = sets.into_values().map(|rows| {
            if rows.len() > MOST_VARIABLES {
                return None;
            }
            tangents.limits.rank(&OneSided::of(rows)?.values)
        });
        ranks.sum()
    };
    let ends = Ends::of(mechanism, structure, &bodies, &intermediate, branch);
    let mut idle_of = vec![0; bodies.links.len()];
    for idle in &branch.idle {
        idle_of[bodies.of[idle.link]] += idle.freedom;
    }
    let mut found = Vec::new();
    for piece in &pieces {
        let joints = piece
            .iter()
            .flat_map(|&body| &bodies.joints[body])
            .map(|(joint, _)| *joint);
        let start = ends.branching_start(base, piece);
        found.push(Limb {
            end: start.unwrap_or_else(|| ends.of_piece(base, piece)),
            branches: start.is_some(),
            freedom: freedoms(&joints.collect())?,
            idle: piece.iter().map(|&body| idle_of[body]).sum(),
        });
    }
    found.sort_by_key(|limb| structure.graph.node_rank(limb.end));
    let trunk = freedoms(&trunk)?;
    let all = trunk + found.iter().map(|limb| limb.freedom).sum::<usize>();
    (all == tangents.dimension()).then_some(Limbs {
        base: main_link(mechanism, structure, &bodies.links[base]),
        trunk,
        limbs: found,
    })
}

/// The base, the joints of the trunk, and the bodies of each limb.
fn taken_apart(
    mechanism: &Mechanism,
    bodies: &Bodies,
) -> Option<(usize, BTreeSet<usize>, Vec<BTreeSet<usize>>)> {
    let mut base = bodies.of[mechanism.ground().0];
    if bodies.joints[base].is_empty() {
        // A robot that floats in a world.
        let mut floating = mechanism
            .links()
            .iter()
            .enumerate()
            .filter_map(|(link, placed)| {
                matches!(placed.placement, Placement::Floating { .. }).then_some(bodies.of[link])
            });
        base = floating.next()?;
        if floating.next().is_some() {
            return None;
        }
    }
    let coupled: BTreeSet<usize> = mechanism
        .couplings()
        .iter()
        .flat_map(|coupling| coupling.terms.iter().map(|term| term.joint.0))
        .collect();
    let mut passed = BTreeSet::from([base]);
    let mut trunk = BTreeSet::new();
    loop {
        let mut ways = bodies.joints[base]
            .iter()
            .filter(|(_, other)| !passed.contains(other));
        let &(joint, next) = ways.next()?;
        if ways.clone().any(|(_, other)| *other != next) {
            let pieces = pieces_beside(mechanism, bodies, &passed, base);
            return (pieces.len() > 1).then_some((base, trunk, pieces));
        }
        if ways.next().is_some() || coupled.contains(&joint) {
            return None;
        }
        trunk.insert(joint);
        passed.insert(next);
        base = next;
    }
}

/// The sets of bodies that hang together, by joints or couplings, without those passed, and hang on the base.
fn pieces_beside(
    mechanism: &Mechanism,
    bodies: &Bodies,
    passed: &BTreeSet<usize>,
    base: usize,
) -> Vec<BTreeSet<usize>> {
    let mut tied: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for coupling in mechanism.couplings() {
        let ends: BTreeSet<usize> = coupling
            .terms
            .iter()
            .flat_map(|term| {
                let joint = mechanism.joint(term.joint);
                [joint.predecessor.link.0, joint.successor.link.0].map(|link| bodies.of[link])
            })
            .filter(|body| !passed.contains(body))
            .collect();
        for &body in &ends {
            tied.entry(body).or_default().extend(&ends);
        }
    }
    let mut pieces: Vec<BTreeSet<usize>> = Vec::new();
    let mut seen = passed.clone();
    for &(_, start) in &bodies.joints[base] {
        if seen.contains(&start) {
            continue;
        }
        let mut piece = BTreeSet::from([start]);
        let mut open = vec![start];
        while let Some(body) = open.pop() {
            let joined = bodies.joints[body].iter().map(|(_, other)| *other);
            for next in joined.chain(tied.get(&body).into_iter().flatten().copied()) {
                if !passed.contains(&next) && piece.insert(next) {
                    open.push(next);
                }
            }
        }
        seen.extend(&piece);
        pieces.push(piece);
    }
    pieces
}

/// What tells the link that gives a limb its name.
struct Ends<'a> {
    bodies: &'a Bodies,
    intermediate: &'a [bool],
    /// Whether a body moves idly.
    idle: Vec<bool>,
    /// How freely a body moves.
    freedom: Vec<usize>,
    /// The link that stands for a body, and its rank by name.
    link: Vec<(usize, usize)>,
}

impl<'a> Ends<'a> {
    fn of(
        mechanism: &Mechanism,
        structure: &Structure,
        bodies: &'a Bodies,
        intermediate: &'a [bool],
        branch: &Branch,
    ) -> Self {
        let mut idle = vec![false; bodies.links.len()];
        for link in branch
            .idle
            .iter()
            .flat_map(|idle| idle.with.iter().chain([&idle.link]))
        {
            idle[bodies.of[*link]] = true;
        }
        let mut freedom = vec![0; bodies.links.len()];
        for motion in &branch.motions {
            let most = &mut freedom[bodies.of[motion.link]];
            *most = motion.freedom.unwrap_or(0).max(*most);
        }
        let links = bodies.links.iter().map(|links| {
            let link = main_link(mechanism, structure, links);
            (link, structure.graph.node_rank(link))
        });
        Self {
            bodies,
            intermediate,
            idle,
            freedom,
            link: links.collect(),
        }
    }

    /// The link that a limb starts with, if it starts with one and branches: two parts or more hang on one of its bodies, and each
    /// moves by [`OF_A_BRANCH`] freedoms more.
    fn branching_start(&self, base: usize, piece: &BTreeSet<usize>) -> Option<usize> {
        let inside = |body: usize| self.bodies.joints[body].iter().map(|(_, other)| *other);
        let mut beside = piece
            .iter()
            .copied()
            .filter(|&body| inside(body).any(|other| other == base));
        let start = beside.next()?;
        if beside.next().is_some() {
            return None;
        }
        let mut queue = VecDeque::from([start]);
        let mut seen = BTreeSet::from([base, start]);
        for _ in 0..MOST_FORKS {
            let fork = queue.pop_front()?;
            // Those behind the fork, if not even one way round it leads to the base.
            let parts = self.parts_behind(base, fork);
            let moves = |part: &BTreeSet<usize>| {
                let most = part.iter().map(|&body| self.freedom[body]).max();
                most >= Some(self.freedom[fork] + OF_A_BRANCH)
            };
            if parts.iter().filter(|part| moves(part)).count() > 1 {
                return Some(self.link[start].0);
            }
            queue.extend(inside(fork).filter(|&next| seen.insert(next)));
        }
        None
    }

    /// The sets of bodies that hang together without a body, but for that which has the base.
    fn parts_behind(&self, base: usize, fork: usize) -> Vec<BTreeSet<usize>> {
        let joints = &self.bodies.joints;
        let mut seen = BTreeSet::from([fork]);
        let mut parts = Vec::new();
        // The base's part first, so that it is left out.
        let neighbours: BTreeSet<usize> = joints[fork].iter().map(|(_, other)| *other).collect();
        if neighbours.len() < 3 {
            return parts;
        }
        for start in std::iter::once(base).chain(neighbours) {
            if !seen.insert(start) {
                continue;
            }
            let (mut part, mut open) = (BTreeSet::from([start]), vec![start]);
            while let Some(body) = open.pop() {
                for &(_, next) in &joints[body] {
                    if seen.insert(next) {
                        part.insert(next);
                        open.push(next);
                    }
                }
            }
            if start != base {
                parts.push(part);
            }
        }
        parts
    }

    fn of_piece(&self, base: usize, piece: &BTreeSet<usize>) -> usize {
        // From the base's neighbours, since of all the joints of the base few lead here.
        let beside = |body: &usize| {
            self.bodies.joints[*body]
                .iter()
                .any(|(_, other)| *other == base)
        };
        let mut queue: VecDeque<usize> = piece.iter().copied().filter(beside).collect();
        let mut distance: BTreeMap<usize, usize> = queue.iter().map(|&body| (body, 1)).collect();
        while let Some(body) = queue.pop_front() {
            let next = distance[&body] + 1;
            for (_, other) in &self.bodies.joints[body] {
                if piece.contains(other) && !distance.contains_key(other) {
                    distance.insert(*other, next);
                    queue.push_back(*other);
                }
            }
        }
        let away = |body: &usize| distance.get(body).copied().unwrap_or(0);
        let bodily = |body: &&usize| !self.idle[**body] && !self.intermediate[**body];
        let farthest = piece.iter().filter(bodily).max_by(|a, b| {
            self.freedom[**a]
                .cmp(&self.freedom[**b])
                .then_with(|| self.bodies.mass[**a].total_cmp(&self.bodies.mass[**b]))
                .then_with(|| away(a).cmp(&away(b)))
                .then_with(|| self.link[**b].1.cmp(&self.link[**a].1))
        });
        farthest
            .or(piece.first())
            .map_or(0, |&body| self.link[body].0)
    }
}

/// The heaviest link of a body, or the first by name.
fn main_link(mechanism: &Mechanism, structure: &Structure, links: &[usize]) -> usize {
    let links = heaviest_first(mechanism, structure, links.to_vec());
    links.first().copied().unwrap_or(0)
}
