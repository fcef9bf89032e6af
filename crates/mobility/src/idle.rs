//! Idle freedoms along a branch: a rod, or another body inside a loop, moves while all others stand still.
//!
//! The rod between two balls spins, a sleeve slides on the shaft of its two cylindrical joints, a disc between parallel
//! grooves shifts, a telescopic leg between two balls spins as a whole. Such a freedom enlarges the mobility and says nothing
//! about what the mechanism is for.
//!
//! What may move is a [`Cluster`]: a body (links that fixed joints hold together), or the bodies of a chain between two balls,
//! with the intermediate links of the balls and universal joints that end at it ([`Connections`]).
//!
//! A tangent moves one cluster only if all joints without a side in it stand still. In an orthonormal basis of the
//! tangent space the joints of the cluster alone then make up the whole length of the vector: singular values of their rows
//! equal to one. The pieces into which the other links fall without the cluster are rigid along it, so that it remains to
//! ask of the cluster's neighbours whether they stand still too. What hangs on a cluster by a joint moves with it: then
//! somebody may want that motion, and it is not idle.
//!
//! Cost: linear in the mechanism for links of few joints, times the square of the freedoms of a link's joints.

use super::branch::{Branch, BranchPose, IdleLink};
use super::link_twists::LinkTwists;
use super::one_sided::{OneSided, dot};
use super::point_chains::{Bodies, Connection, Connections, heaviest_first};
use super::pose_rank::{TALL, height};
use super::relative_motion::link_twists;
use super::subgroup::drawn_hidden_offset;
use super::tangent_space::{Blocks, Limits, TangentSpace};
use super::without_body::standing_without;
use kutzbach_closure::{Geometry, Structure, jacobian};
use kutzbach_model::mechanism::Mechanism;
use std::collections::{BTreeMap, BTreeSet};

/// A vector is looked at more closely if at most a tenth of its length is outside the link's own joints.
const NEARLY_ALL: f64 = 0.99;

/// A unit tangent that moves everything else by less is nearly idle: a tenth of a millimetre on a decimetre.
const NEARLY_AT_REST: f64 = 1e-3;

/// The line through the centres of two balls is an axis of both, whatever the file's numbers: what hangs between them spins, exactly and
/// at every pose. So it is seen to rounding, of poses that are closed to rounding.
const COMPUTED_TO: f64 = 1e-9;

/// Bodies of loops that can move alone at all of the poses, with the smallest freedom they have there, by link index.
///
/// A body counts as inside a loop if at least two of its joints are in cycles of one part, and these lead to at least two
/// other bodies: between two bodies alone the motion of one is what the mechanism is for. Bodies that would stand still
/// relative to one another without it count as one for that, as two rails on one wall; but not for a rod between balls, whose
/// spin is of no use in a truss either. Links that hang on bridges, and the ground, are never idle. Where margins are thin a link is not called idle. Freedoms of several entries are independent of
/// one another.
#[must_use]
pub fn idle_links(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
) -> Vec<IdleLink> {
    let seen = link_twists(mechanism, geometry, structure, poses);
    idle_seen(mechanism, geometry, structure, (poses, &seen)).idle
}

pub(super) fn idle_seen(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    (poses, seen): (&[BranchPose], &[LinkTwists]),
) -> IdleFreedoms {
    if seen.is_empty() {
        return IdleFreedoms::default();
    }
    let around = Around::new(mechanism, geometry, structure, poses);
    let clusters = around.clusters();
    let (freedoms, _) = moving_alone(seen, (&around, &clusters), false);
    let (nearly, _) = moving_alone(seen, (&around, &clusters), true);
    let named = |clusters_with: Vec<(&Cluster, usize)>| -> Vec<IdleLink> {
        let mut idle: Vec<IdleLink> = clusters_with
            .into_iter()
            .filter(|(_, freedom)| *freedom > 0)
            .map(|(cluster, freedom)| {
                cluster.named(mechanism, structure, &around.connections.bodies, freedom)
            })
            .collect();
        idle.sort_by_key(|idle| idle.link);
        idle
    };
    let more = nearly
        .iter()
        .zip(&freedoms)
        .map(|(near, idle)| near.saturating_sub(*idle));
    IdleFreedoms {
        nearly: named(clusters.iter().zip(more).collect()),
        idle: named(clusters.iter().zip(freedoms).collect()),
    }
}

/// What is idle along a branch.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct IdleFreedoms {
    /// As [`idle_links`] gives them.
    pub idle: Vec<IdleLink>,
    /// Further freedoms that move a cluster a thousand times as much as anything else: a ball that its rod's axis misses by
    /// little.
    pub nearly: Vec<IdleLink>,
}

/// The freedom of each cluster beyond that of its bodies one by one, and the tangents that move it alone, pose by pose.
fn moving_alone(
    seen: &[LinkTwists],
    (around, clusters): (&Around<'_>, &[Cluster]),
    nearly: bool,
) -> (Vec<usize>, Vec<Vec<Combinations>>) {
    let mut freedoms = vec![usize::MAX; clusters.len()];
    let mut all = Vec::with_capacity(seen.len());
    for there in seen {
        let mut moving: Vec<Combinations> = Vec::with_capacity(clusters.len());
        for (freedom, cluster) in freedoms.iter_mut().zip(clusters) {
            let alone = match freedom {
                0 => Combinations::default(),
                _ => idle_tangents(there, cluster, nearly).unwrap_or_default(),
            };
            // A chain moves as a whole where its bodies move one by one.
            let singles: Vec<&Combinations> = cluster
                .singles
                .iter()
                .map(|&single| &moving[single])
                .filter(|single| !single.weights.is_empty())
                .collect();
            let more = if singles.is_empty() {
                alone.weights.len()
            } else {
                let singly = singles.iter().map(|single| single.weights.len()).sum();
                let all = singles.into_iter().chain([&alone]);
                let rank = OneSided::of(Combinations::together(all))
                    .and_then(|all| there.rank(&all.values));
                rank.map_or(0, |rank| rank.saturating_sub(singly))
            };
            *freedom = more.min(*freedom);
            moving.push(alone);
        }
        all.push(moving);
    }
    for (freedom, cluster) in freedoms.iter_mut().zip(clusters) {
        let idle = || {
            let apart = !nearly && around.is_hardly_apart(cluster);
            !apart && !around.is_between_two(cluster)
        };
        if *freedom > 0 && !idle() {
            *freedom = 0;
        }
    }
    (freedoms, all)
}

/// What a cluster is in.
struct Around<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    structure: &'a Structure,
    poses: &'a [BranchPose],
    connections: Connections,
}

impl<'a> Around<'a> {
    fn new(
        mechanism: &'a Mechanism,
        geometry: &'a Geometry<f64>,
        structure: &'a Structure,
        poses: &'a [BranchPose],
    ) -> Self {
        Self {
            mechanism,
            geometry,
            structure,
            poses,
            connections: Connections::of(mechanism, geometry, structure),
        }
    }

    fn clusters(&self) -> Vec<Cluster> {
        clusters(self.mechanism, self.structure, &self.connections)
    }

    /// Whether the bodies that a body moves between are as good as one: they stand still relative to one another without it.
    fn is_between_two(&self, cluster: &Cluster) -> bool {
        let Some(beyond) = &cluster.beyond else {
            return false;
        };
        let part = &self.structure.parts[beyond.part];
        self.poses.iter().all(|pose| {
            let still = standing_without(
                self.mechanism,
                self.geometry,
                &pose.states,
                part,
                &cluster.own,
            );
            still.is_some_and(|still| self.connections.bodies.joined(&beyond.bodies, &still))
        })
    }
}

impl Around<'_> {
    /// Whether axes of a body's joints are apart by what doubles take for nothing and the file's numbers do not: it moves the others
    /// after all. What spins between two balls is idle whatever the numbers.
    fn is_hardly_apart(&self, cluster: &Cluster) -> bool {
        let own = |joint: &usize| cluster.own.contains(joint);
        let mut parts = self.structure.parts.iter();
        let part = parts.find(|part| part.joints.iter().any(own));
        part.is_some_and(|part| {
            let joints: Vec<usize> = part.joints.iter().copied().filter(own).collect();
            !cluster.spins
                && height(self.mechanism, part) > TALL
                && jacobian(self.mechanism, self.geometry, &self.geometry.states, part).is_ok_and(
                    |rows| {
                        drawn_hidden_offset(self.mechanism, part, &joints, rows.length).is_some()
                    },
                )
        })
    }
}

/// Sums of some vectors of a basis of tangents.
#[derive(Clone, Debug, Default)]
struct Combinations {
    /// Indices of the vectors, increasing.
    vectors: Vec<usize>,
    /// One weight for each of the vectors, sum by sum.
    weights: Vec<Vec<f64>>,
}

impl Combinations {
    /// All weights of some combinations, over the vectors that any of them has.
    fn together<'a>(of: impl Iterator<Item = &'a Self> + Clone) -> Vec<Vec<f64>> {
        let vectors: BTreeSet<usize> = of.clone().flat_map(|one| &one.vectors).copied().collect();
        let place: BTreeMap<usize, usize> = vectors
            .into_iter()
            .enumerate()
            .map(|(at, vector)| (vector, at))
            .collect();
        of.flat_map(|one| one.weights.iter().map(move |weights| (one, weights)))
            .map(|(one, weights)| {
                let mut all = vec![0.0; place.len()];
                for (vector, weight) in one.vectors.iter().zip(weights) {
                    all[place[vector]] = *weight;
                }
                all
            })
            .collect()
    }
}

/// A tangent space taken apart into what moves independently of everything else, idle motions heeded.
pub(super) struct IdleSpace {
    pub tangents: TangentSpace,
    pub blocks: Blocks,
    /// For every block an orthonormal basis of the idle motions in it: weights of its vectors.
    pub idle: Vec<Vec<Vec<f64>>>,
}

impl IdleSpace {
    /// A tangent space of which no motion counts as idle.
    pub fn without_idle(tangents: TangentSpace) -> Self {
        let blocks = tangents.blocks([]);
        Self {
            idle: vec![Vec::new(); blocks.vectors.len()],
            blocks,
            tangents,
        }
    }
}

/// The tangent spaces at the usable ones of the poses of a branch, with the idle motions in them.
pub(super) fn idle_spaces(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    branch: &Branch,
) -> Vec<IdleSpace> {
    let seen = &*branch.seen;
    // Without a pose nothing bounds what might move alone.
    if seen.is_empty() {
        return Vec::new();
    }
    let around = Around::new(mechanism, geometry, structure, &branch.poses);
    let clusters = around.clusters();
    let (freedoms, moving) = moving_alone(seen, (&around, &clusters), false);
    let dimension: usize = freedoms.iter().sum();
    seen.iter()
        .zip(moving)
        .filter_map(|(there, moving)| {
            let idle: Vec<Combinations> = moving
                .into_iter()
                .zip(&freedoms)
                .filter(|(alone, freedom)| **freedom > 0 && !alone.weights.is_empty())
                .map(|(alone, _)| alone)
                .collect();
            let blocks = there
                .tangents
                .blocks(idle.iter().map(|alone| &alone.vectors[..]));
            let mut of_blocks: Vec<Vec<Vec<f64>>> = vec![Vec::new(); blocks.vectors.len()];
            for alone in &idle {
                for weights in &alone.weights {
                    let (block, _) = blocks.place[alone.vectors[0]];
                    let mut own = vec![0.0; blocks.vectors[block].len()];
                    for (vector, weight) in alone.vectors.iter().zip(weights) {
                        own[blocks.place[*vector].1] = *weight;
                    }
                    of_blocks[block].push(own);
                }
            }
            let mut units = Vec::with_capacity(of_blocks.len());
            for idle in of_blocks {
                let found = OneSided::of(idle)?;
                let rank = there.rank(&found.values)?;
                let vectors = found.vectors.into_iter().zip(found.values).take(rank);
                let unit =
                    vectors.map(|(vector, value)| vector.iter().map(|x| x / value).collect());
                units.push(unit.collect());
            }
            // Poses that show more than others do are not generic.
            (units.iter().map(Vec::len).sum::<usize>() == dimension).then_some(IdleSpace {
                tangents: there.tangents.clone(),
                blocks,
                idle: units,
            })
        })
        .collect()
}

/// What a body moves between.
struct Beyond {
    /// The part that its loops are in.
    part: usize,
    /// The other bodies that its joints in these loops lead to.
    bodies: BTreeSet<usize>,
}

/// Bodies that might move alone.
struct Cluster {
    /// The bodies that move as one.
    core: Vec<usize>,
    /// Intermediate bodies of the connections at its ends.
    between: Vec<usize>,
    /// Joints that move with it.
    own: Vec<usize>,
    /// A link of the core.
    link: usize,
    /// The links beyond the joints, each with its joint.
    neighbours: Vec<(usize, usize)>,
    /// What it moves between, of a single body that is neither a rod nor an intermediate one.
    beyond: Option<Beyond>,
    /// Whether it hangs between balls only.
    rod: bool,
    /// Whether these are two, and each a single joint.
    spins: bool,
    /// Of a chain: the clusters of its bodies.
    singles: Vec<usize>,
}

impl Cluster {
    fn new(mechanism: &Mechanism, bodies: &Bodies, core: Vec<usize>, ends: &[&Connection]) -> Self {
        let between: Vec<usize> = ends.iter().flat_map(|end| &end.between).copied().collect();
        let own: Vec<usize> = ends.iter().flat_map(|end| &end.joints).copied().collect();
        let mut neighbours = Vec::new();
        for &index in &own {
            let joint = &mechanism.joints()[index];
            for link in [joint.predecessor.link.0, joint.successor.link.0] {
                let body = bodies.of[link];
                if !core.contains(&body) && !between.contains(&body) {
                    neighbours.push((index, link));
                }
            }
        }
        Self {
            link: bodies.links[core[0]][0],
            core,
            between,
            own,
            neighbours,
            beyond: None,
            rod: ends.iter().all(|end| end.ball),
            spins: ends.len() == 2 && ends.iter().all(|end| end.ball && end.joints.len() == 1),
            singles: Vec::new(),
        }
    }

    /// The links that move: the one with most mass, or the first by name, before the others.
    fn named(
        &self,
        mechanism: &Mechanism,
        structure: &Structure,
        bodies: &Bodies,
        freedom: usize,
    ) -> IdleLink {
        let links = |of: &[usize]| {
            let links = of.iter().flat_map(|&body| &bodies.links[body]).copied();
            heaviest_first(mechanism, structure, links.collect())
        };
        let mut all = links(&self.core);
        all.extend(links(&self.between));
        IdleLink {
            link: all.remove(0),
            with: all,
            freedom,
            rod: self.rod,
        }
    }
}

/// The part whose cycles a joint is in, by joint.
fn parts_of_joints(mechanism: &Mechanism, structure: &Structure) -> Vec<Option<usize>> {
    let mut part_of = vec![None; mechanism.joints().len()];
    for (index, part) in structure.parts.iter().enumerate() {
        for (joint, _) in part.cycles.iter().flatten() {
            part_of[*joint] = Some(index);
        }
    }
    part_of
}

/// The bodies of loops one by one, and the chains between two balls after them.
fn clusters(
    mechanism: &Mechanism,
    structure: &Structure,
    connections: &Connections,
) -> Vec<Cluster> {
    let bodies = &connections.bodies;
    let part_of = parts_of_joints(mechanism, structure);
    let ground = bodies.of[mechanism.ground().0];
    let mut single_of = vec![None; bodies.links.len()];
    let mut found: Vec<Cluster> = Vec::new();
    for body in (0..bodies.links.len()).filter(|body| *body != ground) {
        let joints = &bodies.joints[body];
        let mut parts: Vec<usize> = joints.iter().filter_map(|(j, _)| part_of[*j]).collect();
        parts.sort_unstable();
        if !parts.windows(2).any(|pair| pair[0] == pair[1]) {
            continue;
        }
        // An intermediate link is asked for by itself: its joint by joint.
        let apart: Vec<Connection> = match connections.intermediate[body] {
            true => joints
                .iter()
                .map(|&(j, o)| Connection::one(mechanism, j, [body, o]))
                .collect(),
            false => Vec::new(),
        };
        let at = connections.at[body]
            .iter()
            .map(|&index| &connections.all[index]);
        let ends: Vec<&Connection> = at.chain(&apart).collect();
        let mut cluster = Cluster::new(mechanism, bodies, vec![body], &ends);
        let in_loops = cluster
            .neighbours
            .iter()
            .filter(|(joint, _)| part_of[*joint].is_some());
        let others: BTreeSet<usize> = in_loops.map(|&(_, link)| bodies.of[link]).collect();
        if others.len() >= 2 {
            // What other loops hold together is not asked of several parts at once.
            parts.dedup();
            if let ([part], false) = (&parts[..], cluster.rod || connections.intermediate[body]) {
                cluster.beyond = Some(Beyond {
                    part: *part,
                    bodies: others,
                });
            }
            single_of[body] = Some(found.len());
            found.push(cluster);
        }
    }
    for (core, ends) in chains(connections, ground) {
        let [first, last] = ends.map(|index| &connections.all[index]);
        if part_of[first.joints[0]].is_none() || part_of[first.joints[0]] != part_of[last.joints[0]]
        {
            continue;
        }
        let mut cluster = Cluster::new(mechanism, bodies, core, &[first, last]);
        cluster.singles = cluster
            .core
            .iter()
            .filter_map(|&body| single_of[body])
            .collect();
        found.push(cluster);
    }
    found
}

/// Chains of two bodies or more from one ball to another, without branches: their bodies and the two balls.
fn chains(connections: &Connections, ground: usize) -> Vec<(Vec<usize>, [usize; 2])> {
    let inner = |body: usize| body != ground && connections.at[body].len() == 2;
    let mut found = Vec::new();
    for start in (0..connections.at.len()).filter(|&body| inner(body)) {
        for &ball in connections.at[start]
            .iter()
            .filter(|&&c| connections.all[c].ball)
        {
            let mut core = vec![start];
            let (mut body, mut came_by) = (start, ball);
            let last = loop {
                let Some(&onward) = connections.at[body].iter().find(|&&c| c != came_by) else {
                    break None;
                };
                let connection = &connections.all[onward];
                if connection.ball {
                    break Some(onward);
                }
                let next = connection.beyond(body);
                if !inner(next) || core.contains(&next) {
                    break None;
                }
                core.extend(&connection.between);
                core.push(next);
                (body, came_by) = (next, onward);
            };
            // Every chain is met from both of its ends.
            let Some(last) = last.filter(|_| start < body) else {
                continue;
            };
            if connections.all[ball].beyond(start) != connections.all[last].beyond(body) {
                found.push((core, [ball, last]));
            }
        }
    }
    found
}

/// The tangents that move a cluster alone, as orthonormal combinations of the basis, one for each of its freedoms; `None`
/// where a margin is thin. `nearly`: others may move a little.
fn idle_tangents(there: &LinkTwists, cluster: &Cluster, nearly: bool) -> Option<Combinations> {
    let tangents = &there.tangents;
    let own: Vec<usize> = cluster
        .own
        .iter()
        .flat_map(|joint| tangents.variables(*joint))
        .collect();
    // All others leave the cluster at rest.
    let vectors = tangents.vectors_of(own.iter().copied());
    let rows = own
        .iter()
        .map(|&variable| tangents.components(variable, &vectors));
    let found = OneSided::of(rows.collect())?;
    // Combinations of the tangents that hardly move any other joint.
    let candidates: Vec<Vec<f64>> = found
        .vectors
        .iter()
        .zip(&found.values)
        .take_while(|(_, value)| **value > NEARLY_ALL)
        .map(|(vector, value)| vector.iter().map(|x| x / value).collect())
        .collect();
    if candidates.is_empty() {
        return Some(Combinations::default());
    }
    let is_own: BTreeSet<usize> = own.into_iter().collect();
    let others: Vec<Vec<f64>> = tangents
        .moved_with(&vectors)
        .into_iter()
        .filter(|variable| !is_own.contains(variable))
        .map(|variable| tangents.components(variable, &vectors))
        .collect();
    let others_move: Vec<Vec<f64>> = candidates
        .iter()
        .map(|candidate| {
            let mut moves: Vec<f64> = others.iter().map(|row| dot(row, candidate)).collect();
            for (_, neighbour) in &cluster.neighbours {
                moves.extend(there.along(*neighbour, &vectors, candidate));
            }
            moves
        })
        .collect();
    let rank_of = |values: &[f64]| match cluster.spins {
        true => Limits::new(COMPUTED_TO, tangents.length()).rank(values),
        false => there.rank(values),
    };
    let outside = OneSided::of(others_move)?;
    let moving = match nearly {
        true => outside
            .values
            .iter()
            .filter(|value| **value > NEARLY_AT_REST)
            .count(),
        false => {
            // That it spins is known; which tangent that is, is seen among those of a shaky pose, which is not closed to rounding.
            let least = outside.values.iter().copied().fold(f64::INFINITY, f64::min);
            let spin = usize::from(cluster.spins && least <= NEARLY_AT_REST);
            let most = outside.values.len() - spin;
            let rank = rank_of(&outside.values);
            rank.or((spin > 0).then_some(most))?.min(most)
        }
    };
    // What is left moves nothing else; some of it may not even move the core, where a joint's own screws are dependent.
    let alone: Vec<Vec<f64>> = outside.combinations[moving..]
        .iter()
        .map(|combination| combined(&candidates, combination))
        .collect();
    let own_motion = alone
        .iter()
        .map(|sum| there.along(cluster.link, &vectors, sum).to_vec());
    let own_motion = OneSided::of(own_motion.collect())?;
    let freedom = rank_of(&own_motion.values)?;
    let weights = own_motion.combinations[..freedom]
        .iter()
        .map(|combination| combined(&alone, combination))
        .collect();
    Some(Combinations { vectors, weights })
}

/// Σ weights[i] vectors[i]; nothing where there are no vectors.
fn combined(vectors: &[Vec<f64>], weights: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; vectors.first().map_or(0, Vec::len)];
    for (vector, weight) in vectors.iter().zip(weights) {
        sum.iter_mut()
            .zip(vector)
            .for_each(|(s, x)| *s += weight * x);
    }
    sum
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::branch_samples::Sample;
    use super::*;

    fn idle(sample: &Sample) -> Vec<(&str, usize)> {
        idle_links(
            &sample.mechanism,
            &sample.geometry,
            &sample.structure,
            &sample.poses,
        )
        .iter()
        .map(|idle| {
            let link = &sample.mechanism.links()[idle.link];
            (link.name.as_str(), idle.freedom)
        })
        .collect()
    }

    #[test]
    fn rods_spin_and_sleeves_slide() {
        assert_eq!(idle(&Sample::rod_between_links()), [("r1", 1)]);
        assert_eq!(idle(&Sample::sleeve_between_links()), [("r1", 2)]);
    }

    #[test]
    fn between_two_places_of_one_body_nothing_is_idle() {
        assert!(idle(&Sample::rod()).is_empty());
        assert!(idle(&Sample::sleeve()).is_empty());
    }

    #[test]
    fn links_that_move_others_are_not_idle() {
        assert!(idle(&Sample::parallelogram()).is_empty());
    }

    #[test]
    fn the_poorest_pose_counts() {
        let mut sample = Sample::sleeve_between_links();
        sample.poses[1].tangents.pop();
        assert_eq!(idle(&sample), [("r1", 1)]);
        sample.poses[0].tangents.clear();
        assert!(idle(&sample).is_empty());
        sample.poses.clear();
        assert!(idle(&sample).is_empty());
    }
}
